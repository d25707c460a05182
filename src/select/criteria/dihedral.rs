//! Vertices at the folds of a mesh.

use std::fmt;

use super::{Criterion, shortest};
use crate::angle::Angle;
use crate::error::{ConfigError, SelectError};
use crate::id::VertexId;
use crate::mesh::Mesh;
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
        if (0.0..=180.0).contains(&above.deg()) {
            Ok(Self { above })
        } else {
            let expected = "expected degrees from 0 to 180".to_owned();
            Err(ConfigError { name: "angle", value: shortest(above.deg()), expected })
        }
    }
}

impl Criterion for Dihedral {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        let threshold = self.above.rad();
        let mut marks = scratch.marks(mesh.vertex_count(), 1);
        for a in mesh.vertices() {
            let ring = mesh.ring(a);
            // By slots: to search the ring for each neighbour would cost the square of the valence.
            for (slot, &b) in ring.neighbors().iter().enumerate() {
                let (Some(left), Some(right)) = (ring.slot_after(slot), ring.slot_before(slot)) else { continue };
                let [left, right] = [left, right].map(|slot| ring.neighbors()[slot]);
                if a < b && angle_rad(mesh, [a, b, left], [b, a, right]).is_some_and(|angle| angle > threshold) {
                    for v in [a, b, left, right] {
                        marks.insert(v);
                    }
                }
            }
        }
        Ok(mesh.vertices().filter(|&v| marks.is_set(v)).collect())
    }
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
