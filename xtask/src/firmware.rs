//! Building firmware.

use crate::boards::BOARDS;
use crate::elf::Elf;
use crate::project::{self, progress};
use crate::qemu::{self, Machine};
use crate::{process, toolchain};
use anyhow::{Context, Result};
use std::collections::BTreeSet;
use std::process::Command;

/// A target of the measuring firmware.
#[derive(Debug, Clone, Copy)]
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
    /// Whether it needs a heap's library, `alloc`, beside `core`.
    pub(crate) heap: bool,
}

impl Package {
    pub(crate) const fn new(path: &'static str, program: &'static str) -> Self {
        Self { path, program, heap: false }
    }
}

/// What is measured unless something else is asked for: features of the measuring firmware.
pub(crate) const SCENE: &str = "t880";
pub(crate) const METHOD: &str = "duff-barycentric";

/// The measuring firmware.
pub(crate) const MEASURE: Package = Package::new("xtask/measure", "measure");

/// Other renderers on the measured scene.
pub(crate) const COMPARE: Package = Package { heap: true, ..Package::new("xtask/compare", "compare") };

/// The OLED board's firmware, and its target.
pub(crate) const OLED: Package = Package::new("examples/lm3s6965-oled", "lm3s6965-oled");
pub(crate) const OLED_TARGET: &str = "thumbv7m-none-eabi";

/// The Raspberry Pi Pico's firmware, one for each panel, and its target.
pub(crate) const PICO_ST7789: Package = Package::new("examples/pico-st7789", "pico-st7789");
pub(crate) const PICO_GC9A01: Package = Package::new("examples/pico-gc9a01", "pico-gc9a01");
pub(crate) const PICO_VGA: Package = Package::new("examples/pico-vga", "pico-vga");
pub(crate) const PICO_TARGET: &str = "thumbv6m-none-eabi";

/// All targets of all firmware.
pub(crate) fn triples() -> impl Iterator<Item = &'static str> {
    let triples = TARGETS.iter().map(|target| target.triple).chain(BOARDS.iter().map(|board| board.target));
    triples.collect::<BTreeSet<_>>().into_iter()
}

/// The command that builds a package for a target.
///
/// # Errors
/// If there is no compiler for it.
pub(crate) fn command(package: Package, target: &str, features: &[&str]) -> Result<Command> {
    let toolchain = toolchain::pick(target)?;
    let (features, version) = (features.join(","), toolchain.version()?);
    progress(format!("building {} for {target} with {version}, features [{features}]", package.path));
    let mut command = toolchain.cargo(target, package.heap);
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
