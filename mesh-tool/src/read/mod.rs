//! The readers, one for each kind of file.

mod mtl;
mod obj;

#[cfg(feature = "gltf")]
mod gltf;
#[cfg(feature = "stl")]
mod stl;

use std::path::Path;

use crate::error::Error;
use crate::soup::Soup;

/// Reads a file by its extension.
pub(crate) fn read(path: &Path) -> Result<Soup, Error> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let read: fn(&Path, &[u8]) -> Result<Soup, Error> = match &*extension {
        "obj" => obj::read,
        #[cfg(feature = "stl")]
        "stl" => stl::read,
        #[cfg(feature = "gltf")]
        "gltf" | "glb" => gltf::read,
        known if ["stl", "gltf", "glb"].contains(&known) => {
            return Err(Error::file(path, format!("built without the feature that reads .{known}")))
        }
        _ => return Err(Error::file(path, "not a kind of file that can be read: .obj, .stl, .gltf or .glb")),
    };
    read(path, &bytes(path)?)
}

/// The contents of a file.
fn bytes(path: &Path) -> Result<Vec<u8>, Error> {
    std::fs::read(path).map_err(|error| Error::file(path, error))
}

/// A finite number in the range of f32, so that products of a few of them stay in the range of f64.
fn number(word: &str) -> Result<f64, String> {
    match word.parse::<f64>() {
        Ok(number) if (number as f32).is_finite() => Ok(number),
        _ => Err(format!("`{word}` is not a finite number")),
    }
}

/// The first N words as numbers.
fn numbers<'a, const N: usize>(words: &mut impl Iterator<Item = &'a str>) -> Result<[f64; N], String> {
    let mut numbers = [0.0; N];
    for (i, slot) in numbers.iter_mut().enumerate() {
        *slot = number(words.next().ok_or_else(|| format!("{i} numbers where {N} are needed"))?)?;
    }
    Ok(numbers)
}
