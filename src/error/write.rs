//! A file could not be written.

use std::fmt;

/// A file could not be written; what stood there before is untouched.
#[derive(Debug)]
pub struct WriteError {
    /// What the file system said.
    pub cause: std::io::Error,
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.cause)
    }
}

impl std::error::Error for WriteError {}
