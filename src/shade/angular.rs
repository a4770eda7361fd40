//! What both methods by angles do along a line: *Faster Phong Shading*, Eq. 4 and 5.
//!
//! A normal that turns by equal angles has products `cos γ cos(θ − α)` with l and h, θ growing by Δθ/Δx a pixel. So Eq. 4's
//! parabolas in the angle are parabolas in the pixel: two additions and three registers for each product.
//!
//! Corrected of the appendix: `gamma` holds cos γ, so that its power is cosⁿ γ (`shader`); second differences have the factor
//! (Δθ/Δx)² cosⁿ γ, offsets are from each parabola's vertex and not rounded, the piece in the middle ends where it must, and the last
//! one where the power does (`yProc`, `eval`). Pieces begin at the ceiling of where parabolas meet (§3.4).

use core::marker::PhantomData;

use super::{Intensity, Paint, Surface};
use crate::{
    math::{piecewise::PiecewisePower, power::Power, product::mul_high, quadratic::Differences, reciprocal::Reciprocal},
    model::material::Material,
};

/// The parabolas that stand for the powers of cosines, Eq. 4 of *Faster Phong Shading*.
pub trait Fit: Copy + core::fmt::Debug {
    /// For the diffuse light, exponent 1.
    const DIFFUSE: PiecewisePower;

    /// For a material's highlight.
    #[must_use]
    fn specular(material: &Material) -> &PiecewisePower;
}

/// Parabolas fitted anew, [`PiecewisePower::refit`].
#[derive(Clone, Copy, Debug)]
pub struct Refit;

/// Parabolas with the coefficients that the report gives, [`PiecewisePower::printed`].
#[derive(Clone, Copy, Debug)]
pub struct Printed;

impl Fit for Refit {
    const DIFFUSE: PiecewisePower = PiecewisePower::refit(1);

    #[inline]
    fn specular(material: &Material) -> &PiecewisePower {
        let [refit, _] = &material.parabolas;
        refit
    }
}

impl Fit for Printed {
    const DIFFUSE: PiecewisePower = PiecewisePower::printed(1);

    #[inline]
    fn specular(material: &Material) -> &PiecewisePower {
        let [_, printed] = &material.parabolas;
        printed
    }
}

/// A product of an interpolated normal with a fixed vector along a line: `cos γ · cos(θ − α)`, Eq. 5a.
///
/// The normal turns by equal angles from pixel to pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Arc {
    /// cos γ, of the angle between the plane of the normals and the vector, times the vector's length; Q30, 0 to 1.
    pub cosine: i32,
    /// θ − α at the line's first pixel, in 2⁻³² of a circle: how far the normal has passed the place nearest to the vector.
    pub angle: i32,
    /// Δθ/Δx, its increase for a pixel to the right, from 0 to half a circle.
    pub step: i32,
}

impl Arc {
    /// Nothing.
    pub(super) const DARK: Self = Self { cosine: 0, angle: 0, step: 0 };

    /// The power of the cosine times `peak` (Q14), Q30, by one parabola: from pixel `at` on, counted from the line's first, for
    /// `count` pixels or however many of these it is good for.
    ///
    /// Forward differences start at the first pixel of a parabola's part of the line (§3.4), and go from there to pixel `at`: so
    /// the values do not depend on where on the line one begins.
    #[inline(never)]
    fn parabola(&self, power: &PiecewisePower, peak: u32, at: i32, count: i32) -> Piece {
        // How far the last pixel is from the first.
        let way = ((at + count - 1).max(0) as u32).wrapping_mul(self.step as u32);
        let (mut from, mut left) = (0, count);
        // The angle from which on there is another parabola.
        for knot in [1 - power.reach(), -power.knee(), power.knee() + 1, power.reach()] {
            if self.angle >= knot {
                continue;
            }
            let ahead = knot.wrapping_sub(self.angle) as u32;
            if way < ahead {
                break;
            }
            let crossing = self.crossing(ahead);
            if crossing > at {
                left = count.min(crossing - at);
                break;
            }
            from = crossing;
        }
        let angle = self.angle.wrapping_add(self.step.wrapping_mul(from));
        Piece { differences: power.along(angle, self.step, peak).after(at - from), left }
    }

    /// The number of the first pixel at so large an angle from the line's first one, or of the next where they nearly meet.
    fn crossing(&self, ahead: u32) -> i32 {
        let inverse = Reciprocal::of(self.step as u32);
        // ahead · 2^(zeros − 30) / step, and more rather than less: so that the angle is never short of a knot.
        let ratio = (mul_high((ahead >> 1) as i32, inverse.short() + 1) as u32).saturating_add(2);
        ((ratio >> (30 - inverse.zeros).max(0)) as i32).saturating_add(1)
    }
}

/// A parabola along a line, and the number of pixels that it is good for.
#[derive(Clone, Copy, Default)]
struct Piece {
    differences: Differences,
    left: i32,
}

/// What is started with on a line, 4 + 24 · LIGHTS bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Registers<const LIGHTS: usize> {
    /// The pixel, counted from the line's first one.
    pub at: i32,
    /// For each light the arcs of n·l (times its intensity) and n·h.
    pub arcs: [[Arc; 2]; LIGHTS],
}

/// Shades pixels by the parabolas `F`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Parabolas<F>(PhantomData<F>);

impl<F: Fit> Parabolas<F> {
    /// Shades the pixels from there on to the right.
    #[inline]
    pub(super) fn run<P, const LIGHTS: usize>(
        registers: Registers<LIGHTS>,
        surface: &Surface<'_, LIGHTS>,
        mut pixels: &mut [P],
        paint: &impl Paint<P>,
    ) {
        let mut at = registers.at;
        let mut pieces = [[Piece::default(); 2]; LIGHTS];
        while !pixels.is_empty() {
            let rest = pixels.len() as i32;
            let mut count = rest;
            let mut glossy = false;
            for (([diffuse, specular], [l, h]), strength) in pieces.iter_mut().zip(&registers.arcs).zip(surface.intensities) {
                if diffuse.left == 0 {
                    *diffuse = l.parabola(&F::DIFFUSE, (l.cosine as u32 + (1 << 15)) >> 16, at, rest);
                }
                if specular.left == 0 {
                    let peak = peak(&surface.material.power, h.cosine, *strength);
                    *specular = match peak {
                        0 => Piece { left: rest, ..Piece::default() },
                        _ => h.parabola(F::specular(surface.material), peak, at, rest),
                    };
                }
                count = count.min(diffuse.left).min(specular.left);
                glossy |= specular.differences != Differences::default();
            }
            let Some((piece, rest)) = pixels.split_at_mut_checked(count as usize) else { return };
            (pixels, at) = (rest, at + count);
            let mut terms = pieces.map(|pair| pair.map(|piece| piece.differences));
            if glossy {
                for pixel in piece {
                    let mut intensity = Intensity::default();
                    for [diffuse, specular] in &mut terms {
                        intensity.diffuse += diffuse.next().max(0) as u32 >> 16;
                        intensity.specular += specular.next().max(0) as u32 >> 16;
                    }
                    *pixel = paint.mix(intensity.limited(LIGHTS));
                }
            } else {
                for pixel in piece {
                    let mut intensity = Intensity::default();
                    for [diffuse, _] in &mut terms {
                        intensity.diffuse += diffuse.next().max(0) as u32 >> 16;
                    }
                    *pixel = paint.dull(intensity.limited(LIGHTS).diffuse);
                }
            }
            for (piece, differences) in pieces.as_flattened_mut().iter_mut().zip(terms.as_flattened()) {
                *piece = Piece { differences: *differences, left: piece.left - count };
            }
        }
    }
}

/// cosⁿ γ times the light's intensity, Q14.
#[inline]
fn peak(power: &Power, cosine: i32, strength: u16) -> u32 {
    (power.at((cosine as u32) << 1) * u32::from(strength) + (1 << 14)) >> 15
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers of all sizes, from a generator of the simplest kind.
    fn numbers() -> impl Iterator<Item = u32> {
        let mut state = 1_u64;
        core::iter::repeat_with(move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) as u32) >> ((state >> 20) & 31)
        })
    }

    #[test]
    fn a_crossing_is_never_before_its_knot_and_rarely_late() {
        let mut numbers = numbers();
        let (mut late, mut count) = (0, 0);
        for _ in 0..200_000 {
            let (Some(ahead), Some(step)) = (numbers.next(), numbers.next()) else { return };
            // Smaller steps do not leave a parabola on any line.
            if step < 256 || ahead == 0 || ahead / step > 4096 {
                continue;
            }
            let exact = ahead.div_ceil(step);
            let found = Arc { cosine: 0, angle: 0, step: step as i32 }.crossing(ahead) as u32;
            assert!(found == exact || found == exact + 1, "{ahead} / {step}: {found}");
            count += 1;
            late += u32::from(found > exact);
        }
        assert!(count > 50_000 && late < count / 50, "{late} of {count}");
    }

    #[test]
    fn parabolas_are_the_same_from_wherever_one_begins() {
        let power = PiecewisePower::refit(20);
        for (angle, step) in [(-700_000_000, 9_000_001), (-80_000_000, 300_000), (-1_900_000_000, 40_000_000), (3, 2_000_000_000)]
        {
            let arc = Arc { cosine: 1 << 30, angle, step };
            let values = |from: i32, to: i32| {
                let mut at = from;
                let mut values = [0; 200];
                while at < to {
                    let Piece { mut differences, left } = arc.parabola(&power, 1 << 14, at, to - at);
                    for value in values.iter_mut().skip(at as usize).take(left as usize) {
                        *value = differences.next();
                    }
                    at += left;
                }
                values
            };
            let whole = values(0, 200);
            for from in 0..200 {
                for (value, expected) in values(from, 200).iter().zip(&whole).skip(from as usize) {
                    assert_eq!(value, expected, "{angle} {step} {from}");
                }
            }
        }
    }
}
