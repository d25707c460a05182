//! What is not needed any more, taken out.
//!
//! A star is needed if somebody asks for it, or if a triangle with this corner at its level has to be split; a triangle has
//! to be split if the star of one of its corners, or of a vertex on one of its edges, is required at the next level. All of
//! that stands above in level, so there are no circles, and looking is enough: nothing is counted. What is left is the
//! least that the askers need, whatever the order in which it came and went.
//!
//! **Deliberately not here**: who asks.

use super::Levels;
use crate::id::VertexId;
use crate::rotation::RotationSystem;
use crate::step::Hierarchy;

/// Takes out of a hierarchy what nothing needs.
pub(crate) struct Shrinker<'a, A> {
    pub(crate) rotation: &'a RotationSystem,
    pub(crate) hierarchy: &'a mut Hierarchy,
    /// Whether somebody asks for the star of a vertex at this level or above.
    pub(crate) asked: A,
    /// The vertices that split nothing any more; their ids are still to be released.
    pub(crate) removed: Vec<VertexId>,
    /// The vertices that lost their greatest star, once for each.
    pub(crate) lost: Vec<VertexId>,
}

impl<A: Fn(VertexId, u8) -> bool> Shrinker<'_, A> {
    fn levels(&self) -> Levels<'_> {
        Levels::new(self.rotation, self.hierarchy)
    }

    /// Takes out the stars of a vertex that are not needed, from the greatest level on, and what only they needed.
    /// O(what goes, and the valences there).
    pub(crate) fn settle(&mut self, v: VertexId) {
        let mut unsettled = vec![v];
        while let Some(v) = unsettled.pop() {
            while let Some(level) = self.hierarchy.top_star(v).filter(|&level| !self.is_needed(v, level)) {
                self.hierarchy.pop_star(v);
                self.lost.push(v);
                for triangle in self.levels().triangles_below(v, level).iter() {
                    if !self.must_split(triangle) {
                        self.join_edges(triangle);
                        unsettled.extend(triangle);
                    }
                }
            }
        }
    }

    /// Whether the greatest star that a vertex has is needed.
    fn is_needed(&self, v: VertexId, level: u8) -> bool {
        let around = || self.levels().ring(v, level);
        (self.asked)(v, level) || around().as_ring().pairs().any(|(a, b)| self.must_split([v, a, b]))
    }

    /// Whether a star at the next level is made of the triangle.
    fn must_split(&self, corners: [VertexId; 3]) -> bool {
        let next = self.hierarchy.level_of(corners) + 1;
        let has_star = |v| self.hierarchy.has_star(v, next);
        corners.into_iter().any(has_star) || self.hierarchy.odds(corners).into_iter().flatten().any(has_star)
    }

    /// Makes the edges of a triangle whole for which the triangle beyond has no need either.
    fn join_edges(&mut self, [a, b, c]: [VertexId; 3]) {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            let Some(x) = self.hierarchy.odd(p, q) else { continue };
            let beside = self.levels().triangles_beside(x);
            if !beside.into_iter().flatten().any(|triangle| self.must_split(triangle)) {
                self.hierarchy.join(p, q);
                self.removed.push(x);
            }
        }
    }
}
