//! From a picture to the pixels of line y.

use core::ops::Range;

use embedded_graphics::primitives::Rectangle;

use crate::{
    ladder::Degraded,
    model::{
        light::{Light, LightSource},
        material::{Color, Material},
    },
    scan::{
        active::Active, columns::Columns, geometry::Source, list::ActiveList, picture::Picture, resolve::Spanning, table::Span,
        visibility::Visibility,
    },
    shade::{duff_barycentric::DuffBarycentric, Shade},
    sink::{ink::Ink, row::Row},
    walk::{Dressed, Shading, Take, Walk},
    work::Work,
};

/// The state of a walk down a picture: up to `ACTIVE` triangles that cross one line, each with a facet of the shading method. Two that the
/// [frame](crate::Frame) keeps as one are one here, too.
///
/// Owns its memory: about 200 bytes for each of `ACTIVE` with the default method and one light.
#[derive(Clone, Debug)]
pub struct Scanner<
    const ACTIVE: usize,
    S: Shade<LIGHTS, L> = DuffBarycentric,
    const LIGHTS: usize = 1,
    L: LightSource = Light,
    V: Visibility = Spanning,
> {
    list: ActiveList<ACTIVE>,
    facets: [[S::Facet; 2]; ACTIVE],
    visibility: V,
}

impl<const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource, V: Visibility>
    Scanner<ACTIVE, S, LIGHTS, L, V>
{
    /// A scanner at rest.
    #[must_use]
    pub const fn new() -> Self {
        Self { list: ActiveList::new(), facets: [[S::EMPTY; 2]; ACTIVE], visibility: V::NEW }
    }

    /// Starts on a picture, above its first line, with an empty list of triangles.
    pub fn start<'s, 'm>(&'s mut self, picture: Picture<'s, 'm, LIGHTS, L>) -> Lines<'s, 'm, ACTIVE, S, LIGHTS, L, V> {
        self.list.clear();
        Lines { scanner: self, picture, line: None, dropped: 0, degraded: Degraded::default() }
    }
}

impl<const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource, V: Visibility> Default
    for Scanner<ACTIVE, S, LIGHTS, L, V>
{
    fn default() -> Self {
        Self::new()
    }
}

/// What a line was made of, and what had no room.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Line {
    /// Triangles that cross it; two that are kept as one count once.
    pub active: u16,
    /// Visible spans; pieces that clipping or splitting made of one triangle count apart, two triangles that share
    /// [a facet](Shade::pair) together, but in frozen pictures, and in smooth and transparent lines.
    pub spans: u16,
    /// Facets set up on it.
    pub facets: u16,
    /// Of those, facets whose normals bend beyond what shading follows exactly: u above 63/64 at an edge's middle or the centroid.
    pub bent: u16,
    /// Triangles left out for want of room, on this and all lines above: of those that cross a line, the ones whose nearest
    /// corner is farthest.
    pub dropped: u16,
    /// Visible spans left out for want of room in the table that they were to be [baked](Lines::bake) or
    /// [frozen](crate::Frozen::take) into: the rightmost ones, and those of facets without room. Always 0 for a row.
    pub left_out: u16,
}

impl Line {
    /// A line without triangles.
    pub(crate) const NONE: Self = Self { active: 0, spans: 0, facets: 0, bent: 0, dropped: 0, left_out: 0 };
}

/// The lines of one picture, in any order; from top to bottom is fastest.
#[derive(Debug)]
pub struct Lines<
    's,
    'm,
    const ACTIVE: usize,
    S: Shade<LIGHTS, L> = DuffBarycentric,
    const LIGHTS: usize = 1,
    L: LightSource = Light,
    V: Visibility = Spanning,
> {
    scanner: &'s mut Scanner<ACTIVE, S, LIGHTS, L, V>,
    picture: Picture<'s, 'm, LIGHTS, L>,
    /// The line that the active list stands on; the list is empty if that is none.
    line: Option<u16>,
    dropped: u16,
    degraded: Degraded,
}

impl<'s, 'm, const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource, V: Visibility>
    Lines<'s, 'm, ACTIVE, S, LIGHTS, L, V>
{
    /// Where the picture lies on the panel, and its size.
    #[must_use]
    pub const fn viewport(&self) -> Rectangle {
        self.picture.viewport()
    }

    /// Shades line y into the row: every pixel up to the picture's width stored once, from left to right; a shorter row takes
    /// what fits. A y below the picture leaves the row alone.
    ///
    /// The next line costs a step of each active triangle; a later one that for each line in between, without shading; an
    /// earlier one the walk from the top again. The pixels are the same in whatever order. [Transparent](Material::opacity)
    /// triangles are opaque in it.
    #[inline(never)]
    pub fn line<P: Ink>(&mut self, y: u16, row: &mut [P]) -> Line {
        if !self.seek(y) {
            return self.none();
        }
        let width = self.width().min(row.len());
        let row = Row::new(row.get_mut(..width).unwrap_or_default(), self.background(y));
        let intensities = self.picture.intensities;
        let first = self.first_material();
        let Some(material) = first else {
            row.finish();
            return self.none();
        };
        let shading = Shading { row, dressed: Dressed::new(y.into(), material, intensities) };
        let (line, shading) = self.walk(y, width, material, shading);
        shading.row.finish();
        line
    }

    /// What was walked so far, running on modulo 2³²: what a line took is the difference between after and before. Nothing is
    /// counted without the feature `tally`; `long` never is, as [`Picture::most`] knows it.
    #[must_use]
    pub fn walked(&self) -> Work {
        let work = self.scanner.list.tally.work();
        let searches = [work.entered, work.facets, work.walked].into_iter().fold(work.searched, u32::wrapping_add);
        Work { searched: searches.wrapping_mul(self.picture.geometry.searched()), ..work }
    }

    /// Facets set up so far on each rung of a [ladder](crate::ladder) below the first.
    #[must_use]
    pub const fn degraded(&self) -> Degraded {
        self.degraded
    }

    /// Brings the active list to line y; gives the triangles that cross it, by what they cover and in their slots. None if the
    /// picture has no such line.
    pub(crate) fn crossing(&mut self, y: u16) -> Option<(&[Span], &mut [Active; ACTIVE])> {
        self.seek(y).then(|| self.scanner.list.split())
    }

    /// The spans of line y with the triangles seen in them, left to right, handed to `see` one by one.
    pub fn spans(&mut self, y: u16, mut see: impl FnMut(Range<u16>, Source)) {
        if !self.seek(y) {
            return;
        }
        let Scanner { list, visibility, .. } = &mut *self.scanner;
        let geometry = &self.picture.geometry;
        visibility.resolve(y, geometry.width(), list, geometry, |spans, slots| {
            for span in spans {
                let Some(active) = slots.get(usize::from(span.slot())) else { continue };
                for (id, span) in active.ids().into_iter().zip(span.halves(active.middle().into())) {
                    if let (false, Some(source)) = (span.is_empty(), geometry.source(id)) {
                        see(span.start() as u16..span.end() as u16, source);
                    }
                }
            }
        });
    }

    /// The triangles that cross the line.
    pub(crate) const fn list(&self) -> &ActiveList<ACTIVE> {
        &self.scanner.list
    }

    /// The same, to be changed for a while.
    pub(crate) const fn list_mut(&mut self) -> &mut ActiveList<ACTIVE> {
        &mut self.scanner.list
    }

    /// The facets of the triangles that are seen, by their slots.
    pub(crate) const fn facets(&self) -> &[[S::Facet; 2]; ACTIVE] {
        &self.scanner.facets
    }

    /// The picture.
    pub(crate) const fn picture(&self) -> &Picture<'s, 'm, LIGHTS, L> {
        &self.picture
    }

    /// Forgets where it stands, and all facets.
    pub(crate) fn rewind(&mut self) {
        self.scanner.list.clear();
        self.line = None;
    }

    pub(crate) fn width(&self) -> usize {
        self.picture.geometry.width() as usize
    }

    /// What fills line y where no triangle is seen.
    #[inline(always)]
    pub(crate) fn background(&self, y: u16) -> Option<Color> {
        self.picture.background.at(y, self.picture.geometry.height())
    }

    /// The counts of a line without triangles.
    pub(crate) fn none(&self) -> Line {
        Line { dropped: self.dropped, ..Line::NONE }
    }

    /// The material of the leftmost triangle of the line that the list stands on, if there is any.
    #[inline(always)]
    pub(crate) fn first_material(&self) -> Option<&'m Material> {
        self.scanner.list.extents().first().and_then(|extent| self.picture.geometry.material(extent.look()))
    }

    /// Hands the visible spans of line y, on which the list stands, to whoever takes them, with that material ready.
    #[inline(always)]
    pub(crate) fn walk<T: Take<'m, S, LIGHTS, L>>(&mut self, y: u16, width: usize, material: &'m Material, to: T) -> (Line, T) {
        let Scanner { list, facets, visibility } = &mut *self.scanner;
        let picture = &self.picture;
        let look = list.extents().first().map_or(0, |extent| extent.look());
        let line = Line { active: list.extents().len() as u16, dropped: self.dropped, ..Line::NONE };
        let mut walk = Walk::new(picture, facets, &mut self.degraded, look, material, to);
        visibility.resolve(y, width as i32, list, &picture.geometry, |spans, slots| walk.see(spans, slots));
        let (active, spans, facets) = (line.active.into(), walk.spans.into(), walk.made.into());
        list.tally.add(Work { active, spans, facets, ..walk.tally.work() });
        (Line { spans: walk.spans, facets: walk.made, bent: walk.bent, ..line }, walk.to)
    }

    /// The triangle that is seen at a pixel of the picture, transparent or not; none for the background, and outside of the picture.
    ///
    /// There is no buffer of numbers: the line is resolved once more, at the cost of [`line`](Self::line) without shading, in
    /// whatever order. So "the smallest pick primitive becomes a visible surface and not a pixel" (*Faster Phong Shading*, §1).
    ///
    /// ```
    /// use beamshade::{Camera, Frame, Light, Pose, Scanner, Source};
    /// # use embedded_graphics::geometry::Size;
    /// # use beamshade::{Color, Material, Mesh, MeshData};
    /// # use fixed::types::I16F16;
    /// # static CARD: Mesh<'static> = match Mesh::new(MeshData {
    /// #     extent: I16F16::ONE, center: [0; 3], radius: 32768, positions: &[[-16384, -16384, 0], [16384, -16384, 0], [0, 16384, 0]],
    /// #     normals: &[[0, 0, 16384]; 3], triangles: &[[0, 1, 2]], edges: &[[0; 3]], parts: &[[1, 0]],
    /// #     materials: &[Material::new(Color::WHITE)],
    /// # }) { Ok(mesh) => mesh, Err(_) => panic!() };
    ///
    /// let mut frame = Frame::<512, 512, 48>::new();
    /// let mut scanner = Scanner::<72>::new();
    /// frame.begin(&Camera::new(Size::new(64, 48)), &[Light::OFF])?;
    /// frame.add(&CARD, &Pose::IDENTITY)?; // object 0
    /// frame.add(&CARD, &Pose::IDENTITY.at([0.0, 0.0, 1.0]))?; // object 1, nearer
    /// let mut lines = scanner.start(frame.picture());
    /// assert_eq!(lines.pick(32, 24), Some(Source { object: 1, triangle: 0 }));
    /// assert_eq!(lines.pick(0, 0), None);
    /// # Ok::<(), beamshade::Full>(())
    /// ```
    pub fn pick(&mut self, x: u16, y: u16) -> Option<Source> {
        let mut picked = None;
        self.spans(y, |span, source| {
            if span.contains(&x) {
                picked = Some(source);
            }
        });
        picked
    }

    /// The columns of line y from the first pixel that a triangle covers to the last one, known before it is shaded; none if
    /// all is background.
    pub fn covered(&mut self, y: u16) -> Columns {
        if !self.seek(y) {
            return Columns::NONE;
        }
        let width = self.picture.geometry.width();
        let (mut first, mut after) = (width, 0);
        for extent in self.scanner.list.extents() {
            let (start, end) = (extent.start().max(0), extent.end().min(width));
            if start < end {
                (first, after) = (first.min(start), after.max(end));
            }
        }
        Columns { start: first as u16, end: after as u16 }.within(Columns::ALL)
    }

    /// Brings the active list to line y; false if the picture has no such line.
    pub(crate) fn seek(&mut self, y: u16) -> bool {
        if y >= self.picture.geometry.height() {
            return false;
        }
        let mut line = match self.line {
            Some(line) if line <= y => line,
            before => {
                if before.is_some() {
                    self.scanner.list.clear();
                }
                self.dropped = self.scanner.list.enter(0, &self.picture.geometry);
                0
            }
        };
        while line < y {
            line += 1;
            self.dropped = self.dropped.saturating_add(self.scanner.list.advance(line, &self.picture.geometry));
        }
        self.line = Some(y);
        self.scanner.list.tally.add(Work { walked: 1, ..Work::NONE });
        true
    }
}
