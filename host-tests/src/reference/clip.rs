//! Clipping at the near plane.

use glam::DVec3;

/// A corner of a triangle on its way to the screen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Corner {
    /// In view space: x right, y up, z towards the viewer.
    pub(super) position: DVec3,
    /// Of length 1, in the world.
    pub(super) normal: DVec3,
}

/// The part of a triangle that lies `near` or farther in front of the eye: a convex polygon of 0, 3 or 4 corners, in the
/// same sense of rotation.
///
/// The corners stand in the order of the triangle's, those made by the cut in place of the ones cut off. Along a cut edge
/// position and normal are linear, and the new normal is brought back to length 1.
pub(super) fn clip_near(triangle: [Corner; 3], near: f64) -> Vec<Corner> {
    let visible = |corner: &Corner| -corner.position.z >= near;
    let mut polygon = Vec::with_capacity(4);
    for (index, from) in triangle.iter().enumerate() {
        let to = &triangle[(index + 1) % 3];
        if visible(from) {
            polygon.push(*from);
        }
        match (visible(from), visible(to)) {
            (true, false) => polygon.push(cut(from, to, near)),
            (false, true) => polygon.push(cut(to, from, near)),
            _ => {}
        }
    }
    polygon
}

/// Where an edge meets the plane. It is always cut from the same side, so that neighbours get the same point to the bit.
fn cut(visible: &Corner, hidden: &Corner, near: f64) -> Corner {
    let t = (near + visible.position.z) / (visible.position.z - hidden.position.z);
    Corner {
        position: visible.position.lerp(hidden.position, t).with_z(-near),
        normal: visible.normal.lerp(hidden.normal, t).normalize_or_zero(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const NEAR: f64 = 0.1;

    fn corner(depth: f64, x: f64, normal: DVec3) -> Corner {
        Corner { position: DVec3::new(x, 2.0 * x, -depth), normal }
    }

    #[test]
    fn what_is_beyond_the_plane_stays_and_what_is_before_it_goes() {
        let [touching, far, hidden] = [(NEAR, 0.0), (7.0, 3.0), (-5.0, 2.0)].map(|(depth, x)| corner(depth, x, DVec3::Y));
        assert_eq!(clip_near([touching, far, far], NEAR), [touching, far, far]);
        assert_eq!(clip_near([hidden, hidden, hidden], NEAR), []);
    }

    #[test]
    fn a_cut_edge_is_linear_and_its_normal_has_length_one() {
        let [far, hidden, other] = [(0.3, 1.0, DVec3::X), (-0.1, 3.0, DVec3::Y), (0.5, 5.0, DVec3::Z)]
            .map(|(depth, x, normal)| corner(depth, x, normal));
        // The plane is in the middle of this edge.
        let middle = corner(NEAR, 2.0, DVec3::new(0.5_f64.sqrt(), 0.5_f64.sqrt(), 0.0));

        let polygon = clip_near([hidden, other, far], NEAR);
        assert_eq!((polygon.len(), polygon[1], polygon[2]), (4, other, far));
        assert!(polygon[3].position.distance(middle.position) < 1e-15);
        assert!(polygon[3].normal.distance(middle.normal) < 1e-15);

        let triangle = clip_near([far, hidden, corner(0.0, 0.0, DVec3::Y)], NEAR);
        assert_eq!((triangle.len(), triangle[0], triangle[1]), (3, far, polygon[3]));
    }

    #[test]
    fn neighbours_are_cut_at_the_same_point() {
        for step in 1..100 {
            let depth = 0.1 + f64::from(step) / 7.0;
            let (a, b) = (corner(depth, 0.3, DVec3::X), corner(-1.0 / depth, 0.7, DVec3::Y));
            // The edge is cut on the way there and on the way back.
            let polygon = clip_near([a, b, b], NEAR);
            assert_eq!(polygon[1], polygon[2]);
            assert_eq!(polygon[1].position.z, -NEAR);
        }
    }
}
