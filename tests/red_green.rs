//! Plain red-green refinement: a plain model of its triangles beside it, what it shares with *simple*, and what its
//! certificate proves.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::collections::{BTreeMap, BTreeSet};

use common::load::load;
use common::meshes;
use common::random::{Closed, Picks, Random, Surface, WithBoundary, check};
use common::run::{Beside, MeshBits, Run, schemes};
use vvmesh::adaptive::{Simple, Uniform};
use vvmesh::certify::Certificate;
use vvmesh::check::mesh_conformity;
use vvmesh::error::RefineError;
use vvmesh::query::r_disk;
use vvmesh::scheme::{FourEight, Loop, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep, Lineage};
use vvmesh::subdivide::{Control, Step, Subdivider, Values};
use vvmesh::{Edge, Mesh, Triangle, VertexId, shapes};

/// Leaves and split edges, told by the ids of the run beside it.
struct Plain {
    leaves: BTreeSet<Triangle>,
    odd: BTreeMap<Edge, VertexId>,
}

fn sides(triangle: Triangle) -> [(Edge, VertexId); 3] {
    let [a, b, c] = triangle.corners();
    [(a, b, c), (b, c, a), (c, a, b)].map(|(p, q, third)| (Edge::new(p, q), third))
}

impl Plain {
    fn new(mesh: &Mesh) -> Self {
        Self { leaves: mesh.triangles().collect(), odd: BTreeMap::new() }
    }

    /// Goes on beside a run that made a step for a selection.
    fn follow(&mut self, run: &Run, selection: &Selection, before: usize) {
        let mut red: BTreeSet<Triangle> =
            self.leaves.iter().copied().filter(|leaf| leaf.corners().iter().all(|&v| selection.contains(v))).collect();
        let mut new: BTreeSet<Edge> = BTreeSet::new();
        loop {
            let all = red.iter().flat_map(|&leaf| sides(leaf).map(|side| side.0));
            new.extend(all.filter(|edge| !self.odd.contains_key(edge)));
            let is_split = |edge: &Edge| self.odd.contains_key(edge) || new.contains(edge);
            let is_split_again = |edge: &Edge| {
                self.odd.get(edge).is_some_and(|&x| edge.ends().iter().any(|&end| is_split(&Edge::new(end, x))))
            };
            let due = |leaf: &Triangle| {
                let edges = sides(*leaf).map(|side| side.0);
                edges.iter().filter(|edge| is_split(edge)).count() >= 2 || edges.iter().any(is_split_again)
            };
            let more: Vec<Triangle> =
                self.leaves.iter().copied().filter(|leaf| !red.contains(leaf) && due(leaf)).collect();
            if more.is_empty() {
                break;
            }
            red.extend(more);
        }
        let made: BTreeMap<Edge, VertexId> = run
            .mesh
            .vertices()
            .skip(before)
            .map(|x| match run.history.parents(x) {
                Some(Lineage::Edge([p, q])) => (Edge::new(p, q), x),
                other => panic!("{x} is made of {other:?}"),
            })
            .collect();
        assert_eq!(made.keys().copied().collect::<BTreeSet<_>>(), new);
        self.odd.extend(made);
        for leaf in red {
            self.leaves.remove(&leaf);
            let [a, b, c] = leaf.corners();
            let [z, x, y] = sides(leaf).map(|side| self.odd[&side.0]);
            for [p, q, r] in [[a, z, y], [b, x, z], [c, y, x], [x, y, z]] {
                self.leaves.insert(Triangle::new(p, q, r));
            }
        }
    }

    /// The triangles with their cracks closed.
    fn closed(&self) -> BTreeSet<Triangle> {
        let mut closed = BTreeSet::new();
        for &leaf in &self.leaves {
            let [a, b, c] = leaf.corners();
            let split: Vec<[VertexId; 4]> = [[a, b, c], [b, c, a], [c, a, b]]
                .into_iter()
                .filter_map(|[p, q, o]| self.odd.get(&Edge::new(p, q)).map(|&x| [p, q, o, x]))
                .collect();
            match split[..] {
                [] => drop(closed.insert(leaf)),
                [[p, q, o, x]] => closed.extend([Triangle::new(p, x, o), Triangle::new(x, q, o)]),
                _ => panic!("a leaf has one split edge at most"),
            }
        }
        closed
    }
}

/// Steps for nested selections and for others, beside the model and, where it is small, the uniform mesh.
fn is_as_told(mesh: &Mesh, seed: u64, steps: usize) {
    let mut random = Random::new(seed);
    let (name, scheme) = schemes().into_iter().nth(random.below(5)).unwrap();
    let subdivider = Subdivider::red_green(scheme.clone()).unwrap();
    let (mut run, mut plain) = (Run::new(mesh), Plain::new(mesh));
    let mut uniform = Run::new(mesh);
    let everything = Subdivider::new(scheme, Uniform);
    let input = mesh.vertices().map(|v| mesh.ring(v).valence()).max().unwrap_or(0);
    let euler = mesh.rotation().euler_characteristic();
    let disk = |mesh: &Mesh, random: &mut Random| -> Selection {
        let center = VertexId::new(random.below(mesh.vertex_count()));
        r_disk(mesh.rotation(), [center], 2 + random.below(3), &mut Scratch::new())
            .into_vertices()
            .into_iter()
            .collect()
    };
    let mut selection = disk(&run.mesh, &mut random);
    for k in 0..steps {
        let before = run.mesh.vertex_count();
        let faces = run.mesh.face_count();
        let step = run.step(&subdivider, &selection);
        plain.follow(&run, &selection, before);
        assert_eq!(run.mesh.rotation().validate(), [], "{name}");
        assert_eq!(run.mesh.triangles().collect::<BTreeSet<_>>(), plain.closed(), "{name}");
        assert_eq!(run.mesh.rotation().euler_characteristic(), euler);
        assert_eq!(step.split_edges, run.mesh.vertex_count() - before);
        assert!(run.mesh.face_count() >= faces);
        let valence = run.mesh.vertices().map(|v| run.mesh.ring(v).valence()).max().unwrap_or(0);
        assert!(valence <= 2 * input.max(6), "{name}: {valence} of {input}");
        assert!(valence <= run.history.max_valence());
        assert_follows(&step, &selection, &plain, before, &run);
        assert_closing(&run, &plain);
        if uniform.mesh.face_count() < 40_000 {
            uniform.step(&everything, &Selection::empty());
            let beside = Beside::new(&run, &uniform);
            let certificate = Certificate::new(&run.mesh, &run.history).unwrap();
            certificate.certified().for_each(|v| assert!(beside.star_is_same(v), "{name}: {v} at step {k}"));
            assert_eq!(step.certified, Some(certificate.certified().count()));
        }
        selection = if random.below(3) == 0 { disk(&run.mesh, &mut random) } else { step.selection };
    }
}

/// S' = S, and every vertex between two of S that was made in this step or is a corner of a triangle that was.
fn assert_follows(step: &Step, selection: &Selection, plain: &Plain, before: usize, run: &Run) {
    assert!(selection.vertices().iter().all(|&v| step.selection.contains(v)));
    for (edge, &x) in &plain.odd {
        let between = edge.ends().iter().all(|&end| selection.contains(end));
        if x.index() >= before {
            assert_eq!(step.selection.contains(x), between, "{x}");
        } else if step.selection.contains(x) && !selection.contains(x) {
            assert!(between && run.mesh.ring(x).iter().any(|w| w.index() >= before), "{x}");
        }
    }
}

/// The edges that close cracks are those of bisected leaves.
fn assert_closing(run: &Run, plain: &Plain) {
    let closing: BTreeSet<Edge> = run.history.closing_edges(&run.mesh).unwrap().into_iter().collect();
    let green = plain.leaves.iter().flat_map(|&leaf| sides(leaf));
    let expected: BTreeSet<Edge> =
        green.filter_map(|(edge, o)| plain.odd.get(&edge).map(|&x| Edge::new(o, x))).collect();
    assert_eq!(closing, expected);
}

#[test]
fn it_is_the_plain_model_on_closed_meshes() {
    fn property(script: Closed, seed: u64) -> bool {
        is_as_told(&script.mesh(), seed, 3);
        true
    }
    check(511, 40, property as fn(Closed, u64) -> bool);
}

#[test]
fn it_is_the_plain_model_on_open_meshes() {
    fn property(script: WithBoundary, seed: u64) -> bool {
        is_as_told(&script.mesh(), seed, 3);
        true
    }
    check(512, 40, property as fn(WithBoundary, u64) -> bool);
}

#[test]
fn five_steps_on_real_meshes_are_as_told() {
    let Some(folder) = meshes() else { return };
    let names = [
        "papers/goathead_1420.off",
        "papers/spot_280.off",
        "papers/penguin_500.off",
        "papers/torso_1678.off",
        "papers/foot_240.off",
        "papers/top_144.off",
        "papers/strip_320.off",
        "papers/eight_384.off",
        "papers/box_12.off",
        "models/mesh_with_border.off",
    ];
    for (seed, name) in (1..).zip(names) {
        let mesh = load(&folder.join(name));
        is_as_told(&mesh, seed, 5);
        is_as_told(&mesh, 100 + seed, 5);
    }
}

// Beside other methods.

fn inside(mesh: &Mesh, selection: &Selection) -> bool {
    let both = |edge: &Edge| edge.ends().iter().all(|&end| selection.contains(end));
    mesh.edges().filter(both).all(|edge| {
        mesh.triangles().any(|triangle| {
            let is_inside = triangle.corners().iter().all(|&v| selection.contains(v));
            is_inside && sides(triangle).iter().any(|side| side.0 == edge)
        })
    })
}

fn first_step_is_that_of_simple(script: Closed, picks: Picks) -> bool {
    let mesh = script.mesh();
    let selection = picks.patch(&mesh);
    let (mut red_green, mut simple) = (Run::new(&mesh), Run::new(&mesh));
    red_green.step(&Subdivider::red_green(Loop::default()).unwrap(), &selection);
    simple.step(&Subdivider::new(Loop::default(), Simple), &selection);
    let is_same = red_green.mesh.triangles().eq(simple.mesh.triangles());
    assert!(is_same || !inside(&mesh, &selection));
    if is_same {
        for v in selection.vertices() {
            assert_eq!(red_green.mesh.position(*v), simple.mesh.position(*v));
        }
    }
    true
}

#[test]
fn the_first_step_has_the_faces_of_simple_where_edges_inside_lie_in_faces_inside() {
    check(513, 60, first_step_is_that_of_simple as fn(Closed, Picks) -> bool);
}

#[test]
fn faces_grow_by_the_split_edges_they_have() {
    let mesh = shapes::torus(12, 9, 2.0, 1.0);
    let selection = r_disk(mesh.rotation(), [VertexId::new(0)], 2, &mut Scratch::new()).into_vertices();
    let selection: Selection = selection.into_iter().collect();
    let is_inside = |v: VertexId| selection.contains(v);
    let split = |triangle: Triangle| {
        sides(triangle)
            .iter()
            .filter(|side| {
                let ends = side.0.ends();
                mesh.triangles().any(|other| {
                    other.corners().iter().all(|&v| is_inside(v))
                        && ends.iter().all(|end| other.corners().contains(end))
                })
            })
            .count()
    };
    let expected: usize = mesh.triangles().map(|triangle| 1 + split(triangle)).sum();
    let mut run = Run::new(&mesh);
    let step = run.step(&Subdivider::red_green(Loop::default()).unwrap(), &selection);
    assert_eq!(run.mesh.face_count(), expected);
    assert!(mesh_conformity(&run.mesh, None).is_conforming());
    // The disk, and the new vertices of its edges; those on the rim stand beside triangles that were not split in four.
    assert_eq!((step.certified, step.selection.len()), (Some(7 + 30), 19 + 42));

    let mut simple = Run::new(&mesh);
    simple.step(&Subdivider::new(Loop::default(), Simple), &selection);
    assert!(inside(&mesh, &selection) && simple.bits() == run.bits());
}

// What goes along, what is refused, what lies in between.

#[test]
fn what_goes_along_sees_the_masks_and_a_refused_step_changes_nothing() {
    let mut mesh = shapes::torus(12, 9, 2.0, 1.0);
    let mut history = History::new(&mesh, Keep::default());
    let subdivider = Subdivider::red_green(Loop::default()).unwrap();
    let mut heat = Values::new(mesh.positions().iter().map(|position| position.z).collect());
    let mut scratch = Scratch::new();
    let mut selection: Selection = (0..40).map(VertexId::new).collect();
    for _ in 0..3 {
        let before = MeshBits::of(&mesh);
        let control = &mut Control { max_faces: Some(mesh.face_count() as u64), ..Control::default() };
        let refused = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, control);
        assert!(matches!(refused, Err(RefineError::TooManyFaces { .. })), "{refused:?}");
        assert_eq!(MeshBits::of(&mesh), before);
        let control = &mut Control { follower: Some(&mut heat), ..Control::default() };
        let step = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, control).unwrap();
        assert!(mesh.positions().iter().map(|position| position.z).eq(heat.shown().iter().copied()));
        selection = step.selection.vertices().iter().copied().filter(|v| v.index() % 5 > 0).collect();
    }
    assert_eq!(mesh.rotation().validate(), []);
}

#[test]
fn other_steps_in_between_begin_anew() {
    let mesh = shapes::icosahedron();
    let mut run = Run::new(&mesh);
    let selection = Selection::all(3);
    run.step(&Subdivider::red_green(Loop::default()).unwrap(), &selection);
    run.step(&Subdivider::new(Loop::default(), Simple), &selection);
    let faces = run.mesh.face_count();
    let (before, mut plain) = (run.mesh.vertex_count(), Plain::new(&run.mesh));
    let all = Selection::all(before);
    run.step(&Subdivider::red_green(Loop::default()).unwrap(), &all);
    plain.follow(&run, &all, before);
    assert_eq!((run.mesh.face_count(), plain.closed().len()), (4 * faces, 4 * faces));
    assert_eq!(run.mesh.triangles().collect::<BTreeSet<_>>(), plain.closed());
}

#[test]
fn schemes_that_conform_by_themselves_are_refused_with_the_reason() {
    let refused = [Subdivider::red_green(Sqrt3::default()), Subdivider::red_green(FourEight::default())];
    for (name, refused) in ["sqrt3", "four-eight"].into_iter().zip(refused) {
        let text = refused.unwrap_err().to_string();
        assert!(text.starts_with(&format!("scheme = {name}: ")) && text.contains("conform"), "{text}");
    }
}
