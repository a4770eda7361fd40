//! How far the library's pictures are from the reference's, on the standard scenes.

use anyhow::Result;
use beamshade::{Ink, Shade};
use embedded_graphics::pixelcolor::{Gray8, Rgb565, Rgb888};

use crate::{
    library::{self, Meshes},
    reference::{render, Material, Mesh, Normals, Options, Scene},
    scenes::{self, FRAMES, ORANGE, WHITE},
    Format, Measures,
};

/// What the library is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Truth {
    /// The ideal scene: mesh not quantised, vertices not snapped, normals linear on the screen.
    Ideal,
    /// The same with normals in correct perspective.
    Perspective,
    /// The quantised mesh, its projected vertices snapped to 1/256 pixel: what is left is the error of the arithmetic.
    Quantized,
}

impl Truth {
    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ideal => "ideal",
            Self::Perspective => "perspective",
            Self::Quantized => "quantized",
        }
    }
}

/// A frame's measures.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// Name of the pixel format: `gray8` or `rgb565`.
    pub output: &'static str,
    /// What it was compared with.
    pub truth: Truth,
    /// Number of the frame.
    pub frame: u32,
    /// The measures.
    pub measures: Measures,
    /// For `rgb565`, the PSNR in dB of the reference rounded to that format: what rounding alone costs.
    pub rounding_db: Option<f64>,
}

/// Measures a method on a standard scene, all frames in Gray8 (in white) and Rgb565 (in orange).
///
/// # Errors
///
/// When the mesh does not fit the library's formats.
pub fn standard<S: Shade<1>>(mesh: &Mesh, mut progress: impl FnMut(u32)) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    let meshes = |material| Meshes::of(&scenes::standard(mesh, material, 0));
    let (white, orange) = (meshes(WHITE)?, meshes(ORANGE)?);
    let snapped = white.dequantized(mesh)?;
    for frame in 0..FRAMES {
        progress(frame);
        let at = |mesh, material| -> Scene<'_> { scenes::standard(mesh, material, frame) };
        for truth in [Truth::Ideal, Truth::Perspective, Truth::Quantized] {
            let mesh = if truth == Truth::Quantized { &snapped } else { mesh };
            let compare = Comparison { truth, frame };
            rows.push(compare.row::<Gray8, Gray8, S>("gray8", &at(mesh, WHITE), &white)?);
            rows.push(compare.row::<Rgb888, Rgb565, S>("rgb565", &at(mesh, ORANGE), &orange)?);
        }
    }
    Ok(rows)
}

#[derive(Clone, Copy)]
struct Comparison {
    truth: Truth,
    frame: u32,
}

impl Comparison {
    /// Compares the library's picture in format `P` with the reference's rounded to `R`.
    fn row<R: Format, P: Ink + Format, S: Shade<1>>(
        self,
        output: &'static str,
        scene: &Scene<'_>,
        meshes: &Meshes,
    ) -> Result<Row> {
        let normals = if self.truth == Truth::Perspective { Normals::PerspectiveCorrect } else { Normals::ScreenLinear };
        let snap = (self.truth == Truth::Quantized).then_some(256.0);
        let reference = render(scene, Options { normals, snap });
        let drawn = library::draw::<P, S, 1>(scene, meshes)?;
        let rounded = reference.round::<R>();
        let measures = Measures::between(&rounded, &drawn, &scene.triangles());
        let rounding = Measures::between(&rounded, &reference.round::<P>(), &scene.triangles()).psnr_db;
        Ok(Row { output, truth: self.truth, frame: self.frame, measures, rounding_db: rounding.is_finite().then_some(rounding) })
    }
}

/// The worst of several frames, measure by measure, but for `wrong_owner` and `wrong_neighbour`, which are sums.
#[must_use]
pub fn worst(rows: &[&Row]) -> Option<Measures> {
    rows.iter().map(|row| row.measures).reduce(|a, b| Measures {
        psnr_db: a.psnr_db.min(b.psnr_db),
        mean: a.mean.max(b.mean),
        max: a.max.max(b.max),
        over4_share: a.over4_share.max(b.over4_share),
        same_owner_share: a.same_owner_share.min(b.same_owner_share),
        wrong_owner: a.wrong_owner + b.wrong_owner,
        wrong_neighbour: a.wrong_neighbour + b.wrong_neighbour,
        covered: a.covered + b.covered,
    })
}

/// The exponent of a material, for tables.
#[must_use]
pub fn exponent(material: &Material) -> u32 {
    material.exponent as u32
}
