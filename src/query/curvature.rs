//! Curvature at the vertices, as a mesh of flat triangles shows it.
//!
//! Gaussian and mean curvature are means over a part of the surface around the vertex, its *mixed area*: of each triangle
//! that is not obtuse, what is nearer to the vertex than to the other corners; of an obtuse one half or a quarter. The mixed
//! areas of all vertices cover the surface once. Source: `[meyer2003]`, sections 3.3 to 4.1.
//!
//! A triangle without area has angles but no area of its own, and no part in the mean curvature. Nothing is ever NaN; what is
//! too great to be written is infinite.
//!
//! **Deliberately not here**: principal curvatures and their directions.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::by_vertex;
use super::measure::{Spokes, angle_between_rad};
use crate::id::VertexId;
use crate::mesh::Mesh;

/// What is missing to a full turn around each vertex, to half a turn on a boundary: 2π − Σθ or π − Σθ, for the angles θ of
/// the triangles at it.
///
/// Their sum is 2π times the [Euler characteristic](crate::rotation::RotationSystem::euler_characteristic) (Gauss and Bonnet),
/// as long as no edge has length 0. An isolated vertex misses nothing. O(vertices + edges).
///
/// ```
/// use vvmesh::{query::curvature::angle_defects, shapes};
/// use std::f64::consts::PI;
/// let mut defects = angle_defects(&shapes::octahedron()).into_iter();
/// assert!(defects.all(|defect| (defect - 2.0 * PI / 3.0).abs() < 1e-15));
/// ```
#[must_use]
pub fn angle_defects(mesh: &Mesh) -> Vec<f64> {
    by_vertex(mesh, |v| angle_defect(mesh, v))
}

/// The part of the surface that counts to each vertex: its mixed area. O(vertices + edges).
///
/// ```
/// use vvmesh::{query::curvature::mixed_areas, shapes};
/// assert_eq!(mixed_areas(&shapes::grid(2, 2)), [0.25, 0.5, 0.25, 0.5, 1.0, 0.5, 0.25, 0.5, 0.25]);
/// ```
#[must_use]
pub fn mixed_areas(mesh: &Mesh) -> Vec<f64> {
    by_vertex(mesh, |v| {
        let (area, unit) = mixed_area(mesh, v);
        number(area * unit * unit)
    })
}

/// The Gaussian curvature at each vertex: the angle defect divided by the mixed area; 0 where there is no area.
///
/// Of a sphere of radius r it is 1/r², of a plane, a cone or a cylinder 0, of a saddle negative. On a boundary it holds the
/// turning of the boundary, too. O(vertices + edges).
#[must_use]
pub fn gaussian(mesh: &Mesh) -> Vec<f64> {
    by_vertex(mesh, |v| {
        let (area, unit) = mixed_area(mesh, v);
        if area > 0.0 { angle_defect(mesh, v) / area / unit / unit } else { 0.0 }
    })
}

/// The absolute mean curvature at each vertex: half the length of Σ (cot α + cot β)(v − w) / 2A, for the angles opposite to
/// the edge to the neighbour w and the mixed area A; 0 on a boundary, where the sum is not defined.
///
/// Of a sphere of radius r it is 1/r, of a cylinder 1/2r, of a plane 0. O(vertices + edges).
#[must_use]
pub fn mean(mesh: &Mesh) -> Vec<f64> {
    by_vertex(mesh, |v| {
        if mesh.is_boundary(v) {
            return 0.0;
        }
        let (spokes, mut sum, mut area) = (Spokes::new(mesh, v), DVec3::ZERO, 0.0);
        for (a, b) in mesh.ring(v).pairs() {
            let corner = Corner::new(spokes.to(a), spokes.to(b));
            sum += corner.turning();
            area += corner.mixed_area();
        }
        if area > 0.0 { sum.length() / (4.0 * area) / spokes.unit } else { 0.0 }
    })
}

fn angle_defect(mesh: &Mesh, v: VertexId) -> f64 {
    let (ring, center) = (mesh.ring(v), mesh.position(v));
    let turn = match ring.valence() {
        0 => return 0.0,
        _ if ring.is_open() => PI,
        _ => TAU,
    };
    let angle = |(a, b)| angle_between_rad(mesh.position(a) - center, mesh.position(b) - center);
    number(turn - ring.pairs().map(angle).sum::<f64>())
}

/// The mixed area of a vertex, and the length whose square it is counted in.
fn mixed_area(mesh: &Mesh, v: VertexId) -> (f64, f64) {
    let spokes = Spokes::new(mesh, v);
    let area = |(a, b)| Corner::new(spokes.to(a), spokes.to(b)).mixed_area();
    (number(mesh.ring(v).pairs().map(area).sum()), spokes.unit)
}

/// What is no number, because a position is none, counts as 0.
fn number(value: f64) -> f64 {
    if value.is_nan() { 0.0 } else { value }
}

/// A triangle, seen from the corner where two sides start.
struct Corner {
    sides: [DVec3; 2],
    /// Twice the area.
    cross: f64,
    /// Products of the sides that meet here, and at the far ends of the two: divided by `cross`, the cotangents.
    dots: [f64; 3],
}

impl Corner {
    fn new(u: DVec3, w: DVec3) -> Self {
        let opposite = w - u;
        Self { sides: [u, w], cross: u.cross(w).length(), dots: [u.dot(w), -u.dot(opposite), w.dot(opposite)] }
    }

    fn mixed_area(&self) -> f64 {
        let [here, at_u, at_w] = self.dots;
        let [u, w] = self.sides;
        if here < 0.0 {
            self.cross / 4.0
        } else if at_u < 0.0 || at_w < 0.0 {
            self.cross / 8.0
        } else if self.cross > 0.0 {
            (u.length_squared() * at_w + w.length_squared() * at_u) / (8.0 * self.cross)
        } else {
            0.0
        }
    }

    /// Each side times the cotangent of the angle opposite to it.
    fn turning(&self) -> DVec3 {
        let [_, at_u, at_w] = self.dots;
        let [u, w] = self.sides;
        if self.cross > 0.0 { (u * at_w + w * at_u) / self.cross } else { DVec3::ZERO }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn an_octahedron_by_hand() {
        // Equilateral triangles of side √2: at each vertex four times a third of √3/2, and a defect of 2π − 4π/3.
        let mesh = shapes::octahedron();
        let area = 2.0 / 3.0_f64.sqrt();
        for v in 0..6 {
            assert!((mixed_areas(&mesh)[v] - area).abs() < 1e-15);
            assert!((gaussian(&mesh)[v] - 2.0 * PI / 3.0 / area).abs() < 1e-14);
            // Cotangents of 1/√3; the neighbours cancel, and (1/√3 + 1/√3) · 4 · v / 2A is left.
            assert!((mean(&mesh)[v] - 1.0).abs() < 1e-15);
        }
    }

    #[test]
    fn obtuse_triangles_count_by_half_and_by_quarter() {
        let corners = vec![DVec3::ZERO, DVec3::new(-3.0, 1.0, 0.0), DVec3::new(3.0, 1.0, 0.0)];
        let mesh = Mesh::from_triangles(corners, &[[0, 2, 1]]).expect("a triangle");
        assert_eq!(mixed_areas(&mesh), [1.5, 0.75, 0.75]);
        assert_eq!(mean(&mesh), [0.0; 3]);
    }

    #[test]
    fn what_has_no_area_has_no_curvature() {
        let isolated = Mesh::from_triangles(vec![DVec3::ONE], &[]).expect("a vertex");
        assert_eq!([gaussian(&isolated), mean(&isolated), angle_defects(&isolated)], [[0.0], [0.0], [0.0]]);
        let mut flat = shapes::octahedron();
        flat.positions_mut().iter_mut().for_each(|p| *p = DVec3::X * p.x);
        for (k, mean) in mean(&flat).into_iter().enumerate() {
            assert_eq!(mean, 0.0, "{k}");
        }
        let mut point = shapes::octahedron();
        point.positions_mut().fill(DVec3::ONE);
        let mut broken = shapes::octahedron();
        broken.positions_mut()[0].x = f64::INFINITY;
        for mesh in [flat, point, broken] {
            let values = [gaussian(&mesh), mean(&mesh), mixed_areas(&mesh), angle_defects(&mesh)].concat();
            assert!(values.iter().all(|value| !value.is_nan()), "{values:?}");
        }
    }

    #[test]
    fn the_unit_does_not_matter() {
        for exponent in [-300, 300] {
            let scale = 2_f64.powi(exponent);
            let (mesh, mut scaled) = (shapes::torus(7, 5, 3.0, 1.0), shapes::torus(7, 5, 3.0, 1.0));
            scaled.positions_mut().iter_mut().for_each(|p| *p *= scale);
            let by = |values: Vec<f64>| values.into_iter().map(|value| value * scale).collect::<Vec<_>>();
            assert_eq!(by(mean(&scaled)), mean(&mesh));
            assert_eq!(by(by(gaussian(&scaled))), gaussian(&mesh));
        }
    }
}
