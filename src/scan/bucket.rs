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
}

/// A kept triangle, and the next one that starts on the same line.
#[derive(Clone, Copy, Debug)]
pub struct Kept {
    /// One more than its place; 0 at the end.
    pub(crate) next: u16,
    pub(crate) triangle: TriangleId,
}

/// The triangles that start on one line.
#[derive(Clone, Debug)]
pub(crate) struct Starting<'a> {
    pub(crate) kept: &'a [Kept],
    /// One more than the place of the next one; 0 at the end.
    pub(crate) next: u16,
}

impl Iterator for Starting<'_> {
    type Item = TriangleId;

    fn next(&mut self) -> Option<TriangleId> {
        let kept = self.kept.get(usize::from(self.next).wrapping_sub(1))?;
        self.next = kept.next;
        Some(kept.triangle)
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

/// Whether a triangle covers anything on the screen and shows the eye a side that is to be seen.
#[inline(always)]
fn is_seen<const LIGHTS: usize>([a, b, c]: [&Vertex<LIGHTS>; 3], double_sided: bool) -> bool {
    let (a, b, c) = (a.point(), b.point(), c.point());
    let (bx, by, cx, cy) = (b.x - a.x, b.y - a.y, c.x - a.x, c.y - a.y);
    // Twice the area in two parts, as products of 20 and 10 bits.
    let part = |cx: i32, cy: i32| bx.wrapping_mul(cy).wrapping_sub(by.wrapping_mul(cx));
    let low = part(cx & 0x3ff, cy & 0x3ff);
    let high = part(cx >> 10, cy >> 10).wrapping_add(low >> 10);
    high < 0 || (double_sided && (high > 0 || low & 0x3ff != 0))
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
    #[inline(never)]
    pub(crate) fn sort<const LIGHTS: usize>(
        &mut self,
        vertices: &[Vertex<LIGHTS>],
        triangles: &[[u16; 3]],
        first: TriangleId,
        double_sided: bool,
    ) -> Sorted {
        let size = self.viewport.size;
        let (mut used, mut left_out) = (self.used, 0);
        let TriangleId(mut id) = first;
        for corners in triangles {
            if let Some(corners) = at(vertices, *corners) {
                if is_seen(corners, double_sided) {
                    if let Some(line) = first_line(corners, size) {
                        match (self.heads.get_mut(line), self.kept.get_mut(used)) {
                            (Some(head), Some(room)) => {
                                *room = Kept { next: *head, triangle: TriangleId(id) };
                                used += 1;
                                *head = used as u16;
                            }
                            _ => left_out += 1,
                        }
                    }
                }
            }
            id = id.wrapping_add(1);
        }
        Sorted { fitted: (used - core::mem::replace(&mut self.used, used)) as u16, left_out }
    }

    /// Takes back all triangles after so many.
    pub(crate) fn forget(&mut self, used: usize) {
        while self.used > used {
            let place = self.used as u16;
            self.used -= 1;
            let next = self.kept.get(self.used).map_or(0, |kept| kept.next);
            if let Some(head) = self.heads.iter_mut().find(|head| **head == place) {
                *head = next;
            }
        }
    }
}

/// The line on which a triangle starts in a picture of that size; none if it cannot cover a pixel.
#[inline(always)]
fn first_line<const LIGHTS: usize>(corners: [&Vertex<LIGHTS>; 3], size: Size) -> Option<usize> {
    let [a, b, c] = corners.map(Vertex::pixel);
    let is_between = is_between([a.y, b.y, c.y], size.height as i32) && is_between([a.x, b.x, c.x], size.width as i32);
    is_between.then(|| a.y.min(b.y).min(c.y).max(0) as usize)
}

/// Whether one of the first `count` pixels lies between three borders of pixels.
#[inline(always)]
fn is_between([a, b, c]: [i32; 3], count: i32) -> bool {
    if a == b && a == c {
        return false;
    }
    // One border inside is enough, as another one is elsewhere.
    (a > 0 && a < count) || (a.max(b).max(c) > 0 && a.min(b).min(c) < count)
}
