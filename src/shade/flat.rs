//! One intensity for each facet.

use super::{Intensity, Paint, Shade, Surface};
use crate::{math::root::inverse_root, model::light::LightSource, scan::triangle::Triangle};

/// Flat shading: the illumination at the triangle's centroid, under the normalised mean of the corners' normals.
///
/// Course notes (ENDS 489), "Incremental Shading Techniques", first scheme; the mean normal stands for the face's.
#[derive(Clone, Copy, Debug)]
pub struct Flat;

impl<const LIGHTS: usize, L: LightSource> Shade<LIGHTS, L> for Flat {
    type Facet = Intensity;
    type Registers = Intensity;
    const EMPTY: Intensity = Intensity { diffuse: 0, specular: 0 };

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Intensity {
        let root = inverse_root(bend_at_centroid(triangle.edges));
        let mut intensity = Intensity::default();
        for ([diffuse, specular], strength) in triangle.centroid().iter().zip(surface.intensities) {
            // Q16 · Q15: a cosine in Q31.
            let cosine = |product: i16| (u32::from(product.max(0) as u16) << 2).saturating_mul(root);
            intensity.diffuse += cosine(*diffuse) >> 17;
            intensity.specular += (surface.material.power.at(cosine(*specular)) * u32::from(*strength)) >> 15;
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

/// `u = 1 − |N|²` at the centroid, Q28: 2/9 of the sum of the edge constants, to 4·10⁻⁵ of it.
pub(super) fn bend_at_centroid(edges: &[u16; 3]) -> i32 {
    let sum: u32 = edges.iter().map(|e| u32::from(*e)).sum();
    // 2¹⁴/9, without a division.
    ((sum * 14563) >> 3) as i32
}
