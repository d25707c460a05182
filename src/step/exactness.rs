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
    /// Whether even vertices move, so that a proven position is another one's after the next step.
    positions_lapse: bool,
    records: Vec<Record>,
}

impl Exactness {
    /// Of input vertices everything is proven.
    pub(crate) fn new(vertex_count: usize) -> Self {
        let record = Record { shown: [0, 0, NEVER], spoiler: None };
        Self { step: 0, positions_lapse: true, records: vec![record; vertex_count] }
    }

    #[inline]
    pub(crate) fn holds(&self, proof: Proof, v: VertexId) -> bool {
        let shown = self.records[v.index()].shown[proof as usize];
        let lapses = self.positions_lapse || proof != Proof::Position;
        shown == self.step || (!lapses && shown != NEVER)
    }

    pub(crate) fn spoiler(&self, v: VertexId) -> Option<Spoiler> {
        self.records[v.index()].spoiler
    }

    /// Shows something for the present step.
    pub(crate) fn show(&mut self, proof: Proof, v: VertexId) {
        self.records[v.index()].shown[proof as usize] = self.step;
    }

    /// Says whether the scheme moves even vertices.
    pub(crate) fn set_positions_lapse(&mut self, lapse: bool) {
        self.positions_lapse = lapse;
    }

    /// Names what spoiled a vertex, unless that is known already.
    pub(crate) fn spoil(&mut self, v: VertexId, spoiler: Option<Spoiler>) {
        let record = &mut self.records[v.index()];
        record.spoiler = record.spoiler.or(spoiler);
    }

    /// Goes on to the next step, with new vertices of which nothing is proven. What was shown lapses.
    pub(crate) fn advance(&mut self, vertex_count: usize) {
        self.step += 1;
        let record = Record { shown: [NEVER; 3], spoiler: None };
        self.records.resize(vertex_count, record);
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        self.records.capacity() * size_of::<Record>()
    }
}
