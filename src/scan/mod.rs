//! From a picture's triangles to the span table of a line.

pub mod active;
pub mod anew;
pub mod bucket;
pub mod columns;
pub(crate) mod course;
pub mod depth;
pub mod depth_line;
pub mod edge;
pub mod geometry;
pub mod list;
pub(crate) mod most;
pub mod pair;
pub mod picture;
pub mod resolve;
pub(crate) mod silhouette;
pub mod table;
pub mod triangle;
pub mod vertex;
pub mod visibility;
