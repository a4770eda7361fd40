//! What one of each piece of work takes on a core.

use crate::work::Work;

/// What one of each count of [`Work`] takes at most, in sixteenths of a cycle of a core.
///
/// A cost is never below what is counted, under the conditions of the price list: one directional light,
/// [`Spanning`](crate::Spanning), pixels in `Rgb565` or its two bytes, `opt-level = 2` and `lto`, and a core without wait states: what a flash
/// and its caches add is not in it, nor are interrupts, nor the transfer of rows, nor [smooth lines](crate::Lines::smooth_line), nor lines
/// for which the scanner has no room, nor vertices that a [`LeanFrame`](crate::LeanFrame) makes anew. Cycles are those of the Technical
/// Reference Manuals of Cortex-M0+ and Cortex-M4, of the latter with the most that a branch or a division may take.
///
/// Prices are the least ones, and 8 % more (12 % up to the visible spans), at which none of the lines of 1000 random scenes costs less than was counted: `cargo xtask
/// cost --calibrate` makes them anew, and checks them on 1000 other scenes and on the standard ones. They go with the compiler, and with
/// changes of what they price.
///
/// ```
/// use beamshade::{Price, Work};
///
/// let price = Price(Work { lines: 400 * 16, pixels: 30 * 16, ..Work::NONE });
/// assert_eq!(price.of(Work { lines: 1, pixels: 100, ..Work::NONE }), 3400);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Price(pub Work);

impl Price {
    /// What that much work takes at most, in cycles; 2²⁸ − 1 if it is more.
    #[must_use]
    pub fn of(&self, work: Work) -> u32 {
        cycles([self.sixteenths(work)])
    }

    /// The same in sixteenths of a cycle.
    pub(crate) fn sixteenths(&self, work: Work) -> u32 {
        work.at(&self.0)
    }

    /// What a line with at most so much to do takes at most: pixels of whatever kind, known before facets are set up, being of the
    /// dearest one.
    #[must_use]
    pub fn bound(&self, most: Work) -> u32 {
        self.of_any_kind().of(most)
    }

    /// The price list with all pixels at the price of the dearest kind.
    pub(crate) fn of_any_kind(&self) -> Self {
        let Self(prices) = *self;
        let dearest = prices.pixels.max(prices.pixels_1).max(prices.pixels_2).max(prices.pixels_3);
        Self(Work { pixels: dearest, pixels_1: dearest, pixels_2: dearest, pixels_3: dearest, ..prices })
    }

    /// For each piece of work the dearest of several prices.
    #[must_use]
    pub fn dearest(prices: &[Self]) -> Self {
        let mut dearest = [0; Work::COUNT];
        for Self(prices) in prices {
            for (dearest, price) in dearest.iter_mut().zip(prices.counts()) {
                *dearest = price.max(*dearest);
            }
        }
        Self(Work::from(dearest))
    }
}

/// A sum of sixteenths in whole cycles, rounded up.
pub(crate) fn cycles(parts: impl IntoIterator<Item = u32>) -> u32 {
    parts.into_iter().fold(15, u32::saturating_add) >> 4
}
