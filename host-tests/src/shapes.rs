//! Round meshes with the normals of what they stand for.

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

    #[test]
    fn triangles_face_where_their_normals_point() {
        for mesh in [sphere(7), bowl(5), torus(9)] {
            for corners in &mesh.triangles {
                let [a, b, c] = corners.map(|corner| mesh.positions[corner as usize]);
                let normal: DVec3 = corners.iter().map(|&corner| mesh.normals[corner as usize]).sum();
                let face = (b - a).cross(c - a);
                assert!(face.length() < 1e-9 || face.dot(normal) > 0.0, "{corners:?}");
            }
        }
    }
}
