//! Square roots and their reciprocals, from one table: that which renormalises an interpolated normal.

use super::product::mul_high;

/// `1/√(1 − u)` in Q15 (one is 32768) for u in Q28, 0 to 63/64; below it counts as 0, beyond it gives 8.
///
/// 96 intervals up to 0.75, linear in between; beyond, by `1/√v = 2/√(4v)`. Relative error at most 5.8·10⁻⁵ up to u = 0.5 and
/// 9·10⁻⁵ from there on, RMS below 2.1·10⁻⁵.
#[inline(always)]
#[must_use]
pub fn inverse_root(u: i32) -> u32 {
    let u = (u & !(u >> 31)) as u32;
    let place = u >> SHIFT;
    match TABLE.get((place >> 8) as usize) {
        Some(entry) => (entry & 0xffff) + (((entry >> 16) * (place & 0xff)) >> 8),
        None => steep(u),
    }
}

/// The same to the nearest of 1024 places a unit: one look-up less a product, for pixels.
///
/// Relative error at most 5.2·10⁻⁴ up to u = 0.5 and 10⁻³ up to 0.75, RMS 3·10⁻⁴; none beyond that of [`inverse_root`].
#[inline(always)]
#[must_use]
pub fn near_inverse_root(u: i32) -> u32 {
    let u = (u & !(u >> 31)) as u32;
    match NEAR.get((u >> NEAR_SHIFT) as usize) {
        Some(entry) => u32::from(*entry),
        None => steep(u),
    }
}

/// The same for u from 0.75.
#[cold]
#[inline(never)]
fn steep(u: u32) -> u32 {
    const WHOLE: u32 = 1 << 28;
    let rest = WHOLE.saturating_sub(u);
    // 4v or 16v, below 1/4 … 1.
    let (rest, factor) = if rest >= WHOLE / 16 { (4 * rest, 2) } else { (16 * rest, 4) };
    if rest < WHOLE / 4 {
        return 8 * ONE;
    }
    factor * inverse_root((WHOLE - rest.min(WHOLE)) as i32)
}

/// `1/√x` as a mantissa and a power of two: `mantissa · 2^(half_zeros − 46)`.
///
/// [`inverse_root`] and one step of Newton's; relative error at most 1.1·10⁻⁸, RMS below 1.5·10⁻⁹.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ReciprocalRoot {
    /// At least 2³⁰, at most 2³¹.
    pub mantissa: u32,
    /// Half of the leading zeros of x, rounded down.
    pub half_zeros: i32,
}

impl ReciprocalRoot {
    /// The reciprocal of the root of x; 0 counts as 1.
    #[inline]
    #[must_use]
    pub fn of(x: u32) -> Self {
        let x = x.max(1);
        let half_zeros = x.leading_zeros() / 2;
        Self { mantissa: Self::mantissa(x << (2 * half_zeros)), half_zeros: half_zeros as i32 }
    }

    /// The mantissa of the reciprocal of the root of x, which has at most one leading zero: `2⁴⁶ / √x`. Others give anything.
    #[inline]
    #[must_use]
    pub fn mantissa(x: u32) -> u32 {
        let (y0, _, e) = rough(x);
        // Q15 · Q27, and half of it: Q30.
        (y0 << 15).wrapping_add_signed((y0 as i32).wrapping_mul(e.wrapping_add(2) >> 2) >> 13)
    }
}

/// The square root of a Q30 number (one is 2³⁰), Q30, rounded; from 0 up to 4.
///
/// For numbers up to one the error is at most 9·10⁻⁹, RMS below 1.4·10⁻⁹; for all at most 1.8·10⁻⁸ of the root, and half a unit.
#[inline]
#[must_use]
pub fn square_root(x: u32) -> u32 {
    if x == 0 {
        return 0;
    }
    let half_zeros = x.leading_zeros() / 2;
    let (_, root, e) = rough(x << (2 * half_zeros));
    // Q14 · Q29, and half of it: Q30. Twice that, as x is Q30; and half for every two bits by which it was shifted.
    let root = (root + (((root >> 16) * e) >> 14)) as u32 * 2;
    (root + ((1 << half_zeros) >> 1)) >> half_zeros
}

/// The integer square root of x, rounded down, bit by bit: `u64::isqrt` in a sixth of its code.
#[inline(never)]
#[must_use]
pub const fn integer_root(x: u64) -> u32 {
    let (mut root, mut rest) = (0, x);
    let mut square = 1 << 62;
    while square > x {
        square >>= 2;
    }
    while square > 0 {
        // The root so far is in twice its place: what a bit more adds to the square.
        let more = root + square;
        root >>= 1;
        if rest >= more {
            rest -= more;
            root += square;
        }
        square >>= 2;
    }
    root as u32
}

/// Of x as a fraction of 2³², 1/4 to 1: the reciprocal of its root to 13 bits, Q15; the root by that, Q30; and what their product
/// lacks of one, Q29, less than 2¹⁷. Either lacks half as much, as a part of itself.
#[inline(always)]
fn rough(x: u32) -> (u32, i32, i32) {
    let y0 = inverse_root((x.wrapping_neg() >> 4) as i32);
    let root = mul_high((x >> 1) as i32, y0);
    (y0, root, (1_i32 << 29).wrapping_sub(mul_high(root, y0)))
}

const ONE: u32 = 1 << 15;
const INTERVALS: usize = 96;
/// `u >> SHIFT` counts 256ths of intervals of 1/128 in a Q28 number.
const SHIFT: u32 = 28 - 7 - 8;

/// Rise over the interval in the high half, value at its start in the low half; Q15.
static TABLE: [u32; INTERVALS] = table();

const NEARS: usize = 8 * INTERVALS;
/// `u >> NEAR_SHIFT` counts intervals of 1/1024 in a Q28 number.
const NEAR_SHIFT: u32 = 28 - 10;

/// `1/√(1 − u)` in the middle of each interval, Q15.
static NEAR: [u16; NEARS] = near();

#[expect(clippy::indexing_slicing, reason = "evaluated by the compiler")]
const fn near() -> [u16; NEARS] {
    let mut near = [0; NEARS];
    let mut i = 0;
    while i < NEARS {
        near[i] = root_of_inverse(2 * i as u64 + 1, 2048) as u16;
        i += 1;
    }
    near
}

#[expect(clippy::indexing_slicing, reason = "evaluated by the compiler")]
const fn table() -> [u32; INTERVALS] {
    let mut table = [0; INTERVALS];
    let mut start = knot(0);
    let mut i = 0;
    while i < INTERVALS {
        let end = knot(i as u64 + 1);
        table[i] = (end - start) << 16 | start;
        start = end;
        i += 1;
    }
    table
}

const fn knot(i: u64) -> u32 {
    root_of_inverse(i, 128)
}

/// `32768/√(1 − i/whole)`, rounded.
const fn root_of_inverse(i: u64, whole: u64) -> u32 {
    // (2·32768)²·whole/(whole − i) is four times the square: the root to half a unit, then rounded.
    ((1 << 32) * whole / (whole - i)).isqrt().div_ceil(2) as u32
}
