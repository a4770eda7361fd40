//! Which compiler builds firmware.
//!
//! - rustup's, where the target is installed: what an ordinary user has. Nothing here ever runs `rustup`.
//! - Debian's (`rustc-web`, `cargo-web`, `rust-web-src`, `lld`), which builds `core` from its source: for machines that
//!   rustup cannot install targets on. Counts are recorded with it.
//!
//! `BEAMSHADE_TOOLCHAIN=rustup` or `debian` forces one: the same program gives counts that differ by 2 in 1000 from one
//! version of the compiler to the next.

use crate::process;
use anyhow::{bail, ensure, Context, Result};
use std::path::{Path, PathBuf};
use std::process::Command;

/// The oldest compiler that builds the library, as in its Cargo.toml.
const OLDEST: (u32, u32) = (1, 87);

/// What Debian's packages put where.
const DEBIAN_CARGO: &str = "/usr/bin/cargo";
const DEBIAN_RUSTC: &str = "/usr/bin/rustc";
const DEBIAN_CORE: &str = "/usr/lib/rustlib/src/rust/library/core/Cargo.toml";

/// Debian's packages, for apt.
pub(crate) const DEBIAN_PACKAGES: [&str; 4] = ["rustc-web", "cargo-web", "rust-web-src", "lld"];

/// A compiler for firmware.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Toolchain {
    Rustup,
    Debian,
}

/// What `BEAMSHADE_TOOLCHAIN` asks for.
///
/// # Errors
/// If it is neither of the two.
pub(crate) fn forced() -> Result<Option<Toolchain>> {
    match std::env::var("BEAMSHADE_TOOLCHAIN").as_deref() {
        Err(_) | Ok("") => Ok(None),
        Ok("rustup") => Ok(Some(Toolchain::Rustup)),
        Ok("debian") => Ok(Some(Toolchain::Debian)),
        Ok(other) => bail!("BEAMSHADE_TOOLCHAIN is {other:?}; it may be \"rustup\" or \"debian\""),
    }
}

/// The compiler for a target.
///
/// # Errors
/// If there is none; the error says what to install.
pub(crate) fn pick(target: &str) -> Result<Toolchain> {
    match forced()? {
        Some(Toolchain::Rustup) => ensure!(rustup_has(target), "rustup's {target} is missing: rustup target add {target}"),
        Some(Toolchain::Debian) => {
            ensure!(debian_complete(), "Debian's compiler is not complete: apt-get install {}", DEBIAN_PACKAGES.join(" "));
        }
        None if rustup_has(target) => return Ok(Toolchain::Rustup),
        None if debian_complete() => {}
        None => bail!("no compiler has {target}: rustup target add {target}"),
    }
    let toolchain = forced()?.unwrap_or(Toolchain::Debian);
    let version = toolchain.version()?;
    let number = version.split(' ').nth(1).unwrap_or_default();
    let mut parts = number.split('.').map_while(|part| part.parse::<u32>().ok());
    let (major, minor) = (parts.next().unwrap_or(0), parts.next().unwrap_or(0));
    ensure!((major, minor) >= OLDEST, "{version} is too old: {}.{} is the oldest that will do", OLDEST.0, OLDEST.1);
    Ok(toolchain)
}

impl Toolchain {
    /// What `rustc --version` says, with the source of the compiler.
    ///
    /// # Errors
    /// If the compiler does not run.
    pub(crate) fn version(self) -> Result<String> {
        let (rustc, source) = match self {
            Toolchain::Rustup => ("rustc", "rustup"),
            Toolchain::Debian => (DEBIAN_RUSTC, "Debian"),
        };
        let version = process::output(Command::new(rustc).arg("--version"))?;
        let number = version.split(' ').nth(1).with_context(|| format!("{rustc} --version says {version:?}"))?;
        Ok(format!("rustc {number} ({source})"))
    }

    /// A cargo command that builds for `target`, with or without a heap, up to the subcommand.
    pub(crate) fn cargo(self, target: &str, heap: bool) -> Command {
        let mut command = match self {
            Toolchain::Rustup => crate::project::cargo(),
            Toolchain::Debian => Command::new(DEBIAN_CARGO),
        };
        // Flags meant for this machine's own programs: they would change what is counted, or not even link.
        for variable in ["RUSTFLAGS", "CARGO_ENCODED_RUSTFLAGS", "CARGO_BUILD_RUSTFLAGS"] {
            command.env_remove(variable);
        }
        // As anyone builds who knows the core: 3 % fewer instructions, by another order alone.
        command.env("CARGO_TARGET_THUMBV7EM_NONE_EABIHF_RUSTFLAGS", "-Ctarget-cpu=cortex-m4");
        if self == Toolchain::Debian {
            // rustup's proxies leave these behind, and each of them would lead back to rustup's compiler.
            for variable in ["RUSTUP_TOOLCHAIN", "CARGO", "RUSTC_WRAPPER", "RUSTDOC", "LD_LIBRARY_PATH"] {
                command.env_remove(variable);
            }
            let linker = format!("CARGO_TARGET_{}_LINKER", target.to_uppercase().replace(['-', '.'], "_"));
            command.env("RUSTC", DEBIAN_RUSTC).env(linker, "ld.lld");
            // Debian has no compiled `core` for these targets, only its source.
            command.env("RUSTC_BOOTSTRAP", "1").env("CARGO_UNSTABLE_BUILD_STD", if heap { "core,alloc" } else { "core" });
        }
        command
    }
}

/// Whether rustup's compiler has a target.
pub(crate) fn rustup_has(target: &str) -> bool {
    let sysroot = process::output(Command::new("rustc").args(["--print", "sysroot"])).unwrap_or_default();
    PathBuf::from(sysroot.trim()).join("lib/rustlib").join(target).join("lib").is_dir()
}

/// Whether all of Debian's compiler is there.
pub(crate) fn debian_complete() -> bool {
    [DEBIAN_CARGO, DEBIAN_RUSTC, DEBIAN_CORE].iter().all(|file| Path::new(file).exists()) && process::exists("ld.lld")
}
