use embedded_graphics::pixelcolor::{IntoStorage, Rgb565};

/// FNV-1a, 32 bits, over the pixels of rows, the low byte of each pixel first.
#[derive(Debug, Clone, Copy)]
pub struct Checksum(u32);

impl Checksum {
    /// The checksum of nothing.
    pub const fn new() -> Self {
        Checksum(0x811c_9dc5)
    }

    /// Takes in one row.
    pub fn row(&mut self, row: &[Rgb565]) {
        for byte in row.iter().flat_map(|pixel| pixel.into_storage().to_le_bytes()) {
            self.0 = (self.0 ^ u32::from(byte)).wrapping_mul(0x0100_0193);
        }
    }

    /// The checksum of what was taken in so far.
    pub fn value(self) -> u32 {
        self.0
    }
}

impl Default for Checksum {
    fn default() -> Self {
        Self::new()
    }
}
