//! Makes the mesh, picks the memory map, and hands the linker its scripts.
//!
//! They are handed over here and not in `.cargo/config.toml`: with RUSTFLAGS set in the environment, even empty, the
//! flags of that file are dropped without a word, and what is linked is an empty program.

use beamshade_mesh::{Model, Options};
use std::{
    env,
    error::Error,
    fs,
    path::{Path, PathBuf},
};

fn main() {
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    mesh(&out).unwrap_or_else(|error| panic!("{error}"));
    if env::var_os("CARGO_FEATURE_WAYS").is_some() {
        ways(&out).unwrap_or_else(|error| panic!("{error}"));
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
    fs::copy(memory, out.join("memory.x")).expect("the memory map is beside this file");
    println!("cargo:rustc-link-search={}", out.display());
    for script in scripts {
        println!("cargo:rustc-link-arg-bins=-T{script}");
    }
}

/// Makes the scene's mesh, in orange, and constants with the numbers of its vertices and triangles.
fn mesh(out: &Path) -> Result<(), Box<dyn Error>> {
    let is = |scene: &str| env::var_os(format!("CARGO_FEATURE_{scene}")).is_some();
    let model = out.join("mesh.obj");
    if is("I80") {
        fs::write(&model, icosphere())?;
    } else {
        println!("cargo:rerun-if-env-changed=BEAMSHADE_MODEL");
        let of_growth = env::var("BEAMSHADE_MODEL").ok().filter(|_| is("GROWTH"));
        let file = if is("T5560") { "teapot-5560.obj" } else { "teapot-880.obj" };
        let source = of_growth.unwrap_or(format!("../../examples/models/{file}"));
        println!("cargo:rerun-if-changed={source}");
        fs::copy(source, &model)?;
    }
    let orange = Options { base: Some([0.85, 0.45, 0.20]), ..Options::default() };
    beamshade_mesh::build(&model, "MESH", &orange)?;
    let read = Model::load(&model, &orange)?;
    let (vertices, triangles) = (read.positions.len(), read.triangles.len());
    let counts = format!("const VERTICES: usize = {vertices};\nconst TRIANGLES: usize = {triangles};\n");
    Ok(fs::write(out.join("counts.rs"), counts)?)
}

/// A unit sphere of 80 triangles: an icosahedron, each face of which is divided into four.
fn icosphere() -> String {
    let golden = (1.0 + 5_f64.sqrt()) / 2.0;
    let mut points = Vec::new();
    for (a, b) in [(-1.0, golden), (1.0, golden), (-1.0, -golden), (1.0, -golden)] {
        points.extend([[a, b, 0.0], [0.0, a, b], [b, 0.0, a]].map(unit));
    }
    let mut text = String::new();
    for a in 0..12 {
        for (b, c) in (a + 1..12).flat_map(|b| (a + 1..12).map(move |c| (b, c))) {
            let [p, q, r] = [a, b, c].map(|corner| points[corner]);
            // Neighbours are 63° apart, all others more than 90°; counter-clockwise seen from outside.
            if b != c && dot(p, q) > 0.0 && dot(q, r) > 0.0 && dot(r, p) > 0.0 && dot(p, cross(q, r)) > 0.0 {
                let middle = |a: [f64; 3], b: [f64; 3]| unit([a[0] + b[0], a[1] + b[1], a[2] + b[2]]);
                let (pq, qr, rp) = (middle(p, q), middle(q, r), middle(r, p));
                for triangle in [[p, pq, rp], [pq, q, qr], [rp, qr, r], [pq, qr, rp]] {
                    for [x, y, z] in triangle {
                        text += &format!("v {x:.6} {y:.6} {z:.6}\nvn {x:.6} {y:.6} {z:.6}\n");
                    }
                    text += "f -3//-3 -2//-2 -1//-1\n";
                }
            }
        }
    }
    text
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(v: [f64; 3]) -> [f64; 3] {
    v.map(|c| c / dot(v, v).sqrt())
}

/// Makes the meshes of all scenes of whose lines the cost is foretold.
fn ways(out: &Path) -> Result<(), Box<dyn Error>> {
    soups(out);
    let orange = Options { base: Some([0.85, 0.45, 0.20]), ..Options::default() };
    beamshade_mesh::build("../../examples/models/teapot-5560.obj", "TEAPOT_5560", &orange)?;
    let sphere = out.join("sphere-80.obj");
    fs::write(&sphere, icosphere())?;
    beamshade_mesh::build(&sphere, "SPHERE", &orange)?;
    Ok(())
}

/// Makes meshes of random triangles for random scenes, the same on each machine: integers throughout.
fn soups(out: &Path) {
    const SOUPS: usize = 20;
    let mut state = 1_u64;
    let mut random = |below: i64| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as i64 % below
    };
    let mut statics = String::new();
    let mut names = Vec::new();
    for soup in 0..SOUPS {
        let mut text = String::new();
        let mut vertex = |[x, y, z]: [i64; 3], normal: [i64; 3]| {
            let [nx, ny, nz] = normal;
            text += &format!("v {x}e-3 {y}e-3 {z}e-3\nvn {nx}e-3 {ny}e-3 {nz}e-3\n");
        };
        let count = if soup == 0 { 1 } else { 1 + random(40) as usize };
        for _ in 0..count {
            let mut near = |[x, y, z]: [i64; 3], size: i64| [x, y, z].map(|at| at + random(2 * size + 1) - size);
            let bend = [0, 100, 500, 3000][soup / 4 % 4];
            let normal = near([0; 3], 1000);
            let mut corners = [[0; 3]; 3].map(|center| near(center, 900));
            match soup % 4 {
                // Anywhere; small; slivers; sheets that lie close behind each other.
                0 => {}
                1 => corners = [(); 3].map(|()| near(corners[0], 150)),
                2 => corners[2] = near([0, 1, 2].map(|i| (corners[0][i] + corners[1][i]) / 2), 20),
                _ => corners = corners.map(|[x, y, z]| [x, y, z / 40]),
            }
            for corner in corners {
                let [x, y, z] = near(normal, bend);
                vertex(corner, [x, y, if x | y | z == 0 { 1 } else { z }]);
            }
        }
        for at in (1..=3 * count).step_by(3) {
            text += &format!("f {at}//{at} {0}//{0} {1}//{1}\n", at + 1, at + 2);
        }
        let (path, name) = (out.join(format!("soup-{soup}.obj")), format!("SOUP_{soup}"));
        fs::write(&path, text).expect("OUT_DIR can be written to");
        let base = [0.2 + 0.04 * soup as f64, 0.9 - 0.04 * soup as f64, 0.5];
        let options = Options { base: Some(base), double_sided: soup % 3 == 0, ..Options::default() };
        if let Err(error) = beamshade_mesh::build(&path, &name, &options) {
            panic!("{}: {error}", path.display());
        }
        statics += &format!("include!(concat!(env!(\"OUT_DIR\"), \"/soup-{soup}.rs\"));\n");
        names.push(format!("&{name}"));
    }
    statics += &format!("static SOUPS: [&beamshade::Mesh<'static>; {SOUPS}] = [{}];\n", names.join(", "));
    fs::write(out.join("soups.rs"), statics).expect("OUT_DIR can be written to");
}
