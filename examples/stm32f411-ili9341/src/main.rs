//! The teapot turning on an ILI9341 panel at an STM32F411 "Black Pill": the DMA sends one row while the core shades the next.
#![no_std]
#![no_main]

use beamshade::{Camera, Frame, Light, Pose, Rotation, Scanner, Turn};
use core::mem::swap;
use embassy_executor::Spawner;
use embassy_futures::join::join;
use embassy_stm32::gpio::{Level, Output, Speed};
use embassy_stm32::spi::{self, Spi};
use embassy_stm32::{bind_interrupts, dma, peripherals::DMA2_CH3, rcc, time::mhz, Config};
use embassy_time::Delay;
use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use embedded_hal_async::spi::SpiDevice;
use embedded_hal_bus::spi::ExclusiveDevice;
use mipidsi::options::{ColorOrder, Orientation, Rotation as Turned};
use mipidsi::{interface::SpiInterface, models::ILI9341Rgb565, Builder};
use panic_halt as _;

// `static TEAPOT`, made from the OBJ file by build.rs.
include!(concat!(env!("OUT_DIR"), "/teapot-880.rs"));

/// Pixels of the panel, lying on its side.
const WIDTH: usize = 320;
const HEIGHT: usize = 240;
/// The panel's command for pixels: they fill its window from the top.
const MEMORY_WRITE: u8 = 0x2c;

bind_interrupts!(struct Interrupts { DMA2_STREAM3 => dma::InterruptHandler<DMA2_CH3>; });

#[embassy_executor::main]
async fn main(_spawner: Spawner) {
    let chip = embassy_stm32::init(clocks());
    let mut config = spi::Config::default();
    config.frequency = mhz(25);
    let bus = Spi::new_txonly(chip.SPI1, chip.PA5, chip.PA7, chip.DMA2_CH3, Interrupts, config);
    let select = Output::new(chip.PA4, Level::High, Speed::VeryHigh);
    let dc = Output::new(chip.PA3, Level::High, Speed::VeryHigh);
    let reset = Output::new(chip.PA2, Level::High, Speed::Low);

    // mipidsi wakes the panel and sets its window to the whole of it; then bus and D/C are ours.
    let mut buffer = [0; 64];
    let panel = SpiInterface::new(ExclusiveDevice::new_no_delay(bus, select).unwrap(), dc, &mut buffer);
    let sideways = Orientation::new().rotate(Turned::Deg90).flip_vertical();
    let panel = Builder::new(ILI9341Rgb565, panel).reset_pin(reset).color_order(ColorOrder::Bgr).orientation(sideways);
    let mut panel = panel.init(&mut Delay).ok().unwrap();
    panel.clear(Rgb565::BLACK).ok().unwrap();
    let (mut spi, mut dc) = panel.release().0.release();

    let camera = Camera::new(Size::new(WIDTH as u32, HEIGHT as u32)).field_of_view(Turn::degrees(40)).at_distance(2.45);
    let light = Light::directional([-0.5, 0.7, 0.6]);
    let mut frame = Frame::<481, 320, HEIGHT>::new(); // vertices, triangles or pairs that face the eye, lines
    let mut scanner = Scanner::<48>::new(); // triangles or pairs that cross one line
    let (mut shading, mut sending) = (&mut [[0; 2]; WIDTH], &mut [[0; 2]; WIDTH]); // Rgb565, high byte first
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
        for y in 1..=HEIGHT as u16 {
            // The line below the picture costs nothing.
            let _ = join(spi.write(sending.as_flattened()), async { lines.line(y, shading) }).await;
            swap(&mut shading, &mut sending);
        }
    }
}

/// 100 MHz from the board's crystal.
fn clocks() -> Config {
    let mut config = Config::default();
    let clocks = &mut config.rcc;
    clocks.hse = Some(rcc::Hse { freq: mhz(25), mode: rcc::HseMode::Oscillator });
    clocks.pll_src = rcc::PllSource::HSE;
    clocks.pll = Some(rcc::Pll {
        prediv: rcc::PllPreDiv::DIV25,
        mul: rcc::PllMul::MUL200,
        divp: Some(rcc::PllPDiv::DIV2),
        divq: None,
        divr: None,
    });
    clocks.sys = rcc::Sysclk::PLL1_P;
    clocks.apb1_pre = rcc::APBPrescaler::DIV2;
    config
}
