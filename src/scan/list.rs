//! The active list: the triangles that cross the current line, from left to right.

use super::{
    active::Active,
    bucket::TriangleId,
    picture::{Picture, Triangle},
};

/// Up to `N` active triangles in fixed slots, and their order by the first pixel of the line.
#[derive(Clone, Debug)]
pub(crate) struct ActiveList<const N: usize> {
    slots: [Active; N],
    /// All slots: those in use first, by the first pixel they cover; then the free ones.
    order: [u16; N],
    used: usize,
}

impl<const N: usize> ActiveList<N> {
    /// A list that is to be [cleared](Self::clear) before its first use: all zeros, so that a `static` takes no flash.
    pub(crate) const fn new() -> Self {
        Self { slots: [Active::NONE; N], order: [0; N], used: 0 }
    }

    pub(crate) fn clear(&mut self) {
        self.used = 0;
        for (place, slot) in self.order.iter_mut().zip(0..) {
            *place = slot;
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.used
    }

    /// The slots in use, by the first pixel they cover.
    pub(crate) fn slots(&self) -> &[u16] {
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
            let Some(&slot) = self.order.get(i) else { break };
            let points = |id| picture.triangle(id).map(|triangle| triangle.points());
            if self.slots.get_mut(usize::from(slot)).is_some_and(|active| active.step(line, points)) {
                swap(&mut self.order, kept, i);
                kept += 1;
            }
        }
        self.used = kept;
        self.enter(line, picture)
    }

    /// Takes in the triangles that start on line `line`, and puts all in order. Returns the number of those left out.
    pub(crate) fn enter<const L: usize>(&mut self, line: u16, picture: &Picture<'_, L>) -> u16 {
        let mut dropped = 0;
        for id in picture.starting(line) {
            let Some(triangle) = picture.triangle(id) else { continue };
            let Some(active) = Active::new(triangle.points(), id, picture.whole(id), line) else { continue };
            let free = match self.order.get(self.used) {
                Some(&free) => free,
                None => {
                    dropped += 1;
                    match self.farther_than(&triangle, id, picture) {
                        Some(victim) => victim,
                        None => continue,
                    }
                }
            };
            if let Some(slot) = self.slots.get_mut(usize::from(free)) {
                *slot = active;
                self.used = (self.used + 1).min(N);
            }
        }
        self.sort();
        dropped
    }

    /// Insertion sort: from line to line hardly anything moves.
    fn sort(&mut self) {
        let Self { slots, order, used, .. } = self;
        let begin = |slot: u16| slots.get(usize::from(slot)).map_or(0, Active::begin);
        for i in 1..*used {
            let mut j = i;
            while j > 0 {
                let (Some(&before), Some(&here)) = (order.get(j - 1), order.get(j)) else { break };
                if begin(before) <= begin(here) {
                    break;
                }
                swap(order, j - 1, j);
                j -= 1;
            }
        }
    }

    /// Of all in the list and this one, the slot of that whose nearest corner is farthest, of equals that with the highest
    /// number; none if it is this one. What is left out thus depends on the picture alone.
    #[cold]
    #[inline(never)]
    fn farther_than<const L: usize>(&self, triangle: &Triangle<L>, id: TriangleId, picture: &Picture<'_, L>) -> Option<u16> {
        let nearness = |triangle: &Triangle<L>| triangle.corners.iter().map(|corner| corner.nearness()).max().unwrap_or(0);
        let mut least = (nearness(triangle), core::cmp::Reverse(id));
        let mut victim = None;
        for &slot in self.slots() {
            let Some(active) = self.get(slot) else { continue };
            let Some(other) = picture.triangle(active.id) else { continue };
            let rank = (nearness(&other), core::cmp::Reverse(active.id));
            if rank < least {
                (least, victim) = (rank, Some(slot));
            }
        }
        victim
    }
}

/// Swaps two elements; nothing if one is not there.
#[inline(always)]
fn swap(order: &mut [u16], i: usize, j: usize) {
    if i < order.len() && j < order.len() {
        order.swap(i, j);
    }
}
