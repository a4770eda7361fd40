//! The teapot turning on a VGA monitor at a Raspberry Pi Pico: no frame buffer; a row is shaded while the one above it is shown.
//!
//! `vga.rs` makes the signal, `scene.rs` says what is seen, `whole.rs` makes frames of it, or `ring.rs` lines. The wiring is in the
//! README.
#![no_std]
#![no_main]

#[cfg(feature = "ring")]
mod ring;
mod scene;
mod vga;
#[cfg(not(feature = "ring"))]
mod whole;

use core::{cell::RefCell, sync::atomic::Ordering::Relaxed};
use critical_section::Mutex;
use embedded_hal::digital::OutputPin;
use panic_halt as _;
#[cfg(feature = "ring")]
use ring::{Memory, Show};
use rp2040_hal::{
    clocks::init_clocks_and_plls,
    gpio::{
        bank0::{Gpio22, Gpio25},
        FunctionPio0, FunctionSioOutput, Pin, Pins, PullDown,
    },
    pac::{self, interrupt, NVIC},
    Sio, Watchdog,
};
use vga::{Row, Vga, LATE};
#[cfg(not(feature = "ring"))]
use whole::{Memory, Show};

/// The boot ROM runs this first: it makes the Pico's flash readable as memory.
#[link_section = ".boot2"]
#[used]
static BOOT2_FIRMWARE: [u8; 256] = rp2040_boot2::BOOT_LOADER_W25Q080;

/// What the interrupt works with.
struct Beam {
    vga: Vga,
    show: Show,
    /// High while a row is shaded: for an oscilloscope.
    busy: Pin<Gpio22, FunctionSioOutput, PullDown>,
    /// The Pico's LED: on from the first late row on.
    late: Pin<Gpio25, FunctionSioOutput, PullDown>,
}

/// On its way from `main` to the interrupt.
static BEAM: Mutex<RefCell<Option<Beam>>> = Mutex::new(RefCell::new(None));

#[rp2040_hal::entry]
fn main() -> ! {
    static mut ROWS: [Row; 2] = [Row::BLACK; 2];
    static mut MEMORY: Memory = Memory::NEW;

    // The chip at 125 MHz: 5 cycles for each pixel of 640.
    let mut chip = pac::Peripherals::take().unwrap();
    let resets = &mut chip.RESETS;
    let mut watchdog = Watchdog::new(chip.WATCHDOG);
    let (xosc, pll_sys, pll_usb) = (chip.XOSC, chip.PLL_SYS, chip.PLL_USB);
    init_clocks_and_plls(12_000_000, xosc, chip.CLOCKS, pll_sys, pll_usb, resets, &mut watchdog).ok().unwrap();
    let pins = Pins::new(chip.IO_BANK0, chip.PADS_BANK0, Sio::new(chip.SIO).gpio_bank0, resets);
    let (busy, late) = (pins.gpio22.into_push_pull_output(), pins.gpio25.into_push_pull_output());
    // Red, green without its lowest bit, blue, sync.
    macro_rules! to_pio { ($($pin:ident)*) => { $( pins.$pin.into_function::<FunctionPio0>(); )* } }
    to_pio!(gpio0 gpio1 gpio2 gpio3 gpio4);
    to_pio!(gpio6 gpio7 gpio8 gpio9 gpio10);
    to_pio!(gpio11 gpio12 gpio13 gpio14 gpio15);
    to_pio!(gpio16 gpio17);

    let (show, make) = MEMORY.split();
    let vga = Vga::start(chip.PIO0, chip.DMA, resets, ROWS);
    critical_section::with(|section| BEAM.borrow_ref_mut(section).replace(Beam { vga, show, busy, late }));
    // SAFETY: the interrupt finds what it works with, and nothing else is shared with it.
    unsafe { NVIC::unmask(pac::Interrupt::PIO0_IRQ_0) };
    make.run()
}

/// A row begins: the time to shade the next one.
#[interrupt]
fn PIO0_IRQ_0() {
    static mut HERE: Option<Beam> = None;

    if HERE.is_none() {
        *HERE = critical_section::with(|section| BEAM.borrow_ref_mut(section).take());
    }
    let Some(Beam { vga, show, busy, late }) = HERE else { return };
    let _ = busy.set_high();
    vga.row_begun(|y, row| show.row(y, row));
    let _ = busy.set_low();
    let _ = late.set_state((LATE.load(Relaxed) > 0).into());
}
