//! What a run on a hierarchy remembers.

use std::collections::BTreeSet;

use super::{Hierarchy, Places};
use crate::id::VertexId;
use crate::mesh::{Mesh, Tags};

/// A hierarchy over the input, where its vertices are, and what is asked for. The mesh that is shown is a function of it.
#[derive(Clone, Debug)]
pub(crate) struct Refinement {
    pub(crate) hierarchy: Hierarchy,
    pub(crate) places: Places,
    /// The stars that somebody asked for, by vertex and level, above level 0. Empty for methods that only split.
    pub(crate) asked: BTreeSet<(VertexId, u8)>,
    /// Those of the input, from which those of all levels follow.
    pub(crate) input_tags: Tags,
    /// The name of the scheme that made it.
    pub(crate) scheme: &'static str,
    /// Whether stars are asked for, not triangles, so that they can be given up again.
    pub(crate) goes_back: bool,
    /// Whether any were.
    pub(crate) gave_up: bool,
}

impl Refinement {
    /// Of a mesh that was not refined yet.
    pub(crate) fn new(mesh: &Mesh, scheme: &'static str, goes_back: bool) -> Self {
        Self {
            hierarchy: Hierarchy::new(mesh.vertex_count()),
            places: Places::default(),
            asked: BTreeSet::new(),
            input_tags: mesh.tags().clone(),
            scheme,
            goes_back,
            gave_up: false,
        }
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        self.hierarchy.memory_bytes() + self.places.memory_bytes() + self.asked.len() * size_of::<(VertexId, u8)>()
    }
}
