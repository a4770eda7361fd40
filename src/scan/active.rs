//! The triangles that cross a line.

use embedded_graphics::geometry::Point;

use super::{bucket::TriangleId, edge::Edge, geometry::Geometry, table::Span, vertex::Vertex};
use crate::math::{
    gradient::Gradient,
    screen::{area, first_at, SUBPIXELS},
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

    /// Edges for which [`Edge::set`] takes 64 bits where it begins on line `line`, or turns there.
    pub(crate) fn long<const LIGHTS: usize>(corners: [&Vertex<LIGHTS>; 3], line: u16, turns: bool) -> u32 {
        let [(_, top), (_, middle), (_, bottom)] = by_height(corners.map(|corner| (0, corner)));
        let line = i32::from(line);
        let (from, to) = if line < first_at(middle.point().y) { (top, middle) } else { (middle, bottom) };
        u32::from(Edge::is_long(from, to, line)) + u32::from(!turns && Edge::is_long(top, bottom, line))
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

    /// Whether line `line` is the first one below the middle corner.
    pub(crate) fn turned_on<const LIGHTS: usize>(&self, line: u16, vertices: &[Vertex<LIGHTS>]) -> bool {
        let [middle, _] = self.lower;
        vertices.get(usize::from(middle)).is_some_and(|middle| first_at(middle.point().y) == i32::from(line))
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

    /// Makes `depth` ready. Returns 1 if that took 64-bit divisions, else 0.
    #[cold]
    #[inline(never)]
    pub(crate) fn deepen<const LIGHTS: usize>(&mut self, geometry: &Geometry<'_, '_, LIGHTS>) -> u32 {
        let Some(corners) = geometry.corners(self.id) else { return 0 };
        let points = corners.map(Vertex::point);
        let [p0, ..] = points;
        let [x, y] = Gradient::anchor(p0).map(i32::from);
        let [far, near] = self.reach();
        let ([at, dx, dy], exact) = plane(points, corners.map(|corner| corner.nearness() as i32), near - far);
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
