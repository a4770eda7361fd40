//! The standard scenes: Newell's teapot, turning in 60 frames.

use std::f64::consts::TAU;
use std::path::Path;

use anyhow::Result;
use glam::{DMat3, DVec3};

use crate::reference::{Camera, Light, Material, Mesh, Object, Pose, Scene};

/// Number of frames in which the teapot turns once.
pub const FRAMES: u32 = 60;

/// The orange body under a white highlight.
pub const ORANGE: Material = Material {
    base: [0.85, 0.45, 0.20],
    highlight: [1.0; 3],
    ambient: 0.15,
    diffuse: 0.75,
    specular: 0.5,
    exponent: 32.0,
    double_sided: false,
};

/// The same in white, for grey output: its three channels are equal.
pub const WHITE: Material = Material { base: [1.0; 3], ..ORANGE };

/// A frame of the standard scene: T880 with [`teapot_880`], T5560 with [`teapot_5560`].
///
/// 240×240 pixels, vertical field of view 40°, the camera at distance 2.45 looking along −z; the model turned by
/// R_x(25°)·R_y(6°·`frame`); one light from (−0.5, 0.7, 0.6); the background is black.
#[must_use]
pub fn standard(mesh: &Mesh, material: Material, frame: u32) -> Scene<'_> {
    let turn = f64::from(frame) / f64::from(FRAMES) * TAU;
    Scene {
        camera: Camera {
            width: 240,
            height: 240,
            focal: Camera::focal_length(240, 40_f64.to_radians()),
            near: 0.1,
            rotation: DMat3::IDENTITY,
            position: DVec3::new(0.0, 0.0, 2.45),
        },
        lights: vec![Light::directional(DVec3::new(-0.5, 0.7, 0.6))],
        objects: vec![Object {
            mesh,
            materials: vec![material],
            pose: Pose { rotation: DMat3::from_rotation_x(25_f64.to_radians()) * DMat3::from_rotation_y(turn), ..Pose::IDENTITY },
        }],
        background: [0.0; 3],
    }
}

/// The teapot of 880 triangles.
///
/// # Errors
///
/// When the file cannot be read.
pub fn teapot_880() -> Result<Mesh> {
    model("teapot-880.obj")
}

/// The teapot of 5560 triangles.
///
/// # Errors
///
/// When the file cannot be read.
pub fn teapot_5560() -> Result<Mesh> {
    model("teapot-5560.obj")
}

/// Reads one of the models that come with the examples.
fn model(file: &str) -> Result<Mesh> {
    Mesh::from_obj(Path::new(env!("CARGO_MANIFEST_DIR")).join("../examples/models").join(file))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn after_a_quarter_of_its_turn_the_spout_points_away() {
        let mesh = Mesh::new(vec![], vec![], vec![]);
        let spout = standard(&mesh, ORANGE, FRAMES / 4).objects[0].pose.position(DVec3::X);
        let (up, away) = 25_f64.to_radians().sin_cos();
        assert!(spout.distance(DVec3::new(0.0, up, -away)) < 1e-12);
    }
}
