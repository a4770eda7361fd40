//! The teapot turning on an ST7789 panel at a Raspberry Pi Pico 2: the DMA sends one row while the core shades the next.
#![no_std]
#![no_main]

use beamshade::{Camera, Frame, Light, Pose, Rotation, Scanner, Turn};
use core::mem::swap;
use embassy_executor::Spawner;
use embassy_futures::join::join;
use embassy_rp::gpio::{Level, Output};
use embassy_rp::spi::{self, Phase, Polarity, Spi};
use embassy_rp::{bind_interrupts, dma, peripherals::DMA_CH0};
use embassy_time::Delay;
use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use embedded_hal_async::spi::SpiDevice;
use embedded_hal_bus::spi::ExclusiveDevice;
use mipidsi::{interface::SpiInterface, models::ST7789, options::ColorInversion, Builder};
use panic_halt as _;

// `static TEAPOT`, made from the OBJ file by build.rs.
include!(concat!(env!("OUT_DIR"), "/teapot-880.rs"));

/// Pixels of the panel, both ways.
const SIDE: u16 = 240;
/// The panel's command for pixels: they fill its window from the top.
const MEMORY_WRITE: u8 = 0x2c;

bind_interrupts!(struct Interrupts { DMA_IRQ_0 => dma::InterruptHandler<DMA_CH0>; });

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    let chip = embassy_rp::init(Default::default());
    let mut config = spi::Config::default();
    config.frequency = 37_500_000;
    (config.polarity, config.phase) = (Polarity::IdleHigh, Phase::CaptureOnSecondTransition);
    let bus = Spi::new_txonly(chip.SPI0, chip.PIN_18, chip.PIN_19, chip.DMA_CH0, Interrupts, config);
    let select = Output::new(chip.PIN_17, Level::High);
    let dc = Output::new(chip.PIN_20, Level::High);
    let reset = Output::new(chip.PIN_21, Level::High);
    let _backlight = Output::new(chip.PIN_22, Level::High);

    // mipidsi wakes the panel and sets its window to the whole of it; then bus and D/C are ours.
    let mut buffer = [0; 64];
    let panel = SpiInterface::new(ExclusiveDevice::new_no_delay(bus, select).unwrap(), dc, &mut buffer);
    let panel = Builder::new(ST7789, panel).reset_pin(reset).display_size(SIDE, SIDE).invert_colors(ColorInversion::Inverted);
    let mut panel = panel.init(&mut Delay).ok().unwrap();
    panel.clear(Rgb565::BLACK).ok().unwrap();
    let (mut spi, mut dc) = panel.release().0.release();

    let camera = Camera::new(Size::new_equal(SIDE.into())).field_of_view(Turn::degrees(40)).at_distance(2.45);
    let light = Light::directional([-0.5, 0.7, 0.6]);
    let mut frame = Frame::<481, 320, { SIDE as usize }>::new(); // vertices, triangles or pairs that face the eye, lines
    let mut scanner = Scanner::<48>::new(); // triangles or pairs that cross one line
                                            // Rgb565, high byte first.
    let (mut shading, mut sending) = (&mut [[0; 2]; SIDE as usize], &mut [[0; 2]; SIDE as usize]);
    for step in 0.. {
        let rotation = Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(6 * (step % 60)));
        // What has no room is left out of the picture, and what the port could not send comes with the next one: there is
        // nobody here to tell.
        let _ = frame.begin(&camera, &[light]);
        let _ = frame.add(&TEAPOT, &Pose::turned(rotation));
        let mut lines = scanner.start(frame.picture());
        dc.set_low();
        let _ = spi.write(&[MEMORY_WRITE]).await;
        dc.set_high();
        lines.line(0, sending);
        for y in 1..=SIDE {
            // The line below the picture costs nothing.
            let _ = join(spi.write(sending.as_flattened()), async { lines.line(y, shading) }).await;
            swap(&mut shading, &mut sending);
        }
    }
}
