//! Vertices where a mesh bends on average.

use std::fmt;

use super::{Criterion, at_least_0, shortest};
use crate::error::{ConfigError, SelectError};
use crate::mesh::Mesh;
use crate::query::curvature::mean;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The vertices whose absolute [mean curvature](mean) |H| is above a threshold.
///
/// H is 1 divided by a length: half the size, twice the curvature. A fold that runs straight has one, while its Gaussian
/// curvature is 0. Boundary vertices have none and are not selected; triangles without area count for nothing.
///
/// Complexity: O(vertices + edges). Source: `[meyer2003]`, section 3.5.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct MeanCurvature {
    above: f64,
}

impl MeanCurvature {
    /// The vertices of greater mean curvature than this, outwards or inwards.
    ///
    /// # Errors
    /// If the number is not finite, or below 0.
    pub fn new(above: f64) -> Result<Self, ConfigError> {
        at_least_0("curvature", above).map(|above| Self { above })
    }
}

impl Criterion for MeanCurvature {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let values = mean(mesh);
        Ok(Selection::of_those(mesh.vertex_count(), |v| values[v.index()] > self.above))
    }
}

/// As an expression has it: `mean-curvature:H`.
impl fmt::Display for MeanCurvature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "mean-curvature:{}", shortest(self.above))
    }
}
