//! The topology of refinement: what is split, in which order new vertices are numbered, and how cracks are closed.
//!
//! A step is a plan, which only reads, and its application, which rewrites rings in place. It
//! sees no coordinate; where a choice may depend on one, in faces with two split edges, the caller decides.
//!
//! There is one way for each kind of split of a region: `quadrisect`, `trisect`, and `bisect`, which stands on `generation` and
//! `matching`; and in `whole` one that splits a whole mesh.
//!
//! **Deliberately not here**: positions, tags, weights.

pub(crate) mod bisect;
mod diagonal;
pub(crate) mod generation;
pub(crate) mod hierarchy;
pub(crate) mod matching;
mod peers;
pub(crate) mod quadrisect;
pub(crate) mod trisect;
pub(crate) mod whole;

pub use diagonal::{Diagonal, Quad};
