//! A hierarchy from which something is taken, with its mesh. Nothing here can fail.

use super::sharpness::LevelTags;
use super::{Change, Site, show_change};
use crate::id::{Edge, VertexId};
use crate::mesh::{Mesh, Sharpness};
use crate::split::hierarchy::{Levels, Shrinker};
use crate::step::Refinement;

/// Takes out of a hierarchy what nothing needs any more now that these stars are not asked for, and changes the mesh
/// accordingly.
pub(super) fn shrink(site: Site<'_>, given_up: impl IntoIterator<Item = VertexId>) -> Change {
    let Site { scheme, mesh, refinement, scratch } = site;
    let Refinement { hierarchy, asked, .. } = &mut *refinement;
    let asked = |v: VertexId, level: u8| asked.range((v, level)..=(v, u8::MAX)).next().is_some();
    let mut shrinker = Shrinker { rotation: mesh.rotation(), hierarchy, asked, removed: Vec::new(), lost: Vec::new() };
    for v in given_up {
        shrinker.settle(v);
    }
    let Shrinker { mut removed, lost, .. } = shrinker;
    refinement.gave_up = true;
    if scheme.moves_even() {
        for v in lost {
            if let Some(birth) = refinement.places.pop(v) {
                mesh.positions_mut()[v.index()] = birth;
            }
        }
    }
    join_tags(mesh, refinement, &removed);
    let mut change = show_change(mesh, refinement, &removed, scratch);
    for &x in &removed {
        refinement.hierarchy.release(x);
    }
    let (rotation, positions, tags) = mesh.parts_mut();
    rotation.truncate(refinement.hierarchy.vertex_count());
    positions.truncate(refinement.hierarchy.vertex_count());
    if refinement.hierarchy.is_input_alone() {
        // In the very order in which they were set.
        tags.clone_from(&refinement.input_tags);
    }
    removed.sort_unstable();
    change.removed = removed;
    change
}

/// Gives edges that are whole again the sharpness that they have at their level.
fn join_tags(mesh: &mut Mesh, refinement: &Refinement, removed: &[VertexId]) {
    if refinement.input_tags.is_empty() {
        return;
    }
    let (rotation, _, tags) = mesh.parts_mut();
    let of_levels = LevelTags::new(Levels::new(rotation, &refinement.hierarchy), &refinement.input_tags);
    for &x in removed {
        let Some(birth) = refinement.hierarchy.birth(x) else { continue };
        let edge = Edge::new(birth.parent.p, birth.parent.q);
        for end in edge.ends() {
            tags.set_sharpness(Edge::new(end, x), Sharpness::SMOOTH);
        }
        let [a, b] = edge.ends();
        tags.set_sharpness(edge, of_levels.of_edge(a, b, birth.level - 1));
    }
}
