//! Visibility: the spanning scan-line algorithm.

use heapless::Vec;

use super::{
    active::Active,
    list::{ActiveList, Place},
    picture::Picture,
    table::{Span, Table},
};

/// A walk along one line, from one change of the visible triangle to the next.
///
/// One triangle is in front; those behind it wait. Depths, linear along the line, are compared where a triangle begins, where
/// the one in front ends, and where another one crosses it: not at each pixel. A crossing is the first pixel where the other
/// one is in front; equal depths go to the lower (object, triangle).
#[derive(Clone, Debug)]
pub(crate) struct Sweep<const N: usize> {
    line: u16,
    width: i32,
    /// Up to here the line is resolved.
    x: i32,
    /// Index, in the list's order, of the first triangle that has not begun.
    next: usize,
    /// The triangle in front.
    front: Option<Place>,
    /// Where the first one crosses it, if before its end.
    crossing: i32,
    /// Those that have begun, other than the one in front; some may have ended.
    behind: Vec<Place, N>,
}

impl<const N: usize> Sweep<N> {
    pub(crate) const fn new(line: u16, width: i32) -> Self {
        Self { line, width, x: 0, next: 0, front: None, crossing: i32::MAX, behind: Vec::new() }
    }

    /// Adds the next spans to the table, until the line ends or the table is full; whether there are any.
    pub(crate) fn fill<const L: usize>(
        &mut self,
        list: &mut ActiveList<N>,
        picture: &Picture<'_, L>,
        table: &mut Table<N>,
    ) -> bool {
        table.clear();
        while self.x < self.width && !table.is_full() {
            match self.front {
                None => self.alone(list.places(), table),
                Some(front) => self.covered(front, list, picture, table),
            }
        }
        !table.is_empty()
    }

    /// Where nothing is open: sees one triangle after the other, up to one that another one overlaps.
    fn alone(&mut self, places: &[Place], table: &mut Table<N>) {
        let (mut x, mut next) = (self.x, self.next);
        while let Some(place) = places.get(next) {
            next += 1;
            let (start, end) = (i32::from(place.begin).max(x), i32::from(place.stop).min(self.width));
            if start >= end {
                continue;
            }
            if places.get(next).is_some_and(|after| i32::from(after.begin) < end) {
                (self.x, self.next) = (start, next);
                (self.front, self.crossing) = (Some(*place), i32::MAX);
                return;
            }
            let _ = table.push(Span { start: start as u16, end: end as u16, slot: place.slot });
            x = end;
            if table.is_full() {
                (self.x, self.next) = (x, next);
                return;
            }
        }
        self.x = self.width;
    }

    /// Where a triangle is in front: on to the next triangle, or to the end of its being there.
    fn covered<const L: usize>(
        &mut self,
        front: Place,
        list: &mut ActiveList<N>,
        picture: &Picture<'_, L>,
        table: &mut Table<N>,
    ) {
        let end = i32::from(front.stop).min(self.crossing).min(self.width);
        if let Some(place) = list.places().get(self.next).copied().filter(|place| i32::from(place.begin) < end) {
            self.next += 1;
            let begin = i32::from(place.begin).max(self.x);
            if i32::from(place.stop) > begin && self.begins_in_front(place, front, begin, list, picture) {
                see(table, self.x, begin, front.slot);
                self.x = begin;
                let _ = self.behind.push(front);
                (self.front, self.crossing) = (Some(place), i32::MAX);
                self.look_behind(list);
            }
            return;
        }
        see(table, self.x, end, front.slot);
        self.x = end;
        if self.behind.is_empty() {
            self.front = None;
            return;
        }
        if i32::from(front.stop) > end {
            let _ = self.behind.push(front);
        }
        self.elect(list);
    }

    /// Whether a triangle that begins at x is in front there; if not, it goes behind.
    #[inline(never)]
    fn begins_in_front<const L: usize>(
        &mut self,
        place: Place,
        front: Place,
        x: i32,
        list: &mut ActiveList<N>,
        picture: &Picture<'_, L>,
    ) -> bool {
        for slot in [place.slot, front.slot] {
            if let Some(active) = list.get_mut(slot).filter(|active| !active.deep) {
                if let Some(triangle) = picture.triangle(active.id) {
                    active.deepen(&triangle);
                }
            }
        }
        let (Some(other), Some(active)) = (list.get(place.slot), list.get(front.slot)) else { return false };
        if self.ahead(other, active, x) >= 0 {
            return true;
        }
        let _ = self.behind.push(place);
        self.crossing = self.crossing.min(self.crosses(other, active, x, i32::from(place.stop.min(front.stop))));
        false
    }

    /// Of those behind, lets go of the ended ones, and puts the one that is nearest at x in front.
    #[inline(never)]
    fn elect(&mut self, list: &ActiveList<N>) {
        let x = self.x;
        self.behind.retain(|place| i32::from(place.stop) > x);
        let mut best: Option<(usize, Place, &Active)> = None;
        for (i, &place) in self.behind.iter().enumerate() {
            let Some(other) = list.get(place.slot) else { continue };
            if best.is_none_or(|(_, _, active)| self.ahead(other, active, x) >= 0) {
                best = Some((i, place, other));
            }
        }
        self.crossing = i32::MAX;
        self.front = best.map(|(i, place, _)| {
            if i < self.behind.len() {
                self.behind.swap_remove(i);
            }
            place
        });
        self.look_behind(list);
    }

    /// Finds the first of those behind that crosses the one in front.
    fn look_behind(&mut self, list: &ActiveList<N>) {
        let Some((front, active)) = self.front.and_then(|front| Some((front, list.get(front.slot)?))) else { return };
        for place in &self.behind {
            let Some(other) = list.get(place.slot) else { continue };
            let end = i32::from(place.stop.min(front.stop));
            if end > self.x {
                self.crossing = self.crossing.min(self.crosses(other, active, self.x, end));
            }
        }
    }

    /// At least 0 where `other` is in front of `front`: the difference of the nearnesses, less one if `front` wins when equal.
    #[inline]
    fn ahead(&self, other: &Active, front: &Active, x: i32) -> i32 {
        let difference = other.depth_at(x, self.line).wrapping_sub(front.depth_at(x, self.line));
        difference.saturating_sub(i32::from((front.whole, front.id) < (other.whole, other.id)))
    }

    /// The first pixel after x, before `end`, where `other` is in front, which it is not at x; else a pixel that never comes.
    fn crosses(&self, other: &Active, front: &Active, x: i32, end: i32) -> i32 {
        let last = end.min(self.width) - 1;
        if last <= x || self.ahead(other, front, last) < 0 {
            return i32::MAX;
        }
        // It is behind here and in front there, so that between at least two pixels the step fits and is positive.
        let behind = self.ahead(other, front, x).wrapping_neg();
        let step = other.depth_step().wrapping_sub(front.depth_step());
        let pixels = match u32::try_from(step) {
            Ok(step) => (behind as u32).checked_add(step.wrapping_sub(1)).and_then(|sum| sum.checked_div(step)).unwrap_or(1),
            Err(_) => 1,
        };
        // Never more than what is left of the line, which fits 16 bits.
        x + pixels.min((last - x) as u32).max(1) as i32
    }
}

/// Adds a span to the table, or to its last span.
#[inline(always)]
fn see<const N: usize>(table: &mut Table<N>, start: i32, end: i32, slot: u16) {
    if start >= end {
        return;
    }
    let span = Span { start: start as u16, end: end as u16, slot };
    match table.last_mut() {
        Some(last) if last.slot == span.slot && last.end == span.start => last.end = span.end,
        _ => drop(table.push(span)),
    }
}
