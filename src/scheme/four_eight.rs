//! The 4-8 scheme.

use super::MaskSink;
use crate::id::VertexId;
use crate::step::{Blocks, Parent};

/// The 4-8 scheme of Velho and Zorin: triangles are bisected, two that share their refinement edge together as a block.
///
/// | vertex | mask |
/// |---|---|
/// | new, in a block | 1/4 for each of its four corners |
/// | new, on a boundary edge | 1/2 for each end |
/// | new, in an input triangle without a partner | 1/3 for each corner |
/// | even, inside | 1/2 for itself, 1/2 for the mean of its neighbours across exterior edges |
/// | even, on the boundary | 1/2 for itself, 1/4 for each neighbour along the boundary once both edges to them are split |
///
/// An *exterior* edge is one that is no refinement edge before the step. Of two edges that follow each other in a ring
/// one is exterior, as their triangle has one refinement edge; so every inner vertex has exterior edges, and on a
/// regular mesh the masks are (1, 2, 1) × (1, 2, 1) / 8, those of the box spline of four directions.
///
/// Two steps split every boundary edge once, some in the first and some in the second. A boundary vertex moves in the
/// step that splits the second of its two edges (the rule: 1/8, 3/4, 1/8 of the positions before both). So after every
/// two steps the boundary is the cubic B-spline that the boundary of [`Loop`](super::Loop) is, whatever the blocks.
///
/// # Guarantees
/// Every vertex is where as many uniform steps have it as the least generation at it says (the level of the triangles
/// at it, the greatest of their corners'), bit for bit, for every method and any sequence of selections: what a
/// position depends on is refined first. If each selection lies in the one that follows the step before,
/// [`Incremental`](crate::adaptive) with r = 1 gives selected vertices the positions and the neighbours of uniform
/// refinement, and with r = 2 the neighbours' positions too. Triangles that share a vertex differ by one generation at
/// most, and the mesh is conforming without being closed: a step makes no T-vertex. A closed mesh has a perfect
/// pairing, so the number of triangles doubles with each step of the whole mesh, and two steps make four of one.
///
/// The scheme knows neither creases nor corners. Source: `[velho-zorin2001]`; masks after `[incremental]`.
///
/// ```
/// use vvmesh::scheme::{FourEight, Mask};
/// use vvmesh::step::Parent;
/// use vvmesh::VertexId;
/// let [p, q, left, right] = [0, 1, 2, 3].map(VertexId::new);
/// let mut mask = Mask::default();
/// FourEight::default().middle(&Parent { p, q, left: Some(left), right: Some(right) }, &mut mask);
/// assert_eq!((mask.weight_of(left), mask.sum()), (0.25, 1.0));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct FourEight {
    blocks: Blocks,
}

impl FourEight {
    /// The scheme with this choice of blocks.
    #[must_use]
    pub fn new(blocks: Blocks) -> Self {
        Self { blocks }
    }

    /// How input triangles are paired.
    #[must_use]
    pub fn blocks(&self) -> Blocks {
        self.blocks
    }

    /// Writes the mask of the new vertex on a refinement edge.
    #[inline]
    pub fn middle(&self, parent: &Parent, mask: &mut impl MaskSink) {
        let Parent { p, q, left, right } = *parent;
        match (left, right) {
            (Some(left), Some(right)) => mask.group(0.25, [p, q, left, right]),
            _ => mask.group(0.5, [p, q]),
        }
    }

    /// Writes the mask of the new vertex in a triangle without a partner.
    pub fn center(&self, corners: [VertexId; 3], mask: &mut impl MaskSink) {
        mask.group(1.0 / 3.0, corners);
    }

    /// Writes the mask of an even inner vertex with these neighbours across exterior edges, of which there are some.
    #[inline]
    pub fn even(&self, v: VertexId, exterior: impl ExactSizeIterator<Item = VertexId>, mask: &mut impl MaskSink) {
        mask.group(0.5, [v]);
        mask.group(0.5 / exterior.len() as f64, exterior);
    }

    /// Writes the mask of an even boundary vertex whose edges along the boundary are split: the vertices in their
    /// middle, which are (v + w)/2, stand for the ends before, since one of them may be gone.
    #[inline]
    pub fn boundary(&self, v: VertexId, middles: [VertexId; 2], mask: &mut impl MaskSink) {
        mask.group(0.5, [v]);
        mask.group(0.25, middles);
    }
}
