//! A picture on the OLED of TI's LM3S6965 board, one line at a time: no frame buffer, two pixels a byte.
//!
//! In QEMU: `cargo run --release --features emulator`. The features and the wiring are in Cargo.toml and `oled.rs`.
#![no_std]
#![no_main]

#[cfg(feature = "emulator")]
mod emulator;
mod oled;

use oled::{Oled, Row};
use panic_halt as _;

#[cortex_m_rt::entry]
fn main() -> ! {
    let mut oled = Oled::init();
    let mut row: Row = [0; oled::ROW_BYTES];
    let mut frame = 0u32;
    loop {
        oled.begin_frame();
        for y in 0..oled::HEIGHT {
            render(frame, y, &mut row);
            oled.send(&row);
        }
        #[cfg(feature = "emulator")]
        emulator::shown(frame);
        frame = frame.wrapping_add(1);
    }
}

/// A gradient that moves, until the library renders here.
fn render(frame: u32, y: usize, row: &mut Row) {
    let grey = |x: usize| ((x + y + frame as usize) % 16) as u8;
    for (pair, byte) in row.iter_mut().enumerate() {
        *byte = grey(2 * pair) << 4 | grey(2 * pair + 1);
    }
}
