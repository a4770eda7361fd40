//! Round meshes with the normals of what they stand for.

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::reference::Mesh;

/// A unit sphere of so many steps from pole to pole, twice as many around.
#[must_use]
pub fn sphere(steps: u32) -> Mesh {
    surface(steps, 2 * steps, |down, around| {
        let ring = on_sphere(PI * down, TAU * around);
        (ring, ring)
    })
}

/// A unit sphere of 20 · 4ⁿ almost equal triangles: an icosahedron, each triangle of which is divided into four, n times.
#[must_use]
pub fn icosphere(divisions: u32) -> Mesh {
    let golden = (1.0 + 5_f64.sqrt()) / 2.0;
    let mut points = Vec::new();
    // The corners of three golden rectangles.
    for (a, b) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        points.extend([DVec3::new(a, b, 0.0), DVec3::new(0.0, a, b), DVec3::new(b, 0.0, a)].map(DVec3::normalize));
    }
    let mut triangles = icosahedron(&points);
    for _ in 0..divisions {
        let mut middles = HashMap::new();
        let mut middle = |a: u32, b: u32| {
            *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                points.push((points[a as usize] + points[b as usize]).normalize());
                points.len() as u32 - 1
            })
        };
        triangles = triangles
            .into_iter()
            .flat_map(|[a, b, c]| {
                let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
                [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
            })
            .collect();
    }
    Mesh::new(points.clone(), points, triangles)
}

/// The triangles between neighbours of twelve corners, counter-clockwise seen from outside.
fn icosahedron(corners: &[DVec3]) -> Vec<[u32; 3]> {
    let count = corners.len() as u32;
    let all = (0..count).flat_map(|a| (0..count).flat_map(move |b| (0..count).map(move |c| [a, b, c])));
    let face = |&[a, b, c]: &[u32; 3]| {
        let [p, q, r] = [a, b, c].map(|corner| corners[corner as usize]);
        // Neighbours are 63° apart; all others more than 90°.
        let close = p.dot(q) > 0.0 && q.dot(r) > 0.0 && r.dot(p) > 0.0;
        a < b.min(c) && b != c && close && p.dot(q.cross(r)) > 0.0
    };
    all.filter(face).collect()
}

/// A square of side 2 in the xy plane, its normals towards +z.
#[must_use]
pub fn pane() -> Mesh {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| DVec3::new(x, y, 0.0));
    Mesh::new(corners.to_vec(), vec![DVec3::Z; 4], vec![[0, 1, 2], [0, 2, 3]])
}

/// One triangle in the xy plane with its corners on the unit circle, the first at the top, and normals that lean outwards by that
/// angle in radians.
#[must_use]
pub fn bent_triangle(lean: f64) -> Mesh {
    let corner = |index: u32| {
        let (sine, cosine) = (TAU * f64::from(index) / 3.0).sin_cos();
        let outwards = DVec3::new(-sine, cosine, 0.0);
        (outwards, outwards * lean.sin() + DVec3::Z * lean.cos())
    };
    let (positions, normals) = (0..3).map(corner).unzip();
    Mesh::new(positions, normals, vec![[0, 1, 2]])
}

/// The lower part of a unit sphere, open at the top.
#[must_use]
pub fn bowl(steps: u32) -> Mesh {
    surface(steps, 3 * steps, |down, around| {
        let ring = on_sphere(PI * (0.4 + 0.6 * down), TAU * around);
        (ring, ring)
    })
}

/// A ring around the y axis, 0.7 from it to the middle of its body, which is 0.3 thick to either side.
#[must_use]
pub fn torus(steps: u32) -> Mesh {
    surface(steps, 2 * steps, |down, around| {
        let (sine, cosine) = (TAU * down).sin_cos();
        let outwards = DVec3::new((TAU * around).sin(), 0.0, (TAU * around).cos());
        let normal = outwards * sine + DVec3::Y * cosine;
        (outwards * 0.7 + normal * 0.3, normal)
    })
}

fn on_sphere(latitude: f64, longitude: f64) -> DVec3 {
    let (sine, cosine) = latitude.sin_cos();
    DVec3::new(sine * longitude.sin(), cosine, sine * longitude.cos())
}

/// Rows of quads, each in two triangles, closed around the y axis; `place` takes two numbers from 0 to 1, downwards and around, to
/// position and normal.
fn surface(rows: u32, around: u32, place: impl Fn(f64, f64) -> (DVec3, DVec3)) -> Mesh {
    let vertices = (0..=rows).flat_map(|row| (0..around).map(move |column| (row, column)));
    let place = |(row, column)| place(f64::from(row) / f64::from(rows), f64::from(column) / f64::from(around));
    let (positions, normals) = vertices.map(place).unzip();
    let quad = |row: u32, column: u32| {
        let [a, b] = [column, (column + 1) % around].map(|column| row * around + column);
        let [c, d] = [a + around, b + around];
        [[a, c, d], [a, d, b]]
    };
    let triangles = (0..rows).flat_map(|row| (0..around).flat_map(move |column| quad(row, column))).collect();
    Mesh::new(positions, normals, triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn triangles_face_where_their_normals_point() {
        for mesh in [sphere(7), icosphere(2), bent_triangle(0.7), bowl(5), torus(9)] {
            for corners in &mesh.triangles {
                let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
                let normal: DVec3 = corners.iter().map(|&corner| mesh.normals[corner as usize]).sum();
                let face = (b - a).cross(c - a);
                assert!(face.length() < 1e-9 || face.dot(normal) > 0.0, "{corners:?}");
            }
        }
    }

    #[test]
    fn an_icosphere_is_closed_round_and_even() {
        for divisions in 0..3 {
            let mesh = icosphere(divisions);
            let faces = 20 * 4_usize.pow(divisions);
            // Euler: V − E + F = 2 with three half edges to a face.
            assert_eq!((mesh.triangles.len(), mesh.positions.len()), (faces, faces / 2 + 2));
            let edges: HashSet<_> = mesh.triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
            assert_eq!(edges.len(), 3 * faces);
            assert!(edges.iter().all(|&(a, b)| edges.contains(&(b, a))));
            assert!(mesh.positions.iter().all(|position| (position.length() - 1.0).abs() < 1e-12));
            let length = |&(a, b): &(u32, u32)| mesh.positions[a as usize].distance(mesh.positions[b as usize]);
            let longest = edges.iter().map(length).fold(0.0, f64::max);
            let shortest = edges.iter().map(length).fold(f64::INFINITY, f64::min);
            assert!(longest / shortest < 1.2, "{shortest} to {longest}");
        }
    }
}
