//! Masks applied to positions, and shown to who follows.

use glam::DVec3;

use super::follow::MaskWriter;
use super::{Control, whole};
use crate::error::RefineError;
use crate::id::VertexId;
use crate::mesh::{Mesh, Neighborhood};
use crate::scheme::{Scheme, WeightedSum};
use crate::split::quadrisect::Plan;
use crate::split::whole::WholeSplit;
use crate::split::whole::quadrisect::Whole;
use crate::step::Parent;

/// After how many new positions of a region they are stored, and the caller is asked whether to go on.
pub(super) const BUFFERED: usize = 1 << 10;

/// What an empty mask makes, which no scheme's is.
pub(super) const NO_POSITION: DVec3 = DVec3::NAN;

/// Positions on their way into a mesh.
#[derive(Default)]
pub(super) struct Buffer {
    /// New ones that are not appended yet.
    odd: Vec<DVec3>,
    /// The new ones of moved vertices.
    pub(super) moved: Vec<DVec3>,
}

/// Appends the positions of the new vertices and leaves those of the moved ones in the buffer, not written yet.
///
/// Both are computed from the old positions. `moving` are the even vertices that move if the scheme moves any; else none
/// are left. After an error the positions are as before.
pub(super) fn append_odd<S: Scheme>(
    scheme: &S,
    mesh: &mut Mesh,
    moving: &[VertexId],
    plan: &Plan,
    buffer: &mut Buffer,
    control: &mut Control<'_>,
) -> Result<(), RefineError> {
    let (rotation, positions, tags) = mesh.parts_mut();
    let around = Neighborhood::new(rotation, tags).with_hubs(plan.hubs());
    let old = positions.len();
    let moving = if scheme.moves_even() { moving } else { &[] };
    let (new, total) = (plan.edges.len(), plan.edges.len() + moving.len());
    let Buffer { odd: buffer, moved } = buffer;
    buffer.clear();
    moved.clear();
    let mut compute = || {
        positions.reserve(new);
        // A few at a time, as what is appended to can not be read from; the buffer stays in the cache.
        for (done, parent) in plan.parents(around).enumerate() {
            if done % BUFFERED == 0 {
                positions.append(buffer);
                control.report(done, total)?;
            }
            buffer.push(finite(odd(scheme, around, positions, &parent), parent.p)?);
        }
        positions.append(buffer);
        for &v in moving {
            if moved.len() % BUFFERED == 0 {
                control.report(new + moved.len(), total)?;
            }
            moved.push(finite(even(scheme, around, positions, v), v)?);
        }
        Ok(())
    };
    let computed = compute();
    if computed.is_err() {
        positions.truncate(old);
    }
    computed
}

/// The positions after a split of everything, the old vertices first.
pub(super) fn of_whole<S: Scheme + Sync>(
    scheme: &S,
    mesh: &Mesh,
    split: &Whole<'_>,
    control: &mut Control<'_>,
) -> Result<Vec<DVec3>, RefineError> {
    let (around, old) = (mesh.neighborhood().with_hubs(split.numbers().hubs()), mesh.positions());
    let even = move |v| even(scheme, around, old, v);
    let odd = move |parent| odd(scheme, around, old, &parent);
    whole::positions(split, old, scheme.moves_even().then_some(even), odd, |parent| parent.p, control)
}

/// Writes the masks by which [`append_odd`] makes positions.
pub(super) fn show_region<S: Scheme>(
    scheme: &S,
    mesh: &Mesh,
    moving: &[VertexId],
    plan: &Plan,
    masks: &mut MaskWriter<'_>,
) {
    let around = mesh.neighborhood().with_hubs(plan.hubs());
    for &v in if scheme.moves_even() { moving } else { &[] } {
        masks.assign(v, &[], |mask| scheme.even(around, v, mask));
    }
    for (k, parent) in (plan.first..).zip(plan.parents(around)) {
        masks.assign(VertexId::new(k), &[parent.p, parent.q], |mask| scheme.odd(around, &parent, mask));
    }
}

/// Writes the masks by which [`of_whole`] makes positions.
pub(super) fn show_whole<S: Scheme>(scheme: &S, mesh: &Mesh, whole: &Whole<'_>, masks: &mut MaskWriter<'_>) {
    let around = mesh.neighborhood().with_hubs(whole.numbers().hubs());
    for v in mesh.vertices().filter(|_| scheme.moves_even()) {
        masks.assign(v, &[], |mask| scheme.even(around, v, mask));
    }
    let mut odd = mesh.vertex_count()..;
    for block in whole.numbers().owning_blocks() {
        let mut parents = Vec::new();
        whole.append_new(block, &mut parents, Some);
        for (parent, k) in parents.into_iter().flatten().zip(&mut odd) {
            masks.assign(VertexId::new(k), &[parent.p, parent.q], |mask| scheme.odd(around, &parent, mask));
        }
    }
}

/// The new position of an old vertex.
#[inline]
fn even<S: Scheme>(scheme: &S, around: Neighborhood<'_>, positions: &[DVec3], v: VertexId) -> DVec3 {
    let mut sum = WeightedSum::new(move |w: VertexId| positions[w.index()]);
    scheme.even(around, v, &mut sum);
    sum.total().unwrap_or(NO_POSITION)
}

/// The position of a new vertex.
#[inline]
fn odd<S: Scheme>(scheme: &S, around: Neighborhood<'_>, positions: &[DVec3], parent: &Parent) -> DVec3 {
    let mut sum = WeightedSum::new(move |w: VertexId| positions[w.index()]);
    scheme.odd(around, parent, &mut sum);
    sum.total().unwrap_or(NO_POSITION)
}

/// The position, or the error for which the vertex to blame is named.
pub(super) fn finite(position: DVec3, v: VertexId) -> Result<DVec3, RefineError> {
    if position.is_finite() { Ok(position) } else { Err(RefineError::NonFinite(v)) }
}
