//! A triangle mesh, borrowed from flash.

use fixed::types::I16F16;

use super::material::Material;

/// Triangles with unit normals at their corners, in ranges of one material each. Borrowed, never copied.
///
/// Made at compile time by `beamshade-mesh` (from OBJ, STL or glTF), or read in place [from bytes](Mesh::from_bytes).
/// Either way every index has been checked.
#[derive(Clone, Copy, Debug)]
pub struct Mesh<'a> {
    pub(crate) data: MeshData<'a>,
}

/// The arrays of a [`Mesh`], before they are checked.
#[derive(Clone, Copy, Debug)]
pub struct MeshData<'a> {
    /// The length, in units of the model, that 32768 stands for in `positions`, `center` and `radius`; more than 0.
    pub extent: I16F16,
    /// Centre of a sphere around all positions, Q15 of `extent`.
    pub center: [i16; 3],
    /// Radius of that sphere, Q15 of `extent`, rounded up.
    pub radius: u16,
    /// `[x, y, z]` of each vertex, Q15 of `extent`.
    pub positions: &'a [[i16; 3]],
    /// Unit normal of each vertex, Q14.
    pub normals: &'a [[i16; 3]],
    /// Vertex numbers of the corners 0, 1, 2 of each triangle, counter-clockwise seen from outside.
    pub triangles: &'a [[u16; 3]],
    /// For each triangle the edge constants `e = 1 − n_i·n_j` (0 … 2) of its edges 01, 12, 20, Q15, at most 65535.
    pub edges: &'a [[u16; 3]],
    /// `[number of triangles, material]` of each range, in the order of `triangles`.
    pub parts: &'a [[u16; 2]],
    /// The materials that `parts` refers to.
    pub materials: &'a [Material],
}

/// What is wrong with a mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshError {
    /// The extent is zero or negative.
    Extent,
    /// More than 65535 vertices or 65535 triangles.
    TooLarge,
    /// This vertex lies outside the sphere around all positions.
    Sphere {
        /// Number of the vertex.
        vertex: u16,
    },
    /// Positions and normals differ in number.
    Normals,
    /// Triangles and edge constants differ in number.
    Edges,
    /// This triangle has a corner that is no vertex.
    Corner {
        /// Number of the triangle.
        triangle: u16,
    },
    /// The parts do not add up to the number of triangles.
    Parts,
    /// This part names a material that is not there.
    Material {
        /// Number of the part.
        part: u16,
    },
    /// The bytes do not start with the magic number of a mesh, or the target is not little-endian.
    Magic,
    /// The bytes are of another version of the format.
    Version(u16),
    /// The bytes do not start at an even address.
    Alignment,
    /// The number of bytes is not that which the header asks for.
    Length {
        /// Bytes that the header asks for.
        expected: u32,
        /// Bytes that are there.
        found: u32,
    },
}

impl core::fmt::Display for MeshError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match *self {
            Self::Extent => f.write_str("the extent is not positive"),
            Self::TooLarge => f.write_str("more than 65535 vertices or triangles"),
            Self::Sphere { vertex } => write!(f, "vertex {vertex} lies outside the sphere around all positions"),
            Self::Normals => f.write_str("positions and normals differ in number"),
            Self::Edges => f.write_str("triangles and edge constants differ in number"),
            Self::Corner { triangle } => write!(f, "triangle {triangle} has a corner that is no vertex"),
            Self::Parts => f.write_str("the parts do not add up to the number of triangles"),
            Self::Material { part } => write!(f, "part {part} names a material that is not there"),
            Self::Magic => f.write_str("not a mesh in binary form, or not in this machine's byte order"),
            Self::Version(version) => write!(f, "version {version} of the binary form is not known"),
            Self::Alignment => f.write_str("the bytes start at an odd address"),
            Self::Length { expected, found } => write!(f, "{found} bytes where the header asks for {expected}"),
        }
    }
}

impl core::error::Error for MeshError {}

impl<'a> Mesh<'a> {
    /// The first two words of the binary form, "BSHM".
    pub const MAGIC: [u16; 2] = [u16::from_le_bytes(*b"BS"), u16::from_le_bytes(*b"HM")];
    /// The version of the binary form.
    pub const VERSION: u16 = 1;
    /// Number of 16-bit words in the header of the binary form.
    pub const HEADER_WORDS: usize = 13;

    /// Checks the arrays; const, so that a mesh in a `static` is checked by the compiler.
    ///
    /// # Errors
    /// The first thing that is wrong, by name and number.
    pub const fn new(data: MeshData<'a>) -> Result<Self, MeshError> {
        if data.extent.to_bits() <= 0 {
            return Err(MeshError::Extent);
        }
        if data.positions.len() > 0xffff || data.triangles.len() > 0xffff {
            return Err(MeshError::TooLarge);
        }
        let mut positions = data.positions;
        let mut vertex = 0;
        while let [position, tail @ ..] = positions {
            if square_distance(*position, data.center) > data.radius as i64 * data.radius as i64 {
                return Err(MeshError::Sphere { vertex });
            }
            positions = tail;
            vertex = vertex.wrapping_add(1);
        }
        if data.positions.len() != data.normals.len() {
            return Err(MeshError::Normals);
        }
        if data.triangles.len() != data.edges.len() {
            return Err(MeshError::Edges);
        }
        let vertices = data.positions.len();
        let mut rest = data.triangles;
        let mut triangle = 0;
        while let [[a, b, c], tail @ ..] = rest {
            if *a as usize >= vertices || *b as usize >= vertices || *c as usize >= vertices {
                return Err(MeshError::Corner { triangle });
            }
            rest = tail;
            triangle = triangle.wrapping_add(1);
        }
        let mut parts = data.parts;
        let mut part = 0;
        let mut sum = 0;
        while let [[count, material], tail @ ..] = parts {
            if *material as usize >= data.materials.len() {
                return Err(MeshError::Material { part });
            }
            sum += *count as usize;
            parts = tail;
            part += 1;
        }
        if sum != data.triangles.len() {
            return Err(MeshError::Parts);
        }
        Ok(Self { data })
    }

    /// Reads a mesh in place from the binary form that `beamshade-mesh` writes, with materials of the caller's choice.
    ///
    /// The bytes must start at an even address (`#[repr(align(2))]` around an `include_bytes!`, for example) and hold 16-bit
    /// little-endian words: magic "BSHM" 2, version 1, the numbers of vertices, triangles, parts and materials 4, extent 2
    /// (I16F16, low word first), centre 3, radius 1; then positions, normals, triangles, edge constants (3 words each),
    /// parts (2 words each), materials ([`Material::WORDS`] each, see [`Mesh::materials_in`]).
    ///
    /// # Errors
    /// The first thing that is wrong; nothing of an invalid mesh can be reached.
    pub fn from_bytes(bytes: &'a [u8], materials: &'a [Material]) -> Result<Self, MeshError> {
        let binary = Binary::read(bytes)?;
        Self::new(MeshData { materials, ..binary.data })
    }

    /// The materials stored in the binary form, in their order.
    ///
    /// # Errors
    /// As [`Mesh::from_bytes`], as far as the layout of the bytes goes.
    pub fn materials_in(bytes: &'a [u8]) -> Result<impl ExactSizeIterator<Item = Material> + 'a, MeshError> {
        Ok(Binary::read(bytes)?.materials.iter().map(|words| Material::from_words(*words)))
    }

    /// The number of a triangle's material; none for a number that is no triangle's.
    #[inline]
    pub(crate) fn material_number(&self, triangle: u16) -> Option<u16> {
        if let [[_, material]] = self.data.parts {
            return Some(*material);
        }
        let mut end = 0;
        let [_, material] = self.data.parts.iter().find(|[count, _]| {
            end += u32::from(*count);
            u32::from(triangle) < end
        })?;
        Some(*material)
    }

    /// The checked arrays.
    #[must_use]
    pub const fn data(&self) -> &MeshData<'a> {
        &self.data
    }
}

/// The square of the distance of two points.
const fn square_distance([ax, ay, az]: [i16; 3], [bx, by, bz]: [i16; 3]) -> i64 {
    let [x, y, z] = [ax as i64 - bx as i64, ay as i64 - by as i64, az as i64 - bz as i64];
    x * x + y * y + z * z
}

/// The binary form, cut up but not checked.
struct Binary<'a> {
    data: MeshData<'a>,
    materials: &'a [[u16; Material::WORDS]],
}

impl<'a> Binary<'a> {
    fn read(bytes: &'a [u8]) -> Result<Self, MeshError> {
        let found = u32::try_from(bytes.len()).unwrap_or(u32::MAX);
        let header_bytes = 2 * Mesh::HEADER_WORDS;
        let short = MeshError::Length { expected: header_bytes as u32, found };
        // An odd last byte is left out here and found by its number below.
        let even = bytes.get(..bytes.len() & !1).unwrap_or(bytes);
        let words: &[u16] = bytemuck::try_cast_slice(even).map_err(|_| MeshError::Alignment)?;
        let (header, body) = words.split_first_chunk::<{ Mesh::HEADER_WORDS }>().ok_or(short)?;
        let [m0, m1, version, vertices, triangles, parts, materials, e0, e1, cx, cy, cz, radius] = *header;
        if [m0, m1] != Mesh::MAGIC {
            return Err(MeshError::Magic);
        }
        if version != Mesh::VERSION {
            return Err(MeshError::Version(version));
        }
        let [vertices, triangles, parts, materials] = [vertices, triangles, parts, materials].map(u32::from);
        let expected = header_bytes as u32 + 12 * vertices + 12 * triangles + 4 * parts + 2 * Material::WORDS as u32 * materials;
        let wrong = MeshError::Length { expected, found };
        if expected != found {
            return Err(wrong);
        }
        let mut body = body;
        let mut take = |count: u32| -> Result<&'a [u16], MeshError> {
            let (front, back) = body.split_at_checked(count as usize).ok_or(wrong)?;
            body = back;
            Ok(front)
        };
        let data = MeshData {
            extent: I16F16::from_bits((u32::from(e1) << 16 | u32::from(e0)) as i32),
            center: [cx, cy, cz].map(|word| word as i16),
            radius,
            positions: cast(take(3 * vertices)?)?,
            normals: cast(take(3 * vertices)?)?,
            triangles: cast(take(3 * triangles)?)?,
            edges: cast(take(3 * triangles)?)?,
            parts: cast(take(2 * parts)?)?,
            materials: &[],
        };
        Ok(Self { data, materials: cast(take(Material::WORDS as u32 * materials)?)? })
    }
}

fn cast<T: bytemuck::AnyBitPattern>(words: &[u16]) -> Result<&[T], MeshError> {
    bytemuck::try_cast_slice(words).map_err(|_| MeshError::Alignment)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_outside_the_sphere_is_named() {
        let data = MeshData {
            extent: I16F16::ONE,
            center: [100, 0, 0],
            radius: 500,
            positions: &[[100, 300, 400], [100, 300, 401]],
            normals: &[[0, 0, 1 << 14]; 2],
            triangles: &[],
            edges: &[],
            parts: &[],
            materials: &[],
        };
        assert_eq!(Mesh::new(data).err(), Some(MeshError::Sphere { vertex: 1 }));
        assert!(Mesh::new(MeshData { radius: 501, ..data }).is_ok());
    }
}
