//! A whole picture's span tables and facets, frozen.

use core::ops::Range;

use heapless::Vec;

use crate::{
    baked::{sum_of_rungs, to_shade},
    model::{
        light::{Light, LightSource},
        material::{Color, Material},
    },
    price::Price,
    scan::{
        bucket::TriangleId,
        geometry::Source,
        picture::{Background, Picture},
        table::Span,
        visibility::Visibility,
    },
    scanner::{Line, Lines},
    shade::{duff_barycentric::DuffBarycentric, Shade, Surface},
    sink::{ink::Ink, row::Row},
    walk::Take,
    work::Work,
};

/// All spans of a picture and all its facets: what is left to do is to shade, line by line, in any order, as often as wanted.
///
/// It borrows nothing but meshes, `'m`: while it is shown, the next frame is made and scanned, and taken into another one. As
/// `&'static mut` they change places through [`heapless::spsc`] queues: a picture that is late leaves the last one on the screen,
/// never half of it. Takes 6 bytes a span, 2 a line, and a facet and 8 bytes for each visible triangle, and for both of a pair that
/// [shares](crate::Shade::pair) one; about 52 kB for 240 lines of a teapot of 880 triangles.
#[derive(Clone, Debug)]
pub struct Frozen<
    'm,
    const SPANS: usize,
    const FACETS: usize,
    const LINES: usize,
    S: Shade<LIGHTS, L> = DuffBarycentric,
    const LIGHTS: usize = 1,
    L: LightSource = Light,
> {
    spans: Vec<Piece, SPANS>,
    facets: Vec<Facet<'m, S::Facet>, FACETS>,
    /// For each line the number of spans on it and above.
    ends: Vec<u16, LINES>,
    /// The picture's width and height.
    size: [u16; 2],
    background: Background,
    intensities: [u16; LIGHTS],
}

#[derive(Clone, Copy, Debug)]
struct Piece {
    start: u16,
    end: u16,
    facet: u16,
}

#[derive(Clone, Copy, Debug)]
struct Facet<'m, F> {
    material: &'m Material,
    source: Source,
    facet: F,
}

impl<
        'm,
        const SPANS: usize,
        const FACETS: usize,
        const LINES: usize,
        S: Shade<LIGHTS, L>,
        const LIGHTS: usize,
        L: LightSource,
    > Frozen<'m, SPANS, FACETS, LINES, S, LIGHTS, L>
{
    /// A picture without lines; all zeros, so that a `static` takes no flash.
    #[must_use]
    pub const fn new() -> Self {
        Self {
            spans: Vec::new(),
            facets: Vec::new(),
            ends: Vec::new(),
            size: [0; 2],
            background: Background::Plain(Color::BLACK),
            intensities: [0; LIGHTS],
        }
    }

    /// Takes in a picture, from its first line to its last, or as many as there is room for. Returns the sums over its lines, of
    /// `active` the largest.
    pub fn take<const ACTIVE: usize, V: Visibility>(&mut self, mut lines: Lines<'_, 'm, ACTIVE, S, LIGHTS, L, V>) -> Line {
        // Facets that were set up before are not here.
        lines.rewind();
        let picture = *lines.picture();
        self.spans.clear();
        self.facets.clear();
        self.ends.clear();
        self.size = [lines.width() as u16, picture.geometry.height()];
        self.background = picture.background;
        self.intensities = *picture.intensities;
        let mut sums = Line::NONE;
        let Self { spans, facets, ends, .. } = self;
        for y in (0..picture.geometry.height()).take(LINES) {
            if !lines.seek(y) {
                break;
            }
            let mut line = lines.none();
            if let Some(material) = lines.first_material() {
                let freezing = Freezing { spans, facets, picture: &picture, material, left_out: 0 };
                let (seen, Freezing { left_out, .. }) = lines.walk(y, lines.width(), material, freezing);
                line = Line { spans: seen.spans - left_out, left_out, ..seen };
            }
            // There is room for all.
            let _ = ends.push(spans.len() as u16);
            sums = Line {
                active: sums.active.max(line.active),
                spans: sums.spans.saturating_add(line.spans),
                facets: sums.facets.saturating_add(line.facets),
                bent: sums.bent.saturating_add(line.bent),
                dropped: line.dropped,
                left_out: sums.left_out.saturating_add(line.left_out),
            };
        }
        sums
    }

    /// Number of lines that are there.
    #[must_use]
    pub fn lines(&self) -> u16 {
        self.ends.len() as u16
    }

    /// What [`line`](Self::line) has to do; nothing below the picture.
    #[must_use]
    pub fn work(&self, y: u16) -> Work {
        self.work_where(y, |_| true)
    }

    /// The same of the spans that are chosen by their registers.
    fn work_where(&self, y: u16, chosen: impl Fn(&S::Registers) -> bool) -> Work {
        let Some(spans) = self.spans(y) else { return Work::NONE };
        let [width, _] = self.size;
        let started = |span: &Piece| {
            let Facet { material, facet, .. } = self.facets.get(usize::from(span.facet))?;
            let registers = S::start(facet, span.start.into(), y.into());
            chosen(&registers).then_some((span.start..span.end, *material, registers))
        };
        let work = to_shade::<S, LIGHTS, L>(width, &self.intensities, spans.iter().filter_map(started));
        Work { gradients: self.background.is_gradient().into(), started: work.runs, ..work }
    }

    /// What [`line`](Self::line) takes at most with a [ladder](crate::ladder) of methods, given the price list of each.
    #[must_use]
    pub fn cost_on(&self, y: u16, prices: &[Price]) -> u32 {
        sum_of_rungs(prices, self.work(y), |rung| self.work_where(y, |registers| S::rung(registers) == rung))
    }

    /// What [`line`](Self::line) takes at most.
    #[must_use]
    pub fn cost(&self, y: u16, price: &Price) -> u32 {
        price.of(self.work(y))
    }

    /// What all its lines take at most, one by one, from the first to the last: for a [`Schedule`](crate::Schedule).
    pub fn costs<'a>(&'a self, price: &'a Price) -> impl Iterator<Item = u32> + Clone + 'a {
        (0..self.lines()).map(|y| self.cost(y, price))
    }

    /// Shades line y into the row, as [`Lines::line`] does: every pixel stored once, from left to right. A y below the picture
    /// leaves the row alone. It knows no transparency: [transparent](Material::opacity) triangles are opaque in it.
    pub fn line<P: Ink>(&self, y: u16, row: &mut [P]) {
        let Some(spans) = self.spans(y) else { return };
        let [width, height] = self.size;
        let width = usize::from(width).min(row.len());
        let mut row = Row::new(row.get_mut(..width).unwrap_or_default(), self.background.at(y, height));
        let mut dressed = None;
        for span in spans {
            let Some(Facet { material, facet, .. }) = self.facets.get(usize::from(span.facet)) else { continue };
            let end = usize::from(span.end).min(width);
            let start = usize::from(span.start).min(end);
            let paint = match &dressed {
                Some((before, paint)) if core::ptr::eq::<Material>(*before, *material) => paint,
                _ => &dressed.insert((*material, P::paint(material))).1,
            };
            let surface = Surface { material, intensities: &self.intensities };
            if let Some(pixels) = row.span(start, end) {
                S::run(S::start(facet, start as i32, y.into()), &surface, pixels, paint);
            }
        }
        row.finish();
    }

    /// What is seen at a pixel: the visible surface is the pick primitive, as *Faster Phong Shading* has it in its first section.
    #[must_use]
    pub fn pick(&self, x: u16, y: u16) -> Option<Source> {
        let span = self.spans(y)?.iter().find(|span| (span.start..span.end).contains(&x))?;
        self.facets.get(usize::from(span.facet)).map(|facet| facet.source)
    }

    /// The spans of a line.
    fn spans(&self, y: u16) -> Option<&[Piece]> {
        let y = usize::from(y);
        let end = usize::from(*self.ends.get(y)?);
        let start = y.checked_sub(1).and_then(|above| self.ends.get(above)).copied().unwrap_or(0);
        self.spans.get(usize::from(start)..end)
    }
}

impl<const SPANS: usize, const FACETS: usize, const LINES: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource>
    Default for Frozen<'_, SPANS, FACETS, LINES, S, LIGHTS, L>
{
    fn default() -> Self {
        Self::new()
    }
}

/// Spans and facets on their way into a frozen picture.
struct Freezing<'t, 'f, 'm, F, const SPANS: usize, const FACETS: usize, const LIGHTS: usize, L: LightSource> {
    spans: &'t mut Vec<Piece, SPANS>,
    facets: &'t mut Vec<Facet<'m, F>, FACETS>,
    picture: &'t Picture<'f, 'm, LIGHTS, L>,
    material: &'m Material,
    left_out: u16,
}

impl<'m, S: Shade<LIGHTS, L>, const SPANS: usize, const FACETS: usize, const LIGHTS: usize, L: LightSource> Take<'m, S, LIGHTS, L>
    for Freezing<'_, '_, 'm, S::Facet, SPANS, FACETS, LIGHTS, L>
{
    const APART: bool = true;

    fn dress(&mut self, material: &'m Material) {
        self.material = material;
    }

    fn keep(&mut self, facet: &S::Facet, id: TriangleId) -> u16 {
        let source = self.picture.geometry.source(id);
        let kept = source.map(|source| self.facets.push(Facet { material: self.material, source, facet: *facet }));
        match kept {
            Some(Ok(())) => self.facets.len() as u16,
            _ => NO_ROOM,
        }
    }

    fn span(&mut self, span: Span, _: &S::Facet, number: u16) {
        let Range { start, end } = span.range();
        let span = Piece { start: start as u16, end: end as u16, facet: number - 1 };
        let fits = number != NO_ROOM && self.spans.len() < usize::from(u16::MAX) && self.spans.push(span).is_ok();
        self.left_out += u16::from(!fits);
    }
}

/// The number of facets that had no room.
const NO_ROOM: u16 = u16::MAX;
