//! The distance between a mesh and its limit surface as it is.

use glam::DVec3;

use super::refuse_without_limit;
use crate::error::PredictError;
use crate::id::{Triangle, VertexId};
use crate::limit::LimitSurface;
use crate::mesh::Mesh;
use crate::parallel;
use crate::scheme::LoopWeights;

/// The greatest distances that were found between a mesh and its limit surface.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Measured {
    /// Of all points that were looked at.
    pub distance: f64,
    /// Of the vertices alone.
    pub at_vertices: f64,
}

impl Measured {
    /// Compares points of every triangle with those of the limit surface of the same parameters, which is evaluated
    /// exactly: the corners, and all others that cut every side into `divisions` equal parts and lie on the lines between
    /// those, (d + 1)(d + 2)/2 for d of them. Between them it may be greater; the nearest point of the surface may be
    /// nearer than that of the same parameters. O(faces · d²).
    ///
    /// For a mesh that uniform steps made of another it is the distance to the surface of that one, too.
    ///
    /// ```
    /// use vvmesh::predict::{DistanceBound, Measured};
    /// use vvmesh::{scheme::LoopWeights, shapes};
    /// let (mesh, weights) = (shapes::icosahedron(), LoopWeights::Loop);
    /// let measured = Measured::new(&mesh, weights, 4)?;
    /// assert!(measured.at_vertices <= measured.distance);
    /// assert!(measured.distance <= DistanceBound::new(&mesh, weights)?.at(0));
    /// # Ok::<(), vvmesh::error::PredictError>(())
    /// ```
    ///
    /// # Errors
    /// If something is [semi-sharp](PredictError::SemiSharp) or [too great](PredictError::NonFinite).
    ///
    /// # Panics
    /// If `divisions` is 0.
    pub fn new(mesh: &Mesh, weights: LoopWeights, divisions: u32) -> Result<Self, PredictError> {
        assert!(divisions > 0, "a side has one part at least");
        let at_vertices = refuse_without_limit(mesh, weights)?.into_iter().fold(0.0, f64::max);
        let surface = LimitSurface::new(mesh, weights);
        let mut greatest = Vec::with_capacity(mesh.vertex_count());
        parallel::append(&mut greatest, 0..mesh.vertex_count(), |v| {
            let triangles = mesh.rotation().triangles_of_smallest(VertexId::new(v));
            triangles.map(|triangle| on_triangle(&surface, mesh, triangle, divisions)).fold(0.0, f64::max)
        });
        Ok(Self { distance: greatest.into_iter().fold(at_vertices, f64::max), at_vertices })
    }
}

fn on_triangle(surface: &LimitSurface<'_>, mesh: &Mesh, triangle: Triangle, divisions: u32) -> f64 {
    let patch = surface.patch(triangle).expect("nothing of the mesh is semi-sharp");
    let [a, b, c] = triangle.corners().map(|v| mesh.position(v));
    let distance = |i: u32, j: u32| {
        let [u, v] = [i, j].map(|k| f64::from(k) / f64::from(divisions));
        let point: DVec3 = c + u * (a - c) + v * (b - c);
        point.distance_squared(patch.evaluate(u, v).position)
    };
    let row = |i| (0..=divisions - i).map(move |j| (i, j));
    (0..=divisions).flat_map(row).map(|(i, j)| distance(i, j)).fold(0.0, f64::max).sqrt()
}
