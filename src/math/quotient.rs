//! Quotients of 64 bits.
//!
//! No processor that this is made for has an instruction for them, and the compiler's library takes several times the code.

use super::reciprocal::Reciprocal;

/// `n / d`, rounded down; 0 for d = 0.
#[inline(never)]
#[must_use]
pub fn quotient(n: u64, d: u64) -> u64 {
    if d < 2 {
        return n.wrapping_mul(d);
    }
    let zeros = d.leading_zeros();
    // 2⁹⁴ over d without its leading zeros: not too large, and too small by less than a part in 2²⁰.
    let inverse = Reciprocal::mantissa(((d << zeros) >> 32) as u32) - (1 << 9);
    let (mut rest, mut quotient) = (n, 0);
    // Each round finds 20 bits, or the last one.
    while rest >= d {
        let fewer = rest.leading_zeros();
        let most = ((rest << fewer) >> 32) * u64::from(inverse);
        let part = (most >> (62 + fewer - zeros)).max(1);
        rest -= part * d;
        quotient += part;
    }
    quotient
}

/// `n / d` in Q30, rounded down, for n ≤ d and 0 < d < 2³¹; bit by bit.
#[inline(never)]
#[must_use]
pub const fn fraction(n: u32, d: u32) -> u32 {
    let (mut rest, mut fraction) = (n, 0);
    let mut bit = 1 << 30;
    while bit > 0 {
        if rest >= d {
            rest -= d;
            fraction |= bit;
        }
        rest <<= 1;
        bit >>= 1;
    }
    fraction
}

/// `n / d`, rounded down; 0 or −1 for d = 0, as if it had no end.
#[must_use]
pub fn floor(n: i64, d: u64) -> i64 {
    // Below 0, what is left of the way from −1 on.
    let sign = n >> 63;
    quotient((n ^ sign) as u64, d) as i64 ^ sign
}
