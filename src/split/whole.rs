//! The 1-to-4 split of a whole mesh: what [`quadrisect`](super::quadrisect) makes of it, bit for bit, at a part of the cost.
//!
//! No plan is kept. Edges are numbered in order of (smaller end, slot in its ring), so every new ring and every parent is a
//! function of the old mesh and its own number: they are made in any order and written once, beside the old ones.
//!
//! Regular inner vertices, almost all of a refined mesh, have a way of their own through every function here: six
//! neighbours need no loop, sets of slots are bits, and nothing is decided by a branch that no pattern foretells.

use std::ops::{Range, RangeFrom};

use super::peers::Peers;
use crate::id::{Edge, VertexId};
use crate::parallel;
use crate::rotation::{Hubs, Regular, RingBuf, RotationSystem, Slots};
use crate::step::{History, Parent};

/// So many old vertices are taken at a time; what is made of them stays in the nearest cache.
const PART: usize = 1 << 8;

/// So many old vertices make a block.
const BLOCK: usize = 1 << 16;

/// The edges of a mesh, numbered.
pub(crate) struct Whole<'a> {
    rotation: &'a RotationSystem,
    history: &'a History,
    /// For each vertex, and behind them the number of edges as the first of one more.
    own: Vec<OwnEdges>,
    hubs: Hubs,
}

/// The edges from a vertex to greater ids: they have consecutive numbers.
#[derive(Clone, Copy, Default)]
struct OwnEdges {
    first: u32,
    /// Their slots if the vertex is regular.
    slots: Slots,
    /// The slots of edges that are read towards the vertex, if it is regular.
    inward: Slots,
}

impl<'a> Whole<'a> {
    /// Numbers the edges. O(edges), and 8 bytes a vertex.
    pub(crate) fn new(rotation: &'a RotationSystem, history: &'a History) -> Self {
        let vertices = rotation.vertex_count();
        let mut own = Vec::with_capacity(vertices + 1);
        parallel::append_parts(
            &mut own,
            parts(0..vertices).map(|part| part.len()),
            OwnEdges::default,
            |_, part, own| {
                let mut peers = Peers::of(history, VertexId::new(part * PART));
                for (v, own) in (part * PART..).map(VertexId::new).zip(own) {
                    peers.move_to(history, v);
                    *own = OwnEdges::count(rotation, &peers, v);
                }
            },
        );
        own.push(OwnEdges::default());
        let mut edges = 0;
        for own in &mut own {
            edges += std::mem::replace(&mut own.first, edges);
        }
        let hubs = parallel::gather(0..vertices, |v| {
            let v = VertexId::new(v);
            Hubs::is_long(rotation, v).then_some(v)
        });
        Self { rotation, history, own, hubs: Hubs::among(rotation, hubs) }
    }

    /// Very long rings.
    pub(crate) fn hubs(&self) -> &Hubs {
        &self.hubs
    }

    /// All vertices in pieces, after each of which a caller can be asked whether to go on.
    pub(crate) fn blocks(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        pieces(0..self.rotation.vertex_count(), BLOCK)
    }

    /// The rings after the split, those of the old vertices first. O(edges).
    pub(crate) fn rings(&self) -> Vec<RingBuf> {
        let vertices = 0..self.rotation.vertex_count();
        let mut rings = Vec::with_capacity(vertices.len() + self.rotation.edge_count());
        let blank = || RingBuf::regular([VertexId::new(0); 6]);
        parallel::append_parts(&mut rings, parts(vertices.clone()).map(|part| part.len()), blank, |_, part, rings| {
            for (v, ring) in (part * PART..).map(VertexId::new).zip(rings) {
                self.write_even(v, ring);
            }
        });
        parallel::append_parts(&mut rings, self.odd_lengths(vertices.clone()), blank, |evens, part, rings| {
            let mut rings = rings.iter_mut();
            for v in piece(vertices.clone(), PART, part) {
                self.write_odd_from(VertexId::new(v), evens, &mut rings);
            }
        });
        rings
    }

    /// Appends what is made of each edge that belongs to one of the vertices, in order.
    pub(crate) fn append_odd<T: Default + Send + Sync>(
        &self,
        vertices: Range<usize>,
        list: &mut Vec<T>,
        make: impl Fn(Parent) -> T + Sync,
    ) {
        parallel::append_parts(list, self.odd_lengths(vertices.clone()), T::default, |_, part, made| {
            let mut made = made.iter_mut();
            for v in piece(vertices.clone(), PART, part).map(VertexId::new) {
                let OwnEdges { first, mut slots, inward } = self.own[v.index()];
                let regular = self.rotation.regular(v).map(Regular::threes);
                let mut irregular = 0..;
                for _ in first..self.own[v.index() + 1].first {
                    let parent = match &regular {
                        Some(threes) => {
                            let slot = slots.next().expect("there is one for each edge");
                            let [right, w, left] = threes.at(slot);
                            Parent::read(v, w, [Some(left), Some(right)], inward.contains(slot))
                        }
                        None => self.irregular_parent(v, &mut irregular),
                    };
                    *made.next().expect("there is one for each edge") = make(parent);
                }
            }
        });
    }

    /// How many edges belong to the vertices of each part of a range.
    fn odd_lengths(&self, vertices: Range<usize>) -> impl Iterator<Item = usize> {
        parts(vertices).map(|part| (self.own[part.end].first - self.own[part.start].first) as usize)
    }

    #[inline(never)]
    fn irregular_parent(&self, v: VertexId, slots: &mut RangeFrom<usize>) -> Parent {
        let ring = self.rotation.ring(v);
        let neighbors = ring.neighbors();
        let slot = slots.find(|&slot| v < neighbors[slot]).expect("there are so many");
        let (w, corners) = (neighbors[slot], ring.corners_at(slot));
        Parent::read(v, w, corners, Peers::of(self.history, v).run_inward(corners, w))
    }

    /// Appends the new vertices between two of these vertices, which come ascending, in order; `inside` tells them from others.
    pub(crate) fn append_between(
        &self,
        vertices: &[VertexId],
        inside: impl Fn(VertexId) -> bool,
        list: &mut Vec<VertexId>,
    ) {
        for &v in vertices {
            let greater = self.rotation.ring(v).iter().filter(|&w| v < w);
            let numbered = greater.zip(self.own[v.index()].first..);
            list.extend(numbered.filter(|&(w, _)| inside(w)).map(|(_, number)| self.vertex(number)));
        }
    }

    /// The new vertex on an edge, which exists.
    pub(crate) fn on(&self, edge: Edge) -> VertexId {
        let [v, w] = edge.ends();
        self.vertex(self.number(v, w))
    }

    /// The new vertex on the edge with a number.
    #[inline]
    fn vertex(&self, number: u32) -> VertexId {
        VertexId::from_raw((self.own.len() - 1) as u32 + number)
    }

    /// The number of the edge from `v` to the greater id `w`.
    #[inline]
    fn number(&self, v: VertexId, w: VertexId) -> u32 {
        let own = self.own[v.index()];
        let rank = match self.rotation.regular(v) {
            Some(ring) => own.slots.rank(ring.slot_of(w)),
            None => self.irregular_rank(v, w),
        };
        own.first + rank
    }

    #[inline(never)]
    fn irregular_rank(&self, v: VertexId, w: VertexId) -> u32 {
        self.hubs.place(self.rotation, v, w).expect("rings are symmetric").rank
    }

    /// Writes the ring of an old vertex, in which every neighbour gives way to the new vertex between.
    #[inline]
    fn write_even(&self, v: VertexId, ring: &mut RingBuf) {
        let OwnEdges { first, slots, .. } = self.own[v.index()];
        let (Some(old), Some(new)) = (self.rotation.regular(v), ring.as_regular_mut()) else {
            *ring = self.irregular_even(v);
            return;
        };
        for (slot, number) in slots.zip(first..) {
            new[slot] = self.vertex(number);
        }
        for slot in slots.others() {
            new[slot] = self.vertex(self.number(old.neighbors()[slot], v));
        }
    }

    #[inline(never)]
    fn irregular_even(&self, v: VertexId) -> RingBuf {
        let mut own = self.own[v.index()].first..;
        RingBuf::like(self.rotation.ring(v), |w| {
            let number = if v < w { own.next() } else { Some(self.number(w, v)) };
            self.vertex(number.expect("own numbers have no end"))
        })
    }

    /// Writes the rings of the new vertices on the edges from `v` to greater ids: each from `p` counter-clockwise, or from
    /// the gap.
    #[inline]
    fn write_odd_from<'r>(&self, v: VertexId, evens: &[RingBuf], rings: &mut impl Iterator<Item = &'r mut RingBuf>) {
        let OwnEdges { first, mut slots, inward } = self.own[v.index()];
        let regular = self.rotation.regular(v).zip(evens[v.index()].as_regular());
        let regular = regular.map(|(old, new)| (old.threes(), new.threes()));
        let mut irregular = 0..;
        for number in first..self.own[v.index() + 1].first {
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
            let [left_w, right_w] = at_w.beside(self.vertex(number));
            // The half from `p` on comes first.
            let (from_v, from_w) = if inward.contains(slot) { (3, 0) } else { (0, 3) };
            [ring[from_v], ring[from_v + 1], ring[from_v + 2]] = [v, right, right_w];
            [ring[from_w], ring[from_w + 1], ring[from_w + 2]] = [w, left_w, left];
        }
    }

    #[inline(never)]
    fn irregular_odd(&self, &Parent { p, q, .. }: &Parent, evens: &[RingBuf]) -> RingBuf {
        let slot = |v, w| self.hubs.slot(self.rotation, v, w).expect("rings are symmetric");
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

impl OwnEdges {
    /// The edges of a vertex, with their number in place of the first one's.
    #[inline]
    fn count(rotation: &RotationSystem, peers: &Peers, v: VertexId) -> Self {
        let Some(ring) = rotation.regular(v) else {
            let count = rotation.neighbors(v).iter().filter(|&&w| v < w).count();
            return Self { first: count as u32, ..Self::default() };
        };
        let slots = ring.slots(|w| v < w);
        Self { first: slots.len(), slots, inward: peers.inward(ring) }
    }
}

/// A range cut into pieces of a given length; the last may be shorter.
fn pieces(range: Range<usize>, length: usize) -> impl Iterator<Item = Range<usize>> {
    (0..range.len().div_ceil(length)).map(move |k| piece(range.clone(), length, k))
}

fn piece(range: Range<usize>, length: usize, k: usize) -> Range<usize> {
    let start = range.start + k * length;
    start..range.end.min(start + length)
}

fn parts(vertices: Range<usize>) -> impl Iterator<Item = Range<usize>> {
    pieces(vertices, PART)
}
