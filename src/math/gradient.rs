//! How values at a triangle's corners run across the screen.

use embedded_graphics::geometry::Point;

use super::{
    product::{mul_high, scale},
    reciprocal::Reciprocal,
    screen::SUBPIXELS,
};

/// The barycentric coordinates λ1 and λ2 of a screen triangle, as linear functions of the pixel.
///
/// With X and Y counted in pixels from the one that holds corner 0, the anchor, `λi = (at[i] + x[i]·X + y[i]·Y) · ρ`; the numerators
/// have 14 bits, and one reciprocal serves all values of the triangle. These are given as functions of the picture's pixels, which
/// modulo 2³² are as exact as from the anchor.
#[derive(Clone, Copy, Debug)]
pub struct Gradient {
    /// Numerators of λ1, λ2 at the centre of the anchor's pixel.
    pub at: [i32; 2],
    /// Their increase for a pixel to the right.
    pub x: [i32; 2],
    /// Their increase for a pixel down.
    pub y: [i32; 2],
    /// `ρ = short · 2^(exponent − 39)`, 32768 to 65536.
    pub short: u32,
    /// See `short`.
    pub exponent: i32,
    /// The anchor, in pixels.
    pub anchor: [i32; 2],
}

impl Gradient {
    /// The gradient of the triangle; none where it is thinner than about 1/64 pixel, or, with a longest side of more than 32
    /// pixels, than 1/2000 of that side: such a triangle takes its values from its centroid.
    #[inline(always)]
    #[must_use]
    pub fn new(points: [Point; 3]) -> Option<Self> {
        Self::with_bits(points).map(|(gradient, _)| gradient)
    }

    /// The same with the number of good bits: on the triangle λ1 and λ2 are off by at most `2^−bits` before ρ is rounded.
    #[inline(always)]
    pub(crate) fn with_bits([p0, p1, p2]: [Point; 3]) -> Option<(Self, i32)> {
        let [ax, ay, bx, by] = [p1.x - p0.x, p1.y - p0.y, p2.x - p0.x, p2.y - p0.y];
        let mut bits = (ax ^ ax >> 31) | (ay ^ ay >> 31) | (bx ^ bx >> 31) | (by ^ by >> 31) | 1;
        // Thirteen bits for the largest: more precision for small triangles, no overflow for large ones.
        let mut up = 0;
        let ([ax, ay, bx, by], least) = if bits < 1 << 13 {
            // A few steps for most; not every processor can count zeros.
            while bits & (1 << 12) == 0 {
                bits <<= 1;
                up += 1;
            }
            // At least a height of 1/64 pixel over the longest side.
            ([ax, ay, bx, by].map(|d| d << up), 1 << 15 << up)
        } else {
            up = bits.leading_zeros() as i32 - 19;
            // Or of 4 units where these are larger.
            ([ax, ay, bx, by].map(|d| scale(d, up)), 1 << 15)
        };
        let area = ax * by - ay * bx;
        let size = area.unsigned_abs();
        if size < least {
            return None;
        }
        // At most 2²⁷; a few steps here, too.
        let (mut whole, mut zeros) = (size << 4, 4);
        while whole >> 31 == 0 {
            whole <<= 1;
            zeros += 1;
        }
        let inverse = Reciprocal { mantissa: Reciprocal::mantissa(whole), zeros };
        let [x, y] = if area < 0 { [[-by, ay], [bx, -ax]] } else { [[by, -ay], [-bx, ax]] };
        // From corner 0 to the centre of its pixel.
        let [fx, fy] = [p0.x, p0.y].map(|place| SUBPIXELS / 2 - (place & (SUBPIXELS - 1)));
        let ([x1, x2], [y1, y2]) = (x, y);
        let at = [(x1 * fx + y1 * fy + 128) >> 8, (x2 * fx + y2 * fy + 128) >> 8];
        let exponent = inverse.zeros + up;
        // Small ones have half a unit of `at`; large ones that of each coordinate, in numerators of 2³¹⁻ᶻᵉʳᵒˢ and more for λ = 1.
        let bits = if up < 0 { 16 - inverse.zeros } else { 24 - exponent };
        Some((Self { at, x, y, short: inverse.short(), exponent, anchor: [p0.x >> 8, p0.y >> 8] }, bits))
    }

    /// A value that is `v0` at corner 0, `v0 + d1` and `v0 + d2` at the others: at pixel (0, 0), and its increase for a
    /// pixel to the right and down, in units finer by 2^`finer` and wrapping.
    ///
    /// The differences have at most 15 bits and a sign.
    #[inline]
    #[must_use]
    pub fn linear(&self, v0: i32, d1: i32, d2: i32, finer: i32) -> [i32; 3] {
        self.linear_here(v0, d1, d2, finer)
    }

    /// The same in line, for a gradient that then need not be stored.
    #[inline(always)]
    pub(crate) fn linear_here(&self, v0: i32, d1: i32, d2: i32, finer: i32) -> [i32; 3] {
        // ρ goes into the differences, in halves of a unit: so the value is off by no more than these, wherever on the triangle.
        let half = (self.short >> 1) as i32;
        let [d1, d2] = [d1, d2].map(|d| d.wrapping_mul(half).wrapping_add(1 << 13) >> 14);
        let up = self.exponent + finer - 24;
        let along = |[g1, g2]: [i32; 2]| (d1.wrapping_mul(g1).wrapping_add(d2.wrapping_mul(g2)) << up.max(0)) >> (-up).max(0);
        self.at_origin([v0.wrapping_shl(finer as u32).wrapping_add(along(self.at)), along(self.x), along(self.y)])
    }

    /// As [`linear`](Self::linear) for differences of up to 24 bits, exact but for a rounding at the end; by 64-bit products only
    /// where differences have more than 16 bits.
    #[must_use]
    pub fn linear_wide(&self, v0: i32, d1: i32, d2: i32, finer: i32) -> [i32; 3] {
        let is_short = |d: i32| (d + (1 << 16)) as u32 >> 17 == 0;
        let [at, x, y] = if is_short(d1) && is_short(d2) {
            let shift = self.exponent + finer - 23;
            [self.at, self.x, self.y].map(|[g1, g2]| scale(mul_high(d1 * g1 + d2 * g2, self.short), shift))
        } else {
            let (d1, d2) = (i64::from(d1), i64::from(d2));
            let less = (39 - self.exponent - finer).clamp(1, 63);
            [self.at, self.x, self.y].map(|[g1, g2]| {
                let product = (d1 * i64::from(g1) + d2 * i64::from(g2)) * i64::from(self.short);
                ((product >> (less - 1)).wrapping_add(1) >> 1) as i32
            })
        };
        self.at_origin([v0.wrapping_shl(finer as u32).wrapping_add(at), x, y])
    }

    /// A plane given at the anchor as one from pixel (0, 0) on.
    #[inline(always)]
    const fn at_origin(&self, [at, x, y]: [i32; 3]) -> [i32; 3] {
        let [ax, ay] = self.anchor;
        [at.wrapping_sub(x.wrapping_mul(ax)).wrapping_sub(y.wrapping_mul(ay)), x, y]
    }
}
