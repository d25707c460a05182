//! Subdivision as one matrix: refined positions are weighted sums of those of the input.
//!
//! Every mask is linear in the positions, so a run of any number of steps, of any scheme by any method, is a matrix S with
//! V′ = S V. A [`SubdivisionMatrix`] follows the steps and holds S. When the input is moved and its topology and tags stay,
//! one product says where the refined vertices go: no ring is looked at, nothing is selected again. (Under 4-8 the faces of the
//! input are paired by the lengths of their edges; the product keeps the pairs of the input as it was.)
//!
//! Read in this order: [`SubdivisionMatrix`], [`WeightMatrix`], [`TangentRows`].
//!
//! **Deliberately not here**: files ([`crate::io::write_matrix_market`]), and selecting anew for the moved input.

mod tangents;
mod weights;

pub use tangents::TangentRows;
pub use weights::WeightMatrix;

use std::mem;

use crate::limit::Limit;
use crate::mesh::Mesh;
use crate::scheme::Mask;
use crate::subdivide::{Assignment, Follower, StepMasks, ValueId, Values};
use weights::{Entries, Row, RowSum, Rows};

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
///
/// A step costs what it makes: rows that it does not name stay where they are, and those that are made go behind all
/// others. What is out of date in between is thrown out as soon as it is more than the rest.
#[derive(Clone, Debug)]
pub struct SubdivisionMatrix {
    /// Where the rows of the vertices lie, and those that are kept beside them.
    rows: Values<Row>,
    entries: Entries,
    /// How many entries are of no row any more.
    dead: usize,
    sum: RowSum,
}

impl PartialEq for SubdivisionMatrix {
    /// Whether S is the same.
    fn eq(&self, other: &Self) -> bool {
        fn rows(matrix: &SubdivisionMatrix) -> impl Iterator<Item = (&[u32], &[f64])> {
            matrix.rows.shown().iter().map(|&row| matrix.entries.row(row))
        }
        self.sum.column_count() == other.sum.column_count() && rows(self).eq(rows(other))
    }
}

impl SubdivisionMatrix {
    /// The identity, for a mesh whose vertices as they are now are the input.
    #[must_use]
    pub fn new(mesh: &Mesh) -> Self {
        let vertices = mesh.vertex_count();
        let (entries, rows) = Entries::identity(vertices);
        Self { rows: Values::new(rows), entries, dead: 0, sum: RowSum::new(vertices) }
    }

    /// S: a row for each vertex of the mesh as it is now. The weights of a row add to 1, up to rounding; under
    /// [`Loop`](crate::scheme::Loop) none is negative. O(nonzeros).
    #[must_use]
    pub fn weights(&self) -> WeightMatrix {
        Rows::gathered(self.sum.column_count(), &self.entries, self.rows.shown())
    }

    /// The rows of the limit positions of all vertices. O(nonzeros).
    ///
    /// # Panics
    /// If the mesh is not the one that was followed: it has not as many vertices as there are rows; or if the limit of a vertex
    /// is not known yet, see [`Limit::mask`].
    ///
    /// # Guarantees
    /// They are those of the mesh as it is, so those of the surface only where the masks of the limit hold: under √3 on uniform
    /// meshes, with a boundary after an even number of steps. 4-8 has none.
    #[must_use]
    pub fn limit(&self, mesh: &Mesh, limit: &impl Limit) -> WeightMatrix {
        self.assert_followed(mesh);
        let mut rows = self.new_rows();
        let mut mask = Mask::default();
        for v in mesh.vertices() {
            mask.clear();
            limit.mask(mesh.neighborhood(), v, &mut mask);
            self.push_row(&mut rows, &mask);
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
        TangentRows::of(self, mesh, limit)
    }

    fn assert_followed(&self, mesh: &Mesh) {
        assert_eq!(mesh.vertex_count(), self.rows.shown().len(), "the mesh is the one that was followed");
    }

    /// Another matrix of the same input, without a row.
    fn new_rows(&self) -> Rows {
        Rows::new(self.sum.column_count())
    }

    /// Appends to another matrix what a mask makes of the rows of the vertices.
    fn push_row(&self, rows: &mut Rows, mask: &Mask) {
        rows.push(mask, &self.entries, |v| *self.rows.get(v.into()));
    }

    /// Throws out what is of no row any more.
    fn tidy(&mut self) {
        let entries = mem::take(&mut self.entries);
        self.rows.all_mut().for_each(|row| *row = self.entries.copy(&entries, *row));
        self.dead = 0;
    }
}

impl Follower for SubdivisionMatrix {
    /// Takes one step. O(nonzeros of the rows that it makes), over many steps.
    ///
    /// # Panics
    /// If the step is one of another mesh, with not as many vertices as there are rows, or steps before it were not followed.
    fn follow(&mut self, step: &StepMasks<'_>) {
        self.rows.grow(step, Row::default());
        let make = |matrix: &mut Self, _: Assignment<'_>, mask: &Mask<ValueId>| {
            matrix.sum.add(mask, &matrix.entries, |id| *matrix.rows.get(id));
            matrix.sum.append_to(&mut matrix.entries)
        };
        step.replay(self, make, |matrix, id, row| {
            let before = matrix.rows.put(id, row);
            matrix.dead += before.map_or(0, Row::len);
        });
        if 2 * self.dead > self.entries.len() {
            self.tidy();
        }
    }

    fn has_kept(&self) -> bool {
        self.rows.keeps_any()
    }
}
