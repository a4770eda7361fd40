//! Phong shading with normals linear over the triangle.

use super::{
    phong::{self, far, Registers},
    Paint, Shade, Surface,
};
use crate::{
    math::{
        gradient::Gradient,
        interpolant::{Interpolant, Plane},
    },
    model::light::{Aim, Change, LightSource},
    scan::triangle::Triangle,
};

/// Phong shading of triangles, independent of their rotation on the screen: the normal is `N(x, y) = ax + by + c`.
///
/// *Faster Phong Shading* (CS-R9228), Eq. 2a, and method 2 of Table 2, "Rotation Independent Phong"; pixels as by
/// [`Phong`](super::phong::Phong). For lights in the scene l and h run likewise, and are renormalised (81 operations a pixel, not 64
/// as Table 2 has it: a reciprocal root is missing there).
///
/// With normals at most 60° apart, diffuse intensity is off by at most 3·10⁻⁴ on triangles no less than 12 pixels high (RMS
/// 1.3·10⁻⁴), and 1.2·10⁻³ from 2 pixels on (RMS 1.4·10⁻⁴). A triangle too thin for a [`Gradient`] has its mean vectors everywhere.
#[derive(Clone, Copy, Debug)]
pub struct PhongPlanes;

/// The vectors a, b and c: 36 + 24 · LIGHTS bytes for directional lights, 40 + 72 · LIGHTS for lights in the scene.
#[derive(Clone, Copy, Debug)]
pub struct Facet<const LIGHTS: usize, L: LightSource> {
    /// N, Q24.
    normal: [Plane; 3],
    /// For each light l and h at pixel (0, 0), Q24.
    rays: [[[i32; 3]; 2]; LIGHTS],
    /// What they increase by to the right and down.
    rises: L::Change<[[[[i32; 2]; 3]; 2]; LIGHTS]>,
}

impl<const LIGHTS: usize, L: LightSource> Shade<LIGHTS, L> for PhongPlanes {
    type Facet = Facet<LIGHTS, L>;
    type Registers = Registers<LIGHTS, L>;
    const EMPTY: Self::Facet = Facet { normal: [Plane::ZERO; 3], rays: [[[0; 3]; 2]; LIGHTS], rises: L::Change::NONE };

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet {
        let gradient = Gradient::new(triangle.points());
        let planes = |[v0, v1, v2]: [[i16; 3]; 3]| {
            let ([ax, ay, az], [bx, by, bz], [cx, cy, cz]) = (v0, v1, v2);
            [[ax, bx, cx], [ay, by, cy], [az, bz, cz]]
                .map(|values| Plane::through(gradient.as_ref(), values.map(i32::from), [0; 3]))
        };
        let normal = planes(triangle.normals());
        if !L::IN_SCENE {
            return Facet { normal, rays: far(triangle, surface), rises: L::Change::NONE };
        }
        let positions = triangle.positions();
        let rays = triangle.aims.each_ref().map(|aim| {
            let rays = positions.map(|position| aim.rays(position));
            let short = |vector: [i32; 3]| vector.map(|c| ((c + 2) >> 2) as i16);
            [rays.map(|rays| short(rays.light)), rays.map(|rays| short(rays.half))].map(planes)
        });
        Facet {
            normal,
            rays: rays.map(|pair| pair.map(|ray| ray.map(|plane| plane.at))),
            rises: L::Change::of(|| rays.map(|pair| pair.map(|ray| ray.map(|plane| [plane.x, plane.y])))),
        }
    }

    #[inline]
    fn start(facet: &Self::Facet, x: i32, y: i32) -> Self::Registers {
        let normal = facet.normal.each_ref().map(|plane| plane.along(x, y));
        let Some(rises) = facet.rises.get() else {
            return Registers { normal, rays: facet.rays, steps: L::Change::NONE };
        };
        let mut rays = facet.rays;
        for (value, [right, down]) in
            rays.as_flattened_mut().as_flattened_mut().iter_mut().zip(rises.as_flattened().as_flattened())
        {
            *value = value.wrapping_add(right.wrapping_mul(x)).wrapping_add(down.wrapping_mul(y));
        }
        let steps = L::Change::of(|| rises.map(|pair| pair.map(|ray| ray.map(|[right, _]| right))));
        Registers { normal, rays, steps }
    }

    #[inline]
    fn run<P>(registers: Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        phong::run(registers, surface, pixels, paint);
    }
}
