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
    records: Vec<Record>,
}

impl Exactness {
    /// Of input vertices everything is proven.
    pub(crate) fn new(vertex_count: usize) -> Self {
        let record = Record { shown: [0, 0, NEVER], spoiler: None };
        Self { step: 0, moved: 0, records: vec![record; vertex_count] }
    }

    #[inline]
    pub(crate) fn holds(&self, proof: Proof, v: VertexId) -> bool {
        let shown = self.records[v.index()].shown[proof as usize];
        let since = if proof == Proof::Position { self.moved } else { self.step };
        since <= shown && shown != NEVER
    }

    pub(crate) fn spoiler(&self, v: VertexId) -> Option<Spoiler> {
        self.records[v.index()].spoiler
    }

    /// Shows something for the present step.
    pub(crate) fn show(&mut self, proof: Proof, v: VertexId) {
        self.records[v.index()].shown[proof as usize] = self.step;
    }

    /// Names what spoiled a vertex, unless that is known already.
    pub(crate) fn spoil(&mut self, v: VertexId, spoiler: Option<Spoiler>) {
        let record = &mut self.records[v.index()];
        record.spoiler = record.spoiler.or(spoiler);
    }

    /// Goes on to the next step, with new vertices of which nothing is proven. What was shown lapses, but for positions
    /// if even vertices did not move.
    pub(crate) fn advance(&mut self, vertex_count: usize, moves_even: bool) {
        self.step += 1;
        if moves_even {
            self.moved = self.step;
        }
        let record = Record { shown: [NEVER; 3], spoiler: None };
        self.records.resize(vertex_count, record);
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        self.records.capacity() * size_of::<Record>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_hold_until_even_vertices_move() {
        let v = VertexId::new(0);
        let mut exactness = Exactness::new(1);
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
