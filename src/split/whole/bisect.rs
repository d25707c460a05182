//! The bisection of a whole mesh: what [`bisect`](crate::split::bisect) makes of it, bit for bit, at a part of the cost.
//!
//! It is for a mesh of which every step refined the whole, from the second step on. There all triangles are of one generation,
//! and each has one corner, its apex, that the last step made; so an edge is split if neither of its ends was. Around an older
//! vertex every second neighbour is an apex, and new vertices take the slots of the others. Around an apex every neighbour
//! stays, and a new vertex comes behind it in the triangle there.
//!
//! An edge that is split belongs to its smaller end, which is the older one.

use std::slice::IterMut;

use super::{Numbers, Own, WholeSplit};
use crate::id::{Edge, VertexId};
use crate::parallel;
use crate::rotation::{RingBuf, RotationSystem, Slots};
use crate::step::{History, Parent};

/// Which edges are split.
#[derive(Clone, Copy)]
pub(crate) struct RefinementEdges<'a> {
    rotation: &'a RotationSystem,
    /// The first vertex of the last step.
    youngest: usize,
}

impl<'a> RefinementEdges<'a> {
    /// Those of a mesh that was refined as a whole, once or more.
    pub(crate) fn new(rotation: &'a RotationSystem, history: &History) -> Self {
        Self { rotation, youngest: history.youngest() }
    }

    /// How many there are. O(vertices).
    pub(crate) fn count(&self) -> usize {
        let exterior =
            parallel::sums(self.youngest..self.rotation.vertex_count(), |v| [self.rotation.valence(VertexId::new(v))]);
        self.rotation.edge_count() - exterior[0]
    }

    /// Whether an edge is one.
    #[inline]
    pub(crate) fn contains(&self, v: VertexId, w: VertexId) -> bool {
        !self.is_apex(v) & !self.is_apex(w)
    }

    /// Whether a vertex is the apex of all triangles at it; if not, it is of none.
    #[inline]
    pub(crate) fn is_apex(&self, v: VertexId) -> bool {
        v.index() >= self.youngest
    }

    #[inline]
    fn is_owned(&self, v: VertexId, w: VertexId) -> bool {
        (v < w) & !self.is_apex(w)
    }

    fn owned_by(&self, v: VertexId) -> Own {
        let neighbors = self.rotation.neighbors(v);
        if neighbors.len() <= Slots::END {
            let slots = Slots::among(neighbors, |w| self.is_owned(v, w));
            return Own { first: slots.len(), slots, ..Own::default() };
        }
        let count = neighbors.iter().filter(|&&w| self.is_owned(v, w)).count();
        Own { first: count as u32, ..Own::default() }
    }

    fn owned_at(&self, v: VertexId, slot: usize) -> u32 {
        u32::from(self.is_owned(v, self.rotation.neighbors(v)[slot]))
    }
}

/// The edges that are split, numbered.
pub(crate) struct Whole<'a> {
    edges: RefinementEdges<'a>,
    numbers: Numbers,
}

impl<'a> Whole<'a> {
    /// Numbers the edges. O(edges), and 8 bytes a vertex.
    pub(crate) fn new(edges: RefinementEdges<'a>) -> Self {
        let owned_at = |v, slot| edges.owned_at(v, slot);
        Self { edges, numbers: Numbers::new(edges.rotation, |_| |v| edges.owned_by(v), owned_at) }
    }

    /// The rings after the split, those of the old vertices first. O(edges).
    pub(crate) fn rings(&self) -> Vec<RingBuf> {
        self.numbers.rings(|v, ring| *ring = self.even(v), |v, _, rings| self.write_odd_from(v, rings))
    }

    /// The new vertex on an edge that is split.
    #[inline]
    pub(crate) fn on(&self, edge: Edge) -> VertexId {
        let [v, w] = edge.ends();
        let slot = self.numbers.hubs().slot(self.edges.rotation, v, w).expect("rings are symmetric");
        let own = self.numbers.of(v);
        let rank = if self.edges.rotation.valence(v) <= Slots::END {
            own.slots.rank(slot)
        } else {
            self.numbers.counted(v, slot, |v, slot| self.edges.owned_at(v, slot))
        };
        self.numbers.vertex(own.first + rank)
    }

    /// The ring of an old vertex.
    #[inline]
    fn even(&self, v: VertexId) -> RingBuf {
        let ring = self.edges.rotation.ring(v);
        if self.edges.is_apex(v) {
            return RingBuf::spread(ring, |w, next| self.on(Edge::new(w, next)));
        }
        let mut own = self.numbers.range(v);
        let mut new = RingBuf::from_ring(ring);
        for (slot, w) in ring.iter().enumerate().filter(|&(_, w)| !self.edges.is_apex(w)) {
            let x = match w {
                w if v < w => self.numbers.vertex(own.next().expect("there is one for each edge")),
                w => self.on(Edge::new(w, v)),
            };
            new.set(slot, x);
        }
        new
    }

    /// Writes the rings of the new vertices on the edges from `v` to greater ids: each from `v`, or from the gap.
    #[inline]
    fn write_odd_from(&self, v: VertexId, rings: &mut IterMut<'_, RingBuf>) {
        self.each_new(v, |Parent { p, q, left, right }| {
            *rings.next().expect("there is one for each edge") = match (left, right) {
                (Some(left), Some(right)) => RingBuf::closed(&[p, right, q, left]),
                (Some(left), None) => RingBuf::open(&[q, left, p]),
                (None, Some(right)) => RingBuf::open(&[p, right, q]),
                (None, None) => unreachable!("an edge of a mesh has a triangle"),
            };
        });
    }
}

impl WholeSplit for Whole<'_> {
    type Made = Parent;

    fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    #[inline]
    fn each_new(&self, v: VertexId, mut take: impl FnMut(Parent)) {
        let ring = self.edges.rotation.ring(v);
        for (slot, q) in ring.iter().enumerate().filter(|&(_, w)| self.edges.is_owned(v, w)) {
            let [left, right] = ring.corners_at(slot);
            take(Parent { p: v, q, left, right });
        }
    }

    fn append_between(&self, v: VertexId, inside: impl Fn(VertexId) -> bool, list: &mut Vec<VertexId>) {
        let owned = self.edges.rotation.ring(v).iter().filter(|&w| self.edges.is_owned(v, w));
        let numbered = owned.zip(self.numbers.range(v));
        list.extend(numbered.filter(|&(w, _)| inside(w)).map(|(_, number)| self.numbers.vertex(number)));
    }
}
