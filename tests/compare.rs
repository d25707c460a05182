//! Methods side by side: the reference is uniform refinement, and rows say what they should.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use common::random::{Closed, Picks, Surface, WithBoundary, check};
use vvmesh::accuracy::Accuracy;
use vvmesh::adaptive::{Incremental, Uniform};
use vvmesh::check::{Sharing, balance};
use vvmesh::compare::{METHODS, Measures, Outcome, Reference, Row};
use vvmesh::glam::DVec3;
use vvmesh::limit::{Limit, LoopLimit};
use vvmesh::scheme::{AnyScheme, Loop, Midpoint, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Dihedral, Disk, Selection};
use vvmesh::step::{History, Keep, SplitKind};
use vvmesh::subdivide::{AnyMethod, Control, Subdivider};
use vvmesh::{Angle, Mesh, VertexId, shapes};

const LEVELS: u8 = 3;

fn made(row: &Row) -> &Measures {
    match &row.outcome {
        Outcome::Made(measures) => measures,
        Outcome::Skipped { reason, .. } => panic!("level {} is skipped: {reason}", row.level),
    }
}

fn reason(row: &Row) -> &str {
    match &row.outcome {
        Outcome::Made(measures) => panic!("level {} is made: {measures:?}", row.level),
        Outcome::Skipped { reason, .. } => reason,
    }
}

/// The uniform mesh and its history after each step, with the selection that follows.
fn uniform_levels(mesh: &Mesh, selection: &Selection, scheme: &AnyScheme) -> Vec<(Mesh, History, Selection)> {
    let (mut mesh, mut selection) = (mesh.clone(), selection.clone());
    let mut history = History::new(&mesh, Keep { names: true, certificate: false });
    let subdivider = Subdivider::new(scheme.clone(), Uniform);
    let step = |_| {
        let (scratch, control) = (&mut Scratch::new(), &mut Control::default());
        selection = subdivider.step(&mut mesh, &mut history, &selection, scratch, control).unwrap().selection;
        (mesh.clone(), history.clone(), selection.clone())
    };
    (0..LEVELS).map(step).collect()
}

/// The vertices of the reference are those of the uniform mesh that follow the selection, where it has them, to the last bit.
fn the_reference_is_uniform<S: Surface, const SCHEME: usize>(surface: S, picks: Picks) {
    let (mesh, scheme) = (surface.mesh(), AnyScheme::named(AnyScheme::NAMES[SCHEME]).unwrap());
    let selection = picks.patch(&mesh);
    let reference = Reference::new(&mesh, &selection, scheme.clone(), LEVELS, None).unwrap();
    for (k, (uniform, history, selected)) in uniform_levels(&mesh, &selection, &scheme).iter().enumerate() {
        let same = reference.history().same_names(history).unwrap();
        let mut found: Vec<(VertexId, DVec3)> =
            reference.vertices(k + 1).map(|(v, position)| (same[v.index()].unwrap(), position)).collect();
        found.sort_by_key(|(v, _)| *v);
        let expected = selected.vertices().iter().map(|&v| (v, uniform.position(v)));
        assert!(found.into_iter().eq(expected), "{} level {}", scheme.name(), k + 1);
    }
}

fn the_reference_is_uniform_for<const SCHEME: usize>() {
    let seed = 170 + 2 * SCHEME as u64;
    check(seed, 10, the_reference_is_uniform::<Closed, SCHEME> as fn(Closed, Picks));
    check(seed + 1, 10, the_reference_is_uniform::<WithBoundary, SCHEME> as fn(WithBoundary, Picks));
}

#[test]
fn the_reference_is_uniform_refinement_to_the_last_bit() {
    assert_eq!(AnyScheme::NAMES.len(), 6);
    the_reference_is_uniform_for::<0>();
    the_reference_is_uniform_for::<1>();
    the_reference_is_uniform_for::<2>();
    the_reference_is_uniform_for::<3>();
    the_reference_is_uniform_for::<4>();
    the_reference_is_uniform_for::<5>();
}

fn bumpy() -> (Mesh, Selection) {
    let mut mesh = shapes::torus(16, 12, 2.0, 0.9);
    for (k, position) in mesh.positions_mut().iter_mut().enumerate() {
        *position += 0.05 * DVec3::new((k * k) as f64, k as f64, (7 * k) as f64).map(f64::sin);
    }
    let selection = Disk::new(VertexId::new(40), 2).select(&mesh, &mut Scratch::new()).unwrap();
    (mesh, selection)
}

#[test]
fn every_method_has_a_row_for_every_level() {
    let (mesh, selection) = bumpy();
    let accuracy = Some(Accuracy::new(0.01).unwrap());
    for scheme in AnyScheme::NAMES.map(|name| AnyScheme::named(name).unwrap()) {
        let reference = Reference::new(&mesh, &selection, scheme.clone(), LEVELS, None).unwrap();
        for method in METHODS {
            let rows = reference.compare_named(method, accuracy);
            assert!(rows.iter().map(|row| row.level).eq(1..=LEVELS), "{method}");
            let is_made = Subdivider::of(scheme.clone(), AnyMethod::named(method, accuracy).unwrap()).is_ok();
            assert!(rows.iter().all(|row| matches!(row.outcome, Outcome::Made(_)) == is_made), "{method}");
            if ["uniform", "incremental-1", "incremental-2"].contains(&method) {
                assert!(rows.iter().all(|row| made(row).equal_percent == Some(100.0)), "{method}");
                assert!(rows.iter().all(|row| made(row).max_deviation == Some(0.0)), "{method}");
                let in_four = scheme.split_kind() == SplitKind::Quadrisect;
                assert!(!in_four || rows.iter().all(|row| made(row).balance <= 1), "{} {method}", scheme.name());
            }
        }
        let without = reference.compare_named("mobile", None);
        assert!(without.len() == 3 && without.iter().all(|row| reason(row).starts_with("accuracy = none: ")));
        let unknown = reference.compare_named("unheard-of", None);
        assert!(unknown.iter().all(|row| reason(row).contains("one of uniform, simple, ")));
    }
}

/// What a row says is counted here once more, on the mesh of the simple method.
#[test]
fn measures_are_those_of_the_mesh() {
    let (mut mesh, selection) = bumpy();
    let (input, limit) = (mesh.clone(), LoopLimit::default());
    let rows = Reference::new(&input, &selection, Loop::default(), 2, None).unwrap().compare(AnyMethod::Simple);
    let (uniform, names, followed) = &uniform_levels(&input, &selection, &Loop::default().into())[1];

    let subdivider = Subdivider::of(Loop::default(), AnyMethod::Simple).unwrap();
    let mut history = History::new(&mesh, Keep { names: true, certificate: false });
    let (mut scratch, mut control) = (Scratch::new(), Control::default());
    let step = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut control).unwrap();
    let step = subdivider.step(&mut mesh, &mut history, &step.selection, &mut scratch, &mut control).unwrap();

    let same = history.same_names(names).unwrap();
    let pairs: Vec<(VertexId, VertexId)> = mesh.vertices().filter_map(|v| Some((v, same[v.index()]?))).collect();
    let pairs: Vec<(VertexId, VertexId)> = pairs.into_iter().filter(|(_, twin)| followed.contains(*twin)).collect();
    assert_eq!(pairs.len(), followed.len());
    let distances: Vec<f64> =
        pairs.iter().map(|&(v, twin)| mesh.position(v).distance(uniform.position(twin))).collect();
    let limits = pairs.iter().map(|&(v, twin)| limit.position(&mesh, v).distance(limit.position(uniform, twin)));
    let measures = made(&rows[1]);
    let greatest = distances.iter().copied().fold(0.0, f64::max);
    assert!(greatest > 1e-4);
    assert_eq!(measures.max_deviation, Some(greatest));
    assert!((measures.mean_deviation.unwrap() - distances.iter().sum::<f64>() / distances.len() as f64).abs() < 1e-15);
    assert_eq!(measures.max_limit_deviation, Some(limits.fold(0.0, f64::max)));
    let equal = distances.iter().filter(|&&distance| distance == 0.0).count();
    assert_eq!(measures.equal_percent, Some(100.0 * equal as f64 / followed.len() as f64));
    assert_eq!([measures.faces, measures.vertices], [mesh.face_count(), mesh.vertex_count()]);
    assert_eq!([measures.t_vertices, measures.o_vertices], [step.t_vertices.len(), step.o_vertices.len()]);
    assert_eq!((measures.max_valence, measures.passes), (history.max_valence(), 1));
    assert!(measures.min_angle_deg.unwrap() > 0.0 && measures.bytes > mesh.memory_bytes());
    let closing = history.closing_edges(&mesh).unwrap();
    let level = |triangle| u32::from(history.face_level(triangle, &closing).unwrap().0);
    let unbalanced = balance(&mesh, Sharing::Vertex, level).into_iter().map(|finding| finding.message);
    assert_eq!(measures.balance, 2);
    assert!(unbalanced.into_iter().any(|message| message.ends_with("levels 0 and 2")));
}

/// Around a disk it is known where a mesh of 10^15 faces would have its vertices.
#[test]
fn it_works_where_the_uniform_mesh_would_not_fit() {
    let mesh = shapes::torus(300, 200, 2.0, 1.0);
    let selection = Disk::new(VertexId::new(777), 0).select(&mesh, &mut Scratch::new()).unwrap();
    let rows = |scheme: AnyScheme, levels| {
        let reference = Reference::new(&mesh, &selection, scheme, levels, Some(200_000)).unwrap();
        (reference.compare(AnyMethod::Uniform), reference.compare(AnyMethod::Incremental(Incremental::new(1).unwrap())))
    };
    let (uniform, incremental) = rows(Loop::default().into(), 16);
    assert_eq!(uniform.len(), 16);
    for (k, row) in uniform.iter().enumerate() {
        let Outcome::Skipped { reason, sizes } = &row.outcome else { panic!("level {} is made", row.level) };
        assert!(reason.contains("allowed are 200000"), "{reason}");
        let faces = 120_000 << (2 * (k + 1));
        assert_eq!(*sizes, Some([faces, faces / 2]));
    }
    assert!(incremental.iter().all(|row| made(row).equal_percent == Some(100.0)));
    let (uniform, incremental) = rows(Sqrt3::default().into(), 3);
    let sizes = |row: &Row| if let Outcome::Skipped { sizes, .. } = row.outcome { sizes } else { None };
    assert!(uniform.iter().map(sizes).eq([360_000, 1_080_000, 3_240_000].map(|faces| Some([faces, faces / 2]))));
    assert!(incremental.iter().all(|row| made(row).max_deviation == Some(0.0)));
}

#[test]
fn an_empty_selection_and_one_that_does_not_exist() {
    let mesh = shapes::icosahedron();
    let none = Selection::empty();
    let row = &Reference::new(&mesh, &none, Midpoint, 1, None).unwrap().compare(AnyMethod::Simple)[0];
    let measures = made(row);
    assert_eq!((measures.faces, measures.equal_percent, measures.max_deviation), (20, None, None));
    let beyond: Selection = [VertexId::new(12)].into_iter().collect();
    assert!(Reference::new(&mesh, &beyond, Midpoint, 1, None).is_err());
}

/// Whether every edge inside of a selection is a side of a face inside of it.
fn has_no_lone_edge(mesh: &Mesh, selection: &Selection) -> bool {
    let mut inside = mesh.edges().filter(|edge| edge.ends().iter().all(|&v| selection.contains(v)));
    inside.all(|edge| {
        let [a, b] = edge.ends();
        let mut faces = mesh.rotation().triangles_around(a).map(|face| face.corners());
        faces.any(|corners| corners.contains(&b) && corners.iter().all(|&v| selection.contains(v)))
    })
}

/// Fig. 25 of the paper on incremental subdivision, on a mesh of as many faces: the relations, and the numbers in
/// `papers/incremental.md`.
#[test]
fn figure_25() {
    let Some(folder) = common::meshes() else { return };
    let mesh = common::load::load(&folder.join("papers/goathead_1420.off"));
    let faces = |selection: &Selection| {
        let reference = Reference::new(&mesh, selection, Loop::default(), 2, None).unwrap();
        ["uniform", "simple", "red-green-restricted", "incremental-1"].map(|method| {
            let rows = reference.compare_named(method, None);
            [made(&rows[0]).faces, made(&rows[1]).faces]
        })
    };
    let folded = |degrees| Dihedral::new(Angle::from_deg(degrees)).unwrap();
    let criterion = folded(15.0).and(Disk::new(VertexId::new(300), 9));
    let selection = criterion.select(&mesh, &mut Scratch::new()).unwrap();
    assert!(has_no_lone_edge(&mesh, &selection));
    let here = faces(&selection);
    let [regular, simple, red_green, incremental] = here;
    assert_eq!(simple[0], red_green[0]);
    assert!(simple[1] <= red_green[1] && red_green[1] <= incremental[1] && incremental[1] <= regular[1]);

    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/papers/incremental.md")).unwrap();
    let assert_told = |line: &str| assert!(page.contains(line), "papers/incremental.md does not have `{line}`");
    let paper = [[5680, 22720], [2880, 8536], [2880, 9134], [3420, 10148]];
    for (level, (whose, counts)) in [0, 1].into_iter().flat_map(|k| [(k, ("paper", paper)), (k, ("here", here))]) {
        let counts = counts.map(|counts| counts[level].to_string()).join(" | ");
        assert_told(&format!("| {} | {whose} | {counts} |", level + 1));
    }
    for (name, method) in [("red-green, restricted", 2), ("simple", 1)] {
        let more = |counts: [[usize; 2]; 4], of: usize| {
            100.0 * (counts[3][1] - counts[method][1]) as f64 / counts[of][1] as f64
        };
        let parts = [(paper, 0), (here, 0), (paper, method), (here, method)].map(|(counts, of)| more(counts, of));
        assert_told(&format!("| {name} | {} |", parts.map(|part| format!("{part:.1} %")).join(" | ")));
    }

    let strips = folded(50.8).select(&mesh, &mut Scratch::new()).unwrap();
    assert!(!has_no_lone_edge(&mesh, &strips));
    let [_, simple, red_green, _] = faces(&strips);
    assert_told(&format!("they make {} and {} faces", simple[0], red_green[0]));
}
