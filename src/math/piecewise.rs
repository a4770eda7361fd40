//! Integer powers of a cosine, as parabolas in the angle.

use super::{product::mul_high, quadratic::Differences};

/// `cosⁿ` of an angle as three parabolas: Eq. 4 of *Faster Phong Shading*.
///
/// With a and b that depend on n it is `1 − θ²/(ab)` for |θ| ≤ a, `(|θ| − b)²/(b(b − a))` from there to b, and 0 beyond; value
/// and slope are continuous. Along a line on which the angle grows evenly that is two additions a pixel, and it needs no table. (a
/// and b are not to be swapped: that remark of the report is about an earlier paper.)
///
/// Errors against f64 from −90° to 90° in levels of 255, largest and RMS; the table is [`Power`](super::power::Power):
///
/// | n | [`printed`](Self::printed) | RMS | [`refit`](Self::refit) | RMS | table | RMS |
/// |---|---|---|---|---|---|---|
/// | 1 | 13.4 | 3.5 | 6.1 | 4.0 | 0.5 | 0.15 |
/// | 2 | 10.6 | 5.1 | 9.4 | 4.5 | 0.6 | 0.22 |
/// | 5 | 3.7 | 1.9 | 4.4 | 1.9 | 1.3 | 0.40 |
/// | 10 | 5.2 | 2.1 | 3.8 | 1.6 | 1.3 | 0.33 |
/// | 20 | 3.8 | 1.5 | 3.7 | 1.5 | 2.5 | 0.55 |
/// | 32 | 4.7 | 1.5 | 3.7 | 1.4 | 2.0 | 0.39 |
/// | 50 | 4.7 | 1.3 | 3.7 | 1.3 | 1.6 | 0.27 |
/// | 100 | 9.2 | 2.1 | 3.7 | 1.1 | 1.6 | 0.23 |
/// | 125 | 14.2 | 3.2 | 3.7 | 1.0 | 2.0 | 0.27 |
/// | 256 | 37.6 | 8.4 | 3.7 | 0.9 | 2.0 | 0.23 |
///
/// So the printed one does not hold up to 125, as the report has it: its largest is 5.4 for n = 5 … 50. The refit's is 3.8 for n =
/// 10 … 256.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PiecewisePower {
    /// a and b, in 2⁻³² of a circle.
    knee: u32,
    reach: u32,
    /// 2^(bits + 30)/b, where b has so many bits: more than 2³⁰, at most 2³¹.
    scale: u32,
    bits: u8,
    /// b/a and b/(b − a), Q13: half the curvatures, downwards and upwards, over an angle of b.
    dome: u16,
    flank: u16,
}

impl PiecewisePower {
    /// With a = (n + 5.6)/(n (0.09 n + 5.2)) and b = (n + 65)/(5 n + 31.7), in radians, as printed.
    ///
    /// For n = 1 … 256; 0 counts as 1, more as 256, where it is far off already.
    #[must_use]
    pub const fn printed(exponent: u16) -> Self {
        let n = match exponent {
            0 => 1,
            1..=256 => exponent as u64,
            _ => 256,
        };
        Self::new(angle(((100 * n + 560) << 31) / (n * (9 * n + 520))), angle(((10 * n + 650) << 31) / (50 * n + 317)))
    }

    /// With a = 0.755/√n · (1 + 0.65/n) and b = 2.99/√n · (1 − 0.47/n), in radians; 1.3545 and 1.6861 for n = 1.
    ///
    /// Not the report's, but at the same cost; for any n, 0 counts as 1.
    #[must_use]
    pub const fn refit(exponent: u16) -> Self {
        if exponent <= 1 {
            return Self::new(13_545 * RADIAN / 10_000, 16_861 * RADIAN / 10_000);
        }
        let n = exponent as u64;
        // 1/√n, Q31.
        let root = ((1 << 62) / n).isqrt();
        Self::new(angle(root * 755 * (100 * n + 65) / (100_000 * n)), angle(root * 299 * (100 * n - 47) / (10_000 * n)))
    }

    /// From a and b, 0 < a < b < 2³¹.
    const fn new(a: u64, b: u64) -> Self {
        let bits = 64 - b.leading_zeros();
        Self {
            knee: a as u32,
            reach: b as u32,
            scale: ((1 << (bits + 30)) / b) as u32,
            bits: bits as u8,
            dome: (((b << 13) + a / 2) / a) as u16,
            flank: (((b << 13) + (b - a) / 2) / (b - a)) as u16,
        }
    }

    /// a, to which the parabola in the middle goes, in 2⁻³² of a circle.
    #[must_use]
    pub const fn knee(&self) -> i32 {
        self.knee as i32
    }

    /// b, from which on there is nothing, in 2⁻³² of a circle.
    #[must_use]
    pub const fn reach(&self) -> i32 {
        self.reach as i32
    }

    /// The power in Q14 (one is 16384) at an angle in 2⁻³² of a circle.
    ///
    /// Three short products. At most 2.6 units beside the exact parabolas, RMS 0.65.
    #[inline]
    #[must_use]
    pub const fn at(&self, angle: i32) -> u32 {
        let distance = angle.unsigned_abs();
        if distance >= self.reach {
            return 0;
        }
        // As a part of the reach: 16 bits by 16 bits, Q16.
        let part = ((distance >> (self.bits - 16)) * (self.scale >> 15)) >> 15;
        // Q18 · Q13. The square is at most that of a/b, and 1 − a/b: the product stays below one.
        if distance <= self.knee {
            (1 << 14) - ((((part * part) >> 14) * self.dome as u32) >> 17)
        } else {
            let part = (1 << 16) - part;
            (((part * part) >> 14) * self.flank as u32) >> 17
        }
    }

    /// The power times `peak` along a line on which the angle grows by `step` a pixel, by that parabola on which `angle` lies.
    ///
    /// Values are Q30; the peak is Q14, up to one; the step is less than twice the reach. It holds for those pixels whose angles
    /// are on the same side of ±a and ±b, up to 1024 of them: at most 5.3·10⁻⁵ beside the exact parabola, RMS 8.5·10⁻⁶. On
    /// Cortex-M0+ it takes as long as [`at`](Self::at) for ten pixels.
    ///
    /// Differences as in the report's `eval`, but taken from the parabola's vertex, not from a rounded pixel.
    #[inline]
    #[must_use]
    pub const fn along(&self, angle: i32, step: i32, peak: u32) -> Differences {
        let distance = angle.unsigned_abs();
        if distance >= self.reach {
            return Differences { value: 0, step: 0, second: 0 };
        }
        let inside = distance <= self.knee;
        // Where the parabola has its vertex, how high, and half its curvature, Q13.
        let (vertex, top, half) = if inside {
            (0, peak << 16, self.dome)
        } else {
            (if angle < 0 { -self.reach() } else { self.reach() }, 0, self.flank)
        };
        let half = (half as u32).wrapping_mul(peak).wrapping_add(1 << 13) >> 14;
        // As parts of the reach, Q30; and times half the curvature, Q27.
        let (from, step) = (self.part(angle.wrapping_sub(vertex)), self.part(step));
        let (height, slope) = (mul_high(from, half), mul_high(step, half));
        let sign = if inside { -1 } else { 1 };
        Differences {
            value: product(height, from).wrapping_mul(sign).wrapping_add(top as i32),
            step: product(slope, from.wrapping_mul(2).wrapping_add(step)).wrapping_mul(sign),
            second: product(slope, step.wrapping_mul(2)).wrapping_mul(sign),
        }
    }

    /// An angle of less than twice the reach as a part of the reach, Q30.
    #[inline(always)]
    const fn part(&self, angle: i32) -> i32 {
        let bits = self.bits;
        // 30 bits and a sign.
        let angle = if bits > 30 { angle >> 1 } else { angle << (30 - bits) };
        ((angle as i64 * self.scale as i64) >> 30) as i32
    }
}

/// An angle in radians, Q31, in 2⁻³² of a circle.
const fn angle(radians: u64) -> u64 {
    (radians * RADIAN) >> 31
}

/// So much of a circle, in 2⁻³² of it, is a radian.
const RADIAN: u64 = (4_294_967_296.0 / core::f64::consts::TAU + 0.5) as u64;

/// The product of a Q27 and a Q30 number, Q30, rounded.
#[inline(always)]
const fn product(a: i32, b: i32) -> i32 {
    ((a as i64 * b as i64 + (1 << 26)) >> 27) as i32
}
