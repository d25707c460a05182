//! What is wrong with a mesh or with faces read from a file, as data.
//!
//! [`conformity`] looks at a list of faces, leniently: whatever stands in it, it answers with [`Finding`]s. It is the last
//! stage after a refinement and the first look at a file of unknown making. [`balance`] compares the levels of
//! neighbouring triangles.
//!
//! Read in this order: [`Finding`] and [`FindingKind`], [`Report`], [`conformity`], [`balance`].
//!
//! **Deliberately not here**: repair, and the invariants of the rings themselves ([`crate::rotation`]).

mod balance;
mod conformity;
mod geometry;

pub use balance::{Sharing, balance};
pub use conformity::{Report, conformity, mesh_conformity};

use std::fmt;

use crate::id::VertexId;

/// Which rule is broken. The order is that of a report.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[non_exhaustive]
pub enum FindingKind {
    /// A boundary vertex lies on the inside of a boundary edge.
    TJunction,
    /// A thin triangular gap between an edge and a vertex that belongs on it.
    Crack,
    /// An edge with three or more faces.
    NonManifoldEdge,
    /// A vertex whose faces form two or more fans that meet in it alone.
    BowTie,
    /// Two faces run along their common edge in the same direction.
    Orientation,
    /// A component of one-sided faces: no turning of faces round makes them agree.
    NonOrientable,
    /// A face stands in the list already.
    DuplicateFace,
    /// A face names a vertex twice, or has fewer than three corners.
    DegenerateFace,
    /// A vertex without a face.
    IsolatedVertex,
    /// A coordinate is not a finite number.
    NonFinite,
    /// A face names a vertex that does not exist.
    IndexOutOfRange,
    /// More vertices than 32-bit ids can name.
    TooManyVertices,
    /// Triangles next to each other differ by more than one level.
    LevelBalance,
}

impl FindingKind {
    /// The name that stands in reports, such as `t_junction`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::TJunction => "t_junction",
            Self::Crack => "crack",
            Self::NonManifoldEdge => "non_manifold_edge",
            Self::BowTie => "bow_tie",
            Self::Orientation => "orientation",
            Self::NonOrientable => "non_orientable",
            Self::DuplicateFace => "duplicate_face",
            Self::DegenerateFace => "degenerate_face",
            Self::IsolatedVertex => "isolated_vertex",
            Self::NonFinite => "non_finite",
            Self::IndexOutOfRange => "index_out_of_range",
            Self::TooManyVertices => "too_many_vertices",
            Self::LevelBalance => "level_balance",
        }
    }

    /// Whether a mesh with such a finding can still be conforming: only isolated vertices do no harm.
    #[must_use]
    pub fn is_harmless(self) -> bool {
        self == Self::IsolatedVertex
    }
}

impl fmt::Display for FindingKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// One broken rule and where it is broken.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Finding {
    /// Which rule is broken.
    pub kind: FindingKind,
    /// What is wrong, in a sentence with the ids.
    pub message: String,
    /// The vertices concerned: the ends of the edge first, then the others.
    pub vertices: Vec<VertexId>,
    /// The faces concerned, by their place in the list, ascending; of a [`Mesh`](crate::Mesh) in the order of
    /// [`Mesh::triangles`](crate::Mesh::triangles).
    pub faces: Vec<usize>,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}
