//! Splitting without smoothing.

use super::{MaskSink, Reach, Scheme};
use crate::mesh::Neighborhood;
use crate::step::Parent;

/// Every new vertex is the midpoint of its edge and no vertex moves: the surface stays as it is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Midpoint;

impl Scheme for Midpoint {
    #[inline]
    fn moves_even(&self) -> bool {
        false
    }

    fn reads_tags(&self) -> bool {
        false
    }

    #[inline]
    fn reach(&self) -> Reach {
        Reach::Ends
    }

    #[inline(always)]
    fn odd(&self, _around: Neighborhood<'_>, parent: &Parent, mask: &mut impl MaskSink) {
        mask.group(0.5, [parent.p, parent.q]);
    }
}
