//! The leaves of a hierarchy, each with what the limit surface on it depends on.
//!
//! What that is follows from level to level: fans are split as triangles are. So a hierarchy is gone through from the
//! triangles of the input down, and the rings of deeper levels are only read where something was semi-sharp above.

use glam::DVec3;

use super::patch::{Patch, View};
use crate::id::VertexId;
use crate::limit::Fans;
use crate::mesh::Mesh;
use crate::scheme::LoopWeights;
use crate::step::Refinement;

/// A triangle that is not split in four.
pub(crate) struct Leaf {
    /// Counter-clockwise.
    pub(crate) corners: [VertexId; 3],
    /// The vertices that split the edges opposite to the corners.
    pub(crate) odds: [Option<VertexId>; 3],
    /// Its surroundings at its level; `None` if some of it is semi-sharp, or was and is not known.
    pub(crate) fans: Option<Fans>,
}

/// All triangles of a hierarchy under [`Loop`](crate::scheme::Loop).
#[derive(Clone, Copy)]
pub(crate) struct Leaves<'a> {
    view: View<'a>,
    weights: LoopWeights,
}

impl<'a> Leaves<'a> {
    pub(crate) fn new(mesh: &'a Mesh, refinement: &'a Refinement, weights: LoopWeights) -> Self {
        Self { view: View::new(mesh.rotation(), mesh.positions(), refinement), weights }
    }

    /// Where a vertex of the input is in the input.
    pub(crate) fn input_position(self, v: VertexId) -> DVec3 {
        self.view.position(v, 0)
    }

    /// Goes through the leaves in those triangles of the input of which this is the smallest corner. O(triangles of all levels
    /// there, and their valences).
    pub(crate) fn of_smallest(self, v: VertexId, mut take: impl FnMut(Leaf)) {
        let (ring, patch) = (self.view.levels.input_ring(v), &mut Patch::default());
        for (a, b) in ring.as_ring().pairs().filter(|&(a, b)| v < a && v < b) {
            let corners = [v, a, b];
            let fans = self.fans(patch, corners, 0);
            self.visit(patch, corners, 0, fans, &mut take);
        }
    }

    fn visit(
        self,
        patch: &mut Patch,
        corners: [VertexId; 3],
        level: u8,
        fans: Option<Fans>,
        take: &mut impl FnMut(Leaf),
    ) {
        let [a, b, c] = corners;
        match self.view.levels.hierarchy().odds(corners) {
            [Some(bc), Some(ca), Some(ab)] => {
                let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]];
                let split = fans.map(|fans| fans.split());
                for (number, part) in parts.into_iter().enumerate() {
                    let fans = match &split {
                        Some(split) => Some(split[number].clone()),
                        None => self.fans(patch, part, level + 1),
                    };
                    self.visit(patch, part, level + 1, fans, take);
                }
            }
            odds => take(Leaf { corners, odds, fans }),
        }
    }

    /// The surroundings of a triangle, if they are there and nothing of them is semi-sharp.
    fn fans(self, patch: &mut Patch, corners: [VertexId; 3], level: u8) -> Option<Fans> {
        let mut fan = |c: usize| patch.fan(self.view, self.weights, [corners[c], corners[(c + 1) % 3]], level);
        Some(Fans([fan(0)?, fan(1)?, fan(2)?]))
    }
}
