//! Subdivision schemes: which weights make a new position.
//!
//! A [`Scheme`] answers, for an old vertex or for the [`Parent`] of a new one, with a [`Mask`]: groups of vertices with a
//! weight. It sees rings and tags through a [`Neighborhood`], no positions, and edits nothing.
//!
//! **Deliberately not here**: the positions ([`crate::subdivide`] applies masks to them) and the topology of a split
//! ([`crate::split`]).

mod mask;

pub use mask::{Mask, MaskSink};

use crate::id::VertexId;
use crate::mesh::Neighborhood;
use crate::step::Parent;

/// Which stars the position of an odd vertex is a function of; the exactness certificate stands on it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Reach {
    /// The two ends of the edge alone.
    Ends,
    /// The star of any one end: the two triangles on the edge.
    OneStar,
    /// The stars of both ends.
    BothStars,
}

/// A set of masks for the split of a triangle in four.
pub trait Scheme {
    /// Whether even vertices move. If not, [`Scheme::even`] is never asked.
    fn moves_even(&self) -> bool;

    /// What the position of an odd vertex depends on.
    fn reach(&self) -> Reach;

    /// Writes the mask of an even vertex.
    fn even(&self, around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink);

    /// Writes the mask of the odd vertex on an edge.
    fn odd(&self, around: Neighborhood<'_>, parent: &Parent, mask: &mut impl MaskSink);
}
