//! Degrade, never tear: cheaper methods for the lines that would be late, known before the first one is drawn.
//!
//! A [`Plan`] walks down a picture without drawing it, and finds for each line how far it has to go down a ladder of methods until
//! its bound keeps the line period: one rung for the far triangles on it, then that rung for the near ones too, then the next one for
//! the far ones, and so on. A triangle is shaded by one method: that which the line asks for that is farthest down, of all that it
//! crosses. So it is set up once, it has no stripes, and the pixels are the same in whatever order lines are drawn. No clock has a
//! say: the same picture and period give the same pixels everywhere.

use heapless::Vec;

use crate::{
    model::light::LightSource,
    price::{cycles, Price},
    scan::{
        active::Active,
        most::{Cover, Known},
        picture::{Picture, Steps},
        visibility::Visibility,
    },
    scanner::Lines,
    shade::{
        choose::{ByRung, Choose},
        duff_barycentric::DuffBarycentric,
        flat::Flat,
        gouraud::Gouraud,
        quadratic_intensity::QuadraticIntensity,
        Shade,
    },
    work::Work,
};

/// The ladder from the default by quadratics and Gouraud down to flat: a method for a [`Scanner`](crate::Scanner).
pub type Degrading = Choose<DuffBarycentric, Choose<QuadraticIntensity, Choose<Gouraud, Flat, ByRung<3>>, ByRung<2>>, ByRung<1>>;

/// How many facets were set up by cheaper methods: on the first rung below the top, the second, and the third.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Degraded(pub [u16; 3]);

impl Degraded {
    pub(crate) fn count(&mut self, rung: u8) {
        let Self(counts) = self;
        if let Some(count) = usize::from(rung).checked_sub(1).and_then(|rung| counts.get_mut(rung)) {
            *count = count.saturating_add(1);
        }
    }
}

/// What the lines of a picture take at most, and how far down the ladder each of them goes for that: 5 bytes a line.
///
/// ```
/// # use beamshade::{Camera, Degrading, Frame, Light, Plan, Price, Scanner, Schedule};
/// # use embedded_graphics::{geometry::Size, pixelcolor::{Rgb565, RgbColor}};
/// # let mut frame = Frame::<8, 8, 48>::new();
/// # frame.begin(&Camera::new(Size::new(64, 48)), &[Light::OFF])?;
/// # let mut row = [Rgb565::BLACK; 64];
/// const PERIOD: u32 = 8000; // cycles
/// let mut scanner = Scanner::<72, Degrading>::new();
/// let mut plan = Plan::<48>::new();
/// plan.make(scanner.start(frame.picture()), &Price::M0_PLUS_DEGRADING, PERIOD);
/// let schedule = Schedule::new(plan.bounds().iter().copied(), PERIOD);
/// assert_eq!((plan.late(), schedule.look_ahead), (0, 1));
/// let mut lines = scanner.start(plan.degrade(frame.picture()));
/// for y in 0..48 {
///     lines.line(y, &mut row);
/// }
/// assert_eq!(lines.degraded().0, [0; 3]);
/// # Ok::<(), beamshade::Full>(())
/// ```
#[derive(Clone, Debug)]
pub struct Plan<const LINES: usize> {
    bounds: Vec<u32, LINES>,
    /// How far down each line is.
    steps: Vec<u8, LINES>,
    middle: u16,
    late: u16,
}

impl<const LINES: usize> Plan<LINES> {
    /// A plan for a picture without lines.
    #[must_use]
    pub const fn new() -> Self {
        Self { bounds: Vec::new(), steps: Vec::new(), middle: 0, late: 0 }
    }

    /// Makes the plan for a picture, given the price list of each method from the top of the ladder down, and the line period in the
    /// same unit; with one list, it tells the bounds alone. Costs the walk down the picture, without comparing depths or shading.
    ///
    /// Bounds hold under the conditions of [`Picture::most`], one line drawn after the other, from the first one on.
    pub fn make<const ACTIVE: usize, S: Shade<LIGHTS, L>, const LIGHTS: usize, L: LightSource, V: Visibility>(
        &mut self,
        mut lines: Lines<'_, '_, ACTIVE, S, LIGHTS, L, V>,
        prices: &[Price],
        period: u32,
    ) {
        lines.rewind();
        let picture = *lines.picture();
        self.bounds.clear();
        self.steps.clear();
        (self.middle, self.late) = (middle(&picture), 0);
        let rungs = Rungs::new(prices);
        let last = 2 * prices.len().saturating_sub(1).min(3) as u8;
        let mut descent = Descent { picture: &picture, middle: self.middle, here: Cover::NONE, near: Cover::NONE, above: 0 };
        for y in (0..picture.geometry.height()).take(LINES) {
            let Some(Halves { all, near }) = descent.line(&mut lines, y) else { break };
            let [own, rest] = all.by_method();
            let (far, rest) = (own - near, rungs.rest.sixteenths(rest));
            let (mut of_near, mut of_far) = (rungs.of(0, near), rungs.of(0, far));
            let (mut step, mut bound) = (0, cycles([of_near, of_far, rest]));
            while bound > period && step < last {
                step += 1;
                // To each rung far triangles go first.
                if step % 2 == 1 {
                    of_far = rungs.of(step / 2 + 1, far);
                } else {
                    of_near = rungs.of(step / 2, near);
                }
                bound = cycles([of_near, of_far, rest]);
            }
            self.late = self.late.saturating_add((bound > period).into());
            // There is room for both.
            let _ = self.bounds.push(bound);
            let _ = self.steps.push(step);
        }
    }

    /// What each line takes at most; for a [`Schedule`](crate::Schedule).
    #[must_use]
    pub fn bounds(&self) -> &[u32] {
        &self.bounds
    }

    /// How far down the ladder each line is: 0 where nothing is degraded, 1 if the far half of the picture goes down a rung, 2 if all of
    /// it does, 3 if the far half goes down another one, and so on.
    #[must_use]
    pub fn steps(&self) -> &[u8] {
        &self.steps
    }

    /// Lines that may be late even at the foot of the ladder.
    #[must_use]
    pub const fn late(&self) -> u16 {
        self.late
    }

    /// The picture, to be drawn as planned by a method that asks for it, such as [`Degrading`].
    #[must_use]
    pub fn degrade<'f, 'm, const LIGHTS: usize, L: LightSource>(
        &'f self,
        picture: Picture<'f, 'm, LIGHTS, L>,
    ) -> Picture<'f, 'm, LIGHTS, L> {
        Picture { steps: Steps { steps: &self.steps, middle: self.middle }, ..picture }
    }
}

impl<const LINES: usize> Default for Plan<LINES> {
    fn default() -> Self {
        Self::new()
    }
}

/// A walk down a picture from line to line, without comparing depths or shading.
struct Descent<'p, 'f, 'm, const LIGHTS: usize, L: LightSource> {
    picture: &'p Picture<'f, 'm, LIGHTS, L>,
    /// What is nearer is near.
    middle: u16,
    /// What covers the line: all triangles, and the near ones.
    here: Cover,
    near: Cover,
    /// How many cross the line above.
    above: u32,
}

impl<const LIGHTS: usize, L: LightSource> Descent<'_, '_, '_, LIGHTS, L> {
    /// What is known of line y, the next one; none below the picture.
    fn line<const ACTIVE: usize, S: Shade<LIGHTS, L>, V: Visibility>(
        &mut self,
        lines: &mut Lines<'_, '_, ACTIVE, S, LIGHTS, L, V>,
        y: u16,
    ) -> Option<Halves> {
        let Self { picture, middle, here, near, above } = self;
        let geometry = &picture.geometry;
        let width = geometry.width() as u16;
        let (extents, slots) = lines.crossing(y)?;
        let is_near = |active: &Active| {
            let [_, nearest] = active.reach();
            nearest > i32::from(*middle)
        };
        here.clear();
        near.clear();
        for active in extents.iter().filter_map(|extent| slots.get(usize::from(extent.slot()))) {
            here.add(active.columns(width));
            if is_near(active) {
                near.add(active.columns(width));
            }
        }
        let mut known = Known::default();
        let mut near_facets = 0;
        known.work.entered = geometry.starting(y).count() as u32;
        for extent in extents {
            let Some(active) = slots.get_mut(usize::from(extent.slot())) else { continue };
            let overlaps = known.add(active, here, width);
            // No facets are set up: their numbers say what is known of each triangle, the first one also of both.
            let turns_next = active.turns(u32::from(y) + 1);
            let [both, _] = &mut active.facets;
            let (is_there, turns) = (*both & THERE != 0, *both & TURNS != 0);
            *both = *both & !TURNS | THERE | if turns_next { TURNS } else { 0 };
            known.work.turned += u32::from(turns);
            if turns || !is_there {
                known.work.long += picture.outline(active.ids()).long(y);
            }
            let (is_near, columns, count) = (is_near(active), active.columns_of(width), active.count());
            for (half, columns) in (0..usize::from(count)).zip(columns) {
                let mut facet = active.facets.get(half).copied().unwrap_or(0);
                if overlaps && facet & EXACT_KNOWN == 0 {
                    facet |= EXACT_KNOWN | if active.deepen(half, geometry) > 0 { EXACT } else { 0 };
                }
                known.work.exact += u32::from(overlaps && facet & EXACT != 0);
                if !columns.is_empty() && facet & SEEN == 0 {
                    known.work.facets += 1;
                    let lines = picture.lines(active.id(half)).map_or(0, |[start, _, end]| end.saturating_sub(start));
                    known.work.asked += u32::from(lines);
                    near_facets += u32::from(is_near);
                }
                if !columns.is_empty() && (!overlaps || here.is_single(columns)) {
                    facet |= SEEN;
                }
                if let Some(room) = active.facets.get_mut(half) {
                    *room = facet;
                }
            }
        }
        known.work.stepped = known.work.active.saturating_sub(known.work.entered);
        let ended = above.saturating_sub(known.work.stepped);
        *above = known.work.active;
        let all = known.finish(picture, here, ended);
        let [pixels, _] = near.counts();
        let spans = all.spans.min(pixels);
        let near = Work { facets: near_facets, spans, started: spans, runs: spans, pixels, ..Work::NONE };
        Some(Halves { all, near })
    }
}

/// What is known of a triangle: that it is seen, so that its facet is there; and whether its depths take 64-bit divisions.
const SEEN: u16 = 1;
const EXACT_KNOWN: u16 = 2;
const EXACT: u16 = 4;
/// Of one or both that make a pair: that it crosses the line above; and that it turns on this one.
const THERE: u16 = 8;
const TURNS: u16 = 16;

/// What a line has at most to do, and of that what is, at most, for near triangles.
struct Halves {
    all: Work,
    near: Work,
}

/// The prices of a ladder.
struct Rungs {
    /// For each rung, of triangles on it or below: of each piece of work the dearest.
    own: [Price; 4],
    /// Of what is the same on all.
    rest: Price,
}

impl Rungs {
    fn new(prices: &[Price]) -> Self {
        let below = |rung: usize| Price::dearest(prices.get(rung..).unwrap_or_default()).of_any_kind();
        Self { own: [0, 1, 2, 3].map(below), rest: Price::dearest(prices) }
    }

    /// What that much work of triangles on a rung or below takes at most, in sixteenths.
    fn of(&self, rung: u8, work: Work) -> u32 {
        self.own.get(usize::from(rung)).map_or(0, |price| price.sixteenths(work))
    }
}

/// Halfway between the farthest and the nearest corner of a picture, the upper 16 bits of the nearness.
fn middle<const LIGHTS: usize, L: LightSource>(picture: &Picture<'_, '_, LIGHTS, L>) -> u16 {
    let corners =
        picture.geometry.kept.iter().flat_map(|kept| kept.triangles()).filter_map(|id| picture.geometry.corners(id)).flatten();
    let (far, near) = corners.map(|corner| corner.nearness()).fold((u32::MAX, 0), |(far, near), w| (far.min(w), near.max(w)));
    ((u64::from(far) + u64::from(near)) >> 9) as u16
}
