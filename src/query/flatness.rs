//! How far the neighbours of a vertex are from lying in a plane.

use super::by_vertex;
use super::measure::{NormalWeight, Spokes, vertex_normal};
use crate::id::VertexId;
use crate::mesh::Mesh;

/// The greatest distance of a neighbour from the plane through the vertex across the mean of the normals of its triangles.
///
/// 0 if there is no such plane, because no triangle has area or their normals cancel each other. O(valence).
///
/// # Panics
/// If there is no such vertex.
///
/// ```
/// use vvmesh::{VertexId, query::flatness, shapes};
/// assert_eq!(flatness(&shapes::grid(2, 2), VertexId::new(4)), 0.0);
/// assert!((flatness(&shapes::octahedron(), VertexId::new(4)) - 1.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn flatness(mesh: &Mesh, v: VertexId) -> f64 {
    let Some(normal) = vertex_normal(mesh, v, NormalWeight::Equal) else { return 0.0 };
    let spokes = Spokes::new(mesh, v);
    mesh.ring(v).iter().map(|w| normal.dot(spokes.to(w)).abs()).fold(0.0, f64::max) * spokes.unit
}

/// [`flatness()`] of every vertex, by id. O(vertices + edges).
#[must_use]
pub fn flatnesses(mesh: &Mesh) -> Vec<f64> {
    by_vertex(mesh, |v| flatness(mesh, v))
}
