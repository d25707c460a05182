//! Methods side by side: what each makes of the same selection, beside uniform refinement.
//!
//! A [`Reference`] is where uniform steps would have the vertices of the selection that follows; it is made without a uniform
//! mesh. [`Reference::compare`] runs a method from the same input and answers with one [`Row`] a level: sizes, shape, cost,
//! and how far the vertices are from where uniform refinement has them. What cannot be run has rows, too, with the reason.
//!
//! ```
//! use vvmesh::compare::{Outcome, Reference};
//! use vvmesh::scheme::Loop;
//! use vvmesh::select::Selection;
//! use vvmesh::subdivide::AnyMethod;
//! use vvmesh::{VertexId, shapes};
//!
//! let mesh = shapes::torus(12, 8, 2.0, 1.0);
//! let selection: Selection = [0, 1, 12, 13].map(VertexId::new).into_iter().collect();
//! let reference = Reference::new(&mesh, &selection, Loop::default(), 2, None)?;
//! let equal = |method| {
//!     let rows = reference.compare(method);
//!     let Some(Outcome::Made(measures)) = rows.last().map(|row| &row.outcome) else { panic!("it is no method of Loop's") };
//!     measures.equal_percent
//! };
//! assert_eq!(equal(AnyMethod::named("incremental-1", None)?), Some(100.0));
//! assert!(equal(AnyMethod::Simple) < Some(100.0));
//! # Ok::<(), vvmesh::error::Error>(())
//! ```
//!
//! Read in this order: [`Reference`], [`Row`], [`Measures`].
//!
//! **Deliberately not here**: selections chosen anew at each level, for which no method promises the same vertices.

mod measures;
mod reference;
mod sizes;

pub use measures::Measures;
pub use reference::Reference;

/// The names of the methods that are compared unless others are asked for; see [`AnyMethod::named`](crate::subdivide::AnyMethod::named).
pub const METHODS: [&str; 8] =
    ["uniform", "simple", "red-green", "red-green-restricted", "incremental-1", "incremental-2", "mobile", "dynamic"];

/// A level of a method.
#[derive(Clone, PartialEq, Debug)]
pub struct Row {
    /// How many steps were made.
    pub level: u8,
    /// What came of it.
    pub outcome: Outcome,
}

/// What came of a level.
#[derive(Clone, PartialEq, Debug)]
pub enum Outcome {
    /// It was made.
    Made(Measures),
    /// It was not.
    Skipped {
        /// Why.
        reason: String,
        /// How many faces and vertices the mesh would have, if that is known without making it: of uniform refinement, but
        /// under 4-8.
        sizes: Option<[u64; 2]>,
    },
}
