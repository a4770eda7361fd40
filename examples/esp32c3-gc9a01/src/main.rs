//! The teapot turning on the round GC9A01 panel of an ESP32-C3: the DMA sends one row while the core shades the next.
#![no_std]
#![no_main]

use beamshade::{Camera, Frame, Light, Pose, Rotation, Scanner, Turn};
use core::{cell::RefCell, mem::swap};
use embedded_graphics::{pixelcolor::Rgb565, prelude::*};
use embedded_hal_bus::spi::RefCellDevice;
use esp_hal::gpio::{Level, Output, OutputConfig};
use esp_hal::spi::master::{Config, Spi};
use esp_hal::{clock::CpuClock, delay::Delay, dma_tx_buffer, time::Rate};
use mipidsi::options::{ColorInversion, ColorOrder};
use mipidsi::{interface::SpiInterface, models::GC9A01, Builder};
use panic_halt as _;

// `static TEAPOT`, made from the OBJ file by build.rs.
include!(concat!(env!("OUT_DIR"), "/teapot-880.rs"));

// What the boot loader wants to know of a program.
esp_bootloader_esp_idf::esp_app_desc!();

/// Pixels of the panel, both ways.
const SIDE: u16 = 240;
/// Two a pixel: Rgb565, high byte first.
const ROW_BYTES: usize = 2 * SIDE as usize;
/// The panel's command for pixels: they fill its window from the top.
const MEMORY_WRITE: u8 = 0x2c;

#[esp_hal::main]
fn main() -> ! {
    let chip = esp_hal::init(esp_hal::Config::default().with_cpu_clock(CpuClock::max()));
    let config = Config::default().with_frequency(Rate::from_mhz(80));
    let bus = Spi::new(chip.SPI2, config).unwrap().with_sck(chip.GPIO6).with_mosi(chip.GPIO7);
    let mut select = Output::new(chip.GPIO10, Level::High, OutputConfig::default());
    let dc = Output::new(chip.GPIO2, Level::High, OutputConfig::default());
    let _backlight = Output::new(chip.GPIO3, Level::High, OutputConfig::default());

    // mipidsi wakes the panel and sets its window to the whole of it; then bus and pins are ours.
    let bus = RefCell::new(bus);
    let mut buffer = [0; 64];
    let panel = SpiInterface::new(RefCellDevice::new_no_delay(&bus, &mut select).unwrap(), dc, &mut buffer);
    let panel = Builder::new(GC9A01, panel).color_order(ColorOrder::Bgr).invert_colors(ColorInversion::Inverted);
    let mut panel = panel.init(&mut Delay::new()).ok().unwrap();
    panel.clear(Rgb565::BLACK).ok().unwrap();
    let (_, mut dc) = panel.release().0.release();
    select.set_low();
    let mut spi = bus.into_inner().with_dma(chip.DMA_CH0);

    let camera = Camera::new(Size::new_equal(SIDE.into())).field_of_view(Turn::degrees(40)).at_distance(2.45);
    let light = Light::directional([-0.5, 0.7, 0.6]);
    let mut frame = Frame::<481, 320, { SIDE as usize }>::new(); // vertices, triangles or pairs that face the eye, lines
    let mut scanner = Scanner::<48>::new(); // triangles or pairs that cross one line
    let (mut shading, mut sending) = (dma_tx_buffer!(ROW_BYTES).unwrap(), dma_tx_buffer!(ROW_BYTES).unwrap());
    let mut step = 0;
    loop {
        let rotation = Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(6 * step));
        // What has no room is left out of the picture: there is nobody here to tell.
        let _ = frame.begin(&camera, &[light]);
        let _ = frame.add(&TEAPOT, &Pose::turned(rotation));
        let mut lines = scanner.start(frame.picture());
        // The command goes out in a row's place: the DMA reads nothing but its own buffers.
        sending.as_mut_slice()[0] = MEMORY_WRITE;
        dc.set_low();
        (spi, sending) = spi.write_buffer(1, sending).ok().unwrap().wait();
        dc.set_high();
        lines.line(0, sending.as_mut_slice().as_chunks_mut::<2>().0);
        for y in 1..=SIDE {
            let transfer = spi.write_buffer(ROW_BYTES, sending).ok().unwrap();
            // The line below the picture costs nothing.
            lines.line(y, shading.as_mut_slice().as_chunks_mut::<2>().0);
            (spi, sending) = transfer.wait();
            swap(&mut shading, &mut sending);
        }
        step = (step + 1) % 60;
    }
}
