//! How an edge cuts the pixels of a line.

use super::{depth::Depth, edge::Edge};
use crate::math::{
    reciprocal::Reciprocal,
    screen::{center, SUBPIXELS},
};

/// An edge that a surface ends at, on one line: area sampling, *Faster Phong Shading* §3.6.
///
/// A pixel is a square, the edge a straight line through all of the line's height. A steep edge cuts one pixel or two; a shallow one
/// cuts several, and the area grows linearly from one to the next: the linear modulation of that section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Silhouette {
    /// Where the edge meets the line's centre, from the left side of pixel 0, in subpixels.
    at: i32,
    /// How far it goes sideways on the line, in subpixels, and `2²⁴` of the reciprocal.
    breadth: i32,
    inverse: u32,
}

/// What lies right of a vertical edge of all pixels up to one whose right side is so far right of it, Q16.
const fn integral(right: i32) -> i32 {
    if right <= 0 {
        0
    } else if right < SUBPIXELS {
        (right * right) >> 1
    } else {
        (right << 8) - (1 << 15)
    }
}

impl Silhouette {
    /// Narrower edges count as vertical: 1/16 pixel.
    const VERTICAL: i32 = 16;
    /// Broader ones are cut off there, so that all fits 32 bits: 64 pixels.
    const BROADEST: i32 = 64 << 8;

    /// An edge that stands on the line.
    pub(crate) fn new(edge: &Edge) -> Self {
        Self::along(edge.on_line())
    }

    /// Where two surfaces cut each other between a pixel, where the left one is in front, and the next one; none if they do not.
    ///
    /// Their depths are planes, so that they cut along a straight line: where the lead of the left one ends.
    pub(crate) fn crossing([left, right]: [&Depth; 2], pixel: i32, line: u16) -> Option<Self> {
        let ([left_x, left_y], [right_x, right_y]) = (left.steps(), right.steps());
        let (x, y) = (left_x.wrapping_sub(right_x), left_y.wrapping_sub(right_y));
        let lead = left.at(pixel, line).wrapping_sub(right.at(pixel, line));
        if !left.is_known() || !right.is_known() || x >= 0 || lead < 0 || lead > x.saturating_neg() {
            return None;
        }
        let reciprocal = Reciprocal::of(x.unsigned_abs());
        let subpixels = |depth: i32| {
            let product = (i64::from(depth) * i64::from(reciprocal.mantissa)) >> (54 - reciprocal.zeros);
            product.clamp(i64::from(-Self::BROADEST), i64::from(Self::BROADEST)) as i32
        };
        Some(Self::along([center(pixel) + subpixels(lead), subpixels(y)]))
    }

    /// An edge there that goes so far to the right from line to line, in subpixels.
    fn along([at, step]: [i32; 2]) -> Self {
        let breadth = step.saturating_abs().min(Self::BROADEST);
        let inverse = if breadth > Self::VERTICAL {
            let reciprocal = Reciprocal::of(breadth as u32);
            (reciprocal.short() << 8).wrapping_shr((31 - reciprocal.zeros) as u32)
        } else {
            0
        };
        Self { at, breadth, inverse }
    }

    /// The pixels that it cuts: the first one, and the first one after.
    pub(crate) const fn pixels(&self) -> [i32; 2] {
        let half = (self.breadth + 1) >> 1;
        [(self.at - half) >> 8, (self.at + half + SUBPIXELS - 1) >> 8]
    }

    /// The share of a pixel that lies right of it, 256 for all; off by 0.02 at most.
    pub(crate) const fn right(&self, pixel: i32) -> i32 {
        let right = ((pixel + 1) << 8) - self.at;
        if self.inverse == 0 {
            return if right < 0 {
                0
            } else if right > SUBPIXELS {
                SUBPIXELS
            } else {
                right
            };
        }
        let right = right + (self.breadth >> 1);
        let area = integral(right) - integral(right - self.breadth);
        // A quarter of the product is 2³⁰ at most.
        (((area >> 2) as u32 * self.inverse) >> 22) as i32
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The share by sampling the line's height.
    fn sampled(at: f64, breadth: f64, pixel: i32) -> f64 {
        let rows = 4000;
        let x = |row: i32| at + breadth * ((f64::from(row) + 0.5) / f64::from(rows) - 0.5);
        (0..rows).map(|row| (f64::from(pixel + 1) - x(row)).clamp(0.0, 1.0)).sum::<f64>() / f64::from(rows)
    }

    #[test]
    fn the_share_is_that_of_the_area() {
        let mut worst = 0.0_f64;
        for breadth in [0, 5, 16, 17, 40, 255, 256, 257, 700, 3000, 16384] {
            for at in [-40, 0, 1, 100, 128, 255, 1000] {
                let inverse = if breadth > 16 { (1_u32 << 24) / breadth as u32 } else { 0 };
                let edge = Silhouette { at, breadth, inverse };
                let [first, end] = edge.pixels();
                for pixel in first - 1..=end {
                    let expected = sampled(f64::from(at) / 256.0, f64::from(breadth) / 256.0, pixel);
                    worst = worst.max((f64::from(edge.right(pixel)) / 256.0 - expected).abs());
                }
            }
        }
        assert!(worst < 0.02, "{worst}");
    }
}
