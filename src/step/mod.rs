//! The words of one refinement step.
//!
//! **Deliberately not here**: what is done with them; see [`crate::subdivide`].

mod parent;

pub use parent::Parent;
