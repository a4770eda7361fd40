//! A frame as the scanner sees it.

use embedded_graphics::{geometry::Point, primitives::Rectangle};

use super::{
    bucket::{Kept, Starting, TriangleId},
    vertex::Vertex,
};
use crate::{
    math::screen::area,
    model::{
        material::{Color, Material},
        mesh::Mesh,
    },
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

/// Where a triangle comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Source {
    /// Number of the object, in the order of addition to the frame, those out of sight included.
    pub object: u16,
    /// Number of the triangle in its mesh.
    pub triangle: u16,
}

/// An object of a frame.
#[derive(Clone, Copy, Debug)]
pub struct Object<'m> {
    pub(crate) mesh: &'m Mesh<'m>,
    /// Number in the order of addition.
    pub(crate) number: u16,
    pub(crate) first_vertex: u16,
    pub(crate) first_triangle: u16,
    pub(crate) first_material: u16,
}

/// A triangle made by clipping.
#[derive(Clone, Copy, Debug)]
pub struct Made {
    /// The triangle that it is a part of.
    pub(crate) whole: TriangleId,
    /// Numbers of its corners among the frame's vertices.
    pub(crate) corners: [u16; 3],
    pub(crate) edges: [u16; 3],
}

/// A triangle with all that set-up needs.
#[derive(Clone, Copy, Debug)]
pub struct Triangle<'f, const LIGHTS: usize> {
    /// Its corners; on the screen they may run either way round.
    pub corners: [&'f Vertex<LIGHTS>; 3],
    /// The edge constants of edges 01, 12, 20, Q15.
    pub edges: &'f [u16; 3],
}

impl<const LIGHTS: usize> Triangle<'_, LIGHTS> {
    /// Its corners on the screen.
    #[inline]
    #[must_use]
    pub fn points(&self) -> [Point; 3] {
        let [a, b, c] = &self.corners;
        [a.point(), b.point(), c.point()]
    }

    /// Whether it is seen from behind.
    pub(crate) fn is_turned(&self) -> bool {
        let [a, b, c] = self.points();
        area(a, b, c) > 0
    }

    /// Its corners as seen from behind: with turned normals.
    #[must_use]
    pub fn turned(&self) -> [Vertex<LIGHTS>; 3] {
        let mut corners = self.corners.map(|corner| *corner);
        for corner in &mut corners {
            corner.dots = corner.dots.map(|dots| dots.map(i16::wrapping_neg));
        }
        corners
    }
}

/// A finished frame: projected vertices, the triangles that face the eye by the line on which they start, and what they
/// refer to. A view: copying it copies no data.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'f, const LIGHTS: usize = 1> {
    pub(crate) viewport: Rectangle,
    pub(crate) background: Background,
    pub(crate) intensities: &'f [u16; LIGHTS],
    pub(crate) vertices: &'f [Vertex<LIGHTS>],
    /// For each line, one more than the place of the first of the kept triangles that start there, or 0.
    pub(crate) heads: &'f [u16],
    pub(crate) kept: &'f [Kept],
    pub(crate) objects: &'f [Object<'f>],
    pub(crate) made: &'f [Made],
}

impl<'f, const LIGHTS: usize> Picture<'f, LIGHTS> {
    /// Where the picture lies on the panel, and its size.
    #[must_use]
    pub const fn viewport(&self) -> Rectangle {
        self.viewport
    }

    /// Number of triangles that face the eye and touch the picture.
    #[must_use]
    pub const fn triangles(&self) -> usize {
        self.kept.len()
    }

    pub(crate) fn width(&self) -> i32 {
        self.viewport.size.width as i32
    }

    pub(crate) fn height(&self) -> u16 {
        self.viewport.size.height as u16
    }

    pub(crate) fn starting(&self, line: u16) -> Starting<'f> {
        Starting { kept: self.kept, next: self.heads.get(usize::from(line)).copied().unwrap_or(0) }
    }

    /// The mesh's triangle that this one is, or is a part of.
    #[inline]
    pub(crate) fn whole(&self, id: TriangleId) -> TriangleId {
        self.made.get(usize::from(TriangleId::MADE.wrapping_sub(id.0))).map_or(id, |made| made.whole)
    }

    /// The object of a mesh's triangle, and the number of the triangle in the mesh.
    #[inline]
    pub(crate) fn object(&self, whole: TriangleId) -> Option<(&'f Object<'f>, u16)> {
        let object = match self.objects {
            [only] => only,
            many => many.iter().rev().find(|object| object.first_triangle <= whole.0)?,
        };
        Some((object, whole.0.wrapping_sub(object.first_triangle)))
    }

    /// Where a triangle comes from.
    pub(crate) fn source(&self, id: TriangleId) -> Option<Source> {
        let (object, triangle) = self.object(self.whole(id))?;
        Some(Source { object: object.number, triangle })
    }

    /// The material with that number among those of all objects.
    #[inline]
    pub(crate) fn material(&self, look: u16) -> Option<&'f Material> {
        let object = self.objects.iter().rev().find(|object| object.first_material <= look)?;
        object.mesh.data().materials.get(usize::from(look - object.first_material))
    }

    /// A triangle's numbers.
    #[inline]
    pub(crate) fn numbers(&self, id: TriangleId) -> Option<Numbers<'f>> {
        let made = self.made.get(usize::from(TriangleId::MADE.wrapping_sub(id.0)));
        let (object, triangle) = self.object(made.map_or(id, |made| made.whole))?;
        let data = object.mesh.data();
        let index = usize::from(triangle);
        let (corners, edges) = match made {
            Some(made) => (made.corners, &made.edges),
            None => {
                let corners = *data.triangles.get(index)?;
                (corners.map(|corner| corner.wrapping_add(object.first_vertex)), data.edges.get(index)?)
            }
        };
        Some(Numbers { object, triangle, corners, edges })
    }

    /// A triangle, fetched.
    #[inline]
    pub(crate) fn triangle(&self, id: TriangleId) -> Option<Triangle<'f, LIGHTS>> {
        let Numbers { corners: [a, b, c], edges, .. } = self.numbers(id)?;
        Some(Triangle { corners: [self.vertex(a)?, self.vertex(b)?, self.vertex(c)?], edges })
    }

    /// A vertex by its number in the frame.
    #[inline]
    pub(crate) fn vertex(&self, number: u16) -> Option<&'f Vertex<LIGHTS>> {
        self.vertices.get(usize::from(number))
    }
}

/// Where a triangle is to be found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbers<'f> {
    object: &'f Object<'f>,
    /// Of the mesh's triangle that it is, or is a part of.
    triangle: u16,
    /// Its corners among the frame's vertices.
    pub(crate) corners: [u16; 3],
    /// The edge constants of edges 01, 12, 20, Q15.
    pub(crate) edges: &'f [u16; 3],
}

impl Numbers<'_> {
    /// The number of its material among those of all objects.
    #[inline]
    pub(crate) fn look(&self) -> u16 {
        let material = self.object.mesh.material_number(self.triangle).unwrap_or(0);
        self.object.first_material.wrapping_add(material)
    }
}
