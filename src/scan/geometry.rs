//! Where the triangles of a frame are.

use embedded_graphics::primitives::Rectangle;

use super::{
    anew::Way,
    bucket::{Kept, Starting, TriangleId},
    vertex::Vertex,
};
use crate::{
    math::weights::Weights,
    model::{material::Material, mesh::Mesh},
};

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
    /// Number in the order of addition, and among those in sight.
    pub(crate) number: u16,
    pub(crate) place: u16,
    pub(crate) first_vertex: u16,
    pub(crate) first_triangle: u16,
    pub(crate) first_material: u16,
}

/// A triangle made by clipping or splitting.
#[derive(Clone, Copy, Debug)]
pub struct Made {
    /// The triangle that it is a part of.
    pub(crate) whole: TriangleId,
    /// Numbers of its corners among the frame's vertices.
    pub(crate) corners: [u16; 3],
    pub(crate) edges: [u16; 3],
    /// Where they are in the whole: in space if that was clipped, on the screen if it was split, which no corner of it forbids.
    pub(crate) weights: [Weights; 3],
}

/// Makes four vertices anew, without light, by their numbers in the frame.
pub(crate) type Four<const LIGHTS: usize> = fn(&Geometry<'_, '_, LIGHTS>, [u16; 4]) -> Option<[Vertex<LIGHTS>; 4]>;

/// What of a frame is seen by the scan: projected vertices, the triangles that face the eye by the line on which they start,
/// and where these come from. A view: copying it copies no data.
#[derive(Clone, Copy, Debug)]
pub struct Geometry<'f, 'm, const LIGHTS: usize = 1> {
    pub(crate) viewport: Rectangle,
    /// Those that are stored, all or none.
    pub(crate) vertices: &'f [Vertex<LIGHTS>],
    /// For each object, how its vertices are made anew, if none is stored; and what makes four of them.
    pub(crate) ways: &'f [Way],
    pub(crate) anew: Four<LIGHTS>,
    /// For each line, one more than the place of the first of the kept triangles that start there, or 0.
    pub(crate) heads: &'f [u16],
    pub(crate) kept: &'f [Kept],
    pub(crate) objects: &'f [Object<'m>],
    pub(crate) made: &'f [Made],
}

impl<'f, 'm, const LIGHTS: usize> Geometry<'f, 'm, LIGHTS> {
    pub(crate) fn width(&self) -> i32 {
        self.viewport.size.width as i32
    }

    pub(crate) fn height(&self) -> u16 {
        self.viewport.size.height as u16
    }

    /// Objects and parts of meshes that a search for a triangle or a material looks at, at most.
    pub(crate) fn searched(&self) -> u32 {
        let parts = self.objects.iter().map(|object| object.mesh.data().parts.len()).max().unwrap_or(0);
        (self.objects.len() + parts) as u32
    }

    pub(crate) fn starting(&self, line: u16) -> Starting<'f> {
        Starting { kept: self.kept, next: self.heads.get(usize::from(line)).copied().unwrap_or(0) }
    }

    /// The mesh's triangle that this one is, or is a part of.
    #[inline]
    pub(crate) fn whole(&self, id: TriangleId) -> TriangleId {
        self.made.get(usize::from(TriangleId::MADE.wrapping_sub(id.0))).map_or(id, |made| made.whole)
    }

    /// The last object that does not begin too late, as the first one never does.
    #[inline(always)]
    fn last(&self, begins: impl Fn(&Object<'_>) -> bool) -> Option<&'f Object<'m>> {
        match self.objects {
            [only] => Some(only),
            many => many.iter().rev().find(|object| begins(object)),
        }
    }

    /// The object of a mesh's triangle, and the number of the triangle in the mesh.
    #[inline]
    pub(crate) fn object(&self, whole: TriangleId) -> Option<(&'f Object<'m>, u16)> {
        let object = self.last(|object| object.first_triangle <= whole.0)?;
        Some((object, whole.0.wrapping_sub(object.first_triangle)))
    }

    /// Where a triangle comes from.
    pub(crate) fn source(&self, id: TriangleId) -> Option<Source> {
        let (object, triangle) = self.object(self.whole(id))?;
        Some(Source { object: object.number, triangle })
    }

    /// The material with that number among those of all objects.
    #[inline]
    pub(crate) fn material(&self, look: u16) -> Option<&'m Material> {
        let object = self.last(|object| object.first_material <= look)?;
        object.mesh.data().materials.get(usize::from(look.wrapping_sub(object.first_material)))
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
        Some(Numbers { object, triangle, part: made, corners, edges })
    }

    /// The corners of a triangle, the last one twice, and the number of its material among those of all objects.
    #[inline(always)]
    pub(crate) fn one(&self, id: TriangleId) -> Option<([u16; 4], u16)> {
        let Numbers { object, triangle, corners: [a, b, c], .. } = self.numbers(id)?;
        Some(([a, b, c, c], object.look(triangle)))
    }

    /// The corners of a triangle of a mesh and the next one, which are kept as one, and the number of their material among those of all
    /// objects.
    #[inline(always)]
    pub(crate) fn pair(&self, first: TriangleId) -> Option<([u16; 4], u16)> {
        let (object, triangle) = self.object(first)?;
        let at = usize::from(triangle);
        let [[a, b, c], [_, _, d]] = object.mesh.data().triangles.get(at..at + 2)? else { return None };
        Some(([*a, *b, *c, *d].map(|corner| corner.wrapping_add(object.first_vertex)), object.look(triangle)))
    }

    /// A triangle's corners.
    #[inline]
    pub(crate) fn corners(&self, id: TriangleId) -> Option<[Vertex<LIGHTS>; 3]> {
        let [a, b, c] = self.numbers(id)?.corners;
        let mut room = None;
        let [a, b, c, _] = self.four(&[a, b, c, c], &mut room)?;
        Some([*a, *b, *c])
    }

    /// Four vertices by their numbers in the frame, if they are stored.
    #[inline(always)]
    pub(crate) fn stored(&self, [a, b, c, d]: &[u16; 4]) -> Option<[&'f Vertex<LIGHTS>; 4]> {
        let vertex = |number: &u16| self.vertices.get(usize::from(*number));
        Some([vertex(a)?, vertex(b)?, vertex(c)?, vertex(d)?])
    }

    /// Four vertices by their numbers in the frame: where they are stored or, made anew and without light, in `room`.
    #[inline(always)]
    pub(crate) fn four<'v>(
        &self,
        numbers: &[u16; 4],
        room: &'v mut Option<[Vertex<LIGHTS>; 4]>,
    ) -> Option<[&'v Vertex<LIGHTS>; 4]>
    where
        'f: 'v,
    {
        match self.stored(numbers) {
            Some(stored) => Some(stored),
            None => Some(self.fill(numbers, room)?.each_ref()),
        }
    }

    /// Makes four vertices anew, in `room`.
    #[cold]
    #[inline(never)]
    fn fill<'v>(&self, numbers: &[u16; 4], room: &'v mut Option<[Vertex<LIGHTS>; 4]>) -> Option<&'v [Vertex<LIGHTS>; 4]> {
        *room = (self.anew)(self, *numbers);
        room.as_ref()
    }

    /// The object that a vertex is of, and its number in the mesh.
    pub(crate) fn origin(&self, number: u16) -> Option<(&'f Object<'m>, usize)> {
        let object = self.last(|object| object.first_vertex <= number)?;
        Some((object, number.wrapping_sub(object.first_vertex).into()))
    }
}

/// Where a triangle is to be found.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Numbers<'f> {
    pub(crate) object: &'f Object<'f>,
    /// Of the mesh's triangle that it is, or is a part of.
    pub(crate) triangle: u16,
    /// What was made of that.
    pub(crate) part: Option<&'f Made>,
    /// Its corners among the frame's vertices.
    pub(crate) corners: [u16; 3],
    /// The edge constants of edges 01, 12, 20, Q15.
    pub(crate) edges: &'f [u16; 3],
}

impl Object<'_> {
    /// The number of a triangle's material among those of all objects.
    #[inline]
    pub(crate) fn look(&self, triangle: u16) -> u16 {
        let material = self.mesh.material_number(triangle).unwrap_or(0);
        self.first_material.wrapping_add(material)
    }
}
