//! A triangle's edge, walked line by line in integers.

use embedded_graphics::geometry::Point;

use crate::math::{
    product::mul_high,
    reciprocal::Reciprocal,
    screen::{center, is_short, SUBPIXELS},
};

/// The first pixel on or right of an edge, on one line after another; exact for the snapped corners, whatever the slope.
///
/// An integer DDA with *floor* quotient and remainder. (The course notes' DDA, §"Shading Notes", truncates, which makes
/// 44 % of the x of edges to the left wrong.)
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Edge {
    /// By how much `x` lies right of the edge, in 1/`whole` pixel; less than `whole`.
    over: u32,
    /// What a line takes from `over`, in the same unit.
    less: u32,
    /// 256 times the height of the edge, in subpixels.
    whole: u32,
    /// The first pixel whose centre lies on or right of the edge.
    pub x: i16,
    /// Floor of pixels a line.
    step: i16,
}

impl Edge {
    /// An empty edge at pixel 0.
    pub const NONE: Self = Self { over: 0, less: 0, whole: 0, x: 0, step: 0 };

    /// The edge from `top` down to `bottom`, on line `line`, which must not begin above `top`.
    #[inline]
    #[must_use]
    pub fn new(top: Point, bottom: Point, line: i32) -> Self {
        let (dx, dy) = (bottom.x - top.x, bottom.y - top.y);
        let down = center(line) - top.y;
        // From the centre of the pixel that holds the top corner, in subpixels.
        let from = top.x - center(top.x >> 8);
        if dy > 0 && is_short(dx) && is_short(dy) && is_short(down) {
            let inverse = Reciprocal::of(dy as u32);
            let (step, less) = divide(dx, dy, inverse);
            // The first pixel at or right of n/(256·dy) is minus the floor of −n/(256·dy).
            let n = -(dx * down + from * dy);
            let (minus, over) = divide(n >> 8, dy, inverse);
            Self {
                over: over << 8 | (n as u32 & 0xff),
                less: less << 8,
                whole: (dy << 8) as u32,
                x: ((top.x >> 8) - minus) as i16,
                step: step as i16,
            }
        } else {
            Self::long(top, i64::from(dx), i64::from(dy).max(1), i64::from(down), i64::from(from))
        }
    }

    /// The same for edges of 128 pixels and more, in 64 bits.
    #[cold]
    #[inline(never)]
    fn long(top: Point, dx: i64, dy: i64, down: i64, from: i64) -> Self {
        let whole = dy * i64::from(SUBPIXELS);
        let n = -(dx * down + from * dy);
        let floor = |n: i64, d: i64| (n.checked_div_euclid(d).unwrap_or(0), n.checked_rem_euclid(d).unwrap_or(0));
        let ((step, less), (minus, over)) = (floor(dx, dy), floor(n, whole));
        Self {
            over: over as u32,
            less: (less * i64::from(SUBPIXELS)) as u32,
            whole: whole as u32,
            x: (i64::from(top.x >> 8) - minus) as i16,
            step: step as i16,
        }
    }

    /// On to the next line.
    #[inline(always)]
    pub fn step(&mut self) {
        self.x = self.x.wrapping_add(self.step);
        match self.over.checked_sub(self.less) {
            Some(over) => self.over = over,
            None => {
                self.over = self.over.wrapping_sub(self.less).wrapping_add(self.whole);
                self.x = self.x.wrapping_add(1);
            }
        }
    }
}

/// Floor of `n/d` and the rest, by the reciprocal of d and a correction of at most one or two either way.
#[inline]
fn divide(n: i32, d: i32, inverse: Reciprocal) -> (i32, u32) {
    let mut quotient = mul_high(n, inverse.short()) >> (31 - inverse.zeros).clamp(0, 31);
    let mut rest = n - quotient * d;
    while rest < 0 {
        rest += d;
        quotient -= 1;
    }
    while rest >= d {
        rest -= d;
        quotient += 1;
    }
    (quotient, rest as u32)
}
