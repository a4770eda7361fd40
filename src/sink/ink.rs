//! From light to pixels.

use embedded_graphics::pixelcolor::{raw::RawU16, Gray4, Gray8, IntoStorage, Rgb565, Rgb888};

use crate::{
    model::material::{Color, Material},
    shade::{Intensity, Paint},
};

/// A pixel that light can be turned into. Each channel is rounded to the nearest level once, after all sums, and saturates.
pub trait Ink: Copy {
    /// A material's colours, made ready for this kind of pixel.
    type Paint<'m>: Paint<Self>;

    /// Makes a material ready.
    fn paint(material: &Material) -> Self::Paint<'_>;

    /// Whether [`plain`](Self::plain) has a pixel for any colour; if not, transparent surfaces are opaque, and silhouettes are not smoothed.
    const BLENDS: bool = true;

    /// The pixel of a colour as it is.
    fn plain(color: Color) -> Self;
}

/// The first bit above every level.
const OVER: u32 = 29;

/// One channel of a material with `BITS` bits: `ambient + diffuse · d + specular · s`, levels in the upper bits of a word.
#[derive(Clone, Copy, Debug)]
struct Channel<const BITS: u32> {
    /// With half a level for rounding.
    ambient: u32,
    /// Per Q14 of intensity, both.
    diffuse: u32,
    specular: u32,
}

impl<const BITS: u32> Channel<BITS> {
    const LARGEST: u32 = (1 << BITS) - 1;
    /// The place of a level's lowest bit: two products of intensities below 2, and an ambient of at most 1, fit a word.
    const PLACE: u32 = OVER - BITS;

    fn new(material: &Material, base: u16, highlight: u16) -> Self {
        // Q15 · Q15, times the largest level: Q15 of the word's unit for an intensity of one.
        let level = |coefficient: u16, factor: u16| {
            let product = (u32::from(coefficient) * u32::from(factor)) >> 15;
            product - (product >> BITS)
        };
        Self {
            ambient: (level(material.ambient, base) << 14) + (1 << (Self::PLACE - 1)),
            diffuse: level(material.diffuse, base),
            specular: level(material.specular, highlight),
        }
    }

    /// The sum, in which a level above the largest shows in the bits from [`OVER`] on.
    #[inline(always)]
    fn sum(&self, intensity: Intensity) -> u32 {
        self.ambient + self.diffuse * intensity.diffuse + self.specular * intensity.specular
    }

    #[inline(always)]
    fn saturated(sum: u32) -> u32 {
        (sum >> Self::PLACE).min(Self::LARGEST)
    }

    #[inline(always)]
    fn level_of(&self, intensity: Intensity) -> u8 {
        Self::saturated(self.sum(intensity)) as u8
    }

    /// The level of a Q15 factor, one at most.
    const fn level(factor: u16) -> u8 {
        ((factor as u32 * Self::LARGEST + (1 << 14)) >> 15) as u8
    }
}

/// A material in three channels.
#[derive(Clone, Copy, Debug)]
pub struct Rgb<const R: u32, const G: u32, const B: u32>(Channel<R>, Channel<G>, Channel<B>);

impl<const R: u32, const G: u32, const B: u32> Rgb<R, G, B> {
    fn new(material: &Material) -> Self {
        let ([br, bg, bb], [hr, hg, hb]) = (material.base.0, material.highlight.0);
        Self(Channel::new(material, br, hr), Channel::new(material, bg, hg), Channel::new(material, bb, hb))
    }

    #[inline(always)]
    fn levels_of(&self, intensity: Intensity) -> [u32; 3] {
        let sums = [self.0.sum(intensity), self.1.sum(intensity), self.2.sum(intensity)];
        let [r, g, b] = sums;
        if (r | g | b) >> OVER == 0 {
            [r >> Channel::<R>::PLACE, g >> Channel::<G>::PLACE, b >> Channel::<B>::PLACE]
        } else {
            [Channel::<R>::saturated(r), Channel::<G>::saturated(g), Channel::<B>::saturated(b)]
        }
    }

    fn levels(color: Color) -> [u8; 3] {
        let [r, g, b] = color.limited();
        [Channel::<R>::level(r), Channel::<G>::level(g), Channel::<B>::level(b)]
    }
}

impl Ink for Rgb888 {
    type Paint<'m> = Rgb<8, 8, 8>;

    fn paint(material: &Material) -> Self::Paint<'_> {
        Rgb::new(material)
    }

    fn plain(color: Color) -> Self {
        let [r, g, b] = Rgb::<8, 8, 8>::levels(color);
        Self::new(r, g, b)
    }
}

impl Paint<Rgb888> for Rgb<8, 8, 8> {
    #[inline]
    fn mix(&self, intensity: Intensity) -> Rgb888 {
        let [r, g, b] = self.levels_of(intensity);
        Rgb888::new(r as u8, g as u8, b as u8)
    }
}

/// A pixel that is yet to be blended with another one.
impl Ink for Color {
    type Paint<'m> = Rgb<15, 15, 15>;

    fn paint(material: &Material) -> Self::Paint<'_> {
        Rgb::new(material)
    }

    fn plain(color: Color) -> Self {
        color
    }
}

impl Paint<Color> for Rgb<15, 15, 15> {
    #[inline]
    fn mix(&self, intensity: Intensity) -> Color {
        // One is 2¹⁵, the largest level one less.
        Color(self.levels_of(intensity).map(|level| (level + (level >> 14)) as u16))
    }
}

/// The bits above red, green and blue in a sum of light, see [`Material::SPREAD`].
const ABOVE: u32 = 1 << 31 | 1 << 20 | 1 << 9;
/// Their levels, without the four bits below.
const LEVELS: u32 = 0x7e0 << 16 | 0xf81f;

/// The least specular light that Rgb565 shows: a step of its tables, Q14.
pub(crate) const LEAST: u32 = 1 << 7;

/// Rgb565 for that much light.
#[inline(always)]
fn rgb565(material: &Material, intensity: Intensity) -> u16 {
    // Both are below 2.
    if intensity.specular < LEAST {
        return at(&material.ramp, intensity.diffuse);
    }
    let mut sum = at(&material.dull, intensity.diffuse).wrapping_add(at(&material.gloss, intensity.specular));
    // All bits below the one above a channel, where that one is set.
    let above = sum & ABOVE;
    sum |= above - (above >> 9);
    let levels = sum >> 4 & LEVELS;
    (levels | levels >> 16) as u16
}

/// A table's entry for an intensity below 2.
#[inline(always)]
fn at<T: Copy + Default>(table: &[T; 256], intensity: u32) -> T {
    table.get(usize::from((intensity >> 7) as u8)).copied().unwrap_or_default()
}

/// Light in steps of 1/128: below what the format resolves.
impl Ink for Rgb565 {
    type Paint<'m> = &'m Material;

    fn paint(material: &Material) -> &Material {
        material
    }

    fn plain(color: Color) -> Self {
        let [r, g, b] = Rgb::<5, 6, 5>::levels(color);
        Self::new(r, g, b)
    }
}

impl Paint<Rgb565> for &Material {
    #[inline(always)]
    fn least(&self) -> u32 {
        LEAST
    }

    #[inline(always)]
    fn mix(&self, intensity: Intensity) -> Rgb565 {
        Rgb565::from(RawU16::new(rgb565(self, intensity)))
    }

    #[inline(always)]
    fn dull(&self, diffuse: u32) -> Rgb565 {
        Rgb565::from(RawU16::new(at(&self.ramp, diffuse)))
    }
}

/// Rgb565 with the high byte first, as SPI panels take it: [`as_flattened`](slice::as_flattened) makes bytes of a row.
impl Ink for [u8; 2] {
    type Paint<'m> = &'m Material;

    fn paint(material: &Material) -> &Material {
        material
    }

    fn plain(color: Color) -> Self {
        Rgb565::plain(color).into_storage().to_be_bytes()
    }
}

impl Paint<[u8; 2]> for &Material {
    #[inline(always)]
    fn least(&self) -> u32 {
        LEAST
    }

    #[inline(always)]
    fn mix(&self, intensity: Intensity) -> [u8; 2] {
        rgb565(self, intensity).to_be_bytes()
    }

    #[inline(always)]
    fn dull(&self, diffuse: u32) -> [u8; 2] {
        at(&self.ramp, diffuse).to_be_bytes()
    }
}

/// Rgb565 as a number: for ports that send words of 16 bits, the highest bit first, and for what shifts bits out by itself.
impl Ink for u16 {
    type Paint<'m> = &'m Material;

    fn paint(material: &Material) -> &Material {
        material
    }

    fn plain(color: Color) -> Self {
        Rgb565::plain(color).into_storage()
    }
}

impl Paint<u16> for &Material {
    #[inline(always)]
    fn mix(&self, intensity: Intensity) -> u16 {
        rgb565(self, intensity)
    }

    #[inline(always)]
    fn dull(&self, diffuse: u32) -> u16 {
        at(&self.ramp, diffuse)
    }
}

/// A material in grey: the [luma](Color::luma) of its colours.
#[derive(Clone, Copy, Debug)]
pub struct Gray<const BITS: u32>(Channel<BITS>);

impl<const BITS: u32> Gray<BITS> {
    fn new(material: &Material) -> Self {
        Self(Channel::new(material, material.base.luma(), material.highlight.luma()))
    }
}

impl Ink for Gray8 {
    type Paint<'m> = Gray<8>;

    fn paint(material: &Material) -> Self::Paint<'_> {
        Gray::new(material)
    }

    fn plain(color: Color) -> Self {
        Self::new(Channel::<8>::level(color.luma().min(1 << 15)))
    }
}

impl Paint<Gray8> for Gray<8> {
    #[inline]
    fn mix(&self, intensity: Intensity) -> Gray8 {
        Gray8::new(self.0.level_of(intensity))
    }
}

impl Ink for Gray4 {
    type Paint<'m> = Gray<4>;

    fn paint(material: &Material) -> Self::Paint<'_> {
        Gray::new(material)
    }

    fn plain(color: Color) -> Self {
        Self::new(Channel::<4>::level(color.luma().min(1 << 15)))
    }
}

impl Paint<Gray4> for Gray<4> {
    #[inline]
    fn mix(&self, intensity: Intensity) -> Gray4 {
        Gray4::new(self.0.level_of(intensity))
    }
}
