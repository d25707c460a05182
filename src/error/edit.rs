//! A local edit is not possible.

use std::fmt;

use crate::id::VertexId;

/// Why an edit was refused. The rotation system is as it was before.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum EditError {
    /// There is no such vertex.
    NoVertex(VertexId),
}

impl fmt::Display for EditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoVertex(v) => write!(f, "there is no vertex {v}; name an existing one"),
        }
    }
}

impl std::error::Error for EditError {}
