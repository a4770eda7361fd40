//! Words to the emulator, without `core::fmt`: that has paths to a panic, and it is large.

use core::arch::asm;

const WRITE_CHARACTER: usize = 0x03;
const EXIT: usize = 0x18;
/// The reason for an exit that counts as success: ADP_Stopped_ApplicationExit.
const APPLICATION_EXIT: usize = 0x2_0026;

/// A piece of a line of output.
pub(crate) enum Word<'a> {
    Text(&'a str),
    Decimal(usize),
    /// Eight digits.
    Hexadecimal(u32),
}

/// Prints a line.
pub(crate) fn print(line: &[Word]) {
    for word in line {
        match *word {
            Word::Text(text) => text.bytes().for_each(character),
            Word::Decimal(number) => decimal(number),
            Word::Hexadecimal(number) => hexadecimal(number),
        }
    }
    character(b'\n');
}

fn decimal(number: usize) {
    let mut power = 1_000_000_000;
    while power > 1 && number < power {
        power /= 10;
    }
    while power > 0 {
        character(b'0' + (number / power % 10) as u8);
        power /= 10;
    }
}

fn hexadecimal(number: u32) {
    for shift in (0..8).rev().map(|digit| 4 * digit) {
        let digit = (number >> shift & 15) as u8;
        character(if digit < 10 { b'0' + digit } else { b'a' + digit - 10 });
    }
}

/// Ends the emulation, with success.
pub(crate) fn exit() -> ! {
    call(EXIT, APPLICATION_EXIT);
    loop {
        core::hint::spin_loop();
    }
}

fn character(byte: u8) {
    call(WRITE_CHARACTER, &raw const byte as usize);
}

/// One semihosting call; what it returns is of no use here.
fn call(operation: usize, argument: usize) {
    // SAFETY: the calls made here read at most the byte that `argument` points to, and change only the first register.
    unsafe {
        #[cfg(target_arch = "arm")]
        asm!("bkpt 0xab", inout("r0") operation => _, in("r1") argument, options(nostack));
        // Three instructions that together mean a call; they must be uncompressed and lie on one page.
        #[cfg(target_arch = "riscv32")]
        asm!(
            ".balign 16",
            ".option push",
            ".option norvc",
            "slli x0, x0, 0x1f",
            "ebreak",
            "srai x0, x0, 7",
            ".option pop",
            inout("a0") operation => _, in("a1") argument, options(nostack)
        );
    }
}
