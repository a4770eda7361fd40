//! Normals that a file lacks, averaged from its faces.

use crate::soup::Triangle;
use crate::vector::{add_scaled, angle, cross, dot, sub, unit, Vector};

/// One triangle's corner at a position.
#[derive(Clone, Copy)]
struct Wedge {
    triangle: usize,
    corner: usize,
    /// The positions before and after this one.
    previous: usize,
    next: usize,
    /// Normal of the face.
    normal: Vector,
    /// Angle of the corner.
    angle: f64,
}

/// Gives every corner a unit normal: its own, or else the average of the faces around its position, weighted by their
/// angles (Thürmer and Wüthrich, *Computing vertex normals from polygonal facets*, 1998).
///
/// Faces are averaged if one comes from one to the other across edges at which they meet at no more than `crease` degrees.
/// So both faces of a smooth edge have the same normals at its ends, and those of a crease have not.
pub(crate) fn complete(positions: &[Vector], triangles: &mut [Triangle], crease: f64) {
    // A little slack for faces that meet at the very angle.
    let cosine = crease.clamp(0.0, 180.0).to_radians().cos() - 1e-9;
    for corner in triangles.iter_mut().flat_map(|triangle| &mut triangle.corners) {
        corner.normal = corner.normal.and_then(unit);
    }
    let is_missing = |wedge: &Wedge, triangles: &[Triangle]| triangles[wedge.triangle].corners[wedge.corner].normal.is_none();
    for mut wedges in wedges(positions, triangles) {
        if !wedges.iter().any(|wedge| is_missing(wedge, triangles)) {
            continue;
        }
        while let Some(&first) = wedges.first() {
            let (smooth, rest) = around(first, wedges, cosine);
            let sum = smooth.iter().fold([0.0; 3], |sum, wedge| add_scaled(sum, wedge.normal, wedge.angle));
            for wedge in smooth {
                let normal = &mut triangles[wedge.triangle].corners[wedge.corner].normal;
                *normal = normal.or(unit(sum)).or(Some(wedge.normal));
            }
            wedges = rest;
        }
    }
}

/// The wedges around each position, in the order of the triangles.
fn wedges(positions: &[Vector], triangles: &[Triangle]) -> Vec<Vec<Wedge>> {
    let mut wedges = vec![Vec::new(); positions.len()];
    for (number, triangle) in triangles.iter().enumerate() {
        let at = triangle.corners.map(|corner| corner.position);
        let [a, b, c] = at.map(|position| positions[position]);
        let Some(normal) = unit(cross(sub(b, a), sub(c, a))) else { continue };
        for corner in 0..3 {
            let [here, next, previous] = [0, 1, 2].map(|step| at[(corner + step) % 3]);
            let arm = |to: usize| sub(positions[to], positions[here]);
            let angle = angle(arm(next), arm(previous));
            wedges[here].push(Wedge { triangle: number, corner, previous, next, normal, angle });
        }
    }
    wedges
}

/// Parts the wedges into those that go smoothly over into the first, and the rest; both keep their order.
fn around(first: Wedge, wedges: Vec<Wedge>, cosine: f64) -> (Vec<Wedge>, Vec<Wedge>) {
    let mut smooth = vec![first];
    let mut rest = wedges;
    rest.retain(|wedge| (wedge.triangle, wedge.corner) != (first.triangle, first.corner));
    let mut seen = 0;
    while let Some(&from) = smooth.get(seen) {
        let meets =
            |to: &mut Wedge| (to.previous == from.next || to.next == from.previous) && dot(to.normal, from.normal) >= cosine;
        smooth.extend(rest.extract_if(.., meets));
        seen += 1;
    }
    // A sum in the order of the triangles does not depend on which one came first.
    smooth.sort_by_key(|wedge| (wedge.triangle, wedge.corner));
    (smooth, rest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::soup::Corner;
    use crate::vector::length;

    /// Two squares, each of two triangles, that meet at a right angle along the x axis.
    fn roof() -> (Vec<Vector>, Vec<Triangle>) {
        let positions = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [1, 0, -1], [0, 0, -1]];
        let corner = |position| Corner { position, normal: None };
        let triangle = |corners: [usize; 3]| Triangle { corners: corners.map(corner), surface: 0 };
        (positions.map(|p| p.map(f64::from)).into(), [[0, 1, 2], [0, 2, 3], [0, 5, 4], [0, 4, 1]].map(triangle).into())
    }

    fn normals(triangles: &[Triangle]) -> Vec<Vector> {
        triangles.iter().flat_map(|triangle| triangle.corners).map(|corner| corner.normal.unwrap()).collect()
    }

    #[test]
    fn a_crease_parts_and_no_crease_joins() {
        let (positions, mut flat) = roof();
        complete(&positions, &mut flat, 89.0);
        for (i, normal) in normals(&flat).into_iter().enumerate() {
            assert_eq!(normal, if i < 6 { [0.0, 0.0, 1.0] } else { [0.0, -1.0, 0.0] });
        }
        let (positions, mut smooth) = roof();
        complete(&positions, &mut smooth, 90.0);
        let diagonal = 0.5f64.sqrt();
        // Position 0 is a corner of all four triangles; by angle, both squares weigh the same.
        for i in [0, 3, 6, 9] {
            let gap = sub(normals(&smooth)[i], [0.0, -diagonal, diagonal]);
            assert!(length(gap) < 1e-12);
        }
    }

    #[test]
    fn given_normals_stay_and_become_unit() {
        let (positions, mut triangles) = roof();
        triangles[0].corners[0].normal = Some([3.0, 0.0, 0.0]);
        triangles[0].corners[1].normal = Some([0.0; 3]);
        complete(&positions, &mut triangles, 0.0);
        assert_eq!(normals(&triangles)[..3], [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]]);
    }
}
