//! Faces at the folds of a mesh.

use std::fmt;

use super::dihedral::{Dihedral, folded_edges};
use super::{Criterion, shortest};
use crate::angle::Angle;
use crate::error::{ConfigError, SelectError};
use crate::id::Triangle;
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// Faces whose normal and that of a neighbour across an edge are more than an angle apart.
///
/// A face f is selected if a(f) = max over its neighbours g of atan2(|n × m|, n · m) is above the threshold, with n and m the
/// normals of f and g. Boundary edges and faces without area count for nothing, and faces without area are not selected.
/// With [neighbors](NormalAngle::and_neighbors) all faces that share an edge with a selected one are selected, too.
///
/// [`Dihedral`](super::Dihedral) is the same question to edges, and answers with vertices. Source: `[iterative]`.
///
/// Complexity: O(vertices + edges), and O(n log n) with n faces selected.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NormalAngle {
    above: Angle,
    and_neighbors: bool,
}

impl NormalAngle {
    /// The faces at an edge folded by more than an angle.
    ///
    /// # Errors
    /// If the angle is not from 0 to 180 degrees.
    pub fn new(above: Angle) -> Result<Self, ConfigError> {
        Dihedral::new(above)?;
        Ok(Self { above, and_neighbors: false })
    }

    /// The same with the faces that share an edge with them.
    #[must_use]
    pub fn and_neighbors(mut self) -> Self {
        self.and_neighbors = true;
        self
    }
}

impl Criterion for NormalAngle {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let folds = folded_edges(mesh, self.above);
        let sides = |[a, b, left, right]: [_; 4]| [Triangle::new(a, b, left), Triangle::new(b, a, right)];
        let mut faces: Vec<Triangle> = folds.flat_map(sides).collect();
        if self.and_neighbors {
            let neighbors: Vec<Triangle> = faces.iter().flat_map(|&face| across_edges(mesh, face)).collect();
            faces.extend(neighbors);
        }
        Ok(faces.into_iter().collect())
    }
}

/// The faces that share an edge with a face.
fn across_edges(mesh: &Mesh, face: Triangle) -> impl Iterator<Item = Triangle> {
    let [a, b, c] = face.corners();
    let rotation = mesh.rotation();
    [[b, a], [c, b], [a, c]].into_iter().filter_map(move |[p, q]| Some(Triangle::new(p, q, rotation.left_of(p, q)?)))
}

/// As an expression has it: `normal-angle:DEG`, with `+neighbors` behind it if they belong to it.
impl fmt::Display for NormalAngle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let neighbors = if self.and_neighbors { "+neighbors" } else { "" };
        write!(f, "normal-angle:{}{neighbors}", shortest(self.above.deg()))
    }
}
