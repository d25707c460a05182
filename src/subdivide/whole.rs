//! What steps of a whole mesh share, whatever the kind of their split.
//!
//! **Deliberately not here**: rings and the numbers of new vertices ([`crate::split`]), weights ([`crate::scheme`]).

use glam::DVec3;

use super::{Control, Request};
use crate::error::RefineError;
use crate::id::VertexId;
use crate::parallel;
use crate::rotation::RotationSystem;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::split::whole::WholeSplit;

/// Whether ids alone tell the levels of all vertices, and the step need not tell where the new ones come from.
pub(super) fn is_plain(request: &Request<'_, '_>) -> bool {
    let Request { history, region, control, .. } = request;
    region.is_everything() && history.is_of_whole_steps() && !history.has_names() && control.follower.is_none()
}

/// The positions after a split of everything, the old vertices first: `even` makes those of old vertices, if they move, and
/// `odd` those of new ones, of which `blamed` names a vertex that they are made of.
// Inlined, so that what the functions hold is not read again for every position.
#[inline]
pub(super) fn positions<W: WholeSplit>(
    whole: &W,
    old: &[DVec3],
    even: Option<impl Fn(VertexId) -> DVec3 + Sync>,
    odd: impl Fn(W::Made) -> DVec3 + Sync + Copy,
    blamed: impl Fn(W::Made) -> VertexId + Sync,
    control: &mut Control<'_>,
) -> Result<Vec<DVec3>, RefineError> {
    let numbers = whole.numbers();
    let mut new = Vec::with_capacity(old.len() + numbers.count());
    let kept = if even.is_some() { 0 } else { old.len() };
    let total = old.len() + numbers.count() - kept;
    if let Some(even) = even {
        for block in numbers.blocks() {
            control.report(new.len(), total)?;
            parallel::append(&mut new, block, |v| even(VertexId::new(v)));
        }
    } else {
        new.extend_from_slice(old);
    }
    for block in numbers.owning_blocks() {
        let done = new.len();
        control.report(done - kept, total)?;
        // By value, as through a reference it would not always be inlined.
        whole.append_new(block.clone(), &mut new, odd);
        if let Some(k) = parallel::find(done..new.len(), |k| !new[k].is_finite()) {
            let mut names = Vec::new();
            whole.append_new(block, &mut names, |made| Some(blamed(made)));
            return Err(RefineError::NonFinite(names[k - done].expect("a new vertex is made of old ones")));
        }
    }
    // Last, as when a region is refined, so that the same vertex is to blame.
    match parallel::find(0..old.len(), |v| !new[v].is_finite()) {
        Some(v) => Err(RefineError::NonFinite(VertexId::new(v))),
        None => Ok(new),
    }
}

/// S' = S and every new vertex between vertices of S.
pub(super) fn follow(whole: &impl WholeSplit, selection: &Selection, old: usize, scratch: &mut Scratch) -> Selection {
    let mut followed = scratch.take_list();
    followed.extend_from_slice(selection.vertices());
    if selection.vertices().len() == old {
        followed.extend((old..old + whole.numbers().count()).map(VertexId::new));
    } else {
        let marks = scratch.marked(old, selection.vertices());
        for &v in selection.vertices() {
            whole.append_between(v, |w| marks.is_set(w), &mut followed);
        }
    }
    Selection::ascending(followed)
}

/// The greatest valence after a split of so many vertices, of which new ones have `at_most` neighbours.
pub(super) fn max_valence(rotation: &RotationSystem, old: usize, at_most: usize) -> usize {
    let among = |vertices| {
        let greatest = parallel::shares(vertices, |share| share.map(|v| rotation.valence(VertexId::new(v))).max());
        greatest.into_iter().flatten().max().unwrap_or(0)
    };
    let even = among(0..old);
    if even < at_most { among(0..rotation.vertex_count()) } else { even }
}
