//! One step against a model, and what holds for any number of steps: counts, numbering, invariance, all or nothing.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use common::random::{Closed, Picks, Random, Surface, WithBoundary, check, triangles};
use common::run::{Run, bits, renamed, schemes};
use common::step_model::StepModel;
use vvmesh::adaptive::{AdaptiveMethod, Incremental, Simple, Uniform};
use vvmesh::error::RefineError;
use vvmesh::glam::{DAffine3, DVec3};
use vvmesh::query::r_disk;
use vvmesh::scheme::{AnyScheme, FourEight, Loop, Midpoint, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::split::Diagonal;
use vvmesh::step::{History, Keep, Region};
use vvmesh::subdivide::{Control, Progress, Step, Subdivider};
use vvmesh::{Edge, Mesh, Triangle, VertexId, shapes};

const DIAGONALS: [Diagonal; 4] = [Diagonal::Valence, Diagonal::Longest, Diagonal::Shortest, Diagonal::ById];

/// Splits these edges, whatever is selected.
#[derive(Debug)]
struct Edges(Vec<Edge>);

impl AdaptiveMethod for Edges {
    fn region(&self, _mesh: &Mesh, _selection: &Selection, _scratch: &mut Scratch) -> Region {
        Region::edges(self.0.iter().copied())
    }

    fn promises_exactness(&self) -> bool {
        false
    }
}

fn select(indices: impl IntoIterator<Item = usize>) -> Selection {
    indices.into_iter().map(VertexId::new).collect()
}

fn one_step(run: &mut Run, subdivider: &Subdivider, selection: &Selection) -> Result<(), RefineError> {
    let Run { mesh, history } = run;
    subdivider.step(mesh, history, selection, &mut Scratch::new(), &mut Control::default()).map(|_| ())
}

/// Steps with edges chosen anew and at random, so that all mixes of split edges in a face come up, against the model.
fn steps_follow_the_model<S: Surface>(surface: S, seed: u32) {
    let mut random = Random::new(u64::from(seed));
    let mut run = Run::new(&surface.mesh());
    let mut starts = vec![run.mesh.vertex_count()];
    for _ in 0..3 {
        let share = random.below(5);
        let edges: Vec<Edge> = run.mesh.edges().filter(|_| random.below(4) < share).collect();
        let diagonal = DIAGONALS[random.below(4)];
        let chosen: BTreeSet<Edge> = edges.iter().copied().collect();
        let model = StepModel::new(&run.mesh, |edge| chosen.contains(&edge));
        let (_, scheme) = schemes()[random.below(5)].clone();
        let subdivider = Subdivider::new(scheme, Edges(edges)).with_diagonal(diagonal);
        let step = run.step(&subdivider, &Selection::empty());
        assert_eq!(step.split_edges, chosen.len());
        model.assert_made(&run, diagonal, |v| starts.partition_point(|&start| start <= v.index()));
        let greatest = run.mesh.vertices().map(|v| run.mesh.ring(v).valence()).max().unwrap();
        assert_eq!(run.history.max_valence(), greatest);
        starts.push(run.mesh.vertex_count());
    }
}

#[test]
fn steps_on_any_edges_follow_the_model() {
    check(31, 60, steps_follow_the_model::<Closed> as fn(Closed, u32));
    check(32, 60, steps_follow_the_model::<WithBoundary> as fn(WithBoundary, u32));
}

/// Regions of vertices split the edges between two of them, and no face gets two.
fn regions_follow_the_model<S: Surface>(surface: S, picks: Picks) {
    let mut run = Run::new(&surface.mesh());
    let mut starts = vec![run.mesh.vertex_count()];
    let mut selection = picks.patch(&run.mesh);
    for level in 0..3 {
        let model = StepModel::new(&run.mesh, |edge| edge.ends().iter().all(|&end| selection.contains(end)));
        assert_eq!(model.face_counts()[2], 0);
        let step = run.step(&Subdivider::new(Midpoint, Simple), &selection);
        assert_eq!((step.selected, step.region), (selection.len(), selection.len()));
        model.assert_made(&run, Diagonal::default(), |v| starts.partition_point(|&start| start <= v.index()));
        starts.push(run.mesh.vertex_count());
        selection = picks.part(&step.selection, level);
    }
}

#[test]
fn steps_on_selected_vertices_follow_the_model() {
    check(33, 40, regions_follow_the_model::<Closed> as fn(Closed, Picks));
    check(34, 40, regions_follow_the_model::<WithBoundary> as fn(WithBoundary, Picks));
}

/// V + E, 2E + 3F, 4F; the Euler characteristic, the boundary edges' doubling, and the valences of even vertices.
fn uniform_counts<S: Surface>(surface: S, scheme: u8) {
    let mesh = surface.mesh();
    let (_, scheme) = schemes()[usize::from(scheme) % 5].clone();
    let mut run = Run::new(&mesh);
    for _ in 0..3 {
        let before = run.mesh.clone();
        let model = StepModel::new(&before, |_| true);
        run.step(&Subdivider::new(scheme.clone(), Uniform), &Selection::empty());
        let counts = |mesh: &Mesh| [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()];
        let [v, e, f] = counts(&before);
        assert_eq!(counts(&run.mesh), [v + e, 2 * e + 3 * f, 4 * f]);
        assert_eq!(run.mesh.rotation().boundary_edge_count(), 2 * before.rotation().boundary_edge_count());
        assert_eq!(run.mesh.triangles().collect::<BTreeSet<_>>(), model.faces(&run.mesh, Diagonal::default()));
        for v in before.vertices() {
            assert_eq!(run.mesh.ring(v).valence(), before.ring(v).valence());
        }
        for v in run.mesh.vertices().skip(before.vertex_count()) {
            assert_eq!(run.mesh.ring(v).valence(), if run.mesh.is_boundary(v) { 4 } else { 6 });
        }
    }
}

#[test]
fn uniform_steps_have_their_counts() {
    check(35, 15, uniform_counts::<Closed> as fn(Closed, u8));
    check(36, 15, uniform_counts::<WithBoundary> as fn(WithBoundary, u8));
}

/// The random meshes are what they are said to be: else what is shown with them would say little.
#[test]
fn random_meshes_are_varied() {
    use quickcheck::{Arbitrary, Gen};
    let mut g = Gen::from_size_and_seed(40, 37);
    let (mut genera, mut loops, mut valences) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
    let (mut darts, mut creases, mut isolated) = (0, 0, 0);
    for k in 0..200 {
        let mesh = if k % 2 == 0 { Closed::arbitrary(&mut g).mesh() } else { WithBoundary::arbitrary(&mut g).mesh() };
        let census = mesh.to_face_list().census();
        assert!((40..500).contains(&census.faces), "{} faces", census.faces);
        assert_eq!(k % 2 == 0, (census.boundary_loops == 0));
        genera.extend(census.genus);
        loops.insert(census.boundary_loops);
        isolated += census.isolated_vertices;
        for v in mesh.vertices() {
            valences.insert(mesh.ring(v).valence());
            match mesh.tags().sharp_neighbors(v).len() {
                1 => darts += 1,
                2 => creases += 1,
                _ => {}
            }
        }
    }
    assert!([0, 1, 2, 3].iter().all(|genus| genera.contains(genus)), "{genera:?}");
    assert!((0..=4).all(|count| loops.contains(&count)), "{loops:?}");
    assert!((2..=12).all(|n| valences.contains(&n)) && valences.last() == Some(&12), "{valences:?}");
    assert!(darts > 20 && creases > 20 && isolated > 20);
}

/// Two calls of one step, with a history that was put away and a mesh that was copied between, are one run of two.
#[test]
fn a_step_depends_on_mesh_and_history_alone() {
    for (_, scheme) in schemes() {
        let subdivider = Subdivider::new(scheme.clone(), Incremental::new(1).unwrap());
        let mut run = Run::new(&shapes::torus(9, 6, 2.0, 1.0));
        let mut scratch = Scratch::new();
        let mut selection = select([0, 1, 2, 6, 7, 8]);
        let mut copied = run.clone();
        for _ in 0..3 {
            let Run { mesh, history } = &mut run;
            let step = subdivider.step(mesh, history, &selection, &mut scratch, &mut Control::default()).unwrap();
            copied = copied.clone();
            let again = Subdivider::new(scheme.clone(), Incremental::new(1).unwrap());
            assert_eq!(copied.step(&again, &selection), step);
            assert_eq!(copied.bits(), run.bits());
            selection = step.selection;
        }
    }
}

/// Steps that fail leave every bit of mesh and history.
fn assert_unchanged(run: &mut Run, expected: &RefineError, step: impl FnOnce(&mut Run) -> Result<(), RefineError>) {
    let before = run.clone();
    assert_eq!(step(run).as_ref(), Err(expected));
    assert_eq!(run.bits(), before.bits());
    assert_eq!(format!("{:?}", run.history), format!("{:?}", before.history));
}

#[test]
fn a_selection_of_nothing_known_is_refused() {
    let mut run = Run::new(&shapes::grid(3, 3));
    for method in [Subdivider::new(Midpoint, Uniform), Subdivider::new(Midpoint, Simple)] {
        let selection = select([3, 16]);
        assert_unchanged(&mut run, &RefineError::NoVertex(VertexId::new(16)), |run| one_step(run, &method, &selection));
    }
}

#[test]
fn a_limit_of_faces_is_exact() {
    for subdivider in [Subdivider::new(Loop::default(), Uniform), Subdivider::new(Loop::default(), Simple)] {
        let mut run = Run::new(&shapes::grid(4, 4));
        let selection = select(0..12);
        let mut after = run.clone();
        after.step(&subdivider, &selection);
        let needed = after.mesh.face_count() as u64;
        let with_limit = |allowed: u64| {
            let (subdivider, selection) = (&subdivider, &selection);
            move |run: &mut Run| {
                let mut control = Control { max_faces: Some(allowed), ..Control::default() };
                let Run { mesh, history } = run;
                subdivider.step(mesh, history, selection, &mut Scratch::new(), &mut control).map(|_| ())
            }
        };
        let refused = RefineError::TooManyFaces { needed, allowed: needed - 1 };
        assert_unchanged(&mut run, &refused, with_limit(needed - 1));
        assert_eq!(with_limit(needed)(&mut run), Ok(()));
        assert_eq!(run.bits(), after.bits());
    }
}

#[test]
fn a_step_can_be_stopped_whenever_it_asks() {
    let subdivider = Subdivider::new(Loop::default(), Uniform);
    let mut run = Run::new(&shapes::torus(40, 30, 2.0, 1.0));
    let stop_at = |call: usize, seen: &mut Vec<Progress>, run: &mut Run| {
        let mut report = |progress| {
            seen.push(progress);
            if seen.len() > call { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let mut control = Control { progress: Some(&mut report), ..Control::default() };
        let Run { mesh, history } = run;
        subdivider.step(mesh, history, &Selection::empty(), &mut Scratch::new(), &mut control).map(|_| ())
    };
    let mut seen = Vec::new();
    let mut after = run.clone();
    stop_at(usize::MAX, &mut seen, &mut after).unwrap();
    let total = 1200 + 3600;
    assert!(seen.iter().all(|progress| progress.total == total && progress.done < total));
    assert!(seen.is_sorted_by(|one, next| one.done < next.done && next.done <= one.done + 1024));
    assert!(seen.len() >= 5);
    for call in [0, seen.len() / 2, seen.len() - 1] {
        assert_unchanged(&mut run, &RefineError::Cancelled, |run| stop_at(call, &mut Vec::new(), run));
    }
    run.step(&subdivider, &Selection::empty());
    assert_eq!(run.bits(), after.bits());
}

/// Without names the whole mesh is refined at once, and there are as many blocks as there is work to share: two of old
/// vertices, and of new ones those that belong to them; under 4-8 none belongs to the younger half.
#[test]
fn a_step_of_a_whole_mesh_can_be_stopped_whenever_it_asks() {
    let torus = |around| shapes::torus(300, around, 2.0, 1.0);
    let cases: [(AnyScheme, Mesh, usize, usize, usize); 4] = [
        (Loop::default().into(), torus(250), 0, 4, 300_000),
        (Midpoint.into(), torus(250), 0, 2, 225_000),
        (Sqrt3::default().into(), torus(250), 0, 4, 225_000),
        (FourEight::default().into(), torus(125), 1, 3, 150_000),
    ];
    for (scheme, mesh, steps_before, asked, total) in cases {
        let subdivider = Subdivider::new(scheme, Uniform);
        let mut run = Run { history: History::new(&mesh, Keep::default()), mesh };
        for _ in 0..steps_before {
            run.step(&subdivider, &Selection::empty());
        }
        for stop_at in 0..asked {
            let mut seen: Vec<Progress> = Vec::new();
            let mut report = |progress| {
                seen.push(progress);
                if seen.len() > stop_at { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            };
            assert_unchanged(&mut run, &RefineError::Cancelled, |Run { mesh, history }| {
                let mut control = Control { progress: Some(&mut report), ..Control::default() };
                subdivider.step(mesh, history, &Selection::empty(), &mut Scratch::new(), &mut control).map(|_| ())
            });
            assert_eq!(seen.len(), stop_at + 1);
            assert_eq!(seen[0], Progress { done: 0, total });
            assert!(seen.is_sorted_by(|one, next| one.done < next.done && next.done < total));
        }
        let mut count = 0;
        let mut report = |_| {
            count += 1;
            ControlFlow::Continue(())
        };
        let mut control = Control { progress: Some(&mut report), ..Control::default() };
        let Run { mesh, history } = &mut run;
        subdivider.step(mesh, history, &Selection::empty(), &mut Scratch::new(), &mut control).unwrap();
        assert_eq!(count, asked);
    }
}

/// Two vertices near the end are too far out, so most positions are computed and taken back.
#[test]
fn a_sum_that_overflows_is_refused() {
    for (name, scheme) in schemes() {
        let mut mesh = shapes::torus(40, 30, 2.0, 1.0);
        mesh.positions_mut()[1198..].fill(DVec3::splat(f64::MAX));
        let [uniform, simple] = [Subdivider::new(scheme.clone(), Uniform), Subdivider::new(scheme, Simple)];
        for (subdivider, names) in [(&uniform, true), (&uniform, false), (&simple, true)] {
            let history = History::new(&mesh, Keep { names, certificate: false });
            let mut run = Run { mesh: mesh.clone(), history };
            let refused = RefineError::NonFinite(VertexId::new(1198));
            assert_unchanged(&mut run, &refused, |run| one_step(run, subdivider, &Selection::all(1200)));
            run.mesh.positions_mut()[1198..].fill(DVec3::ONE);
            assert_eq!(one_step(&mut run, subdivider, &Selection::all(1200)), Ok(()), "{name}");
        }
    }
}

/// The edge at one vertex is halved again and again.
#[test]
fn the_256th_level_is_refused() {
    let mut run = Run::new(&shapes::icosahedron());
    let subdivider = Subdivider::new(Midpoint, Simple);
    let a = VertexId::new(0);
    let mut near = run.mesh.ring(a).iter().next().unwrap();
    for level in 1..=255 {
        let step = run.step(&subdivider, &[a, near].into_iter().collect());
        near = VertexId::new(run.mesh.vertex_count() - 1);
        assert_eq!((step.split_edges, run.history.level(near)), (1, Some(level)));
    }
    let selection = [a, near].into_iter().collect();
    assert_unchanged(&mut run, &RefineError::TooDeep, |run| one_step(run, &subdivider, &selection));
    assert_eq!(run.mesh.rotation().validate_triangles(), []);
}

/// Other ids for the input give the same surface. Sums are taken in another order, so up to rounding: some 30 terms of
/// size 3, so 1e-13 is ten times what can come up.
fn relabelling(surface: WithBoundary, picks: Picks, seed: u32) {
    let mesh = surface.mesh();
    let mut random = Random::new(u64::from(seed));
    let mut order: Vec<usize> = (0..mesh.vertex_count()).collect();
    for k in (1..order.len()).rev() {
        order.swap(k, random.below(k + 1));
    }
    let input: Vec<VertexId> = order.iter().copied().map(VertexId::new).collect();
    let mut positions = vec![DVec3::ZERO; order.len()];
    for v in mesh.vertices() {
        positions[order[v.index()]] = mesh.position(v);
    }
    let turned: Vec<[u32; 3]> = triangles(&mesh).iter().map(|t| t.map(|v| order[v as usize] as u32)).collect();
    let mut relabelled = Mesh::from_triangles(positions, &turned).unwrap();
    for edge in mesh.tags().sharp_edges() {
        let [a, b] = edge.ends().map(|v| input[v.index()]);
        relabelled.set_sharp(Edge::new(a, b), true);
    }
    for v in mesh.tags().corners() {
        relabelled.set_corner(input[v.index()], true);
    }
    let patch = picks.patch(&mesh);
    for (name, scheme) in schemes() {
        let subdivider = Subdivider::new(scheme, Incremental::new(1).unwrap());
        let (mut one, mut other) = (Run::new(&mesh), Run::new(&relabelled));
        let mut selection = [patch.clone(), patch.vertices().iter().map(|v| input[v.index()]).collect()];
        for _ in 0..3 {
            selection =
                [one.step(&subdivider, &selection[0]).selection, other.step(&subdivider, &selection[1]).selection];
            let same = renamed(&one, &other, &input);
            for v in one.mesh.vertices() {
                let distance = one.mesh.position(v).distance(other.mesh.position(same[v.index()]));
                assert!(distance < 1e-13, "{name}: {v} is {distance} away");
            }
            let named: BTreeSet<Edge> = one
                .mesh
                .edges()
                .map(|edge| {
                    let [a, b] = edge.ends().map(|v| same[v.index()]);
                    Edge::new(a, b)
                })
                .collect();
            assert_eq!(named, other.mesh.edges().collect());
            assert_eq!(selection[0].vertices().iter().map(|v| same[v.index()]).collect::<Selection>(), selection[1]);
        }
    }
}

#[test]
fn relabelled_vertices_give_the_same_surface() {
    check(38, 15, relabelling as fn(WithBoundary, Picks, u32));
}

/// Refining commutes with affine maps, up to the rounding of both.
fn affine_map(surface: WithBoundary, picks: Picks, seed: u32) {
    let mut random = Random::new(u64::from(seed));
    let map = DAffine3::from_cols(random.vector(), random.vector(), random.vector(), random.vector());
    let mesh = surface.mesh();
    let mut mapped = mesh.clone();
    for position in mapped.positions_mut() {
        *position = map.transform_point3(*position);
    }
    let patch = picks.patch(&mesh);
    for (name, scheme) in schemes() {
        let subdivider = Subdivider::new(scheme, Incremental::new(2).unwrap());
        let (mut one, mut other) = (Run::new(&mesh), Run::new(&mapped));
        let mut selection = patch.clone();
        for _ in 0..3 {
            other.step(&subdivider, &selection);
            selection = one.step(&subdivider, &selection).selection;
        }
        for v in one.mesh.vertices() {
            let distance = map.transform_point3(one.mesh.position(v)).distance(other.mesh.position(v));
            assert!(distance < 1e-12, "{name}: {v} is {distance} away");
        }
    }
}

#[test]
fn affine_maps_commute_with_refinement() {
    check(39, 15, affine_map as fn(WithBoundary, Picks, u32));
}

/// A closed fan of `n` triangles around vertex 0, and its mirror image below: two hubs of valence `n`.
fn spindle(n: usize) -> Mesh {
    let turn = |k: usize| (k as f64 / n as f64 * std::f64::consts::TAU).sin_cos();
    let rim = (0..n).map(|k| DVec3::new(turn(k).1, turn(k).0, 0.0));
    let positions = [DVec3::Z, -DVec3::Z].into_iter().chain(rim).collect();
    let at = |k: usize| (2 + k % n) as u32;
    let triangles: Vec<[u32; 3]> = (0..n).flat_map(|k| [[0, at(k), at(k + 1)], [1, at(k + 1), at(k)]]).collect();
    Mesh::from_triangles(positions, &triangles).unwrap()
}

/// Simple for 0 rings, else incremental.
fn with_rings(scheme: impl Into<AnyScheme>, rings: usize) -> Subdivider {
    match Incremental::new(rings) {
        Ok(method) => Subdivider::new(scheme, method),
        Err(_) => Subdivider::new(scheme, Simple),
    }
}

/// One step against the model, on the vertices within some rings.
fn assert_step_follows_the_model(mesh: &Mesh, scheme: AnyScheme, rings: usize, selection: &Selection) -> Run {
    let seeds = selection.vertices().iter().copied();
    let region: Selection =
        r_disk(mesh.rotation(), seeds, rings, &mut Scratch::new()).into_vertices().into_iter().collect();
    let model = StepModel::new(mesh, |edge| edge.ends().iter().all(|&end| region.contains(end)));
    let mut run = Run::new(mesh);
    let step = run.step(&with_rings(scheme, rings), selection);
    assert_eq!(step.region, region.len());
    model.assert_made(&run, Diagonal::default(), |v| usize::from(v.index() >= mesh.vertex_count()));
    run
}

/// Hubs inside the region, half inside, and beside it as O-vertices of all their faces.
#[test]
fn hubs_are_refined_and_closed() {
    for n in [3, 40, 5000] {
        let mesh = spindle(n);
        for selection in
            [Selection::all(n + 2), select(2..n + 2), select(0..2 + n / 2), select([0]), Selection::empty()]
        {
            for rings in 0..=1 {
                let run = assert_step_follows_the_model(&mesh, Loop::default().into(), rings, &selection);
                if rings == 0 && selection == select(2..n + 2) {
                    assert_eq!(run.mesh.ring(VertexId::new(0)).valence(), 2 * n);
                }
            }
        }
    }
}

/// The smallest meshes, pieces, isolated vertices; nothing selected, one vertex, all; regions larger than the mesh.
#[test]
fn small_meshes_and_pieces_follow_the_model() {
    let corners = |count: usize| (0..count).map(|k| DVec3::new(k as f64, (k * k) as f64, (k % 3) as f64)).collect();
    let lists: [&[[u32; 3]]; 6] = [
        &[],
        &[[0, 1, 2]],
        &[[0, 1, 2], [2, 1, 3]],
        &[[0, 1, 2], [3, 4, 5]],
        &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]],
        &[[5, 4, 3], [3, 4, 1], [1, 4, 2], [2, 4, 5], [0, 6, 7]],
    ];
    for list in lists {
        let used = list.as_flattened().iter().max().map_or(0, |&last| last as usize + 1);
        for isolated in [0, 2] {
            let mesh = Mesh::from_triangles(corners(used + isolated), list).unwrap();
            let count = mesh.vertex_count();
            let single = (0..count).map(|v| select([v]));
            for selection in single.chain([Selection::empty(), Selection::all(count)]) {
                for (_, scheme) in schemes() {
                    for rings in [0, 1, 2, usize::MAX] {
                        assert_step_follows_the_model(&mesh, scheme.clone(), rings, &selection);
                    }
                    let mut run = Run::new(&mesh);
                    let mut selection = selection.clone();
                    for _ in 0..3 {
                        selection = run.step(&with_rings(scheme.clone(), 1), &selection).selection;
                        assert_eq!(run.mesh.rotation().validate_triangles(), []);
                    }
                    for v in used..count {
                        assert_eq!(bits(run.mesh.position(VertexId::new(v))), bits(mesh.position(VertexId::new(v))));
                    }
                }
            }
        }
    }
}

#[test]
fn an_empty_selection_changes_nothing() {
    let mut run = Run::new(&shapes::icosahedron());
    let before = run.bits();
    let step = run.step(&with_rings(Loop::default(), 1), &Selection::empty());
    assert_eq!((step.region, step.split_edges, step.selection), (0, 0, Selection::empty()));
    assert_eq!((run.bits(), run.history.step_count()), (before, 1));
}

/// With more rings than the mesh has, the whole component is refined as by a uniform step, bit for bit.
#[test]
fn a_region_of_everything_is_uniform() {
    for (_, scheme) in schemes() {
        let (mut region, mut uniform) = (Run::new(&shapes::grid(4, 3)), Run::new(&shapes::grid(4, 3)));
        for _ in 0..3 {
            region.step(&with_rings(scheme.clone(), usize::MAX), &select([7]));
            uniform.step(&Subdivider::new(scheme.clone(), Uniform), &select([7]));
            assert_eq!(region.bits(), uniform.bits());
        }
    }
}

/// Without names and certificate a whole mesh is split without a plan: the same bits, counts and valences, and errors.
fn whole_meshes_are_split_alike<S: Surface>(surface: S, nothing: bool) {
    let base = surface.mesh();
    for (name, scheme) in schemes() {
        let uniform = Subdivider::new(scheme, Uniform);
        let (mut planned, mut whole) = (Run::new(&base), Run::new(&base));
        whole.history = History::new(&base, Keep::default());
        for _ in 0..3 {
            let count = base.vertex_count().max(planned.mesh.vertex_count());
            let selection = if nothing { Selection::empty() } else { Selection::all(count) };
            let faces = planned.mesh.face_count() as u64;
            let mut tight = Control { max_faces: Some(4 * faces - 1), ..Control::default() };
            let refused =
                uniform.step(&mut whole.mesh, &mut whole.history, &selection, &mut Scratch::new(), &mut tight);
            assert_eq!(refused, Err(RefineError::TooManyFaces { needed: 4 * faces, allowed: 4 * faces - 1 }));
            let mut stop = |_| ControlFlow::Break(());
            let mut stopped = Control { progress: Some(&mut stop), ..Control::default() };
            let refused =
                uniform.step(&mut whole.mesh, &mut whole.history, &selection, &mut Scratch::new(), &mut stopped);
            assert_eq!(refused, Err(RefineError::Cancelled));
            assert_eq!(whole.bits(), planned.bits(), "{name}");
            let expected = planned.step(&uniform, &selection);
            let step = whole.step(&uniform, &selection);
            assert_eq!(whole.bits(), planned.bits(), "{name}");
            assert_eq!(step, Step { certified: None, ..expected });
            assert_eq!(whole.history.max_valence(), planned.history.max_valence());
            let counts = |run: &Run| (run.mesh.edge_count(), run.mesh.face_count(), run.mesh.vertex_count());
            assert_eq!(counts(&whole), counts(&planned));
            assert_eq!(whole.mesh.rotation().boundary_edge_count(), planned.mesh.rotation().boundary_edge_count());
        }
    }
}

#[test]
fn a_whole_mesh_without_names_is_split_alike() {
    check(61, 6, whole_meshes_are_split_alike::<Closed> as fn(Closed, bool));
    check(62, 6, whole_meshes_are_split_alike::<WithBoundary> as fn(WithBoundary, bool));
    // With the hubs last, the edges to them stand in their rings at slots beyond what is remembered.
    let spindle = spindle(300);
    let last = spindle.vertex_count() as u32 - 1;
    let positions = spindle.positions().iter().rev().copied().collect();
    let turned = |triangle: Triangle| triangle.corners().map(|v| last - v.index() as u32);
    let spindle = Mesh::from_triangles(positions, &spindle.triangles().map(turned).collect::<Vec<_>>()).unwrap();
    let uniform = Subdivider::new(Loop::default(), Uniform);
    let (mut planned, mut whole) = (Run::new(&spindle), Run::new(&spindle));
    whole.history = History::new(&whole.mesh, Keep::default());
    for run in [&mut planned, &mut whole] {
        run.step(&uniform, &Selection::empty());
        run.step(&uniform, &Selection::empty());
    }
    assert_eq!(whole.bits(), planned.bits());
}

/// Ten levels around one vertex: each step costs the same few faces.
#[test]
fn ten_levels_around_a_vertex() {
    let mut run = Run::new(&shapes::torus(20, 20, 2.0, 1.0));
    let selection = select([77]);
    let mut growth = Vec::new();
    for _ in 0..10 {
        let before = run.mesh.face_count();
        run.step(&with_rings(Loop::default(), 2), &selection);
        growth.push(run.mesh.face_count() - before);
        assert_eq!(run.mesh.rotation().validate_triangles(), []);
    }
    assert!(growth.iter().all(|&faces| faces == growth[0]), "{growth:?}");
    assert!(run.history.max_valence() <= 12);
}

/// No weight and no choice depends on the unit of length.
#[test]
fn powers_of_two_are_carried_exactly() {
    for (_, scheme) in schemes() {
        let mesh = shapes::icosahedron();
        let mut scaled = mesh.clone();
        scaled.positions_mut().iter_mut().for_each(|position| *position *= 1024.0);
        let (mut one, mut other) = (Run::new(&mesh), Run::new(&scaled));
        for _ in 0..3 {
            one.step(&with_rings(scheme.clone(), 1), &select([0]));
            other.step(&with_rings(scheme.clone(), 1), &select([0]));
        }
        assert!(one.mesh.vertices().all(|v| bits(one.mesh.position(v) * 1024.0) == bits(other.mesh.position(v))));
    }
}

/// Whatever is kept beside a mesh, uniform steps and a step on a region after them do and prove the same.
fn what_is_kept_changes_nothing<S: Surface>(surface: S, picks: Picks, scheme: u8) {
    let mesh = surface.mesh();
    let (_, scheme) = schemes()[usize::from(scheme) % 5].clone();
    let selection = picks.patch(&mesh);
    let run = |keep: Keep| {
        let mut run = Run { mesh: mesh.clone(), history: History::new(&mesh, keep) };
        let mut selection = selection.clone();
        let mut steps = Vec::new();
        for method in [Subdivider::new(scheme.clone(), Uniform), with_rings(scheme.clone(), 1)] {
            for _ in 0..2 {
                let step = run.step(&method, &selection);
                selection = step.selection.clone();
                steps.push(step);
            }
        }
        (run.bits(), run.history.max_valence(), steps)
    };
    let all = run(Keep { names: true, certificate: true });
    assert_eq!(run(Keep { names: false, certificate: true }), all);
    let (bits, max_valence, mut steps) = all;
    steps.iter_mut().for_each(|step| step.certified = None);
    assert_eq!(run(Keep { names: true, certificate: false }), (bits, max_valence, steps));
}

#[test]
fn what_a_history_keeps_changes_nothing() {
    check(47, 30, what_is_kept_changes_nothing::<Closed> as fn(Closed, Picks, u8));
    check(48, 30, what_is_kept_changes_nothing::<WithBoundary> as fn(WithBoundary, Picks, u8));
}
