//! The mesh as the renderer has it.

use std::path::Path;

use beamshade::{Material, Mesh, MeshData};
use fixed::types::I16F16;

use crate::error::Error;
use crate::model::Model;
use crate::report::Report;
use crate::sphere;
use crate::surface::Surface;
use crate::vector::{dot, length, Vector};

/// A mesh in the number formats of [`MeshData`]; made by [`Model::quantize`].
#[derive(Clone, Debug)]
pub struct Quantized {
    pub(crate) name: String,
    pub(crate) extent: I16F16,
    pub(crate) center: [i16; 3],
    pub(crate) radius: u16,
    pub(crate) positions: Vec<[i16; 3]>,
    pub(crate) normals: Vec<[i16; 3]>,
    pub(crate) triangles: Vec<[u16; 3]>,
    pub(crate) edges: Vec<[u16; 3]>,
    pub(crate) parts: Vec<[u16; 2]>,
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) materials: Vec<Material>,
    pub(crate) report: Report,
}

impl Model {
    /// Brings the model into the number formats of the renderer, every number rounded to nearest.
    ///
    /// The edge constants come from the normals as they are here, so that both sides of an edge have the same one.
    ///
    /// # Errors
    /// More than 65535 vertices or triangles, none at all, coordinates that are not finite, or too large or too small for an
    /// extent in I16F16; for a model that was not loaded, also arrays that do not fit together.
    pub fn quantize(&self) -> Result<Quantized, Error> {
        self.check()?;
        let extent = extent(&self.positions).map_err(|reason| Error::file(self.file(), reason))?;
        let scale = 32768.0 / extent.to_num::<f64>();
        let q15 = |x: f64| (x * scale).round().clamp(-32767.0, 32767.0) as i16;
        let positions: Vec<_> = self.positions.iter().map(|position| position.map(q15)).collect();
        let (center, radius) = bounding_sphere(&positions);
        let edge = |[i, j]: [u32; 2]| {
            let cosine = dot(self.normals[i as usize], self.normals[j as usize]);
            ((1.0 - cosine) * 32768.0).round().clamp(0.0, 65535.0) as u16
        };
        let mut quantized = Quantized {
            name: self.name(),
            extent,
            center,
            radius,
            positions,
            normals: self.normals.iter().map(|normal| normal.map(|x| (x * 16384.0).round() as i16)).collect(),
            triangles: self.triangles.iter().map(|corners| corners.map(|corner| corner as u16)).collect(),
            edges: self.triangles.iter().map(|&[a, b, c]| [[a, b], [b, c], [c, a]].map(edge)).collect(),
            parts: self.parts.iter().map(|part| [part.triangles.len() as u16, part.surface as u16]).collect(),
            surfaces: self.surfaces.clone(),
            materials: self.surfaces.iter().map(Surface::material).collect(),
            report: Report::default(),
        };
        quantized.report = Report::new(self, &quantized);
        Mesh::new(quantized.data()).map_err(|error| Error::file(self.file(), error))?;
        Ok(quantized)
    }

    /// What messages name.
    fn file(&self) -> &Path {
        self.files.first().map_or("model".as_ref(), |file| file.as_path())
    }

    /// What can be wrong with a model; what is left, [`Mesh::new`] finds.
    fn check(&self) -> Result<(), Error> {
        let Self { positions, normals, triangles, parts, surfaces, .. } = self;
        let lengths = [positions.len(), triangles.len(), parts.len(), surfaces.len()];
        for (count, what) in lengths.into_iter().zip(["vertices", "triangles", "parts", "materials"]) {
            if count > 0xffff {
                return Err(Error::file(self.file(), format!("{count} {what}, of which 65535 are possible")));
            }
        }
        if triangles.is_empty() {
            return Err(Error::file(self.file(), "no triangles"));
        }
        let wrong = |what, number, reason| Err(Error::element(self.file(), format!("{what} {number}"), reason));
        let is_finite = |position: &Vector| position.iter().all(|x| x.is_finite());
        if let Some(vertex) = positions.iter().position(|position| !is_finite(position)) {
            return wrong("vertex", vertex, "the position is not finite");
        }
        let is_unit = |normal: &Vector| (length(*normal) - 1.0).abs() < 1e-6;
        if let Some(vertex) = normals.iter().position(|normal| !is_unit(normal)) {
            return wrong("vertex", vertex, "the normal is not of length 1");
        }
        let vertices = positions.len().min(normals.len()) as u32;
        if let Some(triangle) = triangles.iter().position(|corners| corners.iter().any(|&corner| corner >= vertices)) {
            return wrong("triangle", triangle, "a corner is no vertex");
        }
        let mut next = 0;
        for (number, part) in parts.iter().enumerate() {
            let follows = part.triangles.start == next && (next..=triangles.len()).contains(&part.triangles.end);
            if !follows || part.surface >= surfaces.len() {
                return wrong("part", number, "it does not follow the one before, or its material is not there");
            }
            next = part.triangles.end;
        }
        Ok(())
    }
}

/// The smallest multiple of 2⁻¹⁶ of which no coordinate is more than 32767/32768.
fn extent(positions: &[[f64; 3]]) -> Result<I16F16, String> {
    let largest = positions.iter().flatten().fold(0.0, |max: f64, x| max.max(x.abs()));
    let bits = (largest * 65536.0 * (32768.0 / 32767.0)).ceil();
    if bits > f64::from(i32::MAX) {
        return Err(format!("coordinates up to {largest}, of which up to 32766 are possible: scale or fit the model"));
    }
    // Below that, rounding the extent up would cost more than one bit of the positions.
    if largest < 0.5 / 65536.0 {
        return Err(format!("coordinates only up to {largest:e}: scale or fit the model"));
    }
    Ok(I16F16::from_bits(bits as i32))
}

/// A sphere around the quantised positions, in integers.
fn bounding_sphere(positions: &[[i16; 3]]) -> ([i16; 3], u16) {
    let points: Vec<_> = positions.iter().map(|position| position.map(f64::from)).collect();
    let center = sphere::center(&points).map(f64::round);
    // Squares of integers below 2³³ and their sum are exact in f64.
    (center.map(|x| x as i16), sphere::radius(&points, center).ceil() as u16)
}

impl Quantized {
    /// The mesh, borrowed.
    #[must_use]
    pub fn mesh(&self) -> Mesh<'_> {
        Mesh::new(self.data()).expect("it was checked when it was made")
    }

    /// Sizes and errors.
    #[must_use]
    pub fn report(&self) -> &Report {
        &self.report
    }

    fn data(&self) -> MeshData<'_> {
        MeshData {
            extent: self.extent,
            center: self.center,
            radius: self.radius,
            positions: &self.positions,
            normals: &self.normals,
            triangles: &self.triangles,
            edges: &self.edges,
            parts: &self.parts,
            materials: &self.materials,
        }
    }

    /// The binary form that [`Mesh::from_bytes`] and [`Mesh::materials_in`] read.
    #[must_use]
    pub fn to_bytes(&self) -> Vec<u8> {
        let [e0, e1, e2, e3] = self.extent.to_bits().to_le_bytes();
        let counts =
            [self.positions.len(), self.triangles.len(), self.parts.len(), self.surfaces.len()].map(|count| count as u16);
        let signed = |triples: &[[i16; 3]]| triples.iter().flatten().map(|&word| word as u16).collect::<Vec<_>>();
        let words = [
            Mesh::MAGIC.to_vec(),
            vec![Mesh::VERSION],
            counts.to_vec(),
            vec![u16::from_le_bytes([e0, e1]), u16::from_le_bytes([e2, e3])],
            signed(&[self.center]),
            vec![self.radius],
            signed(&self.positions),
            signed(&self.normals),
            self.triangles.concat(),
            self.edges.concat(),
            self.parts.concat(),
            self.surfaces.iter().flat_map(Surface::words).collect(),
        ];
        words.concat().into_iter().flat_map(u16::to_le_bytes).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Part;

    fn triangle(positions: [[f64; 3]; 3]) -> Model {
        Model {
            positions: positions.into(),
            normals: vec![[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [-1.0, 0.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            parts: vec![Part { triangles: 0..1, surface: 0 }],
            surfaces: vec![Surface::default()],
            ..Model::default()
        }
    }

    #[test]
    fn formats() {
        let quantized = triangle([[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, 0.5]]).quantize().unwrap();
        assert_eq!(quantized.extent.to_bits(), 65539, "65538.00006 rounded up");
        assert_eq!(quantized.positions, [[32767, 0, 0], [0, -32767, 0], [0, 0, 16383]]);
        assert_eq!(quantized.normals, [[16384, 0, 0], [0, -16384, 0], [-16384, 0, 0]]);
        assert_eq!(quantized.edges, [[32768, 32768, 65535]]);
        assert_eq!(quantized.parts, [[1, 0]]);
    }

    #[test]
    fn the_sphere_holds_every_position_even_in_the_corners() {
        for far in [0.5 / 65536.0, 1.0, 32000.0] {
            let quantized = triangle([[far; 3], [-far; 3], [far, far, -far]]).quantize().unwrap();
            let arms =
                |position: &[i16; 3]| (0..3).map(|axis| i64::from(position[axis]) - i64::from(quantized.center[axis])).collect();
            for arm in quantized.positions.iter().map(arms) {
                let arm: Vec<i64> = arm;
                assert!(arm.iter().map(|x| x * x).sum::<i64>() <= i64::from(quantized.radius).pow(2));
            }
        }
    }

    #[test]
    fn what_cannot_be_is_named() {
        let error = |model: Model| model.quantize().unwrap_err().to_string();
        let good = || triangle([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        assert!(error(triangle([[40000.0, 0.0, 0.0]; 3])).contains("up to 40000"));
        assert!(error(triangle([[1e-9; 3]; 3])).contains("1e-9"));
        assert!(error(triangle([[0.0; 3], [0.0, f64::NAN, 0.0], [1.0; 3]])).contains("vertex 1: the position is not finite"));
        assert!(error(Model { triangles: vec![], ..good() }).contains("no triangles"));
        assert!(error(Model { triangles: vec![[0, 1, 3]], ..good() }).contains("triangle 0: a corner is no vertex"));
        assert!(error(Model { normals: vec![[f64::NAN; 3]; 3], ..good() }).contains("vertex 0: the normal"));
        assert!(error(Model { normals: vec![[1.0, 0.0, 0.0]; 4], ..good() }).contains("positions and normals differ"));
        assert!(error(Model { parts: vec![], ..good() }).contains("the parts do not add up"));
        for part in [Part { triangles: 0..1, surface: 1 }, Part { triangles: 0..0x10001, surface: 0 }] {
            assert!(error(Model { parts: vec![part], ..good() }).contains("part 0"));
        }
        assert!(error(Model { positions: vec![[1.0; 3]; 65536], ..good() }).contains("65536 vertices"));
    }
}
