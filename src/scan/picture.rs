//! A frame as the scanner sees it.

use embedded_graphics::primitives::Rectangle;

use super::{
    bucket::TriangleId,
    geometry::{Geometry, Source},
    pair::Pair,
    triangle::Triangle,
    vertex::Vertex,
};
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

impl Background {
    /// Whether its colour is another one on each line.
    pub(crate) const fn is_gradient(self) -> bool {
        matches!(self, Self::Gradient { .. })
    }

    /// Its colour on line y of so many; none if pixels stay what they were.
    #[inline(always)]
    pub(crate) fn at(self, y: u16, height: u16) -> Option<Color> {
        match self {
            Self::Plain(color) => Some(color),
            Self::Gradient { top, bottom } => Some(between(top, bottom, y, height)),
            Self::Keep => None,
        }
    }
}

/// A finished frame: where its triangles are, and the lights on them. A view of the frame, `'f`, and of its meshes, `'m`: copying it
/// copies no data.
#[derive(Clone, Copy, Debug)]
pub struct Picture<'f, 'm, const LIGHTS: usize = 1, L: LightSource = Light> {
    pub(crate) geometry: Geometry<'f, 'm, LIGHTS>,
    pub(crate) background: Background,
    /// Of the lights, Q15.
    pub(crate) intensities: &'f [u16; LIGHTS],
    /// For each object, the lights as it sees them.
    pub(crate) aims: &'f [[L::Aim; LIGHTS]],
    pub(crate) steps: Steps<'f>,
    /// Makes vertices anew, with light.
    pub(crate) lit_anew: Lit<LIGHTS, L>,
}

/// Makes four vertices anew by their numbers in the frame.
pub(crate) type Lit<const LIGHTS: usize, L> = fn(&Picture<'_, '_, LIGHTS, L>, [u16; 4]) -> Option<[Vertex<LIGHTS>; 4]>;

/// How far each line is down a ladder.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Steps<'f> {
    /// For each line, steps: one for far triangles, the next one for near ones, and so on; none if nothing is degraded.
    pub(crate) steps: &'f [u8],
    /// Triangles are far whose nearest corner is not nearer than this, the upper 16 bits of a nearness.
    pub(crate) middle: u16,
}

impl Steps<'_> {
    /// Nothing is degraded.
    pub(crate) const NONE: Self = Self { steps: &[], middle: 0 };

    /// The rung of a triangle whose nearest corner, or that of the pair that it is kept in, is so near, the upper 16 bits: that of
    /// the line that is farthest down the ladder, of all that it crosses, so that it is set up once and the same in whatever order
    /// lines are drawn.
    pub(crate) fn rung(&self, lines: &[u8], near: i32) -> u8 {
        let step = lines.iter().fold(0, |most, step| most.max(*step));
        (step + u8::from(near <= i32::from(self.middle))) >> 1
    }
}

impl<'f, const LIGHTS: usize, L: LightSource> Picture<'f, '_, LIGHTS, L> {
    /// Where the picture lies on the panel, and its size.
    #[must_use]
    pub const fn viewport(&self) -> Rectangle {
        self.geometry.viewport
    }

    /// Number of triangles that face the eye and touch the picture.
    #[must_use]
    pub fn triangles(&self) -> usize {
        self.geometry.kept.iter().map(|kept| kept.count()).sum()
    }

    /// Number of places that those triangles take in the frame: two that are kept as one take one.
    #[must_use]
    pub const fn places(&self) -> usize {
        self.geometry.kept.len()
    }

    /// Those triangles with their corners, in the order of their first addition to the frame; of one that was clipped or split, its
    /// parts.
    pub fn outlines(&self) -> impl Iterator<Item = (Source, [Vertex<LIGHTS>; 3])> + use<'_, 'f, LIGHTS, L> {
        let geometry = self.geometry;
        geometry
            .kept
            .iter()
            .flat_map(|kept| kept.triangles())
            .filter_map(move |id| Some((geometry.source(id)?, geometry.corners(id)?)))
    }

    /// A triangle, fetched; its corners are in `room` if none is stored.
    #[inline]
    pub(crate) fn triangle<'v>(
        &self,
        id: TriangleId,
        room: &'v mut Option<[Vertex<LIGHTS>; 4]>,
    ) -> Option<Triangle<'v, LIGHTS, L>>
    where
        'f: 'v,
    {
        let numbers = self.geometry.numbers(id)?;
        let [a, b, c] = numbers.corners;
        let aims = self.aims.get(usize::from(numbers.object.place))?;
        let nearness = match numbers.part {
            Some(made) if L::IN_SCENE => self.geometry.corners(made.whole)?.map(|corner| corner.nearness()),
            _ => [0; 3],
        };
        let [a, b, c, _] = self.lit(&[a, b, c, c], room)?;
        let corners = [a, b, c];
        Some(Triangle { corners, edges: numbers.edges, aims, numbers, nearness, turned: false, rung: 0 })
    }

    /// A triangle of a mesh and the next one, which are kept as one, fetched; its corners are in `room` if none is stored.
    #[inline]
    pub(crate) fn pair<'v>(&self, first: TriangleId, room: &'v mut Option<[Vertex<LIGHTS>; 4]>) -> Option<Pair<'v, LIGHTS>>
    where
        'f: 'v,
    {
        let (object, triangle) = self.geometry.object(first)?;
        let (data, first) = (object.mesh.data(), usize::from(triangle));
        let (Some([[a, b, c], [_, _, d]]), Some([one, other])) =
            (data.triangles.get(first..first + 2), data.edges.get(first..first + 2))
        else {
            return None;
        };
        let numbers = [*a, *b, *c, *d].map(|corner| corner.wrapping_add(object.first_vertex));
        Some(Pair { corners: self.lit(&numbers, room)?, edges: [one, other] })
    }

    /// Four vertices by their numbers in the frame: where they are stored or, made anew, in `room`.
    #[inline(always)]
    fn lit<'v>(&self, numbers: &[u16; 4], room: &'v mut Option<[Vertex<LIGHTS>; 4]>) -> Option<[&'v Vertex<LIGHTS>; 4]>
    where
        'f: 'v,
    {
        match self.geometry.stored(numbers) {
            Some(stored) => Some(stored),
            None => Some(self.fill(numbers, room)?.each_ref()),
        }
    }

    /// Makes four vertices anew, in `room`.
    #[cold]
    #[inline(never)]
    fn fill<'v>(&self, numbers: &[u16; 4], room: &'v mut Option<[Vertex<LIGHTS>; 4]>) -> Option<&'v [Vertex<LIGHTS>; 4]> {
        *room = (self.lit_anew)(self, *numbers);
        room.as_ref()
    }
}

/// The colour of a gradient on line y.
fn between(top: Color, bottom: Color, y: u16, height: u16) -> Color {
    let steps = u32::from(height.saturating_sub(1)).max(1);
    let (y, rest) = (u32::from(y), steps - u32::from(y).min(steps));
    let mut color = top;
    for (to, from) in color.0.iter_mut().zip(bottom.0) {
        *to = ((u32::from(*to) * rest + u32::from(from) * y + steps / 2).checked_div(steps).unwrap_or(0)) as u16;
    }
    color
}
