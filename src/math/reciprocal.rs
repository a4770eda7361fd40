//! Reciprocals without division.

/// `1/x` as a mantissa and a power of two: `mantissa · 2^(zeros − 62)`.
///
/// A table of 256 seeds and three 32-bit products; relative error at most 1.4·10⁻⁷, RMS below 4·10⁻⁸.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Reciprocal {
    /// More than 2³⁰, at most 2³¹.
    pub mantissa: u32,
    /// Leading zeros of x.
    pub zeros: i32,
}

impl Reciprocal {
    /// The reciprocal of x; 0 counts as 1.
    #[inline]
    #[must_use]
    pub fn of(x: u32) -> Self {
        let x = x.max(1);
        let zeros = x.leading_zeros();
        Self { mantissa: Self::mantissa(x << zeros), zeros: zeros as i32 }
    }

    /// The mantissa of the reciprocal of x, which has no leading zeros: `2⁶² / x`.
    #[inline]
    #[must_use]
    pub fn mantissa(x: u32) -> u32 {
        let x24 = x >> 8;
        // y0 = 2³²/x24 to nine bits, so that 2³² − x24·y0 is exact in 32 bits: 2³² times the relative error.
        let y0 = 256 + u32::from(SEEDS.get((x24 >> 15) as usize & 0xff).copied().unwrap_or(0));
        let e = (x24.wrapping_mul(y0).wrapping_neg() as i32) >> 8;
        // 1/(1 − ε) = 1 + ε + ε² and so on, ε in Q24.
        let e = e + ((e.wrapping_mul(e) as u32) >> 24) as i32;
        (y0 << 22).wrapping_add_signed((y0 as i32 * e) >> 2)
    }

    /// The mantissa to 16 bits: `1/x ≈ short · 2^(zeros − 47)`, 32768 to 65536, relative error at most 1.6·10⁻⁵.
    #[inline]
    #[must_use]
    pub const fn short(self) -> u32 {
        (self.mantissa + (1 << 14)) >> 15
    }
}

/// `2³²/x` for 2¹⁴ ≤ x < 2¹⁵, to 18 bits: never too large, relative error at most 1.5·10⁻⁵.
#[inline(always)]
#[must_use]
pub fn rough(x: u32) -> u32 {
    // 2²³/x to nine bits, and 2²³ times its relative error.
    let y0 = 256 + u32::from(SEEDS.get((x >> 6) as usize & 0xff).copied().unwrap_or(0));
    let e = (1 << 23) - x.wrapping_mul(y0) as i32;
    (y0 << 9).wrapping_add_signed((y0 as i32).wrapping_mul(e) >> 14)
}

/// `2³² / x24 − 256` in the middle of each of 256 equal intervals of `2²³ ≤ x24 < 2²⁴`.
static SEEDS: [u8; 256] = seeds();

#[expect(clippy::indexing_slicing, reason = "evaluated by the compiler")]
const fn seeds() -> [u8; 256] {
    let mut seeds = [0; 256];
    let mut i = 0;
    while i < 256 {
        let twice_middle = 513 + 2 * i as u32;
        seeds[i] = (((1 << 18) + twice_middle / 2) / twice_middle - 256) as u8;
        i += 1;
    }
    seeds
}
