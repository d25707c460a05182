//! The limit of the Loop scheme at vertices.

use std::f64::consts::{PI, TAU};

use super::{Limit, dart};
use crate::id::VertexId;
use crate::mesh::{Mesh, Neighborhood, Sector, VertexClass};
use crate::parallel;
use crate::scheme::{LoopWeights, MaskSink, cos_of_turn, crease_neighbors};

/// Limit positions, tangents and normals of the [`Loop`](crate::scheme::Loop) scheme.
///
/// ```
/// use vvmesh::limit::{Limit, LoopLimit};
/// use vvmesh::{scheme::LoopWeights, shapes};
/// let mesh = shapes::octahedron();
/// let limit = LoopLimit::new(LoopWeights::Loop);
/// let v = mesh.vertices().next().unwrap();
/// let normal = limit.normal(&mesh, v, 0).unwrap();
/// assert!(normal.distance(mesh.position(v)) < 1e-15);
/// assert!(limit.position(&mesh, v).length() < 1.0);
/// ```
///
/// Source: `[loop1987]`, `[zorin2000]`; the boundary tangents belong to the plain boundary rules and were derived for them,
/// as were the masks of darts.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct LoopLimit {
    weights: LoopWeights,
}

impl LoopLimit {
    /// The limit of the scheme with these weights.
    #[must_use]
    pub fn new(weights: LoopWeights) -> Self {
        Self { weights }
    }

    /// The weights of smooth even vertices.
    #[must_use]
    pub fn weights(&self) -> LoopWeights {
        self.weights
    }

    /// How far a smooth vertex of `n` neighbours is from its limit: v − v∞ is this times v − c, `c` being the mean of the
    /// neighbours. 8nα / (3 + 8nα), and 1/2 for n = 6.
    #[must_use]
    pub fn distance_factor(&self, n: usize) -> f64 {
        let eight_n_alpha = 8.0 * n as f64 * self.weights.alpha(n);
        eight_n_alpha / (3.0 + eight_n_alpha)
    }

    /// By how much each step shrinks the distance of a vertex to its limit: λ(n) if it is smooth, 1/4 on a crease or a
    /// boundary, 0 at a corner and for an isolated vertex. `None` for a dart, whose distance is a sum of several rates,
    /// and for a semi-sharp vertex.
    ///
    /// So a vertex born at level b is at level k at v∞ + λᵏ⁻ᵇ (v − v∞).
    #[must_use]
    pub fn contraction(&self, around: Neighborhood<'_>, v: VertexId) -> Option<f64> {
        match around.class(v) {
            _ if around.is_semi_sharp(v) => None,
            VertexClass::Smooth => Some(self.weights.lambda(around.ring(v).valence())),
            VertexClass::Dart => None,
            VertexClass::Crease => Some(0.25),
            VertexClass::Corner => Some(0.0),
        }
    }

    /// How far a vertex is from its limit. `None` if that is not known: for a semi-sharp vertex, and where it is too great to
    /// be written. O(valence).
    ///
    /// # Panics
    /// If there is no such vertex.
    #[must_use]
    pub fn distance(&self, mesh: &Mesh, v: VertexId) -> Option<f64> {
        if mesh.neighborhood().is_semi_sharp(v) {
            return None;
        }
        Some(self.position(mesh, v).distance(mesh.position(v))).filter(|distance| distance.is_finite())
    }

    /// [`LoopLimit::distance`] of every vertex, by id. O(vertices + edges).
    ///
    /// ```
    /// use vvmesh::{limit::LoopLimit, shapes};
    /// let distances = LoopLimit::default().distances(&shapes::icosahedron());
    /// assert!(distances.into_iter().all(|distance| distance.is_some_and(|distance| distance > 0.1)));
    /// ```
    #[must_use]
    pub fn distances(&self, mesh: &Mesh) -> Vec<Option<f64>> {
        parallel::list(mesh.vertex_count(), |v| self.distance(mesh, VertexId::new(v)))
    }
}

impl Limit for LoopLimit {
    /// Smooth: χ = 1/(3/(8α) + n) for each neighbour and 1 − nχ for the vertex. Crease and boundary: 2/3, and 1/6 for each
    /// of the two neighbours along it. Corner: the vertex. Dart: the left eigenvector for the eigenvalue 1, in closed form.
    fn mask(&self, around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink) {
        assert!(!around.is_semi_sharp(v), "{v} is semi-sharp: its limit is known when that has faded");
        let ring = around.ring(v);
        let n = ring.valence();
        let alpha = self.weights.alpha(n);
        match around.class(v) {
            VertexClass::Smooth => {
                let spread = 8.0 * alpha / (3.0 + 8.0 * n as f64 * alpha);
                mask.group(1.0 - self.distance_factor(n), [v]);
                mask.group(spread, ring);
            }
            VertexClass::Dart => dart::position(around, v, alpha, mask),
            VertexClass::Crease => {
                mask.group(2.0 / 3.0, [v]);
                mask.group(1.0 / 6.0, crease_neighbors(around, v));
            }
            VertexClass::Corner => mask.group(1.0, [v]),
        }
    }

    /// A smooth vertex and a dart have one, any other vertex one for each sector; the tip of a cone, a smooth vertex tagged
    /// a corner, has none, nor has a semi-sharp vertex.
    fn side_count(&self, around: Neighborhood<'_>, v: VertexId) -> usize {
        match around.class(v) {
            _ if around.is_semi_sharp(v) => 0,
            VertexClass::Smooth | VertexClass::Dart => usize::from(around.ring(v).valence() > 0),
            VertexClass::Crease | VertexClass::Corner => around.sectors(v).len(),
        }
    }

    /// On a crease or a boundary the first runs along it and the second points into the side; at a corner they point along
    /// its two sharp edges. With 5 neighbours and more in a sector the surface bends faster across than along the curve,
    /// with 8 and more it has no tangent plane there: this is known of the plain boundary rules; the tangents are then
    /// those of the curve and of the slowest mode across. In the same way a sector of a corner has the plane of its two
    /// curves, even where a sector of 4 faces and more does not keep to it inside.
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
        let sector = || around.sectors(v).nth(side).expect("the side was counted");
        match around.class(v) {
            VertexClass::Smooth => {
                let n = around.ring(v).valence();
                for (i, w) in around.ring(v).iter().enumerate() {
                    let (sin, cos) = (TAU * i as f64 / n as f64).sin_cos();
                    first.group(cos, [w]);
                    second.group(sin, [w]);
                }
            }
            VertexClass::Dart => {
                let alpha = self.weights.alpha(around.ring(v).valence());
                dart::tangents(around, v, alpha, first, second);
            }
            VertexClass::Crease => {
                let sector = sector();
                first.group(1.0, [sector.neighbor(0)]);
                first.group(-1.0, [sector.neighbor(sector.face_count())]);
                across(v, sector, second);
            }
            VertexClass::Corner => {
                let sector = sector();
                first.group(1.0, [sector.neighbor(0)]);
                first.group(-1.0, [v]);
                second.group(1.0, [sector.neighbor(sector.face_count())]);
                second.group(-1.0, [v]);
            }
        }
        true
    }
}

/// The tangent across a crease or a boundary, into a sector.
///
/// With θ = π/k for k faces it belongs to the eigenvalue 3/8 + cos θ/4, and to 1/4 for one face.
fn across(v: VertexId, sector: Sector<'_>, mask: &mut impl MaskSink) {
    let faces = sector.face_count();
    let ends = [sector.neighbor(0), sector.neighbor(faces)];
    if faces == 1 {
        mask.group(1.0, ends);
        mask.group(-2.0, [v]);
        return;
    }
    let theta = PI / faces as f64;
    let (sin, cos) = (theta.sin(), cos_of_turn(2 * faces));
    mask.group(-sin, [v]);
    mask.group(-sin * cos, ends);
    for i in 1..faces {
        let weight = (1.0 - cos) * (1.0 + 2.0 * cos) * (theta * i as f64).sin();
        mask.group(weight, [sector.neighbor(i)]);
    }
}
