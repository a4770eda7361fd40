//! The span table of a line.

use heapless::Vec;

/// A run of pixels in which one triangle is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The first pixel.
    pub start: u16,
    /// The first pixel after it.
    pub end: u16,
    /// The place of the triangle among those that cross the line.
    pub(crate) slot: u16,
}

/// Disjoint spans of one line, left to right, gaps showing the background.
pub type Table<const SPANS: usize> = Vec<Span, SPANS>;
