//! What is wrong with the rings, all of it, as values.
//!
//! Five rules, each about one vertex and its neighbours: a ring holds existing neighbours once and not its own vertex
//! (I1); neighbours name each other (I2); both ends of an edge agree on which side a gap is (I3). These make a rotation
//! system. In a mesh of triangles moreover consecutive neighbours make a triangle (I4), and a vertex that is not isolated
//! has three neighbours or more, at a boundary two (I5).
//!
//! Whatever the edits of this crate leave behind keeps the first three, and what is a [`Mesh`](crate::Mesh) all five. The
//! check is for those who want to see it, and for tests.
//!
//! **Deliberately not here**: what is wrong with a list of faces, or with positions; see [`crate::check`].

use super::reverse::ReverseSlots;
use super::{Ring, RotationSystem};
use crate::error::RingDefect;
use crate::id::{DirectedEdge, VertexId};

impl RotationSystem {
    /// Every breach of the rules of a rotation system (I1 to I3), in the order of [`RingDefect`]; empty if there is none.
    ///
    /// O(vertices + edges), whatever the valences.
    ///
    /// ```
    /// use vvmesh::shapes;
    /// assert!(shapes::grid(3, 2).rotation().validate().is_empty());
    /// ```
    #[must_use]
    pub fn validate(&self) -> Vec<RingDefect> {
        self.find_defects(false)
    }

    /// Every breach of the rules of a mesh of triangles (I1 to I5), in the order of [`RingDefect`].
    ///
    /// A corner is judged by I4 only if its two edges are found in the rings of both their ends. O(vertices + edges).
    #[must_use]
    pub fn validate_triangles(&self) -> Vec<RingDefect> {
        self.find_defects(true)
    }

    fn find_defects(&self, triangles: bool) -> Vec<RingDefect> {
        if self.is_seen_sound(triangles) { Vec::new() } else { self.list_defects(triangles) }
    }

    pub(super) fn list_defects(&self, triangles: bool) -> Vec<RingDefect> {
        let reverse = ReverseSlots::new(self);
        let mut defects = Vec::new();
        let mut seen_at = vec![VertexId::GAP; self.vertex_count()];
        for v in self.vertices() {
            let ring = self.ring(v);
            if ring.is_open() && ring.valence() == 0 {
                defects.push(RingDefect::EmptyGap { v });
                continue;
            }
            for (slot, neighbor) in ring.iter().enumerate() {
                if !self.contains(neighbor) {
                    defects.push(RingDefect::NoVertex { v, neighbor });
                } else if neighbor == v {
                    defects.push(RingDefect::SelfNeighbor { v });
                } else if std::mem::replace(&mut seen_at[neighbor.index()], v) == v {
                    defects.push(RingDefect::Repeated { v, neighbor });
                } else if let Some(back) = reverse.get(v, slot) {
                    self.find_gap_defects(v, slot, back, &mut defects);
                } else {
                    defects.push(RingDefect::OneSided { v, neighbor });
                }
            }
            if triangles {
                self.find_corner_defects(v, &reverse, &mut defects);
                defects.extend(valence_defect(v, ring));
            }
        }
        // A gap that two rings do not agree on is found from both.
        defects.sort_unstable();
        defects.dedup();
        defects
    }

    /// Compares the gaps beside the edge at a slot with those that the ring of its end has, `back` being the slot there.
    fn find_gap_defects(&self, v: VertexId, slot: usize, back: usize, defects: &mut Vec<RingDefect>) {
        let w = self.neighbors(v)[slot];
        let (here, there) = (sides(self.ring(v), slot), sides(self.ring(w), back));
        if here.left != there.right {
            defects.push(RingDefect::Gap { edge: DirectedEdge::new(v, w) });
        }
        if here.right != there.left {
            defects.push(RingDefect::Gap { edge: DirectedEdge::new(w, v) });
        }
    }

    fn find_corner_defects(&self, v: VertexId, reverse: &ReverseSlots, defects: &mut Vec<RingDefect>) {
        let ring = self.ring(v);
        for (slot, (a, b)) in (0..ring.face_count()).zip(ring.pairs()) {
            let after = ring.slot_after(slot).expect("a face lies between two slots");
            let (Some(at_a), Some(at_b)) = (reverse.get(v, slot), reverse.get(v, after)) else { continue };
            if self.ring(a).ahead(at_a) != Some(b) || self.ring(b).behind(at_b) != Some(a) {
                defects.push(RingDefect::NotTriangle { v, a, b });
            }
        }
    }
}

/// On which sides of a directed edge there is a gap.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct Sides {
    pub(super) left: bool,
    pub(super) right: bool,
}

/// The gaps beside the edge that leads to a slot, as the ring it leaves from has them.
pub(super) fn sides(ring: Ring<'_>, slot: usize) -> Sides {
    Sides { left: ring.is_open() && slot + 1 == ring.valence(), right: ring.is_open() && slot == 0 }
}

/// Whether a vertex that is not isolated has fewer neighbours than triangles need.
pub(super) fn valence_defect(v: VertexId, ring: Ring<'_>) -> Option<RingDefect> {
    let (valence, needed) = (ring.valence(), least_valence(ring.is_open()));
    (valence > 0 && valence < needed).then_some(RingDefect::Valence { v, valence, needed })
}

/// How many neighbours a vertex of triangles has at least.
pub(super) fn least_valence(open: bool) -> usize {
    if open { 2 } else { 3 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation::RingBuf;
    use crate::shapes;

    fn ids<const N: usize>(indices: [usize; N]) -> [VertexId; N] {
        indices.map(VertexId::new)
    }

    fn tetrahedron() -> (RotationSystem, [VertexId; 4]) {
        (shapes::tetrahedron().rotation().clone(), ids([0, 1, 2, 3]))
    }

    #[test]
    fn each_planted_fault_is_found_and_nothing_else() {
        let (sound, [a, ..]) = tetrahedron();
        assert_eq!(sound.validate_triangles(), []);
        let outside = VertexId::new(9);
        let ring = sound.neighbors(a).to_vec();
        let [p, q, r] = ring[..] else { panic!("a tetrahedron has valence 3") };
        let with = |ring: RingBuf| {
            let mut system = sound.clone();
            system.set_ring(a, ring);
            system.validate()
        };
        assert_eq!(with(RingBuf::closed(&[p, q, r, outside])), [RingDefect::NoVertex { v: a, neighbor: outside }]);
        assert_eq!(with(RingBuf::closed(&[p, a, q, r])), [RingDefect::SelfNeighbor { v: a }]);
        assert_eq!(with(RingBuf::closed(&[p, q, r, q])), [RingDefect::Repeated { v: a, neighbor: q }]);
        assert_eq!(with(RingBuf::closed(&[p, q])), [RingDefect::OneSided { v: r, neighbor: a }]);
        let gaps = [DirectedEdge::new(p, a), DirectedEdge::new(a, r)].map(|edge| RingDefect::Gap { edge });
        let found = with(RingBuf::open(&[p, q, r]));
        assert!(found.len() == 2 && gaps.iter().all(|gap| found.contains(gap)), "{found:?}");
        let mut alone = RotationSystem::with_isolated(1);
        alone.set_ring(a, RingBuf::open(&[]));
        assert_eq!(alone.validate(), [RingDefect::EmptyGap { v: a }]);
    }

    #[test]
    fn triangles_have_two_rules_more() {
        let (mut system, [a, ..]) = tetrahedron();
        let ring = system.neighbors(a).to_vec();
        system.set_ring(a, RingBuf::closed(&[ring[1], ring[0], ring[2]]));
        assert_eq!(system.validate(), []);
        let defects = system.validate_triangles();
        assert!(defects.iter().all(|defect| matches!(defect, RingDefect::NotTriangle { .. })));
        // The three corners at a, and two at each of its neighbours.
        assert_eq!(defects.len(), 9);

        let [a, b, c] = ids([0, 1, 2]);
        let pillow = [[b, c], [c, a], [a, b]].map(|ring| RingBuf::closed(&ring));
        let defects = RotationSystem::from_rings(pillow.into()).validate_triangles();
        assert_eq!(defects, [a, b, c].map(|v| RingDefect::Valence { v, valence: 2, needed: 3 }));
    }

    #[test]
    fn a_vertex_of_high_valence_costs_no_more() {
        let count = 100_000;
        let rim = |k: usize| VertexId::new(1 + k % count);
        let mut hub: Vec<VertexId> = (0..count).map(rim).collect();
        hub.push(rim(7));
        let mut rings = vec![RingBuf::closed(&hub)];
        rings.extend((0..count).map(|k| RingBuf::open(&[rim(k + 1), VertexId::new(0), rim(k + count - 1)])));
        let defects = RotationSystem::from_rings(rings).validate();
        assert_eq!(defects, [RingDefect::Repeated { v: VertexId::new(0), neighbor: rim(7) }]);
    }
}
