//! From a mesh's positions to the screen.

use embedded_graphics::geometry::{Point, Size};

use crate::math::{
    reciprocal::Reciprocal,
    rotation::Rotation,
    screen::{GUARD, SUBPIXELS},
    Length,
};

/// A point before the eye: right, down, forward; I12F20.
pub type Eye = [i32; 3];

/// A projected point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Projected {
    /// Place on the screen, in subpixels.
    pub point: Point,
    /// Nearness: 1/z with 23 bits at the near plane; never 0.
    pub nearness: u32,
}

/// The way of one object's positions to the screen: one matrix, one translation, one perspective.
#[derive(Clone, Copy, Debug)]
pub struct Projection {
    /// Rotation times the mantissa of the scale, cut in two so that 32-bit products do: Q14, and 14 bits more.
    high: [[i32; 3]; 3],
    low: [[i32; 3]; 3],
    /// Bits to drop from the products, Q29, for I12F20.
    drop: u32,
    translation: Eye,
    /// I12F20.
    near: i32,
    /// Bits to drop from the mantissa of 1/z for 23 bits at the near plane, were there no leading zeros.
    nearness_drop: i32,
    /// In subpixels.
    focal: u32,
    center: Point,
    size: Size,
}

impl Projection {
    /// From rotation, scale (world units for 1.0 of the mesh's positions, Q32), translation (I12F20), near plane, focal length in
    /// subpixels, and size of the picture.
    pub(super) fn new(rotation: Rotation, scale: i64, translation: [i64; 3], near: Length, focal: u32, size: Size) -> Self {
        // scale = mantissa · 2^(exponent − 32), the mantissa below one in 32 bits.
        let scale = (scale as u64).min(512 << 32);
        let zeros = scale.leading_zeros() as i32;
        let exponent = 32 - zeros;
        let mantissa = (if zeros <= 32 { scale >> (32 - zeros) } else { scale << (zeros - 32).min(31) }) as i64;
        let scaled = rotation.0.map(|row| row.0.map(|r| ((i64::from(r) * mantissa) >> 34) as i32));
        let near = near.to_bits() << 4;
        Self {
            high: scaled.map(|row| row.map(|m| m >> 14)),
            low: scaled.map(|row| row.map(|m| m & 0x3fff)),
            drop: (9 - exponent).clamp(0, 31) as u32,
            translation: translation.map(|t| t.clamp(-(1 << 30), 1 << 30) as i32),
            near,
            nearness_drop: 62 - (54 - near.leading_zeros() as i32),
            focal,
            center: Point::new(size.width as i32, size.height as i32) * (SUBPIXELS / 2),
            size,
        }
    }

    /// A position of the mesh as the eye sees it.
    #[inline]
    #[must_use]
    pub fn eye(&self, position: [i16; 3]) -> Eye {
        let [x, y, z] = position.map(i32::from);
        let [[ha, hb, hc], [la, lb, lc]] = [self.high, self.low];
        let along = |[a, b, c]: [i32; 3], [d, e, f]: [i32; 3], translation: i32| {
            // |row| ≤ 2¹⁴ and |position| ≤ √3·2¹⁵, so neither sum leaves 32 bits; rows that are none of a rotation wrap.
            let high = a.wrapping_mul(x).wrapping_add(b.wrapping_mul(y)).wrapping_add(c.wrapping_mul(z));
            let low = d * x + e * y + f * z;
            (high.wrapping_add(low >> 14) >> self.drop).saturating_add(translation)
        };
        let [tx, ty, tz] = self.translation;
        [along(ha, la, tx), along(hb, lb, ty), along(hc, lc, tz)]
    }

    /// The point on the screen; none before the near plane or outside the guard band.
    #[inline]
    #[must_use]
    pub fn screen(&self, [x, y, z]: Eye) -> Option<Projected> {
        if z < self.near {
            return None;
        }
        let inverse = Reciprocal::of(z as u32);
        let along = |d: i32| {
            let ratio = (i64::from(d) * i64::from(inverse.mantissa)) >> 24;
            let right = 38 - inverse.zeros;
            (ratio * i64::from(self.focal) + (1 << (right - 1))) >> right
        };
        let (x, y) = (along(x), along(y));
        if x.unsigned_abs() > GUARD as u64 || y.unsigned_abs() > GUARD as u64 {
            return None;
        }
        let nearness = inverse.mantissa >> (self.nearness_drop - inverse.zeros).clamp(0, 31);
        Some(Projected { point: self.center + Point::new(x as i32, y as i32), nearness: nearness.max(1) })
    }

    /// Whether a sphere around a position of the mesh, both Q15, lies wholly out of sight.
    #[must_use]
    pub fn hides(&self, center: [i16; 3], radius: u16) -> bool {
        let [x, y, z] = self.eye(center).map(i64::from);
        // Each row is as long as the scale's mantissa.
        let [[a, b, c], ..] = self.high.map(|row| row.map(i64::from));
        let mantissa = ((a * a + b * b + c * c) as u64).isqrt() as i64 + 3;
        let radius = ((mantissa * i64::from(radius)) >> self.drop) + 2;
        if z + radius < i64::from(self.near) {
            return true;
        }
        let focal = i64::from(self.focal);
        let beyond = |d: i64, half: u32| {
            let half = i64::from(half) * i64::from(SUBPIXELS) / 2;
            let slant = ((focal * focal + half * half) as u64).isqrt() as i64 + 1;
            d.abs() * focal - half * z > radius * slant
        };
        beyond(x, self.size.width) || beyond(y, self.size.height)
    }

    /// Distance of a point from a plane that bounds what can be projected, in a unit of the plane's own: the near plane first,
    /// then left, right, top and bottom of the guard band; at least 0 inside.
    #[must_use]
    pub fn inside(&self, [x, y, z]: Eye, plane: usize) -> i64 {
        let (x, y, z) = (i64::from(x), i64::from(y), i64::from(z));
        // A little less than the guard band, so that rounding does not put a cut back outside.
        let (focal, guard) = (i64::from(self.focal), i64::from(GUARD - 8) * z);
        match plane {
            0 => z - i64::from(self.near),
            1 => guard + x * focal,
            2 => guard - x * focal,
            3 => guard + y * focal,
            _ => guard - y * focal,
        }
    }

    /// Number of the planes that [`inside`](Self::inside) knows.
    pub const PLANES: usize = 5;
}
