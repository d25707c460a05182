//! A step of plain red-green refinement.
//!
//! The leaves with all corners in the selection, or in which a selected face lies, are split in four (*red*), and so is, to a fixed point, every leaf of which
//! two edges would be split or one twice. Leaves with one split edge are bisected (*green*) until the next step, which takes
//! that back first. Positions come from masks on the mesh as it is, green edges and all: those of all corners of red leaves,
//! and of new vertices. So nothing is exact by itself; what the certificate proves is. Source: `[bank1983]`.
//!
//! **Deliberately not here**: which leaves need to be split ([`crate::split::hierarchy`]).

use super::quadrisect::Quadrisection;
use super::{Control, Request, Step, parts};
use crate::error::RefineError;
use crate::id::{Edge, VertexId};
use crate::mesh::Mesh;
use crate::rotation::RotationSystem;
use crate::scheme::Scheme;
use crate::scratch::Scratch;
use crate::select::{Elements, Selection};
use crate::split::hierarchy::{Levels, Red, leaf_of, show};
use crate::split::quadrisect::{Closing, Plan};
use crate::step::{Hierarchy, History, Region};

/// Makes one step for a selection.
pub(super) fn step<S: Scheme + Sync>(
    quadrisection: &Quadrisection<'_, S>,
    mesh: &mut Mesh,
    history: &mut History,
    selection: &Selection,
    scratch: &mut Scratch,
    control: &mut Control<'_>,
) -> Result<Step, RefineError> {
    let mut hierarchy = history.take_hierarchy(mesh.vertex_count());
    let selected = match selection.elements() {
        Elements::Faces(faces) => parts::leaves(&hierarchy, faces),
        _ => leaves_inside(mesh, &hierarchy, selection, scratch),
    };
    let red = Red::closure(Levels::new(mesh.rotation(), &hierarchy), selected.iter().copied());
    let first = mesh.vertex_count();
    let step = if red.edges.keys().any(|edge| hierarchy.level_of(edge.ends()) == u8::MAX) {
        Err(RefineError::TooDeep)
    } else {
        let region = Region::edges(red.edges.keys().copied());
        let corners = selection.to_vertices();
        let request = Request {
            mesh: &mut *mesh,
            history: &mut *history,
            selection: &corners,
            region: &region,
            scratch: &mut *scratch,
            control,
        };
        quadrisection.refine_by(request, |mesh, plan, closing, scratch| {
            let (rotation, ..) = mesh.parts_mut();
            let made = plan.odd().map(|(x, split)| (x, split.edge()));
            red.split(rotation, &mut hierarchy, made);
            redraw(rotation, &hierarchy, plan, closing, scratch);
        })
    };
    let followed = step.map(|step| {
        let followed = match selection.elements() {
            Elements::Faces(_) => parts::shown(&hierarchy, mesh.rotation(), selected),
            _ => step.selection.union(&older_between(&hierarchy, &red, selection, first)),
        };
        Step { selection: followed, passes: red.passes, ..step }
    });
    history.keep_hierarchy(hierarchy);
    followed
}

/// The leaves with all corners in the selection; some come more than once.
fn leaves_inside(
    mesh: &Mesh,
    hierarchy: &Hierarchy,
    selection: &Selection,
    scratch: &mut Scratch,
) -> Vec<[VertexId; 3]> {
    let marks = scratch.marked(mesh.vertex_count(), selection.vertices());
    let around = selection.vertices().iter().flat_map(|&v| mesh.rotation().triangles_around(v));
    let leaves = around.map(|triangle| leaf_of(hierarchy, triangle));
    leaves.filter(|leaf| leaf.iter().all(|&v| marks.is_set(v))).collect()
}

/// Writes the rings that new vertices changed, and says in `closing` what closes cracks there.
fn redraw(
    rotation: &mut RotationSystem,
    hierarchy: &Hierarchy,
    plan: &Plan,
    closing: &mut Closing,
    scratch: &mut Scratch,
) {
    closing.clear();
    let new: Vec<VertexId> = plan.odd().map(|(x, _)| x).collect();
    let mut reached = scratch.take_list();
    show(rotation, hierarchy, &new, scratch, |v, shown| {
        reached.push(v);
        closing.t_vertices.extend((shown.hangs && v.index() >= plan.first).then_some(v));
    });
    closing.t_vertices.sort_unstable();
    closing.max_valence = reached.iter().map(|&v| rotation.valence(v)).max().unwrap_or(0);
    scratch.give_list(reached);
    let levels = Levels::new(rotation, hierarchy);
    for &x in &closing.t_vertices {
        let beside = levels.triangles_beside(x).into_iter().flatten();
        let green = beside.filter(|&triangle| !hierarchy.is_split(triangle));
        let opposite = green.map(|[_, _, o]| o);
        for o in opposite {
            closing.edges.push(Edge::new(o, x));
            closing.o_vertices.push(o);
        }
    }
    closing.o_vertices.sort_unstable();
    closing.o_vertices.dedup();
}

/// The vertices made before that now are corners of red triangles, between two selected vertices. A leaf that was bisected
/// gets three new corners, of which one was there.
fn older_between(hierarchy: &Hierarchy, red: &Red, selection: &Selection, first: usize) -> Selection {
    let sides = red.leaves.iter().flat_map(|leaf| {
        let [a, b, c] = leaf.corners();
        [[a, b], [b, c], [c, a]]
    });
    let inside = sides.filter(|ends| ends.iter().all(|&end| selection.contains(end)));
    inside.filter_map(|[a, b]| hierarchy.odd(a, b)).filter(|x| x.index() < first).collect()
}
