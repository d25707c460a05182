//! Vertices near one, counted in edges.

use std::fmt;

use super::{Criterion, no_vertex};
use crate::error::SelectError;
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::query::r_disk;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The r-disk of a vertex: what is at most so many edges away from it.
///
/// Complexity: O(d log d) with d vertices and edges in the disk, whatever the size of the mesh and the radius.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Disk {
    center: VertexId,
    radius: usize,
}

impl Disk {
    /// The disk around a vertex, its radius counted in edges.
    #[must_use]
    pub fn new(center: VertexId, radius: usize) -> Self {
        Self { center, radius }
    }
}

impl Criterion for Disk {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        if !mesh.rotation().contains(self.center) {
            return Err(no_vertex(self.center, mesh));
        }
        let disk = r_disk(mesh.rotation(), [self.center], self.radius, scratch);
        Ok(disk.into_vertices().into_iter().collect())
    }
}

/// As an expression has it: `disk:V,R`.
impl fmt::Display for Disk {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "disk:{},{}", self.center.index(), self.radius)
    }
}
