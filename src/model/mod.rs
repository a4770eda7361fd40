//! What the user describes: meshes and materials, poses, cameras and lights; and the way from a mesh to the screen.

pub mod camera;
pub mod clip;
pub mod highlight;
pub mod light;
pub mod material;
pub mod mesh;
pub mod pose;
pub mod projection;
