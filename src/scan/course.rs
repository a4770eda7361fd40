//! How the sides of a triangle, or of a quadrilateral of two, and the diagonal between these run down past the corners.

/// What is to come at the next corners, from the top down.
///
/// Corners of the mesh run down the left side first, seen from the front; the diagonal joins the first and the third.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course(u8);

impl Course {
    /// Nothing.
    pub(super) const NONE: Self = Self(0);
    /// The next corner is on the left; so is the one after it.
    pub(super) const LEFT: u8 = 1;
    pub(super) const LEFT_AFTER: u8 = 2;
    /// The diagonal ends at the next corner; at the one after it.
    pub(super) const ENDS: u8 = 4;
    pub(super) const ENDS_AFTER: u8 = 8;
    /// The diagonal begins at the next corner.
    pub(super) const BEGINS: u8 = 16;
    /// Of two triangles, the second one is left of the diagonal.
    pub(super) const SECOND_LEFT: u8 = 32;
    /// The next corner is the last one, or meets the same line first; so is the one after it.
    pub(super) const LAST: u8 = 64;
    pub(super) const LAST_AFTER: u8 = 128;

    /// That of a quadrilateral, below its top corner, by the places of that and of the next two in the order of the mesh.
    #[inline(always)]
    pub(super) fn of(top: u32, first: u32, second: u32) -> Self {
        static COURSES: [Course; 64] = {
            let mut courses = [Course::NONE; 64];
            let mut i = 0;
            while i < 64 {
                #[expect(clippy::indexing_slicing, reason = "i < 64, evaluated by the compiler")]
                {
                    courses[i as usize] = Course::find(i & 3, i >> 2 & 3, i >> 4);
                }
                i += 1;
            }
            courses
        };
        COURSES.get((top | first << 2 | second << 4) as usize).copied().unwrap_or(Self::NONE)
    }

    const fn find(top: u32, first: u32, second: u32) -> Self {
        let last = (6_u32).wrapping_sub(top + first + second);
        let last = last.wrapping_sub(top) & 3;
        let (left, left_after) = (first.wrapping_sub(top) & 3 < last, second.wrapping_sub(top) & 3 < last);
        // From the upper end of the diagonal, corners go down its left side.
        let begins = top & 1 != 0;
        let upper = if begins { first } else { top };
        let mut course = 0;
        if left {
            course |= Self::LEFT;
        }
        if left_after {
            course |= Self::LEFT_AFTER;
        }
        if second & 1 == 0 {
            course |= Self::ENDS_AFTER;
        }
        if begins {
            course |= Self::BEGINS;
        }
        if upper != 0 {
            course |= Self::SECOND_LEFT;
        }
        Self(course)
    }

    /// That of a triangle, by the places of its top and its middle corner; seen from behind, corners run down the right side.
    #[inline(always)]
    pub(super) const fn of_one(top: u32, middle: u32, is_front: bool) -> Self {
        let follows = middle == top + 1 || middle + 2 == top;
        Self(if follows == is_front { Self::LEFT | Self::LEFT_AFTER } else { 0 })
    }

    #[inline(always)]
    pub(super) const fn is(self, what: u8) -> bool {
        self.0 & what != 0
    }

    /// Whether the edge that begins at the next corner, or ends there, is on the same side as that at the corner after it.
    #[inline(always)]
    pub(super) const fn goes_on(self) -> bool {
        (self.0 ^ self.0 >> 1) & Self::LEFT == 0
    }

    /// With the next corner, and the one after it, as the last one where they are.
    #[inline(always)]
    pub(super) const fn ending(self, [next, after]: [bool; 2]) -> Self {
        Self(self.0 | if next { Self::LAST } else { 0 } | if after { Self::LAST_AFTER } else { 0 })
    }

    /// From the next corner on.
    #[inline(always)]
    pub(super) const fn next(self) -> Self {
        let (stays, comes) = (Self::LEFT_AFTER | Self::SECOND_LEFT, Self::LEFT | Self::ENDS | Self::LAST);
        Self(self.0 & stays | self.0 >> 1 & comes | Self::LAST_AFTER)
    }
}
