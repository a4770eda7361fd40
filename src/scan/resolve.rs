//! Visibility: the spanning scan-line algorithm.

use heapless::Vec;

use super::{active::Active, list::ActiveList, picture::Picture, table::{Span, Table}};

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

/// What comes next on a line.
enum Step {
    /// A span; spans of one triangle may come in pieces.
    Span(Span),
    /// Nothing; look again.
    Look,
    /// No more.
    End,
}

impl<const N: usize> Sweep<N> {
    pub(crate) const fn new(line: u16, width: i32) -> Self {
        Self { line, width, x: 0, next: 0, open: Vec::new() }
    }

    /// Adds the next spans to the table, until the line ends or the table is full; whether there are any.
    pub(crate) fn fill<const L: usize>(&mut self, list: &mut ActiveList<N>, picture: &Picture<'_, L>, table: &mut Table<N>) -> bool {
        table.clear();
        while !table.is_full() {
            let span = if self.open.is_empty() { self.alone(list) } else { self.among(list, picture) };
            match span {
                Step::Span(span) => match table.last_mut() {
                    Some(last) if last.slot == span.slot && last.end == span.start => last.end = span.end,
                    _ => drop(table.push(span)),
                },
                Step::Look => {}
                Step::End => break,
            }
        }
        !table.is_empty()
    }

    /// The next triangle, where none is open: all of it, if the one after it begins where it ends or later.
    #[inline(always)]
    fn alone(&mut self, list: &ActiveList<N>) -> Step {
        let Some([place, rest @ ..]) = list.places().get(self.next..) else { return Step::End };
        self.next += 1;
        let Some(active) = list.get(place.slot) else { return Step::End };
        let (start, end) = (i32::from(place.begin).max(self.x), active.stop().min(self.width));
        if start >= end {
            return if start >= self.width { Step::End } else { Step::Look };
        }
        self.x = start;
        if rest.first().is_some_and(|next| i32::from(next.begin) < end) {
            let _ = self.open.push(place.slot);
            return Step::Look;
        }
        self.x = end;
        Step::Span(Span { start: start as u16, end: end as u16, slot: place.slot })
    }

    /// The next span where triangles are open.
    #[inline(never)]
    fn among<const L: usize>(&mut self, list: &mut ActiveList<N>, picture: &Picture<'_, L>) -> Step {
        // The end of what can be said without looking again.
        let mut limit = self.width;
        while let Some(place) = list.places().get(self.next) {
            if i32::from(place.begin) > self.x {
                limit = limit.min(i32::from(place.begin));
                break;
            }
            if list.get(place.slot).is_some_and(|active| active.stop() > self.x) {
                let _ = self.open.push(place.slot);
            }
            self.next += 1;
        }
        for &slot in &self.open {
            limit = limit.min(list.get(slot).map_or(0, Active::stop));
        }
        let front = match *self.open {
            [slot] => Some((slot, limit)),
            _ => self.front(limit, list, picture),
        };
        let Some((slot, end)) = front else { return Step::End };
        let start = self.x;
        self.x = end;
        self.open.retain(|slot| list.get(*slot).is_some_and(|active| active.stop() > end));
        if end >= self.width {
            self.open.clear();
            self.next = usize::MAX;
        }
        Step::Span(Span { start: start as u16, end: end as u16, slot })
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
