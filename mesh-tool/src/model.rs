//! The mesh before it is quantised.

use std::collections::HashMap;
use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::options::Options;
use crate::soup::{Corner, Soup, Triangle};
use crate::surface::Surface;
use crate::vector::{dot, sub, Vector};
use crate::{crease, read, sphere, weld};

/// A triangle mesh in f64: what the quantised one approximates, with the same numbers of vertices and triangles.
///
/// The triangles keep the order of the file within a material; the materials come in the order of their first use, the
/// vertices likewise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Model {
    /// The files it was read from, its own first; messages name that one.
    pub files: Vec<PathBuf>,
    /// Positions of the vertices, in units of the file.
    pub positions: Vec<[f64; 3]>,
    /// Unit normals of the vertices.
    pub normals: Vec<[f64; 3]>,
    /// Vertex numbers of the corners of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Ranges of triangles of one material each, one after the other.
    pub parts: Vec<Part>,
    /// The materials.
    pub surfaces: Vec<Surface>,
    /// Number of triangles of the file that had no area and were left out.
    pub dropped: usize,
}

/// A range of triangles of one material.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Part {
    /// Numbers of the triangles.
    pub triangles: Range<usize>,
    /// Number of the material in [`Model::surfaces`].
    pub surface: usize,
}

impl Model {
    /// Reads a file: `.obj` (with its `.mtl`), `.stl`, `.gltf` or `.glb`.
    ///
    /// Equal vertices are welded, faces of more than three corners cut into triangles, triangles without an area dropped,
    /// missing normals averaged from the faces.
    ///
    /// # Errors
    /// What is wrong, with the file's name and the line or element.
    pub fn load(path: impl AsRef<Path>, options: &Options) -> Result<Self, Error> {
        let mut soup = read::read(path.as_ref())?;
        let firsts = weld::weld(&soup.positions, options.weld);
        for corner in soup.faces.iter_mut().flat_map(|face| &mut face.corners) {
            corner.position = firsts[corner.position];
        }
        let (mut triangles, dropped) = soup.triangles();
        if triangles.is_empty() {
            return Err(Error::file(path.as_ref(), "no triangles"));
        }
        crease::complete(&soup.positions, &mut triangles, options.crease);
        let mut model = Self::assemble(soup, triangles);
        model.dropped = dropped;
        model.surfaces = model.surfaces.into_iter().map(|surface| options.override_surface(surface)).collect();
        if options.fit {
            model.fit();
        }
        Ok(model)
    }

    /// Sorts triangles by surface and numbers what they use. Every corner has its normal by now.
    fn assemble(soup: Soup, mut triangles: Vec<Triangle>) -> Self {
        let mut surfaces = Vec::new();
        for triangle in &mut triangles {
            let old = triangle.surface;
            triangle.surface = surfaces.iter().position(|&used| used == old).unwrap_or(surfaces.len());
            if triangle.surface == surfaces.len() {
                surfaces.push(old);
            }
        }
        triangles.sort_by_key(|triangle| triangle.surface);

        let mut model = Self { files: soup.files, ..Self::default() };
        let mut vertices = Vertices::default();
        for range in triangles.chunk_by(|a, b| a.surface == b.surface) {
            let first = model.triangles.len();
            for triangle in range {
                let numbers = triangle.corners.map(|Corner { position, normal }| {
                    vertices.number(&mut model, position, soup.positions[position], normal.unwrap_or_default())
                });
                model.triangles.push(numbers);
            }
            model.parts.push(Part { triangles: first..model.triangles.len(), surface: model.surfaces.len() });
            model.surfaces.push(soup.surfaces[surfaces[model.surfaces.len()]].clone());
        }
        model
    }

    /// Moves and scales the model so that its bounding sphere has its centre at the origin and the radius 1.
    fn fit(&mut self) {
        let center = sphere::center(&self.positions);
        let radius = sphere::radius(&self.positions, center);
        for position in &mut self.positions {
            *position = sub(*position, center).map(|x| x / radius);
        }
    }

    /// The name of the file it was read from, without folders; empty for one that was not.
    pub(crate) fn name(&self) -> String {
        let name = self.files.first().and_then(|file| file.file_name());
        name.map_or_else(String::new, |name| name.to_string_lossy().into_owned())
    }
}

/// The vertices so far, found again by position and normal.
#[derive(Default)]
struct Vertices {
    at: HashMap<usize, Vec<u32>>,
}

impl Vertices {
    /// Normals that are no farther apart than this are the same; Q14 would not tell them apart.
    const SAME_NORMAL: f64 = 1e-6;

    fn number(&mut self, model: &mut Model, place: usize, position: Vector, normal: Vector) -> u32 {
        let same = |&&vertex: &&u32| {
            let gap = sub(model.normals[vertex as usize], normal);
            dot(gap, gap) <= Self::SAME_NORMAL * Self::SAME_NORMAL
        };
        let here = self.at.entry(place).or_default();
        here.iter().find(same).copied().unwrap_or_else(|| {
            let number = model.positions.len() as u32;
            here.push(number);
            model.positions.push(position);
            model.normals.push(normal);
            number
        })
    }
}
