//! The 4-8 scheme: against a plain list of triangles, and adaptive refinement against uniform refinement.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;
#[path = "common/plain.rs"]
mod plain;

use std::collections::{BTreeMap, BTreeSet};
use std::ops::ControlFlow;

use common::random::{Closed, Picks, Random, Surface, WithBoundary, check};
use common::run::{Beside, Run, bits};
use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::check::{Sharing, balance, mesh_conformity};
use vvmesh::error::RefineError;
use vvmesh::glam::DVec3;
use vvmesh::query::r_disk;
use vvmesh::scheme::{FourEight, Loop};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{Blocks, Lineage};
use vvmesh::subdivide::{Control, Progress, Subdivider, Values};
use vvmesh::{Mesh, VertexId, shapes};

/// How many steps are made.
const STEPS: usize = 6;

fn uniform() -> Subdivider {
    Subdivider::new(FourEight::default(), Uniform)
}

fn simple() -> Subdivider {
    Subdivider::new(FourEight::default(), Simple)
}

fn incremental(rings: usize) -> Subdivider {
    Subdivider::new(FourEight::default(), Incremental::new(rings).unwrap())
}

/// Every method, uniform first.
fn methods(blocks: Blocks) -> [Subdivider; 4] {
    let scheme = FourEight::new(blocks);
    let incremental = |rings| Subdivider::new(scheme, Incremental::new(rings).unwrap());
    [Subdivider::new(scheme, Uniform), Subdivider::new(scheme, Simple), incremental(1), incremental(2)]
}

/// The uniform run before the first step and after each.
fn uniform_runs(mesh: &Mesh, blocks: Blocks, steps: usize) -> Vec<Run> {
    let mut runs = vec![Run::new(mesh)];
    for k in 0..steps {
        let mut next = runs[k].clone();
        next.step(&methods(blocks)[0], &Selection::empty());
        runs.push(next);
    }
    runs
}

fn level(run: &Run, v: VertexId) -> u8 {
    run.history.level(v).unwrap_or(0)
}

/// The generation of a triangle.
fn generation(run: &Run, corners: [VertexId; 3]) -> u8 {
    corners.map(|v| level(run, v)).into_iter().max().unwrap()
}

/// The least generation of the triangles at a vertex; 0 without any.
fn generation_at(run: &Run, v: VertexId) -> u8 {
    let around = run.mesh.rotation().triangles_around(v);
    around.map(|triangle| generation(run, triangle.corners())).min().unwrap_or(0)
}

/// Asserts valid rings, triangles that differ by one generation at most where they share a vertex, and every vertex
/// where as many uniform steps as its least generation have it.
fn assert_exact(run: &Run, uniform: &[Run], what: &str) {
    assert_eq!(run.mesh.rotation().validate_triangles(), [], "{what}");
    let unbalanced = balance(&run.mesh, Sharing::Vertex, |triangle| generation(run, triangle.corners()).into());
    assert_eq!(unbalanced, [], "{what}");
    let same: Vec<Vec<Option<VertexId>>> =
        uniform.iter().map(|uniform| run.history.same_names(&uniform.history).unwrap()).collect();
    for v in run.mesh.vertices() {
        let steps = usize::from(generation_at(run, v));
        let twin = same[steps][v.index()].unwrap_or_else(|| panic!("{what}: {v} is made otherwise"));
        let places = [run.mesh.position(v), uniform[steps].mesh.position(twin)];
        assert_eq!(bits(places[0]), bits(places[1]), "{what}: {v} of level {} after {steps} steps", level(run, v));
    }
}

fn random_part(mesh: &Mesh, random: &mut Random) -> Selection {
    let center = VertexId::new(random.below(mesh.vertex_count()));
    let radius = 1 + random.below(3);
    r_disk(mesh.rotation(), [center], radius, &mut Scratch::new()).vertices().iter().copied().collect()
}

/// Whatever is selected, step by step, and by whatever method.
fn exact_everywhere<S: Surface>(surface: S, seed: u64) {
    let mesh = surface.mesh();
    let mut random = Random::new(seed);
    for blocks in [Blocks::Maximum, Blocks::LongestEdge] {
        let methods = methods(blocks);
        let uniform = uniform_runs(&mesh, blocks, STEPS);
        let mut run = Run::new(&mesh);
        let mut selection = random_part(&mesh, &mut random);
        for step in 1..=STEPS {
            // Two of three steps follow the one before, so that generations lie close to each other.
            if random.below(3) == 0 {
                selection = random_part(&run.mesh, &mut random);
            }
            // Seldom everything.
            let method = &methods[(1 + random.below(10)) % methods.len()];
            selection = run.step(method, &selection).selection;
            assert_exact(&run, &uniform, &format!("{blocks:?}, {method:?}, step {step}"));
        }
    }
}

#[test]
fn every_vertex_is_where_uniform_steps_have_it() {
    check(81, 60, exact_everywhere::<Closed> as fn(Closed, u64));
    check(82, 60, exact_everywhere::<WithBoundary> as fn(WithBoundary, u64));
}

/// How much of a selection is as in the uniform run: everywhere the position, the neighbours, the neighbours'
/// positions.
fn sameness(selection: &Selection, run: &Run, uniform: &Run) -> [bool; 3] {
    let beside = Beside::new(run, uniform);
    let all = |same: &dyn Fn(VertexId) -> bool| selection.vertices().iter().all(|&v| same(v));
    [all(&|v| beside.position_is_same(v)), all(&|v| beside.rotation_is_same(v)), all(&|v| beside.star_is_same(v))]
}

/// One ring is enough for positions and neighbours of nested selections, two for the neighbours' positions.
fn assert_rings(mesh: &Mesh, patch: &Selection, uniform: &[Run], part: impl Fn(Selection, usize) -> Selection) {
    for rings in 1..=3 {
        let (mut run, mut selection) = (Run::new(mesh), patch.clone());
        for (k, uniform) in uniform.iter().enumerate().skip(1) {
            let before = selection;
            selection = run.step(&incremental(rings), &before).selection;
            assert!(selection.vertices().iter().all(|&v| is_followed(&run, &before, v)));
            let expected = [true, true, rings > 1];
            let found = sameness(&selection, &run, uniform);
            assert!(found >= expected, "r {rings}, level {k}: {found:?}");
            selection = part(selection, k - 1);
        }
    }
}

/// Whether a vertex is of a selection, or made of vertices of it alone.
fn is_followed(run: &Run, before: &Selection, v: VertexId) -> bool {
    before.contains(v)
        || run.history.parents(v).is_some_and(|lineage| lineage.vertices().all(|parent| before.contains(parent)))
}

fn nested_selections_are_exact<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    let patch = picks.patch(&mesh);
    let uniform = uniform_runs(&mesh, Blocks::Maximum, STEPS);
    assert_rings(&mesh, &patch, &uniform, |selection, k| picks.part(&selection, k));
    // Without a ring neither is so: the test can fail.
    let (mut run, mut selection) = (Run::new(&mesh), patch);
    let mut found = [true; 3];
    for uniform in &uniform[1..] {
        selection = run.step(&simple(), &selection).selection;
        let same = sameness(&selection, &run, uniform);
        found = [0, 1, 2].map(|k| found[k] && same[k]);
    }
    assert_eq!(found, [false; 3]);
}

#[test]
fn incremental_refinement_of_random_meshes_is_exact() {
    check(83, 12, nested_selections_are_exact::<Closed> as fn(Closed, Picks));
    check(84, 12, nested_selections_are_exact::<WithBoundary> as fn(WithBoundary, Picks));
}

/// The manifold meshes of the folder.
fn models() -> Vec<(String, Mesh)> {
    common::meshes().map_or_else(Vec::new, |folder| plain::models(&folder))
}

fn disk(mesh: &Mesh, center: VertexId, radius: usize) -> Selection {
    r_disk(mesh.rotation(), [center], radius, &mut Scratch::new()).vertices().iter().copied().collect()
}

#[test]
fn models_stay_conforming() {
    for (name, mesh) in models() {
        let mut random = Random::new(85);
        for method in [uniform(), simple(), incremental(1)] {
            let mut run = Run::new(&mesh);
            let mut selection = random_part(&mesh, &mut random);
            for step in 1..=STEPS {
                selection = run.step(&method, &selection).selection;
                if selection.len() < 3 {
                    selection = random_part(&run.mesh, &mut random);
                }
                let what = format!("{name}, {method:?}, step {step}");
                assert_eq!(run.mesh.rotation().validate_triangles(), [], "{what}");
                let report = mesh_conformity(&run.mesh, None);
                assert!(report.is_conforming(), "{what}: {:?}", report.findings.first());
            }
        }
    }
}

#[test]
fn incremental_refinement_of_models_is_exact() {
    for (_, mesh) in models().into_iter().filter(|(_, mesh)| (100..2000).contains(&mesh.face_count())) {
        let uniform = uniform_runs(&mesh, Blocks::Maximum, STEPS);
        let patch = disk(&mesh, VertexId::new(mesh.vertex_count() / 2), 2);
        assert_rings(&mesh, &patch, &uniform, |selection, _| selection);
    }
}

#[test]
fn triangles_double_and_two_steps_make_four_of_one() {
    for mesh in [shapes::icosahedron(), shapes::torus(7, 5, 2.0, 1.0), shapes::grid(5, 4), shapes::tetrahedron()] {
        let runs = uniform_runs(&mesh, Blocks::Maximum, STEPS);
        for (k, run) in runs.iter().enumerate() {
            assert_eq!(run.mesh.face_count(), mesh.face_count() << k);
            let boundary = |mesh: &Mesh| mesh.rotation().boundary_edge_count();
            if k % 2 == 0 {
                assert_eq!(boundary(&run.mesh), boundary(&mesh) << (k / 2));
            }
            assert_eq!(run.mesh.rotation().euler_characteristic(), mesh.rotation().euler_characteristic());
            assert_eq!(run.history.unmatched_faces(), (k > 0).then_some(0));
            // From generation 1 on, four exterior edges or three, or as many as there are refinement edges.
            let greatest = run.mesh.vertices().map(|v| run.mesh.ring(v).valence()).max().unwrap();
            assert!(run.history.max_valence() >= greatest, "step {k}");
        }
    }
}

/// Faces by the least corner of the newest level, and the positions, as lists of triangles would make them.
struct Plain {
    /// Refinement edge first, counter-clockwise.
    faces: Vec<[usize; 3]>,
    positions: Vec<DVec3>,
    steps: usize,
}

impl Plain {
    /// With the blocks that a first step of the library has shown.
    fn new(mesh: &Mesh, first: &Run) -> Self {
        let made = |v: VertexId| first.history.parents(v);
        let mut edges = BTreeSet::new();
        let mut whole = BTreeSet::new();
        for v in first.mesh.vertices() {
            match made(v) {
                Some(Lineage::Edge([p, q])) => drop(edges.insert((p.min(q), p.max(q)))),
                Some(Lineage::Face(corners)) => drop(whole.insert(BTreeSet::from(corners))),
                _ => {}
            }
        }
        assert!(whole.is_empty(), "every face has a partner");
        let faces = mesh.triangles().map(|triangle| {
            let [a, b, c] = triangle.corners();
            let turns = [[a, b, c], [b, c, a], [c, a, b]];
            let [found] = turns
                .into_iter()
                .filter(|[p, q, _]| edges.contains(&(*p.min(q), *p.max(q))))
                .collect::<Vec<_>>()
                .try_into()
                .expect("one refinement edge");
            found.map(VertexId::index)
        });
        Self { faces: faces.collect(), positions: mesh.positions().to_vec(), steps: 0 }
    }

    fn step(&mut self) {
        self.steps += 1;
        let old = &self.positions;
        let mut opposite: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
        let mut all: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for &[a, b, c] in &self.faces {
            opposite.entry((a.min(b), a.max(b))).or_default().push(c);
            for (v, w) in [(a, b), (b, c), (c, a)] {
                *all.entry((v.min(w), v.max(w))).or_default() += 1;
            }
        }
        let mut exterior: Vec<Vec<DVec3>> = vec![Vec::new(); old.len()];
        let mut rim: Vec<Vec<usize>> = vec![Vec::new(); old.len()];
        for (&(v, w), &count) in &all {
            if !opposite.contains_key(&(v, w)) {
                exterior[v].push(old[w]);
                exterior[w].push(old[v]);
            }
            if count == 1 {
                rim[v].push(w);
                rim[w].push(v);
            }
        }
        let mut made = BTreeMap::new();
        let mut new = old.clone();
        for (&(a, b), corners) in &opposite {
            made.insert((a, b), new.len());
            new.push(match corners[..] {
                [c, d] => (old[a] + old[b] + old[c] + old[d]) / 4.0,
                _ => (old[a] + old[b]) / 2.0,
            });
        }
        for v in 0..old.len() {
            match rim[v][..] {
                [] => {
                    let mean = exterior[v].iter().sum::<DVec3>() / exterior[v].len() as f64;
                    new[v] = (old[v] + mean) / 2.0;
                }
                [a, b] => {
                    // Where the boundary edge was split in the step before, its end was as far again behind the middle.
                    let is_split = |w: usize| opposite.contains_key(&(v.min(w), v.max(w)));
                    let end = |w: usize| if is_split(w) { old[w] } else { 2.0 * old[w] - old[v] };
                    let moves = match (is_split(a), is_split(b)) {
                        (true, true) => true,
                        (false, false) => false,
                        _ => self.steps % 2 == 0,
                    };
                    if moves {
                        new[v] = 0.75 * old[v] + 0.125 * (end(a) + end(b));
                    }
                }
                _ => unreachable!("a vertex has two boundary edges"),
            }
        }
        let halves = self.faces.iter().flat_map(|&[a, b, c]| {
            let m = made[&(a.min(b), a.max(b))];
            [[c, a, m], [b, c, m]]
        });
        self.faces = halves.collect();
        self.positions = new;
    }
}

/// A face with a corner at each of these places, whatever its order.
fn cloud(positions: &[DVec3], faces: impl Iterator<Item = [usize; 3]>) -> Vec<[[i64; 3]; 3]> {
    let place = |v: usize| positions[v].to_array().map(|x| (x * 1e7).round() as i64);
    let mut faces: Vec<_> = faces
        .map(|corners| {
            let mut corners = corners.map(place);
            corners.sort_unstable();
            corners
        })
        .collect();
    faces.sort_unstable();
    faces
}

fn as_lists_of_triangles<S: Surface>(surface: S) {
    let mesh = surface.mesh();
    let runs = uniform_runs(&mesh, Blocks::Maximum, 4);
    // On a closed mesh it is so by a theorem; here some face beside a boundary can always be spared.
    assert_eq!(runs[1].history.unmatched_faces(), Some(0));
    let mut plain = Plain::new(&mesh, &runs[1]);
    for run in &runs[1..] {
        plain.step();
        let faces = run.mesh.triangles().map(|triangle| triangle.corners().map(VertexId::index));
        assert_eq!(cloud(run.mesh.positions(), faces), cloud(&plain.positions, plain.faces.iter().copied()));
    }
}

#[test]
fn uniform_steps_equal_those_of_lists_of_triangles() {
    check(86, 30, as_lists_of_triangles::<Closed> as fn(Closed));
    check(87, 30, as_lists_of_triangles::<WithBoundary> as fn(WithBoundary));
}

/// Two steps refine the boundary as one step of Loop does, whatever the blocks.
fn boundary_is_a_cubic_spline(surface: WithBoundary) {
    // Without the corners that Loop would keep.
    let tagged = surface.mesh();
    let triangles: Vec<_> = tagged.triangles().map(|triangle| triangle.corners().map(|v| v.index() as u32)).collect();
    let mesh = Mesh::from_triangles(tagged.positions().to_vec(), &triangles).unwrap();
    for blocks in [Blocks::Maximum, Blocks::LongestEdge] {
        let (mut run, mut loops) = (Run::new(&mesh), Run::new(&mesh));
        for _ in 0..3 {
            run.step(&methods(blocks)[0], &Selection::empty());
            run.step(&methods(blocks)[0], &Selection::empty());
            loops.step(&Subdivider::new(Loop::default(), Uniform), &Selection::empty());
        }
        // Input vertices stay first, and between two of them seven are made.
        for start in mesh.vertices().filter(|&v| mesh.is_boundary(v)) {
            let (mut v, mut w) = (start, start);
            for _ in 0..8 {
                let distance = run.mesh.position(v).distance(loops.mesh.position(w));
                assert!(distance < 1e-12, "{distance} at {v}");
                (v, w) =
                    (*run.mesh.ring(v).neighbors().last().unwrap(), *loops.mesh.ring(w).neighbors().last().unwrap());
            }
            assert_eq!(v, *mesh.ring(start).neighbors().last().unwrap());
        }
    }
}

#[test]
fn the_boundary_is_that_of_loop() {
    check(88, 30, boundary_is_a_cubic_spline as fn(WithBoundary));
}

#[test]
fn regular_masks_reproduce_polynomials_of_degree_three() {
    // On the grid the diagonals are the longest edges, and stay it below so small heights.
    const FLAT: f64 = 1e-6;
    let mut mesh = shapes::grid(12, 12);
    let values = [
        |x: f64, y: f64| x + 2.0 * y,
        |x: f64, y: f64| x * y,
        |x: f64, y: f64| x * x - y * y,
        // A step adds as much to the one cube as to the other product.
        |x: f64, y: f64| x * x * x - 3.0 * x * y * y,
    ];
    for value in values {
        for v in mesh.vertices() {
            let p = &mut mesh.positions_mut()[v.index()];
            p.z = FLAT * value(p.x, p.y);
        }
        let runs = uniform_runs(&mesh, Blocks::Maximum, 2);
        for run in &runs[1..] {
            let inner = run.mesh.positions().iter().filter(|p| (p.x - 6.0).abs() < 2.1 && (p.y - 6.0).abs() < 2.1);
            assert!(inner.clone().count() > 20);
            for p in inner {
                assert!((p.z / FLAT - value(p.x, p.y)).abs() < 1e-9, "{p}");
            }
        }
        for v in mesh.vertices() {
            mesh.positions_mut()[v.index()].z = 0.0;
        }
    }
}

#[test]
fn a_step_that_is_not_made_leaves_everything() {
    for mesh in [shapes::grid(6, 6), shapes::icosahedron()] {
        let mut run = Run::new(&mesh);
        run.step(&simple(), &disk(&mesh, VertexId::new(3), 1));
        let before = run.clone();
        let all = disk(&run.mesh, VertexId::new(0), 9);
        let mut stop = |progress: Progress| match progress.done {
            0 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        };
        let mut stop_at_once = |_: Progress| ControlFlow::Break(());
        let faces = run.mesh.face_count() as u64;
        let mut many = Run::new(&shapes::grid(40, 40));
        let untouched = many.clone();
        let cancelled =
            step(&mut many, &uniform(), &all, &mut Control { progress: Some(&mut stop), ..Control::default() });
        assert_eq!(cancelled, Err(RefineError::Cancelled));
        assert_eq!((many.bits(), many.history.split_kind()), (untouched.bits(), None));
        let cancelled =
            step(&mut run, &simple(), &all, &mut Control { progress: Some(&mut stop_at_once), ..Control::default() });
        assert_eq!(cancelled, Err(RefineError::Cancelled));
        let limited = step(&mut run, &uniform(), &all, &mut Control { max_faces: Some(faces), ..Control::default() });
        assert!(matches!(limited, Err(RefineError::TooManyFaces { allowed, .. }) if allowed == faces));
        assert_eq!(run.bits(), before.bits());
        // And the history too: what follows is the same.
        let mut again = before.clone();
        run.step(&uniform(), &all);
        again.step(&uniform(), &all);
        assert_eq!(run.bits(), again.bits());
        let other = step(&mut run, &Subdivider::new(Loop::default(), Uniform), &all, &mut Control::default());
        assert!(matches!(other, Err(RefineError::OtherSplit { .. })));
    }
}

fn step(
    run: &mut Run,
    subdivider: &Subdivider,
    selection: &Selection,
    control: &mut Control<'_>,
) -> Result<(), RefineError> {
    let Run { mesh, history } = run;
    subdivider.step(mesh, history, selection, &mut Scratch::new(), control).map(|_| ())
}

#[test]
fn what_goes_along_has_to_be_there_when_generations_meet() {
    for mesh in [shapes::grid(6, 6), shapes::icosahedron()] {
        let mut run = Run::new(&mesh);
        let all = Selection::empty();
        run.step(&uniform(), &all);
        // All triangles have one generation, so one may still join.
        let mut early = Values::new(run.mesh.positions().to_vec());
        for _ in 0..3 {
            let control = &mut Control { follower: Some(&mut early), ..Control::default() };
            let part = disk(&run.mesh, VertexId::new(3), 1);
            step(&mut run, &simple(), &part, control).unwrap();
        }
        let (before, mut late) = (run.bits(), Values::new(run.mesh.positions().to_vec()));
        let result = step(&mut run, &uniform(), &all, &mut Control { follower: Some(&mut late), ..Control::default() });
        assert_eq!((result, run.bits() == before), (Err(RefineError::JoinedLate), true));
        assert_eq!(late.shown().len(), run.mesh.vertex_count());
        step(&mut run, &uniform(), &all, &mut Control { follower: Some(&mut early), ..Control::default() }).unwrap();
        assert_eq!(early.shown(), run.mesh.positions());
    }
}
