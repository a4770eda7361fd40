//! Intensities at the corners, linear in between.

use super::{lit, Intensity, Paint, Shade, Surface};
use crate::{math::gradient::Gradient, scan::picture::Triangle};

/// Gouraud shading: the illumination at the corners, interpolated over the screen; diffuse and specular apart, so that they
/// saturate after adding.
///
/// Course notes (ENDS 489), "Gouraud shading", with incremental steps. A highlight inside a facet is missed.
#[derive(Clone, Copy, Debug)]
pub struct Gouraud;

/// A Gouraud facet, 28 bytes: diffuse and specular at the anchor, and their increase to the right and down, Q24.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    anchor: [i16; 2],
    planes: [[i32; 3]; 2],
}

/// Diffuse and specular, each with its step to the right, Q24.
#[derive(Clone, Copy, Debug)]
pub struct Registers {
    diffuse: i32,
    diffuse_step: i32,
    specular: i32,
    specular_step: i32,
}

impl<const LIGHTS: usize> Shade<LIGHTS> for Gouraud {
    type Facet = Facet;
    type Registers = Registers;
    const EMPTY: Facet = Facet { anchor: [0; 2], planes: [[0; 3]; 2] };

    fn facet(triangle: &Triangle<'_, LIGHTS>, surface: &Surface<'_, LIGHTS>) -> Facet {
        let points = triangle.points();
        let [c0, c1, c2] = triangle.corners.map(|corner| at_corner(&corner.dots, surface));
        let gradient = Gradient::new(points);
        let plane = |which: fn(Intensity) -> u32| {
            let [v0, v1, v2] = [c0, c1, c2].map(|intensity| which(intensity) as i32);
            match &gradient {
                Some(gradient) => gradient.linear(v0, v1 - v0, v2 - v0, 10),
                None => [((v0 + v1 + v2) << 10) / 3, 0, 0],
            }
        };
        let [p0, ..] = points;
        Facet { anchor: Gradient::anchor(p0), planes: [plane(|c| c.diffuse), plane(|c| c.specular)] }
    }

    #[inline]
    fn start(facet: &Facet, x: i32, y: i32) -> Registers {
        let [ax, ay] = facet.anchor.map(i32::from);
        let [[d, dx, dy], [s, sx, sy]] = facet.planes;
        let at = |v: i32, vx: i32, vy: i32| v.wrapping_add(vx.wrapping_mul(x - ax)).wrapping_add(vy.wrapping_mul(y - ay));
        Registers { diffuse: at(d, dx, dy), diffuse_step: dx, specular: at(s, sx, sy), specular_step: sx }
    }

    #[inline]
    fn run<P>(mut r: Registers, _: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        for pixel in pixels {
            // A clamp at the top is not needed: the corners are below it, and rounding cannot pass them by a whole step.
            *pixel = paint.mix(Intensity { diffuse: lit(r.diffuse) >> 2, specular: lit(r.specular) >> 2 });
            r.diffuse = r.diffuse.wrapping_add(r.diffuse_step);
            r.specular = r.specular.wrapping_add(r.specular_step);
        }
    }
}

/// The illumination at a corner.
pub(super) fn at_corner<const LIGHTS: usize>(dots: &[[i16; 2]; LIGHTS], surface: &Surface<'_, LIGHTS>) -> Intensity {
    let mut sum = Intensity::default();
    for ([diffuse, specular], strength) in dots.iter().zip(surface.intensities) {
        sum.diffuse += i32::from(*diffuse).max(0) as u32;
        let cosine = (i32::from(*specular).max(0) as u32) << 17;
        sum.specular += (surface.material.power.at(cosine) * u32::from(*strength)) >> 15;
    }
    sum.limited(LIGHTS)
}
