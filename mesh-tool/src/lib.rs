//! Turns OBJ, STL and glTF models into meshes for [`beamshade`]: from a build script, or by the command of the same name.
//!
//! ```text
//! file ──▶ Model (f64: welded, triangles only, every vertex with its normal) ──▶ Quantized ──▶ .rs, .bin or a borrowed Mesh
//! ```
//!
//! In `build.rs`, with `beamshade-mesh = { version = "0.1", default-features = false }` among the build dependencies (OBJ needs
//! no more; features `stl` and `gltf` add readers, `cli` the command):
//!
//! ```no_run
//! fn main() -> Result<(), beamshade_mesh::Error> {
//!     beamshade_mesh::build("models/teapot.obj", "TEAPOT", &Default::default())?;
//!     Ok(())
//! }
//! ```
//!
//! and in the firmware `include!(concat!(env!("OUT_DIR"), "/teapot.rs"));`, which makes a `pub static TEAPOT`.
//!
//! What is not read: textures and vertex colours, free-form surfaces (OBJ), attributes (STL), skins, animations and sparse
//! accessors (glTF).

mod crease;
mod error;
mod model;
mod options;
mod output;
mod polygon;
mod quantized;
mod read;
mod report;
mod soup;
mod source;
mod sphere;
mod surface;
mod vector;
mod weld;

pub use error::Error;
pub use model::{Model, Part};
pub use options::Options;
pub use output::build;
pub use quantized::Quantized;
pub use report::{Deviation, Report};
pub use surface::Surface;
