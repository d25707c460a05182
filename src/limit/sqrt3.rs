//! The limit of the √3 scheme at vertices.

use std::f64::consts::{PI, TAU};

use super::Limit;
use crate::id::VertexId;
use crate::mesh::Neighborhood;
use crate::scheme::{MaskSink, cos_of_turn};

/// Limit positions, tangents and normals of the √3 scheme.
///
/// Inside, the ring turns by half a neighbour at each step; the first Fourier mode turns with it and keeps its plane. On a
/// boundary two steps are one, which cut the edges of the curve in three. So the masks hold for meshes after an even number
/// of steps; after an odd one, vertices next to the boundary have other neighbours than the next step reads. Tags are not
/// read.
///
/// Source: `[kobbelt2000]`; the tangents at boundaries were derived.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Sqrt3Limit;

impl Limit for Sqrt3Limit {
    /// Inside 1 − b for the vertex and b = 3a/(1 + 3a) for the mean of its neighbours, a = (4 − 2cos(2π/n))/9 being what a
    /// step takes of it. On a boundary 2/3, and 1/6 for each of the two neighbours along it.
    fn mask(&self, around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink) {
        let ring = around.ring(v);
        match ring.neighbors() {
            [] => mask.group(1.0, [v]),
            &[first, .., last] if ring.is_open() => {
                mask.group(2.0 / 3.0, [v]);
                mask.group(1.0 / 6.0, [first, last]);
            }
            neighbors => {
                let n = neighbors.len();
                let three_a = (4.0 - 2.0 * cos_of_turn(n)) / 3.0;
                mask.group(1.0 / (1.0 + three_a), [v]);
                mask.group(three_a / (1.0 + three_a) / n as f64, ring);
            }
        }
    }

    fn side_count(&self, around: Neighborhood<'_>, v: VertexId) -> usize {
        usize::from(around.ring(v).valence() > 0)
    }

    /// On a boundary the first runs along it and the second points inwards. With 5 neighbours and more the surface bends
    /// faster across than along the curve, with 7 and more it has no tangent plane there: the tangents are then those of
    /// the curve and of the slowest mode across, as for [`LoopLimit`](super::LoopLimit).
    fn tangent_masks(
        &self,
        around: Neighborhood<'_>,
        v: VertexId,
        side: usize,
        first: &mut impl MaskSink,
        second: &mut impl MaskSink,
    ) -> bool {
        let count = self.side_count(around, v);
        assert!(side < count, "{v} has {count} sides, there is no side {side}");
        let ring = around.ring(v);
        match ring.neighbors() {
            neighbors @ &[start, .., end] if ring.is_open() => {
                first.group(1.0, [start]);
                first.group(-1.0, [end]);
                across(v, neighbors, second);
            }
            neighbors => {
                for (j, &w) in neighbors.iter().enumerate() {
                    let (sin, cos) = (TAU * j as f64 / neighbors.len() as f64).sin_cos();
                    first.group(cos, [w]);
                    second.group(sin, [w]);
                }
            }
        }
        true
    }
}

/// The tangent across a boundary.
///
/// Two steps map p₀ to (16v + 10p₀ + pₖ)/27 and an inner pᵢ to (5v + pᵢ₋₁ + 2pᵢ + pᵢ₊₁)/9. With θ = π/k for k faces the row
/// is sin(iθ) inside and belongs to the eigenvalue (2 + 2cos θ)/9; that of one face belongs to 1/9.
fn across(v: VertexId, neighbors: &[VertexId], mask: &mut impl MaskSink) {
    let faces = neighbors.len() - 1;
    let ends = [neighbors[0], neighbors[faces]];
    if faces == 1 {
        mask.group(1.0, ends);
        mask.group(-2.0, [v]);
        return;
    }
    let theta = PI / faces as f64;
    // Σ sin(iθ) over 0 < i < k.
    let inner = 1.0 / (0.5 * theta).tan();
    let end = (3.0 * theta.sin() - 4.0 * inner) / (3.0 + 6.0 * cos_of_turn(2 * faces));
    mask.group(-2.0 * end - inner, [v]);
    mask.group(end, ends);
    for (i, &w) in neighbors.iter().enumerate().take(faces).skip(1) {
        mask.group((theta * i as f64).sin(), [w]);
    }
}
