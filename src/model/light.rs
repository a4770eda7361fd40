//! Lights.

use crate::math::{rotation::Rotation, vector::Vector};

/// A directional light of white colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Light {
    /// Unit vector towards the light, in the world; the null vector for a light that is off.
    direction: Vector,
    /// Q15.
    intensity: u16,
}

impl Light {
    /// A light of full intensity from that direction: (x, y, z) points towards the light and need not be normalised.
    /// The null vector makes a light that is off.
    #[must_use]
    pub fn directional(towards: [f32; 3]) -> Self {
        match Vector::unit_f32(towards) {
            Some(direction) => Self { direction, intensity: 1 << 15 },
            None => Self::OFF,
        }
    }

    /// No light.
    pub const OFF: Self = Self { direction: Vector([0; 3]), intensity: 0 };

    /// The same with another intensity, 0.0 to 1.0, clamped.
    #[must_use]
    pub const fn intensity(mut self, intensity: f32) -> Self {
        let scaled = (intensity * 32768.0 + 0.5) as u16;
        self.intensity = if scaled > 1 << 15 { 1 << 15 } else { scaled };
        self
    }

    /// The intensity in Q15.
    #[must_use]
    pub const fn strength(&self) -> u16 {
        self.intensity
    }

    /// Light and half vector in the space of an object, for a viewer at infinity.
    ///
    /// `viewer` is the unit vector to the viewer, in the world; h = (l + v)/|l + v| (*Faster Phong Shading*, Eq. 1).
    #[must_use]
    pub fn aim(&self, viewer: Vector, object: Rotation) -> Aim {
        let half = if self.intensity == 0 { None } else { Vector::unit(self.direction + viewer) };
        let back = object.inverse();
        // Q30 · Q15 to Q16.
        let short = |vector: Vector, factor: u16| {
            back.turn(vector).0.map(|c| ((i64::from(c) * i64::from(factor) + (1 << 28)) >> 29) as i32)
        };
        Aim { light: short(self.direction, self.intensity), half: half.map_or([0; 3], |half| short(half, 1 << 15)) }
    }
}

/// A light as an object's vertices see it: two directions in the object's space, Q16.
#[derive(Clone, Copy, Debug)]
pub struct Aim {
    /// As long as the light is intense.
    light: [i32; 3],
    half: [i32; 3],
}

impl Aim {
    /// `[intensity · n·l, n·h]` in Q14 for a normal in Q14.
    #[inline]
    #[must_use]
    pub fn dots(&self, normal: [i16; 3]) -> [i16; 2] {
        // Q14 · Q16 = Q30; each sum is at most √3 of that.
        let dot = |[x, y, z]: [i32; 3]| {
            let [nx, ny, nz] = normal.map(i32::from);
            x.wrapping_mul(nx).wrapping_add(y.wrapping_mul(ny)).wrapping_add(z.wrapping_mul(nz))
        };
        let round = |product: i32| (product.wrapping_add(1 << 15) >> 16) as i16;
        [round(dot(self.light)), round(dot(self.half))]
    }
}
