//! The mesh: a rotation system of triangles, a position a vertex, and tags of edges and vertices that are sharp, for ever or
//! for some steps.
//!
//! It is always an oriented 2-manifold, with or without boundary: [`Mesh::from_triangles`] refuses everything else with
//! all reasons, and whatever changes a mesh keeps it one.
//!
//! Read in this order: [`Mesh`], [`Tags`] with [`Sharpness`], [`VertexClass`], [`Neighborhood`], [`Sector`] and
//! [`Transition`], then `order` (other vertex numbers, as a [`Permutation`]).
//!
//! **Deliberately not here**: birth levels and parents of vertices. They belong to a run of refinements, not to a mesh,
//! and live in [`History`](crate::step::History).

mod boundary;
mod build;
mod edit;
mod neighborhood;
mod order;
mod permutation;
mod sector;
mod sharpness;
mod tags;
mod transition;

pub use boundary::BoundaryPolicy;
pub(crate) use build::rotation_of;
pub use neighborhood::{Neighborhood, VertexClass};
pub use permutation::Permutation;
pub use sector::Sector;
pub use sharpness::{Sharpness, SharpnessRule};
pub use tags::Tags;
pub use transition::{Feature, Transition};

use glam::DVec3;

use crate::id::{Edge, Triangle, VertexId};
use crate::parallel;
use crate::rotation::{Ring, RotationSystem};
use crate::soup::FaceList;

/// An oriented 2-manifold of triangles, with or without boundary.
///
/// ```
/// use vvmesh::{Mesh, glam::DVec3};
/// let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
/// let mesh = Mesh::from_triangles(corners, &[[0, 1, 2]])?;
/// assert_eq!((mesh.vertex_count(), mesh.edge_count(), mesh.face_count()), (3, 3, 1));
/// assert!(mesh.vertices().all(|v| mesh.is_boundary(v)));
/// # Ok::<(), vvmesh::error::BuildError>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Mesh {
    rotation: RotationSystem,
    positions: Vec<DVec3>,
    tags: Tags,
}

impl Mesh {
    /// The rings, which are also a graph for petgraph's algorithms.
    #[inline]
    #[must_use]
    pub fn rotation(&self) -> &RotationSystem {
        &self.rotation
    }

    /// Where every vertex is, by id.
    #[inline]
    #[must_use]
    pub fn positions(&self) -> &[DVec3] {
        &self.positions
    }

    /// The positions, to be changed. Their number stays.
    #[inline]
    #[must_use]
    pub fn positions_mut(&mut self) -> &mut [DVec3] {
        &mut self.positions
    }

    /// Where a vertex is.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[inline]
    #[must_use]
    pub fn position(&self, v: VertexId) -> DVec3 {
        self.positions[v.index()]
    }

    /// The sharp edges and corners.
    #[inline]
    #[must_use]
    pub fn tags(&self) -> &Tags {
        &self.tags
    }

    /// Tags an edge infinitely sharp, or takes the tag off. A boundary edge is sharp by nature; a tag on it changes nothing.
    ///
    /// Answers whether there is such an edge; without one nothing is changed.
    pub fn set_sharp(&mut self, edge: Edge, sharp: bool) -> bool {
        self.set_sharpness(edge, if sharp { Sharpness::INFINITE } else { Sharpness::SMOOTH })
    }

    /// Tags an edge with a sharpness, in place of what it had; 0 takes the tag off. A boundary edge, which is infinitely
    /// sharp by nature, is tagged so whatever sharpness is given.
    ///
    /// Answers whether there is such an edge; without one nothing is changed.
    ///
    /// ```
    /// use vvmesh::mesh::Sharpness;
    /// use vvmesh::{Edge, VertexId, shapes};
    /// let mut mesh = shapes::icosahedron();
    /// let edge = Edge::new(VertexId::new(0), VertexId::new(1));
    /// assert!(mesh.set_sharpness(edge, Sharpness::new(2.5)?));
    /// assert_eq!((mesh.tags().sharpness(edge).value(), mesh.tags().sharp_edges()), (2.5, vec![edge]));
    /// # Ok::<(), vvmesh::error::ConfigError>(())
    /// ```
    pub fn set_sharpness(&mut self, edge: Edge, sharpness: Sharpness) -> bool {
        let [a, b] = edge.ends();
        let exists = self.rotation.has_edge(a, b);
        if exists {
            let is_infinite = sharpness.is_sharp() && self.rotation.is_boundary_edge(a, b);
            self.tags.set_sharpness(edge, if is_infinite { Sharpness::INFINITE } else { sharpness });
        }
        exists
    }

    /// Tags a vertex as a corner, infinitely sharp, or takes the tag off.
    ///
    /// Answers whether there is such a vertex; without one nothing is changed.
    pub fn set_corner(&mut self, v: VertexId, corner: bool) -> bool {
        self.set_vertex_sharpness(v, if corner { Sharpness::INFINITE } else { Sharpness::SMOOTH })
    }

    /// Tags a vertex with a sharpness, in place of what it had; 0 takes the tag off.
    ///
    /// Answers whether there is such a vertex; without one nothing is changed.
    pub fn set_vertex_sharpness(&mut self, v: VertexId, sharpness: Sharpness) -> bool {
        let exists = self.rotation.contains(v);
        if exists {
            self.tags.set_vertex_sharpness(v, sharpness);
        }
        exists
    }

    /// Says what the halves of semi-sharp edges inherit in the steps to come.
    pub fn set_sharpness_rule(&mut self, rule: SharpnessRule) {
        self.tags.set_rule(rule);
    }

    /// What a scheme may see: rings and tags, no positions.
    #[inline]
    #[must_use]
    pub fn neighborhood(&self) -> Neighborhood<'_> {
        Neighborhood::new(&self.rotation, &self.tags)
    }

    /// How many vertices there are, isolated ones too.
    #[inline]
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.rotation.vertex_count()
    }

    /// How many edges there are. O(1).
    #[inline]
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.rotation.edge_count()
    }

    /// How many triangles there are. O(1).
    #[inline]
    #[must_use]
    pub fn face_count(&self) -> usize {
        self.rotation.triangle_count()
    }

    /// All vertices by id.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + DoubleEndedIterator + Clone + use<> {
        self.rotation.vertices()
    }

    /// All edges, by their smaller end, then in the order of its ring.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + Clone {
        self.rotation.edges()
    }

    /// All triangles, by their smallest corner, then in the order of its ring.
    pub fn triangles(&self) -> impl Iterator<Item = Triangle> + Clone {
        self.rotation.triangles()
    }

    /// The ring of a vertex.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[inline]
    #[must_use]
    pub fn ring(&self, v: VertexId) -> Ring<'_> {
        self.rotation.ring(v)
    }

    /// Whether a vertex lies on a boundary. O(1).
    ///
    /// # Panics
    /// If there is no such vertex.
    #[inline]
    #[must_use]
    pub fn is_boundary(&self, v: VertexId) -> bool {
        self.rotation.is_boundary(v)
    }

    /// The triangles as a list, in the order of [`Mesh::triangles`]; vertex `k` stays vertex `k`.
    #[must_use]
    pub fn to_face_list(&self) -> FaceList {
        let triangles = parallel::gather(0..self.vertex_count(), |v| {
            let triangles = self.rotation.triangles_of_smallest(VertexId::new(v));
            triangles.map(|triangle| triangle.corners().map(|v| v.index() as u32))
        });
        FaceList::of_triangles(self.positions.clone(), triangles)
    }

    /// Bytes held: rings, positions and tags.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.rotation.memory_bytes() + self.positions.capacity() * size_of::<DVec3>() + self.tags.memory_bytes()
    }

    /// A mesh of rings that fit each other, with a position each.
    pub(crate) fn from_parts(rotation: RotationSystem, positions: Vec<DVec3>, tags: Tags) -> Self {
        Self { rotation, positions, tags }
    }

    pub(crate) fn parts_mut(&mut self) -> (&mut RotationSystem, &mut Vec<DVec3>, &mut Tags) {
        (&mut self.rotation, &mut self.positions, &mut self.tags)
    }
}
