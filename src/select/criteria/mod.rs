//! What a criterion is, and how criteria combine.

mod all;
mod dihedral;
mod disk;
mod faces;
mod normal_angle;
mod sphere;
mod vertices;

pub use all::All;
pub use dihedral::Dihedral;
pub use disk::Disk;
pub use faces::Faces;
pub use normal_angle::NormalAngle;
pub use sphere::Sphere;
pub use vertices::Vertices;

use super::selection::{Selection, Unknown};
use crate::error::SelectError;
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::scratch::Scratch;

/// A question to a mesh that selects vertices, edges or faces.
///
/// Whatever the mesh is, the answer is of one kind. It is a pure function of the mesh: the scratch is for marks and changes no answer. A closure from a mesh to a
/// selection is a criterion.
///
/// ```
/// use vvmesh::scratch::Scratch;
/// use vvmesh::select::{Criterion, Disk, Selection};
/// use vvmesh::{Mesh, VertexId, shapes};
///
/// let on_boundary = |mesh: &Mesh| mesh.vertices().filter(|&v| mesh.is_boundary(v)).collect::<Selection>();
/// let near = Disk::new(VertexId::new(0), 1).and(on_boundary.not());
/// let selection = near.select(&shapes::grid(3, 3), &mut Scratch::new())?;
/// assert_eq!(selection.vertices(), [VertexId::new(5)]);
/// # Ok::<(), vvmesh::error::SelectError>(())
/// ```
pub trait Criterion {
    /// What the mesh has of it.
    ///
    /// # Errors
    /// If the criterion names a vertex, an edge or a face that the mesh has not. To select nothing is no error.
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError>;

    /// What both select, as [`Selection::intersection`] has it.
    fn and<C: Criterion>(self, other: C) -> And<Self, C>
    where
        Self: Sized,
    {
        And(self, other)
    }

    /// What one of the two selects, or both, as [`Selection::union`] has it.
    fn or<C: Criterion>(self, other: C) -> Or<Self, C>
    where
        Self: Sized,
    {
        Or(self, other)
    }

    /// What this does not select, as [`Selection::complement`] has it.
    fn not(self) -> Not<Self>
    where
        Self: Sized,
    {
        Not(self)
    }
}

impl<F: Fn(&Mesh) -> Selection> Criterion for F {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let selection = self(mesh);
        check(&selection, mesh)?;
        Ok(selection)
    }
}

impl Criterion for &dyn Criterion {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        (**self).select(mesh, scratch)
    }
}

impl Criterion for Box<dyn Criterion> {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        (**self).select(mesh, scratch)
    }
}

/// What two criteria both select; made by [`Criterion::and`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct And<A, B>(A, B);

impl<A: Criterion, B: Criterion> Criterion for And<A, B> {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        Ok(self.0.select(mesh, scratch)?.intersection(&self.1.select(mesh, scratch)?))
    }
}

/// What one of two criteria selects, or both; made by [`Criterion::or`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Or<A, B>(A, B);

impl<A: Criterion, B: Criterion> Criterion for Or<A, B> {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        Ok(self.0.select(mesh, scratch)?.union(&self.1.select(mesh, scratch)?))
    }
}

/// What a criterion does not select; made by [`Criterion::not`].
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Not<A>(A);

impl<A: Criterion> Criterion for Not<A> {
    fn select(&self, mesh: &Mesh, scratch: &mut Scratch) -> Result<Selection, SelectError> {
        Ok(self.0.select(mesh, scratch)?.complement(mesh))
    }
}

/// Refuses the first vertex, edge or face that the mesh has not.
fn check(selection: &Selection, mesh: &Mesh) -> Result<(), SelectError> {
    match selection.first_unknown(mesh.rotation()) {
        None => Ok(()),
        Some(Unknown::Vertex(v)) => Err(no_vertex(v, mesh)),
        Some(Unknown::Edge(edge)) => Err(SelectError::NoEdge(edge)),
        Some(Unknown::Face(face)) => Err(SelectError::NoFace(face)),
    }
}

fn no_vertex(vertex: VertexId, mesh: &Mesh) -> SelectError {
    SelectError::NoVertex { vertex, vertex_count: mesh.vertex_count() }
}

/// The shortest number that reads back as the same; with an exponent where it would be hundreds of digits long.
fn shortest(number: f64) -> String {
    let mut text = format!("{number:?}");
    if text.ends_with(".0") {
        text.truncate(text.len() - 2);
    }
    text
}
