//! Where a new vertex comes from.

use crate::id::VertexId;

/// The edge `p -> q` that a new (odd) vertex splits, and the corners opposite to it.
///
/// `p` is the older end. Of two ends made in the same step it is the one such that the corner which the edge cuts off
/// its triangle lies left of `p -> q`; of two input vertices it is the smaller id. A scheme reads from `p` to `q`, so the
/// order in which it adds does not depend on ids that were given later.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Parent {
    /// The older end.
    pub p: VertexId,
    /// The other end.
    pub q: VertexId,
    /// The third corner of the triangle left of `p -> q`; `None` if a gap is there.
    pub left: Option<VertexId>,
    /// The third corner of the triangle right of `p -> q`; `None` if a gap is there.
    pub right: Option<VertexId>,
}

impl Parent {
    /// The edge between two vertices with the corners left and right of `v -> w`, read from `w` if it runs towards `v`.
    #[inline]
    pub(crate) fn read(v: VertexId, w: VertexId, [left, right]: [Option<VertexId>; 2], inward: bool) -> Self {
        if inward { Self { p: w, q: v, left: right, right: left } } else { Self { p: v, q: w, left, right } }
    }
}
