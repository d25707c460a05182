//! Where vertices are at the levels at which they were made or moved.
//!
//! A position is kept for every level from the birth of a vertex to the one after its greatest required star, 4/3 a vertex
//! if everything is refined: less than a birth position with a limit for each. So it is never computed twice, it has the bits
//! of uniform refinement, and it does not have to follow a closed form, which darts and semi-sharp vertices do not have.
//!
//! **Deliberately not here**: how positions are made; see [`crate::subdivide`].

use glam::DVec3;

use crate::id::VertexId;

/// No place; behind the last of a vertex and the last free one.
const NONE: u32 = u32::MAX;

#[derive(Clone, Copy, Debug)]
struct Place {
    position: DVec3,
    /// The place of the same vertex at the level below.
    below: u32,
    level: u8,
}

/// For each vertex that moved, where it is at which level; of others the mesh tells it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Places {
    /// For every vertex up to the last that moved its place at the greatest level, or [`NONE`].
    tops: Vec<u32>,
    places: Vec<Place>,
    free: Vec<u32>,
}

impl Places {
    /// Where a vertex is at a level; `None` if it has not moved, so that it is where it was born.
    #[inline]
    pub(crate) fn at(&self, v: VertexId, level: u8) -> Option<DVec3> {
        let mut place = self.places.get(*self.tops.get(v.index())? as usize)?;
        while place.level > level {
            place = &self.places[place.below as usize];
        }
        Some(place.position)
    }

    /// Says where a vertex is at the next level. Of one that has not moved yet `birth` is its place before.
    pub(crate) fn push(&mut self, v: VertexId, level: u8, birth: DVec3, position: DVec3) {
        if self.tops.len() <= v.index() {
            self.tops.resize(v.index() + 1, NONE);
        }
        if self.tops[v.index()] == NONE {
            self.push_one(v, level - 1, birth);
        }
        self.push_one(v, level, position);
    }

    fn push_one(&mut self, v: VertexId, level: u8, position: DVec3) {
        let place = Place { position, below: self.tops[v.index()], level };
        self.tops[v.index()] = match self.free.pop() {
            Some(free) => {
                self.places[free as usize] = place;
                free
            }
            None => {
                self.places.push(place);
                (self.places.len() - 1) as u32
            }
        };
    }

    /// Forgets where a vertex is at the greatest level to which it moved; if then it has not moved, answers with its birth
    /// position.
    pub(crate) fn pop(&mut self, v: VertexId) -> Option<DVec3> {
        let below = self.pop_one(v);
        if self.places[below as usize].below != NONE {
            return None;
        }
        let birth = self.places[below as usize].position;
        self.pop_one(v);
        Some(birth)
    }

    /// Answers what is on top afterwards.
    fn pop_one(&mut self, v: VertexId) -> u32 {
        let top = &mut self.tops[v.index()];
        self.free.push(*top);
        *top = self.places[*top as usize].below;
        *top
    }

    /// Whether any vertex has moved.
    pub(crate) fn any(&self) -> bool {
        self.free.len() < self.places.len()
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        (self.tops.capacity() + self.free.capacity()) * size_of::<u32>() + self.places.capacity() * size_of::<Place>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_kept_by_level_and_their_memory_is_used_again() {
        let [v, w] = [0, 1].map(VertexId::new);
        let mut places = Places::default();
        places.push(v, 1, DVec3::ZERO, DVec3::X);
        places.push(w, 3, DVec3::ONE, DVec3::Z);
        places.push(v, 2, DVec3::NAN, DVec3::Y);
        assert_eq!([0, 1, 2].map(|level| places.at(v, level)), [DVec3::ZERO, DVec3::X, DVec3::Y].map(Some));
        assert_eq!([2, 3].map(|level| places.at(w, level)), [DVec3::ONE, DVec3::Z].map(Some));
        assert_eq!(places.at(VertexId::new(2), 1), None);
        assert_eq!((places.pop(v), places.pop(v), places.at(v, 0)), (None, Some(DVec3::ZERO), None));
        places.push(v, 1, DVec3::ZERO, DVec3::X);
        assert_eq!((places.pop(w), places.places.len()), (Some(DVec3::ONE), 5));
    }
}
