//! Are whole meshes split alike by √3 and 4-8, whether or not names are kept? Without them no plan is made.
//!
//! The same of the split in four is shown in `refinement`, and of many threads in `threads`.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::ops::ControlFlow;

use common::random::{Closed, Picks, Random, Surface, WithBoundary, check};
use common::run::{Run, other_schemes};
use vvmesh::adaptive::{Incremental, Uniform};
use vvmesh::error::RefineError;
use vvmesh::glam::DVec3;
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Step, Subdivider};
use vvmesh::{Mesh, VertexId, shapes};

/// The same mesh twice: with names, and without.
struct Twins {
    planned: Run,
    whole: Run,
}

impl Twins {
    fn new(mesh: &Mesh) -> Self {
        let history = |names| History::new(mesh, Keep { names, certificate: false });
        let [planned, whole] = [true, false].map(|names| Run { mesh: mesh.clone(), history: history(names) });
        Self { planned, whole }
    }

    fn assert_alike(&self) {
        let Self { planned, whole } = self;
        assert_eq!(whole.bits(), planned.bits());
        assert_eq!(whole.history.max_valence(), planned.history.max_valence());
        let level = |run: &Run, v| run.history.level(v).unwrap_or(0);
        assert!(whole.mesh.vertices().all(|v| level(whole, v) == level(planned, v)));
        let counts = |mesh: &Mesh| {
            (mesh.vertex_count(), mesh.edge_count(), mesh.face_count(), mesh.rotation().boundary_edge_count())
        };
        assert_eq!(counts(&whole.mesh), counts(&planned.mesh));
        assert_eq!(whole.mesh.rotation().validate_triangles(), []);
    }

    fn step(&mut self, subdivider: &Subdivider, selection: &Selection) -> Step {
        let step = self.whole.step(subdivider, selection);
        assert_eq!(self.planned.step(subdivider, selection), step);
        self.assert_alike();
        step
    }

    /// A step that something keeps from being made is not made at all.
    fn assert_refused(&mut self, subdivider: &Subdivider, mut control: Control<'_>, expected: &RefineError) {
        let Run { mesh, history } = &mut self.whole;
        let refused = subdivider.step(mesh, history, &Selection::empty(), &mut Scratch::new(), &mut control);
        assert_eq!(refused.as_ref(), Err(expected));
        self.assert_alike();
    }
}

/// Steps of everything, which a selection follows, then a step of a region, then of everything again.
fn are_split_alike<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    for (_, scheme) in other_schemes() {
        let uniform = Subdivider::new(scheme.clone(), Uniform);
        let mut twins = Twins::new(&mesh);
        let mut selection = picks.patch(&mesh);
        for level in 0..5 {
            let all = Selection::all(twins.whole.mesh.vertex_count());
            let mut next = Run { mesh: twins.whole.mesh.clone(), history: twins.whole.history.clone() };
            assert_eq!(next.step(&uniform, &all).selection, Selection::all(next.mesh.vertex_count()));
            let needed = next.mesh.face_count() as u64;
            let tight = Control { max_faces: Some(needed - 1), ..Control::default() };
            twins.assert_refused(&uniform, tight, &RefineError::TooManyFaces { needed, allowed: needed - 1 });
            let mut stop = |_| ControlFlow::Break(());
            let stopped = Control { progress: Some(&mut stop), ..Control::default() };
            twins.assert_refused(&uniform, stopped, &RefineError::Cancelled);
            selection = picks.part(&twins.step(&uniform, &selection).selection, level);
        }
        let incremental = Subdivider::new(scheme, Incremental::new(1).unwrap());
        for subdivider in [incremental, uniform] {
            selection = twins.step(&subdivider, &selection).selection;
        }
    }
}

#[test]
fn random_meshes_are_split_alike() {
    check(91, 6, are_split_alike::<Closed> as fn(Closed, Picks));
    check(92, 12, are_split_alike::<WithBoundary> as fn(WithBoundary, Picks));
}

/// Rings so long that they are not searched, of a vertex with the smallest id or the greatest, on a boundary or inside.
#[test]
fn hubs_are_split_alike() {
    let count = 150_u32;
    for is_last in [false, true] {
        for is_open in [false, true] {
            let [hub, first] = if is_last { [count, 0] } else { [0, 1] };
            let rim = |k: u32| first + k % count;
            let fan: Vec<[u32; 3]> = (0..count - u32::from(is_open)).map(|k| [hub, rim(k), rim(k + 1)]).collect();
            let mut random = Random::new(93);
            let positions: Vec<DVec3> = (0..=count).map(|_| random.vector()).collect();
            let mesh = Mesh::from_triangles(positions, &fan).unwrap();
            for (_, scheme) in other_schemes() {
                let mut twins = Twins::new(&mesh);
                for _ in 0..4 {
                    twins.step(&Subdivider::new(scheme.clone(), Uniform), &Selection::empty());
                }
            }
        }
    }
}

/// Pieces of a triangle or two, of which all edges or all but one lie on a boundary, and vertices without a triangle.
#[test]
fn small_pieces_are_split_alike() {
    let mut random = Random::new(94);
    let positions: Vec<DVec3> = (0..11).map(|_| random.vector()).collect();
    for faces in [vec![], vec![[0, 1, 2]], vec![[9, 2, 5], [1, 4, 3], [3, 4, 8], [6, 7, 10]]] {
        let mut mesh = Mesh::from_triangles(positions.clone(), &faces).unwrap();
        if let [.., _, [a, b, _]] = faces[..] {
            mesh.set_sharp(vvmesh::Edge::new(VertexId::new(a as usize), VertexId::new(b as usize)), true);
        }
        for (_, scheme) in other_schemes() {
            let mut twins = Twins::new(&mesh);
            for _ in 0..5 {
                twins.step(&Subdivider::new(scheme.clone(), Uniform), &Selection::all(2));
            }
        }
    }
}

/// Tags go along with edges that are bisected.
#[test]
fn creases_are_split_alike() {
    let mut mesh = shapes::torus(8, 6, 2.0, 1.0);
    for edge in mesh.clone().rotation().edges().step_by(5) {
        mesh.set_sharp(edge, true);
    }
    for (_, scheme) in other_schemes() {
        let mut twins = Twins::new(&mesh);
        for _ in 0..4 {
            twins.step(&Subdivider::new(scheme.clone(), Uniform), &Selection::empty());
        }
    }
}

/// The same vertex is to blame for a sum that overflows.
#[test]
fn a_sum_that_overflows_is_refused_alike() {
    for (_, scheme) in other_schemes() {
        let uniform = Subdivider::new(scheme, Uniform);
        let mut twins = Twins::new(&shapes::grid(9, 7));
        for level in 0..4 {
            let far = twins.whole.mesh.vertex_count() - 20 - level..;
            let positions = twins.whole.mesh.positions()[far.clone()].to_vec();
            for Run { mesh, .. } in [&mut twins.planned, &mut twins.whole] {
                mesh.positions_mut()[far.clone()].fill(DVec3::splat(f64::MAX));
            }
            let [planned, whole] = [&mut twins.planned, &mut twins.whole].map(|Run { mesh, history }| {
                uniform.step(mesh, history, &Selection::empty(), &mut Scratch::new(), &mut Control::default())
            });
            assert!(matches!(whole, Err(RefineError::NonFinite(_))));
            assert_eq!(whole, planned);
            twins.assert_alike();
            for Run { mesh, .. } in [&mut twins.planned, &mut twins.whole] {
                mesh.positions_mut()[far.clone()].copy_from_slice(&positions);
            }
            twins.step(&uniform, &Selection::empty());
        }
    }
}
