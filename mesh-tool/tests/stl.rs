//! STL files as a user has them.

mod folder;

use beamshade_mesh::{Model, Options, Surface};
use folder::{error, mutate, Folder};

const TETRAHEDRON: [[[f32; 3]; 3]; 4] = {
    const A: [f32; 3] = [0.0, 0.0, 0.0];
    const B: [f32; 3] = [1.0, 0.0, 0.0];
    const C: [f32; 3] = [0.0, 1.0, 0.0];
    const D: [f32; 3] = [0.0, 0.0, 1.0];
    [[A, C, B], [A, B, D], [A, D, C], [B, C, D]]
};

fn ascii(triangles: &[[[f32; 3]; 3]]) -> String {
    let mut text = String::from("solid a thing\n");
    for triangle in triangles {
        text += "  facet normal 0 0 0\n    outer loop\n";
        text.extend(triangle.iter().map(|[x, y, z]| format!("      vertex {x:e} {y} {z}\n")));
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid a thing\n"
}

fn binary(triangles: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = vec![b'x'; 80];
    bytes.extend((triangles.len() as u32).to_le_bytes());
    for triangle in triangles {
        bytes.extend([0; 12]);
        bytes.extend(triangle.iter().flatten().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

#[test]
fn both_kinds_say_the_same() {
    let folder = Folder::new();
    let ascii = folder.write("ascii.stl", ascii(&TETRAHEDRON));
    let binary = folder.write("binary.STL", binary(&TETRAHEDRON));
    for (crease, vertices) in [(60.0, 12), (180.0, 4)] {
        let options = Options { crease, ..Options::default() };
        let [a, b] = [&ascii, &binary].map(|path| Model::load(path, &options).unwrap());
        assert_eq!((a.positions.len(), a.triangles.len()), (vertices, 4));
        assert_eq!(a.surfaces, [Surface::default()]);
        assert_eq!(Model { files: vec![], ..a }, Model { files: vec![], ..b });
    }
}

#[test]
fn broken_ascii_is_named_by_line() {
    let good = ascii(&TETRAHEDRON);
    for (from, to, message) in [
        (
            "vertex 0e0 0 1\n    endloop\n  endfacet\n  facet",
            "vertex\n    endloop\n  endfacet\n  facet",
            "a.stl:9: facet 1: vertex f32 f32 f32",
        ),
        ("vertex 1e0 0 0", "vertex nan 0 0", "a.stl:2: facet 0: expected finite f32"),
        ("vertex 1e0 0 0", "vertex one 0 0", "a.stl:2: facet 0: invalid float literal"),
        ("endsolid a thing", "a line of garbage", "a.stl:30: facet 4: invalid facet header"),
        ("endsolid a thing\n", "", "a.stl:29: facet 4: EOF"),
    ] {
        let broken = good.replacen(from, to, 1);
        assert_ne!(broken, good);
        let error = error("a.stl", broken);
        assert!(error.starts_with(message), "{error}");
    }
    let cut = &good[..good.len() / 2];
    assert!(error("a.stl", cut).starts_with("a.stl:16: facet 2: EOF"), "{}", error("a.stl", cut));
    assert_eq!(error("a.stl", [&good, "rubbish\n"].concat()), "a.stl:31: no `solid` begins here");
    assert_eq!(error("a.stl", "solid nothing\nendsolid\n"), "a.stl: no triangles");
}

#[test]
fn broken_binary_is_named_by_triangle() {
    let good = binary(&TETRAHEDRON);
    assert_eq!(error("a.stl", &good[..200]), "a.stl: triangle 2: the file ends here");
    assert_eq!(error("a.stl", &good[..83]), "a.stl: 83 bytes are neither a binary nor an ASCII STL");
    assert_eq!(error("a.stl", ""), "a.stl: 0 bytes are neither a binary nor an ASCII STL");
    assert_eq!(error("a.stl", binary(&[])), "a.stl: no triangles");
    let mut broken = TETRAHEDRON;
    broken[3][1][2] = f32::NAN;
    assert_eq!(error("a.stl", binary(&broken)), "a.stl: triangle 3: a coordinate is not a finite number");
}

#[test]
fn mutations_do_no_harm() {
    mutate("a.stl", &binary(&TETRAHEDRON), 1000);
    mutate("a.stl", ascii(&TETRAHEDRON).as_bytes(), 1000);
}
