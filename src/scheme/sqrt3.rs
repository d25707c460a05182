//! The √3 scheme.

use super::{MaskSink, cos_of_turn, crease_neighbors};
use crate::id::VertexId;
use crate::mesh::Neighborhood;

/// Weights of inner vertices are kept up to this valence; above they are computed each time.
const TABLED: usize = 32;

/// The √3 scheme of Kobbelt: a new vertex in every triangle, and every old edge turned.
///
/// | vertex | mask |
/// |---|---|
/// | new, in a triangle | 1/3 for each corner |
/// | even, inner | 1 − a(n) for itself, a(n)/n for each of n neighbours |
/// | new, a third of a boundary edge | 16/27 for the end that it is nearer to, 10/27 for the other, 1/27 for the boundary neighbour beyond the nearer end |
/// | even, between two boundary edges that are cut in three | 19/27 for itself, 4/27 for each neighbour along the boundary |
/// | even, any other on a boundary | stays |
///
/// a(n) = (4 − 2cos(2π/n))/9. Boundary edges are cut in every second step only; along the boundary the limit is a cubic
/// B-spline. Tags are not read.
///
/// ```
/// use vvmesh::scheme::{Mask, Sqrt3};
/// let mesh = vvmesh::shapes::torus(5, 4, 2.0, 1.0);
/// let v = mesh.vertices().next().unwrap();
/// let mut mask = Mask::default();
/// Sqrt3::default().even(mesh.neighborhood(), v, &mut mask);
/// assert!((mask.weight_of(v) - 2.0 / 3.0).abs() < 1e-15 && (mask.sum() - 1.0).abs() < 1e-15);
/// ```
///
/// Source: `[kobbelt2000]`; the boundary from section 5 there.
#[derive(Clone, PartialEq, Debug)]
pub struct Sqrt3 {
    table: [f64; TABLED + 1],
}

impl Default for Sqrt3 {
    fn default() -> Self {
        Self { table: std::array::from_fn(computed_alpha) }
    }
}

impl Sqrt3 {
    /// a(n), what an even inner vertex takes of the mean of its `n` neighbours; 0 for an isolated vertex, which stays.
    #[must_use]
    pub fn alpha(&self, n: usize) -> f64 {
        self.table.get(n).copied().unwrap_or_else(|| computed_alpha(n))
    }

    /// Writes the mask of the new vertex in a triangle.
    #[inline]
    pub fn center(&self, corners: [VertexId; 3], mask: &mut impl MaskSink) {
        mask.group(1.0 / 3.0, corners);
    }

    /// Writes the mask of an even vertex; on a boundary, of one between two edges that are cut.
    #[inline]
    pub fn even(&self, around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink) {
        let ring = around.ring(v);
        if ring.is_open() {
            mask.group(19.0 / 27.0, [v]);
            mask.group(4.0 / 27.0, crease_neighbors(around, v));
        } else {
            let alpha = self.alpha(ring.valence());
            mask.group(1.0 - alpha, [v]);
            mask.group(alpha / ring.valence().max(1) as f64, ring);
        }
    }

    /// Writes the mask of the new vertex that cuts a boundary edge near one end.
    #[inline]
    pub fn third(&self, around: Neighborhood<'_>, near: VertexId, far: VertexId, mask: &mut impl MaskSink) {
        let [after, before] = crease_neighbors(around, near);
        mask.group(16.0 / 27.0, [near]);
        mask.group(10.0 / 27.0, [far]);
        mask.group(1.0 / 27.0, [if after == far { before } else { after }]);
    }
}

fn computed_alpha(n: usize) -> f64 {
    if n == 0 { 0.0 } else { (4.0 - 2.0 * cos_of_turn(n)) / 9.0 }
}
