//! A step by the masks of the mesh before it.
//!
//! All is split at once. A triangle that lags moves on by what has to be split first, one link of the chain a step; in a
//! selection that follows there is no such chain.

use glam::DVec3;

use crate::error::RefineError;
use crate::id::{Triangle, VertexId};
use crate::mesh::{Mesh, Neighborhood};
use crate::scheme::{MaskSink, Sqrt3, WeightedSum};
use crate::split::trisect::{Levels, Plan, across_mate};
use crate::step::{History, Lineage};
use crate::subdivide::Control;
use crate::subdivide::positions::{BUFFERED, NO_POSITION, finite};

/// Splits triangles, or what has to be split before them, and answers the greatest valence that changed.
///
/// The old vertices around which every triangle is split move, on a boundary those between two edges that are cut.
pub(super) fn split(
    scheme: &Sqrt3,
    mesh: &mut Mesh,
    history: &mut History,
    inside: Vec<Triangle>,
    plan: &mut Plan,
    control: &mut Control<'_>,
) -> Result<usize, RefineError> {
    if history.has_motions() {
        return Err(RefineError::OtherPositions);
    }
    let mut levels = Levels::before(history, mesh.vertex_count());
    let mut ready = inside;
    let mut first_needed = Vec::new();
    ready.retain(|&triangle| {
        let across = |triangle| across_mate(mesh.rotation(), levels.state(triangle));
        let first = std::iter::successors(across(triangle), |&next| across(next)).last();
        first_needed.extend(first);
        first.is_none()
    });
    add_others(&mut ready, first_needed);

    plan.clear();
    plan.next_pass(mesh.rotation(), &levels, ready.into_iter())?;
    control.allow(plan.vertex_count, mesh.face_count(), 2 * plan.faces().len())?;
    let moving: Vec<VertexId> = plan.moving(mesh.rotation()).collect();
    let moved = append_new(scheme, mesh, plan, &moving, control)?;

    // From here on nothing can fail.
    control.show(mesh.rotation().vertex_count(), plan.vertex_count, |masks| {
        let around = mesh.neighborhood();
        for &v in &moving {
            masks.assign(v, &[], |mask| scheme.even(around, v, mask));
        }
        for (x, lineage) in plan.faces().iter().flat_map(|face| face.made()) {
            let parents: Vec<VertexId> = lineage.vertices().collect();
            masks.assign(x, &parents, |mask| odd(scheme, around, lineage, mask));
        }
    });
    let (rotation, positions, _) = mesh.parts_mut();
    for (v, position) in moving.into_iter().zip(moved) {
        positions[v.index()] = position;
    }
    levels.push(plan.faces());
    Ok(plan.apply(rotation, &levels, |_, _| {}))
}

/// Adds what is not in a list in order of smallest corners.
pub(super) fn add_others(list: &mut Vec<Triangle>, mut others: Vec<Triangle>) {
    let smallest = |triangle: &Triangle| triangle.corners()[0];
    others.sort_unstable();
    others.dedup();
    others.retain(|triangle| {
        let start = list.partition_point(|other| smallest(other) < smallest(triangle));
        let alike = list[start..].iter().take_while(|other| smallest(other) == smallest(triangle));
        !alike.into_iter().any(|other| other == triangle)
    });
    list.extend(others);
}

/// Appends the positions of the new vertices, and answers those of the ones that move. After an error they are as before.
fn append_new(
    scheme: &Sqrt3,
    mesh: &mut Mesh,
    plan: &Plan,
    moving: &[VertexId],
    control: &mut Control<'_>,
) -> Result<Vec<DVec3>, RefineError> {
    let (rotation, positions, tags) = mesh.parts_mut();
    let around = Neighborhood::new(rotation, tags);
    let old = positions.len();
    let new = plan.vertex_count - old;
    let total = new + moving.len();
    let mut compute = || {
        positions.reserve(new);
        let mut buffer = Vec::with_capacity(BUFFERED.min(new));
        // A few at a time, as what is appended to can not be read from; the buffer stays in the cache.
        for (done, (_, lineage)) in plan.faces().iter().flat_map(|face| face.made()).enumerate() {
            if done % BUFFERED == 0 {
                positions.append(&mut buffer);
                control.report(done, total)?;
            }
            let mut sum = WeightedSum::new(|v: VertexId| positions[v.index()]);
            odd(scheme, around, lineage, &mut sum);
            let to_blame = lineage.vertices().next();
            buffer.push(finite(sum.total().unwrap_or(NO_POSITION), to_blame.expect("it was made of something"))?);
        }
        positions.append(&mut buffer);
        let mut moved = Vec::with_capacity(moving.len());
        for &v in moving {
            if moved.len() % BUFFERED == 0 {
                control.report(new + moved.len(), total)?;
            }
            let mut sum = WeightedSum::new(|v: VertexId| positions[v.index()]);
            scheme.even(around, v, &mut sum);
            moved.push(finite(sum.total().unwrap_or(NO_POSITION), v)?);
        }
        Ok(moved)
    };
    let moved = compute();
    if moved.is_err() {
        positions.truncate(old);
    }
    moved
}

/// Writes the mask of a new vertex.
#[inline]
fn odd(scheme: &Sqrt3, around: Neighborhood<'_>, lineage: Lineage, mask: &mut impl MaskSink) {
    match lineage {
        Lineage::Face(corners) => scheme.center(corners, mask),
        Lineage::Third { near, far } => scheme.third(around, near, far, mask),
        Lineage::Edge(_) => unreachable!("no edge is halved"),
    }
}
