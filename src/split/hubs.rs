//! Slots in very long rings.

use std::collections::HashMap;

use crate::id::VertexId;
use crate::rotation::RotationSystem;

/// Rings up to this long are searched; a sorted copy of longer ones is kept, or splitting all edges at a vertex would
/// cost the square of its valence.
const SEARCHED: usize = 128;

/// Finds slots in rings, in O(1) for short ones and O(log valence) for long ones.
#[derive(Default)]
pub(super) struct Slots {
    hubs: HashMap<VertexId, Vec<(VertexId, u32)>>,
}

impl Slots {
    /// The slot of `neighbor` in the ring of `v`.
    ///
    /// # Panics
    /// If it is no neighbour.
    #[inline]
    pub(super) fn find(&mut self, rotation: &RotationSystem, v: VertexId, neighbor: VertexId) -> usize {
        let ring = rotation.ring(v);
        let slot =
            if ring.valence() <= SEARCHED { ring.slot_of(neighbor) } else { self.find_in_hub(rotation, v, neighbor) };
        slot.expect("rings are symmetric")
    }

    #[cold]
    fn find_in_hub(&mut self, rotation: &RotationSystem, v: VertexId, neighbor: VertexId) -> Option<usize> {
        let sorted = self.hubs.entry(v).or_insert_with(|| {
            let mut slots: Vec<(VertexId, u32)> = rotation.ring(v).iter().zip(0..).collect();
            slots.sort_unstable();
            slots
        });
        sorted.binary_search_by_key(&neighbor, |entry| entry.0).ok().map(|k| sorted[k].1 as usize)
    }
}
