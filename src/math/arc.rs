//! Angles from cosines and from directions: what the methods that interpolate angles start from.
//!
//! Both come from a sine of at most √½, by one table of how much longer an arc is than its sine: so small angles are exact to a few
//! millionths of themselves, not of a circle.

use super::{
    product::square,
    root::{square_root, ReciprocalRoot},
};

/// The angle from 0 to half a circle that has a cosine, in 2⁻³² of a circle; `cos` is Q30 and counts as ±1 beyond.
///
/// Error at most 8.5·10⁻⁷ of a circle (2⁻²⁰), RMS 2.0·10⁻⁷. Where |cos| > 15/16 it is at most 1.4·10⁻⁶ of the angle, or of what the
/// angle lacks of half a circle, and one unit. Half a circle itself is `i32::MAX`.
#[must_use]
pub fn arc_cosine(cos: i32) -> i32 {
    // cos a = 1 − 2 sin² a/2, and √(4 sin²) is twice the sine: Q31 for the sine.
    let sines = ONE.saturating_sub(cos.unsigned_abs()) * 2;
    let angle = times(square_root(sines), 2 * stretch(sines));
    if cos < 0 {
        (HALF - angle).min(MOST) as i32
    } else {
        angle as i32
    }
}

/// The angle of the direction (x, y) from −½ to ½ of a circle, in 2⁻³² of it, counted from the x axis towards the y axis.
///
/// Both are in any one unit; (0, 0) has the angle 0, and half a circle is `i32::MAX`. Error at most 4.3·10⁻⁷ of a circle (2⁻²¹),
/// RMS 8.2·10⁻⁸. Within 1/16 of an axis it is at most 1.3·10⁻⁶ of the angle to that axis, and one unit.
#[must_use]
pub fn arc_tangent(y: i32, x: i32) -> i32 {
    let (rise, run) = (y.unsigned_abs(), x.unsigned_abs());
    let (short, long) = (rise.min(run), rise.max(run));
    if long == 0 {
        return 0;
    }
    // As parts of 2³², the longer from a half.
    let zeros = long.leading_zeros();
    let (short, long) = (short << zeros, long << zeros);
    // Their length squared, Q30, from 1/4 to 2; or a quarter of it from there on, as a fraction of 2³².
    let length = square(short >> 2) + square(long >> 2);
    let wide = length >> 30;
    let over_length = ReciprocalRoot::mantissa(length << (2 - 2 * wide)) >> wide;
    // Q32 · Q30: the sine in Q31.
    let sine = ((u64::from(short) * u64::from(over_length)) >> 31) as u32;
    let angle = times(sine, stretch(square(sine >> 1) << 2));
    let angle = if rise > run { QUARTER - angle } else { angle };
    let angle = if x < 0 { HALF - angle } else { angle };
    let angle = angle.min(MOST) as i32;
    if y < 0 {
        -angle
    } else {
        angle
    }
}

/// One, Q30.
const ONE: u32 = 1 << 30;
const QUARTER: u32 = 1 << 30;
const HALF: u32 = 1 << 31;
const MOST: u32 = i32::MAX as u32;

/// The upper half of a product.
#[inline(always)]
fn times(a: u32, b: u32) -> u32 {
    ((u64::from(a) * u64::from(b)) >> 32) as u32
}

/// `arcsin s / s` for an s given by 2s² in Q31, up to one; in 2⁻³² of half a circle.
///
/// 64 intervals, linear in between.
#[inline(always)]
fn stretch(square: u32) -> u32 {
    match TABLE.get((square >> 25) as usize..) {
        Some([start, end, ..]) => start + (((end - start) * ((square >> 15) & 0x3ff)) >> 10),
        _ => TABLE[INTERVALS],
    }
}

const INTERVALS: usize = 64;

static TABLE: [u32; INTERVALS + 1] = table();

#[expect(clippy::indexing_slicing, reason = "evaluated by the compiler")]
const fn table() -> [u32; INTERVALS + 1] {
    const OVER_PI: u64 = (core::f64::consts::FRAC_1_PI * (1u64 << 32) as f64) as u64;
    let mut table = [0; INTERVALS + 1];
    let mut i = 0;
    while i <= INTERVALS {
        // 1 + s²/6 + …: a term is the one before by (2k − 1)² s² / (2k (2k + 1)), less than half.
        let (mut sum, mut term, mut k) = (0, 1u64 << 40, 1);
        while term > 0 {
            sum += term;
            term = term * (2 * k - 1) * (2 * k - 1) * i as u64 / (2 * k * (2 * k + 1) * 2 * INTERVALS as u64);
            k += 1;
        }
        table[i] = (((sum >> 8) * OVER_PI) >> 32) as u32;
        i += 1;
    }
    table
}
