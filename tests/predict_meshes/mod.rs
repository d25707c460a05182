//! Meshes of every kind that a limit surface can have.

use std::f64::consts::{PI, TAU};

use vvmesh::glam::{DVec2, DVec3};
use vvmesh::mesh::BoundaryPolicy;
use vvmesh::{Edge, Mesh, VertexId, shapes};

use crate::common::random::Random;

/// A cube of 12 triangles, cut such that four of its corners have valence 4 and four have 5.
pub(crate) fn cube(side: f64) -> Mesh {
    let sign = |k: usize, axis: usize| if k >> axis & 1 == 1 { 0.5 } else { -0.5 };
    let corners = (0..8).map(|k| side * DVec3::new(sign(k, 0), sign(k, 1), sign(k, 2))).collect();
    let [bottom, top] = [[[0, 2, 3], [0, 3, 1]], [[4, 5, 7], [4, 7, 6]]];
    let [front, back] = [[[0, 1, 5], [0, 5, 4]], [[6, 7, 3], [6, 3, 2]]];
    let [left, right] = [[[4, 6, 2], [4, 2, 0]], [[1, 3, 7], [1, 7, 5]]];
    Mesh::from_triangles(corners, &[bottom, top, front, back, left, right].concat()).unwrap()
}

/// Two poles of a valence above and below a ring of valence 4.
pub(crate) fn bipyramid(n: usize, height: f64) -> Mesh {
    let on_circle = |k: usize| DVec2::from_angle(TAU * k as f64 / n as f64).extend(0.0);
    let points = (0..n).map(on_circle).chain([height * DVec3::Z, -height * DVec3::Z]).collect();
    let sides = (0..n).flat_map(|k| {
        let [a, b] = [k, (k + 1) % n];
        [[a, b, n], [b, a, n + 1]].map(|face| face.map(|v| v as u32))
    });
    Mesh::from_triangles(points, &sides.collect::<Vec<_>>()).unwrap()
}

/// Triangles around a vertex of the boundary, bent.
fn fan(faces: usize) -> Mesh {
    let point = |k: usize| {
        let angle = PI * k as f64 / faces as f64;
        DVec2::from_angle(angle).extend(0.3 * (2.0 * angle).sin())
    };
    let points = [DVec3::ZERO].into_iter().chain((0..=faces).map(point)).collect();
    let faces: Vec<[u32; 3]> = (1..=faces as u32).map(|k| [0, k, k + 1]).collect();
    Mesh::from_triangles(points, &faces).unwrap()
}

/// The mesh with every position mapped.
pub(crate) fn mapped(mut mesh: Mesh, map: impl FnMut(DVec3) -> DVec3) -> Mesh {
    let positions: Vec<DVec3> = mesh.positions().iter().copied().map(map).collect();
    mesh.positions_mut().copy_from_slice(&positions);
    mesh
}

fn shaken(mesh: Mesh, seed: u64, by: f64) -> Mesh {
    let mut random = Random::new(seed);
    mapped(mesh, |x| x + by * random.vector())
}

fn at_boundary(mut mesh: Mesh, policy: BoundaryPolicy) -> Mesh {
    mesh.apply_boundary_policy(policy);
    mesh
}

/// The mesh with one sharp edge: two darts.
fn with_darts(mut mesh: Mesh) -> Mesh {
    let edge = mesh.edges().next().unwrap();
    mesh.set_sharp(edge, true);
    mesh
}

/// The mesh with sharp edges at random, one of so many, and half as often corners.
fn with_features(mut mesh: Mesh, seed: u64, one_of: usize) -> Mesh {
    let mut random = Random::new(seed);
    for edge in mesh.edges().collect::<Vec<Edge>>() {
        mesh.set_sharp(edge, random.below(one_of) == 0);
    }
    for v in mesh.vertices() {
        mesh.set_corner(v, random.below(2 * one_of) == 0);
    }
    mesh
}

/// Meshes with names: closed and open, of valences 3 to 64, bent and flat, with creases, darts, corners, the tip of a cone.
pub(crate) fn every_kind() -> Vec<(String, Mesh)> {
    let mut cone = shapes::octahedron();
    cone.set_corner(VertexId::new(0), true);
    let torus = |along, around| shapes::torus(along, around, 2.0, 1.0);
    let mut meshes: Vec<(String, Mesh)> = [
        ("tetrahedron", shapes::tetrahedron()),
        ("octahedron", shapes::octahedron()),
        ("icosahedron", shapes::icosahedron()),
        ("cube", cube(10.74)),
        ("torus", torus(5, 4)),
        ("shaken torus", shaken(torus(7, 6), 1, 0.4)),
        ("far torus", mapped(torus(6, 5), |x| x + DVec3::splat(1e6))),
        ("shaken icosahedron", shaken(shapes::icosahedron(), 2, 0.5)),
        ("flat grid", shapes::grid(5, 4)),
        ("grid", shaken(shapes::grid(5, 4), 3, 0.5)),
        ("grid with corners", at_boundary(shaken(shapes::grid(4, 4), 4, 0.4), BoundaryPolicy::Corners)),
        ("fixed grid", at_boundary(shaken(shapes::grid(4, 4), 5, 0.4), BoundaryPolicy::Fixed)),
        ("flat bipyramid", mapped(bipyramid(9, 1.0), |x| x.with_z(0.0))),
        ("cone", cone),
        ("dart of 3", with_darts(shapes::tetrahedron())),
        ("dart of 5", with_darts(shaken(shapes::icosahedron(), 6, 0.2))),
        ("dart of 18", with_darts(bipyramid(18, 1.0))),
    ]
    .into_iter()
    .map(|(name, mesh)| (name.to_owned(), mesh))
    .collect();
    for n in [3, 7, 12, 18, 64] {
        meshes.push((format!("bipyramid of {n}"), bipyramid(n, 1.5)));
    }
    for faces in [1, 2, 5, 9] {
        meshes.push((format!("fan of {faces}"), fan(faces)));
    }
    for one_of in [3, 12] {
        for (name, base) in
            [("torus", torus(8, 4)), ("icosahedron", shapes::icosahedron()), ("grid", shapes::grid(4, 4))]
        {
            let mesh = with_features(shaken(base, one_of as u64, 0.3), one_of as u64, one_of);
            meshes.push((format!("{name} with one of {one_of} sharp"), mesh));
        }
    }
    meshes
}
