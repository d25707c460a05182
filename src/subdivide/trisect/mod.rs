//! A step of √3: which triangles are split, and where what is new goes.
//!
//! The triangles of a step are those with all corners in its region. One that [lags](crate::split::trisect) is not split;
//! the triangle across its mate is, inside of the region or not, and if that lags in turn, the one across its own mate. This
//! goes down in level, so it ends. As no triangle that lags is ever split, triangles that share an edge never differ by more
//! than one level, half levels counted; and nothing is ever to be closed.
//!
//! **Methods that promise exactness** apply the masks of the mesh before the step, see `masks`. For a selection that begins
//! on a uniform mesh, and then lies in the one that follows the step before, every r ≥ 1 of
//! [`Incremental`](crate::adaptive::Incremental) gives each selected vertex the position, the neighbours in order, and their
//! positions as after uniform steps, bit for bit.
//!
//! *Proof.* Call a vertex exact if all that holds of it; in a uniform mesh every vertex is. Let v be selected, and exact. Its
//! triangles are those of uniform refinement, so none lags, and all are split, as their corners are within one edge of v.
//! Then the new position of v and the vertices that are new around it are functions of its star, but for the thirds of a
//! boundary edge ab opposite to v, which are functions of the stars of a and b. These are exact: v was made in the step before
//! in a triangle with the edge ab, and either the mesh was uniform after that step, or a and b were selected before it. What
//! is new in a triangle of selected corners has for neighbours these corners, its twin if it is a third, and what is new
//! across the edges of the triangle: all are functions of the corners' stars. ∎ Without a ring it fails, as the triangles
//! around v are not all split.
//!
//! **Other methods** (*simple*, the adaptive scheme of Kobbelt) put every vertex where it is at the level that a triangle
//! needs, in closed form, see `passes`.
//!
//! **Deliberately not here**: rings ([`crate::split`]), weights ([`crate::scheme`]).

mod closed_form;
mod masks;
mod passes;
mod points;
mod whole;

use super::whole::is_plain;
use super::{Control, Request, Step};
use crate::error::RefineError;
use crate::id::{Edge, Triangle, VertexId};
use crate::mesh::Mesh;
use crate::rotation::RotationSystem;
use crate::scheme::Sqrt3;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::split::trisect::{Face, Levels, Plan, across_mate};
use crate::step::{History, Region, RegionKind, SplitKind};

/// Refines the triangles inside of a region; `exact` if its method promises exactness.
pub(super) fn step(scheme: &Sqrt3, exact: bool, request: Request<'_, '_>) -> Result<Step, RefineError> {
    if exact && is_plain(&request) {
        return whole::step(scheme, request);
    }
    let Request { mesh, history, selection, region, scratch, control } = request;
    let mut buffers = scratch.take::<Buffers>();
    let Buffers { plan, inside, masks } = &mut *buffers;
    let vertices = region.vertices(mesh.vertex_count());
    list_triangles(mesh.rotation(), region, &vertices, scratch, inside);
    let split = if exact {
        masks::split(scheme, mesh, history, inside, plan, masks, control)
    } else {
        passes::split(scheme, mesh, history, inside, plan, control)
    };
    let step = split.map(|max_valence| {
        let made = plan.faces().iter().flat_map(|face| face.made().map(|(_, lineage)| (face.level, lineage)));
        history.record(SplitKind::Trisect, mesh.vertex_count(), made, &[], max_valence);
        Step {
            selection: follow(selection, plan.faces(), mesh.vertex_count(), scratch),
            selected: selection.vertices().len(),
            region: vertices.len(),
            split_edges: plan.faces().iter().filter(|face| face.cutting().is_some()).count(),
            passes: 1,
            ..Step::default()
        }
    });
    scratch.give(buffers);
    step
}

/// Splits triangles of a mesh that lies over another, each of which [`can_split`].
pub(super) fn step_over(
    scheme: &Sqrt3,
    exact: bool,
    mesh: &mut Mesh,
    history: &mut History,
    mut triangles: Vec<Triangle>,
    scratch: &mut Scratch,
    control: &mut Control<'_>,
) -> Result<(), RefineError> {
    let mut buffers = scratch.take::<Buffers>();
    let Buffers { plan, masks, .. } = &mut *buffers;
    let split = if exact {
        masks::split(scheme, mesh, history, &mut triangles, plan, masks, control)
    } else {
        passes::split(scheme, mesh, history, &triangles, plan, control)
    };
    let step = split.map(|max_valence| {
        let made = plan.faces().iter().flat_map(|face| face.made().map(|(_, lineage)| (face.level, lineage)));
        history.record(SplitKind::Trisect, mesh.vertex_count(), made, &[], max_valence);
    });
    scratch.give(buffers);
    step
}

/// Whether a triangle can be split before any other is.
pub(super) fn can_split(exact: bool, mesh: &Mesh, history: &History, triangle: Triangle) -> bool {
    let levels = Levels::before(history, mesh.vertex_count(), Vec::new());
    if exact {
        return across_mate(mesh.rotation(), levels.state(triangle)).is_none();
    }
    passes::needed(mesh.rotation(), &levels, triangle).is_none()
}

/// What a step needs while it is made, kept from step to step.
#[derive(Default)]
struct Buffers {
    plan: Plan,
    inside: Vec<Triangle>,
    masks: masks::Buffers,
}

/// Lists the triangles inside of a region, in order of (smallest corner, slot).
fn list_triangles(
    rotation: &RotationSystem,
    region: &Region,
    vertices: &[VertexId],
    scratch: &mut Scratch,
    list: &mut Vec<Triangle>,
) {
    list.clear();
    let of = |v: &VertexId| rotation.triangles_of_smallest(*v);
    match region.kind() {
        RegionKind::Stars(_) => unreachable!("only the split in four is made around vertices"),
        RegionKind::Everything => list.extend(rotation.triangles()),
        RegionKind::Induced(_) => {
            let marks = scratch.marked(rotation.vertex_count(), vertices);
            let inside = |triangle: &Triangle| triangle.corners().iter().all(|&v| marks.is_set(v));
            list.extend(vertices.iter().flat_map(of).filter(inside));
        }
        RegionKind::Edges(edges) => {
            let has = |a, b| edges.binary_search(&Edge::new(a, b)).is_ok();
            let inside = |triangle: &Triangle| {
                let [a, b, c] = triangle.corners();
                has(a, b) && has(b, c) && has(c, a)
            };
            list.extend(vertices.iter().flat_map(of).filter(inside));
        }
    }
}

/// S' = S and every new vertex in a triangle with all corners in S'. O(S and what was split).
fn follow(selection: &Selection, faces: &[Face], vertex_count: usize, scratch: &mut Scratch) -> Selection {
    let mut vertices = scratch.take_list();
    vertices.extend_from_slice(selection.vertices());
    let mut marks = scratch.marked(vertex_count, selection.vertices());
    for face in faces {
        if face.corners.iter().all(|&v| marks.is_set(v)) {
            for (x, _) in face.made() {
                marks.set(x, 0);
                vertices.push(x);
            }
        }
    }
    Selection::ascending(vertices)
}
