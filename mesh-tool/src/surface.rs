//! A material before it is quantised.

use std::fmt::Write;

use beamshade::Material;

/// A material in f64, as the file or the [options](crate::Options) give it; what lies outside of 0 to 1 is clamped when it
/// becomes a [`Material`].
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The file's name for it; empty if it has none.
    pub name: String,
    /// Base colour: red, green, blue from 0 to 1, linear.
    pub base: [f64; 3],
    /// Colour of the highlight, likewise.
    pub highlight: [f64; 3],
    /// Ambient coefficient, 0 to 1.
    pub ambient: f64,
    /// Diffuse coefficient, 0 to 1.
    pub diffuse: f64,
    /// Specular coefficient, 0 to 1.
    pub specular: f64,
    /// Exponent, 1 to 256 being useful.
    pub exponent: u16,
    /// Back faces are seen too.
    pub double_sided: bool,
    /// Opacity, 0 to 1; transparent below 1.
    pub opacity: f64,
}

impl Default for Surface {
    /// Light grey, otherwise as [`Material::new`] has it.
    fn default() -> Self {
        Self {
            name: String::new(),
            base: [0.8; 3],
            highlight: [1.0; 3],
            ambient: 0.15,
            diffuse: 0.75,
            specular: 0.5,
            exponent: 32,
            double_sided: false,
            opacity: 1.0,
        }
    }
}

impl Surface {
    /// The largest exponent taken from a file; beyond it a highlight is smaller than a pixel of a small display.
    pub(crate) const MAX_EXPONENT: f64 = 256.0;

    /// The words of the binary form, see [`Material::from_words`].
    pub(crate) fn words(&self) -> [u16; Material::WORDS] {
        let [br, bg, bb] = self.base.map(q15);
        let [hr, hg, hb] = self.highlight.map(q15);
        let [ambient, diffuse, specular] = [self.ambient, self.diffuse, self.specular].map(q15);
        [
            br,
            bg,
            bb,
            hr,
            hg,
            hb,
            ambient,
            diffuse,
            specular,
            self.exponent,
            self.double_sided.into(),
            (1 << 15) - q15(self.opacity),
        ]
    }

    /// The quantised material.
    pub(crate) fn material(&self) -> Material {
        Material::from_words(self.words())
    }

    /// A const expression for the quantised material. A Q15 word over 32768 is an f32 without rounding, and is printed so
    /// that it reads back as the same f32.
    pub(crate) fn rust(&self) -> String {
        let [br, bg, bb, hr, hg, hb, factors @ .., exponent, _, clearness] = self.words();
        let [ambient, diffuse, specular] = factors.map(|word| f32::from(word) / 32768.0);
        let mut rust = format!(
            "beamshade::Material::new(beamshade::Color([{br}, {bg}, {bb}])).highlight(beamshade::Color([{hr}, {hg}, {hb}]))\
             .ambient({ambient:?}).diffuse({diffuse:?}).specular({specular:?}).exponent({exponent})"
        );
        if self.double_sided {
            let _ = write!(rust, ".double_sided()");
        }
        if clearness > 0 {
            let _ = write!(rust, ".opacity({:?})", 1.0 - f32::from(clearness) / 32768.0);
        }
        rust
    }
}

/// 0 to 1 in Q15, rounded to nearest, clamped; NaN is 0.
fn q15(factor: f64) -> u16 {
    (factor.clamp(0.0, 1.0) * 32768.0).round() as u16
}

#[cfg(test)]
mod tests {
    use beamshade::Color;

    use super::*;

    #[test]
    fn the_default_is_that_of_the_renderer() {
        let white = Surface { base: [1.0; 3], ..Surface::default() };
        assert_eq!(white.material(), Material::new(Color::WHITE));
    }

    #[test]
    fn every_factor_is_printed_exactly() {
        for word in 0..=1u16 << 15 {
            let printed = format!("{:?}", f32::from(word) / 32768.0);
            let read: f32 = printed.parse().unwrap();
            assert_eq!((read * 32768.0 + 0.5) as u16, word);
        }
    }

    #[test]
    fn factors_are_clamped() {
        assert_eq!([-1.0, 0.0, 0.5, 1.0, 7.0, f64::NAN].map(q15), [0, 0, 16384, 32768, 32768, 0]);
    }
}
