//! A distance to the limit surface that is never exceeded.

use super::refuse_without_limit;
use super::star::Star;
use crate::accuracy::Accuracy;
use crate::error::PredictError;
use crate::id::VertexId;
use crate::mesh::{Mesh, VertexClass};
use crate::parallel;
use crate::scheme::LoopWeights;

/// For so many levels irregular vertices are followed. What is then left of their differences, at most 0.625⁴⁰ ≈ 7e-9, is
/// bounded by a series.
pub(super) const LEVELS: usize = 40;

/// What rounding adds at most, as a part of the greatest coordinate: some hundred roundings on the way to a point.
pub(crate) const ROUNDING: f64 = 1.0 / (1_u64 << 45) as f64;

/// The greatest distance, at any depth, between the mesh that so many uniform steps make and its limit surface: at no point
/// of the mesh is the point of the surface with the same parameters farther away.
///
/// Boundaries, creases, darts and corners are those of the mesh, and it holds for all of them. What rounding can do to a
/// mesh and to points of its surface is part of it, so it does not go to 0: there are accuracies that no depth has.
///
/// # Derivation
///
/// A step from the mesh M to M' puts the new vertex of an edge ab with opposite corners c, d at (a + b)/2 + D/8, where
///
/// D = c + d − a − b, and D = 0 on a sharp edge,
///
/// and moves an old vertex by d, which is α Σ (vᵢ − v) if it is smooth or a dart, (a + b − 2v)/8 on a crease between a and
/// b, and 0 at a corner. M' − M is linear on the triangles of M', so it is nowhere longer than the longest d and D/8. The
/// distance at depth k is at most the sum of these lengths over the steps from k on. Now what becomes of them:
///
/// | of | after a step |
/// |---|---|
/// | the half at v of the edge to its neighbour i | Dᵢ' = 3/8 Dᵢ + (Dᵢ₋₁ + Dᵢ₊₁)/8 − d |
/// | the new edge opposite to v in its triangle with a and b | D' = d + (D_ab − D_va − D_vb)/8 |
/// | a smooth vertex or a dart | d' = (1/2 − nα) d + α/8 Σ Dᵢ |
/// | a crease vertex, a corner | d' = d/4 |
///
/// So the numbers at a vertex follow from those at the vertex. Let v be **regular**. If it is smooth, its six
/// differences have no first Fourier mode, since they vanish on linear functions: d is their sum over 16, Dᵢ' =
/// 3/16 Dᵢ + 1/16 Dᵢ₊₃, and for a and b at places i and i + 1, D' = D_ab/8 + (Dᵢ₋₁ + Dᵢ₊₂)/16. If a crease leaves three
/// triangles on each side, a side has two differences, 8d is their sum, Dᵢ' = Dᵢ/4, and D' is D_ab/8 with an eighth of
/// one of the two or of none. In short: no difference of M' at or opposite to a regular vertex exceeds 1/4 of the
/// greatest at its triangles, and d is at most 3/8 of the greatest at the vertex.
///
/// All new vertices are regular. The **irregular** ones of the input, whose differences shrink more slowly or faster,
/// are followed one by one, in O(valence) a level. Let s be the greatest difference at one of them, t the greatest |d −
/// (D_va + D_vb)/8|, m the greatest |d|, and g the greatest difference of all other edges, in the input of all. Then
///
/// g' ≤ max((1/4) max(g, s), t + g/8),
///
/// and the step to the next level is no longer than max(m, g/4 + max(g, s)/8), as of six differences at a regular
/// vertex at most two are at irregular ones; only in the input may there be more, and its first step is known as it is.
///
/// Now follow a point. In a *regular triangle*, with three regular corners, it stays in such ones. It moves by no more
/// than g/4 + max(g, s)/8 in the next step and 3/8 of the differences in each one after, which fall by quarters:
/// together (g + max(g, s))/4. In a triangle with an irregular corner, of which there is one after the first step, it
/// either leaves to a regular triangle, or it is in the part at the corner. There the step is linear, d at the corner
/// and D/8 at the other two ends; and a point that leaves i steps later is not farther from the corner than 2¹⁻ⁱ of
/// that part. So it moves by at most m + 2¹⁻ⁱ s/8. The bound is the greatest sum over all levels at which a point can
/// leave.
///
/// After the levels that are followed, let p be the greatest s + 3|d| at one irregular vertex. It shrinks to 4/5 or
/// less: by the table s' ≤ 5/8 s + |d|, and |d'| is at most λ|d| with λ ≤ 25/64, |d|/4 or, at a dart, 0.27|d| + 3/64 s
/// for all n and both weights. With g' ≤ g/4 + p/3 all that follows is at most 3/8 Σ (g + p) ≤ g/2 + 3p.
///
/// On a regular mesh without sharp edges this is 4⁻ᵏ g/2, which is reached where all differences are equal. At an
/// irregular vertex it shrinks at the rate at which the mesh slides towards it, 3/8 + cos(2π/n)/4 for a smooth one of 4
/// neighbours or more.
///
/// ```
/// use vvmesh::predict::DistanceBound;
/// use vvmesh::{Accuracy, scheme::LoopWeights, shapes};
/// let bound = DistanceBound::new(&shapes::octahedron(), LoopWeights::Loop)?;
/// assert!(bound.at(0) > 0.5 && bound.at(1) < bound.at(0) / 2.0);
/// let accuracy = Accuracy::new(0.01)?;
/// let depth = bound.depth(accuracy).unwrap();
/// assert!(bound.at(depth) < 0.01 && bound.at(depth - 1) >= 0.01);
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
///
/// Source: `[huang-wang2008]` for the idea, a bound by second differences and the rates at which they shrink; the derivation,
/// which takes features and follows vertices, is our own.
#[derive(Clone, Debug)]
pub struct DistanceBound {
    /// By depth, descending.
    bounds: [f64; LEVELS + 1],
}

impl DistanceBound {
    /// Looks at every vertex. O(vertices + edges), and for irregular vertices forty times that.
    ///
    /// # Errors
    /// If something is [semi-sharp](PredictError::SemiSharp) or [too great](PredictError::NonFinite).
    pub fn new(mesh: &Mesh, weights: LoopWeights) -> Result<Self, PredictError> {
        refuse_without_limit(mesh, weights)?;
        let shares = parallel::shares(0..mesh.vertex_count(), |share| {
            let mut greatest = Greatest::default();
            share.map(VertexId::new).for_each(|v| greatest.take(mesh, weights, v));
            greatest
        });
        let greatest = shares.into_iter().fold(Greatest::default(), Greatest::or);
        let coordinate = mesh.positions().iter().map(|x| x.abs().max_element()).fold(0.0, f64::max);
        Ok(Self { bounds: greatest.bounds().map(|bound| bound + ROUNDING * coordinate) })
    }

    /// The bound of the distance at a depth. From 40 on that for 40 is given, which holds for all of them.
    #[must_use]
    pub fn at(&self, depth: u32) -> f64 {
        self.bounds[(depth as usize).min(LEVELS)]
    }

    /// The least depth of which the distance is proven to be below an accuracy; `None` if there is none up to 40.
    #[must_use]
    pub fn depth(&self, accuracy: Accuracy) -> Option<u32> {
        (0..=LEVELS as u32).find(|&depth| self.at(depth) < accuracy.distance())
    }
}

/// What was found at the irregular vertices of one level.
#[derive(Clone, Copy, Default)]
struct Irregular {
    /// s.
    difference: f64,
    /// t.
    opposite: f64,
    /// m.
    motion: f64,
}

impl Irregular {
    fn or(self, other: Self) -> Self {
        Self {
            difference: self.difference.max(other.difference),
            opposite: self.opposite.max(other.opposite),
            motion: self.motion.max(other.motion),
        }
    }
}

/// The greatest of everything that the bound is made of.
#[derive(Clone)]
struct Greatest {
    /// Of the differences of all edges of the input.
    difference: f64,
    /// How long the first step is.
    first_step: f64,
    levels: [Irregular; LEVELS],
    /// p after the last level.
    rest: f64,
}

impl Default for Greatest {
    fn default() -> Self {
        Self { difference: 0.0, first_step: 0.0, levels: [Irregular::default(); LEVELS], rest: 0.0 }
    }
}

impl Greatest {
    /// Looks at one more vertex of the input.
    fn take(&mut self, mesh: &Mesh, weights: LoopWeights, v: VertexId) {
        let mut star = Star::of(mesh, weights, v);
        let difference = star.greatest_difference();
        self.difference = self.difference.max(difference);
        self.first_step = self.first_step.max(star.motion()).max(difference / 8.0);
        if is_regular(mesh, v) {
            return;
        }
        for level in &mut self.levels {
            let found = Irregular {
                difference: star.greatest_difference(),
                opposite: star.greatest_opposite(),
                motion: star.motion(),
            };
            *level = level.or(found);
            star.refine();
        }
        self.rest = self.rest.max(star.greatest_difference() + 3.0 * star.motion());
    }

    fn or(mut self, other: Self) -> Self {
        self.difference = self.difference.max(other.difference);
        self.first_step = self.first_step.max(other.first_step);
        self.levels.iter_mut().zip(other.levels).for_each(|(level, other)| *level = level.or(other));
        self.rest = self.rest.max(other.rest);
        self
    }

    /// The bounds by depth, but for rounding.
    fn bounds(&self) -> [f64; LEVELS + 1] {
        let mut regular = self.difference;
        let mut steps = [0.0; LEVELS];
        // How far away a regular triangle of the level is; after the last level, any.
        let mut rests = [0.0; LEVELS + 1];
        for (level, &Irregular { difference, opposite, motion }) in self.levels.iter().enumerate() {
            let all = regular.max(difference);
            steps[level] = motion.max(0.25 * regular + 0.125 * all);
            rests[level] = 0.25 * (regular + all);
            regular = (0.25 * all).max(opposite + 0.125 * regular);
        }
        rests[LEVELS] = 0.5 * regular + 3.0 * self.rest;
        let mut bounds = rests;
        // A point that leaves the irregular triangles by the step from level `last`, or stays for ever.
        for last in 0..=LEVELS {
            let mut distance = steps.get(last).map_or(rests[LEVELS], |step| step + rests[last + 1]);
            bounds[last] = bounds[last].max(distance);
            let mut share = 0.125;
            for level in (0..last).rev() {
                distance += self.levels[level].motion + share * self.levels[level].difference;
                bounds[level] = bounds[level].max(distance);
                share /= 2.0;
            }
        }
        bounds[0] = self.first_step + bounds[1];
        bounds
    }
}

/// Whether the surroundings of a vertex are those of almost every vertex after many steps: six neighbours, or a crease or
/// boundary with three faces on every side. An isolated vertex is nowhere on the surface, and counts as regular.
fn is_regular(mesh: &Mesh, v: VertexId) -> bool {
    let around = mesh.neighborhood();
    match around.class(v) {
        VertexClass::Smooth => matches!(around.ring(v).valence(), 0 | 6),
        VertexClass::Crease => around.sectors(v).all(|sector| sector.face_count() == 3),
        VertexClass::Dart | VertexClass::Corner => false,
    }
}
