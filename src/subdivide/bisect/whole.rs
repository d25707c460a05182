//! A step of the whole mesh, if that was refined as a whole in every step, from the second one on.
//!
//! All positions are of one generation, and so are their masks of the mesh before the step.

use glam::DVec3;

use crate::error::RefineError;
use crate::id::{Edge, VertexId};
use crate::mesh::Mesh;
use crate::scheme::{FourEight, WeightedSum};
use crate::split::whole::bisect::{RefinementEdges, Whole};
use crate::step::{History, Parent, SplitKind};
use crate::subdivide::positions::NO_POSITION;
use crate::subdivide::{Control, Request, Step, whole};

/// Refines the whole mesh.
pub(super) fn step(scheme: &FourEight, request: Request<'_, '_>) -> Result<Step, RefineError> {
    let Request { mesh, history, selection, scratch, control, .. } = request;
    let (old, faces) = (mesh.vertex_count(), mesh.face_count());
    let edges = RefinementEdges::new(mesh.rotation(), history);
    let new = edges.count();
    control.allow(old + new, faces, faces)?;
    let split = Whole::new(edges);
    let new_positions = positions(scheme, mesh, history, edges, &split, control)?;

    // From here on nothing can fail.
    let followed = whole::follow(&split, selection, old, scratch);
    let rings = split.rings();
    let sharp = mesh.tags().sharp_edges().into_iter();
    let is_split = |edge: &Edge| {
        let [v, w] = edge.ends();
        edges.contains(v, w)
    };
    let mut sharp: Vec<(VertexId, Edge)> = sharp.filter(is_split).map(|edge| (split.on(edge), edge)).collect();
    sharp.sort_unstable();
    let (rotation, positions, tags) = mesh.parts_mut();
    *positions = new_positions;
    for (x, edge) in sharp {
        tags.split(edge, x);
    }
    // Two triangles on an edge, or one on a boundary.
    let on_boundary = 2 * new - faces;
    rotation.replace_rings(rings, 2 * faces, rotation.boundary_edge_count() + on_boundary);
    history.record_whole(SplitKind::Bisect, old + new, whole::max_valence(rotation, old, 4));
    Ok(Step {
        selection: followed,
        selected: selection.vertices().len(),
        region: old,
        split_edges: new,
        passes: 1,
        ..Step::default()
    })
}

fn positions(
    scheme: &FourEight,
    mesh: &Mesh,
    history: &History,
    edges: RefinementEdges<'_>,
    split: &Whole<'_>,
    control: &mut Control<'_>,
) -> Result<Vec<DVec3>, RefineError> {
    let old = mesh.positions();
    let at = |v: VertexId| old[v.index()];
    let middle = |parent: Parent| {
        let mut sum = WeightedSum::new(at);
        scheme.middle(&parent, &mut sum);
        sum.total().unwrap_or(NO_POSITION)
    };
    // A boundary vertex moves in the steps that split the second edge of two along the boundary, or both.
    let is_second = history.step_count() % 2 == 1;
    let even = |v: VertexId| {
        let ring = mesh.ring(v);
        let neighbors = ring.neighbors();
        match *neighbors {
            [] => at(v),
            [first, .., last] if ring.is_open() => {
                let is_split = [first, last].map(|w| edges.contains(v, w));
                let moves = if is_second { is_split[0] || is_split[1] } else { is_split[0] && is_split[1] };
                if !moves {
                    return at(v);
                }
                // A neighbour stands for what will be there instead.
                let mut sum = WeightedSum::new(|w: VertexId| match w {
                    w if w != v && edges.contains(v, w) => middle(Parent { p: v, q: w, left: None, right: None }),
                    w => at(w),
                });
                scheme.boundary(v, [first, last], &mut sum);
                sum.total().unwrap_or(NO_POSITION)
            }
            [first, ..] => {
                // Exterior edges lead to every neighbour of an apex, of other vertices to the apexes, which alternate.
                let (skipped, step) = match (edges.is_apex(v), edges.is_apex(first)) {
                    (true, _) => (0, 1),
                    (false, true) => (0, 2),
                    (false, false) => (1, 2),
                };
                let mut sum = WeightedSum::new(at);
                scheme.even(v, ring.iter().skip(skipped).step_by(step), &mut sum);
                sum.total().unwrap_or(NO_POSITION)
            }
        }
    };
    whole::positions(split, old, Some(even), middle, |parent| parent.p, control)
}
