//! glTF files as a user has them.

mod folder;

use base64::prelude::{Engine, BASE64_STANDARD};
use beamshade_mesh::{Model, Options};
use folder::{error, mutate, Folder};

/// Two triangles of a square with normals, and their corners: 4 positions, 4 normals, 6 indices of 16 bits.
fn buffer() -> Vec<u8> {
    let positions = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]].map(|p| p.map(|x| x as f32));
    let normals = [[0.0, 0.0, 1.0f32]; 4];
    let vectors = positions.iter().chain(&normals).flatten().flat_map(|x| x.to_le_bytes());
    vectors.chain([0, 1, 2, 0, 2, 3].into_iter().flat_map(u16::to_le_bytes)).collect()
}

/// The square twice: turned upwards and scaled, in red; mirrored, without a material and a normal.
fn json(uri: &str) -> String {
    let uri = if uri.is_empty() { String::new() } else { format!(r#""uri": "{uri}", "#) };
    format!(
        r#"{{
  "asset": {{ "version": "2.0" }}, "scene": 0,
  "scenes": [{{ "nodes": [0, 2] }}],
  "nodes": [
    {{ "children": [1], "translation": [0, 0, 5] }},
    {{ "mesh": 0, "rotation": [-0.70710678, 0, 0, 0.70710678], "scale": [2, 1, 1] }},
    {{ "mesh": 1, "scale": [-1, 1, 1] }}
  ],
  "meshes": [
    {{ "primitives": [{{ "attributes": {{ "POSITION": 0, "NORMAL": 1 }}, "indices": 2, "material": 0 }}] }},
    {{ "primitives": [{{ "attributes": {{ "POSITION": 0 }}, "indices": 2 }}] }}
  ],
  "materials": [{{ "name": "red", "doubleSided": true,
    "pbrMetallicRoughness": {{ "baseColorFactor": [1, 0, 0, 1], "roughnessFactor": 0.5, "metallicFactor": 0 }} }}],
  "buffers": [{{ {uri}"byteLength": 108 }}],
  "bufferViews": [{{ "buffer": 0, "byteLength": 96 }}, {{ "buffer": 0, "byteOffset": 96, "byteLength": 12 }}],
  "accessors": [
    {{ "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] }},
    {{ "bufferView": 0, "byteOffset": 48, "componentType": 5126, "count": 4, "type": "VEC3" }},
    {{ "bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR" }}
  ]
}}"#
    )
}

fn embedded(buffer: &[u8]) -> String {
    json(&format!("data:application/octet-stream;base64,{}", BASE64_STANDARD.encode(buffer)))
}

fn binary(json: &str, buffer: &[u8]) -> Vec<u8> {
    let json = format!("{json:0$}", json.len().next_multiple_of(4));
    let length = 12 + 8 + json.len() + 8 + buffer.len();
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    for (kind, chunk) in [(b"JSON", json.as_bytes()), (b"BIN\0", buffer)] {
        if bytes.len() == 8 {
            bytes.extend((length as u32).to_le_bytes());
        }
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

#[test]
fn a_scene_with_transforms() {
    let folder = Folder::new();
    let model = Model::load(folder.write("a.gltf", embedded(&buffer())), &Options::default()).unwrap();
    assert_eq!((model.positions.len(), model.triangles.len()), (8, 4));
    let corner = |triangle: usize, corner: usize| model.triangles[triangle][corner] as usize;
    let near = |a: [f64; 3], b: [f64; 3]| assert!(a.iter().zip(b).all(|(x, y)| (x - y).abs() < 1e-6), "{a:?} is not {b:?}");
    // (1, 1, 0), twice as wide, turned about x by −90° and moved by 5 along z.
    near(model.positions[corner(0, 2)], [2.0, 0.0, 4.0]);
    near(model.normals[corner(0, 2)], [0.0, 1.0, 0.0]);
    // Mirrored, the corners change their order, so that the front stays the front.
    assert_eq!(model.positions[corner(2, 1)], [-1.0, 1.0, 0.0]);
    assert_eq!(model.normals[corner(2, 1)], [0.0, 0.0, 1.0]);
    let [red, plain] = &model.surfaces[..] else { panic!("two materials") };
    assert_eq!((&*red.name, red.base, red.double_sided, red.exponent), ("red", [1.0, 0.0, 0.0], true, 30));
    assert_eq!((&*plain.name, plain.double_sided, plain.exponent), ("", false, 32));
}

#[test]
fn text_binary_and_a_file_of_its_own_say_the_same() {
    let folder = Folder::new();
    folder.write("a buffer.bin", buffer());
    let paths = [
        folder.write("a.gltf", embedded(&buffer())),
        folder.write("a.glb", binary(&json(""), &buffer())),
        folder.write("b.gltf", json("a%20buffer.bin")),
    ];
    let [a, b, c] = paths.map(|path| Model::load(path, &Options::default()).unwrap());
    assert_eq!(c.files.len(), 2);
    let [a, b, c] = [a, b, c].map(|model| Model { files: vec![], ..model });
    assert!(a == b && b == c);
}

#[test]
fn broken_ones_are_named_by_element() {
    let good = embedded(&buffer());
    let mut out_of_range = buffer();
    out_of_range[96] = 9;
    let mut not_finite = buffer();
    not_finite[12..16].copy_from_slice(&f32::NAN.to_le_bytes());
    for (text, message) in [
        (String::new(), "a.gltf: EOF while parsing a value at line 1 column 0"),
        (good[..good.len() / 2].into(), "a.gltf: EOF while parsing"),
        (good.replacen("\"scene\": 0,", "a line of garbage", 1), "a.gltf: key must be a string at line 2 column "),
        (good.replace("[0, 2] }]", "[0, 7] }]"), "a.gltf: invalid glTF: scenes[0].nodes[1]: Index out of bounds"),
        (good.replacen("\"POSITION\": 0", "\"POSITION\": 3", 1), "a.gltf: mesh 0, primitive 0: accessor 3 of 3"),
        (embedded(&out_of_range), "a.gltf: mesh 0, primitive 0: index 9 of 4 vertices"),
        (embedded(&not_finite), "a.gltf: mesh 0, primitive 0: vertex 1 is not finite"),
        (embedded(&buffer()[..100]), "a.gltf: buffer 0: 100 bytes where 108 are needed"),
        (json("no such.bin"), "a.gltf: buffer 0: no such.bin: No such file"),
        (json("data:,xyz"), "a.gltf: buffer 0: data that is not base64"),
        (json(""), "a.gltf: buffer 0: the file has no binary part"),
        (good.replace(r#""count": 6"#, r#""count": 7"#), "a.gltf: mesh 0, primitive 0: accessor 2: it does not lie within"),
        (
            good.replace(r#""byteLength": 12 "#, r#""byteLength": 99 "#),
            "a.gltf: mesh 0, primitive 0: accessor 2: its buffer view",
        ),
        (good.replace("\"VEC3\", \"min\"", "\"VEC4\", \"min\""), "a.gltf: mesh 0, primitive 0: accessor 0 does not hold vectors"),
        (good.replace(r#""children": [1],"#, r#""children": [1, 1],"#), "a.gltf: node 1: it has two parents"),
        (good.replace(r#"{ "mesh": 0,"#, r#"{ "children": [0], "mesh": 0,"#), "a.gltf: node 0: it has two parents"),
        (good.replace(r#""count": 6"#, r#""count": 0"#), "a.gltf: "),
    ] {
        let error = error("a.gltf", text);
        assert!(error.starts_with(message), "{error}\n{message}");
    }
}

#[test]
fn broken_binary_ones() {
    let good = binary(&json(""), &buffer());
    for length in [0, 3, 4, 11, 12, 19, 20, 300, good.len() - 1] {
        let error = error("a.glb", &good[..length]);
        assert!(error.starts_with("a.glb: "), "{error}");
    }
    let mut short = good.clone();
    short[8..12].copy_from_slice(&3u32.to_le_bytes());
    assert_eq!(error("a.glb", short), "a.glb: header: the file ends here");
}

#[test]
fn mutations_do_no_harm() {
    mutate("a.glb", &binary(&json(""), &buffer()), 1500);
}
