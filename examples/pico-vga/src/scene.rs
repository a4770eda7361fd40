//! What is shown.

use beamshade::{Background, Camera, Color, Frame, Light, Pose, Rotation, Turn};
use embedded_graphics::geometry::Size;

use crate::vga::{HEIGHT, WIDTH};

// `static TEAPOT`, made from an OBJ file by build.rs.
#[cfg(not(feature = "ring"))]
include!(concat!(env!("OUT_DIR"), "/teapot-880.rs"));
#[cfg(feature = "ring")]
include!(concat!(env!("OUT_DIR"), "/teapot-216.rs"));

/// Teapots.
pub const TEAPOTS: usize = if cfg!(feature = "heavy") { 3 } else { 1 };
/// For how many triangles or pairs there is room on one line.
pub const ACTIVE: usize = if cfg!(feature = "heavy") { 64 } else { 48 };
/// From the eye: as near as the rows of a teapot can be shaded in time; the ring's is nearer, to be late.
const DISTANCE: f32 = if cfg!(feature = "heavy") {
    6.2
} else if cfg!(feature = "ring") {
    2.45
} else {
    5.5
};

/// How it is shaded: a row has 8000 cycles, which is too short for more at this size.
#[cfg(not(feature = "ring"))]
pub type Method = beamshade::Flat;
/// How it is shaded: by the default, late or not.
#[cfg(all(feature = "ring", not(feature = "degrade")))]
pub type Method = beamshade::DuffBarycentric;
/// How it is shaded: by the default, or by what the plan says.
#[cfg(feature = "degrade")]
pub type Method = beamshade::Degrading;

/// One frame's geometry: vertices, triangles or pairs that face the eye, lines.
pub type Geometry = Frame<'static, { TEAPOTS * 481 }, { TEAPOTS * 320 }, { HEIGHT as usize }>;

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
