//! Instructions without an effect, by which the counting plugin knows where it is (`xtask/counter` has the table).
//!
//! The assembler statements may touch memory for all the compiler knows, so no access moves across them. On a PC nothing is
//! counted; there, the lengths of runs are printed.

#[cfg(target_os = "none")]
use core::arch::asm;

macro_rules! mark {
    ($(#[$doc:meta])* $name:ident, $thumb:literal, $riscv:literal) => {
        $(#[$doc])*
        #[inline(always)]
        pub fn $name() {
            // SAFETY: copies a register to itself, or compares into the register that is always zero.
            #[cfg(target_os = "none")]
            unsafe {
                #[cfg(target_arch = "arm")]
                asm!($thumb, options(nostack, preserves_flags));
                #[cfg(target_arch = "riscv32")]
                asm!($riscv, options(nostack, preserves_flags));
            }
        }
    };
}

mark! {
    /// A new frame begins; what follows counts for it.
    frame, "mov r9, r9", "slti x0, x0, 1"
}
mark! {
    /// A new line of the frame begins; what follows counts for both.
    line, "mov r10, r10", "slti x0, x0, 2"
}
mark! {
    /// What follows does not count.
    pause, "mov r11, r11", "slti x0, x0, 3"
}
mark! {
    /// What follows is the set-up of a facet.
    facet, "mov r12, r12", "slti x0, x0, 4"
}
mark! {
    /// What follows is the start of a span.
    start, "mov lr, lr", "slti x0, x0, 5"
}
mark! {
    /// What follows shades a span.
    shading, "mov sp, sp", "slti x0, x0, 6"
}

/// What follows shades a span of so many pixels.
#[inline(always)]
pub fn run(_pixels: usize) {
    #[cfg(feature = "host")]
    std::println!("run {_pixels}");
    shading();
}
