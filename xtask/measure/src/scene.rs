//! The scenes: Newell's teapot of 880 triangles, turning once, in Rgb565.

use beamshade::{Camera, Frame, Lines, Pose, Rotation, Scanner, Turn};
use embedded_graphics::{
    geometry::Size,
    pixelcolor::{Rgb565, RgbColor},
};

include!(concat!(env!("OUT_DIR"), "/teapot-880.rs"));

#[cfg(feature = "phong")]
type Method = beamshade::Phong;
#[cfg(feature = "phong-planes")]
type Method = beamshade::PhongPlanes;
#[cfg(feature = "duff-direct")]
type Method = beamshade::DuffDirect;
#[cfg(feature = "duff-differences")]
type Method = beamshade::DuffDifferences;
#[cfg(feature = "duff-barycentric")]
type Method = beamshade::DuffBarycentric;
#[cfg(feature = "gouraud")]
type Method = beamshade::Gouraud;
#[cfg(feature = "flat")]
type Method = beamshade::Flat;

#[cfg(feature = "parts")]
type Shading = crate::parts::Parts<Method>;
#[cfg(not(feature = "parts"))]
type Shading = Method;

/// T880: 240×240 pixels, one directional light.
#[cfg(any(feature = "t880", feature = "t880-parts"))]
mod setting {
    use beamshade::Light;

    pub(super) type Source = Light;
    pub(super) const LIGHTS: usize = 1;
    pub(super) const SIZE: usize = 240;
    pub(super) const FRAMES: u16 = if cfg!(feature = "parts") { 4 } else { 60 };
    /// Triangles that face the eye in the worst frame, and that cross the worst line.
    pub(super) const SEEN: usize = 488;
    pub(super) const ACTIVE: usize = 65;

    pub(super) fn lights() -> [Light; LIGHTS] {
        [Light::directional([-0.5, 0.7, 0.6])]
    }
}

/// The same under four directional lights.
#[cfg(feature = "t880-four-lights")]
mod setting {
    use beamshade::Light;

    pub(super) type Source = Light;
    pub(super) const LIGHTS: usize = 4;
    pub(super) const SIZE: usize = 240;
    pub(super) const FRAMES: u16 = 12;
    pub(super) const SEEN: usize = 488;
    pub(super) const ACTIVE: usize = 65;

    pub(super) fn lights() -> [Light; LIGHTS] {
        let light = |towards| Light::directional(towards).intensity(0.4);
        [light([-0.5, 0.7, 0.6]), light([0.7, 0.4, 0.6]), light([0.0, -0.5, 0.8]), light([-0.8, 0.1, 0.3])]
    }
}

/// The same with one point light and the viewer in the scene.
#[cfg(any(feature = "t880-point-light", feature = "t880-point-parts"))]
mod setting {
    use beamshade::SceneLight;

    pub(super) type Source = SceneLight;
    pub(super) const LIGHTS: usize = 1;
    pub(super) const SIZE: usize = 240;
    pub(super) const FRAMES: u16 = if cfg!(feature = "parts") { 4 } else { 12 };
    pub(super) const SEEN: usize = 488;
    pub(super) const ACTIVE: usize = 65;

    pub(super) fn lights() -> [SceneLight; LIGHTS] {
        [SceneLight::point([-1.5, 2.1, 1.8])]
    }
}

use setting::{lights, Source, ACTIVE, FRAMES, LIGHTS, SEEN, SIZE};

type TeapotFrame = Frame<'static, 481, SEEN, SIZE, LIGHTS, 1, 0, Source>;
type TeapotScanner = Scanner<ACTIVE, Shading, LIGHTS, Source>;
type Row = [Rgb565; SIZE];

/// A measured scene: all state that rendering it needs, and one row of pixels.
#[derive(Debug)]
pub struct Scene {
    frame: TeapotFrame,
    scanner: TeapotScanner,
    row: Row,
}

impl Scene {
    /// Frames that are measured: a whole turn.
    pub const FRAMES: u16 = FRAMES;
    /// Lines of a frame.
    pub const LINES: u16 = SIZE as u16;
    /// Bytes of the mesh, which lies in flash and does not count as code.
    pub const MESH_BYTES: usize = 481 * 12 + 880 * 12 + 4;
    /// What lies in RAM, by type, with its size in bytes.
    pub const RAM: &'static [(&'static str, usize)] =
        &[("Frame", size_of::<TeapotFrame>()), ("Scanner", size_of::<TeapotScanner>()), ("rows", 2 * size_of::<Row>())];

    /// A scene of which no frame was prepared yet.
    pub const fn new() -> Self {
        Scene { frame: Frame::new(), scanner: Scanner::new(), row: [Rgb565::BLACK; SIZE] }
    }

    /// All that is done once for a frame; false if something had no room.
    #[inline(never)]
    pub fn prepare(&mut self, step: u16) -> bool {
        let camera = Camera::new(Size::new(SIZE as u32, SIZE as u32)).field_of_view(Turn::degrees(40)).at_distance(2.45);
        let turn = Turn::degrees(i32::from(step) * 360 / i32::from(FRAMES));
        let rotation = Rotation::x(Turn::degrees(25)) * Rotation::y(turn);
        self.frame.begin(&camera, &lights()).is_ok() && self.frame.add(&TEAPOT, &Pose::turned(rotation)).is_ok()
    }

    /// The lines of the frame that was prepared, and a row for them.
    pub fn lines(&mut self) -> (Lines<'_, ACTIVE, Shading, LIGHTS, Source>, &mut Row) {
        (self.scanner.start(self.frame.picture()), &mut self.row)
    }
}

impl Default for Scene {
    fn default() -> Self {
        Self::new()
    }
}
