//! The limit of the original Butterfly scheme at vertices.

use std::f64::consts::{FRAC_PI_3, TAU};

use super::Limit;
use super::two_ring::{Row, TwoRing};
use crate::id::VertexId;
use crate::mesh::Neighborhood;
use crate::scheme::{Butterfly, MaskSink, Scheme};

/// Limit positions, tangents and normals of [`Butterfly`].
///
/// Vertices are at their limit from the start. Inside, the first Fourier mode of the two rings around a vertex shrinks
/// slowest for valences 4 to 7; at valence 3 it shrinks like others and from 8 on a later one is slower, so there is no
/// tangent plane. On a boundary, which is continued by parallelograms, there is one up to valence 18. Tags are not read.
///
/// ```
/// use vvmesh::limit::{ButterflyLimit, Limit};
/// use vvmesh::{VertexId, shapes};
/// let v = VertexId::new(0);
/// assert!(ButterflyLimit.normal(&shapes::icosahedron(), v, 0).is_some());
/// assert!(ButterflyLimit.normal(&shapes::tetrahedron(), v, 0).is_none());
/// ```
///
/// Source: `[dyn1990]`, `[zorin1996]` for the valences; the masks were derived.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct ButterflyLimit;

impl Limit for ButterflyLimit {
    fn mask(&self, _around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink) {
        mask.group(1.0, [v]);
    }

    fn side_count(&self, around: Neighborhood<'_>, v: VertexId) -> usize {
        usize::from(around.ring(v).valence() > 0)
    }

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
        let star = TwoRing::whole(Butterfly, around, v, 0);
        match ring.valence() {
            n @ ..=18 if ring.is_open() => on_boundary(star.row(first), star.row(second), n - 1),
            n @ 4..=7 if !ring.is_open() => inside(star.row(first), star.row(second), n),
            _ => return false,
        }
        true
    }
}

/// The first Fourier mode of the 8-point rule around an inner vertex.
///
/// With ω = 2π/n the modes of spokes, rims and far vertices are mapped by
///
/// | | | |
/// |---|---|---|
/// | p = 1/2 + cos ω/4 − cos 2ω/8 | q = −cos(ω/2)/8 | 0 |
/// | r = cos(ω/2) − cos(3ω/2)/8 | 1/8 | q |
/// | 1 | 0 | 0 |
///
/// and the weights are the left eigenvector (1, q/(μ − 1/8), q²/(μ(μ − 1/8))) of the greatest eigenvalue μ.
pub(super) fn inside<S: Scheme, M: MaskSink, N: MaskSink>(
    mut first: Row<'_, '_, S, M>,
    mut second: Row<'_, '_, S, N>,
    n: usize,
) {
    let omega = TAU / n as f64;
    let (p, q) = (0.5 + 0.25 * omega.cos() - 0.125 * (2.0 * omega).cos(), -0.125 * (0.5 * omega).cos());
    let r = (0.5 * omega).cos() - 0.125 * (1.5 * omega).cos();
    let mu = greatest_root([1.0, -p - 0.125, 0.125 * p - q * r, -q * q]);
    let rim = q / (mu - 0.125);
    let far = rim * q / mu;
    for j in 0..n {
        let (sin, cos) = (omega * j as f64).sin_cos();
        let (rim_sin, rim_cos) = (omega * (j as f64 + 0.5)).sin_cos();
        first.spoke(j, cos);
        first.rim(j, rim * rim_cos);
        first.far(j, far * cos);
        second.spoke(j, sin);
        second.rim(j, rim * rim_sin);
        second.far(j, far * sin);
    }
    first.finish();
    second.finish();
}

/// The greatest root of a polynomial of degree 3 whose roots are below 1, by Newton's method from there: beyond the greatest
/// root nothing turns, so each step stays on its side.
fn greatest_root([a, b, c, d]: [f64; 4]) -> f64 {
    let mut x = 1.0;
    loop {
        let next = x - (((a * x + b) * x + c) * x + d) / ((3.0 * a * x + 2.0 * b) * x + c);
        if next >= x {
            return x;
        }
        x = next;
    }
}

/// The two rows for the eigenvalue 1/2 at a boundary vertex with `k` faces.
///
/// They weigh spokes with xⱼ = sin and cos of (k/2 − j)φ, cos φ = 1/5, rims with −(xⱼ + xⱼ₊₁)/6 and a far vertex with −1/8 of
/// the rims at it. Up to 17 faces no other eigenvalue but 1 is as great, with 18 one is 0.501. The right eigenvectors are flat
/// fans of equilateral triangles, which the parallelograms continue; on them the signs are chosen.
fn on_boundary<S: Scheme, M: MaskSink, N: MaskSink>(first: Row<'_, '_, S, M>, second: Row<'_, '_, S, N>, k: usize) {
    let phi = 0.2_f64.acos();
    let place = |j: usize| 0.5 * k as f64 - j as f64;
    boundary_row(first, k, |j| (place(j) * phi).sin(), |j| (place(j) * FRAC_PI_3).sin());
    boundary_row(second, k, |j| (place(j) * phi).cos(), |j| (place(j) * FRAC_PI_3).cos());
}

fn boundary_row<S: Scheme, M: MaskSink>(
    mut row: Row<'_, '_, S, M>,
    k: usize,
    spoke: impl Fn(usize) -> f64,
    fan: impl Fn(usize) -> f64,
) {
    let rim = |j: usize| -(spoke(j) + spoke(j + 1)) / 6.0;
    let far = |j: usize| {
        let before = if j > 0 { rim(j - 1) } else { 0.0 };
        let after = if j < k { rim(j) } else { 0.0 };
        -0.125 * (before + after)
    };
    let on_spokes: f64 = (0..=k).map(|j| (spoke(j) + 2.0 * far(j)) * fan(j)).sum();
    let on_fan = on_spokes + (0..k).map(|j| rim(j) * (fan(j) + fan(j + 1))).sum::<f64>();
    let sign = on_fan.signum();
    for j in 0..=k {
        row.spoke(j, sign * spoke(j));
        row.far(j, sign * far(j));
    }
    for j in 0..k {
        row.rim(j, sign * rim(j));
    }
    row.finish();
}
