//! Vertices far from where subdivision leads them.

use std::fmt;

use super::{Criterion, diagonal};
use crate::error::SelectError;
use crate::length::Length;
use crate::limit::LoopLimit;
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The vertices whose distance |v − v∞| from their limit by the Loop scheme is above a length, and all their neighbours.
///
/// It is the scheme's limit whatever scheme refines: of an interpolating one, which moves no old vertex, every distance is 0.
/// Boundary and crease vertices have the limit of their curve, corners lie there already, and isolated vertices too. Of a
/// semi-sharp vertex the limit is not known until its sharpness has faded, so it counts as far, as it does to static/mobile
/// subdivision. Faces without area are like others, since only positions count. A relative length refers to the bounding box
/// of the mesh as it is.
///
/// Complexity: O(vertices + edges). Source: `[incremental]`, equations 11 and 12.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LimitError {
    limit: LoopLimit,
    above: Length,
}

impl LimitError {
    /// The vertices farther from their limit than a length, by Loop's weights, and their neighbours.
    #[must_use]
    pub fn new(above: Length) -> Self {
        Self::with(LoopLimit::default(), above)
    }

    /// The same by other weights.
    #[must_use]
    pub fn with(limit: LoopLimit, above: Length) -> Self {
        Self { limit, above }
    }
}

impl Criterion for LimitError {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let above = self.above.distance(|| diagonal(mesh));
        let distances = self.limit.distances(mesh);
        let is_far = |v: usize| distances[v].is_none_or(|distance| distance > above);
        Ok(Selection::of_those(mesh.vertex_count(), |v| {
            is_far(v.index()) || mesh.ring(v).iter().any(|w| is_far(w.index()))
        }))
    }
}

/// As an expression has it: `limit-error:EPS` or `limit-error:EPS%`; the weights are not told.
impl fmt::Display for LimitError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "limit-error:{}", self.above)
    }
}
