//! What birth levels say of triangles that are bisected.
//!
//! A vertex that a bisection makes has the level of the triangles it makes; both are called *generation* here, the
//! input having 0. So the generation of a triangle is the greatest level of its corners, and from generation 1 on one
//! corner alone has it: the *apex*. The edge opposite to the apex is the *refinement edge*, at which the triangle is
//! bisected next. Of input triangles a matching tells it ([`super::matching`]), and those that are in no block have
//! none.

use crate::id::{Edge, VertexId};
use crate::step::{History, InputBlocks};

/// Birth levels and the blocks of the input.
#[derive(Clone, Copy)]
pub(crate) struct Generations<'a> {
    history: &'a History,
    blocks: &'a InputBlocks,
}

impl<'a> Generations<'a> {
    pub(crate) fn new(history: &'a History, blocks: &'a InputBlocks) -> Self {
        Self { history, blocks }
    }

    /// The birth level of a vertex.
    #[inline]
    pub(crate) fn level(&self, v: VertexId) -> u8 {
        self.history.level(v).unwrap_or(0)
    }

    /// The generation of a triangle.
    #[inline]
    pub(crate) fn of(&self, corners: [VertexId; 3]) -> u8 {
        let [a, b, c] = corners.map(|v| self.level(v));
        a.max(b).max(c)
    }

    /// The place of the apex among the corners; `None` for an input triangle in no block.
    #[inline]
    pub(crate) fn apex(&self, corners: [VertexId; 3]) -> Option<usize> {
        match self.of(corners) {
            0 => (0..3).find(|&k| self.blocks.contains(Edge::new(corners[(k + 1) % 3], corners[(k + 2) % 3]))),
            generation => corners.iter().position(|&v| self.level(v) == generation),
        }
    }

    /// The end of an edge that is read first: the older one, of two input vertices the smaller id.
    ///
    /// The ends of a refinement edge have different levels, unless both are of the input.
    #[inline]
    pub(crate) fn is_first(&self, v: VertexId, w: VertexId) -> bool {
        (self.level(v), v) < (self.level(w), w)
    }
}
