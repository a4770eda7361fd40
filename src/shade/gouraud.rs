//! Intensities at the corners, linear in between.

use super::{lit, Intensity, Paint, Shade, Surface};
use crate::{
    math::{
        gradient::Gradient,
        interpolant::{Interpolant, Plane, Slope, Steps},
    },
    model::light::LightSource,
    scan::triangle::Triangle,
};

/// Gouraud shading: the illumination at the corners, interpolated over the screen; diffuse and specular apart, so that they
/// saturate after adding.
///
/// Course notes (ENDS 489), "Gouraud shading", with incremental steps. A highlight inside a facet is missed.
#[derive(Clone, Copy, Debug)]
pub struct Gouraud;

/// A Gouraud facet, 24 bytes: diffuse and specular at pixel (0, 0), and their increase to the right and down, Q24.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    planes: [Plane; 2],
}

impl<const LIGHTS: usize, L: LightSource> Shade<LIGHTS, L> for Gouraud {
    type Facet = Facet;
    /// Diffuse and specular, Q24.
    type Registers = [Slope; 2];
    const EMPTY: Facet = Facet { planes: [Plane::ZERO; 2] };

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Facet {
        let [c0, c1, c2] = triangle.corners.map(|corner| at_corner(&corner.dots, surface));
        let gradient = Gradient::new(triangle.points());
        let plane = |which: fn(Intensity) -> u32| {
            Plane::through(gradient.as_ref(), [c0, c1, c2].map(|intensity| which(intensity) as i32), [0; 3])
        };
        Facet { planes: [plane(|c| c.diffuse), plane(|c| c.specular)] }
    }

    #[inline]
    fn start(facet: &Facet, x: i32, y: i32) -> [Slope; 2] {
        facet.planes.map(|plane| plane.along(x, y))
    }

    #[inline]
    fn run<P>([mut diffuse, mut specular]: [Slope; 2], _: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        let lit = |value| lit(value, Plane::FINER) >> 2;
        for pixel in pixels {
            // A clamp at the top is not needed: the corners are below it, and rounding cannot pass them by a whole step.
            *pixel = paint.mix(Intensity { diffuse: lit(diffuse.next()), specular: lit(specular.next()) });
        }
    }
}

/// The illumination at a corner.
pub(crate) fn at_corner<const LIGHTS: usize>(dots: &[[i16; 2]; LIGHTS], surface: &Surface<'_, LIGHTS>) -> Intensity {
    let mut sum = Intensity::default();
    for ([diffuse, specular], strength) in dots.iter().zip(surface.intensities) {
        sum.diffuse += i32::from(*diffuse).max(0) as u32;
        let cosine = (i32::from(*specular).max(0) as u32) << 17;
        sum.specular += (surface.material.power.at(cosine) * u32::from(*strength)) >> 15;
    }
    sum.limited(LIGHTS)
}
