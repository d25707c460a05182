//! What is shown to a follower: the masks that make the positions, of regions and of whole meshes alike.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::ops::ControlFlow;

use common::random::{Closed, Picks, Surface, WithBoundary, check};
use common::run::{MeshBits, schemes};
use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::error::RefineError;
use vvmesh::glam::DVec3;
use vvmesh::scheme::{AnyScheme, Loop, Mask, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep, SplitKind};
use vvmesh::subdivide::{Control, Follower, StepMasks, Subdivider};
use vvmesh::{Mesh, VertexId, shapes};

/// A channel of values, and what it was shown last.
struct Channel {
    values: Vec<DVec3>,
    steps: usize,
    shown: Vec<(VertexId, Vec<VertexId>, Mask)>,
}

impl Channel {
    /// The channel that holds the positions.
    fn of(mesh: &Mesh) -> Self {
        Self { values: mesh.positions().to_vec(), steps: 0, shown: Vec::new() }
    }
}

impl Follower for Channel {
    fn follow(&mut self, step: &StepMasks<'_>) {
        assert_eq!(step.vertex_count_before(), self.values.len());
        self.steps += 1;
        self.shown.clear();
        step.for_each(|shown| self.shown.push((shown.vertex, shown.parents.to_vec(), shown.mask.clone())));
        let mut new = self.values.clone();
        new.resize(step.vertex_count_after(), DVec3::NAN);
        for (v, _, mask) in &self.shown {
            new[v.index()] = mask.apply(|w| self.values[w.index()]);
        }
        self.values = new;
    }
}

fn methods(scheme: &AnyScheme) -> Vec<Subdivider> {
    let incremental = |rings| Subdivider::new(scheme.clone(), Incremental::new(rings).unwrap());
    let mut methods = vec![Subdivider::new(scheme.clone(), Uniform), incremental(1), incremental(2)];
    if scheme.split_kind() == SplitKind::Quadrisect {
        methods.push(Subdivider::new(scheme.clone(), Simple));
    }
    methods
}

fn positions_are_followed(mesh: &Mesh, selection: &Selection) {
    for (name, scheme) in schemes().into_iter().chain([("sqrt3", Sqrt3::default().into())]) {
        for subdivider in methods(&scheme) {
            let (mut mesh, mut selection) = (mesh.clone(), selection.clone());
            let mut history = History::new(&mesh, Keep { names: true, ..Keep::default() });
            let mut channel = Channel::of(&mesh);
            for _ in 0..3 {
                let old = mesh.vertex_count();
                let mut control = Control { follower: Some(&mut channel), ..Control::default() };
                let step =
                    subdivider.step(&mut mesh, &mut history, &selection, &mut Scratch::new(), &mut control).unwrap();
                assert_eq!(channel.values, mesh.positions(), "{name}");
                assert!(channel.shown.is_sorted_by_key(|(v, ..)| *v));
                let (even, odd): (Vec<_>, Vec<_>) = channel.shown.iter().partition(|(v, ..)| v.index() < old);
                assert_eq!(odd.len(), mesh.vertex_count() - old);
                if scheme.split_kind() == SplitKind::Quadrisect {
                    assert_eq!(even.len(), if scheme.moves_even() { step.region } else { 0 });
                }
                assert!(even.iter().all(|(_, parents, _)| parents.is_empty()));
                assert!(odd.iter().all(|(v, parents, _)| {
                    history.parents(*v).is_some_and(|names| names.vertices().eq(parents.iter().copied()))
                }));
                selection = step.selection;
            }
        }
    }
}

fn random_positions_are_followed<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    positions_are_followed(&mesh, &picks.patch(&mesh));
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
    for names in [false, true] {
        let mut mesh = shapes::icosahedron();
        let mut history = History::new(&mesh, Keep { names, ..Keep::default() });
        let mut channel = Channel::of(&mesh);
        let subdivider = Subdivider::new(Loop::default(), Uniform);
        let mut step = |control: &mut Control<'_>| {
            subdivider.step(&mut mesh, &mut history, &Selection::empty(), &mut Scratch::new(), control).map(|_| ())
        };
        let mut stop = |_| ControlFlow::Break(());
        let mut stopped = Control { progress: Some(&mut stop), follower: Some(&mut channel), ..Control::default() };
        assert_eq!(step(&mut stopped), Err(RefineError::Cancelled));
        let mut tight = Control { max_faces: Some(79), follower: Some(&mut channel), ..Control::default() };
        assert!(step(&mut tight).is_err());
        assert_eq!((channel.steps, channel.values.len()), (0, 12));
        step(&mut Control { follower: Some(&mut channel), ..Control::default() }).unwrap();
        assert_eq!((channel.steps, channel.values.len()), (1, 42));
    }
}
