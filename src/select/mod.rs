//! What is to be refined: vertices, edges or faces.
//!
//! A [`Criterion`] reads a mesh and answers with a [`Selection`], which a refinement then expands to its region. Criteria are values with typed parameters that combine with `and`, `or` and `not`; a closure is one too.
//! An [`Expression`] is a criterion made from text.
//!
//! Read in this order: [`Selection`], [`Criterion`], the criteria, [`Expression`].
//!
//! | select | criteria |
//! |---|---|
//! | vertices | [`All`], [`Vertices`], [`Disk`], [`Sphere`], [`Dihedral`], [`LimitError`], [`Curvature`], [`CurvatureTop`], [`MeanCurvature`], [`NormalCone`], [`Flatness`], [`Valence`], [`Field`] |
//! | edges | [`EdgeLength`], [`Boundary`], [`Sharp`], [`Silhouette`], [`PixelLength`] |
//! | faces | [`Faces`], [`NormalAngle`], [`Area`], [`Frustum`], [`PixelArea`] |
//!
//! Those that measure select what is strictly above a threshold. What they measure can be asked for by itself: in
//! [`query`](crate::query), [`limit`](crate::limit) and [`camera`](crate::camera).
//!
//! **Deliberately not here**: how far the refinement reaches beyond the selection, and how a selection follows it.

mod criteria;
mod expression;
mod selection;

pub use criteria::{
    All, And, Area, Boundary, Comparison, Criterion, Curvature, CurvatureTop, Dihedral, Disk, EdgeLength, Faces, Field,
    Flatness, Frustum, LimitError, MeanCurvature, NormalAngle, NormalCone, Not, Or, PixelArea, PixelLength, Sharp,
    Silhouette, Sphere, Valence, Vertices,
};
pub use expression::Expression;
pub(crate) use selection::Unknown;
pub use selection::{Elements, Selection};
