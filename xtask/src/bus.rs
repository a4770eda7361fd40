//! What a frame takes on the bus of a panel with memory of its own.

use crate::table::{self, number};
use anyhow::{ensure, Result};
use beamshade::Changes;
use host_tests::panel::{is_in_circle, turn, Step};

/// Count the bytes on the bus of a panel with memory of its own, what changed against whole frames.
///
/// The standard scene T880 turns once, after a first frame that is sent whole. The panel is emulated: it takes commands and
/// pixels byte by byte, and what it then shows is compared with the whole frame.
#[derive(clap::Args)]
pub(crate) struct Arguments {}

/// `cargo xtask bus`.
pub(crate) fn run() -> Result<()> {
    println!("{}", text()?);
    Ok(())
}

/// The table as Markdown.
///
/// # Errors
/// If the mesh cannot be read, or a panel shows another picture.
pub(crate) fn text() -> Result<String> {
    let square = turn(Changes::new(240), |_, _| true)?;
    let alone = turn(Changes::new(240).window_price(0), |_, _| true)?;
    let round = turn(Changes::round(240), |x, y| is_in_circle(x, y, 240))?;
    let rows = [("square", &square), ("square, no shared windows", &alone), ("round", &round)];
    let head = ["panel", "first frame", "bytes", "of 115 200", "most", "windows", "most windows", "wrong pixels"];
    Ok(table::text(&head, rows.into_iter().map(|(name, steps)| row(name, steps)).collect::<Result<_>>()?))
}

fn row(name: &str, steps: &[Step]) -> Result<Vec<String>> {
    let [first, rest @ ..] = steps else { anyhow::bail!("no frames") };
    let mean = |of: fn(&Step) -> u64| rest.iter().map(of).sum::<u64>() as f64 / rest.len() as f64;
    let most = |of: fn(&Step) -> u64| rest.iter().map(of).max().unwrap_or(0);
    let bytes = |step: &Step| step.bytes;
    let windows = |step: &Step| step.windows;
    let wrong: usize = steps.iter().map(|step| step.wrong).sum();
    ensure!(wrong == 0, "{name}: {wrong} pixels are not those of whole frames");
    ensure!(steps.iter().all(|step| step.bytes == u64::from(step.sent.bytes(2))), "{name}: the library counts otherwise");
    Ok(vec![
        name.to_owned(),
        number(first.bytes),
        number(mean(bytes).round() as u64),
        format!("{:.1} %", mean(bytes) / f64::from(240 * 240 * 2) * 100.0),
        number(most(bytes)),
        format!("{:.1}", mean(windows)),
        number(most(windows)),
        wrong.to_string(),
    ])
}
