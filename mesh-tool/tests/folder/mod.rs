//! A folder of files that goes away with the test.

#![allow(dead_code, reason = "no test needs all of it")]

use std::path::PathBuf;

use beamshade_mesh::{Model, Options};

pub(crate) struct Folder(tempfile::TempDir);

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn write(&self, name: &str, contents: impl AsRef<[u8]>) -> PathBuf {
        std::fs::write(self.path(name), contents).unwrap();
        self.path(name)
    }

    pub(crate) fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

/// What is said about a broken file, without the folder.
pub(crate) fn error(name: &str, contents: impl AsRef<[u8]>) -> String {
    let folder = Folder::new();
    let path = folder.write(name, contents);
    let error = Model::load(&path, &Options::default()).and_then(|model| model.quantize()).unwrap_err().to_string();
    error.replace(&format!("{}/", folder.0.path().display()), "")
}

/// Loads a file over and over, each time with a few bytes changed and perhaps its end cut off. All it may do is fail.
pub(crate) fn mutate(name: &str, contents: &[u8], times: u32) {
    let folder = Folder::new();
    let mut random = Random(1);
    for _ in 0..times {
        let mut bytes = contents.to_vec();
        for _ in 0..=random.below(3) {
            let at = random.below(bytes.len());
            bytes[at] = random.below(256) as u8;
        }
        if random.below(4) == 0 {
            bytes.truncate(random.below(bytes.len()));
        }
        let path = folder.write(name, bytes);
        if let Ok(mesh) = Model::load(&path, &Options::default()).and_then(|model| model.quantize()) {
            assert!(!mesh.mesh().data().triangles.is_empty());
        }
    }
}

/// Marsaglia's xorshift.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn below(&mut self, end: usize) -> usize {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 16) as usize % end
    }
}
