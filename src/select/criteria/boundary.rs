//! Where a mesh ends.

use std::fmt;

use super::{Criterion, edges_that};
use crate::error::SelectError;
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The edges on a boundary: those of one face.
///
/// Complexity: O(vertices + edges), and O(n log n) with n edges selected.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Boundary;

impl Criterion for Boundary {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        Ok(edges_that(mesh, |_, opposite| opposite.contains(&None)))
    }
}

/// As an expression has it: `boundary`.
impl fmt::Display for Boundary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("boundary")
    }
}
