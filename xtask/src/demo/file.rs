//! Files that are either whole or not there.

use anyhow::{Context, Result};
use std::fs;
use std::path::Path;

/// Writes a file, and its folder if that is not there: under another name in the same folder first, which does not stay
/// if anything fails.
pub(super) fn write(path: &Path, contents: &[u8]) -> Result<()> {
    let mut hidden = path.as_os_str().to_owned();
    hidden.push(format!(".{}", std::process::id()));
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    let written = folder.and_then(|()| fs::write(&hidden, contents)).and_then(|()| fs::rename(&hidden, path));
    if written.is_err() {
        // Whether it is there or not.
        let _ = fs::remove_file(&hidden);
    }
    written.with_context(|| path.display().to_string())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_left_of_a_file_that_cannot_be() {
        let folder = std::env::temp_dir().join(format!("beamshade-file-{}", std::process::id()));
        write(&folder.join("new/a.png"), b"whole").unwrap();
        // A folder is in the way.
        fs::create_dir(folder.join("new/b.png")).unwrap();
        let error = write(&folder.join("new/b.png"), b"whole").unwrap_err();
        assert!(error.to_string().contains("b.png"));
        let mut names: Vec<_> = fs::read_dir(folder.join("new")).unwrap().map(|file| file.unwrap().file_name()).collect();
        names.sort();
        assert_eq!(names, ["a.png", "b.png"]);
        fs::remove_dir_all(folder).unwrap();
    }
}
