//! The triangles that cross a line.

use super::{
    bucket::{Kept, TriangleId},
    course::Course,
    depth::Depth,
    edge::Edge,
    geometry::Geometry,
    vertex::Vertex,
};
use crate::math::screen::area;

/// A triangle on one line, or two that share an edge and make a convex quadrilateral: where it begins and ends, how deep it is, and how
/// to go on to the next line.
///
/// In this order: a Cortex-M0+ reads what is short faster near the beginning.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Active {
    pub(crate) sharing: Sharing,
    /// What is to come at the lower corners.
    course: Course,
    /// The first line below the next corner.
    turn: u16,
    /// The numbers of the facets, from 1 on, 0 before they are set up: of the triangle left of the diagonal, which a single one is,
    /// and of the one right of it.
    pub(crate) facets: [u16; 2],
    /// The first of two in the mesh, or the only one.
    first: TriangleId,
    /// The least and the largest nearness of the corners, the upper 16 bits, rounded apart.
    far: u16,
    near: u16,
    /// The corners still to come, from top to bottom, among the frame's vertices; the last one again where there are no three. In a
    /// free slot, the next free one first.
    lower: [u16; 3],
    /// The right edge, and the left one.
    sides: [Edge; 2],
    /// Between two triangles; where only one of them is on the line, far out on the other's side.
    diagonal: Edge,
    /// Of the left triangle and of the right one, once they are compared.
    pub(crate) depths: [Depth; 2],
}

/// Whether two triangles share a facet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sharing {
    /// There is only one.
    Single,
    /// Each has its own.
    Apart,
    /// They were not seen yet.
    Unknown,
    Shared,
}

impl Active {
    /// No triangle: all zeros, so that a `static` takes no flash.
    pub(crate) const NONE: Self = Self {
        sides: [Edge::NONE; 2],
        diagonal: Edge::NONE,
        depths: [Depth::ZERO; 2],
        facets: [0; 2],
        first: TriangleId(0),
        turn: 0,
        far: 0,
        near: 0,
        lower: [0; 3],
        course: Course::NONE,
        sharing: Sharing::Single,
    };

    /// Becomes what was kept, on line `line`, on which or above which it must start. Returns the number of its material; none if
    /// it is not on that line: a free slot then stays one.
    #[inline(never)]
    pub(crate) fn begin<const LIGHTS: usize>(
        &mut self,
        kept: Kept,
        line: u16,
        geometry: &Geometry<'_, '_, LIGHTS>,
    ) -> Option<u16> {
        let is_pair = kept.is_pair();
        let (names, look) = if is_pair { geometry.pair(kept.triangle)? } else { geometry.one(kept.triangle)? };
        self.sharing = if is_pair { Sharing::Unknown } else { Sharing::Single };
        let mut room = None;
        let vertices = geometry.four(&names, &mut room)?;
        let [a, b, c, _] = vertices;
        let [wa, wb, wc, wd] = vertices.map(|corner| corner.nearness());
        self.far = (wa.min(wb).min(wc).min(wd) >> 8) as u16;
        self.near = ((wa.max(wb).max(wc).max(wd) + 0xff) >> 8) as u16;
        let [t, m1, m2, e] = by_height(vertices, is_pair);
        let course =
            if is_pair { Course::of(t, m1, m2) } else { Course::of_one(t, m1, area(a.point(), b.point(), c.point()) < 0) };
        (self.first, self.facets) = (kept.triangle, [0; 2]);
        self.depths.iter_mut().for_each(Depth::forget);

        let (top, first, second, last) = (pick(&vertices, t), pick(&vertices, m1), pick(&vertices, m2), pick(&vertices, e));
        let (start, end) = (i32::from(line), last.pixel().y);
        if start >= end {
            return None;
        }
        self.lower = [pick(&names, m1), pick(&names, m2), pick(&names, e)];
        let turn = first.pixel().y;
        let course = course.ending([turn == end, second.pixel().y == end]);
        (self.course, self.turn) = (course, turn as u16);
        let is_left = course.is(Course::LEFT);
        self.side(is_left).set(top, first, start);
        self.side(!is_left).set(top, if course.goes_on() { last } else { second }, start);
        self.diagonal.set_beyond(!(course.is(Course::BEGINS) && course.is(Course::LEFT)));
        if is_pair && !course.is(Course::BEGINS) {
            self.diagonal.set(top, if course.is(Course::ENDS_AFTER) { second } else { last }, start);
        }
        if turn <= start {
            self.bend(line.into(), geometry);
        }
        Some(look)
    }

    /// The edge on that side.
    #[inline(always)]
    fn side(&mut self, is_left: bool) -> &mut Edge {
        let [right, left] = &mut self.sides;
        if is_left {
            left
        } else {
            right
        }
    }

    /// The first of the triangles, if there are two.
    pub(crate) fn pair(&self) -> Option<TriangleId> {
        self.is_pair().then_some(self.first)
    }

    #[inline(always)]
    fn is_pair(&self) -> bool {
        self.sharing != Sharing::Single
    }

    /// Number of triangles.
    pub(crate) fn count(&self) -> u16 {
        1 + u16::from(self.is_pair())
    }

    /// The left triangle, or the right one; of one alone, that.
    #[inline(always)]
    pub(crate) fn id(&self, half: usize) -> TriangleId {
        let is_second = self.is_pair() && self.course.is(Course::SECOND_LEFT) == (half == 0);
        if is_second {
            self.first.next()
        } else {
            self.first
        }
    }

    /// The left triangle, and the right one.
    pub(crate) fn ids(&self) -> [TriangleId; 2] {
        [self.id(0), self.id(1)]
    }

    /// Makes the depth of one of the triangles ready. Returns 1 if that took 64-bit divisions, else 0.
    #[cold]
    #[inline(never)]
    pub(crate) fn deepen<const LIGHTS: usize>(&mut self, half: usize, geometry: &Geometry<'_, '_, LIGHTS>) -> u32 {
        let Some([a, b, c]) = geometry.numbers(self.id(half)).map(|numbers| numbers.corners) else { return 0 };
        let mut room = None;
        let Some([a, b, c, _]) = geometry.four(&[a, b, c, c], &mut room) else { return 0 };
        let (depth, exact) = Depth::of([a, b, c]);
        if let Some(room) = self.depths.get_mut(half) {
            *room = depth;
        }
        exact
    }

    /// The next free slot, if this one is free.
    pub(crate) const fn next_free(&self) -> u16 {
        let [next, ..] = self.lower;
        next
    }

    /// Makes this slot a free one.
    pub(crate) const fn free(&mut self, next: u16) {
        self.lower = [next; 3];
    }

    /// Whether line `line` is the first one below a corner.
    #[inline(always)]
    pub(crate) const fn turns(&self, line: u32) -> bool {
        line == self.turn as u32
    }

    /// Whether the next corner is the last, so that it ends where it [turns](Self::turns).
    #[inline(always)]
    pub(crate) const fn ends(&self) -> bool {
        self.course.is(Course::LAST)
    }

    /// Turns to other edges on line `line`, the first one below a corner that is not the last.
    #[inline(never)]
    pub(crate) fn bend<const LIGHTS: usize>(&mut self, line: u32, geometry: &Geometry<'_, '_, LIGHTS>) {
        // Two corners may lie above the line; the last one does not.
        for _ in 0..2 {
            let [a, b, c] = self.lower;
            let mut room = None;
            let Some([here, next, last, _]) = geometry.four(&[a, b, c, c], &mut room) else { return };
            if self.turn_at([here, next, last], line as i32) {
                return;
            }
        }
    }

    /// Turns at `here`; whether the next corner is below the line.
    #[inline(always)]
    fn turn_at<const LIGHTS: usize>(&mut self, [here, next, last]: [&Vertex<LIGHTS>; 3], line: i32) -> bool {
        let ([_, b, c], course) = (self.lower, self.course);
        (self.lower, self.course) = ([b, c, c], course.next());
        let turn = next.pixel().y;
        self.turn = turn as u16;
        self.side(course.is(Course::LEFT)).set(here, if course.goes_on() { next } else { last }, line);
        if course.is(Course::BEGINS) {
            self.diagonal.set(here, if course.is(Course::ENDS_AFTER) { next } else { last }, line);
        } else if course.is(Course::ENDS) {
            self.diagonal.set_beyond(!course.is(Course::LEFT));
        }
        turn > line
    }

    /// On to the next line.
    #[inline(always)]
    pub(crate) fn step(&mut self) {
        self.diagonal.step();
        let [right, left] = &mut self.sides;
        left.step();
        right.step();
    }

    /// The first pixel that it covers on the line, and the first one after; no pixels if the latter is not larger.
    #[inline(always)]
    pub(crate) const fn extent(&self) -> (i16, i16) {
        let [right, left] = &self.sides;
        (left.x(), right.x())
    }

    /// The first pixel of the line right of the diagonal.
    #[inline(always)]
    pub(crate) const fn middle(&self) -> i16 {
        self.diagonal.x()
    }

    /// The left and the right edge.
    pub(crate) const fn sides(&self) -> [&Edge; 2] {
        let [right, left] = &self.sides;
        [left, right]
    }

    /// The left and the right edge of one of the triangles; of a pair, if the other one covers no pixel of the line.
    pub(crate) fn sides_of(&self, half: usize) -> [&Edge; 2] {
        let (start, end) = self.extent();
        let [left, right] = self.sides();
        match half {
            0 if self.middle() < end => [left, &self.diagonal],
            1 if self.middle() > start => [&self.diagonal, right],
            _ => [left, right],
        }
    }

    /// Whether both triangles of a pair cover pixels of the line.
    pub(crate) fn is_divided(&self) -> bool {
        let (start, end) = self.extent();
        start < self.middle() && self.middle() < end
    }

    /// The least and the largest nearness of all of it.
    #[inline(always)]
    pub(crate) fn reach(&self) -> [i32; 2] {
        [self.far.into(), self.near.into()]
    }
}

/// Of four, that at a place.
#[inline(always)]
fn pick<T: Copy>(four: &[T; 4], place: u32) -> T {
    let [first, ..] = four;
    *four.get((place & 3) as usize).unwrap_or(first)
}

/// The places of corners from top to bottom; those of equal height in their order. Of a triangle, the last place is there twice.
#[inline(always)]
fn by_height<const LIGHTS: usize>([a, b, c, d]: [&Vertex<LIGHTS>; 4], is_pair: bool) -> [u32; 4] {
    let [a, b, c, d] = [key(a, 0), key(b, 1), key(c, 2), key(d, 3)];
    let [a, b] = ordered(a, b);
    let order = if is_pair {
        let [c, d] = ordered(c, d);
        let ([a, c], [b, d]) = (ordered(a, c), ordered(b, d));
        let [b, c] = ordered(b, c);
        [a, b, c, d]
    } else {
        let [b, c] = ordered(b, c);
        let [a, b] = ordered(a, b);
        [a, b, c, c]
    };
    order.map(|key| (key & 3) as u32)
}

/// A corner's height, and its place.
#[inline(always)]
fn key<const LIGHTS: usize>(corner: &Vertex<LIGHTS>, place: i32) -> i32 {
    (corner.point().y << 2) | place
}

#[inline(always)]
fn ordered(a: i32, b: i32) -> [i32; 2] {
    [a.min(b), a.max(b)]
}
