//! A run of columns on a line.

use core::ops::Range;

/// A run of columns, from the first to before the end; none if it ends where it starts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Columns {
    /// The first column.
    pub start: u16,
    /// The first one after it.
    pub end: u16,
}

impl Columns {
    /// No columns.
    pub const NONE: Self = Self { start: 0, end: 0 };

    /// All that there can be.
    pub const ALL: Self = Self { start: 0, end: u16::MAX };

    /// Whether there are none.
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.start >= self.end
    }

    /// How many they are.
    #[must_use]
    pub const fn len(self) -> u16 {
        self.end.saturating_sub(self.start)
    }

    /// Their pixels in a row.
    #[must_use]
    pub const fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// The least run that has the columns of both.
    #[must_use]
    pub fn hull(self, other: Self) -> Self {
        match (self.is_empty(), other.is_empty()) {
            (_, true) => self,
            (true, _) => other,
            _ => Self { start: self.start.min(other.start), end: self.end.max(other.end) },
        }
    }

    /// The columns that are in both.
    #[must_use]
    pub fn within(self, other: Self) -> Self {
        let both = Self { start: self.start.max(other.start), end: self.end.min(other.end) };
        if both.is_empty() {
            Self::NONE
        } else {
            both
        }
    }
}
