//! Two methods in one scene.

use core::marker::PhantomData;

use super::{duff_barycentric::DuffBarycentric, gouraud::Gouraud, Paint, Shade, Surface};
use crate::{
    model::{
        highlight::Bent,
        light::{Light, LightSource},
    },
    scan::triangle::Triangle,
};

/// Which of two methods shades a triangle.
pub trait Rule<const LIGHTS: usize, L: LightSource = Light> {
    /// Rungs of a [ladder](crate::ladder) from the first method down to the second.
    const RUNGS: usize = 0;

    /// Whether it is the second.
    fn second(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> bool;
}

/// The rule that leaves it to the material: the second method for those [marked plain](crate::Material::plain).
#[derive(Clone, Copy, Debug)]
pub struct ByMaterial;

impl<const LIGHTS: usize, L: LightSource> Rule<LIGHTS, L> for ByMaterial {
    fn second(_: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> bool {
        surface.material.plain
    }
}

/// The rule that leaves it to the place of highlights: the first method for triangles [near](crate::model::highlight::is_near)
/// the centre of one, the second for all others. [`GouraudPhong`] is made by it.
///
/// *Adaptive Shading*, §3.3, with the neighbours of §4: without these, highlights that reach beyond the triangle of their
/// centre are cut off at its edges, which on the standard scene costs 3.6 of 36.3 dB. Where the methods meet, intensity is
/// not continuous; a highlight wider than a triangle and its neighbours ends there.
#[derive(Clone, Copy, Debug)]
pub struct ByHighlight;

impl<const LIGHTS: usize, L: LightSource> Rule<LIGHTS, L> for ByHighlight {
    fn second(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> bool {
        let bent = Bent { positions: if L::IN_SCENE { triangle.positions() } else { [[0; 3]; 3] }, normals: triangle.normals() };
        surface.material.specular == 0 || !bent.is_near(triangle.aims)
    }
}

/// The rule of a [ladder](crate::ladder): the second method from that rung on.
#[derive(Clone, Copy, Debug)]
pub struct ByRung<const RUNG: u8>;

impl<const RUNG: u8, const LIGHTS: usize, L: LightSource> Rule<LIGHTS, L> for ByRung<RUNG> {
    const RUNGS: usize = 1;

    fn second(triangle: &Triangle<'_, LIGHTS, L>, _: &Surface<'_, LIGHTS>) -> bool {
        triangle.rung >= RUNG
    }
}

/// Shades each triangle by `A` or by `B`, as the rule `R` says; may be nested. Only the methods named are linked.
#[derive(Clone, Copy, Debug)]
pub struct Choose<A, B, R = ByMaterial>(PhantomData<(A, B, R)>);

/// Gouraud shading, and per-pixel shading near highlights.
pub type GouraudPhong = Choose<DuffBarycentric, Gouraud, ByHighlight>;

/// One of two.
#[derive(Clone, Copy, Debug)]
pub enum Either<A, B> {
    /// The first method's.
    First(A),
    /// The second method's.
    Second(B),
}

impl<const LIGHTS: usize, L: LightSource, A: Shade<LIGHTS, L>, B: Shade<LIGHTS, L>, R: Rule<LIGHTS, L>> Shade<LIGHTS, L>
    for Choose<A, B, R>
{
    type Facet = Either<A::Facet, B::Facet>;
    type Registers = Either<A::Registers, B::Registers>;
    const BY_RUNG: bool = R::RUNGS > 0 || A::BY_RUNG || B::BY_RUNG;
    const EMPTY: Self::Facet = Either::First(A::EMPTY);

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet {
        if R::second(triangle, surface) {
            Either::Second(B::facet(triangle, surface))
        } else {
            Either::First(A::facet(triangle, surface))
        }
    }

    #[inline]
    fn start(facet: &Self::Facet, x: i32, y: i32) -> Self::Registers {
        match facet {
            Either::First(facet) => Either::First(A::start(facet, x, y)),
            Either::Second(facet) => Either::Second(B::start(facet, x, y)),
        }
    }

    /// The kind that the method of the span says.
    fn kind(registers: &Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: usize, least: u32) -> usize {
        match registers {
            Either::First(registers) => A::kind(registers, surface, pixels, least),
            Either::Second(registers) => B::kind(registers, surface, pixels, least),
        }
    }

    fn rung(registers: &Self::Registers) -> usize {
        match registers {
            Either::First(registers) => A::rung(registers),
            Either::Second(registers) => R::RUNGS + B::rung(registers),
        }
    }

    #[inline]
    fn run<P>(registers: Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        match registers {
            Either::First(registers) => A::run(registers, surface, pixels, paint),
            Either::Second(registers) => B::run(registers, surface, pixels, paint),
        }
    }
}
