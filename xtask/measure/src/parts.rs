//! A shading method whose three parts are marked apart, to be counted one by one.

use core::marker::PhantomData;

use beamshade::{model::light::LightSource, scan::triangle::Triangle, shade::Surface, Paint, Shade};

use crate::mark;

/// The method `S`, with a mark before and after each set-up of a facet, each start and each run of a span.
#[derive(Debug, Clone, Copy)]
pub struct Parts<S>(PhantomData<S>);

impl<S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource> Shade<LIGHTS, L> for Parts<S> {
    type Facet = S::Facet;
    type Registers = S::Registers;
    const EMPTY: S::Facet = S::EMPTY;

    #[inline(never)]
    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> S::Facet {
        mark::facet();
        let facet = S::facet(triangle, surface);
        mark::pause();
        facet
    }

    #[inline(never)]
    fn start(facet: &S::Facet, x: i32, y: i32) -> S::Registers {
        mark::start();
        let registers = S::start(facet, x, y);
        mark::pause();
        registers
    }

    #[inline(never)]
    fn run<P>(registers: S::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        mark::run(pixels.len());
        S::run(registers, surface, pixels, paint);
        mark::pause();
    }
}
