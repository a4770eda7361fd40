//! One intensity for each facet.

use super::{Intensity, Paint, Shade, Surface};
use crate::{math::root::inverse_root, scan::picture::Triangle};

/// Flat shading: the illumination at the triangle's centroid, under the normalised mean of the corners' normals.
///
/// Course notes (ENDS 489), "Incremental Shading Techniques", first scheme; the mean normal stands for the face's.
#[derive(Clone, Copy, Debug)]
pub struct Flat;

impl<const LIGHTS: usize> Shade<LIGHTS> for Flat {
    type Facet = Intensity;
    type Registers = Intensity;
    const EMPTY: Intensity = Intensity { diffuse: 0, specular: 0 };

    fn facet(triangle: &Triangle<'_, LIGHTS>, surface: &Surface<'_, LIGHTS>) -> Intensity {
        let root = inverse_root(bend_at_centroid(triangle));
        let mut intensity = Intensity::default();
        for (light, strength) in surface.intensities.iter().enumerate() {
            // Q14 · 3, its third as Q16, times Q15: a cosine in Q31.
            let cosine = |which: fn([i16; 2]) -> i16| {
                let sum = dots(triangle, light, which);
                (((sum & !(sum >> 31)) as u32 * 4 + 1) / 3).saturating_mul(root)
            };
            intensity.diffuse += cosine(|[diffuse, _]| diffuse) >> 17;
            intensity.specular += (surface.material.power.at(cosine(|[_, specular]| specular)) * u32::from(*strength)) >> 15;
        }
        intensity.limited(LIGHTS)
    }

    fn start(facet: &Intensity, _: i32, _: i32) -> Intensity {
        *facet
    }

    #[inline]
    fn run<P>(intensity: Intensity, _: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        for pixel in pixels {
            *pixel = paint.mix(intensity);
        }
    }
}

/// Sum over the corners of one of a light's products, Q14.
fn dots<const LIGHTS: usize>(triangle: &Triangle<'_, LIGHTS>, light: usize, which: fn([i16; 2]) -> i16) -> i32 {
    triangle.corners.iter().map(|corner| corner.dots.get(light).map_or(0, |dots| i32::from(which(*dots)))).sum()
}

/// `u = 1 − |N|²` at the centroid, Q28: 2/9 of the sum of the edge constants.
pub(super) fn bend_at_centroid<const LIGHTS: usize>(triangle: &Triangle<'_, LIGHTS>) -> i32 {
    let sum: u32 = triangle.edges.iter().map(|e| u32::from(*e)).sum();
    ((sum << 14) / 9) as i32
}
