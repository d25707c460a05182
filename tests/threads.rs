//! Is the result the same, bit for bit, on any number of threads, and whether a whole mesh is refined the short way or the
//! general one?
//!
//! Work is shared from 8192 elements on (a unit test of `parallel` shows that it is), so meshes are refined until they have
//! as many vertices.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]
#![allow(clippy::print_stderr, reason = "shown only when the test fails")]

mod common;
#[path = "common/plain.rs"]
mod plain;

use std::collections::BTreeSet;

use common::random::{Closed, Surface, WithBoundary, check, semi_sharp, triangles};
use common::run::{bits, other_schemes, schemes};
use rayon::ThreadPoolBuilder;
use vvmesh::adaptive::Uniform;
use vvmesh::check::{FindingKind, conformity, mesh_conformity};
use vvmesh::glam::DVec3;
use vvmesh::limit::{Limit, LoopLimit};
use vvmesh::mesh::SharpnessRule;
use vvmesh::query::measure::dihedral_angle_rad;
use vvmesh::scheme::{AnyScheme, Loop, LoopWeights, Midpoint};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Dihedral, Expression, Selection, Sphere};
use vvmesh::soup::FaceList;
use vvmesh::step::{History, Keep, SplitKind};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Angle, Edge, Mesh, VertexId, shapes};

/// From so many elements on all of the work is shared.
const SHARED: usize = 8192;

const SHORT: Keep = Keep { names: false, certificate: false };
const GENERAL: Keep = Keep { names: true, certificate: false };

/// Shows that some work has the same result on other numbers of threads as on one, with which it answers.
fn same_on_any<T: PartialEq + Send>(work: impl Fn() -> T + Sync) -> T {
    let on = |threads: usize| ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(&work);
    let one = on(1);
    for threads in [2, 3, 7] {
        // Not `assert_eq`, which would print both.
        assert!(on(threads) == one, "another result on {threads} threads");
    }
    one
}

/// A mesh that equals another if all bits do.
struct Bits(Mesh);

impl PartialEq for Bits {
    fn eq(&self, Self(other): &Self) -> bool {
        let Self(mesh) = self;
        let has_bits_of = |(&p, &q): (&DVec3, &DVec3)| bits(p) == bits(q);
        mesh.vertex_count() == other.vertex_count()
            && mesh.vertices().all(|v| mesh.ring(v) == other.ring(v))
            && mesh.positions().iter().zip(other.positions()).all(has_bits_of)
            && sharp_edges(mesh) == sharp_edges(other)
            && sharp_vertices(mesh) == sharp_vertices(other)
    }
}

fn sharp_edges(mesh: &Mesh) -> impl PartialEq + use<> {
    let edges = mesh.tags().sharp_edges().into_iter();
    edges.map(|edge| (edge, mesh.tags().sharpness(edge))).collect::<Vec<_>>()
}

fn sharp_vertices(mesh: &Mesh) -> impl PartialEq + use<> {
    let vertices = mesh.tags().sharp_vertices().into_iter();
    vertices.map(|v| (v, mesh.tags().vertex_sharpness(v))).collect::<Vec<_>>()
}

fn refined(mesh: &Mesh, scheme: &AnyScheme, steps: usize, keep: Keep) -> Mesh {
    let (mut mesh, subdivider) = (mesh.clone(), Subdivider::new(scheme.clone(), Uniform));
    let mut history = History::new(&mesh, keep);
    for _ in 0..steps {
        let (mut scratch, mut control) = (Scratch::new(), Control::default());
        subdivider.step(&mut mesh, &mut history, &Selection::empty(), &mut scratch, &mut control).unwrap();
    }
    mesh
}

/// How many steps leave a mesh with enough vertices before the last one.
fn steps_to_share(mesh: &Mesh, kind: SplitKind) -> usize {
    let (mut vertices, mut edges, mut faces) = (mesh.vertex_count(), mesh.edge_count(), mesh.face_count());
    let mut steps = 1;
    while vertices < SHARED {
        // Of the last two at least so many: a boundary adds some.
        (vertices, edges, faces) = match kind {
            SplitKind::Quadrisect => (vertices + edges, 2 * edges + 3 * faces, 4 * faces),
            SplitKind::Trisect => (vertices + faces, edges + 3 * faces, 3 * faces),
            SplitKind::Bisect => (vertices + faces / 2, edges + faces / 2 + faces, 2 * faces),
        };
        steps += 1;
    }
    steps
}

/// The short way on any number of threads is the general way.
fn refinement_is_the_same(mesh: &Mesh, scheme: &AnyScheme) -> Mesh {
    let steps = steps_to_share(mesh, scheme.split_kind());
    let short = same_on_any(|| Bits(refined(mesh, scheme, steps, SHORT)));
    assert!(short == Bits(refined(mesh, scheme, steps, GENERAL)), "the general way has another result");
    short.0
}

/// All that is asked of a whole mesh has the same answer on any number of threads.
fn answers_are_the_same(mesh: &Mesh) {
    assert!(mesh.vertex_count() >= SHARED);
    for weights in [LoopWeights::Loop, LoopWeights::Warren] {
        let limit = LoopLimit::new(weights);
        let positions = same_on_any(|| limit.positions(mesh).into_iter().map(bits).collect::<Vec<_>>());
        assert!(positions.into_iter().eq(mesh.vertices().map(|v| bits(limit.position(mesh, v)))));
    }

    let center = mesh.position(VertexId::new(0));
    let radius = mesh.positions().iter().map(|p| p.distance(center)).fold(0.0, f64::max) / 2.0;
    let sphere = Sphere::new(center, radius).unwrap();
    let inside = mesh.vertices().filter(|&v| mesh.position(v).distance(center) <= radius);
    assert_eq!(same_on_any(|| selected(&sphere, mesh)), inside.collect());
    let folded = Dihedral::new(Angle::from_deg(2.0)).unwrap();
    let ends: Selection =
        mesh.edges().filter(|&edge| is_folded(mesh, edge)).flat_map(|edge| beside(mesh, edge)).collect();
    assert_eq!(same_on_any(|| selected(&folded, mesh)), ends);
    let both = Expression::parse(&format!("!{sphere} | {folded} & disk:0,40"), &mut |_| unreachable!()).unwrap();
    same_on_any(|| selected(&both, mesh));

    let faces = |list: &FaceList| list.faces().map(<[u32; 3]>::try_from).collect::<Result<Vec<_>, _>>().unwrap();
    let written = same_on_any(|| faces(&mesh.to_face_list()));
    assert_eq!(written, triangles(mesh));
    let list = mesh.to_face_list();
    let built = same_on_any(|| Bits(Mesh::from_face_list(&list).unwrap()));
    // Inner rings start at their smallest neighbour, so the triangles come in another order.
    let sorted = |mesh: &Mesh| triangles(mesh).into_iter().collect::<BTreeSet<_>>();
    assert!(sorted(&built.0) == sorted(mesh));
    assert_eq!(same_on_any(|| mesh.rotation().validate_triangles()), []);
    let report = same_on_any(|| conformity(&list, Some(0.0)));
    assert!(same_on_any(|| mesh_conformity(mesh, Some(0.0))) == report);
}

fn selected(criterion: &(impl Criterion + Sync), mesh: &Mesh) -> Selection {
    criterion.select(mesh, &mut Scratch::new()).unwrap()
}

fn is_folded(mesh: &Mesh, edge: Edge) -> bool {
    dihedral_angle_rad(mesh, edge).is_some_and(|angle| angle > 2_f64.to_radians())
}

fn beside(mesh: &Mesh, edge: Edge) -> impl Iterator<Item = VertexId> {
    let [a, b] = edge.ends();
    [Some(a), Some(b), mesh.rotation().left_of(a, b), mesh.rotation().right_of(a, b)].into_iter().flatten()
}

/// A wheel whose hub has more than 128 neighbours, a disk of two triangles, a torus, and two vertices without a face.
fn wheel() -> Mesh {
    let rim = 150_u32;
    let torus = shapes::torus(40, 20, 2.0, 1.0);
    let angle = |k: u32| f64::from(k) / f64::from(rim) * std::f64::consts::TAU;
    let mut positions = vec![DVec3::Z];
    positions.extend((0..rim).map(|k| DVec3::new(angle(k).cos(), angle(k).sin(), 0.1 * (5.0 * angle(k)).sin())));
    let mut faces: Vec<[u32; 3]> = (0..rim).map(|k| [0, 1 + k, 1 + (k + 1) % rim]).collect();
    positions.push(DVec3::splat(9.0));
    let first = positions.len() as u32;
    positions.extend(torus.positions().iter().map(|&p| p + 7.0 * DVec3::X));
    faces.extend(triangles(&torus).iter().map(|face| face.map(|v| v + first)));
    let first = positions.len() as u32;
    positions.extend([DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::ONE].map(|p| p - 7.0 * DVec3::X));
    faces.extend([[0, 1, 2], [2, 1, 3]].map(|face| face.map(|v| v + first)));
    positions.push(DVec3::splat(-9.0));

    let mut mesh = Mesh::from_triangles(positions, &faces).unwrap();
    for k in 0..rim / 2 {
        let [v, w] = [1 + k, 2 + k].map(|v| VertexId::new(v as usize));
        mesh.set_sharp(Edge::new(v, w), true);
        if k % 10 == 0 {
            mesh.set_sharp(Edge::new(VertexId::new(0), v), true);
        }
    }
    mesh.set_corner(VertexId::new(200), true);
    mesh
}

#[test]
fn a_mesh_of_all_kinds_of_vertices_is_the_same() {
    let mesh = wheel();
    for (_, scheme) in schemes() {
        answers_are_the_same(&refinement_is_the_same(&mesh, &scheme));
    }
    for (_, scheme) in other_schemes() {
        refinement_is_the_same(&mesh, &scheme);
    }
}

#[test]
fn semi_sharp_meshes_are_the_same() {
    for rule in [SharpnessRule::Uniform, SharpnessRule::Chaikin] {
        refinement_is_the_same(&semi_sharp(wheel(), 7, rule), &Loop::default().into());
    }
}

#[test]
fn random_meshes_are_the_same() {
    fn is_the_same<S: Surface>(surface: S, scheme: u8) {
        let (_, scheme) = schemes()[usize::from(scheme) % 5].clone();
        answers_are_the_same(&refinement_is_the_same(&surface.mesh(), &scheme));
        for (_, scheme) in other_schemes() {
            refinement_is_the_same(&surface.mesh(), &scheme);
        }
    }
    check(71, 6, is_the_same::<Closed> as fn(Closed, u8));
    check(72, 6, is_the_same::<WithBoundary> as fn(WithBoundary, u8));
}

#[test]
fn shared_meshes_are_the_same() {
    let Some(folder) = common::meshes() else { return };
    let is_mesh = |row: &plain::Row| row.cell("manifold") == "yes" && row.cell("genus") != "-";
    let mut count = 0;
    for row in plain::tables(&folder).into_iter().filter(is_mesh) {
        eprintln!("{}", row.file);
        let list = plain::read(&folder.join(&row.file));
        let mesh = Mesh::from_triangles(list.positions.clone(), &list.triangulate().triangles).unwrap();
        for (_, scheme) in schemes().into_iter().chain(other_schemes()) {
            refinement_is_the_same(&mesh, &scheme);
        }
        answers_are_the_same(&refined(
            &mesh,
            &Midpoint.into(),
            steps_to_share(&mesh, SplitKind::Quadrisect) - 1,
            SHORT,
        ));
        count += 1;
    }
    assert!(count >= 80, "only {count} meshes");
}

#[test]
fn bounds_are_the_same() {
    let mut list = shapes::grid(SHARED, 1).to_face_list();
    // Zeros of both signs are equal: which of them is told depends on what is compared with what.
    for (k, position) in list.positions.iter_mut().enumerate() {
        position.z = if k % 3 == 0 { -0.0 } else { 0.0 };
    }
    same_on_any(|| list.census().bounds.unwrap().map(bits));
    assert_eq!(list.census().bounds, Some([DVec3::ZERO, DVec3::new(SHARED as f64, 1.0, 0.0)]));
}

/// Two strips, one above the other, of which the upper has twice as many faces: each edge between them has a vertex on it.
fn strips() -> FaceList {
    let columns = SHARED as u32;
    let [lower, upper] = [shapes::grid(columns as usize, 1), shapes::grid(2 * columns as usize, 1)];
    let mut list = lower.to_face_list();
    let first = list.vertex_count() as u32;
    list.positions.extend(upper.positions().iter().map(|p| DVec3::new(p.x / 2.0, p.y + 1.0, 0.0)));
    for face in triangles(&upper) {
        list.push_face(&face.map(|v| v + first));
    }
    list
}

#[test]
fn findings_are_the_same() {
    let kinds = |list: &FaceList| -> Vec<FindingKind> {
        same_on_any(|| conformity(list, None)).findings.iter().map(|finding| finding.kind).collect()
    };
    let mut list = strips();
    assert_eq!(kinds(&list), vec![FindingKind::TJunction; SHARED]);
    for _ in 0..3 {
        list.positions.push(DVec3::ONE);
    }
    list.positions[5].y = f64::NAN;
    list.push_face(&[0, 1, 1]);
    let found = kinds(&list);
    for (kind, count) in
        [(FindingKind::DegenerateFace, 1), (FindingKind::IsolatedVertex, 3), (FindingKind::NonFinite, 1)]
    {
        assert_eq!(found.iter().filter(|&&other| other == kind).count(), count, "{kind}");
    }
    assert!(same_on_any(|| Mesh::from_face_list(&list).unwrap_err().to_string()).contains("vertex 1 twice"));
}
