//! What is shown.

use beamshade::{Background, Camera, Color, Flat, Frame, Light, Pose, Rotation, Turn};
use embedded_graphics::geometry::Size;

use crate::vga::{HEIGHT, WIDTH};

// `static TEAPOT`, made from the OBJ file by build.rs.
include!(concat!(env!("OUT_DIR"), "/teapot-880.rs"));

/// Teapots.
pub const TEAPOTS: usize = if cfg!(feature = "heavy") { 3 } else { 1 };
/// For how many triangles there is room on one line.
pub const ACTIVE: usize = if cfg!(feature = "heavy") { 96 } else { 72 };
/// From the eye: as near as the rows of a teapot can be shaded in time.
const DISTANCE: f32 = if cfg!(feature = "heavy") { 6.2 } else { 5.5 };

/// How it is shaded: a row has 8000 cycles, which is too short for more at this size.
pub type Method = Flat;

/// One frame's geometry: vertices, triangles that face the eye, lines.
pub type Geometry = Frame<'static, { TEAPOTS * 481 }, { TEAPOTS * 512 }, { HEIGHT as usize }>;

/// Fills the background; all frames keep it.
pub fn prepare(frame: &mut Geometry) {
    frame.background(Background::Gradient { top: color(0.02, 0.03, 0.10), bottom: color(0.25, 0.30, 0.40) });
}

/// Begins the next frame, and adds what is seen in it: the teapot, turned by 6° a frame; or three, one above the other.
pub fn describe(frame: &mut Geometry, step: i32) {
    let camera = Camera::new(Size::new(WIDTH as u32, HEIGHT.into())).field_of_view(Turn::degrees(40)).at_distance(DISTANCE);
    // What has no room is left out of the picture: there is nobody here to tell.
    let _ = frame.begin(&camera, &[Light::directional([-0.5, 0.7, 0.6])]);
    for number in 0..TEAPOTS as i32 {
        let turned = Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(6 * step + 120 * number));
        let pose = Pose::turned(turned);
        let _ = frame.add(
            &TEAPOT,
            &if TEAPOTS == 1 { pose } else { pose.at([(number - 1) as f32 * 0.9, (number - 1) as f32 * 1.4, 0.0]) },
        );
    }
}

/// A colour as it comes out: the pins that carry red on the Pico's VGA boards are those of blue in Rgb565, and the other way round.
const fn color(red: f32, green: f32, blue: f32) -> Color {
    Color::rgb(blue, green, red)
}
