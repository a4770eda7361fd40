//! Splitting triangles where a highlight may lie, so that Gouraud shading catches it.
//!
//! *Adaptive Shading*, §3: [`Regular`](regular::Regular) subdivision of potentially highlighted triangles and their neighbours,
//! or subdivision [`AtHighlight`](highlight::AtHighlight). Objects are added by
//! [`Frame::add_split`](crate::Frame::add_split) and drawn by [`Gouraud`](crate::Gouraud) (any other method works as well); the
//! third way, per-pixel shading where a highlight may lie, is a rule: [`ByHighlight`](crate::shade::choose::ByHighlight).

use embedded_graphics::geometry::Point;
use heapless::VecView;

use crate::{
    frame::{Frame, Full},
    math::{screen::area, weights::Weights},
    model::{
        clip::edge_constant,
        highlight::Bent,
        light::{Aim, Light, LightSource},
        mesh::Mesh,
        pose::Pose,
        projection::Projected,
    },
    scan::{
        bucket::TriangleId,
        geometry::{Made, Object},
        triangle::in_space,
        vertex::Vertex,
    },
    shade::{gouraud::at_corner, Intensity, Surface},
};

pub mod highlight;
pub mod regular;

/// A way of splitting triangles.
pub trait Split<const LIGHTS: usize = 1, L: LightSource = Light> {
    /// Whether triangles that share a vertex with a potentially highlighted one are split, too.
    const NEIGHBOURS: bool;

    /// Makes parts that cover the triangle, or none where it is to stay whole; `None` if they have no room.
    fn split(&self, whole: &Whole<'_, LIGHTS, L>, parts: &mut Parts<'_, LIGHTS>) -> Option<()>;
}

/// What became of the triangles of an object that [was split](Frame::add_split): of those that face the eye, touch the picture
/// and need no clipping.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Splits {
    /// Triangles chosen: potentially highlighted ones, with their neighbours if the way of splitting includes these.
    pub chosen: u16,
    /// Of those, the ones that were split; the others are small enough.
    pub split: u16,
    /// The triangles that face the eye and touch the picture that they were split into.
    pub parts: u16,
    /// Chosen ones that stayed whole for want of room.
    pub no_room: u16,
}

/// A triangle that may be split.
#[derive(Clone, Copy, Debug)]
pub struct Whole<'f, const LIGHTS: usize, L: LightSource = Light> {
    /// What it is lit as.
    pub surface: Surface<'f, LIGHTS>,
    /// The lights as its object sees them.
    pub aims: &'f [L::Aim; LIGHTS],
    /// Its corners in the mesh.
    pub bent: Bent,
    id: TriangleId,
    /// Its corners, and their numbers among the frame's vertices.
    corners: [Vertex<LIGHTS>; 3],
    numbers: [u16; 3],
}

impl<'f, const LIGHTS: usize, L: LightSource> Whole<'f, LIGHTS, L> {
    /// Twice its area on the screen, in square subpixels.
    #[must_use]
    pub fn twice_area(&self) -> u64 {
        let [a, b, c] = self.corners.map(|corner| corner.point());
        area(a, b, c).unsigned_abs()
    }

    /// The illumination at a place on the screen, computed there.
    #[must_use]
    pub fn intensity(&self, place: Weights) -> Intensity {
        at_corner(&self.dots(place), &self.surface)
    }

    /// The numbers of its corners: what tells them apart from all other vertices.
    #[must_use]
    pub const fn numbers(&self) -> [u16; 3] {
        self.numbers
    }

    /// The products with the lights there: normals are linear on the screen, positions in space.
    fn dots(&self, place: Weights) -> [[i16; 2]; LIGHTS] {
        let normal = place.normal(self.bent.normals);
        let position = if L::IN_SCENE {
            in_space(place, self.corners.map(|corner| corner.nearness())).position(self.bent.positions)
        } else {
            [0; 3]
        };
        self.aims.each_ref().map(|aim| aim.dots(position, normal))
    }
}

/// A corner of a part: the number of its vertex, and where it is in the whole, on the screen.
pub type Corner = (u16, Weights);

/// The parts that a triangle is split into.
#[derive(Debug)]
pub struct Parts<'a, const LIGHTS: usize> {
    /// Room for vertices, the number of the first, and how many are there.
    vertices: &'a mut [Vertex<LIGHTS>],
    first: usize,
    used: usize,
    made: &'a mut VecView<Made>,
}

impl<const LIGHTS: usize> Parts<'_, LIGHTS> {
    /// Whether there is room for so many vertices and triangles more.
    #[must_use]
    pub fn have_room(&self, vertices: usize, triangles: usize) -> bool {
        vertices <= self.vertices.len().saturating_sub(self.used) && triangles <= self.made.capacity() - self.made.len()
    }

    /// The corners of the whole, which need no new vertices.
    #[must_use]
    pub fn corners<L: LightSource>(whole: &Whole<'_, LIGHTS, L>) -> [Corner; 3] {
        let ([n0, n1, n2], [w0, w1, w2]) = (whole.numbers, Weights::CORNERS);
        [(n0, w0), (n1, w1), (n2, w2)]
    }

    /// Adds a vertex at a place of the whole on the screen, lit there; none if it has no room.
    ///
    /// Where it is depends on the vertices that have a share in it alone, so triangles that share an edge get the same.
    pub fn vertex<L: LightSource>(&mut self, whole: &Whole<'_, LIGHTS, L>, place: Weights) -> Option<Corner> {
        let room = self.vertices.get_mut(self.used)?;
        // All three are linear on the screen.
        let [x, y, nearness] = place.point(whole.corners.map(|corner| {
            let Point { x, y } = corner.point();
            [x, y, corner.nearness() as i32]
        }));
        *room = Vertex::new(Some(Projected { point: Point::new(x, y), nearness: nearness as u32 }), whole.dots(place));
        let number = u16::try_from(self.first + self.used).ok()?;
        self.used += 1;
        Some((number, place))
    }

    /// Adds a part; its corners run as the whole's do. None if it has no room.
    pub fn triangle<L: LightSource>(&mut self, whole: &Whole<'_, LIGHTS, L>, corners: [Corner; 3]) -> Option<()> {
        let [n0, n1, n2] = corners.map(|(_, place)| place.normal(whole.bent.normals));
        let part = Made {
            whole: whole.id,
            corners: corners.map(|(number, _)| number),
            edges: [edge_constant(n0, n1), edge_constant(n1, n2), edge_constant(n2, n0)],
            weights: corners.map(|(_, place)| place),
        };
        self.made.push(part).ok()
    }
}

impl<
        'm,
        const VERTICES: usize,
        const TRIANGLES: usize,
        const LINES: usize,
        const LIGHTS: usize,
        const OBJECTS: usize,
        const MADE: usize,
        L: LightSource,
    > Frame<'m, VERTICES, TRIANGLES, LINES, LIGHTS, OBJECTS, MADE, L>
{
    /// Adds an object, its triangles split where a highlight may lie; returns how many.
    ///
    /// Parts take room that later objects may need: new vertices in that for `VERTICES`, parts in those for `MADE` and, but for
    /// one of each whole, for `TRIANGLES`. A triangle whose parts have no room stays whole and is
    /// [counted](Splits::no_room). Not split are triangles that turn their back, those of a material without specular
    /// reflection, and those that are to be clipped. All parts are of the [`Source`](crate::Source) that the whole is.
    ///
    /// Where a split triangle meets one that is whole or split otherwise, its new vertices are rounded to the subpixel grid beside
    /// the neighbour's edge: so here and there, on one frame in five of the standard scenes, a pixel shows what is behind the edge.
    ///
    /// # Errors
    /// As [`add`](Self::add): what is then there is not split.
    pub fn add_split<S: Split<LIGHTS, L>>(&mut self, mesh: &'m Mesh<'m>, pose: &Pose, split: &S) -> Result<Splits, Full> {
        let (objects, first) = (self.objects.len(), self.buckets.used);
        self.add_by(mesh, pose, false)?;
        let (Some(object), Some(aims)) = (self.objects.get(objects), self.aims.get(objects)) else {
            // Out of sight.
            return Ok(Splits::default());
        };
        let candidates = Candidates { object: *object, aims: *aims, intensities: self.intensities };
        let added = first..self.buckets.used;
        if S::NEIGHBOURS {
            for vertex in self.vertices_of(object.first_vertex) {
                vertex.unmarked();
            }
            for place in added.clone() {
                let Some(whole) = self.candidate(&candidates, place) else { continue };
                if whole.bent.is_potential(whole.aims) {
                    for number in whole.numbers {
                        if let Some(vertex) = self.vertices.get_mut(usize::from(number)) {
                            vertex.mark();
                        }
                    }
                }
            }
        }
        let mut splits = Splits::default();
        for place in added {
            if S::NEIGHBOURS && !self.is_marked(&candidates.object, place) {
                continue;
            }
            let Some(whole) = self.candidate(&candidates, place) else { continue };
            if S::NEIGHBOURS || whole.bent.is_potential(whole.aims) {
                splits.chosen += 1;
                match self.replace(place, &whole, split) {
                    Some(0) => {}
                    Some(parts) => {
                        splits.split += 1;
                        splits.parts += parts;
                    }
                    None => splits.no_room += 1,
                }
            }
        }
        if S::NEIGHBOURS {
            for vertex in self.vertices_of(candidates.object.first_vertex) {
                vertex.unmark();
            }
        }
        Ok(splits)
    }

    /// The vertices from that number on.
    fn vertices_of(&mut self, first: u16) -> &mut [Vertex<LIGHTS>] {
        self.vertices.get_mut(usize::from(first)..self.used).unwrap_or_default()
    }

    /// The mesh's number of the kept triangle at that place, and its corners there; none if it was made by clipping.
    #[inline]
    fn kept(&self, object: &Object<'m>, place: usize) -> Option<(u16, [u16; 3])> {
        let id = self.buckets.kept.get(place)?.triangle;
        // Those made by clipping are beyond the mesh's.
        let triangle = id.0.checked_sub(object.first_triangle)?;
        let corners = object.mesh.data().triangles.get(usize::from(triangle))?;
        Some((triangle, *corners))
    }

    /// Whether a kept triangle is near a potentially highlighted one.
    fn is_marked(&self, object: &Object<'m>, place: usize) -> bool {
        let Some((_, corners)) = self.kept(object, place) else { return false };
        let vertex = |corner: u16| self.vertices.get(usize::from(corner.wrapping_add(object.first_vertex)));
        corners.iter().any(|corner| vertex(*corner).is_some_and(Vertex::is_marked))
    }

    /// The kept triangle at that place, if it may be split at all.
    #[inline(always)]
    fn candidate<'c>(&self, of: &'c Candidates<'m, LIGHTS, L>, place: usize) -> Option<Whole<'c, LIGHTS, L>>
    where
        'm: 'c,
    {
        let Object { mesh, first_triangle, first_vertex, .. } = of.object;
        let data = mesh.data();
        let (triangle, [c0, c1, c2]) = self.kept(&of.object, place)?;
        let numbers = [c0, c1, c2].map(|corner| corner.wrapping_add(first_vertex));
        let vertex = |number: u16| self.vertices.get(usize::from(number));
        let [n0, n1, n2] = numbers;
        let mut corners = [*vertex(n0)?, *vertex(n1)?, *vertex(n2)?];
        let [a, b, c] = corners.map(|corner| corner.point());
        let material = data.materials.get(usize::from(mesh.material_number(triangle)?))?;
        if material.specular == 0 || area(a, b, c) >= 0 {
            return None;
        }
        for corner in &mut corners {
            corner.unmark();
        }
        let of_mesh = |all: &[[i16; 3]], corner: u16| all.get(usize::from(corner)).copied();
        let (p, n) = (data.positions, data.normals);
        let bent = Bent {
            positions: [of_mesh(p, c0)?, of_mesh(p, c1)?, of_mesh(p, c2)?],
            normals: [of_mesh(n, c0)?, of_mesh(n, c1)?, of_mesh(n, c2)?],
        };
        let id = TriangleId(first_triangle.wrapping_add(triangle));
        Some(Whole { surface: Surface { material, intensities: &of.intensities }, aims: &of.aims, bent, id, corners, numbers })
    }

    /// Puts parts of the triangle in its place, all of them or none; returns how many are seen, `None` if there is no room.
    fn replace<S: Split<LIGHTS, L>>(&mut self, place: usize, whole: &Whole<'_, LIGHTS, L>, split: &S) -> Option<u16> {
        let (made, kept) = (self.made.len(), self.buckets.used);
        // Vertices are numbered in 16 bits.
        let vertices = self.vertices.get_mut(self.used..VERTICES.min(0x1_0000)).unwrap_or_default();
        let mut parts = Parts { vertices, first: self.used, used: 0, made: &mut self.made };
        let is_done = split.split(whole, &mut parts);
        let used = self.used + parts.used;
        let seen = match is_done {
            Some(()) if self.made.len() == made => Some(0),
            Some(()) => self.keep_parts(place, made, used),
            None => None,
        };
        match seen {
            Some(1..) => self.used = used,
            _ => {
                self.buckets.forget(kept);
                self.made.truncate(made);
            }
        }
        seen
    }

    /// Keeps the made triangles from that number on as far as they are seen, one of them in the given place.
    fn keep_parts(&mut self, place: usize, made: usize, used: usize) -> Option<u16> {
        let vertices = self.vertices.get(..used).unwrap_or_default();
        // The place is among those of the line on which the whole starts, and so for one that starts there, too.
        let top = |part: &Made| {
            let line = |number: &u16| vertices.get(usize::from(*number)).map_or(i32::MAX, |vertex| vertex.pixel().y);
            part.corners.iter().map(line).min()
        };
        let parts = self.made.get_mut(made..).unwrap_or_default();
        let (highest, _) = parts.iter().enumerate().min_by_key(|(_, part)| top(part))?;
        if let Some((first, others)) = parts.split_first_mut() {
            if let Some(highest) = others.get_mut(highest.wrapping_sub(1)) {
                core::mem::swap(first, highest);
            }
        }
        let number = |made: usize| TriangleId(TriangleId::MADE.wrapping_sub(made as u16));
        let (mut next, others) = (made + 1, made + 1..self.made.len());
        for i in others {
            let Some(part) = self.made.get(i).copied() else { break };
            let sorted = self.buckets.sort(vertices, &[part.corners], number(next), false, false);
            if sorted.left_out > 0 {
                return None;
            }
            if sorted.fitted > 0 {
                if let Some(room) = self.made.get_mut(next) {
                    *room = part;
                }
                next += 1;
            }
        }
        self.made.truncate(next);
        self.buckets.kept.get_mut(place)?.triangle = number(made);
        Some((next - made) as u16)
    }
}

/// What is the same for all triangles of an object.
struct Candidates<'m, const LIGHTS: usize, L: LightSource> {
    object: Object<'m>,
    aims: [L::Aim; LIGHTS],
    intensities: [u16; LIGHTS],
}
