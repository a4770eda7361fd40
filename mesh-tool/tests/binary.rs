//! The binary form, there and back.

mod folder;

use beamshade::{Material, Mesh, MeshError};
use beamshade_mesh::{Model, Options, Quantized};
use folder::{Folder, Random};

fn quantized() -> Quantized {
    let folder = Folder::new();
    folder.write("a.mtl", "newmtl a\nKd 0.1 0.2 0.3\nKs 0.5 0.25 0.125\nKa 0.1 0.1 0.1\nNs 77\nnewmtl b\nKd 1 1 0\n");
    let text = "mtllib a.mtl\nv 0 0 -3\nv 1 0 0\nv 0 1 0\nv 0 0 1\nusemtl a\nf 1 2 3\nusemtl b\nf 1 4 2\nf 2 4 3\n";
    let options = Options { double_sided: true, ..Options::default() };
    Model::load(folder.write("a.obj", text), &options).unwrap().quantize().unwrap()
}

/// Bytes at an even address.
struct Even(Vec<u16>, usize);

impl Even {
    fn new(bytes: &[u8]) -> Self {
        let mut words = vec![0; bytes.len().div_ceil(2)];
        bytemuck::cast_slice_mut(&mut words)[..bytes.len()].copy_from_slice(bytes);
        Self(words, bytes.len())
    }

    fn bytes(&self) -> &[u8] {
        &bytemuck::cast_slice(&self.0)[..self.1]
    }
}

#[test]
fn everything_comes_back() {
    let quantized = quantized();
    let bytes = Even::new(&quantized.to_bytes());
    let materials: Vec<Material> = Mesh::materials_in(bytes.bytes()).unwrap().collect();
    let (there, back) = (quantized.mesh(), Mesh::from_bytes(bytes.bytes(), &materials).unwrap());
    assert_eq!(format!("{:?}", there.data()), format!("{:?}", back.data()));
    assert_eq!(back.data().materials.len(), 2);
    assert_eq!(back.data().parts, [[1, 0], [2, 1]]);
}

#[test]
fn truncations_are_errors() {
    let good = quantized().to_bytes();
    let materials = [Material::new(beamshade::Color::WHITE); 2];
    for length in 0..good.len() {
        let bytes = Even::new(&good[..length]);
        let error = Mesh::from_bytes(bytes.bytes(), &materials).unwrap_err();
        assert!(matches!(error, MeshError::Length { found, .. } if found as usize == length), "{length}: {error}");
    }
}

#[test]
fn mutations_never_reach_out_of_bounds() {
    let good = quantized().to_bytes();
    let mut random = Random(7);
    for _ in 0..20_000 {
        let mut bytes = good.clone();
        for _ in 0..=random.below(4) {
            let at = random.below(bytes.len());
            bytes[at] = random.below(256) as u8;
        }
        let bytes = Even::new(&bytes);
        let materials: Vec<Material> = Mesh::materials_in(bytes.bytes()).into_iter().flatten().collect();
        if let Ok(mesh) = Mesh::from_bytes(bytes.bytes(), &materials) {
            let data = mesh.data();
            assert!(data.triangles.iter().flatten().all(|&corner| usize::from(corner) < data.positions.len()));
            assert!(data.parts.iter().all(|&[_, material]| usize::from(material) < data.materials.len()));
        }
    }
}
