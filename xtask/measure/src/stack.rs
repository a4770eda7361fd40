//! How deep the stack gets: paint what lies below it, and see later how much of the paint is left.

use core::arch::asm;

/// Words that are painted: 64 KiB, of the megabytes that the emulated boards have.
const WORDS: usize = 16 * 1024;
const PAINT: u32 = 0xa55a_c33c;

/// A painted stack.
pub(crate) struct Watch {
    /// The stack pointer when it was painted.
    top: *mut u32,
}

impl Watch {
    /// Paints the stack below the caller, whose frame does not count.
    #[inline(always)]
    pub(crate) fn begin() -> Self {
        let top: *mut u32;
        // SAFETY: reads the stack pointer.
        unsafe {
            #[cfg(target_arch = "arm")]
            asm!("mov {}, sp", out(reg) top, options(nomem, nostack, preserves_flags));
            #[cfg(target_arch = "riscv32")]
            asm!("mv {}, sp", out(reg) top, options(nomem, nostack, preserves_flags));
        }
        for word in 1..=WORDS {
            // SAFETY: RAM below the stack pointer, which nothing uses: these targets have no red zone, and no interrupt
            // is enabled.
            unsafe { top.wrapping_sub(word).write_volatile(PAINT) };
        }
        Watch { top }
    }

    /// The largest number of bytes that were ever in use below the caller of [`Watch::begin`].
    pub(crate) fn deepest(&self) -> usize {
        // SAFETY: the words that were painted, or have been used as stack since: RAM all the same.
        let is_paint = |&word: &usize| unsafe { self.top.wrapping_sub(word).read_volatile() } == PAINT;
        let left = (1..=WORDS).rev().take_while(is_paint).count();
        (WORDS - left) * size_of::<u32>()
    }
}
