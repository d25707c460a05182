//! One ring: the circular list of a vertex's neighbours, whole or with a gap.

use std::iter::Copied;
use std::slice;

use smallvec::SmallVec;

use super::Regular;
use crate::id::VertexId;

/// Neighbours that a ring holds without an allocation of its own; 6 make a ring of 32 bytes (see `benches/RECORD.md`).
const INLINE: usize = 6;

/// How a ring is kept: its neighbours, and behind the last one of an open ring [`VertexId::GAP`].
#[derive(Clone, Default, PartialEq, Eq)]
pub(crate) struct RingBuf(SmallVec<[VertexId; INLINE]>);

impl RingBuf {
    pub(crate) fn from_ring(ring: Ring<'_>) -> Self {
        let mut buf = Self(SmallVec::from_slice(ring.neighbors));
        if ring.open {
            buf.0.push(VertexId::GAP);
        }
        buf
    }

    /// A ring with other neighbours at the same slots, and the same gap.
    pub(crate) fn like(ring: Ring<'_>, neighbor: impl FnMut(VertexId) -> VertexId) -> Self {
        if let Some(six) = ring.as_regular() {
            return Self::regular(six.neighbors().map(neighbor));
        }
        let gap = ring.open.then_some(VertexId::GAP);
        Self(ring.iter().map(neighbor).chain(gap).collect())
    }

    /// A ring in the given order, if `open` with the gap behind the last.
    pub(crate) fn collect(neighbors: impl Iterator<Item = VertexId>, open: bool) -> Self {
        Self(neighbors.chain(open.then_some(VertexId::GAP)).collect())
    }

    /// A ring with the same gap and another neighbour behind each one that a face follows: what is made of it and the next.
    pub(crate) fn spread(ring: Ring<'_>, mut between: impl FnMut(VertexId, VertexId) -> VertexId) -> Self {
        let mut entries = SmallVec::with_capacity(2 * ring.valence());
        for (slot, w) in ring.iter().enumerate() {
            entries.push(w);
            entries.push(ring.behind(slot).map_or(VertexId::GAP, |next| between(w, next)));
        }
        Self(entries)
    }

    /// A closed ring of six, which needs no length to be known.
    #[inline]
    pub(crate) fn regular(neighbors: [VertexId; INLINE]) -> Self {
        Self(SmallVec::from_buf(neighbors))
    }

    /// A closed ring in the given order.
    #[inline]
    pub(crate) fn closed(neighbors: &[VertexId]) -> Self {
        Self(SmallVec::from_slice(neighbors))
    }

    /// An open ring in the given order, the gap behind the last.
    #[inline]
    pub(crate) fn open(neighbors: &[VertexId]) -> Self {
        Self::from_ring(Ring { neighbors, open: true })
    }

    /// The neighbours of a regular inner vertex, whose number is then known when the program is built. `None` for any other,
    /// and for a ring that was once longer.
    #[inline]
    pub(crate) fn as_regular(&self) -> Option<Regular<'_>> {
        if self.0.spilled() {
            return None;
        }
        let six: &[VertexId; INLINE] = self.0.as_slice().try_into().ok()?;
        (six[INLINE - 1] != VertexId::GAP).then_some(Regular(six))
    }

    /// The neighbours of a regular inner vertex, to be changed; `None` for any other.
    #[inline]
    pub(crate) fn as_regular_mut(&mut self) -> Option<&mut [VertexId; INLINE]> {
        if self.0.spilled() {
            return None;
        }
        let six: &mut [VertexId; INLINE] = self.0.as_mut_slice().try_into().ok()?;
        (six[INLINE - 1] != VertexId::GAP).then_some(six)
    }

    #[inline]
    pub(crate) fn as_ring(&self) -> Ring<'_> {
        match self.0.as_slice() {
            [neighbors @ .., VertexId::GAP] => Ring { neighbors, open: true },
            neighbors => Ring { neighbors, open: false },
        }
    }

    #[inline]
    pub(crate) fn set(&mut self, slot: usize, neighbor: VertexId) {
        self.0[slot] = neighbor;
    }

    /// Puts a neighbour at a slot; those from there on move up.
    #[inline]
    pub(crate) fn insert(&mut self, slot: usize, neighbor: VertexId) {
        self.0.insert(slot, neighbor);
    }

    pub(crate) fn remove(&mut self, slot: usize) {
        self.0.remove(slot);
    }

    /// Bytes outside of the inline part.
    pub(crate) fn heap_bytes(&self) -> usize {
        if self.0.spilled() { self.0.capacity() * size_of::<VertexId>() } else { 0 }
    }
}

/// The ring of a vertex: its neighbours counter-clockwise seen from outside.
///
/// A *closed* ring is a cycle: behind the last neighbour comes the first. An *open* one has a gap, the outside of the
/// mesh, between the last and the first, so the vertex lies on a boundary. The ring of an isolated vertex is closed and
/// empty. Neighbours are numbered by *slots*, 0 being the start of the ring (right after the gap if it is open).
///
/// ```
/// use vvmesh::shapes;
/// let mesh = shapes::octahedron();
/// let v = mesh.vertices().next().unwrap();
/// let ring = mesh.ring(v);
/// let first = ring.neighbors()[0];
/// assert_eq!(ring.valence(), 4);
/// assert_eq!(ring.prev(ring.next(first).unwrap()), Some(first));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Ring<'a> {
    neighbors: &'a [VertexId],
    open: bool,
}

impl<'a> Ring<'a> {
    /// The neighbours in order, from the start of the ring.
    #[inline]
    #[must_use]
    pub fn neighbors(self) -> &'a [VertexId] {
        self.neighbors
    }

    /// The neighbours of a regular inner vertex; `None` for any other.
    #[inline]
    pub(crate) fn as_regular(self) -> Option<Regular<'a>> {
        if self.open { None } else { self.neighbors.try_into().ok().map(Regular) }
    }

    /// How many neighbours there are.
    #[inline]
    #[must_use]
    pub fn valence(self) -> usize {
        self.neighbors.len()
    }

    /// Whether there is a gap between the last neighbour and the first.
    #[inline]
    #[must_use]
    pub fn is_open(self) -> bool {
        self.open
    }

    /// How many faces stand around the vertex: pairs of consecutive neighbours without a gap between them.
    #[inline]
    #[must_use]
    pub fn face_count(self) -> usize {
        self.valence() - usize::from(self.open)
    }

    /// The slot of a neighbour, or `None` if it is none. O(valence).
    #[inline]
    #[must_use]
    pub fn slot_of(self, neighbor: VertexId) -> Option<usize> {
        if let Ok(six) = <&[VertexId; 6]>::try_from(self.neighbors) {
            // The regular case without a branch, as nothing foretells where the neighbour stands.
            let found: usize = (0..6).map(|slot| if six[slot] == neighbor { slot + 1 } else { 0 }).sum();
            return found.checked_sub(1);
        }
        self.neighbors.iter().position(|&w| w == neighbor)
    }

    /// Whether a vertex is a neighbour. O(valence).
    #[inline]
    #[must_use]
    pub fn contains(self, neighbor: VertexId) -> bool {
        self.slot_of(neighbor).is_some()
    }

    /// The slot after this one, or `None` across the gap.
    #[inline]
    #[must_use]
    pub fn slot_after(self, slot: usize) -> Option<usize> {
        if slot + 1 < self.neighbors.len() {
            Some(slot + 1)
        } else if self.open {
            None
        } else {
            Some(0)
        }
    }

    /// The slot before this one, or `None` across the gap.
    #[inline]
    #[must_use]
    pub fn slot_before(self, slot: usize) -> Option<usize> {
        if slot > 0 {
            Some(slot - 1)
        } else if self.open {
            None
        } else {
            Some(self.neighbors.len() - 1)
        }
    }

    /// The neighbour behind (counter-clockwise of) a slot, or `None` across the gap.
    #[inline]
    pub(crate) fn behind(self, slot: usize) -> Option<VertexId> {
        self.slot_after(slot).map(|slot| self.neighbors[slot])
    }

    /// The neighbour ahead (clockwise) of a slot, or `None` across the gap.
    #[inline]
    pub(crate) fn ahead(self, slot: usize) -> Option<VertexId> {
        self.slot_before(slot).map(|slot| self.neighbors[slot])
    }

    /// The neighbours after and before the one at a slot: the third corners of the triangles left and right of the edge to
    /// it.
    #[inline]
    pub(crate) fn corners_at(self, slot: usize) -> [Option<VertexId>; 2] {
        [self.slot_after(slot), self.slot_before(slot)].map(|slot| slot.map(|slot| self.neighbors[slot]))
    }

    /// The neighbour after (counter-clockwise of) this one; `None` across the gap, and for a vertex that is no neighbour.
    #[inline]
    #[must_use]
    pub fn next(self, neighbor: VertexId) -> Option<VertexId> {
        self.behind(self.slot_of(neighbor)?)
    }

    /// The neighbour before (clockwise of) this one; `None` across the gap, and for a vertex that is no neighbour.
    #[inline]
    #[must_use]
    pub fn prev(self, neighbor: VertexId) -> Option<VertexId> {
        self.ahead(self.slot_of(neighbor)?)
    }

    /// The neighbours counter-clockwise from the start of the ring.
    pub fn iter(self) -> Copied<slice::Iter<'a, VertexId>> {
        self.neighbors.iter().copied()
    }

    /// The pairs of consecutive neighbours: with the vertex itself, the triangles around it in order.
    pub fn pairs(self) -> impl ExactSizeIterator<Item = (VertexId, VertexId)> + DoubleEndedIterator + Clone + use<'a> {
        let neighbors = self.neighbors;
        (0..self.face_count()).map(move |k| {
            let after = if k + 1 < neighbors.len() { k + 1 } else { 0 };
            (neighbors[k], neighbors[after])
        })
    }
}

impl<'a> IntoIterator for Ring<'a> {
    type Item = VertexId;
    type IntoIter = Copied<slice::Iter<'a, VertexId>>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ids<const N: usize>(indices: [usize; N]) -> [VertexId; N] {
        indices.map(VertexId::new)
    }

    #[test]
    fn six_neighbours_take_thirty_two_bytes() {
        assert_eq!(size_of::<RingBuf>(), 32);
        assert_eq!(RingBuf::closed(&ids([1, 2, 3, 4, 5, 6])).heap_bytes(), 0);
        assert_ne!(RingBuf::open(&ids([1, 2, 3, 4, 5, 6])).heap_bytes(), 0);
    }

    #[test]
    fn a_gap_is_no_neighbour_and_is_not_crossed() {
        let [a, b, c] = ids([4, 5, 6]);
        let buf = RingBuf::open(&[a, b, c]);
        let ring = buf.as_ring();
        assert_eq!((ring.valence(), ring.face_count()), (3, 2));
        assert_eq!((ring.next(a), ring.next(c), ring.prev(a)), (Some(b), None, None));
        let buf = RingBuf::closed(&[a, b, c]);
        assert_eq!((buf.as_ring().next(c), buf.as_ring().prev(a)), (Some(a), Some(c)));
        assert_eq!(buf.as_ring().pairs().last(), Some((c, a)));
    }
}
