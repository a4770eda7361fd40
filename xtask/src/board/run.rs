//! A run of the emulator, and what it tells.

use crate::elf::Elf;
use crate::{process, project};
use anyhow::{ensure, Context, Result};
use serde_json::Value;
use std::fmt;
use std::path::Path;
use std::process::Command;

/// Lines of a frame.
pub(crate) const LINES: usize = 240;

/// What the emulator saw of some frames.
#[derive(Debug)]
pub(crate) struct Run {
    /// The clocks of the core and of the SPI port.
    system_hertz: f64,
    spi_hertz: f64,
    /// The deepest stack.
    stack_bytes: u64,
    /// By frame: when its last byte was on the wire, in ns.
    ends: Vec<f64>,
    /// By frame: for how long the port had been sending until then, in ns.
    busy: Vec<f64>,
    /// By frame and line: cycles in `Lines::line`.
    pub(crate) cycles: Vec<Vec<f64>>,
    /// By frame, the first excepted: from the last line before it to its first one, in ns. Geometry, mostly.
    between: Vec<f64>,
}

impl Run {
    /// Runs firmware with a panel until it has sent that many frames.
    ///
    /// # Errors
    /// If it does not get there.
    pub(crate) fn of(elf: &Elf, panel: &str, folder: &Path, frames: u32) -> Result<Run> {
        let is_line = |name: &str| name.contains("Lines<") && (name.ends_with("::line") || name.contains("::line::<"));
        let mut found = elf.functions().iter().filter(|function| is_line(&function.name));
        let line = found.next().context("the firmware has no function Lines::line")?;
        ensure!(found.next().is_none(), "the firmware has more than one function Lines::line");
        let mut command = Command::new("node");
        command.arg(project::root().join("xtask/bench/panel.mjs")).arg(elf.path()).arg(panel).arg(folder);
        process::run(command.args([frames.to_string(), line.address.to_string()]))?;

        let result: Value = serde_json::from_slice(&std::fs::read(folder.join("bench.json"))?)?;
        let frame = |key: &str| numbers(&result["frames"], key);
        let line = |key: &str| numbers(&result["lines"], key);
        let (begins, ends) = (line("begin")?, line("end")?);
        let starts = (LINES..begins.len()).step_by(LINES);
        Ok(Run {
            system_hertz: number(&result["systemHertz"])?,
            spi_hertz: number(&result["spiHertz"])?,
            stack_bytes: number(&result["stack"])? as u64,
            ends: frame("end")?,
            busy: frame("busy")?,
            cycles: line("cycles")?.chunks_exact(LINES).map(<[f64]>::to_vec).collect(),
            between: starts.map(|start| begins[start] - ends[start - 1]).collect(),
        })
    }

    /// The time that a row takes on the wire, in µs.
    pub(crate) fn row_micros(&self) -> f64 {
        LINES as f64 * 16.0 / self.spi_hertz * 1e6
    }

    /// A number of cycles in µs.
    pub(crate) fn micros(&self, cycles: f64) -> f64 {
        cycles / self.system_hertz * 1e6
    }

    /// The time from the first frame's end to the last one's, by what it went into.
    fn shares(&self) -> Shares {
        let count = self.ends.len() - 1;
        let frame = (self.ends[count] - self.ends[0]) / count as f64;
        let later = self.cycles[1..].iter().flatten().sum::<f64>() / count as f64;
        let between = self.between.iter().take(count).sum::<f64>() / count as f64;
        let (shading, bus) = (1e3 * self.micros(later), (self.busy[count] - self.busy[0]) / count as f64);
        Shares { frame, bus, shading, between, waiting: frame - shading - between }
    }
}

/// Mean of a frame, in ns.
struct Shares {
    frame: f64,
    /// The port sends.
    bus: f64,
    /// The core shades lines, it is between the last line of a frame and the first of the next, and the rest.
    shading: f64,
    between: f64,
    waiting: f64,
}

impl fmt::Display for Run {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Shares { frame, bus, shading, between, waiting } = self.shares();
        let percent = |time: f64| 100.0 * time / frame;
        let cycles = |time: f64| time * self.system_hertz / 1e15;
        let worst = |frame: usize| (0..LINES).max_by(|&a, &b| self.cycles[frame][a].total_cmp(&self.cycles[frame][b]));
        let worst = (0..self.ends.len()).filter_map(|frame| worst(frame).map(|y| (self.cycles[frame][y], frame, y)));
        let (cost, number, y) = worst.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or_default();
        let (system, spi) = (self.system_hertz / 1e6, self.spi_hertz / 1e6);
        writeln!(
            f,
            "clocks          core {system:.1} MHz, SPI {spi:.1} MHz: a row is on the wire for {:.2} µs",
            self.row_micros()
        )?;
        writeln!(f, "frame           {:.3} ms, {:.2} frames per second", frame / 1e6, 1e9 / frame)?;
        writeln!(f, "bus             busy for {:.1} % of the time", percent(bus))?;
        for (what, time) in [("shading", shading), ("between frames", between), ("rest: waiting", waiting)] {
            writeln!(f, "{what:<16}{:.3} M cycles a frame, {:.1} %", cycles(time), percent(time))?;
        }
        writeln!(f, "worst line      {:.1} µs, {cost} cycles: line {y} of frame {number}", self.micros(cost))?;
        writeln!(f, "stack           {} bytes", self.stack_bytes)
    }
}

/// A field of each object in a list.
fn numbers(list: &Value, key: &str) -> Result<Vec<f64>> {
    list.as_array().context("no list")?.iter().filter_map(|item| item.get(key)).map(number).collect()
}

fn number(value: &Value) -> Result<f64> {
    value.as_f64().with_context(|| format!("{value} is no number"))
}
