//! What the project wants rendering to cost, how near it is, and what was recorded.
//!
//! A row is one build, that is a scene and a method on a core, with the accuracy of that method beside it. Rows are data: when a better
//! method comes, its name goes here, and the record is made anew.

use crate::cycles::Measured;
use crate::firmware::{Target, METHOD, TARGETS};
use crate::install::{self, Need};
use crate::project::{self, progress};
use crate::{table, toolchain};
use anyhow::{bail, ensure, Context, Result};
use host_tests::accuracy::{self, Method};
use host_tests::scenes;
use std::collections::BTreeMap;

/// The cheapest method that keeps 48 dB in the worst frame of T880 and T5560.
const CHEAP: &str = "hybrid-8";

/// The recorded figures.
const RECORD: &str = "xtask/recorded.txt";

/// By how much a figure may get worse than the recorded one.
const TOLERANCE: f64 = 0.02;

/// What is told of a build.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Figure {
    /// Of the mean frame.
    Cycles,
    /// Of the mean frame.
    Instructions,
    RamBytes,
    /// In flash, without the mesh.
    CodeBytes,
    /// Of the build of all on this core that is deepest.
    DeepestStack,
}

/// A line of the table.
#[derive(Debug)]
struct Row {
    name: &'static str,
    figure: Figure,
    target: &'static Target,
    scene: &'static str,
    method: &'static str,
    /// What would do, and what is aimed at.
    goal: Option<[u64; 2]>,
    /// The PSNR that the worst frame must have.
    least_db: Option<f64>,
}

const M0: &Target = &TARGETS[0];
const M4: &Target = &TARGETS[1];

const fn row(name: &'static str, figure: Figure, target: &'static Target, build: [&'static str; 2]) -> Row {
    let [scene, method] = build;
    Row { name, figure, target, scene, method, goal: None, least_db: None }
}

impl Row {
    const fn goal(self, floor: u64, goal: u64) -> Row {
        Row { goal: Some([floor, goal]), ..self }
    }

    const fn at_least(self, db: f64) -> Row {
        Row { least_db: Some(db), ..self }
    }
}

const ROWS: [Row; 15] = [
    row("T880, M0+ cycles", Figure::Cycles, M0, ["t880", CHEAP]).goal(2_600_000, 1_840_000).at_least(48.0),
    row("T880, M4F instructions", Figure::Instructions, M4, ["t880", CHEAP]).goal(1_300_000, 900_000).at_least(48.0),
    row("T880 by the default, M0+ cycles", Figure::Cycles, M0, ["t880", METHOD]).goal(3_300_000, 2_600_000).at_least(58.0),
    row("T5560, M4F instructions", Figure::Instructions, M4, ["t5560", CHEAP]).goal(4_300_000, 3_000_000).at_least(48.0),
    row("T5560, M0+ cycles", Figure::Cycles, M0, ["t5560", CHEAP]).goal(9_000_000, 6_000_000).at_least(48.0),
    row("RAM in the T880 rows", Figure::RamBytes, M0, ["t880", CHEAP]).goal(16_000, 10_000).at_least(48.0),
    row("RAM of the smallest T880", Figure::RamBytes, M0, ["t880-lean", "flat"]).goal(10_000, 8_000),
    row("code, one method, one pixel format", Figure::CodeBytes, M0, ["t880", CHEAP]).goal(20_000, 12_000),
    row("deepest stack of all", Figure::DeepestStack, M0, ["t880", METHOD]).goal(2_000, 1_000),
    row("the smallest T880, M0+ cycles", Figure::Cycles, M0, ["t880-lean", "flat"]),
    row("sphere of 80 faces over the screen, M0+ cycles", Figure::Cycles, M0, ["i80", METHOD]),
    row("three objects through each other, M0+ cycles", Figure::Cycles, M0, ["three-objects", METHOD]),
    row("T880, four directional lights, M0+ cycles", Figure::Cycles, M0, ["t880-four-lights", METHOD]),
    row("T880, one point light, M0+ cycles", Figure::Cycles, M0, ["t880-point-light", METHOD]),
    row("T880 at 320×240, M0+ cycles", Figure::Cycles, M0, ["t880-320", METHOD]),
];

/// A row, measured.
struct Outcome {
    row: &'static Row,
    /// The row's, but for the deepest stack.
    method: &'static str,
    figure: u64,
    /// PSNR of the worst frame, where the scene is one of the two that accuracy is measured on.
    db: Option<f64>,
}

/// Prints the table; then compares it with the record, or writes that anew.
///
/// # Errors
/// If a figure is worse than recorded, or something cannot be measured.
pub(crate) fn run(record: bool) -> Result<()> {
    let outcomes = measure()?;
    println!("{}\n", table(&outcomes));
    let path = project::root().join(RECORD);
    if record {
        std::fs::write(&path, written(&outcomes)?)?;
        progress(format!("{} is written", project::shown(&path)));
        return Ok(());
    }
    let text = std::fs::read_to_string(&path).with_context(|| RECORD)?;
    let (worse, better) = compare(&outcomes, &read(&text)?);
    better.iter().for_each(|line| println!("better than recorded: {line}"));
    ensure!(worse.is_empty(), "worse than {RECORD}; on purpose, `cargo xtask cycles --record` keeps it:\n{}", worse.join("\n"));
    Ok(())
}

/// The table as Markdown.
///
/// # Errors
/// If something cannot be measured.
pub(crate) fn text() -> Result<String> {
    Ok(table(&measure()?))
}

fn measure() -> Result<Vec<Outcome>> {
    install::ensure(&[Need::FirmwareCompiler, Need::Qemu])?;
    let accuracies = accuracies()?;
    let mut builds = BTreeMap::new();
    for Row { target, scene, method, .. } in &ROWS {
        let build = (target.triple, *scene, *method);
        if let std::collections::btree_map::Entry::Vacant(place) = builds.entry(build) {
            place.insert(Measured::new(target, scene, method)?);
        }
    }
    let outcome = |row: &'static Row| {
        let mut build = (row.target.triple, row.scene, row.method);
        if row.figure == Figure::DeepestStack {
            let deepest =
                builds.iter().filter(|(build, _)| build.0 == row.target.triple).max_by_key(|(_, it)| it.report.stack_bytes);
            build = deepest.map_or(build, |(build, _)| *build);
        }
        let (_, scene, method) = build;
        let build: &Measured = &builds[&build];
        let mean = build.counts.mean();
        let figure = match row.figure {
            Figure::Cycles => mean.cycles,
            Figure::Instructions => mean.instructions,
            Figure::RamBytes => build.report.ram_bytes(),
            Figure::CodeBytes => build.code_bytes(),
            Figure::DeepestStack => build.report.stack_bytes,
        };
        // Which build is deepest changes, and its accuracy with it.
        let db = accuracies.get(&(shown(scene), method)).copied().filter(|_| row.figure != Figure::DeepestStack);
        Outcome { row, method, figure, db }
    };
    Ok(ROWS.iter().map(outcome).collect())
}

/// The scene that a build shows: vertices made anew show the same pixels.
fn shown(scene: &str) -> &str {
    scene.strip_suffix("-lean").unwrap_or(scene)
}

/// The PSNR of the worst frame by scene and method.
fn accuracies() -> Result<BTreeMap<(&'static str, &'static str), f64>> {
    let mut found = BTreeMap::new();
    for (scene, mesh) in [("t880", scenes::teapot_880()?), ("t5560", scenes::teapot_5560()?)] {
        progress(format!("comparing {scene} with the reference"));
        let names: std::collections::BTreeSet<_> =
            ROWS.iter().filter(|row| shown(row.scene) == scene).map(|row| row.method).collect();
        let methods = names.iter().map(|name| Method::named(name)).collect::<Result<Vec<_>>>()?;
        let worst = accuracy::worst_db(&mesh, &methods)?;
        found.extend(names.into_iter().map(|name| (scene, name)).zip(worst));
    }
    Ok(found)
}

fn table(outcomes: &[Outcome]) -> String {
    let line = |Outcome { row, method, figure, db }: &Outcome| {
        let ratio = |goal: u64| format!("{} ({:.2})", table::number(goal), *figure as f64 / goal as f64);
        let [floor, goal] = row.goal.map_or([String::from("–"), String::from("–")], |goals| goals.map(ratio));
        vec![
            row.name.to_owned(),
            (*method).to_owned(),
            table::number(*figure),
            floor,
            goal,
            db.map_or("–".into(), |db| format!("{db:.1}")),
            row.least_db.map_or("–".into(), |db| format!("{db:.0}")),
        ]
    };
    let head = ["what", "method", "measured", "floor (ratio)", "goal (ratio)", "PSNR dB", "at least"];
    table::text(&head, outcomes.iter().map(line).collect())
}

/// A recorded figure.
#[derive(Debug, PartialEq)]
struct Recorded {
    figure: u64,
    db: Option<f64>,
}

/// The record as text.
fn written(outcomes: &[Outcome]) -> Result<String> {
    let version = toolchain::pick(M0.triple)?.version()?;
    let mut text = format!(
        "# What the rows of `cargo xtask cycles --check` came to, by {version}: figure, PSNR of the worst frame, method, row.\n\
         # Written by `cargo xtask cycles --record`, on purpose only.\n"
    );
    for Outcome { row, method, figure, db } in outcomes {
        let db = db.map_or("-".into(), |db| format!("{db:.2}"));
        text += &format!("{figure:>9} {db:>6} {method:<18} {}\n", row.name);
    }
    Ok(text)
}

/// The record by the names of its rows.
fn read(text: &str) -> Result<BTreeMap<String, Recorded>> {
    let mut found = BTreeMap::new();
    for line in text.lines().filter(|line| !line.starts_with('#')) {
        let words: Vec<_> = line.split_whitespace().collect();
        let [figure, db, _method, name @ ..] = &words[..] else { bail!("{RECORD}: {line:?} is no record") };
        let recorded = Recorded { figure: figure.parse()?, db: (*db != "-").then(|| db.parse()).transpose()? };
        found.insert(name.join(" "), recorded);
    }
    Ok(found)
}

/// What is worse than recorded, and what is better by so much that it should be recorded.
fn compare(outcomes: &[Outcome], recorded: &BTreeMap<String, Recorded>) -> (Vec<String>, Vec<String>) {
    let (mut worse, mut better) = (Vec::new(), Vec::new());
    for Outcome { row, figure, db, .. } in outcomes {
        let name = row.name;
        let Some(before) = recorded.get(name) else {
            worse.push(format!("{name}: not recorded yet"));
            continue;
        };
        let change = *figure as f64 / before.figure as f64 - 1.0;
        let line = format!("{name}: {} → {} ({:+.1} %)", table::number(before.figure), table::number(*figure), 100.0 * change);
        if change > TOLERANCE {
            worse.push(line);
        } else if change < -TOLERANCE {
            better.push(line);
        }
        if let Some(db) = db.filter(|db| row.least_db.is_some_and(|least| *db < least)) {
            worse.push(format!("{name}: {db:.2} dB in the worst frame are too few"));
        }
        if let (Some(db), Some(before)) = (db, before.db) {
            if *db < before * (1.0 - TOLERANCE) {
                worse.push(format!("{name}: {before:.2} → {db:.2} dB in the worst frame"));
            }
        }
    }
    (worse, better)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn outcomes(factor: f64) -> Vec<Outcome> {
        ROWS.iter().map(|row| Outcome { row, method: row.method, figure: (1e6 * factor) as u64, db: Some(60.0) }).collect()
    }

    #[test]
    fn what_is_recorded_is_read_back() -> Result<()> {
        let text =
            "# a comment\n  123456  48.10 hybrid-8           T880, M0+ cycles\n     77      - flat               deepest stack\n";
        let record = read(text)?;
        assert_eq!(record["T880, M0+ cycles"], Recorded { figure: 123_456, db: Some(48.1) });
        assert_eq!(record["deepest stack"], Recorded { figure: 77, db: None });
        assert!(read("123\n").is_err());
        Ok(())
    }

    #[test]
    fn two_percent_are_let_through() {
        let record = ROWS.iter().map(|row| (row.name.to_owned(), Recorded { figure: 1_000_000, db: Some(60.0) })).collect();
        let count = |factor| {
            let (worse, better) = compare(&outcomes(factor), &record);
            (worse.len(), better.len())
        };
        assert_eq!(count(1.0), (0, 0));
        assert_eq!(count(1.019), (0, 0));
        assert_eq!(count(1.021), (ROWS.len(), 0));
        assert_eq!(count(0.97), (0, ROWS.len()));
        assert_eq!(compare(&outcomes(1.0), &BTreeMap::new()).0.len(), ROWS.len());
    }

    #[test]
    fn too_little_accuracy_is_worse() {
        let record = ROWS.iter().map(|row| (row.name.to_owned(), Recorded { figure: 1_000_000, db: Some(48.5) })).collect();
        let with =
            |db| ROWS.iter().map(|row| Outcome { row, method: row.method, figure: 1_000_000, db: Some(db) }).collect::<Vec<_>>();
        let barred = |least: f64| ROWS.iter().filter(|row| row.least_db.is_some_and(|db| db >= least)).count();
        assert_eq!(compare(&with(58.0), &record).0.len(), 0);
        assert_eq!(compare(&with(48.0), &record).0.len(), barred(58.0));
        assert_eq!(compare(&with(47.9), &record).0.len(), barred(48.0));
    }
}
