//! Other renderers on the standard scene T880: what the firmware renders in an emulator, and a PC for the same checksum and to tell
//! which triangle each pixel shows.
//!
//! One peer and one method are compiled in, chosen by a feature. Camera, light, material and mesh are those of the standard scene as
//! far as the peer has them; where it leaves a choice it is made in the peer's favour, and said in its file. Every fifth frame of the
//! sixty is drawn.
#![no_std]

extern crate alloc;
#[cfg(feature = "host")]
extern crate std;

#[path = "../../measure/src/checksum.rs"]
mod checksum;
#[path = "../../measure/src/mark.rs"]
pub mod mark;

#[cfg_attr(any(feature = "retrofire-phong", feature = "retrofire-gouraud"), path = "retrofire.rs")]
#[cfg_attr(any(feature = "embedded-3dgfx-gouraud", feature = "embedded-3dgfx-blinn-phong"), path = "embedded_3dgfx.rs")]
mod peer;

pub use checksum::Checksum;
pub use peer::Scene;

/// Pixels of a side of the picture.
pub const SIZE: usize = 240;
/// Pixels of the picture.
pub const PIXELS: usize = SIZE * SIZE;

/// The teapot, the numbers of the frames and their rotations.
#[allow(dead_code, reason = "not every peer has all of this")]
mod teapot {
    include!(concat!(env!("OUT_DIR"), "/teapot.rs"));
}

/// Numbers of the frames, of the sixty in which the teapot turns once.
pub const STEPS: &[u16] = &teapot::STEPS;

/// The orange body under a white highlight, its exponent being 32; the light and the half vector between it and a viewer at infinity,
/// x to the right, y up, z to the viewer.
#[allow(dead_code, reason = "not every peer has all of this")]
mod setting {
    pub(crate) const BASE: [f32; 3] = [0.85, 0.45, 0.20];
    pub(crate) const AMBIENT: f32 = 0.15;
    pub(crate) const DIFFUSE: f32 = 0.75;
    pub(crate) const SPECULAR: f32 = 0.5;
    pub(crate) const EXPONENT: f32 = 32.0;
    /// (−0.5, 0.7, 0.6) with the length 1.
    pub(crate) const LIGHT: [f32; 3] = [-0.476_731_3, 0.667_423_8, 0.572_077_6];
    /// LIGHT + (0, 0, 1) with the length 1.
    pub(crate) const HALF: [f32; 3] = [-0.268_857_2, 0.376_400_1, 0.886_588_3];
    /// From the camera to the middle of the teapot.
    pub(crate) const DISTANCE: f32 = 2.45;
    /// Half of the vertical field of view of 40°: its cotangent.
    pub(crate) const FOCAL: f32 = 2.747_477_4;
}
