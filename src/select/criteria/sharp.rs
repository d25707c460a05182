//! Edges that are sharp.

use std::fmt;

use super::{Criterion, edges_that};
use crate::error::SelectError;
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The sharp edges: those that are tagged so, for ever or for some steps, and those on a boundary, which are sharp by nature.
///
/// So `sharp&!boundary` are the creases inside. Positions do not count: an edge that is folded without a tag is found by
/// [`Dihedral`](super::Dihedral).
///
/// Complexity: O(vertices + edges), and O(n log n) with n edges selected.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Sharp;

impl Criterion for Sharp {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let around = mesh.neighborhood();
        Ok(edges_that(mesh, |[a, b], opposite| opposite.contains(&None) || around.is_tagged(a, b)))
    }
}

/// As an expression has it: `sharp`.
impl fmt::Display for Sharp {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("sharp")
    }
}
