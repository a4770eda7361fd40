//! A small sphere around points.

use crate::vector::{add_scaled, dot, sub, Vector};

/// More steps than this do not show in a radius of 16 bits.
const STEPS: u32 = 500;

/// The centre of a nearly smallest sphere: step i goes 1/(i + 1) of the way to the farthest point
/// (Bădoiu and Clarkson, *Smaller core-sets for balls*, 2003). The origin if there are no points.
pub(crate) fn center(points: &[Vector]) -> Vector {
    let mut center = points.first().copied().unwrap_or_default();
    for step in 1..=STEPS {
        center = match farthest(points, center) {
            Some((point, _)) => add_scaled(center, sub(point, center), 1.0 / f64::from(step + 1)),
            None => center,
        };
    }
    center
}

/// The radius that such a sphere must have.
pub(crate) fn radius(points: &[Vector], center: Vector) -> f64 {
    farthest(points, center).map_or(0.0, |(_, square)| square.sqrt())
}

/// The point farthest from the centre, and the square of its distance.
fn farthest(points: &[Vector], center: Vector) -> Option<(Vector, f64)> {
    let distance = |&point: &Vector| {
        let arm = sub(point, center);
        (point, dot(arm, arm))
    };
    points.iter().map(distance).reduce(|far, next| if next.1 > far.1 { next } else { far })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_has_its_half_diagonal() {
        let corner = |i: u32| [i & 1, i >> 1 & 1, i >> 2].map(|bit| 3.0 + f64::from(bit));
        let corners: Vec<_> = (0..8).map(corner).collect();
        let center = center(&corners);
        let radius = radius(&corners, center);
        assert!((0.866_025..0.868).contains(&radius), "{radius}");
    }

    #[test]
    fn one_point_and_none() {
        assert_eq!(center(&[]), [0.0; 3]);
        assert_eq!(center(&[[1.0, 2.0, 3.0]]), [1.0, 2.0, 3.0]);
        assert_eq!(radius(&[[1.0, 2.0, 3.0]], [1.0, 2.0, 3.0]), 0.0);
    }
}
