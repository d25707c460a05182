//! Curvature: the theorem of Gauss and Bonnet on every model, and what spheres and tori have.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]
#![allow(clippy::print_stdout, reason = "the errors that were found are worth a look: --nocapture")]

mod common;

use std::f64::consts::{PI, TAU};

use common::meshes;
use vvmesh::glam::DVec3;
use vvmesh::query::curvature::{angle_defects, gaussian, mean, mixed_areas};
use vvmesh::query::measure::total_area;
use vvmesh::{Edge, Mesh, VertexId, io, shapes};

/// A sum of n angles, each right to a few last bits of π.
fn rounding(mesh: &Mesh) -> f64 {
    16.0 * f64::EPSILON * PI * (6.0 * mesh.vertex_count() as f64)
}

fn is_gauss_bonnet(name: &str, mesh: &Mesh) {
    let defects: f64 = angle_defects(mesh).iter().sum();
    let expected = TAU * mesh.rotation().euler_characteristic() as f64;
    let error = (defects - expected).abs();
    println!("{name}: {} vertices, Σ defects - 2πχ = {error:.1e}", mesh.vertex_count());
    assert!(error < rounding(mesh).min(1e-9), "{name}: {defects} instead of {expected}");
    let area: f64 = mixed_areas(mesh).iter().sum();
    assert!((area - total_area(mesh)).abs() <= 1e-12 * total_area(mesh), "{name}: mixed areas cover the surface once");
}

#[test]
fn defects_add_up_to_the_euler_characteristic() {
    for mesh in [shapes::icosahedron(), shapes::grid(7, 5), shapes::grid(1, 1), shapes::torus(9, 7, 3.0, 1.0)] {
        is_gauss_bonnet("shape", &mesh);
    }
    // An octahedron and a vertex apart.
    let mut positions = shapes::octahedron().positions().to_vec();
    positions.push(DVec3::ONE);
    let triangles: Vec<[u32; 3]> =
        shapes::octahedron().triangles().map(|t| t.corners().map(|v| v.index() as u32)).collect();
    is_gauss_bonnet("pieces", &Mesh::from_triangles(positions, &triangles).unwrap());
}

#[test]
fn defects_add_up_on_every_model() {
    let Some(folder) = meshes() else { return };
    let mut checked = 0;
    let mut paths: Vec<_> =
        std::fs::read_dir(folder.join("models")).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    for path in paths {
        let faces = io::read(&path).unwrap().faces;
        let triangles = faces.triangulate().triangles;
        // Some models are no meshes; they are there for what refuses them.
        let Ok(mesh) = Mesh::from_triangles(faces.positions, &triangles) else { continue };
        is_gauss_bonnet(&path.file_name().unwrap().to_string_lossy(), &mesh);
        checked += 1;
    }
    assert!(checked > 50, "only {checked} models were looked at");
}

/// Each triangle in four, with the new vertices on the unit sphere.
fn finer_sphere(mesh: &Mesh) -> Mesh {
    let mut positions = mesh.positions().to_vec();
    let mut edges: Vec<Edge> = mesh.edges().collect();
    edges.sort_unstable();
    positions.extend(edges.iter().map(|edge| {
        let [a, b] = edge.ends().map(|v| mesh.position(v));
        (a + b).normalize()
    }));
    let number = |a, b| (mesh.vertex_count() + edges.binary_search(&Edge::new(a, b)).unwrap()) as u32;
    let split = |corners: [VertexId; 3]| {
        let [a, b, c] = corners;
        let [x, y, z] = [number(a, b), number(b, c), number(c, a)];
        let [a, b, c] = corners.map(|v| v.index() as u32);
        [[a, x, z], [x, b, y], [z, y, c], [x, y, z]]
    };
    let triangles: Vec<[u32; 3]> = mesh.triangles().flat_map(|t| split(t.corners())).collect();
    Mesh::from_triangles(positions, &triangles).unwrap()
}

fn greatest_error(values: &[f64], expected: impl Fn(usize) -> f64) -> f64 {
    values.iter().enumerate().map(|(v, value)| (value - expected(v)).abs()).fold(0.0, f64::max)
}

/// Asserts that errors shrink with the square of the length of the edges, which halves each time.
fn is_second_order(name: &str, errors: &[f64]) {
    let orders: Vec<f64> = errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect();
    println!("{name}: errors {errors:.6?}, orders {orders:.2?}");
    assert!(
        orders.iter().all(|&order| order > 1.7) && orders.last().is_some_and(|&order| order > 1.9),
        "{name}: {orders:?}"
    );
}

#[test]
fn a_sphere_is_met_in_second_order() {
    const RADIUS: f64 = 2.0;
    let mut sphere = shapes::icosahedron();
    sphere.positions_mut().iter_mut().for_each(|p| *p = p.normalize());
    let (mut gaussian_errors, mut mean_errors) = (Vec::new(), Vec::new());
    for _ in 0..4 {
        sphere = finer_sphere(&sphere);
        let mut scaled = sphere.clone();
        scaled.positions_mut().iter_mut().for_each(|p| *p *= RADIUS);
        gaussian_errors.push(greatest_error(&gaussian(&scaled), |_| RADIUS.powi(-2)));
        mean_errors.push(greatest_error(&mean(&scaled), |_| 1.0 / RADIUS));
    }
    is_second_order("Gaussian curvature of a sphere", &gaussian_errors);
    // On the first the mean curvature happens to be exact.
    is_second_order("mean curvature of a sphere", &mean_errors[1..]);
}

#[test]
fn a_torus_is_met_in_second_order() {
    const MAJOR: f64 = 2.0;
    const MINOR: f64 = 1.0;
    let (mut gaussian_errors, mut mean_errors) = (Vec::new(), Vec::new());
    for k in [12, 24, 48, 96] {
        let torus = shapes::torus(2 * k, k, MAJOR, MINOR);
        // The cosine of the turn around the tube, 1 on the outside.
        let cos = |v: usize| (torus.positions()[v].truncate().length() - MAJOR) / MINOR;
        let from_axis = |v: usize| MAJOR + MINOR * cos(v);
        gaussian_errors.push(greatest_error(&gaussian(&torus), |v| cos(v) / (MINOR * from_axis(v))));
        let expected = |v: usize| (MAJOR + 2.0 * MINOR * cos(v)) / (2.0 * MINOR * from_axis(v));
        mean_errors.push(greatest_error(&mean(&torus), expected));
    }
    is_second_order("Gaussian curvature of a torus", &gaussian_errors);
    is_second_order("mean curvature of a torus", &mean_errors);
}
