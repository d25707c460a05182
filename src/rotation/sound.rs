//! Whether the rings have no defect at all: a quick answer, as nearly always there is none.
//!
//! One look at each directed edge is enough. Let `w` stand at a slot in the ring of `v`. If `v` stands in the ring of
//! `w` exactly once, then neighbours name each other (I2), and no ring holds a neighbour twice, as that is seen from
//! the neighbour (I1). If moreover both rings have the same vertex on the left of `v -> w`, or both a gap, then with
//! what is seen of `w -> v` both sides agree (I3), and the faces are triangles (I4).
//!
//! **Deliberately not here**: what is wrong where; see `validate`.

use super::validate::least_valence;
use super::{Regular, Ring, RotationSystem};
use crate::id::VertexId;
use crate::parallel;

/// How many neighbours are compared with, for each neighbour in a ring, on average at most. In a regular mesh it is 6,
/// and few vertices of high valence change little.
const COMPARED: usize = 32;

impl RotationSystem {
    /// Whether it is quickly seen that there is no breach of I1 to I3, and for `triangles` of I4 and I5.
    ///
    /// O(vertices + edges). It may be `false` without a breach if many vertices have a high valence.
    pub(super) fn is_seen_sound(&self, triangles: bool) -> bool {
        let vertices = 0..self.vertex_count();
        let [entries, compared] = parallel::sums(vertices.clone(), |v| {
            let n = self.valence(VertexId::new(v));
            [n, n * n]
        });
        compared <= COMPARED * entries
            && parallel::find(vertices, |v| !self.is_sound_at(VertexId::new(v), triangles)).is_none()
    }

    #[inline]
    fn is_sound_at(&self, v: VertexId, triangles: bool) -> bool {
        if let Some(ring) = self.regular(v) {
            let threes = ring.threes();
            return (0..6).all(|slot| {
                let [_, w, left] = threes.at(slot);
                let Some(at_w) = self.rings.get(w.index()).filter(|_| w != v) else { return false };
                match at_w.as_regular() {
                    Some(at_w) => regular_holds_once(at_w, v, left, triangles),
                    None => holds_once(at_w.as_ring(), v, Some(left), triangles),
                }
            });
        }
        let ring = self.ring(v);
        let least = if triangles { least_valence(ring.is_open()) } else { 1 };
        let is_isolated = ring.valence() == 0 && !ring.is_open();
        is_isolated
            || ring.valence() >= least
                && ring.iter().enumerate().all(|(slot, w)| {
                    w != v && self.contains(w) && holds_once(self.ring(w), v, ring.behind(slot), triangles)
                })
    }
}

/// Whether `v` stands in a ring exactly once, and before it `left`, or a gap where that is none. Of faces of any number
/// of sides only the gaps are compared.
fn holds_once(ring: Ring<'_>, v: VertexId, left: Option<VertexId>, triangles: bool) -> bool {
    let mut slots = ring.iter().enumerate().filter(|&(_, w)| w == v).map(|(slot, _)| slot);
    let (Some(slot), None) = (slots.next(), slots.next()) else { return false };
    let before = ring.ahead(slot);
    if triangles { before == left } else { before.is_none() == left.is_none() }
}

/// The same for regular rings, without branches.
#[inline]
fn regular_holds_once(ring: Regular<'_>, v: VertexId, left: VertexId, triangles: bool) -> bool {
    let found = ring.slots(|w| w == v);
    let agreeing = ring.slots_of_threes(|[before, w, _]| (w == v) & (before == left));
    (found.len() == 1) & ((agreeing == found) | !triangles)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation::RingBuf;
    use crate::shapes;

    /// The system with one ring changed in each way that one hand can: an entry replaced by any id, two swapped, one
    /// inserted or removed, the ring turned, the gap put in or taken out.
    fn changed_at(system: &RotationSystem, v: VertexId) -> Vec<RotationSystem> {
        let (ring, count) = (system.ring(v), system.vertex_count());
        let mut rings = vec![(ring.neighbors().to_vec(), !ring.is_open())];
        let mut change = |edit: &dyn Fn(&mut Vec<VertexId>)| {
            let mut neighbors = ring.neighbors().to_vec();
            edit(&mut neighbors);
            rings.push((neighbors, ring.is_open()));
        };
        for slot in 0..ring.valence() {
            for w in (0..=count).map(VertexId::new) {
                change(&|neighbors| neighbors[slot] = w);
                change(&|neighbors| neighbors.insert(slot, w));
            }
            change(&|neighbors| neighbors.swap(slot, 0));
            change(&|neighbors| neighbors.rotate_left(slot));
            change(&|neighbors| neighbors.retain(|&w| w != ring.neighbors()[slot]));
        }
        let with = |(neighbors, open): (Vec<VertexId>, bool)| {
            let mut system = system.clone();
            system.set_ring(v, if open { RingBuf::open(&neighbors) } else { RingBuf::closed(&neighbors) });
            system
        };
        rings.into_iter().map(with).collect()
    }

    fn assert_agrees(system: &RotationSystem) {
        for triangles in [false, true] {
            let defects = system.list_defects(triangles);
            assert_eq!(system.is_seen_sound(triangles), defects.is_empty(), "{system:?}: {defects:?}");
        }
    }

    #[test]
    fn it_agrees_with_the_list_of_defects() {
        let [small, regular] = [shapes::tetrahedron(), shapes::torus(4, 3, 2.0, 1.0)];
        for mesh in [&small, &regular, &shapes::grid(2, 2), &shapes::icosahedron()] {
            assert_agrees(mesh.rotation());
            for v in mesh.vertices() {
                changed_at(mesh.rotation(), v).iter().for_each(assert_agrees);
            }
        }
        for system in changed_at(small.rotation(), VertexId::new(0)) {
            changed_at(&system, VertexId::new(2)).iter().for_each(assert_agrees);
        }
        assert_agrees(&RotationSystem::with_isolated(2));
    }

    #[test]
    fn a_hub_is_left_to_the_list() {
        let count = 1000;
        let rim = |k: usize| VertexId::new(1 + k % count);
        let mut rings = vec![RingBuf::closed(&(0..count).map(rim).collect::<Vec<_>>())];
        rings.extend((0..count).map(|k| RingBuf::open(&[rim(k + 1), VertexId::new(0), rim(k + count - 1)])));
        let wheel = RotationSystem::from_rings(rings);
        assert!(!wheel.is_seen_sound(true));
        assert_eq!(wheel.validate_triangles(), []);
    }
}
