//! Visibility: the spanning scan-line algorithm.

use heapless::Vec;

use super::{active::Active, list::ActiveList, picture::Picture, table::Span};

/// A walk along one line, from one span to the next.
///
/// The set of triangles that cover a pixel changes only where one begins or ends; depths, linear along the line, are compared
/// there, and where two cross in between, not at each pixel. A crossing is the first pixel where the other one is in front;
/// equal depths go to the lower (object, triangle).
#[derive(Clone, Debug)]
pub(crate) struct Sweep<const N: usize> {
    line: u16,
    width: i32,
    x: i32,
    /// Index, in the list's order, of the first triangle that has not begun.
    next: usize,
    /// The triangles that cover the current pixel.
    open: Vec<u16, N>,
}

impl<const N: usize> Sweep<N> {
    pub(crate) const fn new(line: u16, width: i32) -> Self {
        Self { line, width, x: 0, next: 0, open: Vec::new() }
    }

    /// The next span; spans of one triangle may come in pieces.
    pub(crate) fn next<const L: usize>(&mut self, list: &mut ActiveList<N>, picture: &Picture<'_, L>) -> Option<Span> {
        let x = self.x;
        self.open.retain(|slot| list.get(*slot).is_some_and(|active| active.stop() > x));
        // The end of what can be said without looking again.
        let mut limit = self.width;
        while let Some(&slot) = list.slots().get(self.next) {
            let Some(active) = list.get(slot) else { break };
            if active.stop() > self.x.max(active.begin()) {
                if active.begin() > self.x {
                    if !self.open.is_empty() {
                        limit = limit.min(active.begin());
                        break;
                    }
                    self.x = active.begin();
                }
                let _ = self.open.push(slot);
            }
            self.next += 1;
        }
        for &slot in &self.open {
            limit = limit.min(list.get(slot).map_or(0, Active::stop));
        }
        if self.x >= limit {
            return None;
        }
        let (slot, end) = match *self.open {
            [] => return None,
            [slot] => (slot, limit),
            [..] => self.front(limit, list, picture)?,
        };
        let start = self.x;
        self.x = end;
        Some(Span { start: start as u16, end: end as u16, slot })
    }

    /// Of several triangles that cover all pixels up to `limit`, the one in front at the current pixel, and where it stops
    /// being in front.
    fn front<const L: usize>(&self, limit: i32, list: &mut ActiveList<N>, picture: &Picture<'_, L>) -> Option<(u16, i32)> {
        for &slot in &self.open {
            let active = list.get_mut(slot)?;
            if !active.deep {
                active.deepen(&picture.triangle(active.id)?);
            }
        }
        let (mut front, others) = self.open.split_first().map(|(first, others)| (*first, others))?;
        for &slot in others {
            if self.ahead(list.get(slot)?, list.get(front)?, self.x) >= 0 {
                front = slot;
            }
        }
        let mut end = limit;
        for &slot in &self.open {
            if slot != front {
                end = self.crossing(list.get(slot)?, list.get(front)?, end);
            }
        }
        Some((front, end))
    }

    /// At least 0 where `other` is in front of `front`: the difference of the nearnesses, less one if `front` wins when equal.
    #[inline]
    fn ahead(&self, other: &Active, front: &Active, x: i32) -> i32 {
        let difference = other.depth_at(x, self.line).wrapping_sub(front.depth_at(x, self.line));
        difference.saturating_sub(i32::from((front.whole, front.id) < (other.whole, other.id)))
    }

    /// The first pixel after the current one, before `end`, where `other` is in front; else `end`.
    fn crossing(&self, other: &Active, front: &Active, end: i32) -> i32 {
        let last = end - 1;
        if last <= self.x || self.ahead(other, front, last) < 0 {
            return end;
        }
        // It is behind here and in front there, so that between at least two pixels the step fits and is positive.
        let behind = self.ahead(other, front, self.x).wrapping_neg();
        let step = other.depth_step().wrapping_sub(front.depth_step());
        let pixels = match u32::try_from(step) {
            Ok(step) => (behind as u32).checked_add(step - 1).and_then(|sum| sum.checked_div(step)).unwrap_or(1),
            Err(_) => 1,
        };
        // Never more than what is left of the line, which fits 16 bits.
        let left = (last - self.x) as u32;
        self.x + pixels.min(left).max(1) as i32
    }
}
