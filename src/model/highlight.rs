//! Whether the centre of a highlight may lie on a triangle, and where.

use super::light::{Aim, Rays};
use crate::math::weights::Weights;

/// How a normal leans away from that under which the centre of a highlight is seen, in two directions.
///
/// *Adaptive Shading*, §2.1: at the centre of a highlight the normal lies in the plane of light and viewer (H1) and makes equal
/// angles with both (H2), so that both numbers are 0 there. They change smoothly over a triangle; for directional lights and a
/// viewer at infinity they are linear in the normal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Lean {
    /// Out of the plane of light and viewer: (l × v)·n, Q29.
    pub out: i32,
    /// Towards the light rather than the viewer: n·l − n·v, Q29. Light and viewer being unit vectors, nothing need be squared.
    pub over: i32,
    /// Whether n·h > 0; a surface that turns away from h at all corners has no highlight.
    pub faces: bool,
}

impl Lean {
    /// Of a normal, Q14, under these rays.
    #[inline]
    #[must_use]
    pub fn new(rays: &Rays, normal: [i16; 3]) -> Self {
        let dot = |[x, y, z]: [i32; 3]| {
            let [nx, ny, nz] = normal.map(i32::from);
            x.wrapping_mul(nx).wrapping_add(y.wrapping_mul(ny)).wrapping_add(z.wrapping_mul(nz))
        };
        // Q15; each component of the product is at most one, whatever overflows on the way.
        let ([lx, ly, lz], [vx, vy, vz]) = (rays.light.map(|c| c >> 1), rays.viewer.map(|c| c >> 1));
        let cross = [(ly, vz, lz, vy), (lz, vx, lx, vz), (lx, vy, ly, vx)]
            .map(|(a, b, c, d)| a.wrapping_mul(b).wrapping_sub(c.wrapping_mul(d)) >> 15);
        Self { out: dot(cross), over: (dot(rays.light) >> 1).wrapping_sub(dot(rays.viewer) >> 1), faces: dot(rays.half) > 0 }
    }
}

/// Whether a triangle, given its corners, is potentially highlighted: whether both conditions may be met at one of its points.
///
/// *Adaptive Shading*, §2.2 and §2.3. The two strips make a box around the triangle: a highlight whose centre is in the box but
/// off the triangle passes, too. For directional lights and a viewer at infinity no highlight centred on the triangle is missed.
/// In the scene n·l − n·v may be 0 on a closed curve inside: with the light at 1.5 and the viewer at 6 times the length of an edge,
/// some 37 % are missed; with both at 1.5 times, hardly one. Where light and viewer are in one direction, every plane through it
/// holds both, and all triangles that face them pass.
#[inline]
#[must_use]
pub fn is_potential(corners: [Lean; 3]) -> bool {
    passes(corners, |least, most| least <= 0 && most >= 0)
}

/// The same with strips three times as wide, in the middle of which the triangle is: so the neighbours of a potentially
/// highlighted triangle, if they are about as large and as bent, pass as well, without a look at it.
#[inline]
#[must_use]
pub fn is_near(corners: [Lean; 3]) -> bool {
    passes(corners, |least, most| least.saturating_mul(2) <= most && most.saturating_mul(2) >= least)
}

#[inline]
fn passes(corners: [Lean; 3], holds: impl Fn(i32, i32) -> bool) -> bool {
    let strip = |[a, b, c]: [i32; 3]| holds(a.min(b).min(c), a.max(b).max(c));
    corners.iter().any(|corner| corner.faces)
        && strip(corners.map(|corner| corner.out))
        && strip(corners.map(|corner| corner.over))
}

/// A triangle of a mesh: positions, Q15 of its extent, and normals, Q14, of its corners.
#[derive(Clone, Copy, Debug)]
pub struct Bent {
    /// The positions.
    pub positions: [[i16; 3]; 3],
    /// The normals.
    pub normals: [[i16; 3]; 3],
}

impl Bent {
    /// Whether it [is potentially highlighted](is_potential) by any of the lights.
    #[must_use]
    pub fn is_potential<A: Aim>(&self, aims: &[A]) -> bool {
        aims.iter().any(|aim| is_potential(self.leans(aim)))
    }

    /// Whether it [is near a highlight](is_near) of any of the lights.
    #[must_use]
    pub fn is_near<A: Aim>(&self, aims: &[A]) -> bool {
        aims.iter().any(|aim| is_near(self.leans(aim)))
    }

    /// How the normals at its corners lean.
    #[inline]
    #[must_use]
    pub fn leans<A: Aim>(&self, aim: &A) -> [Lean; 3] {
        let ([p0, p1, p2], [n0, n1, n2]) = (self.positions, self.normals);
        [(p0, n0), (p1, n1), (p2, n2)].map(|(position, normal)| Lean::new(&aim.rays(position), normal))
    }

    /// The centre of a light's highlight in 512ths of the triangle; where it lies outside, the nearer one of Q and R (see below);
    /// none where no such places are. Of triangles that share an edge, both get the same place on it: its end of the lower
    /// number comes first.
    ///
    /// *Adaptive Shading*, §3.1.1 and appendix: H1 holds at Q and R on two edges, H2 at P between them. On an edge
    /// `(PL × PV)·N` is a quadratic in t, as AB × AB vanishes. It is taken from its values at both ends and in the middle, so that
    /// the term `−t·(AB×AV + AL×AB)·N_A`, lost in a line of the printed derivation, cannot be; its root is found by halving. The
    /// measure for H2 is `n·l − n·v`, which changes its sign at P, where the printed one, the cosine between viewer and
    /// reflected light, has its maximum. For directional lights and a viewer at infinity P is the very centre.
    #[must_use]
    pub fn center<A: Aim>(&self, aim: &A, numbers: [u16; 3]) -> Option<Weights> {
        let [a, b, c] = self.leans(aim).map(|lean| lean.out < 0);
        // The corner alone on its side, and the others.
        let lone = match [a == b, b == c, c == a] {
            [false, true, _] => [0, 1, 2],
            [false, false, true] => [1, 2, 0],
            [true, false, _] => [2, 0, 1],
            _ => return None,
        };
        let corner = |i: usize| Some((*self.positions.get(i)?, *self.normals.get(i)?, *numbers.get(i)?));
        let [i, j, k] = lone;
        let (first, second, third) = (corner(i)?, corner(j)?, corner(k)?);
        let (q, r) = (share(aim, first, second), share(aim, first, third));
        // Shares of the second and the third corner.
        let place = |second: u32, third: u32| {
            let mut shares = [0; 3];
            for (corner, share) in [(i, ONE - (second + third).min(ONE)), (j, second), (k, third)] {
                *shares.get_mut(corner)? = (share << (15 - BITS)) as u16;
            }
            Some(Weights::new(shares))
        };
        let (on_q, on_r) = (place(q, 0)?, place(0, r)?);
        let over = |place: Weights| {
            let normal = place.mean(self.normals).map(|c| ((c + (1 << 14)) >> 15) as i16);
            i64::from(Lean::new(&aim.rays(place.position(self.positions)), normal).over)
        };
        let (near, far) = (over(on_q), over(on_r));
        if (near < 0) == (far < 0) {
            return Some(if near.abs() <= far.abs() { on_q } else { on_r });
        }
        let part = (near << BITS).checked_div(near - far).unwrap_or(0).clamp(0, ONE.into()) as u32;
        let half = ONE / 2;
        place((q * (ONE - part) + half) >> BITS, (r * part + half) >> BITS)
    }
}

/// Parts of an edge are counted in 2⁻⁹: exact in [`Weights`] even when halved six times.
const BITS: u32 = 9;
const ONE: u32 = 1 << BITS;

/// A corner of a mesh's triangle: position, normal, number.
type Corner = ([i16; 3], [i16; 3], u16);

/// The share of the second corner where the normal on the edge is in the plane of light and viewer.
fn share<A: Aim>(aim: &A, first: Corner, second: Corner) -> u32 {
    let ((_, _, a), (_, _, b)) = (first, second);
    if a <= b {
        crossing(aim, first, second)
    } else {
        ONE - crossing(aim, second, first)
    }
}

/// The same, from the first corner's side.
fn crossing<A: Aim>(aim: &A, (p0, n0, _): Corner, (p1, n1, _): Corner) -> u32 {
    let ([ax, ay, az], [bx, by, bz]) = (p0.map(i32::from), p1.map(i32::from));
    let ([na, nb, nc], [nd, ne, nf]) = (n0.map(i32::from), n1.map(i32::from));
    let places = [[2 * ax, 2 * ay, 2 * az], [ax + bx, ay + by, az + bz], [2 * bx, 2 * by, 2 * bz]];
    let normals = [[2 * na, 2 * nb, 2 * nc], [na + nd, nb + ne, nc + nf], [2 * nd, 2 * ne, 2 * nf]];
    let ways = places.map(|place| aim.ways(place));
    // One unit for all places: 19 bits for the farthest.
    let largest = ways.iter().fold([0, 0], |[light, viewer], [l, v]| {
        let most = |most: u32, way: &[i32; 3]| way.iter().fold(most, |most, c| most | c.unsigned_abs());
        [most(light, l), most(viewer, v)]
    });
    let [less_light, less_viewer] = largest.map(|most| 13_u32.saturating_sub(most.leading_zeros()));
    let [[l0, v0], [l1, v1], [l2, v2]] =
        ways.map(|[light, viewer]| [light.map(|c| c >> less_light), viewer.map(|c| c >> less_viewer)]);
    let [m0, m1, m2] = normals;
    // At most 58 bits.
    let [start, middle, end] =
        [(l0, v0, m0), (l1, v1, m1), (l2, v2, m2)].map(|(light, viewer, normal)| triple(light, viewer, normal));
    // The control values of the quadratic as a curve of Bézier's: halving it takes sums alone.
    let (mut c0, mut c1, mut c2) = (start, 2 * middle - (start + end) / 2, end);
    let mut share = 0;
    for _ in 0..BITS {
        let (left, right) = ((c0 + c1) >> 1, (c1 + c2) >> 1);
        let middle = (left + right) >> 1;
        share <<= 1;
        if (middle < 0) == (start < 0) {
            share |= 1;
            (c0, c1) = (middle, right);
        } else {
            (c1, c2) = (left, middle);
        }
    }
    share
}

/// (a × b)·c.
fn triple(a: [i32; 3], b: [i32; 3], c: [i32; 3]) -> i64 {
    let ([ax, ay, az], [bx, by, bz], [cx, cy, cz]) = (a.map(i64::from), b.map(i64::from), c.map(i64::from));
    (ay * bz - az * by) * cx + (az * bx - ax * bz) * cy + (ax * by - ay * bx) * cz
}
