//! The span table of a line.

use core::ops::Range;

use heapless::Vec;

/// A run of pixels of one triangle; no pixels if it ends where it starts. In two words, so that it is moved and compared fast.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// The first pixel in the upper half, the first one after it in the lower.
    pixels: i32,
    /// The number of its material in the upper half, that of its triangle among those of all slots, two in each, in the lower.
    source: u32,
}

impl Span {
    /// A span of no triangle.
    pub(crate) const NONE: Self = Self { pixels: 0, source: u32::MAX };

    /// No span starts left of it.
    pub(crate) const LEFTMOST: Self = Self { pixels: i32::MIN, ..Self::NONE };

    #[inline(always)]
    pub(crate) const fn new(start: i16, end: i16, slot: u16, look: u16) -> Self {
        Self { pixels: (start as i32) << 16 | end as u16 as i32, source: (look as u32) << 16 | (slot as u32) << 1 }
    }

    /// The same triangle's span from there to there.
    #[inline(always)]
    pub(crate) const fn with(self, start: i32, end: i32) -> Self {
        Self { pixels: start << 16 | end as u16 as i32, ..self }
    }

    /// The same of the right triangle.
    #[inline(always)]
    pub(crate) const fn right(self) -> Self {
        Self { source: self.source | 1, ..self }
    }

    /// What shows the left triangle, and the right one; either may be empty.
    #[inline(always)]
    pub(crate) fn halves(self, middle: i32) -> [Self; 2] {
        let (start, end) = (self.start(), self.end());
        let middle = middle.max(start).min(end);
        [self.with(start, middle), self.with(middle, end).right()]
    }

    /// The first pixel.
    #[inline(always)]
    #[must_use]
    pub const fn start(self) -> i32 {
        self.pixels >> 16
    }

    /// The first pixel after it.
    #[inline(always)]
    #[must_use]
    pub const fn end(self) -> i32 {
        self.pixels as i16 as i32
    }

    /// Its pixels in a row, if it lies in the picture.
    #[inline(always)]
    #[must_use]
    pub const fn range(self) -> Range<usize> {
        self.start() as u16 as usize..self.end() as u16 as usize
    }

    /// The slot among those that cross the line.
    #[inline(always)]
    pub(crate) const fn slot(self) -> u16 {
        self.source as u16 >> 1
    }

    /// Which triangle of the slot it is of: 0 for the left one, which all [halves](Self::halves) but the right ones are of.
    #[inline(always)]
    pub(crate) const fn half(self) -> usize {
        (self.source & 1) as usize
    }

    /// The number of its material in the picture.
    #[inline(always)]
    pub(crate) const fn look(self) -> u16 {
        (self.source >> 16) as u16
    }

    /// Whether it has no pixels.
    #[inline(always)]
    #[must_use]
    pub const fn is_empty(self) -> bool {
        self.start() >= self.end()
    }

    /// Whether it is of no triangle: no slot has this number.
    #[inline(always)]
    pub(crate) const fn is_none(self) -> bool {
        self.source == u32::MAX
    }

    /// Whether it comes after the other one: starts right of it, or starts where that does and ends right of it.
    #[inline(always)]
    pub(crate) const fn is_after(self, other: Self) -> bool {
        self.pixels > other.pixels
    }

    /// Whether it starts before this pixel.
    #[inline(always)]
    pub(crate) const fn starts_before(self, x: i32) -> bool {
        self.pixels < x << 16
    }
}

/// Spans that are handed on at once.
pub(super) const SPANS: usize = 16;

/// Some disjoint spans of one line, left to right, none of them empty, gaps showing the background.
#[derive(Clone, Debug, Default)]
pub(super) struct Table {
    spans: Vec<Span, SPANS>,
}

impl Table {
    pub(super) fn clear(&mut self) {
        self.spans.clear();
    }

    #[inline(always)]
    pub(super) fn is_full(&self) -> bool {
        self.spans.is_full()
    }

    #[inline(always)]
    pub(super) fn spans(&self) -> &[Span] {
        &self.spans
    }

    /// Adds a span. False if there is no room.
    #[inline(always)]
    pub(super) fn push(&mut self, span: Span) -> bool {
        self.spans.push(span).is_ok()
    }

    /// Adds a span, or lets the last one go on if it is of the same triangle. False if there is no room.
    #[inline(always)]
    pub(super) fn resume(&mut self, span: Span) -> bool {
        match self.spans.last_mut() {
            Some(last) if last.source == span.source => *last = last.with(last.start(), span.end()),
            _ => return self.push(span),
        }
        true
    }

    /// Lets the last span end at x.
    #[inline(always)]
    pub(super) fn cut(&mut self, x: i32) {
        match self.spans.last_mut() {
            Some(last) if last.start() < x => *last = last.with(last.start(), x),
            _ => {
                let _ = self.spans.pop();
            }
        }
    }
}
