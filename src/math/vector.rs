//! Directions.

use super::{product::scale, root::inverse_root};

/// A vector with Q30 components (one is 2³⁰), each from −2 to 2.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Vector(pub [i32; 3]);

impl Vector {
    /// The unit vector in the direction of (x, y, z), in any one unit; none for the null vector.
    ///
    /// Relative error of each component below 2⁻²⁸ where the largest exceeds 2⁻⁸ in its unit.
    #[must_use]
    pub fn unit(components: [i64; 3]) -> Option<Self> {
        let largest = components.iter().fold(0, |largest: u64, c| largest.max(c.unsigned_abs()));
        // Bring the largest to 30 bits: the sum of squares then fits 62.
        let up = largest.leading_zeros() as i32 - 34;
        let [x, y, z] = components.map(|c| if up >= 0 { c << up } else { c >> -up });
        let length = ((x * x + y * y + z * z) as u64).isqrt() as i64;
        let [x, y, z] = [x, y, z].map(|c| (c << 30).checked_div(length).map(|q| q as i32));
        Some(Self([x?, y?, z?]))
    }

    /// The unit vector in the direction of (x, y, z); none for the null vector. NaN counts as 0.
    #[must_use]
    pub fn unit_f32(components: [f32; 3]) -> Option<Self> {
        Self::unit(components.map(|c| (c * 4_294_967_296.0) as i64))
    }

    /// The scalar product, Q30; wraps beyond ±2.
    #[must_use]
    pub fn dot(self, other: Self) -> i32 {
        let ([a, b, c], [d, e, f]) = (self.0.map(i64::from), other.0.map(i64::from));
        ((a * d + b * e + c * f + (1 << 29)) >> 30) as i32
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

impl core::ops::Add for Vector {
    type Output = [i64; 3];
    fn add(self, other: Self) -> [i64; 3] {
        let ([a, b, c], [d, e, f]) = (self.0.map(i64::from), other.0.map(i64::from));
        [a + d, b + e, c + f]
    }
}
