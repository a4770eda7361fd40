//! Few colours: pixels that are numbers of a palette's colours, and the palette for them.

use embedded_graphics::pixelcolor::{
    raw::{RawData, RawU4, RawU8},
    PixelColor,
};

use super::ink::Ink;
use crate::{
    model::material::{Color, Material},
    shade::{Intensity, Paint},
};

/// The colours of a display that is sent numbers: colour 0 for the background, and a range for each material.
///
/// *OTMPHONG.DOC*, "The Phong illumination model": a material's colours are those that it has under one angle x, the same to the light
/// and to the half vector, in equal steps from 90° to 0: `ambient + cos x · diffuse + cosⁿ x · specular` (the document calls the first
/// term specular, too). Steps of the angle leave more colours to a highlight than the document's steps of the cosine would.
///
/// Light reaches a surface by two angles, though; what a pixel's number stands for is its brightness: see [`Indexed`].
///
/// ```
/// use beamshade::{Color, Indexed, Material, Palette};
/// use embedded_graphics::pixelcolor::Rgb565;
///
/// static COPPER: Material = Material::new(Color::rgb(0.85, 0.45, 0.20)).colors(1, 9);
/// static SLATE: Material = Material::new(Color::rgb(0.20, 0.25, 0.30)).colors(10, 15);
/// static PALETTE: Palette<16> = Palette::new(Color::BLACK).with(&COPPER).with(&SLATE);
///
/// for color in PALETTE.colors::<Rgb565>() {
///     // into the display's palette
/// }
/// // Lines and whole frames are drawn in numbers: `lines.line(y, &mut row)`.
/// let row = [Indexed::<16>::default(); 240];
/// let _bytes = row.as_chunks().0.iter().map(|&[left, right]| Indexed::pair(left, right));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Palette<const COLORS: usize>([Color; COLORS]);

impl<const COLORS: usize> Palette<COLORS> {
    /// A palette of nothing but the background's colour.
    #[must_use]
    pub const fn new(background: Color) -> Self {
        Self([background; COLORS])
    }

    /// The same with a material's colours in [their range](Material::colors), as far as it lies in the palette; built in a `const`
    /// or at the start.
    #[must_use]
    pub const fn with(mut self, material: &Material) -> Self {
        let Range { first, steps } = Range::of::<COLORS>(material);
        let mut step = 0;
        while step <= steps && ((first + step) as usize) < COLORS {
            #[expect(clippy::indexing_slicing, reason = "below COLORS; slice::get is not const")]
            {
                self.0[(first + step) as usize] = material.at_angle(Material::ramp_angle(step, steps));
            }
            step += 1;
        }
        self
    }

    /// The colour of a pixel; black for a number that the palette has not.
    #[must_use]
    pub fn color(&self, Indexed(number): Indexed<COLORS>) -> Color {
        self.0.get(usize::from(number)).copied().unwrap_or(Color::BLACK)
    }

    /// All colours in order, as the display takes them.
    pub fn colors<'p, P: Ink + 'p>(&'p self) -> impl Iterator<Item = P> + 'p {
        self.0.iter().copied().map(P::plain)
    }
}

/// A pixel as the number of a colour in a [palette](Palette) of at most 256.
///
/// Of the material's colours it is the one as bright as the pixel, by [luma](Color::luma) before any channel saturates:
/// `diffuse·base·d + specular·highlight·s`, d and s the intensities, is looked up on the ramp by 256 steps; light beyond the ramp's last
/// colour counts as that. The hue is the ramp's: with a white highlight, light of a highlight on a dark side is shown as if it were
/// diffuse. Backgrounds are colour 0, whatever colour they ask for.
///
/// On the standard scene, all 60 frames, the colours are so far from those in `Rgb888` (worst PSNR in dB / mean level of 255):
///
/// | colours | orange | white |
/// |---|---|---|
/// | 16 | 36.7 / 2.5 | 33.9 / 4.1 |
/// | 64 | 43.4 / 0.9 | 45.9 / 1.0 |
/// | 256 | 44.1 / 0.8 | 50.6 / 0.6 |
///
/// 16 colours in equal steps of the cosine would be 4 dB worse in orange, in equal steps of the brightness 3 dB.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Indexed<const COLORS: usize>(pub u8);

impl Indexed<16> {
    /// Two pixels in a byte, the left one in its upper half.
    #[must_use]
    pub const fn pair(Self(left): Self, Self(right): Self) -> u8 {
        left << 4 | right & 15
    }
}

/// A material's part of a palette.
#[derive(Clone, Copy, Debug)]
struct Range {
    first: u32,
    /// From its first colour to its last.
    steps: u32,
}

impl Range {
    const fn of<const COLORS: usize>(material: &Material) -> Self {
        let [first, last] = material.colors;
        let most = COLORS.saturating_sub(1);
        let (first, last) = (at_most(first, most), at_most(last, most));
        Self { first, steps: last.saturating_sub(first) }
    }
}

const fn at_most(number: u8, most: usize) -> u32 {
    if (number as usize) < most {
        number as u32
    } else {
        most as u32
    }
}

/// A material in numbers.
#[derive(Clone, Copy, Debug)]
pub struct Ramp<'m> {
    places: &'m [u8; 256],
    /// Shares of both kinds of light, Q15.
    shares: [u32; 2],
    /// The first number, with a half for rounding; and numbers from one of the ramp's 255 places to the next. Q16.
    first: u32,
    step: u32,
}

impl<const COLORS: usize> Ink for Indexed<COLORS> {
    type Paint<'m> = Ramp<'m>;

    fn paint(material: &Material) -> Ramp<'_> {
        let Range { first, steps } = Range::of::<COLORS>(material);
        let share = u32::from(material.share);
        // 257 is 2¹⁶/255.
        Ramp { places: &material.places, shares: [share, (1 << 15) - share], first: (first << 16) + (1 << 15), step: steps * 257 }
    }

    /// There is no number for a colour between two.
    const BLENDS: bool = false;

    fn plain(_: Color) -> Self {
        Self(0)
    }
}

impl<const COLORS: usize> Paint<Indexed<COLORS>> for Ramp<'_> {
    #[inline]
    fn mix(&self, intensity: Intensity) -> Indexed<COLORS> {
        let [diffuse, specular] = self.shares;
        // Q14 · Q15: one in 29 bits.
        let light = intensity.diffuse * diffuse + intensity.specular * specular;
        let place = self.places.get((light >> 21) as usize).copied().unwrap_or(u8::MAX);
        Indexed(((self.first + u32::from(place) * self.step) >> 16) as u8)
    }
}

impl PixelColor for Indexed<16> {
    type Raw = RawU4;
}

impl From<RawU4> for Indexed<16> {
    fn from(raw: RawU4) -> Self {
        Self(raw.into_inner())
    }
}

impl From<Indexed<16>> for RawU4 {
    fn from(Indexed(number): Indexed<16>) -> Self {
        Self::new(number)
    }
}

impl PixelColor for Indexed<64> {
    type Raw = RawU8;
}

impl PixelColor for Indexed<256> {
    type Raw = RawU8;
}

impl<const COLORS: usize> From<RawU8> for Indexed<COLORS> {
    fn from(raw: RawU8) -> Self {
        Self(raw.into_inner())
    }
}

impl<const COLORS: usize> From<Indexed<COLORS>> for RawU8 {
    fn from(Indexed(number): Indexed<COLORS>) -> Self {
        Self::new(number)
    }
}
