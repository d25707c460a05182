//! Vertices around which the normals spread.

use std::fmt;

use super::{Criterion, half_turn, shortest};
use crate::angle::Angle;
use crate::error::{ConfigError, SelectError};
use crate::mesh::Mesh;
use crate::query::normal_cone_rad;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The vertices whose [normal cone](normal_cone_rad) has a half angle above a threshold: the greatest angle between the normal
/// of a face of theirs and the mean of those.
///
/// It does not depend on the unit. A boundary vertex has the faces it has. Faces without area have no normal and do not count;
/// where the normals of the others cancel each other the cone is as wide as it can be.
///
/// Complexity: O(vertices + edges).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NormalCone {
    above: Angle,
}

impl NormalCone {
    /// The vertices of a wider cone than this.
    ///
    /// # Errors
    /// If the angle is not from 0 to 180 degrees.
    pub fn new(above: Angle) -> Result<Self, ConfigError> {
        half_turn(above).map(|above| Self { above })
    }
}

impl Criterion for NormalCone {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let above = self.above.rad();
        Ok(Selection::of_those(mesh.vertex_count(), |v| normal_cone_rad(mesh, v) > above))
    }
}

/// As an expression has it: `normal-cone:DEG`.
impl fmt::Display for NormalCone {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "normal-cone:{}", shortest(self.above.deg()))
    }
}
