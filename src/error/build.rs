//! Faces do not make a mesh.

use std::fmt;

use crate::id::VertexId;

/// What kind of defect stands in a list of faces.
///
/// Orientation is apart from non-manifold: the first can be mended by turning faces round, the second can not.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
#[non_exhaustive]
pub enum DefectKind {
    /// A face names a vertex that does not exist.
    IndexOutOfRange,
    /// A coordinate is not a finite number.
    NonFinite,
    /// A face names a vertex twice, or has fewer than three corners.
    DegenerateFace,
    /// A face stands in the list already, with the same corners in the same circular order or its reverse.
    DuplicateFace,
    /// An edge with three or more faces.
    NonManifoldEdge,
    /// A vertex whose faces form two or more fans that meet in it alone.
    BowTie,
    /// Two faces run along their common edge in the same direction; turning faces round would mend it.
    Orientation,
    /// A component of one-sided faces: no turning of faces round makes them agree.
    NonOrientable,
    /// A face of more than three sides where triangles are needed.
    NotTriangle,
    /// More vertices than 32-bit ids can name.
    TooManyVertices,
}

/// One defect and where it is.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Defect {
    /// What is wrong.
    pub kind: DefectKind,
    /// The vertices concerned: the vertex, or the ends of the edge, or the corners of the face. For an index out of
    /// range none, as there is no such vertex.
    pub vertices: Vec<VertexId>,
    /// The faces concerned, by their place in the list, ascending.
    pub faces: Vec<usize>,
    /// What is wrong, in a sentence with the ids.
    pub message: String,
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

/// Faces do not make an oriented 2-manifold: every reason, in the order of [`DefectKind`], then by ids.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct BuildError {
    defects: Vec<Defect>,
}

impl BuildError {
    pub(crate) fn new(defects: Vec<Defect>) -> Self {
        debug_assert!(!defects.is_empty());
        Self { defects }
    }

    /// The error that these defects are, for faces that a mesh is not built from directly; `None` if there is no defect.
    #[must_use]
    pub fn from_defects(defects: Vec<Defect>) -> Option<Self> {
        (!defects.is_empty()).then(|| Self::new(defects))
    }

    /// All defects.
    #[must_use]
    pub fn defects(&self) -> &[Defect] {
        &self.defects
    }

    /// Whether turning some faces round would mend all of it.
    #[must_use]
    pub fn is_mended_by_orienting(&self) -> bool {
        self.defects.iter().all(|defect| defect.kind == DefectKind::Orientation)
    }
}

/// How many defects the message names; the rest are counted.
const NAMED: usize = 5;

impl fmt::Display for BuildError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "not an oriented manifold of triangles: ")?;
        for (k, defect) in self.defects.iter().take(NAMED).enumerate() {
            let separator = if k == 0 { "" } else { "; " };
            write!(f, "{separator}{defect}")?;
        }
        if self.defects.len() > NAMED {
            write!(f, "; and {} more", self.defects.len() - NAMED)?;
        }
        if self.is_mended_by_orienting() {
            write!(f, "; turning faces round so that they agree would mend it")?;
        } else if self.defects.iter().any(|defect| defect.kind == DefectKind::Orientation) {
            write!(f, "; turning faces round would mend the orientation only")?;
        }
        Ok(())
    }
}

impl std::error::Error for BuildError {}
