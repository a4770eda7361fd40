//! Values that run over a triangle on the screen.

use core::fmt::Debug;

use super::{
    gradient::Gradient,
    product::scale,
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

    /// Along line y of the picture, from pixel x on.
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
    /// At pixel (0, 0).
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

impl Plane {
    /// The plane through values at the corners, of at most 15 bits and a sign, so many bits finer than these; the same
    /// everywhere, their mean, for a triangle that has no gradient.
    #[inline]
    #[must_use]
    pub fn new(gradient: Option<&Gradient>, [v0, v1, v2]: [i32; 3], finer: i32) -> Self {
        let [at, x, y] = match gradient {
            Some(gradient) => gradient.linear(v0, v1 - v0, v2 - v0, finer),
            None => [scale(((v0 + v1 + v2) << 8) / 3, finer - 8), 0, 0],
        };
        Self { at, x, y }
    }
}

/// Linear between the corners: ten bits finer than the values there.
impl Interpolant for Plane {
    type Steps = Slope;
    const FINER: i32 = 10;
    const ZERO: Self = Self { at: 0, x: 0, y: 0 };

    #[inline]
    fn through(gradient: Option<&Gradient>, corners: [i32; 3], _: [i32; 3]) -> Self {
        Self::new(gradient, corners, Self::FINER)
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
        Self::through_six(gradient, corners, middles, Self::FINER)
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
