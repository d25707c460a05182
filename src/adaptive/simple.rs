//! Simple triangulation (Amresh, Farin & Razdan 2002).

use super::AdaptiveMethod;
use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::{Elements, Selection};
use crate::step::Region;

/// Refines the faces inside the selection and closes the cracks around them.
///
/// Of vertices it splits every edge between two of them; of edges these; of faces all their edges. Only in the last two cases
/// can a face have two split edges, which then asks for a [diagonal](crate::split::Diagonal).
///
/// The edges that close cracks stay and are refined with the rest, so the surface differs from that of uniform refinement
/// from the second step on, and valences grow at the border of the selection. It is here to be compared with.
/// Source: `[amresh2002]`.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Simple;

impl AdaptiveMethod for Simple {
    fn region(&self, _mesh: &Mesh, selection: &Selection, scratch: &mut Scratch) -> Region {
        match selection.elements() {
            Elements::Vertices(selected) => {
                let mut vertices = scratch.take_list();
                vertices.extend_from_slice(selected);
                Region::induced(vertices)
            }
            Elements::Edges(edges) => Region::edges(edges.iter().copied()),
            Elements::Faces(faces) => Region::edges(faces.iter().flat_map(|face| face.edges())),
        }
    }

    fn promises_exactness(&self) -> bool {
        false
    }
}
