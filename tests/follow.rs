//! What is shown to a follower: the masks that make the positions, of regions and of whole meshes alike.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::collections::HashMap;
use std::ops::ControlFlow;

use common::random::{Closed, Picks, Surface, WithBoundary, check};
use common::run::{MeshBits, schemes};
use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::error::RefineError;
use vvmesh::glam::DVec3;
use vvmesh::scheme::{AnyScheme, FourEight, Mask, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep, SplitKind};
use vvmesh::subdivide::{Assignment, Control, Follower, StepMasks, Subdivider, ValueId, Values};
use vvmesh::{Mesh, Triangle, VertexId, shapes};

/// An assignment as it was shown.
#[derive(Clone, PartialEq, Debug)]
struct Shown {
    id: ValueId,
    parents: Vec<VertexId>,
    pass: usize,
    mask: Option<Mask<ValueId>>,
}

/// Values that go along by the letter: those of a pass are made of the values before it, and then all put at once.
struct Channel {
    values: HashMap<ValueId, DVec3>,
    vertex_count: usize,
    steps: usize,
    /// By the last step.
    shown: Vec<Shown>,
}

impl Channel {
    /// The channel that holds the positions.
    fn of(mesh: &Mesh) -> Self {
        let values = mesh.vertices().map(|v| (ValueId::Shown(v), mesh.position(v))).collect();
        Self { values, vertex_count: mesh.vertex_count(), steps: 0, shown: Vec::new() }
    }

    fn positions(&self) -> Vec<DVec3> {
        (0..self.vertex_count).map(|v| self.values[&ValueId::Shown(VertexId::new(v))]).collect()
    }
}

impl Follower for Channel {
    fn follow(&mut self, step: &StepMasks<'_>) {
        assert_eq!(step.vertex_count_before(), self.vertex_count);
        self.vertex_count = step.vertex_count_after();
        self.steps += 1;
        self.shown.clear();
        step.for_each(|Assignment { id, parents, pass, mask }| {
            self.shown.push(Shown { id, parents: parents.to_vec(), pass, mask: mask.cloned() });
        });
        assert!(self.shown.is_sorted_by_key(|shown| shown.pass));
        for pass in self.shown.chunk_by(|one, next| one.pass == next.pass) {
            let vertices = || pass.iter().filter_map(|shown| vertex(shown.id));
            assert!(vertices().zip(vertices().skip(1)).all(|(v, w)| v < w));
            let made: HashMap<ValueId, Option<DVec3>> = pass
                .iter()
                .map(|shown| (shown.id, shown.mask.as_ref().map(|mask| mask.apply(|id| self.values[&id]))))
                .collect();
            assert_eq!(made.len(), pass.len(), "each comes once");
            for (id, value) in made {
                match value {
                    Some(value) => self.values.insert(id, value),
                    None => Some(self.values.remove(&id).unwrap()),
                };
            }
        }
    }

    fn has_kept(&self) -> bool {
        self.values.len() > self.vertex_count
    }
}

fn vertex(id: ValueId) -> Option<VertexId> {
    match id {
        ValueId::Shown(v) => Some(v),
        ValueId::Kept(..) => None,
    }
}

fn all_schemes() -> impl Iterator<Item = (&'static str, AnyScheme)> {
    schemes().into_iter().chain([("sqrt3", Sqrt3::default().into()), ("4-8", FourEight::default().into())])
}

fn methods(scheme: &AnyScheme) -> [(&'static str, Subdivider); 4] {
    let incremental = |rings| Subdivider::new(scheme.clone(), Incremental::new(rings).unwrap());
    [
        ("uniform", Subdivider::new(scheme.clone(), Uniform)),
        ("incremental", incremental(1)),
        ("incremental, two rings", incremental(2)),
        ("simple", Subdivider::new(scheme.clone(), Simple)),
    ]
}

/// If `each` is given, it selects anew from step to step; else the selection follows.
fn positions_are_followed(mesh: &Mesh, selection: &Selection, each: Option<&Picks>) {
    for (name, scheme) in all_schemes() {
        for (method, subdivider) in methods(&scheme) {
            let (mut mesh, mut selection) = (mesh.clone(), selection.clone());
            let mut history = History::new(&mesh, Keep { names: true, ..Keep::default() });
            let (mut channel, mut values) = (Channel::of(&mesh), Values::new(mesh.positions().to_vec()));
            for _ in 0..4 {
                let old = mesh.vertex_count();
                let mut both = Both(&mut channel, &mut values);
                let mut control = Control { follower: Some(&mut both), ..Control::default() };
                let step =
                    subdivider.step(&mut mesh, &mut history, &selection, &mut Scratch::new(), &mut control).unwrap();
                assert_eq!(channel.positions(), mesh.positions(), "{name}, {method}");
                assert_eq!(values.shown(), mesh.positions(), "{name}, {method}");
                let (odd, even): (Vec<_>, Vec<_>) = channel.shown.iter().partition(|shown| !shown.parents.is_empty());
                assert_eq!(odd.len(), mesh.vertex_count() - old);
                if scheme.split_kind() == SplitKind::Quadrisect {
                    assert_eq!(even.len(), if scheme.moves_even() { step.region } else { 0 });
                    assert!(channel.shown.iter().all(|shown| shown.pass == 0 && shown.mask.is_some()));
                }
                assert!(odd.iter().all(|shown| {
                    let names = vertex(shown.id).and_then(|v| history.parents(v));
                    names.is_some_and(|names| names.vertices().eq(shown.parents.iter().copied()))
                }));
                selection = each.map_or(step.selection, |picks| picks.patch(&mesh));
            }
        }
    }
}

/// Two that follow.
struct Both<'a>(&'a mut Channel, &'a mut Values<DVec3>);

impl Follower for Both<'_> {
    fn follow(&mut self, step: &StepMasks<'_>) {
        self.0.follow(step);
        self.1.follow(step);
    }

    fn has_kept(&self) -> bool {
        assert_eq!(self.0.has_kept(), self.1.has_kept());
        self.1.has_kept()
    }
}

fn random_positions_are_followed<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    positions_are_followed(&mesh, &picks.patch(&mesh), None);
    positions_are_followed(&mesh, &picks.patch(&mesh), Some(&picks));
}

#[test]
fn a_channel_that_holds_the_positions_gets_their_bits() {
    check(71, 8, random_positions_are_followed::<Closed> as fn(Closed, Picks));
    check(72, 8, random_positions_are_followed::<WithBoundary> as fn(WithBoundary, Picks));
}

/// Names are kept of one run and not of the other, so one takes the way of regions and the other that of whole meshes.
fn both_ways_show_the_same<S: Surface>(surface: S) {
    let input = surface.mesh();
    for (name, scheme) in schemes() {
        let subdivider = Subdivider::new(scheme, Uniform);
        let run = |names| {
            let mut mesh = input.clone();
            let mut history = History::new(&mesh, Keep { names, ..Keep::default() });
            let mut channel = Channel::of(&mesh);
            let mut shown = Vec::new();
            for _ in 0..2 {
                let mut control = Control { follower: Some(&mut channel), ..Control::default() };
                let selection = &Selection::empty();
                subdivider.step(&mut mesh, &mut history, selection, &mut Scratch::new(), &mut control).unwrap();
                shown.push(std::mem::take(&mut channel.shown));
            }
            (shown, MeshBits::of(&mesh))
        };
        assert!(run(true) == run(false), "{name}");
    }
}

#[test]
fn regions_and_whole_meshes_show_the_same() {
    check(73, 10, both_ways_show_the_same::<Closed> as fn(Closed));
    check(74, 10, both_ways_show_the_same::<WithBoundary> as fn(WithBoundary));
}

#[test]
fn a_step_that_is_not_made_is_shown_to_nobody() {
    for ((name, scheme), names) in all_schemes().flat_map(|scheme| [(scheme.clone(), false), (scheme, true)]) {
        for (method, subdivider) in methods(&scheme) {
            let mut mesh = shapes::icosahedron();
            let mut history = History::new(&mesh, Keep { names, ..Keep::default() });
            let mut channel = Channel::of(&mesh);
            let all: Selection = mesh.vertices().collect();
            let mut step = |control: &mut Control<'_>| {
                subdivider.step(&mut mesh, &mut history, &all, &mut Scratch::new(), control).map(|_| ())
            };
            let mut stop = |_| ControlFlow::Break(());
            let mut stopped = Control { progress: Some(&mut stop), follower: Some(&mut channel), ..Control::default() };
            assert_eq!(step(&mut stopped), Err(RefineError::Cancelled), "{name}, {method}");
            let mut tight = Control { max_faces: Some(39), follower: Some(&mut channel), ..Control::default() };
            assert!(step(&mut tight).is_err());
            assert_eq!((channel.steps, channel.vertex_count), (0, 12));
            step(&mut Control { follower: Some(&mut channel), ..Control::default() }).unwrap();
            assert_eq!((channel.steps, channel.vertex_count), (1, mesh.vertex_count()));
            assert_eq!(channel.positions(), mesh.positions());
        }
    }
}

/// Under 4-8 one value is kept of a vertex that is ahead of a neighbour, and let go when it is not any more.
#[test]
fn what_nothing_will_read_is_not_kept() {
    let mut mesh = shapes::grid(8, 8);
    let mut history = History::new(&mesh, Keep::default());
    let mut values = Values::new(mesh.positions().to_vec());
    let subdivider = Subdivider::new(FourEight::default(), Simple);
    let mut selection: Selection = [36, 37, 45, 46].map(VertexId::new).into_iter().collect();
    let mut kept = false;
    for _ in 0..20 {
        let mut control = Control { follower: Some(&mut values), ..Control::default() };
        let step = subdivider.step(&mut mesh, &mut history, &selection, &mut Scratch::new(), &mut control).unwrap();
        assert_eq!(values.shown(), mesh.positions());
        let level = |v| history.level(v).unwrap();
        let generation = |triangle: &Triangle| triangle.corners().into_iter().map(level).max().unwrap();
        let greatest = mesh.triangles().map(|triangle| generation(&triangle)).max().unwrap();
        let lags = |triangle: &Triangle| generation(triangle) < greatest;
        let differ = mesh.triangles().any(|triangle| lags(&triangle));
        kept |= values.has_kept();
        if !differ {
            assert!(kept && !values.has_kept());
            return;
        }
        // Three steps ahead, and then whatever is behind.
        selection = if history.step_count() < 3 {
            step.selection
        } else {
            mesh.triangles().filter(lags).flat_map(|triangle| triangle.corners()).collect()
        };
    }
    panic!("triangles never are of one generation");
}
