//! How far the library's pictures are from the f64 reference's.

use crate::firmware::{METHOD, SCENE};
use crate::project::progress;
use crate::table;
use anyhow::{bail, Result};
use beamshade::{DuffBarycentric, Flat, Gouraud};
use host_tests::accuracy::{self, Row, Truth};
use host_tests::{scenes, Measures};
use serde_json::{json, Value};

/// Compare the library's pictures of a standard scene with those of the f64 reference, frame by frame.
///
/// Gray8 shows a white body, Rgb565 an orange one under a white highlight. Colours are compared over pixels that show the same
/// triangle in both pictures, in levels of 8 bits; wrong_owner counts pixels covered in one only or by triangles that share no
/// vertex. The truth is the ideal scene; beside it stand the scene in correct perspective, and the quantised mesh with its
/// vertices snapped to 1/256 pixel, which leaves the errors of the arithmetic alone.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Print one JSON object a line: each frame, output and truth.
    #[arg(long)]
    json: bool,
    /// The scene: t880 or t5560.
    #[arg(long, default_value = SCENE)]
    scene: String,
    /// The shading method: duff-barycentric, gouraud or flat.
    #[arg(long, default_value = METHOD)]
    method: String,
}

/// `cargo xtask accuracy`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    let mesh = match arguments.scene.as_str() {
        "t880" => scenes::teapot_880()?,
        "t5560" => scenes::teapot_5560()?,
        other => bail!("there is no scene {other:?}; there are t880 and t5560"),
    };
    let step = |frame: u32| {
        if frame.is_multiple_of(20) {
            progress(format!("{}, {}: frame {frame} of {}", arguments.scene, arguments.method, scenes::FRAMES));
        }
    };
    let rows = match arguments.method.as_str() {
        "duff-barycentric" => accuracy::standard::<DuffBarycentric>(&mesh, step)?,
        "gouraud" => accuracy::standard::<Gouraud>(&mesh, step)?,
        "flat" => accuracy::standard::<Flat>(&mesh, step)?,
        other => bail!("there is no method {other:?}; there are duff-barycentric, gouraud and flat"),
    };
    if arguments.json {
        rows.iter().for_each(|row| println!("{}", object(arguments, row)));
    } else {
        println!("{}, {}, worst of {} frames\n", arguments.scene, arguments.method, scenes::FRAMES);
        println!("{}\n", text(&rows));
    }
    Ok(())
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
fn object(arguments: &Arguments, row: &Row) -> Value {
    let Measures { psnr_db, mean, max, over4_share, same_owner_share, wrong_owner, wrong_neighbour, .. } = row.measures;
    json!({
        "scene": arguments.scene, "method": arguments.method, "output": row.output, "light": "directional",
        "exponent": accuracy::exponent(&scenes::WHITE), "frame": row.frame,
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
