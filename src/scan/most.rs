//! What a line has at most to do, known before it is resolved.

use core::ops::Range;

use super::{
    active::Active,
    bucket::{Kept, TriangleId},
    edge::Edge,
    list::BATCH,
    picture::Picture,
    table::SPANS,
    vertex::Vertex,
};
use crate::{model::light::LightSource, price::Price, work::Work};

impl<const LIGHTS: usize, L: LightSource> Picture<'_, '_, LIGHTS, L> {
    /// What line y has at most to do: to be drawn or baked by [`Spanning`](crate::Spanning), after the line above it, by a scanner with
    /// room for all its triangles. Nothing below the picture.
    ///
    /// Known from what each triangle covers on it and on the line above. Who is in front is not known, so it is taken that all depths
    /// have to be compared where triangles overlap, that each overlapped pixel parts a span, and that facets are set up late but for
    /// triangles that stood alone on the line above. Looks at all triangles, and sets up the edges of those that cross the line
    /// four times.
    #[must_use]
    pub fn most(&self, y: u16) -> Work {
        let geometry = &self.geometry;
        if y >= geometry.height() {
            return Work::NONE;
        }
        let width = geometry.width() as u16;
        let cover = |y: Option<u16>| {
            let mut cover = Cover::NONE;
            y.into_iter().flat_map(|y| self.crossing(y)).for_each(|crossing| cover.add(crossing.active.columns(width)));
            cover
        };
        let (above, here) = (cover(y.checked_sub(1)), cover(Some(y)));

        let mut known = Known::default();
        for Crossing { kept, mut active, starts } in self.crossing(y) {
            let starts = starts == y;
            known.work.entered += u32::from(starts);
            known.work.stepped += u32::from(!starts);
            let outline = self.outline(kept.ends());
            known.work.turned += u32::from(!starts && outline.turns(y));
            known.work.long += outline.long(y);
            if known.add(&active, &here, width) {
                known.work.exact += (0..kept.count()).map(|half| active.deepen(half, geometry)).sum::<u32>();
            }
            let before = y.checked_sub(1).and_then(|above| self.crossing_of(kept, above));
            let before = before.map_or([0..0, 0..0], |before| before.active.columns_of(width));
            for ((id, columns), before) in active.ids().into_iter().zip(active.columns_of(width)).zip(before) {
                let was_seen = !before.is_empty() && above.is_single(before);
                if !columns.is_empty() && !was_seen {
                    known.work.facets += 1;
                    known.work.asked += self.lines(id).map_or(0, |[start, _, end]| u32::from(end - start));
                }
            }
        }
        let ending = self.ending(y);
        known.finish(self, &here, ending)
    }

    /// What line y takes at most, under the conditions of [`most`](Self::most).
    #[must_use]
    pub fn bound(&self, y: u16, price: &Price) -> u32 {
        price.bound(self.most(y))
    }

    /// What all lines take at most, one by one, from the first to the last: for a [`Schedule`](crate::Schedule).
    pub fn bounds<'a>(&'a self, price: &'a Price) -> impl Iterator<Item = u32> + Clone + 'a {
        (0..self.geometry.height()).map(|y| self.bound(y, price))
    }

    /// The triangles that cross a line.
    fn crossing(&self, y: u16) -> impl Iterator<Item = Crossing> + '_ {
        self.geometry.kept.iter().filter_map(move |kept| self.crossing_of(*kept, y))
    }

    /// What was kept, on a line; none if it does not cross it.
    fn crossing_of(&self, kept: Kept, y: u16) -> Option<Crossing> {
        let [starts, ends] = self.lines_of(kept)?;
        if !(starts..ends).contains(&y) {
            return None;
        }
        let mut active = Active::NONE;
        active.begin(kept, y, &self.geometry)?;
        Some(Crossing { kept, active, starts })
    }

    /// The outline of a triangle, or of two that are a pair.
    pub(crate) fn outline(&self, [one, other]: [TriangleId; 2]) -> Outline<LIGHTS> {
        let corners = |id| self.geometry.corners(id).unwrap_or([Vertex::NONE; 3]);
        let ([a, b, c], [_, _, d]) = (corners(one.min(other)), corners(one.max(other)));
        Outline([a, b, c, d])
    }

    /// The first line of what was kept, and the first one below it.
    fn lines_of(&self, kept: Kept) -> Option<[u16; 2]> {
        let mut lines = kept.triangles().filter_map(|id| self.lines(id)).map(|[start, _, end]| [start, end]);
        let first = lines.next()?;
        Some(lines.fold(first, |[start, end], [other_start, other_end]| [start.min(other_start), end.max(other_end)]))
    }

    /// The first lines of a triangle below its corners, from top to bottom; those above the picture count as its first.
    pub(crate) fn lines(&self, id: TriangleId) -> Option<[u16; 3]> {
        let mut lines = self.geometry.corners(id)?.map(|corner| corner.pixel().y.max(0) as u16);
        lines.sort_unstable();
        Some(lines)
    }

    /// How far down the ladder the lines are that a triangle crosses; none if nothing is degraded.
    pub(crate) fn steps_of(&self, id: TriangleId) -> &[u8] {
        let steps = self.steps.steps;
        let [start, _, end] = self.lines(id).unwrap_or_default().map(|line| steps.len().min(line.into()));
        steps.get(start..end).unwrap_or_default()
    }

    /// Triangles that cross the line above, and end there.
    fn ending(&self, y: u16) -> u32 {
        let ends = |kept| self.lines_of(kept).is_some_and(|[starts, ends]| starts < y && ends == y);
        self.geometry.kept.iter().filter(|kept| ends(**kept)).count() as u32
    }
}

/// The corners of a triangle, or of a pair, in the order of the mesh; of a triangle, the last one twice.
pub(crate) struct Outline<const LIGHTS: usize>([Vertex<LIGHTS>; 4]);

impl<const LIGHTS: usize> Outline<LIGHTS> {
    /// Whether the line is the first one below a corner that is neither the first nor the last.
    pub(crate) fn turns(&self, line: u16) -> bool {
        let rows = self.0.map(|corner| corner.pixel().y);
        let line = i32::from(line);
        line > 0 && rows.iter().any(|row| *row < line) && rows.contains(&line) && rows.iter().any(|row| *row > line)
    }

    /// Edges, and diagonals, for which [`Edge::set`] takes 64 bits, of those that begin on the line.
    pub(crate) fn long(&self, line: u16) -> u32 {
        let [a, b, c, d] = self.0;
        let line = i32::from(line);
        let is_long = |(one, other): &(&Vertex<LIGHTS>, &Vertex<LIGHTS>)| {
            let (top, bottom) = if one.point().y <= other.point().y { (one, other) } else { (other, one) };
            top.pixel().y.max(0) == line && line < bottom.pixel().y && Edge::is_long(top, bottom, line)
        };
        [(&a, &b), (&b, &c), (&c, &d), (&d, &a), (&c, &a)].iter().filter(|edge| is_long(edge)).count() as u32
    }
}

/// A triangle on a line that it crosses.
struct Crossing {
    kept: Kept,
    active: Active,
    /// The first line.
    starts: u16,
}

impl Active {
    /// The pixels that it covers in a picture of that width.
    pub(crate) fn columns(&self, width: u16) -> Range<u16> {
        let (start, end) = self.extent();
        between(start, end, width)
    }

    /// The same for its left triangle and its right one.
    pub(crate) fn columns_of(&self, width: u16) -> [Range<u16>; 2] {
        let (start, end) = self.extent();
        let middle = self.middle().max(start).min(end);
        [between(start, middle, width), between(middle, end, width)]
    }
}

/// The pixels from there to there in a picture of that width.
fn between(start: i16, end: i16, width: u16) -> Range<u16> {
    let [start, end] = [start, end].map(|x| (x.max(0) as u16).min(width));
    start..end
}

/// What is known of a line before it is resolved: counts, of which some follow from others in the end.
#[derive(Default)]
pub(crate) struct Known {
    pub(crate) work: Work,
    /// Triangles that cover pixels; triangles and pairs that begin or end outside of the picture; that overlap others.
    seen: u32,
    outside: u32,
    overlapping: u32,
    /// Twos that overlap, each known by the first pixel of that which begins later.
    twos: u32,
    /// Those that begin over two others or more, and the number of these.
    crowded: u32,
    crowds: u32,
}

impl Known {
    /// What crosses the line. Returns whether it covers pixels that something else covers too.
    pub(crate) fn add(&mut self, active: &Active, here: &Cover, width: u16) -> bool {
        self.work.active += 1;
        let (start, end) = active.extent();
        self.outside += u32::from(start < end && (start < 0 || end > width as i16));
        self.seen += active.columns_of(width).iter().filter(|columns| !columns.is_empty()).count() as u32;
        let columns = active.columns(width);
        let others = here.at(columns.start).saturating_sub(1);
        let overlaps = !columns.is_empty() && !here.is_single(columns);
        if overlaps {
            self.overlapping += 1;
            self.twos += others;
            self.work.deepened += u32::from(active.count());
        }
        if overlaps && others > 1 {
            self.crowded += 1;
            self.crowds += others;
        }
        overlaps
    }

    /// All that follows, where so many triangles ended on the line above.
    pub(crate) fn finish<const LIGHTS: usize, L: LightSource>(
        self,
        picture: &Picture<'_, '_, LIGHTS, L>,
        here: &Cover,
        ended: u32,
    ) -> Work {
        let Self { mut work, seen, outside, overlapping, twos, crowded, crowds } = self;
        let (geometry, width) = (&picture.geometry, picture.geometry.width() as u16);
        (work.walked, work.lines, work.gradients) = (1, 1, picture.background.is_gradient().into());
        // Each of those that stay may pass all others; those that start come some at a time, and each may pass the rest of these.
        let (stay, enter, batch) = (work.stepped, work.entered, BATCH as u32);
        let batches = enter.div_ceil(batch).saturating_mul(work.active);
        work.moved = stay.saturating_mul(stay.saturating_sub(1)) / 2 + batches + enter * (batch - 1) / 2;
        (work.stepped, work.ended) = (work.stepped + ended, ended);

        let ([covered, shared], gaps) = (here.counts(), here.gaps(width));
        // Of each pixel, the triangles behind the first one.
        let behind = here.pixels - covered;
        work.pixels = covered;
        work.filled = u32::from(width) - covered;
        work.gaps = gaps;
        // What parts a triangle's spans is a pixel of it that is hidden.
        work.spans = (seen + behind).min(covered);
        (work.runs, work.started) = (work.spans, work.spans);
        if overlapping + outside > 0 {
            // Times that the table is full.
            let full = work.spans / SPANS as u32;
            // Two cross each other three times at most, as each may be two planes.
            let crossings = shared.min(twos.saturating_mul(3));
            // One is in front until it ends, another one begins, or it is crossed.
            work.fronts = 3 * (overlapping + outside) + crossings + 2 * full + 2;
            // An election is among those that cover a pixel. There is one a pixel, another one where a triangle begins there behind
            // one that waits, and one more where the table is full.
            let elections = work.fronts.min(shared + crowded + full);
            let most = here.deepest().saturating_sub(1);
            let elected = (behind + crowds + full.saturating_mul(most)).min(work.fronts.saturating_mul(most));
            // Some once more, after they ended.
            work.looked = work.active + overlapping + outside + elections + elected;
            work.compared = overlapping + 2 * elected;
        }
        work.dressed = work.spans.min(if geometry.searched() > 2 { u32::MAX } else { 1 });
        work.searched = (work.entered + work.facets + work.spans + 1).saturating_mul(geometry.searched());
        work
    }
}

/// Words with a bit for each of the 1024 pixels that a line has at most.
const WORDS: usize = 1024 / 32;

/// The triangles that cover each pixel of a line, counted.
pub(crate) struct Cover {
    /// The count's four bits, from the lowest, of 32 pixels each; 15 are that many or more.
    words: [[u32; 4]; WORDS],
    /// The words from which on no pixel is covered.
    end: usize,
    /// All triangles, and the sum of their pixels.
    triangles: u32,
    pixels: u32,
}

impl Cover {
    /// None.
    pub(crate) const NONE: Self = Self { words: [[0; 4]; WORDS], end: 0, triangles: 0, pixels: 0 };

    /// Back to none.
    pub(crate) fn clear(&mut self) {
        self.words.iter_mut().take(self.end).for_each(|counts| *counts = [0; 4]);
        (self.end, self.triangles, self.pixels) = (0, 0, 0);
    }

    pub(crate) fn add(&mut self, columns: Range<u16>) {
        self.triangles += 1;
        self.pixels += columns.len() as u32;
        self.end = self.end.max(columns.end.div_ceil(32).into());
        for (counts, bits) in self.words.iter_mut().skip(first(&columns)).zip(words(columns)) {
            let mut carry = bits;
            for bit in counts.iter_mut() {
                if carry == 0 {
                    break;
                }
                (*bit, carry) = (*bit ^ carry, *bit & carry);
            }
            for bit in counts {
                *bit |= carry;
            }
        }
    }

    /// Whether none of these pixels is covered by two.
    #[inline(never)]
    pub(crate) fn is_single(&self, columns: Range<u16>) -> bool {
        self.words.iter().skip(first(&columns)).zip(words(columns)).all(|(counts, bits)| twice(*counts) & bits == 0)
    }

    /// The triangles that cover a pixel.
    fn at(&self, x: u16) -> u32 {
        let counts = self.words.get(usize::from(x / 32)).copied().unwrap_or_default();
        self.known(counts.iter().rev().fold(0, |count, bits| count << 1 | (bits >> (x % 32) & 1)))
    }

    /// The triangles that cover the pixel that most cover.
    fn deepest(&self) -> u32 {
        let deepest = |counts: &[u32; 4]| {
            let (count, _) = counts.iter().rev().fold((0, u32::MAX), |(count, among), bits| match among & bits {
                0 => (count << 1, among),
                among => (count << 1 | 1, among),
            });
            count
        };
        self.known(self.covered().map(deepest).max().unwrap_or(0))
    }

    /// A count that may be more than four bits say.
    const fn known(&self, count: u32) -> u32 {
        if count < 15 {
            count
        } else {
            self.triangles
        }
    }

    /// The words up to the last pixel that is covered.
    fn covered(&self) -> impl Iterator<Item = &[u32; 4]> {
        self.words.iter().take(self.end)
    }

    /// Pixels covered by one or more, and by two or more.
    #[inline(never)]
    pub(crate) fn counts(&self) -> [u32; 2] {
        [once, twice].map(|some| self.covered().map(|counts| some(*counts).count_ones()).sum())
    }

    /// Gaps between covered pixels in a line of that width.
    fn gaps(&self, width: u16) -> u32 {
        let (mut gaps, mut before) = (0, 1);
        for (once, bits) in self.words.iter().map(|counts| once(*counts)).zip(words(0..width)) {
            let starts = !once & bits & (once << 1 | before);
            gaps += starts.count_ones();
            before = once >> 31;
        }
        gaps
    }
}

/// Of 32 pixels, those that one triangle or more cover.
fn once([ones, twos, fours, eights]: [u32; 4]) -> u32 {
    ones | twos | fours | eights
}

/// Those that two or more cover.
fn twice([_, twos, fours, eights]: [u32; 4]) -> u32 {
    twos | fours | eights
}

/// The first word that has one of these pixels.
fn first(columns: &Range<u16>) -> usize {
    usize::from(columns.start / 32)
}

/// The bits of these pixels, word by word, from the first that has one to the last.
fn words(columns: Range<u16>) -> impl Iterator<Item = u32> {
    let words = first(&columns)..usize::from(columns.end.div_ceil(32));
    let Range { start, end } = columns;
    let below = |x: u16, word: usize| {
        let bits = (usize::from(x)).saturating_sub(32 * word).min(32) as u32;
        u32::MAX.checked_shr(32 - bits).unwrap_or(0)
    };
    words.map(move |word| below(end, word) & !below(start, word))
}
