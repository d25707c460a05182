//! Which leaves are split together without restriction: those that are asked for, and all that need it then.
//!
//! A leaf may have one split edge, in two parts: it is bisected. One with more, or with a part that is split again, is split
//! in four itself. What is split is a leaf from the start; no triangle that comes of it needs to be split at once, as before
//! every leaf had one split edge at most, and no neighbour that is two levels finer.
//!
//! Source: `[bank1983]`.

use std::collections::{BTreeMap, BTreeSet};
use std::mem;

use super::{Across, Levels};
use crate::id::{Edge, Triangle, VertexId};
use crate::rotation::RotationSystem;
use crate::step::Hierarchy;

/// The leaf that a triangle of the mesh is, or half of.
pub(crate) fn leaf_of(hierarchy: &Hierarchy, triangle: Triangle) -> [VertexId; 3] {
    let corners = triangle.corners();
    let level = hierarchy.level_of(corners);
    // A triangle of a level above 0 has two corners of that level or three, half of one below has one.
    let mut youngest = (0..3).filter(|&k| hierarchy.level(corners[k]) == level);
    match (youngest.next().map(|k| (k, hierarchy.birth(corners[k]))), youngest.next()) {
        (Some((k, Some(birth))), None) => {
            let mut leaf = corners;
            let ends = corners.iter().find_map(|&end| birth.other_end(end));
            leaf[k] = ends.expect("the other half has the other end");
            leaf
        }
        _ => corners,
    }
}

/// Leaves that are split together.
#[derive(Debug, Default)]
pub(crate) struct Red {
    pub(crate) leaves: BTreeSet<Triangle>,
    /// The edges that are split for it, each as the first edge of such a leaf, counter-clockwise.
    pub(crate) edges: BTreeMap<Edge, [VertexId; 3]>,
    /// How many passes found them: one for the leaves that were asked for, each other for those that the one before made
    /// necessary.
    pub(crate) passes: usize,
}

impl Red {
    /// These leaves, and all that need to be split then. O(n log n) in their number, times valences at level 0.
    pub(crate) fn closure(levels: Levels<'_>, leaves: impl IntoIterator<Item = [VertexId; 3]>) -> Self {
        let mut red = Self::default();
        let mut due: Vec<[VertexId; 3]> = leaves.into_iter().collect();
        while !due.is_empty() {
            let found = red.leaves.len();
            for [a, b, c] in mem::take(&mut due) {
                if red.leaves.insert(Triangle::new(a, b, c)) {
                    for side in [[a, b, c], [b, c, a], [c, a, b]] {
                        due.extend(red.split_side(levels, side));
                    }
                }
            }
            red.passes += usize::from(red.leaves.len() > found);
        }
        red
    }

    /// Splits the first edge of a leaf; answers with the leaf that needs to be split then.
    fn split_side(&mut self, levels: Levels<'_>, side: [VertexId; 3]) -> Option<[VertexId; 3]> {
        let [a, b, _] = side;
        if self.is_split(levels, [a, b]) {
            return None;
        }
        self.edges.insert(Edge::new(a, b), side);
        match levels.across(side) {
            Across::Gap => None,
            Across::Unmade(coarser) => Some(coarser),
            Across::Corner(d) => {
                let split = [[a, d], [d, b]].into_iter().filter(|&ends| self.is_split(levels, ends)).count();
                (split > 0).then_some([b, a, d])
            }
        }
    }

    fn is_split(&self, levels: Levels<'_>, [a, b]: [VertexId; 2]) -> bool {
        levels.hierarchy().odd(a, b).is_some() || self.edges.contains_key(&Edge::new(a, b))
    }

    /// Splits the edges by vertices that follow those of the hierarchy, in the order of their edges as they are given.
    pub(crate) fn split(
        &self,
        rotation: &RotationSystem,
        hierarchy: &mut Hierarchy,
        vertices: impl Iterator<Item = (VertexId, Edge)>,
    ) {
        let mut made: Vec<(u8, VertexId, [VertexId; 3])> =
            vertices.map(|(x, edge)| (hierarchy.level_of(edge.ends()), x, self.edges[&edge])).collect();
        // What lies across an edge is a part of a leaf one level below, or is there.
        made.sort_unstable();
        for (_, x, side) in made {
            let birth = Levels::new(rotation, hierarchy).birth(side).expect("the caller has looked how deep it is");
            hierarchy.insert(x, birth);
        }
    }
}
