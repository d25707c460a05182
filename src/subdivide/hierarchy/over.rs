//! Values of a mesh that lies over another, after a step on a hierarchy.

use super::follow;
use super::patch::View;
use super::sharpness::LevelTags;
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::scheme::{AnyScheme, with_scheme};
use crate::split::hierarchy::Levels;
use crate::step::Refinement;
use crate::subdivide::Control;

/// A mesh whose hierarchy has grown over that of another mesh.
pub(crate) struct GrownOver<'a> {
    pub(crate) mesh: &'a Mesh,
    pub(crate) refinement: &'a Refinement,
    /// How many vertices there were before.
    pub(crate) first: usize,
    /// What is new, as in [`Growth`](crate::split::hierarchy::Growth).
    pub(crate) steps: &'a [(VertexId, u8)],
    /// At which level those vertices are shown of which this may be new.
    pub(crate) shown: &'a [(VertexId, u8)],
    /// The vertex below each vertex.
    pub(crate) base: &'a [VertexId],
    /// The mesh below with its hierarchy.
    pub(crate) below: (&'a Mesh, &'a Refinement),
}

impl GrownOver<'_> {
    /// Shows the follower by which masks the values of what is new are made.
    pub(in crate::subdivide) fn show(&self, scheme: &AnyScheme, control: &mut Control<'_>) {
        let (mesh, below) = self.below;
        let tags = LevelTags::new(Levels::new(mesh.rotation(), &below.hierarchy), &below.input_tags);
        let view = View::over(self.mesh, self.refinement, &tags, self.base);
        let shown = || self.shown.iter().copied();
        with_scheme!(
            scheme,
            scheme => control.show(self.first, self.mesh.vertex_count(), |masks| {
                follow::show(scheme, view, self.steps, shown(), masks);
            }),
            else unreachable!("other schemes are refused")
        );
    }
}
