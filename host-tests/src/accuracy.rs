//! How far the library's pictures are from the reference's, on the standard scenes and by every method.

use std::sync::{Mutex, PoisonError};
use std::thread;

use anyhow::{anyhow, bail, Result};
use beamshade::{AtHighlight, Gouraud, Ink, Light, Regular, SceneLight, Shade};
use embedded_graphics::pixelcolor::{Gray8, Rgb565, Rgb888};

use crate::{
    library::{self, Meshes},
    reference::{render, Material, Mesh, Normals, Options, Scene},
    scenes::{self, Case, Illumination, FRAMES, ORANGE, WHITE},
    Format, Measures, Picture,
};

/// Gouraud shading of triangles split that way.
macro_rules! split_method {
    ($name:literal, $split:expr) => {
        Method {
            name: $name,
            standard: |_, _| bail!(concat!($name, " is compared by --all alone")),
            gray: [
                |scene, meshes| Ok(library::draw_split::<Gray8, Gouraud, 1, Light>(scene, meshes, &$split)?.0),
                |scene, meshes| Ok(library::draw_split::<Gray8, Gouraud, 1, SceneLight>(scene, meshes, &$split)?.0),
            ],
            color: |scene, meshes| Ok(library::draw_split::<Rgb888, Gouraud, 1, Light>(scene, meshes, &$split)?.0),
        }
    };
}

macro_rules! methods {
    ($($name:literal $type:ty,)*) => {
        /// Every shading method, the most exact first.
        pub const METHODS: &[Method] = &[
            $(Method::of::<$type>($name),)*
            split_method!("regular-split", Regular { pixels: 32 }),
            split_method!("highlight-split", AtHighlight::new(0.3)),
        ];
    };
}

crate::every_method!(methods);

/// A shading method by name.
#[derive(Clone, Copy, Debug)]
pub struct Method {
    /// Its name in tables and commands.
    pub name: &'static str,
    /// [`standard`] by this method.
    pub standard: fn(&Mesh, Progress<'_>) -> Result<Vec<Row>>,
    /// Draws a scene with one light in white, by the kind of its light: directional, or in the scene.
    gray: [Draw<Gray8>; 2],
    /// Draws a scene with one directional light in colour.
    pub color: Draw<Rgb888>,
}

/// [`library::draw`] by some method.
pub type Draw<P> = fn(&Scene<'_>, &Meshes) -> Result<Picture<P>>;

/// Is told the number of each frame before it is drawn.
pub type Progress<'p> = &'p mut dyn FnMut(u32);

impl Method {
    const fn of<S: Shade<1> + Shade<1, SceneLight>>(name: &'static str) -> Self {
        Self {
            name,
            standard: |mesh, progress| standard::<S>(mesh, progress),
            gray: [library::draw::<Gray8, S, 1, Light>, library::draw::<Gray8, S, 1, SceneLight>],
            color: library::draw::<Rgb888, S, 1, Light>,
        }
    }

    /// Draws a scene with one light of that kind in white.
    ///
    /// # Errors
    ///
    /// As [`library::draw`].
    pub fn draw(&self, light: Illumination, scene: &Scene<'_>, meshes: &Meshes) -> Result<Picture<Gray8>> {
        let [directional, in_scene] = self.gray;
        match light {
            Illumination::Directional => directional(scene, meshes),
            Illumination::Point => in_scene(scene, meshes),
        }
    }

    /// The method of that name.
    ///
    /// # Errors
    ///
    /// When there is none; the error names those that there are.
    pub fn named(name: &str) -> Result<&'static Self> {
        let names = || METHODS.iter().map(|method| method.name).collect::<Vec<_>>().join(", ");
        let found = METHODS.iter().find(|method| method.name == name);
        found.ok_or_else(|| anyhow!("there is no method {name:?}; there are {}", names()))
    }
}

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
        let drawn = library::draw::<P, S, 1, Light>(scene, meshes)?;
        let rounded = reference.round::<R>();
        let measures = Measures::between(&rounded, &drawn, &scene.triangles());
        let rounding = Measures::between(&rounded, &reference.round::<P>(), &scene.triangles()).psnr_db;
        Ok(Row { output, truth: self.truth, frame: self.frame, measures, rounding_db: rounding.is_finite().then_some(rounding) })
    }
}

/// What a method makes of a case.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The case.
    pub case: Case,
    /// The method's name.
    pub method: &'static str,
    /// Each frame in Gray8 against the ideal scene.
    pub rows: Vec<Row>,
}

/// Measures methods on cases, two cases at a time; the outcomes stand in the order of the cases, and in each as the methods do.
///
/// `progress` is called before each case.
///
/// # Errors
///
/// When a mesh cannot be read or does not fit the library's formats, or the library lacks a case's kind of light.
pub fn compare(cases: &[Case], methods: &[&Method], progress: impl Fn(Case) + Sync) -> Result<Vec<Outcome>> {
    let waiting = Mutex::new(cases.iter().enumerate());
    let next = || waiting.lock().unwrap_or_else(PoisonError::into_inner).next();
    let work = || -> Result<Vec<_>> {
        let mut done = Vec::new();
        while let Some((number, &case)) = next() {
            progress(case);
            done.push((number, outcomes(case, methods)?));
        }
        Ok(done)
    };
    let mut done = thread::scope(|scope| {
        let other = scope.spawn(work);
        let mut done = work()?;
        done.extend(other.join().map_err(|_| anyhow!("a case could not be measured"))??);
        anyhow::Ok(done)
    })?;
    done.sort_by_key(|&(number, _)| number);
    Ok(done.into_iter().flat_map(|(_, outcomes)| outcomes).collect())
}

/// A case by several methods, the reference of each frame drawn once.
fn outcomes(case: Case, methods: &[&Method]) -> Result<Vec<Outcome>> {
    let mesh = case.subject.mesh()?;
    let meshes = Meshes::of(&case.scene(&mesh, 0))?;
    let mut outcomes: Vec<_> = methods.iter().map(|method| Outcome { case, method: method.name, rows: Vec::new() }).collect();
    for frame in case.subject.frames() {
        let scene = case.scene(&mesh, frame);
        let reference = render(&scene, Options::default()).round::<Gray8>();
        for (method, outcome) in methods.iter().zip(&mut outcomes) {
            let measures = Measures::between(&reference, &method.draw(case.light, &scene, &meshes)?, &scene.triangles());
            outcome.rows.push(Row { output: "gray8", truth: Truth::Ideal, frame, measures, rounding_db: None });
        }
    }
    Ok(outcomes)
}

/// The PSNR in dB of the worst frame of a standard scene in Gray8 against the ideal scene, by each of these methods.
///
/// # Errors
///
/// When the mesh does not fit the library's formats.
pub fn worst_db(mesh: &Mesh, methods: &[&Method]) -> Result<Vec<f64>> {
    let meshes = Meshes::of(&scenes::standard(mesh, WHITE, 0))?;
    let mut worst = vec![f64::INFINITY; methods.len()];
    for frame in 0..FRAMES {
        let scene = scenes::standard(mesh, WHITE, frame);
        let reference = render(&scene, Options::default()).round::<Gray8>();
        for (method, worst) in methods.iter().zip(&mut worst) {
            let drawn = method.draw(Illumination::Directional, &scene, &meshes)?;
            *worst = worst.min(Measures::between(&reference, &drawn, &scene.triangles()).psnr_db);
        }
    }
    Ok(worst)
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
