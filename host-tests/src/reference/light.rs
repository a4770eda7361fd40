//! Phong's illumination model.

use glam::DVec3;

use super::Camera;

/// A light, and for whom it makes highlights.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it is.
    pub source: Source,
    /// Who sees its highlights.
    pub viewer: Viewer,
    /// Factor of all that the light adds, 0 or more, the same at any distance.
    pub intensity: f64,
}

/// Where a light is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// Infinitely far away: unit vector towards the light, in the world.
    Direction(DVec3),
    /// At this place in the world.
    Point(DVec3),
}

/// From where a highlight is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Viewer {
    /// From infinitely far away, along the camera's axis: of parallel light the half vector is one for the whole picture.
    Infinity,
    /// From where the camera stands.
    Eye,
}

impl Light {
    /// A light of intensity 1 in that direction, which need not have length 1, for a viewer infinitely far away.
    #[must_use]
    pub fn directional(towards: DVec3) -> Self {
        Self { source: Source::Direction(towards.normalize_or_zero()), viewer: Viewer::Infinity, intensity: 1.0 }
    }

    /// A light of intensity 1 at that place in the world, for a viewer at the eye.
    #[must_use]
    pub fn point(position: DVec3) -> Self {
        Self { source: Source::Point(position), viewer: Viewer::Eye, intensity: 1.0 }
    }
}

/// What a surface looks like. Colours are red, green and blue from 0 to 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// Colour of the surface.
    pub base: [f64; 3],
    /// Colour of its highlights.
    pub highlight: [f64; 3],
    /// Share of `base` that shows without light, 0 to 1.
    pub ambient: f64,
    /// Coefficient of the diffuse reflection, 0 to 1.
    pub diffuse: f64,
    /// Coefficient of the specular reflection, 0 to 1.
    pub specular: f64,
    /// Exponent of the specular reflection, 1 or more.
    pub exponent: f64,
    /// Seen from behind too, under turned normals.
    pub double_sided: bool,
    /// Share of its own colour in what is seen, 0 to 1; the rest is what lies behind. Below 1 the surface is transparent.
    pub opacity: f64,
}

/// The lights of a scene, and those who look.
pub(super) struct Lighting<'a> {
    lights: &'a [Light],
    /// Where the camera stands.
    eye: DVec3,
    /// Unit vector towards the viewer who is infinitely far away.
    axis: DVec3,
}

impl<'a> Lighting<'a> {
    pub(super) fn new(lights: &'a [Light], camera: &Camera) -> Self {
        Self { lights, eye: camera.position, axis: camera.rotation.z_axis }
    }

    /// `ambient·base + diffuse·base·Σ I·(n·l) + specular·highlight·Σ I·(n·h)ⁿ`, both products clamped at 0, saturating.
    ///
    /// At `point` in the world, l is the unit vector towards the light, v the one towards the viewer, h = (l + v)/|l + v|.
    /// The highlight is there whether or not the surface faces the light.
    pub(super) fn shade(&self, material: &Material, normal: DVec3, point: DVec3) -> [f64; 3] {
        let mut diffuse = material.ambient;
        let mut specular = 0.0;
        for Light { source, viewer, intensity } in self.lights {
            let to_light = match *source {
                Source::Direction(towards) => towards,
                Source::Point(position) => (position - point).normalize_or_zero(),
            };
            let to_viewer = match viewer {
                Viewer::Infinity => self.axis,
                Viewer::Eye => (self.eye - point).normalize_or_zero(),
            };
            let half = (to_light + to_viewer).normalize_or_zero();
            diffuse += material.diffuse * intensity * normal.dot(to_light).max(0.0);
            specular += material.specular * intensity * normal.dot(half).max(0.0).powf(material.exponent);
        }
        [0, 1, 2].map(|channel| (diffuse * material.base[channel] + specular * material.highlight[channel]).min(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DMat3;

    const MATERIAL: Material = Material {
        base: [0.8, 0.4, 0.0],
        highlight: [1.0, 0.0, 0.5],
        ambient: 0.1,
        diffuse: 0.5,
        specular: 0.5,
        exponent: 2.0,
        double_sided: false,
        opacity: 1.0,
    };

    fn assert_near(actual: [f64; 3], expected: [f64; 3]) {
        let near = actual.iter().zip(expected).all(|(actual, expected)| (actual - expected).abs() < 1e-12);
        assert!(near, "{actual:?} is not {expected:?}");
    }

    /// The colour of a surface with that normal at (3, 0, 0), seen from (0, 0, 4) by a camera that looks along −z.
    fn shade(lights: &[Light], normal: DVec3) -> [f64; 3] {
        let position = DVec3::new(0.0, 0.0, 4.0);
        let camera = Camera { width: 1, height: 1, focal: 1.0, near: 0.1, rotation: DMat3::IDENTITY, position };
        Lighting::new(lights, &camera).shade(&MATERIAL, normal, DVec3::new(3.0, 0.0, 0.0))
    }

    #[test]
    fn known_points() {
        // The light from the right, the viewer in front: the half vector has 45° to both.
        let light = [Light::directional(DVec3::X)];
        // Towards the light: n·l = 1, (n·h)² = 1/2.
        assert_near(shade(&light, DVec3::X), [0.6 * 0.8 + 0.25, 0.6 * 0.4, 0.125]);
        // Towards the viewer: n·l = 0, and yet a highlight.
        assert_near(shade(&light, DVec3::Z), [0.1 * 0.8 + 0.25, 0.1 * 0.4, 0.125]);
        // Turned from the light, n·l < 0, with n·h = (4/5 − 3/5)/√2.
        let turned = DVec3::new(-0.6, 0.0, 0.8);
        assert_near(shade(&light, turned), [0.1 * 0.8 + 0.01, 0.1 * 0.4, 0.005]);
        // Turned from both.
        assert_near(shade(&light, DVec3::NEG_Z), [0.1 * 0.8, 0.1 * 0.4, 0.0]);
    }

    #[test]
    fn a_viewer_at_the_eye_sees_the_highlight_elsewhere() {
        // v = (−3, 0, 4)/5; the light stands above the point, so that l = (0, 0, 1) however far it is.
        // l + v = (−0.6, 0, 1.8), so n·h = 1.8/√3.6 for n = (0, 0, 1), and its square is 0.9.
        let towards_z = [0.6 * 0.8 + 0.45, 0.6 * 0.4, 0.225];
        let parallel = Light { viewer: Viewer::Eye, ..Light::directional(DVec3::Z) };
        let [near, far] = [2.0, 70.0].map(|height| Light::point(DVec3::new(3.0, 0.0, height)));
        for light in [parallel, near, far] {
            assert_near(shade(&[light], DVec3::Z), towards_z);
        }
        // A light at the eye: l = v = h, and n·l = n·h = 0.8.
        let at_eye = Light::point(DVec3::new(0.0, 0.0, 4.0));
        assert_near(shade(&[at_eye], DVec3::Z), [0.5 * 0.8 + 0.32, 0.5 * 0.4, 0.16]);
        // From behind: l = (−3, 0, −4)/5, n·l = −0.28 adds nothing; h = (−1, 0, 0), n·h = 0.6.
        let below = Light::point(DVec3::new(0.0, 0.0, -4.0));
        assert_near(shade(&[below], DVec3::new(-0.6, 0.0, 0.8)), [0.1 * 0.8 + 0.18, 0.1 * 0.4, 0.09]);
        // Where the light itself is, it shines from nowhere: l = 0, h = v.
        let here = Light::point(DVec3::new(3.0, 0.0, 0.0));
        assert_near(shade(&[here], DVec3::Z), [0.1 * 0.8 + 0.32, 0.1 * 0.4, 0.16]);
    }

    #[test]
    fn lights_add_and_each_channel_saturates() {
        let with = |intensity| Light { intensity, ..Light::directional(DVec3::Z) };
        assert_near(shade(&[with(0.5); 2], DVec3::Z), [0.6 * 0.8 + 0.5, 0.24, 0.25]);
        assert_near(shade(&[with(2.0)], DVec3::Z), [1.0, 0.44, 0.5]);
    }
}
