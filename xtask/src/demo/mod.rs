//! A model on the turntable: rendered by the no_std core, saved as PNG and GIF, or shown in a window.

mod animation;
mod figures;
mod file;
mod turntable;
mod window;

use crate::project::{self, progress};
use crate::{oled, table};
use animation::{Animation, Palette};
use anyhow::{Context, Result};
use beamshade::{DuffBarycentric, Flat, Gouraud, Shade, Turn};
use beamshade_mesh::{Model, Options, Quantized, Surface};
use clap::ValueEnum;
use embedded_graphics::geometry::Size;
use figures::Figures;
use image::{DynamicImage, ImageFormat};
use std::io::Cursor;
use std::path::{Path, PathBuf};
use turntable::Turntable;

/// Render a turning model line by line, and save it as PNG and GIF in target/demo/.
///
/// Prints what a program needs for it: the capacities of its frame and its scanner, and their bytes.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// A model: .obj, .stl, .gltf or .glb, brought to the right size; by default the teapot of 880 triangles.
    model: Option<PathBuf>,
    /// Width and height of the picture in pixels, 1024x1024 at most.
    #[arg(long, value_name = "WxH", default_value = "240x240", value_parser = size)]
    size: Size,
    /// The number of frames in which the model turns once.
    #[arg(long, value_name = "COUNT", default_value_t = 60, value_parser = clap::value_parser!(u16).range(1..=720))]
    frames: u16,
    /// The shading method.
    #[arg(long, value_enum, default_value_t = Method::DuffBarycentric)]
    method: Method,
    /// Show the model in a window instead; needs SDL2.
    #[arg(long)]
    window: bool,
    /// Run the OLED board's firmware in QEMU instead, and save what its panel shows.
    #[arg(long, conflicts_with_all = ["model", "size", "frames", "method", "window"])]
    oled: bool,
}

/// The shading methods, by the names of their modules.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
enum Method {
    DuffBarycentric,
    Gouraud,
    Flat,
}

/// `240x320` as a size.
fn size(word: &str) -> Result<Size, String> {
    let side = |digits: &str| digits.parse().ok().filter(|side| (1..=turntable::LARGEST).contains(side));
    let sides = word.split_once('x').and_then(|(width, height)| Some(Size::new(side(width)?, side(height)?)));
    sides.ok_or_else(|| format!("two numbers from 1 to {} with an x between, such as 320x240", turntable::LARGEST))
}

/// `cargo demo`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    if arguments.oled {
        let panel = oled::show(0)?;
        println!("{}", save("oled.png", &png(panel.picture())?)?);
        return oled::check(&panel, 0);
    }
    let (path, model) = arguments.load()?;
    match arguments.method {
        Method::DuffBarycentric => arguments.play::<DuffBarycentric>(&path, &model),
        Method::Gouraud => arguments.play::<Gouraud>(&path, &model),
        Method::Flat => arguments.play::<Flat>(&path, &model),
    }
}

impl Arguments {
    /// The model, and where it comes from.
    fn load(&self) -> Result<(PathBuf, Quantized)> {
        let path = self.model.clone().unwrap_or_else(|| project::root().join("examples/models/teapot-880.obj"));
        // The teapot is used as it is: it has its size, and the standard scene has it so.
        let mut model = Model::load(&path, &Options { fit: self.model.is_some(), ..Options::default() })?;
        for surface in model.surfaces.iter_mut().filter(|surface| **surface == Surface::default()) {
            surface.base = [0.85, 0.45, 0.20];
        }
        Ok((path, model.quantize()?))
    }

    /// How far away the camera is.
    fn distance(&self) -> f32 {
        match self.model {
            // The standard scene's; the teapot's belly is slim enough for it.
            None => 2.45,
            // A sphere of radius 1 just fits into 40°.
            Some(_) => 1.0 / 20_f32.to_radians().sin(),
        }
    }

    /// Turns the model, in a window or to files.
    fn play<S: Shade<1, Facet: Send>>(&self, path: &Path, model: &Quantized) -> Result<()> {
        let mesh = model.mesh();
        let mut turntable = Turntable::<S>::new(&mesh, self.size, self.distance());
        if self.window {
            window::ensure_display()?;
            return window::show(&mut turntable, self.frames);
        }
        progress(format!("rendering {} frames of {}", self.frames, path.display()));
        let (png, gif, figures) = self.film(&mut turntable).with_context(|| path.display().to_string())?;
        let name = |extension| Path::new(path.file_stem().unwrap_or_default()).with_extension(extension);
        let saved = [save(name("png"), &png)?, save(name("gif"), &gif)?];

        let file = path.file_name().unwrap_or_default().to_string_lossy();
        let method = self.method.to_possible_value().map_or(String::new(), |value| value.get_name().to_owned());
        let Size { width, height } = self.size;
        figures.print(&[&file, &format!("{width} x {height}, {} frames, {method}", self.frames)], model.report());
        figures.print_needs::<S>(model.report().vertices, self.size);
        println!("{}", saved.join("\n"));
        Ok(())
    }

    /// One turn: the first picture as PNG, all as GIF, and what they took.
    fn film<S: Shade<1>>(&self, turntable: &mut Turntable<'_, S>) -> Result<(Vec<u8>, Vec<u8>, Figures)> {
        let angle = |frame: u16| Turn(((u64::from(frame) << 32) / u64::from(self.frames)) as u32);
        // The palette comes first: from eight of the pictures, which are then rendered again.
        let step = usize::from(self.frames).div_ceil(8);
        let mut samples = Vec::new();
        for frame in (0..self.frames).step_by(step) {
            samples.push(turntable.picture(angle(frame), &mut Figures::default())?);
        }
        let mut animation = Animation::new(self.size, Palette::of(&samples))?;
        let mut figures = Figures::default();
        for frame in 0..self.frames {
            animation.add(&turntable.picture(angle(frame), &mut figures)?)?;
        }
        Ok((png(samples.swap_remove(0))?, animation.finish()?, figures))
    }
}

/// A picture as a PNG file.
fn png(picture: impl Into<DynamicImage>) -> Result<Vec<u8>> {
    let mut file = Cursor::new(Vec::new());
    picture.into().write_to(&mut file, ImageFormat::Png)?;
    Ok(file.into_inner())
}

/// Writes a file to target/demo/; gives its name and size, for people.
fn save(name: impl AsRef<Path>, contents: &[u8]) -> Result<String> {
    let path = project::target()?.join("demo").join(name);
    file::write(&path, contents)?;
    Ok(format!("{}: {} bytes", project::shown(&path), table::number(contents.len() as u64)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Demo {
        #[command(flatten)]
        arguments: Arguments,
    }

    fn parse(words: &str) -> Result<Arguments, String> {
        let parsed = Demo::try_parse_from(["demo"].into_iter().chain(words.split_whitespace()));
        parsed.map(|demo| demo.arguments).map_err(|error| error.to_string())
    }

    #[test]
    fn without_arguments_it_is_the_standard_scene() {
        let arguments = parse("").unwrap();
        assert_eq!((arguments.size, arguments.frames, arguments.method), (Size::new(240, 240), 60, Method::DuffBarycentric));
        let (path, model) = arguments.load().unwrap();
        assert!(path.ends_with("teapot-880.obj"));
        assert_eq!((model.report().vertices, model.report().triangles), (481, 880));
    }

    #[test]
    fn arguments() {
        let arguments = parse("a.glb --size 320x200 --frames 1 --method flat").unwrap();
        assert_eq!((arguments.size, arguments.frames, arguments.method), (Size::new(320, 200), 1, Method::Flat));
        for size in ["0x10", "10x1025", "240", "10x", "axb", "-1x10", "1x2x3"] {
            assert!(parse(&format!("--size={size}")).is_err_and(|error| error.contains(size) && error.contains("320x240")));
        }
        assert!(parse("--frames 0").is_err() && parse("--method phong").is_err_and(|error| error.contains("gouraud")));
        assert!(parse("--oled").is_ok() && parse("--oled a.obj").is_err());
    }

    #[test]
    fn a_bad_model_is_named() {
        let error = |word: &str| parse(word).unwrap().load().unwrap_err().to_string();
        assert!(error("no/such.obj").starts_with("no/such.obj: "));
        assert!(error("Cargo.toml").starts_with("Cargo.toml: not a kind of file"));
    }
}
