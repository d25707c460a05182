//! Places in very long rings.

use std::collections::HashMap;

use super::RotationSystem;
use crate::id::VertexId;

/// Rings up to this long are searched; a sorted copy of longer ones is kept, or splitting all edges at a vertex would
/// cost the square of its valence.
const SEARCHED: usize = 128;

/// Finds neighbours in rings, in O(1) for short ones and O(log valence) for long ones.
#[derive(Debug, Default)]
pub(crate) struct Hubs {
    /// The neighbours ascending, each with its slot.
    sorted: HashMap<VertexId, Vec<(VertexId, u32)>>,
}

impl Hubs {
    /// Whether the ring of a vertex is too long to be searched.
    #[inline]
    pub(crate) fn is_long(rotation: &RotationSystem, v: VertexId) -> bool {
        rotation.valence(v) > SEARCHED
    }

    /// Ready for the rings of these vertices, which may come more than once.
    ///
    /// O(vertices), and O(valence log valence) for each long ring.
    pub(crate) fn among(rotation: &RotationSystem, vertices: impl IntoIterator<Item = VertexId>) -> Self {
        let mut sorted = HashMap::new();
        for v in vertices.into_iter().filter(|&v| Self::is_long(rotation, v)) {
            sorted.entry(v).or_insert_with(|| sorted_slots(rotation, v));
        }
        Self { sorted }
    }

    /// The slot of `neighbor` in the ring of `v`, or `None` if it is none.
    #[inline]
    pub(crate) fn slot(&self, rotation: &RotationSystem, v: VertexId, neighbor: VertexId) -> Option<usize> {
        let ring = rotation.ring(v);
        if ring.valence() <= SEARCHED {
            return ring.slot_of(neighbor);
        }
        self.sorted_slot(v, neighbor).or_else(|| ring.slot_of(neighbor))
    }

    #[cold]
    fn sorted_slot(&self, v: VertexId, neighbor: VertexId) -> Option<usize> {
        let sorted = self.sorted.get(&v)?;
        sorted.binary_search_by_key(&neighbor, |entry| entry.0).ok().map(|k| sorted[k].1 as usize)
    }
}

fn sorted_slots(rotation: &RotationSystem, v: VertexId) -> Vec<(VertexId, u32)> {
    let mut sorted: Vec<(VertexId, u32)> = rotation.neighbors(v).iter().copied().zip(0..).collect();
    sorted.sort_unstable();
    sorted
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mesh;
    use crate::glam::DVec3;

    #[test]
    fn a_hub_and_a_short_ring_are_found_alike() {
        let fan: Vec<[u32; 3]> = (1..=SEARCHED as u32).map(|k| [0, k, k + 1]).collect();
        let mesh = Mesh::from_triangles(vec![DVec3::ZERO; SEARCHED + 2], &fan).unwrap();
        let rotation = mesh.rotation();
        let [with, without] = [Hubs::among(rotation, mesh.vertices().chain(mesh.vertices())), Hubs::default()];
        assert_eq!(with.sorted.len(), 1);
        for v in mesh.vertices() {
            for w in mesh.vertices() {
                assert_eq!(with.slot(rotation, v, w), mesh.ring(v).slot_of(w));
                assert_eq!(without.slot(rotation, v, w), mesh.ring(v).slot_of(w));
            }
        }
    }
}
