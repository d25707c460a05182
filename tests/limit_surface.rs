//! The Loop surface between the vertices, against refinement: a vertex of a refined mesh, moved to its limit, is a point of
//! the surface at barycentric coordinates that are known exactly.

#![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

mod common;
mod scheme_support;

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use common::random::check;
use common::run::Run;
use scheme_support::{scripted, star};
use vvmesh::adaptive::{Incremental, Uniform};
use vvmesh::glam::{DMat3, DVec3};
use vvmesh::limit::{Evaluation, Limit, LimitSurface, LoopLimit};
use vvmesh::mesh::VertexClass;
use vvmesh::scheme::{Loop, LoopWeights};
use vvmesh::select::Selection;
use vvmesh::subdivide::Subdivider;
use vvmesh::{Edge, Mesh, Triangle, VertexId, shapes};

const WEIGHTS: [LoopWeights; 2] = [LoopWeights::Loop, LoopWeights::Warren];

/// Barycentric coordinates of points in triangles, inside and on edges.
const SAMPLES: [[f64; 2]; 9] = [
    [0.31, 0.42],
    [0.11, 0.13],
    [0.83, 0.06],
    [0.07, 0.91],
    [0.013, 0.0021],
    [0.0003, 0.9991],
    [0.5, 0.25],
    [0.4, 0.6],
    [0.0, 0.3],
];

fn id(index: usize) -> VertexId {
    VertexId::new(index)
}

/// A vertex 0 of a valence with rings of regular vertices around it, nothing about it symmetric.
fn wheel(n: usize, rings: usize) -> Mesh {
    let first = |ring: usize| if ring == 0 { 0 } else { 1 + n * ring * (ring - 1) / 2 };
    let at = |ring: usize, k: usize| if ring == 0 { 0 } else { (first(ring) + k % (n * ring)) as u32 };
    let mut faces = Vec::new();
    for ring in 0..rings {
        for sector in 0..n {
            for k in 0..=ring {
                let [inner, outer] = [sector * ring + k, sector * (ring + 1) + k];
                faces.push([at(ring, inner), at(ring + 1, outer), at(ring + 1, outer + 1)]);
                if k < ring {
                    faces.push([at(ring, inner), at(ring + 1, outer + 1), at(ring, inner + 1)]);
                }
            }
        }
    }
    let mut points = vec![DVec3::ZERO];
    for ring in 1..=rings {
        for k in 0..n * ring {
            let angle = TAU * k as f64 / (n * ring) as f64;
            points.push(DVec3::new(angle.cos(), angle.sin(), 0.0) * ring as f64);
        }
    }
    for (k, x) in points.iter_mut().enumerate() {
        let wave = |salt: usize| ((k * 37 + salt * 17) % 23) as f64 / 23.0 - 0.5;
        *x += DVec3::new(0.2 * wave(1), 0.2 * wave(2), 0.6 * wave(3));
    }
    Mesh::from_triangles(points, &faces).unwrap()
}

/// For every vertex of a refined run the input vertices that it lies between, with weights.
fn places(run: &Run, inputs: usize) -> Vec<BTreeMap<VertexId, f64>> {
    let mut places: Vec<BTreeMap<VertexId, f64>> = (0..inputs).map(|v| BTreeMap::from([(id(v), 1.0)])).collect();
    for v in run.mesh.vertices().skip(inputs) {
        let mut place = BTreeMap::new();
        for parent in run.history.parents(v).unwrap().vertices() {
            for (&corner, weight) in &places[parent.index()] {
                *place.entry(corner).or_default() += 0.5 * weight;
            }
        }
        places.push(place);
    }
    places
}

/// All triangles of a mesh that have these corners, which is more than one for a point on an edge.
fn triangles_with(mesh: &Mesh, place: &BTreeMap<VertexId, f64>) -> Vec<Triangle> {
    let (&v, _) = place.first_key_value().unwrap();
    let pairs = mesh.ring(v).pairs().map(|(a, b)| Triangle::new(v, a, b));
    pairs.filter(|triangle| place.keys().all(|corner| triangle.corners().contains(corner))).collect()
}

/// Every vertex of the refined mesh, at its limit, is the point of the surface, seen from every triangle that it lies on.
fn refined_points_are_on_the_surface(mesh: &Mesh, run: &Run, weights: LoopWeights, tolerance: f64) -> usize {
    let (surface, limit) = (LimitSurface::new(mesh, weights), LoopLimit::new(weights));
    let mut compared = 0;
    for (v, place) in places(run, mesh.vertex_count()).into_iter().enumerate() {
        let expected = limit.position(&run.mesh, id(v));
        for triangle in triangles_with(mesh, &place) {
            let [a, b, _] = triangle.corners().map(|corner| place.get(&corner).copied().unwrap_or(0.0));
            let found = surface.evaluate(triangle, a, b).unwrap().position;
            assert!(found.distance(expected) < tolerance, "{triangle} {place:?}: {:e}", found.distance(expected));
            compared += 1;
        }
    }
    compared
}

fn refined(mesh: &Mesh, weights: LoopWeights, levels: usize) -> Run {
    let subdivider = Subdivider::new(Loop::new(weights), Uniform);
    let mut run = Run::new(mesh);
    for _ in 0..levels {
        run.step(&subdivider, &Selection::all(run.mesh.vertex_count()));
    }
    run
}

fn uniform_points_are_on_the_surface(mesh: &Mesh, weights: LoopWeights, levels: usize) {
    let compared = refined_points_are_on_the_surface(mesh, &refined(mesh, weights, levels), weights, 1e-12);
    assert!(compared > mesh.face_count());
}

/// A star with sharp edges to some neighbours, in a mesh so large that they are regular.
fn tagged_wheel(n: usize, sharp: &[usize], corner: bool) -> Mesh {
    let mut mesh = wheel(n, 3);
    for &k in sharp {
        // Straight on from the middle to the rim.
        for [a, b] in [[0, 1 + k], [1 + k, 1 + n + 2 * k], [1 + n + 2 * k, 1 + 3 * n + 3 * k]] {
            assert!(mesh.set_sharp(Edge::new(id(a), id(b)), true), "{a} {b}");
        }
    }
    mesh.set_corner(id(0), corner);
    mesh
}

/// Wheels of every kind of middle: smooth, dart, crease, corner, cone.
fn wheels() -> Vec<Mesh> {
    let mut meshes = Vec::new();
    for n in 3..=12 {
        meshes.extend([&[][..], &[1], &[0, 1], &[0, 2], &[0, 1, 2]].map(|sharp| tagged_wheel(n, sharp, false)));
        meshes.extend([&[][..], &[1], &[0, 2]].map(|sharp| tagged_wheel(n, sharp, true)));
    }
    meshes
}

#[test]
fn refined_points_of_any_mesh_are_on_the_surface() {
    fn property(script: Vec<(u8, u16)>) -> bool {
        let mesh = scripted(&script);
        WEIGHTS.into_iter().for_each(|weights| uniform_points_are_on_the_surface(&mesh, weights, 2));
        true
    }
    check(203, 100, property as fn(Vec<(u8, u16)>) -> bool);
}

#[test]
fn refined_points_are_on_the_surface_at_every_valence() {
    for weights in WEIGHTS {
        for mesh in wheels() {
            uniform_points_are_on_the_surface(&mesh, weights, 3);
        }
        for n in 3..=7 {
            // Open stars have the boundary valences 2 and n, closed ones pairs of irregular vertices.
            for mesh in [star(n, false), star(n, true)] {
                uniform_points_are_on_the_surface(&mesh, weights, 4);
            }
        }
        uniform_points_are_on_the_surface(&shapes::grid(1, 1), weights, 4);
        // Above the valences that have an eigenbasis.
        uniform_points_are_on_the_surface(&wheel(40, 2), weights, 2);
    }
}

#[test]
fn eight_levels_lead_to_the_surface() {
    for n in [3, 4, 5, 7, 8, 12] {
        for mesh in [tagged_wheel(n, &[], false), tagged_wheel(n, &[1], false), tagged_wheel(n, &[0, 2], false)] {
            let subdivider = Subdivider::new(Loop::default(), Incremental::new(1).unwrap());
            // The selection follows one triangle at the middle, and is all that is exact.
            let mut selection = mesh.triangles().next().unwrap().corners().into_iter().collect::<Selection>();
            let mut run = Run::new(&mesh);
            let levels = if n == 5 { 8 } else { 6 };
            for _ in 0..levels {
                selection = run.step(&subdivider, &selection).selection;
            }
            let (surface, limit) = (LimitSurface::new(&mesh, LoopWeights::Loop), LoopLimit::default());
            let triangle = mesh.triangles().next().unwrap();
            let patch = surface.patch(triangle).unwrap();
            let places = places(&run, mesh.vertex_count());
            for &v in selection.vertices() {
                let [a, b, _] = triangle.corners().map(|corner| places[v.index()].get(&corner).copied().unwrap_or(0.0));
                let apart = patch.evaluate(a, b).position.distance(limit.position(&run.mesh, v));
                assert!(apart < 1e-12, "valence {n}, {:?}: {apart:e}", places[v.index()]);
            }
            assert_eq!(selection.len(), ((1 << levels) + 1) * ((1 << levels) + 2) / 2);
        }
    }
}

#[test]
fn the_corners_are_the_limits_of_the_masks() {
    for mesh in wheels() {
        for weights in WEIGHTS {
            let (surface, limit) = (LimitSurface::new(&mesh, weights), LoopLimit::new(weights));
            for triangle in mesh.triangles() {
                let patch = surface.patch(triangle).unwrap();
                for (v, [a, b]) in triangle.corners().into_iter().zip([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]) {
                    let corner = patch.evaluate(a, b);
                    let expected = limit.position(&mesh, v);
                    assert!(corner.position.distance(expected) < 1e-13);
                    // And what comes near is near: at a distance of 2⁻⁶⁰ by less than any power that occurs.
                    let inward = |x: f64, y: f64| x + (y - x) * 2.0_f64.powi(-60);
                    let near = patch.evaluate(inward(a, 0.2), inward(b, 0.3));
                    assert!(near.position.distance(expected) < 1e-8, "{v}");
                    if let Some(normal) = corner.normal() {
                        let around = mesh.neighborhood();
                        let slot = mesh.ring(v).slot_of(next(triangle, v)).unwrap();
                        let side = limit.side_at(around, v, slot).unwrap();
                        assert!(normal.distance(limit.normal(&mesh, v, side).unwrap()) < 1e-6, "{v} of {triangle}");
                    }
                }
            }
        }
    }
}

fn next(triangle: Triangle, v: VertexId) -> VertexId {
    let corners = triangle.corners();
    corners[(corners.iter().position(|&w| w == v).unwrap() + 1) % 3]
}

#[test]
fn normals_come_near_those_of_the_masks() {
    for n in 3..=12 {
        // Beside a crease the tangents shrink at unlike rates, so the triangle must not be too small.
        let mut meshes = vec![(tagged_wheel(n, &[], false), -40, 1e-3)];
        if n <= 5 {
            meshes.push((tagged_wheel(n, &[0, 2], false), -20, 1e-2));
        }
        for (mesh, exponent, tolerance) in meshes {
            let surface = LimitSurface::new(&mesh, LoopWeights::Loop);
            for triangle in mesh.triangles().take(n) {
                assert_eq!(triangle.corners()[0], id(0));
                let patch = surface.patch(triangle).unwrap();
                let distance = 2.0_f64.powi(exponent);
                let [there, near] = [patch.evaluate(1.0, 0.0), patch.evaluate(1.0 - distance, 0.5 * distance)];
                let apart = there.normal().unwrap().distance(near.normal().unwrap());
                assert!(apart < tolerance, "valence {n}, {triangle}: {apart:e}");
            }
        }
    }
}

#[test]
fn derivatives_are_those_of_differences() {
    for mesh in wheels().into_iter().chain([star(4, false), star(5, true), shapes::grid(1, 1), shapes::tetrahedron()]) {
        let surface = LimitSurface::new(&mesh, LoopWeights::Loop);
        for triangle in mesh.triangles() {
            let patch = surface.patch(triangle).unwrap();
            for [u, v] in SAMPLES {
                // So small that the point stays in the polynomial, which shrinks towards irregular corners.
                let room = u.min(v).min(1.0 - u - v);
                if room < 1e-6 {
                    continue;
                }
                let h = 1e-3 * room;
                let at = |i: f64, j: f64| patch.evaluate(u + i * h, v + j * h);
                let Evaluation { first: Some([du, dv]), second: Some([duu, duv, dvv]), .. } = patch.evaluate(u, v)
                else {
                    panic!("inside of {triangle} there are derivatives");
                };
                let first = |p: Evaluation, m: Evaluation| (p.position - m.position) / (2.0 * h);
                let second =
                    |p: Evaluation, m: Evaluation, k: usize| (p.first.unwrap()[k] - m.first.unwrap()[k]) / (2.0 * h);
                let scale = 1.0 + du.length() + dv.length() + duu.length() + duv.length() + dvv.length();
                for (found, expected, tolerance) in [
                    (du, first(at(1.0, 0.0), at(-1.0, 0.0)), 1e-5),
                    (dv, first(at(0.0, 1.0), at(0.0, -1.0)), 1e-5),
                    (duu, second(at(1.0, 0.0), at(-1.0, 0.0), 0), 1e-2),
                    (duv, second(at(0.0, 1.0), at(0.0, -1.0), 0), 1e-2),
                    (dvv, second(at(0.0, 1.0), at(0.0, -1.0), 1), 1e-2),
                ] {
                    let apart = found.distance(expected);
                    assert!(apart < tolerance * scale, "{triangle} at ({u}, {v}): {apart:e} of {scale}");
                }
            }
        }
    }
}

#[test]
fn the_surface_goes_along_with_affine_maps() {
    let map = DMat3::from_cols(DVec3::new(0.3, 1.0, -0.2), DVec3::new(-0.7, 0.1, 0.5), DVec3::new(0.2, 0.4, 1.1));
    let by = DVec3::new(3.0, -2.0, 5.0);
    for mesh in wheels() {
        let mut image = mesh.clone();
        image.positions_mut().iter_mut().for_each(|x| *x = map * *x + by);
        let [surface, mapped] = [&mesh, &image].map(|mesh| LimitSurface::new(mesh, LoopWeights::Loop));
        for triangle in mesh.triangles().step_by(3) {
            for [u, v] in SAMPLES {
                let [p, q] = [&surface, &mapped].map(|surface| surface.evaluate(triangle, u, v).unwrap());
                assert!((map * p.position + by).distance(q.position) < 1e-12);
                let [du, image] = [p, q].map(|evaluation| evaluation.first.unwrap()[0]);
                assert!((map * du).distance(image) < 1e-12 * (1.0 + image.length()));
            }
        }
    }
}

#[test]
fn a_regular_plane_keeps_its_coordinates() {
    let mesh = shapes::grid(6, 6);
    let surface = LimitSurface::new(&mesh, LoopWeights::Loop);
    for triangle in mesh.triangles() {
        let [a, b, c] = triangle.corners().map(|v| mesh.position(v));
        for [u, v] in SAMPLES {
            let point = surface.evaluate(triangle, u, v).unwrap();
            assert!(point.normal().unwrap().distance(DVec3::Z) < 1e-12, "{triangle} at ({u}, {v})");
            let is_inside = triangle.corners().iter().all(|&v| mesh.neighborhood().class(v) == VertexClass::Smooth);
            if is_inside {
                assert!(point.position.distance(u * a + v * b + (1.0 - u - v) * c) < 1e-14);
                let [du, dv] = point.first.unwrap();
                assert!(du.distance(a - c) < 1e-13 && dv.distance(b - c) < 1e-13);
                assert!(point.second.unwrap().iter().all(|second| second.length() < 1e-12));
            }
        }
    }
}

/// The point on the edge from the smaller to the greater end of it, as each of its triangles has it.
fn along_edge(surface: &LimitSurface<'_>, mesh: &Mesh, edge: Edge, t: f64) -> Vec<DVec3> {
    let [a, b] = edge.ends();
    let place = BTreeMap::from([(a, 1.0 - t), (b, t)]);
    let coordinates = |triangle: Triangle| {
        let [u, v, _] = triangle.corners().map(|corner| place.get(&corner).copied().unwrap_or(0.0));
        surface.evaluate(triangle, u, v).unwrap().position
    };
    triangles_with(mesh, &place).into_iter().map(coordinates).collect()
}

fn is_continuous(mesh: &Mesh, step: usize) -> usize {
    let surface = LimitSurface::new(mesh, LoopWeights::Loop);
    let size = mesh.positions().iter().map(|x| x.length()).fold(0.0, f64::max);
    let mut compared = 0;
    for edge in mesh.edges().step_by(step) {
        for t in [0.0, 1e-9, 0.013, 0.25, 0.37, 0.5, 0.81, 0.997, 1.0] {
            if let [p, q] = along_edge(&surface, mesh, edge, t)[..] {
                assert!(p.distance(q) < 1e-12 * size, "{edge} at {t}: {:e} of {size}", p.distance(q));
                compared += 1;
            }
        }
    }
    compared
}

#[test]
fn triangles_meet_at_their_edges() {
    for mesh in wheels() {
        assert!(is_continuous(&mesh, 1) > 0);
    }
    let Some(folder) = common::meshes() else { return };
    let mut compared = 0;
    for place in ["models", "papers", "loop_reference"] {
        for entry in std::fs::read_dir(folder.join(place)).unwrap() {
            let Ok(loaded) = vvmesh::io::read(entry.unwrap().path()) else { continue };
            let triangles = loaded.faces.triangulate().triangles;
            let Ok(mesh) = Mesh::from_triangles(loaded.faces.positions, &triangles) else { continue };
            compared += is_continuous(&mesh, mesh.edge_count().div_ceil(500));
        }
    }
    assert!(compared > 100_000, "only {compared} points were compared");
}

#[test]
fn what_is_not_defined_is_not_told() {
    let cone = tagged_wheel(5, &[], true);
    let surface = LimitSurface::new(&cone, LoopWeights::Loop);
    let triangle = cone.triangles().next().unwrap();
    let tip = surface.evaluate(triangle, 1.0, 0.0).unwrap();
    assert_eq!(tip, Evaluation { position: cone.position(id(0)), first: None, second: None });
    assert_eq!(tip.normal(), None);
    let five = wheel(5, 3);
    let surface = LimitSurface::new(&five, LoopWeights::Loop);
    let corner = surface.evaluate(triangle, 1.0, 0.0).unwrap();
    assert!(corner.first.is_some() && corner.second.is_none());
    let [a, b, c] = triangle.corners();
    assert!(surface.evaluate(Triangle::new(a, c, b), 0.3, 0.3).is_none(), "seen from behind");
    assert!(surface.evaluate(Triangle::new(a, b, id(12)), 0.3, 0.3).is_none());
    assert!(surface.evaluate(Triangle::new(id(1000), id(1001), id(1002)), 0.3, 0.3).is_none());
}

#[test]
#[should_panic(expected = "is not in the triangle")]
fn points_outside_are_refused() {
    let mesh = wheel(5, 3);
    let triangle = mesh.triangles().next().unwrap();
    let _ = LimitSurface::new(&mesh, LoopWeights::Loop).evaluate(triangle, 0.7, 0.4);
}
