//! What is wrong with a file, and where.

use std::fmt;
use std::path::{Path, PathBuf};

/// What is wrong with a model, and where: `teapot.obj:12: corner 3 names vertex 9 of 8`.
#[derive(Debug)]
pub struct Error {
    file: PathBuf,
    place: Place,
    reason: String,
}

#[derive(Debug)]
enum Place {
    File,
    Line(usize),
    Element(String),
}

impl Error {
    /// Something is wrong with the file as a whole.
    pub(crate) fn file(file: &Path, reason: impl ToString) -> Self {
        Self { file: file.into(), place: Place::File, reason: reason.to_string() }
    }

    /// Something is wrong in a line, counted from 1.
    pub(crate) fn line(file: &Path, line: usize, reason: impl ToString) -> Self {
        Self { file: file.into(), place: Place::Line(line), reason: reason.to_string() }
    }

    /// Something is wrong in a part of a file that has no lines, such as `triangle 7`.
    pub(crate) fn element(file: &Path, element: impl ToString, reason: impl ToString) -> Self {
        Self { file: file.into(), place: Place::Element(element.to_string()), reason: reason.to_string() }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { file, place, reason } = self;
        match place {
            Place::File => write!(f, "{}: {reason}", file.display()),
            Place::Line(line) => write!(f, "{}:{line}: {reason}", file.display()),
            Place::Element(element) => write!(f, "{}: {element}: {reason}", file.display()),
        }
    }
}

impl std::error::Error for Error {}
