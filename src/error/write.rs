//! A file could not be written.

use std::fmt;
use std::path::PathBuf;

/// Why a file could not be written.
#[derive(Debug)]
#[non_exhaustive]
pub enum WriteErrorKind {
    /// The file system said no.
    Io(std::io::Error),
    /// The ending of the name tells no format that is written.
    UnknownEnding,
    /// The path names a folder.
    Folder,
    /// The file that would be replaced is write-protected.
    ReadOnly,
}

/// A file could not be written; what stood there before is untouched.
#[derive(Debug)]
pub struct WriteError {
    /// The file that was to be written.
    pub path: PathBuf,
    /// Why it was not.
    pub kind: WriteErrorKind,
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cannot write {}: ", self.path.display())?;
        match &self.kind {
            WriteErrorKind::Io(error) => write!(f, "{error}"),
            WriteErrorKind::UnknownEnding => write!(f, "the name must end in .obj, .off, .ply or .stl"),
            WriteErrorKind::Folder => write!(f, "it is a folder; name a file in it"),
            WriteErrorKind::ReadOnly => {
                write!(f, "the file there is read-only; take the protection off or name another")
            }
        }
    }
}

impl std::error::Error for WriteError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.kind {
            WriteErrorKind::Io(error) => Some(error),
            _ => None,
        }
    }
}
