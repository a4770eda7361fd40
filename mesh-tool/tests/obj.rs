//! OBJ files as a user has them.

mod folder;

use beamshade_mesh::{Model, Options, Part, Surface};
use folder::{error, mutate, Folder};

const TEAPOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/models/teapot-880.obj");

/// A cube of quads, by numbers from the front and from the back; left and right are blue, the others red.
const CUBE: &str = "\
mtllib two colours.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
g bottom
usemtl red
f 1 4 3 2
usemtl blue
f 1/ 5/ 8/ 4/
f 2 3 7 6
o top
usemtl red
f -4 -3 -2 -1
f 1 2 6 5
f 3 4 8 7
";

const COLOURS: &str = "newmtl blue\nKd 0 0 1\nNs 8\nnewmtl unused\nKd 1 1 1\nnewmtl red\nKd 1 0 0\nKs 0 0 0\n";

fn load(name: &str, contents: &str, options: &Options) -> Model {
    Model::load(Folder::new().write(name, contents), options).unwrap()
}

#[test]
fn the_teapot_keeps_its_numbers() {
    let model = Model::load(TEAPOT, &Options::default()).unwrap();
    assert_eq!((model.positions.len(), model.triangles.len(), model.dropped), (481, 880, 0));
    let mesh = model.quantize().unwrap();
    assert_eq!((mesh.report().vertices, mesh.report().triangles), (481, 880));
    assert!(mesh.report().positions.max < 0.87 / 32768.0 * mesh.report().extent, "half a step on each axis");
    assert!(mesh.report().normals.max < 0.0031, "half a step of Q14 on each axis, in degrees");
}

/// The same corners in the same order as another reader finds.
#[test]
fn the_teapot_is_read_as_others_read_it() {
    let model = Model::load(TEAPOT, &Options::default()).unwrap();
    let (theirs, _) = tobj::load_obj(TEAPOT, &tobj::GPU_LOAD_OPTIONS).unwrap();
    let theirs = &theirs[0].mesh;
    let corners = model.triangles.as_flattened();
    assert_eq!(corners.len(), theirs.indices.len());
    for (&corner, &index) in corners.iter().zip(&theirs.indices) {
        let [corner, index] = [corner, index].map(|number| number as usize);
        assert_eq!(model.positions[corner], theirs.positions[3 * index..][..3]);
        for (n, m) in model.normals[corner].iter().zip(&theirs.normals[3 * index..]) {
            assert!((n - m).abs() < 2e-6, "normals of six digits are not quite unit");
        }
    }
}

#[test]
fn a_cube_of_two_colours() {
    let folder = Folder::new();
    folder.write("two colours.mtl", COLOURS);
    let model = Model::load(folder.write("cube.obj", CUBE), &Options::default()).unwrap();
    assert_eq!((model.positions.len(), model.triangles.len()), (24, 12), "four vertices a side, as no edge is smooth");
    assert_eq!(model.parts, [Part { triangles: 0..8, surface: 0 }, Part { triangles: 8..12, surface: 1 }]);
    let names: Vec<_> = model.surfaces.iter().map(|surface| &*surface.name).collect();
    assert_eq!(names, ["red", "blue"]);
    assert_eq!((model.surfaces[0].base, model.surfaces[0].specular), ([1.0, 0.0, 0.0], 0.0));
    assert_eq!((model.surfaces[1].base, model.surfaces[1].exponent), ([0.0, 0.0, 1.0], 8));
    for corners in &model.triangles {
        let [a, b, c] = corners.map(|corner| model.positions[corner as usize]);
        let n = model.normals[corners[0] as usize];
        let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
        let face = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
        assert_eq!(face, n, "half a square whose sides are 1 has a cross product of length 1");
        assert!((0..3).any(|axis| n[axis] == if a[axis] == 1.0 { 1.0 } else { -1.0 }), "outwards");
    }
    // Triangles stay in the order of the file within a material: bottom, top, front, back, then left, right.
    let sides: Vec<_> = model.triangles.iter().step_by(2).map(|corners| model.normals[corners[0] as usize]).collect();
    let expected = [[0, 0, -1], [0, 0, 1], [0, -1, 0], [0, 1, 0], [-1, 0, 0], [1, 0, 0]];
    assert_eq!(sides, expected.map(|n| n.map(f64::from)));
    assert_eq!(model.files.len(), 2);
}

#[test]
fn a_cube_without_creases() {
    let cube = CUBE.replace("mtllib two colours.mtl\n", "");
    let model = load("cube.obj", &cube, &Options { crease: 180.0, ..Options::default() });
    assert_eq!(model.positions.len(), 8);
    for (position, normal) in model.positions.iter().zip(&model.normals) {
        for (x, n) in position.iter().zip(normal) {
            assert!((n - (x - 0.5) * 2.0 / 3f64.sqrt()).abs() < 1e-12, "by angle, all three sides weigh the same");
        }
    }
    assert_eq!(model.surfaces[0], Surface { name: "red".into(), ..Surface::default() });
    let e = model.quantize().unwrap().mesh().data().edges[0];
    // Bottom: 1 4 3 with two sides, cosine 1/3, and a diagonal, cosine −1/3.
    assert_eq!(e, [21845, 21845, 43691]);
}

#[test]
fn options_win() {
    let options = Options {
        fit: true,
        base: Some([0.25, 0.5, 1.0]),
        highlight: Some([0.0, 1.0, 0.0]),
        ambient: Some(0.1),
        diffuse: Some(0.2),
        specular: Some(0.3),
        exponent: Some(7),
        double_sided: true,
        ..Options::default()
    };
    let model = load("cube.obj", &CUBE.replace("mtllib two colours.mtl\n", ""), &options);
    let surface = &model.surfaces[1];
    assert_eq!((surface.base, surface.highlight, surface.exponent), ([0.25, 0.5, 1.0], [0.0, 1.0, 0.0], 7));
    assert_eq!((surface.ambient, surface.diffuse, surface.specular, surface.double_sided), (0.1, 0.2, 0.3, true));
    let far = model.positions.iter().map(|p| p.iter().map(|x| x * x).sum::<f64>().sqrt()).fold(0.0, f64::max);
    assert!((far - 1.0).abs() < 1e-12);
    let centre: f64 = model.positions.iter().flatten().sum();
    assert!(centre.abs() < 0.1);
}

#[test]
fn some_faces_with_normals_and_some_without() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvn 0 0 2\nf 1//1 2//1 3//1\nf 1 2 4\n";
    let model = load("a.obj", text, &Options::default());
    assert_eq!(model.normals[..4], [[0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0]]);
}

#[test]
fn what_has_no_area_is_dropped_and_counted() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv 0 0 0\nf 1 2 4\nf 1 2 3\nf 1 1 3\nf 1 5 2 3\nl 1 2 3\np 1\n";
    let model = load("a.obj", text, &Options::default());
    assert_eq!((model.triangles.len(), model.dropped, model.positions.len()), (2, 3, 3));
}

#[test]
fn welding_closes_gaps() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1.001 0 0\nv 0 1.001 0\nv 1 1 0\nf 1 2 3\nf 4 6 5\n";
    let vertices = |weld| load("a.obj", text, &Options { weld, ..Options::default() }).positions.len();
    assert_eq!((vertices(0.0), vertices(0.01)), (6, 4));
}

#[test]
fn broken_ones_are_named_by_line() {
    let vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (tail, message) in [
        ("f 1 2 4", "a.obj:4: a corner has position 4 of 3"),
        ("vn 0 0 1\nf 1//1 2//2 3//1", "a.obj:5: a corner has normal 2 of 1"),
        ("f 1 2 -4", "a.obj:4: position of corner `-4` is -4, but only 3 come before"),
        ("f 0 1 2", "a.obj:4: position of corner `0` is 0, but the first is 1"),
        ("f 1 2 x", "a.obj:4: position of corner `x` is not a whole number"),
        ("f 1 2 //3", "a.obj:4: corner `//3` has no position"),
        ("f 1 2 3/1/1/1", "a.obj:4: corner `3/1/1/1` has more than three numbers"),
        ("f 1 2", "a.obj:4: a face of 2 corners"),
        ("f 1 2 3\nv 1 nan 0", "a.obj:5: `nan` is not a finite number"),
        ("f 1 2 3\nv 1 1e39 0", "a.obj:5: `1e39` is not a finite number"),
        ("f 1 2 3\nvn 1 2", "a.obj:5: 2 numbers where 3 are needed"),
        ("\n\nPK\u{3}\u{4} garbage", "a.obj:6: unknown keyword `PK\\u{3}\\u{4}`"),
        ("mtllib none.mtl", "a.obj:4: the material library cannot be read: none.mtl: No such file or directory (os error 2)"),
        ("f 1 1 1", "a.obj: no triangles"),
        ("", "a.obj: no triangles"),
    ] {
        assert_eq!(error("a.obj", [vertices, tail].concat()), message);
    }
    assert_eq!(error("a.obj", ""), "a.obj: no triangles");
    assert_eq!(error("a.obj", "v 1e5 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3").split(':').next(), Some("a.obj"));
    assert_eq!(error("a.txt", ""), "a.txt: not a kind of file that can be read: .obj, .stl, .gltf or .glb");
    let missing = Model::load("nowhere/a.obj", &Options::default()).unwrap_err().to_string();
    assert!(missing.starts_with("nowhere/a.obj: No such file"), "{missing}");
}

#[test]
fn broken_materials_are_named_by_line() {
    let folder = Folder::new();
    let obj = folder.write("a.obj", CUBE);
    let error = || Model::load(&obj, &Options::default()).unwrap_err().to_string();
    folder.write("two colours.mtl", "newmtl red\nKd 1 0\n");
    assert!(error().ends_with("two colours.mtl:2: 2 numbers where 3 are needed"), "{}", error());
    folder.write("two colours.mtl", "newmtl red\n");
    assert!(error().ends_with("a.obj:13: no material library has `blue`"), "{}", error());
}

#[test]
fn too_many_vertices() {
    let mut text: String = (0..65538).map(|i| format!("v {i} {} 0\n", i % 2)).collect();
    text += "vn 0 0 1\n";
    text.extend((1..=65536).map(|i| format!("f {i}//1 {}//1 {}//1\n", i + 1, i + 2)));
    assert_eq!(error("a.obj", text), "a.obj: 65538 vertices, of which 65535 are possible");
}

#[test]
fn mutations_do_no_harm() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nusemtl x\nf 1//1 2//1 -2//1 4//1\nf 1 2 \\\n3\n";
    mutate("a.obj", text.as_bytes(), 2000);
}
