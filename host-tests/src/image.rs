//! Pictures in PNG files: 8 bits for each of red, green and blue.

use std::fs::File;
use std::io::{BufReader, BufWriter};
use std::path::Path;

use anyhow::{ensure, Context, Result};
use embedded_graphics::pixelcolor::Rgb888;
use png::{BitDepth, ColorType, Decoder, Encoder};

use crate::{Format, Picture};

/// Writes the colours of a picture, widened to 8 bits; what was there is replaced.
///
/// # Errors
///
/// When the file cannot be written.
pub fn write<F: Format>(path: impl AsRef<Path>, picture: &Picture<F>) -> Result<()> {
    let path = path.as_ref();
    let file = File::create(path).with_context(|| format!("creating {}", path.display()))?;
    let mut encoder = Encoder::new(BufWriter::new(file), u32::try_from(picture.width)?, u32::try_from(picture.height)?);
    encoder.set_color(ColorType::Rgb);
    encoder.set_depth(BitDepth::Eight);
    let levels: Vec<[u8; 3]> = picture.color.iter().map(|pixel| pixel.levels()).collect();
    let mut writer = encoder.write_header()?;
    writer.write_image_data(levels.as_flattened())?;
    writer.finish().with_context(|| format!("writing {}", path.display()))
}

/// Reads the colours of a picture. Files keep no owners: all of them are `None`.
///
/// # Errors
///
/// When the file cannot be read, is no PNG, or does not have 8 bits for each of red, green and blue.
pub fn read(path: impl AsRef<Path>) -> Result<Picture<Rgb888>> {
    let path = path.as_ref();
    let file = File::open(path).with_context(|| format!("opening {}", path.display()))?;
    let mut reader = Decoder::new(BufReader::new(file)).read_info()?;
    let size = reader.output_buffer_size().context("the picture is too large")?;
    let mut levels = vec![0; size];
    let frame = reader.next_frame(&mut levels).with_context(|| format!("reading {}", path.display()))?;
    let layout = (frame.color_type, frame.bit_depth);
    ensure!(layout == (ColorType::Rgb, BitDepth::Eight), "{} has the layout {layout:?}", path.display());

    let (pixels, _) = levels.as_chunks();
    Ok(Picture {
        width: frame.width as usize,
        height: frame.height as usize,
        color: pixels.iter().map(|&[red, green, blue]| Rgb888::new(red, green, blue)).collect(),
        owner: vec![None; pixels.len()],
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_back() {
        let path = std::env::temp_dir().join(format!("beamshade-image-{}.png", std::process::id()));
        let mut picture = Picture::blank(3, 2, Rgb888::new(1, 2, 3));
        picture.color[4] = Rgb888::new(200, 0, 255);
        write(&path, &picture).unwrap();
        let back = read(&path);
        std::fs::remove_file(&path).unwrap();
        assert_eq!(back.unwrap(), picture);
    }

    #[test]
    fn a_missing_file_is_named() {
        let error = read("no such picture.png").unwrap_err();
        assert!(error.to_string().contains("no such picture.png"));
    }
}
