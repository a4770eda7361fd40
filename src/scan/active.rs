//! The triangles that cross a line.

use super::{bucket::TriangleId, edge::Edge, geometry::Geometry, table::Span, vertex::Vertex};
use crate::math::{
    gradient::Gradient,
    screen::{area, first_at},
};

/// A triangle on one line: where it begins and ends, how deep it is, and how to go on to the next line.
#[derive(Clone, Copy, Debug)]
pub struct Active {
    left: Edge,
    right: Edge,
    /// Nearness at the centre of pixel (0, 0), and its increase for a pixel to the right and down; wrapping. Valid once `deep`.
    depth: [i32; 3],
    /// The first line below the middle corner, until it is reached; then that below the last.
    turn: u16,
    /// The first line below the last corner.
    end: u16,
    /// The least and the largest nearness of the corners, the upper 16 bits, rounded apart.
    far: u16,
    near: u16,
    pub(crate) id: TriangleId,
    /// The middle and the last corner, among the frame's vertices.
    lower: [u16; 2],
    /// The next free slot, if this one is free.
    pub(crate) next: u16,
    /// The number of its facet, from 1 on; 0 before it is set up.
    pub(crate) facet: u16,
    /// Whether the middle corner is on the left.
    middle_left: bool,
    /// Whether `depth` is there.
    pub(crate) deep: bool,
}

/// Bits of a depth below those of a nearness.
const FINER: i32 = 7;

impl Active {
    /// No triangle.
    pub(crate) const NONE: Self = Self {
        left: Edge::NONE,
        right: Edge::NONE,
        depth: [0; 3],
        turn: 0,
        end: 0,
        far: 0,
        near: 0,
        id: TriangleId(0),
        lower: [0; 2],
        next: 0,
        facet: 0,
        middle_left: false,
        deep: false,
    };

    /// Becomes a triangle on line `line`, on which or above which it must start. Returns the number of its material; none if it
    /// is not on that line.
    #[inline(never)]
    pub(crate) fn begin<const LIGHTS: usize>(
        &mut self,
        id: TriangleId,
        line: u16,
        geometry: &Geometry<'_, '_, LIGHTS>,
    ) -> Option<u16> {
        let numbers = geometry.numbers(id)?;
        let look = numbers.look();
        let [na, nb, nc] = numbers.corners;
        let (a, b, c) = (geometry.vertex(na)?, geometry.vertex(nb)?, geometry.vertex(nc)?);
        self.id = id;
        let [wa, wb, wc] = [a, b, c].map(Vertex::nearness);
        self.far = (wa.min(wb).min(wc) >> 8) as u16;
        self.near = ((wa.max(wb).max(wc) + 0xff) >> 8) as u16;
        let [(_, top), (nb, middle), (nc, bottom)] = by_height([(na, a), (nb, b), (nc, c)]);
        self.lower = [nb, nc];
        let start = i32::from(line);
        let end = first_at(bottom.point().y);
        if start >= end {
            return None;
        }
        self.end = end as u16;
        let middle_line = first_at(middle.point().y);
        let above = start < middle_line;
        self.turn = if above { middle_line } else { end } as u16;
        // Clockwise from the top: the middle corner is on the right.
        self.middle_left = area(top.point(), middle.point(), bottom.point()) < 0;
        let [bent, straight] = self.edges();
        let (from, to) = if above { (top, middle) } else { (middle, bottom) };
        bent.set(from, to, start);
        straight.set(top, bottom, start);
        (self.deep, self.facet) = (false, 0);
        Some(look)
    }

    /// The edges with the middle corner and without.
    #[inline(always)]
    fn edges(&mut self) -> [&mut Edge; 2] {
        if self.middle_left {
            [&mut self.left, &mut self.right]
        } else {
            [&mut self.right, &mut self.left]
        }
    }

    /// Whether line `line` is the first one below the middle corner, or below the last.
    #[inline(always)]
    pub(crate) const fn turns(&self, line: u32) -> bool {
        line == self.turn as u32
    }

    /// Whether line `line` is the first one below the last corner.
    #[inline(always)]
    pub(crate) const fn ends(&self, line: u32) -> bool {
        line == self.end as u32
    }

    /// Turns to the lower edge before the step to line `line`, the first one below the middle corner.
    #[inline(never)]
    pub(crate) fn bend<const LIGHTS: usize>(&mut self, line: u32, vertices: &[Vertex<LIGHTS>]) {
        let [middle, bottom] = self.lower;
        let Some(middle) = vertices.get(usize::from(middle)) else { return };
        let Some(bottom) = vertices.get(usize::from(bottom)) else { return };
        self.turn = self.end;
        let [bent, _] = self.edges();
        bent.set(middle, bottom, line as i32);
        bent.step_back();
    }

    /// On to the next line, with what it covers there.
    #[inline(always)]
    pub(crate) fn step(&mut self, span: &mut Span) {
        self.left.step();
        self.right.step();
        *span = span.with(self.left.x().into(), self.right.x().into());
    }

    /// The first pixel that it covers on the line, and the first one after; no pixels if the latter is not larger.
    #[inline(always)]
    pub(crate) const fn extent(&self) -> (i16, i16) {
        (self.left.x(), self.right.x())
    }

    /// Its left and its right edge.
    pub(crate) const fn sides(&self) -> [&Edge; 2] {
        [&self.left, &self.right]
    }

    /// The least and the largest nearness of all of it.
    #[inline(always)]
    pub(crate) fn reach(&self) -> [i32; 2] {
        [self.far.into(), self.near.into()]
    }

    /// Makes `depth` ready.
    #[cold]
    #[inline(never)]
    pub(crate) fn deepen<const LIGHTS: usize>(&mut self, geometry: &Geometry<'_, '_, LIGHTS>) {
        let Some(corners) = geometry.corners(self.id) else { return };
        let points = corners.map(Vertex::point);
        let [w0, w1, w2] = corners.map(|corner| corner.nearness() as i32);
        let [p0, ..] = points;
        let [x, y] = Gradient::anchor(p0).map(i32::from);
        let [at, dx, dy] = match Gradient::new(points) {
            Some(gradient) => gradient.linear_wide(w0, w1 - w0, w2 - w0, FINER),
            // Three numbers below 2³⁰·(1 + 2⁻⁷).
            None => [((((w0 + w1 + w2) as u32) << FINER) / 3) as i32, 0, 0],
        };
        self.depth = [at.wrapping_sub(dx.wrapping_mul(x)).wrapping_sub(dy.wrapping_mul(y)), dx, dy];
        self.deep = true;
    }

    /// The nearness at a pixel, 30 bits at the near plane; larger is nearer.
    #[inline(always)]
    pub(crate) const fn depth_at(&self, x: i32, line: u16) -> i32 {
        let [at, dx, dy] = self.depth;
        at.wrapping_add(dx.wrapping_mul(x)).wrapping_add(dy.wrapping_mul(line as i32))
    }

    /// The increase of the nearness for a pixel to the right.
    #[inline]
    pub(crate) const fn depth_step(&self) -> i32 {
        let [_, dx, _] = self.depth;
        dx
    }
}

/// The corners, with their numbers, from top to bottom; those of equal height in their order.
#[inline]
fn by_height<const LIGHTS: usize>([mut a, mut b, mut c]: [(u16, &Vertex<LIGHTS>); 3]) -> [(u16, &Vertex<LIGHTS>); 3] {
    let height = |(_, vertex): (u16, &Vertex<LIGHTS>)| vertex.point().y;
    if height(b) < height(a) {
        core::mem::swap(&mut a, &mut b);
    }
    if height(c) < height(b) {
        core::mem::swap(&mut b, &mut c);
        if height(b) < height(a) {
            core::mem::swap(&mut a, &mut b);
        }
    }
    [a, b, c]
}
