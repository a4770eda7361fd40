//! How near a triangle is, from pixel to pixel.

use embedded_graphics::geometry::Point;

use super::vertex::Vertex;
use crate::math::{gradient::Gradient, quotient::floor, screen::SUBPIXELS};

/// A triangle's nearness on the screen, a plane: 30 bits at the near plane; larger is nearer. Wrapping.
///
/// At each pixel that the triangle covers it is off by less than 2¹⁴, in fact by 6300 at most. As the reach of a triangle, from its
/// farthest corner to its nearest, is in units of 2¹⁵, two triangles of which one as a whole is nearer are in the same order by their
/// depths: there is one order for all ways to find who is seen.
#[derive(Clone, Copy, Debug)]
pub struct Depth {
    /// At the centre of pixel (0, 0).
    at: i32,
    /// Its increase for a pixel to the right and down.
    steps: [i32; 2],
}

/// Bits of a depth below those of a nearness.
const FINER: i32 = 7;

impl Depth {
    /// Zero everywhere.
    pub(crate) const ZERO: Self = Self { at: 0, steps: [0; 2] };

    /// The increase to the right of one that is not known yet; no triangle has such a step.
    const UNKNOWN: i32 = i32::MIN;

    /// That of a triangle; and 1 if it took 64-bit divisions, else 0.
    #[inline(always)]
    pub(crate) fn of<const LIGHTS: usize>(corners: [&Vertex<LIGHTS>; 3]) -> (Self, u32) {
        let nearness @ [a, b, c] = corners.map(|corner| corner.nearness() as i32);
        let reach = ((a.max(b).max(c) + 0xff) >> 8) - (a.min(b).min(c) >> 8);
        let ([at, x, y], exact) = plane(corners.map(|corner| corner.point()), nearness, reach);
        (Self { at, steps: [x.max(-i32::MAX), y] }, exact)
    }

    /// Is not known any more.
    #[inline(always)]
    pub(crate) const fn forget(&mut self) {
        let [right, _] = &mut self.steps;
        *right = Self::UNKNOWN;
    }

    #[inline(always)]
    pub(crate) const fn is_known(&self) -> bool {
        self.step() != Self::UNKNOWN
    }

    /// At a pixel.
    #[inline(always)]
    pub(crate) const fn at(&self, x: i32, line: u16) -> i32 {
        let [right, down] = self.steps;
        self.at.wrapping_add(right.wrapping_mul(x)).wrapping_add(down.wrapping_mul(line as i32))
    }

    /// The increase for a pixel to the right.
    #[inline(always)]
    pub(crate) const fn step(&self) -> i32 {
        let [right, _] = self.steps;
        right
    }

    /// The increase for a pixel to the right, and down.
    #[inline(always)]
    pub(crate) const fn steps(&self) -> [i32; 2] {
        self.steps
    }
}

/// The depth at pixel (0, 0), and its increase for a pixel to the right and down, wrapping; given the reach, the difference between the
/// nearest and the farthest corner. And 1 if that took 64-bit divisions, else 0.
#[inline(always)]
fn plane(points: [Point; 3], [w0, w1, w2]: [i32; 3], reach: i32) -> ([i32; 3], u32) {
    match Gradient::with_bits(points) {
        // Of 2¹⁴, at most half for λ1 and λ2, and a quarter for ρ.
        Some((gradient, bits)) if reach >> (bits.min(16) - 3).max(0) == 0 => {
            (gradient.linear_wide(w0, w1 - w0, w2 - w0, FINER), 0)
        }
        _ => (exact_plane(points, [w0, w1, w2]), 1),
    }
}

/// The same by 64-bit divisions, each number off by less than a unit: for triangles so thin, large or steep that the gradient has too
/// few bits.
#[cold]
#[inline(never)]
fn exact_plane([p0, p1, p2]: [Point; 3], [w0, w1, w2]: [i32; 3]) -> [i32; 3] {
    let from_p0 = |p: Point| [p.x - p0.x, p.y - p0.y].map(i64::from);
    let ([ax, ay], [bx, by]) = (from_p0(p1), from_p0(p2));
    let [d1, d2] = [w1 - w0, w2 - w0].map(i64::from);
    // Products of 21 and 25 bits; with those of a place in a pixel and of the finer unit 62.
    let [x, y] = [d1 * by - d2 * ay, d2 * ax - d1 * bx];
    let [fx, fy] = [p0.x, p0.y].map(|place| i64::from(SUBPIXELS / 2 - (place & (SUBPIXELS - 1))));
    let area = ax * by - ay * bx;
    let [at, x, y] = [x * fx + y * fy, x * i64::from(SUBPIXELS), y * i64::from(SUBPIXELS)]
        .map(|numerator| (floor(numerator << FINER, area.unsigned_abs()) * area.signum()) as i32);
    let [px, py] = [p0.x, p0.y].map(|place| place.div_euclid(SUBPIXELS));
    [(w0 << FINER).wrapping_add(at).wrapping_sub(x.wrapping_mul(px)).wrapping_sub(y.wrapping_mul(py)), x, y]
}

#[cfg(test)]
#[expect(clippy::indexing_slicing, reason = "a test may fail")]
mod tests {
    use super::*;

    /// Twice the area, as far as 20 bits of coordinates go.
    fn area([[ax, ay], [bx, by], [cx, cy]]: [[i32; 2]; 3]) -> i128 {
        let [bx, by, cx, cy] = [bx - ax, by - ay, cx - ax, cy - ay].map(i128::from);
        bx * cy - by * cx
    }

    /// At pixels of triangles of all sizes, down to the thinnest.
    #[test]
    fn depths_are_off_by_less_than_half_a_unit_of_the_reach() {
        let mut state = 1_u64;
        let mut random = |below: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (((state >> 33) as i64 * i64::from(below)) >> 31) as i32
        };
        let (mut counts, mut most) = ([0; 2], [0.0; 2]);
        for round in 0..400_000 {
            let pixel = [random(1024), random(1024)];
            let p = pixel.map(|c| 256 * c + 128);
            let size = 1 << (2 + round % 17);
            let mut near = |[x, y]: [i32; 2], size: i32| [x + random(2 * size + 1) - size, y + random(2 * size + 1) - size];
            let (a, b) = (near(p, size), near(p, size));
            // Opposite to one of them, or to their middle; how far off that, makes the triangle thick or thin.
            let opposite = [0, 1].map(|i| if round % 2 == 0 { 2 * p[i] - a[i] } else { 2 * p[i] - (a[i] + b[i]) / 2 });
            let c = near(opposite, 1 << (round / 17 % 12));
            let corners = [a, b, c];
            let [at_a, at_b, at_c] = [area([p, b, c]), area([a, p, c]), area([a, b, p])];
            let whole = area(corners);
            let inside = [at_a, at_b, at_c].iter().all(|part| part * whole.signum() >= 0);
            if whole == 0 || !inside || corners.as_flattened().iter().any(|c| c.abs() >= 1 << 19) {
                continue;
            }
            let span = 1 << (1 + round / 5 % 23);
            let nearness = [(); 3].map(|()| (1 << 23) - random(span));
            let (least, largest) =
                nearness.iter().fold((i32::MAX, 0), |(least, largest), near| (least.min(*near), largest.max(*near)));
            let reach = ((largest + 0xff) >> 8) - (least >> 8);

            let points = corners.map(|[x, y]| Point::new(x, y));
            let ([depth, dx, dy], kind) = plane(points, nearness, reach);
            let depth = depth.wrapping_add(dx.wrapping_mul(pixel[0])).wrapping_add(dy.wrapping_mul(pixel[1]));
            let [wa, wb, wc] = nearness.map(i128::from);
            let exact = (((wa * at_a + wb * at_b + wc * at_c) << FINER) as f64) / whole as f64;
            let error = (f64::from(depth) - exact).abs();
            assert!(error < f64::from(1 << 14), "{corners:?} {nearness:?} at {pixel:?}: {error}");
            let kind = kind as usize;
            counts[kind] += 1;
            most[kind] = f64::max(most[kind], error);
        }
        assert!(counts.iter().all(|count| *count > 50_000), "{counts:?}");
        assert!(most[0] < 6300.0 && most[1] < 1800.0, "{most:?}");
    }
}
