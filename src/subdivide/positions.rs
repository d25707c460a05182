//! Masks applied to positions.

use glam::DVec3;

use super::Control;
use crate::error::RefineError;
use crate::id::VertexId;
use crate::mesh::{Mesh, Neighborhood};
use crate::scheme::{MaskSink, Scheme};
use crate::parallel;
use crate::split::Parents;
use crate::split::whole::Whole;

/// After how many new positions they are stored, and the caller is asked whether to go on.
const BUFFERED: usize = 1 << 10;

/// Appends the positions of the new vertices and answers with those of the moved ones, which are not written yet.
///
/// Both are computed from the old positions. `moving` are the even vertices that move if the scheme moves any; else none
/// come back. After an error the positions are as before.
pub(super) fn append_odd<S: Scheme>(
    scheme: &S,
    mesh: &mut Mesh,
    moving: impl ExactSizeIterator<Item = VertexId>,
    parents: &impl Parents,
    control: &mut Control<'_>,
) -> Result<Vec<DVec3>, RefineError> {
    let (rotation, positions, tags) = mesh.parts_mut();
    let around = Neighborhood::new(rotation, tags);
    let old = positions.len();
    let mut moved = Vec::with_capacity(if scheme.moves_even() { moving.len() } else { 0 });
    let (new, total) = (parents.count(), parents.count() + moved.capacity());
    let mut computed = odd(scheme, around, positions, parents, total, control);
    if computed.is_ok() && scheme.moves_even() {
        computed = even(scheme, around, positions, moving, &mut moved, |done| control.report(new + done, total));
    }
    if computed.is_err() {
        positions.truncate(old);
    }
    computed.map(|()| moved)
}

fn odd<S: Scheme>(
    scheme: &S,
    around: Neighborhood<'_>,
    positions: &mut Vec<DVec3>,
    parents: &impl Parents,
    total: usize,
    control: &mut Control<'_>,
) -> Result<(), RefineError> {
    let old = positions.len();
    positions.reserve(parents.count());
    // A few at a time, as what is appended to can not be read from; the buffer stays in the cache.
    let mut buffer = Vec::with_capacity(BUFFERED.min(parents.count()));
    parents.try_for_each(around, |parent| {
        if buffer.is_empty() {
            control.report(positions.len() - old, total)?;
        }
        let mut sum = WeightedSum::new(positions);
        scheme.odd(around, &parent, &mut sum);
        buffer.push(sum.finite(parent.p)?);
        if buffer.len() == BUFFERED {
            positions.append(&mut buffer);
        }
        Ok(())
    })?;
    positions.append(&mut buffer);
    Ok(())
}

/// The positions after a split of everything, the old vertices first.
pub(super) fn of_whole<S: Scheme + Sync>(
    scheme: &S,
    mesh: &Mesh,
    whole: &Whole<'_>,
    control: &mut Control<'_>,
) -> Result<Vec<DVec3>, RefineError> {
    let (around, old) = (mesh.neighborhood(), mesh.positions());
    let mut new = Vec::with_capacity(old.len() + mesh.edge_count());
    let total = new.capacity();
    if scheme.moves_even() {
        parallel::append(&mut new, 0..old.len(), |v| {
            let mut sum = WeightedSum::new(old);
            scheme.even(around, VertexId::new(v), &mut sum);
            sum.total.unwrap_or(DVec3::NAN)
        });
    } else {
        new.extend_from_slice(old);
    }
    whole.append_odd(&mut new, |parent| {
        let mut sum = WeightedSum::new(old);
        scheme.odd(around, &parent, &mut sum);
        sum.total.unwrap_or(DVec3::NAN)
    });
    control.report(total, total)?;
    Ok(new)
}

/// Adds the new positions of vertices that move; `report` hears how many there are.
fn even<S: Scheme>(
    scheme: &S,
    around: Neighborhood<'_>,
    positions: &[DVec3],
    moving: impl Iterator<Item = VertexId>,
    moved: &mut Vec<DVec3>,
    mut report: impl FnMut(usize) -> Result<(), RefineError>,
) -> Result<(), RefineError> {
    for v in moving {
        if moved.len() % BUFFERED == 0 {
            report(moved.len())?;
        }
        let mut sum = WeightedSum::new(positions);
        scheme.even(around, v, &mut sum);
        moved.push(sum.finite(v)?);
    }
    Ok(())
}

/// A mask applied to positions as it comes, group by group.
struct WeightedSum<'a> {
    positions: &'a [DVec3],
    /// `None` before the first group, as 0 + (-0) is not -0.
    total: Option<DVec3>,
}

impl<'a> WeightedSum<'a> {
    #[inline]
    fn new(positions: &'a [DVec3]) -> Self {
        Self { positions, total: None }
    }

    /// The sum, or the error that it is not finite, for which the vertex to blame is named.
    #[inline]
    fn finite(self, v: VertexId) -> Result<DVec3, RefineError> {
        self.total.filter(|total| total.is_finite()).ok_or(RefineError::NonFinite(v))
    }
}

impl MaskSink for WeightedSum<'_> {
    #[inline]
    fn group(&mut self, weight: f64, vertices: impl IntoIterator<Item = VertexId>) {
        let group = vertices.into_iter().map(|v| self.positions[v.index()]).reduce(|sum, position| sum + position);
        if let Some(group) = group {
            let group = weight * group;
            self.total = Some(self.total.map_or(group, |total| total + group));
        }
    }
}
