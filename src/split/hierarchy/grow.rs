//! What a split or a star needs, planned: the hierarchy grows, the mesh is only read.
//!
//! The star of a vertex v at a level l is made of triangles of level l − 1, and *restriction* says that a triangle of level k
//! is split only if the stars of its three corners at level k are complete. So each need leads one level down, and ends. What
//! is there before a triangle is split is then the whole surroundings from which its new vertices are made.
//!
//! Source: `[zorin1997]` for restriction, `[incremental]` for its use with red-green refinement.

use super::Levels;
use crate::error::RefineError;
use crate::id::VertexId;
use crate::rotation::RotationSystem;
use crate::step::{Birth, Hierarchy};

/// What was added to a hierarchy, in order: a vertex with a level is a new vertex if that is the level of its birth, else the
/// star of an older one at the level before.
///
/// In other words, of which vertices it is to be found out where they are at which level; all that this depends on comes
/// before.
#[derive(Debug, Default)]
pub(crate) struct Growth {
    pub(crate) steps: Vec<(VertexId, u8)>,
    /// The vertices that are new.
    pub(crate) made: Vec<VertexId>,
    /// How many triangles the mesh that is shown has more.
    pub(crate) added_faces: usize,
}

impl Growth {
    pub(crate) fn clear(&mut self) {
        self.steps.clear();
        self.made.clear();
        self.added_faces = 0;
    }

    /// Takes back all that was added.
    pub(crate) fn undo(&mut self, hierarchy: &mut Hierarchy) {
        for &(v, level) in self.steps.iter().rev() {
            match hierarchy.birth(v).filter(|birth| birth.level == level) {
                None => hierarchy.pop_star(v),
                Some(&Birth { parent, .. }) => {
                    hierarchy.join(parent.p, parent.q);
                    hierarchy.release(v);
                }
            }
        }
        self.clear();
    }
}

/// Adds to a hierarchy. After an error what was added is still there; see [`Growth::undo`].
pub(crate) struct Grower<'a> {
    pub(crate) rotation: &'a RotationSystem,
    pub(crate) hierarchy: &'a mut Hierarchy,
    pub(crate) growth: &'a mut Growth,
    /// How many faces the mesh may have.
    pub(crate) max_faces: Option<u64>,
}

impl Grower<'_> {
    pub(crate) fn levels(&self) -> Levels<'_> {
        Levels::new(self.rotation, self.hierarchy)
    }

    /// Requires the star of a vertex at a level not below that of its birth, and all that it needs. O(what is new, and the
    /// valences there).
    pub(crate) fn require_star(&mut self, v: VertexId, level: u8) -> Result<(), RefineError> {
        if self.hierarchy.has_star(v, level) {
            return Ok(());
        }
        if level > self.hierarchy.level(v) {
            self.require_star(v, level - 1)?;
        }
        for triangle in self.levels().triangles_below(v, level).iter() {
            self.split_restricted(triangle)?;
        }
        let next = level.checked_add(1).ok_or(RefineError::TooDeep)?;
        self.hierarchy.push_star(v);
        self.growth.steps.push((v, next));
        Ok(())
    }

    /// Splits a triangle, counter-clockwise, and before that all that restriction asks for.
    pub(crate) fn split_restricted(&mut self, triangle: [VertexId; 3]) -> Result<(), RefineError> {
        let level = self.hierarchy.level_of(triangle);
        for v in triangle {
            self.require_star(v, level)?;
        }
        self.split(triangle)
    }

    /// Splits, until there is none, triangles of which two edges or more are split: those beside edges that were split here.
    /// Answers in how many passes something was split.
    pub(crate) fn close_red(&mut self) -> Result<usize, RefineError> {
        let (mut closed, mut passes) = (0, 0);
        while closed < self.growth.made.len() {
            let made = self.growth.made.len();
            for k in closed..made {
                for triangle in self.levels().triangles_beside(self.growth.made[k]).into_iter().flatten() {
                    if self.hierarchy.odds(triangle).iter().flatten().count() >= 2 {
                        self.split_restricted(triangle)?;
                    }
                }
            }
            passes += usize::from(self.growth.made.len() > made);
            closed = made;
        }
        Ok(passes)
    }

    /// The vertices that were made so far on an edge between two of which this holds.
    pub(crate) fn made_between(&self, holds: impl Fn(&VertexId) -> bool) -> impl Iterator<Item = VertexId> {
        let births = self.growth.made.iter().filter_map(|&x| self.hierarchy.birth(x).map(|birth| (x, birth.parent)));
        births.filter(move |(_, parent)| holds(&parent.p) && holds(&parent.q)).map(|(x, _)| x)
    }

    /// Splits a triangle, counter-clockwise, across whose edges there are triangles of the same level, or nothing.
    pub(crate) fn split(&mut self, [a, b, c]: [VertexId; 3]) -> Result<(), RefineError> {
        for triangle in [[a, b, c], [b, c, a], [c, a, b]] {
            self.split_edge(triangle)?;
        }
        Ok(())
    }

    /// Splits the edge `a -> b` of a triangle `a, b, c` as [`Grower::split`] does, if it is not split yet.
    pub(crate) fn split_edge(&mut self, [a, b, c]: [VertexId; 3]) -> Result<(), RefineError> {
        if self.hierarchy.odd(a, b).is_some() {
            return Ok(());
        }
        let birth = self.levels().birth([a, b, c]).ok_or(RefineError::TooDeep)?;
        self.growth.added_faces += [birth.parent.left, birth.parent.right].iter().flatten().count();
        let needed = self.rotation.triangle_count() as u64 + self.growth.added_faces as u64;
        if let Some(allowed) = self.max_faces.filter(|&allowed| needed > allowed) {
            return Err(RefineError::TooManyFaces { needed, allowed });
        }
        let too_many = RefineError::TooManyVertices { needed: self.hierarchy.vertex_count() as u64 + 1 };
        let x = self.hierarchy.next_id().ok_or(too_many)?;
        self.hierarchy.insert(x, birth);
        self.growth.made.push(x);
        self.growth.steps.push((x, birth.level));
        Ok(())
    }
}
