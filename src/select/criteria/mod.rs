//! What a criterion is, and how criteria combine.

mod all;
mod area;
mod boundary;
mod curvature;
mod curvature_top;
mod dihedral;
mod disk;
mod edge_length;
mod faces;
mod field;
mod flatness;
mod frustum;
mod limit_error;
mod mean_curvature;
mod normal_angle;
mod normal_cone;
mod pixel_area;
mod pixel_length;
mod sharp;
mod silhouette;
mod sphere;
mod valence;
mod vertices;

pub use all::All;
pub use area::Area;
pub use boundary::Boundary;
pub use curvature::Curvature;
pub use curvature_top::CurvatureTop;
pub use dihedral::Dihedral;
pub use disk::Disk;
pub use edge_length::EdgeLength;
pub use faces::Faces;
pub use field::{Comparison, Field};
pub use flatness::Flatness;
pub use frustum::Frustum;
pub use limit_error::LimitError;
pub use mean_curvature::MeanCurvature;
pub use normal_angle::NormalAngle;
pub use normal_cone::NormalCone;
pub use pixel_area::PixelArea;
pub use pixel_length::PixelLength;
pub use sharp::Sharp;
pub use silhouette::Silhouette;
pub use sphere::Sphere;
pub use valence::Valence;
pub use vertices::Vertices;

use super::selection::{Selection, Unknown};
use crate::angle::Angle;
use crate::error::{ConfigError, SelectError};
use crate::id::{Edge, Triangle, VertexId};
use crate::mesh::Mesh;
use crate::number::shortest;
use crate::parallel;
use crate::query::measure::bounds;
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

/// The diagonal of the bounding box of a mesh, to which relative lengths refer.
fn diagonal(mesh: &Mesh) -> f64 {
    bounds(mesh).map_or(0.0, |bounds| bounds.diagonal())
}

/// A threshold for what is never below 0.
fn at_least_0(name: &'static str, threshold: f64) -> Result<f64, ConfigError> {
    if threshold.is_finite() && threshold >= 0.0 {
        return Ok(threshold);
    }
    let expected = "expected a finite number, 0 or more".to_owned();
    Err(ConfigError { name, value: shortest(threshold), expected })
}

/// A threshold for the angle between two directions.
fn half_turn(threshold: Angle) -> Result<Angle, ConfigError> {
    if (0.0..=180.0).contains(&threshold.deg()) {
        return Ok(threshold);
    }
    let expected = "expected degrees from 0 to 180".to_owned();
    Err(ConfigError { name: "angle", value: shortest(threshold.deg()), expected })
}

/// The edges of a mesh that pass a test, which is shown their ends, the smaller first, and the third corners of the faces left
/// and right of the way from the one to the other.
fn edges_that(mesh: &Mesh, test: impl Fn([VertexId; 2], [Option<VertexId>; 2]) -> bool + Sync + Send) -> Selection {
    let test = &test;
    let from = |a: usize| {
        let a = VertexId::new(a);
        let ring = mesh.ring(a);
        // By slots: to search the ring for each neighbour would cost the square of the valence.
        let greater = ring.iter().enumerate().filter(move |&(_, b)| a < b);
        greater.filter(move |&(slot, b)| test([a, b], ring.corners_at(slot))).map(move |(_, b)| Edge::new(a, b))
    };
    parallel::gather(0..mesh.vertex_count(), from).into_iter().collect()
}

/// The faces of a mesh that pass a test, which is shown their corners.
fn faces_that(mesh: &Mesh, test: impl Fn([VertexId; 3]) -> bool + Sync + Send) -> Selection {
    let test = &test;
    let at = |v: usize| {
        let faces = mesh.rotation().triangles_of_smallest(VertexId::new(v));
        faces.filter(move |face: &Triangle| test(face.corners()))
    };
    parallel::gather(0..mesh.vertex_count(), at).into_iter().collect()
}
