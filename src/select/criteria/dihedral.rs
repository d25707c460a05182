//! Vertices at the folds of a mesh.

use std::fmt;

use super::{Criterion, half_turn, shortest};
use crate::angle::Angle;
use crate::error::{ConfigError, SelectError};
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::parallel;
use crate::query::measure::{angle_between_rad, triangle_normal};
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// Both ends and the two opposite vertices of every edge whose dihedral angle is above a threshold.
///
/// The angle is that between the normals of the two faces: 0 where they lie flat, 180° where one is folded back onto the
/// other. Boundary edges and edges of a face without area have none.
///
/// Complexity: O(vertices + edges).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Dihedral {
    above: Angle,
}

impl Dihedral {
    /// The edges folded by more than an angle.
    ///
    /// # Errors
    /// If the angle is not from 0 to 180 degrees.
    pub fn new(above: Angle) -> Result<Self, ConfigError> {
        half_turn(above).map(|above| Self { above })
    }
}

impl Criterion for Dihedral {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        let mut marks = scratch.marks(mesh.vertex_count(), 1);
        for v in folded_edges(mesh, self.above).flatten() {
            marks.insert(v);
        }
        Ok(Selection::of_those(mesh.vertex_count(), |v| marks.is_set(v)))
    }
}

/// The edges folded by more than an angle: both ends, then the vertices opposite on the left and on the right.
pub(super) fn folded_edges(mesh: &Mesh, above: Angle) -> impl Iterator<Item = [VertexId; 4]> {
    let threshold = above.rad();
    let folds_from = |a: usize| {
        let a = VertexId::new(a);
        let ring = mesh.ring(a);
        // By slots: to search the ring for each neighbour would cost the square of the valence.
        ring.iter().enumerate().filter(move |&(_, b)| a < b).filter_map(move |(slot, b)| {
            let (left, right) = (ring.behind(slot)?, ring.ahead(slot)?);
            let angle = angle_rad(mesh, [a, b, left], [b, a, right])?;
            (angle > threshold).then_some([a, b, left, right])
        })
    };
    parallel::gather(0..mesh.vertex_count(), folds_from).into_iter()
}

/// The angle between the normals of two faces; `None` if one of them has no area.
fn angle_rad(mesh: &Mesh, left: [VertexId; 3], right: [VertexId; 3]) -> Option<f64> {
    let normal = |corners: [VertexId; 3]| triangle_normal(corners.map(|v| mesh.position(v)));
    Some(angle_between_rad(normal(left)?, normal(right)?))
}

/// As an expression has it: `dihedral:DEG`.
impl fmt::Display for Dihedral {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "dihedral:{}", shortest(self.above.deg()))
    }
}
