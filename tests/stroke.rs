//! Is what a pen draws as fine as it was wanted, conforming, repeatable, and where it says so that of a uniform mesh?
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use common::run::{MeshBits, schemes};
use vvmesh::adaptive::Uniform;
use vvmesh::check::mesh_conformity;
use vvmesh::error::RefineError;
use vvmesh::glam::DVec3;
use vvmesh::mesh::{Sharpness, SharpnessRule};
use vvmesh::pick::{FaceTree, Ray};
use vvmesh::scheme::{AnyScheme, FourEight, Loop, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::stroke::{Aim, Brush, Event, Pen, PenMethod, Radius, Touch};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Edge, Mesh, VertexId, shapes};

const METHODS: [PenMethod; 2] = [PenMethod::Incremental, PenMethod::Dynamic];

fn torus() -> Mesh {
    shapes::torus(24, 12, 2.0, 1.0)
}

/// From above down to a place on a torus.
fn down(x: f64, y: f64) -> Aim {
    Aim::Along(Ray::new(DVec3::new(x, y, 9.0), -DVec3::Z).unwrap())
}

/// Around a torus on top of it, slower and slower.
fn around(brush: Brush) -> Vec<Event> {
    (0..40)
        .map(|k| {
            let turn = 3.0 * (f64::from(k) / 40.0).sqrt();
            Event { time: 0.1 * f64::from(k), aim: down(2.1 * turn.cos(), 2.1 * turn.sin()), brush }
        })
        .collect()
}

fn draw(pen: &mut Pen, events: &[Event]) -> Vec<Touch> {
    events.iter().map(|event| pen.touch(event, &mut Control::default()).unwrap()).collect()
}

fn brush(radius: Radius, level: u8, pace: f64) -> Brush {
    Brush::new(radius, level, pace).unwrap()
}

fn greatest_level(pen: &Pen) -> u8 {
    pen.mesh().vertices().map(|v| pen.history().level(v).unwrap_or(0)).max().unwrap()
}

#[test]
fn what_is_drawn_conforms_and_is_as_fine_as_wanted() {
    for method in METHODS {
        for radius in [Radius::Euclidean(0.4), Radius::EdgePath(0.5), Radius::Edges(2)] {
            for level in 0..=3 {
                let mut pen = Pen::new(torus(), Loop::default(), method).unwrap();
                for event in around(brush(radius, level, 0.25)) {
                    let touch = pen.touch(&event, &mut Control::default()).unwrap();
                    assert!(touch.hit.is_some() && touch.touched >= 3 && touch.wanted <= level, "{touch:?}");
                    assert!(touch.proven <= touch.refined && touch.refined <= touch.touched, "{touch:?}");
                }
                // One step an event is too few for the last level at places; restriction makes nothing finer around.
                let reached = greatest_level(&pen);
                assert!(reached <= level && reached >= level.min(2), "{method:?} {radius:?}: {reached} of {level}");
                assert_eq!(pen.mesh().face_count() > 576, level > 0);
                assert!(mesh_conformity(pen.mesh(), None).is_conforming(), "{method:?} {radius:?} {level}");
            }
        }
    }
}

/// Uniform refinements of a mesh, from level 0 on.
fn uniform(mesh: &Mesh, scheme: &AnyScheme, levels: usize) -> Vec<(Mesh, History)> {
    let subdivider = Subdivider::new(scheme.clone(), Uniform);
    let (mut mesh, mut history) = (mesh.clone(), History::new(mesh, Keep { names: true, ..Keep::default() }));
    let mut made = vec![(mesh.clone(), history.clone())];
    for _ in 0..levels {
        let (scratch, control) = (&mut Scratch::new(), &mut Control::default());
        subdivider.step(&mut mesh, &mut history, &Selection::empty(), scratch, control).unwrap();
        made.push((mesh.clone(), history.clone()));
    }
    made
}

/// Asserts that each vertex is where the uniform mesh of its proven level has it, with the same ring and neighbours there if
/// `stars` are proven. Answers how many are, of each level.
fn assert_proven(pen: &Pen, uniform: &[(Mesh, History)], stars: bool) -> Vec<usize> {
    let same: Vec<_> = uniform.iter().map(|(_, history)| pen.history().same_names(history).unwrap()).collect();
    let mut counts = vec![0; uniform.len()];
    for v in pen.mesh().vertices() {
        let Some(level) = pen.proven_level(v) else {
            assert!(stars, "{v} has a level");
            continue;
        };
        let (other, same) = (&uniform[level].0, &same[level]);
        let like = same[v.index()].unwrap_or_else(|| panic!("{v} is not in the uniform mesh of level {level}"));
        assert_eq!(pen.mesh().position(v), other.position(like), "{v}, level {level}");
        if stars {
            let ring: Vec<_> = pen.mesh().ring(v).iter().map(|w| same[w.index()]).collect();
            assert!(ring.iter().copied().eq(other.ring(like).iter().map(Some)), "{v}, level {level}");
            let equal = |w: VertexId| same[w.index()].is_some_and(|l| pen.mesh().position(w) == other.position(l));
            assert!(pen.mesh().ring(v).iter().all(equal), "beside {v}, level {level}");
        }
        counts[level] += 1;
    }
    counts
}

/// A torus with what is sharp for ever, for a while, and at an end.
fn creased(rule: SharpnessRule) -> Mesh {
    let mut mesh = torus();
    mesh.set_sharpness_rule(rule);
    let edges: Vec<Edge> = mesh.edges().collect();
    for (k, &edge) in edges.iter().enumerate().filter(|(k, _)| k % 7 < 2) {
        mesh.set_sharpness(edge, Sharpness::new([f64::INFINITY, 1.5, 0.75][k % 3]).unwrap());
    }
    mesh.set_vertex_sharpness(VertexId::new(5), Sharpness::new(1.25).unwrap());
    mesh
}

#[test]
fn what_is_proven_is_that_of_a_uniform_mesh() {
    for (name, scheme) in schemes() {
        let mut meshes = vec![torus(), shapes::grid(9, 7)];
        if scheme.blends_sharpness() {
            meshes.extend([creased(SharpnessRule::Uniform), creased(SharpnessRule::Chaikin)]);
        }
        for mesh in meshes {
            let uniform = uniform(&mesh, &scheme, 3);
            for method in METHODS {
                let mut pen = Pen::new(mesh.clone(), scheme.clone(), method).unwrap();
                draw(&mut pen, &around(brush(Radius::Euclidean(0.6), 3, 0.25)));
                let counts = assert_proven(&pen, &uniform, method == PenMethod::Incremental);
                assert!(counts[1] > 0, "{name} {method:?}: {counts:?}");
                let mut pen = Pen::new(mesh.clone(), scheme.clone(), method).unwrap();
                let (aim, brush) = (down(2.1, 0.2), brush(Radius::Euclidean(1.2), 3, 0.0));
                draw(&mut pen, &[0.0, 0.1, 0.2].map(|time| Event { time, aim, brush }));
                let counts = assert_proven(&pen, &uniform, method == PenMethod::Incremental);
                assert!(counts[3] > 0, "{name} {method:?}: {counts:?}");
            }
        }
    }
}

#[test]
fn a_pen_that_stays_on_fresh_ground_is_proven_in_its_middle() {
    let mut pen = Pen::new(torus(), Loop::default(), PenMethod::Incremental).unwrap();
    let brush = brush(Radius::Euclidean(0.8), 3, 0.0);
    let touches = draw(&mut pen, &[0.0, 0.1, 0.2, 0.3].map(|time| Event { time, aim: down(2.1, 0.2), brush }));
    assert_eq!(touches[0].proven, touches[0].refined);
    // One step an event, then nothing is left to do.
    assert!(touches[..3].iter().all(|touch| touch.refined > 0 && touch.proven > touch.refined / 2), "{touches:?}");
    assert_eq!((touches[3].refined, touches[3].added), (0, 0));
    let corners = touches[3].hit.unwrap().face.corners();
    assert!(corners.iter().all(|&v| pen.proven_level(v) == Some(3)));
}

#[test]
fn the_longer_a_pen_dwells_the_finer_it_draws() {
    let at = |time, x, pace| Event { time, aim: down(x, 0.0), brush: brush(Radius::Euclidean(0.3), 4, pace) };
    let wanted = |events: &[Event]| {
        let mut pen = Pen::new(torus(), Loop::default(), PenMethod::Dynamic).unwrap();
        draw(&mut pen, events).iter().map(|touch| touch.wanted).collect::<Vec<_>>()
    };
    let times = [0.0, 0.9, 1.0, 1.9, 2.5, 9.0];
    assert_eq!(wanted(&times.map(|time| at(time, 2.0, 1.0))), [1, 1, 2, 2, 3, 4]);
    // It moves within the radius, then leaves, comes back, and takes another brush.
    let moves = [at(0.0, 2.0, 1.0), at(1.0, 2.2, 1.0), at(2.0, 2.4, 1.0), at(3.0, 2.4, 1.0), at(4.0, 2.4, 0.5)];
    assert_eq!(wanted(&moves), [1, 2, 1, 2, 1]);
    // Where it meets nothing it leaves, too; and without a pace all is wanted at once.
    assert_eq!(wanted(&[at(0.0, 2.0, 1.0), at(1.0, 9.0, 1.0), at(2.0, 2.0, 1.0)]), [1, 0, 1]);
    assert_eq!(wanted(&[at(0.0, 2.0, 0.0)]), [4]);
}

#[test]
fn every_radius_touches_what_lies_within() {
    let mesh = shapes::grid(20, 20);
    let aim = Aim::Along(Ray::new(DVec3::new(10.0, 10.0, 1.0), -DVec3::Z).unwrap());
    let touched = |radius| {
        let mut pen = Pen::new(mesh.clone(), Loop::default(), PenMethod::Incremental).unwrap();
        draw(&mut pen, &[Event { time: 0.0, aim, brush: brush(radius, 0, 0.0) }])[0].touched
    };
    let (near, near_face) =
        (|r: f64| mesh.positions().iter().filter(|p| p.distance(DVec3::new(10.0, 10.0, 0.0)) <= r).count(), 3);
    assert_eq!([0.0, 0.5].map(|r| touched(Radius::Euclidean(r))), [near_face; 2]);
    for r in [2.0, 3.5, 6.0] {
        assert_eq!(touched(Radius::Euclidean(r)), near(r));
        let path = touched(Radius::EdgePath(r));
        assert!(path <= near(r) && path > near(r / 2_f64.sqrt() - 1.0), "{path}");
    }
    assert_eq!(touched(Radius::Edges(0)), near_face);
    assert_eq!([f64::MAX, 1e9].map(|r| touched(Radius::EdgePath(r))), [441; 2]);
    assert_eq!([touched(Radius::Edges(usize::MAX)), touched(Radius::Euclidean(f64::MAX))], [441; 2]);
}

#[test]
fn the_tree_of_a_pen_keeps_up_and_the_same_events_give_the_same_bits() {
    for method in METHODS {
        let events = around(brush(Radius::Euclidean(0.4), 3, 0.2));
        let [mut one, mut other] = [(); 2].map(|()| Pen::new(torus(), Loop::default(), method).unwrap());
        for event in &events {
            let Aim::Along(ray) = event.aim else { unreachable!("it is drawn from above") };
            let fresh = FaceTree::new(one.mesh()).pick(one.mesh(), &ray);
            assert_eq!(one.touch(event, &mut Control::default()).unwrap().hit, fresh);
        }
        draw(&mut other, &events);
        assert_eq!(MeshBits::of(one.mesh()), MeshBits::of(other.mesh()));
        assert!(one.memory_bytes() > one.mesh().memory_bytes());
    }
}

#[test]
fn a_place_of_the_input_is_found_on_the_refined_mesh() {
    let mesh = shapes::octahedron();
    let face = mesh.triangles().next().unwrap();
    let center = face.corners().map(|v| mesh.position(v)).iter().sum::<DVec3>() / 3.0;
    let brush = brush(Radius::Edges(1), 2, 0.0);
    let mut pen = Pen::new(mesh, Loop::default(), PenMethod::Incremental).unwrap();
    let aim = Aim::Near(Ray::new(center, DVec3::ONE).unwrap());
    for time in [0.0, 1.0, 2.0] {
        let hit = pen.touch(&Event { time, aim, brush }, &mut Control::default()).unwrap().hit.unwrap();
        // The surface sinks below the place, and is found behind it.
        assert_eq!(hit.distance > 0.1, time > 0.0, "{hit:?}");
        assert!(hit.position.dot(center) > 0.0, "{hit:?}");
    }
}

#[test]
fn what_is_refused_leaves_the_mesh_as_it_was() {
    for method in METHODS {
        let mut pen = Pen::new(torus(), Loop::default(), method).unwrap();
        let event = Event { time: 0.0, aim: down(2.0, 0.0), brush: brush(Radius::Edges(2), 1, 0.0) };
        let mut control = Control { max_faces: Some(600), ..Control::default() };
        assert!(matches!(pen.touch(&event, &mut control), Err(RefineError::TooManyFaces { .. })), "{method:?}");
        assert_eq!(MeshBits::of(pen.mesh()), MeshBits::of(&torus()));
        assert!(pen.touch(&event, &mut Control::default()).unwrap().added > 0);
        for scheme in [AnyScheme::from(Sqrt3::default()), FourEight::default().into()] {
            assert!(Pen::new(torus(), scheme, method).is_err());
        }
    }
    for (radius, pace) in
        [(Radius::Euclidean(f64::NAN), 0.0), (Radius::EdgePath(-1.0), 0.0), (Radius::Edges(1), f64::INFINITY)]
    {
        assert!(Brush::new(radius, 1, pace).is_err());
    }
    let mut empty = Pen::new(Mesh::default(), Loop::default(), PenMethod::Incremental).unwrap();
    let event = Event { time: 0.0, aim: down(2.0, 0.0), brush: brush(Radius::Edges(2), 1, 0.0) };
    assert_eq!(draw(&mut empty, &[event]), [Touch::default()]);
}
