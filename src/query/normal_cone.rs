//! How far the normals around a vertex point apart.

use super::by_vertex;
use super::measure::{NormalWeight, angle_between_rad, triangle_normal, vertex_normal};
use crate::id::VertexId;
use crate::mesh::Mesh;

/// The half angle, in radians, of the cone around the mean of the normals of a vertex's triangles that holds them all.
///
/// Triangles without area have none; 0 if no other is there. If the normals cancel each other there is no mean, and no cone is
/// narrower than all directions: π. O(valence).
///
/// # Panics
/// If there is no such vertex.
///
/// ```
/// use vvmesh::{query::normal_cone_rad, shapes};
/// let mesh = shapes::octahedron();
/// let cone = normal_cone_rad(&mesh, mesh.vertices().next().unwrap());
/// assert!((cone - 2.0_f64.sqrt().atan()).abs() < 1e-15);
/// ```
#[must_use]
pub fn normal_cone_rad(mesh: &Mesh, v: VertexId) -> f64 {
    let corners = |(a, b)| [v, a, b].map(|corner| mesh.position(corner));
    let mut normals = mesh.ring(v).pairs().filter_map(|pair| triangle_normal(corners(pair)));
    match vertex_normal(mesh, v, NormalWeight::Equal) {
        Some(axis) => normals.map(|normal| angle_between_rad(axis, normal)).fold(0.0, f64::max),
        None if normals.next().is_some() => std::f64::consts::PI,
        None => 0.0,
    }
}

/// [`normal_cone_rad`] of every vertex, by id. O(vertices + edges).
#[must_use]
pub fn normal_cones_rad(mesh: &Mesh) -> Vec<f64> {
    by_vertex(mesh, |v| normal_cone_rad(mesh, v))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use glam::DVec3;

    #[test]
    fn a_fold_has_the_widest_cone_and_no_area_has_none() {
        // Two triangles on an edge, one folded back onto the other.
        let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Y];
        let mut mesh = Mesh::from_triangles(corners, &[[0, 1, 2], [1, 0, 3]]).expect("a fold");
        let pi = std::f64::consts::PI;
        assert_eq!(normal_cones_rad(&mesh), [pi, pi, 0.0, 0.0]);
        mesh.positions_mut().fill(DVec3::ONE);
        assert_eq!(normal_cones_rad(&mesh), [0.0; 4]);
        assert!(normal_cones_rad(&shapes::grid(3, 2)).iter().all(|&cone| cone < 1e-15));
    }
}
