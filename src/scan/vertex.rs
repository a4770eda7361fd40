//! Projected vertices.

use embedded_graphics::geometry::Point;

use crate::{math::screen::SUBPIXELS, model::projection::Projected};

/// A vertex as a frame holds it: 8 bytes of place and nearness, 4 for each light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vertex<const LIGHTS: usize> {
    /// x in the upper 20 bits, the upper half of the nearness in the lower 12.
    x: u32,
    /// The same with y and the lower half.
    y: u32,
    /// For each light `[intensity · n·l, n·h]`, Q14.
    pub dots: [[i16; 2]; LIGHTS],
}

impl<const LIGHTS: usize> Vertex<LIGHTS> {
    /// No vertex yet.
    pub const NONE: Self = Self::new(None, [[0; 2]; LIGHTS]);

    /// A vertex there; or, for none, one that triangles must be clipped for.
    #[inline]
    #[must_use]
    pub const fn new(projected: Option<Projected>, dots: [[i16; 2]; LIGHTS]) -> Self {
        let mut vertex = Self { x: 0, y: 0, dots };
        if let Some(Projected { point, nearness }) = projected {
            vertex.place([point.x << 12, point.y << 12], nearness);
        }
        vertex
    }

    /// The same with that light.
    pub(crate) const fn lit<const OTHERS: usize>(self, dots: [[i16; 2]; OTHERS]) -> Vertex<OTHERS> {
        Vertex { x: self.x, y: self.y, dots }
    }

    /// Puts it there; the coordinates in Q12, rounded down.
    #[inline(always)]
    pub const fn place(&mut self, [x, y]: [i32; 2], nearness: u32) {
        self.x = (x as u32 & !0xfff) | (nearness >> 12);
        self.y = (y as u32 & !0xfff) | (nearness & 0xfff);
    }

    /// Place on the screen, in subpixels.
    #[inline(always)]
    #[must_use]
    pub const fn point(&self) -> Point {
        Point::new(self.x as i32 >> 12, self.y as i32 >> 12)
    }

    /// The column and the row of the first pixel centres at or after the place, as
    /// [`first_at`](crate::math::screen::first_at) finds them.
    #[inline(always)]
    #[must_use]
    pub const fn pixel(&self) -> Point {
        let [x, y] = self.words();
        Point::new(first_pixel(x), first_pixel(y))
    }

    /// The words with the coordinates, which are in the order of these or, of equal ones, in some order.
    #[inline(always)]
    pub(super) const fn words(&self) -> [i32; 2] {
        [self.x as i32, self.y as i32]
    }

    /// 1/z with 23 bits at the near plane; 0 for a vertex that could not be projected.
    #[inline(always)]
    #[must_use]
    pub const fn nearness(&self) -> u32 {
        ((self.x & 0xfff) << 12) | (self.y & 0xfff)
    }

    /// The bit above the nearness.
    const MARK: u32 = 1 << 11;

    /// Marks it: its nearness is not to be asked for until the mark is [taken away](Self::unmark).
    pub(crate) const fn mark(&mut self) {
        self.x |= Self::MARK;
    }

    /// Whether it is marked.
    pub(crate) const fn is_marked(&self) -> bool {
        self.x & Self::MARK != 0
    }

    /// Takes a mark away.
    pub(crate) const fn unmark(&mut self) {
        self.x &= !Self::MARK;
    }

    /// Makes sure that it can be marked: on the very near plane it needs the bit, and goes back by one unit.
    pub(crate) const fn unmarked(&mut self) {
        if self.is_marked() {
            self.x = (self.x & !Self::MARK) | (Self::MARK - 1);
            self.y |= 0xfff;
        }
    }
}

/// The first pixel centre at or after a coordinate, by the [word](Vertex::words) with it.
#[inline(always)]
pub(super) const fn first_pixel(word: i32) -> i32 {
    const HALF: i32 = (SUBPIXELS / 2 - 1) << 12;
    word.wrapping_add(HALF) >> 20
}
