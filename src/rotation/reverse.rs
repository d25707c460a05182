//! Where every directed edge comes back: its slot in the other ring, for all of them in linear time.

use super::RotationSystem;
use crate::id::VertexId;

/// The start of an edge does not stand in the ring of its end.
const NONE: u32 = u32::MAX;

/// For the edge at slot `s` in the ring of `v`, leading to `w`: the slot of `v` in the ring of `w`.
///
/// [`Ring::slot_of`](super::Ring::slot_of) finds one in O(valence), which over all edges of a vertex of high valence is
/// quadratic. This table takes O(vertices + edges) for all, also when the rings have defects: the first of repeated
/// entries counts, and what is missing is `None`. It also numbers the directed edges, by their start and slot.
pub(crate) struct ReverseSlots {
    /// Where the edges of each vertex start, and their number at the end.
    starts: Vec<usize>,
    slots: Vec<u32>,
}

impl ReverseSlots {
    pub(crate) fn new(system: &RotationSystem) -> Self {
        let count = system.vertex_count();
        let mut starts = Vec::with_capacity(count + 1);
        let mut arriving = vec![0_usize; count + 1];
        let mut edges = 0;
        for v in system.vertices() {
            starts.push(edges);
            edges += system.valence(v);
            for w in system.ring(v).iter().filter(|&w| system.contains(w)) {
                arriving[w.index() + 1] += 1;
            }
        }
        starts.push(edges);

        // The edges sorted by the vertex at which they arrive, each as its number and its start.
        for w in 0..count {
            arriving[w + 1] += arriving[w];
        }
        let mut sorted = vec![(0_usize, VertexId::GAP); arriving[count]];
        let mut free = arriving.clone();
        for v in system.vertices() {
            for (slot, w) in system.ring(v).iter().enumerate().filter(|&(_, w)| system.contains(w)) {
                sorted[free[w.index()]] = (starts[v.index()] + slot, v);
                free[w.index()] += 1;
            }
        }

        // One ring at a time is laid out by vertex, so that each edge arriving there reads its slot off.
        let mut laid_out = vec![NONE; count];
        let mut slots = vec![NONE; edges];
        for w in system.vertices() {
            let ring = system.ring(w);
            for (slot, v) in ring.iter().enumerate().rev().filter(|&(_, v)| system.contains(v)) {
                laid_out[v.index()] = slot as u32;
            }
            for &(edge, v) in &sorted[arriving[w.index()]..arriving[w.index() + 1]] {
                slots[edge] = laid_out[v.index()];
            }
            for v in ring.iter().filter(|&v| system.contains(v)) {
                laid_out[v.index()] = NONE;
            }
        }
        Self { starts, slots }
    }

    /// The slot of `v` in the ring of its neighbour at `slot`.
    #[inline]
    pub(crate) fn get(&self, v: VertexId, slot: usize) -> Option<usize> {
        let reverse = self.slots[self.number(v, slot)];
        (reverse != NONE).then_some(reverse as usize)
    }

    /// The number of the directed edge at a slot, below [`ReverseSlots::edge_count`].
    #[inline]
    pub(crate) fn number(&self, v: VertexId, slot: usize) -> usize {
        self.starts[v.index()] + slot
    }

    /// How many directed edges there are.
    pub(crate) fn edge_count(&self) -> usize {
        self.slots.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation::RingBuf;

    #[test]
    fn it_agrees_with_searching() {
        let [a, b, c, outside] = [0, 1, 2, 9].map(VertexId::new);
        // b repeats c, c names nobody back but b, a names a vertex that does not exist.
        let rings = vec![RingBuf::closed(&[b, outside]), RingBuf::open(&[c, a, c]), RingBuf::closed(&[a, b])];
        let system = RotationSystem::from_rings(rings);
        let table = ReverseSlots::new(&system);
        assert_eq!(table.edge_count(), 7);
        for v in system.vertices() {
            for (slot, w) in system.ring(v).iter().enumerate() {
                let searched = system.contains(w).then(|| system.ring(w).slot_of(v)).flatten();
                assert_eq!(table.get(v, slot), searched, "{v} at {slot}");
            }
        }
        assert_eq!(
            (table.get(a, 0), table.get(a, 1), table.get(b, 2), table.get(c, 0)),
            (Some(1), None, Some(1), None)
        );
    }
}
