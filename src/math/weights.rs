//! Barycentric coordinates.

use super::vector::unit;

/// A place in a triangle as a mean of its corners: the shares of corners 0 and 1 in Q15; corner 2 has the rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Weights([u16; 2]);

impl Weights {
    /// The corners themselves.
    pub const CORNERS: [Self; 3] = [Self([1 << 15, 0]), Self([0, 1 << 15]), Self([0, 0])];

    /// From the shares of the three corners, Q15, 2¹⁵ in sum.
    #[must_use]
    pub const fn new([w0, w1, _]: [u16; 3]) -> Self {
        Self([w0, w1])
    }

    /// The shares of the three corners, Q15.
    #[must_use]
    pub const fn shares(self) -> [u16; 3] {
        let Self([w0, w1]) = self;
        [w0, w1, (1_u16 << 15).wrapping_sub(w0).wrapping_sub(w1)]
    }

    /// The place that is such a part of the way from this one to the other, Q30.
    #[must_use]
    pub fn towards(self, Self([b0, b1]): Self, part: u32) -> Self {
        let Self([a0, a1]) = self;
        let mix = |a: u16, b: u16| {
            let way = (i64::from(b) - i64::from(a)) * i64::from(part.min(1 << 30));
            (i64::from(a) + ((way + (1 << 29)) >> 30)) as u16
        };
        Self([mix(a0, b0), mix(a1, b1)])
    }

    /// The mean of what the corners have, times 2¹⁵.
    #[must_use]
    pub fn mean(self, corners: [[i16; 3]; 3]) -> [i32; 3] {
        let Self([w0, w1]) = self;
        let (w0, w1) = (i32::from(w0), i32::from(w1));
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = corners.map(|corner| corner.map(i32::from));
        [(ax, bx, cx), (ay, by, cy), (az, bz, cz)].map(|(a, b, c)| w0 * a + w1 * b + ((1 << 15) - w0 - w1) * c)
    }

    /// The mean of the corners' positions.
    #[must_use]
    pub fn position(self, corners: [[i16; 3]; 3]) -> [i16; 3] {
        self.mean(corners).map(|c| ((c + (1 << 14)) >> 15) as i16)
    }

    /// The mean of the corners' normals, Q14, renormalised.
    #[must_use]
    pub fn normal(self, corners: [[i16; 3]; 3]) -> [i16; 3] {
        unit(self.mean(corners)).map(|c| ((c + 2) >> 2) as i16)
    }

    /// The mean of points with more bits.
    #[must_use]
    pub fn point(self, corners: [[i32; 3]; 3]) -> [i32; 3] {
        let [w0, w1, w2] = self.shares().map(i64::from);
        let [[ax, ay, az], [bx, by, bz], [cx, cy, cz]] = corners.map(|corner| corner.map(i64::from));
        [(ax, bx, cx), (ay, by, cy), (az, bz, cz)].map(|(a, b, c)| ((w0 * a + w1 * b + w2 * c + (1 << 14)) >> 15) as i32)
    }
}
