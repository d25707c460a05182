//! Subdivision schemes: which weights make a new position.
//!
//! A [`Scheme`] answers, for an old vertex or for the [`Parent`] of a new one, with a [`Mask`]: groups of vertices with a
//! weight. It sees rings and tags through a [`Neighborhood`], no positions, and edits nothing.
//!
//! [`Loop`] approximates: even vertices move and the limit is smooth. [`Butterfly`] and [`ModifiedButterfly`] interpolate:
//! even vertices stay. [`Midpoint`] changes the triangles and not the surface. These split a triangle in four; [`Sqrt3`]
//! splits it otherwise, so its new vertices have other parents and it has mask methods of its own. [`AnyScheme`] is any of
//! them.
//!
//! Every mask adds to 1 (up to the rounding of its weights) and reads the stars of the vertex, or of both ends of the edge,
//! and nothing else: the exactness of incremental refinement stands on that.
//!
//! **Deliberately not here**: the positions ([`crate::subdivide`] applies masks to them) and the topology of a split
//! ([`crate::split`]).

mod any;
mod butterfly;
mod four_eight;
mod loop_;
mod mask;
mod midpoint;
mod modified_butterfly;
mod sqrt3;

pub use any::AnyScheme;
pub(crate) use any::with_scheme;
pub use butterfly::Butterfly;
pub use four_eight::FourEight;
pub use loop_::{Loop, LoopWeights};
pub(crate) use loop_::{cos_of_turn, crease_neighbors};
pub(crate) use mask::WeightedSum;
pub use mask::{Mask, MaskSink};
pub use midpoint::Midpoint;
pub use modified_butterfly::ModifiedButterfly;
pub use sqrt3::Sqrt3;

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
///
/// A step asks for a mask a vertex, in loops that are compiled for each scheme; so masks are short, what is rare stands in
/// functions of its own, and both methods that write masks are always inlined: a compiler left to choose counts how often a
/// method is named, and not that one of the loops takes all the time (a tenth more instructions for a step of Loop).
pub trait Scheme {
    /// Whether even vertices move. If not, [`Scheme::even`] is never asked.
    fn moves_even(&self) -> bool;

    /// Whether sharp edges and corners change its masks.
    fn reads_tags(&self) -> bool;

    /// Whether semi-sharp edges and vertices blend its masks. If not, and tags change its masks at all, a mesh with
    /// semi-sharp ones is refused.
    fn blends_sharpness(&self) -> bool {
        false
    }

    /// What the position of an odd vertex depends on.
    fn reach(&self) -> Reach;

    /// Writes the mask of an even vertex. The default leaves it where it is.
    #[inline]
    fn even(&self, _around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink) {
        mask.group(1.0, [v]);
    }

    /// Writes the mask of the odd vertex on an edge.
    fn odd(&self, around: Neighborhood<'_>, parent: &Parent, mask: &mut impl MaskSink);
}
