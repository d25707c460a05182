//! The limit of any scheme, chosen while the program runs.

use super::{ButterflyLimit, Limit, LoopLimit, ModifiedButterflyLimit, Sqrt3Limit};
use crate::id::VertexId;
use crate::mesh::Neighborhood;
use crate::scheme::MaskSink;

/// One of the limits.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum AnyLimit {
    /// [`LoopLimit`].
    Loop(LoopLimit),
    /// [`ButterflyLimit`].
    Butterfly(ButterflyLimit),
    /// [`ModifiedButterflyLimit`].
    ModifiedButterfly(ModifiedButterflyLimit),
    /// [`Sqrt3Limit`].
    Sqrt3(Sqrt3Limit),
}

/// Does the same for whichever limit it is.
macro_rules! with_limit {
    ($any:expr, $limit:ident => $do:expr) => {
        match $any {
            AnyLimit::Loop($limit) => $do,
            AnyLimit::Butterfly($limit) => $do,
            AnyLimit::ModifiedButterfly($limit) => $do,
            AnyLimit::Sqrt3($limit) => $do,
        }
    };
}

impl Limit for AnyLimit {
    fn mask(&self, around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink) {
        with_limit!(self, limit => limit.mask(around, v, mask));
    }

    fn side_count(&self, around: Neighborhood<'_>, v: VertexId) -> usize {
        with_limit!(self, limit => limit.side_count(around, v))
    }

    fn tangent_masks(
        &self,
        around: Neighborhood<'_>,
        v: VertexId,
        side: usize,
        first: &mut impl MaskSink,
        second: &mut impl MaskSink,
    ) -> bool {
        with_limit!(self, limit => limit.tangent_masks(around, v, side, first, second))
    }
}

macro_rules! from_limit {
    ($($limit:ident: $variant:ident),*) => {
        $(impl From<$limit> for AnyLimit {
            fn from(limit: $limit) -> Self {
                Self::$variant(limit)
            }
        })*
    };
}

from_limit!(
    LoopLimit: Loop,
    ButterflyLimit: Butterfly,
    ModifiedButterflyLimit: ModifiedButterfly,
    Sqrt3Limit: Sqrt3
);
