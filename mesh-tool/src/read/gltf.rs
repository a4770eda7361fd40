//! glTF 2.0, as text or binary: a scene of meshes with materials.

use std::path::Path;

use base64::prelude::{Engine, BASE64_STANDARD};
use gltf::accessor::{DataType, Dimensions};
use gltf::material::AlphaMode;
use gltf::mesh::Mode;
use gltf::{buffer, Accessor, Document, Gltf, Node, Primitive};

use super::bytes as file_bytes;
use crate::error::Error;
use crate::soup::{Corner, Face, Soup};
use crate::surface::Surface;
use crate::vector::{cross, dot, Vector};

/// Reads the triangles of the default scene, or else of the first, in their places. Skins and morph targets are left as they
/// are at rest; points and lines are left out.
pub(crate) fn read(path: &Path, bytes: &[u8]) -> Result<Soup, Error> {
    let (document, blob) = parse(path, bytes)?;
    let scene = document.default_scene().or_else(|| document.scenes().next()).ok_or_else(|| Error::file(path, "no scene"))?;
    let mut surfaces: Vec<Surface> = document.materials().map(|material| surface(&material)).collect();
    surfaces.push(Surface::default());
    let mut soup = Soup { surfaces, files: vec![path.into()], ..Soup::default() };
    let buffers = load_buffers(path, &document, blob, &mut soup)?;
    let mut reader = Reader { path, buffers, seen: vec![false; document.nodes().len()], soup };
    // A stack instead of recursion: a file may be as deep as it likes.
    let mut nodes: Vec<(Node, Transform)> = scene.nodes().map(|node| (node, IDENTITY)).collect();
    nodes.reverse();
    while let Some((node, parent)) = nodes.pop() {
        let transform = multiply(parent, node.transform().matrix().map(|column| column.map(f64::from)));
        reader.node(&node, transform)?;
        let below = nodes.len();
        nodes.extend(node.children().map(|child| (child, transform)));
        nodes[below..].reverse();
    }
    Ok(reader.soup)
}

/// Reads and validates the document, past two panics of the crate that reads it (gltf 1.4.1).
fn parse(path: &Path, bytes: &[u8]) -> Result<(Document, Option<Vec<u8>>), Error> {
    // It takes the header's own length off the one given there without a look.
    if bytes.starts_with(b"glTF") && bytes.get(8..12).is_none_or(|length| length[0] < 12 && length[1..] == [0; 3]) {
        return Err(Error::element(path, "header", "the file ends here"));
    }
    let Gltf { document, blob } = Gltf::from_slice_without_validation(bytes).map_err(|error| Error::file(path, error))?;
    // Its validation looks up positions before it has checked their number.
    let root = document.into_json();
    for (m, mesh) in root.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            if let Some(accessor) = primitive.attributes.values().find(|accessor| accessor.value() >= root.accessors.len()) {
                let reason = format!("accessor {} of {}", accessor.value(), root.accessors.len());
                return Err(Error::element(path, format!("mesh {m}, primitive {p}"), reason));
            }
        }
    }
    Ok((Document::from_json(root).map_err(|error| Error::file(path, error))?, blob))
}

/// Columns of a matrix.
type Transform = [[f64; 4]; 4];

const IDENTITY: Transform = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]];

fn multiply(a: Transform, b: Transform) -> Transform {
    b.map(|column| std::array::from_fn(|row| (0..4).map(|k| a[k][row] * column[k]).sum()))
}

/// The base colour is taken as it is. The rougher the surface, the fainter the highlight, and the wider: roughness r is a lobe
/// of width α = r², as wide as that of the exponent 2/α² − 2 (Karis, *Specular BRDF reference*, 2013). Metals colour it. Alpha
/// is opacity where the file says that it is to be blended.
fn surface(material: &gltf::Material) -> Surface {
    let pbr = material.pbr_metallic_roughness();
    let [red, green, blue, alpha] = pbr.base_color_factor().map(f64::from);
    let [roughness, metallic] = [pbr.roughness_factor(), pbr.metallic_factor()].map(|factor| f64::from(factor).clamp(0.0, 1.0));
    let exponent = (2.0 / roughness.powi(4) - 2.0).round().clamp(1.0, Surface::MAX_EXPONENT);
    let plain = Surface::default();
    Surface {
        name: material.name().unwrap_or_default().into(),
        base: [red, green, blue],
        highlight: [red, green, blue].map(|base| 1.0 + (base - 1.0) * metallic),
        specular: plain.specular * (1.0 - roughness),
        exponent: exponent as u16,
        double_sided: material.double_sided(),
        opacity: if material.alpha_mode() == AlphaMode::Blend { alpha } else { 1.0 },
        ..plain
    }
}

fn load_buffers(path: &Path, document: &Document, blob: Option<Vec<u8>>, soup: &mut Soup) -> Result<Vec<Vec<u8>>, Error> {
    let mut blob = blob;
    let mut load = |buffer: buffer::Buffer| -> Result<Vec<u8>, String> {
        let bytes = match buffer.source() {
            buffer::Source::Bin => blob.take().ok_or("the file has no binary part")?,
            buffer::Source::Uri(uri) => match uri.strip_prefix("data:") {
                Some(data) => {
                    let (_, data) = data.split_once(";base64,").ok_or("data that is not base64")?;
                    BASE64_STANDARD.decode(data).map_err(|error| error.to_string())?
                }
                None => {
                    let name = urlencoding::decode(uri).map_err(|error| error.to_string())?;
                    let file = path.parent().unwrap_or(Path::new("")).join(&*name);
                    let bytes = file_bytes(&file).map_err(|error| error.to_string())?;
                    soup.files.push(file);
                    bytes
                }
            },
        };
        if bytes.len() < buffer.length() {
            return Err(format!("{} bytes where {} are needed", bytes.len(), buffer.length()));
        }
        Ok(bytes)
    };
    let fail = |index, reason| Error::element(path, format!("buffer {index}"), reason);
    document.buffers().map(|buffer| load(buffer.clone()).map_err(|reason| fail(buffer.index(), reason))).collect()
}

struct Reader<'a> {
    path: &'a Path,
    buffers: Vec<Vec<u8>>,
    /// The nodes that have been met.
    seen: Vec<bool>,
    soup: Soup,
}

impl Reader<'_> {
    fn node(&mut self, node: &Node, transform: Transform) -> Result<(), Error> {
        if std::mem::replace(&mut self.seen[node.index()], true) {
            return Err(Error::element(self.path, format!("node {}", node.index()), "it has two parents, or is one of its own"));
        }
        let Some(mesh) = node.mesh() else { return Ok(()) };
        for primitive in mesh.primitives() {
            self.primitive(&primitive, transform).map_err(|reason| {
                let element = format!("mesh {}, primitive {}", mesh.index(), primitive.index());
                Error::element(self.path, element, reason)
            })?;
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Primitive, transform: Transform) -> Result<(), String> {
        if matches!(primitive.mode(), Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip) {
            return Ok(());
        }
        let [x, y, z, origin] = transform.map(|[x, y, z, _]| [x, y, z]);
        // Normals go by the cofactors, which have the directions of the inverse transposed for any scale.
        let turned = [cross(y, z), cross(z, x), cross(x, y)];
        let mirrored = dot(x, turned[0]) < 0.0;
        let sign = if mirrored { -1.0 } else { 1.0 };

        let place = |point: Vector| sum([(x, point[0]), (y, point[1]), (z, point[2]), (origin, 1.0)]);
        let turn = |n: Vector| sum([(turned[0], sign * n[0]), (turned[1], sign * n[1]), (turned[2], sign * n[2])]);
        let positions = primitive.get(&gltf::Semantic::Positions).ok_or("no positions")?;
        let positions: Vec<Vector> = self.vectors(&positions)?.into_iter().map(place).collect();
        let normals = primitive.get(&gltf::Semantic::Normals).map(|normals| self.vectors(&normals)).transpose()?;
        let normals: Option<Vec<Vector>> = normals.map(|normals| normals.into_iter().map(turn).collect());
        for vectors in std::iter::once(&positions).chain(&normals) {
            if vectors.len() != positions.len() {
                return Err(format!("{} normals of {} positions", vectors.len(), positions.len()));
            }
            let is_good = |vector: &Vector| vector.iter().all(|x| (*x as f32).is_finite());
            if let Some(vertex) = vectors.iter().position(|vector| !is_good(vector)) {
                return Err(format!("vertex {vertex} is not finite"));
            }
        }
        let indices = match primitive.indices() {
            Some(indices) => self.indices(&indices)?,
            None => (0..positions.len()).collect(),
        };
        if let Some(index) = indices.iter().find(|&&index| index >= positions.len()) {
            return Err(format!("index {index} of {} vertices", positions.len()));
        }
        let first = self.soup.positions.len();
        let corner = |index: usize| Corner { position: first + index, normal: normals.as_ref().map(|normals| normals[index]) };
        let surface = primitive.material().index().unwrap_or(self.soup.surfaces.len() - 1);
        for [a, b, c] in triangles(primitive.mode(), &indices) {
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            self.soup.faces.push(Face { corners: corners.map(corner).into(), surface });
        }
        self.soup.positions.extend(positions);
        Ok(())
    }

    fn vectors(&self, accessor: &Accessor) -> Result<Vec<Vector>, String> {
        if (accessor.data_type(), accessor.dimensions()) != (DataType::F32, Dimensions::Vec3) {
            return Err(format!("accessor {} does not hold vectors of three floats", accessor.index()));
        }
        let float = |bytes: &[u8]| f64::from(f32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]));
        let vector = |bytes: &[u8]| [float(bytes), float(&bytes[4..]), float(&bytes[8..])];
        Ok(self.elements(accessor, 12)?.map(vector).collect())
    }

    fn indices(&self, accessor: &Accessor) -> Result<Vec<usize>, String> {
        let size = match (accessor.data_type(), accessor.dimensions()) {
            (DataType::U8, Dimensions::Scalar) => 1,
            (DataType::U16, Dimensions::Scalar) => 2,
            (DataType::U32, Dimensions::Scalar) => 4,
            _ => return Err(format!("accessor {} does not hold unsigned numbers", accessor.index())),
        };
        let index = |bytes: &[u8]| bytes.iter().rev().fold(0, |index, &byte| index << 8 | usize::from(byte));
        Ok(self.elements(accessor, size)?.map(index).collect())
    }

    /// The elements of an accessor, `size` bytes each.
    fn elements(&self, accessor: &Accessor, size: usize) -> Result<impl Iterator<Item = &[u8]>, String> {
        let fail = |what: &str| format!("accessor {}: {what}", accessor.index());
        if accessor.sparse().is_some() {
            return Err(fail("sparse accessors are not supported"));
        }
        let view = accessor.view().ok_or_else(|| fail("no buffer view"))?;
        let buffer = &self.buffers[view.buffer().index()];
        let bytes = view.offset().checked_add(view.length()).and_then(|end| buffer.get(view.offset()..end));
        let bytes = bytes.ok_or_else(|| fail("its buffer view does not lie within its buffer"))?;
        let stride = view.stride().unwrap_or(size);
        if stride < size {
            return Err(fail("the stride is too small"));
        }
        // Every element is as long as the stride but for the last one.
        let length = accessor.count().checked_sub(1).map_or(Some(0), |last| last.checked_mul(stride)?.checked_add(size));
        let start = accessor.offset();
        let bytes = length.and_then(|length| bytes.get(start..start.checked_add(length)?));
        let bytes = bytes.ok_or_else(|| fail("it does not lie within its buffer view"))?;
        Ok(bytes.chunks(stride).map(move |chunk| &chunk[..size]))
    }
}

/// A sum of vectors, each times a factor.
fn sum<const N: usize>(terms: [(Vector, f64); N]) -> Vector {
    std::array::from_fn(|axis| terms.iter().map(|(vector, factor)| vector[axis] * factor).sum())
}

/// The corners of each triangle, in the order of the file.
fn triangles(mode: Mode, indices: &[usize]) -> Vec<[usize; 3]> {
    match (mode, indices) {
        (Mode::TriangleStrip, _) => {
            let turn = |(i, w): (usize, &[usize])| if i % 2 == 0 { [w[0], w[1], w[2]] } else { [w[1], w[0], w[2]] };
            indices.windows(3).enumerate().map(turn).collect()
        }
        (Mode::TriangleFan, [center, rim @ ..]) => rim.windows(2).map(|pair| [*center, pair[0], pair[1]]).collect(),
        _ => indices.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_their_sense() {
        assert_eq!(triangles(Mode::TriangleStrip, &[0, 1, 2, 3]), [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(triangles(Mode::TriangleFan, &[0, 1, 2, 3]), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(triangles(Mode::Triangles, &[0, 1, 2, 3]), [[0, 1, 2]]);
        assert!(triangles(Mode::TriangleFan, &[]).is_empty());
    }

    #[test]
    fn a_parent_moves_what_the_child_has_scaled() {
        let mut scale = IDENTITY;
        scale[0][0] = 2.0;
        let mut moved = IDENTITY;
        moved[3] = [1.0, 0.0, 0.0, 1.0];
        assert_eq!(multiply(moved, scale)[3], [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(multiply(scale, moved)[3], [2.0, 0.0, 0.0, 1.0]);
    }
}
