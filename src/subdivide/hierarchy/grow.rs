//! A hierarchy that grows, with its mesh: all that can fail, and then what cannot.

use std::mem;

use glam::DVec3;

use super::follow;
use super::patch::{Center, Patch, View};
use super::sharpness::LevelTags;
use super::{Change, Site, show_change};
use crate::error::RefineError;
use crate::id::Edge;
use crate::mesh::Mesh;
use crate::scheme::Scheme;
use crate::split::hierarchy::{Grower, Growth, Levels};
use crate::step::Refinement;
use crate::subdivide::Control;
use crate::subdivide::positions::{BUFFERED, finite};

/// Buffers, kept from step to step.
#[derive(Default)]
struct Buffers {
    growth: Growth,
    patch: Patch,
}

/// Adds to a hierarchy what is asked for, and changes the mesh accordingly. After an error all is as before.
pub(super) fn grow<S: Scheme>(
    scheme: &S,
    site: Site<'_>,
    control: &mut Control<'_>,
    add: impl FnOnce(&mut Grower<'_>) -> Result<(), RefineError>,
) -> Result<Change, RefineError> {
    let Site { mesh, refinement, scratch, .. } = site;
    control.allow_follower(refinement.places.any())?;
    if control.follower.is_some() && refinement.gave_up {
        return Err(RefineError::JoinedLate);
    }
    let before = mesh.vertex_count();
    let mut buffers = scratch.take::<Buffers>();
    let Buffers { growth, patch } = &mut *buffers;
    growth.clear();
    let rotation = mesh.rotation();
    let mut grower = Grower { rotation, hierarchy: &mut refinement.hierarchy, growth, max_faces: control.max_faces };
    let placed = add(&mut grower).and_then(|()| place(scheme, mesh, refinement, growth, patch, control));
    let change = match placed {
        Ok(()) => {
            split_tags(mesh, refinement, growth);
            let mut change = show_change(mesh, refinement, &growth.made, scratch);
            let view = View::new(mesh.rotation(), mesh.positions(), refinement);
            let after = mesh.vertex_count();
            let shown = || change.changed.iter().map(|&v| (v, view.shown_level(v)));
            control.show(before, after, |masks| follow::show(scheme, view, &growth.steps, shown(), masks));
            change.added.clone_from(&growth.made);
            change.added.sort_unstable();
            Ok(change)
        }
        Err(error) => {
            growth.undo(&mut refinement.hierarchy);
            Err(error)
        }
    };
    scratch.give(buffers);
    change
}

/// Finds where what is new is, in order. After an error positions are as before.
fn place<S: Scheme>(
    scheme: &S,
    mesh: &mut Mesh,
    refinement: &mut Refinement,
    growth: &Growth,
    patch: &mut Patch,
    control: &mut Control<'_>,
) -> Result<(), RefineError> {
    let (rotation, positions, _) = mesh.parts_mut();
    let before = positions.len();
    // Of ids that were free before.
    let mut replaced: Vec<(usize, DVec3)> = Vec::new();
    let mut moved = Vec::new();
    let mut compute = || {
        let total = if scheme.moves_even() { growth.steps.len() } else { growth.made.len() };
        let mut done = 0;
        for &(v, level) in &growth.steps {
            let view = View::new(rotation, positions, refinement);
            let birth = refinement.hierarchy.birth(v).filter(|birth| birth.level == level);
            if birth.is_none() && !scheme.moves_even() {
                continue;
            }
            if done % BUFFERED == 0 {
                control.report(done, total)?;
            }
            done += 1;
            match birth {
                Some(birth) => {
                    let position =
                        finite(patch.position(scheme, view, Center::Edge(birth.parent), level - 1), birth.parent.p)?;
                    match positions.get_mut(v.index()) {
                        Some(free) => replaced.push((v.index(), mem::replace(free, position))),
                        None => positions.push(position),
                    }
                }
                None => {
                    let position = finite(patch.position(scheme, view, Center::Vertex(v), level - 1), v)?;
                    let birth = positions[v.index()];
                    refinement.places.push(v, level, birth, position);
                    moved.push(v);
                }
            }
        }
        Ok(())
    };
    let computed = compute();
    if computed.is_err() {
        for &v in moved.iter().rev() {
            refinement.places.pop(v);
        }
        positions.truncate(before);
        for (k, position) in replaced {
            positions[k] = position;
        }
    }
    computed
}

/// Hands the sharpness of edges on to their halves, as it is at their level.
fn split_tags(mesh: &mut Mesh, refinement: &Refinement, growth: &Growth) {
    if refinement.input_tags.is_empty() {
        return;
    }
    let (rotation, _, tags) = mesh.parts_mut();
    let of_levels = LevelTags::new(Levels::new(rotation, &refinement.hierarchy), &refinement.input_tags);
    for &x in &growth.made {
        let Some(birth) = refinement.hierarchy.birth(x) else { continue };
        let edge = Edge::new(birth.parent.p, birth.parent.q);
        if tags.is_sharp(edge) {
            tags.split(edge, x);
            for end in edge.ends() {
                tags.set_sharpness(Edge::new(end, x), of_levels.of_edge(x, end, birth.level));
            }
        }
    }
}
