//! Visibility: the spanning scan-line algorithm.

use core::ops::Range;

use heapless::Vec;

use super::{
    active::Active,
    geometry::Geometry,
    list::ActiveList,
    table::{Span, Table},
    visibility::{wins, Visibility},
};
use crate::work::{Tally, Work};

/// The spanning scan-line algorithm: depths are compared where triangles begin, end or cross. Needs no memory.
#[derive(Clone, Copy, Debug)]
pub struct Spanning;

impl Visibility for Spanning {
    const NEW: Self = Self;

    /// Where triangles lie beside each other, what is handed on are their extents themselves.
    #[inline(always)]
    fn resolve<const N: usize, const L: usize>(
        &mut self,
        line: u16,
        width: i32,
        list: &mut ActiveList<N>,
        geometry: &Geometry<'_, '_, L>,
        see: impl FnMut(&[Span], &mut [Active; N]),
    ) {
        Sweep::new(line, width).run(list, geometry, see);
    }
}

/// A walk along one line, from one change of the visible triangle to the next.
///
/// One triangle is in front; those behind it wait. Depths, linear along the line, are compared where a triangle begins and where
/// the one in front ends or is crossed: not at each pixel, and not at all where one triangle as a whole is nearer than the other.
/// A crossing is the first pixel where the other one is in front; equal depths go to the lower (object, triangle).
///
/// A pair of triangles is one here, of two planes: left of its diagonal, and right of it. Triangles go by their place in the list,
/// whose extents are in order: those that have not begun start at x or after it, save left of the picture.
#[derive(Clone, Debug)]
struct Sweep<const N: usize> {
    line: u16,
    width: i32,
    /// Up to here the line is resolved.
    x: i32,
    /// The first triangle that has not begun.
    next: usize,
    /// Those that have begun and may be seen at x or after it; some may have ended.
    open: Vec<u16, N>,
    tally: Tally,
}

impl<const N: usize> Sweep<N> {
    const fn new(line: u16, width: i32) -> Self {
        Self { line, width, x: 0, next: 0, open: Vec::new(), tally: Tally::NONE }
    }

    /// Walks the line, run by run.
    #[inline(always)]
    fn run<const L: usize>(
        mut self,
        list: &mut ActiveList<N>,
        geometry: &Geometry<'_, '_, L>,
        mut see: impl FnMut(&[Span], &mut [Active; N]),
    ) {
        let (extents, slots) = list.split();
        let mut table = Table::default();
        while self.x < self.width {
            let run = self.alone(extents);
            if !run.is_empty() {
                see(run, slots);
            }
            if self.open.is_empty() {
                break;
            }
            while self.x < self.width && !self.open.is_empty() {
                table.clear();
                self.covered(extents, slots, geometry, &mut table);
                see(table.spans(), slots);
            }
        }
        list.tally.add(self.tally.work());
    }

    /// Where none is open: the triangles that lie beside each other, up to one that the next one overlaps or that reaches out of
    /// the picture, which is open then. A loop of its own, as short as can be: most triangles come this way.
    #[inline(never)]
    fn alone<'a>(&mut self, extents: &'a [Span]) -> &'a [Span] {
        let first = self.next;
        let (mut until, mut next) = (self.x, first);
        let overlaps = loop {
            let Some(extent) = extents.get(next) else { break false };
            if !extent.starts_before(until) {
                until = extent.end();
            } else if !extent.is_empty() {
                break true;
            }
            next += 1;
        };
        let run = extents.get(first..next).unwrap_or_default();
        let place = match () {
            () if until > self.width => run.iter().position(|extent| extent.end() > self.width),
            () if overlaps => run.iter().rposition(|extent| !extent.is_empty()).or(Some(run.len())),
            () => return run,
        };
        let Some(place) = place else { return run };
        self.x = extents.get(first + place).map_or(self.width, |extent| extent.start().max(0));
        self.wait(first + place);
        self.next = first + place + 1;
        run.get(..place).unwrap_or(run)
    }

    /// Where some are open: sees one triangle after the other, until none is open, or the table is full.
    #[inline(never)]
    fn covered<const L: usize>(
        &mut self,
        extents: &[Span],
        slots: &mut [Active; N],
        geometry: &Geometry<'_, '_, L>,
        table: &mut Table,
    ) {
        let Self { width, mut x, mut next, .. } = *self;
        // What is nearer than this is in front of all open ones.
        let mut bound = i32::MAX;
        while x < width && !self.open.is_empty() {
            self.tally.add(Work { fronts: 1, ..Work::NONE });
            let mut until = width;
            let mut place = next;
            let is_nearer = |other: Open| other.start <= x && other.end > x && other.far > bound;
            if bound < i32::MAX && Open::new(next, extents, slots).is_some_and(is_nearer) {
                next += 1;
            } else {
                bound = 0;
                if self.open.len() > 1 {
                    (until, bound) = self.elect(x, extents, slots, geometry);
                }
                place = self.open.pop().map_or(usize::MAX, usize::from);
            }
            let Some(mut front) = Open::new(place, extents, slots).filter(|front| front.end > x) else { break };
            until = until.min(front.end);
            let Some(extent) = extents.get(front.place) else { break };
            if !table.resume(extent.with(x, until)) {
                self.wait(front.place);
                break;
            }
            while let Some(extent) = extents.get(next) {
                let start = extent.start().max(0);
                if start >= until {
                    break;
                }
                next += 1;
                self.tally.add(Work { looked: 1, ..Work::NONE });
                if extent.end() <= start {
                    continue;
                }
                let Some(other) = Open::new(next - 1, extents, slots) else { break };
                let (mut ahead, mut crossing) = (false, i32::MAX);
                if front.far <= other.near {
                    ahead = true;
                    if other.far <= front.near {
                        (ahead, crossing) = self.duel([other.place, front.place], start, extents, slots, geometry);
                    }
                }
                if !ahead {
                    // One that can never be seen is let go.
                    if other.end > front.end || crossing < i32::MAX {
                        self.wait(other.place);
                        bound = bound.max(other.near);
                        until = until.min(crossing);
                    }
                    continue;
                }
                if other.far <= bound || table.is_full() {
                    // To be elected.
                    self.wait(other.place);
                    until = start;
                    break;
                }
                if front.end > other.end || crossing < i32::MAX {
                    self.wait(front.place);
                    bound = bound.max(front.near);
                }
                table.cut(start);
                until = other.end.min(crossing).min(width);
                let Some(extent) = extents.get(other.place) else { break };
                table.push(extent.with(start, until));
                front = other;
            }
            x = until;
            if front.end > x {
                table.cut(x);
                self.wait(front.place);
                bound = i32::MAX;
            }
        }
        (self.x, self.next) = (x, next);
    }

    #[inline(always)]
    fn wait(&mut self, place: usize) {
        // There is room for all.
        let _ = self.open.push(place as u16);
    }

    /// Of several open ones, brings the nearest at x to the end, and lets go of those that are never seen again. Returns where
    /// the first of the others crosses it, and the nearness of the nearest of these.
    #[inline(never)]
    fn elect<const L: usize>(
        &mut self,
        x: i32,
        extents: &[Span],
        slots: &mut [Active; N],
        geometry: &Geometry<'_, '_, L>,
    ) -> (i32, i32) {
        self.tally.add(Work { looked: self.open.len() as u32, ..Work::NONE });
        let mut front = Open::NONE;
        while let Some(other) = self.open.pop().and_then(|place| Open::new(place.into(), extents, slots)) {
            front = other;
            if front.end > x {
                break;
            }
        }
        for i in 0..self.open.len() {
            let Some(other) = self.open.get(i).and_then(|place| Open::new((*place).into(), extents, slots)) else { break };
            let near = other.end > x && front.far <= other.near;
            if near && (other.far > front.near || self.duel([other.place, front.place], x, extents, slots, geometry).0) {
                if let Some(place) = self.open.get_mut(i) {
                    *place = front.place as u16;
                }
                front = other;
            }
        }
        let (mut until, mut bound) = (self.width, 0);
        let mut kept = 0;
        for i in 0..self.open.len() {
            let Some(other) = self.open.get(i).and_then(|place| Open::new((*place).into(), extents, slots)) else { break };
            let mut crossing = i32::MAX;
            if other.end > x && front.far <= other.near {
                (_, crossing) = self.duel([other.place, front.place], x, extents, slots, geometry);
            }
            if other.end > front.end || crossing < i32::MAX {
                if let Some(place) = self.open.get_mut(kept) {
                    *place = other.place as u16;
                    kept += 1;
                }
                until = until.min(crossing);
                bound = bound.max(other.near);
            }
        }
        self.open.truncate(kept);
        self.wait(front.place);
        (until, bound)
    }

    /// Whether `other` is in front of `front` at x, by their depths, and the first pixel after it, before either ends, where this
    /// changes; else a pixel that never comes.
    #[inline(never)]
    fn duel<const L: usize>(
        &mut self,
        [other, front]: [usize; 2],
        x: i32,
        extents: &[Span],
        slots: &mut [Active; N],
        geometry: &Geometry<'_, '_, L>,
    ) -> (bool, i32) {
        const NEVER: (bool, i32) = (false, i32::MAX);
        let (Some(other), Some(front)) = (extents.get(other), extents.get(front)) else { return NEVER };
        let end = other.end().min(front.end()).min(self.width);
        let pair = [other.slot(), front.slot()].map(usize::from);
        self.tally.add(Work { compared: 1, ..Work::NONE });
        let (mut from, mut known) = (x, None);
        // Each of them is one plane left of its diagonal, and another one right of it.
        for _ in 0..3 {
            let [Some(other), Some(front)] = pair.map(|slot| slots.get(slot)) else { return NEVER };
            let middles = [other, front].map(|active| i32::from(active.middle()));
            let until = middles.iter().fold(end, |until, middle| if *middle > from { until.min(*middle) } else { until });
            let [of_other, of_front] = middles.map(|middle| usize::from(middle <= from));
            let [other, front] = pair;
            let (ahead, crossing) = self.compare([(other, of_other), (front, of_front)], from..until, slots, geometry);
            let known = *known.get_or_insert(ahead);
            if ahead != known {
                return (known, from);
            }
            if crossing < i32::MAX || until >= end {
                return (known, crossing);
            }
            from = until;
        }
        NEVER
    }

    /// The same for a half of each, given slot and half, between two pixels, of which there is at least one.
    #[inline(always)]
    fn compare<const L: usize>(
        &mut self,
        [one, two]: [(usize, usize); 2],
        pixels: Range<i32>,
        slots: &mut [Active; N],
        geometry: &Geometry<'_, '_, L>,
    ) -> (bool, i32) {
        const NEVER: (bool, i32) = (false, i32::MAX);
        let [Some(other), Some(front)] = [one, two].map(|(slot, half)| {
            let active = slots.get_mut(slot)?;
            if !active.depths.get(half)?.is_known() {
                let exact = active.deepen(half, geometry);
                self.tally.add(Work { deepened: 1, exact, ..Work::NONE });
            }
            active.depths.get(half).copied()
        }) else {
            return NEVER;
        };
        let Range { start: x, end } = pixels;
        let last = end - 1;
        let wins = || {
            let [one, two] = [one, two].map(|(slot, half)| slots.get(slot).map(|active| active.id(half)));
            one.zip(two).is_some_and(|(one, two)| wins(one, two, geometry))
        };
        let is_ahead = |lead: i32| lead > 0 || lead == 0 && wins();
        let lead = other.at(x, self.line).wrapping_sub(front.at(x, self.line));
        let step = other.step().wrapping_sub(front.step());
        let ahead = is_ahead(lead);
        if is_ahead(lead.wrapping_add(step.wrapping_mul(last - x))) == ahead {
            return (ahead, i32::MAX);
        }
        // One is behind here and in front there, so that between at least two pixels the step fits, and it gains on the other.
        let (lag, gain) = if ahead { (lead, step.wrapping_neg()) } else { (lead.wrapping_neg(), step) };
        let lag = lag.wrapping_add((wins() == ahead).into());
        let pixels = match u32::try_from(gain) {
            Ok(gain) => (lag as u32).checked_add(gain.wrapping_sub(1)).and_then(|sum| sum.checked_div(gain)).unwrap_or(1),
            Err(_) => 1,
        };
        // Never more than what is left of the line, which fits 16 bits.
        (ahead, x + pixels.min((last - x) as u32).max(1) as i32)
    }
}

/// An open triangle.
#[derive(Clone, Copy, Debug)]
struct Open {
    place: usize,
    start: i32,
    end: i32,
    /// Nearness of its farthest and its nearest corner.
    far: i32,
    near: i32,
}

impl Open {
    /// None: behind whatever comes.
    const NONE: Self = Self { place: usize::MAX, start: 0, end: i32::MIN, far: -1, near: -1 };

    #[inline(always)]
    fn new<const N: usize>(place: usize, extents: &[Span], slots: &[Active; N]) -> Option<Self> {
        let extent = extents.get(place)?;
        let [far, near] = slots.get(usize::from(extent.slot()))?.reach();
        Some(Self { place, start: extent.start(), end: extent.end(), far, near })
    }
}
