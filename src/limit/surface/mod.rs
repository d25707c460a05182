//! The limit of Loop subdivision as a surface: points and derivatives anywhere on a triangle.

mod bezier;
mod corner;
mod eigen;
mod fan;

use std::sync::OnceLock;

use glam::DVec3;

use super::{Limit, LoopLimit};
use crate::id::Triangle;
use crate::mesh::Mesh;
use crate::scheme::LoopWeights;
use bezier::Bezier;
use eigen::{Coefficients, EigenBasis};
pub(crate) use fan::{Fan, Fans, Rule};

/// Up to this valence extraordinary corners have an eigenbasis; above, whose would be large, points are found by steps.
const BASES: usize = 32;

/// How far barycentric coordinates may be outside of the triangle, for rounding; they are then moved to its rim.
const OUTSIDE: f64 = 1e-12;

/// The limit surface of a mesh under [`Loop`](crate::scheme::Loop), to be evaluated exactly.
///
/// A point is named by a triangle of the mesh and barycentric coordinates: u belongs to the first of
/// [`Triangle::corners`], v to the second, 1 − u − v to the third. A vertex that refinement puts at such a place of its
/// triangle ends there on the surface.
///
/// Creases, boundaries, darts and corners are those of the mesh, with the rules of the scheme. Where a triangle has regular
/// corners the surface is a polynomial of degree 4. With one extraordinary inner corner it is evaluated in the eigenbasis of
/// its surroundings, at the same cost however near the corner. Triangles with several irregular corners are split once; those
/// with an irregular corner on a crease, or a dart or corner, are refined towards it, O(valence · log(1/distance)).
///
/// ```
/// use vvmesh::limit::{Limit, LimitSurface, LoopLimit};
/// use vvmesh::{scheme::LoopWeights, shapes};
/// let mesh = shapes::icosahedron();
/// let surface = LimitSurface::new(&mesh, LoopWeights::Loop);
/// let triangle = mesh.triangles().next().unwrap();
///
/// let middle = surface.evaluate(triangle, 1.0 / 3.0, 1.0 / 3.0).unwrap();
/// assert!(middle.normal().unwrap().distance(middle.position.normalize()) < 1e-12);
/// let patch = surface.patch(triangle).unwrap();
/// let [corner, ..] = triangle.corners();
/// assert!(patch.evaluate(1.0, 0.0).position.distance(LoopLimit::default().position(&mesh, corner)) < 1e-14);
/// ```
///
/// Source: `[stam1998]`; features by refinement.
#[derive(Debug)]
pub struct LimitSurface<'a> {
    mesh: &'a Mesh,
    limit: LoopLimit,
    /// By valence, made when first needed.
    bases: [OnceLock<EigenBasis>; BASES + 1],
}

impl<'a> LimitSurface<'a> {
    /// The surface of a mesh under the scheme with these weights. O(1).
    #[must_use]
    pub fn new(mesh: &'a Mesh, weights: LoopWeights) -> Self {
        Self { mesh, limit: LoopLimit::new(weights), bases: [const { OnceLock::new() }; BASES + 1] }
    }

    /// The surface on a triangle, prepared for any number of points; `None` if the mesh has no such triangle, or one of its
    /// corners is [semi-sharp](crate::mesh::Neighborhood::is_semi_sharp). O(n log n) for n neighbours of its corners, and
    /// once for each valence up to 32 O(n²).
    #[must_use]
    pub fn patch(&self, triangle: Triangle) -> Option<Patch<'_>> {
        let corners = triangle.corners();
        let [a, b, c] = corners;
        let is_there = self.mesh.rotation().contains(a) && self.mesh.ring(a).next(b) == Some(c);
        if !is_there || corners.iter().any(|&v| self.mesh.neighborhood().is_semi_sharp(v)) {
            return None;
        }
        let fans = Fans::of(self.mesh, self.limit.weights(), corners);
        let limits = corners.map(|v| self.limit.position(self.mesh, v));
        let at_corners = [0, 1, 2].map(|k| {
            let others = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
            fans.0[k].hexagon().is_none().then(|| {
                let tangents = corner::tangents(self.limit, self.mesh, corners[k], others);
                // The derivatives by the coordinates of this corner and the next.
                let first = tangents.map(|[next, third]| [-third, next - third]);
                Evaluation { position: limits[k], first, second: None }.turned(k)
            })
        });
        Some(Patch { corners: at_corners, piece: self.piece(fans, limits) })
    }

    /// One point with its derivatives; `None` as for [`LimitSurface::patch`], which does the common part of many points of a
    /// triangle once.
    ///
    /// # Panics
    /// If the coordinates are not those of a point of the triangle, as [`Patch::evaluate`].
    #[must_use]
    pub fn evaluate(&self, triangle: Triangle, u: f64, v: f64) -> Option<Evaluation> {
        self.patch(triangle).map(|patch| patch.evaluate(u, v))
    }

    fn piece(&self, fans: Fans, limits: [DVec3; 3]) -> Piece<'_> {
        if let Some(bezier) = fans.bezier() {
            return Piece::Polynomial(bezier);
        }
        let irregular: Vec<usize> = (0..3).filter(|&c| fans.0[c].hexagon().is_none()).collect();
        let &[corner] = &irregular[..] else {
            // Then each part has one at most; the new corners are regular, and their limits not asked for.
            let parts = fans.split().map(|part| self.piece(part, limits));
            return Piece::Parts(Box::new(parts));
        };
        let Fans([a, b, c]) = fans.clone();
        let turned = Fans(match corner {
            0 => [a, b, c],
            1 => [b, c, a],
            _ => [c, a, b],
        });
        match self.basis(&turned).and_then(|basis| Some((basis, basis.project(&turned, limits[corner])?))) {
            Some((basis, coefficients)) => Piece::Extraordinary { corner, basis, coefficients },
            None => Piece::Refined { limit: limits[corner], fans: Box::new(fans.moved(-limits[corner])) },
        }
    }

    fn basis(&self, fans: &Fans) -> Option<&EigenBasis> {
        let n = fans.0[0].smooth_ring()?.len();
        Some(self.bases.get(n)?.get_or_init(|| EigenBasis::new(self.limit.weights(), n)))
    }
}

/// The surface on one triangle.
#[derive(Clone, Debug)]
pub struct Patch<'a> {
    /// What is answered at corners that are not regular.
    corners: [Option<Evaluation>; 3],
    piece: Piece<'a>,
}

impl Patch<'_> {
    /// The point at barycentric coordinates u, v, 1 − u − v of the corners, and its derivatives.
    ///
    /// # Panics
    /// If one of the coordinates is below 0 by more than rounding explains (1e-12), or is not a number.
    #[must_use]
    pub fn evaluate(&self, u: f64, v: f64) -> Evaluation {
        let at = [u, v, 1.0 - u - v];
        assert!(at.iter().all(|&x| x >= -OUTSIDE), "({u}, {v}) is not in the triangle");
        let at = at.map(|x| x.max(0.0));
        let corner = (0..3).find(|&c| at[(c + 1) % 3] == 0.0 && at[(c + 2) % 3] == 0.0);
        match corner.and_then(|c| self.corners[c]) {
            Some(evaluation) => evaluation,
            None => self.piece.evaluate(at),
        }
    }
}

/// The surface on a triangle or a part of it, without its irregular corners.
#[derive(Clone, Debug)]
enum Piece<'a> {
    Polynomial(Bezier),
    /// One extraordinary corner inside.
    Extraordinary {
        corner: usize,
        basis: &'a EigenBasis,
        coefficients: Coefficients,
    },
    /// One irregular corner of another kind, to which points are followed by steps; all positions are seen from its limit.
    Refined {
        limit: DVec3,
        fans: Box<Fans>,
    },
    /// Four, in the order of [`Fans::split`].
    Parts(Box<[Piece<'a>; 4]>),
}

impl Piece<'_> {
    fn evaluate(&self, at: [f64; 3]) -> Evaluation {
        match self {
            Self::Polynomial(bezier) => bezier.evaluate(at),
            &Self::Extraordinary { corner, basis, ref coefficients } => {
                let turned = [0, 1, 2].map(|c| at[(corner + c) % 3]);
                basis.evaluate(coefficients, turned).turned(corner)
            }
            Self::Refined { limit, fans } => follow(fans, at).moved(*limit),
            Self::Parts(parts) => {
                let (part, at, scale) = part(at);
                parts[part].evaluate(at).scaled(scale)
            }
        }
    }
}

/// Refines towards a point until it is in a regular triangle. It must not be an irregular corner itself.
fn follow(fans: &Fans, at: [f64; 3]) -> Evaluation {
    let (mut fans, mut at, mut scale) = (fans.clone(), at, 1.0);
    loop {
        if let Some(bezier) = fans.bezier() {
            return bezier.evaluate(at).scaled(scale);
        }
        let (next, inner, factor) = part(at);
        (fans, at, scale) = (fans.part(next), inner, scale * factor);
    }
}

/// The part of a split triangle that a point is in, its coordinates there, and by how much derivatives grow.
fn part(at: [f64; 3]) -> (usize, [f64; 3], f64) {
    for corner in 0..3 {
        let [next, third] = [(corner + 1) % 3, (corner + 2) % 3];
        if at[next] + at[third] <= 0.5 {
            // From the small ones, so that nothing near a corner is lost.
            let mut inner = at.map(|x| 2.0 * x);
            inner[corner] = 1.0 - inner[next] - inner[third];
            return (corner, inner, 2.0);
        }
    }
    (3, at.map(|x| 1.0 - 2.0 * x), -2.0)
}

/// A point of a surface with derivatives by u and v, the barycentric coordinates of the first two corners of its triangle.
///
/// At a vertex with irregular surroundings (valence other than 6 inside, other than 3 faces beside a crease, a dart, a
/// corner) first derivatives by barycentric coordinates vanish or diverge, or differ from triangle to triangle. There
/// `first` has tangents in the directions of the parameter lines, as long as a flat fan would have them, and `second` is
/// `None`; at the tip of a cone both are. Everywhere else both are the derivatives; near such a vertex they may be great.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Evaluation {
    /// The point.
    pub position: DVec3,
    /// ∂/∂u and ∂/∂v; their cross product points outwards.
    pub first: Option<[DVec3; 2]>,
    /// ∂²/∂u², ∂²/∂u∂v and ∂²/∂v².
    pub second: Option<[DVec3; 3]>,
}

impl Evaluation {
    /// The unit normal, outwards; `None` if there are no first derivatives, or they vanish or are parallel.
    #[must_use]
    pub fn normal(&self) -> Option<DVec3> {
        let [du, dv] = self.first?;
        let scale = du.abs().max_element().max(dv.abs().max_element());
        let cross = (du / scale).cross(dv / scale);
        let length = cross.length();
        (length > super::FLAT && length.is_finite()).then(|| cross / length)
    }

    /// The same by other units of the coordinates.
    fn scaled(self, factor: f64) -> Self {
        let first = self.first.map(|first| first.map(|derivative| factor * derivative));
        let second = self.second.map(|second| second.map(|derivative| factor * factor * derivative));
        Self { first, second, ..self }
    }

    /// The same elsewhere.
    fn moved(self, by: DVec3) -> Self {
        Self { position: self.position + by, ..self }
    }

    /// The same by the coordinates of a triangle of which the first corner here is corner `turns`.
    fn turned(self, turns: usize) -> Self {
        (0..turns).fold(self, |this, _| Self {
            position: this.position,
            first: this.first.map(|[u, v]| [-v, u - v]),
            second: this.second.map(|[uu, uv, vv]| [vv, vv - uv, uu - 2.0 * uv + vv]),
        })
    }
}
