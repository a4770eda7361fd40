//! Makes the mesh, picks the memory map, and hands the linker its scripts.
//!
//! They are handed over here and not in `.cargo/config.toml`: with RUSTFLAGS set in the environment, even empty, the
//! flags of that file are dropped without a word, and what is linked is an empty program.

use beamshade_mesh::Options;
use std::{env, fs, path::PathBuf};

fn main() {
    let orange = Options { base: Some([0.85, 0.45, 0.20]), ..Options::default() };
    if let Err(error) = beamshade_mesh::build("../../examples/models/teapot-880.obj", "TEAPOT", &orange) {
        panic!("{error}");
    }
    println!("cargo:rerun-if-changed=memory-mps2.x");
    println!("cargo:rerun-if-changed=memory-virt.x");
    let target = env::var("TARGET").expect("cargo sets TARGET");
    let (memory, scripts) = match target.as_str() {
        arm if arm.starts_with("thumb") => ("memory-mps2.x", &["link.x"][..]),
        // The linker script of riscv-rt does not include memory.x.
        riscv if riscv.starts_with("riscv32") => ("memory-virt.x", &["memory.x", "link.x"][..]),
        _ => return,
    };
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    fs::copy(memory, out.join("memory.x")).expect("the memory map is beside this file");
    println!("cargo:rustc-link-search={}", out.display());
    for script in scripts {
        println!("cargo:rustc-link-arg-bins=-T{script}");
    }
}
