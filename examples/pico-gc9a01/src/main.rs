//! The teapot turning on a round 240×240 GC9A01 at a Raspberry Pi Pico: one line is shaded while the one before it is sent by DMA.
//!
//! There is no frame buffer: two rows of 240 pixels change places, and belong to the DMA while they are sent. The wiring is in
//! the README.
#![no_std]
#![no_main]

use beamshade::{Camera, Frame, Light, Overlay, Pose, Rotation, Scanner, Turn};
use core::fmt::Write;
use cortex_m::singleton;
use embedded_graphics::{
    framebuffer::buffer_size,
    mono_font::{ascii::FONT_6X10, MonoTextStyle},
    pixelcolor::{BinaryColor, Rgb565},
    prelude::*,
    text::{Baseline, Text},
};
use embedded_hal::{
    digital::OutputPin,
    spi::{SpiBus, MODE_3},
};
use embedded_hal_bus::spi::ExclusiveDevice;
use heapless::String;
use mipidsi::{
    interface::SpiInterface,
    models::GC9A01,
    options::{ColorInversion, ColorOrder},
    Builder,
};
use panic_halt as _;
use rp2040_hal::{
    clocks::init_clocks_and_plls,
    dma::{single_buffer::Config, DMAExt},
    fugit::RateExtU32,
    gpio::{FunctionSpi, Pins},
    pac, Clock, Sio, Spi, Timer, Watchdog,
};

// `static TEAPOT`, made from the OBJ file by build.rs.
include!(concat!(env!("OUT_DIR"), "/teapot-880.rs"));

/// The boot ROM runs this first: it makes the Pico's flash readable as memory.
#[link_section = ".boot2"]
#[used]
static BOOT2_FIRMWARE: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// The width and the height of the panel.
const SIDE: usize = 240;
/// The panel's commands "nothing" and "what follows are pixels, from the top left on", a word of two.
const WRITE_MEMORY: u16 = 0x002c;
/// Frames for which a text stays: frames per second, and the longest time that a line took.
const TEXT_FRAMES: i32 = 8;

#[rp2040_hal::entry]
fn main() -> ! {
    // The chip at 125 MHz, and what of it is used: a timer, pins, one channel of the DMA, one SPI port.
    let mut chip = pac::Peripherals::take().unwrap();
    let resets = &mut chip.RESETS;
    let mut watchdog = Watchdog::new(chip.WATCHDOG);
    let (xosc, pll_sys, pll_usb) = (chip.XOSC, chip.PLL_SYS, chip.PLL_USB);
    let clocks = init_clocks_and_plls(12_000_000, xosc, chip.CLOCKS, pll_sys, pll_usb, resets, &mut watchdog).ok().unwrap();
    let mut timer = Timer::new(chip.TIMER, resets, &clocks);
    let pins = Pins::new(chip.IO_BANK0, chip.PADS_BANK0, Sio::new(chip.SIO).gpio_bank0, resets);
    let channel = chip.DMA.split(resets).ch0;
    let (mut cs, mut dc) = (pins.gpio17.into_push_pull_output(), pins.gpio20.into_push_pull_output());
    let reset = pins.gpio21.into_push_pull_output();
    let wires = (pins.gpio19.into_function::<FunctionSpi>(), pins.gpio18.into_function::<FunctionSpi>());
    // In mode 3 this port sends word after word without a pause; in mode 0 it pauses between any two.
    let (clock, fastest) = (clocks.peripheral_clock.freq(), 62_500_000u32.Hz());
    let mut spi = Spi::<_, _, _, 8>::new(chip.SPI0, wires).init(resets, clock, fastest, MODE_3);

    // The driver sets the panel up, clears it, and leaves it with the window set to all of it.
    let mut buffer = [0; 2 * SIDE];
    let device = ExclusiveDevice::new_no_delay(&mut spi, &mut cs).unwrap();
    let builder = Builder::new(GC9A01, SpiInterface::new(device, &mut dc, &mut buffer)).reset_pin(reset);
    let builder = builder.invert_colors(ColorInversion::Inverted).color_order(ColorOrder::Bgr);
    builder.init(&mut timer).unwrap().clear(Rgb565::BLACK).unwrap();
    // Pixels go in words of 16 bits.
    let (port, wires) = spi.disable().free();
    let spi = Spi::<_, _, _, 16>::new(port, wires).init(resets, clock, fastest, MODE_3);
    cs.set_low().unwrap();

    // Vertices, triangles or pairs that face the eye, lines; then triangles or pairs that cross one line.
    let frame = singleton!(: Frame<'static, 481, 320, SIDE> = Frame::new()).unwrap();
    let scanner = singleton!(: Scanner<48> = Scanner::new()).unwrap();
    let [mut row, other] = singleton!(: [[u16; SIDE]; 2] = [[0; SIDE]; 2]).unwrap().each_mut();
    let camera = Camera::new(Size::new_equal(SIDE as u32)).field_of_view(Turn::degrees(40)).at_distance(2.45);
    let light = Light::directional([-0.5, 0.7, 0.6]);
    let mut overlay = Overlay::<84, 10, { buffer_size::<BinaryColor>(84, 10) }>::new(Point::new(78, 220));

    // From here on one row is always being sent; this one, before the first frame begins, is black on black.
    let mut sending = Config::new(channel, other, spi).start();
    let (mut step, mut begin, mut worst) = (0, timer.get_counter_low(), 0);
    loop {
        let rotation = Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(6 * step));
        // What has no room is left out of the picture: there is nobody here to tell.
        let _ = frame.begin(&camera, &[light]);
        let _ = frame.add(&TEAPOT, &Pose::turned(rotation));
        let mut lines = scanner.start(frame.picture());
        for y in 0..SIDE as u16 {
            let start = timer.get_counter_low();
            lines.line(y, row);
            overlay.blit(y, row, 0xffff);
            worst = worst.max(timer.get_counter_low().wrapping_sub(start));

            let (channel, sent, mut spi) = sending.wait();
            if y == 0 {
                // D/C says whether words are commands or pixels; the last ones may still be on their way.
                spi.flush().unwrap();
                dc.set_low().unwrap();
                spi.write(&[WRITE_MEMORY]).unwrap();
                spi.flush().unwrap();
                dc.set_high().unwrap();
            }
            sending = Config::new(channel, row, spi).start();
            row = sent;
        }

        step += 1;
        if step % TEXT_FRAMES == 0 {
            let time = timer.get_counter_low().wrapping_sub(begin);
            let mut text = String::<14>::new();
            let _ = write!(text, "{} fps, {worst} us", TEXT_FRAMES as u32 * 1_000_000 / time);
            let style = MonoTextStyle::new(&FONT_6X10, BinaryColor::On);
            let _ = overlay.clear(BinaryColor::Off);
            let _ = Text::with_baseline(&text, Point::zero(), style, Baseline::Top).draw(&mut overlay);
            (begin, worst) = (timer.get_counter_low(), 0);
        }
    }
}
