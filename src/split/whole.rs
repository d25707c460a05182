//! The 1-to-4 split of a whole mesh: what [`quadrisect`](super::quadrisect) makes of it, bit for bit, at half the cost.
//!
//! No plan is kept. The old rings stay readable until the end, as the new rings of the old vertices are written beside
//! them, and of an edge only the slot at its greater end is remembered, in a byte.

use super::hubs::Slots;
use super::parents::{Direction, Parents};
use crate::id::{Edge, VertexId};
use crate::mesh::Neighborhood;
use crate::rotation::{RingBuf, RotationSystem};
use crate::step::{History, Parent};

/// Set in a link if its edge is read from the greater id to the smaller one.
const DOWN: u8 = 0x80;

/// Stands in a link for a slot that is too great for it and is looked for again.
const FAR: u8 = 0x7f;

/// A split of everything, numbered but not made.
pub(crate) struct Whole {
    /// The rings of the old vertices after the split, with room for those of the new ones.
    rings: Vec<RingBuf>,
    /// For each new vertex the slot of the smaller end of its edge in the ring of the greater one, and [`DOWN`].
    links: Vec<u8>,
    slots: Slots,
}

/// Numbers the new vertices, in order of (smaller end, slot in its ring). O(edges).
pub(crate) fn number(rotation: &RotationSystem, history: &History) -> Whole {
    let (old, new) = (rotation.vertex_count(), rotation.edge_count());
    let mut rings = Vec::with_capacity(old + new);
    rings.extend(rotation.vertices().map(|v| RingBuf::from_ring(rotation.ring(v))));
    let mut links = Vec::with_capacity(new);
    let mut slots = Slots::default();
    let mut direction = Direction::new(history);
    for v in rotation.vertices() {
        let ring = rotation.ring(v);
        for (slot, &w) in ring.neighbors().iter().enumerate() {
            if v < w {
                let x = VertexId::new(old + links.len());
                let slot_in_w = slots.find(rotation, w, v);
                rings[v.index()].set(slot, x);
                rings[w.index()].set(slot_in_w, x);
                let down = if direction.runs_down(ring, slot, [v, w]) { DOWN } else { 0 };
                links.push(down | slot_in_w.min(FAR.into()) as u8);
            }
        }
    }
    Whole { rings, links, slots }
}

impl Parents for Whole {
    fn count(&self) -> usize {
        self.links.len()
    }

    #[inline]
    fn try_for_each<E>(
        &self,
        around: Neighborhood<'_>,
        mut visit: impl FnMut(Parent) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut links = self.links.iter();
        for v in (0..self.rings.len()).map(VertexId::new) {
            let ring = around.ring(v);
            let neighbors = ring.neighbors();
            for (slot, &w) in neighbors.iter().enumerate() {
                if v < w {
                    let left = ring.slot_after(slot).map(|slot| neighbors[slot]);
                    let right = ring.slot_before(slot).map(|slot| neighbors[slot]);
                    visit(match next(&mut links) & DOWN {
                        0 => Parent { p: v, q: w, left, right },
                        _ => Parent { p: w, q: v, left: right, right: left },
                    })?;
                }
            }
        }
        Ok(())
    }
}

impl Whole {
    /// The new vertex on an edge; `rotation` is as before the split.
    pub(crate) fn on(&self, rotation: &RotationSystem, edge: Edge) -> VertexId {
        let [a, b] = edge.ends();
        let slot = rotation.ring(a).slot_of(b).expect("the edge exists");
        self.rings[a.index()].as_ring().neighbors()[slot]
    }

    /// Makes the split, and answers with the greatest valence of a new vertex. O(edges).
    pub(crate) fn apply(mut self, rotation: &mut RotationSystem) -> usize {
        let mut links = self.links.iter();
        let mut max_valence = 0;
        for v in rotation.vertices() {
            for (slot, &w) in rotation.neighbors(v).iter().enumerate() {
                if v < w {
                    let link = next(&mut links);
                    let slot_in_w = match link & !DOWN {
                        FAR => self.slots.find(rotation, w, v),
                        near => near.into(),
                    };
                    let ring = match link & DOWN {
                        0 => between(&self.rings, [v, w], [slot, slot_in_w]),
                        _ => between(&self.rings, [w, v], [slot_in_w, slot]),
                    };
                    max_valence = max_valence.max(ring.as_ring().valence());
                    self.rings.push(ring);
                }
            }
        }
        rotation.replace_by_split(self.rings);
        max_valence
    }
}

#[inline]
fn next(links: &mut std::slice::Iter<'_, u8>) -> u8 {
    *links.next().expect("there is a link for each edge")
}

/// The ring of the new vertex between `p` and `q`, which stands at these slots in theirs: from `p` counter-clockwise, or
/// from the gap.
#[inline]
fn between(rings: &[RingBuf], [p, q]: [VertexId; 2], [slot_p, slot_q]: [usize; 2]) -> RingBuf {
    let (ring_p, ring_q) = (rings[p.index()].as_ring(), rings[q.index()].as_ring());
    if let (Some(at_p), Some(at_q)) = (ring_p.as_regular(), ring_q.as_regular()) {
        let before = |slot: usize| if slot == 0 { 5 } else { slot - 1 };
        let after = |slot: usize| if slot == 5 { 0 } else { slot + 1 };
        let (right, left) = ([at_p[before(slot_p)], at_q[after(slot_q)]], [at_q[before(slot_q)], at_p[after(slot_p)]]);
        return RingBuf::regular([p, right[0], right[1], q, left[0], left[1]]);
    }
    let (at_p, at_q) = (ring_p.neighbors(), ring_q.neighbors());
    let right = ring_p.slot_before(slot_p).zip(ring_q.slot_after(slot_q)).map(|(i, j)| [at_p[i], at_q[j]]);
    let left = ring_q.slot_before(slot_q).zip(ring_p.slot_after(slot_p)).map(|(j, i)| [at_q[j], at_p[i]]);
    match (right, left) {
        (Some([a, b]), Some([c, d])) => RingBuf::regular([p, a, b, q, c, d]),
        (Some([a, b]), None) => RingBuf::open(&[p, a, b, q]),
        (None, Some([c, d])) => RingBuf::open(&[q, c, d, p]),
        (None, None) => unreachable!("an edge of a mesh has a triangle"),
    }
}
