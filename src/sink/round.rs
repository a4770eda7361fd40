//! Round panels.

use crate::{math::root::square_root, scan::columns::Columns};

/// A round panel, such as those of the GC9A01: a circle in a square memory, whose corners are not seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Round {
    diameter: u16,
}

impl Round {
    /// A panel of so many pixels across, up to 1024; more count as 1024.
    #[must_use]
    pub const fn new(diameter: u16) -> Self {
        Self { diameter: if diameter < 1024 { diameter } else { 1024 } }
    }

    /// The columns of line y that the circle touches; none below it.
    #[must_use]
    pub fn columns(self, y: u16) -> Columns {
        let (diameter, y) = (u32::from(self.diameter), u32::from(y));
        if y >= diameter {
            return Columns::NONE;
        }
        // In half pixels, from the centre: the nearer edge of the line, and half the chord that the circle cuts out of it.
        let edge = (2 * y + 1).abs_diff(diameter).saturating_sub(1);
        let chord = root(diameter * diameter - edge * edge);
        let start = (diameter - chord) >> 1;
        Columns { start: start as u16, end: (diameter - start) as u16 }
    }
}

/// The square root of a whole number up to 2²⁰, rounded up.
fn root(x: u32) -> u32 {
    // x/2²⁰ in Q30, and its root in Q20 of a whole, to 10 units. The root of a number above k² is at least 2²⁰/2049 = 511 units
    // above k: with 256 units less than the next whole number, that of k² stays at k.
    (square_root(x << 10) + (1 << 20) - 256) >> 20
}
