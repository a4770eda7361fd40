//! Quadratics of the cosines, through six samples.

use super::{
    duff_barycentric::{is_shiny, most},
    Intensity, Paint, Shade, Surface,
};
use crate::{
    math::{
        gradient::Gradient,
        quadratic::{Differences, Quadratic},
        root::inverse_root,
    },
    model::light::LightSource,
    scan::triangle::Triangle,
};

/// Shading by quadratics of the two cosines, N·L/|N| and N·H/|N|, that are exact at the corners and in the middles of the edges; the
/// power is looked up.
///
/// After *Faster Phong Shading*, §2.2, which takes Bishop and Weimer's Taylor series instead: the form of Eq. 3, other
/// coefficients. In the middle of an edge it is `(d_i + d_j)/√(2(2 − e_ij))`, d being the products at the corners and
/// `e = 1 − n_i·n_j`; for lights in the scene the product there takes the place of `(d_i + d_j)/2`. Continuous across shared
/// edges, as an edge's three samples are all that it depends on there.
///
/// Good on facets whose normals bend up to 30° or so, and no worse than Bishop and Weimer's up to 60°. Beyond, cosines are no
/// longer quadratic: on the teapot, where some corners of one facet have normals 138° apart, it is off by up to 100 levels of 255.
/// [`DuffBarycentric`](super::duff_barycentric::DuffBarycentric) is made of the same where normals bend little, exact
/// elsewhere, and cheaper.
#[derive(Clone, Copy, Debug)]
pub struct QuadraticDots;

/// A facet, 4 + 48 · LIGHTS bytes.
#[derive(Clone, Copy, Debug)]
pub struct Facet<const LIGHTS: usize> {
    /// Whether a highlight can show on it.
    pub(super) shiny: bool,
    /// For each light the cosine with l, times its intensity, and that with h, Q28.
    pub(super) cosines: [[Quadratic; 2]; LIGHTS],
}

/// What is stepped along a line.
#[derive(Clone, Copy, Debug)]
pub struct Registers<const LIGHTS: usize> {
    shiny: bool,
    cosines: [[Differences; 2]; LIGHTS],
}

/// Bits of an interpolated cosine below Q14.
pub(super) const FINER: i32 = 14;

impl<const LIGHTS: usize, L: LightSource> Shade<LIGHTS, L> for QuadraticDots {
    type Facet = Facet<LIGHTS>;
    type Registers = Registers<LIGHTS>;
    const EMPTY: Self::Facet = Facet { shiny: false, cosines: [[Quadratic::ZERO; 2]; LIGHTS] };

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet {
        let gradient = Gradient::new(triangle.points());
        let middles = triangle.middles();
        let [e01, e12, e20] = *triangle.edges;
        let shiny = is_shiny(most(triangle, &middles), e01.max(e12).max(e20).into(), &surface.material.power);
        let [r01, r12, r20] = triangle.edges.map(stretch);
        let mut cosines = [[Quadratic::ZERO; 2]; LIGHTS];
        let ([c0, c1, c2], [m01, m12, m20]) = (triangle.corners, &middles);
        let corners = c0.dots.iter().zip(&c1.dots).zip(&c2.dots);
        let middles = m01.iter().zip(m12).zip(m20);
        for ((pair, ((v0, v1), v2)), ((m01, m12), m20)) in cosines.iter_mut().zip(corners).zip(middles) {
            let quadratic = |[v0, v1, v2]: [i16; 3], [m01, m12, m20]: [i16; 3]| {
                let middles = [cosine(m01, r01), cosine(m12, r12), cosine(m20, r20)].map(|cosine| (cosine + (1 << 14)) >> 15);
                Quadratic::through_six(gradient.as_ref(), [v0, v1, v2].map(i32::from), middles, FINER)
            };
            let ([l0, h0], [l1, h1], [l2, h2]) = (*v0, *v1, *v2);
            let ([l01, h01], [l12, h12], [l20, h20]) = (*m01, *m12, *m20);
            let [diffuse, specular] = pair;
            *diffuse = quadratic([l0, l1, l2], [l01, l12, l20]);
            if shiny {
                *specular = quadratic([h0, h1, h2], [h01, h12, h20]);
            }
        }
        Facet { shiny, cosines }
    }

    #[inline]
    fn start(facet: &Self::Facet, x: i32, y: i32) -> Self::Registers {
        let along = |quadratic: &Quadratic| quadratic.along(x, y);
        Registers { shiny: facet.shiny, cosines: facet.cosines.each_ref().map(|pair| pair.each_ref().map(along)) }
    }

    #[inline]
    fn run<P>(mut r: Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        // At most one, so that the sums stay below 2³².
        let cosine = |value: i32| value.clamp(0, 1 << (14 + FINER)) as u32;
        if r.shiny {
            for pixel in pixels {
                let mut intensity = Intensity::default();
                for ([diffuse, specular], strength) in r.cosines.iter_mut().zip(surface.intensities) {
                    intensity.diffuse += cosine(diffuse.next()) >> FINER;
                    // Q28 to Q31.
                    let power = surface.material.power.at(cosine(specular.next()) << (17 - FINER));
                    intensity.specular += (power * u32::from(*strength)) >> 15;
                }
                *pixel = paint.mix(intensity.limited(LIGHTS));
            }
        } else {
            for pixel in pixels {
                let mut intensity = Intensity::default();
                for [diffuse, _] in &mut r.cosines {
                    intensity.diffuse += cosine(diffuse.next()) >> FINER;
                }
                *pixel = paint.dull(intensity.limited(LIGHTS).diffuse);
            }
        }
    }
}

/// `1/√(1 − e/2)`, Q15, for an edge constant e: what a product in the middle of the edge takes to become a cosine.
#[inline(always)]
pub(super) fn stretch(edge: u16) -> u32 {
    // Half of a Q15 number in Q28.
    inverse_root(i32::from(edge) << 12)
}

/// A product, Q14, times that: a cosine in Q29, from −1 to 1.
#[inline(always)]
pub(super) fn cosine(product: i16, stretch: u32) -> i32 {
    let product = i32::from(product);
    if stretch >> 16 == 0 {
        (product * stretch as i32).clamp(-1 << 29, 1 << 29)
    } else {
        // 18 bits.
        (product * (stretch >> 2) as i32).clamp(-1 << 27, 1 << 27) << 2
    }
}
