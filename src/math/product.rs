//! Products wider than 32 bits, by 32-bit multiplications alone.
//!
//! Cortex-M0+ multiplies 32 × 32 → 32 in one cycle; a 64-bit product is a library call.

/// `a · b / 2¹⁶`, rounded down; exact for b ≤ 65536, whatever a.
#[inline(always)]
#[must_use]
pub const fn mul_high(a: i32, b: u32) -> i32 {
    let low = (((a & 0xffff) as u32).wrapping_mul(b) >> 16) as i32;
    (a >> 16).wrapping_mul(b as i32).wrapping_add(low)
}

/// `a · 2^shift`, rounded to nearest where bits are lost, wrapping where they overflow.
#[inline(always)]
#[must_use]
pub const fn scale(a: i32, shift: i32) -> i32 {
    if shift >= 0 {
        if shift > 31 {
            0
        } else {
            a.wrapping_shl(shift as u32)
        }
    } else if shift < -31 {
        0
    } else {
        (a >> -shift) + ((a >> (-shift - 1)) & 1)
    }
}

/// The square of a Q30 number up to one, Q30, rounded down or one less.
#[inline(always)]
#[must_use]
pub const fn square(x: u32) -> u32 {
    let (high, low) = (x >> 15, x & 0x7fff);
    high.wrapping_mul(high).wrapping_add(high.wrapping_mul(low) >> 14)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn mul_high_is_the_exact_floor() {
        for a in [i32::MIN, -1_000_003, -1, 0, 1, 77_777, i32::MAX] {
            for b in [0u32, 1, 32_768, 65_535, 65_536] {
                assert_eq!(i64::from(mul_high(a, b)), (i64::from(a) * i64::from(b)) >> 16, "{a} {b}");
            }
        }
    }

    #[test]
    fn square_is_rarely_less_than_the_floor() {
        for x in [0, 1, 32_767, 32_768, 1_000_003, 777_777_777, (1 << 30) - 1, 1 << 30] {
            let exact = ((u64::from(x) * u64::from(x)) >> 30) as u32;
            assert!(exact - square(x) <= 1, "{x}");
        }
        assert_eq!(square(1 << 30), 1 << 30);
    }

    #[test]
    fn scale_rounds_to_nearest() {
        assert_eq!([scale(5, -1), scale(4, -2), scale(-5, -1), scale(3, 4)], [3, 1, -2, 48]);
        assert_eq!([scale(i32::MAX, -40), scale(1, 40), scale(i32::MAX, -31)], [0, 0, 1]);
    }
}
