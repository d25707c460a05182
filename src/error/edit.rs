//! A local edit is not possible, and what is wrong with rings.

use std::fmt;

use crate::id::{DirectedEdge, Edge, VertexId};

/// How many defects a message names; the rest is counted.
const NAMED: usize = 5;

/// Why an edit was refused. Everything is as it was before.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum EditError {
    /// There is no such vertex.
    NoVertex(VertexId),
    /// There is no such edge.
    NoEdge(Edge),
    /// The ring of a vertex does not hold the neighbour named.
    NotNeighbor {
        /// Whose ring.
        v: VertexId,
        /// What is not in it.
        neighbor: VertexId,
    },
    /// The ring of a vertex holds the new neighbour already.
    AlreadyNeighbor {
        /// Whose ring.
        v: VertexId,
        /// What is in it.
        neighbor: VertexId,
    },
    /// A vertex would become its own neighbour.
    SelfNeighbor(VertexId),
    /// A vertex would have two gaps in its ring.
    SecondGap(VertexId),
    /// A vertex has no gap to close.
    NoGap(VertexId),
    /// There are as many vertices as 32-bit ids can name.
    TooManyVertices,
    /// A gap is on the left of a directed edge where a face is needed.
    GapOnLeft(DirectedEdge),
    /// The face on the left of a directed edge is no triangle.
    NotTriangle(DirectedEdge),
    /// Two corners lie in different faces.
    DifferentFaces(DirectedEdge, DirectedEdge),
    /// One face is on both sides of an edge.
    SameFace(Edge),
    /// A vertex would keep too few neighbours.
    Valence {
        /// Which vertex.
        v: VertexId,
        /// How many neighbours it would have.
        valence: usize,
        /// How many it needs: 3, at a boundary 2.
        needed: usize,
    },
    /// Both ends of an edge are next to a vertex that makes no triangle with it.
    CommonNeighbor {
        /// The edge.
        edge: Edge,
        /// The vertex next to both ends.
        neighbor: VertexId,
    },
    /// An inner edge joins two boundary vertices.
    JoinsBoundaries(Edge),
    /// An edge is sharp and the edit would lose it.
    Sharp(Edge),
    /// A coordinate of a new position is not a finite number.
    NonFinite,
    /// The rings would have these defects, all of them.
    Defects(Vec<RingDefect>),
}

impl fmt::Display for EditError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoVertex(v) => write!(f, "there is no vertex {v}; name an existing one"),
            Self::NoEdge(edge) => write!(f, "there is no edge {edge}; name two vertices that are neighbours"),
            Self::NotNeighbor { v, neighbor } => {
                write!(f, "{neighbor} is not in the ring of {v}; name one of its neighbours")
            }
            Self::AlreadyNeighbor { v, neighbor } => {
                write!(f, "{neighbor} is in the ring of {v} already, and a ring holds a neighbour once; name another")
            }
            Self::SelfNeighbor(v) => write!(f, "{v} cannot be its own neighbour; name another vertex"),
            Self::SecondGap(v) => {
                write!(f, "{v} would have two gaps, and a ring has at most one; close one of them first")
            }
            Self::NoGap(v) => write!(f, "the ring of {v} has no gap to close; name a boundary vertex"),
            Self::TooManyVertices => write!(
                f,
                "there are {} vertices already, and 32-bit ids name no more; work on a smaller mesh",
                VertexId::MAX_INDEX + 1
            ),
            Self::GapOnLeft(edge) => {
                write!(f, "a face is needed on the left of {edge}, there is a gap; take an inner edge")
            }
            Self::NotTriangle(edge) => {
                write!(f, "a triangle is needed on the left of {edge}, the face there has other sides; split it first")
            }
            Self::DifferentFaces(a, b) => {
                write!(f, "the corners at {a} and {b} must lie in one face, they do not; name corners of one face")
            }
            Self::SameFace(edge) => {
                write!(
                    f,
                    "two faces are needed at {edge}, there is one on both sides; erase it in a transaction instead"
                )
            }
            Self::Valence { v, valence, needed } => {
                write!(f, "{v} would keep {valence} neighbours and needs {needed}; take an edge elsewhere")
            }
            Self::CommonNeighbor { edge, neighbor } => write!(
                f,
                "{neighbor} is next to both ends of {edge} and makes no triangle with it; split {edge} or take an edge elsewhere"
            ),
            Self::JoinsBoundaries(edge) => {
                write!(
                    f,
                    "{edge} is no boundary edge but joins boundary vertices; split {edge} or take an edge elsewhere"
                )
            }
            Self::Sharp(edge) => write!(f, "{edge} is sharp and would be lost; take the tag off first"),
            Self::NonFinite => write!(f, "a finite position is needed, a coordinate is not; give numbers"),
            Self::Defects(defects) => {
                write!(f, "the rings would have {} defects: ", defects.len())?;
                for (k, defect) in defects.iter().take(NAMED).enumerate() {
                    write!(f, "{}{defect}", if k == 0 { "" } else { "; " })?;
                }
                if defects.len() > NAMED {
                    write!(f, "; and {} more", defects.len() - NAMED)?;
                }
                Ok(())
            }
        }
    }
}

impl std::error::Error for EditError {}

/// One thing wrong with the rings of a rotation system.
///
/// Defects are ordered by the rule broken, as listed here, then by ids.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[non_exhaustive]
pub enum RingDefect {
    /// A ring names a vertex that does not exist.
    NoVertex {
        /// Whose ring.
        v: VertexId,
        /// What does not exist.
        neighbor: VertexId,
    },
    /// A vertex stands in its own ring.
    SelfNeighbor {
        /// Which vertex.
        v: VertexId,
    },
    /// A ring holds a neighbour more than once.
    Repeated {
        /// Whose ring.
        v: VertexId,
        /// What is repeated.
        neighbor: VertexId,
    },
    /// A ring holds a neighbour whose ring does not hold the vertex.
    OneSided {
        /// Whose ring.
        v: VertexId,
        /// The neighbour whose ring lacks `v`.
        neighbor: VertexId,
    },
    /// A ring has a gap but no neighbour.
    EmptyGap {
        /// Which vertex.
        v: VertexId,
    },
    /// The ring of one end has a gap on the left of a directed edge, that of the other end has none there.
    Gap {
        /// The directed edge.
        edge: DirectedEdge,
    },
    /// Two consecutive neighbours of a vertex make no triangle with it.
    NotTriangle {
        /// Which vertex.
        v: VertexId,
        /// A neighbour.
        a: VertexId,
        /// The next one.
        b: VertexId,
    },
    /// A vertex has too few neighbours for a mesh of triangles.
    Valence {
        /// Which vertex.
        v: VertexId,
        /// How many it has.
        valence: usize,
        /// How many it needs: 3, at a boundary 2.
        needed: usize,
    },
}

impl fmt::Display for RingDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoVertex { v, neighbor } => write!(f, "the ring of {v} names {neighbor}, which does not exist"),
            Self::SelfNeighbor { v } => write!(f, "{v} stands in its own ring"),
            Self::Repeated { v, neighbor } => write!(f, "the ring of {v} holds {neighbor} more than once"),
            Self::OneSided { v, neighbor } => {
                write!(f, "the ring of {v} holds {neighbor}, but the ring of {neighbor} does not hold {v}")
            }
            Self::EmptyGap { v } => write!(f, "the ring of {v} has a gap but no neighbour"),
            Self::Gap { edge } => {
                write!(
                    f,
                    "one of the rings of {} and {} has a gap on the left of {edge}, the other has none",
                    edge.from, edge.to
                )
            }
            Self::NotTriangle { v, a, b } => {
                write!(f, "{b} comes after {a} in the ring of {v}, but ({v} {a} {b}) is no triangle")
            }
            Self::Valence { v, valence, needed } => write!(f, "{v} has {valence} neighbours and needs {needed}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_names_the_place_and_counts_what_it_leaves_out() {
        let [v, neighbor] = [3, 4].map(VertexId::new);
        assert_eq!(
            EditError::NoEdge(Edge::new(neighbor, v)).to_string(),
            "there is no edge v3-v4; name two vertices that are neighbours"
        );
        let many = EditError::Defects(vec![RingDefect::OneSided { v, neighbor }; 7]).to_string();
        assert!(many.starts_with("the rings would have 7 defects: the ring of v3 holds v4, but"), "{many}");
        assert!(many.ends_with("; and 2 more"), "{many}");
    }
}
