//! Makes the mesh, and hands the linker the memory map and cortex-m-rt's script.
//!
//! From here, and not from `.cargo/config.toml`: with RUSTFLAGS set in the environment, even empty, the flags of that
//! file are dropped without a word, and what is linked is an empty program.

use beamshade_mesh::Options;
use std::{env, fs, path::PathBuf};

fn main() {
    let white = Options { base: Some([1.0; 3]), ..Options::default() };
    if let Err(error) = beamshade_mesh::build("../models/teapot-880.obj", "TEAPOT", &white) {
        panic!("{error}");
    }
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::copy("../../memory.x", out.join("memory.x")).expect("memory.x is in the repository's root");
    println!("cargo:rerun-if-changed=../../memory.x");
    println!("cargo:rustc-link-search={}", out.display());
    println!("cargo:rustc-link-arg-bins=-Tlink.x");
}
