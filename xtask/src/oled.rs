//! The OLED board's firmware on the emulated board, and what its panel then shows.

use crate::firmware::{self, OLED, OLED_TARGET};
use crate::install::{self, Need};
use crate::project::{self, progress};
use crate::qemu::{Emulator, Exchange, LM3S6965};
use anyhow::{bail, ensure, Context, Result};
use beamshade::{Camera, Frame, Light, Pose, Rotation, Scanner, Turn};
use beamshade_mesh::{Model, Options};
use embedded_graphics::{
    geometry::Size,
    pixelcolor::{Gray4, GrayColor},
};
use image::{GrayImage, ImageFormat};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// Run the OLED board's firmware in QEMU, and save what its panel shows.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The frame to stop at, from 0 on.
    #[arg(long, default_value_t = 0)]
    frame: u32,
    /// Where the picture goes; by default target/demo/oled.png.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The panel's size, and that of a pixel of it on QEMU's display.
pub(crate) const WIDTH: u32 = 128;
pub(crate) const HEIGHT: u32 = 64;
const BLOCK: u32 = 4;
/// The step from one of the 16 greys to the next, on QEMU's display.
const STEP: u8 = 17;

/// What the panel shows: greys from 0 to 15, row by row.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Panel {
    pub(crate) greys: Vec<u8>,
}

impl Panel {
    /// Reads QEMU's picture of the panel.
    ///
    /// # Errors
    /// If it is no picture of this panel.
    fn decode(path: &Path) -> Result<Panel> {
        let picture = image::open(path)?.into_rgb8();
        let size = picture.dimensions();
        ensure!(size == (WIDTH * BLOCK, HEIGHT * BLOCK), "the emulated display is of {} x {} pixels", size.0, size.1);
        let mut greys = vec![0; (WIDTH * HEIGHT) as usize];
        for (x, y, pixel) in picture.enumerate_pixels() {
            let [red, green, blue] = pixel.0;
            ensure!(red == green && green == blue && red % STEP == 0, "pixel {x}, {y} is none of the panel's greys");
            let grey = &mut greys[(y / BLOCK * WIDTH + x / BLOCK) as usize];
            ensure!(x % BLOCK + y % BLOCK == 0 || *grey == red / STEP, "pixel {x}, {y} differs within a block");
            *grey = red / STEP;
        }
        Ok(Panel { greys })
    }

    /// A picture of the panel, each of its pixels a block, as QEMU's display has it.
    pub(crate) fn picture(&self) -> GrayImage {
        GrayImage::from_fn(WIDTH * BLOCK, HEIGHT * BLOCK, |x, y| {
            image::Luma([STEP * self.greys[(y / BLOCK * WIDTH + x / BLOCK) as usize]])
        })
    }
}

/// The same frame as this machine renders it: the scene of the board's `main.rs`, described once more.
///
/// # Errors
/// If the model is not there, or has no room.
pub(crate) fn expected(frame: u32) -> Result<Panel> {
    let white = Options { base: Some([1.0; 3]), ..Options::default() };
    let model = Model::load(project::root().join("examples/models/teapot-880.obj"), &white)?.quantize()?;
    let mesh = model.mesh();
    let camera = Camera::new(Size::new(WIDTH, HEIGHT)).field_of_view(Turn::degrees(40)).at_distance(2.2);
    let mut geometry = Frame::<481, 512, { HEIGHT as usize }>::new();
    geometry.begin(&camera, &[Light::directional([-0.5, 0.7, 0.6])])?;
    let rotation = Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(6 * frame as i32));
    geometry.add(&mesh, &Pose::turned(rotation))?;
    let mut scanner = Scanner::<96>::new();
    let mut lines = scanner.start(geometry.picture());
    let mut greys = Vec::new();
    for y in 0..HEIGHT as u16 {
        let mut row = [Gray4::BLACK; WIDTH as usize];
        ensure!(lines.line(y, &mut row).dropped == 0, "line {y} of frame {frame} has no room");
        greys.extend(row.map(|pixel| pixel.luma()));
    }
    Ok(Panel { greys })
}

/// Checks that the emulated panel shows what this machine renders, pixel for pixel.
///
/// # Errors
/// If it does not.
pub(crate) fn check(panel: &Panel, frame: u32) -> Result<()> {
    let expected = expected(frame)?;
    let wrong = panel.greys.iter().zip(&expected.greys).filter(|(a, b)| a != b).count();
    ensure!(wrong == 0, "{wrong} of {} pixels of frame {frame} on the panel differ from this machine's", expected.greys.len());
    Ok(())
}

/// `cargo xtask oled`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let panel = show(arguments.frame)?;
    let path = match &arguments.output {
        Some(path) => path.clone(),
        None => project::target()?.join("demo/oled.png"),
    };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    panel.picture().save_with_format(&path, ImageFormat::Png).with_context(|| path.display().to_string())?;
    println!("{}: frame {} on the emulated panel, {WIDTH} x {HEIGHT} in 16 greys", project::shown(&path), arguments.frame);
    check(&panel, arguments.frame)?;
    println!("it equals what this machine renders, pixel for pixel");
    Ok(())
}

/// What the emulated panel shows once the firmware has sent frame `frame`.
///
/// # Errors
/// If the firmware does not build, or does not get there.
pub(crate) fn show(frame: u32) -> Result<Panel> {
    install::ensure(&[Need::FirmwareCompiler, Need::Qemu])?;
    let elf = firmware::build(OLED, OLED_TARGET, &["emulator"])?;
    progress(format!("running {} in QEMU up to frame {frame}", OLED.path));
    let exchange = Exchange::open()?;
    let words = ["hold".to_owned(), frame.to_string()];
    let limit = Duration::from_secs(60) + Duration::from_secs(1) * frame;
    let mut emulator = Emulator::start(LM3S6965, &elf, &exchange.options()?, &words, limit)?;
    loop {
        match emulator.line()? {
            Some(line) if line == format!("frame {frame}") => break,
            Some(_) => {}
            None => bail!("the firmware ended before frame {frame}"),
        }
    }
    // From here on the firmware holds the picture.
    let file = std::env::temp_dir().join(format!("beamshade-{}.ppm", std::process::id()));
    exchange.answer()?.screenshot(&file)?;
    let panel = Panel::decode(&file);
    std::fs::remove_file(&file)?;
    panel
}
