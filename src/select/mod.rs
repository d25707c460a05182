//! Which vertices are to be refined.
//!
//! **Deliberately not here**: how far the refinement reaches beyond them ([`crate::adaptive`]).

mod selection;

pub use selection::Selection;
