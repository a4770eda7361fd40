//! What is drawn, and from where.

use glam::{DMat3, DVec2, DVec3};

use super::{Light, Material, Mesh};

/// Objects and lights before a camera.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// Who looks.
    pub camera: Camera,
    /// What shines.
    pub lights: Vec<Light>,
    /// What is seen; [`Owner`](crate::Owner) numbers them in this order.
    pub objects: Vec<Object<'a>>,
    /// Colour where nothing is seen: red, green and blue from 0 to 1.
    pub background: [f64; 3],
}

impl Scene<'_> {
    /// The vertex numbers of each object's triangles, as [`Measures`](crate::Measures) asks for them.
    #[must_use]
    pub fn triangles(&self) -> Vec<&[[u32; 3]]> {
        self.objects.iter().map(|object| &*object.mesh.triangles).collect()
    }
}

/// A mesh at its place in the world.
#[derive(Clone, Debug)]
pub struct Object<'a> {
    /// Its shape.
    pub mesh: &'a Mesh,
    /// The materials that the triangles of the mesh refer to.
    pub materials: Vec<Material>,
    /// Its place.
    pub pose: Pose,
}

/// Rotation, uniform scale and translation of an object, in this order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// An orthonormal matrix of determinant 1.
    pub rotation: DMat3,
    /// More than 0.
    pub scale: f64,
    /// Where the origin of the mesh goes, in the world.
    pub translation: DVec3,
}

impl Pose {
    /// The mesh as it is.
    pub const IDENTITY: Self = Self { rotation: DMat3::IDENTITY, scale: 1.0, translation: DVec3::ZERO };

    /// A point of the mesh in the world.
    #[must_use]
    pub fn position(&self, point: DVec3) -> DVec3 {
        self.rotation * point * self.scale + self.translation
    }
}

/// A pinhole camera, looking along its own −z, its y pointing up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Width of the viewport in pixels.
    pub width: usize,
    /// Height of the viewport in pixels.
    pub height: usize,
    /// Focal length in pixels.
    pub focal: f64,
    /// Distance of the near plane, more than 0; nothing nearer is seen.
    pub near: f64,
    /// The camera's axes in the world: columns x (right), y (up) and z (backwards).
    pub rotation: DMat3,
    /// Where it stands, in the world.
    pub position: DVec3,
}

impl Camera {
    /// The focal length in pixels of a vertical field of view in radians, rounded to 1/256 px, as the library keeps it.
    #[must_use]
    pub fn focal_length(height: usize, field_of_view: f64) -> f64 {
        (height as f64 / 2.0 / (field_of_view / 2.0).tan() * 256.0).round() / 256.0
    }

    /// A point of the world in view space: x right, y up, z towards the viewer.
    #[must_use]
    pub fn view(&self, point: DVec3) -> DVec3 {
        self.rotation.transpose() * (point - self.position)
    }

    /// A point of view space back in the world.
    #[must_use]
    pub fn world(&self, view: DVec3) -> DVec3 {
        self.rotation * view + self.position
    }

    /// A point in view space, before the eye, on the screen: x right, y down, in pixels from the upper left corner.
    /// The middle of the viewport is what the camera looks at.
    #[must_use]
    pub fn project(&self, view: DVec3) -> DVec2 {
        let center = DVec2::new(self.width as f64, self.height as f64) / 2.0;
        center + DVec2::new(view.x, -view.y) * (self.focal / -view.z)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::FRAC_PI_2;

    fn camera() -> Camera {
        Camera { width: 100, height: 60, focal: 50.0, near: 0.1, rotation: DMat3::IDENTITY, position: DVec3::new(0.0, 0.0, 2.0) }
    }

    #[test]
    fn x_is_right_and_y_is_up() {
        let on_screen = |point| camera().project(camera().view(point));
        assert_eq!(on_screen(DVec3::ZERO), DVec2::new(50.0, 30.0));
        assert_eq!(on_screen(DVec3::X), DVec2::new(75.0, 30.0));
        assert_eq!(on_screen(DVec3::Y), DVec2::new(50.0, 5.0));
        assert_eq!(on_screen(DVec3::new(1.0, 0.0, 1.0)), DVec2::new(100.0, 30.0));
    }

    #[test]
    fn a_camera_turned_to_the_left_looks_along_minus_x() {
        let camera = Camera { rotation: DMat3::from_rotation_y(FRAC_PI_2), position: DVec3::X, ..camera() };
        // From (1, 0, 0) towards −x: what lies at −z is on the right.
        let (world, view) = (DVec3::new(-1.0, 3.0, -4.0), DVec3::new(4.0, 3.0, -2.0));
        assert!(camera.view(world).distance(view) < 1e-12 && camera.world(view).distance(world) < 1e-12);
    }

    #[test]
    fn a_pose_turns_then_scales_then_moves() {
        let pose = Pose { rotation: DMat3::from_rotation_z(FRAC_PI_2), scale: 2.0, translation: DVec3::new(10.0, 0.0, 0.0) };
        assert!(pose.position(DVec3::X).distance(DVec3::new(10.0, 2.0, 0.0)) < 1e-12);
    }

    #[test]
    fn the_focal_length_is_kept_in_256ths() {
        assert_eq!(Camera::focal_length(240, 40_f64.to_radians()), 84403.0 / 256.0);
    }
}
