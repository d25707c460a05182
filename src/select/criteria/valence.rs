//! Vertices of many neighbours.

use std::fmt;

use super::Criterion;
use crate::error::SelectError;
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The vertices of more neighbours than a number.
///
/// So `valence:6` are those above the regular valence inside, and `!valence:5` those of at most 5. A boundary vertex is
/// regular with 4; isolated vertices have 0.
///
/// Complexity: O(vertices).
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Valence {
    above: usize,
}

impl Valence {
    /// The vertices of more neighbours than this.
    #[must_use]
    pub fn new(above: usize) -> Self {
        Self { above }
    }
}

impl Criterion for Valence {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        Ok(Selection::of_those(mesh.vertex_count(), |v| mesh.ring(v).valence() > self.above))
    }
}

/// As an expression has it: `valence:N`.
impl fmt::Display for Valence {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "valence:{}", self.above)
    }
}
