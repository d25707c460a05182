//! A step of the whole mesh by the masks of the mesh before it, if that was refined as a whole in every step.

use glam::DVec3;

use super::masks::odd;
use crate::error::RefineError;
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::scheme::{Sqrt3, WeightedSum};
use crate::split::whole::trisect::{Whole, cuts_boundary};
use crate::step::{Lineage, SplitKind};
use crate::subdivide::positions::NO_POSITION;
use crate::subdivide::{Control, Request, Step, whole};

/// Refines the whole mesh, with the result of [`masks`](super::masks).
pub(super) fn step(scheme: &Sqrt3, request: Request<'_, '_>) -> Result<Step, RefineError> {
    let Request { mesh, history, selection, scratch, control, .. } = request;
    if history.has_motions() {
        return Err(RefineError::OtherPositions);
    }
    let (old, faces, boundary) = (mesh.vertex_count(), mesh.face_count(), mesh.rotation().boundary_edge_count());
    // Each triangle has a new vertex, or two on its boundary edge.
    let cut = if cuts_boundary(history) { boundary } else { 0 };
    let all = old + faces + cut;
    control.allow(all, faces, 2 * faces)?;
    let split = Whole::new(mesh.rotation(), history);
    let new_positions = positions(scheme, mesh, &split, cut > 0, control)?;

    // From here on nothing can fail.
    let followed = whole::follow(&split, selection, old, scratch);
    let rings = split.rings();
    let (rotation, positions, _) = mesh.parts_mut();
    *positions = new_positions;
    rotation.replace_rings(rings, 3 * faces, boundary + 2 * cut);
    history.record_whole(SplitKind::Trisect, all, whole::max_valence(rotation, old, 6));
    Ok(Step {
        selection: followed,
        selected: selection.vertices().len(),
        region: old,
        split_edges: cut,
        passes: 1,
        ..Step::default()
    })
}

fn positions(
    scheme: &Sqrt3,
    mesh: &Mesh,
    split: &Whole<'_>,
    is_cut: bool,
    control: &mut Control<'_>,
) -> Result<Vec<DVec3>, RefineError> {
    let (around, old) = (mesh.neighborhood(), mesh.positions());
    let even = |v| {
        // Isolated vertices stay, and those on a boundary unless it is cut.
        if mesh.ring(v).valence() == 0 || (mesh.is_boundary(v) && !is_cut) {
            return old[v.index()];
        }
        let mut sum = WeightedSum::new(|v: VertexId| old[v.index()]);
        scheme.even(around, v, &mut sum);
        sum.total().unwrap_or(NO_POSITION)
    };
    let new = |lineage| {
        let mut sum = WeightedSum::new(|v: VertexId| old[v.index()]);
        odd(scheme, around, lineage, &mut sum);
        sum.total().unwrap_or(NO_POSITION)
    };
    let blamed = |lineage: Lineage| lineage.vertices().next().expect("a new vertex is made of old ones");
    whole::positions(split, old, Some(even), new, blamed, control)
}
