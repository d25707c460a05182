//! Faces whose surface may be in a picture.

use std::fmt;

use super::{Criterion, faces_that};
use crate::camera::Camera;
use crate::error::SelectError;
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::parallel;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The faces of which something may be in the picture of a camera, however often they are refined.
///
/// A face is left out only if it and all vertices that share an edge with a corner of it lie beyond one of the planes of the
/// view (near, left, right, below, above). What becomes of a face by Loop's scheme is a mean of those vertices with weights that
/// are not negative, on boundaries and creases too, so it lies in their convex hull, and beyond that plane. So nothing that is
/// seen is lost, but some faces beside the picture are kept. Butterfly's schemes, whose weights are of both signs, do not keep
/// to the hull. Faces without area are like others.
///
/// Complexity: O(vertices + edges), and O(n log n) with n faces selected.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Frustum {
    camera: Camera,
}

impl Frustum {
    /// The faces that a camera may see.
    #[must_use]
    pub fn new(camera: Camera) -> Self {
        Self { camera }
    }
}

impl Criterion for Frustum {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let count = mesh.vertex_count();
        let alone = parallel::list(count, |v| self.camera.planes_beyond(mesh.positions()[v]));
        // The planes beyond which a vertex lies with all its neighbours.
        let all = parallel::list(count, |v| {
            mesh.ring(VertexId::new(v)).iter().fold(alone[v], |common, w| common & alone[w.index()])
        });
        Ok(faces_that(mesh, |corners| corners.into_iter().fold(u8::MAX, |common, v| common & all[v.index()]) == 0))
    }
}

/// As an expression has it, which is told the camera apart: `frustum`.
impl fmt::Display for Frustum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("frustum")
    }
}
