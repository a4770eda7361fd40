//! A triangle mesh.

use std::collections::HashMap;
use std::path::Path;

use anyhow::{ensure, Context, Result};
use glam::DVec3;
use tobj::LoadOptions;

/// Triangles with unit normals at their corners.
#[derive(Clone, Debug, PartialEq)]
pub struct Mesh {
    /// Position of each vertex.
    pub positions: Vec<DVec3>,
    /// Normal of each vertex, of length 1.
    pub normals: Vec<DVec3>,
    /// Vertex numbers of each triangle's corners, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// For each triangle the number of its material among those of its object.
    pub materials: Vec<usize>,
}

impl Mesh {
    /// A mesh of one material, number 0. Normals are brought to length 1.
    ///
    /// # Panics
    ///
    /// When positions and normals differ in number, or a corner is no vertex.
    #[must_use]
    pub fn new(positions: Vec<DVec3>, normals: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        assert_eq!(positions.len(), normals.len(), "one normal for each position");
        assert!(triangles.as_flattened().iter().all(|&vertex| (vertex as usize) < positions.len()), "a corner is no vertex");
        let normals = normals.into_iter().map(DVec3::normalize_or_zero).collect();
        let materials = vec![0; triangles.len()];
        Self { positions, normals, triangles, materials }
    }

    /// Reads a Wavefront OBJ file with normals, its faces in their order.
    ///
    /// Each pair of position and normal that faces use is one vertex, numbered as it first appears. Polygons become fans
    /// of triangles, which moves the numbers of what follows. Materials are numbered as the file's `mtllib` has them;
    /// without one all are 0.
    ///
    /// # Errors
    ///
    /// When the file cannot be read, or lacks normals.
    pub fn from_obj(path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let options = LoadOptions { triangulate: true, single_index: true, ..LoadOptions::default() };
        let (models, _) = tobj::load_obj(path, &options).with_context(|| format!("reading {}", path.display()))?;

        let mut whole = Self::new(vec![], vec![], vec![]);
        let mut numbers = HashMap::new();
        for part in models.into_iter().map(|model| model.mesh) {
            ensure!(part.normals.len() == part.positions.len(), "{} lacks normals", path.display());
            let (positions, _) = part.positions.as_chunks::<3>();
            let (normals, _) = part.normals.as_chunks::<3>();
            let mut vertex = |index: u32| {
                let (position, normal) = (positions[index as usize], normals[index as usize]);
                // Parts that meet, meet in the same vertices.
                *numbers.entry((position.map(f64::to_bits), normal.map(f64::to_bits))).or_insert_with(|| {
                    whole.positions.push(position.into());
                    whole.normals.push(DVec3::from(normal).normalize_or_zero());
                    whole.positions.len() as u32 - 1
                })
            };
            let (corners, _) = part.indices.as_chunks();
            whole.triangles.extend(corners.iter().map(|corners| corners.map(&mut vertex)));
            whole.materials.resize(whole.triangles.len(), part.material_id.unwrap_or(0));
        }
        Ok(whole)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_an_obj_keep_their_order_and_meet_in_vertices() {
        let path = std::env::temp_dir().join(format!("beamshade-mesh-{}.obj", std::process::id()));
        let vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 9 9 9\nvn 0 0 2\nvn 0 -3 0\n";
        let faces = "o first\nf 1//1 2//1 3//1\no second\nf 3//1 4//1 1//1\nf 1//2 2//1 3//1 4//1\n";
        std::fs::write(&path, [vertices, faces].concat()).unwrap();
        let mesh = Mesh::from_obj(&path);
        std::fs::remove_file(&path).unwrap();
        let mesh = mesh.unwrap();
        assert_eq!(mesh.positions, [DVec3::ZERO, DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Y, DVec3::ZERO]);
        assert_eq!(mesh.normals, [DVec3::Z, DVec3::Z, DVec3::Z, DVec3::Z, DVec3::NEG_Y]);
        assert_eq!(mesh.triangles, [[0, 1, 2], [2, 3, 0], [4, 1, 2], [4, 2, 3]]);
        assert_eq!(mesh.materials, [0; 4]);
    }
}
