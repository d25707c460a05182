//! Faces without a structure: what a file holds before it is known to be a mesh.
//!
//! A [`FaceList`] is positions and polygons that name them by number. Anything can stand in it, also what no mesh can
//! hold; [`FaceList::defects`] tells what is wrong, [`FaceList::census`] counts what stands there as it is, and
//! [`FaceList::triangulate`] makes triangles of the polygons.
//!
//! **Deliberately not here**: files ([`crate::io`]) and the mesh itself ([`crate::mesh`]).

mod census;
mod defects;
mod disjoint;
mod sieve;
mod table;
mod triangulate;

pub(crate) use census::bounds;
pub use census::{Census, Valences};
pub(crate) use defects::{bow_ties, enumerated, non_finite, non_manifold_edges, orientation, too_many_vertices};
pub(crate) use sieve::Sieve;
pub(crate) use table::{EdgeTable, Fans, TableEdge};
pub use triangulate::Triangulation;

use std::ops::Range;

use glam::DVec3;

use crate::parallel;

/// Positions, and polygons whose corners are indices into them, in counter-clockwise order seen from outside.
///
/// It promises nothing: indices may be out of range, positions may be no numbers, corners may repeat.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceList {
    /// Where vertex `k` is.
    pub positions: Vec<DVec3>,
    corners: Vec<u32>,
    /// Where each face ends in `corners`.
    ends: Vec<u32>,
}

impl FaceList {
    /// A list with these positions and no face.
    #[must_use]
    pub fn new(positions: Vec<DVec3>) -> Self {
        Self { positions, ..Self::default() }
    }

    /// A list of triangles.
    #[must_use]
    pub fn from_triangles(positions: Vec<DVec3>, triangles: &[[u32; 3]]) -> Self {
        Self::of_triangles(positions, triangles.to_vec())
    }

    pub(crate) fn of_triangles(positions: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Self {
        let ends = (1..=triangles.len()).map(|k| 3 * k as u32).collect();
        Self { positions, corners: triangles.into_flattened(), ends }
    }

    /// Adds a face at the end.
    pub fn push_face(&mut self, corners: &[u32]) {
        self.corners.extend_from_slice(corners);
        self.ends.push(self.corners.len() as u32);
    }

    /// How many vertices there are, used or not.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// How many faces there are, of any number of sides.
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.ends.len()
    }

    /// The corners of face `k`.
    ///
    /// # Panics
    /// If there is no face `k`.
    #[must_use]
    pub fn face(&self, k: usize) -> &[u32] {
        &self.corners[self.corner_range(k)]
    }

    /// The faces in their order, each as its corners.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = &[u32]> + Clone {
        (0..self.face_count()).map(|k| self.face(k))
    }

    /// Where the corners of face `k` stand among all corners, counted through all faces.
    ///
    /// # Panics
    /// If there is no face `k`.
    #[must_use]
    pub fn corner_range(&self, k: usize) -> Range<usize> {
        let start = if k == 0 { 0 } else { self.ends[k - 1] as usize };
        start..self.ends[k] as usize
    }

    /// The corners of all faces, if they are triangles.
    pub(crate) fn triangles(&self) -> Option<&[u32]> {
        let other = parallel::find(0..self.face_count(), |k| self.ends[k] as usize != 3 * (k + 1));
        other.is_none().then_some(&self.corners)
    }

    fn corner_ranges(&self) -> impl Iterator<Item = Range<usize>> {
        (0..self.face_count()).map(|k| self.corner_range(k))
    }
}
