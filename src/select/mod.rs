//! What is to be refined: vertices, edges or faces.
//!
//! A [`Criterion`] reads a mesh and answers with a [`Selection`], which a refinement then expands to its region. Criteria are values with typed parameters that combine with `and`, `or` and `not`; a closure is one too.
//! An [`Expression`] is a criterion made from text.
//!
//! Read in this order: [`Selection`], [`Criterion`], the criteria ([`All`], [`Vertices`], [`Disk`], [`Sphere`],
//! [`Dihedral`]; [`Faces`], [`NormalAngle`]), [`Expression`].
//!
//! **Deliberately not here**: how far the refinement reaches beyond the selection, and how a selection follows it.

mod criteria;
mod expression;
mod selection;

pub use criteria::{All, And, Criterion, Dihedral, Disk, Faces, NormalAngle, Not, Or, Sphere, Vertices};
pub use expression::Expression;
pub(crate) use selection::Unknown;
pub use selection::{Elements, Selection};
