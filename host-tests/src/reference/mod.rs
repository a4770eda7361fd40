//! A renderer that takes no short cuts: f64 throughout, a z-buffer, and Phong's model at the centre of each pixel.
//!
//! The stages, in the order of the data: a [`Mesh`] stands in a [`Scene`]; its triangles are clipped at the near plane,
//! projected, covered by exact edge functions, compared by depth, and shaded ([`render`]).

mod clip;
mod coverage;
mod light;
mod mesh;
mod render;
mod scene;

pub use light::{Light, Material, Source, Viewer};
pub use mesh::Mesh;
pub use render::{render, Normals, Options};
pub use scene::{Camera, Object, Pose, Scene};
