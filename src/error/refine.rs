//! Parameters do not make sense, or a refinement step was not made.

use std::fmt;

/// A parameter, or a pair of them, that has no meaning.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ConfigError {
    /// The name of the parameter.
    pub name: &'static str,
    /// The value it was given.
    pub value: String,
    /// What would be allowed, or why this is not.
    pub expected: String,
}

impl fmt::Display for ConfigError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} = {}: {}", self.name, self.value, self.expected)
    }
}

impl std::error::Error for ConfigError {}

/// Why a refinement step was not made. The mesh and its history are as they were before the step.
#[derive(Clone, PartialEq, Eq, Debug)]
#[non_exhaustive]
pub enum RefineError {
    /// The step would make more faces than allowed.
    TooManyFaces {
        /// Faces after the step; on a hierarchy as many as were counted before it was given up.
        needed: u64,
        /// Faces allowed.
        allowed: u64,
    },
    /// The step would make more vertices than 32-bit ids can name.
    TooManyVertices {
        /// Vertices after the step.
        needed: u64,
    },
    /// An edge would be split for the 256th time.
    TooDeep,
    /// The step cuts triangles in another way than the steps before it, which its history remembers.
    OtherSplit {
        /// How they did.
        made: &'static str,
        /// How this one does.
        asked: &'static str,
    },
    /// Under √3, a step by a method that promises exactness and one by a method that does not, in one run: the latter keeps
    /// positions of all levels from the first step on.
    OtherPositions,
    /// What goes along with the mesh was not there before, and the step reads values that earlier ones kept: adaptive √3 from
    /// the second step on, 4-8 where triangles of several generations meet. Or, on a hierarchy, something was given up before,
    /// which nothing follows; or something is said of faces that were made on it, and may be taken back.
    JoinedLate,
    /// In one run, steps on a hierarchy of another method, or of another kind than those before.
    OtherHistory,
    /// On a hierarchy, a step by another scheme than the steps before it: positions are kept by level, and would be mixed.
    OtherScheme {
        /// The scheme that made them.
        made: &'static str,
        /// The one that was asked for.
        asked: &'static str,
    },
    /// A selection names a vertex that does not exist.
    NoVertex(crate::id::VertexId),
    /// A selection names an edge that does not exist.
    NoEdge(crate::id::Edge),
    /// A selection names a face that does not exist.
    NoFace(crate::id::Triangle),
    /// The star of a vertex was asked for at a level at which it has none yet.
    NoStar {
        /// The vertex.
        vertex: crate::id::VertexId,
        /// The level that was asked for.
        level: u8,
        /// The level at which the vertex was made.
        birth: u8,
    },
    /// The star of a vertex at a level was given up that nobody asked for.
    NotAsked {
        /// The vertex.
        vertex: crate::id::VertexId,
        /// The level.
        level: u8,
    },
    /// The mesh has semi-sharp edges or vertices, and tags change the masks of the scheme, but it cannot blend them.
    SemiSharp,
    /// A new position is not a finite number.
    NonFinite(crate::id::VertexId),
    /// The caller asked to stop.
    Cancelled,
}

impl fmt::Display for RefineError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooManyFaces { needed, allowed } => write!(
                f,
                "the step would make {needed} faces, allowed are {allowed}; take fewer levels, a smaller selection or a higher limit"
            ),
            Self::TooManyVertices { needed } => {
                write!(f, "the step would make {needed} vertices, 32-bit ids name at most {}", u32::MAX)
            }
            Self::TooDeep => write!(f, "an edge would be split for the 256th time; take fewer levels"),
            Self::OtherSplit { made, asked } => {
                write!(f, "{asked} cannot follow {made} in one run; begin a new history with the mesh as it is")
            }
            Self::OtherPositions => write!(
                f,
                "under sqrt3 a method that promises exactness and one that does not cannot follow each other in one run; \
                 begin a new history with the mesh as it is"
            ),
            Self::JoinedLate => write!(
                f,
                "the step reads values that earlier steps kept, and what goes along was not there; take it along from the \
                 first step, or begin a new history with the mesh as it is"
            ),
            Self::OtherHistory => write!(
                f,
                "methods on a hierarchy, those of them that cannot go back, and methods on the mesh as it is cannot follow \
                 each other in one run; begin a new history with the mesh as it is"
            ),
            Self::OtherScheme { made, asked } => {
                write!(f, "on a hierarchy {asked} cannot follow {made}; begin a new history with the mesh as it is")
            }
            Self::NoStar { vertex, level, birth } => {
                write!(
                    f,
                    "{vertex} was made at level {birth} and has no star at level {level}; ask for {birth} or more"
                )
            }
            Self::NotAsked { vertex, level } => {
                write!(f, "nobody asks for the star of {vertex} at level {level}, so it cannot be given up")
            }
            Self::NoVertex(v) => write!(f, "the selection names {v}, which does not exist"),
            Self::NoEdge(edge) => write!(f, "the selection names the edge {edge}, which does not exist"),
            Self::NoFace(face) => write!(f, "the selection names the face {face}, which does not exist"),
            Self::SemiSharp => {
                write!(
                    f,
                    "the scheme cannot blend masks for semi-sharp edges and vertices; make them infinitely sharp or smooth"
                )
            }
            Self::NonFinite(v) => write!(f, "the new position of {v} is not finite; scale the mesh down"),
            Self::Cancelled => write!(f, "cancelled"),
        }
    }
}

impl std::error::Error for RefineError {}
