//! Directions.

use super::{
    product::{mul_high, scale},
    quotient::fraction,
    reciprocal::Reciprocal,
    root::{integer_root, inverse_root},
};

/// A vector with Q30 components (one is 2³⁰), each from −2 to 2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Vector(pub [i32; 3]);

impl Vector {
    /// The unit vector in the direction of (x, y, z), in any one unit; none for the null vector.
    ///
    /// Relative error of each component below 2⁻²⁸ where the largest exceeds 2⁻⁸ in its unit.
    #[must_use]
    pub fn unit(components: [i64; 3]) -> Option<Self> {
        let largest = components.iter().fold(0, |largest, c| largest | c.unsigned_abs());
        // Bring the largest to 30 bits: the sum of squares then fits 62.
        let up = largest.leading_zeros().saturating_sub(1);
        let components = components.map(|c| ((c << up) >> 33) as i32);
        let length = norm(components);
        (length > 0).then(|| Self(components.map(|c| c.signum() * fraction(c.unsigned_abs(), length) as i32)))
    }

    /// The unit vector in the direction of (x, y, z); none for the null vector. NaN counts as 0.
    #[must_use]
    pub fn unit_f32(components: [f32; 3]) -> Option<Self> {
        Self::unit(components.map(|c| (c * 4_294_967_296.0) as i64))
    }

    /// The scalar product, Q30; wraps beyond ±2.
    #[inline(never)]
    #[must_use]
    pub fn dot(self, other: Self) -> i32 {
        ((dot_64(self.0, other.0) + (1 << 29)) >> 30) as i32
    }
}

/// The unit vector in the direction of (x, y, z), in any one unit, with Q16 components; the null vector for itself.
///
/// By 32-bit arithmetic and one 64-bit product. Error of each component at most 5·10⁻⁵, once the largest has 15 bits.
#[must_use]
pub fn unit(components: [i32; 3]) -> [i32; 3] {
    let largest = components.iter().fold(0, |largest, c| largest | c.unsigned_abs());
    if largest == 0 {
        return [0; 3];
    }
    // Bring the largest to 15 bits: the sum of squares then fits 32.
    let components = components.map(|c| scale(c, largest.leading_zeros() as i32 - 17));
    let square = components.iter().fold(0, |sum: u32, c| sum.wrapping_add(c.wrapping_mul(*c) as u32));
    // v = square/2³² of a quarter and more, by a shift of two bits at most.
    let short = i32::from(square < 1 << 30);
    let square = square << (2 * short);
    let root = inverse_root((square.wrapping_neg() >> 4) as i32).min(0xffff);
    // One step of Newton's: 1/√v · (1 + e/2), e = 1 − v/√v² in Q20.
    let e = ((1 << 32) - ((i64::from(square) * i64::from(root * root)) >> 30)) >> 12;
    let root = (8 * root as i32 + ((root as i32 * e as i32) >> 18) + 8) >> 4;
    components.map(|c| (c * root + (1 << (13 - short))) >> (14 - short))
}

/// A unit vector, turned by the least rotation that takes the unit vector `from` to the unit vector `to`.
///
/// The vector is Q14, the two are Q16. Where they are more than 151° apart the vector stays where it is. Error of each component at
/// most 4.2·10⁻⁴, RMS below 3.9·10⁻⁵.
#[must_use]
pub fn turned(vector: [i16; 3], from: [i32; 3], to: [i32; 3]) -> [i16; 3] {
    // Q15, and their sum.
    let half = |v: [i32; 3]| v.map(|c| (c + 1) >> 1);
    let (from, to) = (half(from), half(to));
    let ([fx, fy, fz], [tx, ty, tz]) = (from, to);
    let sum = [fx + tx, fy + ty, fz + tz];
    // 1 + cos of the angle between the two, Q29.
    let apart = (1 << 29) + (dot(from, to) >> 1);
    if apart < 1 << 26 {
        return vector;
    }
    let inverse = Reciprocal::of(apart as u32);
    let wide = vector.map(i32::from);
    // Two reflections: v + 2 (from · v) to − sum (sum · v)/(1 + from · to); Q15 each.
    let along = dot(from, wide) >> 13;
    let back = scale(mul_high(dot(sum, wide), inverse.short()), inverse.zeros - 16);
    let mut turned = vector;
    for ((turned, sum), to) in turned.iter_mut().zip(sum).zip(to) {
        let way = along.wrapping_mul(to).wrapping_sub(back.wrapping_mul(sum));
        *turned = turned.wrapping_add((way.wrapping_add(1 << 15) >> 16) as i16);
    }
    turned
}

/// The scalar product in 64 bits, the sum wrapping.
///
/// A function of its own: it is long on small processors, and a frame's objects need many.
#[inline(never)]
#[must_use]
pub fn dot_64(a: [i32; 3], b: [i32; 3]) -> i64 {
    let ([a, b, c], [d, e, f]) = (a.map(i64::from), b.map(i64::from));
    (a * d).wrapping_add(b * e).wrapping_add(c * f)
}

/// The length, rounded down.
#[inline(never)]
#[must_use]
pub fn norm(vector: [i32; 3]) -> u32 {
    integer_root(dot_64(vector, vector) as u64)
}

/// The scalar product, wrapping.
#[inline(always)]
#[must_use]
pub const fn dot([ax, ay, az]: [i32; 3], [bx, by, bz]: [i32; 3]) -> i32 {
    ax.wrapping_mul(bx).wrapping_add(ay.wrapping_mul(by)).wrapping_add(az.wrapping_mul(bz))
}

/// The vector product, wrapping.
#[inline(always)]
#[must_use]
pub const fn cross([ax, ay, az]: [i32; 3], [bx, by, bz]: [i32; 3]) -> [i32; 3] {
    [
        ay.wrapping_mul(bz).wrapping_sub(az.wrapping_mul(by)),
        az.wrapping_mul(bx).wrapping_sub(ax.wrapping_mul(bz)),
        ax.wrapping_mul(by).wrapping_sub(ay.wrapping_mul(bx)),
    ]
}

impl core::ops::Add for Vector {
    type Output = [i64; 3];
    fn add(self, other: Self) -> [i64; 3] {
        let ([a, b, c], [d, e, f]) = (self.0.map(i64::from), other.0.map(i64::from));
        [a + d, b + e, c + f]
    }
}
