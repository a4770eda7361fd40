//! Integer powers of a cosine, as a table over the range where they show.

/// `cosⁿ` for one exponent n, tabulated over the range in which it reaches 1/512 or more.
///
/// The table has 512 entries of equal width, 2⁻ᵏ/512, the first where the power begins to show, each with the power in its
/// middle; k is the largest that keeps the whole visible range inside.
///
/// Error against f64, for n = 1 … 256: at most 1.36·10⁻² (half of what an entry differs from the next), RMS below 2.0·10⁻³.
/// By exponent, beside parabolas in the angle: see [`PiecewisePower`](super::piecewise::PiecewisePower).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Power {
    exponent: u16,
    /// The table covers cosines over a width of 2⁻ᵏ.
    zeros: u8,
    /// The first place in the table where the power reaches [`FAINT`](Self::FAINT).
    faint: u16,
    /// The cosine at which the power begins to show, Q31.
    start: u32,
    table: [u16; Power::ENTRIES],
}

impl Power {
    const ENTRIES: usize = 512;
    /// One, as a Q31 cosine.
    const ONE: u32 = 1 << 31;
    /// One, as the power in Q14.
    const PEAK: u16 = 1 << 14;
    /// What is too little for formats of few bits, as the power in Q14: 1/128.
    pub const FAINT: u32 = 1 << 7;

    /// Tabulates `cosⁿ` for n = `exponent`; 0 counts as 1. Integers only, so it costs the same at compile time and on a chip.
    #[must_use]
    pub const fn new(exponent: u16) -> Self {
        let exponent = if exponent == 0 { 1 } else { exponent };
        let mut zeros = 0;
        while zeros < 15 && Self::exact(Self::ONE - (Self::ONE >> (zeros + 1)), exponent) < (1 << 21) {
            zeros += 1;
        }
        let width = Self::ONE >> (zeros + 9);
        let mut entries = 0;
        // Below 1/512 nothing shows.
        while entries < Self::ENTRIES as u32 && Self::exact(Self::ONE - entries * width - width / 2, exponent) >= (1 << 21) {
            entries += 1;
        }
        // The first entry is for all below it, too.
        entries = if entries < Self::ENTRIES as u32 { entries + 1 } else { entries };
        let start = Self::ONE - entries * width;
        let mut table = [Self::PEAK; Self::ENTRIES];
        table[0] = 0;
        let mut faint = 1;
        let mut i = 1;
        while i < entries {
            let power = (Self::exact(start + i * width + width / 2, exponent) + (1 << 15)) >> 16;
            if power < Self::FAINT {
                faint = i as u16 + 1;
            }
            #[expect(clippy::indexing_slicing, reason = "i < ENTRIES; slice::get is not const")]
            {
                table[i as usize] = power as u16;
            }
            i += 1;
        }
        Self { exponent, zeros: zeros as u8, faint, start, table }
    }

    /// `cosⁿ` in Q30 by repeated squaring; `cos` is Q31, at most one.
    pub(crate) const fn exact(cos: u32, exponent: u16) -> u32 {
        let mut base = cos as u64;
        let mut value = Self::ONE as u64;
        let mut left = exponent;
        while left > 0 {
            if left & 1 == 1 {
                value = (value * base) >> 31;
            }
            base = (base * base) >> 31;
            left >>= 1;
        }
        (value >> 1) as u32
    }

    /// The exponent n.
    #[must_use]
    pub const fn exponent(&self) -> u16 {
        self.exponent
    }

    /// The cosine from which on the power shows, Q31.
    #[must_use]
    pub const fn start(&self) -> u32 {
        self.start
    }

    /// k: cosines from [`start`](Self::start) to one lie at heights of 0 to 2²⁹, a height being `(cos − start) · 2^(29 + k)`.
    #[inline(always)]
    #[must_use]
    pub const fn zeros(&self) -> i32 {
        self.zeros as i32
    }

    /// `cosⁿ` in Q14 (one is 16384) for a height of the cosine; heights of 0 and less give 0, those above one count as one.
    #[inline(always)]
    #[must_use]
    pub fn at_height(&self, height: i32) -> u32 {
        let entry = (height >> 20).clamp(0, Self::ENTRIES as i32 - 1);
        self.table.get(entry as usize).copied().unwrap_or(0).into()
    }

    /// `cosⁿ` in Q14 for a cosine in Q31; cosines above one count as one.
    #[inline(always)]
    #[must_use]
    pub fn at(&self, cos: u32) -> u32 {
        if cos <= self.start {
            return 0;
        }
        self.entry((cos - self.start) >> self.shift())
    }

    /// A place in the table before which the power is less than that, Q14.
    #[inline(always)]
    #[must_use]
    pub const fn first(&self, least: u32) -> u32 {
        if least >= Self::FAINT {
            self.faint as u32
        } else {
            0
        }
    }

    /// The height of a place in the table.
    #[inline(always)]
    #[must_use]
    pub const fn height_of(place: u32) -> i32 {
        (place << 20) as i32
    }

    /// Of what a Q31 cosine is above [`start`](Self::start), how far it is to be shifted down for the place in the table.
    #[inline(always)]
    #[must_use]
    pub fn shift(&self) -> u32 {
        // 22 bits are left of a width of 2⁻ᵏ.
        u32::from(22 - self.zeros) & 31
    }

    /// `cosⁿ` in Q14 at a place in the table; beyond it, one.
    #[inline(always)]
    #[must_use]
    pub fn entry(&self, place: u32) -> u32 {
        self.table.get(place as usize).copied().unwrap_or(Self::PEAK).into()
    }
}
