//! Phong's illumination model.

use glam::DVec3;

/// A light infinitely far away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Unit vector towards the light, in the world.
    pub direction: DVec3,
    /// Factor of all that the light adds, 0 or more.
    pub intensity: f64,
}

impl Light {
    /// A light of intensity 1 in that direction, which need not have length 1.
    #[must_use]
    pub fn directional(towards: DVec3) -> Self {
        Self { direction: towards.normalize_or_zero(), intensity: 1.0 }
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
}

/// The lights of a scene, ready to be reflected.
pub(super) struct Lighting {
    lights: Vec<Lit>,
}

struct Lit {
    light: Light,
    /// Unit vector half way between the light and the viewer.
    half: DVec3,
}

impl Lighting {
    /// `to_viewer` is the unit vector towards the viewer, who is infinitely far away.
    pub(super) fn new(lights: &[Light], to_viewer: DVec3) -> Self {
        let lit = |&light: &Light| Lit { light, half: (light.direction + to_viewer).normalize_or_zero() };
        Self { lights: lights.iter().map(lit).collect() }
    }

    /// `ambient·base + diffuse·base·Σ I·(n·l) + specular·highlight·Σ I·(n·h)ⁿ`, both products clamped at 0, saturating.
    ///
    /// The highlight is there whether or not the surface faces the light.
    pub(super) fn shade(&self, material: &Material, normal: DVec3) -> [f64; 3] {
        let mut diffuse = material.ambient;
        let mut specular = 0.0;
        for Lit { light, half } in &self.lights {
            diffuse += material.diffuse * light.intensity * normal.dot(light.direction).max(0.0);
            specular += material.specular * light.intensity * normal.dot(*half).max(0.0).powf(material.exponent);
        }
        [0, 1, 2].map(|channel| (diffuse * material.base[channel] + specular * material.highlight[channel]).min(1.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MATERIAL: Material = Material {
        base: [0.8, 0.4, 0.0],
        highlight: [1.0, 0.0, 0.5],
        ambient: 0.1,
        diffuse: 0.5,
        specular: 0.5,
        exponent: 2.0,
        double_sided: false,
    };

    fn assert_near(actual: [f64; 3], expected: [f64; 3]) {
        let near = actual.iter().zip(expected).all(|(actual, expected)| (actual - expected).abs() < 1e-12);
        assert!(near, "{actual:?} is not {expected:?}");
    }

    #[test]
    fn known_points() {
        // The light from the right, the viewer in front: the half vector has 45° to both.
        let lighting = Lighting::new(&[Light::directional(DVec3::X)], DVec3::Z);
        // Towards the light: n·l = 1, (n·h)² = 1/2.
        assert_near(lighting.shade(&MATERIAL, DVec3::X), [0.6 * 0.8 + 0.25, 0.6 * 0.4, 0.125]);
        // Towards the viewer: n·l = 0, and yet a highlight.
        assert_near(lighting.shade(&MATERIAL, DVec3::Z), [0.1 * 0.8 + 0.25, 0.1 * 0.4, 0.125]);
        // Turned from the light, n·l < 0, with n·h = (4/5 − 3/5)/√2.
        let turned = DVec3::new(-0.6, 0.0, 0.8);
        assert_near(lighting.shade(&MATERIAL, turned), [0.1 * 0.8 + 0.01, 0.1 * 0.4, 0.005]);
        // Turned from both.
        assert_near(lighting.shade(&MATERIAL, DVec3::NEG_Z), [0.1 * 0.8, 0.1 * 0.4, 0.0]);
    }

    #[test]
    fn lights_add_and_each_channel_saturates() {
        let dim = Light { direction: DVec3::Z, intensity: 0.5 };
        assert_near(Lighting::new(&[dim, dim], DVec3::Z).shade(&MATERIAL, DVec3::Z), [0.6 * 0.8 + 0.5, 0.24, 0.25]);
        let bright = Light { direction: DVec3::Z, intensity: 2.0 };
        assert_near(Lighting::new(&[bright], DVec3::Z).shade(&MATERIAL, DVec3::Z), [1.0, 0.44, 0.5]);
    }
}
