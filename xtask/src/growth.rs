//! How the cost of a frame grows with the mesh and with the picture, and a model of it.

use crate::count::Count;
use crate::cycles::Measured;
use crate::firmware::{METHOD, TARGETS};
use crate::install::{self, Need};
use crate::project::{self, progress};
use crate::{table, teapot};
use anyhow::{Context, Result};
use beamshade::{DuffBarycentric, Light, Scanner};
use host_tests::library::{self, Meshes};
use host_tests::reference::{Camera, Mesh};
use host_tests::scenes::{self, FRAMES, ORANGE};
use std::fmt::Write;

/// Measure how the cost of a frame grows, fit a model to it, and draw docs/growth.svg; takes long.
///
/// The standard scene by the default method, with teapots of 2×2 to 16×16 per patch at 240×240, and that of 4×4 at 64×64 to 480×480:
/// the mean of twelve frames. The model is c_frame + c_triangle·T + c_span·S + c_pixel·P, with T triangles that face the eye, S visible
/// spans and P covered pixels; its constants make the sum of the squared relative errors least.
#[derive(clap::Args)]
pub(crate) struct Arguments {}

/// Divisions of a patch, and pixels of a side of the picture.
const CASES: [(usize, usize); 11] =
    [(2, 240), (3, 240), (4, 240), (6, 240), (8, 240), (12, 240), (16, 240), (4, 64), (4, 128), (4, 320), (4, 480)];

/// Every so many frames of the standard scene one is measured; as many as xtask/measure has.
const STEP: usize = 5;

/// The model's terms: one, triangles, spans, pixels.
const TERMS: usize = 4;
const NAMES: [&str; TERMS] = ["frame", "triangle", "span", "pixel"];

/// One case, measured.
struct Outcome {
    divisions: usize,
    size: usize,
    /// In the mean frame; the first is 1.
    terms: [f64; TERMS],
    /// Of the mean frame, on each core: cycles on Cortex-M0+, instructions on Cortex-M4F.
    costs: [f64; 2],
}

const UNITS: [&str; 2] = ["cycles, Cortex-M0+", "instructions, Cortex-M4F"];

/// `cargo xtask growth`.
pub(crate) fn run() -> Result<()> {
    println!("{}", text()?);
    Ok(())
}

/// The tables as Markdown; docs/growth.svg is drawn too.
///
/// # Errors
/// If something cannot be measured, or the plot not be written.
pub(crate) fn text() -> Result<String> {
    install::ensure(&[Need::FirmwareCompiler, Need::Qemu])?;
    let outcomes = CASES.iter().map(|&(divisions, size)| measure(divisions, size)).collect::<Result<Vec<_>>>()?;
    let models = [0, 1].map(|core| fit(&outcomes, |outcome| outcome.costs[core]));
    let models = models.into_iter().collect::<Option<Vec<_>>>().context("the cases do not tell the terms apart")?;
    let path = project::root().join("docs/growth.svg");
    std::fs::write(&path, plot(&outcomes, &models))?;
    progress(format!("{} is drawn", project::shown(&path)));

    let head = ["core", NAMES[0], NAMES[1], NAMES[2], NAMES[3], "largest error %"];
    let constants = UNITS.iter().zip(&models).enumerate().map(|(core, (unit, model))| {
        let error = |outcome: &Outcome| (value(model, outcome) / outcome.costs[core] - 1.0).abs();
        let largest = outcomes.iter().map(error).fold(0.0, f64::max);
        let constants = model.iter().map(|constant| format!("{constant:.1}"));
        [(*unit).to_owned()].into_iter().chain(constants).chain([format!("{:.1}", 100.0 * largest)]).collect()
    });
    let constants = table::text(&head, constants.collect());
    let lines = outcomes.iter().map(|outcome| {
        let [_, triangles, spans, pixels] = outcome.terms.map(|term| table::number(term.round() as u64));
        let mut line = vec![format!("{0}×{0}, {1}×{1}", outcome.divisions, outcome.size), triangles, spans, pixels];
        for (model, cost) in models.iter().zip(outcome.costs) {
            line.push(table::number(cost.round() as u64));
            line.push(format!("{:+.1}", 100.0 * (value(model, outcome) / cost - 1.0)));
        }
        line
    });
    let head = ["teapot, picture", "T", "S", "P", "M0+ cycles", "model %", "M4F instructions", "model %"];
    Ok(format!("{constants}\n\n{}", table::text(&head, lines.collect())))
}

fn measure(divisions: usize, size: usize) -> Result<Outcome> {
    let path = project::target()?.join("counts").join(format!("teapot-{divisions}.obj"));
    std::fs::create_dir_all(path.parent().context("it lies in a folder")?)?;
    // A file that stays the same keeps its date, and what was built from it.
    let text = teapot::obj(divisions)?;
    if std::fs::read_to_string(&path).ok().as_ref() != Some(&text) {
        std::fs::write(&path, text)?;
    }
    // The build of the measured scene reads these.
    std::env::set_var("BEAMSHADE_MODEL", &path);
    std::env::set_var("BEAMSHADE_SIZE", size.to_string());
    progress(format!("teapot of {divisions}×{divisions}, picture of {size}×{size}"));
    let cost = |core: usize, of: fn(Count) -> u64| -> Result<f64> {
        Ok(of(Measured::new(&TARGETS[core], "growth", METHOD)?.counts.mean()) as f64)
    };
    let costs = [cost(0, |count| count.cycles)?, cost(1, |count| count.instructions)?];
    Ok(Outcome { divisions, size, terms: terms(&Mesh::from_obj(&path)?, size)?, costs })
}

/// What there is to draw in the mean frame.
fn terms(mesh: &Mesh, size: usize) -> Result<[f64; TERMS]> {
    let mut sums = [0; TERMS];
    let frames = (0..FRAMES).step_by(STEP);
    let count = frames.len() as f64;
    for frame in frames {
        let mut scene = scenes::standard(mesh, ORANGE, frame);
        let focal = scene.camera.focal * size as f64 / scene.camera.height as f64;
        scene.camera = Camera { width: size, height: size, focal, ..scene.camera };
        let meshes = Meshes::of(&scene)?;
        let seen = library::frame::<_, 1, Light>(&scene, &meshes, |picture| {
            let triangles = picture.triangles();
            let mut scanner: Box<Scanner<2048, DuffBarycentric>> = Box::default();
            let mut lines = scanner.start(picture);
            let (mut spans, mut pixels) = (0, 0);
            for y in 0..size as u16 {
                lines.spans(y, |columns, _| {
                    spans += 1;
                    pixels += columns.len();
                });
            }
            [1, triangles, spans, pixels]
        })?;
        sums = std::array::from_fn(|term| sums[term] + seen[term]);
    }
    Ok(sums.map(|sum| sum as f64 / count))
}

/// What a model says.
fn value(model: &[f64; TERMS], outcome: &Outcome) -> f64 {
    model.iter().zip(outcome.terms).map(|(constant, term)| constant * term).sum()
}

/// The constants with the least sum of squared relative errors: normal equations, by elimination with the largest pivot.
fn fit(outcomes: &[Outcome], cost: impl Fn(&Outcome) -> f64) -> Option<[f64; TERMS]> {
    let mut rows = [[0.0; TERMS + 1]; TERMS];
    for outcome in outcomes {
        let terms = outcome.terms.map(|term| term / cost(outcome));
        for (row, a) in rows.iter_mut().zip(terms) {
            for (cell, b) in row.iter_mut().zip(terms.into_iter().chain([1.0])) {
                *cell += a * b;
            }
        }
    }
    for column in 0..TERMS {
        let pivot = (column..TERMS).max_by(|&a, &b| rows[a][column].abs().total_cmp(&rows[b][column].abs()))?;
        rows.swap(column, pivot);
        let first = rows[column];
        if first[column] == 0.0 {
            return None;
        }
        for (number, row) in rows.iter_mut().enumerate() {
            let factor = row[column] / first[column];
            if number != column {
                row.iter_mut().zip(first).for_each(|(cell, above)| *cell -= factor * above);
            }
        }
    }
    Some(std::array::from_fn(|term| rows[term][TERMS] / rows[term][term]))
}

/// Two panels, cost over triangles and over pixels, both axes logarithmic: what was measured as dots, the model as lines.
fn plot(outcomes: &[Outcome], models: &[[f64; TERMS]]) -> String {
    const PANEL: f64 = 360.0;
    const COLORS: [&str; 2] = ["#c2571a", "#2a6fb0"];
    let mut svg = String::from(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 860 430\" font-family=\"sans-serif\" font-size=\"12\">\n\
         <rect width=\"860\" height=\"430\" fill=\"white\"/>\n",
    );
    let millions = |cost: f64| (380.0 - PANEL * (cost / 0.2e6).log10() / 200_f64.log10()).round();
    for (panel, title) in ["triangles that face the eye, 240×240", "covered pixels, teapot of 4×4"].into_iter().enumerate() {
        let left = 60.0 + 420.0 * panel as f64;
        let mut chosen: Vec<_> =
            outcomes.iter().filter(|at| if panel == 0 { at.size == 240 } else { at.divisions == 4 }).collect();
        let along = |outcome: &Outcome| outcome.terms[[1, 3][panel]];
        chosen.sort_by(|a, b| along(a).total_cmp(&along(b)));
        let [first, .., last] = chosen[..] else { continue };
        let (least, most) = (along(first) / 1.2, along(last) * 1.2);
        let x = |at: f64| (left + PANEL * (at / least).ln() / (most / least).ln()).round();
        let _ = writeln!(svg, "<rect x=\"{left}\" y=\"20\" width=\"{PANEL}\" height=\"{PANEL}\" fill=\"none\" stroke=\"#888\"/>");
        let _ = writeln!(svg, "<text x=\"{}\" y=\"420\" text-anchor=\"middle\">{title}</text>", left + PANEL / 2.0);
        for cost in [0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 40.0] {
            let y = millions(1e6 * cost);
            let _ = writeln!(svg, "<path d=\"M{left} {y}h{PANEL}\" stroke=\"#ddd\"/>");
            let _ = writeln!(svg, "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{cost} M</text>", left - 4.0, y + 4.0);
        }
        for outcome in &chosen {
            let at = along(outcome);
            let _ = writeln!(svg, "<text x=\"{}\" y=\"396\" text-anchor=\"middle\" font-size=\"10\">{at:.0}</text>", x(at));
        }
        for (core, model) in models.iter().enumerate() {
            let color = COLORS[core];
            let points: String = chosen.iter().map(|at| format!("{},{} ", x(along(at)), millions(value(model, at)))).collect();
            let _ = writeln!(svg, "<polyline points=\"{points}\" fill=\"none\" stroke=\"{color}\"/>");
            for outcome in &chosen {
                let (x, y) = (x(along(outcome)), millions(outcome.costs[core]));
                let _ = writeln!(svg, "<circle cx=\"{x}\" cy=\"{y}\" r=\"4\" fill=\"{color}\"/>");
            }
            let y = 40 + 18 * core;
            let _ = writeln!(svg, "<text x=\"{}\" y=\"{y}\" fill=\"{color}\">{}</text>", left + 12.0, UNITS[core]);
        }
    }
    svg + "</svg>\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_model_finds_the_constants_that_made_the_costs() {
        let made = [30_000.0, 900.0, 250.0, 40.0];
        let outcome = |terms: [f64; TERMS]| {
            let cost = made.iter().zip(terms).map(|(constant, term)| constant * term).sum();
            Outcome { divisions: 4, size: 240, terms, costs: [cost; 2] }
        };
        let all = [[1.0, 100.0, 900.0, 7000.0], [1.0, 400.0, 2500.0, 22_000.0], [1.0, 400.0, 600.0, 1500.0]];
        let all: Vec<_> =
            all.into_iter().chain([[1.0, 6000.0, 9000.0, 22_100.0], [1.0, 480.0, 5100.0, 90_000.0]]).map(outcome).collect();
        let found = fit(&all, |outcome| outcome.costs[0]).unwrap();
        assert!(found.iter().zip(made).all(|(a, b)| (a / b - 1.0).abs() < 1e-6), "{found:?}");
        assert_eq!(fit(&[], |outcome| outcome.costs[0]), None);
    }
}
