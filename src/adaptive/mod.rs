//! Adaptive methods: which region a step refines for a selection.
//!
//! A method is a policy. It moves no vertex and splits no edge; what it chooses is refined and closed in the same way
//! for all of them. *Uniform* takes everything, *simple* the selection as it is, or [what of it would
//! move](SimpleMoving), *incremental* the selection with the rings around it.
//!
//! *Red-green* with restriction and without, *dynamic* and *static/mobile* choose by more than the mesh and the selection. They
//! are no methods of this kind but ways in which a [`Subdivider`](crate::subdivide::Subdivider) is made.
//!
//! **Deliberately not here**: how a selection follows the refinement; that is the same for all methods, see
//! [`crate::subdivide`].

mod incremental;
mod simple;
mod simple_moving;
mod uniform;

pub use incremental::Incremental;
pub use simple::Simple;
pub use simple_moving::SimpleMoving;
pub use uniform::Uniform;

use std::fmt;

use crate::mesh::Mesh;
use crate::scratch::Scratch;
use crate::select::Selection;
use crate::step::Region;

/// A choice of what a step refines of the mesh as it is.
pub trait AdaptiveMethod: fmt::Debug + Send + Sync {
    /// The region to refine for a selection whose vertices all exist.
    fn region(&self, mesh: &Mesh, selection: &Selection, scratch: &mut Scratch) -> Region;

    /// Whether the method promises that a selection which follows the refinement is refined exactly as by uniform steps.
    fn promises_exactness(&self) -> bool;
}
