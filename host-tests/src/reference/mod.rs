//! A renderer that takes no short cuts: f64 throughout, a z-buffer, and Phong's model at the centre of each pixel.
//!
//! The stages, in the order of the data: a [`Mesh`] stands in a [`Scene`]; its triangles are clipped at the near plane,
//! projected, covered by exact edge functions, compared by depth, and shaded ([`render`]).
//!
//! Two algorithms of the course notes stand beside it, for scenes that are snapped already: linked edge lists ([`EdgeList`]), and
//! the by-polygon z-buffer ([`by_polygon`]).

mod by_polygon;
mod clip;
mod coverage;
mod edge_list;
mod light;
mod mesh;
mod render;
mod scene;

pub use by_polygon::{by_polygon, Polygon};
pub use edge_list::EdgeList;
pub use light::{Light, Material, Source, Viewer};
pub use mesh::Mesh;
pub use render::{render, render_opaque, Normals, Options};
pub use scene::{Camera, Object, Pose, Scene};
