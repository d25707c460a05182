//! The estimate of paper 3: how deep, and how many faces, from the distances of the vertices to their limits.

use super::refuse_without_limit;
use crate::accuracy::Accuracy;
use crate::error::PredictError;
use crate::id::VertexId;
use crate::limit::{Limit, LoopLimit};
use crate::mesh::{Mesh, VertexClass};
use crate::parallel;
use crate::scheme::LoopWeights;

/// The valence of new vertices: none contracts as if it had fewer neighbours.
const REGULAR: usize = 6;

/// At what rate the distance of a vertex is taken to shrink.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Rate {
    /// λ(n) with n = max(6, valence), since around any vertex new ones of valence 6 appear.
    WithNewVertices,
    /// λ of the valence: that of the vertex itself.
    OwnValence,
}

/// How deep uniform subdivision has to go for an accuracy, estimated from the vertices of the mesh.
///
/// With M⁰ the greatest distance of a vertex to its limit, N the greatest valence or 6 and λ(N) = 5/8 − Nα(N), the estimate
/// of the distance at depth k is M⁰ λ(N)ᵏ, and that at one vertex its own distance times λ(max(6, n))ᵏ. A face takes the
/// greatest depth of its corners.
///
/// It is an estimate. The distance of one vertex does shrink by λ(n), exactly, but new vertices bring distances of their
/// own: on regular meshes some shrink by no more than 0.327 in the first step, not 1/4, and around a vertex of valence other
/// than 3 and 6 new vertices slide towards it at the rate 3/8 + cos(2π/n)/4, which is above λ. What can be relied upon is
/// [`DistanceBound`](super::DistanceBound).
///
/// On creases and boundaries the distance is that of the curve, which shrinks by 1/4; corners have none. A dart is taken
/// for a smooth vertex.
///
/// ```
/// use vvmesh::predict::{Estimate, Rate};
/// use vvmesh::{Accuracy, scheme::LoopWeights, shapes};
/// let mesh = shapes::octahedron();
/// let estimate = Estimate::new(&mesh, LoopWeights::Loop)?;
/// assert_eq!((estimate.max_valence(), estimate.n(), estimate.contraction()), (4, 6, 0.25));
/// let accuracy = Accuracy::new(0.02)?;
/// assert_eq!(estimate.depth(accuracy), 3);
/// assert_eq!(estimate.vertex_depths(accuracy, Rate::OwnValence), [0, 0, 6]);
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
///
/// Source: `[mesh-size]`, theorem 1 to corollary 3. Faces of depth 0 are counted, which the printed sum leaves out.
#[derive(Clone, Debug)]
pub struct Estimate<'a> {
    mesh: &'a Mesh,
    weights: LoopWeights,
    /// By vertex.
    distances: Vec<f64>,
    greatest_distance: f64,
    max_valence: usize,
}

impl<'a> Estimate<'a> {
    /// Measures the distances of the vertices to their limits. O(vertices + edges).
    ///
    /// # Errors
    /// If something is [semi-sharp](PredictError::SemiSharp) or [too great](PredictError::NonFinite).
    pub fn new(mesh: &'a Mesh, weights: LoopWeights) -> Result<Self, PredictError> {
        let distances = refuse_without_limit(mesh, weights)?;
        let greatest_distance = distances.iter().copied().fold(0.0, f64::max);
        let max_valence = mesh.vertices().map(|v| mesh.ring(v).valence()).max().unwrap_or(0);
        Ok(Self { mesh, weights, distances, greatest_distance, max_valence })
    }

    /// M⁰, the greatest distance of a vertex to its limit.
    #[must_use]
    pub fn greatest_distance(&self) -> f64 {
        self.greatest_distance
    }

    /// The greatest valence of the mesh.
    #[must_use]
    pub fn max_valence(&self) -> usize {
        self.max_valence
    }

    /// N, the greatest valence of the mesh and those to come.
    #[must_use]
    pub fn n(&self) -> usize {
        self.max_valence.max(REGULAR)
    }

    /// λ(N), by which the distance is taken to shrink at each step.
    #[must_use]
    pub fn contraction(&self) -> f64 {
        self.weights.lambda(self.n())
    }

    /// The least depth at which the estimate for the whole mesh is below an accuracy.
    #[must_use]
    pub fn depth(&self, accuracy: Accuracy) -> u32 {
        depth(self.greatest_distance, self.contraction(), accuracy)
    }

    /// How many vertices reach an accuracy at depth 0, 1 and so on, each by its own distance. Isolated ones are counted.
    #[must_use]
    pub fn vertex_depths(&self, accuracy: Accuracy, rate: Rate) -> Vec<u64> {
        histogram(self.mesh.vertices().map(|v| self.vertex_depth(v, accuracy, rate)))
    }

    /// How many faces reach an accuracy at depth 0, 1 and so on, each by the deepest of its corners.
    #[must_use]
    pub fn face_depths(&self, accuracy: Accuracy) -> Vec<u64> {
        let mut depths = Vec::new();
        parallel::append(&mut depths, 0..self.mesh.vertex_count(), |v| {
            self.vertex_depth(VertexId::new(v), accuracy, Rate::WithNewVertices)
        });
        let deepest = |corners: [VertexId; 3]| corners.map(|v| depths[v.index()]).into_iter().fold(0, u32::max);
        histogram(self.mesh.triangles().map(|triangle| deepest(triangle.corners())))
    }

    /// How many faces a mesh has at most of which every face is refined to its own depth: Σ 4ⁱ fᵢ for fᵢ faces of depth i;
    /// `None` if 64 bits do not hold the number. Closing cracks is not counted.
    #[must_use]
    pub fn adaptive_bound(&self, accuracy: Accuracy) -> Option<u64> {
        let depths = self.face_depths(accuracy);
        let faces = |(depth, &faces): (usize, &u64)| match faces {
            0 => Some(0),
            _ => 4_u64.checked_pow(u32::try_from(depth).ok()?)?.checked_mul(faces),
        };
        depths.iter().enumerate().try_fold(0_u64, |sum, entry| sum.checked_add(faces(entry)?))
    }

    fn vertex_depth(&self, v: VertexId, accuracy: Accuracy, rate: Rate) -> u32 {
        let around = self.mesh.neighborhood();
        let valence = match around.class(v) {
            VertexClass::Smooth | VertexClass::Dart => around.ring(v).valence(),
            // Their factor is that of the regular valence, and corners are where they will be.
            VertexClass::Crease | VertexClass::Corner => REGULAR,
        };
        let n = match rate {
            Rate::WithNewVertices => valence.max(REGULAR),
            Rate::OwnValence => valence,
        };
        depth(self.distances[v.index()], self.weights.lambda(n), accuracy)
    }
}

/// The distances of all vertices to their limits.
pub(super) fn distances(mesh: &Mesh, weights: LoopWeights) -> Vec<f64> {
    let limit = LoopLimit::new(weights);
    let mut distances = Vec::with_capacity(mesh.vertex_count());
    parallel::append(&mut distances, 0..mesh.vertex_count(), |v| {
        let v = VertexId::new(v);
        mesh.position(v).distance(limit.position(mesh, v))
    });
    distances
}

/// After how many steps a distance is below an accuracy.
fn depth(mut distance: f64, contraction: f64, accuracy: Accuracy) -> u32 {
    let mut depth = 0;
    while distance >= accuracy.distance() {
        distance *= contraction;
        depth += 1;
    }
    depth
}

/// How often each depth occurs, up to the greatest.
fn histogram(depths: impl Iterator<Item = u32>) -> Vec<u64> {
    let mut counts = Vec::new();
    for depth in depths {
        let depth = depth as usize;
        if counts.len() <= depth {
            counts.resize(depth + 1, 0);
        }
        counts[depth] += 1;
    }
    counts
}
