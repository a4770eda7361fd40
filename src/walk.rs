//! From the visible spans of a line to whoever takes them, with their facets: pixels first of all.

use core::ops::Range;

use crate::{
    ladder::Degraded,
    model::{light::LightSource, material::Material},
    scan::{
        active::{Active, Sharing},
        bucket::TriangleId,
        picture::Picture,
        table::Span,
        triangle::Triangle,
    },
    shade::{Shade, Surface},
    sink::{ink::Ink, row::Row},
    work::{Tally, Work},
};

/// Who takes the visible spans of a line, from left to right: a row of pixels, a baked line, a frozen picture.
pub(crate) trait Take<'m, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource> {
    /// Whether the triangles of a pair come as spans apart, even if one facet is for both.
    const APART: bool = false;

    /// Spans have another material from here on.
    fn dress(&mut self, material: &'m Material);

    /// Keeps a facet that was just set up, if it has to; returns its number, from 1 on.
    #[inline(always)]
    fn keep(&mut self, _facet: &S::Facet, _id: TriangleId) -> u16 {
        1
    }

    /// A span, which is not empty, of a triangle with that facet, of that number.
    fn span(&mut self, span: Span, facet: &S::Facet, number: u16);
}

/// Spans on their way to whoever takes them.
pub(crate) struct Walk<'a, 'f, 'm, T, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource> {
    picture: &'a Picture<'f, 'm, LIGHTS, L>,
    facets: &'a mut [[S::Facet; 2]; ACTIVE],
    pub(crate) to: T,
    /// The material, and its number.
    look: u16,
    material: &'m Material,
    /// Counts of [`Line`](crate::scanner::Line): spans, facets set up, and of those the bent ones.
    pub(crate) spans: u16,
    pub(crate) made: u16,
    pub(crate) bent: u16,
    degraded: &'a mut Degraded,
    pub(crate) tally: Tally,
}

impl<'a, 'f, 'm, T: Take<'m, S, LIGHTS, L>, S: Shade<LIGHTS, L>, const ACTIVE: usize, const LIGHTS: usize, L: LightSource>
    Walk<'a, 'f, 'm, T, S, ACTIVE, LIGHTS, L>
{
    /// At the start of a line, with the material of that number ready.
    #[inline(always)]
    pub(crate) fn new(
        picture: &'a Picture<'f, 'm, LIGHTS, L>,
        facets: &'a mut [[S::Facet; 2]; ACTIVE],
        degraded: &'a mut Degraded,
        look: u16,
        material: &'m Material,
        to: T,
    ) -> Self {
        Self { picture, facets, to, look, material, spans: 0, made: 0, bent: 0, degraded, tally: Tally::NONE }
    }

    /// Hands on spans that lie in the picture, each with its facet.
    #[inline(never)]
    pub(crate) fn see(&mut self, spans: &[Span], slots: &mut [Active; ACTIVE]) {
        self.spans += spans.len() as u16;
        for span in spans {
            // In pixels of the row, as whoever takes it asks for them: known to be in order, they are not compared again.
            if span.range().is_empty() {
                self.skip();
                continue;
            }
            if self.look != span.look() {
                self.dress(span.look());
            }
            let slot = usize::from(span.slot());
            let Some(active) = slots.get_mut(slot) else { break };
            // Most that are shared are known to be.
            let is_shared = S::BY_PAIR
                && (active.sharing == Sharing::Shared || active.sharing == Sharing::Unknown && self.share(slot, active));
            let Range { start, end } = span.range();
            let middle = usize::from(active.middle().max(0) as u16);
            if !T::APART && is_shared || middle >= end {
                self.show::<0>(*span, slot, active);
                continue;
            }
            let mut from = start;
            if middle > start {
                self.spans += 1;
                self.show::<0>(span.with(start as i32, middle as i32), slot, active);
                from = middle;
            }
            self.show::<1>(span.with(from as i32, end as i32).right(), slot, active);
        }
    }

    /// Sets up one facet for both triangles of a pair, if that is enough; whether it is.
    #[inline(never)]
    fn share(&mut self, slot: usize, active: &mut Active) -> bool {
        active.sharing = Sharing::Apart;
        let mut room = None;
        let pair = active.pair().and_then(|first| self.picture.pair(first, &mut room));
        let surface = Surface { material: self.material, intensities: self.picture.intensities };
        let (Some(pair), Some([facet, other])) = (pair, self.facets.get_mut(slot)) else { return false };
        if !S::pair(&pair, &surface, facet) {
            return false;
        }
        active.sharing = Sharing::Shared;
        if T::APART {
            *other = *facet;
        }
        self.made += 1;
        active.facets = active.ids().map(|id| self.to.keep(facet, id));
        true
    }

    /// Hands on a span of one triangle, or of a pair that shares a facet, in that slot.
    #[inline(always)]
    fn show<const HALF: usize>(&mut self, span: Span, slot: usize, active: &mut Active) {
        let [_, near] = active.reach();
        let facets = self.facets.get_mut(slot);
        let Some(facet) = facets.and_then(|facets| facets.get_mut(HALF)) else { return };
        let Some(mut number) = active.facets.get(HALF).copied() else { return };
        if number == 0 {
            let id = active.id(HALF);
            let surface = Surface { material: self.material, intensities: self.picture.intensities };
            self.made += 1;
            let mut rung = 0;
            if S::BY_RUNG {
                let steps = self.picture.steps_of(id);
                self.tally.add(Work { asked: steps.len() as u32, ..Work::NONE });
                rung = self.picture.steps.rung(steps, near);
                self.degraded.count(rung);
            }
            self.bent += u16::from(set_up::<S, LIGHTS, L>(self.picture, id, rung, &surface, facet));
            number = self.to.keep(facet, id);
            if let Some(room) = active.facets.get_mut(HALF) {
                *room = number;
            }
        }
        self.to.span(span, facet, number);
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
        self.tally.add(Work { searched: 1, ..Work::NONE });
        if let Some(material) = self.picture.geometry.material(look) {
            (self.look, self.material) = (look, material);
            self.to.dress(material);
        }
    }
}

/// Spans shaded into a row at once.
pub(crate) struct Shading<'a, 'm, 'r, P: Ink, const LIGHTS: usize> {
    pub(crate) row: Row<'r, P>,
    pub(crate) dressed: Dressed<'a, 'm, P, LIGHTS>,
}

/// A material made ready for a line.
pub(crate) struct Dressed<'a, 'm, P: Ink, const LIGHTS: usize> {
    /// The line.
    y: i32,
    surface: Surface<'a, LIGHTS>,
    paint: P::Paint<'m>,
}

impl<'m: 'a, 'a, P: Ink, const LIGHTS: usize> Dressed<'a, 'm, P, LIGHTS> {
    #[inline(always)]
    pub(crate) fn new(y: i32, material: &'m Material, intensities: &'a [u16; LIGHTS]) -> Self {
        Self { y, surface: Surface { material, intensities }, paint: P::paint(material) }
    }
}

impl<'m: 'a, 'a, P: Ink, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource> Take<'m, S, LIGHTS, L>
    for Shading<'a, 'm, '_, P, LIGHTS>
{
    #[inline(always)]
    fn dress(&mut self, material: &'m Material) {
        self.dressed.surface.material = material;
        self.dressed.paint = P::paint(material);
    }

    #[inline(always)]
    fn span(&mut self, span: Span, facet: &S::Facet, _: u16) {
        let Range { start, end } = span.range();
        if let Some(pixels) = self.row.span(start, end) {
            shade::<P, S, LIGHTS, L>(&self.dressed, facet, start as i32, pixels);
        }
    }
}

/// Shades one span.
#[inline(never)]
pub(crate) fn shade<P: Ink, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource>(
    dressed: &Dressed<'_, '_, P, LIGHTS>,
    facet: &S::Facet,
    x: i32,
    pixels: &mut [P],
) {
    S::run(S::start(facet, x, dressed.y), &dressed.surface, pixels, &dressed.paint);
}

/// Sets up the facet of a triangle; whether its normals bend beyond what shading follows.
#[inline(never)]
fn set_up<S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource>(
    picture: &Picture<'_, '_, LIGHTS, L>,
    id: TriangleId,
    rung: u8,
    surface: &Surface<'_, LIGHTS>,
    facet: &mut S::Facet,
) -> bool {
    let mut room = None;
    let Some(triangle) = picture.triangle(id, &mut room) else { return false };
    let corners;
    let triangle = Triangle { rung, ..triangle };
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
