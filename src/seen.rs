//! What is seen on a line, gathered to be looked at together.

use core::ops::Range;

use heapless::Vec;

use crate::{
    model::{
        light::LightSource,
        material::{Color, Material},
    },
    scan::{picture::Picture, table::Span, visibility::Visibility},
    scanner::{Line, Lines},
    shade::Shade,
    sink::ink::Ink,
    walk::{shade, Dressed, Take},
};

/// The spans of a line from a pixel on, on their way to be looked at together.
struct Gathering<'a, const ACTIVE: usize> {
    spans: &'a mut Vec<Span, ACTIVE>,
    from: usize,
    /// The first pixel of which nothing is gathered.
    until: usize,
}

impl<'m, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource> Take<'m, S, LIGHTS, L>
    for Gathering<'_, ACTIVE>
{
    const APART: bool = true;

    fn dress(&mut self, _: &'m Material) {}

    fn span(&mut self, span: Span, _: &S::Facet, _: u16) {
        let Range { start, end } = span.range();
        if end > self.from && self.spans.push(span).is_err() {
            self.until = self.until.min(start);
        }
    }
}

impl<'s, 'm, const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource, V: Visibility>
    Lines<'s, 'm, ACTIVE, S, LIGHTS, L, V>
{
    /// Gathers the spans of line y, on which the list stands, that show some of these pixels, left to right, with their facets set
    /// up; as many as there is room for. Returns the first pixel of which nothing was gathered, too.
    #[inline(never)]
    pub(crate) fn gather(&mut self, y: u16, pixels: Range<usize>, spans: &mut Vec<Span, ACTIVE>) -> (Line, usize) {
        let Range { start: from, end: until } = pixels;
        spans.clear();
        let Some(material) = self.first_material() else { return (self.none(), until) };
        let (line, Gathering { until, .. }) = self.walk(y, until, material, Gathering { spans, from, until });
        (line, until)
    }

    /// What was gathered of line y, to be shaded.
    pub(crate) fn seen(&self, y: u16) -> Seen<'_, 's, 'm, S, ACTIVE, LIGHTS, L> {
        Seen { picture: self.picture(), facets: self.facets(), y: y.into(), background: self.background(y) }
    }
}

/// What is seen on a line.
pub(crate) struct Seen<'a, 'f, 'm, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource> {
    picture: &'a Picture<'f, 'm, LIGHTS, L>,
    facets: &'a [[S::Facet; 2]; ACTIVE],
    y: i32,
    pub(crate) background: Option<Color>,
}

impl<'m, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource> Seen<'_, '_, 'm, S, ACTIVE, LIGHTS, L> {
    /// What a span, or the background, is like at those pixels, in it or beside it.
    #[inline(never)]
    pub(crate) fn colors(&self, span: Option<&Span>, x: usize, colors: &mut [Color]) {
        if let Some(span) = span {
            self.shade(span, x, colors);
        } else if let Some(background) = self.background {
            colors.fill(background);
        }
    }

    /// Shades pixels of a span, in it or beside it.
    pub(crate) fn shade<P: Ink>(&self, span: &Span, x: usize, pixels: &mut [P]) {
        if let Some(dressed) = self.dressed(span) {
            self.shade_as(&dressed, span, x, pixels);
        }
    }

    /// The same with its material made ready.
    pub(crate) fn shade_as<P: Ink>(&self, dressed: &Dressed<'_, 'm, P, LIGHTS>, span: &Span, x: usize, pixels: &mut [P]) {
        let facets = self.facets.get(usize::from(span.slot()));
        if let Some(facet) = facets.and_then(|facets| facets.get(span.half())) {
            shade::<P, S, LIGHTS, L>(dressed, facet, x as i32, pixels);
        }
    }

    /// The material that a span shows, made ready.
    pub(crate) fn dressed<P: Ink>(&self, span: &Span) -> Option<Dressed<'_, 'm, P, LIGHTS>> {
        Some(Dressed::new(self.y, self.material(span)?, self.picture.intensities))
    }

    /// The material that a span shows.
    pub(crate) fn material(&self, span: &Span) -> Option<&'m Material> {
        self.picture.geometry.material(span.look())
    }
}
