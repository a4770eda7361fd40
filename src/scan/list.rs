//! The active list: the triangles that cross the current line, from left to right.

use core::{cell::Cell, cmp::Reverse};

use heapless::Vec;

use super::{
    active::Active,
    bucket::{Kept, TriangleId},
    geometry::Geometry,
    table::Span,
};
use crate::work::{Tally, Work};

/// Triangles put in their places at once.
pub(super) const BATCH: usize = 16;

/// Up to `N` active triangles in fixed slots, and what they cover on the line, in the order of the first pixel.
#[derive(Clone, Debug)]
pub struct ActiveList<const N: usize> {
    slots: [Active; N],
    order: Vec<Span, N>,
    /// The first free slot; N if there is none.
    free: u16,
    pub(crate) tally: Tally,
}

impl<const N: usize> ActiveList<N> {
    /// A list that is to be [cleared](Self::clear) before its first use: all zeros, so that a `static` takes no flash.
    pub(crate) const fn new() -> Self {
        const { assert!(N < 1 << 15, "slots are numbered in 15 bits") };
        Self { slots: [Active::NONE; N], order: Vec::new(), free: 0, tally: Tally::NONE }
    }

    #[inline(never)]
    pub(crate) fn clear(&mut self) {
        self.order.clear();
        self.free = 0;
        for (slot, next) in self.slots.iter_mut().zip(1..) {
            slot.free(next);
        }
    }

    /// What the triangles cover on the line, by the first pixel; some of it empty, some of it outside the picture.
    #[inline(always)]
    pub(crate) fn extents(&self) -> &[Span] {
        &self.order
    }

    /// The extents, and the triangles in their slots.
    #[inline(always)]
    pub(crate) fn split(&mut self) -> (&[Span], &mut [Active; N]) {
        (&self.order, &mut self.slots)
    }

    #[inline(always)]
    pub(crate) fn get(&self, slot: u16) -> Option<&Active> {
        self.slots.get(usize::from(slot))
    }

    /// The extents, of which some may be taken out, if all are put back before the next line.
    pub(crate) const fn extents_mut(&mut self) -> &mut Vec<Span, N> {
        &mut self.order
    }

    /// On to line `line`, the next one: steps all, lets go of those that ended, takes in those that start. Returns the number
    /// of triangles left out for want of room.
    #[inline(never)]
    pub(crate) fn advance<const L: usize>(&mut self, line: u16, geometry: &Geometry<'_, '_, L>) -> u16 {
        self.tally.add(Work { stepped: self.order.len() as u32, ..Work::NONE });
        let free = self.free;
        self.step(line.into(), geometry);
        if self.free != free {
            self.order.retain(|span| !span.is_none());
        }
        self.sort();
        self.enter(line, geometry)
    }

    /// Steps all to line `line`, and marks those that ended.
    #[inline(never)]
    fn step<const L: usize>(&mut self, line: u32, geometry: &Geometry<'_, '_, L>) {
        for span in &mut self.order {
            let Some(active) = self.slots.get_mut(usize::from(span.slot())) else { break };
            let turns = active.turns(line);
            if turns && active.ends() {
                self.tally.add(Work { ended: 1, ..Work::NONE });
                active.free(self.free);
                self.free = span.slot();
                *span = Span::NONE;
                continue;
            }
            active.step();
            if turns {
                self.tally.add(Work { turned: 1, ..Work::NONE });
                active.bend(line, geometry);
            }
            let (start, end) = active.extent();
            *span = span.with(start.into(), end.into());
        }
    }

    /// Insertion sort: from line to line hardly anything moves.
    #[inline(never)]
    fn sort(&mut self) {
        let places = Cell::from_mut(self.order.as_mut_slice()).as_slice_of_cells();
        let mut before = Span::LEFTMOST;
        let mut rest = places;
        while let [place, after @ ..] = rest {
            rest = after;
            let span = place.get();
            if before.is_after(span) {
                sink(places.get(..places.len() - rest.len()).unwrap_or_default(), &mut self.tally);
            } else {
                before = span;
            }
        }
    }

    /// Takes in the triangles that start on line `line`. Returns the number of those left out.
    ///
    /// A few at a time, put in order first, so that each of the others moves once.
    pub(crate) fn enter<const L: usize>(&mut self, line: u16, geometry: &Geometry<'_, '_, L>) -> u16 {
        let mut dropped = 0;
        let mut new = Vec::new();
        for kept in geometry.starting(line) {
            self.tally.add(Work { entered: 1, ..Work::NONE });
            if new.is_full() {
                self.merge(&mut new);
            }
            if self.slots.get(usize::from(self.free)).is_none() {
                self.merge(&mut new);
                match self.farther_than(kept, geometry) {
                    Some(place) => dropped += self.remove(place),
                    None => {
                        dropped += kept.count() as u16;
                        continue;
                    }
                }
            }
            let slot = self.free;
            let Some(active) = self.slots.get_mut(usize::from(slot)) else { continue };
            let free = active.next_free();
            if let Some(look) = active.begin(kept, line, geometry) {
                self.free = free;
                let (start, end) = active.extent();
                let span = Span::new(start, end, slot, look);
                let misplaced = new.last().is_some_and(|last: &Span| last.is_after(span));
                let _ = new.push(span);
                let _ = self.order.push(span);
                if misplaced {
                    sink(Cell::from_mut(new.as_mut_slice()).as_slice_of_cells(), &mut self.tally);
                }
            }
        }
        if !new.is_empty() {
            self.merge(&mut new);
        }
        dropped
    }

    /// Puts the last triangles, those in `new`, where they are in order, in their places among the others; forgets `new`.
    #[inline(never)]
    fn merge(&mut self, new: &mut Vec<Span, BATCH>) {
        let mut places = Cell::from_mut(self.order.as_mut_slice()).as_slice_of_cells();
        let mut others = places.get(..places.len().saturating_sub(new.len())).unwrap_or_default();
        let before = others.len();
        for span in new.iter().rev() {
            [places, others] = settle(places, others, *span);
        }
        self.tally.add(Work { moved: (before - others.len()) as u32, ..Work::NONE });
        new.clear();
    }

    /// Takes out what is at that place. Returns its number of triangles.
    fn remove(&mut self, place: usize) -> u16 {
        let Some(slot) = self.order.get(place).map(|span| span.slot()) else { return 0 };
        let Some(active) = self.slots.get_mut(usize::from(slot)) else { return 0 };
        active.free(self.free);
        self.free = slot;
        let places = Cell::from_mut(self.order.as_mut_slice()).as_slice_of_cells();
        for (place, next) in places.iter().skip(place).zip(places.iter().skip(place + 1)) {
            place.set(next.get());
        }
        self.order.pop();
        active.count()
    }

    /// Of all in the list and this one, the place of that of the lowest [rank]; none if it is this one. What is left out thus depends
    /// on the picture alone.
    #[cold]
    #[inline(never)]
    fn farther_than<const L: usize>(&self, kept: Kept, geometry: &Geometry<'_, '_, L>) -> Option<usize> {
        let mut least = rank(kept.ends(), geometry);
        let mut victim = None;
        for (place, span) in self.order.iter().enumerate() {
            let Some(active) = self.get(span.slot()) else { continue };
            let other = rank(active.ids(), geometry);
            if other < least {
                (least, victim) = (other, Some(place));
            }
        }
        victim
    }
}

/// How near the nearest corner of one triangle or two is, and of equals the lower number first.
#[inline(never)]
fn rank<const L: usize>([one, other]: [TriangleId; 2], geometry: &Geometry<'_, '_, L>) -> (u32, Reverse<TriangleId>) {
    let corners = [one, other].into_iter().filter_map(|id| geometry.corners(id)).flatten();
    (corners.fold(0, |nearest, corner| corner.nearness().max(nearest)), Reverse(one.min(other)))
}

/// Moves the last one to its place among the others, which are in order.
#[inline(never)]
fn sink(places: &[Cell<Span>], tally: &mut Tally) {
    if let [others @ .., last] = places {
        let [_, left] = settle(places, others, last.get());
        tally.add(Work { moved: (others.len() - left.len()) as u32, ..Work::NONE });
    }
}

/// Moves those of the others that lie on the right of this one to the last places, and puts it before them. Returns the places
/// and the others left of it.
#[inline(always)]
fn settle<'a>(mut places: &'a [Cell<Span>], mut others: &'a [Cell<Span>], span: Span) -> [&'a [Cell<Span>]; 2] {
    while let [left @ .., place] = places {
        places = left;
        match others {
            [left @ .., other] if other.get().is_after(span) => {
                place.set(other.get());
                others = left;
            }
            _ => {
                place.set(span);
                break;
            }
        }
    }
    [places, others]
}
