//! How a visible triangle gets its light: one file for each method, behind one trait.

use crate::{
    model::{
        light::{Light, LightSource},
        material::Material,
    },
    scan::{pair::Pair, triangle::Triangle},
};

pub mod angular;
pub mod angular_trapezia;
pub mod angular_triangle;
pub mod bishop_weimer;
pub mod choose;
pub mod duff_barycentric;
pub mod duff_differences;
pub mod duff_direct;
pub mod flat;
pub mod gouraud;
pub mod hybrid;
pub mod linear_angle;
pub mod phong;
pub mod phong_planes;
pub mod quadratic_dots;
pub mod quadratic_intensity;
pub mod trapezium;

/// Light that a surface sends to the eye, before its colours: ambient apart, diffuse and specular each summed over the lights
/// that reach it; Q14, and clamped just below 2 where several lights together are brighter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Intensity {
    /// Σ intensity · max(0, n·l).
    pub diffuse: u32,
    /// Σ intensity · max(0, n·h)ⁿ.
    pub specular: u32,
}

impl Intensity {
    /// The most that either holds.
    pub const MOST: u32 = (2 << 14) - 1;

    /// Clamped to the most, if more than one light was summed: one alone stays below.
    #[inline(always)]
    #[must_use]
    pub(crate) fn limited(self, lights: usize) -> Self {
        if lights > 1 {
            Self { diffuse: self.diffuse.min(Self::MOST), specular: self.specular.min(Self::MOST) }
        } else {
            self
        }
    }
}

/// What a triangle is shaded with: its material, and the intensities of the lights in Q15.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a, const LIGHTS: usize> {
    /// The material.
    pub material: &'a Material,
    /// For each light, Q15.
    pub intensities: &'a [u16; LIGHTS],
}

/// A material, ready to be turned into one kind of pixel.
pub trait Paint<P> {
    /// The pixel for that much light.
    fn mix(&self, intensity: Intensity) -> P;

    /// Less specular light than this, Q14, changes no pixel.
    #[inline(always)]
    fn least(&self) -> u32 {
        1
    }

    /// The pixel for diffuse light alone, Q14.
    #[inline(always)]
    fn dull(&self, diffuse: u32) -> P {
        self.mix(Intensity { diffuse, specular: 0 })
    }
}

/// A shading method.
///
/// A facet is set up once, when its triangle is first seen. Starting anywhere gives the very registers that stepping there
/// would give (modulo 2³²), so that lines and pixels may be skipped at no cost.
pub trait Shade<const LIGHTS: usize, L: LightSource = Light> {
    /// What shading needs of a visible triangle.
    type Facet: Copy + core::fmt::Debug;
    /// What it steps from pixel to pixel.
    type Registers: Copy + core::fmt::Debug;
    /// Whether it asks for a triangle's [rung](Triangle::rung).
    const BY_RUNG: bool = false;
    /// Whether there may be one facet for a [pair](Self::pair).
    const BY_PAIR: bool = false;
    /// A facet of nothing, to fill memory with.
    const EMPTY: Self::Facet;

    /// Sets up a triangle.
    fn facet(triangle: &Triangle<'_, LIGHTS, L>, surface: &Surface<'_, LIGHTS>) -> Self::Facet;

    /// Sets up one facet for two triangles that share an edge, if that is as good as one for each; whether it is, else the facet may be
    /// anything. Asked once, when either is first seen. They then make one span where they meet.
    #[inline]
    fn pair(_pair: &Pair<'_, LIGHTS>, _surface: &Surface<'_, LIGHTS>, _facet: &mut Self::Facet) -> bool {
        false
    }

    /// The registers at pixel x of line y.
    fn start(facet: &Self::Facet, x: i32, y: i32) -> Self::Registers;

    /// Of up to four kinds of pixels that the method knows, from 0 on, that of so many pixels from there on; kinds differ in what a
    /// pixel takes. Less specular light than `least`, Q14, is taken to change no pixel.
    #[inline]
    fn kind(_registers: &Self::Registers, _surface: &Surface<'_, LIGHTS>, _pixels: usize, _least: u32) -> usize {
        0
    }

    /// The rung of a [ladder](crate::ladder) that these registers stand on.
    #[inline]
    fn rung(_registers: &Self::Registers) -> usize {
        0
    }

    /// Shades the pixels from there on to the right.
    fn run<P>(registers: Self::Registers, surface: &Surface<'_, LIGHTS>, pixels: &mut [P], paint: &impl Paint<P>);
}

/// Whether a highlight can show: in the 16 bits that the kind of a facet leaves of a word, so that facets are moved by words.
#[derive(Clone, Copy, Debug)]
struct Shiny(u16);

impl Shiny {
    const NOT: Self = Self(0);

    #[inline(always)]
    const fn is(self) -> bool {
        self.0 != 0
    }
}

impl From<bool> for Shiny {
    #[inline(always)]
    fn from(is: bool) -> Self {
        Self(is.into())
    }
}

/// A product with so many bits more than Q14, clamped at 0, as Q16.
#[inline(always)]
const fn lit(product: i32, finer: i32) -> u32 {
    ((product & !(product >> 31)) >> (finer - 2)) as u32
}
