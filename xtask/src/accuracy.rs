//! How far the library's pictures are from the f64 reference's.

use crate::firmware::{METHOD, SCENE};
use crate::project::progress;
use crate::table;
use anyhow::{bail, ensure, Result};
use beamshade::DuffBarycentric;
use host_tests::accuracy::{self, Method, Outcome, Row, Truth, METHODS};
use host_tests::scenes::{self, Case, Illumination, Subject};
use host_tests::Measures;
use serde_json::{json, Value};

/// Compare the library's pictures with those of the f64 reference, frame by frame.
///
/// A standard scene's Gray8 shows a white body, Rgb565 an orange one under a white highlight. Colours are compared over pixels
/// that show the same triangle in both pictures, in levels of 8 bits; wrong_owner counts pixels covered in one only or by triangles
/// that share no vertex. The truth is the ideal scene; beside it stand the scene in correct perspective, and the quantised mesh with
/// its vertices snapped to 1/256 pixel, which leaves the errors of the arithmetic alone.
///
/// With --all, every method is compared on every case in Gray8 against the ideal scene.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Print one JSON object a line: each frame, output and truth.
    #[arg(long)]
    json: bool,
    /// Every method on every case: scenes, lights, exponents.
    #[arg(long)]
    all: bool,
    /// The scene: t880 or t5560; with --all only this one of t880, t880-512, i320, i80, triangle.
    #[arg(long)]
    scene: Option<String>,
    /// The shading method, or several with commas between; with --all only these.
    #[arg(long, value_delimiter = ',')]
    method: Vec<String>,
    /// With --all only this light: directional or point, or how its name begins.
    #[arg(long, requires = "all")]
    light: Option<String>,
}

/// `cargo xtask accuracy`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let methods: Vec<_> = arguments.method.iter().map(|name| Method::named(name)).collect::<Result<_>>()?;
    if arguments.all {
        all(arguments, methods)
    } else {
        standard(arguments, methods)
    }
}

/// A standard scene, in all outputs and truths.
fn standard(arguments: &Arguments, mut methods: Vec<&'static Method>) -> Result<()> {
    let scene = arguments.scene.as_deref().unwrap_or(SCENE);
    let mesh = match scene {
        "t880" => scenes::teapot_880()?,
        "t5560" => scenes::teapot_5560()?,
        other => bail!("there is no scene {other:?}; there are t880 and t5560"),
    };
    if methods.is_empty() {
        methods.push(Method::named(METHOD)?);
    }
    for method in methods {
        let mut step = |frame: u32| {
            if frame.is_multiple_of(20) {
                progress(format!("{scene}, {}: frame {frame} of {}", method.name, scenes::FRAMES));
            }
        };
        let rows = (method.standard)(&mesh, &mut step)?;
        if arguments.json {
            let exponent = accuracy::exponent(&scenes::WHITE);
            rows.iter().for_each(|row| println!("{}", object(scene, method.name, "directional", exponent, row)));
        } else {
            println!("{scene}, {}, worst of {} frames\n", method.name, scenes::FRAMES);
            println!("{}\n", text(&rows));
        }
    }
    Ok(())
}

/// Every case.
fn all(arguments: &Arguments, mut methods: Vec<&'static Method>) -> Result<()> {
    let mut cases: Vec<_> = Case::all().collect();
    if let Some(scene) = &arguments.scene {
        cases.retain(|case| case.subject.name() == scene);
    }
    if let Some(light) = &arguments.light {
        cases.retain(|case| case.light.name().starts_with(light.as_str()));
    }
    let names = || Subject::ALL.map(Subject::name).join(", ");
    ensure!(!cases.is_empty(), "there are the scenes {}, and the lights directional and point", names());
    if methods.is_empty() {
        methods.extend(METHODS);
    }
    let step = |case: Case| progress(format!("{}, {} light, exponent {}", case.subject.name(), case.light.name(), case.exponent));
    let outcomes = accuracy::compare(&cases, &methods, step)?;
    if arguments.json {
        for Outcome { case, method, rows } in &outcomes {
            for row in rows {
                println!("{}", object(case.subject.name(), method, case.light.name(), case.exponent.into(), row));
            }
        }
        return Ok(());
    }
    print!("{}", by_case(&methods, &outcomes));
    Ok(())
}

/// The tables of every method on every case, for docs/shading.md.
///
/// # Errors
/// If a case cannot be drawn.
pub(crate) fn every_case() -> Result<String> {
    let methods: Vec<_> = METHODS.iter().collect();
    let outcomes = accuracy::compare(&Case::all().collect::<Vec<_>>(), &methods, |case| progress(case.subject.name()))?;
    Ok(by_case(&methods, &outcomes))
}

/// A table for each scene and light.
fn by_case(methods: &[&Method], outcomes: &[Outcome]) -> String {
    let mut text =
        String::from("Gray8 against the ideal scene, worst frame measure by measure: PSNR dB / mean / max / over 4 %\n\n");
    for subject in Subject::ALL {
        for light in Illumination::ALL {
            let these: Vec<_> = outcomes.iter().filter(|at| at.case.subject == subject && at.case.light == light).collect();
            if !these.is_empty() {
                text += &format!("**{}, {} light, {} frames**\n\n", subject.name(), light.name(), subject.frames().count());
                text += &format!("{}\n\n", side_by_side(methods, &these));
            }
        }
    }
    text
}

/// Methods in rows, exponents in columns.
fn side_by_side(methods: &[&Method], outcomes: &[&Outcome]) -> String {
    let row = |method: &&Method| {
        let of = |outcome: &&&Outcome| outcome.method == method.name;
        let worst: Vec<_> =
            outcomes.iter().filter(of).filter_map(|outcome| accuracy::worst(&outcome.rows.iter().collect::<Vec<_>>())).collect();
        let cell = |measures: &Measures| {
            let Measures { psnr_db, mean, max, over4_share, .. } = measures;
            format!("{psnr_db:.1} / {mean:.2} / {max} / {:.2}", 100.0 * over4_share)
        };
        let same_owner = worst.iter().map(|measures| measures.same_owner_share).fold(1.0, f64::min);
        let mut cells = vec![method.name.to_owned()];
        cells.extend(worst.iter().map(cell));
        cells.push(format!("{:.3}", 100.0 * same_owner));
        cells
    };
    let exponents = Case::EXPONENTS.map(|exponent| format!("exponent {exponent}"));
    let head: Vec<_> = ["method"].into_iter().chain(exponents.iter().map(String::as_str)).chain(["same owner %"]).collect();
    table::text(&head, methods.iter().map(row).collect())
}

/// The table of the standard scene by the default method, for the README.
///
/// # Errors
/// If the scene cannot be drawn.
pub(crate) fn summary() -> Result<String> {
    progress(format!("{SCENE}, {METHOD}"));
    Ok(text(&accuracy::standard::<DuffBarycentric>(&scenes::teapot_880()?, |_| ())?))
}

/// A row as JSON; a PSNR without any difference is null.
fn object(scene: &str, method: &str, light: &str, exponent: u32, row: &Row) -> Value {
    let Measures { psnr_db, mean, max, over4_share, same_owner_share, wrong_owner, wrong_neighbour, .. } = row.measures;
    json!({
        "scene": scene, "method": method, "output": row.output, "light": light, "exponent": exponent, "frame": row.frame,
        "psnr_db": psnr_db.is_finite().then_some(psnr_db), "mean": mean, "max": max, "over4_share": over4_share,
        "same_owner_share": same_owner_share, "wrong_owner": wrong_owner, "wrong_neighbour": wrong_neighbour,
        "truth": row.truth.name(), "rounding_db": row.rounding_db,
    })
}

/// The worst frame of each output and truth, measure by measure; owners as means.
fn text(rows: &[Row]) -> String {
    let mut lines = Vec::new();
    for output in ["gray8", "rgb565"] {
        for truth in [Truth::Ideal, Truth::Perspective, Truth::Quantized] {
            let these: Vec<_> = rows.iter().filter(|row| row.output == output && row.truth == truth).collect();
            let Some(worst) = accuracy::worst(&these) else { continue };
            let frames = these.len() as f64;
            // The frame that is farthest below what rounding alone leaves.
            let loss = these.iter().filter_map(|row| Some(row.rounding_db? - row.measures.psnr_db)).reduce(f64::max);
            lines.push(vec![
                output.to_owned(),
                truth.name().to_owned(),
                format!("{:.2}", worst.psnr_db),
                loss.map_or("–".into(), |loss| format!("{loss:.3}")),
                format!("{:.3}", worst.mean),
                worst.max.to_string(),
                format!("{:.4}", 100.0 * worst.over4_share),
                format!("{:.3}", 100.0 * worst.same_owner_share),
                format!("{:.2}", worst.wrong_owner as f64 / frames),
                format!("{:.2}", worst.wrong_neighbour as f64 / frames),
            ]);
        }
    }
    let head = [
        "output",
        "truth",
        "PSNR dB",
        "below rounding dB",
        "mean",
        "max",
        "over 4 %",
        "same owner %",
        "wrong owner",
        "wrong neighbour",
    ];
    table::text(&head, lines)
}
