//! What each shading method costs: *Faster Phong Shading*'s Tables 2 and 3 made anew.

use crate::count::{self, Count, Counts};
use crate::cycles::{self, Measured};
use crate::firmware::{self, Target, MEASURE, SCENE, TARGETS};
use crate::table;
use anyhow::{ensure, Context, Result};
use host_tests::accuracy::{Method, METHODS};

/// A method's costs: for a facet, for a line of it, and for a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Cost {
    facet: f64,
    line: f64,
    pixel: f64,
}

impl Cost {
    const fn new(facet: f64, line: f64, pixel: f64) -> Self {
        Self { facet, line, pixel }
    }

    /// From the counts of all parts, and the number of pixels of each span in order.
    ///
    /// A span costs its start and what shading it costs beside its pixels: by the straight line of least squares.
    fn measured(parts: &[(String, Count)], lengths: &[u64], of: impl Fn(&Count) -> u64) -> Result<Self> {
        let costs =
            |kind: &str| parts.iter().filter(|(name, _)| name == kind).map(|(_, count)| of(count) as f64).collect::<Vec<_>>();
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len().max(1) as f64;
        let (facets, starts, runs) = (costs("facet"), costs("start"), costs("run"));
        ensure!(runs.len() == lengths.len(), "{} spans were counted, {} were drawn", runs.len(), lengths.len());
        let lengths: Vec<_> = lengths.iter().map(|length| *length as f64).collect();
        let (length, run) = (mean(&lengths), mean(&runs));
        let together: f64 = lengths.iter().zip(&runs).map(|(x, y)| (x - length) * (y - run)).sum();
        let alone: f64 = lengths.iter().map(|x| (x - length).powi(2)).sum();
        let pixel = together / alone;
        Ok(Self { facet: mean(&facets), line: mean(&starts) + run - pixel * length, pixel })
    }

    /// Of a square facet of `side`² pixels.
    fn square(&self, side: f64) -> f64 {
        self.facet + self.line * side + self.pixel * side * side
    }

    /// Pixels of a square facet from which on this method is cheaper than the other; none if it never is, 0 if it always is.
    fn breaks_even(&self, other: &Self) -> Option<f64> {
        let (facet, line, pixel) = (self.facet - other.facet, self.line - other.line, self.pixel - other.pixel);
        if pixel == 0.0 && line < 0.0 {
            return Some((-facet / line).max(0.0).powi(2));
        }
        if pixel >= 0.0 {
            return None;
        }
        let root = (line * line - 4.0 * pixel * facet).sqrt();
        if root.is_nan() {
            return Some(0.0);
        }
        let side = (-line - root) / (2.0 * pixel);
        Some(side.max(0.0).powi(2))
    }
}

/// A row of the paper's Table 2 with its errata corrected: operations, for constant and for varying directions.
struct Printed {
    method: &'static str,
    constant: Cost,
    varying: Cost,
}

/// *Faster Phong Shading*, Table 2. Duff's line is 7 by its own operations (printed 6), a pixel of Phong with varying directions 81
/// (printed 64: one reciprocal root is missing).
const PRINTED: [Printed; 7] = [
    Printed { method: "phong", constant: Cost::new(24.0, 21.0, 46.0), varying: Cost::new(144.0, 45.0, 81.0) },
    Printed { method: "phong-planes", constant: Cost::new(73.0, 2.0, 46.0), varying: Cost::new(247.0, 2.0, 81.0) },
    Printed { method: "duff-direct", constant: Cost::new(130.0, 19.0, 32.0), varying: Cost::new(426.0, 67.0, 57.0) },
    Printed { method: "duff-differences", constant: Cost::new(167.0, 7.0, 32.0), varying: Cost::new(581.0, 17.0, 57.0) },
    Printed { method: "bishop-weimer", constant: Cost::new(273.0, 8.0, 12.0), varying: Cost::new(732.0, 8.0, 12.0) },
    Printed { method: "angular-trapezia", constant: Cost::new(434.0, 282.0, 5.0), varying: Cost::new(1080.0, 353.0, 5.0) },
    Printed { method: "angular-triangle", constant: Cost::new(198.0, 282.0, 5.0), varying: Cost::new(578.0, 353.0, 5.0) },
];

/// One method on one core.
struct Row {
    method: &'static str,
    /// A frame of T880: all of it.
    frame: u64,
    constant: Cost,
    varying: Cost,
    /// What one more directional light adds to a frame.
    light: f64,
    /// A frame with one light and the viewer in the scene.
    point: f64,
    code_bytes: u64,
}

/// Prints what the methods cost on Cortex-M0+ (cycles) and Cortex-M4F (instructions).
///
/// # Errors
/// If one cannot be measured.
pub(crate) fn run(wanted: &[String]) -> Result<()> {
    wanted.iter().try_for_each(|name| Method::named(name).map(|_| ()))?;
    println!("{}", text(wanted)?);
    Ok(())
}

/// The tables as Markdown.
///
/// # Errors
/// As [`run`].
pub(crate) fn text(wanted: &[String]) -> Result<String> {
    let lengths = lengths("t880-parts", "flat")?;
    let mut text = String::new();
    for (target, unit) in TARGETS.iter().zip(["cycles, Cortex-M0+", "instructions, Cortex-M4F"]) {
        let methods = METHODS.iter().filter(|method| wanted.is_empty() || wanted.iter().any(|name| name == method.name));
        let rows = methods.map(|method| measure(target, method.name, &lengths)).collect::<Result<Vec<_>>>()?;
        text +=
            &format!("Costs of the methods ({unit}); beside them the operations of the paper's Table 2\n\n{}\n\n", costs(&rows));
        for (title, of) in [("constant", false), ("varying", true)] {
            text += &format!(
                "Break-even ({unit}), {title} directions: pixels of a square facet from which on the row is cheaper than the column; \
                 in brackets by the paper's operations\n\n{}\n\n",
                break_even(&rows, of)
            );
            text += &format!("Cheapest ({unit}), {title} directions, by pixels of a square facet: {}\n\n", cheapest(&rows, of));
        }
    }
    Ok(text)
}

/// Pixels of each span of a scene, in order.
fn lengths(scene: &str, method: &str) -> Result<Vec<u64>> {
    let said = cycles::on_this_machine(scene, method)?;
    said.lines().filter_map(|line| line.strip_prefix("run ")).map(|length| Ok(length.parse()?)).collect()
}

fn measure(target: &'static Target, method: &'static str, lengths: &[u64]) -> Result<Row> {
    let of = |count: &Count| if target.model.is_some() { count.cycles } else { count.instructions };
    let counts = |scene: &str| -> Result<Counts> {
        let elf = firmware::build(MEASURE, target.triple, &["firmware", scene, method])?;
        Ok(count::run(target, &elf)?.1)
    };
    let parts = |scene: &str| {
        // Spans are the same whatever shades them, unless triangles are split.
        let own = method.ends_with("-split").then(|| self::lengths(scene, method)).transpose()?;
        Cost::measured(&counts(scene)?.parts, own.as_deref().unwrap_or(lengths), of).with_context(|| format!("{scene}, {method}"))
    };
    let whole = Measured::new(target, SCENE, method)?;
    // Every fifth frame of T880 is one of the twelve of the other scenes.
    let mean = |frames: &mut dyn Iterator<Item = &Count>| {
        let all: Vec<_> = frames.map(|count| of(count) as f64).collect();
        all.iter().sum::<f64>() / all.len() as f64
    };
    let one = mean(&mut whole.counts.frames.iter().step_by(5));
    let four = mean(&mut counts("t880-four-lights")?.frames.iter());
    let point = mean(&mut counts("t880-point-light")?.frames.iter());
    Ok(Row {
        method,
        frame: of(&whole.counts.mean()),
        constant: parts("t880-parts")?,
        varying: parts("t880-point-parts")?,
        light: (four - one) / 3.0,
        point,
        code_bytes: whole.code_bytes(),
    })
}

fn printed(method: &str) -> Option<&'static Printed> {
    PRINTED.iter().find(|row| row.method == method)
}

/// Facet, line, pixel: measured, and the paper's.
fn costs(rows: &[Row]) -> String {
    let three = |cost: &Cost| format!("{:.0} / {:.0} / {:.1}", cost.facet, cost.line, cost.pixel);
    let operations = |cost: Option<&Cost>| cost.map_or("–".into(), |c| format!("{} / {} / {}", c.facet, c.line, c.pixel));
    let lines = rows.iter().map(|row| {
        vec![
            row.method.to_owned(),
            three(&row.constant),
            operations(printed(row.method).map(|row| &row.constant)),
            three(&row.varying),
            operations(printed(row.method).map(|row| &row.varying)),
            table::number(row.frame),
            table::number(row.light.round() as u64),
            table::number(row.point.round() as u64),
            table::number(row.code_bytes),
        ]
    });
    let head = [
        "method",
        "facet / line / pixel",
        "operations",
        "the same, lights in the scene",
        "operations",
        "frame of T880",
        "a further light",
        "frame, point light",
        "code bytes",
    ];
    table::text(&head, lines.collect())
}

/// Table 3.
fn break_even(rows: &[Row], varying: bool) -> String {
    let in_paper: Vec<_> = rows.iter().filter_map(|row| Some((row, printed(row.method)?))).collect();
    let measured = |row: &Row| if varying { row.varying } else { row.constant };
    let operations = |row: &Printed| if varying { row.varying } else { row.constant };
    let pixels = |pixels: Option<f64>| pixels.map_or("never".into(), |pixels| format!("{pixels:.0}"));
    let lines = in_paper.iter().map(|(row, paper)| {
        let against = in_paper.iter().map(|(other, other_paper)| {
            if row.method == other.method {
                return String::new();
            }
            let ours = measured(row).breaks_even(&measured(other));
            let theirs = operations(paper).breaks_even(&operations(other_paper));
            format!("{} ({})", pixels(ours), pixels(theirs))
        });
        std::iter::once(row.method.to_owned()).chain(against).collect()
    });
    let lines = lines.collect();
    let head: Vec<_> = std::iter::once("method").chain(in_paper.iter().map(|(row, _)| row.method)).collect();
    table::text(&head, lines)
}

/// Which of the paper's methods is cheapest for which facet, up to 128×128 pixels.
fn cheapest(rows: &[Row], varying: bool) -> String {
    let mut ranges: Vec<(&str, u32)> = Vec::new();
    for side in 1..=128_u32 {
        let cost = |row: &&Row| if varying { row.varying } else { row.constant }.square(side.into());
        let rows = rows.iter().filter(|row| printed(row.method).is_some());
        let Some(best) = rows.min_by(|a, b| cost(a).total_cmp(&cost(b))) else { continue };
        if ranges.last().is_none_or(|(method, _)| *method != best.method) {
            ranges.push((best.method, side * side));
        }
    }
    ranges.iter().map(|(method, from)| format!("{method} from {from}")).collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's own Table 3 follows from its Table 2, rounded up; but where pixels cost the same it gives scanlines (printed 3
    /// for 2 against 1).
    #[test]
    fn break_even_as_in_the_paper() {
        let by_number = |number: usize| &PRINTED[number - 1];
        for (method, other, pixels) in
            [(2, 1, 7.0), (3, 1, 8.0), (5, 1, 7.0), (6, 1, 59.0), (7, 1, 49.0), (7, 2, 53.0), (6, 5, 1578.0)]
        {
            let found = by_number(method).constant.breaks_even(&by_number(other).constant).unwrap_or(f64::NAN);
            assert_eq!(found.ceil(), pixels, "{method} against {other}");
        }
        assert_eq!(PRINTED[0].constant.breaks_even(&PRINTED[1].constant), None);
    }

    #[test]
    fn costs_are_taken_apart() -> Result<()> {
        let count = |kind: &str, instructions| (kind.to_owned(), Count { instructions, cycles: 0 });
        let parts = [count("facet", 100), count("start", 10), count("run", 35), count("start", 12), count("run", 95)];
        let cost = Cost::measured(&parts, &[2, 8], |count| count.instructions)?;
        assert_eq!(cost, Cost::new(100.0, 11.0 + 15.0, 10.0));
        assert!(Cost::measured(&parts, &[2], |count| count.instructions).is_err());
        Ok(())
    }
}
