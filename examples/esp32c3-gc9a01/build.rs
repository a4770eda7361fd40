//! Makes the mesh, and hands the linker esp-hal's script, which knows the memory map.
//!
//! From here, and not from `.cargo/config.toml`: with RUSTFLAGS set in the environment, even empty, the flags of that
//! file are dropped without a word, and what is linked is an empty program.

use beamshade_mesh::Options;

fn main() {
    let orange = Options { base: Some([0.85, 0.45, 0.20]), ..Options::default() };
    if let Err(error) = beamshade_mesh::build("../models/teapot-880.obj", "TEAPOT", &orange) {
        panic!("{error}");
    }
    println!("cargo:rustc-link-arg-bins=-Tlinkall.x");
}
