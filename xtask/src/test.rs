//! Everything that is checked before a change lands.

use crate::board::{self, Board};
use crate::boards::{self, BOARDS};
use crate::firmware::{self, MEASURE, METHOD, SCENE, TARGETS};
use crate::install::{self, Need};
use crate::project;
use crate::{cycles, goals, oled, process, ways::WAYS};
use anyhow::{ensure, Result};
use std::collections::BTreeSet;
use std::process::Command;
use std::time::Instant;

/// Check everything that CI checks: formatting, lints, documentation, tests, firmware, the emulated panels.
///
/// Goes on to the end whatever fails, and then says what did. Missing tools are installed first.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Only the steps with this in their name.
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
}

/// A step, by name.
type Step = (&'static str, fn() -> Result<()>);

/// The steps, the quick ones first.
const STEPS: [Step; 13] = [
    ("formatting", formatting),
    ("lints", lints),
    ("documentation", documentation),
    ("host tests", host_tests),
    ("counter tests", counter_tests),
    ("boards", boards::check),
    ("no path to a panic", no_panic),
    ("methods apart", methods_apart),
    ("cycles and checksums", same_pixels),
    ("costs as recorded", as_recorded),
    ("emulated panel", emulated_panel),
    ("emulator tests", emulator_tests),
    ("emulated boards", emulated_boards),
];

/// Packages that are workspaces of their own, as the boards are.
const APART: [&str; 3] = ["xtask/compare", "xtask/counter", "xtask/measure"];

/// `cargo xtask test`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    install::ensure(&[Need::Lints, Need::FirmwareCompiler, Need::Qemu, Need::Node])?;
    let (mut passed, mut failed) = (0, Vec::new());
    for (name, step) in STEPS {
        if arguments.only.as_ref().is_some_and(|text| !name.contains(text.as_str())) {
            continue;
        }
        eprintln!("── {name}");
        let begin = Instant::now();
        let result = step();
        let seconds = begin.elapsed().as_secs_f32();
        match result {
            Ok(()) => {
                passed += 1;
                println!("ok      {name} ({seconds:.1} s)");
            }
            Err(error) => {
                println!("FAILED  {name} ({seconds:.1} s)\n{error:#}");
                failed.push(name);
            }
        }
    }
    println!("{passed} passed, {} failed", failed.len());
    ensure!(passed + failed.len() > 0, "no step has this in its name");
    ensure!(failed.is_empty(), "failed: {}", failed.join(", "));
    Ok(())
}

/// A cargo command in the repository; its output goes to stderr, as stdout is for the list of steps.
fn cargo(arguments: &[&str]) -> Command {
    let mut command = project::cargo();
    command.args(arguments).current_dir(project::root()).stdout(std::io::stderr());
    command
}

fn formatting() -> Result<()> {
    process::run(&mut cargo(&["fmt", "--all", "--check"]))?;
    for package in APART.into_iter().chain(BOARDS.map(|board| board.package.path)) {
        let manifest = format!("{package}/Cargo.toml");
        process::run(&mut cargo(&["fmt", "--check", "--manifest-path", &manifest]))?;
    }
    Ok(())
}

fn lints() -> Result<()> {
    process::run(&mut cargo(&["clippy", "--workspace", "--all-targets", "--", "--deny", "warnings"]))?;
    // The plugin and the measuring firmware's scenes are for a PC as well.
    let mut apart = vec![("xtask/compare", "host,retrofire-phong".to_owned()), ("xtask/counter", String::new())];
    apart.extend(WAYS.map(|[_, scene, method]| ("xtask/measure", format!("host,{scene},{method}"))));
    for (package, features) in apart {
        let mut command = cargo(&["clippy", "--features", &features, "--manifest-path"]);
        command.arg(format!("{package}/Cargo.toml")).arg("--target-dir").arg(project::target()?.join("counter"));
        process::run(command.args(["--", "--deny", "warnings"]))?;
    }
    Ok(())
}

fn documentation() -> Result<()> {
    process::run(cargo(&["doc", "--workspace", "--no-deps"]).env("RUSTDOCFLAGS", "--deny warnings"))
}

fn host_tests() -> Result<()> {
    process::run(&mut cargo(&["test", "--workspace"]))
}

fn counter_tests() -> Result<()> {
    let mut command = cargo(&["test", "--manifest-path", "xtask/counter/Cargo.toml", "--target-dir"]);
    process::run(command.arg(project::target()?.join("counter")))
}

/// That the measuring firmware links shows something only if one with a path to a panic does not.
fn no_panic() -> Result<()> {
    for target in &TARGETS {
        firmware::build(MEASURE, target.triple, &["firmware", SCENE, METHOD])?;
        let mut command = firmware::command(MEASURE, target.triple, &["firmware", SCENE, METHOD, "bad"])?;
        let output = command.output()?;
        ensure!(!output.status.success(), "{}: a program with a path to a panic was linked", target.triple);
        let complaint = String::from_utf8_lossy(&output.stderr);
        ensure!(complaint.contains("a_path_leads_to_a_panic"), "{}: it failed in another way:\n{complaint}", target.triple);
    }
    // Nor where the compiler sees less of it.
    let [target, ..] = &TARGETS;
    for level in ["s", "z"] {
        let mut command = firmware::command(MEASURE, target.triple, &["firmware", SCENE, METHOD])?;
        process::build(command.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", level))?;
    }
    Ok(())
}

/// That firmware with one shading method holds no instruction of another.
fn methods_apart() -> Result<()> {
    for method in ["flat", "gouraud"] {
        let [target, ..] = &TARGETS;
        let elf = firmware::build(MEASURE, target.triple, &["firmware", SCENE, method])?;
        // The file of a function of the library's shading; types have capitals.
        let shading = |name: &String| {
            let (file, _) = name.split_once("beamshade::shade::")?.1.split_once("::")?;
            file.chars().all(|c| c.is_ascii_lowercase() || c == '_').then(|| file.to_owned())
        };
        let ranges = elf.ranges(|names| names.iter().find_map(shading))?;
        let found: BTreeSet<_> = ranges.into_iter().map(|(_, _, file)| file).collect();
        let expected = BTreeSet::from([method.replace('-', "_")]);
        ensure!(found == expected, "firmware with {method} holds code of {found:?}");
        eprintln!("{method}: {} bytes of flash", elf.flash_bytes());
    }
    Ok(())
}

fn same_pixels() -> Result<()> {
    cycles::check()
}

fn as_recorded() -> Result<()> {
    goals::run(false)
}

fn emulated_panel() -> Result<()> {
    let (first, later) = (oled::show(0)?, oled::show(7)?);
    ensure!(first != later, "the picture on the panel does not move");
    oled::check(&first, 0)?;
    oled::check(&later, 7)
}

/// What the emulated panels make of bytes.
fn emulator_tests() -> Result<()> {
    let mut command = Command::new("node");
    process::run(
        command.args(["--test", "st7789.test.mjs"]).current_dir(project::root().join("xtask/bench")).stdout(std::io::stderr()),
    )
}

/// The first frames on the panels of the emulated boards; of one, until there is text in the picture.
fn emulated_boards() -> Result<()> {
    for (board, frames) in [(Board::PicoSt7789, 10), (Board::PicoGc9a01, 2)] {
        let folder = board.folder()?;
        board::emulate(board, frames, &folder)?;
        board::check(board, frames, &folder)?;
    }
    board::vga::run(3)
}
