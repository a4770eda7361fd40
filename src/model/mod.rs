//! What the user describes: meshes and materials, poses, cameras and lights.

pub mod material;
pub mod mesh;
