//! Everything, always.

use super::AdaptiveMethod;
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::step::Region;

/// Refines the whole mesh; the selection is only followed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Uniform;

impl AdaptiveMethod for Uniform {
    fn region(&self, _mesh: &Mesh, _selection: &Selection, _scratch: &mut Scratch) -> Region {
        Region::everything()
    }

    fn promises_exactness(&self) -> bool {
        true
    }
}
