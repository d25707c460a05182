//! Refining a mesh by drawing on it.
//!
//! A [`Pen`] is moved over a mesh by [events](Event): a time, where it points, and a [`Brush`], which says how far around that
//! place vertices are *touched* and to which level. The slower it moves, the finer becomes what is under it: each event refines
//! what is touched by no more than a level, and as long as the pen *dwells*, the level that is wanted rises with the time.
//!
//! The level of a vertex is that of the coarsest face around it, a face having the greatest level of its corners (one that
//! closes a crack counts one more than it would by [`History::face_level`](crate::step::History::face_level)). Source:
//! `[incremental]`, figure 29; how long a pen dwells, and what of its surroundings is done already, it leaves open.
//!
//! What is drawn depends on mesh, scheme, method and events alone, to the last bit.
//!
//! Read in this order: [`Event`], [`Brush`], [`Pen`], [`Touch`].
//!
//! **Deliberately not here**: where a ray meets a mesh ([`crate::pick`]), and files of events.

mod brush;
mod pen;
mod stars;

pub use brush::{Brush, Radius};
pub use pen::{Pen, PenMethod, Touch};

use crate::pick::Ray;

/// What a pen does at a time.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Event {
    /// When, in seconds. Events come in the order of their times.
    pub time: f64,
    /// Where the pen points.
    pub aim: Aim,
    /// How it draws.
    pub brush: Brush,
}

/// Where a pen points.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Aim {
    /// To where a ray meets the mesh first, as from an eye through a point of a screen.
    Along(Ray),
    /// To where the line through the origin of a ray meets the mesh nearest to it, before it or behind. So a place of the input
    /// is named, with the normal there: refinement leaves the surface near it.
    Near(Ray),
}
