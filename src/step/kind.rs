//! How a step cuts triangles.

use std::fmt;

/// How the triangles are cut in every step of a run.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum SplitKind {
    /// Every edge in two, every triangle in four.
    Quadrisect,
    /// Every triangle in three around a new vertex, and the old edges turned; under √3.
    Trisect,
    /// Pairs of triangles across the edge between them; under 4-8.
    Bisect,
}

impl SplitKind {
    /// The word for it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Quadrisect => "quadrisection",
            Self::Trisect => "trisection",
            Self::Bisect => "bisection",
        }
    }
}

impl fmt::Display for SplitKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
