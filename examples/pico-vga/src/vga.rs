//! Scan-out: 640×480 at 60 Hz from two rows of 320 pixels, each shown on two lines, by PIO and DMA alone.
//!
//! Three state machines run at the pixel clock of 25 MHz, an instruction a pixel of 640. One makes HSYNC and tells where a line
//! ends; one counts lines, makes VSYNC, and tells the processor which row begins; one sends the pixels of a line. A line takes
//! 4000 cycles of the processor, a row 8000, and nothing that the processor does or leaves undone changes that.
//!
//! One channel of the DMA feeds the pixels. When a line is through, it starts the other channel, which hands it the place of the
//! row for the next line, out of [`NEXT`]. All that the processor does is to write there, in time, where the next row lies; if it
//! does not, the row that is shown repeats.

use core::sync::atomic::{
    AtomicU32,
    Ordering::{Relaxed, Release},
};
use embedded_graphics::{pixelcolor::Rgb565, prelude::RgbColor};
use pio::{Instruction, InstructionOperands, MovDestination, MovOperation, MovSource, OutDestination};
use rp2040_hal::{
    pac::{DMA, PIO0, RESETS},
    pio::{PIOBuilder, PIOExt, PinDir, PioIRQ, Rx, ShiftDirection, PIO0SM1},
};

/// Pixels of a row.
pub const WIDTH: usize = 320;
/// Rows of the picture.
pub const HEIGHT: u16 = 240;

/// The first pin of the colours, and the sync pins.
const COLORS: u8 = 0;
const HSYNC: u8 = 16;
const VSYNC: u8 = 17;

/// Cycles of the processor for a pixel of 640.
const CLOCK_DIVISOR: u16 = 5;

/// Rows that were not ready when the beam came: in their places the row that was shown before repeats.
pub static LATE: AtomicU32 = AtomicU32::new(0);

/// The places of the rows for the next even line and for the next odd one. The DMA takes turns between them: it wraps at 8 bytes.
static NEXT: Next = Next([AtomicU32::new(0), AtomicU32::new(0)]);

#[repr(align(8))]
struct Next([AtomicU32; 2]);

/// A row, as the DMA reads it.
#[repr(C, align(4))]
pub struct Row {
    pixels: [Rgb565; WIDTH],
    /// Where the DMA stands when it has read the row: not yet in another one.
    end: [u16; 2],
}

impl Row {
    /// Black.
    pub const BLACK: Row = Row { pixels: [Rgb565::BLACK; WIDTH], end: [0; 2] };
}

/// The running scan-out, of which the processor makes the rows.
pub struct Vga {
    dma: DMA,
    /// For each row that begins, how many come after it.
    begun: Rx<PIO0SM1>,
    rows: &'static mut [Row; 2],
    /// The numbers of the rows in there, until they are shown.
    numbers: [Option<u16>; 2],
}

impl Vga {
    /// Starts with a black picture. The pins must be PIO0's.
    pub fn start(pio: PIO0, dma: DMA, resets: &mut RESETS, rows: &'static mut [Row; 2]) -> Self {
        let (mut pio, machine0, machine1, machine2, _) = pio.split(resets);

        // 800 pixels. A line begins with its front porch, where the picture of the line before it ends.
        let hsync = pio::pio_asm!(
            ".side_set 1",
            ".wrap_target",
            "    irq set 4        side 1 [15]", // a line begins: front porch, 16
            "    set x, 4         side 0 [15]", // sync, 96 = 16 + 5 · 16
            "low:",
            "    jmp x-- low      side 0 [15]",
            "    set x, 20        side 1 [15]", // back porch and picture, 48 + 640 = 16 + 21 · 32
            "high:",
            "    nop              side 1 [15]",
            "    jmp x-- high     side 1 [15]",
            ".wrap",
        );
        // 525 lines. VSYNC changes together with the edge of HSYNC, 16 pixels after the line begins.
        let vsync = pio::pio_asm!(
            ".side_set 1",
            ".wrap_target",
            "    mov y, osr       side 1", // 240 rows: 480 lines
            "row:",
            "    wait 1 irq 4     side 1",
            "    irq set 5        side 1", // send the first line
            "    mov isr, y       side 1",
            "    push noblock     side 1", // tell the processor
            "    wait 1 irq 4     side 1",
            "    irq set 5        side 1", // send the second line
            "    jmp y-- row      side 1",
            "    set y, 10        side 1", // front porch, 10 lines and the beginning of the next
            "front:",
            "    wait 1 irq 4     side 1",
            "    jmp y-- front    side 1",
            "    set y, 1         side 1 [12]", // sync, 2 lines
            "low:",
            "    wait 1 irq 4     side 0",
            "    jmp y-- low      side 0",
            "    set y, 31        side 0 [12]", // back porch, 33 lines but for that beginning
            "back:",
            "    wait 1 irq 4     side 1",
            "    jmp y-- back     side 1",
            ".wrap",
        );
        // 320 pixels, each for two of the clock, from the 160th on.
        let pixels = pio::pio_asm!(
            ".wrap_target",
            "    wait 1 irq 5     [31]",
            "    set x, 6         [11]",
            "porch:",
            "    jmp x-- porch    [15]",
            "    mov x, y",
            "pixel:",
            "    out pins, 16",
            "    jmp x-- pixel",
            "    mov pins, null",
            ".wrap",
        );

        let installed = pio.install(&hsync.program).ok().unwrap();
        let builder = PIOBuilder::from_installed_program(installed).side_set_pin_base(HSYNC);
        let (mut hsync, _, _) = builder.clock_divisor_fixed_point(CLOCK_DIVISOR, 0).build(machine0);
        hsync.set_pindirs([(HSYNC, PinDir::Output)]);

        let installed = pio.install(&vsync.program).ok().unwrap();
        let builder = PIOBuilder::from_installed_program(installed).side_set_pin_base(VSYNC);
        let (mut vsync, begun, mut constant) = builder.clock_divisor_fixed_point(CLOCK_DIVISOR, 0).build(machine1);
        vsync.set_pindirs([(VSYNC, PinDir::Output)]);
        constant.write(u32::from(HEIGHT) - 1);
        let operands = InstructionOperands::PULL { if_empty: false, block: true };
        vsync.exec_instruction(Instruction { operands, delay: 0, side_set: Some(1) });

        let installed = pio.install(&pixels.program).ok().unwrap();
        let builder = PIOBuilder::from_installed_program(installed).out_pins(COLORS, 16);
        let builder = builder.autopull(true).out_shift_direction(ShiftDirection::Right);
        let (mut pixels, _, mut constant) = builder.clock_divisor_fixed_point(CLOCK_DIVISOR, 0).build(machine2);
        pixels.set_pindirs((COLORS..COLORS + 16).map(|pin| (pin, PinDir::Output)));
        constant.write(WIDTH as u32 - 1);
        let pull = InstructionOperands::PULL { if_empty: false, block: true };
        let keep = InstructionOperands::MOV { destination: MovDestination::Y, op: MovOperation::None, source: MovSource::OSR };
        let drop = InstructionOperands::OUT { destination: OutDestination::NULL, bit_count: 32 };
        for operands in [pull, keep, drop] {
            pixels.exec_instruction(Instruction { operands, delay: 0, side_set: None });
        }

        feed(&dma, resets, constant.fifo_address() as u32, &rows[0]);
        begun.enable_rx_not_empty_interrupt(PioIRQ::Irq0);
        hsync.with(vsync).with(pixels).sync().start();
        Vga { dma, begun, rows, numbers: [Some(0), None] }
    }

    /// To be called when a row has begun, by interrupt PIO0_IRQ_0: has the next one shaded into the row that is not shown. `shade`
    /// gets its number, and tells whether it has shaded it.
    ///
    /// There are 8000 cycles for that, less about 170, as the DMA reads a little ahead. What comes later is not shown: it would be
    /// in the wrong place.
    pub fn row_begun(&mut self, shade: impl FnOnce(u16, &mut [Rgb565; WIDTH]) -> bool) {
        let shown = self.shown();
        let mut number = None;
        while let Some(after) = self.begun.read() {
            let begun = HEIGHT - 1 - after as u16;
            if self.numbers[shown].take() != Some(begun) {
                LATE.store(LATE.load(Relaxed) + 1, Relaxed);
            }
            number = Some(if after == 0 { 0 } else { begun + 1 });
        }
        let Some(number) = number else { return };
        // On its second line, and again until there is another.
        let [even, odd] = &NEXT.0;
        odd.store(place(&self.rows[shown]), Relaxed);
        even.store(place(&self.rows[shown]), Relaxed);

        let back = 1 - shown;
        if shade(number, &mut self.rows[back].pixels) && self.begun.is_empty() {
            self.numbers[back] = Some(number);
            even.store(place(&self.rows[back]), Release);
        }
    }

    /// The row that the DMA reads.
    fn shown(&self) -> usize {
        let at = self.dma.ch(PIXELS).ch_read_addr().read().bits();
        let [first, _] = &*self.rows;
        usize::from(!(place(first)..=first.end.as_ptr() as u32).contains(&at))
    }
}

/// The channels of the DMA: the one that feeds the pixels, and the one that feeds it with rows.
const PIXELS: usize = 0;
const ROWS: usize = 1;

/// Starts the DMA; from here on it goes in circles.
fn feed(dma: &DMA, resets: &mut RESETS, fifo: u32, row: &Row) {
    resets.reset().modify(|_, reset| reset.dma().clear_bit());
    while resets.reset_done().read().dma().bit_is_clear() {}
    NEXT.0.iter().for_each(|next| next.store(place(row), Release));
    let (pixels, rows) = (dma.ch(PIXELS), dma.ch(ROWS));
    // SAFETY: the DMA reads rows and `NEXT`, which are there forever, and writes to the FIFO and to its own registers alone.
    unsafe {
        pixels.ch_write_addr().write(|to| to.bits(fifo));
        pixels.ch_trans_count().write(|words| words.bits(WIDTH as u32 / 2));
        pixels.ch_al1_ctrl().write(|control| {
            control.treq_sel().pio0_tx2().data_size().size_word().incr_read().set_bit();
            control.chain_to().bits(ROWS as u8).irq_quiet().set_bit().high_priority().set_bit().en().set_bit()
        });

        rows.ch_read_addr().write(|from| from.bits(NEXT.0.as_ptr() as u32));
        rows.ch_write_addr().write(|to| to.bits(pixels.ch_al3_read_addr_trig().as_ptr() as u32));
        rows.ch_trans_count().write(|words| words.bits(1));
        rows.ch_ctrl_trig().write(|control| {
            control.treq_sel().permanent().data_size().size_word().incr_read().set_bit().ring_size().bits(3);
            control.chain_to().bits(ROWS as u8).irq_quiet().set_bit().high_priority().set_bit().en().set_bit()
        });
    }
}

/// The place of a row, as the DMA wants it.
fn place(row: &Row) -> u32 {
    row.pixels.as_ptr() as u32
}
