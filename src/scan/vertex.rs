//! Projected vertices.

use embedded_graphics::geometry::Point;

use crate::model::projection::Projected;

/// A vertex as a frame holds it: 8 bytes of place and nearness, 4 for each light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vertex<const LIGHTS: usize> {
    /// x in the upper 20 bits, the upper half of the nearness in the lower 12.
    x: u32,
    /// The same with y and the lower half.
    y: u32,
    /// For each light `[intensity · n·l, n·h]`, Q14.
    pub dots: [[i16; 2]; LIGHTS],
}

impl<const LIGHTS: usize> Vertex<LIGHTS> {
    /// A vertex there; or, for none, one that triangles must be clipped for.
    #[inline]
    #[must_use]
    pub const fn new(projected: Option<Projected>, dots: [[i16; 2]; LIGHTS]) -> Self {
        match projected {
            Some(Projected { point, nearness }) => {
                Self { x: ((point.x as u32) << 12) | (nearness >> 12), y: ((point.y as u32) << 12) | (nearness & 0xfff), dots }
            }
            None => Self { x: 0, y: 0, dots },
        }
    }

    /// Place on the screen, in subpixels.
    #[inline(always)]
    #[must_use]
    pub const fn point(&self) -> Point {
        Point::new(self.x as i32 >> 12, self.y as i32 >> 12)
    }

    /// 1/z with 23 bits at the near plane; 0 for a vertex that could not be projected.
    #[inline(always)]
    #[must_use]
    pub const fn nearness(&self) -> u32 {
        ((self.x & 0xfff) << 12) | (self.y & 0xfff)
    }
}
