//! Barycentric coordinates.

/// A place in a triangle as a mean of its corners: the shares of corners 0 and 1 in Q15; corner 2 has the rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Weights([u16; 2]);

impl Weights {
    /// The corners themselves.
    pub const CORNERS: [Self; 3] = [Self([1 << 15, 0]), Self([0, 1 << 15]), Self([0, 0])];

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
}
