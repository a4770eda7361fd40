//! What a surface looks like: colours, reflection coefficients, exponent.

use embedded_graphics::pixelcolor::{Rgb888, RgbColor};

use crate::math::{angle::Turn, piecewise::PiecewisePower, power::Power};

/// A colour as three linear factors in Q15: 0 is none, 32768 is all.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Color(pub [u16; 3]);

impl Color {
    /// No light at all.
    pub const BLACK: Self = Self([0; 3]);
    /// All of the light.
    pub const WHITE: Self = Self([1 << 15; 3]);

    /// Red, green and blue from 0.0 to 1.0; what lies outside is clamped, NaN is 0.
    #[must_use]
    pub const fn rgb(red: f32, green: f32, blue: f32) -> Self {
        Self([factor(red), factor(green), factor(blue)])
    }

    /// A colour between this one and another, 256 for the other.
    #[must_use]
    pub(crate) fn mixed(mut self, Color(other): Self, share: i32) -> Self {
        for (channel, other) in self.0.iter_mut().zip(other) {
            let own = i32::from(*channel);
            *channel = (own + (((i32::from(other) - own) * share + 128) >> 8)) as u16;
        }
        self
    }

    /// Its factors, none of them above one.
    #[inline]
    pub(crate) fn limited(self) -> [u16; 3] {
        let Self(factors @ [r, g, b]) = self;
        // Rarely is one of them all of the light, and another one not, or one even more.
        if r | g | b > 1 << 15 {
            factors.map(|factor| factor.min(1 << 15))
        } else {
            factors
        }
    }

    /// How bright it is, (77 R + 150 G + 29 B) / 256, Q15.
    #[must_use]
    pub const fn luma(self) -> u16 {
        let [r, g, b] = self.0;
        ((77 * r as u32 + 150 * g as u32 + 29 * b as u32 + 128) >> 8) as u16
    }
}

impl From<Rgb888> for Color {
    fn from(color: Rgb888) -> Self {
        let widen = |level: u8| ((u32::from(level) * 32768 + 127) / 255) as u16;
        Self([widen(color.r()), widen(color.g()), widen(color.b())])
    }
}

/// 0.0 … 1.0 to Q15, rounded, clamped.
const fn factor(value: f32) -> u16 {
    let scaled = (value * 32768.0 + 0.5) as u16;
    if scaled > 1 << 15 {
        1 << 15
    } else {
        scaled
    }
}

/// The opacity that hides all, Q8.
const OPAQUE: u16 = 1 << 8;

/// Q15 to Q8, rounded.
const fn q8(factor: u16) -> u16 {
    (factor + (1 << 6)) >> 7
}

/// The nearest level of `base · light`, base in Q15, light in Q23, one being `largest`.
const fn shade(base: u16, light: u64, largest: u64) -> u32 {
    ((base as u64 * light * largest + (1 << 37)) >> 38) as u32
}

/// Light on two colours, Q45, saturated; Q15.
const fn channel(dull: u64, base: u16, gloss: u64, highlight: u16) -> u16 {
    let sum = (((dull >> 15) * base as u64 + (gloss >> 15) * highlight as u64) + (1 << 29)) >> 30;
    if sum > 1 << 15 {
        1 << 15
    } else {
        sum as u16
    }
}

/// At most one, Q23.
const fn saturated(light: u64) -> u64 {
    if light > 1 << 23 {
        1 << 23
    } else {
        light
    }
}

/// Light on a colour, spread as [`Material::SPREAD`] says.
const fn spread(Color([red, green, blue]): Color, light: u64) -> u32 {
    let [r, g, b] = Material::SPREAD;
    shade(red, light, 31 << 4) << r | shade(green, light, 63 << 4) << g | shade(blue, light, 31 << 4) << b
}

/// Both kinds of parabolas for one exponent.
const fn parabolas(exponent: u16) -> [PiecewisePower; 2] {
    [PiecewisePower::refit(exponent), PiecewisePower::printed(exponent)]
}

/// A surface under Phong's illumination model (*Faster Phong Shading*, Eq. 1):
/// `ambient·base + diffuse·base·(n·l) + specular·highlight·(n·h)ⁿ`, both products clamped at 0, the sum saturating.
///
/// Built in a `const` or `static`, so that it lives in flash together with its tables, about 3.9 kB.
///
/// ```
/// use beamshade::{Color, Material};
///
/// static COPPER: Material = Material::new(Color::rgb(0.85, 0.45, 0.20)).specular(0.5).exponent(32);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
// In this order: a Cortex-M0+ reads what is short, and finds the ramp that most pixels are of, faster near the beginning.
#[repr(C)]
pub struct Material {
    pub(crate) base: Color,
    pub(crate) highlight: Color,
    /// Coefficients of reflection, Q15.
    pub(crate) ambient: u16,
    pub(crate) diffuse: u16,
    pub(crate) specular: u16,
    /// Q8: 256 hides all that is behind.
    pub(crate) opacity: u16,
    /// The share of diffuse light in what a light of one gives at most, by luma, Q15; specular light has the rest.
    pub(crate) share: u16,
    pub(crate) double_sided: bool,
    pub(crate) plain: bool,
    /// Its first and last number in a palette.
    pub(crate) colors: [u8; 2],
    /// Rgb565 of the ambient and diffuse light alone, in the middle of 256 equal steps of the diffuse intensity up to two.
    pub(crate) ramp: [u16; Self::STEPS],
    pub(crate) power: Power,
    /// The ramp with four bits more for each channel and half a level for rounding, see [`Material::SPREAD`].
    pub(crate) dull: [u32; Self::STEPS],
    /// The highlight in 256 equal steps of the specular intensity up to two, likewise.
    pub(crate) gloss: [u32; Self::STEPS],
    /// For 256 equal steps of what a light of one gives at most the place, 0 to 255, on the ramp of [`at_angle`](Self::at_angle)
    /// that is as bright.
    pub(crate) places: [u8; Self::STEPS],
    /// The power as parabolas, refit and as printed.
    pub(crate) parabolas: [PiecewisePower; 2],
}

impl Material {
    /// A surface of that colour with ambient 0.15, diffuse 0.75, specular 0.5, exponent 32, and a white highlight.
    #[must_use]
    pub const fn new(base: Color) -> Self {
        Self {
            base,
            highlight: Color::WHITE,
            ambient: factor(0.15),
            diffuse: factor(0.75),
            specular: factor(0.5),
            double_sided: false,
            plain: false,
            opacity: OPAQUE,
            power: Power::new(32),
            parabolas: parabolas(32),
            ramp: [0; Self::STEPS],
            dull: [0; Self::STEPS],
            gloss: [0; Self::STEPS],
            colors: Self::ALL_COLORS,
            share: 0,
            places: [0; Self::STEPS],
        }
        .ramped()
    }

    /// Steps of the ramp.
    const STEPS: usize = 256;

    /// Places of red, green and blue in a sum of light: each has its level of Rgb565, four bits below it, and one above. Shifted
    /// by those four, red and blue are where Rgb565 has them, and green is 16 bits above.
    pub(crate) const SPREAD: [u32; 3] = [11, 21, 0];

    /// The same with its ramps made anew.
    const fn ramped(mut self) -> Self {
        let mut step = 0;
        while step < Self::STEPS {
            // In the middle of a step of 1/128; the sum of two saturated ones has one bit more.
            let middle = 2 * step as u64 + 1;
            let light = saturated(self.ambient as u64 * 256 + self.diffuse as u64 * middle);
            let [red, green, blue] = self.base.0;
            #[expect(clippy::indexing_slicing, reason = "step < STEPS; slice::get is not const")]
            {
                self.ramp[step] = (shade(red, light, 31) << 11 | shade(green, light, 63) << 5 | shade(blue, light, 31)) as u16;
                self.dull[step] = spread(self.base, light) + (8 << 21 | 8 << 11 | 8);
                self.gloss[step] = spread(self.highlight, saturated(self.specular as u64 * middle));
            }
            step += 1;
        }
        self.placed()
    }

    /// All of a palette but colour 0, which is the background's.
    const ALL_COLORS: [u8; 2] = [1, u8::MAX];

    /// The same with its places on the ramp made anew.
    const fn placed(mut self) -> Self {
        let diffuse = self.diffuse as u32 * self.base.luma() as u32;
        let specular = self.specular as u32 * self.highlight.luma() as u32;
        // Of a surface that reflects nothing all places are alike.
        self.share = if diffuse == 0 { 0 } else { (((diffuse as u64) << 15) / (diffuse as u64 + specular as u64)) as u16 };
        let (mut step, mut place) = (0, 0);
        let (mut here, mut next) = (self.light(0), self.light(1));
        while step < Self::STEPS {
            // In the middle of a step; the nearer of two places.
            while place < u8::MAX && here + next < (2 * step as u64 + 1) << 22 {
                place += 1;
                here = next;
                next = self.light(place.saturating_add(1));
            }
            #[expect(clippy::indexing_slicing, reason = "step < STEPS; slice::get is not const")]
            {
                self.places[step] = place;
            }
            step += 1;
        }
        self
    }

    /// The light at a place of the ramp, as a part of the most; Q30.
    const fn light(&self, place: u8) -> u64 {
        let [diffuse, specular] = self.reflected(Self::ramp_angle(place as u32, u8::MAX as u32));
        (diffuse * self.share as u64 + specular * ((1 << 15) - self.share as u64)) >> 15
    }

    /// Of so many steps on a ramp from a right angle to 0 this one's angle.
    pub(crate) const fn ramp_angle(step: u32, steps: u32) -> Turn {
        match ((steps.saturating_sub(step) as u64) << 30).checked_div(steps as u64) {
            Some(angle) => Turn(angle as u32),
            None => Turn(0),
        }
    }

    /// cos x and cosⁿ x for an angle x up to a right angle, Q30.
    const fn reflected(&self, angle: Turn) -> [u64; 2] {
        let (_, cos) = angle.sin_cos();
        let cos = if cos < 0 { 0 } else { cos as u32 };
        [cos as u64, Power::exact(2 * cos, self.power.exponent()) as u64]
    }

    /// The colour where one angle x is that to the light and to the half vector, up to a right angle:
    /// `ambient·base + diffuse·base·cos x + specular·highlight·cosⁿ x`, saturated.
    ///
    /// *OTMPHONG.DOC*, "The Phong illumination model"; the ambient term there is called specular, too, by mistake.
    #[must_use]
    pub const fn at_angle(&self, angle: Turn) -> Color {
        let [diffuse, specular] = self.reflected(angle);
        // Q15 · Q30.
        let dull = ((self.ambient as u64) << 30) + self.diffuse as u64 * diffuse;
        let gloss = self.specular as u64 * specular;
        let ([br, bg, bb], [hr, hg, hb]) = (self.base.0, self.highlight.0);
        Color([channel(dull, br, gloss, hr), channel(dull, bg, gloss, hg), channel(dull, bb, gloss, hb)])
    }

    /// The same with colours of its own in a [`Palette`](crate::Palette), from the first number to the last. Without, it takes all
    /// but colour 0, which is the background's.
    #[must_use]
    pub const fn colors(mut self, first: u8, last: u8) -> Self {
        self.colors = [first, last];
        self
    }

    /// The same with another ambient coefficient, 0.0 to 1.0, clamped.
    #[must_use]
    pub const fn ambient(mut self, coefficient: f32) -> Self {
        self.ambient = factor(coefficient);
        self.ramped()
    }

    /// The same with another diffuse coefficient, 0.0 to 1.0, clamped.
    #[must_use]
    pub const fn diffuse(mut self, coefficient: f32) -> Self {
        self.diffuse = factor(coefficient);
        self.ramped()
    }

    /// The same with another specular coefficient, 0.0 to 1.0, clamped.
    #[must_use]
    pub const fn specular(mut self, coefficient: f32) -> Self {
        self.specular = factor(coefficient);
        self.ramped()
    }

    /// The same with another exponent ("gloss"), 1 to 256 being useful; 0 counts as 1.
    #[must_use]
    pub const fn exponent(mut self, exponent: u16) -> Self {
        self.power = Power::new(exponent);
        self.parabolas = parabolas(exponent);
        self.placed()
    }

    /// The same with another colour of the highlight.
    #[must_use]
    pub const fn highlight(mut self, color: Color) -> Self {
        self.highlight = color;
        self.ramped()
    }

    /// The same, seen from behind too: back faces are kept and lit by their turned normals.
    #[must_use]
    pub const fn double_sided(mut self) -> Self {
        self.double_sided = true;
        self
    }

    /// The same, content with the second of two shading methods; see [`ByMaterial`](crate::shade::choose::ByMaterial).
    #[must_use]
    pub const fn plain(mut self) -> Self {
        self.plain = true;
        self
    }

    /// The same with that opacity, 0.0 to 1.0, clamped and rounded to 1/256. Below one the surface is transparent: a pixel is
    /// `opacity · its shaded colour + (1 − opacity) · what is behind`, before it becomes ink. ("Transparent polygons are of course
    /// allowed", *Faster Phong Shading*, §3.6.)
    ///
    /// One level: of several transparent triangles before the nearest opaque one, or before the background, the nearest alone is
    /// seen. Only [`Lines::transparent_line`](crate::Lines::transparent_line) knows of it: in all other lines, be they smooth, baked,
    /// frozen or handed to a display, the surface is opaque.
    ///
    /// ```
    /// # use beamshade::{Color, Material};
    /// static GLASS: Material = Material::new(Color::rgb(0.6, 0.8, 1.0)).opacity(0.4);
    /// ```
    #[must_use]
    pub const fn opacity(mut self, opacity: f32) -> Self {
        self.opacity = q8(factor(opacity));
        self
    }

    /// Whether what is behind it is seen.
    #[inline]
    pub(crate) const fn is_transparent(&self) -> bool {
        self.opacity < OPAQUE
    }

    /// Number of 16-bit words of a material in a mesh's binary form.
    pub const WORDS: usize = 12;

    /// A material from the words of a mesh's binary form: base 3, highlight 3, ambient, diffuse, specular (all Q15),
    /// exponent, flags (bit 0: double-sided, bit 1: plain), 1 − [opacity](Self::opacity) in Q15. Factors above one are clamped.
    #[must_use]
    pub fn from_words(words: [u16; Self::WORDS]) -> Self {
        let [br, bg, bb, hr, hg, hb, ambient, diffuse, specular, exponent, flags, clearness] = words;
        let clamp = |factor: u16| factor.min(1 << 15);
        Self {
            base: Color([br, bg, bb].map(clamp)),
            highlight: Color([hr, hg, hb].map(clamp)),
            ambient: clamp(ambient),
            diffuse: clamp(diffuse),
            specular: clamp(specular),
            double_sided: flags & 1 == 1,
            plain: flags & 2 == 2,
            opacity: q8((1 << 15) - clamp(clearness)),
            power: Power::new(exponent),
            parabolas: parabolas(exponent),
            ramp: [0; Self::STEPS],
            dull: [0; Self::STEPS],
            gloss: [0; Self::STEPS],
            colors: Self::ALL_COLORS,
            share: 0,
            places: [0; Self::STEPS],
        }
        .ramped()
    }
}
