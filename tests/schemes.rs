//! What masks must do, whatever the mesh.

#![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

mod common;
mod scheme_support;

use common::random::check;
use scheme_support::{apply, even, odd, scripted, star};
use vvmesh::glam::{DMat3, DVec3};
use vvmesh::mesh::{Sharpness, VertexClass};
use vvmesh::scheme::{Butterfly, Loop, LoopWeights, Mask, Midpoint, ModifiedButterfly, Reach, Scheme};
use vvmesh::{Edge, Mesh, VertexId, shapes};

/// Calls a function with every scheme in turn, once for each choice of weights.
macro_rules! with_every_scheme {
    ($check:ident($($argument:expr),*)) => {
        $check(&Loop::default(), $($argument),*)
            && $check(&Loop::new(LoopWeights::Warren), $($argument),*)
            && $check(&Butterfly, $($argument),*)
            && $check(&ModifiedButterfly, $($argument),*)
            && $check(&Midpoint, $($argument),*)
    };
}

fn id(index: usize) -> VertexId {
    VertexId::new(index)
}

/// Whether a vertex is wholly smooth and not isolated.
fn is_smooth(mesh: &Mesh, v: VertexId) -> bool {
    let around = mesh.neighborhood();
    around.class(v) == VertexClass::Smooth && !around.is_semi_sharp(v) && mesh.ring(v).valence() > 0
}

/// A mesh from a script, on which every second tag has a sharpness of 0.2 to 1.6.
fn tagged(script: &[(u8, u16)]) -> Mesh {
    let mut mesh = scripted(script);
    let values = (1..).map(|k| Sharpness::new(0.2 * f64::from(1 + k % 8)).unwrap());
    for (edge, sharpness) in mesh.tags().sharp_edges().into_iter().step_by(2).zip(values.clone()) {
        assert!(mesh.set_sharpness(edge, sharpness));
    }
    for (v, sharpness) in mesh.tags().corners().into_iter().step_by(2).zip(values) {
        assert!(mesh.set_vertex_sharpness(v, sharpness));
    }
    mesh
}

fn vertices_of(mask: &Mask) -> impl Iterator<Item = VertexId> {
    mask.groups().iter().flat_map(|(_, vertices)| vertices.iter().copied())
}

fn is_affine(mask: &Mask) -> bool {
    (mask.sum() - 1.0).abs() < 1e-13 && mask.groups().iter().all(|(weight, _)| weight.abs() <= 2.0)
}

/// Whether all weights add to 1, and masks weigh no more than the scheme says.
fn masks_are_affine_and_local(scheme: &impl Scheme, mesh: &Mesh) -> bool {
    let near = |v: VertexId, w: VertexId| v == w || mesh.ring(v).contains(w);
    let evens = mesh.vertices().all(|v| {
        let mask = even(scheme, mesh, v);
        is_affine(&mask) && vertices_of(&mask).all(|w| near(v, w)) && (scheme.moves_even() || mask.weight_of(v) == 1.0)
    });
    let odds = mesh.edges().all(|edge| {
        let [p, q] = edge.ends();
        let mask = odd(scheme, mesh, p, q);
        let supported = |w: VertexId| match scheme.reach() {
            Reach::Ends => w == p || w == q,
            Reach::OneStar => near(p, w) && near(q, w),
            Reach::BothStars => near(p, w) || near(q, w),
        };
        is_affine(&mask) && vertices_of(&mask).all(supported)
    });
    evens && odds
}

/// Whether an edge has the same weights read from its other end.
fn masks_are_the_same_from_both_ends(scheme: &impl Scheme, mesh: &Mesh) -> bool {
    mesh.edges().all(|edge| {
        let [p, q] = edge.ends();
        let (there, back) = (odd(scheme, mesh, p, q), odd(scheme, mesh, q, p));
        vertices_of(&there).chain(vertices_of(&back)).all(|v| (there.weight_of(v) - back.weight_of(v)).abs() < 1e-15)
    })
}

/// Whether mapping positions and subdividing commute.
fn masks_commute_with_affine_maps(scheme: &impl Scheme, mesh: &Mesh, map: DMat3, shift: DVec3) -> bool {
    let image = |x: DVec3| map * x + shift;
    let commutes = |mask: Mask| {
        let (first, then) = (apply(&mask, |v| image(mesh.position(v))), image(apply(&mask, |v| mesh.position(v))));
        (first - then).length() < 1e-11
    };
    mesh.vertices().all(|v| commutes(even(scheme, mesh, v)))
        && mesh.edges().all(|edge| commutes(odd(scheme, mesh, edge.ends()[0], edge.ends()[1])))
}

/// Whether tags that touch neither end leave the mask of an edge as it is.
fn odd_masks_do_not_see_beyond_the_ends(scheme: &impl Scheme, mesh: &Mesh) -> bool {
    let edges: Vec<Edge> = mesh.edges().collect();
    edges.iter().enumerate().all(|(k, edge)| {
        let [p, q] = edge.ends();
        let mut other = mesh.clone();
        for (m, far) in edges.iter().enumerate() {
            let ends = far.ends();
            if (k + m) % 3 == 0 && !ends.contains(&p) && !ends.contains(&q) {
                other.set_sharp(*far, !mesh.tags().is_sharp(*far));
                other.set_corner(ends.into_iter().max().unwrap(), true);
            }
        }
        odd(scheme, mesh, p, q) == odd(scheme, &other, p, q)
    })
}

#[test]
fn weights_add_to_one() {
    fn property(script: Vec<(u8, u16)>) -> bool {
        with_every_scheme!(masks_are_affine_and_local(&tagged(&script)))
    }
    check(204, 100, property as fn(Vec<(u8, u16)>) -> bool);
}

#[test]
fn direction_does_not_matter() {
    fn property(script: Vec<(u8, u16)>) -> bool {
        with_every_scheme!(masks_are_the_same_from_both_ends(&tagged(&script)))
    }
    check(205, 100, property as fn(Vec<(u8, u16)>) -> bool);
}

#[test]
fn affine_maps_commute() {
    fn property(script: Vec<(u8, u16)>, map: [i8; 3]) -> bool {
        let [a, b, c] = map.map(|x| f64::from(x) / 32.0);
        let map = DMat3::from_cols_array(&[a, 1.0, b, -c, 0.5, 2.0, b, c, -1.0]);
        with_every_scheme!(masks_commute_with_affine_maps(&tagged(&script), map, DVec3::new(c, a, b)))
    }
    check(206, 100, property as fn(Vec<(u8, u16)>, [i8; 3]) -> bool);
}

#[test]
fn odd_masks_are_functions_of_both_stars() {
    fn property(script: Vec<(u8, u16)>) -> bool {
        with_every_scheme!(odd_masks_do_not_see_beyond_the_ends(&tagged(&script)))
    }
    check(207, 100, property as fn(Vec<(u8, u16)>) -> bool);
}

/// ALGORITHMS 2.3: v' - c' = lambda (v - c) and c' = 3/8 v + 5/8 c.
#[test]
fn one_loop_step_shrinks_the_distance_to_the_mean() {
    fn property(script: Vec<(u8, u16)>) -> bool {
        let mesh = tagged(&script);
        let at = |v| mesh.position(v);
        [LoopWeights::Loop, LoopWeights::Warren].into_iter().all(|weights| {
            let scheme = Loop::new(weights);
            mesh.vertices().filter(|&v| is_smooth(&mesh, v)).all(|v| {
                let ring = mesh.ring(v);
                let n = ring.valence();
                let mean = ring.iter().map(at).sum::<DVec3>() / n as f64;
                let new_mean = ring.iter().map(|w| apply(&odd(&scheme, &mesh, v, w), at)).sum::<DVec3>() / n as f64;
                let new = apply(&even(&scheme, &mesh, v), at);
                (new - new_mean - weights.lambda(n) * (at(v) - mean)).length() < 1e-14
                    && (new_mean - 0.375 * at(v) - 0.625 * mean).length() < 1e-14
            })
        })
    }
    check(208, 100, property as fn(Vec<(u8, u16)>) -> bool);
}

#[test]
fn scripts_reach_every_class_of_vertices() {
    let mut seen = std::collections::BTreeMap::new();
    for seed in 0..250_u64 {
        let script: Vec<(u8, u16)> = (0..40)
            .map(|k| (41 * seed + k + 1).wrapping_mul(6_364_136_223_846_793_005))
            .map(|x| ((x >> 33) as u8, (x >> 41) as u16))
            .collect();
        let mesh = tagged(&script);
        for v in mesh.vertices() {
            let class = format!("{:?}", mesh.neighborhood().class(v));
            let is_semi_sharp = mesh.neighborhood().is_semi_sharp(v);
            *seen.entry((class, mesh.is_boundary(v), is_semi_sharp)).or_insert(0) += 1;
        }
    }
    // A boundary vertex is a crease or a corner, any other may be all four; and each may be semi-sharp.
    assert_eq!(seen.len(), 12, "{seen:?}");
    assert!(seen.values().all(|&times| times > 50), "{seen:?}");
}

#[test]
fn weights_add_to_one_at_every_valence() {
    for n in 3..=40 {
        for sharp in [&[][..], &[1], &[1, 2], &[1, 3], &[1, n / 2 + 1], &[1, 2, 3]] {
            let mut mesh = star(n, true);
            for &w in sharp {
                mesh.set_sharp(Edge::new(id(0), id(w)), true);
            }
            assert!(with_every_scheme!(masks_are_affine_and_local(&mesh)), "valence {n}, sharp {sharp:?}");
        }
        assert!(with_every_scheme!(masks_are_affine_and_local(&star(n - 1, false))), "boundary valence {}", n - 1);
    }
}

#[test]
fn loop_weights_have_their_printed_values() {
    let printed = [(3, 0.0625), (4, 0.140625), (5, 0.20453), (6, 0.25), (7, 0.28183), (8, 0.30446), (10, 0.33322)];
    for (n, lambda) in printed.into_iter().chain([(18, 0.37201), (1_000_000, 25.0 / 64.0)]) {
        let weights = LoopWeights::Loop;
        assert!((weights.lambda(n) - lambda).abs() < 5e-6, "lambda({n}) = {}", weights.lambda(n));
        assert!((0.625 - n as f64 * weights.alpha(n) - weights.lambda(n)).abs() < 1e-15);
    }
    for weights in [LoopWeights::Loop, LoopWeights::Warren] {
        assert_eq!((weights.alpha(3), weights.alpha(6)), (3.0 / 16.0, 1.0 / 16.0));
    }
    assert_eq!(LoopWeights::Warren.alpha(8), 3.0 / 64.0);
}

#[test]
fn loop_masks_follow_the_class_of_the_vertex() {
    let mut mesh = star(6, true);
    let (v, scheme) = (id(0), Loop::default());
    let ring: Vec<VertexId> = mesh.ring(v).iter().collect();
    let smooth = [(0.625, vec![v]), (0.0625, ring.clone())];
    assert_eq!(even(&scheme, &mesh, v).groups(), smooth);
    let plain = [(0.375, vec![v, ring[2]]), (0.125, vec![ring[3], ring[1]])];
    assert_eq!(odd(&scheme, &mesh, v, ring[2]).groups(), plain);

    mesh.set_sharp(Edge::new(v, ring[4]), true);
    assert_eq!(even(&scheme, &mesh, v).groups(), smooth, "a dart is as smooth");
    assert_eq!(odd(&scheme, &mesh, v, ring[4]).groups(), [(0.5, vec![v, ring[4]])]);
    mesh.set_sharp(Edge::new(v, ring[1]), true);
    assert_eq!(even(&scheme, &mesh, v).groups(), [(0.75, vec![v]), (0.125, vec![ring[1], ring[4]])]);
    assert_eq!(odd(&scheme, &mesh, v, ring[2]).groups(), plain);
    mesh.set_sharp(Edge::new(v, ring[0]), true);
    assert_eq!(even(&scheme, &mesh, v).groups(), [(1.0, vec![v])]);

    let on_boundary = even(&scheme, &mesh, ring[0]);
    assert_eq!(on_boundary.groups(), [(1.0, vec![ring[0]])], "two boundary edges and a sharp one make a corner");
    let [before, after] = [ring[3], ring[1]];
    let at_boundary = even(&scheme, &mesh, ring[2]);
    assert_eq!(at_boundary.weight_of(ring[2]), 0.75);
    assert_eq!((at_boundary.weight_of(before), at_boundary.weight_of(after), at_boundary.sum()), (0.125, 0.125, 1.0));
}

#[test]
fn isolated_vertices_stay() {
    let mesh = Mesh::from_triangles(vec![DVec3::X], &[]).unwrap();
    for weights in [LoopWeights::Loop, LoopWeights::Warren] {
        assert_eq!(apply(&even(&Loop::new(weights), &mesh, id(0)), |v| mesh.position(v)), DVec3::X);
    }
}

/// A grid with corners tagged, so that its four sides are curves of their own, and with a crease on one line.
fn creased_grid(columns: usize, rows: usize, crease: usize) -> Mesh {
    let mut mesh = shapes::grid(columns, rows);
    let at = |x: usize, y: usize| id(y * (columns + 1) + x);
    for (x, y) in [(0, 0), (columns, 0), (0, rows), (columns, rows)] {
        mesh.set_corner(at(x, y), true);
    }
    for x in 0..columns {
        mesh.set_sharp(Edge::new(at(x, crease), at(x + 1, crease)), true);
    }
    mesh
}

fn odd_is_midpoint(scheme: &impl Scheme, mesh: &Mesh) -> bool {
    mesh.edges().all(|edge| {
        let [p, q] = edge.ends();
        let made = apply(&odd(scheme, mesh, p, q), |v| mesh.position(v));
        made.distance(mesh.position(p).midpoint(mesh.position(q))) < 1e-14
    })
}

#[test]
fn linear_functions_are_reproduced_on_half_lattices() {
    // On the grid x and y are the linear functions. Sides meet at corners of one triangle (crease-crease 1) and of two,
    // strips of one row have crease-crease 2, and the crease meets the boundary at corners of three sharp edges.
    for (columns, rows) in [(1, 1), (5, 1), (1, 6), (2, 2), (3, 3), (7, 6)] {
        let crease = rows / 2;
        let mesh = creased_grid(columns, rows, crease);
        assert!(odd_is_midpoint(&ModifiedButterfly, &mesh), "modified, {columns} x {rows}");
        assert!(odd_is_midpoint(&Butterfly, &mesh), "original, {columns} x {rows}");
    }
    // Loop's odd vertices are midpoints as well, and its inner even ones stay.
    let mesh = shapes::grid(6, 6);
    let inner = |v: VertexId| !mesh.is_boundary(v);
    for v in mesh.vertices().filter(|&v| inner(v)) {
        let moved = apply(&even(&Loop::default(), &mesh, v), |w| mesh.position(w));
        assert!(moved.distance(mesh.position(v)) < 1e-14);
    }
    assert!(odd_is_midpoint(&Loop::default(), &mesh));
}

#[test]
fn butterflies_reproduce_cubic_functions_on_the_regular_grid() {
    let mesh = shapes::grid(8, 8);
    let deep = |v: VertexId| mesh.ring(v).iter().all(|w| !mesh.is_boundary(w)) && !mesh.is_boundary(v);
    let inner: Vec<[VertexId; 2]> = mesh.edges().map(Edge::ends).filter(|[p, q]| deep(*p) && deep(*q)).collect();
    assert!(inner.len() > 50);
    let error = |i: i32, j: i32, mask: &Mask, [p, q]: [VertexId; 2]| {
        let f = |x: DVec3| DVec3::X * x.x.powi(i) * x.y.powi(j);
        let made = apply(mask, |v| f(mesh.position(v)));
        made.distance(f(mesh.position(p).midpoint(mesh.position(q))))
    };
    for ends in inner {
        let [p, q] = ends;
        let mask = odd(&Butterfly, &mesh, p, q);
        assert_eq!(mask, odd(&ModifiedButterfly, &mesh, p, q));
        for (i, j) in (0..=3).flat_map(|i| (0..=3 - i).map(move |j| (i, j))) {
            assert!(error(i, j, &mask, ends) < 1e-11, "x^{i} y^{j} on {p} {q}");
        }
        assert!(error(4, 0, &mask, ends) + error(0, 4, &mask, ends) > 0.1, "degree 4 is too much");
    }
}

#[test]
fn butterflies_agree_on_a_regular_torus() {
    let mesh = shapes::torus(7, 6, 3.0, 1.0);
    for edge in mesh.edges() {
        let [p, q] = edge.ends();
        let mask = odd(&Butterfly, &mesh, p, q);
        assert_eq!(mask, odd(&ModifiedButterfly, &mesh, p, q));
        let mut weights: Vec<f64> = vertices_of(&mask).map(|v| mask.weight_of(v)).collect();
        weights.sort_by(f64::total_cmp);
        assert_eq!(weights, [-0.0625, -0.0625, -0.0625, -0.0625, 0.125, 0.125, 0.5, 0.5]);
    }
}

/// In the chart where a vertex stands at 0 and its neighbours evenly around it on a circle (a crease vertex: on half of
/// one), both rules for extraordinary vertices make the point half way, as midpoints of a regular lattice do.
#[test]
fn extraordinary_rules_halve_the_spokes_of_a_regular_star() {
    let halves = |mesh: &Mesh, w: usize| {
        // A rim vertex has two faces, so its own rule is the midpoint, and the mean is half way if ours is.
        let (v, w) = (id(0), id(w));
        let mask = odd(&ModifiedButterfly, mesh, v, w);
        apply(&mask, |v| mesh.position(v)).distance(0.5 * mesh.position(w)) < 1e-14
    };
    for n in 3..=40 {
        for w in 1..=n {
            assert!(halves(&star(n, true), w), "interior, valence {n}");
        }
        for w in 2..n {
            assert!(halves(&star(n, false), w), "boundary, {} faces, spoke {w}", n - 1);
        }
    }
}

fn weights_by_vertex(mesh: &Mesh, p: usize, q: usize) -> Vec<(usize, f64)> {
    let mask = odd(&ModifiedButterfly, mesh, id(p), id(q));
    let weights = mesh.vertices().map(|v| (v.index(), 16.0 * mask.weight_of(v)));
    weights.filter(|&(_, weight)| weight != 0.0).collect()
}

#[test]
fn modified_butterfly_follows_its_table() {
    let mesh = shapes::grid(6, 6);
    let at = |x: usize, y: usize| y * 7 + x;
    // Interior-crease: from the boundary vertex (3, 0) to (3, 1), and to (4, 1).
    let up = [(2, 0, 1.0), (3, 0, 6.0), (4, 0, -1.0), (2, 1, -1.0), (3, 1, 10.0), (4, 1, 3.0), (4, 2, -2.0)];
    assert_eq!(weights_by_vertex(&mesh, at(3, 0), at(3, 1)), up.map(|(x, y, w)| (at(x, y), w)));
    let right = [(2, 0, -1.0), (3, 0, 6.0), (4, 0, 1.0), (3, 1, 3.0), (4, 1, 10.0), (5, 1, -1.0), (4, 2, -2.0)];
    assert_eq!(weights_by_vertex(&mesh, at(3, 0), at(4, 1)), right.map(|(x, y, w)| (at(x, y), w)));
    // The 4-point rule, along a side and around a corner.
    let side = [(2, 0, -1.0), (3, 0, 9.0), (4, 0, 9.0), (5, 0, -1.0)];
    assert_eq!(weights_by_vertex(&mesh, at(3, 0), at(4, 0)), side.map(|(x, y, w)| (at(x, y), w)));
    let around = [(0, 0, 9.0), (1, 0, 9.0), (2, 0, -1.0), (0, 1, -1.0)];
    assert_eq!(weights_by_vertex(&mesh, at(0, 0), at(1, 0)), around.map(|(x, y, w)| (at(x, y), w)));
    // Crease-crease 1, beside the corner of one triangle.
    let cut = [(4, 0, -2.0), (5, 0, 8.0), (5, 1, 4.0), (6, 1, 8.0), (6, 2, -2.0)];
    assert_eq!(weights_by_vertex(&mesh, at(5, 0), at(6, 1)), cut.map(|(x, y, w)| (at(x, y), w)));
    // Crease-crease 2, across a strip.
    let strip = shapes::grid(5, 1);
    assert_eq!(weights_by_vertex(&strip, 2, 8), [(2, 8.0), (8, 8.0)]);
    // Three boundary edges: both outer points are the third corner.
    let triangle = Mesh::from_triangles(vec![DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]]).unwrap();
    assert_eq!(weights_by_vertex(&triangle, 0, 1), [(0, 9.0), (1, 9.0), (2, -2.0)]);
}

#[test]
fn modified_butterfly_ends_curves_by_reflection() {
    let mut mesh = shapes::grid(8, 8);
    let at = |x: usize| 4 * 9 + x;
    let smooth = weights_by_vertex(&mesh, at(4), at(3));
    for x in 4..6 {
        mesh.set_sharp(Edge::new(id(at(x)), id(at(x + 1))), true);
    }
    assert_eq!(weights_by_vertex(&mesh, at(4), at(5)), [(at(4), 7.0), (at(5), 10.0), (at(6), -1.0)]);
    assert_eq!(weights_by_vertex(&mesh, at(4), at(3)), smooth, "a dart counts as interior, with its whole ring");
    mesh.set_corner(id(at(5)), true);
    assert_eq!(weights_by_vertex(&mesh, at(4), at(5)), [(at(4), 8.0), (at(5), 8.0)]);
}

#[test]
fn original_butterfly_reflects_missing_wings() {
    let mesh = shapes::grid(1, 1);
    // The diagonal of a square: all four wings are missing. p + c - q four times, each c twice.
    let mask = odd(&Butterfly, &mesh, id(0), id(3));
    assert_eq!([0, 1, 2, 3].map(|v| mask.weight_of(id(v))), [0.5, 0.0, 0.0, 0.5]);
    // A side: of its one triangle (0, 1, 3) one wing is vertex 2, the other 1 + 3 - 0.
    let mask = odd(&Butterfly, &mesh, id(0), id(1));
    assert_eq!([0, 1, 2, 3].map(|v| 16.0 * mask.weight_of(id(v))), [9.0, 7.0, -1.0, 1.0]);
}

/// Positions, triangles and, by title, the points after one step by another program.
struct Fixture {
    mesh: Mesh,
    steps: Vec<(String, Vec<DVec3>)>,
}

fn read_fixture(name: &str) -> Fixture {
    let path = format!("{}/tests/fixtures/schemes/{name}.txt", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let (mut points, mut faces, mut steps) = (Vec::new(), Vec::new(), Vec::<(String, Vec<DVec3>)>::new());
    for line in text.lines() {
        let (tag, rest) = line.split_once(' ').unwrap();
        let numbers = || rest.split(' ').map(|word| word.parse::<f64>().unwrap()).collect::<Vec<_>>();
        match tag {
            "v" => points.push(DVec3::from_slice(&numbers())),
            "f" => faces.push([0, 1, 2].map(|k| numbers()[k] as u32)),
            "step" => steps.push((rest.to_owned(), Vec::new())),
            _ => steps.last_mut().unwrap().1.push(DVec3::from_slice(&numbers())),
        }
    }
    Fixture { mesh: Mesh::from_triangles(points, &faces).unwrap(), steps }
}

fn points_after_a_step(scheme: &impl Scheme, mesh: &Mesh) -> Vec<DVec3> {
    let at = |v| mesh.position(v);
    let evens = mesh.vertices().map(|v| apply(&even(scheme, mesh, v), at));
    let odds = mesh.edges().map(|edge| apply(&odd(scheme, mesh, edge.ends()[0], edge.ends()[1]), at));
    evens.chain(odds).collect()
}

#[test]
fn other_programs_make_the_same_points() {
    let mut compared = 0;
    for name in ["icosahedron_split", "torus", "torus_split", "torus_cut"] {
        let Fixture { mesh, steps } = read_fixture(name);
        for (title, theirs) in steps {
            let [scheme, tolerance, _program] = title.split(' ').collect::<Vec<_>>()[..] else { panic!("{title}") };
            let ours = match scheme {
                "loop" => points_after_a_step(&Loop::default(), &mesh),
                "warren" => points_after_a_step(&Loop::new(LoopWeights::Warren), &mesh),
                "butterfly" => points_after_a_step(&Butterfly, &mesh),
                "modified_butterfly" => points_after_a_step(&ModifiedButterfly, &mesh),
                other => panic!("no scheme {other}"),
            };
            assert_eq!(ours.len(), theirs.len(), "{name}, {title}");
            let distance = |a: &[DVec3], b: &[DVec3]| {
                let nearest = |x: &DVec3| b.iter().map(|y| x.distance(*y)).fold(f64::INFINITY, f64::min);
                a.iter().map(nearest).fold(0.0, f64::max)
            };
            let tolerance: f64 = tolerance.parse().unwrap();
            let apart = distance(&ours, &theirs).max(distance(&theirs, &ours));
            assert!(apart < tolerance, "{name}, {title}: {apart:e}");
            compared += 1;
        }
    }
    assert_eq!(compared, 3 * 5 + 2);
}
