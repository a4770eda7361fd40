//! Faces of more than three corners, cut into triangles.

use crate::vector::{cross, dot, sub, Vector};

/// Cuts a simple polygon into triangles of the same sense of rotation, by ears; gives the numbers of their corners.
///
/// A convex one becomes a fan around corner 0. One that crosses itself becomes n − 2 triangles of whatever shape.
pub(crate) fn triangles(corners: &[Vector]) -> Vec<[usize; 3]> {
    let normal = normal(corners);
    let mut left: Vec<usize> = (0..corners.len()).collect();
    let mut triangles = Vec::with_capacity(corners.len().saturating_sub(2));
    while let [_, _, _, _, ..] = left[..] {
        // Corner 1 first, so that corner 0 stays.
        let order = (1..left.len()).chain([0]);
        let ear = order.into_iter().find(|&i| is_ear(corners, &left, i, normal)).unwrap_or(1);
        triangles.push(around(&left, ear));
        left.remove(ear);
    }
    triangles.extend(<[usize; 3]>::try_from(left).ok());
    triangles
}

/// Normal by Newell's method: twice the area, whatever the shape.
fn normal(corners: &[Vector]) -> Vector {
    let mut sum = [0.0; 3];
    let Some(&origin) = corners.first() else { return sum };
    for pair in corners.windows(2) {
        let part = cross(sub(pair[0], origin), sub(pair[1], origin));
        sum = [sum[0] + part[0], sum[1] + part[1], sum[2] + part[2]];
    }
    sum
}

/// A corner of those left, between its neighbours.
fn around(left: &[usize], i: usize) -> [usize; 3] {
    let n = left.len();
    [left[(i + n - 1) % n], left[i], left[(i + 1) % n]]
}

/// An ear is a convex corner whose triangle holds no other corner.
fn is_ear(corners: &[Vector], left: &[usize], i: usize, normal: Vector) -> bool {
    let ear = around(left, i);
    let [a, b, c] = ear.map(|corner| corners[corner]);
    let side = |from: Vector, to: Vector, point: Vector| dot(cross(sub(to, from), sub(point, from)), normal);
    let inside = |p: Vector| side(a, b, p) >= 0.0 && side(b, c, p) >= 0.0 && side(c, a, p) >= 0.0;
    let others = left.iter().filter(|corner| !ear.contains(corner)).map(|&corner| corners[corner]);
    side(a, b, c) > 0.0 && !others.filter(|p| ![a, b, c].contains(p)).any(inside)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn convex_ones_become_fans() {
        let square = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]];
        assert_eq!(triangles(&square), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(triangles(&square[..3]), [[0, 1, 2]]);
        assert!(triangles(&square[..2]).is_empty());
    }

    #[test]
    fn a_dart_is_not_cut_outside() {
        let dart = [[0.0, 0.0, 0.0], [2.0, -2.0, 0.0], [0.5, 0.0, 0.0], [2.0, 2.0, 0.0]];
        for turn in 0..4 {
            let turned: Vec<_> = dart.iter().cycle().skip(turn).take(4).copied().collect();
            for [a, b, c] in triangles(&turned) {
                let area = cross(sub(turned[b], turned[a]), sub(turned[c], turned[a]))[2];
                assert!(area > 0.0, "turned by {turn}: {area}");
            }
        }
    }

    #[test]
    fn a_corner_on_a_straight_edge_stays() {
        let corners = [[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
        assert_eq!(triangles(&corners), [[1, 2, 3], [0, 1, 3]]);
    }

    #[test]
    fn nonsense_ends() {
        assert_eq!(triangles(&[[0.0; 3]; 7]).len(), 5);
        assert_eq!(triangles(&[[f64::MAX; 3], [f64::NAN; 3], [0.0; 3], [1.0; 3], [0.0; 3]]).len(), 3);
    }
}
