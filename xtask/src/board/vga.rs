//! The VGA board's firmware in the emulator, and what a monitor makes of its pins.

use crate::firmware::{self, PICO_TARGET, PICO_VGA};
use crate::install::{self, Need};
use crate::process;
use crate::project::{self, progress};
use anyhow::{ensure, Context, Result};
use beamshade::{
    Background, Camera, Color, Degrading, DuffBarycentric, Flat, Frame, Light, Picture, Plan, Pose, Price, Rotation, Scanner,
    Shade, Turn,
};
use beamshade_mesh::{Model, Options};
use embedded_graphics::geometry::Size;
use embedded_graphics::pixelcolor::{Rgb565, RgbColor};
use image::{ImageFormat, RgbImage};
use object::{Object, ObjectSection, ObjectSymbol};
use serde_json::Value;
use std::path::Path;
use std::process::Command;

/// The firmware's ways.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Way {
    /// A teapot, by whole frames.
    Teapot,
    /// Three of them.
    Heavy,
    /// A coarse and large one, by lines that are prepared a little ahead of the beam, all of them by the default method.
    Ring,
    /// The same, with cheaper methods where lines may take too long.
    Degrade,
}

impl Way {
    fn is_ring(self) -> bool {
        matches!(self, Way::Ring | Way::Degrade)
    }
}

const WIDTH: u32 = 320;
const HEIGHT: u32 = 240;

/// The signal, in cycles of the processor: 5 for each pixel of 640×480.
const LINE: u64 = 800 * 5;
const HSYNC: u64 = 96 * 5;
const LINES: u64 = 525;

/// For how many refreshes the firmware shows a frame line by line.
const REFRESHES: u32 = 12;

/// `cargo xtask board pico-vga`: runs each of the firmware's ways for that many frames, and checks signal and pictures.
pub(crate) fn run(frames: u32) -> Result<()> {
    install::ensure(&[Need::FirmwareCompiler, Need::Node])?;
    install::bench()?;
    for way in [Way::Teapot, Way::Heavy] {
        check(way, frames)?;
    }
    let [as_is, degraded] = [check(Way::Ring, frames)?, check(Way::Degrade, frames)?];
    ensure!(degraded < as_is, "degrading does not help: {degraded} late rows, and {as_is} without");
    Ok(())
}

/// Runs the firmware, and checks what it showed. Tells how many rows came late.
///
/// # Errors
/// If it did not show what it should have, or counts late rows otherwise than the monitor.
fn check(way: Way, frames: u32) -> Result<u64> {
    let (name, features): (_, &[&str]) = match way {
        Way::Teapot => ("teapot", &[]),
        Way::Heavy => ("three teapots", &["heavy"]),
        Way::Ring => ("coarse teapot, line by line", &["ring"]),
        Way::Degrade => ("coarse teapot, line by line, degraded where late", &["degrade"]),
    };
    let elf = firmware::build(PICO_VGA, PICO_TARGET, features)?;
    let (late, ram) = facts(elf.path())?;
    let folder = project::target()?.join("board").join(PICO_VGA.program).join(features.first().unwrap_or(&"teapot"));
    std::fs::create_dir_all(&folder)?;
    // The first picture may be black, and what is in the ring may differ with each refresh.
    let [pictures, least] = if way.is_ring() { [0, frames * REFRESHES] } else { [frames + 1, 0] };
    progress(format!("running {} [{}] in the emulator for {frames} frames", PICO_VGA.path, features.join(",")));
    let mut command = Command::new("node");
    command.arg(project::root().join("xtask/bench/vga.mjs")).arg(elf.path()).arg(&folder);
    process::run(command.args([pictures.to_string(), least.to_string(), late.to_string()]))?;

    let result: Value = serde_json::from_slice(&std::fs::read(folder.join("bench.json"))?)?;
    let refreshes = result["refreshes"].as_array().context("no refreshes")?;
    refreshes.iter().try_for_each(signal)?;
    let mut repeats: Vec<_> = refreshes.iter().map(|refresh| refresh["repeats"].as_array().map_or(0, Vec::len) as u64).collect();
    let mut before = number(&result["late"])?;
    for (refresh, repeated) in refreshes.iter().zip(&repeats) {
        let late = number(&refresh["late"])?;
        ensure!(late - before == *repeated, "{repeated} rows repeat, and the firmware counts {}", late - before);
        before = late;
    }
    let late: u64 = repeats.iter().sum();
    ensure!(way.is_ring() || late == 0, "{late} rows came late");
    let shown = if way.is_ring() { lines(&folder, refreshes, frames, way)? } else { whole(&folder, refreshes, pictures, way)? };

    let shading: Vec<_> = refreshes.iter().flat_map(|refresh| numbers(&refresh["shading"])).collect();
    let slack = refreshes.iter().flat_map(|refresh| numbers(&refresh["slack"])).min().unwrap_or_default();
    println!("{name}");
    println!("  signal   {} refreshes of {LINES} lines of {LINE} cycles, exact to the cycle", refreshes.len());
    println!("  pictures {shown}");
    repeats.sort_unstable();
    let median = repeats.get(repeats.len() / 2).unwrap_or(&0);
    let rows = refreshes.len() * HEIGHT as usize;
    println!("  late     {late} of {rows} rows, {median} in the median refresh; the firmware counts as many");
    let (worst, sum) = (shading.iter().max().unwrap_or(&0), shading.iter().sum::<i64>());
    println!(
        "  shading  worst row {worst} cycles of 8000, mean {}; least slack {slack} cycles",
        sum / shading.len().max(1) as i64
    );
    println!("  memory   {ram} bytes of RAM, and {} of stack", number(&result["stack"])?);
    let last = refreshes.last().map_or(0, |refresh| refresh["picture"].as_u64().unwrap_or_default());
    let picture = folder.join("picture.png");
    image::open(folder.join(format!("picture-{last}.ppm")))?.save_with_format(&picture, ImageFormat::Png)?;
    println!("  {}: the last picture", project::shown(&picture));
    Ok(late)
}

/// Checks the signal of a refresh.
fn signal(refresh: &Value) -> Result<()> {
    let only = |key: &str, value: u64| {
        ensure!(refresh[key] == serde_json::json!([value]), "{key}: {}, not always {value}", refresh[key]);
        Ok(())
    };
    only("periods", LINE)?;
    only("hsyncs", HSYNC)?;
    for (key, value) in [("lines", LINES), ("period", LINES * LINE), ("vsync", 2 * LINE), ("offset", 0), ("odd", 0)] {
        ensure!(refresh[key] == value, "{key}: {}, not {value}", refresh[key]);
    }
    ensure!(refresh["phases"].as_array().is_some_and(|phases| phases.len() <= 1), "pixels begin at {}", refresh["phases"]);
    ensure!(refresh["blank"] == true, "there is colour beside the picture");
    ensure!(refresh["doubled"] == true, "pixels are not doubled");
    Ok(())
}

/// Checks that each picture is the next frame; before the first frame the picture may be black. Tells for how many refreshes each
/// stayed.
fn whole(folder: &Path, refreshes: &[Value], pictures: u32, way: Way) -> Result<String> {
    let first = u32::from(open(folder, 0)?.pixels().all(|pixel| pixel.0 == [0; 3]));
    let mut stayed = Vec::new();
    for picture in first..pictures {
        let wrong = differences(&open(folder, picture)?, &expected(picture - first, way)?);
        ensure!(wrong == 0, "{wrong} pixels of picture {picture} differ from this machine's");
        stayed.push(refreshes.iter().filter(|refresh| refresh["picture"] == picture).count().to_string());
    }
    let last = pictures - first - 1;
    Ok(format!("frames 0 to {last} as this machine renders them, for {} refreshes", stayed.join(", ")))
}

/// Checks that each row of each refresh is that row of the frame, or of the next one, or else repeats the row above.
fn lines(folder: &Path, refreshes: &[Value], frames: u32, way: Way) -> Result<String> {
    let expected: Vec<_> = (0..=frames).map(|step| expected(step, way)).collect::<Result<_>>()?;
    let row = |picture: &RgbImage, y: u32| -> Vec<_> { (0..WIDTH).map(|x| *picture.get_pixel(x, y)).collect() };
    let (mut step, mut above, mut good) = (0, None, 0);
    for refresh in refreshes {
        let shown = open(folder, refresh["picture"].as_u64().context("no picture")? as u32)?;
        let repeats = numbers(&refresh["repeats"]);
        for y in 0..HEIGHT {
            let pixels = row(&shown, y);
            if repeats.contains(&y.into()) {
                ensure!(above.is_none() || above.as_ref() == Some(&pixels), "row {y} is neither new nor the one above");
            } else {
                let found = (step..expected.len()).find(|&step| row(&expected[step], y) == pixels);
                step = found.with_context(|| format!("row {y} is of no frame from {step} on"))?;
                good += 1;
            }
            above = Some(pixels);
        }
    }
    Ok(format!("{good} rows as this machine renders them, the others repeat the row above; {step} frames"))
}

fn open(folder: &Path, picture: u32) -> Result<RgbImage> {
    let picture = image::open(folder.join(format!("picture-{picture}.ppm")))?.into_rgb8();
    ensure!(picture.dimensions() == (WIDTH, HEIGHT), "the picture is of another size");
    Ok(picture)
}

fn differences(a: &RgbImage, b: &RgbImage) -> usize {
    a.pixels().zip(b.pixels()).filter(|(a, b)| a != b).count()
}

/// A frame as this machine renders it and as the pins carry it: the scene of the board's `scene.rs`, described once more.
///
/// # Errors
/// If the model is not there, or has no room.
fn expected(step: u32, way: Way) -> Result<RgbImage> {
    // Red and blue change places on their way.
    let orange = Options { base: Some([0.20, 0.45, 0.85]), ..Options::default() };
    let file = if way.is_ring() { "teapot-216.obj" } else { "teapot-880.obj" };
    let model = Model::load(project::root().join("examples/models").join(file), &orange)?.quantize()?;
    let mesh = model.mesh();
    let distance = match way {
        Way::Teapot => 5.5,
        Way::Heavy => 6.2,
        Way::Ring | Way::Degrade => 2.45,
    };
    let camera = Camera::new(Size::new(WIDTH, HEIGHT)).field_of_view(Turn::degrees(40)).at_distance(distance);
    let mut frame = Box::new(Frame::<1443, 1536, { HEIGHT as usize }>::new());
    frame.background(Background::Gradient { top: Color::rgb(0.10, 0.03, 0.02), bottom: Color::rgb(0.40, 0.30, 0.25) });
    frame.begin(&camera, &[Light::directional([-0.5, 0.7, 0.6])])?;
    let teapots = if way == Way::Heavy { 3 } else { 1 };
    for number in 0..teapots {
        let turned = Rotation::x(Turn::degrees(25)) * Rotation::y(Turn::degrees(6 * step as i32 + 120 * number));
        let place = if teapots == 1 { [0.0; 3] } else { [(number - 1) as f32 * 0.9, (number - 1) as f32 * 1.4, 0.0] };
        frame.add(&mesh, &Pose::turned(turned).at(place))?;
    }
    match way {
        Way::Teapot | Way::Heavy => drawn::<Flat>(frame.picture()),
        Way::Ring => drawn::<DuffBarycentric>(frame.picture()),
        Way::Degrade => {
            let mut plan = Plan::<{ HEIGHT as usize }>::new();
            let mut scanner = Box::new(Scanner::<128, Degrading>::new());
            plan.make(scanner.start(frame.picture()), &Price::M0_PLUS_DEGRADING, 2 * LINE as u32);
            drawn::<Degrading>(plan.degrade(frame.picture()))
        }
    }
}

/// A picture, drawn line by line.
fn drawn<S: Shade<1>>(picture: Picture<'_, '_>) -> Result<RgbImage> {
    let mut scanner = Box::new(Scanner::<128, S>::new());
    let mut lines = scanner.start(picture);
    let mut image = RgbImage::new(WIDTH, HEIGHT);
    for (y, pixels) in (0..).zip(image.rows_mut()) {
        let mut row = [Rgb565::BLACK; WIDTH as usize];
        ensure!(lines.line(y, &mut row).dropped == 0, "line {y} has no room");
        for (pixel, color) in pixels.zip(row) {
            let level = |level: u8| ((u32::from(level) * 255 + 15) / 31) as u8;
            pixel.0 = [level(color.b()), level(color.g() >> 1), level(color.r())];
        }
    }
    Ok(image)
}

/// Where the firmware counts late rows, and the RAM that it takes.
fn facts(elf: &Path) -> Result<(u64, u64)> {
    let bytes = std::fs::read(elf)?;
    let file = object::File::parse(&*bytes)?;
    let is_late = |name: &str| format!("{:#}", rustc_demangle::demangle(name)).contains("vga::LATE");
    let late = file.symbols().find(|symbol| symbol.name().is_ok_and(is_late)).context("the firmware has no static LATE")?;
    let in_ram = file.sections().filter(|section| (0x2000_0000..0x3000_0000).contains(&section.address()));
    Ok((late.address(), in_ram.map(|section| section.size()).sum()))
}

fn number(value: &Value) -> Result<u64> {
    value.as_u64().with_context(|| format!("{value} is no number"))
}

/// A list's numbers, without what is none.
fn numbers(list: &Value) -> Vec<i64> {
    list.as_array().into_iter().flatten().filter_map(Value::as_i64).collect()
}
