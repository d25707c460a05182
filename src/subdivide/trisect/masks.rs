//! A step by the masks of the mesh before it.
//!
//! All is split at once. A triangle that lags moves on by what has to be split first, one link of the chain a step; in a
//! selection that follows there is no such chain.

use std::mem;

use glam::DVec3;

use crate::error::RefineError;
use crate::id::{Triangle, VertexId};
use crate::mesh::{Mesh, Neighborhood};
use crate::scheme::{MaskSink, Sqrt3, WeightedSum};
use crate::split::trisect::{Levels, Plan, across_mate};
use crate::step::{History, Lineage};
use crate::subdivide::Control;
use crate::subdivide::positions::{BUFFERED, NO_POSITION, finite};

/// What a step needs while it is made, kept from step to step.
#[derive(Default)]
pub(super) struct Buffers {
    /// What has to be split instead of triangles that lag.
    first_needed: Vec<Triangle>,
    /// Levels of new vertices.
    levels: Vec<u8>,
    /// New positions that are not appended yet.
    new: Vec<DVec3>,
    /// The old vertices that move, and where to.
    moving: Vec<VertexId>,
    moved: Vec<DVec3>,
}

/// Splits triangles, or what has to be split before them, and answers the greatest valence that changed.
///
/// The old vertices around which every triangle is split move, on a boundary those between two edges that are cut.
pub(super) fn split(
    scheme: &Sqrt3,
    mesh: &mut Mesh,
    history: &mut History,
    ready: &mut Vec<Triangle>,
    plan: &mut Plan,
    buffers: &mut Buffers,
    control: &mut Control<'_>,
) -> Result<usize, RefineError> {
    if history.has_motions() {
        return Err(RefineError::OtherPositions);
    }
    let mut levels = Levels::before(history, mesh.vertex_count(), mem::take(&mut buffers.levels));
    let first_needed = &mut buffers.first_needed;
    first_needed.clear();
    ready.retain(|&triangle| {
        let across = |triangle| across_mate(mesh.rotation(), levels.state(triangle));
        let first = std::iter::successors(across(triangle), |&next| across(next)).last();
        first_needed.extend(first);
        first.is_none()
    });
    add_others(ready, first_needed);

    plan.clear();
    plan.next_pass(mesh.rotation(), &levels, ready.iter().copied())?;
    control.allow(plan.vertex_count, mesh.face_count(), 2 * plan.faces().len())?;
    buffers.moving.clear();
    buffers.moving.extend(plan.moving(mesh.rotation()));
    append_new(scheme, mesh, plan, buffers, control)?;

    // From here on nothing can fail.
    let Buffers { moving, moved, .. } = buffers;
    control.show(mesh.rotation().vertex_count(), plan.vertex_count, |masks| {
        let around = mesh.neighborhood();
        for &v in &*moving {
            masks.assign(v, &[], |mask| scheme.even(around, v, mask));
        }
        for (x, lineage) in plan.faces().iter().flat_map(|face| face.made()) {
            let parents: Vec<VertexId> = lineage.vertices().collect();
            masks.assign(x, &parents, |mask| odd(scheme, around, lineage, mask));
        }
    });
    let (rotation, positions, _) = mesh.parts_mut();
    for (v, &position) in moving.iter().zip(&*moved) {
        positions[v.index()] = position;
    }
    levels.push(plan.faces());
    let max_valence = plan.apply(rotation, &levels, |_, _| {});
    buffers.levels = levels.into_list();
    Ok(max_valence)
}

/// Adds what is not in a list in order of smallest corners.
pub(super) fn add_others(list: &mut Vec<Triangle>, others: &mut Vec<Triangle>) {
    let smallest = |triangle: &Triangle| triangle.corners()[0];
    others.sort_unstable();
    others.dedup();
    others.retain(|triangle| {
        let start = list.partition_point(|other| smallest(other) < smallest(triangle));
        let alike = list[start..].iter().take_while(|other| smallest(other) == smallest(triangle));
        !alike.into_iter().any(|other| other == triangle)
    });
    list.append(others);
}

/// Appends the positions of the new vertices, and leaves those of the ones that move in the buffers. After an error they are as
/// before.
fn append_new(
    scheme: &Sqrt3,
    mesh: &mut Mesh,
    plan: &Plan,
    buffers: &mut Buffers,
    control: &mut Control<'_>,
) -> Result<(), RefineError> {
    let (rotation, positions, tags) = mesh.parts_mut();
    let around = Neighborhood::new(rotation, tags);
    let Buffers { new: buffer, moving, moved, .. } = buffers;
    buffer.clear();
    moved.clear();
    let old = positions.len();
    let new = plan.vertex_count - old;
    let total = new + moving.len();
    let mut compute = || {
        positions.reserve(new);
        // A few at a time, as what is appended to can not be read from; the buffer stays in the cache.
        for (done, (_, lineage)) in plan.faces().iter().flat_map(|face| face.made()).enumerate() {
            if done % BUFFERED == 0 {
                positions.append(buffer);
                control.report(done, total)?;
            }
            let mut sum = WeightedSum::new(|v: VertexId| positions[v.index()]);
            odd(scheme, around, lineage, &mut sum);
            let to_blame = lineage.vertices().next();
            buffer.push(finite(sum.total().unwrap_or(NO_POSITION), to_blame.expect("it was made of something"))?);
        }
        positions.append(buffer);
        for &v in &*moving {
            if moved.len() % BUFFERED == 0 {
                control.report(new + moved.len(), total)?;
            }
            let mut sum = WeightedSum::new(|v: VertexId| positions[v.index()]);
            scheme.even(around, v, &mut sum);
            moved.push(finite(sum.total().unwrap_or(NO_POSITION), v)?);
        }
        Ok(())
    };
    let computed = compute();
    if computed.is_err() {
        positions.truncate(old);
    }
    computed
}

/// Writes the mask of a new vertex.
#[inline]
pub(super) fn odd(scheme: &Sqrt3, around: Neighborhood<'_>, lineage: Lineage, mask: &mut impl MaskSink) {
    match lineage {
        Lineage::Face(corners) => scheme.center(corners, mask),
        Lineage::Third { near, far } => scheme.third(around, near, far, mask),
        Lineage::Edge(_) => unreachable!("no edge is halved"),
    }
}
