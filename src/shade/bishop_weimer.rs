//! Bishop and Weimer's Taylor series.

use super::{
    duff_barycentric::{is_shiny, most},
    quadratic_dots::{self, QuadraticDots, FINER},
    Paint, Shade, Surface,
};
use crate::{
    math::{gradient::Gradient, quadratic::Quadratic, root::inverse_root},
    model::light::LightSource,
    scan::triangle::Triangle,
};

/// Shading by Taylor quadratics of the two cosines, N·L/|N| and N·H/|N|, about the triangle's centroid; the power is looked up.
///
/// *Faster Phong Shading*, §2.2: the right-hand side of Eq. 2b, `(ax + by + c)/√(dx² + exy + fy² + gx + hy + i)`, as
/// `T5 x² + T4 xy + T3 y² + T2 x + T1 y + T0` (Eq. 3), stepped by differences: four additions a pixel, and a fifth for the sum of
/// the terms. The paper does not print the coefficients; they are
///
/// ```text
/// T0 = c/√i     T1 = (2bi − ch)/(2i√i)     T3 = (3ch² − 4cfi − 4bhi)/(8i²√i)
///               T2 = (2ai − cg)/(2i√i)     T4 = (3cgh − 2cei − 2bgi − 2ahi)/(4i²√i)
///                                          T5 = (3cg² − 4cdi − 4agi)/(8i²√i)
/// ```
///
/// Here x and y are not the screen's but λ1 − 1/3 and λ2 − 1/3: a Taylor quadratic is the same in whatever linear coordinates,
/// and a to i are short numbers in these. For lights in the scene, Eq. 2c, the numerator is the quadratic through six samples.
///
/// Good near the centroid of each facet, with seams along shared edges: on strongly bent facets the series runs away from what it
/// stands for, by up to 152 levels of 255 on the teapot. What does not fit its numbers is clamped: |N|² at the centroid at 1/8, the
/// cosine at a corner at ±4.
///
/// Facets are those of [`QuadraticDots`], 4 + 48 · LIGHTS bytes, as are the pixels.
#[derive(Clone, Copy, Debug)]
pub struct BishopWeimer;

impl<const LIGHTS: usize, L: LightSource> Shade<LIGHTS, L> for BishopWeimer {
    type Facet = <QuadraticDots as Shade<LIGHTS, L>>::Facet;
    type Registers = <QuadraticDots as Shade<LIGHTS, L>>::Registers;
    const EMPTY: Self::Facet = <QuadraticDots as Shade<LIGHTS, L>>::EMPTY;

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet {
        let [p0, p1, p2] = triangle.points();
        let gradient = Gradient::new([p0, p1, p2]);
        let middles = triangle.middles();
        let [e01, e12, e20] = *triangle.edges;
        let shiny = is_shiny(most(triangle, &middles), e01.max(e12).max(e20).into(), &surface.material.power);
        let root = Root::new(triangle.edges);
        let mut cosines = [[Quadratic::ZERO; 2]; LIGHTS];
        let ([c0, c1, c2], [m01, m12, m20]) = (triangle.corners, &middles);
        let corners = c0.dots.iter().zip(&c1.dots).zip(&c2.dots);
        let middles = m01.iter().zip(m12).zip(m20);
        for ((pair, ((v0, v1), v2)), ((m01, m12), m20)) in cosines.iter_mut().zip(corners).zip(middles) {
            let quadratic = |values: [i16; 3], [m01, m12, m20]: [i16; 3]| {
                let [v0, v1, v2] = values.map(i32::from);
                let bow = |m: i16, a, b| if L::IN_SCENE { 4 * i32::from(m) - 2 * (a + b) } else { 0 };
                let bows = [bow(m01, v0, v1), bow(m12, v1, v2), bow(m20, v2, v0)];
                let (corners, bows) = root.times([v0, v1, v2], bows);
                Quadratic::bowed(gradient.as_ref(), corners, bows, FINER)
            };
            let ([l0, h0], [l1, h1], [l2, h2]) = (*v0, *v1, *v2);
            let ([l01, h01], [l12, h12], [l20, h20]) = (*m01, *m12, *m20);
            let [diffuse, specular] = pair;
            *diffuse = quadratic([l0, l1, l2], [l01, l12, l20]);
            if shiny {
                *specular = quadratic([h0, h1, h2], [h01, h12, h20]);
            }
        }
        quadratic_dots::Facet { shiny, cosines }
    }

    #[inline]
    fn start(facet: &Self::Facet, x: i32, y: i32) -> Self::Registers {
        <QuadraticDots as Shade<LIGHTS, L>>::start(facet, x, y)
    }

    #[inline]
    fn run<P>(registers: Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        <QuadraticDots as Shade<LIGHTS, L>>::run(registers, surface, pixels, paint);
    }
}

/// `1/√(dx² + exy + fy² + gx + hy + i)` as a Taylor quadratic: `1/√i` times one plus these; Q12.
#[derive(Clone, Copy, Debug)]
struct Root {
    /// 1/√i, Q15.
    at: i32,
    x: i32,
    y: i32,
    xx: i32,
    xy: i32,
    yy: i32,
}

impl Root {
    /// Of |N|², for edge constants in Q15; i counts as 1/8 at least.
    fn new(&[e01, e12, e20]: &[u16; 3]) -> Self {
        let [e01, e12, e20] = [e01, e12, e20].map(i32::from);
        // 1 − i = 2/9 of the sum, Q15 to Q28.
        let at = inverse_root(ninth(e01 + e12 + e20) << 14).min(0x16a09) as i32;
        // 1/i, Q12.
        let inverse = ((at >> 1) * (at >> 1)) >> 16;
        // Q15 · Q12 to Q12.
        let over = |coefficient: i32| (coefficient * inverse) >> 15;
        // Halves of g/i and h/i; d/i, e/i, f/i.
        let half = |slope: i32| over(3 * ninth(slope)).clamp(-6 << 12, 6 << 12);
        let (g, h) = (half(e20 - e12), half(e01 - e12));
        let [e01, e12, e20] = [e01, e12, e20].map(over);
        let (d, e, f) = (2 * e01, 2 * (e01 + e20 - e12), 2 * e20);
        // (1 + ε)^(−1/2) = 1 − ε/2 + 3/8 ε².
        let product = |a: i32, b: i32| (3 * a * b) >> 12;
        let [xx, xy, yy] = [product(g, g) - d, 2 * product(g, h) - e, product(h, h) - f].map(|twice| limited(twice >> 1, 16, 12));
        Self { at, x: -g, y: -h, xx, xy, yy }
    }

    /// The Taylor quadratic of this and a numerator that has those values, Q14, at the corners, and between them those bows: its
    /// values at the corners, up to ±4, and its bows, up to ±8.
    fn times(&self, [v0, v1, v2]: [i32; 3], [b01, b12, b20]: [i32; 3]) -> ([i32; 3], [i32; 3]) {
        // The numerator about the centroid: c + ax + by + …, Q14.
        let c = limited(3 * ninth(v0 + v1 + v2) + ninth(b01 + b12 + b20), 1, 14);
        let a = limited(v1 - v0 + 3 * ninth(b12 - b20), 2, 14);
        let b = limited(v2 - v0 + 3 * ninth(b12 - b01), 2, 14);
        let (xx, xy, yy) = (-b01, b12 - b01 - b20, -b20);
        // Q14 · Q12.
        let product = |a: i32, b: i32| (a * b) >> 12;
        // Q14 · Q12, of numbers up to 8 and √8.
        let over_root = |value: i32| (limited(value, 8, 14) * (self.at >> 3)) >> 12;
        let t0 = (c * self.at) >> 15;
        let t2 = over_root(a + product(c, self.x));
        let t1 = over_root(b + product(c, self.y));
        let t5 = over_root(xx + product(c, self.xx) + product(a, self.x));
        let t4 = over_root(xy + product(c, self.xy) + product(a, self.y) + product(b, self.x));
        let t3 = over_root(yy + product(c, self.yy) + product(b, self.y));
        // At thirds of x and y.
        let corner = |x: i32, y: i32| {
            let value = t0 + 3 * ninth(t2 * x + t1 * y) + ninth(t5 * x * x + t4 * x * y + t3 * y * y);
            limited(value, 4, 14)
        };
        ([corner(-1, -1), corner(2, -1), corner(-1, 2)], [-t5, t4 - t3 - t5, -t3].map(|bow| limited(bow, 8, 14)))
    }
}

/// A number with so many bits after the point, less than `most` and more than −`most`.
fn limited(value: i32, most: i32, bits: u32) -> i32 {
    value.clamp(1 - (most << bits), (most << bits) - 1)
}

/// A ninth of a number of up to 21 bits; relative error at most 2.5·10⁻⁴.
const fn ninth(value: i32) -> i32 {
    (value * 455 + (1 << 11)) >> 12
}
