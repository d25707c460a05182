//! The split of √3 of a whole mesh: what [`trisect`](crate::split::trisect) makes of it, bit for bit, at a part of the cost.
//!
//! It is for a mesh of which every step refined the whole. There all triangles are of one level and none lags, so every edge
//! between two of them is turned: in the ring of an old vertex the new vertex of each triangle takes the slot of the edge
//! before it. What is across the edges of a triangle follows from the new rings of its corners.
//!
//! A triangle belongs to its smallest corner, which is its oldest: a smaller id was made no later.

use std::slice::IterMut;

use super::{Numbers, Own, WholeSplit};
use crate::id::VertexId;
use crate::rotation::{Regular, RingBuf, RotationSystem};
use crate::step::{History, Lineage};

/// The triangles of a mesh, numbered by their new vertices.
pub(crate) struct Whole<'a> {
    faces: Faces<'a>,
    numbers: Numbers,
}

impl<'a> Whole<'a> {
    /// Numbers the new vertices. O(triangles), and 8 bytes a vertex.
    pub(crate) fn new(rotation: &'a RotationSystem, history: &History) -> Self {
        let faces = Faces { rotation, youngest: cuts_boundary(history).then(|| history.youngest()) };
        Self { faces, numbers: Numbers::new(rotation, |_| |v| faces.owned_by(v), |v, slot| faces.owned_at(v, slot)) }
    }

    /// The rings after the split, those of the old vertices first. O(triangles).
    pub(crate) fn rings(&self) -> Vec<RingBuf> {
        self.numbers.rings(|v, ring| self.write_even(v, ring), |v, evens, rings| self.write_odd_of(v, evens, rings))
    }

    /// Writes the ring of an old vertex, in which every edge inside gives way to what is new behind it.
    #[inline]
    fn write_even(&self, v: VertexId, ring: &mut RingBuf) {
        let Own { first, slots, .. } = self.numbers.of(v);
        let (Some(old), Some(new)) = (self.faces.rotation.regular(v), ring.as_regular_mut()) else {
            *ring = self.irregular_even(v);
            return;
        };
        for (slot, number) in slots.zip(first..) {
            new[slot] = self.numbers.vertex(number);
        }
        let threes = old.threes();
        for slot in slots.others() {
            let [_, a, b] = threes.at(slot);
            new[slot] = self.numbers.vertex(self.number(if a < b { [a, b] } else { [b, v] }));
        }
    }

    #[inline(never)]
    fn irregular_even(&self, v: VertexId) -> RingBuf {
        let ring = self.faces.rotation.ring(v);
        let mut entries = Vec::with_capacity(ring.valence() + 2);
        let ends = if self.faces.youngest.is_none() && ring.is_open() { ring.neighbors() } else { &[] };
        entries.extend(ends.first());
        for (a, b) in ring.pairs() {
            let (new, thirds) = self.new_in([v, a, b]);
            match (thirds, new) {
                (None, [x, _]) => entries.push(x),
                (Some([_, _, apex]), new) if v == apex => entries.extend(new),
                (Some([near, ..]), [p, q]) => entries.push(if v == near { p } else { q }),
            }
        }
        entries.extend(ends.last());
        if ring.is_open() { RingBuf::open(&entries) } else { RingBuf::closed(&entries) }
    }

    /// Writes the rings of the new vertices that belong to an old one: around a centre from the oldest corner on, along the
    /// boundary from the gap.
    #[inline]
    fn write_odd_of(&self, v: VertexId, evens: &[RingBuf], rings: &mut IterMut<'_, RingBuf>) {
        let mut next = || rings.next().expect("there is one for each number");
        let regular = self.faces.rotation.regular(v).zip(evens[v.index()].as_regular());
        let Some((old, new)) = regular.map(|(old, new)| (old.threes(), new.threes())) else {
            self.faces.each_owned(v, |corners| {
                let (new, thirds) = self.new_in(corners);
                match thirds {
                    None => *next() = self.around_center(corners),
                    Some(corners) => [*next(), *next()] = self.around_thirds(corners, new),
                }
            });
            return;
        };
        for slot in self.numbers.of(v).slots {
            let ([_, b, c], [across_vb, x, across_cv]) = (old.at(slot), new.at(slot));
            let ring = next();
            match (evens[b.index()].as_regular(), ring.as_regular_mut()) {
                (Some(at_b), Some(ring)) => {
                    let [across_bc, _] = at_b.beside(x);
                    *ring = [v, across_vb, b, across_bc, c, across_cv];
                }
                _ => *ring = self.around_center([v, b, c]),
            }
        }
    }

    #[inline(never)]
    fn around_center(&self, [a, b, c]: [VertexId; 3]) -> RingBuf {
        let [across_ab, across_bc, across_ca] = [(b, a), (c, b), (a, c)].map(|(v, w)| self.facing(v, w));
        let ring = [Some(a), across_ab, Some(b), across_bc, Some(c), across_ca];
        RingBuf::closed(&ring.into_iter().flatten().collect::<Vec<_>>())
    }

    /// The rings of the two new vertices on the edge from `a` to `b`.
    fn around_thirds(&self, [a, b, c]: [VertexId; 3], [p, q]: [VertexId; 2]) -> [RingBuf; 2] {
        let across = |v, w| self.facing(v, w).expect("only one edge of a triangle lies on a boundary by now");
        [RingBuf::open(&[q, c, across(a, c), a]), RingBuf::open(&[b, across(c, b), c, p])]
    }

    /// The new vertex that faces an edge from the left; `None` for a gap.
    fn facing(&self, v: VertexId, w: VertexId) -> Option<VertexId> {
        let c = self.faces.rotation.ring(v).behind(self.slot(v, w))?;
        let ([p, q], thirds) = self.new_in([v, w, c]);
        Some(if thirds.is_some_and(|[_, b, _]| v == b) { q } else { p })
    }

    /// What is new in a triangle, the first one twice if there is but one; of a triangle that is cut in three also the
    /// corners, from the edge on that is cut.
    fn new_in(&self, [a, b, c]: [VertexId; 3]) -> ([VertexId; 2], Option<[VertexId; 3]>) {
        let first = self.number(if a < b && a < c {
            [a, b]
        } else if b < c {
            [b, c]
        } else {
            [c, a]
        });
        let thirds = self.faces.thirds([a, b, c]);
        ([first, first + u32::from(thirds.is_some())].map(|number| self.numbers.vertex(number)), thirds)
    }

    /// The number of the first new vertex in the triangle left of an edge, which belongs to `v`.
    #[inline]
    fn number(&self, [v, w]: [VertexId; 2]) -> u32 {
        let own = self.numbers.of(v);
        let rank = match self.faces.rotation.regular(v) {
            Some(ring) => own.slots.rank(ring.slot_of(w)),
            None => self.irregular_rank(v, w),
        };
        own.first + rank
    }

    #[inline(never)]
    fn irregular_rank(&self, v: VertexId, w: VertexId) -> u32 {
        self.numbers.counted(v, self.slot(v, w), |v, slot| self.faces.owned_at(v, slot))
    }

    fn slot(&self, v: VertexId, w: VertexId) -> usize {
        self.numbers.hubs().slot(self.faces.rotation, v, w).expect("rings are symmetric")
    }
}

impl WholeSplit for Whole<'_> {
    type Made = Lineage;

    fn numbers(&self) -> &Numbers {
        &self.numbers
    }

    #[inline]
    fn each_new(&self, v: VertexId, mut take: impl FnMut(Lineage)) {
        if let Some(threes) = self.faces.rotation.regular(v).map(Regular::threes) {
            for slot in self.numbers.of(v).slots {
                let [_, a, b] = threes.at(slot);
                take(Lineage::Face([v, a, b]));
            }
            return;
        }
        self.faces.each_owned(v, |corners| match self.faces.thirds(corners) {
            None => take(Lineage::Face(corners)),
            Some([a, b, _]) => [(a, b), (b, a)].into_iter().for_each(|(near, far)| take(Lineage::Third { near, far })),
        });
    }

    fn append_between(&self, v: VertexId, inside: impl Fn(VertexId) -> bool, list: &mut Vec<VertexId>) {
        let mut numbers = self.numbers.range(v);
        self.faces.each_owned(v, |corners| {
            let count = if self.faces.thirds(corners).is_some() { 2 } else { 1 };
            let new = numbers.by_ref().take(count).map(|number| self.numbers.vertex(number));
            if corners.into_iter().all(&inside) {
                list.extend(new);
            } else {
                new.for_each(drop);
            }
        });
    }
}

/// Whether the next step of a mesh that was refined as a whole cuts boundary edges in three.
pub(crate) fn cuts_boundary(history: &History) -> bool {
    history.step_count() % 2 == 1
}

/// The triangles and how a step splits them.
#[derive(Clone, Copy)]
struct Faces<'a> {
    rotation: &'a RotationSystem,
    /// If boundary edges are cut, the first vertex of the last step.
    youngest: Option<usize>,
}

impl Faces<'_> {
    /// The corners of a triangle from its boundary edge on if that is cut: if a single corner is of the last step.
    #[inline]
    fn thirds(&self, [a, b, c]: [VertexId; 3]) -> Option<[VertexId; 3]> {
        let first = self.youngest?;
        match [a, b, c].map(|v| v.index() >= first) {
            [false, false, true] => Some([a, b, c]),
            [true, false, false] => Some([b, c, a]),
            [false, true, false] => Some([c, a, b]),
            _ => None,
        }
    }

    /// Takes the triangles of which a vertex is the smallest corner.
    #[inline]
    fn each_owned(&self, v: VertexId, mut take: impl FnMut([VertexId; 3])) {
        self.rotation.ring(v).pairs().filter(|&(a, b)| v < a && v < b).for_each(|(a, b)| take([v, a, b]));
    }

    /// How many new vertices a vertex owns at a slot.
    fn owned_at(&self, v: VertexId, slot: usize) -> u32 {
        let ring = self.rotation.ring(v);
        let (a, b) = (ring.neighbors()[slot], ring.behind(slot));
        let corners = b.filter(|&b| v < a && v < b).map(|b| [v, a, b]);
        corners.map_or(0, |corners| if self.thirds(corners).is_some() { 2 } else { 1 })
    }

    /// What a vertex owns. One that is off the boundary owns no triangle with an edge on it: of its corners only the youngest,
    /// a centre, is not on the boundary itself.
    #[inline]
    fn owned_by(&self, v: VertexId) -> Own {
        if let Some(ring) = self.rotation.regular(v) {
            let slots = ring.slots_of_threes(|[_, a, b]| (v < a) & (v < b));
            return Own { first: slots.len(), slots, ..Own::default() };
        }
        let count = (0..self.rotation.valence(v)).map(|slot| self.owned_at(v, slot)).sum();
        Own { first: count, ..Own::default() }
    }
}
