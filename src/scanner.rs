//! From a picture to the pixels of line y.

use core::ops::Range;

use embedded_graphics::primitives::Rectangle;

use crate::{
    model::{
        light::{Light, LightSource},
        material::Color,
    },
    scan::{
        active::Active,
        geometry::Source,
        list::ActiveList,
        picture::{Background, Picture},
        resolve::Sweep,
        table::{Span, Table},
        triangle::Triangle,
    },
    shade::{duff_barycentric::DuffBarycentric, Shade, Surface},
    sink::ink::Ink,
};

/// The state of a walk down a picture: up to `ACTIVE` triangles that cross one line, each with a facet of the shading method.
///
/// Owns its memory: about 140 bytes for each active triangle with the default method and one light.
#[derive(Clone, Debug)]
pub struct Scanner<const ACTIVE: usize, S: Shade<LIGHTS, L> = DuffBarycentric, const LIGHTS: usize = 1, L: LightSource = Light> {
    list: ActiveList<ACTIVE>,
    facets: [S::Facet; ACTIVE],
    table: Table<ACTIVE>,
}

impl<const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource> Scanner<ACTIVE, S, LIGHTS, L> {
    /// A scanner at rest.
    #[must_use]
    pub const fn new() -> Self {
        Self { list: ActiveList::new(), facets: [S::EMPTY; ACTIVE], table: Table::new() }
    }

    /// Starts on a picture, above its first line.
    pub fn start<'s>(&'s mut self, picture: Picture<'s, LIGHTS, L>) -> Lines<'s, ACTIVE, S, LIGHTS, L> {
        // The walk to the first line asked for clears the list.
        Lines { scanner: self, picture, line: None, dropped: 0 }
    }
}

impl<const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource> Default for Scanner<ACTIVE, S, LIGHTS, L> {
    fn default() -> Self {
        Self::new()
    }
}

/// What a line was made of, and what had no room.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Line {
    /// Triangles that cross it.
    pub active: u16,
    /// Visible spans; pieces that clipping or splitting made of one triangle count apart.
    pub spans: u16,
    /// Facets set up on it.
    pub facets: u16,
    /// Of those, facets whose normals bend beyond what shading follows exactly: u above 63/64 at an edge's middle or the centroid.
    pub bent: u16,
    /// Triangles left out for want of room, on this and all lines above: of those that cross a line, the ones whose nearest
    /// corner is farthest.
    pub dropped: u16,
}

/// The lines of one picture, in any order; from top to bottom is fastest.
#[derive(Debug)]
pub struct Lines<'s, const ACTIVE: usize, S: Shade<LIGHTS, L> = DuffBarycentric, const LIGHTS: usize = 1, L: LightSource = Light>
{
    scanner: &'s mut Scanner<ACTIVE, S, LIGHTS, L>,
    picture: Picture<'s, LIGHTS, L>,
    /// The line that the active list stands on.
    line: Option<u16>,
    dropped: u16,
}

impl<const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource> Lines<'_, ACTIVE, S, LIGHTS, L> {
    /// Where the picture lies on the panel, and its size.
    #[must_use]
    pub const fn viewport(&self) -> Rectangle {
        self.picture.viewport()
    }

    /// Shades line y into the row: every pixel up to the picture's width stored once, from left to right; a shorter row takes
    /// what fits. A y below the picture leaves the row alone.
    ///
    /// The next line costs a step of each active triangle; a later one that for each line in between, without shading; an
    /// earlier one the walk from the top again. The pixels are the same in whatever order.
    #[inline(never)]
    pub fn line<P: Ink>(&mut self, y: u16, row: &mut [P]) -> Line {
        if !self.seek(y) {
            return Line { dropped: self.dropped, ..Line::default() };
        }
        let Scanner { list, facets, table } = &mut *self.scanner;
        let picture = &self.picture;
        let width = picture.geometry.width().min(row.len() as i32);
        let background = background(picture, y);
        let pixels = row.get_mut(..width as usize).unwrap_or_default();
        let mut line = Line { active: list.extents().len() as u16, dropped: self.dropped, ..Line::default() };
        let mut from = 0;
        if let Some(dressed) = list.extents().first().and_then(|extent| Dressed::new(picture, extent.look(), y.into())) {
            let (spans, made, bent) = (0, 0, 0);
            let mut row =
                Row::<P, S, ACTIVE, LIGHTS, L> { picture, facets, pixels, from, background, dressed, spans, made, bent };
            Sweep::new(y, width).run(list, &picture.geometry, table, |spans, slots| row.see(spans, slots));
            (from, line) = (row.from, Line { spans: row.spans, facets: row.made, bent: row.bent, ..line });
        }
        if from < pixels.len() {
            fill(pixels, from, pixels.len(), background);
        }
        line
    }

    /// The spans of line y with the triangles seen in them, left to right, handed to `see` one by one.
    pub fn spans(&mut self, y: u16, mut see: impl FnMut(core::ops::Range<u16>, Source)) {
        if !self.seek(y) {
            return;
        }
        let Scanner { list, table, .. } = &mut *self.scanner;
        let geometry = &self.picture.geometry;
        Sweep::new(y, geometry.width()).run(list, geometry, table, |spans, slots| {
            for span in spans.iter().filter(|span| !span.is_empty()) {
                let source = slots.get(usize::from(span.slot())).and_then(|active| geometry.source(active.id));
                if let Some(source) = source {
                    see(span.start() as u16..span.end() as u16, source);
                }
            }
        });
    }

    /// Brings the active list to line y; false if the picture has no such line.
    fn seek(&mut self, y: u16) -> bool {
        if y >= self.picture.geometry.height() {
            return false;
        }
        let mut line = match self.line {
            Some(line) if line <= y => line,
            _ => {
                self.scanner.list.clear();
                self.dropped = self.scanner.list.enter(0, &self.picture.geometry);
                0
            }
        };
        while line < y {
            line += 1;
            self.dropped = self.dropped.saturating_add(self.scanner.list.advance(line, &self.picture.geometry));
        }
        self.line = Some(y);
        true
    }
}

/// A row on its way to be stored, from left to right.
struct Row<'a, 'p, P: Ink, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource> {
    picture: &'a Picture<'p, LIGHTS, L>,
    facets: &'a mut [S::Facet; ACTIVE],
    pixels: &'a mut [P],
    /// The first pixel that is not stored.
    from: usize,
    background: Option<Color>,
    dressed: Dressed<'p, P, LIGHTS>,
    /// Counts of [`Line`]: spans, facets set up, and of those the bent ones.
    spans: u16,
    made: u16,
    bent: u16,
}

impl<P: Ink, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource> Row<'_, '_, P, S, ACTIVE, LIGHTS, L> {
    /// Shades spans that lie in the picture, and the background before each.
    #[inline(never)]
    fn see(&mut self, spans: &[Span], slots: &mut [Active; ACTIVE]) {
        self.spans += spans.len() as u16;
        for span in spans {
            let Range { start, end } = span.range();
            let look = span.look();
            if start >= end {
                self.skip();
                continue;
            }
            if self.from < start {
                self.fill(start);
            }
            self.from = end;
            if self.dressed.look != look {
                self.dress(look);
            }
            let dressed = &self.dressed;
            let slot = usize::from(span.slot());
            let (Some(active), Some(facet)) = (slots.get_mut(slot), self.facets.get_mut(slot)) else { continue };
            if !active.shaded {
                active.shaded = true;
                self.made += 1;
                self.bent += u16::from(set_up::<S, LIGHTS, L>(self.picture, active, &dressed.surface, facet));
            }
            let Some(pixels) = self.pixels.get_mut(start..end) else { continue };
            shade::<P, S, LIGHTS, L>(dressed, facet, start as i32, pixels);
        }
    }

    /// Does not count a span that is empty.
    #[cold]
    #[inline(never)]
    fn skip(&mut self) {
        self.spans -= 1;
    }

    /// Makes another material ready.
    #[cold]
    #[inline(never)]
    fn dress(&mut self, look: u16) {
        if let Some(dressed) = Dressed::new(self.picture, look, self.dressed.y) {
            self.dressed = dressed;
        }
    }

    /// Fills pixels up to there with the background.
    #[inline(always)]
    fn fill(&mut self, to: usize) {
        fill(self.pixels, self.from, to, self.background);
    }
}

/// A material made ready for a line.
struct Dressed<'p, P: Ink, const LIGHTS: usize> {
    /// Its number.
    look: u16,
    /// The line.
    y: i32,
    surface: Surface<'p, LIGHTS>,
    paint: P::Paint<'p>,
}

impl<'p, P: Ink, const LIGHTS: usize> Dressed<'p, P, LIGHTS> {
    #[inline(never)]
    fn new<L: LightSource>(picture: &Picture<'p, LIGHTS, L>, look: u16, y: i32) -> Option<Self> {
        let material = picture.geometry.material(look)?;
        let surface = Surface { material, intensities: picture.intensities };
        Some(Self { look, y, surface, paint: P::paint(material) })
    }
}

/// The background's colour on line y; none if pixels stay what they were.
fn background<const LIGHTS: usize, L: LightSource>(picture: &Picture<'_, LIGHTS, L>, y: u16) -> Option<Color> {
    match picture.background {
        Background::Plain(color) => Some(color),
        Background::Gradient { top, bottom } => Some(between(top, bottom, y, picture.geometry.height())),
        Background::Keep => None,
    }
}

/// Fills pixels with the background.
#[inline(never)]
fn fill<P: Ink>(row: &mut [P], from: usize, to: usize, background: Option<Color>) {
    let (Some(color), Some(pixels)) = (background, row.get_mut(from..to)) else { return };
    let pixel = P::plain(color);
    let mut eights = pixels.chunks_exact_mut(8);
    for eight in &mut eights {
        eight.fill(pixel);
    }
    eights.into_remainder().fill(pixel);
}

/// Shades one span.
#[inline(never)]
fn shade<P: Ink, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource>(
    dressed: &Dressed<'_, P, LIGHTS>,
    facet: &S::Facet,
    x: i32,
    pixels: &mut [P],
) {
    S::run(S::start(facet, x, dressed.y), &dressed.surface, pixels, &dressed.paint);
}

/// Sets up the facet of a triangle; whether its normals bend beyond what shading follows.
#[inline(never)]
fn set_up<S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource>(
    picture: &Picture<'_, LIGHTS, L>,
    active: &Active,
    surface: &Surface<'_, LIGHTS>,
    facet: &mut S::Facet,
) -> bool {
    let Some(triangle) = picture.triangle(active.id) else { return false };
    let corners;
    let triangle = if surface.material.double_sided && triangle.is_turned() {
        corners = triangle.turned();
        Triangle { corners: corners.each_ref(), turned: true, ..triangle }
    } else {
        triangle
    };
    let bent = is_bent(triangle.edges);
    *facet = S::facet(&triangle, surface);
    bent
}

/// Whether `u = 1 − |N|²` passes 63/64 in the middle of an edge (e/2) or at the centroid (2/9 of the sum), e being Q15.
const fn is_bent(edges: &[u16; 3]) -> bool {
    const MOST: u32 = (1 << 15) * 63 / 64;
    let [e01, e12, e20] = *edges;
    let [e01, e12, e20] = [e01 as u32, e12 as u32, e20 as u32];
    // Below one, all of them pass neither.
    (e01 | e12 | e20) >= 1 << 15 && (e01 > 2 * MOST || e12 > 2 * MOST || e20 > 2 * MOST || 2 * (e01 + e12 + e20) > 9 * MOST)
}

/// The colour of a gradient on line y.
fn between(top: Color, bottom: Color, y: u16, height: u16) -> Color {
    let steps = u32::from(height.saturating_sub(1)).max(1);
    let (y, rest) = (u32::from(y), steps - u32::from(y).min(steps));
    let mut color = top;
    for (to, from) in color.0.iter_mut().zip(bottom.0) {
        *to = ((u32::from(*to) * rest + u32::from(from) * y + steps / 2).checked_div(steps).unwrap_or(0)) as u16;
    }
    color
}
