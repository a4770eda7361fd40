//! A frame as the scanner sees it.

use embedded_graphics::{geometry::Point, primitives::Rectangle};

use super::{
    bucket::{Kept, Starting, TriangleId},
    vertex::Vertex,
};
use crate::model::{
    material::{Color, Material},
    mesh::Mesh,
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
pub struct Triangle<const LIGHTS: usize> {
    /// Its corners; on the screen they may run either way round.
    pub corners: [Vertex<LIGHTS>; 3],
    /// The edge constants of edges 01, 12, 20, Q15.
    pub edges: [u16; 3],
}

impl<const LIGHTS: usize> Triangle<LIGHTS> {
    /// Its corners on the screen.
    #[inline]
    #[must_use]
    pub fn points(&self) -> [Point; 3] {
        let [a, b, c] = &self.corners;
        [a.point(), b.point(), c.point()]
    }

    /// The same seen from behind: with turned normals.
    #[must_use]
    pub fn turned(mut self) -> Self {
        for corner in &mut self.corners {
            corner.dots = corner.dots.map(|dots| dots.map(i16::wrapping_neg));
        }
        self
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
        let object = self.objects.iter().rev().find(|object| object.first_triangle <= whole.0)?;
        Some((object, whole.0 - object.first_triangle))
    }

    /// Where a triangle comes from.
    pub(crate) fn source(&self, id: TriangleId) -> Option<Source> {
        let (object, triangle) = self.object(self.whole(id))?;
        Some(Source { object: object.number, triangle })
    }

    /// The place of a triangle's object among the picture's, and of its material in the object's mesh.
    pub(crate) fn look(&self, id: TriangleId) -> [u16; 2] {
        let whole = self.whole(id);
        let object = self.objects.iter().rposition(|object| object.first_triangle <= whole.0).unwrap_or(0);
        let material = self.objects.get(object).map_or(0, |object| {
            let triangle = whole.0.wrapping_sub(object.first_triangle);
            object.mesh.material_number(triangle).unwrap_or(0)
        });
        [object as u16, material]
    }

    /// The material at such a place.
    #[inline]
    pub(crate) fn material(&self, [object, material]: [u16; 2]) -> Option<&'f Material> {
        self.objects.get(usize::from(object))?.mesh.data().materials.get(usize::from(material))
    }

    /// A triangle, fetched.
    #[inline]
    pub(crate) fn triangle(&self, id: TriangleId) -> Option<Triangle<LIGHTS>> {
        let (first, corners, edges) = self.corners(id)?;
        let [a, b, c] = self.vertices_at(first, corners)?;
        Some(Triangle { corners: [*a, *b, *c], edges: *edges })
    }

    /// The corners of a triangle on the screen.
    #[inline]
    pub(crate) fn points(&self, id: TriangleId) -> Option<[Point; 3]> {
        let (first, corners, _) = self.corners(id)?;
        let [a, b, c] = self.vertices_at(first, corners)?;
        Some([a.point(), b.point(), c.point()])
    }

    /// The number from which a triangle's corners count, theirs, and its edge constants.
    #[inline]
    fn corners(&self, id: TriangleId) -> Option<(u16, [u16; 3], &'f [u16; 3])> {
        if let Some(made) = self.made.get(usize::from(TriangleId::MADE.wrapping_sub(id.0))) {
            return Some((0, made.corners, &made.edges));
        }
        let (object, triangle) = self.object(id)?;
        let data = object.mesh.data();
        let triangle = usize::from(triangle);
        Some((object.first_vertex, *data.triangles.get(triangle)?, data.edges.get(triangle)?))
    }

    #[inline]
    fn vertices_at(&self, first: u16, corners: [u16; 3]) -> Option<[&'f Vertex<LIGHTS>; 3]> {
        let [a, b, c] = corners.map(|corner| self.vertices.get(usize::from(first) + usize::from(corner)));
        Some([a?, b?, c?])
    }
}
