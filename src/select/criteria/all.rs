//! Everything.

use std::fmt;

use super::Criterion;
use crate::error::SelectError;
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// Every vertex, isolated ones too.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct All;

impl Criterion for All {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        Ok(Selection::all(mesh.vertex_count()))
    }
}

/// As an expression has it: `all`.
impl fmt::Display for All {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("all")
    }
}
