//! Makes the mesh and the poses in single precision, and hands the linker its scripts.

use beamshade_mesh::Model;
use std::{env, f64::consts::TAU, fmt::Debug, fs, path::PathBuf};

/// Frames of the standard scene, and those of them that are drawn here.
const FRAMES: u32 = 60;
const STEP: usize = 5;

fn main() {
    let model = "../../examples/models/teapot-880.obj";
    let memory = "../measure/memory-mps2.x";
    println!("cargo:rerun-if-changed={model}");
    println!("cargo:rerun-if-changed={memory}");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    let mesh = Model::load(model, &Default::default()).unwrap_or_else(|error| panic!("{error}"));
    let across = |[a, b, c]: [u32; 3]| {
        let [a, b, c] = [a, b, c].map(|corner| mesh.positions[corner as usize]);
        let edge = |to: [f64; 3]| [to[0] - a[0], to[1] - a[1], to[2] - a[2]];
        unit(cross(edge(b), edge(c)))
    };
    let frames = || (0..FRAMES).step_by(STEP);
    let text = [
        list("POSITIONS", "[f32; 3]", mesh.positions.iter().copied().map(single)),
        list("NORMALS", "[f32; 3]", mesh.normals.iter().copied().map(single)),
        list("TRIANGLES", "[u16; 3]", mesh.triangles.iter().copied()),
        list("ACROSS", "[f32; 3]", mesh.triangles.iter().copied().map(across).map(single)),
        list("STEPS", "u16", frames()),
        list("ROTATIONS", "[[f32; 3]; 3]", frames().map(rotation).map(|rows| rows.map(single))),
    ];
    fs::write(out.join("teapot.rs"), text.concat()).expect("OUT_DIR is writable");

    if env::var("TARGET").is_ok_and(|target| target.starts_with("thumb")) {
        fs::copy(memory, out.join("memory.x")).expect("the memory map is there");
        println!("cargo:rustc-link-search={}", out.display());
        println!("cargo:rustc-link-arg-bins=-Tlink.x");
    }
}

/// A constant with these items.
fn list<T: Debug>(name: &str, kind: &str, items: impl Iterator<Item = T>) -> String {
    let items: Vec<_> = items.collect();
    format!("pub(crate) const {name}: [{kind}; {}] = {items:?};\n", items.len())
}

/// R_x(25°)·R_y(6°·frame), by rows.
fn rotation(frame: u32) -> [[f64; 3]; 3] {
    let ((up, far), (side, ahead)) = (25_f64.to_radians().sin_cos(), (f64::from(frame) / f64::from(FRAMES) * TAU).sin_cos());
    [[ahead, 0.0, side], [up * side, far, -up * ahead], [-far * side, up, far * ahead]]
}

fn single(v: [f64; 3]) -> [f32; 3] {
    v.map(|c| c as f32)
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    let length = v.iter().map(|c| c * c).sum::<f64>().sqrt();
    v.map(|c| c / length)
}
