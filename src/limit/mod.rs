//! Where Loop subdivision ends: limit positions, tangents and normals at the vertices of a mesh.
//!
//! The points of a one-ring are mapped to those of the next level by a fixed matrix. Its left eigenvector for the
//! eigenvalue 1 gives the limit of the vertex, those for the next eigenvalues two tangents; each is a row of weights, a
//! mask. [`LoopLimit`] writes them into a [`MaskSink`] or applies them to a mesh.
//!
//! **Deliberately not here**: points between the vertices, and schemes that interpolate (their vertices are at the limit).

mod dart;

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::id::VertexId;
use crate::mesh::{Mesh, Neighborhood, Sector, VertexClass};
use crate::parallel;
use crate::scheme::{LoopWeights, MaskSink, cos_of_turn, crease_neighbors};

/// A cross product of tangents is no normal below this, with the spokes of the vertex scaled to at most 1: what is left of
/// parallel tangents after rounding is near 1e-16.
const FLAT: f64 = 1e-12;

/// Limit positions, tangents and normals of the [`Loop`](crate::scheme::Loop) scheme.
///
/// A vertex has *sides*, one for each tangent plane: a smooth vertex and a dart have one, any other vertex one for each
/// sector between two sharp edges that follow one another, in ring order. So a crease vertex has two and a boundary vertex
/// one. An isolated vertex, and a smooth one tagged a corner (the tip of a cone), have none.
///
/// ```
/// use vvmesh::{limit::LoopLimit, scheme::LoopWeights, shapes};
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

    /// Writes the mask of the limit position of a vertex. O(valence).
    ///
    /// Smooth: χ = 1/(3/(8α) + n) for each neighbour and 1 − nχ for the vertex. Crease and boundary: 2/3, and 1/6 for each
    /// of the two neighbours along it. Corner: the vertex. Dart: the left eigenvector for the eigenvalue 1, in closed form.
    pub fn mask(&self, around: Neighborhood<'_>, v: VertexId, mask: &mut impl MaskSink) {
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

    /// The limit position of a vertex. O(valence).
    ///
    /// # Panics
    /// If there is no such vertex.
    #[must_use]
    pub fn position(&self, mesh: &Mesh, v: VertexId) -> DVec3 {
        let mut sum = WeightedSum::from(mesh, DVec3::ZERO);
        self.mask(mesh.neighborhood(), v, &mut sum);
        sum.value
    }

    /// The limit positions of all vertices, by id. O(vertices + edges).
    ///
    /// ```
    /// use vvmesh::{limit::LoopLimit, shapes};
    /// let (mesh, limit) = (shapes::icosahedron(), LoopLimit::default());
    /// assert!(limit.positions(&mesh).into_iter().eq(mesh.vertices().map(|v| limit.position(&mesh, v))));
    /// ```
    #[must_use]
    pub fn positions(&self, mesh: &Mesh) -> Vec<DVec3> {
        let mut positions = Vec::with_capacity(mesh.vertex_count());
        parallel::append(&mut positions, 0..mesh.vertex_count(), |v| self.position(mesh, VertexId::new(v)));
        positions
    }

    /// How far a smooth vertex of `n` neighbours is from its limit: v − v∞ is this times v − c, `c` being the mean of the
    /// neighbours. 8nα / (3 + 8nα), and 1/2 for n = 6.
    #[must_use]
    pub fn distance_factor(&self, n: usize) -> f64 {
        let eight_n_alpha = 8.0 * n as f64 * self.weights.alpha(n);
        eight_n_alpha / (3.0 + eight_n_alpha)
    }

    /// By how much each step shrinks the distance of a vertex to its limit: λ(n) if it is smooth, 1/4 on a crease or a
    /// boundary, 0 at a corner and for an isolated vertex. `None` for a dart, whose distance is a sum of several rates.
    ///
    /// So a vertex born at level b is at level k at v∞ + λᵏ⁻ᵇ (v − v∞).
    #[must_use]
    pub fn contraction(&self, around: Neighborhood<'_>, v: VertexId) -> Option<f64> {
        match around.class(v) {
            VertexClass::Smooth => Some(self.weights.lambda(around.ring(v).valence())),
            VertexClass::Dart => None,
            VertexClass::Crease => Some(0.25),
            VertexClass::Corner => Some(0.0),
        }
    }

    /// How many sides a vertex has. O(valence).
    #[must_use]
    pub fn side_count(&self, around: Neighborhood<'_>, v: VertexId) -> usize {
        match around.class(v) {
            VertexClass::Smooth | VertexClass::Dart => usize::from(around.ring(v).valence() > 0),
            VertexClass::Crease | VertexClass::Corner => around.sectors(v).len(),
        }
    }

    /// Writes the masks of two tangents of one side of a vertex; their weights add to 0. O(valence).
    ///
    /// Their cross product points outwards. On a crease or a boundary the first runs along it and the second points into
    /// the side; at a corner they point along its two sharp edges. With 5 neighbours and more in a sector the surface bends
    /// faster across than along the curve, with 8 and more it has no tangent plane there: this is known of the plain
    /// boundary rules; the tangents are then those of the curve and of the slowest mode across. In the same way a sector
    /// of a corner has the plane of its two curves, even where a sector of 4 faces and more does not keep to it inside.
    ///
    /// # Panics
    /// If there is no such side.
    pub fn tangent_masks(
        &self,
        around: Neighborhood<'_>,
        v: VertexId,
        side: usize,
        first: &mut impl MaskSink,
        second: &mut impl MaskSink,
    ) {
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
    }

    /// Two tangents of one side of a vertex, of any length; see [`LoopLimit::tangent_masks`]. O(valence).
    ///
    /// # Panics
    /// If there is no such vertex or no such side.
    #[must_use]
    pub fn tangents(&self, mesh: &Mesh, v: VertexId, side: usize) -> [DVec3; 2] {
        // The weights add to 0, so the origin is free; at the vertex least is lost by rounding.
        let [mut first, mut second] = [WeightedSum::from(mesh, mesh.position(v)); 2];
        self.tangent_masks(mesh.neighborhood(), v, side, &mut first, &mut second);
        [first.value, second.value]
    }

    /// The unit normal of one side of a vertex, outwards; `None` if its tangents vanish or are parallel. O(valence).
    ///
    /// # Panics
    /// If there is no such vertex or no such side.
    #[must_use]
    pub fn normal(&self, mesh: &Mesh, v: VertexId, side: usize) -> Option<DVec3> {
        let center = mesh.position(v);
        let spokes = mesh.ring(v).iter().map(|w| (mesh.position(w) - center).abs().max_element());
        let scale = spokes.fold(0.0, f64::max);
        let [first, second] = self.tangents(mesh, v, side).map(|tangent| tangent / scale);
        let cross = first.cross(second);
        let length = cross.length();
        (length > FLAT && length.is_finite()).then(|| cross / length)
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

/// Applies a mask to the positions of a mesh, taken from an origin.
#[derive(Clone, Copy)]
struct WeightedSum<'a> {
    positions: &'a [DVec3],
    origin: DVec3,
    value: DVec3,
}

impl<'a> WeightedSum<'a> {
    fn from(mesh: &'a Mesh, origin: DVec3) -> Self {
        Self { positions: mesh.positions(), origin, value: DVec3::ZERO }
    }
}

impl MaskSink for WeightedSum<'_> {
    fn group(&mut self, weight: f64, vertices: impl IntoIterator<Item = VertexId>) {
        let sum = vertices.into_iter().map(|v| self.positions[v.index()] - self.origin).sum::<DVec3>();
        self.value += weight * sum;
    }
}
