//! The edges that a step splits, and the direction in which each is read.

use std::ops::Range;

use crate::id::VertexId;
use crate::mesh::Neighborhood;
use crate::rotation::Ring;
use crate::step::{History, Parent};

/// The edges that a step splits, in the order of their new vertices.
pub(crate) trait Parents {
    /// How many there are.
    fn count(&self) -> usize;

    /// Shows them one by one, with their surroundings before the step, until there is an error.
    fn try_for_each<E>(&self, around: Neighborhood<'_>, visit: impl FnMut(Parent) -> Result<(), E>) -> Result<(), E>;
}

/// In which direction parents are read; the rule stands at [`Parent`].
pub(super) struct Direction<'a> {
    history: &'a History,
    /// The vertices made in the same step as the one at hand.
    peers: Range<usize>,
}

impl<'a> Direction<'a> {
    pub(super) fn new(history: &'a History) -> Self {
        Self { history, peers: 0..0 }
    }

    /// Whether the edge between `v` and the greater id `w`, which stands at a slot of the ring of `v`, is read from `w` to
    /// `v`.
    ///
    /// Ids grow from step to step, so the greater end can be the first only if both were made in the same step.
    #[inline]
    pub(super) fn runs_down(&mut self, ring: Ring<'_>, slot: usize, [v, w]: [VertexId; 2]) -> bool {
        if !self.peers.contains(&v.index()) {
            self.peers = self.history.peers(v);
        }
        // Nothing is older than an input vertex, so the smaller id is the first of two of them. Without branches, as the
        // answers have no pattern.
        let older = |corner: Option<VertexId>| corner.is_some_and(|corner| corner.index() < self.peers.start);
        let [left, right] = ring.corners_at(slot);
        (w.index() < self.peers.end) & older(right) & !older(left)
    }
}
