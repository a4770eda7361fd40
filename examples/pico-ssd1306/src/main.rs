//! The teapot turning on the SSD1306 OLED of a Raspberry Pi Pico: lines in grey, dithered to one bit, eight of them a page.
#![no_std]
#![no_main]

use beamshade::{Camera, Frame, Light, Page, Pose, Rotation, Scanner, Turn};
use embedded_graphics::{geometry::Size, pixelcolor::Gray8, prelude::GrayColor};
use fugit::RateExtU32;
use panic_halt as _;
use rp2040_hal::clocks::{init_clocks_and_plls, Clock};
use rp2040_hal::gpio::{FunctionI2C, Pins, PullUp};
use rp2040_hal::{pac::Peripherals, Sio, Watchdog, I2C};
use ssd1306::command::AddrMode;
use ssd1306::{prelude::*, I2CDisplayInterface, Ssd1306};

// `static TEAPOT`, made from the OBJ file by build.rs.
include!(concat!(env!("OUT_DIR"), "/teapot-880.rs"));

/// The second-stage boot loader, for the flash chip of the Pico.
#[link_section = ".boot2"]
#[no_mangle]
static BOOT2_FIRMWARE: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// The board's crystal, Hz.
const CRYSTAL: u32 = 12_000_000;

#[rp2040_hal::entry]
fn main() -> ! {
    let chip = Peripherals::take().unwrap();
    let (mut resets, mut watchdog) = (chip.RESETS, Watchdog::new(chip.WATCHDOG));
    let clocks = init_clocks_and_plls(CRYSTAL, chip.XOSC, chip.CLOCKS, chip.PLL_SYS, chip.PLL_USB, &mut resets, &mut watchdog)
        .ok()
        .unwrap();
    let pins = Pins::new(chip.IO_BANK0, chip.PADS_BANK0, Sio::new(chip.SIO).gpio_bank0, &mut resets);
    let data = pins.gpio4.reconfigure::<FunctionI2C, PullUp>();
    let clock = pins.gpio5.reconfigure::<FunctionI2C, PullUp>();
    let i2c = I2C::i2c0(chip.I2C0, data, clock, 400.kHz(), &mut resets, clocks.system_clock.freq());

    // Its window is the whole panel, and bytes fill it page by page, again and again.
    let mut panel = Ssd1306::new(I2CDisplayInterface::new(i2c), DisplaySize128x64, DisplayRotation::Rotate0);
    panel.init_with_addr_mode(AddrMode::Horizontal).unwrap();

    let camera = Camera::new(Size::new(128, 64)).field_of_view(Turn::degrees(40)).at_distance(2.2);
    let light = Light::directional([-0.5, 0.7, 0.6]);
    let mut frame = Frame::<481, 320, 64>::new(); // vertices, triangles or pairs that face the eye, lines
    let mut scanner = Scanner::<48>::new(); // triangles or pairs that cross one line
    let mut row = [Gray8::BLACK; 128];
    let mut page = Page::<128>::new();
    let mut step = 0;
    loop {
        let rotation = Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(6 * step));
        // What has no room is left out of the picture, and what the panel does not take comes with the next one: there is
        // nobody here to tell.
        let _ = frame.begin(&camera, &[light]);
        let _ = frame.add(&TEAPOT, &Pose::turned(rotation));
        let mut lines = scanner.start(frame.picture());
        let _ = panel.set_draw_area((0, 0), (128, 64));
        for y in 0..64 {
            lines.line(y, &mut row);
            if let Some(bytes) = page.add(y, &row) {
                let _ = panel.draw(bytes);
            }
        }
        step = (step + 1) % 60;
    }
}
