//! beamshade
#![no_std]
pub mod frame;
pub mod math;
pub mod model;
pub mod scan;
pub mod scanner;
pub mod shade;
pub mod sink;
pub use frame::{Frame, Full};
pub use math::{angle::Turn, rotation::Rotation};
pub use model::{
    camera::Camera,
    light::Light,
    material::{Color, Material},
    mesh::{Mesh, MeshData, MeshError},
    pose::Pose,
};
pub use scanner::{Line, Lines, Scanner};
pub use sink::{ink::Ink, overlay::Overlay};
