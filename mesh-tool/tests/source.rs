//! The Rust source, compiled in a crate of its own by its build script, as firmware does it.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

const MANIFEST: &str = r#"
[package]
name = "firmware"
version = "0.0.0"
edition = "2021"

[dependencies]
beamshade = { path = "ROOT" }

[build-dependencies]
beamshade-mesh = { path = "ROOT/mesh-tool", default-features = false }

# Not a member of the workspace around it.
[workspace]
"#;

const BUILD: &str = r#"
use beamshade_mesh::{build, Error, Options};

fn main() -> Result<(), Error> {
    build("ROOT/examples/models/teapot-880.obj", "TEAPOT", &Options::default())?;
    build("models/cube.obj", "CUBE", &Options { double_sided: true, ..Options::default() })?;
    Ok(())
}
"#;

const LIBRARY: &str = r#"
//! Firmware.
#![no_std]
#![deny(warnings, missing_docs)]
include!(concat!(env!("OUT_DIR"), "/teapot-880.rs"));
include!(concat!(env!("OUT_DIR"), "/cube.rs"));

// Read by the compiler: were it not so, this would not build.
const _: () = assert!(TEAPOT.data().positions.len() == 481 && TEAPOT.data().triangles.len() == 880);
const _: () = assert!(CUBE.data().parts.len() == 2 && CUBE.data().materials.len() == 2);
const BLUE: beamshade::Material = beamshade::Material::new(beamshade::Color([0, 0, 32768])).double_sided();
/// The second material.
#[must_use]
pub fn is_blue() -> bool {
    CUBE.data().materials[1] == BLUE
}
"#;

const CUBE: &str = "\
mtllib cube.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl *\\ odd \"name\nf 1 2 3\nusemtl blue\nf 1 3 4\nf 1 4 2\n";

#[test]
fn compiles_in_firmware() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    // Stays from one run to the next, so that only the first one builds the dependencies.
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("firmware");
    let write = |name: &str, contents: &str| {
        fs::create_dir_all(folder.join(name).parent().unwrap()).unwrap();
        fs::write(folder.join(name), contents.replace("ROOT", root.to_str().unwrap())).unwrap();
    };
    write("Cargo.toml", MANIFEST);
    write("build.rs", BUILD);
    write("src/lib.rs", LIBRARY);
    write("models/cube.obj", CUBE);
    write("models/cube.mtl", "newmtl blue\nKd 0 0 1\nnewmtl *\\ odd \"name\n");
    // The versions that are here already.
    fs::copy(root.join("Cargo.lock"), folder.join("Cargo.lock")).unwrap();
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["check", "--offline", "--quiet"]).current_dir(&folder).env("CARGO_TARGET_DIR", folder.join("target"));
    let output = cargo.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}
