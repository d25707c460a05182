//! Simple triangulation (Amresh, Farin & Razdan 2002).

use super::AdaptiveMethod;
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::step::Region;

/// Refines the faces inside the selection and closes the cracks around them.
///
/// The edges that close cracks stay and are refined with the rest, so the surface differs from that of uniform refinement
/// from the second step on, and valences grow at the border of the selection. It is here to be compared with.
/// Source: `[amresh2002]`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Simple;

impl AdaptiveMethod for Simple {
    fn region(&self, _mesh: &Mesh, selection: &Selection, scratch: &mut Scratch) -> Region {
        let mut vertices = scratch.take_list();
        vertices.extend_from_slice(selection.vertices());
        Region::induced(vertices)
    }

    fn promises_exactness(&self) -> bool {
        false
    }
}
