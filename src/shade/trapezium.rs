//! A part of the screen between two edges, lit by angles.

use core::array::from_fn;

use embedded_graphics::geometry::Point;

use super::angular::{Arc, Registers};
use crate::{
    math::{
        angle::Turn,
        arc::{arc_cosine, arc_tangent},
        interpolant::Slope,
        product::{mul_high, scale, square},
        reciprocal::Reciprocal,
        root::{square_root, ReciprocalRoot},
        screen::{center, first_at},
    },
    model::light::{Blank, LightSource, PerProduct},
};

/// Lines between a left and a right edge, along which normals turn: the primitive of *Faster Phong Shading*, §3.3.
///
/// At a line's left and right end the normals lie on two arcs of the unit sphere; λ and ρ are their angles from a place where the
/// circles of both meet, S is the angle in which they do. A line takes from that
///
/// - Δθ, the angle between its ends' normals, by Eq. 8a: `1 − cos Δθ = 1 − cos(λ − ρ) + sin λ sin ρ (1 − cos S)`;
/// - cos φ and cos ψ, the products at its ends, by Eq. 8b and 8c;
/// - `cos γ sin α = (cos ψ − cos φ cos Δθ)/sin Δθ`; with `cos γ cos α = cos φ` (Eq. 7) that is a vector of length cos γ (Eq. 6) at the
///   angle α. So α has its sign by itself, where the printed rule for it fails, and cos γ = 0 needs no care.
///
/// Where Δθ is below 0.02°, the light at the left end stands for all of the line. Where rounding would make cos γ more than one, it
/// is one, and α goes with the light at the left end.
///
/// 5 cosines, an arc cosine and a reciprocal root for a line, an arc tangent and a root for each product. 40 + 12 · LIGHTS bytes for
/// light from far, 20 + 52 · LIGHTS in the scene.
///
/// Beside Eq. 5 in f64 on quadrilaterals with four normals about half a radian apart: diffuse at most 4.8 levels of 255 (RMS 0.03),
/// specular 2.4 (RMS 0.22); whatever the normals 6.6 and 6.1 (RMS 0.27). The largest are where Δθ is small: then the light at both
/// ends is right, but not α, so that the line lies elsewhere on parabolas that are themselves up to 6 levels beside the cosine.
/// Beside exact powers of cosines it is at most 6.9.
#[derive(Clone, Copy, Debug)]
pub struct Trapezium<const LIGHTS: usize, L: LightSource> {
    /// Its first line.
    pub(super) line: i16,
    /// Left and right edge there, 2⁻¹⁶ pixel.
    pub(super) edges: [Slope; 2],
    /// How normals turn; where l or h differ from place to place, for each of them (§3.5).
    pub(super) bends: L::PerProduct<Bend, LIGHTS>,
    pub(super) products: [[Products; 2]; LIGHTS],
}

/// How the normals at a line's ends run, and the angle between their arcs.
#[derive(Clone, Copy, Debug)]
pub struct Bend {
    /// λ and ρ on the first line, and what they grow by to the next one; in 2⁻³² of a circle.
    pub(super) ends: [Slope; 2],
    /// 1 − cos S, Q30.
    pub(super) versine: u32,
}

/// Products with a fixed vector, Q14.
#[derive(Clone, Copy, Debug)]
pub struct Products {
    /// cos η: of the place where the arcs meet.
    pub(super) meeting: i16,
    /// sin η · cos S1 and sin η · cos S2: of the directions from there along the left and the right arc.
    pub(super) along: [i16; 2],
}

impl Blank for Bend {
    const BLANK: Self = Self { ends: [Slope { value: 0, step: 0 }; 2], versine: 0 };
}

impl Products {
    const ZERO: Self = Self { meeting: 0, along: [0; 2] };
}

/// One, Q30.
const ONE: u32 = 1 << 30;
/// The least 1 − cos Δθ that counts, Q30: 0.02°. Normals that are nearer to each other count as one.
const LEAST: u32 = 64;

/// 1 − cos of an angle, Q30 and less than two, from its cosine.
pub(super) fn versine(cosine: i32) -> u32 {
    ONE.wrapping_sub(cosine as u32).min(2 * ONE - 1)
}

/// The reciprocal of an angle's sine, `short · 2^(up − 16)`; 0 for angles of nothing or half a circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct InverseSine {
    short: u32,
    up: i32,
}

impl InverseSine {
    /// Of nothing.
    pub(super) const NONE: Self = Self { short: 0, up: 0 };

    /// Of the angle that has so much less than one for a cosine, Q30, at most two.
    pub(super) fn of(versine: u32) -> Self {
        let nearest = versine.min((2 * ONE).wrapping_sub(versine));
        if nearest < LEAST {
            return Self::NONE;
        }
        // sin² = (1 − cos)(1 + cos).
        let inverse = ReciprocalRoot::of(2 * nearest - square(nearest));
        Self { short: inverse.mantissa >> 15, up: inverse.half_zeros }
    }

    /// The quotient of a Q30 number and the sine, at most one to either side.
    pub(super) fn times(&self, value: i32) -> i32 {
        let most = (ONE >> self.up) as i32;
        mul_high(value, self.short).clamp(-most, most) << self.up
    }
}

impl<const LIGHTS: usize, L: LightSource> Trapezium<LIGHTS, L> {
    /// One without a line.
    pub(super) const EMPTY: Self = Self {
        line: i16::MAX,
        edges: [Slope { value: 0, step: 0 }; 2],
        bends: <L::PerProduct<Bend, LIGHTS>>::BLANK,
        products: [[Products::ZERO; 2]; LIGHTS],
    };

    /// The registers at pixel x of line y; without those of highlights where none show.
    fn start(&self, x: i32, y: i32, shiny: bool) -> Registers<LIGHTS> {
        let down = y - i32::from(self.line);
        let [left, right] = self.edges.map(|edge| on_line(edge, down));
        // The first pixel of the line that is on the screen.
        let first = (left.wrapping_add((1 << 15) - 1) >> 16).max(0);
        let width = right.wrapping_sub(left).max(1);
        let before = (first << 16).wrapping_add(1 << 15).wrapping_sub(left).clamp(0, width);
        let span = Part::of(before as u32, width as u32);
        let turn = |bend: &Bend| bend.on_line(down, &span);
        let common = if L::IN_SCENE { None } else { self.bends.of(0, 0).map(turn) };
        let arcs = from_fn(|light| {
            from_fn(|product| {
                let products = self.products.get(light).and_then(|pair| pair.get(product));
                let line = common.or_else(|| self.bends.of(light, product).map(turn));
                match (products, line) {
                    (Some(products), Some(line)) if shiny || product == 0 => line.arc(products),
                    _ => Arc::DARK,
                }
            })
        });
        Registers { at: x - first, arcs }
    }
}

/// A linear value so many lines on.
#[inline(always)]
fn on_line(slope: Slope, lines: i32) -> i32 {
    slope.value.wrapping_add(slope.step.wrapping_mul(lines))
}

/// Normals along a line: from the left end's to the right end's.
#[derive(Clone, Copy)]
struct Line {
    /// Cosine and sine of λ and ρ, Q16.
    ends: [[i32; 2]; 2],
    /// cos Δθ, Q30.
    cosine: i32,
    /// 1/sin Δθ.
    inverse: InverseSine,
    /// θ at the line's first pixel, and its increase for a pixel.
    angle: Slope,
}

impl Bend {
    /// The normals on the line that is `down` lines below the first.
    fn on_line(&self, down: i32, span: &Part) -> Line {
        let [lambda, rho] = self.ends.map(|end| on_line(end, down));
        let ends = [lambda, rho].map(|angle| {
            let angle = angle as u32;
            [angle, angle.wrapping_sub(1 << 30)].map(|angle| (Turn(angle).cosine() + (1 << 13)) >> 14)
        });
        let [[_, sin_lambda], [_, sin_rho]] = ends;
        // Eq. 8a, cos λ cos ρ + sin λ sin ρ cos S, as what it lacks of one: exact for small angles too.
        let sines = i64::from(sin_lambda) * i64::from(sin_rho);
        let apart = i64::from(ONE) - i64::from(Turn(lambda.wrapping_sub(rho) as u32).cosine());
        let versine = (apart + ((sines * i64::from(self.versine)) >> 32)).clamp(0, 2 << 30) as u32;
        let cosine = ONE.wrapping_sub(versine) as i32;
        let angle = if versine < LEAST { 0 } else { arc_cosine(cosine) };
        Line { ends, cosine, inverse: InverseSine::of(versine), angle: span.slope(angle, 16) }
    }
}

impl Line {
    /// Eq. 5 to 8: cos γ and α of a fixed vector.
    fn arc(&self, products: &Products) -> Arc {
        let [left, right] = products.along;
        let [l, r] = self.ends;
        // Q14 · Q16.
        let product = |[cos, sin]: [i32; 2], along: i16| {
            let sum = cos.wrapping_mul(products.meeting.into()).wrapping_add(sin.wrapping_mul(along.into()));
            sum.clamp(-(ONE as i32), ONE as i32)
        };
        let (phi, psi) = (product(l, left), product(r, right));
        // cos γ · sin α = (cos ψ − cos φ cos Δθ)/sin Δθ, beside cos γ · cos α = cos φ.
        let cosine = (self.cosine.unsigned_abs() + (1 << 13)) >> 14;
        let turned = mul_high(phi, cosine);
        let rest = psi.saturating_sub(if self.cosine < 0 { -turned } else { turned });
        let rise = self.inverse.times(rest);
        // Eq. 6 is the length of the two. Where rounding makes it more than one, that at the left end stays as it is.
        let square_phi = square(phi.unsigned_abs());
        let left = ONE.saturating_sub(square_phi);
        let square_rise = square(rise.unsigned_abs());
        let (rise, cosine) = if square_rise > left {
            let most = square_root(left) as i32;
            (if rise < 0 { -most } else { most }, ONE)
        } else {
            (rise, square_root(square_phi + square_rise))
        };
        let Slope { value, step } = self.angle;
        Arc { cosine: cosine as i32, angle: value.wrapping_sub(arc_tangent(rise, phi)), step }
    }
}

/// A part of a length.
#[derive(Clone, Copy)]
pub(super) struct Part {
    /// The part, Q16.
    part: u32,
    /// The reciprocal of the length.
    short: u32,
    zeros: i32,
}

impl Part {
    /// The part that `way` is of `length`.
    pub(super) fn of(way: u32, length: u32) -> Self {
        let inverse = Reciprocal::of(length);
        let short = inverse.short();
        // 16 bits for the longest way.
        let way = (way.min(length) << inverse.zeros) >> 16;
        Self { part: ((way * short) >> 15).min(1 << 16), short, zeros: inverse.zeros }
    }

    /// What grows evenly from 0 to `whole` over the length: its value at the end of the part, and its increase over 2^`unit` from
    /// there on, of no account if the length is less.
    pub(super) fn slope(&self, whole: i32, unit: i32) -> Slope {
        Slope { value: mul_high(whole, self.part), step: scale(mul_high(whole, self.short), (self.zeros + unit - 31).min(0)) }
    }
}

/// An edge on the screen, from the top to the bottom, and a line that it crosses.
#[derive(Clone, Copy)]
pub(super) struct Side {
    top: Point,
    width: i32,
    part: Part,
}

impl Side {
    /// The edge between two points, as it crosses line `line`.
    pub(super) fn new(top: Point, bottom: Point, line: i32) -> Self {
        let way = center(line) - top.y;
        Self { top, width: bottom.x - top.x, part: Part::of(way.max(0) as u32, (bottom.y - top.y).max(1) as u32) }
    }

    /// Where it is on the line, and on the next ones; 2⁻¹⁶ pixel.
    pub(super) fn edge(&self) -> Slope {
        let Slope { value, step } = self.part.slope(self.width << 8, 8);
        Slope { value: (self.top.x << 8).wrapping_add(value), step }
    }

    /// An angle that grows evenly from 0 to `whole` on the way down the edge.
    pub(super) fn turn(&self, whole: i32) -> Slope {
        self.part.slope(whole, 8)
    }
}

/// The first line below a height, which is in subpixels.
pub(super) fn first_line(height: i32) -> i16 {
    first_at(height) as i16
}

/// A facet made of trapezia, one below the other.
#[derive(Clone, Copy, Debug)]
pub struct Facet<const LIGHTS: usize, L: LightSource, const BANDS: usize = 2> {
    /// Whether a highlight can show on it.
    pub(super) shiny: bool,
    pub(super) bands: [Trapezium<LIGHTS, L>; BANDS],
}

impl<const LIGHTS: usize, L: LightSource, const BANDS: usize> Facet<LIGHTS, L, BANDS> {
    /// A facet without a line.
    pub(super) const EMPTY: Self = Self { shiny: false, bands: [Trapezium::EMPTY; BANDS] };

    /// The registers at pixel x of line y.
    #[must_use]
    pub fn start(&self, x: i32, y: i32) -> Registers<LIGHTS> {
        let below = self.bands.iter().rev().find(|band| y >= i32::from(band.line));
        match below.or(self.bands.first()) {
            Some(band) => band.start(x, y, self.shiny),
            None => Registers { at: x, arcs: [[Arc::DARK; 2]; LIGHTS] },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::light::{Light, SceneLight};

    #[test]
    fn sizes_are_as_documented() {
        let sizes = [size_of::<Facet<1, Light>>(), size_of::<Facet<4, Light>>(), size_of::<Facet<1, Light, 3>>()];
        assert_eq!(sizes, [84 + 24, 84 + 4 * 24, 4 + 3 * (40 + 12)]);
        let sizes = [size_of::<Facet<1, SceneLight>>(), size_of::<Facet<4, SceneLight>>()];
        assert_eq!(sizes, [44 + 104, 44 + 4 * 104]);
        assert_eq!([size_of::<Registers<1>>(), size_of::<Registers<4>>()], [4 + 24, 4 + 4 * 24]);
    }
}
