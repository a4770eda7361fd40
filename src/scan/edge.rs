//! A triangle's edge, walked line by line in integers.

use super::vertex::Vertex;
use crate::math::{
    quotient::quotient,
    reciprocal::rough,
    screen::{center, SUBPIXELS},
};

/// The first pixel on or right of an edge, on one line after another; exact for the snapped corners, whatever the slope.
///
/// A DDA in 1/2⁴⁸ pixel. An edge of height `dy` meets the centres of lines at multiples of 1/(256·dy) pixel. What rounding
/// takes from `at` is more than nothing and, all lines together, at most one such part: so it is always the right pixel.
///
/// Numbers of 64 bits are read word by word; so an edge takes no more room than its words do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(Rust, packed(4))]
pub struct Edge {
    /// One pixel right of the edge, counted from the centre of pixel 0, in 1/2⁴⁸ pixel, rounded down.
    at: i64,
    /// Its increase a line, rounded down.
    step: i64,
}

impl Edge {
    /// An empty edge at pixel 0.
    pub const NONE: Self = Self { at: 0, step: 0 };

    /// Becomes the edge from `top` down to `bottom`, on line `line`, which must not begin above `top`; if it ends above the line's
    /// centre, stays what it is.
    #[inline(never)]
    pub fn set<const LIGHTS: usize>(&mut self, top: &Vertex<LIGHTS>, bottom: &Vertex<LIGHTS>, line: i32) {
        let (top, bottom) = (top.point(), bottom.point());
        let (dx, dy, down) = (bottom.x - top.x, bottom.y - top.y, center(line).wrapping_sub(top.y));
        if down >= dy {
            return;
        }
        if is_long(dx, dy, down) {
            return self.set_long(top.x, dx, dy, down);
        }
        let (whole, [high, low]) = divide(dx, dy as u32);
        let down = down as u32;
        // Subpixels, and 1/2¹⁶ of them: up to 2⁻²⁴ pixel too small. On fewer than 128 lines, `step` takes no more than that.
        let x = top.x + whole * down as i32 + SUBPIXELS / 2;
        let part = high * down + ((low * down) >> 16);
        self.at = (i64::from(x) << 40).wrapping_add(i64::from(part) << 24).wrapping_sub(1);
        self.step = (i64::from((whole << 16) + high as i32) << 32) + (i64::from(low) << 16);
    }

    /// The same for edges of 128 pixels and more, in 64 bits.
    #[cold]
    #[inline(never)]
    fn set_long(&mut self, x: i32, dx: i32, dy: i32, down: i32) {
        let dy = dy.max(1);
        let (whole, rest) = (dx.div_euclid(dy), dx.rem_euclid(dy));
        // In 1/2⁴⁰, so that `at` stays exact for all heights below 2²⁰.
        let part = quotient((rest as u64) << 40, dy as u64) as i64;
        let (whole, down) = (i64::from(whole), i64::from(down));
        let x = i64::from(x + SUBPIXELS / 2) + whole * down;
        self.at = (x << 40).wrapping_add(part.wrapping_mul(down)).wrapping_sub(1);
        self.step = (whole << 48) + (part << 8);
    }

    /// Whether [`set`](Self::set) takes 64 bits.
    pub(crate) fn is_long<const LIGHTS: usize>(top: &Vertex<LIGHTS>, bottom: &Vertex<LIGHTS>, line: i32) -> bool {
        let (top, bottom) = (top.point(), bottom.point());
        is_long(bottom.x - top.x, bottom.y - top.y, center(line) - top.y)
    }

    /// Becomes an edge that all pixels lie left of, or all right.
    #[inline(always)]
    pub(crate) const fn set_beyond(&mut self, is_rightmost: bool) {
        self.at = if is_rightmost { i64::MAX } else { i64::MIN };
        self.step = 0;
    }

    /// The first pixel whose centre lies on or right of the edge.
    #[inline(always)]
    #[must_use]
    pub const fn x(&self) -> i16 {
        (self.at >> 48) as i16
    }

    /// Where it meets the line's centre, from the left side of pixel 0, and its increase a line; both in subpixels.
    pub(crate) const fn on_line(&self) -> [i32; 2] {
        [((self.at >> 40) as i32).wrapping_sub(SUBPIXELS / 2), (self.step >> 40) as i32]
    }

    /// Whether it is the other one on this line, as far as the grid can tell.
    pub(crate) const fn is_near(&self, other: &Self) -> bool {
        let ([x, step], [other_x, other_step]) = (self.on_line(), other.on_line());
        x.abs_diff(other_x) <= 1 && step.abs_diff(other_step) <= 1
    }

    /// On to the next line.
    #[inline(always)]
    pub fn step(&mut self) {
        self.at = self.at.wrapping_add(self.step);
    }

    /// Back to the line before.
    #[inline(always)]
    pub fn step_back(&mut self) {
        self.at = self.at.wrapping_sub(self.step);
    }
}

/// Whether a height and a width, or a place on the edge, are 128 pixels and more: below that all of it fits 32 bits.
#[inline(always)]
const fn is_long(dx: i32, dy: i32, down: i32) -> bool {
    ((dx + (1 << 15)) as u32 >> 16) | (dy as u32 >> 15) | (down as u32 >> 15) != 0
}

/// What makes bit 14 the highest one of a number of 15 bits, 0 counting as 1, by a product; looked up, as Cortex-M0+ would have to
/// call a function for an instruction that it lacks.
#[inline(always)]
fn power(d: u32) -> u32 {
    static POWERS: [u8; 256] = {
        let mut powers = [0; 256];
        let mut i = 1_u32;
        while i < 256 {
            #[expect(clippy::indexing_slicing, reason = "i < 256, evaluated by the compiler")]
            {
                powers[i as usize] = (1 << (i << 7).leading_zeros() >> 17) as u8;
            }
            i += 1;
        }
        powers
    };
    match d >> 7 {
        0 => small(d),
        high => POWERS.get(usize::from(high as u8)).map_or(0, |power| u32::from(*power)),
    }
}

/// The same for edges less than half a pixel high.
#[cold]
#[inline(never)]
const fn small(d: u32) -> u32 {
    1 << (d | 1).leading_zeros() >> 17
}

/// Floor of `n/d`, and two more digits of 16 bits, in all less than 2/2³² too small; n in 16 bits, d in 15, 0 giving anything.
#[inline]
fn divide(n: i32, d: u32) -> (i32, [u32; 2]) {
    let power = power(d);
    let divisor = d.wrapping_mul(power);
    let inverse = rough(divisor);
    let mut quotient = (n.wrapping_mul((inverse >> 2) as i32) >> 16).wrapping_mul(power as i32) >> 14;
    let mut rest = n.wrapping_sub(quotient.wrapping_mul(d as i32)) as u32;
    if rest >= d {
        // One too small or one too large.
        if rest as i32 > 0 {
            quotient += 1;
            rest = rest.wrapping_sub(d);
        } else {
            quotient -= 1;
            rest = rest.wrapping_add(d);
        }
    }
    let rest = rest.wrapping_mul(power);
    let mut high = rest.wrapping_mul(inverse) >> 16;
    let mut rest = (rest << 16).wrapping_sub(high.wrapping_mul(divisor));
    if rest >= divisor {
        rest -= divisor;
        high += 1;
    }
    (quotient, [high, rest.wrapping_mul(inverse) >> 16])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::projection::Projected;
    use embedded_graphics::geometry::Point;

    fn vertex(x: i32, y: i32) -> Vertex<1> {
        Vertex::new(Some(Projected { point: Point::new(x, y), nearness: 1 }), [[0; 2]])
    }

    /// On all lines of an edge, from the first or from a later one, up to `most`.
    fn check(top: [i32; 2], bottom: [i32; 2], most: i32) {
        let ([tx, ty], [bx, by]) = (top, bottom);
        let (first, end) = (crate::math::screen::first_at(ty), crate::math::screen::first_at(by));
        for from in [first, first + (end - first) / 3] {
            if from >= end {
                continue;
            }
            let mut edge = Edge::NONE;
            edge.set(&vertex(tx, ty), &vertex(bx, by), from);
            for line in from..end.min(from + most) {
                let (dx, dy) = (i64::from(bx - tx), i64::from(by - ty));
                let n = dx * i64::from(center(line) - ty) + i64::from(tx - 128) * dy;
                let exact = -(-n).div_euclid(256 * dy);
                assert_eq!(i64::from(edge.x()), exact, "{top:?} {bottom:?} from {from} on {line}");
                edge.step();
            }
        }
    }

    #[test]
    fn x_is_exact() {
        let mut state = 1_u32;
        let mut random = |bits: u32| {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            (state >> 8) as i32 % (1 << bits) - (1 << bits >> 1)
        };
        for _ in 0..20_000 {
            for bits in [8, 11, 13, 15, 16, 17, 20] {
                let (top, bottom) = ([random(bits), random(bits)], [random(bits), random(bits)]);
                let [[_, a], [_, b]] = [top, bottom];
                if a < b {
                    check(top, bottom, 1024);
                }
            }
        }
    }

    #[test]
    fn x_is_exact_where_it_is_hardest() {
        // The largest heights in either number of bits, with the steepest and the flattest slopes.
        for dy in [(1 << 15) - 1, 1 << 15, (1 << 15) + 1, (1 << 20) - 1] {
            for d in [1, 2, 3, 127, 128, 32_766, 32_767] {
                for ty in -130..130 {
                    let ty = if dy > 1 << 19 { -(1 << 19) } else { ty };
                    for dx in [d, -d, dy - d, d - dy] {
                        check([-dx / 2, ty], [dx - dx / 2, ty + dy], 4096);
                    }
                }
            }
        }
    }

    #[test]
    fn any_corners_and_lines_will_do() {
        let far = (1 << 19) - 1;
        for ty in [-far, -1, 0, 1, 128, 255, 32_767, far] {
            for by in [-far, -1, 0, 1, 130, 255, 32_767, far] {
                for x in [-far, -32_768, 0, 1, 383, 32_767, far] {
                    for line in [0, 1, 2, 127, 1023, 0xffff, i32::MAX] {
                        let mut edge = Edge::NONE;
                        edge.set(&vertex(383, ty), &vertex(383 + x, by), line);
                        edge.step();
                    }
                }
            }
        }
    }

    #[test]
    fn a_quotient_is_never_too_large() {
        for d in (1..1_u32 << 15).filter(|d| d % 97 < 2 || *d > 32_700) {
            for n in (-(1 << 15)..1 << 15).step_by(7) {
                let (whole, [high, low]) = divide(n, d);
                assert_eq!(whole, n.div_euclid(d as i32), "{n}/{d}");
                let digits = u64::from(high) << 16 | u64::from(low);
                let rest = (u64::from(n.rem_euclid(d as i32) as u32) << 32).checked_sub(digits * u64::from(d));
                assert!(rest.is_some_and(|rest| rest < 2 * u64::from(d)), "{n}/{d}");
            }
        }
    }
}
