//! Angles at the corners, linear in between.

use core::{fmt::Debug, marker::PhantomData};

use super::{Intensity, Paint, Shade, Surface};
use crate::{
    math::{
        angle::Turn,
        arc::arc_cosine,
        gradient::Gradient,
        interpolant::{Interpolant, Plane, Slope, Steps},
        product::scale,
        reciprocal::Reciprocal,
    },
    model::light::LightSource,
    scan::triangle::Triangle,
};

/// The angle between normal and light, and that between normal and half vector, linear on the screen between the corners; the cosine and
/// its power looked up at each pixel.
///
/// *OTMPHONG.DOC*, "Linear interpolation of angles". A normal turns nearly evenly between two others, and its angle to the light changes
/// as evenly where all three lie in one plane. Where the light stands aside it does not; where the angles at the corners are equal, it
/// seems not to change at all, and a highlight inside such a facet is missed. So the document's "correct in 99% of all possible cases" does
/// not hold: worst of 60 frames of T880 at exponents 5, 20, 50, 125 it is 31.3, 30.2, 31.6, 33.6 dB from Phong shading, where
/// [`Gouraud`](super::gouraud::Gouraud) is 29.0, 29.5, 30.1, 30.9. (Its series for the cosine begins with x; it should be
/// `1 − x²/2! + x⁴/4! − …`.)
///
/// Good where facets are small or dull; on the large triangles of a coarse mesh it fails as Gouraud's does. With lights in the scene,
/// the angles at a corner are to that corner's own directions. Several lights are summed at each pixel.
///
/// The power goes by way of the cosine, through the material's own table. A table straight from the angle would save up to a twentieth of a
/// frame's cycles, and cost each material 2 kB more.
#[derive(Clone, Copy, Debug)]
pub struct LinearAngle<A = Fine>(PhantomData<A>);

/// How fine an angle is when its cosine is looked up.
///
/// It is stepped from pixel to pixel as a word, `(2 x + 2.5) · 2²⁴` for an angle of x degrees, the upper bits of which are its place in
/// the table. Corners that are turned away by more than 126° count as that; so no rounding leads out of a word, and nothing has to
/// be clamped at a pixel: that would cost more than the look-up does.
pub trait Angle: Copy + Debug {
    /// The cosine in Q15, 0 beyond a right angle.
    fn cosine(word: i32) -> u32;
}

/// Ten bits of an angle: steps of 1/8°, a table of 2 kB.
///
/// The cosine's error is at most 1.2·10⁻³, RMS 4.5·10⁻⁴.
#[derive(Clone, Copy, Debug)]
pub struct Fine;

impl Angle for Fine {
    #[inline(always)]
    fn cosine(word: i32) -> u32 {
        static TABLE: [u16; 1024] = table();
        TABLE.get((word as u32 >> 22) as usize).copied().unwrap_or(0).into()
    }
}

/// An angle in one byte, as in the document: steps of 1/2°, a table of 512 bytes.
///
/// It saves 1.5 kB and no time. On the accuracy scenes it costs at most 0.2 dB; where a highlight is sharp and facets are large, one
/// can see the steps.
///
/// The cosine's error is at most 4.4·10⁻³, RMS 1.8·10⁻³.
#[derive(Clone, Copy, Debug)]
pub struct Byte;

impl Angle for Byte {
    #[inline(always)]
    fn cosine(word: i32) -> u32 {
        static TABLE: [u16; 256] = table();
        TABLE.get((word as u32 >> 24) as usize).copied().unwrap_or(0).into()
    }
}

/// The word of an angle of 0.
const ZERO: i32 = 5 << 23;

/// The cosine in the middle of each step.
#[expect(clippy::indexing_slicing, reason = "evaluated by the compiler")]
const fn table<const STEPS: usize>() -> [u16; STEPS] {
    let mut table = [0; STEPS];
    let mut i = 0;
    while i < STEPS {
        let middle = (2 * i as i64 + 1) * (1 << 31) / STEPS as i64 - ZERO as i64;
        // From 2²⁵ for a degree.
        let (_, cos) = Turn(if middle < 0 { 0 } else { (middle * 16 / 45) as u32 }).sin_cos();
        table[i] = if cos < 0 { 0 } else { ((cos + (1 << 14)) >> 15) as u16 };
        i += 1;
    }
    table
}

/// The angle for a cosine in Q30, up to 126°; 128 for a degree.
fn angle(cos: i32) -> i32 {
    (((arc_cosine(cos) >> 16) * 45) >> 6).min(126 * 128)
}

/// An angle linear on the screen, from angles at the corners.
fn words(gradient: Option<&Gradient>, angles: [i32; 3]) -> Plane {
    let Plane { at, x, y } = Plane::through(gradient, angles, [0; 3]);
    const FINER: i32 = 25 - 7 - Plane::FINER;
    Plane { at: (at << FINER).wrapping_add(ZERO), x: x << FINER, y: y << FINER }
}

/// A facet, 4 + 24 · LIGHTS bytes.
#[derive(Clone, Copy, Debug)]
pub struct Facet<const LIGHTS: usize> {
    shiny: bool,
    planes: [[Plane; 2]; LIGHTS],
}

/// What is stepped along a line.
#[derive(Clone, Copy, Debug)]
pub struct Registers<const LIGHTS: usize> {
    shiny: bool,
    angles: [[Slope; 2]; LIGHTS],
}

impl<const LIGHTS: usize, L: LightSource, A: Angle> Shade<LIGHTS, L> for LinearAngle<A> {
    type Facet = Facet<LIGHTS>;
    type Registers = Registers<LIGHTS>;
    const EMPTY: Self::Facet = Facet { shiny: false, planes: [[Plane::ZERO; 2]; LIGHTS] };

    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet {
        let gradient = Gradient::new(triangle.points());
        let plane = |cosines: [i32; 3]| words(gradient.as_ref(), cosines.map(angle));
        let least = (surface.material.power.start() >> 17) as i16;
        let [c0, c1, c2] = &triangle.corners;
        let dots = || c0.dots.iter().zip(&c1.dots).zip(&c2.dots).zip(surface.intensities);
        let shiny = dots().any(|((([_, h0], [_, h1]), [_, h2]), _)| *h0.max(h1).max(h2) > least);
        let mut planes = [[Plane::ZERO; 2]; LIGHTS];
        for ([diffuse, specular], ((([l0, h0], [l1, h1]), [l2, h2]), strength)) in planes.iter_mut().zip(dots()) {
            let inverse = Reciprocal::of((*strength).into());
            let (short, up) = (inverse.short() as i32, inverse.zeros - 16);
            *diffuse = plane([*l0, *l1, *l2].map(|dot| scale(i32::from(dot) * short, up)));
            if shiny {
                *specular = plane([*h0, *h1, *h2].map(|dot| i32::from(dot) << 16));
            }
        }
        Facet { shiny, planes }
    }

    #[inline]
    fn start(facet: &Self::Facet, x: i32, y: i32) -> Self::Registers {
        let angles = facet.planes.each_ref().map(|pair| pair.each_ref().map(|plane| plane.along(x, y)));
        Registers { shiny: facet.shiny, angles }
    }

    #[inline]
    fn run<P>(r: Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>) {
        let power = &surface.material.power;
        let mut angles = r.angles;
        // An angle is least at one of the ends.
        let last = pixels.len() as i32 - 1;
        let shows = |word| (A::cosine(word) << 16) > power.start();
        if r.shiny
            && angles.iter().any(|[_, Slope { value, step }]| shows(*value) || shows(value.wrapping_add(step.wrapping_mul(last))))
        {
            for pixel in pixels {
                let mut intensity = Intensity::default();
                for ([diffuse, specular], strength) in angles.iter_mut().zip(surface.intensities) {
                    // Q15 · Q15, and Q14 · Q15.
                    intensity.diffuse += (A::cosine(diffuse.next()) * u32::from(*strength)) >> 16;
                    intensity.specular += (power.at(A::cosine(specular.next()) << 16) * u32::from(*strength)) >> 15;
                }
                *pixel = paint.mix(intensity.limited(LIGHTS));
            }
        } else {
            for pixel in pixels {
                let mut sum = Intensity::default();
                for ([diffuse, _], strength) in angles.iter_mut().zip(surface.intensities) {
                    sum.diffuse += (A::cosine(diffuse.next()) * u32::from(*strength)) >> 16;
                }
                *pixel = paint.dull(sum.limited(LIGHTS).diffuse);
            }
        }
    }
}
