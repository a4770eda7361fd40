//! Visibility: the spanning scan-line algorithm.

use heapless::Vec;

use super::{
    bucket::TriangleId,
    geometry::Geometry,
    list::ActiveList,
    table::{Span, Table},
};

/// A walk along one line, from one change of the visible triangle to the next.
///
/// One triangle is in front; those behind it wait. Depths, linear along the line, are compared where a triangle begins and where
/// the one in front ends or is crossed: not at each pixel, and not at all where one triangle as a whole is nearer than the other.
/// A crossing is the first pixel where the other one is in front; equal depths go to the lower (object, triangle).
///
/// Triangles go by their place in the list, whose extents are in order: those that have not begun start at x or after it, save
/// left of the picture.
#[derive(Clone, Debug)]
pub(crate) struct Sweep<const N: usize> {
    line: u16,
    width: i32,
    /// Up to here the line is resolved.
    x: i32,
    /// The first triangle that has not begun.
    next: usize,
    /// Those that have begun and may be seen at x or after it; some may have ended.
    open: Vec<u16, N>,
}

impl<const N: usize> Sweep<N> {
    pub(crate) const fn new(line: u16, width: i32) -> Self {
        Self { line, width, x: 0, next: 0, open: Vec::new() }
    }

    /// Puts the next spans into the table, until the line ends or the table is full; whether there are any.
    #[inline(always)]
    pub(crate) fn fill<const L: usize>(
        &mut self,
        list: &mut ActiveList<N>,
        geometry: &Geometry<'_, L>,
        table: &mut Table<N>,
    ) -> bool {
        table.clear();
        if self.x < self.width {
            self.resolve(list, geometry, table);
        }
        !table.spans().is_empty()
    }

    #[inline(never)]
    fn resolve<const L: usize>(&mut self, list: &mut ActiveList<N>, geometry: &Geometry<'_, L>, table: &mut Table<N>) {
        while self.x < self.width && !table.is_full() {
            if self.open.is_empty() {
                self.alone(list.extents(), table);
            }
            if !self.open.is_empty() {
                self.covered(list, geometry, table);
            }
        }
    }

    /// Where none is open: sees one triangle after the other, up to one that the next one overlaps, which is open then.
    #[inline(always)]
    fn alone(&mut self, extents: &[Span], table: &mut Table<N>) {
        let (mut x, mut until) = (self.width, self.x);
        let mut rest = extents.get(self.next..).unwrap_or_default();
        let mut free = table.free();
        let overlapped = loop {
            let [extent, after @ ..] = rest else { break false };
            let (start, end) = (i32::from(extent.start).max(0), i32::from(extent.end));
            if start < end {
                if start < until {
                    x = start;
                    break true;
                }
                let Some(span) = free.next() else {
                    x = start;
                    break false;
                };
                *span = Span { start: start as i16, ..*extent };
                until = end;
            }
            rest = after;
        };
        let left = free.len();
        table.keep(left);
        (self.x, self.next) = (x, extents.len() - rest.len());
        if x >= self.width {
            // Maybe right of the picture.
            while table.spans().last().is_some_and(|last| i32::from(last.end) > self.width) {
                table.cut(self.width);
            }
        } else if overlapped {
            let begun = extents.get(..self.next).unwrap_or_default();
            let front = table.spans().last().map(|span| span.slot);
            if let Some(place) = begun.iter().rposition(|extent| Some(extent.slot) == front) {
                self.wait(place);
            }
        }
    }

    /// Where some are open: sees one triangle after the other, until none is open, or the table is full.
    #[inline(never)]
    fn covered<const L: usize>(&mut self, list: &mut ActiveList<N>, geometry: &Geometry<'_, L>, table: &mut Table<N>) {
        let Self { width, mut x, mut next, .. } = *self;
        // What is nearer than this is in front of all open ones.
        let mut bound = i32::MAX;
        while x < width && !self.open.is_empty() {
            let mut until = width;
            let mut place = next;
            if Open::new(next, list).is_some_and(|other| other.start <= x && other.end > x && other.far > bound) {
                next += 1;
            } else {
                bound = 0;
                if self.open.len() > 1 {
                    (until, bound) = self.elect(x, list, geometry);
                }
                place = self.open.pop().map_or(usize::MAX, usize::from);
            }
            let Some(mut front) = Open::new(place, list).filter(|front| front.end > x) else { break };
            until = until.min(front.end);
            let Some(extent) = list.extents().get(front.place) else { break };
            if !table.resume(Span { start: x as i16, end: until as i16, ..*extent }) {
                self.wait(front.place);
                break;
            }
            while let Some(extent) = list.extents().get(next) {
                let start = i32::from(extent.start).max(0);
                if start >= until {
                    break;
                }
                next += 1;
                if i32::from(extent.end) <= start {
                    continue;
                }
                let Some(other) = Open::new(next - 1, list) else { break };
                let (mut ahead, mut crossing) = (false, i32::MAX);
                if front.far <= other.near {
                    ahead = true;
                    if other.far <= front.near {
                        (ahead, crossing) = self.duel([other.place, front.place], start, list, geometry);
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
                let Some(extent) = list.extents().get(other.place) else { break };
                table.push(Span { start: start as i16, end: until as i16, ..*extent });
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
    fn elect<const L: usize>(&mut self, x: i32, list: &mut ActiveList<N>, geometry: &Geometry<'_, L>) -> (i32, i32) {
        let mut front = Open::NONE;
        while let Some(other) = self.open.pop().and_then(|place| Open::new(place.into(), list)) {
            front = other;
            if front.end > x {
                break;
            }
        }
        for i in 0..self.open.len() {
            let Some(other) = self.open.get(i).and_then(|place| Open::new((*place).into(), list)) else { break };
            let near = other.end > x && front.far <= other.near;
            if near && (other.far > front.near || self.duel([other.place, front.place], x, list, geometry).0) {
                if let Some(place) = self.open.get_mut(i) {
                    *place = front.place as u16;
                }
                front = other;
            }
        }
        let (mut until, mut bound) = (self.width, 0);
        let mut kept = 0;
        for i in 0..self.open.len() {
            let Some(other) = self.open.get(i).and_then(|place| Open::new((*place).into(), list)) else { break };
            let mut crossing = i32::MAX;
            if other.end > x && front.far <= other.near {
                (_, crossing) = self.duel([other.place, front.place], x, list, geometry);
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
        &self,
        [other, front]: [usize; 2],
        x: i32,
        list: &mut ActiveList<N>,
        geometry: &Geometry<'_, L>,
    ) -> (bool, i32) {
        const NEVER: (bool, i32) = (false, i32::MAX);
        let extents = list.extents();
        let (Some(other), Some(front)) = (extents.get(other), extents.get(front)) else { return NEVER };
        let last = i32::from(other.end.min(front.end)).min(self.width) - 1;
        let slots = [other.slot, front.slot];
        for slot in slots {
            match list.get_mut(slot) {
                Some(active) if !active.deep => active.deepen(geometry),
                _ => {}
            }
        }
        let [Some(other), Some(front)] = slots.map(|slot| list.get(slot)) else { return NEVER };
        let wins = || wins(other.id, front.id, geometry);
        let is_ahead = |lead: i32| lead > 0 || lead == 0 && wins();
        let lead = other.depth_at(x, self.line).wrapping_sub(front.depth_at(x, self.line));
        let step = other.depth_step().wrapping_sub(front.depth_step());
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
    fn new<const N: usize>(place: usize, list: &ActiveList<N>) -> Option<Self> {
        let Span { start, end, slot, .. } = *list.extents().get(place)?;
        let [far, near] = list.get(slot)?.reach();
        Some(Self { place, start: start.into(), end: end.into(), far, near })
    }
}

/// Whether `other` is in front where both are equally near.
#[cold]
#[inline(never)]
fn wins<const L: usize>(other: TriangleId, front: TriangleId, geometry: &Geometry<'_, L>) -> bool {
    (geometry.whole(other), other) <= (geometry.whole(front), front)
}
