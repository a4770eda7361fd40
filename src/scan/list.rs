//! The active list: the triangles that cross the current line, from left to right.

use super::{active::Active, bucket::TriangleId, picture::Picture};

/// Where an active triangle is on the line, and where in the list.
#[derive(Clone, Copy, Debug)]
#[repr(align(4))]
pub(crate) struct Place {
    /// The first pixel that it covers.
    pub(crate) begin: i16,
    /// The first pixel after those that it covers.
    pub(crate) stop: i16,
    /// Its slot.
    pub(crate) slot: u16,
}

/// Up to `N` active triangles in fixed slots, and their order by the first pixel of the line.
#[derive(Clone, Debug)]
pub(crate) struct ActiveList<const N: usize> {
    slots: [Active; N],
    /// All slots: those in use first, by the first pixel they cover; then the free ones.
    order: [Place; N],
    used: usize,
}

impl<const N: usize> ActiveList<N> {
    /// A list that is to be [cleared](Self::clear) before its first use: all zeros, so that a `static` takes no flash.
    pub(crate) const fn new() -> Self {
        Self { slots: [Active::NONE; N], order: [Place { begin: 0, stop: 0, slot: 0 }; N], used: 0 }
    }

    pub(crate) fn clear(&mut self) {
        self.used = 0;
        for (place, slot) in self.order.iter_mut().zip(0..) {
            place.slot = slot;
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.used
    }

    /// Those in use, by the first pixel they cover.
    #[inline(always)]
    pub(crate) fn places(&self) -> &[Place] {
        self.order.get(..self.used).unwrap_or(&[])
    }

    #[inline(always)]
    pub(crate) fn get(&self, slot: u16) -> Option<&Active> {
        self.slots.get(usize::from(slot))
    }

    #[inline(always)]
    pub(crate) fn get_mut(&mut self, slot: u16) -> Option<&mut Active> {
        self.slots.get_mut(usize::from(slot))
    }

    /// On to line `line`, the next one: steps all, lets go of those that ended, takes in those that start. Returns the number
    /// of triangles left out for want of room.
    pub(crate) fn advance<const L: usize>(&mut self, line: u16, picture: &Picture<'_, L>) -> u16 {
        let mut kept = 0;
        for i in 0..self.used {
            let Some(&Place { slot, .. }) = self.order.get(i) else { break };
            let Some(active) = self.slots.get_mut(usize::from(slot)) else { break };
            if active.step(line, |id| picture.points(id)) {
                if kept != i {
                    swap(&mut self.order, kept, i);
                }
                if let Some(place) = self.order.get_mut(kept) {
                    (place.begin, place.stop) = active.extent();
                }
                kept += 1;
            }
        }
        self.used = kept;
        self.sort();
        self.enter(line, picture)
    }

    /// Takes in the triangles that start on line `line`. Returns the number of those left out.
    pub(crate) fn enter<const L: usize>(&mut self, line: u16, picture: &Picture<'_, L>) -> u16 {
        let mut dropped = 0;
        for id in picture.starting(line) {
            let Some(mut active) = picture.points(id).and_then(|points| Active::new(points, id, line)) else { continue };
            (active.whole, active.look) = (picture.whole(id), picture.look(id));
            if self.used == N {
                dropped += 1;
                match self.farther_than(id, picture) {
                    Some(place) => self.remove(place),
                    None => continue,
                }
            }
            self.insert(active);
        }
        dropped
    }

    /// Puts a triangle in its place; there is a free slot.
    fn insert(&mut self, active: Active) {
        let Some(order) = self.order.get_mut(..=self.used) else { return };
        let Some((free, others)) = order.split_last_mut() else { return };
        let (begin, stop) = active.extent();
        let place = Place { begin, stop, slot: free.slot };
        let Some(slot) = self.slots.get_mut(usize::from(place.slot)) else { return };
        *slot = active;
        self.used += 1;
        let at = others.partition_point(|other| other.begin <= place.begin);
        // The others move up by one, over the free slot's place, the last.
        let Some(after) = order.get_mut(at..) else { return };
        let Some(count) = after.len().checked_sub(1) else { return };
        after.copy_within(..count, 1);
        if let Some(first) = after.first_mut() {
            *first = place;
        }
    }

    /// Takes a triangle out of the order; its slot becomes the first free one.
    fn remove(&mut self, place: usize) {
        let Some(after) = self.order.get_mut(place..self.used) else { return };
        let Some(mut moving) = after.first().copied() else { return };
        after.iter_mut().rev().for_each(|here| core::mem::swap(here, &mut moving));
        self.used -= 1;
    }

    /// Insertion sort: from line to line hardly anything moves.
    fn sort(&mut self) {
        let order = self.order.get_mut(..self.used).unwrap_or_default();
        let mut before = i16::MIN;
        for i in 0..order.len() {
            let Some(place) = order.get(i) else { break };
            if place.begin >= before {
                before = place.begin;
            } else {
                sink(order, i);
            }
        }
    }

    /// Of all in the list and this one, the place of that whose nearest corner is farthest, of equals that with the highest
    /// number; none if it is this one. What is left out thus depends on the picture alone.
    #[cold]
    #[inline(never)]
    fn farther_than<const L: usize>(&self, id: TriangleId, picture: &Picture<'_, L>) -> Option<usize> {
        let rank = |id: TriangleId| {
            let triangle = picture.triangle(id);
            let nearest = triangle.and_then(|triangle| triangle.corners.iter().map(|corner| corner.nearness()).max());
            (nearest.unwrap_or(0), core::cmp::Reverse(id))
        };
        let mut least = rank(id);
        let mut victim = None;
        for (place, Place { slot, .. }) in self.places().iter().enumerate() {
            let Some(active) = self.get(*slot) else { continue };
            let other = rank(active.id);
            if other < least {
                (least, victim) = (other, Some(place));
            }
        }
        victim
    }
}

/// Moves element i to its place among those before it, which are in order.
fn sink(order: &mut [Place], i: usize) {
    let mut j = i;
    while let [before, here] = order.get_mut(j.wrapping_sub(1)..=j).unwrap_or_default() {
        if before.begin <= here.begin {
            break;
        }
        core::mem::swap(before, here);
        j -= 1;
    }
}

/// Swaps two elements; nothing if one is not there.
#[inline(always)]
fn swap(order: &mut [Place], i: usize, j: usize) {
    if i < order.len() && j < order.len() {
        order.swap(i, j);
    }
}
