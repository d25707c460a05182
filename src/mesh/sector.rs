//! The parts into which sharp edges cut the surroundings of a vertex.

use smallvec::SmallVec;

use super::Neighborhood;
use crate::id::VertexId;
use crate::rotation::Ring;

/// The neighbours of a vertex from one sharp edge to the next, both included, in ring order.
///
/// With `k` faces it has `k + 1` neighbours, numbered from 0; the first and the last are the same vertex if the vertex has
/// but one sharp edge (a dart), and nowhere else.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Sector<'a> {
    ring: Ring<'a>,
    first: usize,
    faces: usize,
}

impl<'a> Sector<'a> {
    /// How many faces it has, at least one.
    #[inline]
    #[must_use]
    pub fn face_count(self) -> usize {
        self.faces
    }

    /// The neighbour with a number.
    ///
    /// # Panics
    /// If the number is above [`Sector::face_count`].
    #[inline]
    #[must_use]
    pub fn neighbor(self, number: usize) -> VertexId {
        assert!(number <= self.faces, "a sector of {} faces has no neighbour {number}", self.faces);
        self.ring.neighbors()[(self.first + number) % self.ring.valence()]
    }

    /// The neighbours in order.
    pub fn neighbors(self) -> impl ExactSizeIterator<Item = VertexId> + DoubleEndedIterator + Clone + use<'a> {
        (0..self.faces + 1).map(move |number| self.neighbor(number))
    }

    /// The number of the neighbour at a slot of the ring, or `None` if it is not between the two sharp edges.
    #[must_use]
    pub fn inner_number(self, slot: usize) -> Option<usize> {
        let number = self.steps_to(slot);
        (0 < number && number < self.faces).then_some(number)
    }

    /// Whether the face behind (counter-clockwise of) a slot of the ring is one of its faces.
    #[must_use]
    pub fn has_face(self, slot: usize) -> bool {
        self.steps_to(slot) < self.faces
    }

    /// How many slots lie from its first neighbour to a slot.
    fn steps_to(self, slot: usize) -> usize {
        if slot >= self.first { slot - self.first } else { slot + self.ring.valence() - self.first }
    }
}

impl<'a> Neighborhood<'a> {
    /// The sectors of a vertex: from each sharp edge to the next, in ring order; none if it has no sharp edge. O(valence).
    #[must_use]
    pub fn sectors(&self, v: VertexId) -> impl ExactSizeIterator<Item = Sector<'a>> + use<'a> {
        let ring = self.ring(v);
        let slots: SmallVec<[usize; 4]> = self.sharp_slots(v).collect();
        // Behind the last sharp edge of a boundary vertex lies the gap.
        let count = slots.len().saturating_sub(usize::from(ring.is_open()));
        (0..count).map(move |k| {
            let first = slots[k];
            let end = slots.get(k + 1).copied().unwrap_or(slots[0] + ring.valence());
            Sector { ring, first, faces: end - first }
        })
    }
}

#[cfg(test)]
mod tests {
    use crate::id::{Edge, VertexId};
    use crate::shapes;

    #[test]
    fn sharp_edges_cut_a_ring_into_sectors() {
        let mut mesh = shapes::octahedron();
        let v = VertexId::new(4);
        let ring: Vec<_> = mesh.ring(v).iter().collect();
        assert_eq!(mesh.neighborhood().sectors(v).len(), 0);
        mesh.set_sharp(Edge::new(v, ring[1]), true);
        let whole = mesh.neighborhood().sectors(v).next().unwrap();
        assert_eq!((whole.face_count(), whole.neighbor(0), whole.neighbor(4)), (4, ring[1], ring[1]));
        mesh.set_sharp(Edge::new(v, ring[2]), true);
        let sectors: Vec<_> = mesh.neighborhood().sectors(v).collect();
        assert_eq!(sectors.iter().map(|sector| sector.face_count()).collect::<Vec<_>>(), [1, 3]);
        assert!(sectors[1].neighbors().eq([ring[2], ring[3], ring[0], ring[1]]));
        assert_eq!([0, 1, 2, 3].map(|slot| sectors[1].inner_number(slot)), [Some(2), None, None, Some(1)]);
        assert_eq!(sectors[0].inner_number(1).or(sectors[0].inner_number(2)), None);
        assert_eq!([0, 1, 2, 3].map(|slot| sectors[0].has_face(slot)), [false, true, false, false]);
        assert_eq!([0, 1, 2, 3].map(|slot| sectors[1].has_face(slot)), [true, false, true, true]);
    }

    #[test]
    fn a_boundary_vertex_has_no_sector_across_the_gap() {
        let mut mesh = shapes::grid(2, 1);
        let v = VertexId::new(1);
        let faces = |mesh: &crate::Mesh| -> Vec<usize> {
            mesh.neighborhood().sectors(v).map(|sector| sector.face_count()).collect()
        };
        assert_eq!(faces(&mesh), [3]);
        mesh.set_sharp(Edge::new(v, VertexId::new(4)), true);
        assert_eq!(faces(&mesh), [2, 1]);
    }
}
