//! The triangles that cross a line.

use embedded_graphics::geometry::Point;

use super::{bucket::TriangleId, edge::Edge, picture::Triangle};
use crate::math::{
    gradient::Gradient,
    screen::{area, first_at},
};

/// A triangle on one line: where it begins and ends, how deep it is, and how to go on to the next line.
#[derive(Clone, Copy, Debug)]
pub struct Active {
    left: Edge,
    right: Edge,
    /// Nearness at the anchor, and its increase for a pixel to the right and down; wrapping. Valid once `deep`.
    depth: [i32; 3],
    anchor: [i16; 2],
    /// The first line below the middle corner, and below the last.
    middle: u16,
    pub(crate) end: u16,
    pub(crate) id: TriangleId,
    /// Its object's place in the picture, and its material's in the object's mesh.
    pub(crate) look: [u16; 2],
    /// Of the mesh's triangle that this is or is a part of: decides ties.
    pub(crate) whole: TriangleId,
    /// Whether the middle corner is on the left.
    middle_left: bool,
    /// Whether it is seen from behind.
    pub(crate) turned: bool,
    /// Whether `depth` is there.
    pub(crate) deep: bool,
    /// Whether its facet is set up.
    pub(crate) shaded: bool,
}

/// Bits of a depth below those of a nearness.
const FINER: u32 = 7;

impl Active {
    /// No triangle.
    pub(crate) const NONE: Self = Self {
        left: Edge::NONE,
        right: Edge::NONE,
        depth: [0; 3],
        anchor: [0; 2],
        middle: 0,
        end: 0,
        id: TriangleId(0),
        look: [0; 2],
        whole: TriangleId(0),
        middle_left: false,
        turned: false,
        deep: false,
        shaded: false,
    };

    /// The triangle on line `line`, on which or above which it must start; none if it is not on that line.
    #[inline]
    pub(crate) fn new(points: [Point; 3], id: TriangleId, line: u16) -> Option<Self> {
        let [top, middle, bottom] = by_height(points);
        let [start, middle_line, end] = [top, middle, bottom].map(|point| first_at(point.y));
        let line = i32::from(line);
        if line < start || line >= end {
            return None;
        }
        // Clockwise from the top: the middle corner is on the right.
        let middle_left = area(top, middle, bottom) < 0;
        let bent = if line < middle_line { Edge::new(top, middle, line) } else { Edge::new(middle, bottom, line) };
        let straight = Edge::new(top, bottom, line);
        let (left, right) = if middle_left { (bent, straight) } else { (straight, bent) };
        let [a, b, c] = points;
        Some(Self {
            left,
            right,
            middle: middle_line.clamp(0, 0xffff) as u16,
            end: end.clamp(0, 0xffff) as u16,
            id,
            middle_left,
            turned: area(a, b, c) > 0,
            ..Self::NONE
        })
    }

    /// On to line `line`, the next one; `points` fetches the corners where an edge ends. Whether it is still there.
    #[inline]
    pub(crate) fn step(&mut self, line: u16, points: impl FnOnce(TriangleId) -> Option<[Point; 3]>) -> bool {
        if line >= self.end {
            return false;
        }
        self.left.step();
        self.right.step();
        if line == self.middle {
            let Some(points) = points(self.id) else { return false };
            let [_, middle, bottom] = by_height(points);
            let edge = Edge::new(middle, bottom, i32::from(line));
            *(if self.middle_left { &mut self.left } else { &mut self.right }) = edge;
        }
        true
    }

    /// The first pixel that it covers on the line, and the first one after; no pixels if the latter is not larger.
    #[inline(always)]
    pub(crate) const fn extent(&self) -> (i16, i16) {
        (self.left.x, self.right.x)
    }

    /// Makes `depth` ready.
    #[cold]
    pub(crate) fn deepen<const LIGHTS: usize>(&mut self, triangle: &Triangle<LIGHTS>) {
        let points = triangle.points();
        let [w0, w1, w2] = triangle.corners.map(|corner| (corner.nearness() << FINER) as i32);
        let [p0, ..] = points;
        self.anchor = Gradient::anchor(p0);
        self.depth = match Gradient::new(points) {
            Some(gradient) => gradient.linear_wide(w0, w1 - w0, w2 - w0),
            // The mean of three numbers below 2³⁰·(1 + 2⁻⁷).
            None => [((i64::from(w0) + i64::from(w1) + i64::from(w2)) / 3) as i32, 0, 0],
        };
        self.deep = true;
    }

    /// The nearness at a pixel, 30 bits at the near plane; larger is nearer.
    #[inline]
    pub(crate) const fn depth_at(&self, x: i32, line: u16) -> i32 {
        let [at, dx, dy] = self.depth;
        let [ax, ay] = self.anchor;
        at.wrapping_add(dx.wrapping_mul(x - ax as i32)).wrapping_add(dy.wrapping_mul(line as i32 - ay as i32))
    }

    /// The increase of the nearness for a pixel to the right.
    #[inline]
    pub(crate) const fn depth_step(&self) -> i32 {
        let [_, dx, _] = self.depth;
        dx
    }
}

/// The corners from top to bottom; those of equal height in their order.
#[inline]
fn by_height([mut a, mut b, mut c]: [Point; 3]) -> [Point; 3] {
    if b.y < a.y {
        core::mem::swap(&mut a, &mut b);
    }
    if c.y < b.y {
        core::mem::swap(&mut b, &mut c);
        if b.y < a.y {
            core::mem::swap(&mut a, &mut b);
        }
    }
    [a, b, c]
}
