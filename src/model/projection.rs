//! From a mesh's positions to the screen.

use embedded_graphics::geometry::{Point, Size};

use crate::math::{
    reciprocal::Reciprocal,
    rotation::Rotation,
    screen::{GUARD, SUBPIXELS},
    vector::{dot_64, norm, Vector},
    Length,
};

/// A point before the eye: right, down, forward; I12F20.
pub type Eye = [i32; 3];

/// A projected point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Projected {
    /// Place on the screen, in subpixels.
    pub point: Point,
    /// Nearness: 1/z with 23 bits at the near plane; never 0.
    pub nearness: u32,
}

/// How much of an object is in sight.
#[derive(Clone, Copy, Debug)]
pub enum Sight {
    /// Nothing.
    Hidden,
    /// Perhaps not all of it is beyond the near plane and inside the guard band.
    Partial,
    /// All of it is, so that its positions can go a shorter way.
    Whole(Short),
}

/// A row of a matrix and of a translation.
#[derive(Clone, Copy, Debug)]
struct Row {
    /// The row, cut in two so that 32-bit products do: Q14, and 14 bits more.
    high: [i32; 3],
    low: [i32; 3],
    translation: i32,
}

impl Row {
    /// From a row times a factor below one in 32 bits, Q28 once that many bits are dropped, and a translation.
    #[inline(never)]
    fn new(row: [i32; 3], factor: u32, drop: u32, translation: i32) -> Self {
        let row = row.map(|m| ((i64::from(m) * i64::from(factor)) >> 32) as i32 >> drop);
        Self { high: row.map(|m| m >> 14), low: row.map(|m| m & 0x3fff), translation }
    }

    /// Row and translation times the focal length and `2^zeros`, but for a power of two; none if the translation does not fit.
    #[inline(never)]
    fn times(&self, focal: u32, zeros: u32) -> Option<Self> {
        // 53 bits; I12F20 to the unit of the row.
        let translation = i64::from(self.translation) * i64::from(focal);
        let translation = if zeros < 20 { translation >> (20 - zeros) } else { translation << (zeros - 20).min(10) };
        let fits = translation.abs() <= 1 << 30;
        let ([a, b, c], [d, e, f]) = (self.high, self.low);
        let row = [(a, d), (b, e), (c, f)].map(|(high, low)| (high << 14) + low);
        fits.then(|| Self::new(row, focal << leading_zeros(focal), 0, translation as i32))
    }

    /// The position along this row, `drop` bits fewer than Q29.
    #[inline(always)]
    fn along(&self, [x, y, z]: [i32; 3], drop: u32) -> i32 {
        let ([a, b, c], [d, e, f]) = (self.high, self.low);
        // |row| ≤ 2¹⁴ and |position| ≤ √3·2¹⁵, so neither sum leaves 32 bits; rows that are none of a rotation wrap.
        let high = a.wrapping_mul(x).wrapping_add(b.wrapping_mul(y)).wrapping_add(c.wrapping_mul(z));
        let low = d * x + e * y + f * z;
        // The translation is at most 2³⁰.
        (high.wrapping_add(low >> 14) >> drop).wrapping_add(self.translation)
    }
}

/// `a · b / 2³⁰` by 32-bit products, at most 3 too small, wrapping; b ≤ 2³¹.
#[inline(always)]
const fn mul_30(a: i32, b: u32) -> i32 {
    let (a_high, a_low) = (a >> 15, (a & 0x7fff) as u32);
    let (b_high, b_low) = (b >> 15, b & 0x7fff);
    let outer = a_high.wrapping_mul(b_high as i32);
    outer.wrapping_add(a_high.wrapping_mul(b_low as i32) >> 15).wrapping_add((a_low.wrapping_mul(b_high) >> 15) as i32)
}

/// For the few numbers that have many: a library call where there is no instruction for it.
#[cold]
#[inline(never)]
const fn leading_zeros(number: u32) -> u32 {
    number.leading_zeros()
}

/// The way of the positions of an object that is wholly in sight: by 32-bit products, and to where a vertex holds them.
#[derive(Clone, Copy, Debug)]
pub struct Short {
    /// To right and down, times the focal length in subpixels, times `2^(zeros + depth)`.
    screen: [Row; 2],
    screen_drop: u32,
    /// Forward, I12F20.
    forward: Row,
    drop: u32,
    /// Leading zeros of the greatest z.
    zeros: u32,
    /// How many more the least z has.
    depth: u32,
    /// Bits to drop from the reciprocal for the nearness.
    nearness_drop: u32,
    /// Of the picture, rounding included; Q12 of subpixels.
    center: [i32; 2],
}

impl Short {
    /// The largest depth that leaves the reciprocal of z exact enough.
    const DEPTH: u32 = 6;

    /// The point on the screen, Q12 of subpixels but for the rounding, and the nearness.
    #[inline(always)]
    #[must_use]
    pub fn screen(&self, position: [i16; 3]) -> ([i32; 2], u32) {
        let position = position.map(i32::from);
        let z = (self.forward.along(position, self.drop) as u32).wrapping_shl(self.zeros);
        let nearer = match z >> 30 {
            0 => leading_zeros(z),
            1 => 1,
            _ => 0,
        };
        // 2^(62 − zeros − depth) / z.
        let inverse = Reciprocal::mantissa(z.wrapping_shl(nearer)).wrapping_shr(self.depth.wrapping_sub(nearer));
        let [x, y] = &self.screen;
        let along = |row: &Row| mul_30(row.along(position, self.screen_drop), inverse);
        let [cx, cy] = self.center;
        ([along(x).wrapping_add(cx), along(y).wrapping_add(cy)], inverse.wrapping_shr(self.nearness_drop))
    }
}

/// The way of one object's positions to the screen: one matrix, one translation, one perspective.
#[derive(Clone, Copy, Debug)]
pub struct Projection {
    /// To right, down and forward, I12F20.
    eye: [Row; 3],
    /// Bits to drop from the products, Q29, for I12F20.
    drop: u32,
    /// The scale has so many bits before the point.
    exponent: i32,
    /// I12F20.
    near: i32,
    /// Bits to drop from the mantissa of 1/z for 23 bits at the near plane, were there no leading zeros.
    nearness_drop: i32,
    /// In subpixels.
    focal: u32,
    center: Point,
}

impl Projection {
    /// From rotation, scale (world units for 1.0 of the mesh's positions, Q32), translation (I12F20), near plane, focal length in
    /// subpixels, and size of the picture.
    pub(super) fn new(rotation: Rotation, scale: i64, translation: [i32; 3], near: Length, focal: u32, size: Size) -> Self {
        // scale = mantissa · 2^(exponent − 32), the mantissa below one in 32 bits.
        let scale = (scale as u64).min((512 << 32) - 1);
        let zeros = scale.leading_zeros() as i32;
        let exponent = 32 - zeros;
        let mantissa = (if zeros <= 32 { scale >> (32 - zeros) } else { scale << (zeros - 32).min(31) }) as u32;
        let near = near.to_bits() << 4;
        let ([x, y, z], [tx, ty, tz]) = (rotation.0, translation);
        // From Q30.
        let row = |row: Vector, translation| Row::new(row.0, mantissa, 2, translation);
        Self {
            eye: [row(x, tx), row(y, ty), row(z, tz)],
            drop: (9 - exponent).clamp(0, 31) as u32,
            exponent,
            near,
            nearness_drop: 62 - (54 - near.leading_zeros() as i32),
            focal,
            center: Point::new(size.width as i32, size.height as i32) * (SUBPIXELS / 2),
        }
    }

    /// A position of the mesh as the eye sees it.
    #[inline(never)]
    #[must_use]
    pub fn eye(&self, position: [i16; 3]) -> Eye {
        let position = position.map(i32::from);
        self.eye.map(|row| row.along(position, self.drop))
    }

    /// The point on the screen; none before the near plane or outside the guard band.
    #[inline]
    #[must_use]
    pub fn screen(&self, [x, y, z]: Eye) -> Option<Projected> {
        if z < self.near {
            return None;
        }
        let inverse = Reciprocal::of(z as u32);
        let along = |d: i32| {
            let ratio = (i64::from(d) * i64::from(inverse.mantissa)) >> 24;
            let right = 38 - inverse.zeros;
            (ratio * i64::from(self.focal) + (1 << (right - 1))) >> right
        };
        let (x, y) = (along(x), along(y));
        if x.unsigned_abs() > GUARD as u64 || y.unsigned_abs() > GUARD as u64 {
            return None;
        }
        let nearness = inverse.mantissa >> (self.nearness_drop - inverse.zeros).clamp(0, 31);
        Some(Projected { point: self.center + Point::new(x as i32, y as i32), nearness: nearness.max(1) })
    }

    /// How much is in sight of a sphere around a position of the mesh, both Q15.
    #[must_use]
    pub fn sight(&self, center: [i16; 3], radius: u16) -> Sight {
        let [x, y, z] = self.eye(center);
        let (right, down) = (x.saturating_abs(), y.saturating_abs());
        // Each row is as long as the scale's mantissa, or shorter.
        let [.., Row { high, .. }] = self.eye;
        let mantissa = norm(high) + 3;
        let radius = (mantissa.wrapping_mul(radius.into()) >> self.drop).saturating_add(2).min(i32::MAX as u32) as i32;
        let (nearest, farthest) = (z.saturating_sub(radius), z.saturating_add(radius));
        if farthest < self.near {
            return Sight::Hidden;
        }
        let focal = self.focal as i32;
        // Whether, beside the plane through the eye that is `half` away from the axis at the focal length, the whole sphere is on one
        // side: 1 is outside, −1 inside.
        let is_wholly = |side: i32, away: i32, half: i32| {
            let slant = norm([focal, half, 0]) as i32 + 1;
            dot_64([away, half, radius], [side * focal, z.wrapping_mul(-side), -slant]) > 0
        };
        if is_wholly(1, right, self.center.x) || is_wholly(1, down, self.center.y) {
            return Sight::Hidden;
        }
        let is_inside = nearest >= self.near.max(1) && is_wholly(-1, right.max(down), GUARD - 8);
        if !is_inside || farthest == i32::MAX {
            return Sight::Partial;
        }
        self.short(nearest as u32, farthest as u32).map_or(Sight::Partial, Sight::Whole)
    }

    /// The short way for z in that range, if it is exact enough.
    fn short(&self, nearest: u32, farthest: u32) -> Option<Short> {
        let zeros = nearest.leading_zeros();
        let bits = 32 - self.focal.leading_zeros() as i32;
        // From Q29 times the scale.
        let screen_drop = u32::try_from(29 - self.exponent - bits - zeros as i32).ok().filter(|drop| *drop < 32)?;
        let nearness_drop = u32::try_from(self.nearness_drop - zeros as i32).ok().filter(|drop| *drop <= 24)?;
        let depth = u32::checked_sub(zeros, farthest.leading_zeros()).filter(|depth| *depth <= Short::DEPTH)?;
        let [right, down, forward] = &self.eye;
        Some(Short {
            screen: [right.times(self.focal, zeros)?, down.times(self.focal, zeros)?],
            screen_drop,
            forward: *forward,
            drop: self.drop,
            zeros: zeros - depth,
            depth,
            nearness_drop,
            center: [self.center.x, self.center.y].map(|c| (c << 12) + (1 << 11)),
        })
    }

    /// Distance of a point from a plane that bounds what can be projected, in a unit of the plane's own: the near plane first,
    /// then left, right, top and bottom of the guard band; at least 0 inside.
    #[must_use]
    pub fn inside(&self, point: Eye, plane: usize) -> i64 {
        // A little less than the guard band, so that rounding does not put a cut back outside.
        let (focal, guard) = (self.focal as i32, GUARD - 8);
        let (towards, near) = match plane {
            0 => ([0, 0, 1], self.near),
            1 => ([focal, 0, guard], 0),
            2 => ([-focal, 0, guard], 0),
            3 => ([0, focal, guard], 0),
            _ => ([0, -focal, guard], 0),
        };
        dot_64(point, towards) - i64::from(near)
    }

    /// Whether all of a triangle lies outside of one of these planes.
    #[must_use]
    pub fn is_outside(&self, triangle: [Eye; 3]) -> bool {
        (0..Self::PLANES).any(|plane| triangle.iter().all(|corner| self.inside(*corner, plane) < 0))
    }

    /// Number of the planes that [`inside`](Self::inside) knows.
    pub const PLANES: usize = 5;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::angle::Turn;

    #[test]
    fn the_short_way_is_exact() {
        let mut seed = 1u64;
        let mut random = |range: core::ops::Range<f64>| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            range.start + (range.end - range.start) * (seed >> 33) as f64 / (1u64 << 31) as f64
        };
        let mut whole = 0;
        for _ in 0..20_000 {
            let angle = Turn::degrees(random(0.0..360.0) as i32);
            let rotation = Rotation::x(angle) * Rotation::y(Turn::degrees(random(0.0..360.0) as i32));
            let away = random(-4.0..10.0).exp2();
            let scale = ((away * random(-8.0..0.0).exp2()).min(500.0) * 4_294_967_296.0) as i64;
            let translation = [random(-0.8..0.8), random(-0.8..0.8), 1.0].map(|part| (part * away * 1_048_576.0) as i32);
            let near = Length::from_num(random(-9.0..-1.0).exp2());
            let focal = random(10.0..20.0).exp2();
            let size = Size::new(1024, 240);
            let projection = Projection::new(rotation, scale, translation, near, focal as u32, size);
            let Sight::Whole(way) = projection.sight([0; 3], 32_768) else { continue };
            whole += 1;
            for _ in 0..8 {
                let position = [0; 3].map(|_: i32| random(-18_900.0..18_900.0) as i16);
                let eye = projection.eye(position);
                let (place, nearness) = way.screen(position);
                let long = projection.screen(eye).map(|projected| projected.nearness);
                assert_eq!(Some(nearness), long);
                let [_, _, z] = eye;
                for (((row, t), c), v) in rotation.0.iter().zip(translation).zip([512.0, 120.0]).zip(place) {
                    let turned: f64 = row.0.iter().zip(position).map(|(r, p)| f64::from(*r) * f64::from(p)).sum();
                    let here = turned * scale as f64 / 2f64.powi(30 + 15 + 12) + t as f64;
                    let exact = here * f64::from(focal as u32) / f64::from(z) + c * 256.0;
                    let error = f64::from(v >> 12) - exact;
                    assert!(error.abs() < 0.55, "{error} at {exact} of {way:?}");
                }
            }
        }
        assert!(whole > 5_000, "{whole}");
    }
}
