//! The triangles of a picture by the line on which they start.

use embedded_graphics::{geometry::Size, primitives::Rectangle};

use super::vertex::Vertex;

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

/// Twice the area of a triangle, given two of its edges: units of 2¹⁰ square subpixels, and the rest. Below 0 if it shows the eye its
/// front.
#[derive(Clone, Copy)]
struct Area {
    high: i32,
    low: i32,
}

impl Area {
    #[inline(always)]
    fn of([bx, by]: [i32; 2], [cx, cy]: [i32; 2]) -> Self {
        // Products of 20 and 10 bits.
        let part = |cx: i32, cy: i32| bx.wrapping_mul(cy).wrapping_sub(by.wrapping_mul(cx));
        Self { high: part(cx >> 10, cy >> 10), low: part(cx & 0x3ff, cy & 0x3ff) }
    }

    #[inline(always)]
    const fn is_front(self) -> bool {
        self.high.wrapping_add(self.low >> 10) < 0
    }

    /// Whether the triangle covers anything on the screen and shows a side that is to be seen.
    #[inline(always)]
    const fn is_seen(self, double_sided: bool) -> bool {
        let high = self.high.wrapping_add(self.low >> 10);
        high < 0 || (double_sided && (high > 0 || self.low & 0x3ff != 0))
    }

    /// Whether what is left of two areas without a third one shows its front.
    #[inline(always)]
    const fn is_rest_front(self, other: Self, without: Self) -> bool {
        let high = self.high.wrapping_add(other.high).wrapping_sub(without.high);
        let low = self.low.wrapping_add(other.low).wrapping_sub(without.low);
        Self { high, low }.is_front()
    }
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
        let mut id = first;
        let mut rest = triangles;
        while let [triangle, others @ ..] = rest {
            let this = id;
            (rest, id) = (others, id.next());
            let Some([a, b, c]) = at(vertices, *triangle) else { continue };
            let (pa, pb, pc) = (a.point(), b.point(), c.point());
            let (ab, ac) = ([pb.x - pa.x, pb.y - pa.y], [pc.x - pa.x, pc.y - pa.y]);
            let area = Area::of(ab, ac);
            let is_seen = area.is_seen(double_sided);
            let fourth = match others {
                [next, ..] if pairs => fourth(vertices, *triangle, *next),
                _ => None,
            };
            let Some(d) = fourth else {
                if is_seen {
                    sorted += self.keep([a, b, c, c], this, false);
                }
                continue;
            };
            // Both triangles at once.
            (rest, id) = (others.get(1..).unwrap_or_default(), id.next());
            let pd = d.point();
            let ad = [pd.x - pa.x, pd.y - pa.y];
            let other = Area::of(ac, ad);
            if area.is_front() && other.is_front() {
                let corner = Area::of(ab, ad);
                if corner.is_front() && area.is_rest_front(other, corner) {
                    sorted += self.keep([a, b, c, d], this, true);
                    continue;
                }
            }
            if is_seen {
                sorted += self.keep([a, b, c, c], this, false);
            }
            if other.is_seen(double_sided) {
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
    let [a, b, c, d] = corners.map(|corner| corner.pixel());
    let [x, y] = [[a.x, b.x, c.x, d.x], [a.y, b.y, c.y, d.y]].map(|borders| {
        let [a, b, c, d] = borders;
        [a.min(b).min(c).min(d), a.max(b).max(c).max(d)]
    });
    (is_between(y, size.height as i32) && is_between(x, size.width as i32)).then(|| y[0].max(0) as usize)
}

/// Whether one of the first `count` pixels lies between two borders of pixels.
#[inline(always)]
const fn is_between([least, most]: [i32; 2], count: i32) -> bool {
    least < most && most > 0 && least < count
}
