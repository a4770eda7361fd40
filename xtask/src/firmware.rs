//! Building firmware.

use crate::elf::Elf;
use crate::install::{self, Need};
use crate::project::{self, progress};
use crate::qemu::{self, Machine};
use crate::{process, toolchain};
use anyhow::{ensure, Context, Result};
use std::process::Command;

/// Build the measuring firmware and that of the boards, for all their targets.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Build for this target alone, such as thumbv6m-none-eabi.
    #[arg(long)]
    target: Option<String>,
}

/// A target of the measuring firmware.
#[derive(Debug)]
pub(crate) struct Target {
    pub(crate) triple: &'static str,
    /// The emulated board that runs it.
    pub(crate) machine: Machine,
    /// The counter's model of this core's cycles, where there is one.
    pub(crate) model: Option<&'static str>,
}

/// The targets of the measuring firmware: Cortex-M0+, Cortex-M4F and a small RISC-V.
pub(crate) const TARGETS: [Target; 3] = [
    Target { triple: "thumbv6m-none-eabi", machine: qemu::MPS2_M3, model: Some("m0plus") },
    Target { triple: "thumbv7em-none-eabihf", machine: qemu::MPS2_M4, model: None },
    Target { triple: "riscv32imc-unknown-none-elf", machine: qemu::VIRT, model: None },
];

/// A package of firmware.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Package {
    /// Its folder.
    pub(crate) path: &'static str,
    /// The name of its program.
    pub(crate) program: &'static str,
}

/// What is measured unless something else is asked for: features of the measuring firmware.
pub(crate) const SCENE: &str = "t880";
pub(crate) const METHOD: &str = "duff-barycentric";

/// The measuring firmware.
pub(crate) const MEASURE: Package = Package { path: "xtask/measure", program: "measure" };

/// The OLED board's firmware, and its target.
pub(crate) const OLED: Package = Package { path: "examples/lm3s6965-oled", program: "lm3s6965-oled" };
pub(crate) const OLED_TARGET: &str = "thumbv7m-none-eabi";

/// The Raspberry Pi Pico's firmware, one for each panel, and its target.
pub(crate) const PICO_ST7789: Package = Package { path: "examples/pico-st7789", program: "pico-st7789" };
pub(crate) const PICO_GC9A01: Package = Package { path: "examples/pico-gc9a01", program: "pico-gc9a01" };
pub(crate) const PICO_TARGET: &str = "thumbv6m-none-eabi";

/// The firmware of boards, with its target.
pub(crate) const BOARDS: [(Package, &str); 3] = [(OLED, OLED_TARGET), (PICO_ST7789, PICO_TARGET), (PICO_GC9A01, PICO_TARGET)];

/// All targets of all firmware.
pub(crate) fn triples() -> impl Iterator<Item = &'static str> {
    TARGETS.iter().map(|target| target.triple).chain([OLED_TARGET])
}

/// The command that builds a package for a target.
///
/// # Errors
/// If there is no compiler for it.
pub(crate) fn command(package: Package, target: &str, features: &[&str]) -> Result<Command> {
    let toolchain = toolchain::pick(target)?;
    let (features, version) = (features.join(","), toolchain.version()?);
    progress(format!("building {} for {target} with {version}, features [{features}]", package.path));
    let mut command = toolchain.cargo(target);
    command.args(["build", "--quiet", "--release", "--target", target, "--bin", package.program]);
    command.arg("--manifest-path").arg(project::root().join(package.path).join("Cargo.toml"));
    // One folder for all firmware, so that `core` is built once for a target.
    command.arg("--target-dir").arg(project::target()?.join("firmware"));
    command.arg("--features").arg(features);
    Ok(command)
}

/// Builds a package for a target.
///
/// # Errors
/// If there is no compiler for it, if it does not build, or if what was linked is not a program.
pub(crate) fn build(package: Package, target: &str, features: &[&str]) -> Result<Elf> {
    let files = process::build(&mut command(package, target, features)?)?;
    let path = files.into_iter().find(|file| file.file_name().is_some_and(|name| name == package.program));
    Elf::open(&path.context("the build made no program")?)
}

/// `cargo xtask firmware`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    install::ensure(&[Need::FirmwareCompiler])?;
    let wanted = |triple: &str| arguments.target.as_deref().is_none_or(|target| target == triple);
    let mut built = 0;
    for target in TARGETS.iter().filter(|target| wanted(target.triple)) {
        report(&build(MEASURE, target.triple, &["firmware", SCENE, METHOD])?, target.triple);
        built += 1;
    }
    for (package, target) in BOARDS.into_iter().filter(|(_, target)| wanted(target)) {
        report(&build(package, target, &[])?, target);
        built += 1;
    }
    ensure!(built > 0, "no firmware for this target; there is for {}", triples().collect::<Vec<_>>().join(", "));
    Ok(())
}

fn report(elf: &Elf, target: &str) {
    println!("{target:<28} {:>7} bytes of flash  {}", elf.flash_bytes(), project::shown(elf.path()));
}
