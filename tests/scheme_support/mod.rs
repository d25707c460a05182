//! Meshes out of scripts, and masks applied to positions.

#![allow(dead_code, reason = "not every test file uses all of it")]

use vvmesh::glam::DVec3;
use vvmesh::scheme::{Mask, Scheme};
use vvmesh::step::Parent;
use vvmesh::{Edge, Mesh, VertexId, shapes};

/// A mesh with tags from a script: a base shape, then vertices put into triangles, flips, removed triangles, tags.
///
/// What would leave no manifold is skipped, so every script gives a mesh.
pub(crate) fn scripted(script: &[(u8, u16)]) -> Mesh {
    let base = match script.first().map_or(0, |&(kind, _)| kind % 6) {
        0 => shapes::tetrahedron(),
        1 => shapes::octahedron(),
        2 => shapes::icosahedron(),
        3 => shapes::torus(5, 4, 2.0, 1.0),
        4 => shapes::grid(4, 3),
        _ => shapes::grid(1, 1),
    };
    let mut points = base.positions().to_vec();
    let mut faces: Vec<[u32; 3]> = base.triangles().map(|t| t.corners().map(|v| v.index() as u32)).collect();
    for &(kind, place) in script.iter().skip(1) {
        let place = usize::from(place);
        let (mut new_points, mut new_faces) = (points.clone(), faces.clone());
        let k = place % faces.len();
        let [a, b, c] = faces[k];
        match kind % 7 {
            0 | 1 => {
                let x = points.len() as u32;
                new_points.push([a, b, c].map(|v| points[v as usize]).iter().sum::<DVec3>() * 0.35);
                new_faces[k] = [a, b, x];
                new_faces.extend([[b, c, x], [c, a, x]]);
            }
            2 | 3 => {
                let across = |f: &[u32; 3]| (0..3).find(|&i| (f[i], f[(i + 1) % 3]) == (b, a)).map(|i| f[(i + 2) % 3]);
                let Some((m, d)) = faces.iter().enumerate().find_map(|(m, f)| across(f).map(|d| (m, d))) else {
                    continue;
                };
                new_faces[k] = [a, d, c];
                new_faces[m] = [d, b, c];
            }
            4 if faces.len() > 1 => drop(new_faces.swap_remove(k)),
            _ => continue,
        }
        if Mesh::from_triangles(new_points.clone(), &new_faces).is_ok() {
            (points, faces) = (new_points, new_faces);
        }
    }
    for (k, point) in points.iter_mut().enumerate() {
        let shake = |salt: usize| ((k * 7919 + salt * 104_729) % 1000) as f64 / 4000.0;
        *point += DVec3::new(shake(1), shake(2), shake(3));
    }
    let mut mesh = Mesh::from_triangles(points, &faces).unwrap();
    let edges: Vec<Edge> = mesh.edges().collect();
    for &(kind, place) in script {
        let place = usize::from(place);
        match kind % 7 {
            5 => assert!(mesh.set_sharp(edges[place % edges.len()], true)),
            6 if place % 3 == 0 => assert!(mesh.set_corner(VertexId::new(place % mesh.vertex_count()), true)),
            6 => assert!(mesh.set_sharp(edges[(place + 1) % edges.len()], true)),
            _ => {}
        }
    }
    mesh
}

/// The mask of an even vertex.
pub(crate) fn even(scheme: &impl Scheme, mesh: &Mesh, v: VertexId) -> Mask {
    let mut mask = Mask::default();
    scheme.even(mesh.neighborhood(), v, &mut mask);
    mask
}

/// The mask of the odd vertex on the edge from one vertex to another.
pub(crate) fn odd(scheme: &impl Scheme, mesh: &Mesh, p: VertexId, q: VertexId) -> Mask {
    let (left, right) = (mesh.rotation().left_of(p, q), mesh.rotation().right_of(p, q));
    let mut mask = Mask::default();
    scheme.odd(mesh.neighborhood(), &Parent { p, q, left, right }, &mut mask);
    mask
}

/// The point that a mask makes of positions.
pub(crate) fn apply(mask: &Mask, position: impl Fn(VertexId) -> DVec3) -> DVec3 {
    mask.groups().iter().map(|(weight, vertices)| *weight * vertices.iter().map(|&v| position(v)).sum::<DVec3>()).sum()
}

/// A vertex 0 and its neighbours 1, 2, .. around it, all the way round or with a gap behind the last.
pub(crate) fn star(neighbors: usize, closed: bool) -> Mesh {
    let angle = if closed { std::f64::consts::TAU } else { std::f64::consts::PI };
    let parts = if closed { neighbors } else { neighbors - 1 };
    let rim = (0..neighbors).map(|j| DVec3::from((turn(angle, j, parts), 0.0)));
    let points = std::iter::once(DVec3::ZERO).chain(rim).collect();
    let faces: Vec<[u32; 3]> = (0..parts).map(|j| [0, 1 + j as u32, 1 + ((j + 1) % neighbors) as u32]).collect();
    Mesh::from_triangles(points, &faces).unwrap()
}

fn turn(angle: f64, j: usize, parts: usize) -> vvmesh::glam::DVec2 {
    vvmesh::glam::DVec2::from_angle(angle * j as f64 / parts as f64)
}
