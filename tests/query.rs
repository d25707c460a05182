//! Measures against closed forms and Gauss-Bonnet; disks against petgraph's breadth-first search.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::collections::HashMap;
use std::f64::consts::{PI, TAU};

use common::random::check;
use petgraph::algo::dijkstra;
use petgraph::graph::{NodeIndex, UnGraph};
use vvmesh::glam::DVec3;
use vvmesh::query::measure::{
    NormalWeight, bounds, corner_positions, dihedral_angle_rad, edge_length, total_area, triangle_angles_rad,
    triangle_area, triangle_normal, vertex_normal,
};
use vvmesh::query::{Disk, r_ring, star};
use vvmesh::scratch::Scratch;
use vvmesh::{Mesh, RotationSystem, VertexId, shapes};

/// The cube of side 2 around the origin, each side cut along a diagonal.
fn cube() -> Mesh {
    let corners = (0..8).map(|k| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * 2.0 - 1.0);
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Mesh::from_triangles(corners.collect(), &triangles).unwrap()
}

/// Two grids without a common vertex, then an isolated vertex.
fn pieces() -> Mesh {
    let grid = shapes::grid(3, 2);
    let count = grid.vertex_count() as u32;
    let mut corners = grid.positions().to_vec();
    corners.extend(grid.positions().iter().map(|&p| p + DVec3::Z));
    corners.push(DVec3::ONE * 9.0);
    let triangles = || grid.triangles().map(|t| t.corners().map(|v| v.index() as u32));
    let all: Vec<[u32; 3]> = triangles().chain(triangles().map(|t| t.map(|k| k + count))).collect();
    Mesh::from_triangles(corners, &all).unwrap()
}

/// A ring-shaped grid: a torus with a band of its triangles left out, so with two boundaries.
fn band() -> Mesh {
    let torus = shapes::torus(7, 6, 3.0, 1.0);
    let kept = torus.triangles().map(|t| t.corners().map(|v| v.index() as u32));
    let kept: Vec<[u32; 3]> = kept.filter(|corners| corners.iter().all(|k| k % 6 < 4)).collect();
    Mesh::from_triangles(torus.positions().to_vec(), &kept).unwrap()
}

fn all_shapes() -> Vec<Mesh> {
    vec![
        shapes::tetrahedron(),
        shapes::octahedron(),
        shapes::icosahedron(),
        cube(),
        shapes::grid(1, 1),
        shapes::grid(7, 5),
        shapes::torus(9, 7, 3.0, 1.0),
        band(),
        pieces(),
    ]
}

fn angle_sum(mesh: &Mesh, v: VertexId) -> f64 {
    star(mesh.rotation(), v)
        .triangles()
        .map(|t| {
            let place = t.corners().iter().position(|&w| w == v).unwrap();
            triangle_angles_rad(corner_positions(mesh, t))[place]
        })
        .sum()
}

#[test]
fn a_cube_has_the_measures_of_a_cube() {
    let cube = cube();
    assert_eq!(total_area(&cube), 24.0);
    assert_eq!(bounds(&cube).unwrap().diagonal(), 12_f64.sqrt());
    let mut counts = [0; 2];
    for edge in cube.edges() {
        let is_diagonal = edge_length(&cube, edge) > 2.0;
        let expected = if is_diagonal { 0.0 } else { PI / 2.0 };
        assert!((dihedral_angle_rad(&cube, edge).unwrap() - expected).abs() < 1e-15);
        counts[usize::from(is_diagonal)] += 1;
    }
    assert_eq!(counts, [12, 6]);
    for v in cube.vertices() {
        assert!((angle_sum(&cube, v) - 1.5 * PI).abs() < 1e-14);
        let normal = vertex_normal(&cube, v, NormalWeight::Angle).unwrap();
        assert!(normal.distance(cube.position(v).normalize()) < 1e-15);
    }
    for t in cube.triangles() {
        let corners = corner_positions(&cube, t);
        assert_eq!(triangle_area(corners), 2.0);
        assert!(triangle_normal(corners).unwrap().dot(corners[0]) > 0.0, "normals point out");
    }
}

#[test]
fn platonic_solids_have_their_dihedral_angles() {
    // Between the faces, inside: tetrahedron arccos(1/3), octahedron arccos(-1/3), icosahedron arccos(-sqrt(5)/3).
    let solids = [
        (shapes::tetrahedron(), 1.0 / 3.0),
        (shapes::octahedron(), -1.0 / 3.0),
        (shapes::icosahedron(), -5_f64.sqrt() / 3.0),
    ];
    for (mesh, cosine) in solids {
        for edge in mesh.edges() {
            assert!((PI - dihedral_angle_rad(&mesh, edge).unwrap() - f64::acos(cosine)).abs() < 1e-14);
        }
    }
    let icosahedron = shapes::icosahedron();
    let side = edge_length(&icosahedron, icosahedron.edges().next().unwrap());
    assert!((total_area(&icosahedron) - 5.0 * 3_f64.sqrt() * side * side).abs() < 1e-13);
}

#[test]
fn angle_defects_add_to_the_euler_characteristic() {
    for mesh in all_shapes() {
        let used = || mesh.vertices().filter(|&v| mesh.ring(v).valence() > 0);
        let defect = |v| if mesh.is_boundary(v) { PI } else { TAU } - angle_sum(&mesh, v);
        let euler = used().count() as f64 - mesh.edge_count() as f64 + mesh.face_count() as f64;
        assert!((used().map(defect).sum::<f64>() - TAU * euler).abs() < 1e-11);
    }
}

#[test]
fn normals_of_a_fine_torus_are_nearly_those_of_the_surface() {
    let torus = shapes::torus(120, 80, 3.0, 1.0);
    for weight in [NormalWeight::Angle, NormalWeight::Area] {
        for v in torus.vertices() {
            let p = torus.position(v);
            let center = p.with_z(0.0).normalize() * 3.0;
            assert!(vertex_normal(&torus, v, weight).unwrap().distance(p - center) < 0.02);
        }
    }
}

/// Distances from the nearest seed by petgraph, on a copy of the graph with one more node that is joined to the seeds.
fn distances(rotation: &RotationSystem, seeds: &[VertexId]) -> HashMap<VertexId, usize> {
    let mut graph = UnGraph::<(), ()>::with_capacity(rotation.vertex_count() + 1, rotation.edge_count());
    rotation.vertices().for_each(|_| _ = graph.add_node(()));
    for edge in rotation.edges() {
        let [a, b] = edge.ends().map(|v| NodeIndex::new(v.index()));
        graph.add_edge(a, b, ());
    }
    let source = graph.add_node(());
    for seed in seeds {
        graph.update_edge(source, NodeIndex::new(seed.index()), ());
    }
    let mut distances = dijkstra(&graph, source, None, |_| 1);
    distances.remove(&source);
    distances.into_iter().map(|(node, distance)| (VertexId::new(node.index()), distance - 1)).collect()
}

/// Whether each layer is the neighbours of the one before in the order of the rings, those seen for the first time.
fn is_breadth_first(rotation: &RotationSystem, disk: &Disk) -> bool {
    let layers: Vec<&[VertexId]> = disk.layers().collect();
    layers.windows(2).enumerate().all(|(d, pair)| {
        let mut seen = layers[..=d].concat();
        let known = seen.len();
        for w in pair[0].iter().flat_map(|&v| rotation.neighbors(v)) {
            if !seen.contains(w) {
                seen.push(*w);
            }
        }
        seen[known..] == *pair[1]
    })
}

fn agrees(
    rotation: &RotationSystem,
    seeds: &[VertexId],
    radius: usize,
    disk: &mut Disk,
    scratch: &mut Scratch,
) -> bool {
    let expected = distances(rotation, seeds);
    disk.search(rotation, seeds.iter().copied(), radius, scratch);
    let found: HashMap<VertexId, usize> =
        disk.layers().enumerate().flat_map(|(d, layer)| layer.iter().map(move |&v| (v, d))).collect();
    let within = expected.iter().filter(|&(_, &d)| d <= radius).map(|(&v, &d)| (v, d)).collect();
    let at_radius = r_ring(rotation, seeds.iter().copied(), radius, scratch);
    found == within
        && disk.vertices().len() == found.len()
        && disk.layers().all(|layer| !layer.is_empty())
        && at_radius == disk.layer(radius)
        && at_radius.len() == expected.values().filter(|&&d| d == radius).count()
        && is_breadth_first(rotation, disk)
}

#[test]
fn a_disk_is_what_a_plain_search_finds() {
    let (mut disk, mut scratch) = (Disk::new(), Scratch::new());
    for mesh in all_shapes() {
        for radius in [0, 1, 2, 3, 100, usize::MAX] {
            for seeds in [&[][..], &[0], &[3, 0, 3]] {
                let seeds: Vec<VertexId> = seeds.iter().map(|&k| VertexId::new(k)).collect();
                assert!(agrees(mesh.rotation(), &seeds, radius, &mut disk, &mut scratch));
            }
        }
    }
}

#[test]
fn random_disks_are_what_a_plain_search_finds() {
    // One disk and one scratch for all searches of a script: none may see what another left behind.
    fn script(searches: Vec<(u8, Vec<u16>, u8)>) -> bool {
        let meshes = all_shapes();
        let (mut disk, mut scratch) = (Disk::new(), Scratch::new());
        searches.into_iter().take(20).all(|(which, seeds, radius)| {
            let rotation = meshes[usize::from(which) % meshes.len()].rotation();
            let vertex = |k: u16| VertexId::new(usize::from(k) % rotation.vertex_count());
            let seeds: Vec<VertexId> = seeds.into_iter().take(8).map(vertex).collect();
            let radius = if radius == u8::MAX { usize::MAX } else { usize::from(radius % 8) };
            agrees(rotation, &seeds, radius, &mut disk, &mut scratch)
        })
    }
    check(227, 100, script as fn(Vec<(u8, Vec<u16>, u8)>) -> bool);
}
