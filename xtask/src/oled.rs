//! The OLED board's firmware on the emulated board, and what its panel then shows.

use crate::firmware::{self, OLED, OLED_TARGET};
use crate::install::{self, Need};
use crate::project::{self, progress};
use crate::qemu::{Emulator, Exchange, LM3S6965};
use anyhow::{bail, ensure, Context, Result};
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
