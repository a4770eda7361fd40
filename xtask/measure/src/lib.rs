//! The measured scenes: what the firmware renders in an emulator, and a PC for the same checksum.
//!
//! One scene and one method are compiled in, chosen by features, as the size of the code is measured too.
#![no_std]

#[cfg(feature = "host")]
extern crate std;

mod checksum;
pub mod mark;
#[cfg(feature = "parts")]
mod parts;
mod scene;

pub use checksum::Checksum;
pub use scene::Scene;
