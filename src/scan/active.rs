//! The triangles that cross a line.

use embedded_graphics::geometry::Point;

use super::{
    bucket::{at, Kept, TriangleId},
    course::Course,
    edge::Edge,
    geometry::Geometry,
    vertex::Vertex,
};
use crate::math::{
    gradient::Gradient,
    screen::{area, SUBPIXELS},
};

/// A triangle on one line, or two that share an edge and make a convex quadrilateral: where it begins and ends, how deep it is, and how
/// to go on to the next line.
#[derive(Clone, Copy, Debug)]
pub struct Active {
    left: Edge,
    right: Edge,
    /// Between two triangles; where only one of them is on the line, far out on the other's side.
    diagonal: Edge,
    /// The triangle left of the diagonal, which a single one is, and the one right of it.
    pub(crate) halves: [Half; 2],
    /// The first line below the next corner.
    turn: u16,
    /// The first line below the last corner.
    end: u16,
    /// The least and the largest nearness of the corners, the upper 16 bits, rounded apart.
    far: u16,
    near: u16,
    /// The corners still to come, from top to bottom, among the frame's vertices; the last one again where there are no three.
    lower: [u16; 3],
    /// What is to come at these corners.
    course: Course,
    /// Whether there are two triangles.
    is_pair: bool,
    pub(crate) sharing: Sharing,
    /// The next free slot, if this one is free.
    pub(crate) next: u16,
}

/// Whether two triangles share a facet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sharing {
    /// Each has its own, or there is only one.
    Apart,
    /// They were not seen yet.
    Unknown,
    Shared,
}

/// One of the triangles of an [`Active`].
#[derive(Clone, Copy, Debug)]
pub struct Half {
    /// Nearness at the centre of pixel (0, 0), and its increase for a pixel to the right and down; wrapping. Valid once `deep`.
    depth: [i32; 3],
    pub(crate) id: TriangleId,
    /// The number of its facet, from 1 on; 0 before it is set up.
    pub(crate) facet: u16,
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
        diagonal: Edge::NONE,
        halves: [Half::NONE; 2],
        turn: 0,
        end: 0,
        far: 0,
        near: 0,
        lower: [0; 3],
        course: Course::NONE,
        is_pair: false,
        sharing: Sharing::Apart,
        next: 0,
    };

    /// Becomes what was kept, on line `line`, on which or above which it must start. Returns the number of its material; none if
    /// it is not on that line.
    #[inline(never)]
    pub(crate) fn begin<const LIGHTS: usize>(
        &mut self,
        kept: Kept,
        line: u16,
        geometry: &Geometry<'_, '_, LIGHTS>,
    ) -> Option<u16> {
        let numbers = geometry.numbers(kept.triangle)?;
        let look = numbers.look();
        let [na, nb, nc] = numbers.corners;
        let [a, b, c] = at(geometry.vertices, numbers.corners)?;
        let [wa, wb, wc] = [a, b, c].map(Vertex::nearness);
        self.is_pair = kept.is_pair();
        self.sharing = if self.is_pair { Sharing::Unknown } else { Sharing::Apart };
        let names = [na, nb, nc, if self.is_pair { numbers.fourth()? } else { nc }];
        let [_, _, _, nd] = names;
        let vertices = [a, b, c, geometry.vertex(nd)?];
        let [_, _, _, d] = vertices;
        let wd = d.nearness();
        self.far = (wa.min(wb).min(wc).min(wd) >> 8) as u16;
        self.near = ((wa.max(wb).max(wc).max(wd) + 0xff) >> 8) as u16;
        let [t, m1, m2, e] = by_height(vertices, self.is_pair);
        self.course =
            if self.is_pair { Course::of(t, m1, m2) } else { Course::of_one(t, m1, area(a.point(), b.point(), c.point()) < 0) };
        self.lower = [pick(&names, m1), pick(&names, m2), pick(&names, e)];
        let [left, right] = &mut self.halves;
        (left.id, left.facet, left.deep) = (kept.triangle, 0, false);
        (right.id, right.facet, right.deep) = (kept.triangle, 0, false);
        if self.is_pair {
            if self.course.is(Course::SECOND_LEFT) { left } else { right }.id = kept.triangle.next();
        }

        let (top, first, second, last) = (pick(&vertices, t), pick(&vertices, m1), pick(&vertices, m2), pick(&vertices, e));
        let (start, end) = (i32::from(line), last.pixel().y);
        if start >= end {
            return None;
        }
        self.end = end as u16;
        let course = self.course;
        let [bent, straight] = self.edges(course.is(Course::LEFT));
        bent.join(top, first, start);
        straight.join(top, if course.goes_on() { last } else { second }, start);
        self.diagonal = Edge::beyond(!(course.is(Course::BEGINS) && course.is(Course::LEFT)));
        if self.is_pair && !course.is(Course::BEGINS) {
            self.diagonal.join(top, if course.is(Course::ENDS_AFTER) { second } else { last }, start);
        }
        let turn = first.pixel().y;
        self.turn = turn as u16;
        if turn <= start {
            self.bend(line.into(), geometry.vertices);
        }
        Some(look)
    }

    /// The edge on that side, and the other one.
    #[inline(always)]
    fn edges(&mut self, is_left: bool) -> [&mut Edge; 2] {
        if is_left {
            [&mut self.left, &mut self.right]
        } else {
            [&mut self.right, &mut self.left]
        }
    }

    /// The first of two triangles, if there are two.
    pub(crate) fn pair(&self) -> Option<TriangleId> {
        let [left, right] = self.halves;
        self.is_pair.then_some(left.id.min(right.id))
    }

    /// Number of triangles.
    pub(crate) const fn count(&self) -> u16 {
        1 + self.is_pair as u16
    }

    /// Whether line `line` is the first one below a corner.
    #[inline(always)]
    pub(crate) const fn turns(&self, line: u32) -> bool {
        line == self.turn as u32
    }

    /// Whether line `line` is the first one below the last corner.
    #[inline(always)]
    pub(crate) const fn ends(&self, line: u32) -> bool {
        line == self.end as u32
    }

    /// Turns to other edges on line `line`, the first one below a corner that is not the last.
    #[inline(never)]
    pub(crate) fn bend<const LIGHTS: usize>(&mut self, line: u32, vertices: &[Vertex<LIGHTS>]) {
        let line = line as i32;
        let vertex = |number: u16| vertices.get(usize::from(number));
        for _ in 0..2 {
            let ([a, b, c], course) = (self.lower, self.course);
            let (Some(here), Some(next)) = (vertex(a), vertex(b)) else { return };
            (self.lower, self.course) = ([b, c, c], course.next());
            let turn = next.pixel().y;
            self.turn = turn as u16;
            let below = if course.goes_on() { Some(next) } else { vertex(c) };
            if let Some(below) = below {
                let [edge, _] = self.edges(course.is(Course::LEFT));
                edge.join(here, below, line);
            }
            if course.is(Course::BEGINS) {
                if let Some(below) = if course.is(Course::ENDS_AFTER) { Some(next) } else { vertex(c) } {
                    self.diagonal.join(here, below, line);
                }
            } else if course.is(Course::ENDS) {
                self.diagonal = Edge::beyond(!course.is(Course::LEFT));
            }
            if turn > line {
                break;
            }
        }
    }

    /// On to the next line.
    #[inline(always)]
    pub(crate) fn step(&mut self) {
        self.diagonal.step();
        self.left.step();
        self.right.step();
    }

    /// The first pixel that it covers on the line, and the first one after; no pixels if the latter is not larger.
    #[inline(always)]
    pub(crate) const fn extent(&self) -> (i16, i16) {
        (self.left.x(), self.right.x())
    }

    /// The first pixel of the line right of the diagonal.
    #[inline(always)]
    pub(crate) const fn middle(&self) -> i16 {
        self.diagonal.x()
    }

    /// The left and the right edge.
    pub(crate) const fn sides(&self) -> [&Edge; 2] {
        [&self.left, &self.right]
    }

    /// The left and the right edge of one of the triangles; of a pair, if the other one covers no pixel of the line.
    pub(crate) fn sides_of(&self, half: usize) -> [&Edge; 2] {
        let (start, end) = self.extent();
        match half {
            0 if self.middle() < end => [&self.left, &self.diagonal],
            1 if self.middle() > start => [&self.diagonal, &self.right],
            _ => self.sides(),
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

impl Half {
    const NONE: Self = Self { depth: [0; 3], id: TriangleId(0), facet: 0, deep: false };

    /// Makes `depth` ready. Returns 1 if that took 64-bit divisions, else 0.
    #[cold]
    #[inline(never)]
    pub(crate) fn deepen<const LIGHTS: usize>(&mut self, geometry: &Geometry<'_, '_, LIGHTS>) -> u32 {
        let Some(corners) = geometry.corners(self.id) else { return 0 };
        let points = corners.map(Vertex::point);
        let [p0, ..] = points;
        let [x, y] = Gradient::anchor(p0).map(i32::from);
        let nearness @ [a, b, c] = corners.map(|corner| corner.nearness() as i32);
        let reach = ((a.max(b).max(c) + 0xff) >> 8) - (a.min(b).min(c) >> 8);
        let ([at, dx, dy], exact) = plane(points, nearness, reach);
        self.depth = [at.wrapping_sub(dx.wrapping_mul(x)).wrapping_sub(dy.wrapping_mul(y)), dx, dy];
        self.deep = true;
        exact
    }

    /// The nearness at a pixel, 30 bits at the near plane; larger is nearer.
    #[inline(always)]
    pub(crate) const fn depth_at(&self, x: i32, line: u16) -> i32 {
        let [at, dx, dy] = self.depth;
        at.wrapping_add(dx.wrapping_mul(x)).wrapping_add(dy.wrapping_mul(line as i32))
    }

    /// The increase of the nearness for a pixel to the right, and down.
    pub(crate) const fn depth_steps(&self) -> [i32; 2] {
        let [_, dx, dy] = self.depth;
        [dx, dy]
    }

    /// The increase of the nearness for a pixel to the right.
    #[inline]
    pub(crate) const fn depth_step(&self) -> i32 {
        let [_, dx, _] = self.depth;
        dx
    }
}

/// The depth at [the anchor](Gradient::anchor), and its increase for a pixel to the right and down, wrapping; with the difference
/// between nearest and farthest corner as [`Active::reach`] has it. And 1 if that took 64-bit divisions, else 0.
///
/// At each pixel that the triangle covers the depth is off by less than 2¹⁴, in fact by 6300 at most. As the reach is in units of 2¹⁵, two triangles of which
/// one as a whole is nearer are in the same order by their depths: there is one order for all ways to find who is seen.
#[inline(always)]
fn plane(points: [Point; 3], [w0, w1, w2]: [i32; 3], reach: i32) -> ([i32; 3], u32) {
    match Gradient::with_bits(points) {
        // Of 2¹⁴, at most half for λ1 and λ2, and a quarter for ρ.
        Some((gradient, bits)) if reach >> (bits.min(16) - 3).max(0) == 0 => {
            (gradient.linear_wide(w0, w1 - w0, w2 - w0, FINER), 0)
        }
        _ => (exact_plane(points, [w0, w1, w2]), 1),
    }
}

/// The same by 64-bit divisions, each number off by less than a unit: for triangles so thin, large or steep that the gradient has too
/// few bits.
#[cold]
#[inline(never)]
fn exact_plane([p0, p1, p2]: [Point; 3], [w0, w1, w2]: [i32; 3]) -> [i32; 3] {
    let from_p0 = |p: Point| [p.x - p0.x, p.y - p0.y].map(i64::from);
    let ([ax, ay], [bx, by]) = (from_p0(p1), from_p0(p2));
    let [d1, d2] = [w1 - w0, w2 - w0].map(i64::from);
    // Products of 21 and 25 bits; with those of a place in a pixel and of the finer unit 62.
    let [x, y] = [d1 * by - d2 * ay, d2 * ax - d1 * bx];
    let [fx, fy] = [p0.x, p0.y].map(|place| i64::from(SUBPIXELS / 2 - (place & (SUBPIXELS - 1))));
    let area = ax * by - ay * bx;
    let [at, x, y] = [x * fx + y * fy, x * i64::from(SUBPIXELS), y * i64::from(SUBPIXELS)]
        .map(|numerator| (numerator << FINER).checked_div_euclid(area).unwrap_or(0) as i32);
    [(w0 << FINER).wrapping_add(at), x, y]
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

#[cfg(test)]
#[expect(clippy::indexing_slicing, reason = "a test may fail")]
mod tests {
    use super::*;

    /// Twice the area, as far as 20 bits of coordinates go.
    fn area([[ax, ay], [bx, by], [cx, cy]]: [[i32; 2]; 3]) -> i128 {
        let [bx, by, cx, cy] = [bx - ax, by - ay, cx - ax, cy - ay].map(i128::from);
        bx * cy - by * cx
    }

    /// At pixels of triangles of all sizes, down to the thinnest.
    #[test]
    fn depths_are_off_by_less_than_half_a_unit_of_the_reach() {
        let mut state = 1_u64;
        let mut random = |below: i32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (((state >> 33) as i64 * i64::from(below)) >> 31) as i32
        };
        let (mut counts, mut most) = ([0; 2], [0.0; 2]);
        for round in 0..400_000 {
            let pixel = [random(1024), random(1024)];
            let p = pixel.map(|c| 256 * c + 128);
            let size = 1 << (2 + round % 17);
            let mut near = |[x, y]: [i32; 2], size: i32| [x + random(2 * size + 1) - size, y + random(2 * size + 1) - size];
            let (a, b) = (near(p, size), near(p, size));
            // Opposite to one of them, or to their middle; how far off that, makes the triangle thick or thin.
            let opposite = [0, 1].map(|i| if round % 2 == 0 { 2 * p[i] - a[i] } else { 2 * p[i] - (a[i] + b[i]) / 2 });
            let c = near(opposite, 1 << (round / 17 % 12));
            let corners = [a, b, c];
            let [at_a, at_b, at_c] = [area([p, b, c]), area([a, p, c]), area([a, b, p])];
            let whole = area(corners);
            let inside = [at_a, at_b, at_c].iter().all(|part| part * whole.signum() >= 0);
            if whole == 0 || !inside || corners.as_flattened().iter().any(|c| c.abs() >= 1 << 19) {
                continue;
            }
            let span = 1 << (1 + round / 5 % 23);
            let nearness = [(); 3].map(|()| (1 << 23) - random(span));
            let (least, largest) =
                nearness.iter().fold((i32::MAX, 0), |(least, largest), near| (least.min(*near), largest.max(*near)));
            let reach = ((largest + 0xff) >> 8) - (least >> 8);

            let points = corners.map(|[x, y]| Point::new(x, y));
            let ([depth, dx, dy], kind) = plane(points, nearness, reach);
            let [ax, ay] = Gradient::anchor(points[0]).map(i32::from);
            let depth = depth.wrapping_add(dx.wrapping_mul(pixel[0] - ax)).wrapping_add(dy.wrapping_mul(pixel[1] - ay));
            let [wa, wb, wc] = nearness.map(i128::from);
            let exact = (((wa * at_a + wb * at_b + wc * at_c) << FINER) as f64) / whole as f64;
            let error = (f64::from(depth) - exact).abs();
            assert!(error < f64::from(1 << 14), "{corners:?} {nearness:?} at {pixel:?}: {error}");
            let kind = kind as usize;
            counts[kind] += 1;
            most[kind] = f64::max(most[kind], error);
        }
        assert!(counts.iter().all(|count| *count > 50_000), "{counts:?}");
        assert!(most[0] < 6300.0 && most[1] < 1800.0, "{most:?}");
    }
}
