//! Large faces.

use std::fmt;

use super::{Criterion, at_least_0, faces_that, shortest};
use crate::error::{ConfigError, SelectError};
use crate::mesh::Mesh;
use crate::query::measure::triangle_area;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The faces whose area |(b − a) × (c − a)|/2 is above a threshold. Those without area never are.
///
/// Complexity: O(faces), and O(n log n) with n faces selected.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Area {
    above: f64,
}

impl Area {
    /// The faces larger than this.
    ///
    /// # Errors
    /// If the number is not finite, or below 0.
    pub fn new(above: f64) -> Result<Self, ConfigError> {
        at_least_0("area", above).map(|above| Self { above })
    }
}

impl Criterion for Area {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        Ok(faces_that(mesh, |corners| triangle_area(corners.map(|v| mesh.position(v))) > self.above))
    }
}

/// As an expression has it: `area:A`.
impl fmt::Display for Area {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "area:{}", shortest(self.above))
    }
}
