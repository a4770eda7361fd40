//! From light to pixels.

use embedded_graphics::pixelcolor::{raw::RawU16, Gray4, Gray8, IntoStorage, Rgb565, Rgb888};

use crate::{
    model::material::{Color, Material},
    shade::Intensity,
};

/// A pixel that light can be turned into. Each channel is rounded to the nearest level once, after all sums, and saturates.
pub trait Ink: Copy {
    /// A material's colours, made ready for this kind of pixel.
    type Paint: Copy;

    /// Makes a material ready.
    fn paint(material: &Material) -> Self::Paint;

    /// The pixel for that much light.
    fn mix(paint: &Self::Paint, intensity: Intensity) -> Self;

    /// The pixel of a colour as it is.
    fn plain(color: Color) -> Self;
}

/// One channel of a material with `BITS` bits: `(ambient + diffuse · d + specular · s)`, one being the largest level.
#[derive(Clone, Copy, Debug)]
struct Channel<const BITS: u32> {
    /// With half a level for rounding; Q29 of the largest level.
    ambient: u32,
    /// Q15 of the largest level, both.
    diffuse: u32,
    specular: u32,
}

impl<const BITS: u32> Channel<BITS> {
    const LARGEST: u32 = (1 << BITS) - 1;
    /// Q15 coefficients times Q14 intensities are Q29; levels are scaled so that the largest is `LARGEST · 2^SHIFT`.
    const SHIFT: u32 = 29 - BITS;

    fn new(material: &Material, base: u16, highlight: u16) -> Self {
        let times = |coefficient: u16, factor: u16| (u32::from(coefficient) * u32::from(factor) + (1 << 14)) >> 15;
        // From "one is 2ᵏ" to "one is LARGEST/2^BITS · 2ᵏ".
        let level = |q15: u32| q15 - (q15 >> BITS);
        let ambient = times(material.ambient, base);
        Self {
            ambient: (ambient << 14) - ((ambient << 14) >> BITS) + (1 << (Self::SHIFT - 1)),
            diffuse: level(times(material.diffuse, base)),
            specular: level(times(material.specular, highlight)),
        }
    }

    #[inline(always)]
    fn mix(&self, intensity: Intensity) -> u8 {
        // Two products below 2³⁰ and an ambient of at most 2²⁹ and a half level.
        let sum = self.ambient + self.diffuse * intensity.diffuse + self.specular * intensity.specular;
        (sum >> Self::SHIFT).min(Self::LARGEST) as u8
    }

    /// The level of a Q15 factor.
    fn level(factor: u16) -> u8 {
        ((u32::from(factor) * Self::LARGEST + (1 << 14)) >> 15).min(Self::LARGEST) as u8
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
    fn mix(&self, intensity: Intensity) -> [u8; 3] {
        [self.0.mix(intensity), self.1.mix(intensity), self.2.mix(intensity)]
    }

    fn levels(color: Color) -> [u8; 3] {
        let [r, g, b] = color.0;
        [Channel::<R>::level(r), Channel::<G>::level(g), Channel::<B>::level(b)]
    }
}

impl Ink for Rgb888 {
    type Paint = Rgb<8, 8, 8>;

    fn paint(material: &Material) -> Self::Paint {
        Rgb::new(material)
    }

    #[inline]
    fn mix(paint: &Self::Paint, intensity: Intensity) -> Self {
        let [r, g, b] = paint.mix(intensity);
        Self::new(r, g, b)
    }

    fn plain(color: Color) -> Self {
        let [r, g, b] = Rgb::<8, 8, 8>::levels(color);
        Self::new(r, g, b)
    }
}

impl Ink for Rgb565 {
    type Paint = Rgb<5, 6, 5>;

    fn paint(material: &Material) -> Self::Paint {
        Rgb::new(material)
    }

    #[inline]
    fn mix(paint: &Self::Paint, intensity: Intensity) -> Self {
        let [r, g, b] = paint.mix(intensity).map(u16::from);
        Self::from(RawU16::new(r << 11 | g << 5 | b))
    }

    fn plain(color: Color) -> Self {
        let [r, g, b] = Rgb::<5, 6, 5>::levels(color);
        Self::new(r, g, b)
    }
}

/// Rgb565 with the high byte first, as SPI panels take it: [`as_flattened`](slice::as_flattened) makes bytes of a row.
impl Ink for [u8; 2] {
    type Paint = Rgb<5, 6, 5>;

    fn paint(material: &Material) -> Self::Paint {
        Rgb::new(material)
    }

    #[inline]
    fn mix(paint: &Self::Paint, intensity: Intensity) -> Self {
        <Rgb565 as Ink>::mix(paint, intensity).into_storage().to_be_bytes()
    }

    fn plain(color: Color) -> Self {
        Rgb565::plain(color).into_storage().to_be_bytes()
    }
}

/// A material in grey: the luma of its colours, (77 R + 150 G + 29 B) / 256.
#[derive(Clone, Copy, Debug)]
pub struct Gray<const BITS: u32>(Channel<BITS>);

impl<const BITS: u32> Gray<BITS> {
    fn new(material: &Material) -> Self {
        Self(Channel::new(material, luma(material.base), luma(material.highlight)))
    }
}

fn luma(color: Color) -> u16 {
    let [r, g, b] = color.0.map(u32::from);
    ((77 * r + 150 * g + 29 * b + 128) >> 8) as u16
}

impl Ink for Gray8 {
    type Paint = Gray<8>;

    fn paint(material: &Material) -> Self::Paint {
        Gray::new(material)
    }

    #[inline]
    fn mix(paint: &Self::Paint, intensity: Intensity) -> Self {
        Self::new(paint.0.mix(intensity))
    }

    fn plain(color: Color) -> Self {
        Self::new(Channel::<8>::level(luma(color)))
    }
}

impl Ink for Gray4 {
    type Paint = Gray<4>;

    fn paint(material: &Material) -> Self::Paint {
        Gray::new(material)
    }

    #[inline]
    fn mix(paint: &Self::Paint, intensity: Intensity) -> Self {
        Self::new(paint.0.mix(intensity))
    }

    fn plain(color: Color) -> Self {
        Self::new(Channel::<4>::level(luma(color)))
    }
}
