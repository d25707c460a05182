//! What static/mobile subdivision remembers from step to step.
//!
//! **Deliberately not here**: which vertices are mobile; see [`crate::subdivide`].

use crate::id::{Triangle, VertexId};
use crate::rotation::RotationSystem;

/// Who may still move, and which faces will not be split any more.
///
/// Every face that the last step made has a corner that may move, and around such a vertex all faces are of the last step. So
/// those faces need no list, and those that are on one stay as they are, whatever edges close cracks in them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mobility {
    /// After how many steps of the run it was so.
    pub(crate) step: usize,
    /// The vertices that may move, ascending.
    pub(crate) candidates: Vec<VertexId>,
    /// The faces without a corner that may move.
    pub(crate) settled: Vec<Triangle>,
}

impl Mobility {
    /// The faces of the last step, each at its first corner that may move; in the order of those, then of their rings.
    pub(crate) fn open_faces(&self, rotation: &RotationSystem) -> impl Iterator<Item = Triangle> {
        let is_candidate = |v: VertexId| self.candidates.binary_search(&v).is_ok();
        self.candidates.iter().flat_map(move |&v| {
            let comes_first =
                move |triangle: &Triangle| triangle.corners().into_iter().all(|w| v <= w || !is_candidate(w));
            rotation.triangles_around(v).filter(comes_first)
        })
    }

    /// All faces, the settled ones first.
    pub(crate) fn faces(&self, rotation: &RotationSystem) -> impl Iterator<Item = Triangle> {
        self.settled.iter().copied().chain(self.open_faces(rotation))
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        self.candidates.capacity() * size_of::<VertexId>() + self.settled.capacity() * size_of::<Triangle>()
    }
}
