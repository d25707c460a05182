//! Vertices where a mesh bends in all directions.

use std::fmt;

use super::{Criterion, at_least_0, shortest};
use crate::error::{ConfigError, SelectError};
use crate::mesh::Mesh;
use crate::query::curvature::gaussian;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The vertices whose absolute [Gaussian curvature](gaussian) |K| is above a threshold.
///
/// K is 1 divided by the square of a length, so the threshold depends on the unit: half the size, four times the curvature. On
/// a boundary K is (π − Σθ)/A, which a bend of the boundary raises even in a plane. A triangle without area has angles but
/// no area; a vertex without any area around it is not selected.
///
/// Complexity: O(vertices + edges). Source: `[meyer2003]`, section 4.1.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Curvature {
    above: f64,
}

impl Curvature {
    /// The vertices of greater curvature than this, up or down.
    ///
    /// # Errors
    /// If the number is not finite, or below 0.
    pub fn new(above: f64) -> Result<Self, ConfigError> {
        at_least_0("curvature", above).map(|above| Self { above })
    }
}

impl Criterion for Curvature {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let values = gaussian(mesh);
        Ok(Selection::of_those(mesh.vertex_count(), |v| values[v.index()].abs() > self.above))
    }
}

/// As an expression has it: `curvature:K`.
impl fmt::Display for Curvature {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "curvature:{}", shortest(self.above))
    }
}
