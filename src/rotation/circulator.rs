//! Once round a ring from a chosen neighbour, in either direction.
//!
//! **Deliberately not here**: the way round a face; see [`RotationSystem::face`](super::RotationSystem::face).

use std::iter::{FusedIterator, Rev};

use super::Ring;
use crate::id::VertexId;

/// All neighbours of a ring, each once, counter-clockwise from a chosen one; made by [`Ring::circulate`].
///
/// It holds no copy: a slice, a start, and how far it has come from both sides.
#[derive(Clone, Debug)]
pub struct Circulator<'a> {
    neighbors: &'a [VertexId],
    start: usize,
    /// The steps `front..back` from the start are still to come.
    front: usize,
    back: usize,
}

impl<'a> Ring<'a> {
    /// All neighbours counter-clockwise, beginning with `from`; `None` if it is no neighbour.
    ///
    /// Every neighbour comes once, on an open ring too: there the gap lies between two of them without being told, unless
    /// `from` is the first, when it lies behind the last. Where the gap matters, take [`Ring::next`] or
    /// [`Ring::pairs`].
    ///
    /// O(valence) to find `from`, O(1) a step, no allocation.
    ///
    /// ```
    /// use vvmesh::shapes;
    /// let mesh = shapes::octahedron();
    /// let ring = mesh.ring(mesh.vertices().next().unwrap());
    /// let [a, b, c, d] = ring.neighbors().try_into().unwrap();
    /// assert_eq!(ring.circulate(c).unwrap().collect::<Vec<_>>(), [c, d, a, b]);
    /// assert_eq!(ring.circulate_clockwise(c).unwrap().collect::<Vec<_>>(), [c, b, a, d]);
    /// ```
    #[must_use]
    pub fn circulate(self, from: VertexId) -> Option<Circulator<'a>> {
        let start = self.slot_of(from)?;
        Some(Circulator { neighbors: self.neighbors(), start, front: 0, back: self.valence() })
    }

    /// All neighbours clockwise, beginning with `from`; otherwise as [`Ring::circulate`].
    #[must_use]
    pub fn circulate_clockwise(self, from: VertexId) -> Option<Rev<Circulator<'a>>> {
        let slot = self.slot_of(from)?;
        let start = if slot + 1 < self.valence() { slot + 1 } else { 0 };
        Some(Circulator { neighbors: self.neighbors(), start, front: 0, back: self.valence() }.rev())
    }
}

impl Circulator<'_> {
    #[inline]
    fn at(&self, step: usize) -> VertexId {
        let to_end = self.neighbors.len() - self.start;
        self.neighbors[if step < to_end { self.start + step } else { step - to_end }]
    }
}

impl Iterator for Circulator<'_> {
    type Item = VertexId;

    #[inline]
    fn next(&mut self) -> Option<VertexId> {
        if self.front == self.back {
            return None;
        }
        let neighbor = self.at(self.front);
        self.front += 1;
        Some(neighbor)
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.back - self.front, Some(self.back - self.front))
    }
}

impl DoubleEndedIterator for Circulator<'_> {
    #[inline]
    fn next_back(&mut self) -> Option<VertexId> {
        if self.front == self.back {
            return None;
        }
        self.back -= 1;
        Some(self.at(self.back))
    }
}

impl ExactSizeIterator for Circulator<'_> {}
impl FusedIterator for Circulator<'_> {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation::RingBuf;

    #[test]
    fn it_goes_round_once_from_both_sides() {
        let [a, b, c, d] = [5, 6, 7, 8].map(VertexId::new);
        for buf in [RingBuf::closed(&[a, b, c, d]), RingBuf::open(&[a, b, c, d])] {
            let ring = buf.as_ring();
            let mut round = ring.circulate(c).unwrap();
            assert_eq!(round.len(), 4);
            assert_eq!((round.next(), round.next_back(), round.len()), (Some(c), Some(b), 2));
            assert_eq!(round.clone().collect::<Vec<_>>(), [d, a]);
            assert_eq!(
                (round.next(), round.next_back(), round.next(), round.next_back()),
                (Some(d), Some(a), None, None)
            );
            assert_eq!(ring.circulate_clockwise(a).unwrap().collect::<Vec<_>>(), [a, d, c, b]);
            assert_eq!(ring.circulate_clockwise(d).unwrap().collect::<Vec<_>>(), [d, c, b, a]);
            assert!(ring.circulate(VertexId::new(9)).is_none());
        }
    }
}
