//! Nothing can be told of a limit surface in advance.

use std::fmt;

use crate::id::VertexId;

/// Why nothing is foretold of a mesh.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub enum PredictError {
    /// A vertex, or an edge at it, is semi-sharp: its rules change from step to step.
    SemiSharp {
        /// The one that stays so longest.
        vertex: VertexId,
        /// After how many steps of the whole mesh nothing is semi-sharp.
        steps: u32,
    },
    /// A coordinate of a vertex, or its distance to the limit, is too great to go on with.
    NonFinite(VertexId),
    /// The mesh comes from steps after which its limit surface is not that of the input everywhere, or of another scheme.
    OtherSteps,
    /// An accuracy is asked for that rounding makes impossible to prove.
    TooFine {
        /// The finest there is.
        finest: f64,
    },
}

impl fmt::Display for PredictError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::SemiSharp { vertex, steps } => write!(
                f,
                "{vertex} is semi-sharp, so nothing is known of its limit yet; refine everything until its sharpness has \
                 faded, after {steps} levels, or make it infinitely sharp or smooth"
            ),
            Self::NonFinite(vertex) => {
                write!(f, "{vertex} is too far out for its distances to be finite numbers; scale the mesh down")
            }
            Self::OtherSteps => write!(
                f,
                "the mesh was not made by uniform steps of the scheme, nor by steps on a hierarchy, so the limit surface of \
                 the input is not known any more"
            ),
            Self::TooFine { finest } => {
                write!(
                    f,
                    "the accuracy is finer than rounding allows for coordinates of this size; ask for more than {finest:e}"
                )
            }
        }
    }
}

impl std::error::Error for PredictError {}
