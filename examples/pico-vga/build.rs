//! Makes the mesh, and hands the linker the RP2040's memory map and cortex-m-rt's script.
//!
//! From here, and not from `.cargo/config.toml`: with RUSTFLAGS set in the environment, even empty, the flags of that
//! file are dropped without a word, and what is linked is an empty program.

use beamshade_mesh::Options;
use std::{env, fs, path::PathBuf};

fn main() {
    // Orange: red and blue change places on their way to the pins, see `scene.rs`.
    let orange = Options { base: Some([0.20, 0.45, 0.85]), ..Options::default() };
    for model in ["../models/teapot-880.obj", "../models/teapot-216.obj"] {
        if let Err(error) = beamshade_mesh::build(model, "TEAPOT", &orange) {
            panic!("{error}");
        }
    }
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::copy("../../memory.x", out.join("memory.x")).expect("the RP2040's memory map is at the top of the repository");
    println!("cargo:rerun-if-changed=../../memory.x");
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
}
