//! Lengths, angles, areas and normals.
//!
//! Angles are in radians and come from `atan2` of a cross and a dot product, so small ones and those near π keep their
//! digits. Triangles run counter-clockwise seen from outside, and normals point there. Very large and very small vectors
//! are scaled by a power of two before they are multiplied: nothing overflows on the way and nothing vanishes, as long as
//! the differences of positions and the result itself can be written as an `f64`. What has no meaning (the normal of a
//! triangle without area) is `None`, never a `NaN`. No tolerance decides what is degenerate, but for
//! [`vertex_normal`], which says so.
//!
//! **Deliberately not here**: curvature ([`super::curvature`]), and the thresholds on any of these ([`crate::select`]).

use std::ops::Range;

use glam::DVec3;

use crate::id::{Edge, Triangle, VertexId};
use crate::mesh::Mesh;

/// The angle between two vectors, in 0..=π; 0 if one of them is zero.
///
/// ```
/// use vvmesh::{glam::DVec3, query::measure::angle_between_rad};
/// let angle = angle_between_rad(DVec3::X * 1e200, DVec3::X * 1e200 + DVec3::Y * 1e190);
/// assert!((angle - 1e-10).abs() < 1e-25);
/// ```
#[must_use]
pub fn angle_between_rad(u: DVec3, v: DVec3) -> f64 {
    let [u, v] = [u, v].map(|vector| Scaled::new(vector).mantissa);
    Scaled::cross(u, v).length().atan2(u.dot(v))
}

/// The vector across a triangle whose length is its area: half the cross product of two sides.
#[must_use]
pub fn area_vector(corners: [DVec3; 3]) -> DVec3 {
    let cross = Scaled::cross_of(corners);
    cross.mantissa * 0.5 * cross.powers[0] * cross.powers[1]
}

/// The area of a triangle.
///
/// ```
/// use vvmesh::{glam::DVec3, query::measure::triangle_area};
/// assert_eq!(triangle_area([DVec3::ZERO, DVec3::X, DVec3::Y * 3.0]), 1.5);
/// assert_eq!(triangle_area([DVec3::ZERO, DVec3::X * 1e300, DVec3::Y * 1e-300]), 0.5);
/// ```
#[must_use]
pub fn triangle_area(corners: [DVec3; 3]) -> f64 {
    0.5 * Scaled::cross_of(corners).length()
}

/// The unit normal of a triangle, or `None` if its area is zero.
#[must_use]
pub fn triangle_normal(corners: [DVec3; 3]) -> Option<DVec3> {
    Scaled::cross_of(corners).unit()
}

/// The angles of a triangle at its corners, in their order; 0 at a corner with a side of length zero.
#[must_use]
pub fn triangle_angles_rad([a, b, c]: [DVec3; 3]) -> [f64; 3] {
    [angle_between_rad(b - a, c - a), angle_between_rad(c - b, a - b), angle_between_rad(a - c, b - c)]
}

/// Where the corners of a triangle are: what the functions on a triangle take.
///
/// ```
/// use vvmesh::{glam::DVec3, query::measure::{corner_positions, triangle_normal}, shapes};
/// let mesh = shapes::grid(4, 4);
/// assert!(mesh.triangles().all(|t| triangle_normal(corner_positions(&mesh, t)) == Some(DVec3::Z)));
/// ```
///
/// # Panics
/// If there is no such vertex.
#[inline]
#[must_use]
pub fn corner_positions(mesh: &Mesh, triangle: Triangle) -> [DVec3; 3] {
    triangle.corners().map(|v| mesh.position(v))
}

/// The distance between the ends of an edge.
///
/// # Panics
/// If there is no such vertex.
#[must_use]
pub fn edge_length(mesh: &Mesh, edge: Edge) -> f64 {
    let [a, b] = edge.ends().map(|v| mesh.position(v));
    Scaled::new(b - a).length()
}

/// The angle between the normals of the two triangles at an edge: 0 where the surface is flat, π where it folds back on
/// itself.
///
/// `None` if there is only one triangle, or one of them has no area, or there is no such edge. The angle inside the solid
/// is π minus this one at a convex edge, π plus this one at a concave one. O(valence).
///
/// ```
/// use vvmesh::{query::measure::dihedral_angle_rad, shapes};
/// let mesh = shapes::icosahedron();
/// let interior_deg = 180.0 - dihedral_angle_rad(&mesh, mesh.edges().next().unwrap()).unwrap().to_degrees();
/// assert!((interior_deg - 138.189_685_104).abs() < 1e-9);
/// ```
#[must_use]
pub fn dihedral_angle_rad(mesh: &Mesh, edge: Edge) -> Option<f64> {
    let [a, b] = edge.ends();
    if !mesh.rotation().contains(a) {
        return None;
    }
    let left = mesh.rotation().left_of(a, b)?;
    let right = mesh.rotation().right_of(a, b)?;
    let left_normal = triangle_normal([a, b, left].map(|v| mesh.position(v)))?;
    let right_normal = triangle_normal([b, a, right].map(|v| mesh.position(v)))?;
    Some(angle_between_rad(left_normal, right_normal))
}

/// How much each triangle around a vertex counts in the vertex's normal.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum NormalWeight {
    /// By its angle at the vertex: the normal depends on the surface, not on how it is cut into triangles.
    #[default]
    Angle,
    /// By its area: a little cheaper, and slivers hardly count.
    Area,
    /// All the same: the mean of the normals.
    Equal,
}

/// The unit normal at a vertex: the weighted sum of the normals of the triangles around it.
///
/// Triangles without area count nothing. `None` if none is left, or if they cancel each other: if the sum is shorter than
/// 10⁻¹² of the sum of the weights, it is the rounding of the addition that it shows. O(valence).
///
/// Angle weights: Thürmer and Wüthrich 1998, *Computing vertex normals from polygonal facets*.
///
/// # Panics
/// If there is no such vertex.
///
/// ```
/// use vvmesh::{query::measure::{NormalWeight, vertex_normal}, shapes};
/// let mesh = shapes::octahedron();
/// for v in mesh.vertices() {
///     let normal = vertex_normal(&mesh, v, NormalWeight::default()).unwrap();
///     assert!(normal.distance(mesh.position(v)) < 1e-15);
/// }
/// ```
#[must_use]
pub fn vertex_normal(mesh: &Mesh, v: VertexId, weight: NormalWeight) -> Option<DVec3> {
    let spokes = Spokes::new(mesh, v);
    let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
    for (a, b) in mesh.ring(v).pairs() {
        let (a, b) = (spokes.to(a), spokes.to(b));
        let cross = Scaled::cross(a, b);
        let Some(normal) = cross.unit() else { continue };
        let weight = match weight {
            NormalWeight::Angle => angle_between_rad(a, b),
            // Twice the area of each.
            NormalWeight::Area => cross.length(),
            NormalWeight::Equal => 1.0,
        };
        sum += normal * weight;
        weights += weight;
    }
    let sum = Scaled::new(sum);
    if sum.length() <= 1e-12 * weights {
        return None;
    }
    sum.unit()
}

/// The sum of the areas of all triangles.
///
/// ```
/// use vvmesh::{query::measure::total_area, shapes};
/// assert_eq!(total_area(&shapes::grid(3, 5)), 15.0);
/// ```
#[must_use]
pub fn total_area(mesh: &Mesh) -> f64 {
    mesh.triangles().map(|t| triangle_area(corner_positions(mesh, t))).sum()
}

/// The smallest box along the axes that holds some points.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bounds {
    /// The least coordinates.
    pub min: DVec3,
    /// The greatest coordinates.
    pub max: DVec3,
}

impl Bounds {
    /// The box of these points, or `None` if there are none. Points that are not finite are left out.
    ///
    /// ```
    /// use vvmesh::{query::measure::Bounds, shapes};
    /// let bounds = Bounds::of(shapes::grid(3, 4).positions().iter().copied()).unwrap();
    /// assert_eq!(bounds.diagonal(), 5.0);
    /// ```
    #[must_use]
    pub fn of(points: impl IntoIterator<Item = DVec3>) -> Option<Self> {
        let finite = points.into_iter().filter(|p| p.is_finite());
        finite.map(|p| Self { min: p, max: p }).reduce(|a, b| Self { min: a.min.min(b.min), max: a.max.max(b.max) })
    }

    /// The distance between its extreme corners.
    #[must_use]
    pub fn diagonal(&self) -> f64 {
        Scaled::new(self.max - self.min).length()
    }
}

/// The box around all vertices of a mesh, isolated ones too; `None` if there are none.
#[must_use]
pub fn bounds(mesh: &Mesh) -> Option<Bounds> {
    Bounds::of(mesh.positions().iter().copied())
}

/// Squares of lengths far enough from the ends of `f64` that a square of them can be written too.
const SAFE_SQUARES: Range<f64> = 1e-150..1e150;

/// A vector as a mantissa that can be squared without care, times two powers of two.
struct Scaled {
    mantissa: DVec3,
    /// Apart, because their product may be out of range where the product with the mantissa is not.
    powers: [f64; 2],
}

impl Scaled {
    #[inline]
    fn new(vector: DVec3) -> Self {
        if SAFE_SQUARES.contains(&vector.length_squared()) {
            return Self { mantissa: vector, powers: [1.0; 2] };
        }
        let power = power_of_two_near(vector.abs().max_element());
        Self { mantissa: vector / power, powers: [power, 1.0] }
    }

    #[inline]
    fn cross(u: DVec3, v: DVec3) -> Self {
        let cross = u.cross(v);
        if SAFE_SQUARES.contains(&cross.length_squared()) {
            return Self { mantissa: cross, powers: [1.0; 2] };
        }
        Self::cross_out_of_range(u, v)
    }

    #[cold]
    fn cross_out_of_range(u: DVec3, v: DVec3) -> Self {
        let [u, v] = [u, v].map(Self::new);
        let cross = Self::new(u.mantissa.cross(v.mantissa));
        let [p, q] = [u.powers[0], v.powers[0]];
        let powers = if (p * q).is_normal() { [cross.powers[0], p * q] } else { [cross.powers[0] * p, q] };
        Self { mantissa: cross.mantissa, powers }
    }

    /// Twice the area vector of a triangle.
    #[inline]
    fn cross_of([a, b, c]: [DVec3; 3]) -> Self {
        Self::cross(b - a, c - a)
    }

    #[inline]
    fn length(&self) -> f64 {
        self.mantissa.length() * self.powers[0] * self.powers[1]
    }

    /// The direction; `None` for zero.
    #[inline]
    fn unit(&self) -> Option<DVec3> {
        self.mantissa.try_normalize()
    }
}

/// The vectors from a vertex to its neighbours, divided by one power of two: the longest is near 1, so products of them can be
/// written, and areas between them compared.
pub(super) struct Spokes<'a> {
    mesh: &'a Mesh,
    center: DVec3,
    /// What they are divided by.
    pub(super) unit: f64,
}

impl<'a> Spokes<'a> {
    pub(super) fn new(mesh: &'a Mesh, v: VertexId) -> Self {
        let center = mesh.position(v);
        let sizes = mesh.ring(v).iter().map(|w| (mesh.position(w) - center).abs().max_element());
        Self { mesh, center, unit: power_of_two_near(sizes.fold(0.0, f64::max)) }
    }

    /// The one to a neighbour.
    #[inline]
    pub(super) fn to(&self, w: VertexId) -> DVec3 {
        (self.mesh.position(w) - self.center) / self.unit
    }
}

/// The power of two below a size that is no subnormal number: dividing by it makes the size 1 to 2 and loses no digit.
#[inline]
fn power_of_two_near(size: f64) -> f64 {
    let exponent_bits = size.to_bits() & f64::INFINITY.to_bits();
    f64::from_bits(exponent_bits).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn scaling_by_powers_of_two_changes_no_digit() {
        let corners = [DVec3::new(0.1, 0.7, -0.3), DVec3::new(1.3, 0.2, 0.9), DVec3::new(-0.4, 1.1, 2.3)];
        let expected = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        assert_eq!(area_vector(corners), expected * 0.5);
        assert_eq!(triangle_area(corners), expected.length() * 0.5);
        for exponent in [-480, -300, -166, 166, 300, 480] {
            let scale = 2_f64.powi(exponent);
            let scaled = corners.map(|p| p * scale);
            assert_eq!(triangle_area(scaled), triangle_area(corners) * scale * scale);
            assert_eq!(area_vector(scaled), area_vector(corners) * scale * scale);
            assert_eq!(triangle_normal(scaled), triangle_normal(corners));
            assert_eq!(triangle_angles_rad(scaled), triangle_angles_rad(corners));
        }
        // No square of these can be written, but the area can.
        assert_eq!(triangle_area([DVec3::ZERO, DVec3::X * 1e300, DVec3::Y * 1e-300]), 0.5);
        assert_eq!(triangle_normal([DVec3::ZERO, DVec3::X * 1e300, DVec3::Y * 1e-300]), Some(DVec3::Z));
        assert_eq!(triangle_area([DVec3::ZERO, DVec3::X * 1e300, DVec3::X * 1e305]), 0.0);
        assert_eq!(triangle_area([DVec3::ZERO, DVec3::X * 5e-324, DVec3::Y * 5e-324]), 0.0);
        let sliver = [DVec3::ZERO, DVec3::X * 1e-301, DVec3::new(1e300, 1e225, 0.0)];
        assert!((triangle_area(sliver) / 5e-77 - 1.0).abs() < 1e-15);
    }

    #[test]
    fn angles_keep_their_digits_at_both_ends() {
        let turned = |sign: f64, angle: f64| DVec3::new(sign, angle, 0.0);
        assert_eq!(angle_between_rad(DVec3::X, turned(1.0, 1e-160)), 1e-160);
        assert_eq!(angle_between_rad(DVec3::X, turned(-1.0, 1e-9)), std::f64::consts::PI - 1e-9);
        assert_eq!(angle_between_rad(DVec3::X, DVec3::NEG_X), std::f64::consts::PI);
        assert_eq!(angle_between_rad(DVec3::X, DVec3::ZERO), 0.0);
    }

    #[test]
    fn a_triangle_without_area_has_no_normal() {
        let line = [DVec3::ZERO, DVec3::X, DVec3::X * 3.0];
        assert_eq!((triangle_normal(line), triangle_area(line)), (None, 0.0));
        assert_eq!(triangle_angles_rad(line), [0.0, std::f64::consts::PI, 0.0]);
        let point = [DVec3::ONE; 3];
        assert_eq!((triangle_normal(point), triangle_angles_rad(point)), (None, [0.0; 3]));
    }

    #[test]
    fn vertex_normals_by_angle_do_not_see_the_diagonals_of_a_cube_corner() {
        // A corner of a cube, one of its squares cut through the corner and two not.
        let corners = vec![
            DVec3::ZERO,
            DVec3::X,
            DVec3::new(1.0, 1.0, 0.0),
            DVec3::Y,
            DVec3::new(0.0, 1.0, 1.0),
            DVec3::Z,
            DVec3::new(1.0, 0.0, 1.0),
        ];
        let triangles = [[0, 2, 1], [0, 3, 2], [0, 5, 3], [5, 4, 3], [0, 1, 5], [1, 6, 5]];
        let mesh = Mesh::from_triangles(corners, &triangles).unwrap();
        let corner = VertexId::new(0);
        let by_angle = vertex_normal(&mesh, corner, NormalWeight::Angle).unwrap();
        assert!(by_angle.distance(DVec3::NEG_ONE.normalize()) < 1e-15);
        let by_area = vertex_normal(&mesh, corner, NormalWeight::Area).unwrap();
        assert!(by_area.distance(DVec3::new(-1.0, -1.0, -2.0).normalize()) < 1e-15);
    }

    #[test]
    fn a_vertex_normal_needs_area_that_does_not_cancel() {
        let isolated = Mesh::from_triangles(vec![DVec3::ZERO], &[]).unwrap();
        let mut flat = shapes::octahedron();
        flat.positions_mut()[4] = DVec3::ZERO;
        flat.positions_mut()[5] = DVec3::ZERO;
        let mut point = shapes::octahedron();
        point.positions_mut().fill(DVec3::ONE);
        for weight in [NormalWeight::Angle, NormalWeight::Area, NormalWeight::Equal] {
            assert_eq!(vertex_normal(&isolated, VertexId::new(0), weight), None);
            assert_eq!(vertex_normal(&flat, VertexId::new(0), weight), None);
            assert_eq!(vertex_normal(&flat, VertexId::new(4), weight), Some(DVec3::Z));
            assert_eq!(vertex_normal(&point, VertexId::new(0), weight), None);
        }
    }

    #[test]
    fn vertex_normals_do_not_depend_on_the_unit() {
        for (mut mesh, exponent) in [(shapes::torus(7, 5, 3.0, 1.0), 900), (shapes::torus(7, 5, 3.0, 1.0), -900)] {
            for weight in [NormalWeight::Angle, NormalWeight::Area, NormalWeight::Equal] {
                let normals =
                    |mesh: &Mesh| -> Vec<_> { mesh.vertices().map(|v| vertex_normal(mesh, v, weight)).collect() };
                let before = normals(&mesh);
                mesh.positions_mut().iter_mut().for_each(|p| *p *= 2_f64.powi(exponent));
                let after = normals(&mesh);
                mesh.positions_mut().iter_mut().for_each(|p| *p *= 2_f64.powi(-exponent));
                for (before, after) in before.into_iter().zip(after) {
                    assert!(before.unwrap().distance(after.unwrap()) < 1e-15);
                }
            }
        }
    }

    #[test]
    fn a_dihedral_angle_needs_two_triangles_with_area() {
        let mut mesh = shapes::grid(2, 1);
        let [a, b, c, d] = [0, 1, 4, 5].map(VertexId::new);
        assert_eq!(dihedral_angle_rad(&mesh, Edge::new(b, c)), Some(0.0));
        assert_eq!(dihedral_angle_rad(&mesh, Edge::new(a, b)), None);
        assert_eq!(dihedral_angle_rad(&mesh, Edge::new(a, d)), None);
        assert_eq!(dihedral_angle_rad(&mesh, Edge::new(VertexId::new(70), VertexId::new(80))), None);
        mesh.positions_mut()[a.index()] = DVec3::new(1.0, 0.5, 0.0);
        assert_eq!(dihedral_angle_rad(&mesh, Edge::new(b, c)), None);
    }

    #[test]
    fn bounds_leave_out_what_is_not_finite() {
        assert_eq!(Bounds::of([]), None);
        assert_eq!(Bounds::of([DVec3::NAN, DVec3::INFINITY]), None);
        let bounds = Bounds::of([DVec3::X * 3e200, DVec3::new(0.0, f64::NAN, 9.0), DVec3::Y * -4e200]).unwrap();
        assert!((bounds.diagonal() / 5e200 - 1.0).abs() < 1e-15);
        assert_eq!(Bounds::of([DVec3::ONE]).map(|b| b.diagonal()), Some(0.0));
    }
}
