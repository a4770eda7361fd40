//! The scene T880: Newell's teapot of 880 triangles, turning in 60 frames, in Rgb565.

use beamshade::{Camera, Frame, Light, Lines, Pose, Rotation, Scanner, Turn};
use embedded_graphics::{
    geometry::Size,
    pixelcolor::{Rgb565, RgbColor},
};

include!(concat!(env!("OUT_DIR"), "/teapot-880.rs"));

#[cfg(feature = "duff-barycentric")]
type Method = beamshade::DuffBarycentric;
#[cfg(feature = "gouraud")]
type Method = beamshade::Gouraud;
#[cfg(feature = "flat")]
type Method = beamshade::Flat;

/// Room for what T880 needs: the worst frame has 487 triangles that face the eye, the worst line 65 that cross it.
type TeapotFrame = Frame<'static, 481, 488, 240, 1, 1, 0>;
type TeapotScanner = Scanner<65, Method>;
type Row = [Rgb565; 240];

/// A measured scene: all state that rendering it needs, and one row of pixels.
#[derive(Debug)]
pub struct Scene {
    frame: TeapotFrame,
    scanner: TeapotScanner,
    row: Row,
}

impl Scene {
    /// Frames that are measured.
    pub const FRAMES: u16 = 60;
    /// Lines of a frame.
    pub const LINES: u16 = 240;
    /// Bytes of the mesh, which lies in flash and does not count as code.
    pub const MESH_BYTES: usize = 481 * 12 + 880 * 12 + 4;
    /// What lies in RAM, by type, with its size in bytes.
    pub const RAM: &'static [(&'static str, usize)] =
        &[("Frame", size_of::<TeapotFrame>()), ("Scanner", size_of::<TeapotScanner>()), ("rows", 2 * size_of::<Row>())];

    /// A scene of which no frame was prepared yet.
    pub const fn new() -> Self {
        Scene { frame: Frame::new(), scanner: Scanner::new(), row: [Rgb565::BLACK; 240] }
    }

    /// All that is done once for a frame; false if something had no room.
    #[inline(never)]
    pub fn prepare(&mut self, step: u16) -> bool {
        let camera = Camera::new(Size::new(240, 240)).field_of_view(Turn::degrees(40)).at_distance(2.45);
        let light = Light::directional([-0.5, 0.7, 0.6]);
        let rotation = Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(6 * i32::from(step)));
        self.frame.begin(&camera, &[light]).is_ok() && self.frame.add(&TEAPOT, &Pose::turned(rotation)).is_ok()
    }

    /// The lines of the frame that was prepared, and a row for them.
    pub fn lines(&mut self) -> (Lines<'_, 65, Method>, &mut Row) {
        (self.scanner.start(self.frame.picture()), &mut self.row)
    }
}

impl Default for Scene {
    fn default() -> Self {
        Self::new()
    }
}
