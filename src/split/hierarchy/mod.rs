//! Topology of a [`Hierarchy`](crate::step::Hierarchy): its levels, what a new split needs, and the mesh that is shown.
//!
//! The hierarchy says which edges are split; the mesh shows the *leaves*, the triangles that are not split in four. A leaf
//! with one split edge is bisected, one with two is cut in three; one with three counts as split. These edges that close
//! cracks are no part of the hierarchy: they are drawn and wiped away as it changes, and no later step reads them.
//!
//! Read in this order: `levels` (rings and triangles of every level, read from the map and the rings as they are), `grow` (to
//! split a triangle or to require a star, with all that it needs), `shrink` (to require a star no longer), `red` (to split without requirements), `show` (to write
//! the rings of what changed). All costs what changes: nothing goes through the mesh or the hierarchy.
//!
//! **Deliberately not here**: positions, tags, and who asks for what; see [`crate::subdivide`].

mod grow;
mod levels;
mod red;
mod show;
mod shrink;
#[cfg(test)]
mod tests;

pub(crate) use grow::{Grower, Growth};
pub(crate) use levels::{Across, Levels};
pub(crate) use red::{Red, leaf_of};
pub(crate) use show::{Shown, leaves_around, show};
pub(crate) use shrink::Shrinker;
