//! The vertices where a mesh bends most.

use std::fmt;

use super::{Criterion, shortest};
use crate::error::{ConfigError, SelectError};
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::query::curvature::gaussian;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// A share of the vertices, those of the greatest absolute [Gaussian curvature](gaussian); of equal ones, those with the
/// smaller ids.
///
/// The share is one of all vertices, rounded to the nearest number of them; where a mesh is flat those of curvature 0 fill it
/// up. It does not depend on the unit. Boundaries and degenerate faces are as [`Curvature`](super::Curvature) has them.
///
/// Complexity: O(vertices log vertices).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct CurvatureTop {
    percent: f64,
}

impl CurvatureTop {
    /// So many hundredths of the vertices.
    ///
    /// # Errors
    /// If the number is not from 0 to 100.
    pub fn new(percent: f64) -> Result<Self, ConfigError> {
        if (0.0..=100.0).contains(&percent) {
            return Ok(Self { percent });
        }
        let expected = "expected a number from 0 to 100".to_owned();
        Err(ConfigError { name: "percent", value: shortest(percent), expected })
    }
}

impl Criterion for CurvatureTop {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let values = gaussian(mesh);
        let count = (self.percent * mesh.vertex_count() as f64 / 100.0).round() as usize;
        let mut vertices: Vec<VertexId> = mesh.vertices().collect();
        // The sort is stable, so equal ones stay in the order of their ids.
        vertices.sort_by(|v, w| values[w.index()].abs().total_cmp(&values[v.index()].abs()));
        vertices.truncate(count);
        Ok(vertices.into_iter().collect())
    }
}

/// As an expression has it: `curvature-top:P%`.
impl fmt::Display for CurvatureTop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "curvature-top:{}%", shortest(self.percent))
    }
}
