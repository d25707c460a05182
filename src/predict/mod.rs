//! How deep, and how large, before anything is refined: the distance between a mesh and its limit surface under
//! [`Loop`](crate::scheme::Loop), foretold and measured.
//!
//! | | what it is | from |
//! |---|---|---|
//! | [`Estimate`] | a rule of thumb, sometimes too small; depths of single faces, and so of an adaptive mesh | distances of vertices |
//! | [`DistanceBound`] | proven; never too small | second differences |
//! | [`Measured`] | what is; needs the refined mesh | exact evaluation |
//!
//! A distance is that between a point of the mesh and the point of the surface with the same parameters, where the vertices
//! of all refinements keep the parameters that they have on the triangles of the input. The nearest point of the surface may
//! be nearer, never farther.
//!
//! | at | [`Estimate`] | [`DistanceBound`], [`Measured`] |
//! |---|---|---|
//! | smooth vertices | λ(n), exact for the vertex | hold |
//! | creases, boundaries | 1/4, exact for the vertex | hold |
//! | darts | as smooth, not exact | hold |
//! | corners | no distance, exact | hold |
//! | semi-sharp | refused | refused |
//!
//! An [`Accuracy`] says what is asked for, [`FullSize`] what a depth costs.
//!
//! Read in this order: [`Estimate`], [`FullSize`], [`DistanceBound`], [`Measured`].
//!
//! **Deliberately not here**: refining until an accuracy is reached ([`crate::until`]), and other schemes. The vertices
//! of interpolating ones are their own limits, so nothing can be told from their distances.

mod bound;
mod estimate;
mod face;
mod measured;
mod size;
mod star;

pub use bound::DistanceBound;
pub(crate) use bound::ROUNDING;
pub use estimate::{Estimate, Rate};
pub(crate) use face::Face;
pub use measured::Measured;
pub use size::FullSize;

use crate::error::PredictError;
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::scheme::LoopWeights;

#[cfg(doc)]
use crate::accuracy::Accuracy;

/// Refuses a mesh of which some vertex has no known limit. Answers with their distances.
fn refuse_without_limit(mesh: &Mesh, weights: LoopWeights) -> Result<Vec<f64>, PredictError> {
    if mesh.tags().has_semi_sharp() {
        let steps = |&v: &VertexId| mesh.neighborhood().semi_sharp_steps(v);
        if let Some(vertex) = mesh.vertices().max_by_key(steps).filter(|v| steps(v) > 0) {
            return Err(PredictError::SemiSharp { vertex, steps: steps(&vertex) });
        }
    }
    let distances = estimate::distances(mesh, weights);
    // Second differences are at most four coordinates long in each direction.
    let is_small = |v: usize| distances[v].is_finite() && (8.0 * mesh.positions()[v]).is_finite();
    match (0..distances.len()).find(|&v| !is_small(v)) {
        Some(v) => Err(PredictError::NonFinite(VertexId::new(v))),
        None => Ok(distances),
    }
}
