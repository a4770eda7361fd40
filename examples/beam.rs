//! One row is sent while the next is shaded: `cargo run --example beam` writes `target/beam.png`.
//!
//! What SPI and DMA do on a board, a simulated panel does here. A row is the panel's until it has been sent, and then the
//! application's again; no row is copied, and there are two of them.

use beamshade::{Background, Camera, Color, Frame, Light, Overlay, Pose, Rotation, Scanner, Turn};
use beamshade_mesh::{Model, Options};
use embedded_graphics::{
    framebuffer::buffer_size,
    image::{Image, ImageRawBE},
    mono_font::{ascii::FONT_9X15, MonoTextStyle},
    pixelcolor::{BinaryColor, Rgb565},
    prelude::*,
    text::{Baseline, Text},
};
use embedded_graphics_simulator::{OutputSettings, SimulatorDisplay};

const WIDTH: usize = 320;
const HEIGHT: usize = 240;

/// A row in Rgb565, the high byte of each pixel first, as panels take it.
type Row = [[u8; 2]; WIDTH];

/// A panel with a memory of its own.
#[derive(Default)]
struct Panel {
    memory: Vec<u8>,
}

/// A row on its way to the panel; both are away until it is there.
struct Sending<'r> {
    panel: Panel,
    row: &'r mut Row,
}

impl Panel {
    /// The next row is the first one.
    fn begin_frame(&mut self) {
        self.memory.clear();
    }

    fn send(self, row: &mut Row) -> Sending<'_> {
        Sending { panel: self, row }
    }
}

impl<'r> Sending<'r> {
    /// Waits for the last byte.
    fn wait(mut self) -> (Panel, &'r mut Row) {
        self.panel.memory.extend_from_slice(self.row.as_flattened());
        (self.panel, self.row)
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let options = Options { base: Some([0.85, 0.45, 0.20]), ..Options::default() };
    let model = Model::load(concat!(env!("CARGO_MANIFEST_DIR"), "/examples/models/teapot-880.obj"), &options)?.quantize()?;
    let teapot = model.mesh();

    let mut frame = Frame::<512, 320, HEIGHT>::new();
    frame.background(Background::Gradient { top: Color::rgb(0.02, 0.03, 0.10), bottom: Color::rgb(0.25, 0.30, 0.40) });
    let mut scanner = Scanner::<48>::new();
    let camera = Camera::new(Size::new(WIDTH as u32, HEIGHT as u32)).at_distance(2.45);
    let light = Light::directional([-0.5, 0.7, 0.6]);
    let mut overlay = Overlay::<100, 15, { buffer_size::<BinaryColor>(100, 15) }>::new(Point::new(8, 8));

    let mut rows = [[[0; 2]; WIDTH]; 2];
    let [row, other] = &mut rows;
    // From here on one row is always being sent; this one, before the first frame begins, is not seen.
    let (mut row, mut sending) = (row, Panel::default().send(other));
    for number in 0..30 {
        // Once a frame: the text, and the geometry.
        overlay.clear(BinaryColor::Off)?;
        let style = MonoTextStyle::new(&FONT_9X15, BinaryColor::On);
        Text::with_baseline(&format!("frame {number}"), Point::zero(), style, Baseline::Top).draw(&mut overlay)?;
        frame.begin(&camera, &[light])?;
        frame.add(&teapot, &Pose::turned(Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(12 * number))))?;

        let mut lines = scanner.start(frame.picture());
        for y in 0..HEIGHT as u16 {
            lines.line(y, row);
            overlay.blit(y, row, [0xff; 2]);
            let (mut panel, sent) = sending.wait();
            if y == 0 {
                panel.begin_frame();
            }
            sending = panel.send(row);
            row = sent;
        }
    }
    let (panel, _) = sending.wait();

    let mut display = SimulatorDisplay::<Rgb565>::new(Size::new(WIDTH as u32, HEIGHT as u32));
    Image::new(&ImageRawBE::<Rgb565>::new(&panel.memory, WIDTH as u32), Point::zero()).draw(&mut display)?;
    std::fs::create_dir_all("target")?;
    display.to_rgb_output_image(&OutputSettings::default()).save_png("target/beam.png")?;
    println!("target/beam.png: what the panel shows after 30 frames");
    Ok(())
}
