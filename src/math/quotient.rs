//! Quotients of 64 bits.
//!
//! No processor that this is made for has an instruction for them, and the compiler's library takes four times the code.

/// `n / d`, rounded down, bit by bit; 0 for d = 0.
#[inline(never)]
#[must_use]
pub const fn quotient(n: u64, d: u64) -> u64 {
    if d == 0 {
        return 0;
    }
    let (mut part, mut bit) = (d, 1);
    while part <= n >> 1 {
        part <<= 1;
        bit <<= 1;
    }
    let (mut rest, mut quotient) = (n, 0);
    while bit > 0 {
        if rest >= part {
            rest -= part;
            quotient |= bit;
        }
        part >>= 1;
        bit >>= 1;
    }
    quotient
}

/// `n / d` in Q30, rounded down, for n ≤ d and 0 < d < 2³¹.
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
pub const fn floor(n: i64, d: u64) -> i64 {
    // Below 0, what is left of the way from −1 on.
    let sign = n >> 63;
    quotient((n ^ sign) as u64, d) as i64 ^ sign
}
