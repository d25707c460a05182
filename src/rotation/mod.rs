//! The rotation system: for every vertex the circular list of its neighbours, and nothing else.
//!
//! It answers what is next to what. A graph with such lists has exactly one embedding in an oriented surface, so edges,
//! faces, boundary loops, Euler characteristic and genus all follow from the rings.
//!
//! Read in this order: [`Ring`] and its [`Circulator`], [`RotationSystem`], then `walk` (faces, loops, components as
//! [`VertexLists`]), `edit` and `transaction` (changes that keep it whole; [`Transaction`] for raw ones), `validate`
//! (what may be wrong with it, as [`RingDefect`](crate::error::RingDefect)s).
//!
//! **Deliberately not here**: positions, tags, anything but integers.

mod circulator;
mod edit;
mod hubs;
mod regular;
mod reverse;
mod ring;
mod sound;
mod transaction;
mod validate;
mod walk;

pub use circulator::Circulator;
pub(crate) use hubs::Hubs;
pub(crate) use regular::{Regular, Slots};
pub(crate) use reverse::ReverseSlots;
pub use ring::Ring;
pub(crate) use ring::RingBuf;
pub use transaction::Transaction;
pub use walk::{FaceWalk, VertexLists};

use crate::id::{DirectedEdge, Edge, Triangle, VertexId};
use crate::parallel;

/// For every vertex the circular list of its neighbours.
///
/// Memory: 32 bytes a vertex, and 4 bytes a neighbour more for rings of more than 6 neighbours (5 if open).
#[derive(Clone, Default)]
pub struct RotationSystem {
    rings: Vec<RingBuf>,
    /// Sum of all valences: every edge stands in two rings.
    entries: usize,
    /// How many rings are open.
    open: usize,
}

impl RotationSystem {
    /// A system without vertices.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// A system of isolated vertices.
    ///
    /// # Panics
    /// If `count` is above [`VertexId::MAX_INDEX`] + 1.
    #[must_use]
    pub fn with_isolated(count: usize) -> Self {
        assert!(count <= VertexId::MAX_INDEX + 1, "vertex ids have 32 bits");
        Self { rings: vec![RingBuf::default(); count], entries: 0, open: 0 }
    }

    /// How many vertices there are, isolated ones too.
    #[inline]
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.rings.len()
    }

    /// How many edges there are. O(1).
    #[inline]
    #[must_use]
    pub fn edge_count(&self) -> usize {
        self.entries / 2
    }

    /// How many boundary vertices there are, which is also the number of boundary edges. O(1).
    #[inline]
    #[must_use]
    pub fn boundary_edge_count(&self) -> usize {
        self.open
    }

    /// How many triangles there are, provided that all faces are triangles. O(1).
    #[inline]
    #[must_use]
    pub fn triangle_count(&self) -> usize {
        (self.entries - self.open) / 3
    }

    /// Whether the vertex exists.
    #[inline]
    #[must_use]
    pub fn contains(&self, v: VertexId) -> bool {
        v.index() < self.rings.len()
    }

    /// All vertices by id.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = VertexId> + DoubleEndedIterator + Clone + use<> {
        (0..self.rings.len()).map(VertexId::new)
    }

    /// The ring of a vertex.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[inline]
    #[must_use]
    pub fn ring(&self, v: VertexId) -> Ring<'_> {
        self.rings[v.index()].as_ring()
    }

    /// The neighbours of a vertex in the order of its ring.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[inline]
    #[must_use]
    pub fn neighbors(&self, v: VertexId) -> &[VertexId] {
        self.ring(v).neighbors()
    }

    /// How many neighbours a vertex has.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[inline]
    #[must_use]
    pub fn valence(&self, v: VertexId) -> usize {
        self.ring(v).valence()
    }

    /// Whether a vertex lies on a boundary. O(1).
    ///
    /// # Panics
    /// If there is no such vertex.
    #[inline]
    #[must_use]
    pub fn is_boundary(&self, v: VertexId) -> bool {
        self.ring(v).is_open()
    }

    /// Whether two vertices are neighbours. O(valence of `a`); `false` also for vertices that do not exist.
    #[inline]
    #[must_use]
    pub fn has_edge(&self, a: VertexId, b: VertexId) -> bool {
        self.contains(a) && self.ring(a).contains(b)
    }

    /// Whether there is this triangle, with its corners in this order. O(valence); `false` also for vertices that do not exist.
    #[must_use]
    pub fn has_triangle(&self, triangle: Triangle) -> bool {
        let [a, b, c] = triangle.corners();
        self.contains(a) && self.left_of(a, b) == Some(c)
    }

    /// The third corner of the triangle on the left of `a -> b`; `None` if a gap is there, or no such edge.
    ///
    /// # Panics
    /// If there is no vertex `a`.
    #[inline]
    #[must_use]
    pub fn left_of(&self, a: VertexId, b: VertexId) -> Option<VertexId> {
        self.ring(a).next(b)
    }

    /// The third corner of the triangle on the right of `a -> b`; `None` if a gap is there, or no such edge.
    ///
    /// # Panics
    /// If there is no vertex `a`.
    #[inline]
    #[must_use]
    pub fn right_of(&self, a: VertexId, b: VertexId) -> Option<VertexId> {
        self.ring(a).prev(b)
    }

    /// Whether `a` and `b` are neighbours with a gap on one side of their edge. O(valence).
    ///
    /// # Panics
    /// If there is no vertex `a`.
    #[inline]
    #[must_use]
    pub fn is_boundary_edge(&self, a: VertexId, b: VertexId) -> bool {
        let ring = self.ring(a);
        ring.is_open() && (ring.neighbors().first() == Some(&b) || ring.neighbors().last() == Some(&b))
    }

    /// All edges, by their smaller end, then in the order of its ring.
    pub fn edges(&self) -> impl Iterator<Item = Edge> + Clone {
        self.vertices().flat_map(|v| self.neighbors(v).iter().filter(move |&&w| v < w).map(move |&w| Edge::new(v, w)))
    }

    /// All directed edges, by their start, then in the order of its ring.
    pub fn directed_edges(&self) -> impl Iterator<Item = DirectedEdge> + Clone {
        self.vertices().flat_map(|v| self.neighbors(v).iter().map(move |&w| DirectedEdge::new(v, w)))
    }

    /// The triangles around a vertex in the order of its ring, provided that all faces are triangles.
    ///
    /// # Panics
    /// If there is no such vertex.
    pub fn triangles_around(&self, v: VertexId) -> impl ExactSizeIterator<Item = Triangle> + Clone {
        self.ring(v).pairs().map(move |(a, b)| Triangle::new(v, a, b))
    }

    /// All triangles, by their smallest corner, then in the order of its ring, provided that all faces are triangles.
    pub fn triangles(&self) -> impl Iterator<Item = Triangle> + Clone {
        self.vertices().flat_map(|v| self.triangles_of_smallest(v))
    }

    /// The triangles of which a vertex is the smallest corner, in the order of its ring.
    pub(crate) fn triangles_of_smallest(&self, v: VertexId) -> impl Iterator<Item = Triangle> + Clone {
        let around = self.ring(v).pairs();
        around.filter(move |&(a, b)| v < a && v < b).map(move |(a, b)| Triangle::new(v, a, b))
    }

    /// Bytes held: the rings, and what the long ones hold outside of their inline part.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.rings.capacity() * size_of::<RingBuf>() + self.rings.iter().map(RingBuf::heap_bytes).sum::<usize>()
    }
}

/// Raw writes for the modules that refine and build. Each leaves the counts right; symmetry is the caller's.
impl RotationSystem {
    pub(crate) fn from_rings(rings: Vec<RingBuf>) -> Self {
        let [entries, open] = parallel::sums(0..rings.len(), |v| {
            let ring = rings[v].as_ring();
            [ring.valence(), usize::from(ring.is_open())]
        });
        Self { rings, entries, open }
    }

    /// The neighbours of a regular inner vertex; `None` for any other.
    #[inline]
    pub(crate) fn regular(&self, v: VertexId) -> Option<Regular<'_>> {
        self.rings[v.index()].as_regular()
    }

    /// The same system under other names: the rings of these vertices in this order, each from its start, `name` being
    /// what a vertex is called afterwards.
    pub(crate) fn renumbered(
        &self,
        order: impl Iterator<Item = VertexId>,
        name: impl Fn(VertexId) -> VertexId,
    ) -> Self {
        let rings = order.map(|v| RingBuf::like(self.ring(v), &name)).collect();
        Self { rings, entries: self.entries, open: self.open }
    }

    /// Takes the rings after a split of everything into so many triangles with so many boundary edges.
    pub(crate) fn replace_rings(&mut self, rings: Vec<RingBuf>, triangles: usize, boundary_edges: usize) {
        self.entries = 3 * triangles + boundary_edges;
        self.open = boundary_edges;
        self.rings = rings;
    }

    pub(crate) fn reserve(&mut self, additional: usize) {
        self.rings.reserve(additional);
    }

    #[inline]
    pub(crate) fn push_ring(&mut self, ring: RingBuf) {
        self.entries += ring.as_ring().valence();
        self.open += usize::from(ring.as_ring().is_open());
        self.rings.push(ring);
    }

    pub(crate) fn set_ring(&mut self, v: VertexId, ring: RingBuf) {
        drop(self.replace_ring(v, ring));
    }

    /// Puts another ring in place of one, which is the answer.
    pub(crate) fn replace_ring(&mut self, v: VertexId, ring: RingBuf) -> RingBuf {
        let replaced = std::mem::replace(&mut self.rings[v.index()], ring);
        let (old, new) = (replaced.as_ring(), self.rings[v.index()].as_ring());
        self.entries = self.entries + new.valence() - old.valence();
        self.open = self.open + usize::from(new.is_open()) - usize::from(old.is_open());
        replaced
    }

    /// Takes out the last vertices, so that this many are left.
    pub(crate) fn truncate(&mut self, vertex_count: usize) {
        for ring in self.rings.drain(vertex_count..) {
            self.entries -= ring.as_ring().valence();
            self.open -= usize::from(ring.as_ring().is_open());
        }
    }

    /// Puts another neighbour at a slot.
    #[inline]
    pub(crate) fn set_neighbor(&mut self, v: VertexId, slot: usize, neighbor: VertexId) {
        self.rings[v.index()].set(slot, neighbor);
    }

    /// Inserts a neighbour directly after the one at a slot.
    #[inline]
    pub(crate) fn insert_after(&mut self, v: VertexId, slot: usize, neighbor: VertexId) {
        self.rings[v.index()].insert(slot + 1, neighbor);
        self.entries += 1;
    }

    /// Takes out the neighbour at a slot. It must not be the last one of an open ring: an empty ring has no gap.
    #[inline]
    pub(crate) fn remove_at(&mut self, v: VertexId, slot: usize) {
        self.rings[v.index()].remove(slot);
        self.entries -= 1;
    }
}

impl std::fmt::Debug for RotationSystem {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_map().entries(self.vertices().map(|v| (v, self.ring(v)))).finish()
    }
}
