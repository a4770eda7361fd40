//! The triangles of a picture by the line on which they start.

use embedded_graphics::{geometry::Size, primitives::Rectangle};

use super::vertex::{first_pixel, Vertex};

/// Number of a triangle in a frame: through the meshes in the order they were added; those made by clipping or splitting count down
/// from 65534.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TriangleId(pub(crate) u16);

impl TriangleId {
    /// The last number, that of the first made triangle.
    pub(crate) const MADE: u16 = 0xfffe;

    /// The next triangle of the mesh.
    pub(crate) const fn next(self) -> Self {
        Self(self.0.wrapping_add(1))
    }
}

/// A kept triangle, or two that were kept together, and the next one that starts on the same line.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    /// One more than its place, 0 at the end; and [`PAIR`](Self::PAIR).
    next: u16,
    /// The first of two, the other one being the next of the mesh.
    pub(crate) triangle: TriangleId,
}

impl Kept {
    /// The bit that says that there are two.
    const PAIR: u16 = 1 << 15;

    /// Whether there are two.
    #[inline(always)]
    pub(crate) const fn is_pair(self) -> bool {
        self.next & Self::PAIR != 0
    }

    /// One more than the place of the next one; 0 at the end.
    #[inline(always)]
    const fn next(self) -> u16 {
        self.next & !Self::PAIR
    }

    /// The first triangle and the last.
    pub(crate) const fn ends(self) -> [TriangleId; 2] {
        [self.triangle, if self.is_pair() { self.triangle.next() } else { self.triangle }]
    }

    /// The triangles.
    pub(crate) fn triangles(self) -> impl Iterator<Item = TriangleId> {
        self.ends().into_iter().take(self.count())
    }

    /// Number of triangles.
    pub(crate) const fn count(self) -> usize {
        1 + self.is_pair() as usize
    }
}

/// The triangles that start on one line.
#[derive(Clone, Debug)]
pub(crate) struct Starting<'a> {
    pub(crate) kept: &'a [Kept],
    /// One more than the place of the next one; 0 at the end.
    pub(crate) next: u16,
}

impl Iterator for Starting<'_> {
    type Item = Kept;

    fn next(&mut self) -> Option<Kept> {
        let kept = self.kept.get(usize::from(self.next).wrapping_sub(1))?;
        self.next = kept.next();
        Some(*kept)
    }
}

/// How many triangles that can cover a pixel got a place.
#[derive(Default)]
pub(crate) struct Sorted {
    pub(crate) fitted: u16,
    pub(crate) left_out: u16,
}

impl core::ops::AddAssign for Sorted {
    fn add_assign(&mut self, more: Self) {
        self.fitted += more.fitted;
        self.left_out += more.left_out;
    }
}

/// The vertices with these numbers.
#[inline(always)]
pub(crate) fn at<const LIGHTS: usize>(vertices: &[Vertex<LIGHTS>], [a, b, c]: [u16; 3]) -> Option<[&Vertex<LIGHTS>; 3]> {
    Some([vertices.get(usize::from(a))?, vertices.get(usize::from(b))?, vertices.get(usize::from(c))?])
}

/// Twice the areas of the triangles a, b, c and a, c, d, or numbers of the same signs, below 0 if they show the eye their fronts; and
/// whether both do and are convex together. Given the ways from a to b, to c, and to d.
#[inline(always)]
fn areas([ab, ac, ad]: [[i32; 2]; 3]) -> ([i32; 2], bool) {
    // Below 64 pixels all of it fits 32 bits.
    let far = [ab, ac, ad].iter().fold(0, |bits, [x, y]| bits | (x + (1 << 14)) | (y + (1 << 14)));
    if far as u32 >> 15 != 0 {
        return far_areas([ab, ac, ad]);
    }
    let area = |[bx, by]: [i32; 2], [cx, cy]: [i32; 2]| bx * cy - by * cx;
    let (first, second) = (area(ab, ac), area(ac, ad));
    let is_convex = first < 0 && second < 0 && {
        let corner = area(ab, ad);
        corner < 0 && first + second < corner
    };
    ([first, second], is_convex)
}

/// The same in 64 bits.
#[cold]
#[inline(never)]
fn far_areas([ab, ac, ad]: [[i32; 2]; 3]) -> ([i32; 2], bool) {
    let area = |[bx, by]: [i32; 2], [cx, cy]: [i32; 2]| i64::from(bx) * i64::from(cy) - i64::from(by) * i64::from(cx);
    let (first, second, corner) = (area(ab, ac), area(ac, ad), area(ab, ad));
    ([first, second].map(|area| area.signum() as i32), first < 0 && second < 0 && corner < 0 && first + second < corner)
}

/// The triangles that are to be drawn, by the line on which they start.
#[derive(Clone, Debug)]
pub(crate) struct Buckets<const TRIANGLES: usize, const LINES: usize> {
    pub(crate) viewport: Rectangle,
    pub(crate) heads: [u16; LINES],
    pub(crate) kept: [Kept; TRIANGLES],
    /// Number of triangles that are kept.
    pub(crate) used: usize,
}

impl<const TRIANGLES: usize, const LINES: usize> Buckets<TRIANGLES, LINES> {
    pub(crate) const fn new() -> Self {
        const { assert!(TRIANGLES < Kept::PAIR as usize, "places are numbered in 15 bits") };
        let kept = [Kept { next: 0, triangle: TriangleId(0) }; TRIANGLES];
        Self { viewport: Rectangle::zero(), heads: [0; LINES], kept, used: 0 }
    }

    /// Starts a new frame.
    pub(crate) fn clear(&mut self, viewport: Rectangle) {
        self.viewport = viewport;
        self.heads = [0; LINES];
        self.used = 0;
    }

    /// Sorts triangles with consecutive numbers and projected corners, as far as they are seen.
    ///
    /// If pairs are wanted, two that follow each other as a, b, c and a, c, d are kept as one where they show their fronts and are
    /// convex together.
    #[inline(never)]
    pub(crate) fn sort<const LIGHTS: usize>(
        &mut self,
        vertices: &[Vertex<LIGHTS>],
        triangles: &[[u16; 3]],
        first: TriangleId,
        double_sided: bool,
        pairs: bool,
    ) -> Sorted {
        let mut sorted = Sorted::default();
        let mut rest = triangles;
        while let [triangle, others @ ..] = rest {
            let this = TriangleId(first.0.wrapping_add((triangles.len() - rest.len()) as u16));
            rest = others;
            let Some([a, b, c]) = at(vertices, *triangle) else { continue };
            let mut d = c;
            if let (true, [next, others @ ..]) = (pairs, others) {
                if let Some(fourth) = fourth(vertices, *triangle, *next) {
                    // Both triangles at once.
                    (d, rest) = (fourth, others);
                }
            }
            let here = a.point();
            let ([first, second], is_convex) = areas([b, c, d].map(|corner| {
                let there = corner.point();
                [there.x - here.x, there.y - here.y]
            }));
            if is_convex {
                sorted += self.keep([a, b, c, d], this, true);
                continue;
            }
            let is_seen = |area: i32| area < 0 || double_sided && area > 0;
            if is_seen(first) {
                sorted += self.keep([a, b, c, c], this, false);
            }
            // Of one alone, the second has no area.
            if is_seen(second) {
                sorted += self.keep([a, c, d, d], this.next(), false);
            }
        }
        sorted
    }

    /// The same for triangles whose vertices are not stored.
    #[inline(never)]
    pub(crate) fn sort_anew(
        &mut self,
        vertex: impl Fn(u16) -> Option<Vertex<0>>,
        triangles: &[[u16; 3]],
        first: TriangleId,
        double_sided: bool,
        pairs: bool,
    ) -> Sorted {
        let mut sorted = Sorted::default();
        let (mut rest, mut id) = (triangles, first);
        // Triangles that follow each other in a mesh share corners, most of them.
        let mut last: [Option<(u16, Vertex<0>)>; 4] = [None; 4];
        while let [[a, b, c], others @ ..] = rest {
            let fourth = match others {
                [[e, f, d], ..] if pairs && a == e && c == f => Some(*d),
                _ => None,
            };
            let (triangles, after): (&[_], _) = if fourth.is_some() {
                (&[[0, 1, 2], [0, 2, 3]], others.get(1..).unwrap_or_default())
            } else {
                (&[[0, 1, 2]], others)
            };
            let find = |corner: u16| {
                let known = last.iter().flatten().find(|(number, _)| *number == corner);
                known.copied().or_else(|| Some((corner, vertex(corner)?)))
            };
            let (a, b, c) = (find(*a), find(*b), find(*c));
            let corners = [a, b, c, fourth.map_or(c, find)];
            if let [Some((_, a)), Some((_, b)), Some((_, c)), Some((_, d))] = corners {
                sorted += self.sort(&[a, b, c, d], triangles, id, double_sided, pairs);
            }
            last = corners;
            id = TriangleId(id.0.wrapping_add(triangles.len() as u16));
            rest = after;
        }
        sorted
    }

    /// Keeps a triangle, or a pair, if it can cover a pixel.
    #[inline(never)]
    fn keep<const LIGHTS: usize>(&mut self, corners: [&Vertex<LIGHTS>; 4], triangle: TriangleId, is_pair: bool) -> Sorted {
        let count = 1 + u16::from(is_pair);
        let Some(line) = first_line(corners, self.viewport.size) else { return Sorted::default() };
        let (Some(head), Some(room)) = (self.heads.get_mut(line), self.kept.get_mut(self.used)) else {
            return Sorted { fitted: 0, left_out: count };
        };
        *room = Kept { next: *head | if is_pair { Kept::PAIR } else { 0 }, triangle };
        self.used += 1;
        *head = self.used as u16;
        Sorted { fitted: count, left_out: 0 }
    }

    /// Takes back all triangles after so many.
    pub(crate) fn forget(&mut self, used: usize) {
        while self.used > used {
            let place = self.used as u16;
            self.used -= 1;
            let next = self.kept.get(self.used).map_or(0, |kept| kept.next());
            if let Some(head) = self.heads.iter_mut().find(|head| **head == place) {
                *head = next;
            }
        }
    }
}

/// The last corner of the quadrilateral that two triangles are, if they are a, b, c and a, c, d.
#[inline(always)]
fn fourth<const LIGHTS: usize>(vertices: &[Vertex<LIGHTS>], [a, _, c]: [u16; 3], [e, f, d]: [u16; 3]) -> Option<&Vertex<LIGHTS>> {
    if a == e && c == f {
        vertices.get(usize::from(d))
    } else {
        None
    }
}

/// The line on which a quadrilateral starts in a picture of that size; none if it cannot cover a pixel.
#[inline(always)]
fn first_line<const LIGHTS: usize>(corners: [&Vertex<LIGHTS>; 4], size: Size) -> Option<usize> {
    let [a, b, c, d] = corners.map(|corner| corner.words());
    let [x, y] = [[a[0], b[0], c[0], d[0]], [a[1], b[1], c[1], d[1]]]
        .map(|[a, b, c, d]| [a.min(b).min(c).min(d), a.max(b).max(c).max(d)].map(first_pixel));
    (is_between(y, size.height as i32) && is_between(x, size.width as i32)).then(|| y[0].max(0) as usize)
}

/// Whether one of the first `count` pixels lies between two borders of pixels.
#[inline(always)]
const fn is_between([least, most]: [i32; 2], count: i32) -> bool {
    least < most && most > 0 && least < count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn areas_are_the_same_in_32_bits() {
        let mut state = 1_u32;
        let mut random = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            // Small ones, for areas of 0, and up to the largest.
            let bits = 2 + (state >> 8) % 14;
            (state as i32) >> (32 - bits)
        };
        let mut convex = 0;
        for _ in 0..100_000 {
            let ways = [[(); 2]; 3].map(|way| way.map(|()| random().clamp(-(1 << 14), (1 << 14) - 1)));
            let ([first, second], is_convex) = areas(ways);
            assert_eq!(([first.signum(), second.signum()], is_convex), far_areas(ways), "{ways:?}");
            convex += u32::from(is_convex);
        }
        assert!(convex > 5_000, "{convex}");
    }
}
