//! What was done, or is at most to be done, in counts that a price list turns into time.

use core::ops::{Add, Sub};

macro_rules! work {
    ($($(#[$doc:meta])* $name:ident,)*) => {
        /// Counts of all that takes time between a frame and its rows; in a [`Price`](crate::Price), what one of each takes.
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
        pub struct Work {
            $($(#[$doc])* pub $name: u32,)*
        }

        impl Work {
            /// The names of the counts.
            pub const NAMES: &'static [&'static str] = &[$(stringify!($name)),*];
            /// Number of counts.
            pub const COUNT: usize = Self::NAMES.len();
            /// Nothing.
            pub const NONE: Self = Self { $($name: 0),* };

            /// With counts in the order of their names.
            #[must_use]
            pub const fn of([$($name),*]: [u32; Self::COUNT]) -> Self {
                Self { $($name),* }
            }

            /// The counts in the order of their names.
            #[must_use]
            pub const fn counts(self) -> [u32; Self::COUNT] {
                [$(self.$name),*]
            }
        }

        impl Work {
            /// The sum of all counts, each times its price.
            pub(crate) fn at(&self, prices: &Self) -> u32 {
                let mut sum = 0;
                // Many counts are 0.
                $(if self.$name > 0 {
                    sum = with_product(sum, self.$name, prices.$name);
                })*
                sum
            }
        }

        impl From<[u32; Work::COUNT]> for Work {
            fn from(counts: [u32; Work::COUNT]) -> Self {
                Self::of(counts)
            }
        }

        impl Add for Work {
            type Output = Self;

            fn add(self, other: Self) -> Self {
                Self { $($name: self.$name.wrapping_add(other.$name)),* }
            }
        }

        impl Sub for Work {
            type Output = Self;

            fn sub(self, other: Self) -> Self {
                Self { $($name: self.$name.wrapping_sub(other.$name)),* }
            }
        }
    };
}

work! {
    /// Lines resolved.
    walked,
    /// Triangles that cross them.
    active,
    /// Steps of a triangle to its next line.
    stepped,
    /// Of those, steps past the middle corner.
    turned,
    /// Of those, steps past the last corner: triangles let go.
    ended,
    /// Triangles that started.
    entered,
    /// Edges of 128 pixels and more, for triangles that started or turned.
    long,
    /// Places by which triangles moved to stay in order.
    moved,
    /// Objects, and parts of a mesh, looked through for those of triangles and materials.
    searched,
    /// Times that one was found to be in front where some lie over others.
    fronts,
    /// Triangles looked at for that.
    looked,
    /// Pairs whose depths were compared.
    compared,
    /// Planes of depths set up for that.
    deepened,
    /// Of those, planes by 64-bit divisions.
    exact,
    /// Visible spans handed on.
    spans,
    /// Facets set up.
    facets,
    /// Lines asked for the rungs of these.
    asked,
    /// Lines shaded.
    lines,
    /// Of those, lines whose background is a gradient.
    gradients,
    /// Gaps between spans, filled with the background.
    gaps,
    /// Pixels filled with the background.
    filled,
    /// Materials made ready.
    dressed,
    /// Spans started from their facets.
    started,
    /// Spans shaded.
    runs,
    /// Pixels shaded, by [kind](crate::Shade::kind): the first kind,
    pixels,
    /// the second,
    pixels_1,
    /// the third,
    pixels_2,
    /// and the fourth.
    pixels_3,
}

/// A sum and a product more; out of line, as it is where there is no long multiplication.
#[inline(never)]
fn with_product(sum: u32, count: u32, price: u32) -> u32 {
    sum.saturating_add(count.saturating_mul(price))
}

impl Work {
    /// That which each method has a price of its own for, apart from the rest.
    pub(crate) fn by_method(self) -> [Self; 2] {
        let Self { spans, facets, started, runs, pixels, pixels_1, pixels_2, pixels_3, .. } = self;
        let own = Self { spans, facets, started, runs, pixels, pixels_1, pixels_2, pixels_3, ..Self::NONE };
        [own, self - own]
    }
}

/// A sum of work, for the calibration of prices: kept with the feature `tally`; without it, it is nothing, and stays so.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Tally {
    #[cfg(feature = "tally")]
    sum: Work,
}

impl Tally {
    pub(crate) const NONE: Self = Self {
        #[cfg(feature = "tally")]
        sum: Work::NONE,
    };

    #[inline(always)]
    pub(crate) fn add(&mut self, _more: Work) {
        #[cfg(feature = "tally")]
        {
            self.sum = self.sum + _more;
        }
    }

    #[inline(always)]
    pub(crate) const fn work(self) -> Work {
        #[cfg(feature = "tally")]
        return self.sum;
        #[cfg(not(feature = "tally"))]
        Work::NONE
    }
}
