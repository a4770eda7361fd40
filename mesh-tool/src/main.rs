//! The command: a model in, a mesh out, a report on the way.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use beamshade_mesh::{Error, Model, Options};
use clap::Parser;

/// Turns an OBJ, STL or glTF model into a mesh for beamshade.
#[derive(Parser)]
#[command(name = "beamshade-mesh", version)]
struct Arguments {
    /// The model: .obj, .stl, .gltf or .glb
    input: PathBuf,
    /// Where the mesh goes: .rs for Rust source, .bin for the binary form; without it there is only the report
    #[arg(short, long)]
    output: Option<PathBuf>,
    /// Name of the static in Rust source [default: that of the input, in upper case]
    #[arg(long)]
    name: Option<String>,
    /// Move and scale the model into the unit sphere
    #[arg(long)]
    fit: bool,
    /// Weld positions that are no farther apart than this
    #[arg(long, value_name = "LENGTH", default_value_t = Options::default().weld)]
    weld: f64,
    /// Where normals are missing, average them across edges of up to this angle
    #[arg(long, value_name = "DEGREES", default_value_t = Options::default().crease)]
    crease: f64,
    /// Base colour of all materials, each channel 0 to 1, linear
    #[arg(long, value_name = "R,G,B", value_parser = color)]
    base: Option<[f64; 3]>,
    /// Colour of all highlights
    #[arg(long, value_name = "R,G,B", value_parser = color)]
    highlight: Option<[f64; 3]>,
    /// Ambient coefficient of all materials, 0 to 1
    #[arg(long, value_name = "FACTOR", value_parser = factor)]
    ambient: Option<f64>,
    /// Diffuse coefficient of all materials, 0 to 1
    #[arg(long, value_name = "FACTOR", value_parser = factor)]
    diffuse: Option<f64>,
    /// Specular coefficient of all materials, 0 to 1
    #[arg(long, value_name = "FACTOR", value_parser = factor)]
    specular: Option<f64>,
    /// Exponent of all materials
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=256))]
    exponent: Option<u16>,
    /// All materials can be seen from behind
    #[arg(long)]
    double_sided: bool,
}

fn main() -> ExitCode {
    match run(Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: Arguments) -> Result<(), Error> {
    let Arguments { input, output, name, fit, weld, crease, base, highlight, ambient, diffuse, specular, exponent, double_sided } =
        arguments;
    let options = Options { weld, crease, fit, base, highlight, ambient, diffuse, specular, exponent, double_sided };
    let mesh = Model::load(&input, &options)?.quantize()?;
    if let Some(output) = output {
        mesh.save(output, &name.unwrap_or_else(|| static_name(&input)))?;
    }
    println!("{}", mesh.report());
    Ok(())
}

/// The name of a static for a file: `teapot-880.obj` is `TEAPOT_880`, `3d.obj` is `_3D`.
fn static_name(file: &Path) -> String {
    let stem = file.file_stem().unwrap_or_default().to_string_lossy();
    let name: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_uppercase() } else { '_' }).collect();
    if name.starts_with(|first: char| first.is_ascii_digit()) {
        format!("_{name}")
    } else {
        name
    }
}

fn factor(word: &str) -> Result<f64, String> {
    let number = word.parse().ok().filter(|number| (0.0..=1.0).contains(number));
    number.ok_or_else(|| format!("`{word}` is not a number from 0 to 1"))
}

fn color(word: &str) -> Result<[f64; 3], String> {
    let channels = word.split(',').map(factor).collect::<Result<Vec<_>, _>>()?;
    channels.try_into().map_err(|_| "not three numbers with commas between".into())
}
