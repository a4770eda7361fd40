//! The default: Phong shading by Duff's expression in barycentric form.

use super::{flat::bend_at_centroid, lit, Intensity, Shade, Surface};
use crate::{
    math::{
        gradient::Gradient,
        product::{mul_high, mul_scale},
        root::inverse_root,
    },
    scan::picture::Triangle,
};

/// Phong shading, exact but for rounding, by two additions for |N|² and one for each product.
///
/// With unit normals at the corners and barycentric coordinates λ, N = Σ λi ni has
/// `|N|² = 1 − u`, `u = 2 Σ e_ij λi λj`, `e_ij = 1 − n_i·n_j`, constants of the mesh; and N·L, N·H are linear on the screen. So
/// *Faster Phong Shading*'s Eq. 2b, `(ax + by + c)/√(dx² + exy + fy² + gx + hy + i)`, needs no vector products at set-up, and
/// is continuous across shared edges. `1/√` and the power are looked up.
///
/// Where normals bend so much that u passes 63/64 it is clamped there, and the line counts the facet as bent.
#[derive(Clone, Copy, Debug)]
pub struct DuffBarycentric;

/// A facet, 28 + 24 · LIGHTS bytes; all wrapping.
#[derive(Clone, Copy, Debug)]
pub struct Facet<const LIGHTS: usize> {
    anchor: [i16; 2],
    /// For each light N·L (times its intensity) and N·H: at the anchor, and the increase to the right and down; Q24.
    dots: [[[i32; 3]; 2]; LIGHTS],
    /// u at the anchor, and the coefficients of X, Y, X², XY, Y²; Q28.
    bend: [i32; 6],
    /// Whether a highlight can show on it.
    shiny: bool,
}

/// Two and two registers for each light, and three for u.
#[derive(Clone, Copy, Debug)]
pub struct Registers<const LIGHTS: usize> {
    /// `[value, step]` of N·L and N·H.
    dots: [[[i32; 2]; 2]; LIGHTS],
    bend: i32,
    bend_step: i32,
    bend_second: i32,
    shiny: bool,
}

impl<const LIGHTS: usize> Shade<LIGHTS> for DuffBarycentric {
    type Facet = Facet<LIGHTS>;
    type Registers = Registers<LIGHTS>;
    const EMPTY: Facet<LIGHTS> = Facet { anchor: [0; 2], dots: [[[0; 3]; 2]; LIGHTS], bend: [0; 6], shiny: false };

    fn facet(triangle: &Triangle<LIGHTS>, surface: &Surface<'_, LIGHTS>) -> Facet<LIGHTS> {
        let points = triangle.points();
        let gradient = Gradient::new(points);
        let mut dots = [[[0; 3]; 2]; LIGHTS];
        let [c0, c1, c2] = &triangle.corners;
        for (planes, ((v0, v1), v2)) in dots.iter_mut().zip(c0.dots.iter().zip(&c1.dots).zip(&c2.dots)) {
            for (plane, ((v0, v1), v2)) in planes.iter_mut().zip(v0.iter().zip(v1).zip(v2)) {
                let [v0, v1, v2] = [*v0, *v1, *v2].map(i32::from);
                *plane = match &gradient {
                    Some(gradient) => gradient.linear(v0, v1 - v0, v2 - v0, 10),
                    None => [((v0 + v1 + v2) << 10) / 3, 0, 0],
                };
            }
        }
        let bend = match &gradient {
            Some(gradient) => bend(gradient, triangle.edges),
            None => [bend_at_centroid(triangle), 0, 0, 0, 0, 0],
        };
        let [p0, ..] = points;
        Facet { anchor: Gradient::anchor(p0), dots, bend, shiny: is_shiny(triangle, surface) }
    }

    #[inline]
    fn start(facet: &Facet<LIGHTS>, x: i32, y: i32) -> Registers<LIGHTS> {
        let [ax, ay] = facet.anchor.map(i32::from);
        let (x, y) = (x - ax, y - ay);
        let dots = facet
            .dots
            .map(|planes| planes.map(|[at, dx, dy]| [at.wrapping_add(dx.wrapping_mul(x)).wrapping_add(dy.wrapping_mul(y)), dx]));
        let [u, ux, uy, uxx, uxy, uyy] = facet.bend;
        // On this line u is c + b·x + a·x².
        let b = ux.wrapping_add(uxy.wrapping_mul(y));
        let c = u.wrapping_add(y.wrapping_mul(uy.wrapping_add(uyy.wrapping_mul(y))));
        let ax = uxx.wrapping_mul(x);
        Registers {
            dots,
            bend: c.wrapping_add(x.wrapping_mul(b.wrapping_add(ax))),
            bend_step: b.wrapping_add(ax).wrapping_add(ax).wrapping_add(uxx),
            bend_second: uxx.wrapping_add(uxx),
            shiny: facet.shiny,
        }
    }

    #[inline]
    fn run<P>(mut r: Registers<LIGHTS>, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], ink: impl Fn(Intensity) -> P) {
        if r.shiny {
            let power = &surface.material.power;
            for pixel in pixels {
                let root = inverse_root(r.bend);
                let mut intensity = Intensity::default();
                for ([diffuse, specular], strength) in r.dots.iter_mut().zip(surface.intensities) {
                    // Q16 · Q15: cosines in Q31.
                    intensity.diffuse += lit(diffuse[0]).wrapping_mul(root) >> 17;
                    intensity.specular += (power.at(lit(specular[0]).wrapping_mul(root)) * u32::from(*strength)) >> 15;
                    diffuse[0] = diffuse[0].wrapping_add(diffuse[1]);
                    specular[0] = specular[0].wrapping_add(specular[1]);
                }
                *pixel = ink(intensity.limited(LIGHTS));
                r.step_bend();
            }
        } else {
            for pixel in pixels {
                let root = inverse_root(r.bend);
                let mut intensity = Intensity::default();
                for [diffuse, _] in &mut r.dots {
                    intensity.diffuse += lit(diffuse[0]).wrapping_mul(root) >> 17;
                    diffuse[0] = diffuse[0].wrapping_add(diffuse[1]);
                }
                *pixel = ink(intensity.limited(LIGHTS));
                r.step_bend();
            }
        }
    }
}

impl<const LIGHTS: usize> Registers<LIGHTS> {
    #[inline(always)]
    fn step_bend(&mut self) {
        self.bend = self.bend.wrapping_add(self.bend_step);
        self.bend_step = self.bend_step.wrapping_add(self.bend_second);
    }
}

/// Whether the power can show anywhere on the triangle.
///
/// N·H is nowhere more than at the best corner, and |N| nowhere less than by u = 2/3 of the largest edge constant, as
/// Σ λi λj ≤ 1/3.
fn is_shiny<const LIGHTS: usize>(triangle: &Triangle<LIGHTS>, surface: &Surface<'_, LIGHTS>) -> bool {
    let [c0, c1, c2] = &triangle.corners;
    let dots = c0.dots.iter().chain(&c1.dots).chain(&c2.dots);
    let most = dots.map(|[_, specular]| *specular).max().unwrap_or(0).max(0) as u32;
    let [e01, e12, e20] = triangle.edges;
    // 2/3 of a Q15 number in Q28, without a division.
    let bend = u32::from(e01.max(e12).max(e20)) * (16384 / 3 + 1);
    // Q14 · Q15, rounded up a little, as Q31.
    let cosine = (most + 2).saturating_mul(inverse_root(bend as i32) + 4).saturating_mul(4);
    surface.material.power.shows(cosine)
}

/// The coefficients of u, Q28.
///
/// With λi = ρ·(hi + gi·X + ki·Y), i = 1, 2, and λ0 = 1 − λ1 − λ2:
/// `u = 2ρ(e01·v1 + e02·v2) + 2ρ²(e01·v0·v1 + e02·v0·v2 + e12·v1·v2)` with v the numerators and v0 = −v1 − v2.
fn bend(gradient: &Gradient, [e01, e12, e20]: [u16; 3]) -> [i32; 6] {
    let Gradient { at: h, x: g, y: k, short, exponent } = *gradient;
    // Sixteen bits of the largest edge constant: those of a smooth mesh are small.
    let up = (u32::from(e01 | e12 | e20) | 1).leading_zeros() as i32 - 16;
    let [e01, e12, e20] = [e01, e12, e20].map(|e| u32::from(e) << up);
    // e is Q15: 2ρ·e·v in Q28 is e·v·short · 2^(exponent − 39 + 1 − 15 + 28).
    let linear = |[v1, v2]: [i32; 2]| {
        let sum = (e01 as i32 * v1).wrapping_add(e20 as i32 * v2);
        mul_scale(sum, short, exponent - 9 - up)
    };
    // 2ρ²·e·v·w is e·v·w·short² · 2^(2·exponent − 78 + 1 − 15 + 28), and three halves of a word go in the products.
    let square = (short * (short >> 1)) >> 15;
    let quadratic = |[p0, p1, p2]: [i32; 3]| {
        let sum = mul_high(p0, e01) + mul_high(p1, e12) + mul_high(p2, e20);
        mul_scale(sum, square, 2 * exponent - 16 - up)
    };
    // The products that belong to e01, e12, e20: of one vector with itself, and of two both ways.
    let own = |[v1, v2]: [i32; 2]| {
        let v0 = -v1 - v2;
        [v0 * v1, v1 * v2, v2 * v0]
    };
    let both = |[v1, v2]: [i32; 2], [w1, w2]: [i32; 2]| {
        let (v0, w0) = (-v1 - v2, -w1 - w2);
        [v0 * w1 + v1 * w0, v1 * w2 + v2 * w1, v2 * w0 + v0 * w2]
    };
    [
        linear(h).wrapping_add(quadratic(own(h))),
        linear(g).wrapping_add(quadratic(both(h, g))),
        linear(k).wrapping_add(quadratic(both(h, k))),
        quadratic(own(g)),
        quadratic(both(g, k)),
        quadratic(own(k)),
    ]
}
