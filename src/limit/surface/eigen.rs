//! The eigenbasis of the surroundings of a triangle with one extraordinary corner.
//!
//! The surface on it depends on n + 6 points: the corner X, its ring Y = r₀, Z = r₁, r₂, .. rₙ₋₁, and five *outer* points
//! o₀ .. o₄ behind Y and Z, counter-clockwise. A step maps them to those of the triangle at X, by a matrix
//!
//! | | X and ring | outer |
//! |---|---|---|
//! | X and ring | S | 0 |
//! | outer | B | D |
//!
//! Both S and D have eigenvectors in closed form: those of S are Fourier modes of the ring, with eigenvalues 1, λ and
//! 3/8 + cos(2πj/n)/4; D becomes diagonal, (1/8, 1/16, 1/8, 1/16, 1/8), in the coordinates
//! d = (o₀, o₁ − o₀ − o₂, o₂, o₃ − o₂ − o₄, o₄). So nothing is solved numerically, and points are projected by sums.
//!
//! A mode of the ring with eigenvalue μ drives the outer points: with h = Bx in the coordinates d its eigenvector has
//! h/(μ − δ). Where μ = δ there is none. For the alternating mode, μ = 1/8, h is 0 and so is the part. For n = 3, λ = 1/16
//! and two h are not 0: there are two blocks of Jordan's, and instead of (μᵐ − δᵐ)/(μ − δ) stands its limit m δᵐ⁻¹.

use std::f64::consts::TAU;

use glam::DVec3;

use super::Evaluation;
use super::bezier::Bezier;
use super::fan::{Fan, Fans, Rule};
use crate::scheme::LoopWeights;

/// The eigenvalues of the outer points.
const OUTER: [f64; 5] = [0.125, 0.0625, 0.125, 0.0625, 0.125];

/// An eigenvector on the ring, and how it drives the outer points.
#[derive(Clone, Debug)]
struct Mode {
    eigenvalue: f64,
    /// The part of the eigenvector at the outer points, in the coordinates d.
    outer: [f64; 5],
    /// h/δ for those outer points with the same eigenvalue, else 0.
    growth: [f64; 5],
    /// The polynomials of the eigenvector on the triangles at Y, at Z and between, after a step.
    nets: [[f64; 15]; 3],
}

/// The eigenbasis for one valence.
///
/// Source: `[stam1998]`; the closed forms, and the coordinates in which they are, were derived.
#[derive(Clone, Debug)]
pub(super) struct EigenBasis {
    n: usize,
    /// λ, then for j from 1 the modes cos(2πj/n) and sin(2πj/n), the last without a sine if n is even. The eigenvector of 1
    /// is constant and needs no numbers.
    ring: Vec<Mode>,
    /// The eigenvectors on the outer points alone.
    outer: [[[f64; 15]; 3]; 5],
    /// X in the eigenvector of λ, whose ring is 1.
    center: f64,
}

impl EigenBasis {
    pub(super) fn new(weights: LoopWeights, n: usize) -> Self {
        let rule = Rule::smooth(weights, n);
        let lambda = weights.lambda(n);
        // From λr = 3/8 x + 5/8 r, with r = 1.
        let center = (lambda - 0.625) / 0.375;
        let mut ring = vec![Mode::new(rule, lambda, center, &vec![1.0; n])];
        for j in 1..=n / 2 {
            let eigenvalue = 0.375 + 0.25 * (TAU * (j as f64 / n as f64)).cos();
            let angle = |i: usize| TAU * ((i * j % n) as f64 / n as f64);
            ring.push(Mode::new(rule, eigenvalue, 0.0, &(0..n).map(|i| angle(i).cos()).collect::<Vec<_>>()));
            if 2 * j < n {
                ring.push(Mode::new(rule, eigenvalue, 0.0, &(0..n).map(|i| angle(i).sin()).collect::<Vec<_>>()));
            }
        }
        let outer = std::array::from_fn(|d| {
            let mut unit = [0.0; 5];
            unit[d] = 1.0;
            nets(rule, 0.0, &vec![0.0; n], unit)
        });
        Self { n, ring, outer, center }
    }

    /// The coefficients of the points of a triangle whose first corner has this valence and whose others are regular;
    /// `limit` is where the first corner ends. `None` if that is not so.
    pub(super) fn project(&self, fans: &Fans, limit: DVec3) -> Option<Coefficients> {
        let [x, y, z] = &fans.0;
        let ring = x.smooth_ring().filter(|ring| ring.len() == self.n)?;
        let ([.., o0, o1, o2], [_, _, _, o3, o4, _]) = (y.hexagon()?, z.hexagon()?);
        let n = self.n as f64;
        // Seen from the limit, the part of the constant mode is 0, and derivatives lose nothing to it.
        let ring: Vec<DVec3> = ring.iter().map(|&r| r - limit).collect();
        let [o0, o1, o2, o3, o4] = [o0, o1, o2, o3, o4].map(|o| o - limit);
        let mean = ring.iter().sum::<DVec3>() / n;
        let mut modes = vec![(mean - (x.center - limit)) / (1.0 - self.center)];
        for j in 1..=self.n / 2 {
            let angle = |i: usize| TAU * ((i * j % self.n) as f64 / n);
            let sum =
                |weight: &dyn Fn(usize) -> f64| ring.iter().enumerate().map(|(i, &r)| weight(i) * r).sum::<DVec3>();
            if 2 * j < self.n {
                modes.push(2.0 / n * sum(&|i| angle(i).cos()));
                modes.push(2.0 / n * sum(&|i| angle(i).sin()));
            } else {
                modes.push(sum(&|i| angle(i).cos()) / n);
            }
        }
        let mut outer = [o0, o1 - o0 - o2, o2, o3 - o2 - o4, o4];
        let mut growth = [DVec3::ZERO; 5];
        for (mode, &coefficient) in self.ring.iter().zip(&modes) {
            for d in 0..5 {
                outer[d] -= mode.outer[d] * coefficient;
                growth[d] += mode.growth[d] * coefficient;
            }
        }
        Some(Coefficients { limit, modes, outer, growth })
    }

    /// The point and its derivatives at barycentric coordinates, of which `y` and `z` are not both 0.
    pub(super) fn evaluate(&self, coefficients: &Coefficients, [_, mut y, mut z]: [f64; 3]) -> Evaluation {
        // Towards X until the point is not in the triangle at X: k = floor(1 - log2(y + z)) steps, the last of which is in
        // the nets.
        let mut steps = 0;
        while y + z <= 0.5 {
            (y, z) = (2.0 * y, 2.0 * z);
            steps += 1;
        }
        let x = 1.0 - y - z;
        let (tile, sign, at) = match (y > 0.5, z > 0.5) {
            (true, _) => (0, 1.0, [2.0 * x, 2.0 * y - 1.0, 2.0 * z]),
            (_, true) => (1, 1.0, [2.0 * x, 2.0 * y, 2.0 * z - 1.0]),
            _ => (2, -1.0, [1.0 - 2.0 * x, 1.0 - 2.0 * y, 1.0 - 2.0 * z]),
        };
        let mut points = [DVec3::ZERO; 15];
        let mut add = |net: &[f64; 15], coefficient: DVec3| {
            for (point, &value) in points.iter_mut().zip(net) {
                *point += value * coefficient;
            }
        };
        for (mode, &coefficient) in self.ring.iter().zip(&coefficients.modes) {
            add(&mode.nets[tile], mode.eigenvalue.powi(steps) * coefficient);
        }
        let outer = coefficients.outer.iter().zip(&coefficients.growth).zip(OUTER);
        for (nets, ((&own, &growth), eigenvalue)) in self.outer.iter().zip(outer) {
            add(&nets[tile], eigenvalue.powi(steps) * (own + f64::from(steps) * growth));
        }
        Bezier(points).evaluate(at).scaled(sign * 2.0_f64.powi(steps + 1)).moved(coefficients.limit)
    }
}

/// A triangle's points in the eigenbasis, seen from the limit of its first corner.
#[derive(Clone, Debug)]
pub(super) struct Coefficients {
    limit: DVec3,
    modes: Vec<DVec3>,
    outer: [DVec3; 5],
    growth: [DVec3; 5],
}

impl Mode {
    fn new(rule: Rule, eigenvalue: f64, x: f64, r: &[f64]) -> Self {
        let [y, z, after_z, before_y] = [r[0], r[1], r[2], r[r.len() - 1]];
        // What a step makes of the outer points by the ring alone.
        let [o0, o2, o4] = [[y, before_y], [y, z], [z, after_z]].map(|[p, q]| 0.375 * (p + q) + 0.125 * x);
        let o1 = 0.625 * y + 0.0625 * (x + before_y + z);
        let o3 = 0.625 * z + 0.0625 * (x + y + after_z);
        let driven = [o0, o1 - o0 - o2, o2, o3 - o2 - o4, o4];
        let (mut outer, mut growth) = ([0.0; 5], [0.0; 5]);
        for d in 0..5 {
            if eigenvalue == OUTER[d] {
                growth[d] = driven[d] / OUTER[d];
            } else {
                outer[d] = driven[d] / (eigenvalue - OUTER[d]);
            }
        }
        Self { eigenvalue, outer, growth, nets: nets(rule, x, r, outer) }
    }
}

/// The polynomials of a vector of points on the triangles at Y, at Z and between, after a step.
fn nets(rule: Rule, x: f64, r: &[f64], [d0, d1, d2, d3, d4]: [f64; 5]) -> [[f64; 15]; 3] {
    let [o0, o1, o2, o3, o4] = [d0, d1 + d0 + d2, d2, d3 + d2 + d4, d4];
    let [y, z, after_z, before_y] = [r[0], r[1], r[2], r[r.len() - 1]];
    let regular = Rule::Smooth([0.625, 0.0625]);
    let fan = |center: f64, neighbors: &[f64], rule| {
        Fan::whole(DVec3::splat(center), neighbors.iter().map(|&value| DVec3::splat(value)), rule)
    };
    let fans = Fans([
        fan(x, r, rule),
        fan(y, &[z, x, before_y, o0, o1, o2], regular),
        fan(z, &[x, y, o2, o3, o4, after_z], regular),
    ]);
    let net = |part| fans.part(part).bezier().expect("all corners but X are regular").0.map(|point| point.x);
    [1, 2, 3].map(net)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::limit::surface::follow;

    /// A triangle whose first corner has `n` neighbours, with points that nothing relates.
    fn triangle(weights: LoopWeights, n: usize) -> Fans {
        let point = |k: usize| {
            let wave = |salt: usize| ((k * 37 + salt * 17) % 23) as f64 / 23.0 - 0.5;
            DVec3::new(wave(1), wave(2), wave(3))
        };
        let ring: Vec<DVec3> = (1..=n).map(point).collect();
        let [o0, o1, o2, o3, o4] = [1, 2, 3, 4, 5].map(|k| point(n + k));
        let (x, y, z) = (point(0), ring[0], ring[1]);
        let regular = Rule::Smooth([0.625, 0.0625]);
        Fans([
            Fan::whole(x, ring.iter().copied(), Rule::smooth(weights, n)),
            Fan::whole(y, [z, x, ring[n - 1], o0, o1, o2], regular),
            Fan::whole(z, [x, y, o2, o3, o4, ring[2]], regular),
        ])
    }

    fn limit(weights: LoopWeights, fans: &Fans, n: usize) -> DVec3 {
        let ring = fans.0[0].smooth_ring().expect("the corner is smooth");
        let chi = 1.0 / (0.375 / weights.alpha(n) + n as f64);
        (1.0 - n as f64 * chi) * fans.0[0].center + chi * ring.iter().sum::<DVec3>()
    }

    #[test]
    fn the_eigenbasis_says_what_steps_say() {
        for weights in [LoopWeights::Loop, LoopWeights::Warren] {
            for n in 3..=32 {
                let fans = triangle(weights, n);
                let limit = limit(weights, &fans, n);
                let basis = EigenBasis::new(weights, n);
                let coefficients = basis.project(&fans, limit).expect("the corner has this valence");
                let seen = fans.clone().moved(-limit);
                for steps in [0, 1, 2, 3, 7, 20] {
                    let small = 0.5_f64.powi(steps);
                    for [y, z] in [[0.7, 0.1], [0.2, 0.7], [0.4, 0.35], [0.0, 1.0], [0.9, 0.0], [0.5, 0.5]] {
                        let at = [1.0 - small * (y + z), small * y, small * z];
                        let expected = follow(&seen, at).moved(limit);
                        let found = basis.evaluate(&coefficients, at);
                        let what = format!("{weights:?}, valence {n}, {steps} steps, {at:?}");
                        assert!(found.position.distance(expected.position) < 1e-13, "{what}");
                        let first = found.first.iter().flatten().zip(expected.first.iter().flatten());
                        let second = found.second.iter().flatten().zip(expected.second.iter().flatten());
                        // Second derivatives are differences of what is greater by the length of the triangle.
                        let pairs = first.map(|pair| (pair, 1e-12)).chain(second.map(|pair| (pair, 1e-12 / small)));
                        for ((found, expected), tolerance) in pairs {
                            let apart = found.distance(*expected);
                            assert!(apart < tolerance * (1.0 + expected.length()), "{what}: {apart:e}");
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn only_valence_three_has_blocks_of_jordan() {
        for n in 3..=32 {
            let basis = EigenBasis::new(LoopWeights::Loop, n);
            assert_eq!(basis.ring.len(), n);
            let grows = basis.ring.iter().any(|mode| mode.growth.iter().any(|&part| part != 0.0));
            assert_eq!(grows, n == 3, "valence {n}");
            assert!(basis.ring.iter().all(|mode| mode.outer.iter().all(|part| part.abs() < 10.0 * n as f64)));
        }
    }
}
