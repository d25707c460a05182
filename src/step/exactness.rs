//! What is proven of every vertex, in a form that costs nothing for vertices that a step does not touch.
//!
//! **Deliberately not here**: the rules by which a step hands proofs on; see [`crate::certify`].

use crate::id::VertexId;

/// What spoiled a vertex: the connectivity around one of these is not that of uniform refinement.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Spoiler {
    /// A new vertex on an edge of which a triangle was not refined.
    TVertex(VertexId),
    /// An old vertex opposite to a T-vertex, to which closing the crack added a neighbour.
    OVertex(VertexId),
}

/// Why a vertex is not certified.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Cause {
    /// It, or its whole surroundings, were not refined at some step: it is simply coarser.
    NotRefined,
    /// A T- or O-vertex reached it.
    Spoiled(Spoiler),
}

/// A fact that holds up to a step, and lapses there unless it is renewed: so nothing has to be written for a vertex that
/// a step leaves alone.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Proof {
    Position,
    Rotation,
    /// Position and rotation of the vertex and positions of its neighbours; only valid while a step is made.
    Star,
}

const NEVER: u32 = u32::MAX;

#[derive(Clone, Copy, Debug)]
struct Record {
    /// For each [`Proof`] the step at which it was last shown.
    shown: [u32; 3],
    spoiler: Option<Spoiler>,
}

#[derive(Clone, Debug)]
pub(crate) struct Exactness {
    step: u32,
    /// The last step that moved even vertices: positions shown before it have lapsed, those shown since hold.
    moved: u32,
    /// For each vertex; `None` as long as every step refined the whole mesh, for then everything is proven.
    records: Option<Vec<Record>>,
}

impl Exactness {
    /// Of input vertices everything is proven.
    pub(crate) fn new() -> Self {
        Self { step: 0, moved: 0, records: None }
    }

    /// Whether everything is proven of every vertex, as every step refined the whole mesh.
    #[inline]
    pub(crate) fn is_whole(&self) -> bool {
        self.records.is_none()
    }

    /// Whether something holds of a vertex of the mesh.
    #[inline]
    pub(crate) fn holds(&self, proof: Proof, v: VertexId) -> bool {
        let Some(records) = &self.records else { return true };
        let shown = records[v.index()].shown[proof as usize];
        let since = if proof == Proof::Position { self.moved } else { self.step };
        since <= shown && shown != NEVER
    }

    pub(crate) fn spoiler(&self, v: VertexId) -> Option<Spoiler> {
        self.records.as_ref()?[v.index()].spoiler
    }

    /// Gets ready for a step that may leave out a part of a mesh with so many vertices. O(1) but the first time.
    pub(crate) fn record(&mut self, vertex_count: usize) {
        let record = Record { shown: [self.step, self.step, NEVER], spoiler: None };
        self.records.get_or_insert_with(|| vec![record; vertex_count]);
    }

    /// Shows something for the present step.
    pub(crate) fn show(&mut self, proof: Proof, v: VertexId) {
        if let Some(records) = &mut self.records {
            records[v.index()].shown[proof as usize] = self.step;
        }
    }

    /// Names what spoiled a vertex, unless that is known already.
    pub(crate) fn spoil(&mut self, v: VertexId, spoiler: Option<Spoiler>) {
        if let Some(records) = &mut self.records {
            let record = &mut records[v.index()];
            record.spoiler = record.spoiler.or(spoiler);
        }
    }

    /// Goes on to the next step, with new vertices of which nothing is proven, unless the step was one of the whole mesh and
    /// all before it too. What was shown lapses, but for positions if even vertices did not move.
    pub(crate) fn advance(&mut self, vertex_count: usize, moves_even: bool) {
        self.step += 1;
        if moves_even {
            self.moved = self.step;
        }
        if let Some(records) = &mut self.records {
            records.resize(vertex_count, Record { shown: [NEVER; 3], spoiler: None });
        }
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        self.records.as_ref().map_or(0, |records| records.capacity() * size_of::<Record>())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_hold_until_even_vertices_move() {
        let v = VertexId::new(0);
        let mut exactness = Exactness::new();
        exactness.record(1);
        let mut held = Vec::new();
        for moves_even in [false, true, false] {
            held.push([Proof::Position, Proof::Rotation, Proof::Star].map(|proof| exactness.holds(proof, v)));
            exactness.advance(1, moves_even);
        }
        held.push([Proof::Position, Proof::Rotation, Proof::Star].map(|proof| exactness.holds(proof, v)));
        assert_eq!(held, [[true, true, false], [true, false, false], [false; 3], [false; 3]]);
        exactness.show(Proof::Position, v);
        exactness.advance(2, false);
        assert!(exactness.holds(Proof::Position, v) && !exactness.holds(Proof::Position, VertexId::new(1)));
    }
}
