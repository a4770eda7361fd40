//! Text and drawings over the picture.

use embedded_graphics::{
    draw_target::DrawTarget,
    framebuffer::Framebuffer,
    geometry::{OriginDimensions, Point, Size},
    image::GetPixel,
    pixelcolor::{
        raw::{LittleEndian, RawU1},
        BinaryColor,
    },
    Pixel,
};

/// A small one-bit picture that anything can be drawn into with embedded-graphics, and that is laid over the rows it touches.
///
/// Draw into it once a frame at most; a row then costs a look at `WIDTH` bits, where drawing the text anew through every row
/// would cost more than the line has. `BYTES` is `buffer_size::<BinaryColor>(WIDTH, HEIGHT)`.
///
/// ```
/// use beamshade::Overlay;
/// use embedded_graphics::{framebuffer::buffer_size, mono_font::{ascii::FONT_6X10, MonoTextStyle}};
/// use embedded_graphics::{pixelcolor::{BinaryColor, Rgb565}, prelude::*, text::{Baseline, Text}};
///
/// let mut overlay = Overlay::<48, 10, { buffer_size::<BinaryColor>(48, 10) }>::new(Point::new(4, 4));
/// let style = MonoTextStyle::new(&FONT_6X10, BinaryColor::On);
/// Text::with_baseline("60 fps", Point::zero(), style, Baseline::Top).draw(&mut overlay).unwrap();
///
/// let mut row = [Rgb565::BLACK; 240];
/// overlay.blit(9, &mut row, Rgb565::WHITE);
/// assert!(row.contains(&Rgb565::WHITE));
/// ```
#[derive(Debug)]
pub struct Overlay<const WIDTH: usize, const HEIGHT: usize, const BYTES: usize> {
    at: Point,
    buffer: Framebuffer<BinaryColor, RawU1, LittleEndian, WIDTH, HEIGHT, BYTES>,
}

impl<const WIDTH: usize, const HEIGHT: usize, const BYTES: usize> Overlay<WIDTH, HEIGHT, BYTES> {
    /// An empty overlay with its top left corner there, counted from the picture's.
    #[must_use]
    pub fn new(at: Point) -> Self {
        Self { at, buffer: Framebuffer::new() }
    }

    /// Puts it elsewhere.
    pub fn move_to(&mut self, at: Point) {
        self.at = at;
    }

    /// Writes `color` into the row of line y wherever a pixel of the overlay is on.
    pub fn blit<P: Copy>(&self, y: u16, row: &mut [P], color: P) {
        let line = i32::from(y) - self.at.y;
        if line < 0 || line >= HEIGHT as i32 {
            return;
        }
        for x in 0..WIDTH as i32 {
            if self.buffer.pixel(Point::new(x, line)) == Some(BinaryColor::On) {
                if let Some(pixel) = usize::try_from(x + self.at.x).ok().and_then(|x| row.get_mut(x)) {
                    *pixel = color;
                }
            }
        }
    }
}

impl<const WIDTH: usize, const HEIGHT: usize, const BYTES: usize> DrawTarget for Overlay<WIDTH, HEIGHT, BYTES> {
    type Color = BinaryColor;
    type Error = core::convert::Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        self.buffer.draw_iter(pixels)
    }
}

impl<const WIDTH: usize, const HEIGHT: usize, const BYTES: usize> OriginDimensions for Overlay<WIDTH, HEIGHT, BYTES> {
    fn size(&self) -> Size {
        self.buffer.size()
    }
}
