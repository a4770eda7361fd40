//! The span table of a line.

/// A run of pixels of one triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(align(4))]
pub struct Span {
    /// The first pixel.
    pub start: i16,
    /// The first pixel after it.
    pub end: i16,
    /// The slot of the triangle among those that cross the line.
    pub(crate) slot: u16,
    /// The number of its material in the picture.
    pub(crate) look: u16,
}

/// Disjoint spans of one line, left to right, none of them empty, gaps showing the background.
#[derive(Clone, Debug)]
pub(crate) struct Table<const SPANS: usize> {
    spans: [Span; SPANS],
    count: usize,
}

impl<const SPANS: usize> Table<SPANS> {
    pub(crate) const fn new() -> Self {
        Self { spans: [Span { start: 0, end: 0, slot: 0, look: 0 }; SPANS], count: 0 }
    }

    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }

    #[inline(always)]
    pub(crate) fn is_full(&self) -> bool {
        self.count >= SPANS
    }

    #[inline(always)]
    pub(crate) fn spans(&self) -> &[Span] {
        self.spans.get(..self.count).unwrap_or_default()
    }

    #[inline(always)]
    fn last(&mut self) -> Option<&mut Span> {
        self.spans.get_mut(self.count.wrapping_sub(1))
    }

    /// Adds a span. False if there is no room.
    #[inline(always)]
    pub(crate) fn push(&mut self, span: Span) -> bool {
        let Some(free) = self.spans.get_mut(self.count) else { return false };
        *free = span;
        self.count += 1;
        true
    }

    /// The free places; [`keep`](Self::keep) says how many of them are left.
    #[inline(always)]
    pub(crate) fn free(&mut self) -> core::slice::IterMut<'_, Span> {
        self.spans.get_mut(self.count..).unwrap_or_default().iter_mut()
    }

    /// Takes what was put into the free places, but for the last so many.
    #[inline(always)]
    pub(crate) fn keep(&mut self, free: usize) {
        self.count = SPANS.saturating_sub(free);
    }

    /// Adds a span, or lets the last one go on if it is of the same triangle. False if there is no room.
    #[inline(always)]
    pub(crate) fn resume(&mut self, span: Span) -> bool {
        match self.last() {
            Some(last) if last.slot == span.slot => last.end = span.end,
            _ => return self.push(span),
        }
        true
    }

    /// Lets the last span end at x.
    #[inline(always)]
    pub(crate) fn cut(&mut self, x: i32) {
        match self.last() {
            Some(last) if i32::from(last.start) < x => last.end = x as i16,
            Some(_) => self.count -= 1,
            None => {}
        }
    }
}
