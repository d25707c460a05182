//! A file could not be read.

use std::fmt;

/// Why a file could not be read.
#[derive(Debug)]
#[non_exhaustive]
pub enum ReadErrorKind {
    /// The file system said no.
    Io(std::io::Error),
}

/// A file could not be read, and the line at which that was found.
#[derive(Debug)]
pub struct ReadError {
    /// The line, from 1, if one is to blame.
    pub line: Option<usize>,
    /// What is wrong with it.
    pub kind: ReadErrorKind,
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.kind {
            ReadErrorKind::Io(error) => write!(f, "{error}"),
        }
    }
}

impl std::error::Error for ReadError {}
