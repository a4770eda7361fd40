//! The standard scenes, Newell's teapot turning in 60 frames, and the cases that methods are compared in.

use std::f64::consts::TAU;
use std::path::Path;

use anyhow::Result;
use glam::{DMat3, DVec3};

use crate::reference::{Camera, Light, Material, Mesh, Object, Pose, Scene};
use crate::shapes;

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
    opacity: 1.0,
};

/// The same in white, for grey output: its three channels are equal.
pub const WHITE: Material = Material { base: [1.0; 3], ..ORANGE };

/// Glass, seen from both sides.
pub const GLASS: Material = Material { base: [0.3, 0.6, 1.0], exponent: 20.0, double_sided: true, opacity: 0.4, ..ORANGE };

/// Vertical, in degrees.
const FIELD_OF_VIEW: f64 = 40.0;

/// Where the light is.
const LIGHT: DVec3 = DVec3::new(-0.5, 0.7, 0.6);

/// The angle by which a frame has turned, in radians.
fn turn(frame: u32) -> f64 {
    f64::from(frame) / f64::from(FRAMES) * TAU
}

/// A frame of the standard scene: T880 with [`teapot_880`], T5560 with [`teapot_5560`].
///
/// 240×240 pixels, vertical field of view 40°, the camera at distance 2.45 looking along −z; the model turned by
/// R_x(25°)·R_y(6°·`frame`); one light from (−0.5, 0.7, 0.6); the background is black.
#[must_use]
pub fn standard(mesh: &Mesh, material: Material, frame: u32) -> Scene<'_> {
    Scene {
        camera: Camera {
            width: 240,
            height: 240,
            focal: Camera::focal_length(240, FIELD_OF_VIEW.to_radians()),
            near: 0.1,
            rotation: DMat3::IDENTITY,
            position: DVec3::new(0.0, 0.0, 2.45),
        },
        lights: vec![Light::directional(LIGHT)],
        objects: vec![Object {
            mesh,
            materials: vec![material],
            pose: Pose {
                rotation: DMat3::from_rotation_x(25_f64.to_radians()) * DMat3::from_rotation_y(turn(frame)),
                ..Pose::IDENTITY
            },
        }],
        background: [0.0; 3],
    }
}

/// A pane of glass before the standard scene's teapot: its scale, its place, and by what it is turned about y, in radians.
pub const BEFORE: (f64, [f64; 3], f64) = (0.3, [0.15, 0.1, 1.0], 0.3);
/// Two through it, and through each other.
pub const THROUGH: [(f64, [f64; 3], f64); 2] = [(0.8, [0.1, 0.0, 0.1], 0.5), (0.7, [0.0; 3], -0.6)];

/// The teapot of the standard scene and up to two [panes](shapes::pane) such as these.
#[must_use]
pub fn with_panes<'m>(teapot: &'m Mesh, pane: &'m Mesh, panes: &[(f64, [f64; 3], f64)]) -> Scene<'m> {
    let mut scene = standard(teapot, ORANGE, 5);
    scene.background = [0.1, 0.2, 0.1];
    let object = |(opacity, (scale, place, turn)): (f64, &(f64, [f64; 3], f64))| {
        let pose = Pose { rotation: DMat3::from_rotation_y(*turn), scale: *scale, translation: DVec3::from_array(*place) };
        Object { mesh: pane, materials: vec![Material { opacity, ..GLASS }], pose }
    };
    scene.objects.extend([0.4, 0.7].into_iter().zip(panes).map(object));
    scene
}

/// That teapot, of glass, around a ball.
#[must_use]
pub fn of_glass<'m>(teapot: &'m Mesh, ball: &'m Mesh) -> Scene<'m> {
    let mut scene = standard(teapot, Material { double_sided: false, ..GLASS }, 5);
    scene.background = [0.1, 0.2, 0.1];
    let pose = Pose { scale: 0.3, translation: DVec3::new(0.0, -0.05, 0.0), ..Pose::IDENTITY };
    scene.objects.push(Object { mesh: ball, materials: vec![ORANGE], pose });
    scene
}

/// What a case shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The standard scene T880, all frames.
    T880,
    /// The same teapot at 512×512.
    T880Large,
    /// A sphere of 80 triangles.
    I80,
    /// A sphere of 320 triangles.
    I320,
    /// One big triangle with the highlight inside; at exponent 20 the corners show a ninth of it or less.
    Triangle,
}

impl Subject {
    /// All of them, the dearest first.
    pub const ALL: [Self; 5] = [Self::T880, Self::T880Large, Self::I320, Self::I80, Self::Triangle];

    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::T880 => "t880",
            Self::T880Large => "t880-512",
            Self::I80 => "i80",
            Self::I320 => "i320",
            Self::Triangle => "triangle",
        }
    }

    /// Its mesh.
    ///
    /// # Errors
    ///
    /// When a file cannot be read.
    pub fn mesh(self) -> Result<Mesh> {
        Ok(match self {
            Self::T880 | Self::T880Large => teapot_880()?,
            Self::I80 => shapes::icosphere(1),
            Self::I320 => shapes::icosphere(2),
            Self::Triangle => shapes::bent_triangle(26_f64.to_radians()),
        })
    }

    /// The numbers of its frames: all of the standard scene's, or four of them, 42° apart.
    pub fn frames(self) -> impl Iterator<Item = u32> {
        let (end, step) = if self == Self::T880 { (FRAMES, 1) } else { (28, 7) };
        (0..end).step_by(step)
    }
}

/// The kinds of light in the cases.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Illumination {
    /// The standard scene's light, for a viewer at infinity.
    Directional,
    /// A light on the standard scene's ray of light, 3.15 from the origin, for a viewer at the eye.
    Point,
}

impl Illumination {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Directional, Self::Point];

    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Directional => "directional",
            Self::Point => "point",
        }
    }
}

/// A scene in which shading methods are compared, in white.
///
/// Spheres and triangle are lit by 0.65, so that nothing saturates; the teapot as in the standard scene by 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Case {
    /// What it shows.
    pub subject: Subject,
    /// Its light.
    pub light: Illumination,
    /// Its exponent.
    pub exponent: u16,
}

impl Case {
    /// The exponents.
    pub const EXPONENTS: [u16; 4] = [5, 20, 50, 125];

    /// All cases: exponents within lights within subjects.
    pub fn all() -> impl Iterator<Item = Self> {
        let of = |subject| Illumination::ALL.into_iter().map(move |light| (subject, light));
        let lit = Subject::ALL.into_iter().flat_map(of);
        lit.flat_map(|(subject, light)| Self::EXPONENTS.map(|exponent| Self { subject, light, exponent }))
    }

    /// A frame of the case, with the mesh of its subject.
    #[must_use]
    pub fn scene(self, mesh: &Mesh, frame: u32) -> Scene<'_> {
        let mut scene = standard(mesh, Material { exponent: self.exponent.into(), ..WHITE }, frame);
        let light = match self.light {
            Illumination::Directional => Light::directional(LIGHT),
            Illumination::Point => Light::point(LIGHT * 3.0),
        };
        match self.subject {
            Subject::T880 => {}
            Subject::I80 | Subject::I320 => scene.objects[0].pose.scale = 0.8,
            Subject::T880Large => {
                let focal = Camera::focal_length(512, FIELD_OF_VIEW.to_radians());
                scene.camera = Camera { width: 512, height: 512, focal, ..scene.camera };
            }
            Subject::Triangle => {
                // Turned in its plane, and towards the half vector of the directional light.
                let tilt = DMat3::from_rotation_x(-25_f64.to_radians()) * DMat3::from_rotation_y(-15_f64.to_radians());
                let rotation = tilt * DMat3::from_rotation_z(turn(frame));
                scene.objects[0].pose = Pose { rotation, scale: 0.8, ..Pose::IDENTITY };
            }
        }
        let teapot = matches!(self.subject, Subject::T880 | Subject::T880Large);
        scene.lights = vec![Light { intensity: if teapot { 1.0 } else { 0.65 }, ..light }];
        scene
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

    #[test]
    fn cases_differ_in_what_they_show_and_how_it_is_lit() {
        let cases: Vec<_> = Case::all().collect();
        assert_eq!(cases.len(), 5 * 2 * 4);
        assert!((0..cases.len()).all(|index| !cases[..index].contains(&cases[index])));
        let mesh = shapes::bent_triangle(0.5);
        let brightest = |case: &Case| {
            let Scene { lights, objects, .. } = case.scene(&mesh, 0);
            let material = objects[0].materials[0];
            material.ambient + lights[0].intensity * (material.diffuse + material.specular)
        };
        let saturated: Vec<_> = cases.iter().filter(|case| brightest(case) > 1.0).map(|case| case.subject).collect();
        assert!(saturated.iter().all(|subject| [Subject::T880, Subject::T880Large].contains(subject)));
    }
}
