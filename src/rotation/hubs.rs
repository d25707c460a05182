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
    sorted: HashMap<VertexId, Vec<(VertexId, Place)>>,
}

/// Where a neighbour stands in a ring.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Place {
    pub(crate) slot: u32,
    /// How many neighbours before the slot have a greater id than the vertex whose ring it is.
    pub(crate) rank: u32,
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
            sorted.entry(v).or_insert_with(|| sorted_places(rotation, v));
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
        self.sorted_place(v, neighbor).map_or_else(|| ring.slot_of(neighbor), |place| Some(place.slot as usize))
    }

    /// The place of `neighbor` in the ring of `v`, or `None` if it is none.
    #[inline]
    pub(crate) fn place(&self, rotation: &RotationSystem, v: VertexId, neighbor: VertexId) -> Option<Place> {
        if rotation.valence(v) > SEARCHED {
            if let Some(place) = self.sorted_place(v, neighbor) {
                return Some(place);
            }
        }
        places(rotation, v).find(|(w, _)| *w == neighbor).map(|(_, place)| place)
    }

    #[cold]
    fn sorted_place(&self, v: VertexId, neighbor: VertexId) -> Option<Place> {
        let sorted = self.sorted.get(&v)?;
        sorted.binary_search_by_key(&neighbor, |entry| entry.0).ok().map(|k| sorted[k].1)
    }
}

fn places(rotation: &RotationSystem, v: VertexId) -> impl Iterator<Item = (VertexId, Place)> {
    let ranks = rotation.neighbors(v).iter().scan(0, move |rank, &w| {
        let before = *rank;
        *rank += u32::from(v < w);
        Some((w, before))
    });
    ranks.zip(0..).map(|((w, rank), slot)| (w, Place { slot, rank }))
}

fn sorted_places(rotation: &RotationSystem, v: VertexId) -> Vec<(VertexId, Place)> {
    let mut sorted: Vec<(VertexId, Place)> = places(rotation, v).collect();
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
                assert_eq!(with.place(rotation, v, w), without.place(rotation, v, w));
            }
            let upward = mesh.ring(v).iter().filter(|&w| v < w);
            let ranks = upward.map(|w| with.place(rotation, v, w).unwrap().rank);
            assert!(ranks.eq(0..mesh.ring(v).iter().filter(|&w| v < w).count() as u32));
        }
    }
}
