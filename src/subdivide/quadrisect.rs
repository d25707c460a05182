//! A step of the split in four: everything at once, or a region in place.
//!
//! Both give the same bits; the first keeps no plan and can share its work out, the second costs what its region costs and
//! tells vertices apart.
//!
//! **Deliberately not here**: rings ([`crate::split`]), weights ([`crate::scheme`]).

use super::whole::follow as follow_whole;
use super::{Request, Step, parts, positions};
use crate::certify::{self, Certificate};
use crate::error::RefineError;
use crate::id::{Edge, VertexId};
use crate::mesh::Mesh;
use crate::rotation::RotationSystem;
use crate::scheme::Scheme;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::split::quadrisect::{self, Closing, Plan};
use crate::split::whole::quadrisect::Whole;
use crate::split::{Diagonal, Quad};
use crate::step::{History, Lineage, SplitKind};

/// How all steps of a run are made.
pub(super) struct Quadrisection<'a, S> {
    pub(super) scheme: &'a S,
    /// Whether the method promises exactness.
    pub(super) exact: bool,
    pub(super) diagonal: Diagonal,
}

impl<S: Scheme + Sync> Quadrisection<'_, S> {
    /// Refines a region, or the whole mesh.
    pub(super) fn step(&self, request: Request<'_, '_>) -> Result<Step, RefineError> {
        let Request { mesh, history, selection, region, .. } = &request;
        let unproven = match Certificate::new(mesh, history) {
            Some(certificate) if self.exact => certificate.unproven(selection, self.scheme.reach()),
            _ => Vec::new(),
        };
        // The short way numbers and places everything alike, but does not say where the new vertices come from.
        let step = if region.is_everything() && !history.tells_vertices_apart() {
            self.refine_whole(request)?
        } else {
            self.refine(request)?
        };
        Ok(Step { unproven, ..step })
    }

    /// Refines the whole mesh.
    fn refine_whole(&self, request: Request<'_, '_>) -> Result<Step, RefineError> {
        let Request { mesh, history, selection, scratch, control, .. } = request;
        let (old, new) = (mesh.vertex_count(), mesh.edge_count());
        control.allow(old + new, mesh.face_count(), 3 * mesh.face_count())?;
        let whole = Whole::new(mesh.rotation(), history);
        let new_positions = positions::of_whole(self.scheme, mesh, &whole, control)?;

        // From here on nothing can fail.
        control.show(old, old + new, |masks| positions::show_whole(self.scheme, mesh, &whole, masks));
        let followed = match selection.is_of_vertices() {
            true => follow_whole(&whole, selection, old, scratch),
            false => parts::follow(selection, |edge| Some(whole.on(edge)), mesh.rotation()),
        };
        let rings = whole.rings();
        let mut sharp: Vec<(VertexId, Edge)> =
            mesh.tags().sharp_edges().into_iter().map(|edge| (whole.on(edge), edge)).collect();
        sharp.sort_unstable();
        let (rotation, positions, tags) = mesh.parts_mut();
        *positions = new_positions;
        // In the order of the new vertices, as when a region is split.
        tags.refine(rotation, sharp.into_iter(), (0..old).map(VertexId::new));
        let max_valence = match new {
            0 => 0,
            edges if edges == rotation.boundary_edge_count() => 4,
            _ => 6,
        };
        rotation.replace_rings(rings, 4 * rotation.triangle_count(), 2 * rotation.boundary_edge_count());
        history.record_whole(SplitKind::Quadrisect, old + new, max_valence);
        let certified = history.exactness_mut().map(|exactness| {
            exactness.advance(old + new, self.scheme.moves_even());
            old + new
        });
        Ok(Step {
            selection: followed,
            selected: selection.vertices().len(),
            region: old,
            split_edges: new,
            passes: 1,
            certified,
            ..Step::default()
        })
    }

    /// Refines a region as it is given.
    fn refine(&self, request: Request<'_, '_>) -> Result<Step, RefineError> {
        self.refine_by(request, |mesh, plan, closing, _| {
            let (rotation, positions, _) = mesh.parts_mut();
            quadrisect::apply(rotation, plan, closing, |quad: Quad, valences| {
                self.diagonal.start(quad, valences, positions)
            });
        })
    }

    /// The same with rings written in another way. The positions are then those after the step, and so are the tags.
    pub(super) fn refine_by(
        &self,
        request: Request<'_, '_>,
        write: impl FnOnce(&mut Mesh, &Plan, &mut Closing, &mut Scratch),
    ) -> Result<Step, RefineError> {
        let Request { mesh, region, control, .. } = &request;
        if region.is_everything() {
            control.allow(mesh.vertex_count() + mesh.edge_count(), mesh.face_count(), 3 * mesh.face_count())?;
        }
        let mut buffers = request.scratch.take::<Buffers>();
        let Request { mesh, history, selection, region, scratch, control } = request;
        let request = Request { mesh, history, selection, region, scratch: &mut *scratch, control };
        let step = self.refine_with(&mut buffers, request, write);
        scratch.give(buffers);
        step
    }

    /// The same with buffers, which lie apart from the scratch.
    fn refine_with(
        &self,
        buffers: &mut Buffers,
        request: Request<'_, '_>,
        write: impl FnOnce(&mut Mesh, &Plan, &mut Closing, &mut Scratch),
    ) -> Result<Step, RefineError> {
        let Request { mesh, history, selection, region, scratch, control } = request;
        let Buffers { plan, levels, positions, handed, closing } = buffers;
        let moving = region.vertices(mesh.vertex_count());
        quadrisect::plan(plan, mesh.rotation(), history, region, &moving, scratch);
        control.allow(plan.first + plan.edges.len(), mesh.face_count(), plan.added_faces)?;
        child_levels(levels, history, plan)?;
        positions::append_odd(self.scheme, mesh, &moving, plan, positions, control)?;

        // From here on nothing can fail.
        let (before, after) = (plan.first, plan.first + plan.edges.len());
        control.show(before, after, |masks| positions::show_region(self.scheme, mesh, &moving, plan, masks));
        if let Some(exactness) = history.exactness_mut() {
            let (reach, moves_even) = (self.scheme.reach(), self.scheme.moves_even());
            certify::before(handed, exactness, mesh, &moving, plan, reach, moves_even);
        }
        for (&v, &position) in moving.iter().zip(&positions.moved) {
            mesh.positions_mut()[v.index()] = position;
        }
        split_tags(mesh, plan, &moving);
        write(mesh, plan, closing, scratch);

        let certified = history.exactness_mut().map(|exactness| {
            certify::after(exactness, handed, mesh, &moving, plan, closing);
            // Only what took part can be certified, as the proof of a rotation lapses elsewhere.
            let new = plan.odd().map(|(x, _)| x);
            moving.iter().copied().chain(new).filter(|&v| certify::is_certified(exactness, mesh, v)).count()
        });
        let made = levels.iter().copied().zip(plan.edges.iter().map(|edge| Lineage::Edge(edge.ends())));
        history.record(SplitKind::Quadrisect, mesh.vertex_count(), made, &closing.edges, closing.max_valence);
        Ok(Step {
            selection: follow(selection, plan, mesh.rotation(), scratch),
            selected: selection.vertices().len(),
            region: moving.len(),
            split_edges: plan.edges.len(),
            passes: 1,
            t_vertices: std::mem::replace(&mut closing.t_vertices, scratch.take_list()),
            o_vertices: std::mem::replace(&mut closing.o_vertices, scratch.take_list()),
            certified,
            unproven: Vec::new(),
            mobile: None,
        })
    }
}

/// What a step needs while it is made, kept from step to step.
#[derive(Default)]
struct Buffers {
    plan: Plan,
    levels: Vec<u8>,
    positions: positions::Buffer,
    handed: certify::Handed,
    closing: Closing,
}

/// The levels of the new vertices; empty if names are not kept.
fn child_levels(levels: &mut Vec<u8>, history: &History, plan: &Plan) -> Result<(), RefineError> {
    levels.clear();
    if history.has_names() {
        for edge in &plan.edges {
            levels.push(history.child_level(edge.ends())?);
        }
    }
    Ok(())
}

/// Splits tags, as the vertices `moving` take part in a step; the rings are those before it.
fn split_tags(mesh: &mut Mesh, plan: &Plan, moving: &[VertexId]) {
    let (rotation, _, tags) = mesh.parts_mut();
    if !tags.is_empty() {
        let split = plan.odd().map(|(x, split)| (x, edge_between(split.ends())));
        tags.refine(rotation, split, moving.iter().copied());
    }
}

fn edge_between([p, q]: [VertexId; 2]) -> Edge {
    Edge::new(p, q)
}

/// S' = S and every new vertex between two vertices of S, or the parts of edges and faces. O(S and the region).
fn follow(selection: &Selection, plan: &Plan, rotation: &RotationSystem, scratch: &mut Scratch) -> Selection {
    if !selection.is_of_vertices() {
        let mut odd: Vec<(Edge, VertexId)> = plan.odd().map(|(x, split)| (edge_between(split.ends()), x)).collect();
        odd.sort_unstable();
        let odd_on = |edge| odd.binary_search_by_key(&edge, |&(edge, _)| edge).ok().map(|k| odd[k].1);
        return parts::follow(selection, odd_on, rotation);
    }
    let mut vertices = scratch.take_list();
    vertices.extend_from_slice(selection.vertices());
    let marks = scratch.marked(rotation.vertex_count(), selection.vertices());
    vertices.extend(plan.odd().filter(|(_, edge)| edge.ends().iter().all(|&end| marks.is_set(end))).map(|(x, _)| x));
    Selection::ascending(vertices)
}
