//! What a command needs of the machine, and how to get it.

use crate::toolchain::{self, Toolchain, DEBIAN_PACKAGES};
use crate::{firmware, process, project};
use anyhow::{bail, Result};
use std::process::Command;

/// Something that a command needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Need {
    /// A compiler for each of the firmware's targets.
    FirmwareCompiler,
    /// QEMU for Arm and RISC-V.
    Qemu,
    /// Node.js, which runs the emulator of the RP2040, and npm, which gets it.
    Node,
    /// `cargo fmt` and `cargo clippy`.
    Lints,
}

impl Need {
    fn met(self) -> Result<bool> {
        Ok(match self {
            Need::FirmwareCompiler => {
                let rustup = || firmware::triples().all(toolchain::rustup_has);
                match toolchain::forced()? {
                    Some(Toolchain::Rustup) => rustup(),
                    Some(Toolchain::Debian) => toolchain::debian_complete(),
                    None => toolchain::debian_complete() || rustup(),
                }
            }
            Need::Qemu => process::exists("qemu-system-arm") && process::exists("qemu-system-riscv32"),
            Need::Node => process::exists("node") && process::exists("npm"),
            Need::Lints => process::exists("cargo-clippy") && process::exists("rustfmt"),
        })
    }

    /// Debian's packages for it, as arguments of apt-get; none where it does not come from there.
    fn packages(self) -> Result<Vec<String>> {
        Ok(match self {
            Need::FirmwareCompiler if toolchain::forced()? == Some(Toolchain::Rustup) => Vec::new(),
            Need::FirmwareCompiler => DEBIAN_PACKAGES.map(String::from).to_vec(),
            Need::Qemu => qemu_packages(),
            Need::Node => vec!["nodejs".into(), "npm".into()],
            Need::Lints => Vec::new(),
        })
    }

    /// What gets it where apt does not.
    fn advice(self) -> String {
        match self {
            Need::FirmwareCompiler => format!("rustup target add {}", firmware::triples().collect::<Vec<_>>().join(" ")),
            Need::Qemu if cfg!(target_os = "macos") => "brew install qemu".into(),
            Need::Qemu => "install QEMU 7.2 or later: qemu-system-arm and qemu-system-riscv32".into(),
            Need::Node => "install Node.js 18 or later, and npm".into(),
            Need::Lints => "rustup component add clippy rustfmt".into(),
        }
    }
}

/// Gets what is missing: by apt, after saying so, on Debian and its kin.
///
/// # Errors
/// If something is still missing; the error names the commands that get it.
pub(crate) fn ensure(needs: &[Need]) -> Result<()> {
    let missing = || -> Result<Vec<Need>> {
        needs.iter().filter_map(|&need| need.met().map(|met| (!met).then_some(need)).transpose()).collect()
    };
    if missing()?.is_empty() {
        return Ok(());
    }
    if let Some(apt) = Apt::find() {
        let mut updated = false;
        // One need after the other: a system without Debian's compiler may well have QEMU.
        for need in missing()? {
            if need.packages()?.is_empty() {
                continue;
            }
            if !std::mem::replace(&mut updated, true) {
                apt.update();
            }
            if let Err(error) = apt.install(&need.packages()?) {
                eprintln!("{error:#}");
            }
        }
    }
    let mut advice = Vec::new();
    for need in missing()? {
        let packages = need.packages()?;
        if process::exists("apt-get") && !packages.is_empty() {
            let install = format!("apt-get install {} {}", OPTIONS.join(" "), packages.join(" "));
            advice.push(format!("sudo apt-get update && sudo {install}\nor: {}", need.advice()));
        } else {
            advice.push(need.advice());
        }
    }
    if advice.is_empty() {
        return Ok(());
    }
    bail!("something is missing. This gets it:\n{}", advice.join("\n"))
}

/// Gets the emulator of the RP2040, in the version that xtask/bench names, unless it is there.
///
/// # Errors
/// If npm cannot.
pub(crate) fn bench() -> Result<()> {
    let folder = project::root().join("xtask/bench");
    let changed = |file: &str| folder.join(file).metadata().and_then(|data| data.modified()).ok();
    // npm's own record of what it has installed.
    if changed("node_modules/.package-lock.json") >= changed("package-lock.json") {
        return Ok(());
    }
    let mut command = Command::new("npm");
    command.args(["ci", "--no-audit", "--no-fund"]).current_dir(folder).stdout(std::io::stderr());
    process::run(&mut command)
}

/// apt-get, with the right to install.
struct Apt {
    sudo: bool,
}

impl Apt {
    fn find() -> Option<Apt> {
        if !process::exists("apt-get") {
            return None;
        }
        let succeeds = |program: &str, argument: &[&str]| process::output(Command::new(program).args(argument)).ok();
        if succeeds("id", &["-u"])?.trim() == "0" {
            return Some(Apt { sudo: false });
        }
        succeeds("sudo", &["-n", "true"]).map(|_| Apt { sudo: true })
    }

    fn command(&self) -> Command {
        let mut command = Command::new(if self.sudo { "sudo" } else { "env" });
        if self.sudo {
            command.args(["-n", "env"]);
        }
        command.args(["DEBIAN_FRONTEND=noninteractive", "apt-get", "--quiet", "--assume-yes"]);
        // Its long account goes to stderr: stdout is for results.
        command.stdin(std::process::Stdio::null()).stdout(std::io::stderr());
        command
    }

    fn update(&self) {
        if let Err(error) = process::run(self.command().arg("update")) {
            eprintln!("{error:#}: going on with the lists that are there");
        }
    }

    fn install(&self, packages: &[String]) -> Result<()> {
        eprintln!("Missing here: {}. Installing by apt-get.", packages.join(" "));
        process::run(self.command().arg("install").args(OPTIONS).args(packages))
    }
}

/// Options of `apt-get install`; it downgrades only what is named with a version.
const OPTIONS: [&str; 2] = ["--no-install-recommends", "--allow-downgrades"];

/// QEMU for Arm and RISC-V.
fn qemu_packages() -> Vec<String> {
    // From QEMU 9 on RISC-V is a package of its own.
    let riscv = if version("qemu-system-riscv", "Candidate:").is_some() { "qemu-system-riscv" } else { "qemu-system-misc" };
    let mut packages = vec!["qemu-system-arm".to_owned(), riscv.to_owned()];
    // All of QEMU must be of one version. Where qemu-utils is of another, from backports say, apt refuses to install
    // the emulators beside it, or removes it: so it comes along, in the version of the emulators.
    let wanted = version("qemu-system-arm", "Candidate:");
    let installed = version("qemu-utils", "Installed:");
    if let Some(wanted) = wanted.filter(|wanted| installed.is_some_and(|installed| installed != *wanted)) {
        packages.push(format!("qemu-utils={wanted}"));
    }
    packages
}

/// A version of a package: the installed one, or the one that apt would install.
fn version(package: &str, which: &str) -> Option<String> {
    let policy = process::output(Command::new("apt-cache").env("LC_ALL", "C").args(["policy", package])).ok()?;
    let version = policy.lines().find_map(|line| line.trim().strip_prefix(which))?.trim();
    (version != "(none)").then(|| version.to_owned())
}
