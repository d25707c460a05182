//! The direction in which the edge of a new vertex is read.

use std::ops::Range;

use crate::id::VertexId;
use crate::rotation::{Regular, Slots};
use crate::step::History;

/// The vertices made in one step, among which the direction is decided in which a parent is read; the rule stands at
/// [`Parent`](crate::step::Parent).
#[derive(Clone, Debug)]
pub(super) struct Peers(Range<usize>);

impl Peers {
    /// The vertices made in the same step as this one. O(log steps).
    pub(super) fn of(history: &History, v: VertexId) -> Self {
        Self(history.peers(v))
    }

    /// Goes on to the vertices made in the same step as this one.
    #[inline]
    pub(super) fn move_to(&mut self, history: &History, v: VertexId) {
        if !self.0.contains(&v.index()) {
            *self = Self::of(history, v);
        }
    }

    /// The slots of all edges from one of them, whose ring is regular, that are read from the other end.
    #[inline]
    pub(super) fn inward(&self, ring: Regular<'_>) -> Slots {
        ring.slots_of_threes(|[right, w, left]| self.run_inward([Some(left), Some(right)], w))
    }

    /// Whether the edge from one of them to the greater id `w`, between these corners, is read from `w`.
    ///
    /// Ids grow from step to step, so the greater end can be the first only if both were made in the same step.
    #[inline]
    pub(super) fn run_inward(&self, [left, right]: [Option<VertexId>; 2], w: VertexId) -> bool {
        // Nothing is older than an input vertex, so the smaller id is the first of two of them. Without branches, as the
        // answers have no pattern.
        let older = |corner: Option<VertexId>| corner.is_some_and(|corner| corner.index() < self.0.start);
        (w.index() < self.0.end) & older(right) & !older(left)
    }
}
