//! The words of one refinement step.
//!
//! A [`Region`] says what is split, a [`SplitKind`] how; every new vertex on an edge has a [`Parent`]; a [`History`]
//! remembers, from step to step, what the mesh itself does not: who is older, where vertices come from (their
//! [`Lineage`]), and what is proven of them.
//!
//! **Deliberately not here**: what is done with them; see [`crate::subdivide`].

mod blocks;
mod exactness;
mod hierarchy;
mod history;
mod kind;
mod lineage;
mod mobility;
mod motion;
mod parent;
mod places;
mod refinement;
mod region;

pub use blocks::Blocks;
pub(crate) use blocks::{Bisections, InputBlocks};
pub use exactness::{Cause, Spoiler};
pub(crate) use exactness::{Exactness, Proof};
pub(crate) use hierarchy::{Birth, Hierarchy};
pub use history::{History, Keep};
pub use kind::SplitKind;
pub use lineage::Lineage;
pub(crate) use mobility::Mobility;
pub(crate) use motion::{Motion, Motions, Weights};
pub use parent::Parent;
pub(crate) use places::Places;
pub(crate) use refinement::Refinement;
pub use region::Region;
pub(crate) use region::RegionKind;
