//! Which triangles are bisected together, as far as birth levels do not tell.

use std::collections::HashMap;

use glam::DVec3;

use crate::id::{Edge, VertexId};

/// How the triangles of the input are paired to blocks, which a bisection splits together.
///
/// Any pairing gives a surface with the same smoothness; the longer the edges that are split first, the better the
/// shape of the triangles.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Blocks {
    /// As many as can be: all on a closed mesh. Begins with [`Blocks::LongestEdge`] and changes as little as it needs
    /// to.
    #[default]
    Maximum,
    /// The longest edges first, as long as there are two triangles that have no partner yet. It takes less time and
    /// leaves some triangles without a partner.
    LongestEdge,
}

/// The refinement edges of the input triangles. Those of all later ones follow from birth levels.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub(crate) struct InputBlocks {
    /// Ascending.
    edges: Vec<Edge>,
    unmatched: usize,
}

impl InputBlocks {
    /// Blocks on these edges, with so many triangles left that are in none.
    pub(crate) fn new(mut edges: Vec<Edge>, unmatched: usize) -> Self {
        edges.sort_unstable();
        Self { edges, unmatched }
    }

    /// Whether an edge of the input is the refinement edge of the triangles beside it.
    pub(crate) fn contains(&self, edge: Edge) -> bool {
        self.edges.binary_search(&edge).is_ok()
    }

    /// All of them, ascending.
    pub(crate) fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// How many triangles are in no block.
    pub(crate) fn unmatched(&self) -> usize {
        self.unmatched
    }
}

/// What a run of bisections remembers beside birth levels.
#[derive(Clone, Debug, Default)]
pub(crate) struct Bisections {
    pub(crate) blocks: InputBlocks,
    /// Of vertices that are a generation ahead of a neighbour: the generation before, and where they were then.
    pub(crate) behind: HashMap<VertexId, (u8, DVec3)>,
}

impl Bisections {
    pub(crate) fn memory_bytes(&self) -> usize {
        self.blocks.edges.capacity() * size_of::<Edge>() + self.behind.capacity() * size_of::<(VertexId, (u8, DVec3))>()
    }
}
