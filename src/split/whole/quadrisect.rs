//! The 1-to-4 split of a whole mesh: what [`quadrisect`](crate::split::quadrisect) makes of it, bit for bit, at a part of the
//! cost.
//!
//! Every edge belongs to its smaller end.
//!
//! Regular inner vertices, almost all of a refined mesh, have a way of their own through every function here: six
//! neighbours need no loop, sets of slots are bits, and nothing is decided by a branch that no pattern foretells.

use std::ops::RangeFrom;
use std::slice::IterMut;

use super::{Numbers, Own, WholeSplit};
use crate::id::{Edge, VertexId};
use crate::rotation::{Regular, RingBuf, RotationSystem};
use crate::split::peers::Peers;
use crate::step::{History, Parent};

/// The edges of a mesh, numbered.
pub(crate) struct Whole<'a> {
    rotation: &'a RotationSystem,
    history: &'a History,
    /// Slots of edges that are read towards a regular vertex are told apart.
    numbers: Numbers,
}

impl<'a> Whole<'a> {
    /// Numbers the edges. O(edges), and 8 bytes a vertex.
    pub(crate) fn new(rotation: &'a RotationSystem, history: &'a History) -> Self {
        let owned_from = |first: VertexId| {
            let mut peers = Peers::of(history, first);
            move |v: VertexId| {
                peers.move_to(history, v);
                owned_by(rotation, &peers, v)
            }
        };
        Self { rotation, history, numbers: Numbers::new(rotation, owned_from, |v, slot| owned_at(rotation, v, slot)) }
    }

    /// The rings after the split, those of the old vertices first. O(edges).
    pub(crate) fn rings(&self) -> Vec<RingBuf> {
        self.numbers.rings(|v, ring| self.write_even(v, ring), |v, evens, rings| self.write_odd_from(v, evens, rings))
    }

    #[inline(never)]
    fn irregular_parent(&self, v: VertexId, slots: &mut RangeFrom<usize>) -> Parent {
        let ring = self.rotation.ring(v);
        let neighbors = ring.neighbors();
        let slot = slots.find(|&slot| v < neighbors[slot]).expect("there are so many");
        let (w, corners) = (neighbors[slot], ring.corners_at(slot));
        Parent::read(v, w, corners, Peers::of(self.history, v).run_inward(corners, w))
    }

    /// The new vertex on an edge, which exists.
    pub(crate) fn on(&self, edge: Edge) -> VertexId {
        let [v, w] = edge.ends();
        self.numbers.vertex(self.number(v, w))
    }

    /// The number of the edge from `v` to the greater id `w`.
    #[inline]
    fn number(&self, v: VertexId, w: VertexId) -> u32 {
        let own = self.numbers.of(v);
        let rank = match self.rotation.regular(v) {
            Some(ring) => own.slots.rank(ring.slot_of(w)),
            None => self.irregular_rank(v, w),
        };
        own.first + rank
    }

    #[inline(never)]
    fn irregular_rank(&self, v: VertexId, w: VertexId) -> u32 {
        let slot = self.numbers.hubs().slot(self.rotation, v, w).expect("rings are symmetric");
        self.numbers.counted(v, slot, |v, slot| owned_at(self.rotation, v, slot))
    }

    /// Writes the ring of an old vertex, in which every neighbour gives way to the new vertex between.
    #[inline]
    fn write_even(&self, v: VertexId, ring: &mut RingBuf) {
        let Own { first, slots, .. } = self.numbers.of(v);
        let (Some(old), Some(new)) = (self.rotation.regular(v), ring.as_regular_mut()) else {
            *ring = self.irregular_even(v);
            return;
        };
        for (slot, number) in slots.zip(first..) {
            new[slot] = self.numbers.vertex(number);
        }
        for slot in slots.others() {
            new[slot] = self.numbers.vertex(self.number(old.neighbors()[slot], v));
        }
    }

    #[inline(never)]
    fn irregular_even(&self, v: VertexId) -> RingBuf {
        let mut own = self.numbers.range(v);
        RingBuf::like(self.rotation.ring(v), |w| {
            let number = if v < w { own.next() } else { Some(self.number(w, v)) };
            self.numbers.vertex(number.expect("there is one for each edge"))
        })
    }

    /// Writes the rings of the new vertices on the edges from `v` to greater ids: each from `p` counter-clockwise, or from
    /// the gap.
    #[inline]
    fn write_odd_from(&self, v: VertexId, evens: &[RingBuf], rings: &mut IterMut<'_, RingBuf>) {
        let Own { mut slots, told: inward, .. } = self.numbers.of(v);
        let regular = self.rotation.regular(v).zip(evens[v.index()].as_regular());
        let regular = regular.map(|(old, new)| (old.threes(), new.threes()));
        let mut irregular = 0..;
        for number in self.numbers.range(v) {
            let ring = rings.next().expect("there is one for each edge");
            let Some((old, new)) = &regular else {
                *ring = self.irregular_odd(&self.irregular_parent(v, &mut irregular), evens);
                continue;
            };
            let slot = slots.next().expect("there is one for each edge");
            let [old_right, w, old_left] = old.at(slot);
            let (Some(at_w), Some(ring)) = (evens[w.index()].as_regular(), ring.as_regular_mut()) else {
                let parent = Parent::read(v, w, [Some(old_left), Some(old_right)], inward.contains(slot));
                *ring = self.irregular_odd(&parent, evens);
                continue;
            };
            let [right, _, left] = new.at(slot);
            let [left_w, right_w] = at_w.beside(self.numbers.vertex(number));
            // The half from `p` on comes first.
            let (from_v, from_w) = if inward.contains(slot) { (3, 0) } else { (0, 3) };
            [ring[from_v], ring[from_v + 1], ring[from_v + 2]] = [v, right, right_w];
            [ring[from_w], ring[from_w + 1], ring[from_w + 2]] = [w, left_w, left];
        }
    }

    #[inline(never)]
    fn irregular_odd(&self, &Parent { p, q, .. }: &Parent, evens: &[RingBuf]) -> RingBuf {
        let slot = |v, w| self.numbers.hubs().slot(self.rotation, v, w).expect("rings are symmetric");
        let [left_p, right_p] = evens[p.index()].as_ring().corners_at(slot(p, q));
        let [right_q, left_q] = evens[q.index()].as_ring().corners_at(slot(q, p));
        match (right_p.zip(right_q), left_p.zip(left_q)) {
            (Some((right_p, right_q)), Some((left_p, left_q))) => {
                RingBuf::regular([p, right_p, right_q, q, left_q, left_p])
            }
            (Some((right_p, right_q)), None) => RingBuf::open(&[p, right_p, right_q, q]),
            (None, Some((left_p, left_q))) => RingBuf::open(&[q, left_q, left_p, p]),
            (None, None) => unreachable!("an edge of a mesh has a triangle"),
        }
    }
}

impl WholeSplit for Whole<'_> {
    type Made = Parent;

    fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    #[inline]
    fn each_new(&self, v: VertexId, mut take: impl FnMut(Parent)) {
        let Own { mut slots, told: inward, .. } = self.numbers.of(v);
        let regular = self.rotation.regular(v).map(Regular::threes);
        let mut irregular = 0..;
        for _ in self.numbers.range(v) {
            // Handed over in one place: with two, what takes it would not become a part of this loop.
            take(match &regular {
                Some(threes) => {
                    let slot = slots.next().expect("there is one for each edge");
                    let [right, w, left] = threes.at(slot);
                    Parent::read(v, w, [Some(left), Some(right)], inward.contains(slot))
                }
                None => self.irregular_parent(v, &mut irregular),
            });
        }
    }

    fn append_between(&self, v: VertexId, inside: impl Fn(VertexId) -> bool, list: &mut Vec<VertexId>) {
        let greater = self.rotation.ring(v).iter().filter(|&w| v < w);
        let numbered = greater.zip(self.numbers.range(v));
        list.extend(numbered.filter(|&(w, _)| inside(w)).map(|(_, number)| self.numbers.vertex(number)));
    }
}

/// The edges of a vertex.
#[inline]
fn owned_by(rotation: &RotationSystem, peers: &Peers, v: VertexId) -> Own {
    let Some(ring) = rotation.regular(v) else {
        let count = rotation.neighbors(v).iter().filter(|&&w| v < w).count();
        return Own { first: count as u32, ..Own::default() };
    };
    let slots = ring.slots(|w| v < w);
    Own { first: slots.len(), slots, told: peers.inward(ring) }
}

/// How many edges a vertex owns at a slot: one or none.
fn owned_at(rotation: &RotationSystem, v: VertexId, slot: usize) -> u32 {
    u32::from(v < rotation.neighbors(v)[slot])
}
