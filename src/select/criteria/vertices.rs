//! Vertices by their ids.

use std::fmt;

use super::{Criterion, check};
use crate::error::SelectError;
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The vertices of a list, which may be empty.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Vertices {
    selection: Selection,
}

impl Vertices {
    /// The vertices of a set.
    #[must_use]
    pub fn new(selection: Selection) -> Self {
        Self { selection }
    }
}

/// In any order, with repetitions.
impl FromIterator<VertexId> for Vertices {
    fn from_iter<I: IntoIterator<Item = VertexId>>(vertices: I) -> Self {
        Self::new(vertices.into_iter().collect())
    }
}

impl Criterion for Vertices {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        check(&self.selection, mesh)?;
        Ok(self.selection.clone())
    }
}

/// As an expression has it, ascending: `vertices:1,2,3`; `vertices:` if there is none.
impl fmt::Display for Vertices {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("vertices:")?;
        for (k, v) in self.selection.vertices().iter().enumerate() {
            let separator = if k == 0 { "" } else { "," };
            write!(f, "{separator}{}", v.index())?;
        }
        Ok(())
    }
}
