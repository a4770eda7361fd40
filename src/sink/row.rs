//! A row of pixels on its way to be stored.

use super::ink::Ink;
use crate::model::material::Color;

/// The pixels of a line, stored once each, from left to right: spans by whoever shades them, the background between.
#[derive(Debug)]
pub(crate) struct Row<'r, P> {
    pixels: &'r mut [P],
    /// The first pixel that is not stored.
    from: usize,
    /// None keeps what the row held.
    background: Option<Color>,
}

impl<'r, P: Ink> Row<'r, P> {
    pub(crate) const fn new(pixels: &'r mut [P], background: Option<Color>) -> Self {
        Self { pixels, from: 0, background }
    }

    /// The pixels of a span that lies right of all before it, to be stored now; the background up to it is. None if there are
    /// no such pixels.
    #[inline(always)]
    pub(crate) fn span(&mut self, start: usize, end: usize) -> Option<&mut [P]> {
        if self.from < start {
            self.fill(start);
        }
        self.from = end;
        self.pixels.get_mut(..end)?.get_mut(start..)
    }

    /// Stores what is left.
    #[inline(always)]
    pub(crate) fn finish(mut self) {
        if self.from < self.pixels.len() {
            self.fill(self.pixels.len());
        }
    }

    /// Fills pixels up to there with the background.
    #[inline(always)]
    fn fill(&mut self, to: usize) {
        if let (Some(color), Some(pixels)) = (self.background, self.pixels.get_mut(self.from..to)) {
            fill(pixels, color);
        }
    }
}

/// Fills pixels with the background, two at a time where the processor stores a word at any place.
#[inline(never)]
fn fill<P: Ink>(pixels: &mut [P], color: Color) {
    let pixel = P::plain(color);
    let mut eights = pixels.chunks_exact_mut(8);
    for eight in &mut eights {
        for pair in eight.chunks_exact_mut(2) {
            // Of known length, so that no build has a path to a panic.
            if let Some(pair) = pair.first_chunk_mut::<2>() {
                pair.copy_from_slice(&[pixel; 2]);
            }
        }
    }
    eights.into_remainder().fill(pixel);
}
