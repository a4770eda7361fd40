//! What rendering costs: instructions, cycles, RAM, stack and code, on each target, and that all render the same.

use crate::count::{self, Count, Counts};
use crate::elf::Elf;
use crate::firmware::{self, Package, Target, MEASURE, METHOD, SCENE, TARGETS};
use crate::install::{self, Need};
use crate::project::{self, progress};
use crate::{adaptive, costs, goals};
use crate::{process, table};
use anyhow::{ensure, Context, Result};
use serde_json::json;
use std::process::Command;

/// Count what rendering costs on each target, in QEMU, exactly repeatable.
///
/// Without options the table of goals follows: what the project wants to reach, and how near it is.
///
/// Instructions and cycles are the mean of the scene's frames, from the begin of a frame to its last pixel in a row;
/// the worst line is that of all frames. Cycles are those of a Cortex-M0+ with zero wait states. Code is all that the
/// measuring firmware has in flash, without the mesh. BEAMSHADE_TOOLCHAIN=debian forces the compiler with which the
/// recorded counts were made.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Print one JSON object a line.
    #[arg(long)]
    json: bool,
    /// What each shading method costs for a facet, a line and a pixel, with the tables of break-even sizes; takes long.
    #[arg(long, conflicts_with_all = ["json", "scene", "target", "functions"])]
    all: bool,
    /// What adaptive shading costs under four point lights, with its counts of triangles; takes long.
    #[arg(long, conflicts_with_all = ["all", "json", "scene", "target", "functions"])]
    adaptive: bool,
    /// The table of goals alone; fails if a figure is worse by more than 2 % than the recorded one.
    #[arg(long, conflicts_with_all = ["all", "adaptive", "json", "scene", "method", "target", "functions", "record"])]
    check: bool,
    /// The table of goals alone; records its figures in xtask/recorded.txt, to be compared with from now on.
    #[arg(long, conflicts_with_all = ["all", "adaptive", "json", "scene", "method", "target", "functions"])]
    record: bool,
    /// The scene; t880 unless said otherwise.
    #[arg(long)]
    scene: Option<String>,
    /// The shading method; the default one unless said otherwise.
    #[arg(long)]
    method: Option<String>,
    /// With --all, measure these methods alone.
    #[arg(long, value_delimiter = ',', requires = "all")]
    methods: Vec<String>,
    /// Measure this target alone, such as thumbv6m-none-eabi.
    #[arg(long)]
    target: Option<String>,
    /// Show the dearest functions of each target, this many.
    #[arg(long, value_name = "COUNT", default_value_t = 0)]
    functions: usize,
}

/// What the measuring firmware says about itself.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub(crate) struct Report {
    pub(crate) checksum: String,
    mesh_bytes: u64,
    ram: Vec<(String, u64)>,
    pub(crate) stack_bytes: u64,
}

impl Report {
    pub(crate) fn parse(text: &str) -> Result<Report> {
        let mut report = Report::default();
        for line in text.lines() {
            match line.split(' ').collect::<Vec<_>>()[..] {
                ["frame", _, _] | ["run", _] | ["split", ..] => {}
                ["checksum", sum] => report.checksum = sum.to_owned(),
                ["mesh", bytes] => report.mesh_bytes = bytes.parse()?,
                ["ram", name, bytes] => report.ram.push((name.to_owned(), bytes.parse()?)),
                ["full", frame] => anyhow::bail!("the measured scene has no room for frame {frame}"),
                ["stack", bytes] => report.stack_bytes = bytes.parse()?,
                _ => anyhow::bail!("the measuring firmware says {line:?}"),
            }
        }
        ensure!(!report.checksum.is_empty(), "the measuring firmware gave no checksum");
        Ok(report)
    }

    pub(crate) fn ram_bytes(&self) -> u64 {
        self.ram.iter().map(|(_, bytes)| bytes).sum()
    }
}

/// One target's figures.
pub(crate) struct Measured {
    pub(crate) target: &'static Target,
    elf: Elf,
    pub(crate) report: Report,
    pub(crate) counts: Counts,
}

impl Measured {
    /// Builds, runs and counts a scene by a method.
    ///
    /// # Errors
    /// If any of that fails.
    pub(crate) fn new(target: &'static Target, scene: &str, method: &str) -> Result<Measured> {
        Self::of(MEASURE, target, &["firmware", scene, method])
    }

    /// Builds, runs and counts a package with these features that speaks as the measuring firmware does.
    ///
    /// # Errors
    /// If any of that fails.
    pub(crate) fn of(package: Package, target: &'static Target, features: &[&str]) -> Result<Measured> {
        let elf = firmware::build(package, target.triple, features)?;
        let (said, counts) = count::run(target, &elf)?;
        Ok(Measured { target, elf, report: Report::parse(&said)?, counts })
    }

    /// All that is in flash, without the mesh.
    pub(crate) fn code_bytes(&self) -> u64 {
        self.elf.flash_bytes().saturating_sub(self.report.mesh_bytes)
    }

    /// Cycles, where this core has a model of them.
    pub(crate) fn cycles(&self, cycles: u64) -> Option<u64> {
        self.target.model.map(|_| cycles)
    }

    fn worst_line(&self) -> Option<u64> {
        self.cycles(self.counts.lines.iter().map(|line| line.cycles).max()?)
    }
}

/// `cargo xtask cycles`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    install::ensure(&[Need::FirmwareCompiler, Need::Qemu])?;
    if arguments.adaptive {
        println!("{}", adaptive::text()?);
        return Ok(());
    }
    if arguments.all {
        return costs::run(&arguments.methods);
    }
    if arguments.check || arguments.record {
        return goals::run(arguments.record);
    }
    let scene = arguments.scene.as_deref().unwrap_or(SCENE);
    let method = arguments.method.as_deref().unwrap_or(METHOD);
    let targets = TARGETS.iter().filter(|target| arguments.target.as_deref().is_none_or(|wanted| wanted == target.triple));
    let measured = targets.map(|target| Measured::new(target, scene, method)).collect::<Result<Vec<_>>>()?;
    ensure!(!measured.is_empty(), "no such target; there are {}", TARGETS.map(|target| target.triple).join(", "));
    let host = host(scene, method)?;

    if arguments.json {
        print_json(&measured, &host, scene, method);
    } else {
        println!("{scene}, {method}, mean of {} frames\n", measured[0].counts.frames.len());
        println!("{}\n", totals(&measured, &host));
        for one in &measured {
            print_stages(one, arguments.functions);
        }
        print_ram(&measured[0].report);
    }
    let differs = measured.iter().find(|one| one.report.checksum != host);
    ensure!(differs.is_none(), "{} renders other pixels than this machine", differs.map_or("", |one| one.target.triple));
    let plain = (&arguments.scene, &arguments.method, &arguments.target, arguments.functions, arguments.json);
    if plain == (&None, &None, &None, 0, false) {
        println!("{}", goals::text()?);
    }
    Ok(())
}

/// The same for the scene and method that stand for all, as a check.
///
/// # Errors
/// As [`run`] does: above all, if two targets render different pixels.
pub(crate) fn check() -> Result<()> {
    run(&Arguments {
        json: false,
        all: false,
        adaptive: false,
        check: false,
        record: false,
        scene: Some(SCENE.into()),
        method: None,
        methods: Vec::new(),
        target: None,
        functions: 0,
    })
}

/// The table of the standard scene by the default method, for the README.
///
/// # Errors
/// As [`run`] does.
pub(crate) fn summary() -> Result<String> {
    install::ensure(&[Need::FirmwareCompiler, Need::Qemu])?;
    let measured = TARGETS.iter().map(|target| Measured::new(target, SCENE, METHOD)).collect::<Result<Vec<_>>>()?;
    Ok(totals(&measured, &host(SCENE, METHOD)?))
}

/// What lines that know transparency cost, without a transparent surface and with one, beside plain lines, for the README.
///
/// # Errors
/// As [`run`] does.
pub(crate) fn transparent() -> Result<String> {
    install::ensure(&[Need::FirmwareCompiler, Need::Qemu])?;
    let [m0, m4, _] = &TARGETS;
    let mut rows = Vec::new();
    for (scene, name) in [
        ("t880", "T880, `line`"),
        ("t880-transparent", "T880, `transparent_line`"),
        ("t880-pane", "with a pane, `line`"),
        ("t880-pane-transparent", "with a pane, `transparent_line`"),
    ] {
        let [m0, m4] = [Measured::new(m0, scene, METHOD)?, Measured::new(m4, scene, METHOD)?];
        ensure!(m0.report.checksum == host(scene, METHOD)?, "{scene} differs from what this machine renders");
        let mean = m0.counts.mean();
        let figures = [mean.instructions, mean.cycles, m4.counts.mean().instructions, m0.report.stack_bytes, m0.code_bytes()]
            .map(table::number);
        rows.push(std::iter::once(name.to_owned()).chain(figures).collect());
    }
    Ok(table::text(&["scene", "instructions M0+", "cycles M0+", "instructions M4F", "stack M0+", "code M0+"], rows))
}

/// The checksum of the same frames, rendered by this machine.
fn host(scene: &str, method: &str) -> Result<String> {
    Ok(Report::parse(&on_this_machine(scene, method)?)?.checksum)
}

/// What the measuring program says on this machine.
///
/// # Errors
/// If it cannot be built, or fails.
pub(crate) fn on_this_machine(scene: &str, method: &str) -> Result<String> {
    process::output(&mut host_program(MEASURE, &["host", scene, method])?)
}

/// The program of a package that renders the same on this machine.
///
/// # Errors
/// If it cannot be built.
pub(crate) fn host_program(package: Package, features: &[&str]) -> Result<Command> {
    progress(format!("rendering on this machine ({})", std::env::consts::ARCH));
    let mut command = project::cargo();
    command.args(["build", "--quiet", "--release", "--bin", "host", "--features", &features.join(",")]);
    command.arg("--manifest-path").arg(project::root().join(package.path).join("Cargo.toml"));
    command.arg("--target-dir").arg(project::target()?.join("firmware"));
    let files = process::build(&mut command)?;
    let program = files.iter().find(|file| file.file_stem().is_some_and(|name| name == "host"));
    Ok(Command::new(program.context("nothing was built")?))
}

fn print_json(measured: &[Measured], host: &str, scene: &str, method: &str) {
    for one in measured {
        let mean = one.counts.mean();
        println!(
            "{}",
            json!({
                "scene": scene, "method": method, "target": one.target.triple,
                "instructions": mean.instructions, "cycles": one.cycles(mean.cycles), "worst_line_cycles": one.worst_line(),
                "ram_bytes": one.report.ram_bytes(), "stack_bytes": one.report.stack_bytes, "code_bytes": one.code_bytes(),
                "checksum": one.report.checksum,
            })
        );
    }
    println!(
        "{}",
        json!({
            "scene": scene, "method": method, "target": std::env::consts::ARCH,
            "instructions": null, "cycles": null, "worst_line_cycles": null,
            "ram_bytes": null, "stack_bytes": null, "code_bytes": null,
            "checksum": host,
        })
    );
}

/// One line for each target, and one for this machine.
fn totals(measured: &[Measured], host: &str) -> String {
    let mut rows = Vec::new();
    for one in measured {
        let mean = one.counts.mean();
        rows.push(vec![
            one.target.triple.to_owned(),
            table::number(mean.instructions),
            table::optional(one.cycles(mean.cycles)),
            table::optional(one.worst_line()),
            table::number(one.report.ram_bytes()),
            table::number(one.report.stack_bytes),
            table::number(one.code_bytes()),
            one.report.checksum.clone(),
        ]);
    }
    let mut last = vec![String::from("–"); 8];
    last[0] = std::env::consts::ARCH.to_owned();
    last[7] = host.to_owned();
    rows.push(last);
    table::text(&["target", "instructions", "cycles", "worst line", "RAM", "stack", "code", "checksum"], rows)
}

/// The mean frame by stage, and the dearest functions.
fn print_stages(one: &Measured, functions: usize) {
    let frames = one.counts.frames.len() as u64;
    let all = one.counts.frames.iter().copied().sum::<Count>();
    let row = |name: &str, count: Count| {
        let (part, whole) = match one.target.model {
            Some(_) => (count.cycles, all.cycles),
            None => (count.instructions, all.instructions),
        };
        let share = format!("{:.1} %", 100.0 * part as f64 / whole.max(1) as f64);
        let cycles = table::optional(one.cycles(count.cycles / frames));
        vec![name.to_owned(), table::number(count.instructions / frames), cycles, share]
    };
    println!("{} by stage", one.target.triple);
    table::print(
        &["stage", "instructions", "cycles", "share"],
        one.counts.stages.iter().map(|&(name, count)| row(name, count)).collect(),
    );
    if functions > 0 {
        let dearest = one.counts.functions(&one.elf);
        table::print(
            &["function", "instructions", "cycles", "share"],
            dearest.iter().take(functions).map(|(name, count)| row(name, *count)).collect(),
        );
    }
}

fn print_ram(report: &Report) {
    println!("RAM by type");
    let rows = report.ram.iter().map(|(name, bytes)| vec![name.clone(), table::number(*bytes)]).collect();
    table::print(&["type", "bytes"], rows);
}
