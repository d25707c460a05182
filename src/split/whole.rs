//! The 1-to-4 split of a whole mesh: what [`quadrisect`](super::quadrisect) makes of it, bit for bit, at half the cost.
//!
//! No plan is kept. The old rings stay readable until the end, as the new rings of the old vertices are written beside
//! them, and of an edge only the slot at its greater end is remembered, in a byte.

use std::convert::Infallible;

use super::hubs::Slots;
use super::parents::{Direction, Parents};
use crate::id::{Edge, VertexId};
use crate::mesh::Neighborhood;
use crate::rotation::{Ring, RingBuf, RotationSystem};
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
    let mut rings = rotation.copy_rings(new);
    let mut links = Vec::with_capacity(new);
    let mut slots = Slots::default();
    let mut direction = Direction::new(history);
    for v in rotation.vertices() {
        let ring = rotation.ring(v);
        for_each_upward(v, ring, |slot, w| {
            let x = VertexId::new(old + links.len());
            let slot_in_w = slots.find(rotation, w, v);
            rings[v.index()].set(slot, x);
            rings[w.index()].set(slot_in_w, x);
            let down = if direction.runs_down(ring, slot, [v, w]) { DOWN } else { 0 };
            links.push(down | slot_in_w.min(FAR.into()) as u8);
        });
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
        (0..self.rings.len()).map(VertexId::new).try_for_each(|v| {
            let ring = around.ring(v);
            try_for_each_upward(v, ring, |slot, w| {
                let [left, right] = ring.corners_at(slot);
                visit(match next(&mut links) & DOWN {
                    0 => Parent { p: v, q: w, left, right },
                    _ => Parent { p: w, q: v, left: right, right: left },
                })
            })
        })
    }
}

/// Shows the slots of a ring at which a greater id stands, with that id, until there is an error.
///
/// Which they are is found for all of them at once, as nothing foretells it for any one.
#[inline]
fn try_for_each_upward<E>(
    v: VertexId,
    ring: Ring<'_>,
    mut visit: impl FnMut(usize, VertexId) -> Result<(), E>,
) -> Result<(), E> {
    let greater = |part: &[VertexId]| part.iter().rev().fold(0_u32, |bits, &w| bits << 1 | u32::from(v < w));
    for (k, part) in ring.neighbors().chunks(32).enumerate() {
        let mut bits = match <&[VertexId; 6]>::try_from(part) {
            Ok(six) => greater(six),
            Err(_) => greater(part),
        };
        while bits != 0 {
            let slot = bits.trailing_zeros() as usize;
            visit(32 * k + slot, part[slot])?;
            bits &= bits - 1;
        }
    }
    Ok(())
}

#[inline]
fn for_each_upward(v: VertexId, ring: Ring<'_>, mut visit: impl FnMut(usize, VertexId)) {
    let Ok(()) = try_for_each_upward(v, ring, |slot, w| {
        visit(slot, w);
        Ok::<(), Infallible>(())
    });
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
        for v in rotation.vertices() {
            for_each_upward(v, rotation.ring(v), |slot, w| {
                let link = next(&mut links);
                let slot_in_w = match link & !DOWN {
                    FAR => self.slots.find(rotation, w, v),
                    near => near.into(),
                };
                let ring = match link & DOWN {
                    0 => between(&self.rings, [v, w], [slot, slot_in_w]),
                    _ => between(&self.rings, [w, v], [slot_in_w, slot]),
                };
                self.rings.push(ring);
            });
        }
        let boundary = rotation.boundary_edge_count();
        rotation.replace_by_split(self.rings);
        match self.links.len() {
            0 => 0,
            edges if edges == boundary => 4,
            _ => 6,
        }
    }
}

#[inline]
fn next(links: &mut std::slice::Iter<'_, u8>) -> u8 {
    *links.next().expect("there is a link for each edge")
}

/// The neighbours after and before a slot in the ring of a regular vertex.
#[inline]
fn beside(ring: &[VertexId; 6], slot: usize) -> [VertexId; 2] {
    [ring[if slot == 5 { 0 } else { slot + 1 }], ring[if slot == 0 { 5 } else { slot - 1 }]]
}

/// The ring of the new vertex between `p` and `q`, which stands at these slots in theirs: from `p` counter-clockwise, or
/// from the gap.
#[inline]
fn between(rings: &[RingBuf], [p, q]: [VertexId; 2], [slot_p, slot_q]: [usize; 2]) -> RingBuf {
    let (ring_p, ring_q) = (&rings[p.index()], &rings[q.index()]);
    if let (Some(at_p), Some(at_q)) = (ring_p.as_regular(), ring_q.as_regular()) {
        let ([left_p, right_p], [right_q, left_q]) = (beside(at_p, slot_p), beside(at_q, slot_q));
        return RingBuf::regular([p, right_p, right_q, q, left_q, left_p]);
    }
    let ([left_p, right_p], [right_q, left_q]) =
        (ring_p.as_ring().corners_at(slot_p), ring_q.as_ring().corners_at(slot_q));
    match (right_p.zip(right_q), left_p.zip(left_q)) {
        (Some((right_p, right_q)), Some((left_p, left_q))) => {
            RingBuf::regular([p, right_p, right_q, q, left_q, left_p])
        }
        (Some((right_p, right_q)), None) => RingBuf::open(&[p, right_p, right_q, q]),
        (None, Some((left_p, left_q))) => RingBuf::open(&[q, left_q, left_p, p]),
        (None, None) => unreachable!("an edge of a mesh has a triangle"),
    }
}
