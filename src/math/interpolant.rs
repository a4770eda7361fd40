//! Values that run over a triangle on the screen.

use core::fmt::Debug;

use super::{
    gradient::Gradient,
    quadratic::{Differences, Quadratic},
};

/// A value given at a triangle's corners and in the middles of its edges, and by what curve it runs in between.
pub trait Interpolant: Copy + Debug {
    /// The value along a line of the screen.
    type Steps: Steps;

    /// Bits that it has below those of the values that it was made of.
    const FINER: i32;
    /// Zero everywhere.
    const ZERO: Self;

    /// The interpolant of values with at most 15 bits and a sign: at corners 0, 1, 2, and in the middles of edges 01, 12, 20 as
    /// far as it makes use of these; the same everywhere, their mean, for a triangle that has no gradient.
    fn through(gradient: Option<&Gradient>, corners: [i32; 3], middles: [i32; 3]) -> Self;

    /// Along line y, from pixel x on, both counted from the triangle's [anchor](Gradient::anchor).
    fn along(&self, x: i32, y: i32) -> Self::Steps;
}

/// A value from pixel to pixel.
pub trait Steps: Copy + Debug {
    /// The value at this pixel, and on to the next one.
    fn next(&mut self) -> i32;
}

/// A value that is linear on the screen, wrapping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Plane {
    /// At the anchor.
    pub at: i32,
    /// Its increase for a pixel to the right.
    pub x: i32,
    /// Its increase for a pixel down.
    pub y: i32,
}

/// A linear value along a line: one addition a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Slope {
    /// The value at this pixel.
    pub value: i32,
    /// What it increases by to the next one.
    pub step: i32,
}

/// Linear between the corners: ten bits finer than the values there.
impl Interpolant for Plane {
    type Steps = Slope;
    const FINER: i32 = 10;
    const ZERO: Self = Self { at: 0, x: 0, y: 0 };

    #[inline]
    fn through(gradient: Option<&Gradient>, [v0, v1, v2]: [i32; 3], _: [i32; 3]) -> Self {
        let [at, x, y] = match gradient {
            Some(gradient) => gradient.linear(v0, v1 - v0, v2 - v0, Self::FINER),
            None => [((v0 + v1 + v2) << Self::FINER) / 3, 0, 0],
        };
        Self { at, x, y }
    }

    #[inline(always)]
    fn along(&self, x: i32, y: i32) -> Slope {
        let value = self.at.wrapping_add(self.x.wrapping_mul(x)).wrapping_add(self.y.wrapping_mul(y));
        Slope { value, step: self.x }
    }
}

impl Steps for Slope {
    #[inline(always)]
    fn next(&mut self) -> i32 {
        let value = self.value;
        self.value = value.wrapping_add(self.step);
        value
    }
}

/// Quadratic through the six values, 14 bits finer than these; linear on triangles too thin for that.
impl Interpolant for Quadratic {
    type Steps = Differences;
    const FINER: i32 = 14;
    const ZERO: Self = Self::ZERO;

    #[inline]
    fn through(gradient: Option<&Gradient>, corners: [i32; 3], middles: [i32; 3]) -> Self {
        let [v0, v1, v2] = corners;
        let [m01, m12, m20] = middles;
        let Some(gradient) = gradient else {
            // The centroid's share of the corners is −1/9, that of the middles 4/9.
            return Self { at: (((4 * (m01 + m12 + m20) - (v0 + v1 + v2)) << 10) / 9) << 4, ..Self::ZERO };
        };
        let mut bows = [4 * m01 - 2 * (v0 + v1), 4 * m12 - 2 * (v1 + v2), 4 * m20 - 2 * (v2 + v0)];
        let [mut v0, mut v1, mut v2] = corners;
        let mut finer = Self::FINER;
        // Thirteen bits for the largest.
        while bows.iter().any(|bow| bow.unsigned_abs() >= 1 << 13) {
            bows = bows.map(|bow| bow >> 1);
            [v0, v1, v2] = [v0 >> 1, v1 >> 1, v2 >> 1];
            finer += 1;
        }
        if 2 * gradient.exponent + finer > Self::MOST {
            let [at, x, y] = gradient.linear(v0, v1 - v0, v2 - v0, finer);
            return Self { at, x, y, ..Self::ZERO };
        }
        Self::new(gradient, [v0, v1, v2], bows, finer)
    }

    #[inline(always)]
    fn along(&self, x: i32, y: i32) -> Differences {
        self.along(x, y)
    }
}

impl Steps for Differences {
    #[inline(always)]
    fn next(&mut self) -> i32 {
        self.next()
    }
}
