//! Subdivision as one matrix: refined positions are weighted sums of those of the input.
//!
//! Every mask is linear in the positions, so a run of any number of steps, of any scheme by any method, is a matrix S with
//! V′ = S V. A [`SubdivisionMatrix`] follows the steps and holds S. When the input is moved and its topology and tags stay,
//! one product says where the refined vertices go: no ring is looked at, nothing is selected again. (A step that has no masks
//! of the mesh before it refuses to be followed; see [`RefineError::NoMasks`](crate::error::RefineError::NoMasks).)
//!
//! Read in this order: [`SubdivisionMatrix`], [`WeightMatrix`], [`TangentRows`].
//!
//! **Deliberately not here**: files ([`crate::io::write_matrix_market`]), and selecting anew for the moved input.

mod tangents;
mod weights;

pub use tangents::TangentRows;
pub use weights::WeightMatrix;

use crate::limit::Limit;
use crate::mesh::Mesh;
use crate::scheme::Mask;
use crate::subdivide::{Follower, StepMasks};
use weights::Rows;

/// The matrix of all steps that it followed, given to each of them as [`Control::follower`](crate::subdivide::Control::follower).
///
/// ```
/// use vvmesh::adaptive::Incremental;
/// use vvmesh::matrix::SubdivisionMatrix;
/// use vvmesh::scheme::Loop;
/// use vvmesh::scratch::Scratch;
/// use vvmesh::select::Selection;
/// use vvmesh::step::{History, Keep};
/// use vvmesh::subdivide::{Control, Subdivider};
/// use vvmesh::{VertexId, shapes};
///
/// let mut mesh = shapes::icosahedron();
/// let cage = mesh.positions().to_vec();
/// let mut matrix = SubdivisionMatrix::new(&mesh);
/// let mut history = History::new(&mesh, Keep::default());
/// let selection: Selection = [VertexId::new(0)].into_iter().collect();
/// let control = &mut Control { follower: Some(&mut matrix), ..Control::default() };
/// let subdivider = Subdivider::new(Loop::default(), Incremental::new(1)?);
/// subdivider.step(&mut mesh, &mut history, &selection, &mut Scratch::new(), control)?;
///
/// assert_eq!((matrix.weights().row_count(), matrix.weights().column_count()), (22, 12));
/// let again = matrix.weights().apply(&cage);
/// assert!(again.iter().zip(mesh.positions()).all(|(one, other)| one.distance(*other) < 1e-15));
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct SubdivisionMatrix {
    weights: WeightMatrix,
}

impl SubdivisionMatrix {
    /// The identity, for a mesh whose vertices as they are now are the input.
    #[must_use]
    pub fn new(mesh: &Mesh) -> Self {
        Self { weights: WeightMatrix::identity(mesh.vertex_count()) }
    }

    /// S: a row for each vertex of the mesh as it is now. The weights of a row add to 1, up to rounding; under
    /// [`Loop`](crate::scheme::Loop) none is negative.
    #[must_use]
    pub fn weights(&self) -> &WeightMatrix {
        &self.weights
    }

    /// S, as [`SubdivisionMatrix::weights`] shows it.
    #[must_use]
    pub fn into_weights(self) -> WeightMatrix {
        self.weights
    }

    /// The rows of the limit positions of all vertices. O(nonzeros).
    ///
    /// # Panics
    /// If the mesh is not the one that was followed: it has not as many vertices as there are rows; or if the limit of a vertex
    /// is not known yet, see [`Limit::mask`].
    #[must_use]
    pub fn limit(&self, mesh: &Mesh, limit: &impl Limit) -> WeightMatrix {
        self.assert_followed(mesh);
        let mut rows = Rows::of(&self.weights);
        let mut mask = Mask::default();
        for v in mesh.vertices() {
            mask.clear();
            limit.mask(mesh.neighborhood(), v, &mut mask);
            rows.push(&mask);
        }
        rows.finish()
    }

    /// The rows of two tangents of every side of every vertex, for the normals of the limit surface. O(nonzeros).
    ///
    /// # Panics
    /// If the mesh is not the one that was followed: it has not as many vertices as there are rows.
    #[must_use]
    pub fn tangents(&self, mesh: &Mesh, limit: &impl Limit) -> TangentRows {
        self.assert_followed(mesh);
        TangentRows::of(&self.weights, mesh, limit)
    }

    fn assert_followed(&self, mesh: &Mesh) {
        assert_eq!(mesh.vertex_count(), self.weights.row_count(), "the mesh is the one that was followed");
    }
}

impl Follower for SubdivisionMatrix {
    /// Takes one step. O(nonzeros of all rows), as those that the step does not name are copied.
    ///
    /// # Panics
    /// If the step is one of another mesh, with not as many vertices as there are rows.
    fn follow(&mut self, step: &StepMasks<'_>) {
        let old = self.weights.row_count();
        assert_eq!(step.vertex_count_before(), old, "the mesh is the one that was followed");
        let mut rows = Rows::of(&self.weights);
        step.for_each(|shown| {
            rows.copy(rows.len()..shown.vertex.index());
            rows.push(shown.mask);
        });
        rows.copy(rows.len()..old);
        self.weights = rows.finish();
    }
}
