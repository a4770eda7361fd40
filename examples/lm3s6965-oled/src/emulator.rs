//! For QEMU only: tells by semihosting which frame the panel shows, and holds the picture when that is asked for.

use cortex_m_semihosting::{hprintln, nr, syscall1};

/// Frame `frame` is on the panel. Stays in here if it is the one named on the emulator's command line
/// (`-semihosting-config enable=on,arg=hold,arg=12`).
pub fn shown(frame: u32) {
    hprintln!("frame {}", frame);
    if held() == Some(frame) {
        loop {
            cortex_m::asm::wfi();
        }
    }
}

/// The last word of the command line, where that is a number.
fn held() -> Option<u32> {
    let mut line = [0u8; 64];
    // The block that the call wants: where the line may go, and how long it may be; then it holds how long it is.
    let mut block = [line.as_mut_ptr() as usize, line.len()];
    // SAFETY: the block and the buffer that it describes are ours to write.
    let failed = unsafe { syscall1(nr::GET_CMDLINE, block.as_mut_ptr() as usize) } != 0;
    let line = core::str::from_utf8(line.get(..block[1])?).ok().filter(|_| !failed)?;
    line.trim_end_matches('\0').rsplit(' ').next()?.parse().ok()
}
