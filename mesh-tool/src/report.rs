//! What became of a model, in numbers.

use std::fmt;

use beamshade::Material;

use crate::model::Model;
use crate::quantized::Quantized;
use crate::vector::{angle, length, sub, Vector};

/// Sizes of a mesh and what quantising cost; displayed as a small table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Report {
    /// Number of vertices.
    pub vertices: usize,
    /// Number of triangles.
    pub triangles: usize,
    /// Number of triangles without an area, which were left out.
    pub dropped: usize,
    /// Number of materials.
    pub materials: usize,
    /// Bytes of all arrays, the materials' tables included.
    pub flash: usize,
    /// The length, in units of the model, of which positions are fractions.
    pub extent: f64,
    /// Distance of the quantised positions from the exact ones, in units of the model.
    pub positions: Deviation,
    /// Angle of the quantised normals to the exact ones, in degrees.
    pub normals: Deviation,
}

/// The largest of many deviations, and their root mean square.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Deviation {
    /// The largest.
    pub max: f64,
    /// The root of the mean of their squares.
    pub rms: f64,
}

impl Deviation {
    fn new(deviations: impl ExactSizeIterator<Item = f64>) -> Self {
        let count = deviations.len().max(1) as f64;
        let (max, sum) = deviations.fold((0.0, 0.0), |(max, sum): (f64, f64), next| (max.max(next), sum + next * next));
        Self { max, rms: (sum / count).sqrt() }
    }
}

impl Report {
    pub(crate) fn new(model: &Model, quantized: &Quantized) -> Self {
        let extent = quantized.extent.to_num::<f64>();
        let unit = extent / 32768.0;
        let position = |(exact, quantized): (&Vector, &[i16; 3])| length(sub(quantized.map(|x| f64::from(x) * unit), *exact));
        let normal = |(exact, quantized): (&Vector, &[i16; 3])| angle(quantized.map(f64::from), *exact).to_degrees();
        let arrays = [&quantized.positions, &quantized.normals].map(|array| size_of_val(array.as_slice()));
        let indices = [&quantized.triangles, &quantized.edges].map(|array| size_of_val(array.as_slice()));
        let rest = size_of_val(quantized.parts.as_slice()) + quantized.surfaces.len() * size_of::<Material>();
        Self {
            vertices: model.positions.len(),
            triangles: model.triangles.len(),
            dropped: model.dropped,
            materials: model.surfaces.len(),
            flash: arrays.iter().chain(&indices).sum::<usize>() + rest,
            extent,
            positions: Deviation::new(model.positions.iter().zip(&quantized.positions).map(position)),
            normals: Deviation::new(model.normals.iter().zip(&quantized.normals).map(normal)),
        }
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { vertices, triangles, dropped, materials, flash, extent, positions, normals } = self;
        writeln!(f, "vertices        {vertices:>10}")?;
        writeln!(f, "triangles       {triangles:>10}   without area, dropped: {dropped}")?;
        writeln!(f, "materials       {materials:>10}")?;
        writeln!(f, "flash, bytes    {flash:>10}")?;
        let Deviation { max, rms } = positions;
        let [max_share, rms_share] = [max / extent, rms / extent];
        writeln!(
            f,
            "position error  {max:>10.1e}   rms {rms:.1e}; {max_share:.1e}, rms {rms_share:.1e} of the extent {extent:.5}"
        )?;
        let Deviation { max, rms } = normals;
        write!(f, "normal error    {max:>9.4}°   rms {rms:.4}°")
    }
}
