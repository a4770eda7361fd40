//! Boards with an RP2040, emulated: their firmware as it is, and what their panels then show.

mod plot;
mod run;
pub(crate) mod vga;

use crate::firmware::{self, PICO_GC9A01, PICO_ST7789, PICO_TARGET, PICO_VGA};
use crate::install::{self, Need};
use crate::project::{self, progress};
use anyhow::{ensure, Context, Result};
use beamshade::{Camera, Frame, Light, Pose, Rotation, Scanner, Turn};
use beamshade_mesh::{Model, Options};
use embedded_graphics::{geometry::Size, pixelcolor::Rgb565};
use host_tests::Format;
use image::{ImageFormat, RgbImage};
use run::Run;
use std::path::{Path, PathBuf};

/// Run a board's firmware in the emulator, and check the pictures that its panel shows.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The board.
    board: Board,
    /// How many frames, from 0 on. The text in the picture comes with frame 8.
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u32).range(2..))]
    frames: u32,
}

/// The boards.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Board {
    PicoSt7789,
    PicoGc9a01,
    PicoVga,
}

impl Board {
    fn package(self) -> firmware::Package {
        match self {
            Board::PicoSt7789 => PICO_ST7789,
            Board::PicoGc9a01 => PICO_GC9A01,
            Board::PicoVga => PICO_VGA,
        }
    }

    /// Where what the emulator leaves goes.
    pub(crate) fn folder(self) -> Result<PathBuf> {
        Ok(project::target()?.join("board").join(self.package().program))
    }

    /// The panel's name in the emulator.
    fn panel(self) -> &'static str {
        match self {
            Board::PicoSt7789 => "st7789",
            Board::PicoGc9a01 => "gc9a01",
            Board::PicoVga => "vga",
        }
    }

    /// Where the firmware lays its text: left, top, width, height.
    fn text(self) -> [u32; 4] {
        match self {
            Board::PicoSt7789 => [4, 4, 84, 10],
            Board::PicoGc9a01 => [78, 220, 84, 10],
            Board::PicoVga => [0; 4],
        }
    }
}

/// The width and the height of the panels.
const SIDE: u32 = 240;

/// `cargo xtask board`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let Arguments { board, frames } = *arguments;
    if board == Board::PicoVga {
        return vga::run(frames);
    }
    let folder = board.folder()?;
    let run = emulate(board, frames, &folder)?;
    print!("{run}");
    let plot = folder.join("lines.svg");
    std::fs::write(&plot, plot::lines(&run)).with_context(|| plot.display().to_string())?;
    println!("{}: the time of each line", project::shown(&plot));
    let picture = folder.join(format!("frame-{}.png", frames - 1));
    image::open(picture.with_extension("ppm"))?.save_with_format(&picture, ImageFormat::Png)?;
    println!("{}: the panel after the last frame", project::shown(&picture));
    check(board, frames, &folder)?;
    println!("frames 0 to {} equal what this machine renders, pixel for pixel; over the text, pixels may be white", frames - 1);
    Ok(())
}

/// Builds the firmware, and runs it until it has sent that many frames; their pictures are then in the folder.
///
/// # Errors
/// If the firmware does not build, or does not get there.
pub(crate) fn emulate(board: Board, frames: u32, folder: &Path) -> Result<Run> {
    install::ensure(&[Need::FirmwareCompiler, Need::Node])?;
    install::bench()?;
    let package = board.package();
    let elf = firmware::build(package, PICO_TARGET, &[])?;
    progress(format!("running {} in the emulator for {frames} frames", package.path));
    std::fs::create_dir_all(folder)?;
    Run::of(&elf, board.panel(), folder, frames)
}

/// Checks that the emulated panel showed what this machine renders, pixel for pixel. Where the text is, a pixel may be
/// white as well: what the text says depends on the time that things took.
///
/// # Errors
/// If it did not.
pub(crate) fn check(board: Board, frames: u32, folder: &Path) -> Result<()> {
    let [left, top, width, height] = board.text();
    let (columns, rows) = (left..left + width, top..top + height);
    for frame in 0..frames {
        let shown = image::open(folder.join(format!("frame-{frame}.ppm")))?.into_rgb8();
        let expected = expected(frame)?;
        ensure!(shown.dimensions() == expected.dimensions(), "the emulated panel is of another size");
        let wrong = shown.enumerate_pixels().filter(|&(x, y, pixel)| {
            let text = pixel.0 == [255; 3] && columns.contains(&x) && rows.contains(&y);
            pixel != expected.get_pixel(x, y) && !text
        });
        let wrong = wrong.count();
        ensure!(wrong == 0, "{wrong} of {} pixels of frame {frame} on the panel differ from this machine's", SIDE * SIDE);
    }
    Ok(())
}

/// A frame as this machine renders it: the scene of the boards' `main.rs`, described once more.
///
/// # Errors
/// If the model is not there, or has no room.
fn expected(frame: u32) -> Result<RgbImage> {
    let orange = Options { base: Some([0.85, 0.45, 0.20]), ..Options::default() };
    let model = Model::load(project::root().join("examples/models/teapot-880.obj"), &orange)?.quantize()?;
    let mesh = model.mesh();
    let camera = Camera::new(Size::new_equal(SIDE)).field_of_view(Turn::degrees(40)).at_distance(2.45);
    let mut geometry = Frame::<481, 512, { SIDE as usize }>::new();
    geometry.begin(&camera, &[Light::directional([-0.5, 0.7, 0.6])])?;
    let rotation = Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(6 * frame as i32));
    geometry.add(&mesh, &Pose::turned(rotation))?;
    let mut scanner = Scanner::<72>::new();
    let mut lines = scanner.start(geometry.picture());
    let mut picture = RgbImage::new(SIDE, SIDE);
    for (y, pixels) in (0..).zip(picture.rows_mut()) {
        let mut row = [Rgb565::default(); SIDE as usize];
        ensure!(lines.line(y, &mut row).dropped == 0, "line {y} of frame {frame} has no room");
        for (pixel, color) in pixels.zip(row) {
            pixel.0 = color.levels();
        }
    }
    Ok(picture)
}
