//! Steps of a mesh that lies over another: it is split where the one below was split, and nowhere else.
//!
//! Such a mesh is the mesh below cut along some edges (see [`crate::attributes`]). It has no positions of its own: what a
//! step makes of its values a follower sees.

use super::hierarchy::GrownOver;
use super::{Control, Subdivider, bisect, trisect};
use crate::error::RefineError;
use crate::id::Triangle;
use crate::mesh::Mesh;
use crate::scheme::AnyScheme;
use crate::scratch::Scratch;
use crate::split::bisect::Seed;
use crate::step::History;

impl Subdivider {
    /// Shows the follower how values are made where a hierarchy has grown over that of the mesh below.
    pub(crate) fn show_over(&self, grown: &GrownOver<'_>, control: &mut Control<'_>) {
        grown.show(&self.scheme, control);
    }

    /// Bisects what lies over what a step of 4-8 bisected. The history of the mesh has the blocks of the one below; new
    /// vertices come in the order of the seeds.
    pub(crate) fn bisect_over(
        &self,
        mesh: &mut Mesh,
        history: &mut History,
        seeds: impl Iterator<Item = Seed> + Clone,
        scratch: &mut Scratch,
        control: &mut Control<'_>,
    ) -> Result<(), RefineError> {
        match &self.scheme {
            AnyScheme::FourEight(scheme) => bisect::step_over(scheme, mesh, history, seeds, scratch, control),
            _ => unreachable!("other schemes do not bisect"),
        }
    }

    /// Whether √3 can split a triangle before any other one.
    pub(crate) fn can_trisect(&self, mesh: &Mesh, history: &History, triangle: Triangle) -> bool {
        trisect::can_split(self.promises_exactness(), mesh, history, triangle)
    }

    /// Splits these triangles as √3 does, each of which can be; new vertices come in their order.
    pub(crate) fn trisect_over(
        &self,
        mesh: &mut Mesh,
        history: &mut History,
        triangles: Vec<Triangle>,
        scratch: &mut Scratch,
        control: &mut Control<'_>,
    ) -> Result<(), RefineError> {
        match &self.scheme {
            AnyScheme::Sqrt3(scheme) => {
                let exact = self.promises_exactness();
                trisect::step_over(scheme, exact, mesh, history, triangles, scratch, control)
            }
            _ => unreachable!("other schemes do not trisect"),
        }
    }
}
