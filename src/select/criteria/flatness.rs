//! Vertices whose neighbours do not lie in a plane.

use std::fmt;

use super::{Criterion, diagonal};
use crate::error::SelectError;
use crate::length::Length;
use crate::mesh::Mesh;
use crate::query::flatness;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The vertices with a neighbour farther than a length from the plane through the vertex, across the mean of the normals of its
/// faces: those whose [`flatness()`] is above the length.
///
/// A boundary vertex has the faces it has. Faces without area have no normal and do not count; where there is none, or the
/// normals cancel each other, there is no plane, and the vertex is not selected. A relative length refers to the bounding box
/// of the mesh as it is.
///
/// Complexity: O(vertices + edges).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Flatness {
    above: Length,
}

impl Flatness {
    /// The vertices with a neighbour farther than this from their plane.
    #[must_use]
    pub fn new(above: Length) -> Self {
        Self { above }
    }
}

impl Criterion for Flatness {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let above = self.above.distance(|| diagonal(mesh));
        Ok(Selection::of_those(mesh.vertex_count(), |v| flatness(mesh, v) > above))
    }
}

/// As an expression has it: `flatness:L` or `flatness:L%`.
impl fmt::Display for Flatness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "flatness:{}", self.above)
    }
}
