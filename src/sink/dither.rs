//! One bit from 256 greys, by a threshold that depends on the place: for monochrome panels.
//!
//! Lines are shaded in [`Gray8`] as for any other display; the dither comes behind them. Ordered dither, because it looks at one
//! pixel alone: no line waits for another, and what stands still does not flicker while something beside it moves.

use embedded_graphics::{
    draw_target::DrawTarget,
    geometry::{Dimensions, Point},
    pixelcolor::{BinaryColor, Gray8, GrayColor},
    primitives::{PointsIter, Rectangle},
    Pixel,
};

/// Pixels along a side of the pattern, which then comes again.
const SIDE: usize = 8;

/// The greys up to which a pixel is off: rows, then columns.
///
/// Bayer's matrix ("An optimum method for two-level rendition of continuous-tone pictures", IEEE ICC 1973, order 8) gives each
/// pixel of a block its rank from 0 to 63; the pixel of rank r is on from grey 255 · (r + ½) / 64.
static THRESHOLDS: [[u8; SIDE]; SIDE] = {
    let mut thresholds = [[0; SIDE]; SIDE];
    let mut place = 0;
    while place < SIDE * SIDE {
        let (x, y) = (place % SIDE, place / SIDE);
        #[expect(clippy::indexing_slicing, reason = "below SIDE; slice::get is not const")]
        {
            thresholds[y][x] = (255 * (2 * rank(x, y) + 1) / 128) as u8;
        }
        place += 1;
    }
    thresholds
};

/// Bayer's order: the bits of x ⊕ y and of y, interleaved and reversed.
const fn rank(x: usize, y: usize) -> usize {
    let (mut rank, mut bit) = (0, 0);
    while bit < 3 {
        rank = rank << 2 | ((x ^ y) >> bit & 1) << 1 | y >> bit & 1;
        bit += 1;
    }
    rank
}

/// The thresholds of a line.
#[inline]
fn thresholds(y: u32) -> &'static [u8; SIDE] {
    let [first, ..] = &THRESHOLDS;
    THRESHOLDS.get(y as usize % SIDE).unwrap_or(first)
}

/// Whether a pixel of that grey is on.
///
/// Of any 8×8 pixels of one grey, round(grey · 64 / 255) are on, exactly: black has none, white has all, and the mean is at most
/// 1.99 levels off (RMS 1.15 over all greys). Where greys change within the 8×8 it is farther off: on the teapot at 128×64, in all 60
/// frames, 18.2 levels at most, RMS 4.8, and the mean of the whole picture 0.6 at most.
///
/// The share of light is what is right: the greys in between look brighter than on a display with a gamma.
#[must_use]
pub fn is_on(x: u32, y: u32, grey: Gray8) -> bool {
    thresholds(y).get(x as usize % SIDE).is_some_and(|&threshold| grey.luma() > threshold)
}

/// Eight lines in the bytes of an SSD1306, SH1106 or their kin: each byte is a column, the top pixel in its lowest bit.
///
/// ```
/// # use beamshade::{Camera, Frame, Light, Page, Scanner};
/// # use embedded_graphics::prelude::*;
/// # use embedded_graphics::pixelcolor::Gray8;
/// # let mut frame = Frame::<8, 8, 64>::new();
/// # let mut scanner = Scanner::<8>::new();
/// # frame.begin(&Camera::new(Size::new(128, 64)), &[Light::OFF])?;
/// let mut lines = scanner.start(frame.picture());
/// let mut row = [Gray8::BLACK; 128];
/// let mut page = Page::<128>::new();
/// for y in 0..64 {
///     lines.line(y, &mut row);
///     if let Some(_bytes) = page.add(y, &row) {
///         // to the panel
///     }
/// }
/// # Ok::<(), beamshade::Full>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Page<const WIDTH: usize>([u8; WIDTH]);

impl<const WIDTH: usize> Page<WIDTH> {
    /// A dark page.
    #[must_use]
    pub const fn new() -> Self {
        Self([0; WIDTH])
    }

    /// Dithers line y into its place, and gives the bytes when it is the lowest of its eight. Pixels that the row lacks keep what
    /// was there; lines may come in any order.
    pub fn add(&mut self, y: u16, row: &[Gray8]) -> Option<&[u8; WIDTH]> {
        let line = u32::from(y) % 8;
        let thresholds = thresholds(y.into());
        for (bytes, pixels) in self.0.chunks_mut(SIDE).zip(row.chunks(SIDE)) {
            for ((byte, pixel), &threshold) in bytes.iter_mut().zip(pixels).zip(thresholds) {
                *byte = *byte & !(1 << line) | u8::from(pixel.luma() > threshold) << line;
            }
        }
        (line == 7).then_some(&self.0)
    }

    /// The bytes, from left to right.
    #[must_use]
    pub const fn bytes(&self) -> &[u8; WIDTH] {
        &self.0
    }
}

impl<const WIDTH: usize> Default for Page<WIDTH> {
    fn default() -> Self {
        Self::new()
    }
}

/// A display of one bit that takes greys: [`draw`](crate::Lines::draw) to it, and anything else in [`Gray8`].
///
/// ```
/// # use beamshade::{Camera, Dithered, Frame, Light, Scanner};
/// # use embedded_graphics::{mock_display::MockDisplay, pixelcolor::{BinaryColor, Gray8}, prelude::*};
/// # let mut display = MockDisplay::<BinaryColor>::new();
/// # let mut frame = Frame::<8, 8, 64>::new();
/// # let mut scanner = Scanner::<8>::new();
/// # frame.begin(&Camera::new(Size::new(64, 64)), &[Light::OFF])?;
/// let mut row = [Gray8::BLACK; 64];
/// scanner.start(frame.picture()).draw(&mut row, &mut Dithered(&mut display))?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Dithered<'d, D>(pub &'d mut D);

impl<D: DrawTarget<Color = BinaryColor>> DrawTarget for Dithered<'_, D> {
    type Color = Gray8;
    type Error = D::Error;

    fn draw_iter<I: IntoIterator<Item = Pixel<Gray8>>>(&mut self, pixels: I) -> Result<(), Self::Error> {
        self.0.draw_iter(pixels.into_iter().map(|Pixel(point, grey)| Pixel(point, dither(point, grey))))
    }

    fn fill_contiguous<I: IntoIterator<Item = Gray8>>(&mut self, area: &Rectangle, colors: I) -> Result<(), Self::Error> {
        self.0.fill_contiguous(area, area.points().zip(colors).map(|(point, grey)| dither(point, grey)))
    }
}

impl<D: Dimensions> Dimensions for Dithered<'_, D> {
    fn bounding_box(&self) -> Rectangle {
        self.0.bounding_box()
    }
}

/// Two's complement repeats the pattern to the left of and above the display, too.
fn dither(point: Point, grey: Gray8) -> BinaryColor {
    is_on(point.x as u32, point.y as u32, grey).into()
}
