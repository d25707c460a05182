//! Incremental subdivision (Pakdel & Samavati 2007).

use super::AdaptiveMethod;
use crate::error::ConfigError;
use crate::mesh::Mesh;
use crate::query::expand;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::step::Region;

/// Refines the selection S with all vertices within r edges of it, E^r(S), ends of edges and corners of faces included, so that the surface over S is exactly that of
/// refining everything.
///
/// # Guarantees
/// If each selection lies in the one that follows the step before (S' = S with the new vertices between two of its own),
/// then for every r >= 1 and every number of steps each selected vertex has the same position, the same neighbours in the
/// same order and the same neighbour positions as in the uniform mesh, bit for bit, for Loop and both Butterflies. The
/// [certificate](crate::certify) tells what holds for other sequences. For what holds of 4-8 see
/// [`FourEight`](crate::scheme::FourEight). Source: `[incremental]`, section IV.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Incremental {
    rings: usize,
}

impl Incremental {
    /// Expansion by `rings` rings.
    ///
    /// # Errors
    /// If `rings` is 0: that is [`Simple`](super::Simple).
    pub fn new(rings: usize) -> Result<Self, ConfigError> {
        if rings == 0 {
            return Err(ConfigError {
                name: "rings",
                value: "0".into(),
                expected: "at least 1; without a ring the method is `simple`".into(),
            });
        }
        Ok(Self { rings })
    }

    /// By how many rings a selection is expanded.
    #[must_use]
    pub fn rings(self) -> usize {
        self.rings
    }
}

impl AdaptiveMethod for Incremental {
    fn region(&self, mesh: &Mesh, selection: &Selection, scratch: &mut Scratch) -> Region {
        let mut vertices = scratch.take_list();
        vertices.extend_from_slice(selection.vertices());
        expand(mesh.rotation(), &mut vertices, self.rings, scratch);
        Region::induced(vertices)
    }

    fn promises_exactness(&self) -> bool {
        true
    }
}
