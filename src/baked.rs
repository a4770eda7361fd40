//! One line's span table, ready to be shaded anywhere.

use core::ops::Range;

use heapless::Vec;

use crate::{
    model::{
        light::{Light, LightSource},
        material::{Color, Material},
    },
    price::{cycles, Price},
    scan::{table::Span, visibility::Visibility},
    scanner::{Line, Lines},
    shade::{duff_barycentric::DuffBarycentric, Shade, Surface},
    sink::{
        ink::{Ink, LEAST},
        row::Row,
    },
    walk::Take,
    work::Work,
};

/// Up to `SPANS` spans of one line, each with the registers that shading starts from.
///
/// It borrows nothing but meshes, `'m`: neither the frame, in which the next picture may be made meanwhile, nor the scanner.
/// As `&'static mut` it moves through a [`heapless::spsc`] queue to the other core or to an interrupt; a ring of several lets dear
/// lines borrow time from cheap ones. Takes 8 bytes and the registers for each span: about 40 with the default method and one
/// light.
#[derive(Clone, Debug)]
pub struct Baked<'m, const SPANS: usize, S: Shade<LIGHTS, L> = DuffBarycentric, const LIGHTS: usize = 1, L: LightSource = Light> {
    spans: Vec<Prepared<'m, S::Registers>, SPANS>,
    y: u16,
    width: u16,
    background: Option<Color>,
    intensities: [u16; LIGHTS],
    counts: Line,
}

#[derive(Clone, Copy, Debug)]
struct Prepared<'m, R> {
    start: u16,
    end: u16,
    material: &'m Material,
    registers: R,
}

impl<const SPANS: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource> Baked<'_, SPANS, S, LIGHTS, L> {
    /// An empty line of no pixels.
    #[must_use]
    pub const fn new() -> Self {
        Self { spans: Vec::new(), y: 0, width: 0, background: None, intensities: [0; LIGHTS], counts: Line::NONE }
    }

    /// The line that was baked into it.
    #[must_use]
    pub const fn y(&self) -> u16 {
        self.y
    }

    /// What that line is made of.
    #[must_use]
    pub const fn counts(&self) -> Line {
        self.counts
    }

    /// What [`shade`](Self::shade) has to do.
    #[must_use]
    pub fn work(&self) -> Work {
        let spans = self.spans.iter().map(|span| (span.start..span.end, span.material, span.registers));
        to_shade::<S, LIGHTS, L>(self.width, &self.intensities, spans)
    }

    /// What [`shade`](Self::shade) takes at most.
    #[must_use]
    pub fn cost(&self, price: &Price) -> u32 {
        price.of(self.work())
    }

    /// The same with a [ladder](crate::ladder) of methods, given the price list of each.
    #[must_use]
    pub fn cost_on(&self, prices: &[Price]) -> u32 {
        let on = |rung| self.spans.iter().filter(move |span| S::rung(&span.registers) == rung);
        let work = |rung| {
            let spans = on(rung).map(|span| (span.start..span.end, span.material, span.registers));
            to_shade::<S, LIGHTS, L>(self.width, &self.intensities, spans)
        };
        sum_of_rungs(prices, self.work(), work)
    }

    /// Shades the line into the row, as [`Lines::line`] does: every pixel stored once, from left to right.
    pub fn shade<P: Ink>(&self, row: &mut [P]) {
        let width = usize::from(self.width).min(row.len());
        let mut row = Row::new(row.get_mut(..width).unwrap_or_default(), self.background);
        let mut dressed = None;
        for span in &self.spans {
            let end = usize::from(span.end).min(width);
            let start = usize::from(span.start).min(end);
            let paint = match &dressed {
                Some((material, paint)) if core::ptr::eq::<Material>(*material, span.material) => paint,
                _ => &dressed.insert((span.material, P::paint(span.material))).1,
            };
            let surface = Surface { material: span.material, intensities: &self.intensities };
            if let Some(pixels) = row.span(start, end) {
                S::run(span.registers, &surface, pixels, paint);
            }
        }
        row.finish();
    }
}

impl<const SPANS: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource> Default for Baked<'_, SPANS, S, LIGHTS, L> {
    fn default() -> Self {
        Self::new()
    }
}

impl<'m, const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource, V: Visibility>
    Lines<'_, 'm, ACTIVE, S, LIGHTS, L, V>
{
    /// Bakes line y: all but the shading of [`line`](Lines::line), which [`Baked::shade`] does later. A y below the picture makes
    /// an empty line of no pixels. It knows no transparency: [transparent](Material::opacity) triangles are opaque in it.
    #[inline(never)]
    pub fn bake<const SPANS: usize>(&mut self, y: u16, table: &mut Baked<'m, SPANS, S, LIGHTS, L>) -> Line {
        table.spans.clear();
        table.y = y;
        let is_there = self.seek(y);
        table.width = if is_there { self.width() as u16 } else { 0 };
        table.background = self.background(y);
        table.intensities = *self.picture().intensities;
        table.counts = match self.first_material() {
            Some(material) if is_there => {
                let baking = Baking { spans: &mut table.spans, material, y: y.into(), left_out: 0 };
                let (line, Baking { left_out, .. }) = self.walk(y, self.width(), material, baking);
                Line { spans: line.spans - left_out, left_out, ..line }
            }
            _ => self.none(),
        };
        table.counts
    }
}

/// What shading the spans of a line has to do, in a picture of that width, each given with its material and registers.
pub(crate) fn to_shade<'m, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource>(
    width: u16,
    intensities: &[u16; LIGHTS],
    spans: impl Iterator<Item = (Range<u16>, &'m Material, S::Registers)>,
) -> Work {
    let mut work = Work { lines: 1, ..Work::NONE };
    let (mut from, mut dressed, mut pixels) = (0, None, [0; 4]);
    for (Range { start, end }, material, registers) in spans {
        if !dressed.is_some_and(|before| core::ptr::eq::<Material>(before, material)) {
            work.dressed += 1;
            dressed = Some(material);
        }
        let count = end.saturating_sub(start);
        let kind = S::kind(&registers, &Surface { material, intensities }, count.into(), LEAST);
        if let Some(pixels) = pixels.get_mut(kind) {
            *pixels += u32::from(count);
        }
        work.runs += 1;
        work.gaps += u32::from(start > from);
        work.filled += u32::from(start.saturating_sub(from));
        from = end;
    }
    work.gaps += u32::from(width > from);
    work.filled += u32::from(width.saturating_sub(from));
    [work.pixels, work.pixels_1, work.pixels_2, work.pixels_3] = pixels;
    work
}

/// What a line takes, given all its work and that on each rung: what no method has a price of its own for at the dearest price.
pub(crate) fn sum_of_rungs(prices: &[Price], all: Work, on: impl Fn(usize) -> Work) -> u32 {
    let [_, rest] = all.by_method();
    let own = prices.iter().enumerate().map(|(rung, price)| {
        let [own, _] = on(rung).by_method();
        price.sixteenths(own)
    });
    cycles(own.chain([Price::dearest(prices).sixteenths(rest)]))
}

/// Spans on their way into a table.
struct Baking<'t, 'm, R, const SPANS: usize> {
    spans: &'t mut Vec<Prepared<'m, R>, SPANS>,
    material: &'m Material,
    y: i32,
    left_out: u16,
}

impl<'m, S: Shade<LIGHTS, L>, const SPANS: usize, const LIGHTS: usize, L: LightSource> Take<'m, S, LIGHTS, L>
    for Baking<'_, 'm, S::Registers, SPANS>
{
    fn dress(&mut self, material: &'m Material) {
        self.material = material;
    }

    fn span(&mut self, span: Span, facet: &S::Facet, _: u16) {
        let Range { start, end } = span.range();
        let registers = S::start(facet, start as i32, self.y);
        let span = Prepared { start: start as u16, end: end as u16, material: self.material, registers };
        self.left_out += u16::from(self.spans.push(span).is_err());
    }
}
