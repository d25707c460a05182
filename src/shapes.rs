//! Named small meshes, for examples and tests.
//!
//! **Deliberately not here**: anything read from a file.

use glam::DVec3;

use crate::mesh::Mesh;

/// A tetrahedron: every valence is 3.
#[must_use]
pub fn tetrahedron() -> Mesh {
    let corners = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]];
    build(&corners, &[[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])
}

/// An octahedron: every valence is 4.
#[must_use]
pub fn octahedron() -> Mesh {
    let corners = [[1, 0, 0], [0, 1, 0], [-1, 0, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]];
    let triangles = [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]];
    build(&corners, &triangles)
}

/// An icosahedron with its twelve corners on the unit sphere: every valence is 5.
#[must_use]
pub fn icosahedron() -> Mesh {
    let golden = (1.0 + 5.0_f64.sqrt()) / 2.0;
    let mut corners = Vec::with_capacity(12);
    for (s, t) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
        let (short, long) = (s, t * golden);
        corners.extend([DVec3::new(0.0, short, long), DVec3::new(short, long, 0.0), DVec3::new(long, 0.0, short)]);
    }
    let corners: Vec<DVec3> = corners.into_iter().map(DVec3::normalize).collect();
    // Three corners at the distance of an edge make a face; it is turned so that it is seen from outside.
    let edge = corners[0].distance(corners[6]);
    let near = |i: usize, j: usize| corners[i].distance(corners[j]) < 1.01 * edge;
    let mut triangles = Vec::with_capacity(20);
    for a in 0..12 {
        for b in a + 1..12 {
            for c in b + 1..12 {
                if near(a, b) && near(b, c) && near(c, a) {
                    let outward = corners[a].dot(corners[b].cross(corners[c])) > 0.0;
                    let [a, b, c] = [a, b, c].map(|k| k as u32);
                    triangles.push(if outward { [a, b, c] } else { [a, c, b] });
                }
            }
        }
    }
    Mesh::from_triangles(corners, &triangles).expect("an icosahedron is a mesh")
}

/// A flat grid of `columns` x `rows` unit squares in the plane z = 0, each cut along the diagonal to its upper right.
///
/// Vertex (x, y) has index `y * (columns + 1) + x`; inner vertices have valence 6.
///
/// # Panics
/// If one of them is 0.
#[must_use]
pub fn grid(columns: usize, rows: usize) -> Mesh {
    assert!(columns > 0 && rows > 0, "a grid has at least one square");
    let width = columns + 1;
    let corners = (0..width * (rows + 1)).map(|k| DVec3::new((k % width) as f64, (k / width) as f64, 0.0)).collect();
    let mut triangles = Vec::with_capacity(2 * columns * rows);
    for y in 0..rows {
        for x in 0..columns {
            let a = (y * width + x) as u32;
            let [b, c, d] = [a + 1, a + 1 + width as u32, a + width as u32];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh::from_triangles(corners, &triangles).expect("a grid is a mesh")
}

/// A torus of `around` x `along` quads, each cut into two triangles: every valence is 6.
///
/// `along` counts around the axis (radius `major`), `around` around the tube (radius `minor`).
///
/// # Panics
/// If one of the counts is below 3.
#[must_use]
pub fn torus(along: usize, around: usize, major: f64, minor: f64) -> Mesh {
    assert!(along >= 3 && around >= 3, "a torus needs at least three points each way");
    let turn = |k: usize, of: usize| (k as f64 / of as f64 * std::f64::consts::TAU).sin_cos();
    let mut corners = Vec::with_capacity(along * around);
    for i in 0..along {
        for j in 0..around {
            let ((sin_i, cos_i), (sin_j, cos_j)) = (turn(i, along), turn(j, around));
            let from_axis = major + minor * cos_j;
            corners.push(DVec3::new(from_axis * cos_i, from_axis * sin_i, minor * sin_j));
        }
    }
    let at = |i: usize, j: usize| ((i % along) * around + j % around) as u32;
    let mut triangles = Vec::with_capacity(2 * along * around);
    for i in 0..along {
        for j in 0..around {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Mesh::from_triangles(corners, &triangles).expect("a torus is a mesh")
}

fn build(corners: &[[i32; 3]], triangles: &[[u32; 3]]) -> Mesh {
    let corners = corners.iter().map(|&[x, y, z]| DVec3::new(x.into(), y.into(), z.into())).collect();
    Mesh::from_triangles(corners, triangles).expect("the shape is a mesh")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_platonic_shapes_have_their_valences() {
        for (mesh, valence, faces) in [(tetrahedron(), 3, 4), (octahedron(), 4, 8), (icosahedron(), 5, 20)] {
            assert!(mesh.vertices().all(|v| mesh.ring(v).valence() == valence && !mesh.is_boundary(v)));
            assert_eq!((mesh.face_count(), 2 * mesh.edge_count()), (faces, 3 * faces));
        }
    }

    #[test]
    fn a_torus_is_regular_and_a_grid_has_a_boundary() {
        let torus = torus(5, 4, 2.0, 1.0);
        assert!(torus.vertices().all(|v| torus.ring(v).valence() == 6));
        let grid = grid(3, 2);
        assert_eq!((grid.vertex_count(), grid.face_count(), grid.edge_count()), (12, 12, 23));
        assert_eq!(grid.vertices().filter(|&v| grid.is_boundary(v)).count(), 10);
    }
}
