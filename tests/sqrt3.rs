//! √3: its masks, its counts, its boundary, and that a part refined alone equals the same part refined with the rest.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;
#[path = "common/plain.rs"]
mod plain;

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use common::random::{Closed, Picks, Random, Surface, WithBoundary, check};
use common::run::{Beside, Run};
use vvmesh::adaptive::{AdaptiveMethod, Incremental, Simple, Uniform};
use vvmesh::check::mesh_conformity;
use vvmesh::error::RefineError;
use vvmesh::glam::DVec3;
use vvmesh::query::r_disk;
use vvmesh::scheme::{Loop, Mask, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep, Lineage, Region, SplitKind};
use vvmesh::subdivide::{Control, Progress, Step, Subdivider, Values};
use vvmesh::{Edge, Mesh, Triangle, VertexId, shapes};

/// How many steps are compared.
const LEVELS: usize = 5;

fn uniform() -> Subdivider {
    Subdivider::new(Sqrt3::default(), Uniform)
}

fn simple() -> Subdivider {
    Subdivider::new(Sqrt3::default(), Simple)
}

fn incremental(rings: usize) -> Subdivider {
    Subdivider::new(Sqrt3::default(), Incremental::new(rings).unwrap())
}

/// The uniform run before the first step and after each.
fn uniform_levels(mesh: &Mesh, levels: usize) -> Vec<Run> {
    let mut runs = vec![Run::new(mesh)];
    for k in 0..levels {
        let mut next = runs[k].clone();
        next.step(&uniform(), &Selection::empty());
        runs.push(next);
    }
    runs
}

fn triangle() -> Mesh {
    Mesh::from_triangles(vec![DVec3::ZERO, DVec3::X, DVec3::Y], &[[0, 1, 2]]).unwrap()
}

fn is_boundary(mesh: &Mesh, edge: Edge) -> bool {
    let [a, b] = edge.ends();
    mesh.rotation().is_boundary_edge(a, b)
}

// Masks.

#[test]
fn masks_add_to_one() {
    let scheme = Sqrt3::default();
    let triangle = triangle();
    for n in 3..=40 {
        let points = (0..=n).map(|k| DVec3::new(f64::from(k), 0.0, 0.0)).collect();
        let faces: Vec<[u32; 3]> = (0..n as u32).map(|k| [0, 1 + k, 1 + (k + 1) % n as u32]).collect();
        let star = Mesh::from_triangles(points, &faces).unwrap();
        let [v, p, q] = [0, 1, 2].map(VertexId::new);
        let mut masks = [(); 4].map(|()| Mask::default());
        scheme.even(star.neighborhood(), v, &mut masks[0]);
        scheme.even(triangle.neighborhood(), p, &mut masks[1]);
        scheme.third(triangle.neighborhood(), p, q, &mut masks[2]);
        scheme.center([v, p, q], &mut masks[3]);
        assert!(masks.iter().all(|mask| (mask.sum() - 1.0).abs() < 1e-15), "valence {n}");
    }
    assert_eq!((scheme.alpha(0), scheme.alpha(6), scheme.alpha(3)), (0.0, 1.0 / 3.0, 5.0 / 9.0));
}

/// A regular grid in the plane stays regular where no corner of it is near, whatever linear map it went through.
#[test]
fn a_regular_grid_stays_regular() {
    let grid = shapes::grid(8, 8);
    let map = |p: DVec3| DVec3::new(2.0 * p.x + p.y, p.y - 3.0 * p.x + 1.0, p.x + 0.5);
    let mut mesh = grid.clone();
    mesh.positions_mut().iter_mut().for_each(|p| *p = map(*p));
    let [mut plain, mut mapped] = [Run::new(&grid), Run::new(&mesh)];
    for _ in 0..2 {
        plain.step(&uniform(), &Selection::empty());
        mapped.step(&uniform(), &Selection::empty());
    }
    for v in plain.mesh.vertices() {
        assert!((map(plain.mesh.position(v)) - mapped.mesh.position(v)).length() < 1e-13, "{v}");
    }
    let step = |k: usize| grid.position(VertexId::new(k)) - grid.position(VertexId::new(0));
    let size = step(grid.vertex_count() - 1);
    for v in grid.vertices() {
        let p = grid.position(v);
        let from_corner = |x: f64, size: f64| x.min(size - x);
        if from_corner(p.x, size.x) + from_corner(p.y, size.y) > 0.3 * size.x {
            assert!(p.distance(plain.mesh.position(v)) < 1e-14, "{v}");
        }
    }
}

// What a step does to the topology.

/// The manifold meshes of the folder.
fn models() -> Vec<(String, Mesh)> {
    common::meshes().map_or_else(Vec::new, |folder| plain::models(&folder))
}

fn counts(mesh: &Mesh) -> [usize; 3] {
    [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()]
}

fn triples_and_nines<S: Surface>(surface: S) {
    assert_counts(&surface.mesh());
}

fn assert_counts(mesh: &Mesh) {
    let runs = uniform_levels(mesh, 4);
    let boundary = |k: usize| runs[k].mesh.rotation().boundary_edge_count();
    for k in 1..=4 {
        let ([v, e, f], [w, g, h]) = (counts(&runs[k - 1].mesh), counts(&runs[k].mesh));
        // In a second step a triangle at the boundary gets two vertices instead of one.
        let cut = if k % 2 == 0 { boundary(k - 1) } else { 0 };
        assert_eq!([w, h, g], [v + f + cut, 3 * f, e + 3 * f + cut], "step {k}");
        assert_eq!(boundary(k), boundary(k - 1) + 2 * cut, "step {k}");
        assert_eq!(runs[k].mesh.rotation().validate_triangles(), []);
        assert!(k % 2 == 1 || h == 9 * counts(&runs[k - 2].mesh)[2]);
    }
    // Two steps keep valences, and what is new is regular.
    for v in runs[2].mesh.vertices() {
        let ring = runs[2].mesh.ring(v);
        let expected = if v.index() < mesh.vertex_count() {
            mesh.ring(v).valence()
        } else if ring.is_open() {
            4
        } else {
            6
        };
        assert_eq!(ring.valence(), expected, "{v}");
    }
}

#[test]
fn a_step_makes_three_of_a_triangle_and_two_make_nine() {
    for mesh in
        [shapes::tetrahedron(), shapes::octahedron(), shapes::icosahedron(), shapes::grid(1, 1), shapes::grid(3, 2)]
    {
        assert_counts(&mesh);
    }
    assert_counts(&triangle());
    check(3001, 40, triples_and_nines as fn(Closed));
    check(3002, 40, triples_and_nines as fn(WithBoundary));
}

#[test]
fn rings_start_at_the_oldest_corner_and_names_say_where_it_all_came_from() {
    let mut run = Run::new(&shapes::grid(1, 1));
    run.step(&uniform(), &Selection::empty());
    let id = VertexId::new;
    // Two triangles 0 1 3 and 0 3 2 with an edge between, which is turned.
    assert_eq!(run.history.parents(id(4)), Some(Lineage::Face([id(0), id(1), id(3)])));
    assert_eq!(run.mesh.ring(id(4)).neighbors(), [0, 1, 3, 5].map(id));
    assert_eq!(run.mesh.ring(id(0)).neighbors(), [1, 4, 5, 2].map(id));
    run.step(&uniform(), &Selection::empty());
    let names: BTreeSet<String> =
        (6..run.mesh.vertex_count()).map(|k| run.history.parents(id(k)).unwrap().to_string()).collect();
    assert!(["0>1", "1>0", "0,4,5", "3,5,4"].iter().all(|name| names.contains(*name)), "{names:?}");
    assert_eq!((run.history.level(id(4)), run.history.level(id(6))), (Some(1), Some(2)));
    assert_eq!(run.history.split_kind(), Some(SplitKind::Trisect));
}

// Incremental.

fn assert_exact(selection: &Selection, beside: &Beside<'_>, what: &str) {
    for &v in selection.vertices() {
        assert!(beside.rotation_is_same(v), "{what}: other neighbours at {v}");
        assert!(beside.star_is_same(v), "{what}: another position at or beside {v}");
    }
}

fn assert_follows(selection: &Selection, run: &Run, first: usize, step: &Step) {
    let mut expected: BTreeSet<VertexId> = selection.vertices().iter().copied().collect();
    for v in run.mesh.vertices().skip(first) {
        let inside = match run.history.parents(v).unwrap() {
            Lineage::Face(corners) => corners.iter().all(|corner| expected.contains(corner)),
            // Of the ring only the start and the end, and what comes next to these, is sure.
            Lineage::Third { near, far } => {
                let ring = run.mesh.ring(v).neighbors();
                let apex = if ring[0] == near { ring[ring.len() - 2] } else { ring[1] };
                [near, far, apex].iter().all(|corner| expected.contains(corner))
            }
            Lineage::Edge(_) => unreachable!("no edge is halved"),
        };
        if inside {
            expected.insert(v);
        }
    }
    assert_eq!(step.selection.vertices(), expected.into_iter().collect::<Vec<_>>());
}

fn exact<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    let patch = picks.patch(&mesh);
    assert_nested_is_exact(&mesh, &patch, &uniform_levels(&mesh, LEVELS), |selection, k| picks.part(selection, k));
}

fn assert_nested_is_exact(
    mesh: &Mesh,
    patch: &Selection,
    levels: &[Run],
    mut part: impl FnMut(&Selection, usize) -> Selection,
) {
    for rings in 1..=3 {
        let (mut run, mut selection) = (Run::new(mesh), patch.clone());
        for (k, uniform) in levels.iter().enumerate().skip(1) {
            let first = run.mesh.vertex_count();
            let step = run.step(&incremental(rings), &selection);
            assert_follows(&selection, &run, first, &step);
            assert_exact(&step.selection, &Beside::new(&run, uniform), &format!("r {rings}, step {k}"));
            assert_eq!(run.mesh.rotation().validate_triangles(), []);
            selection = part(&step.selection, k - 1);
        }
    }
}

#[test]
fn nested_selections_are_exact_from_one_ring_on() {
    check(3003, 12, exact as fn(Closed, Picks));
    check(3004, 12, exact as fn(WithBoundary, Picks));
}

/// A method that says it is exact.
#[derive(Debug)]
struct Rings(usize);

impl AdaptiveMethod for Rings {
    fn region(&self, mesh: &Mesh, selection: &Selection, scratch: &mut Scratch) -> Region {
        let seeds = selection.vertices().iter().copied();
        Region::induced(r_disk(mesh.rotation(), seeds, self.0, scratch).into_vertices())
    }

    fn promises_exactness(&self) -> bool {
        true
    }
}

/// Without a ring neighbours differ from the first step on, so what holds with one is no matter of course.
#[test]
fn without_a_ring_nothing_is_exact() {
    let mesh = shapes::torus(12, 8, 2.0, 1.0);
    let selection: Selection =
        r_disk(mesh.rotation(), [VertexId::new(5)], 2, &mut Scratch::new()).into_vertices().into_iter().collect();
    let mut run = Run::new(&mesh);
    run.step(&Subdivider::new(Sqrt3::default(), Rings(0)), &selection);
    let levels = uniform_levels(&mesh, 1);
    let beside = Beside::new(&run, &levels[1]);
    assert!(selection.vertices().iter().any(|&v| !beside.rotation_is_same(v)));
}

/// A selection may begin after any number of uniform steps, also at the apex of a triangle that is about to be cut.
#[test]
fn late_selections_are_exact() {
    let mut mesh = shapes::grid(6, 6);
    mesh.positions_mut().iter_mut().enumerate().for_each(|(k, p)| p.z = (k * k % 17) as f64);
    let levels = uniform_levels(&mesh, 4);
    for v in levels[1].mesh.vertices() {
        let (mut run, mut selection) = (levels[1].clone(), [v].into_iter().collect::<Selection>());
        for uniform in &levels[2..] {
            selection = run.step(&incremental(1), &selection).selection;
            assert_exact(&selection, &Beside::new(&run, uniform), &format!("from {v} on"));
        }
    }
}

/// On a model a disk is refined, for all steps.
#[test]
fn nested_selections_are_exact_on_models() {
    for (_, mesh) in models().iter().filter(|(_, mesh)| mesh.face_count() < 1500) {
        let levels = uniform_levels(mesh, 4);
        let mut random = Random::new(3005);
        let center = VertexId::new(random.below(mesh.vertex_count()));
        let patch: Selection =
            r_disk(mesh.rotation(), [center], 2, &mut Scratch::new()).into_vertices().into_iter().collect();
        assert_nested_is_exact(mesh, &patch, &levels, |selection, _| selection.clone());
    }
}

// Simple.

/// The greatest level at which every triangle around a vertex is whole, at least that of its birth.
fn shown_level(run: &Run, v: VertexId) -> usize {
    let born = |v| run.history.level(v).unwrap();
    let whole = |triangle: Triangle| {
        let generation = run.history.generation(triangle).unwrap() as usize;
        let corners = triangle.corners();
        let youngest = (0..3).max_by_key(|&k| born(corners[k])).unwrap();
        let mate = Edge::new(corners[(youngest + 1) % 3], corners[(youngest + 2) % 3]);
        if generation % 2 == 1 && is_boundary(&run.mesh, mate) { generation.div_ceil(2) } else { generation / 2 }
    };
    let level = run.mesh.rotation().triangles_around(v).map(whole).min().unwrap_or(0);
    level.max(born(v).into())
}

/// Every vertex of an adaptive mesh is where uniform refinement to the level of its surroundings has it.
fn assert_shown_where_uniform(run: &Run, levels: &[Run]) {
    let same: Vec<_> = levels.iter().map(|uniform| run.history.same_names(&uniform.history).unwrap()).collect();
    for v in run.mesh.vertices() {
        let level = shown_level(run, v);
        let twin = same[level][v.index()].unwrap_or_else(|| panic!("{v} is not in the uniform mesh of level {level}"));
        let apart = run.mesh.position(v).distance(levels[level].mesh.position(twin));
        assert!(apart < 1e-12, "{v} at level {level}, born at {:?}: {apart:e} apart", run.history.level(v));
    }
}

/// Triangles beside each other differ by two half steps at most, and the mesh is whole.
fn assert_balanced(run: &Run) {
    assert_eq!(run.mesh.rotation().validate_triangles(), []);
    let generation = |a: VertexId, b, c| run.history.generation(Triangle::new(a, b, c)).unwrap();
    for edge in run.mesh.edges() {
        let [a, b] = edge.ends();
        let (left, right) = (run.mesh.rotation().left_of(a, b), run.mesh.rotation().right_of(a, b));
        if let (Some(left), Some(right)) = (left, right) {
            assert!(generation(a, b, left).abs_diff(generation(b, a, right)) <= 2, "at {edge:?}");
        }
    }
}

fn random_selection(mesh: &Mesh, random: &mut Random) -> Selection {
    let mut selected = BTreeSet::new();
    for _ in 0..1 + random.below(3) {
        let center = VertexId::new(random.below(mesh.vertex_count()));
        selected.extend(r_disk(mesh.rotation(), [center], random.below(4), &mut Scratch::new()).into_vertices());
    }
    let share = 2 + random.below(4);
    selected.into_iter().filter(|_| random.below(6) <= share).collect()
}

fn adaptive<S: Surface>(surface: S, seed: u16) {
    let mesh = surface.mesh();
    let levels = uniform_levels(&mesh, LEVELS);
    let mut random = Random::new(seed.into());
    let mut run = Run::new(&mesh);
    let mut selection = random_selection(&mesh, &mut random);
    for _ in 0..LEVELS {
        let step = run.step(&simple(), &selection);
        assert!(step.t_vertices.is_empty() && step.o_vertices.is_empty() && step.certified.is_none());
        assert_balanced(&run);
        assert_shown_where_uniform(&run, &levels);
        selection = if random.below(2) == 0 { step.selection } else { random_selection(&run.mesh, &mut random) };
    }
}

#[test]
fn every_vertex_is_shown_where_uniform_refinement_has_it() {
    check(3006, 30, adaptive as fn(Closed, u16));
    check(3007, 30, adaptive as fn(WithBoundary, u16));
}

/// Simple with everything selected is uniform, but for rounding.
#[test]
fn simple_of_everything_is_uniform() {
    for mesh in [shapes::icosahedron(), shapes::grid(2, 3), shapes::grid(1, 1)] {
        let levels = uniform_levels(&mesh, 4);
        let (mut run, mut selection) = (Run::new(&mesh), Selection::all(mesh.vertex_count()));
        for uniform in &levels[1..] {
            selection = run.step(&simple(), &selection).selection;
            assert_eq!((selection.len(), counts(&run.mesh)), (run.mesh.vertex_count(), counts(&uniform.mesh)));
            assert_shown_where_uniform(&run, &levels);
        }
    }
}

#[test]
fn adaptive_meshes_conform_after_each_of_six_steps() {
    for (name, mesh) in models() {
        for (seed, subdivider) in [simple(), incremental(1)].into_iter().enumerate() {
            let mut random = Random::new(3008 + seed as u64);
            let mut run = Run::new(&mesh);
            for _ in 0..6 {
                let selection = random_selection(&run.mesh, &mut random);
                run.step(&subdivider, &selection);
                assert_balanced(&run);
                // Of the input, which has its own faults, only what is new can be judged.
                let before = mesh_conformity(&mesh, None).findings.len();
                assert!(mesh_conformity(&run.mesh, None).findings.len() <= before, "{name}");
            }
        }
    }
}

/// The time of a step grows with the valence of a vertex, not with its square: else this would take minutes.
#[test]
fn a_vertex_of_high_valence_is_no_trap() {
    const N: u32 = 30_000;
    let rim = (0..N).map(f64::from).map(|k| DVec3::new(k.sin(), k.cos(), 0.0));
    let positions = [DVec3::Z, -DVec3::Z].into_iter().chain(rim).collect();
    let faces: Vec<[u32; 3]> =
        (0..N).map(|k| [2 + k, 2 + (k + 1) % N]).flat_map(|[p, q]| [[0, p, q], [1, q, p]]).collect();
    let mesh = Mesh::from_triangles(positions, &faces).unwrap();
    for subdivider in [uniform(), incremental(1), simple()] {
        let mut run = Run::new(&mesh);
        let mut selection: Selection = mesh.vertices().filter(|v| v.index() % 5 != 4).collect();
        for _ in 0..2 {
            selection = run.step(&subdivider, &selection).selection;
        }
        assert_eq!(run.mesh.rotation().validate_triangles(), []);
    }
}

// A step is made whole or not at all.

#[test]
fn a_step_that_is_not_made_leaves_everything_as_it_was() {
    let mesh = shapes::grid(5, 5);
    for subdivider in [uniform(), incremental(1), simple()] {
        let mut random = Random::new(3009);
        let mut run = Run::new(&mesh);
        for _ in 0..5 {
            let selection = random_selection(&run.mesh, &mut random);
            let mut next = run.clone();
            let step = next.step(&subdivider, &selection);
            let faces = next.mesh.face_count() as u64;
            for stop in 0..40 {
                let mut tried = run.clone();
                let mut asked = 0;
                let mut progress = |_: Progress| {
                    asked += 1;
                    if asked > stop { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
                };
                let control = &mut Control { progress: Some(&mut progress), ..Control::default() };
                let (Run { mesh, history }, scratch) = (&mut tried, &mut Scratch::new());
                let result = subdivider.step(mesh, history, &selection, scratch, control);
                match result {
                    Ok(again) => {
                        assert_eq!((again, tried.bits()), (step.clone(), next.bits()));
                        break;
                    }
                    Err(error) => assert_eq!((error, tried.bits()), (RefineError::Cancelled, run.bits())),
                }
                // What stayed the same behind the scenes: the step can be made now.
                assert_eq!((tried.step(&subdivider, &selection), tried.bits()), (step.clone(), next.bits()));
            }
            let mut tried = run.clone();
            let (Run { mesh, history }, scratch) = (&mut tried, &mut Scratch::new());
            let control = &mut Control { max_faces: Some(faces - 1), ..Control::default() };
            let result = subdivider.step(mesh, history, &selection, scratch, control);
            assert!(result.is_err() || faces == run.mesh.face_count() as u64);
            assert_eq!(tried.bits(), run.bits());
            run = next;
        }
    }
}

#[test]
fn splits_and_ways_to_place_do_not_mix() {
    let mesh = shapes::icosahedron();
    let step = |first: &Subdivider, second: &Subdivider| {
        let (mut run, mut scratch) = (Run::new(&mesh), Scratch::new());
        run.step(first, &Selection::empty());
        let before = run.bits();
        let Run { mesh, history } = &mut run;
        let result = second.step(mesh, history, &Selection::empty(), &mut scratch, &mut Control::default());
        assert!(result.is_ok() || run.bits() == before);
        result.err()
    };
    let of_loop = Subdivider::new(Loop::default(), Uniform);
    let other = |made, asked| Some(RefineError::OtherSplit { made, asked });
    assert_eq!(step(&of_loop, &uniform()), other("quadrisection", "trisection"));
    assert_eq!(step(&uniform(), &of_loop), other("trisection", "quadrisection"));
    assert_eq!(step(&uniform(), &simple()), Some(RefineError::OtherPositions));
    assert_eq!(step(&simple(), &incremental(1)), Some(RefineError::OtherPositions));
    assert_eq!(step(&uniform(), &incremental(2)), None);
}

#[test]
fn what_is_kept_changes_nothing() {
    let mesh = shapes::grid(4, 3);
    for subdivider in [uniform(), incremental(1), simple()] {
        let mut random = Random::new(3010);
        let mut run = Run::new(&mesh);
        let (mut bare, mut history) = (mesh.clone(), History::new(&mesh, Keep::default()));
        for _ in 0..4 {
            let selection = random_selection(&run.mesh, &mut random);
            run.step(&subdivider, &selection);
            let control = &mut Control::default();
            subdivider.step(&mut bare, &mut history, &selection, &mut Scratch::new(), control).unwrap();
            assert_eq!(run.bits(), common::run::MeshBits::of(&bare));
        }
        assert!(run.history.memory_bytes() > history.memory_bytes());
    }
}

#[test]
fn what_goes_along_is_there_from_the_first_step_on() {
    let mesh = shapes::grid(4, 3);
    for subdivider in [uniform(), incremental(1), simple()] {
        let mut random = Random::new(3011);
        let mut run = Run::new(&mesh);
        let mut early = Values::new(mesh.positions().to_vec());
        for level in 0..5 {
            let selection = random_selection(&run.mesh, &mut random);
            let step = |run: &mut Run, follower: &mut Values<DVec3>| {
                let control = &mut Control { follower: Some(follower), ..Control::default() };
                subdivider.step(&mut run.mesh, &mut run.history, &selection, &mut Scratch::new(), control).map(|_| ())
            };
            if level > 0 && format!("{subdivider:?}").contains("Simple") {
                let (before, mut late) = (run.bits(), Values::new(run.mesh.positions().to_vec()));
                assert_eq!(step(&mut run, &mut late), Err(RefineError::JoinedLate));
                assert_eq!(run.bits(), before);
            }
            step(&mut run, &mut early).unwrap();
            assert_eq!(early.shown(), run.mesh.positions());
        }
    }
}

// Another program.

/// Positions, triangles, and the positions and triangles after two steps of another program.
fn read_fixture(name: &str) -> [(Vec<DVec3>, Vec<[u32; 3]>); 2] {
    let path = format!("{}/tests/fixtures/sqrt3/{name}.txt", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let mut meshes = [(); 2].map(|()| (Vec::new(), Vec::new()));
    let mut k = 0;
    for line in text.lines() {
        let mut words = line.split(' ');
        match words.next().unwrap() {
            "v" => meshes[k].0.push(DVec3::from_slice(&words.map(|word| word.parse().unwrap()).collect::<Vec<f64>>())),
            "f" => meshes[k].1.push(std::array::from_fn(|_| words.next().unwrap().parse().unwrap())),
            _ => k += 1,
        }
    }
    meshes
}

/// The corners and, so that triangles are compared too, the centres of the triangles.
fn points(positions: &[DVec3], triangles: impl Iterator<Item = [usize; 3]>) -> Vec<DVec3> {
    let center = |corners: [usize; 3]| corners.map(|v| positions[v]).iter().sum::<DVec3>() / 3.0;
    positions.iter().copied().chain(triangles.map(center)).collect()
}

#[test]
fn two_steps_are_those_of_another_program() {
    for name in ["torus_split", "torus_cut"] {
        let [(positions, triangles), (their_positions, their_triangles)] = read_fixture(name);
        let mesh = Mesh::from_triangles(positions, &triangles).unwrap();
        let levels = uniform_levels(&mesh, 2);
        let ours = &levels[2].mesh;
        assert_eq!((ours.vertex_count(), ours.face_count()), (their_positions.len(), their_triangles.len()));
        let ours = points(ours.positions(), ours.triangles().map(|t| t.corners().map(VertexId::index)));
        let theirs = points(&their_positions, their_triangles.iter().map(|t| t.map(|v| v as usize)));
        let distance = |a: &[DVec3], b: &[DVec3]| {
            let nearest = |x: &DVec3| b.iter().map(|y| x.distance(*y)).fold(f64::INFINITY, f64::min);
            a.iter().map(nearest).fold(0.0, f64::max)
        };
        let apart = distance(&ours, &theirs).max(distance(&theirs, &ours));
        assert!(apart < 1e-12, "{name}: {apart:e}");
    }
}
