//! The Loop scheme.

use std::f64::consts::TAU;

use super::{MaskSink, Reach, Scheme};
use crate::id::VertexId;
use crate::mesh::{Feature, Neighborhood, Transition, VertexClass};
use crate::step::Parent;

/// Weights of inner vertices are kept up to this valence; above they are computed each time.
const TABLED: usize = 32;

/// How much an even inner vertex takes of its neighbours.
///
/// Both choices agree at valences 3 and 6.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum LoopWeights {
    /// Loop's own: α(n) = (5/8 − (3/8 + cos(2π/n)/4)²) / n.
    ///
    /// Source: `[loop1987]`.
    #[default]
    Loop,
    /// Warren's simpler ones: 3/16 for n = 3, else 3/(8n).
    ///
    /// Source: `[warren2001]`.
    Warren,
}

impl LoopWeights {
    /// α(n), the weight of each of `n` neighbours; 0 for an isolated vertex, which stays where it is.
    #[must_use]
    pub fn alpha(self, n: usize) -> f64 {
        if n == 0 { 0.0 } else { (0.625 - self.lambda(n)) / n as f64 }
    }

    /// λ(n) = 5/8 − nα(n), by which the distance of a smooth vertex to its limit shrinks at each step; 0 for an isolated
    /// vertex.
    ///
    /// With `c` the mean of the neighbours, one step gives v' − c' = λ(v − c). Loop's is (3/8 + cos(2π/n)/4)², the square
    /// of the subdominant eigenvalue; Warren's 1/4 but for n = 3, where both have 1/16.
    #[must_use]
    pub fn lambda(self, n: usize) -> f64 {
        match (self, n) {
            (_, 0) => 0.0,
            (LoopWeights::Warren, 4..) => 0.25,
            _ => (0.375 + 0.25 * cos_of_turn(n)).powi(2),
        }
    }

    /// The weight 1 − nα of the vertex itself, and α. As 3/8 + λ the former has one rounding less.
    fn even(self, n: usize) -> [f64; 2] {
        if n == 0 { [1.0, 0.0] } else { [0.375 + self.lambda(n), self.alpha(n)] }
    }
}

/// The cosine of the `n`-th part of a full turn, exact where it is rational: so regular weights are exact too.
pub(crate) fn cos_of_turn(n: usize) -> f64 {
    match n {
        1 => 1.0,
        2 => -1.0,
        3 => -0.5,
        4 => 0.0,
        6 => 0.5,
        _ => (TAU / n as f64).cos(),
    }
}

/// The Loop scheme, with creases, darts and corners, sharp or semi-sharp.
///
/// | vertex | mask |
/// |---|---|
/// | even, smooth or dart | 1 − nα for itself, α for each neighbour |
/// | even, crease or boundary | 3/4 for itself, 1/8 for each of the two neighbours along the crease |
/// | even, corner | stays |
/// | odd, sharp or boundary edge | 1/2 for each end |
/// | odd, any other edge | 3/8 for each end, 1/8 for each opposite corner |
///
/// An isolated vertex stays. The special odd weights of Hoppe et al. beside irregular crease vertices are not used.
///
/// What is semi-sharp is treated as sharp from a sharpness of 1 on, and blends two masks below:
///
/// - An odd vertex on an edge of sharpness s < 1 takes s of the sharp mask and 1 − s of the other.
/// - An even vertex takes a part of the mask that its sharp edges call for now, and the rest of the mask that those which
///   remain after the step will call for; [`Transition`] tells the parts. A vertex that is itself of sharpness s stays for
///   the part min(s, 1), and follows its edges for the rest.
///
/// ```
/// use vvmesh::scheme::{Loop, Mask, Scheme};
/// let mesh = vvmesh::shapes::torus(5, 4, 2.0, 1.0);
/// let v = mesh.vertices().next().unwrap();
/// let mut mask = Mask::default();
/// Loop::default().even(mesh.neighborhood(), v, &mut mask);
/// assert_eq!((mask.weight_of(v), mask.sum()), (5.0 / 8.0, 1.0));
/// ```
///
/// Source: `[loop1987]`; features from `[hoppe1994]`, semi-sharp ones from `[derose1998]`.
#[derive(Clone, PartialEq, Debug)]
pub struct Loop {
    weights: LoopWeights,
    table: [[f64; 2]; TABLED + 1],
}

impl Loop {
    /// The scheme with these weights for smooth even vertices.
    #[must_use]
    pub fn new(weights: LoopWeights) -> Self {
        Self { weights, table: std::array::from_fn(|n| weights.even(n)) }
    }

    /// The weights of smooth even vertices.
    #[must_use]
    pub fn weights(&self) -> LoopWeights {
        self.weights
    }

    /// The weight of a smooth vertex of `n` neighbours, and of each of them.
    #[inline]
    fn smooth(&self, n: usize) -> [f64; 2] {
        self.table.get(n).copied().unwrap_or_else(|| self.weights.even(n))
    }

    /// The mask of an even vertex that is semi-sharp, or has a semi-sharp edge.
    ///
    /// It is answered, not written: a sink that went to a function of its own could not be kept in registers by all the
    /// others.
    #[inline(never)]
    fn semi_sharp(&self, around: Neighborhood<'_>, v: VertexId) -> Blend {
        let staying = around.vertex_sharpness(v).weight();
        let Transition { now, after, weight } = around.transition(v);
        let weight = if now == after { 1.0 } else { weight };
        let mut blend = Blend { center: staying, neighbor: 0.0, crease: None };
        for (feature, weight) in [(now, weight), (after, 1.0 - weight)].into_iter().filter(|part| part.1 > 0.0) {
            let weight = (1.0 - staying) * weight;
            match feature {
                Feature::Smooth => {
                    let [center, alpha] = self.smooth(around.ring(v).valence());
                    blend.center += weight * center;
                    blend.neighbor += weight * alpha;
                }
                Feature::Crease(along) => {
                    blend.center += weight * 0.75;
                    blend.crease = Some((weight * 0.125, along));
                }
                Feature::Corner => blend.center += weight,
            }
        }
        blend
    }
}

/// The weights of an even vertex itself, of each neighbour, and of those along a crease beside that.
struct Blend {
    center: f64,
    neighbor: f64,
    crease: Option<(f64, [VertexId; 2])>,
}

impl Default for Loop {
    fn default() -> Self {
        Self::new(LoopWeights::default())
    }
}

impl Scheme for Loop {
    #[inline]
    fn moves_even(&self) -> bool {
        true
    }

    fn reads_tags(&self) -> bool {
        true
    }

    fn blends_sharpness(&self) -> bool {
        true
    }

    #[inline]
    fn reach(&self) -> Reach {
        Reach::OneStar
    }

    #[inline(always)]
    fn even(&self, around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink) {
        if !around.has_no_tags() && around.is_semi_sharp(v) {
            let Blend { center, neighbor, crease } = self.semi_sharp(around, v);
            mask.group(center, [v]);
            if neighbor > 0.0 {
                mask.group(neighbor, around.ring(v));
            }
            if let Some((weight, along)) = crease {
                mask.group(weight, along);
            }
            return;
        }
        match around.class(v) {
            VertexClass::Smooth | VertexClass::Dart => {
                let ring = around.ring(v);
                let [center, alpha] = self.smooth(ring.valence());
                mask.group(center, [v]);
                mask.group(alpha, ring);
            }
            VertexClass::Crease => {
                mask.group(0.75, [v]);
                mask.group(0.125, crease_neighbors(around, v));
            }
            VertexClass::Corner => mask.group(1.0, [v]),
        }
    }

    #[inline(always)]
    fn odd(&self, around: Neighborhood<'_>, parent: &Parent, mask: &mut impl MaskSink) {
        let Parent { p, q, left, right } = *parent;
        match (left, right) {
            (Some(left), Some(right)) if !around.is_tagged(p, q) => {
                mask.group(0.375, [p, q]);
                mask.group(0.125, [left, right]);
            }
            // As much of 1/2, 1/2 as the edge is sharp, and the rest of the mask above.
            (Some(left), Some(right)) => {
                let sharp = sharp_part(around, p, q);
                mask.group(0.375 + 0.125 * sharp, [p, q]);
                if sharp < 1.0 {
                    mask.group(0.125 * (1.0 - sharp), [left, right]);
                }
            }
            _ => mask.group(0.5, [p, q]),
        }
    }
}

/// How much of the sharp mask a tagged edge takes. Apart, as few edges are tagged.
#[inline(never)]
fn sharp_part(around: Neighborhood<'_>, p: VertexId, q: VertexId) -> f64 {
    around.sharpness(p, q).weight()
}

/// The two neighbours of a crease vertex along its crease, in ring order.
#[inline]
pub(crate) fn crease_neighbors(around: Neighborhood<'_>, v: VertexId) -> [VertexId; 2] {
    let neighbors = around.ring(v).neighbors();
    if let (true, [first, .., last]) = (around.ring(v).is_open(), neighbors) {
        return [*first, *last];
    }
    let mut slots = around.sharp_slots(v);
    let mut next = || neighbors[slots.next().expect("a crease vertex has two sharp edges")];
    [next(), next()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tabled_and_computed_weights_agree() {
        for weights in [LoopWeights::Loop, LoopWeights::Warren] {
            let scheme = Loop::new(weights);
            for n in 1..=TABLED {
                let [center, alpha] = scheme.table[n];
                assert!((center + n as f64 * alpha - 1.0).abs() < 1e-15, "valence {n}");
                assert_eq!(alpha, weights.alpha(n));
            }
            assert_eq!((scheme.table[0], scheme.table[3][1], scheme.table[6]), ([1.0, 0.0], 0.1875, [0.625, 0.0625]));
        }
    }
}
