//! Output formats, and their common measure: levels of 8 bits.

use embedded_graphics::pixelcolor::{Gray4, Gray8, GrayColor, Rgb565, Rgb888, RgbColor};

/// A pixel of an output format.
pub trait Format: Copy {
    /// The pixel nearest to red, green and blue from 0 to 1; beyond that they saturate. A grey format takes the green.
    fn round(color: [f64; 3]) -> Self;

    /// Red, green and blue in levels of 8 bits, 0 to 255: a channel of fewer bits is widened by `round(v · 255 / max)`.
    fn levels(self) -> [u8; 3];
}

impl Format for Gray8 {
    fn round([_, green, _]: [f64; 3]) -> Self {
        Self::new(narrow(green, 255))
    }

    fn levels(self) -> [u8; 3] {
        [self.luma(); 3]
    }
}

impl Format for Gray4 {
    fn round([_, green, _]: [f64; 3]) -> Self {
        Self::new(narrow(green, 15))
    }

    fn levels(self) -> [u8; 3] {
        [widen(self.luma(), 15); 3]
    }
}

impl Format for Rgb888 {
    fn round(color: [f64; 3]) -> Self {
        let [red, green, blue] = color.map(|channel| narrow(channel, 255));
        Self::new(red, green, blue)
    }

    fn levels(self) -> [u8; 3] {
        [self.r(), self.g(), self.b()]
    }
}

impl Format for Rgb565 {
    fn round([red, green, blue]: [f64; 3]) -> Self {
        Self::new(narrow(red, Self::MAX_R), narrow(green, Self::MAX_G), narrow(blue, Self::MAX_B))
    }

    fn levels(self) -> [u8; 3] {
        [widen(self.r(), Self::MAX_R), widen(self.g(), Self::MAX_G), widen(self.b(), Self::MAX_B)]
    }
}

/// The nearest of the levels 0 to `max`.
fn narrow(channel: f64, max: u8) -> u8 {
    (channel.clamp(0.0, 1.0) * f64::from(max)).round() as u8
}

/// A level of 0 to `max` in levels of 8 bits.
fn widen(level: u8, max: u8) -> u8 {
    (f64::from(level) * 255.0 / f64::from(max)).round() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_of_five_and_six_bits_spread_over_eight() {
        assert_eq!(Rgb565::new(0, 0, 0).levels(), [0, 0, 0]);
        assert_eq!(Rgb565::new(31, 63, 31).levels(), [255, 255, 255]);
        // 255/31 = 8.23, 255/63 = 4.05, 16 · 255/31 = 131.6
        assert_eq!(Rgb565::new(1, 1, 16).levels(), [8, 4, 132]);
    }

    #[test]
    fn colors_go_to_the_nearest_level_and_saturate() {
        assert_eq!(Rgb888::round([0.5, 1.7, -0.2]), Rgb888::new(128, 255, 0));
        assert_eq!(Rgb565::round([0.5, 0.5, 0.48]), Rgb565::new(16, 32, 15));
        assert_eq!(Gray8::round([0.0, 250.4 / 255.0, 1.0]), Gray8::new(250));
        assert_eq!(Gray8::new(7).levels(), [7; 3]);
        assert_eq!((Gray4::round([0.0, 0.5, 1.0]), Gray4::new(9).levels()), (Gray4::new(8), [153; 3]));
    }

    #[test]
    fn every_pixel_comes_back_from_its_levels() {
        for bits in 0..=u16::MAX {
            let pixel = Rgb565::new((bits >> 11) as u8, (bits >> 5 & 63) as u8, (bits & 31) as u8);
            assert_eq!(Rgb565::round(pixel.levels().map(|level| f64::from(level) / 255.0)), pixel);
        }
    }
}
