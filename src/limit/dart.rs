//! Darts: the one-ring with one sharp edge, whose row in the matrix is (1/2, 1/2).
//!
//! A row of weights is (ℓ for the vertex, ℓ₀ for the sharp neighbour, ℓⱼ for the j-th neighbour after it). For an
//! eigenvalue μ the columns of the matrix ask for
//!
//! - (μ − 5/8) ℓⱼ = αℓ + (ℓⱼ₋₁ − 2ℓⱼ + ℓⱼ₊₁)/8 for 0 < j < n, with 0 in place of ℓ₀ and ℓₙ, because the sharp row does not
//!   read its apexes;
//! - (μ − 1/2) ℓ₀ = αℓ + (ℓ₁ + ℓₙ₋₁)/8;
//! - (μ − 1 + nα) ℓ = 3/8 Σ ℓⱼ + ℓ₀/2.
//!
//! The first is a linear recurrence with constant coefficients: its solutions are a constant and powers of a root. So all
//! three rows have a closed form in μ, nothing is solved by iteration but μ itself for one tangent, and nothing is cached.

use std::f64::consts::{PI, TAU};

use crate::id::VertexId;
use crate::mesh::Neighborhood;
use crate::scheme::MaskSink;

/// The neighbours of a dart, counted from its sharp edge.
struct Spokes<'a> {
    neighbors: &'a [VertexId],
    sharp: usize,
}

impl<'a> Spokes<'a> {
    fn new(around: Neighborhood<'a>, v: VertexId) -> Self {
        let sharp = around.sharp_slots(v).next().expect("a dart has a sharp edge");
        Self { neighbors: around.ring(v).neighbors(), sharp }
    }

    fn at(&self, j: usize) -> VertexId {
        self.neighbors[(self.sharp + j) % self.neighbors.len()]
    }

    /// Writes a row that is the same on both sides of the sharp edge: `weight(j)` for the neighbours j and n − j.
    fn write_even(&self, weight: impl Fn(usize) -> f64, mask: &mut impl MaskSink) {
        let n = self.neighbors.len();
        for j in 1..n.div_ceil(2) {
            mask.group(weight(j), [self.at(j), self.at(n - j)]);
        }
        if n % 2 == 0 {
            mask.group(weight(n / 2), [self.at(n / 2)]);
        }
    }
}

/// The mask of the limit position: μ = 1, where the root r solves r + 1/r = 5.
pub(super) fn position(around: Neighborhood<'_>, v: VertexId, alpha: f64, mask: &mut impl MaskSink) {
    let spokes = Spokes::new(around, v);
    let n = spokes.neighbors.len();
    let root = (5.0 - 21.0_f64.sqrt()) / 2.0;
    let power = |j: usize| root.powf(j as f64);
    // With ℓ = 1.
    let plain = |j: usize| 8.0 * alpha / 3.0 * (1.0 - (power(j) + power(n - j)) / (1.0 + power(n)));
    let sharp = 2.0 * alpha + 0.5 * plain(1);
    // 1 + ℓ₀ + Σ ℓⱼ, the sum taken from the third equation.
    let total = 1.0 + 8.0 * n as f64 * alpha / 3.0 - sharp / 3.0;
    mask.group(1.0 / total, [v]);
    mask.group(sharp / total, [spokes.at(0)]);
    spokes.write_even(|j| plain(j) / total, mask);
}

/// The masks of two tangents: along the sharp edge, and to the left of it.
///
/// The second, with ℓⱼ = sin(2πj/n), belongs to μ = 3/8 + cos(2π/n)/4. The first is symmetric, and its μ = 3/8 + cos(φ)/4
/// has no closed form. Both eigenvalues are above all others but 1, so these are the tangents.
pub(super) fn tangents(
    around: Neighborhood<'_>,
    v: VertexId,
    alpha: f64,
    first: &mut impl MaskSink,
    second: &mut impl MaskSink,
) {
    let spokes = Spokes::new(around, v);
    let n = spokes.neighbors.len();
    let row = SymmetricRow::subdominant(n, alpha);
    // Of both signs the one that points to the sharp neighbour of a regular star.
    let along = row.sharp + (1..n).map(|j| row.plain(j) * (TAU * j as f64 / n as f64).cos()).sum::<f64>();
    let sign = along.signum();
    first.group(sign * row.center, [v]);
    first.group(sign * row.sharp, [spokes.at(0)]);
    spokes.write_even(|j| sign * row.plain(j), first);
    for j in 1..n {
        second.group((TAU * j as f64 / n as f64).sin(), [spokes.at(j)]);
    }
}

/// A symmetric row for μ = 3/8 + cos(φ)/4 that solves all equations but one.
///
/// The first equation is solved by ℓ = cos(nφ/2), ℓⱼ = −2α/sin²(φ/2) · (cos(nφ/2) − cos((j − n/2)φ)), the third gives ℓ₀;
/// neither has a pole. What the second lacks is the residual, and φ its zero.
struct SymmetricRow {
    n: usize,
    angle: f64,
    spread: f64,
    center: f64,
    sharp: f64,
    residual: f64,
}

impl SymmetricRow {
    /// The row of the greatest eigenvalue below 1, which has π < nφ < 3π, between the first two modes of the plain spokes
    /// alone (checked for n from 3 to 1000 with both choices of α). Bisection finds it to the last bit or two.
    ///
    /// For n = 3 there is no second mode, and φ = π only seems to be a zero: the search stops before it.
    fn subdominant(n: usize, alpha: f64) -> Self {
        let mut low = PI / n as f64;
        let mut high = (3.0 * low).min(0.9 * PI);
        let rising = Self::new(n, alpha, low).residual < 0.0;
        loop {
            let row = Self::new(n, alpha, 0.5 * (low + high));
            if row.angle <= low || row.angle >= high || row.residual == 0.0 {
                return row;
            }
            if (row.residual < 0.0) == rising {
                low = row.angle;
            } else {
                high = row.angle;
            }
        }
    }

    fn new(n: usize, alpha: f64, angle: f64) -> Self {
        let eigenvalue = 0.375 + 0.25 * angle.cos();
        let half_sin = (0.5 * angle).sin();
        let spread = -2.0 * alpha / half_sin.powi(2);
        let center = (0.5 * n as f64 * angle).cos();
        // Σ cos((j − n/2)φ) over 0 < j < n is sin((n − 1)φ/2) / sin(φ/2).
        let cosines = (0.5 * (n as f64 - 1.0) * angle).sin() / half_sin;
        let plain_sum = spread * ((n as f64 - 1.0) * center - cosines);
        let sharp = 2.0 * ((eigenvalue - 1.0 + n as f64 * alpha) * center - 0.375 * plain_sum);
        let mut row = Self { n, angle, spread, center, sharp, residual: 0.0 };
        row.residual = (eigenvalue - 0.5) * sharp - alpha * center - 0.25 * row.plain(1);
        row
    }

    fn plain(&self, j: usize) -> f64 {
        self.spread * (self.center - ((j as f64 - 0.5 * self.n as f64) * self.angle).cos())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scheme::LoopWeights;

    #[test]
    fn the_symmetric_eigenvalue_is_found_for_every_valence() {
        for weights in [LoopWeights::Loop, LoopWeights::Warren] {
            let mut before = 0.0;
            for n in 3..=1000 {
                let row = SymmetricRow::subdominant(n, weights.alpha(n));
                let eigenvalue = 0.375 + 0.25 * row.angle.cos();
                let scale = row.center.abs().max(row.sharp.abs()).max(row.plain(n / 2).abs());
                assert!(row.residual.abs() < 1e-13 * scale, "{weights:?} {n}: residual {}", row.residual);
                assert!(before < eigenvalue && eigenvalue < 0.625, "{weights:?} {n}: {eigenvalue} after {before}");
                before = eigenvalue;
            }
        }
        // By the eigenvalues of the dense matrices.
        for (n, eigenvalue) in [(3, 0.39827), (4, 0.45182), (5, 0.48094), (6, 0.5), (12, 0.56595), (60, 0.62221)] {
            let row = SymmetricRow::subdominant(n, LoopWeights::Loop.alpha(n));
            assert!((0.375 + 0.25 * row.angle.cos() - eigenvalue).abs() < 1e-5, "{n}");
        }
    }
}
