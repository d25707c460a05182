//! What goes along with a mesh from step to step, by the masks that make its positions.
//!
//! A step replaces the positions by weighted sums of the old ones. Whatever else belongs to the vertices (a colour, a
//! weight, the row of a matrix) is replaced in the same way by a [`Follower`], to which the step shows its masks.
//!
//! **Deliberately not here**: what is done with the masks.

use std::fmt;

use super::Control;
use crate::id::VertexId;
use crate::scheme::Mask;

/// What goes along with a mesh; given to a step with [`Control::follower`].
///
/// ```
/// use vvmesh::adaptive::Uniform;
/// use vvmesh::scheme::Loop;
/// use vvmesh::scratch::Scratch;
/// use vvmesh::select::Selection;
/// use vvmesh::step::{History, Keep};
/// use vvmesh::subdivide::{Control, Follower, StepMasks, Subdivider};
/// use vvmesh::shapes;
///
/// /// A number a vertex.
/// struct Heat(Vec<f64>);
///
/// impl Follower for Heat {
///     fn follow(&mut self, step: &StepMasks<'_>) {
///         let mut new = self.0.clone();
///         new.resize(step.vertex_count_after(), 0.0);
///         step.for_each(|shown| new[shown.vertex.index()] = shown.mask.apply(|v| self.0[v.index()]));
///         self.0 = new;
///     }
/// }
///
/// let mut mesh = shapes::icosahedron();
/// let mut heat = Heat(mesh.positions().iter().map(|position| position.x).collect());
/// let mut history = History::new(&mesh, Keep::default());
/// let control = &mut Control { follower: Some(&mut heat), ..Control::default() };
/// let (subdivider, all) = (Subdivider::new(Loop::default(), Uniform), Selection::empty());
/// subdivider.step(&mut mesh, &mut history, &all, &mut Scratch::new(), control)?;
/// assert!(mesh.positions().iter().map(|position| position.x).eq(heat.0));
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
pub trait Follower {
    /// Takes one step.
    ///
    /// Called once a step, after all that can fail and before anything is written: so a step that fails is shown to
    /// nobody, and one that is shown is made. A step that has no masks of the mesh before it fails with
    /// [`RefineError::NoMasks`](crate::error::RefineError::NoMasks).
    fn follow(&mut self, step: &StepMasks<'_>);
}

/// The masks of one step.
///
/// They tell the step: a vertex that they name gets the sum of *old* values that its mask says, one that they do not name
/// keeps its value. Named are the old vertices that the scheme moves, if it moves any, and all new ones. The same is shown
/// of a region that is the whole mesh as of the whole mesh.
pub struct StepMasks<'a> {
    before: usize,
    after: usize,
    write: &'a dyn Fn(&mut MaskWriter<'_>),
}

/// The mask of one vertex in a step.
#[derive(Clone, Copy, Debug)]
pub struct Assignment<'a> {
    /// The vertex that gets a new value.
    pub vertex: VertexId,
    /// The vertices that a new vertex was made of, in the order of its [`Lineage`](crate::step::Lineage); none for an old
    /// vertex.
    pub parents: &'a [VertexId],
    /// The weights of its new value.
    pub mask: &'a Mask,
}

impl StepMasks<'_> {
    /// How many vertices there are before the step. Masks name only these.
    #[must_use]
    pub fn vertex_count_before(&self) -> usize {
        self.before
    }

    /// How many vertices there are after it: those before, and behind them the new ones.
    #[must_use]
    pub fn vertex_count_after(&self) -> usize {
        self.after
    }

    /// Shows the masks in ascending order of their vertices. They are computed anew each time. O(region).
    pub fn for_each(&self, mut take: impl FnMut(Assignment<'_>)) {
        (self.write)(&mut MaskWriter { mask: Mask::default(), take: &mut take });
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
    mask: Mask,
    take: &'a mut dyn FnMut(Assignment<'_>),
}

impl MaskWriter<'_> {
    /// Shows the mask of the next vertex; see [`Assignment`] for what `parents` are.
    pub(super) fn assign(&mut self, vertex: VertexId, parents: &[VertexId], write: impl FnOnce(&mut Mask)) {
        self.mask.clear();
        write(&mut self.mask);
        (self.take)(Assignment { vertex, parents, mask: &self.mask });
    }
}

impl Control<'_> {
    /// Shows the masks of a step to the follower, if there is one.
    ///
    /// Whatever the kind of the split, a step calls this once, when nothing can fail any more and all is still as before.
    /// `write` assigns, ascending by id, every old vertex that moves and every new vertex, in terms of the old vertices and
    /// with the masks of the positions; it is called as often as the follower wants.
    pub(super) fn show(&mut self, before: usize, after: usize, write: impl Fn(&mut MaskWriter<'_>)) {
        if let Some(follower) = &mut self.follower {
            follower.follow(&StepMasks { before, after, write: &write });
        }
    }
}
