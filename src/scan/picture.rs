//! A frame as the scanner sees it.

use embedded_graphics::primitives::Rectangle;

use super::{bucket::TriangleId, geometry::Geometry, triangle::Triangle, vertex::Vertex};
use crate::model::{
    light::{Light, LightSource},
    material::Color,
};

/// What fills a line where no triangle is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Background {
    /// One colour.
    Plain(Color),
    /// From one colour on the first line to another on the last.
    Gradient {
        /// On the first line.
        top: Color,
        /// On the last line.
        bottom: Color,
    },
    /// Whatever the row held before.
    Keep,
}

/// A finished frame: where its triangles are, and the lights on them. A view: copying it copies no data.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'f, const LIGHTS: usize = 1, L: LightSource = Light> {
    pub(crate) geometry: Geometry<'f, LIGHTS>,
    pub(crate) background: Background,
    /// Of the lights, Q15.
    pub(crate) intensities: &'f [u16; LIGHTS],
    /// For each object, the lights as it sees them.
    pub(crate) aims: &'f [[L::Aim; LIGHTS]],
}

impl<'f, const LIGHTS: usize, L: LightSource> Picture<'f, LIGHTS, L> {
    /// Where the picture lies on the panel, and its size.
    #[must_use]
    pub const fn viewport(&self) -> Rectangle {
        self.geometry.viewport
    }

    /// Number of triangles that face the eye and touch the picture.
    #[must_use]
    pub const fn triangles(&self) -> usize {
        self.geometry.kept.len()
    }

    /// A triangle, fetched.
    #[inline]
    pub(crate) fn triangle(&self, id: TriangleId) -> Option<Triangle<'f, LIGHTS, L>> {
        let numbers = self.geometry.numbers(id)?;
        let [a, b, c] = numbers.corners;
        let vertex = |number| self.geometry.vertex(number);
        let aims = self.aims.get(usize::from(numbers.object.place))?;
        let nearness = match numbers.part {
            Some(made) if L::IN_SCENE => self.geometry.corners(made.whole)?.map(Vertex::nearness),
            _ => [0; 3],
        };
        let corners = [vertex(a)?, vertex(b)?, vertex(c)?];
        Some(Triangle { corners, edges: numbers.edges, aims, numbers, nearness, turned: false })
    }
}
