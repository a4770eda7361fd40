//! Duff's optimisation, without forward differences.

use super::{
    duff_differences::{cosine, Facet},
    phong::joint,
    Intensity, Paint, Shade, Surface,
};
use crate::{
    math::{
        interpolant::{Interpolant, Steps},
        root::inverse_root,
    },
    model::light::{Change, LightSource},
    scan::triangle::Triangle,
};

/// Phong shading by Duff's optimisation, its terms evaluated anew at each pixel.
///
/// *Faster Phong Shading* (CS-R9228), §2.1, Eq. 2b and 2c, and method 3 of Table 2. What stays the same along a line is
/// evaluated once for it: a pixel costs a product for a linear term (which compilers turn into an addition), two for a quadratic
/// one. The same pixels, from the same facets, as by [`DuffDifferences`](super::duff_differences::DuffDifferences), whose docs say
/// how these are made, how exact they are and where they end.
#[derive(Clone, Copy, Debug)]
pub struct DuffDirect;

/// A facet, and a pixel.
#[derive(Clone, Copy, Debug)]
pub struct Registers<const LIGHTS: usize, L: LightSource> {
    facet: Facet<LIGHTS, L>,
    x: i32,
    y: i32,
}

impl<const LIGHTS: usize, L: LightSource> Shade<LIGHTS, L> for DuffDirect {
    type Facet = Facet<LIGHTS, L>;
    type Registers = Registers<LIGHTS, L>;
    const EMPTY: Self::Facet = Facet::EMPTY;

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet {
        Facet::new(triangle, surface)
    }

    #[inline]
    fn start(facet: &Self::Facet, x: i32, y: i32) -> Self::Registers {
        Registers { facet: *facet, x, y }
    }

    #[inline]
    fn run<P>(r: Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        let Registers { facet: Facet { products, bend, bends, .. }, x, y } = r;
        let power = &surface.material.power;
        // Terms of y alone move out of the loops.
        match bends.get() {
            None => {
                for (pixel, x) in pixels.iter_mut().zip(x..) {
                    let root = inverse_root(bend.along(x, y).value);
                    let mut intensity = Intensity::default();
                    for ([diffuse, specular], strength) in products.iter().zip(surface.intensities) {
                        intensity.diffuse += cosine::<L>(diffuse.along(x, y).next(), root) >> 17;
                        intensity.specular +=
                            (power.at(cosine::<L>(specular.along(x, y).next(), root)) * u32::from(*strength)) >> 15;
                    }
                    *pixel = paint.mix(intensity.limited(LIGHTS));
                }
            }
            Some(bends) => {
                for (pixel, x) in pixels.iter_mut().zip(x..) {
                    let bend = bend.along(x, y).value;
                    let mut intensity = Intensity::default();
                    for (([diffuse, specular], rays), strength) in products.iter().zip(bends).zip(surface.intensities) {
                        let [light, half] = rays.each_ref().map(|one| inverse_root(joint(bend, one.along(x, y).value)));
                        intensity.diffuse += cosine::<L>(diffuse.along(x, y).next(), light) >> 17;
                        intensity.specular +=
                            (power.at(cosine::<L>(specular.along(x, y).next(), half)) * u32::from(*strength)) >> 15;
                    }
                    *pixel = paint.mix(intensity.limited(LIGHTS));
                }
            }
        }
    }
}
