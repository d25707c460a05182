//! What goes along with a mesh from step to step, by the masks that make its positions.
//!
//! A step replaces the positions by weighted sums of those before it. Whatever else belongs to the vertices (a colour, a
//! weight, the row of a matrix) is replaced in the same way by a [`Follower`], to which the step shows its masks.
//!
//! Some steps read more than the mesh shows. Adaptive 4-8 reads where a vertex was a generation before, adaptive √3 where
//! it was born and where it tends to. Such *kept* values are made by masks as well, so a step shows them as it shows those
//! of the vertices: a [`ValueId`] names either.
//!
//! Read in this order: [`Follower`], [`Values`](super::Values) (the one that is ready), [`StepMasks`], [`Assignment`].
//!
//! **Deliberately not here**: what is done with the masks.

use std::fmt;

use super::Control;
use crate::error::RefineError;
use crate::id::VertexId;
use crate::scheme::{Mask, MaskSink};

/// What goes along with a mesh; given to each of its steps with [`Control::follower`].
///
/// [`Values`](super::Values) is one, for values that are weighed and added.
pub trait Follower {
    /// Takes one step.
    ///
    /// Called once a step, after all that can fail: so a step that fails is shown to nobody, and one that is shown is made.
    fn follow(&mut self, step: &StepMasks<'_>);

    /// Whether it has kept values. If the steps before left some that the next one may read, a follower without any was not
    /// there, and the step fails with [`RefineError::JoinedLate`](crate::error::RefineError::JoinedLate).
    fn has_kept(&self) -> bool;
}

/// The name of a value that goes along.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub enum ValueId {
    /// The one that belongs to where the mesh shows a vertex.
    Shown(VertexId),
    /// One of those that are kept beside it, by number, since later steps may read them.
    Kept(VertexId, u8),
}

impl From<VertexId> for ValueId {
    fn from(v: VertexId) -> Self {
        Self::Shown(v)
    }
}

/// The masks of one step.
///
/// They tell the step: a value that they name gets the sum that its mask says, one that they do not name stays as it is.
/// They come in *passes*. The masks of a pass read the values as they are before it, and never one that is made in it; most
/// steps have one pass. Named are all new vertices, the old ones that the scheme moves, if it moves any, and what is kept.
/// The same is shown of a region that is the whole mesh as of the whole mesh.
pub struct StepMasks<'a> {
    before: usize,
    after: usize,
    write: &'a dyn Fn(&mut MaskWriter<'_>),
}

/// The mask of one value in a step.
#[derive(Clone, Copy, Debug)]
pub struct Assignment<'a> {
    /// The value that is made anew. In a pass each comes once.
    pub id: ValueId,
    /// Of a new vertex, where it comes first, what it was made of, in the order of its
    /// [`Lineage`](crate::step::Lineage); else none.
    pub parents: &'a [VertexId],
    /// The pass, from 0 on.
    pub pass: usize,
    /// The weights of the new value; `None` for a kept one that nothing will read any more.
    pub mask: Option<&'a Mask<ValueId>>,
}

impl StepMasks<'_> {
    /// How many vertices there are before the step.
    #[must_use]
    pub fn vertex_count_before(&self) -> usize {
        self.before
    }

    /// How many vertices there are after it: those before, and behind them the new ones.
    #[must_use]
    pub fn vertex_count_after(&self) -> usize {
        self.after
    }

    /// Shows the masks pass by pass, in each the vertices in ascending order. They are computed anew each time. O(region).
    pub fn for_each(&self, mut take: impl FnMut(Assignment<'_>)) {
        (self.write)(&mut MaskWriter { mask: Mask::default(), are_masks_read: true, pass: 0, take: &mut take });
    }

    /// Shows which values get masks, and of new vertices what they were made of, as [`StepMasks::for_each`] does; but no
    /// mask is computed, which takes most of the time.
    pub fn for_each_name(&self, mut take: impl FnMut(ValueId, &[VertexId])) {
        let take = &mut |Assignment { id, parents, mask, .. }: Assignment<'_>| {
            if mask.is_some() {
                take(id, parents);
            }
        };
        (self.write)(&mut MaskWriter { mask: Mask::default(), are_masks_read: false, pass: 0, take });
    }

    /// Does in a store of values what the masks say: `make` answers a new value from those in the store, `put` puts it
    /// there, or takes one away.
    ///
    /// Values that take the place of others wait for the end of their pass. O(region).
    pub fn replay<S, T>(
        &self,
        store: &mut S,
        mut make: impl FnMut(&mut S, Assignment<'_>, &Mask<ValueId>) -> T,
        mut put: impl FnMut(&mut S, ValueId, Option<T>),
    ) {
        let mut waiting: Vec<(ValueId, Option<T>)> = Vec::new();
        let mut pass = 0;
        self.for_each(|assignment| {
            if assignment.pass > pass {
                waiting.drain(..).for_each(|(id, value)| put(store, id, value));
                pass = assignment.pass;
            }
            let value = assignment.mask.map(|mask| make(store, assignment, mask));
            if assignment.parents.is_empty() {
                waiting.push((assignment.id, value));
            } else {
                put(store, assignment.id, value);
            }
        });
        waiting.into_iter().for_each(|(id, value)| put(store, id, value));
    }
}

impl fmt::Debug for StepMasks<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { before, after, .. } = self;
        f.debug_struct("StepMasks").field("before", before).field("after", after).finish_non_exhaustive()
    }
}

/// Where a step of any kind writes its masks.
pub(super) struct MaskWriter<'a> {
    mask: Mask<ValueId>,
    /// If not, what is shown has empty ones.
    are_masks_read: bool,
    pass: usize,
    take: &'a mut dyn FnMut(Assignment<'_>),
}

impl MaskWriter<'_> {
    /// Shows the mask of the next vertex, in terms of what is shown; see [`Assignment`] for what `parents` are.
    pub(super) fn assign(
        &mut self,
        vertex: VertexId,
        parents: &[VertexId],
        write: impl FnOnce(&mut Named<'_, fn(VertexId) -> ValueId>),
    ) {
        self.assign_named(vertex, parents, ValueId::from as fn(VertexId) -> ValueId, write);
    }

    /// The same with other values in the place of those shown.
    pub(super) fn assign_named<F>(
        &mut self,
        vertex: VertexId,
        parents: &[VertexId],
        name: F,
        write: impl FnOnce(&mut Named<'_, F>),
    ) {
        self.assign_value(ValueId::Shown(vertex), parents, |mask| write(&mut Named { mask, name }));
    }

    /// Shows the mask of any value.
    pub(super) fn assign_value(&mut self, id: ValueId, parents: &[VertexId], write: impl FnOnce(&mut Mask<ValueId>)) {
        if self.are_masks_read {
            self.mask.clear();
            write(&mut self.mask);
        }
        (self.take)(Assignment { id, parents, pass: self.pass, mask: Some(&self.mask) });
    }

    /// Shows that a kept value is not needed any more.
    pub(super) fn drop(&mut self, id: ValueId) {
        (self.take)(Assignment { id, parents: &[], pass: self.pass, mask: None });
    }

    /// Ends a pass.
    pub(super) fn next_pass(&mut self) {
        self.pass += 1;
    }
}

/// Takes a mask of vertices under the names of their values.
pub(super) struct Named<'a, F> {
    pub(super) mask: &'a mut Mask<ValueId>,
    pub(super) name: F,
}

impl<F: Fn(VertexId) -> ValueId> MaskSink for Named<'_, F> {
    fn group(&mut self, weight: f64, vertices: impl IntoIterator<Item = VertexId>) {
        self.mask.group(weight, vertices.into_iter().map(&self.name));
    }
}

impl Control<'_> {
    /// Whether the follower, if there is one, can take a step that may read kept values of the steps before, if there are
    /// any.
    pub(super) fn allow_follower(&self, has_kept: bool) -> Result<(), RefineError> {
        match &self.follower {
            Some(follower) if has_kept && !follower.has_kept() => Err(RefineError::JoinedLate),
            _ => Ok(()),
        }
    }

    /// Shows the masks of a step to the follower, if there is one.
    ///
    /// Whatever the kind of the split, a step calls this once, when nothing can fail any more. `write` assigns, with the
    /// masks of the positions, every new vertex and every old one that moves; it is called as often as the follower wants.
    /// A value that is kept for later steps is named here too, and dropped here.
    pub(super) fn show(&mut self, before: usize, after: usize, write: impl Fn(&mut MaskWriter<'_>)) {
        if let Some(follower) = &mut self.follower {
            follower.follow(&StepMasks { before, after, write: &write });
        }
    }
}
