//! Quadratics of the intensity, through six samples.

use super::{
    quadratic_dots::{cosine, stretch},
    Intensity, Paint, Shade, Surface,
};
use crate::{
    math::{
        gradient::Gradient,
        quadratic::{Differences, Quadratic},
    },
    model::light::LightSource,
    scan::triangle::Triangle,
};

/// Shading by one quadratic of the diffuse and one of the specular intensity, exact at the corners and in the middles of the edges.
///
/// Several lights are summed at the six samples, so a pixel costs the same for any number of them: two additions, a clamp at 0
/// and a look-up a term, nothing for a highlight that no sample sees. Continuous across shared edges.
///
/// The quadratic of *Faster Phong Shading*, Eq. 3, but of the illumination as a whole, with its power. Good where the highlight
/// is much larger than a facet; where it is not, it becomes flat, and negative around (clamped).
/// [`Hybrid`](super::hybrid::Hybrid) takes it only where it is good.
#[derive(Clone, Copy, Debug)]
pub struct QuadraticIntensity;

/// A facet, 52 bytes whatever the number of lights.
#[derive(Clone, Copy, Debug)]
pub struct Facet {
    /// Whether a sample is in a highlight.
    shiny: bool,
    /// Diffuse and specular, Q30 for one light, Q29 for more.
    intensity: [Quadratic; 2],
}

/// What is stepped along a line.
#[derive(Clone, Copy, Debug)]
pub struct Registers {
    pub(super) shiny: bool,
    pub(super) intensity: [Differences; 2],
}

impl Facet {
    /// No facet yet.
    pub(super) const EMPTY: Self = Self { shiny: false, intensity: [Quadratic::ZERO; 2] };

    /// The facet with those intensities, diffuse and specular.
    #[inline(always)]
    pub(super) fn new(diffuse: Quadratic, specular: Option<Quadratic>) -> Self {
        Self { shiny: specular.is_some(), intensity: [diffuse, specular.unwrap_or(Quadratic::ZERO)] }
    }

    /// The registers at that pixel.
    #[inline(always)]
    pub(super) fn start(&self, x: i32, y: i32) -> Registers {
        Registers { shiny: self.shiny, intensity: self.intensity.each_ref().map(|one| one.along(x, y)) }
    }
}

impl Registers {
    /// Shades pixels.
    #[inline(always)]
    pub(super) fn run<P, const LIGHTS: usize>(self, pixels: &mut [P], paint: &impl Paint<P>) {
        let [mut diffuse, mut specular] = self.intensity;
        // Six values from 0 to one keep a quadratic below 4/3 of that.
        let lit = |value: i32| (value & !(value >> 31)) as u32 >> finer(LIGHTS);
        if self.shiny {
            for pixel in pixels {
                let intensity = Intensity { diffuse: lit(diffuse.next()), specular: lit(specular.next()) };
                *pixel = paint.mix(intensity.limited(LIGHTS));
            }
        } else {
            for pixel in pixels {
                let intensity = Intensity { diffuse: lit(diffuse.next()), specular: 0 };
                *pixel = paint.dull(intensity.limited(LIGHTS).diffuse);
            }
        }
    }
}

/// Bits of an interpolated intensity below Q14: with one light it is below 2 whatever its bits, as pixels ask for.
pub(super) const fn finer(lights: usize) -> i32 {
    if lights > 1 {
        15
    } else {
        16
    }
}

/// An intensity over a triangle by six samples: at its corners, and by how much it is bowed along edges 01, 12, 20, four times what
/// it is in the middle above the mean of the corners; Q14.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bowed {
    pub(super) corners: [i32; 3],
    pub(super) bows: [i32; 3],
}

impl Bowed {
    /// Through samples at the corners and in the middles of the edges.
    #[inline(always)]
    pub(super) fn new<T>([[c0, c1, c2], [m01, m12, m20]]: [[T; 3]; 2], of: impl Fn(&T) -> i32) -> Self {
        let (v0, v1, v2) = (of(&c0), of(&c1), of(&c2));
        let bow = |middle: &T, sum: i32| 4 * of(middle) - 2 * sum;
        Self { corners: [v0, v1, v2], bows: [bow(&m01, v0 + v1), bow(&m12, v1 + v2), bow(&m20, v2 + v0)] }
    }

    /// Whether all six samples are 0.
    pub(super) fn is_zero(&self) -> bool {
        self.corners.iter().chain(&self.bows).fold(0, |all, value| all | value) == 0
    }

    /// Nine times its quadratic at the centroid.
    pub(super) fn nine_at_centroid(&self) -> i32 {
        3 * self.corners.iter().sum::<i32>() + self.bows.iter().sum::<i32>()
    }
}

/// For each light the cosines with l, times its intensity, and with h at one place, Q29.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cosines<const LIGHTS: usize>([[i32; 2]; LIGHTS]);

impl<const LIGHTS: usize> Cosines<LIGHTS> {
    /// From the products with a unit normal.
    #[inline(always)]
    pub(super) fn at_corner(dots: &[[i16; 2]; LIGHTS]) -> Self {
        Self(dots.map(|pair| pair.map(|product| i32::from(product) << 15)))
    }

    /// From the products with an interpolated normal N, and 1/|N| in Q15.
    #[inline(always)]
    pub(super) fn between(dots: &[[i16; 2]; LIGHTS], stretch: u32) -> Self {
        Self(dots.map(|pair| pair.map(|product| cosine(product, stretch))))
    }

    /// The diffuse intensity, Q14.
    ///
    /// That of a single light is negative where it does not reach: so the quadratic finds the border, by the pixels' clamp.
    #[inline(always)]
    pub(super) fn diffuse(&self) -> i32 {
        let mut sum = 0;
        for [diffuse, _] in self.0 {
            let diffuse = (diffuse + (1 << 14)) >> 15;
            sum += if LIGHTS > 1 { diffuse.max(0) } else { diffuse };
        }
        if LIGHTS > 1 {
            sum.min(Intensity::MOST as i32)
        } else {
            sum
        }
    }

    /// The specular intensity, Q14.
    #[inline(always)]
    pub(super) fn specular(&self, surface: &Surface<'_, LIGHTS>) -> i32 {
        let mut sum = 0;
        for ([_, specular], strength) in self.0.iter().zip(surface.intensities) {
            let power = surface.material.power.at((*specular).clamp(0, 1 << 29) as u32 * 4);
            sum += (power * u32::from(*strength)) >> 15;
        }
        sum.min(Intensity::MOST) as i32
    }
}

/// The cosines at the corners, and in the middles of the edges.
#[inline(always)]
pub(super) fn samples<const LIGHTS: usize, L: LightSource>(
    triangle: &Triangle<'_, LIGHTS, L>,
    middles: &[[[i16; 2]; LIGHTS]; 3],
) -> [[Cosines<LIGHTS>; 3]; 2] {
    let ([c0, c1, c2], [m01, m12, m20], [e01, e12, e20]) = (triangle.corners, middles, *triangle.edges);
    [
        [Cosines::at_corner(&c0.dots), Cosines::at_corner(&c1.dots), Cosines::at_corner(&c2.dots)],
        [Cosines::between(m01, stretch(e01)), Cosines::between(m12, stretch(e12)), Cosines::between(m20, stretch(e20))],
    ]
}

impl<const LIGHTS: usize, L: LightSource> Shade<LIGHTS, L> for QuadraticIntensity {
    type Facet = Facet;
    type Registers = Registers;
    const EMPTY: Facet = Facet::EMPTY;

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Facet {
        let gradient = Gradient::new(triangle.points());
        let quadratic = |bowed: &Bowed| Quadratic::bowed(gradient.as_ref(), bowed.corners, bowed.bows, finer(LIGHTS));
        let samples = samples(triangle, &triangle.middles());
        let diffuse = Bowed::new(samples, Cosines::diffuse);
        let specular = Bowed::new(samples, |cosines| cosines.specular(surface));
        Facet::new(quadratic(&diffuse), (!specular.is_zero()).then(|| quadratic(&specular)))
    }

    #[inline]
    fn start(facet: &Facet, x: i32, y: i32) -> Registers {
        facet.start(x, y)
    }

    /// Dull and shining pixels.
    fn kind(registers: &Registers, _: &Surface<'_, LIGHTS>, _: usize, _: u32) -> usize {
        registers.shiny.into()
    }

    #[inline]
    fn run<P>(registers: Registers, _: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        registers.run::<P, LIGHTS>(pixels, paint);
    }
}
