//! The boards' firmware: built for each, run on none here.

use crate::elf::Elf;
use crate::firmware::{self, Package, OLED, OLED_TARGET, PICO_GC9A01, PICO_ST7789, PICO_TARGET, PICO_VGA};
use crate::install::{self, Need};
use crate::table;
use anyhow::{ensure, Result};

/// Build the boards' firmware, and tell the flash and the RAM that each takes.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Only the boards with this in their name.
    #[arg(value_name = "TEXT")]
    only: Option<String>,
}

/// A board, and the target of its core.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Board {
    pub(crate) package: Package,
    pub(crate) target: &'static str,
}

const CORTEX_M4F: &str = "thumbv7em-none-eabihf";
const CORTEX_M33F: &str = "thumbv8m.main-none-eabihf";
const RISCV_IMC: &str = "riscv32imc-unknown-none-elf";

/// All boards.
pub(crate) const BOARDS: [Board; 8] = [
    Board { package: OLED, target: OLED_TARGET },
    Board { package: PICO_ST7789, target: PICO_TARGET },
    Board { package: PICO_GC9A01, target: PICO_TARGET },
    Board { package: PICO_VGA, target: PICO_TARGET },
    board("examples/pico-ssd1306", "pico-ssd1306", PICO_TARGET),
    board("examples/pico2-st7789", "pico2-st7789", CORTEX_M33F),
    board("examples/stm32f411-ili9341", "stm32f411-ili9341", CORTEX_M4F),
    board("examples/esp32c3-gc9a01", "esp32c3-gc9a01", RISCV_IMC),
];

const fn board(path: &'static str, program: &'static str, target: &'static str) -> Board {
    Board { package: Package::new(path, program), target }
}

/// Builds them, and gives the table.
///
/// # Errors
/// If one does not build, or is empty.
fn build(only: Option<&str>) -> Result<String> {
    let mut rows = Vec::new();
    for Board { package, target } in BOARDS.iter().filter(|board| only.is_none_or(|text| board.package.program.contains(text))) {
        rows.push(row(package.program, target, &firmware::build(*package, target, &[])?));
    }
    ensure!(!rows.is_empty(), "no board has this in its name");
    Ok(table::text(&["board", "target", "flash", "static RAM", "text", "data", "bss"], rows))
}

fn row(name: &str, target: &str, elf: &Elf) -> Vec<String> {
    let sizes = elf.sizes();
    let bytes = [elf.flash_bytes(), sizes.data + sizes.bss, sizes.text, sizes.data, sizes.bss];
    [name.to_owned(), target.to_owned()].into_iter().chain(bytes.map(table::number)).collect()
}

/// All of them, for `cargo xtask test`.
///
/// # Errors
/// If one does not build.
pub(crate) fn check() -> Result<()> {
    build(None).map(|table| eprintln!("{table}"))
}

/// `cargo xtask boards`.
pub(crate) fn run(arguments: &Arguments) -> Result<()> {
    install::ensure(&[Need::FirmwareCompiler])?;
    println!("{}", build(arguments.only.as_deref())?);
    println!("in bytes; static RAM is without the stack, on which some boards keep frame and scanner");
    Ok(())
}
