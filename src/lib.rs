//! beamshade
#![no_std]
pub mod math;
pub mod model;
pub use model::{
    material::{Color, Material},
    mesh::{Mesh, MeshData, MeshError},
};
