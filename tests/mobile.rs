//! Static/mobile subdivision: the counts that the paper states, a plain model beside it, what is closed and what hangs, and
//! where it ends.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::collections::{BTreeMap, BTreeSet};

use common::random::{Closed, Surface, WithBoundary, check};
use common::run::{Beside, MeshBits, Run};
use vvmesh::adaptive::{Incremental, Uniform};
use vvmesh::attributes::{Attributes, Blend, Channel, Seams};
use vvmesh::certify::Certificate;
use vvmesh::check::{FindingKind, conformity, mesh_conformity};
use vvmesh::error::RefineError;
use vvmesh::glam::DVec3;
use vvmesh::limit::{Limit, LoopLimit};
use vvmesh::mesh::Sharpness;
use vvmesh::scheme::{AnyScheme, Butterfly, FourEight, Loop, LoopWeights, Midpoint, ModifiedButterfly, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::soup::FaceList;
use vvmesh::step::{History, Keep, Lineage};
use vvmesh::subdivide::{Control, MobileStep, Subdivider, Values};
use vvmesh::{Accuracy, Edge, Mesh, VertexId, shapes};

fn subdivider(distance: f64) -> Subdivider {
    Subdivider::mobile(Loop::default(), Accuracy::new(distance).unwrap()).unwrap()
}

/// All steps until nothing moves any more.
fn refined(mesh: &Mesh, distance: f64) -> (Run, Vec<MobileStep>) {
    let (mut run, subdivider) = (Run::new(mesh), subdivider(distance));
    let mut selection = Selection::all(mesh.vertex_count());
    let mut counts = Vec::new();
    loop {
        let step = run.step(&subdivider, &selection);
        let found = step.mobile.unwrap();
        assert_eq!(step.region, found.mobile_vertices);
        if step.did_nothing() {
            return (run, counts);
        }
        counts.push(found);
        selection = step.selection;
        assert_eq!(selection.len(), run.mesh.vertex_count());
    }
}

fn unclosed(run: &Run) -> FaceList {
    run.history.unclosed(&run.mesh).unwrap_or_else(|| run.mesh.to_face_list())
}

fn greatest_distance(mesh: &Mesh) -> f64 {
    let distances = mesh.vertices().map(|v| LoopLimit::default().position(mesh, v).distance(mesh.position(v)));
    distances.fold(0.0, f64::max)
}

fn scaled(mut mesh: Mesh, factor: f64) -> Mesh {
    mesh.positions_mut().iter_mut().for_each(|position| *position *= factor);
    mesh
}

// What the paper counts.

/// A cube of twelve triangles, its diagonals such that four vertices have valence 4 and four have 5; all such choices.
fn boxes(side: f64) -> Vec<Mesh> {
    let corner = |k: u32| DVec3::new(f64::from(k & 1), f64::from(k >> 1 & 1), f64::from(k >> 2)) * side;
    let squares = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let of = |choice: u32| {
        let halves = squares.iter().enumerate().flat_map(|(k, &[a, b, c, d])| match choice >> k & 1 {
            0 => [[a, b, c], [a, c, d]],
            _ => [[b, c, d], [b, d, a]],
        });
        Mesh::from_triangles((0..8).map(corner).collect(), &halves.collect::<Vec<_>>()).unwrap()
    };
    let is_such = |mesh: &Mesh| {
        let mut valences: Vec<usize> = mesh.vertices().map(|v| mesh.ring(v).valence()).collect();
        valences.sort_unstable();
        valences == [4, 4, 4, 4, 5, 5, 5, 5]
    };
    (0..64).map(of).filter(is_such).collect()
}

/// There are two kinds of such boxes; the paper's is the commoner one.
#[test]
fn the_box_has_the_faces_and_levels_of_the_paper() {
    for (side, expected) in [(10.74, 2172), (10.75, 2184)] {
        let mut met = BTreeMap::new();
        for mesh in boxes(side) {
            assert!((greatest_distance(&mesh) / side - 0.435_877).abs() < 1e-6);
            let (run, counts) = refined(&mesh, 0.05);
            let faces = unclosed(&run).face_count();
            assert_eq!((counts.len(), counts[3].faces), (4, faces));
            *met.entry(faces).or_insert(0) += 1;
            assert_eq!(refined(&mesh, 0.2).1.len(), 3);
        }
        assert_eq!(met, BTreeMap::from([(expected, 12), (2304, 6)]));
    }
}

#[test]
fn tori_have_the_faces_of_the_paper() {
    for (around, tube, ratio, [low, high], expected) in
        [(5, 4, 2.0, [2.05, 2.11], 1000), (4, 4, 1.4, [2.18, 2.22], 800)]
    {
        let torus = shapes::torus(around, tube, ratio, 1.0);
        let unscaled = greatest_distance(&torus);
        for distance in [low, f64::midpoint(low, high), high] {
            let (run, counts) = refined(&scaled(torus.clone(), distance / unscaled), 0.1);
            assert_eq!((counts.len(), unclosed(&run).face_count()), (3, expected), "{around} x {tube}, {distance}");
        }
    }
}

// A plain model.

/// Static/mobile subdivision as it is told: faces with hanging vertices, and nothing else.
struct Plain {
    positions: Vec<DVec3>,
    /// Of vertices that are no input vertices.
    made: BTreeMap<Edge, VertexId>,
    settled: Vec<[VertexId; 3]>,
    open: Vec<[VertexId; 3]>,
    may_move: BTreeSet<VertexId>,
}

impl Plain {
    fn new(mesh: &Mesh) -> Self {
        Self {
            positions: mesh.positions().to_vec(),
            made: BTreeMap::new(),
            settled: Vec::new(),
            open: mesh.triangles().map(vvmesh::Triangle::corners).collect(),
            may_move: mesh.vertices().collect(),
        }
    }

    fn at(&self, v: VertexId) -> DVec3 {
        self.positions[v.index()]
    }

    /// The neighbours of a vertex and those along the boundary, by the open faces.
    fn around(&self, v: VertexId) -> (BTreeSet<VertexId>, Vec<VertexId>) {
        let mut times = BTreeMap::new();
        for face in self.open.iter().filter(|face| face.contains(&v)) {
            face.iter().filter(|&&w| w != v).for_each(|&w| *times.entry(w).or_insert(0) += 1);
        }
        let once = times.iter().filter(|&(_, &count)| count == 1).map(|(&w, _)| w).collect();
        (times.into_keys().collect(), once)
    }

    fn sum<'a>(&self, vertices: impl IntoIterator<Item = &'a VertexId>) -> DVec3 {
        vertices.into_iter().map(|&v| self.at(v)).sum()
    }

    /// The next position of a vertex, and its limit.
    fn even(&self, v: VertexId) -> (DVec3, DVec3) {
        let (neighbors, along) = self.around(v);
        let center = self.at(v);
        if !along.is_empty() {
            return (0.75 * center + self.sum(&along) / 8.0, center * (2.0 / 3.0) + self.sum(&along) / 6.0);
        }
        let n = neighbors.len() as f64;
        if n == 0.0 {
            return (center, center);
        }
        let alpha = (5.0 / 8.0 - (3.0 / 8.0 + (std::f64::consts::TAU / n).cos() / 4.0).powi(2)) / n;
        let chi = 1.0 / (3.0 / (8.0 * alpha) + n);
        let [next, limit] = [alpha, chi].map(|weight| (1.0 - n * weight) * center + weight * self.sum(&neighbors));
        (next, limit)
    }

    fn odd(&self, edge: Edge, mobile: &BTreeSet<VertexId>) -> DVec3 {
        let [a, b] = edge.ends();
        let faces = self.open.iter().filter(|face| face.contains(&a) && face.contains(&b));
        let apexes: Vec<VertexId> = faces.map(|face| *face.iter().find(|v| ![a, b].contains(v)).unwrap()).collect();
        match apexes[..] {
            [c, d] if mobile.contains(&a) || mobile.contains(&b) => {
                0.375 * self.sum(&[a, b]) + 0.125 * self.sum(&[c, d])
            }
            _ => 0.5 * self.sum(&[a, b]),
        }
    }

    /// One step; answers whether anything moved.
    fn step(&mut self, distance: f64) -> bool {
        let candidates = self.may_move.iter().copied();
        let mobile: BTreeSet<VertexId> =
            candidates.filter(|&v| self.even(v).1.distance(self.at(v)) > distance).collect();
        let (split, settled): (Vec<_>, Vec<_>) =
            self.open.clone().into_iter().partition(|face| face.iter().any(|v| mobile.contains(v)));
        self.settled.extend(settled);
        let mut new = self.positions.clone();
        mobile.iter().for_each(|&v| new[v.index()] = self.even(v).0);
        let mut open = Vec::new();
        self.may_move.clone_from(&mobile);
        for [a, b, c] in split {
            let [x, y, z] = [[a, b], [b, c], [c, a]].map(|ends| {
                let edge = Edge::new(ends[0], ends[1]);
                let x = *self.made.entry(edge).or_insert(VertexId::new(new.len()));
                if x.index() == new.len() {
                    new.push(DVec3::ZERO);
                }
                new[x.index()] = self.odd(edge, &mobile);
                self.may_move.extend(ends.iter().any(|end| mobile.contains(end)).then_some(x));
                x
            });
            open.extend([[a, x, z], [b, y, x], [c, z, y], [x, y, z]]);
        }
        self.open = open;
        self.positions = new;
        !mobile.is_empty()
    }

    fn faces(&self) -> BTreeSet<[VertexId; 3]> {
        self.settled.iter().chain(&self.open).map(|&[a, b, c]| vvmesh::Triangle::new(a, b, c).corners()).collect()
    }
}

/// For each vertex of a run the one of the same name in the model.
fn names(run: &Run, plain: &Plain) -> Vec<VertexId> {
    let mut same: Vec<VertexId> = Vec::new();
    for v in run.mesh.vertices() {
        same.push(match run.history.parents(v) {
            None => v,
            Some(Lineage::Edge([p, q])) => plain.made[&Edge::new(same[p.index()], same[q.index()])],
            Some(other) => panic!("{other} is no edge"),
        });
    }
    same
}

/// Vertices on the inside of an edge of a face, by names alone.
fn hanging(faces: &FaceList) -> BTreeSet<VertexId> {
    let id = |v: u32| VertexId::new(v as usize);
    let directed: BTreeSet<(u32, u32)> =
        faces.faces().flat_map(|face| [0, 1, 2].map(|k| (face[k], face[(k + 1) % 3]))).collect();
    let edges = directed.iter().map(|&(a, b)| Edge::new(id(a), id(b))).collect::<BTreeSet<_>>();
    let middle = |edge: &Edge| {
        let [a, b] = edge.ends().map(|v| faces.positions[v.index()]);
        0.5 * (a + b)
    };
    let places: BTreeMap<[u64; 3], VertexId> = faces
        .positions
        .iter()
        .enumerate()
        .map(|(k, position)| (position.to_array().map(|x| (x + 0.0).to_bits()), VertexId::new(k)))
        .collect();
    // An edge with one face whose middle is a vertex, and its halves in turn.
    let mut found = BTreeSet::new();
    let mut torn: Vec<Edge> = edges
        .into_iter()
        .filter(|edge| {
            let [a, b] = edge.ends().map(|v| v.index() as u32);
            directed.contains(&(a, b)) != directed.contains(&(b, a))
        })
        .collect();
    while let Some(edge) = torn.pop() {
        if let Some(&x) = places.get(&middle(&edge).to_array().map(|x| (x + 0.0).to_bits())) {
            found.insert(x);
            torn.extend(edge.ends().map(|end| Edge::new(end, x)));
        }
    }
    found
}

fn agrees_with_the_model<S: Surface>(script: S, k: u8) -> bool {
    let mut mesh = script.mesh();
    for v in mesh.tags().corners() {
        mesh.set_corner(v, false);
    }
    for edge in mesh.tags().sharp_edges() {
        mesh.set_sharp(edge, false);
    }
    let distance = greatest_distance(&mesh) / f64::from(2 + k % 12);
    let (mut run, subdivider) = (Run::new(&mesh), subdivider(distance));
    let mut plain = Plain::new(&mesh);
    let mut selection = Selection::all(mesh.vertex_count());
    for _ in 0..3 {
        let step = run.step(&subdivider, &selection);
        assert_eq!(plain.step(distance), step.region > 0);
        if step.did_nothing() {
            break;
        }
        selection = step.selection;
        assert_eq!(run.mesh.rotation().validate(), []);
        let same = names(&run, &plain);
        for v in run.mesh.vertices() {
            assert!(run.mesh.position(v).distance(plain.at(same[v.index()])) < 1e-12, "{v}");
        }
        let list = unclosed(&run);
        let renamed = |face: &[u32]| {
            let [a, b, c] = [0, 1, 2].map(|k| same[face[k] as usize]);
            vvmesh::Triangle::new(a, b, c).corners()
        };
        let faces: BTreeSet<[VertexId; 3]> = list.faces().map(renamed).collect();
        assert_eq!((faces.len(), &faces), (list.face_count(), &plain.faces()));
        assert_eq!(step.mobile.unwrap().faces, list.face_count());
    }
    true
}

#[test]
fn it_is_the_plain_model_on_closed_meshes() {
    check(501, 25, agrees_with_the_model::<Closed> as fn(Closed, u8) -> bool);
}

#[test]
fn it_is_the_plain_model_on_open_meshes() {
    check(502, 25, agrees_with_the_model::<WithBoundary> as fn(WithBoundary, u8) -> bool);
}

// What is closed, and what hangs.

/// A plane with a hill, so that most of it is near its limit from the start; with a boundary.
fn hill() -> Mesh {
    let mut mesh = shapes::grid(9, 7);
    for position in mesh.positions_mut() {
        let [x, y] = [position.x - 4.2, position.y - 3.1];
        position.z = 1.5 * (-(x * x + y * y)).exp();
    }
    mesh
}

#[test]
fn the_closed_mesh_conforms_and_the_unclosed_faces_have_the_hanging_vertices_as_t_junctions() {
    let meshes = [(hill(), 0.01), (boxes(1.0).swap_remove(3), 0.005), (shapes::torus(9, 6, 2.0, 0.7), 0.04)];
    for (mesh, distance) in meshes {
        let (run, counts) = refined(&mesh, distance);
        assert!(counts.len() >= 2 && counts.iter().any(|found| found.faces_by_mobile_corners[0] > 0), "{counts:?}");
        assert_eq!(run.mesh.rotation().validate(), []);
        assert!(mesh_conformity(&run.mesh, None).is_conforming());
        assert_eq!(run.mesh.rotation().euler_characteristic(), mesh.rotation().euler_characteristic());

        let faces = unclosed(&run);
        let expected = hanging(&faces);
        let report = conformity(&faces, None);
        let mut found = BTreeSet::new();
        for finding in report.findings {
            assert_eq!(finding.kind, FindingKind::TJunction, "{finding}");
            found.extend(finding.vertices[2..].iter().copied());
        }
        assert!(expected.len() > 10);
        assert_eq!(found, expected);
        // Closing splits faces at those vertices and moves none.
        assert!(run.mesh.face_count() > faces.face_count());
        assert_eq!(run.mesh.positions(), faces.positions);
    }
}

#[test]
fn whoever_is_static_never_moves_and_whoever_may_still_is_near_enough_at_the_end() {
    let (mesh, distance) = (hill(), 0.004);
    let (mut run, subdivider) = (Run::new(&mesh), subdivider(distance));
    let mut selection = Selection::all(mesh.vertex_count());
    let mut stay: BTreeSet<VertexId> = BTreeSet::new();
    loop {
        let before = run.mesh.clone();
        let step = run.step(&subdivider, &selection);
        for &v in &stay {
            assert_eq!(run.mesh.position(v), before.position(v));
        }
        if step.did_nothing() {
            break;
        }
        let moved = before.vertices().filter(|&v| run.mesh.position(v) != before.position(v));
        let moved: BTreeSet<VertexId> = moved.collect();
        assert_eq!(moved.len(), step.region);
        stay = before.vertices().filter(|v| !moved.contains(v)).collect();
        // Midpoints between them stay, too.
        let between = |v: &VertexId| match run.history.parents(*v) {
            Some(Lineage::Edge(ends)) => ends.iter().all(|end| !moved.contains(end)),
            _ => false,
        };
        stay.extend(run.mesh.vertices().skip(before.vertex_count()).filter(between));
        selection = step.selection;
    }
    assert!(stay.len() > 50);
    let open = run.mesh.vertices().filter(|v| !stay.contains(v)).collect::<Vec<_>>();
    assert!(open.len() > 50);
    for v in open {
        assert!(LoopLimit::default().position(&run.mesh, v).distance(run.mesh.position(v)) <= distance);
    }
}

// What is sharp, selected, proven, and followed.

#[test]
fn corners_stay_creases_come_near_and_what_is_semi_sharp_moves_until_it_has_faded() {
    let mut mesh = boxes(1.0).swap_remove(0);
    // The four sides of a face of the cube; its diagonal stays smooth.
    let is_side = |edge: &Edge| {
        let [a, b] = edge.ends().map(|v| mesh.position(v));
        a.z == 0.0 && b.z == 0.0 && a.distance(b) < 1.1
    };
    let square: Vec<Edge> = mesh.edges().filter(is_side).collect();
    assert_eq!(square.len(), 4);
    for &edge in &square {
        mesh.set_sharp(edge, true);
    }
    let corner = mesh.vertices().find(|&v| mesh.position(v) == DVec3::ZERO).unwrap();
    mesh.set_corner(corner, true);
    let (run, counts) = refined(&mesh, 0.01);
    assert!(counts.len() >= 2);
    assert_eq!(run.mesh.position(corner), DVec3::ZERO);
    assert!(run.mesh.tags().sharp_edges().len() >= 16);
    assert!(mesh_conformity(&run.mesh, None).is_conforming());

    // Far from its limit is who has none yet: nothing else is asked for.
    let edge = square[0];
    mesh.set_sharpness(edge, Sharpness::new(2.5).unwrap());
    let (run, counts) = refined(&mesh, 1e3);
    assert_eq!(counts.len(), 3);
    assert!(!run.mesh.tags().has_semi_sharp());
    assert!(counts.iter().all(|found| found.static_vertices > 0));
}

#[test]
fn only_the_selected_move() {
    let mesh = shapes::torus(12, 8, 2.0, 1.0);
    let selection: Selection = mesh.vertices().filter(|v| v.index() < 20).collect();
    let (mut run, subdivider) = (Run::new(&mesh), subdivider(0.01));
    let step = run.step(&subdivider, &selection);
    assert_eq!((step.selected, step.region), (20, 20));
    assert!(mesh.vertices().skip(20).all(|v| run.mesh.position(v) == mesh.position(v)));
    let ends = |v: &VertexId| match run.history.parents(*v) {
        Some(Lineage::Edge(ends)) => ends.iter().all(|&end| selection.contains(end)),
        _ => selection.contains(*v),
    };
    assert!(step.selection.vertices().iter().copied().eq(run.mesh.vertices().filter(ends)));
    // Of all vertices only those may move whose faces were all split.
    let all = Selection::all(run.mesh.vertex_count());
    let second = run.step(&subdivider, &all);
    let may_move = selection.vertices().iter().flat_map(|&v| mesh.ring(v)).collect::<BTreeSet<_>>().len();
    assert!(second.region > 20 && second.region < may_move * 6);
    assert_eq!(run.mesh.rotation().validate(), []);
    assert!(mesh_conformity(&run.mesh, None).is_conforming());
}

#[test]
fn what_is_certified_is_where_uniform_refinement_has_it() {
    let mesh = hill();
    let (mut run, mut uniform) = (Run::new(&mesh), Run::new(&mesh));
    let (subdivider, everything) = (subdivider(0.004), Subdivider::new(Loop::default(), Uniform));
    let mut selection = Selection::all(mesh.vertex_count());
    let mut certified = Vec::new();
    for _ in 0..3 {
        let step = run.step(&subdivider, &selection);
        selection = step.selection;
        uniform.step(&everything, &Selection::empty());
        let beside = Beside::new(&run, &uniform);
        let certificate = Certificate::new(&run.mesh, &run.history).unwrap();
        certificate.certified().for_each(|v| assert!(beside.star_is_same(v), "{v}"));
        assert_eq!(step.certified, Some(certificate.certified().count()));
        assert_eq!(step.unproven, []);
        certified.push(certificate.certified().count());
    }
    assert!(certified.iter().all(|&count| count > 20), "{certified:?}");
}

#[test]
fn what_goes_along_sees_the_masks() {
    let mut mesh = hill();
    let mut history = History::new(&mesh, Keep::default());
    let subdivider = subdivider(0.01);
    let mut heat = Values::new(mesh.positions().iter().map(|position| position.z).collect());
    // Texture coordinates without a seam are two coordinates.
    let values: Vec<[f64; 2]> = mesh.positions().iter().map(|position| [position.x, position.z]).collect();
    let corners: Vec<Option<[u32; 3]>> =
        mesh.triangles().map(|triangle| Some(triangle.corners().map(|v| v.index() as u32))).collect();
    let mut attributes = Attributes::default();
    let channel = Channel::new("uv", Blend::Scheme, values).unwrap();
    attributes.add_corner_channel(&mesh, &history, &channel, &corners, Seams::Scheme).unwrap();
    let (mut selection, mut scratch) = (Selection::all(mesh.vertex_count()), Scratch::new());
    loop {
        let control = &mut Control { follower: Some(&mut heat), ..Control::default() };
        let step = attributes.step(&subdivider, &mut mesh, &mut history, &selection, &mut scratch, control).unwrap();
        if step.did_nothing() {
            break;
        }
        selection = step.selection;
    }
    assert!(history.step_count() >= 2);
    assert!(mesh.positions().iter().map(|position| position.z).eq(heat.into_shown()));
    let channel = attributes.corner_channel("uv").unwrap();
    for (v, position) in mesh.positions().iter().enumerate() {
        let over = (0..channel.values().len()).find(|&k| channel.vertex_below(k).index() == v).unwrap();
        assert_eq!(channel.values().value(over), [position.x, position.z]);
    }
}

// Where it ends, and what is refused.

#[test]
fn nothing_is_done_where_all_is_near() {
    let mesh = shapes::icosahedron();
    let (run, counts) = refined(&mesh, 10.0);
    assert_eq!((counts.len(), run.history.step_count(), run.bits()), (0, 0, MeshBits::of(&mesh)));
    assert!(run.history.unclosed(&run.mesh).is_none());
}

#[test]
fn other_steps_in_between_begin_anew() {
    let mesh = hill();
    let (mut run, subdivider) = (Run::new(&mesh), subdivider(0.01));
    let all = |run: &Run| Selection::all(run.mesh.vertex_count());
    run.step(&subdivider, &all(&run));
    assert!(run.history.unclosed(&run.mesh).is_some());
    run.step(&Subdivider::new(Loop::default(), Incremental::new(1).unwrap()), &Selection::all(3));
    assert!(run.history.unclosed(&run.mesh).is_none());
    let faces = run.mesh.face_count();
    let found = run.step(&subdivider, &all(&run)).mobile.unwrap();
    assert_eq!(found.faces_by_mobile_corners.iter().sum::<usize>(), faces);
    assert_eq!(found.faces, unclosed(&run).face_count());
    assert!(mesh_conformity(&run.mesh, None).is_conforming());
}

#[test]
fn a_step_that_is_refused_changes_nothing() {
    let mut mesh = hill();
    let mut history = History::new(&mesh, Keep { names: true, certificate: true });
    let (subdivider, mut scratch) = (subdivider(1e-300), Scratch::new());
    let selection = Selection::all(mesh.vertex_count());
    let step = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default()).unwrap();
    let (before, faces) = (MeshBits::of(&mesh), history.unclosed(&mesh));
    let control = &mut Control { max_faces: Some(1000), ..Control::default() };
    let refused = subdivider.step(&mut mesh, &mut history, &step.selection, &mut scratch, control);
    assert!(matches!(refused, Err(RefineError::TooManyFaces { allowed: 1000, .. })), "{refused:?}");
    assert_eq!((MeshBits::of(&mesh), history.unclosed(&mesh)), (before, faces));

    // Where positions overflow, no distance is small.
    let mut mesh = scaled(shapes::icosahedron(), 1e308);
    let mut history = History::new(&mesh, Keep::default());
    let all = Selection::all(mesh.vertex_count());
    let refused = subdivider.step(&mut mesh, &mut history, &all, &mut scratch, &mut Control::default());
    assert!(matches!(refused, Err(RefineError::NonFinite(_))), "{refused:?}");
}

#[test]
fn schemes_without_mobile_vertices_are_refused_with_the_reason() {
    let accuracy = Accuracy::new(0.1).unwrap();
    let others: [(AnyScheme, &str); 5] = [
        (Butterfly.into(), "on it from the start"),
        (ModifiedButterfly.into(), "on it from the start"),
        (Midpoint.into(), "on it from the start"),
        (Sqrt3::default().into(), "in four"),
        (FourEight::default().into(), "in four"),
    ];
    for (scheme, reason) in others {
        let name = scheme.name();
        let error = Subdivider::mobile(scheme, accuracy).unwrap_err();
        assert!(error.to_string().starts_with(&format!("scheme = {name}: ")), "{error}");
        assert!(error.to_string().contains(reason), "{error}");
    }
    let warren = Loop::new(LoopWeights::Warren);
    assert!(Subdivider::mobile(warren, accuracy).is_ok());
    for distance in [0.0, -0.1, f64::NAN, f64::INFINITY] {
        assert!(Accuracy::new(distance).is_err());
    }
}
