//! Files that are either whole or not there.

use std::path::{Path, PathBuf};
use std::{env, fs};

use crate::error::Error;
use crate::model::Model;
use crate::options::Options;
use crate::quantized::Quantized;
use crate::report::Report;

/// For a build script: reads a model and writes it to `$OUT_DIR/<stem>.rs` as a `pub static` of that name. Cargo is told to
/// run the script again when one of the files changes that were read.
///
/// ```no_run
/// use beamshade_mesh::{build, Error, Options};
///
/// fn main() -> Result<(), Error> {
///     build("models/teapot.obj", "TEAPOT", &Options { fit: true, ..Default::default() })?;
///     Ok(())
/// }
/// ```
///
/// # Errors
/// As [`Model::load`], [`Model::quantize`] and [`Quantized::save`]; or there is no `OUT_DIR`.
pub fn build(path: impl AsRef<Path>, name: &str, options: &Options) -> Result<Report, Error> {
    let path = path.as_ref();
    // First, so that a broken model is looked at again when it is mended.
    println!("cargo:rerun-if-changed={}", path.display());
    let folder = env::var_os("OUT_DIR").ok_or_else(|| Error::file(path, "OUT_DIR is not set: this is for build scripts"))?;
    let model = Model::load(path, options)?;
    for file in model.files.iter().skip(1) {
        println!("cargo:rerun-if-changed={}", file.display());
    }
    let quantized = model.quantize()?;
    let mut output = PathBuf::from(folder);
    output.push(path.with_extension("rs").file_name().unwrap_or_default());
    quantized.save(&output, name)?;
    Ok(*quantized.report())
}

impl Quantized {
    /// Writes a file: Rust source for `.rs`, with a `pub static` of that name; the binary form for `.bin`.
    ///
    /// It is written under another name in the same folder first, so that nothing is left of it if that fails.
    ///
    /// # Errors
    /// Another extension; a name that is not that of a Rust static; whatever the file system says.
    pub fn save(&self, path: impl AsRef<Path>, name: &str) -> Result<(), Error> {
        let path = path.as_ref();
        let contents = match path.extension().and_then(|extension| extension.to_str()) {
            Some("rs") if !is_static_name(name) => {
                return Err(Error::file(path, format!("`{}` is no name of a static, such as TEAPOT", name.escape_debug())));
            }
            Some("rs") => self.rust_source(name).into_bytes(),
            Some("bin") => self.to_bytes(),
            _ => return Err(Error::file(path, "a mesh can be written as .rs or .bin")),
        };
        let mut hidden = path.as_os_str().to_owned();
        hidden.push(format!(".{}", std::process::id()));
        let written = fs::write(&hidden, contents).and_then(|()| fs::rename(&hidden, path));
        written.map_err(|error| {
            // Whether it is there or not, it must not stay.
            let _ = fs::remove_file(&hidden);
            Error::file(path, error)
        })
    }
}

fn is_static_name(name: &str) -> bool {
    let tail_is_good = name.bytes().all(|byte| byte.is_ascii_uppercase() || byte.is_ascii_digit() || byte == b'_');
    tail_is_good && name.bytes().any(|byte| byte.is_ascii_uppercase()) && !name.starts_with(|first: char| first.is_ascii_digit())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_statics() {
        assert!(["A", "TEAPOT_2", "_X"].into_iter().all(is_static_name));
        assert!(!["", "_", "2D", "Teapot", "A-B", "A B", "É"].into_iter().any(is_static_name));
    }
}
