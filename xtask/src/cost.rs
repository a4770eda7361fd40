//! Whether what lines cost is known beforehand: bounds and costs beside counted lines.

use crate::count::{self, Count};
use crate::cycles;
use crate::firmware::{self, Target, MEASURE, TARGETS};
use crate::install::{self, Need};
use crate::project::{self, progress};
use crate::{process, table};
use anyhow::{bail, ensure, Context, Result};
use beamshade::{Price, Work};
use std::fmt::Write;
use std::path::PathBuf;
use std::process::Command;

/// Check that no counted line costs more than its bound before, and its cost after it was resolved.
///
/// A thousand random scenes, T880, T5560, i80 and three teapots through each other are drawn at once, baked, and frozen, by each method
/// and on each core that has prices: cycles with zero wait states, without caches and waits of a flash. Fails if a line costs more than
/// was known, or if span tables cost more than one and a half times what is counted in the mean.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Make the prices anew, from other random scenes, and write them into src/prices.rs.
    #[arg(long)]
    calibrate: bool,
    /// Measure this target alone.
    #[arg(long, conflicts_with = "calibrate")]
    target: Option<String>,
    /// Keep what was counted in this folder.
    #[arg(long)]
    keep: Option<PathBuf>,
    /// Count nothing, but take what was kept in this folder.
    #[arg(long, conflicts_with = "keep")]
    kept: Option<PathBuf>,
}

/// Percent on top of the least prices that no line of the calibration exceeds: of the walk to the visible spans, whose counts
/// explain less, and of shading these.
const MARGINS: [f64; 2] = [12.0, 10.0];
/// How much more than the count span tables may cost in the mean.
const MEAN: f64 = 1.5;

/// A core that has prices.
struct Core {
    /// As in the names of prices.
    name: &'static str,
    /// As in texts.
    title: &'static str,
    target: Target,
    /// By method; and by rung.
    prices: [&'static Price; METHODS.len()],
    degrading: &'static [Price; 4],
}

/// The methods that have prices: what the measuring firmware calls them, and the library.
const METHODS: [[&str; 2]; 4] = [
    ["duff-barycentric", "DuffBarycentric"],
    ["quadratic-intensity", "QuadraticIntensity"],
    ["gouraud", "Gouraud"],
    ["flat", "Flat"],
];

const CORES: [Core; 2] = [
    Core {
        name: "M0_PLUS",
        title: "Cortex-M0+",
        target: TARGETS[0],
        prices: [
            &Price::M0_PLUS_DUFF_BARYCENTRIC,
            &Price::M0_PLUS_QUADRATIC_INTENSITY,
            &Price::M0_PLUS_GOURAUD,
            &Price::M0_PLUS_FLAT,
        ],
        degrading: &Price::M0_PLUS_DEGRADING,
    },
    Core {
        name: "M4",
        title: "Cortex-M4",
        target: Target { model: Some("m4"), ..TARGETS[1] },
        prices: [&Price::M4_DUFF_BARYCENTRIC, &Price::M4_QUADRATIC_INTENSITY, &Price::M4_GOURAUD, &Price::M4_FLAT],
        degrading: &Price::M4_DEGRADING,
    },
];

/// A marked stretch of a scene.
#[derive(Clone)]
struct Line {
    /// The scene is for calibration, or for checks.
    calibrate: bool,
    method: String,
    /// The way it was drawn: `line`, `bake`, `shade` or `frozen`.
    way: String,
    work: Work,
    /// What was known before.
    most: Work,
    counted: u64,
}

/// `cargo xtask cost`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    install::ensure(&[Need::FirmwareCompiler, Need::Qemu])?;
    let mut text = String::from(HEAD);
    let mut failures = Vec::new();
    let said = if arguments.kept.is_none() { cycles::on_this_machine("ways", METHODS[0][0])? } else { String::new() };
    for core in CORES.iter().filter(|core| arguments.target.as_deref().is_none_or(|wanted| wanted == core.target.triple)) {
        let (to_calibrate, to_check): (Vec<_>, Vec<_>) =
            lines(core, &said, arguments)?.into_iter().partition(|line| line.calibrate);
        let mut check = |method: &str, known: &Price| -> Result<Price> {
            let of = |lines: &[Line]| lines.iter().filter(|line| line.method == method).map(Line::clone).collect::<Vec<_>>();
            let price = if arguments.calibrate { calibrated(&of(&to_calibrate))? } else { *known };
            println!("{method}, {}\n", core.title);
            failures.extend(
                compare(&of(&to_check), &price).into_iter().map(|failure| format!("{}, {method}: {failure}", core.title)),
            );
            Ok(price)
        };
        for ([method, title], known) in METHODS.iter().zip(core.prices) {
            let name = format!("{}_{}", core.name, method.replace('-', "_").to_uppercase());
            let price = check(method, known)?;
            write!(
                text,
                "\n/// Cycles of a {} for [`{title}`](crate::{title}).\npub const {name}: Self = {};\n",
                core.title,
                list(&price)
            )?;
        }
        let rungs = (0..).zip(core.degrading).map(|(rung, known)| check(&format!("degrading-{rung}"), known));
        let rungs = rungs.collect::<Result<Vec<_>>>()?.iter().map(list).collect::<Vec<_>>().join(", ");
        let (name, title) = (core.name, core.title);
        write!(text, "\n/// The same for each rung of [`Degrading`](crate::Degrading).\npub const {name}_DEGRADING: [Self; 4] = [{rungs}];\n")?;
        progress(format!("{title} is done"));
    }
    if arguments.calibrate {
        let path = project::root().join("src/prices.rs");
        std::fs::write(&path, text + "}\n")?;
        process::output(Command::new("rustfmt").arg("--config-path").arg(project::root()).arg(&path))?;
        progress(format!("prices are in {}", project::shown(&path)));
    }
    ensure!(failures.is_empty(), "{}", failures.join("\n"));
    Ok(())
}

/// What src/prices.rs begins with.
const HEAD: &str = "//! Prices, in sixteenths of a cycle of a core without wait states: made by `cargo xtask cost --calibrate`.

use crate::{price::Price, work::Work};

/// In the order of the counts of [`Work`].
impl Price {";

/// A price list as src/prices.rs has it.
fn list(Price(prices): &Price) -> String {
    format!("Self(Work::of({:?}))", prices.counts())
}

/// Counts all lines on a core, given what this machine says of them.
fn lines(core: &Core, said: &str, arguments: &Arguments) -> Result<Vec<Line>> {
    let target = &core.target;
    if let Some(folder) = &arguments.kept {
        let text = std::fs::read_to_string(folder.join(core.name))?;
        return text.lines().filter_map(|line| line_of(line).transpose()).collect();
    }
    let mut lines = said.lines().filter_map(|line| line_of(line).transpose()).collect::<Result<Vec<_>>>()?;
    let elf = firmware::build(MEASURE, target.triple, &["firmware", "ways"])?;
    let (on_target, counts) = count::run(target, &elf)?;
    let checksum = |text: &str| text.lines().find(|line| line.starts_with("checksum ")).map(str::to_owned);
    ensure!(checksum(said) == checksum(&on_target), "{} renders other pixels than this machine", target.triple);
    ensure!(!on_target.contains("full "), "a scene has no room");
    ensure!(lines.len() == counts.lines.len(), "{} lines were drawn, {} were counted", lines.len(), counts.lines.len());
    for (line, Count { cycles, .. }) in lines.iter_mut().zip(&counts.lines) {
        line.counted = *cycles;
    }
    if let Some(folder) = &arguments.keep {
        let text = said.lines().filter(|line| line_of(line).is_ok_and(|line| line.is_some()));
        let text = text.zip(&lines).map(|(said, line)| format!("{said} {}\n", line.counted)).collect::<String>();
        std::fs::create_dir_all(folder)?;
        std::fs::write(folder.join(core.name), text)?;
    }
    Ok(lines)
}

/// What the measuring program says of a line: what the scene is for, the method, the way, what there was to do, and what there was at
/// most; then what was counted, if that is known.
fn line_of(said: &str) -> Result<Option<Line>> {
    let words: Vec<_> = said.split(' ').collect();
    let [scene @ ("calibrate" | "check"), method, way, counts @ ..] = &words[..] else { return Ok(None) };
    let counts = counts.iter().map(|word| word.parse()).collect::<Result<Vec<u32>, _>>()?;
    let (work, rest) = counts.split_at_checked(Work::COUNT).context("counts are missing")?;
    let (most, counted) = rest.split_at_checked(Work::COUNT).context("counts are missing")?;
    let counted = counted.first().copied().unwrap_or(0).into();
    let work_of = |counts: &[u32]| Ok::<_, anyhow::Error>(Work::from(<[u32; Work::COUNT]>::try_from(counts)?));
    let (method, way) = ((*method).to_owned(), (*way).to_owned());
    Ok(Some(Line { calibrate: *scene == "calibrate", method, way, work: work_of(work)?, most: work_of(most)?, counted }))
}

/// Prints how counts compare to costs and bounds; gives what is wrong.
fn compare(lines: &[Line], price: &Price) -> Vec<String> {
    let mut rows = Vec::new();
    let mut failures = Vec::new();
    for (way, what, of) in [
        ("frozen", "cost", (|line, price| price.of(line.work)) as fn(&Line, &Price) -> u32),
        ("shade", "cost", |line, price| price.of(line.work)),
        ("bake", "cost", |line, price| price.of(line.work)),
        ("line", "cost", |line, price| price.of(line.work)),
        ("bake", "bound", |line, price| price.bound(line.most)),
        ("line", "bound", |line, price| price.bound(line.most)),
    ] {
        let these =
            lines.iter().filter(|line| line.way == way).map(|line| (f64::from(of(line, price)), line.counted.max(1) as f64));
        let these: Vec<_> = these.collect();
        let (said, counted) = these.iter().fold((0.0, 0.0), |(a, b), (said, counted)| (a + said, b + counted));
        let ratios: Vec<_> = these.iter().map(|(said, counted)| said / counted).collect();
        let mean = ratios.iter().sum::<f64>() / ratios.len().max(1) as f64;
        let below = ratios.iter().filter(|ratio| **ratio < 1.0).count();
        if below > 0 {
            failures.push(format!("{below} lines take more than the {what} of {way}"));
        }
        if ["frozen", "shade"].contains(&way) && mean >= MEAN {
            failures.push(format!("the {what} of {way} is {mean:.3} times the count in the mean"));
        }
        rows.push(vec![
            format!("{what} of {way}"),
            table::number(these.len() as u64),
            table::number(below as u64),
            format!("{:.3}", ratios.iter().copied().fold(f64::INFINITY, f64::min)),
            format!("{mean:.3}"),
            format!("{:.3}", said / counted),
            format!("{:.2}", ratios.iter().copied().fold(0.0, f64::max)),
        ]);
    }
    table::print(&["known", "lines", "below the count", "least ratio", "mean ratio", "ratio of sums", "largest ratio"], rows);
    failures
}

/// The least prices at which no line costs less than was counted, with the margin: those of the least sum of costs to counts.
///
/// A linear program, solved by the simplex method in its dual form: a row for each price, a column for each line, of which that
/// enters which is farthest below its count.
fn calibrated(lines: &[Line]) -> Result<Price> {
    const N: usize = Work::COUNT;
    let dot = |a: &[f64; N], b: &[f64; N]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let columns: Vec<_> = lines.iter().map(|line| (line.work.counts().map(f64::from), line.counted.max(1) as f64)).collect();
    // What never occurs weighs next to nothing.
    let mut values = [1e-6; N];
    for (counts, counted) in &columns {
        values.iter_mut().zip(counts).for_each(|(value, count)| *value += count / counted);
    }
    let mut inverse: [[f64; N]; N] = std::array::from_fn(|row| std::array::from_fn(|column| f64::from(u8::from(row == column))));
    let mut weights = [0.0; N];
    for _ in 0..10_000 {
        let prices: [f64; N] = std::array::from_fn(|at| weights.iter().zip(&inverse).map(|(weight, row)| weight * row[at]).sum());
        let lacks = columns.iter().map(|column| (1.0 - dot(&prices, &column.0) / column.1, *column));
        let below = lacks.max_by(|(a, _), (b, _)| a.total_cmp(b)).filter(|(lack, _)| *lack > 1e-9);
        let negative = (0..N).filter(|at| prices[*at] < -1e-7).min_by(|a, b| prices[*a].total_cmp(&prices[*b]));
        let (column, weight) = match (negative, below) {
            // The slack of a price that must not be negative.
            (Some(at), _) => (std::array::from_fn(|row| f64::from(u8::from(row == at))), 0.0),
            (None, Some((_, column))) => column,
            (None, None) => {
                let shading = Work::NAMES.iter().position(|name| *name == "lines").context("no lines are counted")?;
                let with_margin = |at: usize| {
                    let margin = MARGINS[usize::from(at >= shading)];
                    (16.0 * prices[at] * (1.0 + margin / 100.0) - 1e-4).max(0.0).ceil() as u32
                };
                return Ok(Price(Work::of(std::array::from_fn(with_margin))));
            }
        };
        let along: [f64; N] = std::array::from_fn(|row| dot(&inverse[row], &column));
        let leaves =
            (0..N).filter(|row| along[*row] > 1e-9).min_by(|a, b| (values[*a] / along[*a]).total_cmp(&(values[*b] / along[*b])));
        let leaves = leaves.context("no prices cover a line of which nothing was counted")?;
        let (pivot, step) = (inverse[leaves].map(|entry| entry / along[leaves]), values[leaves] / along[leaves]);
        for row in 0..N {
            inverse[row] = std::array::from_fn(|at| inverse[row][at] - along[row] * pivot[at]);
            values[row] -= along[row] * step;
        }
        (inverse[leaves], values[leaves], weights[leaves]) = (pivot, step, weight);
    }
    bail!("no prices found")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prices_are_the_least_that_cover_all_lines() -> Result<()> {
        let line = |lines, pixels, counted| Line {
            calibrate: true,
            method: "flat".into(),
            way: "line".into(),
            work: Work { lines, pixels, ..Work::NONE },
            most: Work::NONE,
            counted,
        };
        let Price(prices) = calibrated(&[line(1, 0, 100), line(1, 10, 300), line(1, 10, 250)])?;
        let price = |least: u32| (16 * least * (100 + MARGINS[1] as u32)).div_ceil(100);
        assert_eq!((prices.lines, prices.pixels, prices.facets), (price(100), price(20), 0));
        Ok(())
    }

    #[test]
    fn what_a_line_has_to_do_is_read() -> Result<()> {
        let counts = (0..2 * Work::COUNT).map(|count| count.to_string()).collect::<Vec<_>>().join(" ");
        let Some(line) = line_of(&format!("check flat bake {counts}"))? else { bail!("nothing") };
        assert_eq!((line.way.as_str(), line.work.walked, line.most.walked), ("bake", 0, Work::COUNT as u32));
        assert!(line_of("frame 1 2")?.is_none());
        assert!(line_of("check flat line 1 2").is_err());
        Ok(())
    }
}
