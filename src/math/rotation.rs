//! Rotations.

use super::{angle::Turn, vector::Vector};

/// A rotation in space, as the three rows of its matrix: unit vectors at right angles. (Other rows give a wrong picture.)
///
/// `a * b` turns by b first, then by a. Right-handed: a quarter turn about z takes x to y.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rotation(pub [Vector; 3]);

const ONE: i32 = 1 << 30;

impl Rotation {
    /// No turn at all.
    pub const NONE: Self = Self([Vector([ONE, 0, 0]), Vector([0, ONE, 0]), Vector([0, 0, ONE])]);

    /// A turn about the x axis: y towards z.
    #[must_use]
    pub const fn x(angle: Turn) -> Self {
        let (s, c) = angle.sin_cos();
        Self([Vector([ONE, 0, 0]), Vector([0, c, -s]), Vector([0, s, c])])
    }

    /// A turn about the y axis: z towards x.
    #[must_use]
    pub const fn y(angle: Turn) -> Self {
        let (s, c) = angle.sin_cos();
        Self([Vector([c, 0, s]), Vector([0, ONE, 0]), Vector([-s, 0, c])])
    }

    /// A turn about the z axis: x towards y.
    #[must_use]
    pub const fn z(angle: Turn) -> Self {
        let (s, c) = angle.sin_cos();
        Self([Vector([c, -s, 0]), Vector([s, c, 0]), Vector([0, 0, ONE])])
    }

    /// The rotation back.
    #[must_use]
    pub const fn inverse(self) -> Self {
        let [Vector([a, b, c]), Vector([d, e, f]), Vector([g, h, i])] = self.0;
        Self([Vector([a, d, g]), Vector([b, e, h]), Vector([c, f, i])])
    }

    /// The turned vector.
    #[inline(never)]
    #[must_use]
    pub fn turn(&self, vector: Vector) -> Vector {
        Vector(self.0.map(|row| row.dot(vector)))
    }
}

impl core::ops::Mul for Rotation {
    type Output = Self;

    #[inline(never)]
    fn mul(self, first: Self) -> Self {
        let back = first.inverse();
        Self(self.0.map(|row| back.turn(row)))
    }
}
