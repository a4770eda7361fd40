//! Instructions without an effect, by which the counting plugin knows where it is (`xtask/counter` has the table).
//!
//! The assembler statements may touch memory for all the compiler knows, so no access moves across them.

use core::arch::asm;

macro_rules! mark {
    ($(#[$doc:meta])* $name:ident, $thumb:literal, $riscv:literal) => {
        $(#[$doc])*
        #[inline(always)]
        pub(crate) fn $name() {
            // SAFETY: copies a register to itself, or compares into the register that is always zero.
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
