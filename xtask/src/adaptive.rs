//! *Adaptive Shading*'s Tables 1 and 2 made anew.

use crate::count::{self, Count};
use crate::cycles;
use crate::firmware::{self, Target, MEASURE, TARGETS};
use crate::table;
use anyhow::{Context, Result};

/// A row of the document's tables, and the method here that stands for it.
struct Printed {
    method: &'static str,
    name: &'static str,
    /// Milliseconds by software at 256×256 and 512×512, Table 1.
    milliseconds: Option<[f64; 2]>,
    /// Triangles drawn, and split, at both sizes, Table 2.
    triangles: Option<[[f64; 2]; 2]>,
}

/// *Adaptive Shading*, Tables 1 and 2, software renderer; the library's default beside them.
const PRINTED: [Printed; 6] = [
    Printed {
        method: "gouraud",
        name: "Gouraud",
        milliseconds: Some([480.0, 957.0]),
        triangles: Some([[896.0, 0.0], [896.0, 0.0]]),
    },
    Printed {
        method: "highlight-split",
        name: "Highlight subdivision",
        milliseconds: Some([881.0, 1408.0]),
        triangles: Some([[1538.0, 74.5], [1538.0, 74.5]]),
    },
    Printed {
        method: "regular-split",
        name: "Regular subdivision",
        milliseconds: Some([664.0, 1632.0]),
        triangles: Some([[1075.5, 288.4], [1955.6, 288.4]]),
    },
    Printed { method: "gouraud-phong", name: "Gouraud + Phong", milliseconds: Some([1104.0, 3436.0]), triangles: None },
    Printed { method: "phong", name: "Phong", milliseconds: Some([3763.0, 14630.0]), triangles: None },
    Printed { method: "duff-barycentric", name: "(the default)", milliseconds: None, triangles: None },
];

/// The scenes.
const SCENES: [&str; 2] = ["adaptive-256", "adaptive-512"];

/// Triangles of the mesh.
const MESH: f64 = 880.0;

/// The tables as Markdown: the teapot under four point lights in 60 views.
///
/// # Errors
/// If something cannot be built, or run.
pub(crate) fn text() -> Result<String> {
    let mut text = String::new();
    for (target, unit) in TARGETS.iter().zip(["million cycles, Cortex-M0+", "million instructions, Cortex-M4F"]) {
        let mut costs = Vec::new();
        for row in &PRINTED {
            let cost = |scene| mean(target, scene, row.method).with_context(|| format!("{scene}, {}", row.method));
            let [small, large] = SCENES.map(cost);
            costs.push([small?, large?]);
        }
        let relative = |cost: f64, gouraud: f64| format!("{:.2}", cost / gouraud);
        let rows = PRINTED.iter().zip(&costs).map(|(row, cost)| {
            let mut cells = vec![row.name.to_owned()];
            for size in 0..SCENES.len() {
                cells.push(format!("{:.2}", cost[size] / 1e6));
                cells.push(relative(cost[size], costs[0][size]));
                let printed = row.milliseconds.zip(PRINTED[0].milliseconds);
                cells.push(printed.map_or("–".into(), |(row, gouraud)| relative(row[size], gouraud[size])));
            }
            cells
        });
        let head = ["method", "256×256", "relative", "printed", "512×512", "relative", "printed"];
        text += &format!("Cost of a frame ({unit}) under four point lights\n\n{}\n\n", table::text(&head, rows.collect()));
    }
    text += &format!("Triangles drawn (and split), mean of the views\n\n{}\n", triangles()?);
    Ok(text)
}

/// A frame's mean cost: cycles where there is a model of them.
fn mean(target: &'static Target, scene: &str, method: &str) -> Result<f64> {
    let elf = firmware::build(MEASURE, target.triple, &["firmware", scene, method])?;
    let (_, counts) = count::run(target, &elf)?;
    let Count { instructions, cycles } = counts.mean();
    Ok(if target.model.is_some() { cycles } else { instructions } as f64)
}

/// Table 2.
fn triangles() -> Result<String> {
    let mut rows = Vec::new();
    for Printed { method, name, triangles, .. } in &PRINTED {
        let Some(printed) = triangles else { continue };
        let mut cells = vec![(*name).to_owned()];
        for (scene, [drawn, split]) in SCENES.iter().zip(printed) {
            if *method == "gouraud" {
                cells.extend([format!("{MESH:.1}"), format!("{drawn:.1}")]);
                continue;
            }
            let [ours, cut] = drawn_and_split(scene, method)?;
            cells.extend([format!("{ours:.1} ({cut:.1})"), format!("{drawn:.1} ({split})")]);
        }
        rows.push(cells);
    }
    Ok(table::text(&["method", "256×256", "printed", "512×512", "printed"], rows))
}

/// Triangles of the whole mesh as it is drawn, and those that are split, in the mean.
fn drawn_and_split(scene: &str, method: &str) -> Result<[f64; 2]> {
    let said = cycles::on_this_machine(scene, method)?;
    let (mut views, mut split, mut parts) = (0.0, 0.0, 0.0);
    for line in said.lines().filter_map(|line| line.strip_prefix("split ")) {
        let numbers = line.split(' ').map(str::parse).collect::<Result<Vec<f64>, _>>()?;
        let [_chosen, cut, into, _no_room] = numbers[..] else { continue };
        (views, split, parts) = (views + 1.0, split + cut, parts + into);
    }
    Ok([MESH + (parts - split) / views, split / views])
}
