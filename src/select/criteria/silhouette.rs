//! Edges where a mesh turns away from who looks.

use std::fmt;

use glam::DVec3;

use super::{Criterion, edges_that, shortest};
use crate::error::{ConfigError, SelectError};
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::query::measure::triangle_normal;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The edges between a face that is seen from outside and one that is seen from inside: (n · d)(m · d) ≤ 0 for the normals n
/// and m of both faces and the direction d from the edge to the eye, or a constant one. A face seen exactly from the side
/// belongs to both kinds, so all its edges are selected.
///
/// A boundary edge has one face, and is not selected; it is part of the outline always, and `silhouette:...|boundary` takes it
/// in. An edge of a face without area is not selected either.
///
/// Complexity: O(vertices + edges), and O(n log n) with n edges selected.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Silhouette {
    view: View,
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum View {
    From(DVec3),
    Along(DVec3),
}

impl Silhouette {
    /// As an eye at a point sees it.
    ///
    /// # Errors
    /// If a coordinate is not finite.
    pub fn from_eye(eye: DVec3) -> Result<Self, ConfigError> {
        if eye.is_finite() {
            return Ok(Self { view: View::From(eye) });
        }
        Err(ConfigError { name: "eye", value: eye.to_string(), expected: "expected finite coordinates".to_owned() })
    }

    /// As it is seen from very far away along a direction, of any length; from which of its two ends makes no difference.
    ///
    /// # Errors
    /// If a coordinate is not finite, or all are 0.
    pub fn along(direction: DVec3) -> Result<Self, ConfigError> {
        if direction.is_finite() && direction != DVec3::ZERO {
            return Ok(Self { view: View::Along(direction) });
        }
        let expected = "expected finite coordinates, not all 0".to_owned();
        Err(ConfigError { name: "dir", value: direction.to_string(), expected })
    }

    /// Whether a face is seen from outside (1), from inside (-1) or from the side (0); `None` if it has no area.
    fn side(self, mesh: &Mesh, corners: [VertexId; 3]) -> Option<i8> {
        let corners = corners.map(|v| mesh.position(v));
        let direction = match self.view {
            View::From(eye) => eye - corners[0],
            View::Along(direction) => direction,
        };
        // Only the sign counts, and without its length no product of it vanishes.
        let cosine = triangle_normal(corners)?.dot(direction / direction.abs().max_element().max(f64::MIN_POSITIVE));
        Some(i8::from(cosine > 0.0) - i8::from(cosine < 0.0))
    }
}

impl Criterion for Silhouette {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        Ok(edges_that(mesh, |[a, b], opposite| {
            let [Some(left), Some(right)] = opposite else { return false };
            let sides = self.side(mesh, [a, b, left]).zip(self.side(mesh, [a, right, b]));
            sides.is_some_and(|(left, right)| left * right <= 0)
        }))
    }
}

/// As an expression has it: `silhouette:eye=x,y,z` or `silhouette:dir=x,y,z`.
impl fmt::Display for Silhouette {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, vector) = match self.view {
            View::From(eye) => ("eye", eye),
            View::Along(direction) => ("dir", direction),
        };
        let [x, y, z] = vector.to_array().map(shortest);
        write!(f, "silhouette:{name}={x},{y},{z}")
    }
}
