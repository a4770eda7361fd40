//! The ways to get lines to a display, with what each takes, for T880.

use crate::cycles::Measured;
use crate::firmware::{METHOD, TARGETS};
use crate::install::{self, Need};
use crate::table::{self, number};
use anyhow::Result;
use beamshade::Schedule;

/// Count what each way to get lines to a display takes: memory, the worst line, and how many lines it must be ahead.
///
/// T880, 60 frames, cycles of a Cortex-M0+ without wait states. Ahead is the smallest number of lines with which none is late, in the
/// frame that wants most, for an SPI panel (7680 cycles of 125 MHz a line) and for doubled lines of VGA (8000). Late are, of the 240 lines of a
/// frame, those that a beam would miss at 8000 with 16 lines ahead.
#[derive(clap::Args)]
pub(crate) struct Arguments {}

/// What is told, the scene, and the method.
pub(crate) const WAYS: [[&str; 3]; 14] = [
    ["rolling, default", "t880", METHOD],
    ["rolling, quadratic intensity", "t880", "quadratic-intensity"],
    ["rolling, Gouraud", "t880", "gouraud"],
    ["rolling, flat", "t880", "flat"],
    ["rolling, vertices made anew, default", "t880-lean", METHOD],
    ["rolling, vertices made anew, flat", "t880-lean", "flat"],
    ["rolling, as planned for 8000 cycles", "t880-planned", "degrading"],
    ["rolling, one-line z-buffer, default", "t880-depth-line", METHOD],
    ["rolling, smooth lines, default", "t880-smooth", METHOD],
    ["rolling, transparent lines, default", "t880-transparent", METHOD],
    ["ring: baking, default", "t880-baking", METHOD],
    ["ring: shading, default", "t880-shading", METHOD],
    ["frozen: shading, default", "t880-frozen", METHOD],
    ["frozen: shading, flat", "t880-frozen", "flat"],
];

/// Cycles of a line of an SPI panel, and of two of VGA.
const PERIODS: [u32; 2] = [7680, 8000];

/// Lines of a ring for which late ones are told, at the second period.
const RING: u64 = 16;

/// Lines of a picture that are late where so many are kept ahead of a beam, given what each takes. One that the beam has passed is skipped,
/// so that those below it are where they belong.
fn late(lines: &[u32], period: u64, ring: u64) -> u64 {
    let (mut now, mut late) = (0, 0);
    for (line, cycles) in (0..).zip(lines) {
        // The beam starts after the time of so many lines; beside their rows there is the one that is sent, free for another one then.
        let due = (line + ring) * period;
        let start = if line > ring { now.max(line * period) } else { now };
        if start >= due {
            late += 1;
            continue;
        }
        now = start + u64::from(*cycles);
        late += u64::from(now > due);
    }
    late
}

/// `cargo xtask ways`.
pub(crate) fn run() -> Result<()> {
    println!("{}", text()?);
    Ok(())
}

/// The table as Markdown.
///
/// # Errors
/// If something cannot be built or counted.
pub(crate) fn text() -> Result<String> {
    install::ensure(&[Need::FirmwareCompiler, Need::Qemu])?;
    let [target, ..] = &TARGETS;
    let mut rows = Vec::new();
    for [name, scene, method] in WAYS {
        let measured = Measured::new(target, scene, method)?;
        let lines: Vec<_> = measured.counts.lines.iter().map(|line| line.cycles as u32).collect();
        let frames = measured.counts.frames.len().max(1);
        let ahead = |period| {
            let frames = lines.chunks(lines.len() / frames);
            frames.map(|lines| Schedule::new(lines.iter().copied(), period).look_ahead).max().unwrap_or(0)
        };
        let pictures = lines.chunks(lines.len() / frames);
        let late: u64 = pictures.map(|lines| late(lines, PERIODS[1].into(), RING)).sum();
        let [spi, vga] = PERIODS.map(|period| number(ahead(period).into()));
        let mean = lines.iter().map(|cycles| u64::from(*cycles)).sum::<u64>() / lines.len().max(1) as u64;
        let worst = lines.iter().max().copied().unwrap_or(0);
        rows.push(vec![
            name.to_owned(),
            number(measured.report.ram_bytes()),
            number(measured.report.stack_bytes),
            number(mean),
            number(worst.into()),
            spi,
            vga,
            format!("{:.1}", late as f64 / frames as f64),
        ]);
    }
    Ok(table::text(&["way", "RAM", "stack", "mean line", "worst line", "ahead for 7680", "for 8000", "late"], rows))
}

#[cfg(test)]
mod tests {
    use super::late;

    #[test]
    fn a_line_is_late_if_it_is_not_ready_when_it_is_due() {
        assert_eq!(late(&[100; 50], 100, 1), 0);
        // One ahead: nothing is borrowed from the lines before.
        assert_eq!(late(&[10, 10, 101, 10], 100, 1), 1);
        assert_eq!(late(&[10, 10, 101, 10], 100, 2), 0);
        // The first takes two and a half periods: the second passes meanwhile.
        assert_eq!(late(&[250, 10, 10, 10, 10], 100, 1), 2);
        assert_eq!(late(&[250; 6], 100, 1), 6);
    }
}
