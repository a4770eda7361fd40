//! The teapot turning on the OLED of TI's LM3S6965 board, one line at a time: no frame buffer, two pixels a byte.
//!
//! In QEMU: `cargo run --release --features emulator`. The features and the wiring are in Cargo.toml and `oled.rs`.
#![no_std]
#![no_main]

#[cfg(feature = "emulator")]
mod emulator;
mod oled;

use beamshade::{Camera, Frame, Light, Pose, Rotation, Scanner, Turn};
use embedded_graphics::{
    geometry::Size,
    pixelcolor::{Gray4, GrayColor},
};
use oled::Oled;
use panic_halt as _;

// `static TEAPOT`, made from the OBJ file by build.rs.
include!(concat!(env!("OUT_DIR"), "/teapot-880.rs"));

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut oled = Oled::init();
    let camera = Camera::new(Size::new(128, 64)).field_of_view(Turn::degrees(40)).at_distance(2.2);
    let light = Light::directional([-0.5, 0.7, 0.6]);
    let mut frame = Frame::<481, 320, 64>::new(); // vertices, triangles or pairs that face the eye, lines
    let mut scanner = Scanner::<48>::new(); // triangles or pairs that cross one line
    let mut row = [Gray4::BLACK; 128];
    let mut bytes = [0; oled::ROW_BYTES];
    let mut step = 0;
    loop {
        let rotation = Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(6 * step));
        // What has no room is left out of the picture: there is nobody here to tell.
        let _ = frame.begin(&camera, &[light]);
        let _ = frame.add(&TEAPOT, &Pose::turned(rotation));
        let mut lines = scanner.start(frame.picture());
        oled.begin_frame();
        for y in 0..64 {
            lines.line(y, &mut row);
            for (byte, [left, right]) in bytes.iter_mut().zip(row.as_chunks().0) {
                *byte = left.luma() << 4 | right.luma();
            }
            oled.send(&bytes);
        }
        #[cfg(feature = "emulator")]
        emulator::shown(step as u32);
        step += 1;
    }
}
