//! An animated GIF with one palette.

use anyhow::Result;
use color_quant::NeuQuant;
use embedded_graphics::geometry::Size;
use gif::{Encoder, Frame, Repeat};
use image::RgbImage;
use std::collections::HashMap;

/// Hundredths of a second that a frame is shown.
pub(super) const DELAY: u16 = 5;

/// 256 colours for many pictures: black, which is the background and must be just that, and the rest made for the pictures.
pub(super) struct Palette {
    made: NeuQuant,
    known: HashMap<[u8; 3], u8>,
}

impl Palette {
    const BLACK: [u8; 3] = [0; 3];

    /// The palette for pictures of which these are samples.
    pub(super) fn of(samples: &[RgbImage]) -> Self {
        let colors = samples.iter().flat_map(RgbImage::pixels).map(|pixel| pixel.0).filter(|&color| color != Self::BLACK);
        let rgba: Vec<u8> = colors.flat_map(|[r, g, b]| [r, g, b, 0xff]).collect();
        // It looks at every third pixel.
        Self { made: NeuQuant::new(3, 255, &rgba), known: HashMap::from([(Self::BLACK, 0)]) }
    }

    /// The number of the colour nearest to this one.
    fn nearest(&mut self, color: [u8; 3]) -> u8 {
        let [r, g, b] = color;
        *self.known.entry(color).or_insert_with(|| 1 + self.made.index_of(&[r, g, b, 0xff]) as u8)
    }

    /// Red, green and blue of all colours.
    fn colors(&self) -> Vec<u8> {
        [Self::BLACK.to_vec(), self.made.color_map_rgb()].concat()
    }
}

/// An animation being made, frame by frame; it repeats for ever.
pub(super) struct Animation {
    encoder: Encoder<Vec<u8>>,
    palette: Palette,
}

impl Animation {
    /// An animation without frames.
    pub(super) fn new(size: Size, palette: Palette) -> Result<Self> {
        let mut encoder = Encoder::new(Vec::new(), size.width as u16, size.height as u16, &palette.colors())?;
        encoder.set_repeat(Repeat::Infinite)?;
        Ok(Self { encoder, palette })
    }

    /// Adds a frame.
    pub(super) fn add(&mut self, picture: &RgbImage) -> Result<()> {
        let pixels: Vec<u8> = picture.pixels().map(|pixel| self.palette.nearest(pixel.0)).collect();
        let (width, height) = picture.dimensions();
        let frame = Frame::from_indexed_pixels(width as u16, height as u16, pixels, None);
        Ok(self.encoder.write_frame(&Frame { delay: DELAY, ..frame })?)
    }

    /// The file.
    pub(super) fn finish(self) -> Result<Vec<u8>> {
        Ok(self.encoder.into_inner()?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_frame_is_there_and_black_is_black() {
        let black = RgbImage::new(4, 3);
        let mut animation = Animation::new(Size::new(4, 3), Palette::of(std::slice::from_ref(&black))).unwrap();
        animation.add(&black).unwrap();
        animation.add(&black).unwrap();
        let file = animation.finish().unwrap();
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::RGBA);
        let mut decoder = options.read_info(file.as_slice()).unwrap();
        for _ in 0..2 {
            let frame = decoder.read_next_frame().unwrap().unwrap();
            assert_eq!((&*frame.buffer, frame.delay), ([0, 0, 0, 0xff].repeat(12).as_slice(), DELAY));
        }
        assert!(decoder.read_next_frame().unwrap().is_none());
    }
}
