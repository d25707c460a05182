//! Long edges.

use std::fmt;

use super::{Criterion, diagonal, edges_that};
use crate::error::SelectError;
use crate::id::Edge;
use crate::length::Length;
use crate::mesh::Mesh;
use crate::query::measure::edge_length;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The edges longer than a length: |a − b| is above it.
///
/// Boundary edges and edges of faces without area are like others. A relative length refers to the bounding box of the mesh as
/// it is.
///
/// Complexity: O(vertices + edges), and O(n log n) with n edges selected.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct EdgeLength {
    above: Length,
}

impl EdgeLength {
    /// The edges longer than this.
    #[must_use]
    pub fn new(above: Length) -> Self {
        Self { above }
    }
}

impl Criterion for EdgeLength {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let above = self.above.distance(|| diagonal(mesh));
        Ok(edges_that(mesh, |[a, b], _| edge_length(mesh, Edge::new(a, b)) > above))
    }
}

/// As an expression has it: `edge-length:L` or `edge-length:L%`.
impl fmt::Display for EdgeLength {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "edge-length:{}", self.above)
    }
}
