//! Faces by their numbers.

use std::fmt;
use std::sync::Arc;

use super::{Criterion, check};
use crate::error::SelectError;
use crate::id::Triangle;
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::selection::Selection;

/// The faces with these numbers, of which there may be none.
///
/// A mesh does not number its faces. So the numbers are places, from 0, in a [list](Faces::numbered_by), as of the faces in
/// the order of a file; without one in the order of [`Mesh::triangles`]. Faces by their names, without numbers, are selected
/// by a closure.
///
/// ```
/// use vvmesh::scratch::Scratch;
/// use vvmesh::select::{Criterion, Faces, Selection};
/// use vvmesh::{Triangle, VertexId, shapes};
///
/// let mesh = shapes::octahedron();
/// let reversed: Vec<Triangle> = mesh.triangles().collect::<Vec<_>>().into_iter().rev().collect();
/// let first = Faces::new([0]).numbered_by(reversed.clone());
/// let last = Faces::new([7]);
/// assert_eq!(first.select(&mesh, &mut Scratch::new())?, last.select(&mesh, &mut Scratch::new())?);
/// # Ok::<(), vvmesh::error::SelectError>(())
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Faces {
    /// Ascending, each once.
    numbers: Vec<usize>,
    list: Option<Arc<[Triangle]>>,
}

impl Faces {
    /// The faces with these numbers, which come in any order, with repetitions.
    #[must_use]
    pub fn new(numbers: impl IntoIterator<Item = usize>) -> Self {
        let mut numbers: Vec<usize> = numbers.into_iter().collect();
        numbers.sort_unstable();
        numbers.dedup();
        Self { numbers, list: None }
    }

    /// The same with the numbers that faces have in this list.
    #[must_use]
    pub fn numbered_by(mut self, list: impl Into<Arc<[Triangle]>>) -> Self {
        self.list = Some(list.into());
        self
    }
}

/// Complexity: O(n log n) with n numbers, and without a list O(faces).
impl Criterion for Faces {
    fn select(&self, mesh: &Mesh, _: &mut Scratch) -> Result<Selection, SelectError> {
        let order;
        let list = match &self.list {
            Some(list) => list,
            None => {
                order = mesh.triangles().collect::<Vec<_>>();
                order.as_slice()
            }
        };
        let face_of = |&number: &usize| {
            let face_count = list.len();
            list.get(number).copied().ok_or(SelectError::NoFaceNumber { number, face_count })
        };
        let selection = self.numbers.iter().map(face_of).collect::<Result<Selection, _>>()?;
        check(&selection, mesh)?;
        Ok(selection)
    }
}

/// As an expression has it, ascending: `faces:1,2,3`; `faces:` if there is none.
impl fmt::Display for Faces {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("faces:")?;
        for (k, number) in self.numbers.iter().enumerate() {
            let separator = if k == 0 { "" } else { "," };
            write!(f, "{separator}{number}")?;
        }
        Ok(())
    }
}
