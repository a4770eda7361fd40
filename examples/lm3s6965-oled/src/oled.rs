//! The panel: an SSD0323 with 128×64 pixels in 16 greys, at the first SPI port of the LM3S6965.
//!
//! | signal | pin | |
//! |---|---|---|
//! | clock, data | PA2, PA5 | SSI0, a PL022 |
//! | D/C | PC7 | low for commands, high for pixels |
//! | CS of the SD card on the same port | PD0 | kept high |

/// Bytes of a row: two pixels each, the left one in the high half.
pub const ROW_BYTES: usize = 64;
/// Rows.
pub const HEIGHT: usize = 64;
/// The pixels of one row.
pub type Row = [u8; ROW_BYTES];

/// Clock gates (system control).
const CLOCK_SSI: usize = 0x400f_e104;
const CLOCK_GPIO: usize = 0x400f_e108;

/// GPIO ports, and the registers of each.
const PORT_A: usize = 0x4000_4000;
const PORT_C: usize = 0x4000_6000;
const PORT_D: usize = 0x4000_7000;
const DIRECTION: usize = 0x400;
const ALTERNATE: usize = 0x420;
const DIGITAL: usize = 0x51c;

/// The SPI port.
const CONTROL0: usize = 0x4000_8000;
const CONTROL1: usize = 0x4000_8004;
const DATA: usize = 0x4000_8008;
const STATUS: usize = 0x4000_800c;
const PRESCALE: usize = 0x4000_8010;
const RECEIVED: u32 = 1 << 2;

/// The panel, ready for pixels.
pub struct Oled {
    _private: (),
}

impl Oled {
    /// Sets up pins, SPI port and panel.
    pub fn init() -> Self {
        modify(CLOCK_SSI, |gates| gates | 1 << 4);
        modify(CLOCK_GPIO, |gates| gates | 0b1101);
        output(PORT_C, 7);
        output(PORT_D, 0);
        set(PORT_D, 0, true);
        write(PORT_A + ALTERNATE, 0b10_1100);
        write(PORT_A + DIGITAL, 0b10_1100);

        write(CONTROL1, 0);
        write(PRESCALE, 2);
        write(CONTROL0, 0b1100_0111); // 8 bits; the clock idles high, data is taken at its second edge
        write(CONTROL1, 1 << 1); // on

        let mut oled = Oled { _private: () };
        oled.command(&[0xae]); // display off
        oled.command(&[0xa0, 0x52]); // order of columns, rows and nibbles as the board is wired
        oled.command(&[0x81, 0x7f]); // contrast
        oled.command(&[0xa1, 0, 0xa2, 0]); // first line, no offset
        oled.command(&[0xa8, HEIGHT as u8 - 1]); // rows
        oled.command(&[0xa4, 0xaf]); // show memory, display on
        oled
    }

    /// Sets the window to the whole panel: the next [`HEIGHT`] rows fill it from the top.
    pub fn begin_frame(&mut self) {
        self.command(&[0x15, 0, ROW_BYTES as u8 - 1]);
        self.command(&[0x75, 0, HEIGHT as u8 - 1]);
        set(PORT_C, 7, true);
    }

    /// Sends the next row.
    pub fn send(&mut self, row: &Row) {
        row.iter().for_each(|&byte| self.byte(byte));
    }

    fn command(&mut self, bytes: &[u8]) {
        set(PORT_C, 7, false);
        bytes.iter().for_each(|&byte| self.byte(byte));
    }

    /// Sends a byte. The port takes one in for each that it sends, and stops when nobody fetches them; the fetched one
    /// also tells that all is sent, so that D/C may change.
    fn byte(&mut self, byte: u8) {
        write(DATA, byte.into());
        while read(STATUS) & RECEIVED == 0 {}
        read(DATA);
    }
}

/// Makes a pin an output.
fn output(port: usize, pin: u32) {
    modify(port + DIRECTION, |pins| pins | 1 << pin);
    modify(port + ALTERNATE, |pins| pins & !(1 << pin));
    modify(port + DIGITAL, |pins| pins | 1 << pin);
}

/// Drives a pin: the address of the write selects the pins that it reaches.
fn set(port: usize, pin: u32, high: bool) {
    write(port + (4 << pin), if high { 0xff } else { 0 });
}

fn modify(register: usize, change: impl FnOnce(u32) -> u32) {
    write(register, change(read(register)));
}

fn read(register: usize) -> u32 {
    // SAFETY: all addresses used here are registers of this chip, 32 bits wide; reading them has no effect on memory.
    unsafe { (register as *const u32).read_volatile() }
}

fn write(register: usize, value: u32) {
    // SAFETY: as above, and none of them starts DMA: no memory changes.
    unsafe { (register as *mut u32).write_volatile(value) }
}
