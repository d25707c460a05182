//! The normals of a whole mesh.

use std::ops::Range;

use glam::DVec3;

use super::Limit;
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::parallel;

/// The unit normals of all sides of all vertices, as a [`Limit`] has them.
///
/// ```
/// use vvmesh::limit::{Limit, LoopLimit};
/// use vvmesh::{Edge, VertexId, shapes};
/// let mut mesh = shapes::octahedron();
/// let [a, b, c] = [0, 4, 2].map(VertexId::new);
/// mesh.set_sharp(Edge::new(a, b), true);
/// mesh.set_sharp(Edge::new(b, c), true);
/// let normals = LoopLimit::default().normals(&mesh);
/// assert_eq!(normals.of(b).len(), 2, "a crease has two sides");
/// let below = normals.of(VertexId::new(5))[0].unwrap();
/// assert!(below.distance(-vvmesh::glam::DVec3::Z) < 1e-12);
/// ```
#[derive(Clone, PartialEq, Debug)]
pub struct Normals {
    /// For every vertex where its sides begin, and behind the last vertex their number.
    starts: Vec<usize>,
    sides: Vec<Option<DVec3>>,
}

impl Normals {
    pub(super) fn new(limit: &(impl Limit + Sync), mesh: &Mesh) -> Self {
        let around = mesh.neighborhood();
        let mut starts = Vec::with_capacity(mesh.vertex_count() + 1);
        starts.push(0);
        starts.extend(mesh.vertices().scan(0, |end, v| {
            *end += limit.side_count(around, v);
            Some(*end)
        }));
        let sides = parallel::gather(0..mesh.vertex_count(), |v| {
            let v = VertexId::new(v);
            (0..limit.side_count(around, v)).map(move |side| limit.normal(mesh, v, side))
        });
        Self { starts, sides }
    }

    /// Where the sides of a vertex stand, counted through all vertices.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[must_use]
    pub fn places(&self, v: VertexId) -> Range<usize> {
        self.starts[v.index()]..self.starts[v.index() + 1]
    }

    /// The normals of the sides of a vertex, in the order of the sides; `None` for a side without.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[must_use]
    pub fn of(&self, v: VertexId) -> &[Option<DVec3>] {
        &self.sides[self.places(v)]
    }
}
