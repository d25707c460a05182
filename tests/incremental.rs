//! Incremental subdivision equals uniform subdivision on the selection, bit for bit; without rings it does not.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use common::load::load;
use common::random::{Closed, Picks, Surface, WithBoundary, check};
use common::run::{Beside, Run, schemes};
use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::query::r_disk;
use vvmesh::scheme::{AnyScheme, Midpoint};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::subdivide::{Step, Subdivider};
use vvmesh::{Mesh, VertexId};

/// How many steps are compared.
const LEVELS: usize = 4;

/// The uniform run before the first step and after each.
fn uniform_levels(scheme: &AnyScheme, mesh: &Mesh) -> Vec<Run> {
    let subdivider = Subdivider::new(scheme.clone(), Uniform);
    let mut levels = vec![Run::new(mesh)];
    for k in 0..LEVELS {
        let mut next = levels[k].clone();
        next.step(&subdivider, &Selection::empty());
        levels.push(next);
    }
    levels
}

fn incremental(scheme: &AnyScheme, rings: usize) -> Subdivider {
    Subdivider::new(scheme.clone(), Incremental::new(rings).unwrap())
}

/// Asserts that S' is S with every new vertex whose parents are both in S.
fn assert_follows(selection: &Selection, run: &Run, step: &Step) {
    let first = run.mesh.vertex_count() - step.split_edges;
    let expected: Selection = run
        .mesh
        .vertices()
        .filter(|&v| {
            let new = v.index() >= first;
            let parents = run.history.parents(v).filter(|_| new);
            parents.map_or(selection.contains(v), |parents| parents.vertices().all(|end| selection.contains(end)))
        })
        .collect();
    assert_eq!(step.selection, expected);
}

fn assert_exact(selection: &Selection, beside: &Beside<'_>, what: &str) {
    for &v in selection.vertices() {
        assert!(beside.rotation_is_same(v), "{what}: other neighbours at {v}");
        assert!(beside.star_is_same(v), "{what}: another position at or beside {v}");
    }
}

/// How the simple method differs after a step: has any selected vertex other neighbours, and another position?
fn differences(selection: &Selection, beside: &Beside<'_>) -> [bool; 2] {
    let any = |same: &dyn Fn(VertexId) -> bool| selection.vertices().iter().any(|&v| !same(v));
    [any(&|v| beside.rotation_is_same(v)), any(&|v| beside.position_is_same(v))]
}

/// Asserts that the test can fail: without a ring the rotation differs from level 1 on, the position from level 2 on.
fn assert_simple_differs(scheme: &AnyScheme, mesh: &Mesh, patch: &Selection, uniform: &[Run], name: &str) {
    let subdivider = Subdivider::new(scheme.clone(), Simple);
    let (mut run, mut selection) = (Run::new(mesh), patch.clone());
    for (k, uniform) in uniform.iter().enumerate().skip(1) {
        selection = run.step(&subdivider, &selection).selection;
        let found = differences(&selection, &Beside::new(&run, uniform));
        assert_eq!(found, [true, k > 1 && !matches!(scheme, AnyScheme::Midpoint(_))], "simple {name}, level {k}");
    }
}

/// For nested selections, r = 1, 2, 3 and k = 1, 2, 3, 4; the scheme is one of [`schemes`].
fn exact<S: Surface, const SCHEME: usize>(surface: S, picks: Picks) {
    let (name, scheme) = schemes()[SCHEME].clone();
    let mesh = surface.mesh();
    let patch = picks.patch(&mesh);
    assert!(patch.len() >= Picks::LEAST && patch.len() < mesh.vertex_count());
    let uniform = uniform_levels(&scheme, &mesh);
    for rings in 1..=3 {
        let subdivider = incremental(&scheme, rings);
        let (mut run, mut selection) = (Run::new(&mesh), patch.clone());
        for (k, uniform) in uniform.iter().enumerate().skip(1) {
            let step = run.step(&subdivider, &selection);
            assert_follows(&selection, &run, &step);
            assert_exact(&step.selection, &Beside::new(&run, uniform), &format!("{name}, r {rings}, level {k}"));
            selection = picks.part(&step.selection, k - 1);
        }
    }
    assert_simple_differs(&scheme, &mesh, &patch, &uniform, name);
}

fn exact_on_random_meshes<const SCHEME: usize>(seed: u64) {
    check(seed, 12, exact::<Closed, SCHEME> as fn(Closed, Picks));
    check(seed + 1, 12, exact::<WithBoundary, SCHEME> as fn(WithBoundary, Picks));
}

#[test]
fn loop_is_exact_on_random_meshes() {
    exact_on_random_meshes::<0>(1);
}

#[test]
fn loop_with_warrens_weights_is_exact_on_random_meshes() {
    exact_on_random_meshes::<1>(3);
}

#[test]
fn butterfly_is_exact_on_random_meshes() {
    exact_on_random_meshes::<2>(5);
}

#[test]
fn modified_butterfly_is_exact_on_random_meshes() {
    exact_on_random_meshes::<3>(7);
}

#[test]
fn midpoint_is_exact_on_random_meshes() {
    exact_on_random_meshes::<4>(9);
}

/// Closed and open meshes of 100 to 700 faces, as made by people.
const SHARED: [&str; 12] = [
    "papers/spot_280.off",
    "papers/cat_700.off",
    "papers/eight_384.off",
    "papers/penguin_500.off",
    "papers/top_144.off",
    "papers/torus_288.off",
    "papers/foot_240.off",
    "papers/strip_320.off",
    "models/cat_head.obj",
    "models/hole_capsule.off",
    "models/mpi_triang.off",
    "models/patch-13.off",
];

#[test]
fn disks_of_shared_meshes_are_exact() {
    let Some(folder) = common::meshes() else { return };
    let mut open = 0;
    for name in SHARED {
        let mesh = load(&folder.join(name));
        assert!(mesh.face_count() > 100, "{name}");
        open += usize::from(mesh.vertices().any(|v| mesh.is_boundary(v)));
        let center = VertexId::new(mesh.vertex_count() / 2);
        let disk: Selection =
            r_disk(mesh.rotation(), [center], 2, &mut Scratch::new()).vertices().iter().copied().collect();
        for (scheme_name, scheme) in schemes() {
            let what = format!("{name}, {scheme_name}");
            let uniform = uniform_levels(&scheme, &mesh);
            let subdivider = incremental(&scheme, 1);
            let (mut run, mut selection) = (Run::new(&mesh), disk.clone());
            for (k, uniform) in uniform.iter().enumerate().skip(1) {
                selection = run.step(&subdivider, &selection).selection;
                assert_exact(&selection, &Beside::new(&run, uniform), &format!("{what}, level {k}"));
            }
            assert_simple_differs(&scheme, &mesh, &disk, &uniform, &what);
        }
    }
    assert!((3..=9).contains(&open), "closed and open ones: {open} of {} are open", SHARED.len());
}

/// The distance of every vertex from a selection.
fn distances(mesh: &Mesh, selection: &Selection) -> Vec<Option<usize>> {
    let mut distances = vec![None; mesh.vertex_count()];
    let disk = r_disk(mesh.rotation(), selection.vertices().iter().copied(), usize::MAX, &mut Scratch::new());
    for (distance, layer) in disk.layers().enumerate() {
        for v in layer {
            distances[v.index()] = Some(distance);
        }
    }
    distances
}

/// T-vertices are 2r or 2r + 1 edges away from S', O-vertices 2r + 1; none is an O-vertex twice, so valences stay
/// bounded.
fn closing_keeps_its_distance<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    for rings in 1..=3 {
        let subdivider = incremental(&Midpoint.into(), rings);
        let (mut run, mut selection) = (Run::new(&mesh), picks.patch(&mesh));
        let bound = (2 * run.history.max_valence()).max(12);
        let mut were_o = Vec::new();
        for level in 1..=LEVELS {
            let step = run.step(&subdivider, &selection);
            let distances = distances(&run.mesh, &step.selection);
            for &t in &step.t_vertices {
                let distance = distances[t.index()].unwrap();
                assert!([2 * rings, 2 * rings + 1].contains(&distance), "r {rings}, level {level}: {t} at {distance}");
            }
            for &o in &step.o_vertices {
                assert_eq!(distances[o.index()], Some(2 * rings + 1), "r {rings}, level {level}: {o}");
                assert!(!were_o.contains(&o), "{o} is an O-vertex a second time");
            }
            were_o.extend(&step.o_vertices);
            let greatest = run.mesh.vertices().map(|v| run.mesh.ring(v).valence()).max().unwrap();
            assert_eq!(run.history.max_valence(), greatest);
            assert!(greatest <= bound, "valence {greatest} at level {level}");
            selection = step.selection;
        }
    }
}

#[test]
fn closing_keeps_its_distance_and_valences_stay_bounded() {
    check(11, 40, closing_keeps_its_distance::<Closed> as fn(Closed, Picks));
    check(12, 40, closing_keeps_its_distance::<WithBoundary> as fn(WithBoundary, Picks));
}

/// Levels of faces: those that share a vertex differ by one at most, and each face is the share of an input face that its
/// level says, half of it if it closes a crack.
fn levels_are_balanced<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    for rings in 1..=2 {
        let subdivider = incremental(&Midpoint.into(), rings);
        let (mut run, mut selection) = (Run::new(&mesh), picks.patch(&mesh));
        for level in 1..=LEVELS {
            selection = run.step(&subdivider, &selection).selection;
            let closing = run.history.closing_edges(&run.mesh).unwrap();
            let level_of = |triangle| run.history.face_level(triangle, &closing).unwrap();
            for v in run.mesh.vertices() {
                let levels = run.mesh.rotation().triangles_around(v).map(|triangle| level_of(triangle).0);
                let (least, greatest) = (levels.clone().min().unwrap_or(0), levels.max().unwrap_or(0));
                assert!(greatest - least <= 1, "r {rings}, level {level}: {least} and {greatest} at {v}");
            }
            let share = |(level, closes): (u8, bool)| 0.25_f64.powi(level.into()) * if closes { 0.5 } else { 1.0 };
            let sum: f64 = run.mesh.triangles().map(|triangle| share(level_of(triangle))).sum();
            assert_eq!(sum, mesh.face_count() as f64, "r {rings}, level {level}");
        }
    }
}

#[test]
fn levels_of_faces_are_balanced() {
    check(14, 15, levels_are_balanced::<Closed> as fn(Closed, Picks));
    check(15, 15, levels_are_balanced::<WithBoundary> as fn(WithBoundary, Picks));
}

/// Without rings an O-vertex gets as many neighbours as it has split ones, again at each level.
fn valences_double_without_rings(surface: Closed, picks: Picks) {
    let mesh = surface.mesh();
    let subdivider = Subdivider::new(Midpoint, Simple);
    let (mut run, mut selection) = (Run::new(&mesh), picks.patch(&mesh));
    let mut greatest = Vec::new();
    for _ in 0..6 {
        selection = run.step(&subdivider, &selection).selection;
        greatest.push(run.history.max_valence());
    }
    let growth: Vec<usize> = greatest.windows(2).map(|two| two[1] - two[0]).collect();
    assert!(growth[4] == 2 * growth[3] && growth[4] >= 16, "{greatest:?}");
}

#[test]
fn valences_double_at_each_step_without_rings() {
    check(13, 20, valences_double_without_rings as fn(Closed, Picks));
}
