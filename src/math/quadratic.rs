//! Quadratics on the screen.

use super::{
    gradient::Gradient,
    interpolant::Plane,
    product::{mul_high, scale},
};

/// A value that is quadratic on the screen: the coefficients of 1, X, Y, X², XY and Y², all wrapping, X and Y being the picture's
/// pixels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Quadratic {
    /// At pixel (0, 0).
    pub at: i32,
    /// Coefficient of X.
    pub x: i32,
    /// Coefficient of Y.
    pub y: i32,
    /// Coefficient of X².
    pub xx: i32,
    /// Coefficient of XY.
    pub xy: i32,
    /// Coefficient of Y².
    pub yy: i32,
}

/// A quadratic along a line: two additions a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Differences {
    /// The value at this pixel.
    pub value: i32,
    /// What it increases by to the next one.
    pub step: i32,
    /// What the step increases by.
    pub second: i32,
}

impl Quadratic {
    /// Zero everywhere.
    pub const ZERO: Self = Self { at: 0, x: 0, y: 0, xx: 0, xy: 0, yy: 0 };

    /// The most that twice a gradient's exponent and [`new`](Self::new)'s `finer` may make.
    pub const MOST: i32 = 48;

    /// The quadratic that has these values at a triangle's corners, and between corners i and j a bow:
    /// `Σ vi λi + Σ bow_ij λi λj`, bows in the order 01, 12, 20; in units finer by 2^`finer`, wrapping.
    ///
    /// Values have at most 15 bits and a sign, bows 13; twice the gradient's exponent and `finer` make at most [`MOST`](Self::MOST).
    #[inline]
    #[must_use]
    pub fn new(gradient: &Gradient, [v0, v1, v2]: [i32; 3], [b01, b12, b20]: [i32; 3], finer: i32) -> Self {
        let Gradient { at, x: right, y: down, short, exponent, anchor } = *gradient;
        // In λ1 and λ2 alone it is v0 + aᵀλ + λᵀCλ/2.
        let a = [v1 - v0 + b01, v2 - v0 + b20];
        let c = [-2 * b01, b12 - b01 - b20, -2 * b20];
        // λ at the anchor, with 25 − exponent bits after the point.
        let at = at.map(|h| (h * short as i32) >> 14);
        // Slopes there, a + Cλ, in quarters of a unit. What would be shifted to the left in the end has more bits from here on.
        let up = exponent + finer - 25;
        let (more, less) = (up.max(0), (-up).max(0));
        let [a1, a2] = a.map(|a| a << (more + 2));
        let [t1, t2] = times(c, at).map(|turn| turn >> (23 - exponent - more));
        let slopes = [a1 + t1, a2 + t2];
        // Half way from corner 0 to the anchor, in whole units.
        let between = [(2 * a1 + t1) >> 3, (2 * a2 + t2) >> 3];
        let slopes = slopes.map(|slope| mul_high(slope, short));
        let first = |slopes, way| dot(slopes, way) >> less;
        // C times ρ², which is square · 2^(2·exponent − 62), and its products with the increases to the right and down.
        let square = (short * (short >> 1)) >> 15;
        let c = c.map(|c| (c * square as i32) >> 14);
        let up = 2 * exponent + finer - 35;
        let (cut, less) = (14 - up.max(0), (-up).max(0));
        let half = (1 << cut) >> 1;
        let [x, y] = [right, down].map(|way| times(c, way).map(|turn| (turn + half) >> cut));
        Self {
            at: v0.wrapping_shl(finer as u32).wrapping_add(first(between, at)),
            x: first(slopes, right),
            y: first(slopes, down),
            xx: dot(x, right) >> less,
            xy: dot(x, down).wrapping_add(dot(y, right)) >> less,
            yy: dot(y, down) >> less,
        }
        .to_origin(anchor)
    }

    /// A quadratic counted from that pixel as one counted from pixel (0, 0).
    #[inline(always)]
    const fn to_origin(self, [ax, ay]: [i32; 2]) -> Self {
        let Self { at, x, y, xx, xy, yy } = self;
        let (xx_ax, yy_ay) = (xx.wrapping_mul(ax), yy.wrapping_mul(ay));
        let (half_x, half_y) = (x.wrapping_sub(xx_ax).wrapping_sub(xy.wrapping_mul(ay)), y.wrapping_sub(yy_ay));
        Self {
            at: at.wrapping_sub(half_x.wrapping_mul(ax)).wrapping_sub(half_y.wrapping_mul(ay)),
            x: half_x.wrapping_sub(xx_ax),
            y: half_y.wrapping_sub(yy_ay).wrapping_sub(xy.wrapping_mul(ax)),
            xx,
            xy,
            yy,
        }
    }

    /// The same for any triangle, and for values and bows of up to 18 bits: as exact as [`new`](Self::new) can have it, linear where
    /// the triangle is too thin for more, the value at the centroid everywhere where it has no gradient.
    #[inline]
    #[must_use]
    pub fn bowed(gradient: Option<&Gradient>, corners: [i32; 3], bows: [i32; 3], mut finer: i32) -> Self {
        let Some(gradient) = gradient else {
            let sum = 3 * corners.iter().sum::<i32>() + bows.iter().sum::<i32>();
            return Self { at: scale((sum << 8) / 9, finer - 8), ..Self::ZERO };
        };
        let bits = |values: [i32; 3]| values.iter().fold(0, |bits, value| bits | (value ^ value >> 31));
        let mut bits = bits(bows) | bits(corners) >> 2;
        let mut less = 0;
        while bits >= 1 << 13 {
            bits >>= 1;
            less += 1;
        }
        finer += less;
        let [v0, v1, v2] = corners.map(|value| value >> less);
        if 2 * gradient.exponent + finer > Self::MOST {
            return Plane::new(Some(gradient), [v0, v1, v2], finer).into();
        }
        Self::new(gradient, [v0, v1, v2], bows.map(|bow| bow >> less), finer)
    }

    /// As [`bowed`](Self::bowed), given the values in the middles of edges 01, 12, 20; all of at most 15 bits and a sign.
    #[inline]
    #[must_use]
    pub fn through_six(gradient: Option<&Gradient>, corners: [i32; 3], middles: [i32; 3], finer: i32) -> Self {
        let ([v0, v1, v2], [m01, m12, m20]) = (corners, middles);
        let bows = [4 * m01 - 2 * (v0 + v1), 4 * m12 - 2 * (v1 + v2), 4 * m20 - 2 * (v2 + v0)];
        Self::bowed(gradient, corners, bows, finer)
    }

    /// The quadratic along line y, from pixel x on.
    #[inline(always)]
    #[must_use]
    pub const fn along(&self, x: i32, y: i32) -> Differences {
        // On this line it is c + b·x + a·x².
        let b = self.x.wrapping_add(self.xy.wrapping_mul(y));
        let c = self.at.wrapping_add(y.wrapping_mul(self.y.wrapping_add(self.yy.wrapping_mul(y))));
        let ax = self.xx.wrapping_mul(x);
        let slope = b.wrapping_add(ax);
        Differences {
            value: c.wrapping_add(x.wrapping_mul(slope)),
            step: slope.wrapping_add(ax).wrapping_add(self.xx),
            second: self.xx.wrapping_add(self.xx),
        }
    }
}

impl From<Plane> for Quadratic {
    fn from(Plane { at, x, y }: Plane) -> Self {
        Self { at, x, y, ..Self::ZERO }
    }
}

impl Differences {
    /// At least as much as the value reaches on this pixel and the `count` next ones, if it stays between −3 · 2²⁹ and 2²⁹.
    #[inline(always)]
    #[must_use]
    pub const fn most(&self, count: i32) -> i32 {
        let half = self.second >> 1;
        let end = self.value.wrapping_add(count.wrapping_mul(self.step.wrapping_add(half.wrapping_mul(count - 1))));
        let ends = if end > self.value { end } else { self.value };
        // Where it is curved downwards, it is above the chord by at most a quarter of that.
        let bow = (half.wrapping_mul(count) >> 2).wrapping_mul(count);
        ends.wrapping_sub(bow & (bow >> 31))
    }

    /// So many pixels further to the right: what as many steps would give, modulo 2³².
    #[inline(always)]
    #[must_use]
    pub const fn after(self, count: i32) -> Self {
        // One of two successive numbers is even.
        let pairs = if count & 1 == 0 { (count >> 1).wrapping_mul(count - 1) } else { count.wrapping_mul((count - 1) >> 1) };
        Self {
            value: self.value.wrapping_add(self.step.wrapping_mul(count)).wrapping_add(self.second.wrapping_mul(pairs)),
            step: self.step.wrapping_add(self.second.wrapping_mul(count)),
            second: self.second,
        }
    }

    /// The value at this pixel, and on to the next one.
    #[inline(always)]
    pub const fn next(&mut self) -> i32 {
        let value = self.value;
        self.value = value.wrapping_add(self.step);
        self.step = self.step.wrapping_add(self.second);
        value
    }
}

/// A scalar product, wrapping.
#[inline(always)]
const fn dot([a, b]: [i32; 2], [c, d]: [i32; 2]) -> i32 {
    a.wrapping_mul(c).wrapping_add(b.wrapping_mul(d))
}

/// The symmetric matrix 11, 12, 22 times a vector, wrapping.
#[inline(always)]
const fn times([c11, c12, c22]: [i32; 3], vector: [i32; 2]) -> [i32; 2] {
    [dot([c11, c12], vector), dot([c12, c22], vector)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Quadratics whose values on the line are as heights of highlights may be.
    #[test]
    fn none_reaches_more_than_the_most() {
        let mut state = 1_u64;
        let mut random = |below: i64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((i128::from(state >> 33) * i128::from(2 * below)) >> 31) as i64 - below
        };
        let mut seen = 0;
        for round in 0..200_000 {
            let count = 1 + (random(512) + 512) * (round % 3) / 2;
            let (value, rise, bow) = (random(3 << 29), random(3 << 29), random(3 << 31));
            let half = -(bow / (count * count));
            let step = rise / count - half * (count - 1);
            let at = |x: i64| value + x * step + half * x * (x - 1);
            let reached = (0..=count).map(at).max().unwrap_or(0);
            let fits = |value: i64| i32::try_from(value).is_ok();
            if (0..=count).any(|x| !(-(3 << 29)..=1 << 29).contains(&at(x))) || !fits(step) || !fits(2 * half) {
                continue;
            }
            seen += 1;
            let along = Differences { value: value as i32, step: step as i32, second: (2 * half) as i32 };
            assert!(i64::from(along.most(count as i32)) >= reached, "{along:?} {count}");
        }
        assert!(seen > 20_000, "{seen}");
    }
}
