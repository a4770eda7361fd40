//! Cutting a triangle at the near plane and the guard band.

use heapless::Vec;

use super::projection::{Eye, Projection};
use crate::math::{quotient::fraction, vector::Vector, weights::Weights};

/// A corner of what is left of a triangle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Corner {
    /// Where it is.
    pub eye: Eye,
    /// Its normal, Q14; renormalised where it was made by a cut.
    pub normal: [i16; 3],
    /// Number of the vertex, for a corner that was there before.
    pub vertex: Option<u16>,
    /// Where it is in the triangle.
    pub weights: Weights,
}

/// The corners of a triangle cut at five planes.
pub type Polygon = Vec<Corner, 8>;

/// What is left of the triangle inside all planes of the projection, in its order; fewer than three corners: nothing.
///
/// Each cut is computed from the corner inside towards the one outside, so both triangles at an edge cut it alike.
#[must_use]
pub fn clip(projection: &Projection, triangle: [Corner; 3]) -> Polygon {
    let mut polygon = Polygon::new();
    let _ = polygon.extend_from_slice(&triangle);
    for plane in 0..Projection::PLANES {
        let mut cut = Polygon::new();
        let Some(mut previous) = polygon.last().copied() else { break };
        let mut before = projection.inside(previous.eye, plane);
        for &corner in &polygon {
            let here = projection.inside(corner.eye, plane);
            // Five planes make at most eight corners of three, so that nothing here can be too much.
            if (before < 0) != (here < 0) {
                let _ = cut.push(if here < 0 {
                    between(previous, before, corner, here)
                } else {
                    between(corner, here, previous, before)
                });
            }
            if here >= 0 {
                let _ = cut.push(corner);
            }
            (previous, before) = (corner, here);
        }
        polygon = cut;
    }
    polygon
}

/// Where the edge from a corner inside to one outside meets the plane.
fn between(inside: Corner, near: i64, outside: Corner, far: i64) -> Corner {
    // near ≥ 0 > far. The part of the way in Q30, from distances brought below 2³¹.
    let way = near - far;
    let down = 33_u32.saturating_sub(way.leading_zeros());
    let part = fraction((near >> down) as u32, (way >> down) as u32);
    let mix = |a: i32, b: i32| a.wrapping_add((((i64::from(b) - i64::from(a)) * i64::from(part)) >> 30) as i32);
    let [ax, ay, az] = inside.eye;
    let [bx, by, bz] = outside.eye;
    let [nx, ny, nz] = inside.normal.map(i32::from);
    let [ox, oy, oz] = outside.normal.map(i32::from);
    // Sixteen bits more than the normals have, so that the cut's normal is as exact as theirs.
    let normal = [(nx, ox), (ny, oy), (nz, oz)].map(|(n, o)| i64::from(mix(n << 16, o << 16)));
    let unit = Vector::unit(normal);
    let normal = unit.map_or(inside.normal, |unit| unit.0.map(|c| ((c + (1 << 15)) >> 16) as i16));
    let weights = inside.weights.towards(outside.weights, part);
    Corner { eye: [mix(ax, bx), mix(ay, by), mix(az, bz)], normal, vertex: None, weights }
}

/// The edge constant `1 − n·m` of two unit normals in Q14, as Q15: half the square of their difference.
#[must_use]
pub fn edge_constant(n: [i16; 3], m: [i16; 3]) -> u16 {
    let [nx, ny, nz] = n.map(i32::from);
    let [mx, my, mz] = m.map(i32::from);
    // Q28 / 2 to Q15; each difference has at most 16 bits and a sign.
    let square = [nx - mx, ny - my, nz - mz].iter().map(|d| i64::from(*d) * i64::from(*d)).sum::<i64>();
    ((square + (1 << 13)) >> 14).min(0xffff) as u16
}
