//! Lights.

use core::{array::from_fn, fmt::Debug};

use super::{camera::Camera, mesh::Mesh, pose::Pose};
use crate::math::{
    interpolant::{Interpolant, Plane},
    length,
    quadratic::Quadratic,
    vector::{unit, Vector},
    Length,
};

/// A kind of light source, and with it the kind of viewer.
///
/// All lights of a frame are of one kind, named in its type, so that what only the other kind needs is not linked.
pub trait LightSource: Copy + Debug {
    /// The light as the vertices of one object see it.
    type Aim: Aim;
    /// How its products with an interpolated normal run over a triangle on the screen.
    type Product: Interpolant;
    /// What a shading method keeps only where directions change from place to place.
    type Change<T: Copy + Debug>: Change<T>;
    /// What a facet holds once for each product of each light with a normal; or once for all, where all see the same normals.
    type PerProduct<T: Blank, const LIGHTS: usize>: PerProduct<T>;
    /// Whether its direction or the viewer's changes from place to place.
    const IN_SCENE: bool;
    /// A light that is off.
    const OFF: Self;

    /// The intensity in Q15.
    #[must_use]
    fn strength(&self) -> u16;

    /// The light as that mesh in that pose sees it, and the viewer.
    #[must_use]
    fn aim(&self, camera: &Camera, mesh: &Mesh<'_>, pose: &Pose) -> Self::Aim;
}

/// A value that is there only for lights in the scene: an `Option` of it for these, nothing at all for directional ones.
pub trait Change<T>: Copy + Debug {
    /// No value.
    const NONE: Self;

    /// The value, if there is to be one.
    #[must_use]
    fn of(make: impl FnOnce() -> T) -> Self;

    /// The value, if there is one.
    #[must_use]
    fn get(&self) -> Option<&T>;
}

impl<T> Change<T> for () {
    const NONE: Self = ();

    #[inline(always)]
    fn of(_: impl FnOnce() -> T) -> Self {}

    #[inline(always)]
    fn get(&self) -> Option<&T> {
        None
    }
}

impl<T: Copy + Debug> Change<T> for Option<T> {
    const NONE: Self = None;

    #[inline(always)]
    fn of(make: impl FnOnce() -> T) -> Self {
        Some(make())
    }

    #[inline(always)]
    fn get(&self) -> Option<&T> {
        self.as_ref()
    }
}

/// A value to fill memory with.
pub trait Blank: Copy + Debug {
    /// That value.
    const BLANK: Self;
}

/// Values for the products n·l (0) and n·h (1) of each light; several products may have one in common.
pub trait PerProduct<T>: Blank {
    /// Makes each value, given a light and a product that it is for.
    fn each(value: impl FnMut(usize, usize) -> T) -> Self;

    /// The value for a product of a light; none if there is no such light.
    fn of(&self, light: usize, product: usize) -> Option<&T>;
}

impl<T: Blank, const PRODUCTS: usize, const LIGHTS: usize> Blank for [[T; PRODUCTS]; LIGHTS] {
    const BLANK: Self = [[T::BLANK; PRODUCTS]; LIGHTS];
}

/// In common are those beyond the last row or column.
impl<T: Blank, const PRODUCTS: usize, const LIGHTS: usize> PerProduct<T> for [[T; PRODUCTS]; LIGHTS] {
    #[inline(always)]
    fn each(mut value: impl FnMut(usize, usize) -> T) -> Self {
        from_fn(|light| from_fn(|product| value(light, product)))
    }

    #[inline(always)]
    fn of(&self, light: usize, product: usize) -> Option<&T> {
        self.get(light.min(LIGHTS.saturating_sub(1)))?.get(product.min(PRODUCTS.saturating_sub(1)))
    }
}

/// A light source in the space of an object.
pub trait Aim: Copy + Debug {
    /// Directions seen from a position in the mesh, Q15 of its extent.
    #[must_use]
    fn rays(&self, position: [i16; 3]) -> Rays;

    /// The ways to light and viewer from a place in 2⁻¹⁶ of the mesh's extent, in any one unit each: linear in the place.
    #[must_use]
    fn ways(&self, place: [i32; 3]) -> [[i32; 3]; 2];

    /// `[intensity · n·l, n·h]` in Q14, for a position, Q15 of the mesh's extent, and a normal, Q14.
    #[must_use]
    fn dots(&self, position: [i16; 3], normal: [i16; 3]) -> [i16; 2];
}

/// Unit vectors at a place on a surface, in the object's space, Q16; null vectors for a light that is off.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rays {
    /// l, to the light.
    pub light: [i32; 3],
    /// h, half way between light and viewer: h = (l + v)/|l + v| (*Faster Phong Shading*, Eq. 1).
    pub half: [i32; 3],
    /// v, to the viewer.
    pub viewer: [i32; 3],
}

impl Rays {
    /// No light.
    pub(crate) const NONE: Self = Self { light: [0; 3], half: [0; 3], viewer: [0; 3] };

    /// `[intensity · n·l, n·h]` in Q14, intensity in Q15.
    #[inline(always)]
    fn dots(&self, normal: [i16; 3], intensity: u16) -> [i16; 2] {
        // Q14 · Q16 = Q30; each sum is at most √3 of that.
        let dot = |[x, y, z]: [i32; 3]| {
            let [nx, ny, nz] = normal.map(i32::from);
            x.wrapping_mul(nx).wrapping_add(y.wrapping_mul(ny)).wrapping_add(z.wrapping_mul(nz))
        };
        let round = |product: i32| (product.wrapping_add(1 << 15) >> 16) as i16;
        [round((dot(self.light) >> 15).wrapping_mul(intensity.into())), round(dot(self.half))]
    }
}

/// A directional light of white colour, for a viewer at infinity: the same directions everywhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Light {
    /// Unit vector towards the light, in the world; the null vector for a light that is off.
    direction: Vector,
    /// Q15.
    intensity: u16,
}

impl Light {
    /// A light of full intensity from that direction: (x, y, z) points towards the light and need not be normalised.
    /// The null vector makes a light that is off.
    #[must_use]
    pub fn directional(towards: [f32; 3]) -> Self {
        match Vector::unit_f32(towards) {
            Some(direction) => Self { direction, intensity: 1 << 15 },
            None => Self::OFF,
        }
    }

    /// No light.
    pub const OFF: Self = Self { direction: Vector([0; 3]), intensity: 0 };

    /// The same with another intensity, 0.0 to 1.0, clamped.
    #[must_use]
    pub const fn intensity(mut self, intensity: f32) -> Self {
        self.intensity = strength(intensity);
        self
    }
}

impl LightSource for Light {
    type Aim = Far;
    type Product = Plane;
    type Change<T: Copy + Debug> = ();
    type PerProduct<T: Blank, const LIGHTS: usize> = [[T; 1]; 1];
    const IN_SCENE: bool = false;
    const OFF: Self = Self::OFF;

    fn strength(&self) -> u16 {
        self.intensity
    }

    fn aim(&self, camera: &Camera, _: &Mesh<'_>, pose: &Pose) -> Far {
        if self.intensity == 0 {
            return Far { rays: Rays::NONE, intensity: 0 };
        }
        let viewer = camera.viewer();
        let back = pose.rotation.inverse();
        // Q30 to Q16.
        let short = |vector: Vector| back.turn(vector).0.map(|c| (c + (1 << 13)) >> 14);
        let half = Vector::unit(self.direction + viewer).map_or([0; 3], short);
        Far { rays: Rays { light: short(self.direction), half, viewer: short(viewer) }, intensity: self.intensity }
    }
}

/// A directional light in the space of an object.
#[derive(Clone, Copy, Debug)]
pub struct Far {
    rays: Rays,
    /// Q15.
    intensity: u16,
}

impl Aim for Far {
    #[inline(always)]
    fn rays(&self, _: [i16; 3]) -> Rays {
        self.rays
    }

    fn ways(&self, _: [i32; 3]) -> [[i32; 3]; 2] {
        [self.rays.light, self.rays.viewer]
    }

    #[inline(always)]
    fn dots(&self, _: [i16; 3], normal: [i16; 3]) -> [i16; 2] {
        self.rays.dots(normal, self.intensity)
    }
}

/// A light of white colour in a scene that the viewer is in, too: directions change from place to place.
///
/// *Faster Phong Shading*, §3.5; *Adaptive Shading*, §2. It does not get weaker with distance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SceneLight {
    place: Place,
    /// Q15.
    intensity: u16,
}

/// Where a light is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Place {
    /// At a point of the world.
    Point([Length; 3]),
    /// In a direction, infinitely far.
    Direction(Vector),
}

impl SceneLight {
    /// A light of full intensity at that place in the world.
    #[must_use]
    pub const fn point([x, y, z]: [f32; 3]) -> Self {
        Self { place: Place::Point([length(x), length(y), length(z)]), intensity: 1 << 15 }
    }

    /// A light of full intensity from that direction, as [`Light::directional`], for a viewer in the scene.
    #[must_use]
    pub fn directional(towards: [f32; 3]) -> Self {
        match Vector::unit_f32(towards) {
            Some(direction) => Self { place: Place::Direction(direction), intensity: 1 << 15 },
            None => Self::OFF,
        }
    }

    /// No light.
    pub const OFF: Self = Self { place: Place::Direction(Vector([0; 3])), intensity: 0 };

    /// The same with another intensity, 0.0 to 1.0, clamped.
    #[must_use]
    pub const fn intensity(mut self, intensity: f32) -> Self {
        self.intensity = strength(intensity);
        self
    }
}

impl LightSource for SceneLight {
    type Aim = Near;
    type Product = Quadratic;
    type Change<T: Copy + Debug> = Option<T>;
    type PerProduct<T: Blank, const LIGHTS: usize> = [[T; 2]; LIGHTS];
    const IN_SCENE: bool = true;
    const OFF: Self = Self::OFF;

    fn strength(&self) -> u16 {
        self.intensity
    }

    fn aim(&self, camera: &Camera, mesh: &Mesh<'_>, pose: &Pose) -> Near {
        let light = match self.place {
            Place::Point(place) => Spot::Place(pose.back(place, mesh.data.extent)),
            Place::Direction(direction) => {
                Spot::Direction(pose.rotation.inverse().turn(direction).0.map(|c| (c + (1 << 13)) >> 14))
            }
        };
        Near { light, viewer: pose.back(camera.place(), mesh.data.extent), intensity: self.intensity }
    }
}

/// A light and a viewer in the scene, in the space of an object.
#[derive(Clone, Copy, Debug)]
pub struct Near {
    light: Spot,
    /// 2⁻¹⁶ of the mesh's extent.
    viewer: [i32; 3],
    /// Q15.
    intensity: u16,
}

/// Where a light is, as an object sees it.
#[derive(Clone, Copy, Debug)]
enum Spot {
    /// 2⁻¹⁶ of the mesh's extent.
    Place([i32; 3]),
    /// A unit vector, Q16.
    Direction([i32; 3]),
}

impl Aim for Near {
    fn rays(&self, position: [i16; 3]) -> Rays {
        if self.intensity == 0 {
            return Rays::NONE;
        }
        let towards = |[x, y, z]: [i32; 3]| {
            let [px, py, pz] = position.map(|c| 2 * i32::from(c));
            unit([x.saturating_sub(px), y.saturating_sub(py), z.saturating_sub(pz)])
        };
        let light = match self.light {
            Spot::Place(place) => towards(place),
            Spot::Direction(direction) => direction,
        };
        let viewer = towards(self.viewer);
        let ([lx, ly, lz], [vx, vy, vz]) = (light, viewer);
        Rays { light, half: unit([lx + vx, ly + vy, lz + vz]), viewer }
    }

    fn ways(&self, [px, py, pz]: [i32; 3]) -> [[i32; 3]; 2] {
        let towards = |[x, y, z]: [i32; 3]| [x.saturating_sub(px), y.saturating_sub(py), z.saturating_sub(pz)];
        let light = match self.light {
            Spot::Place(place) => towards(place),
            Spot::Direction(direction) => direction,
        };
        [light, towards(self.viewer)]
    }

    #[inline]
    fn dots(&self, position: [i16; 3], normal: [i16; 3]) -> [i16; 2] {
        self.rays(position).dots(normal, self.intensity)
    }
}

/// 0.0 … 1.0 to Q15, rounded, clamped.
const fn strength(intensity: f32) -> u16 {
    let scaled = (intensity * 32768.0 + 0.5) as u16;
    if scaled > 1 << 15 {
        1 << 15
    } else {
        scaled
    }
}
