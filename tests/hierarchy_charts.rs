//! Corner channels and labels of faces on hierarchies: red-green, red-green with restriction, and stars.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::collections::BTreeMap;

use common::random::{Closed, Picks, Random, Surface, WithBoundary, check, semi_sharp};
use common::ride::Ride;
use vvmesh::adaptive::Uniform;
use vvmesh::attributes::{Blend, Channel, Seams};
use vvmesh::certify::Certificate;
use vvmesh::error::RefineError;
use vvmesh::mesh::SharpnessRule;
use vvmesh::scheme::{AnyScheme, Butterfly, Loop, Midpoint, ModifiedButterfly};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Dynamic, Subdivider};
use vvmesh::{Mesh, Triangle, VertexId, shapes};

/// Every method on a hierarchy.
fn methods(scheme: &AnyScheme) -> [Subdivider; 3] {
    [
        Subdivider::red_green(scheme.clone()).unwrap(),
        Subdivider::red_green_restricted(scheme.clone()).unwrap(),
        Subdivider::dynamic(scheme.clone()).unwrap(),
    ]
}

fn schemes() -> [AnyScheme; 4] {
    [Loop::default().into(), Butterfly.into(), ModifiedButterfly.into(), Midpoint.into()]
}

/// A selection that has nothing to do with the one before.
fn moved(picks: &Picks, mesh: &Mesh, step: usize) -> Selection {
    let vertices: Vec<VertexId> = picks.patch(mesh).vertices().to_vec();
    let first = step * 3 % vertices.len();
    vertices.into_iter().cycle().skip(first).take(4).collect()
}

fn number_faces(ride: &mut Ride) {
    let numbers: Vec<u32> = (0..ride.mesh.face_count() as u32).collect();
    ride.attributes.add_face_labels(&ride.mesh, "number", &numbers).unwrap();
}

// Values.

/// Without seams a corner channel of the positions is the positions, and so is a channel of vertices.
fn positions_ride_along<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    for subdivider in schemes().iter().flat_map(methods) {
        let mut ride = Ride::new(&mesh);
        ride.add_positions(Blend::Scheme);
        let mut selection = picks.patch(&mesh);
        for step in 0..4 {
            selection = ride.step(&subdivider, &selection);
            for (triangle, values) in ride.mesh.triangles().zip(ride.values_at_corners("position")) {
                let expected = triangle.corners().map(|v| ride.mesh.position(v).to_array().to_vec());
                assert_eq!(values, Some(expected), "{subdivider:?}");
            }
            if step % 2 == 1 {
                selection = moved(&picks, &ride.mesh, step);
            }
        }
    }
}

#[test]
fn positions_ride_along_on_closed_and_open_meshes() {
    check(541, 6, positions_ride_along::<Closed> as fn(_, _));
    check(542, 6, positions_ride_along::<WithBoundary> as fn(_, _));
}

/// Random values at the corners of a mesh that falls into charts; some faces have none.
struct Charts {
    numbers: Vec<Option<[u32; 3]>>,
    channel: Channel,
    seams: Seams,
}

impl Charts {
    fn new(mesh: &Mesh, seed: u64, blend: Blend, seams: Seams) -> Self {
        let mut random = Random::new(seed);
        let count = mesh.vertex_count();
        let mut sheet = 0;
        let numbers = mesh.triangles().map(|triangle| {
            if random.below(3) == 0 {
                sheet = random.below(4);
            }
            (sheet < 3).then(|| triangle.corners().map(|v| (v.index() + sheet * count) as u32))
        });
        let numbers = numbers.collect();
        let values = (0..3 * count).map(|_| [random.signed(), random.signed()]).collect();
        Self { numbers, channel: Channel::new("uv", blend, values).unwrap(), seams }
    }

    fn ride(&self, mesh: &Mesh) -> Ride {
        let mut ride = Ride::new(mesh);
        ride.history = History::new(mesh, Keep { names: true, certificate: true });
        let Ride { mesh, history, attributes } = &mut ride;
        attributes.add_corner_channel(mesh, history, &self.channel, &self.numbers, self.seams).unwrap();
        number_faces(&mut ride);
        ride
    }

    /// Faces have values where those of the input have, and equal ones on both sides of an edge but where that lies on a seam.
    fn assert_whole(&self, ride: &Ride, input: &Mesh) {
        let inputs: Vec<Triangle> = input.triangles().collect();
        let labels = ride.attributes.face_labels("number", &ride.mesh).unwrap();
        let faces: BTreeMap<Triangle, (Option<[u32; 3]>, u32)> =
            ride.mesh.triangles().zip(ride.corner("uv").faces(&ride.mesh).zip(labels)).collect();
        for &(face, label) in faces.values() {
            assert_eq!(face.is_some(), self.numbers[label as usize].is_some());
        }
        let number_at = |label: u32, v: VertexId| {
            let place = inputs[label as usize].corners().iter().position(|&corner| corner == v)?;
            self.numbers[label as usize].map(|numbers| numbers[place])
        };
        for edge in ride.mesh.edges() {
            let [a, b] = edge.ends();
            let side = |v, w| {
                let triangle = Triangle::new(v, w, ride.mesh.ring(v).next(w)?);
                let (face, label) = faces[&triangle];
                let place = |v| triangle.corners().iter().position(|&corner| corner == v).unwrap();
                Some((face?, label)).map(|(face, label)| (edge.ends().map(|v| face[place(v)]), label))
            };
            let (Some((one, of_one)), Some((other, of_other))) = (side(a, b), side(b, a)) else { continue };
            let corners = inputs[of_one as usize].corners();
            let shared = corners.into_iter().filter(|v| inputs[of_other as usize].corners().contains(v));
            let is_joined = shared.into_iter().all(|v| number_at(of_one, v) == number_at(of_other, v));
            assert_eq!(one == other, is_joined, "{edge} between {of_one} and {of_other}");
            for (over, v) in one.into_iter().chain(other).zip([a, b, a, b]) {
                assert_eq!(ride.corner("uv").vertex_below(over as usize), v);
            }
        }
    }
}

/// The value at each vertex on the side of each face of the input.
fn by_side(ride: &Ride) -> BTreeMap<(VertexId, u32), Option<Vec<f64>>> {
    let labels = ride.attributes.face_labels("number", &ride.mesh).unwrap();
    let mut values = BTreeMap::new();
    for ((triangle, of), label) in ride.mesh.triangles().zip(ride.values_at_corners("uv")).zip(labels) {
        for (k, v) in triangle.corners().into_iter().enumerate() {
            let value = of.as_ref().map(|of| of[k].clone());
            let first = values.entry((v, label)).or_insert_with(|| value.clone());
            assert_eq!(*first, value, "{v}");
        }
    }
    values
}

/// What the mesh shows at some level has the values, and lies in the faces, of uniform refinement to that level.
fn values_are_those_of_levels<S: Surface>(surface: S, picks: Picks, seed: u64) {
    for (k, scheme) in schemes().into_iter().enumerate() {
        let mut mesh = surface.mesh();
        if scheme.blends_sharpness() {
            let rule = if seed % 2 == 0 { SharpnessRule::Uniform } else { SharpnessRule::Chaikin };
            mesh = semi_sharp(mesh, seed, rule);
        }
        let blend = [Blend::Scheme, Blend::Scheme, Blend::Linear, Blend::Nearest][(seed as usize / 2 + k) % 4];
        let seams = if (seed / 8) % 2 == 0 { Seams::Scheme } else { Seams::Linear };
        let charts = Charts::new(&mesh, seed, blend, seams);
        let mut whole = charts.ride(&mesh);
        let mut levels = vec![by_side(&whole)];
        for _ in 0..3 {
            whole.step(&Subdivider::new(scheme.clone(), Uniform), &Selection::empty());
            levels.push(by_side(&whole));
        }
        let [red_green, methods @ ..] = methods(&scheme);
        for subdivider in methods {
            let mut ride = charts.ride(&mesh);
            let mut selection = picks.patch(&mesh);
            let mut compared = 0;
            for step in 0..3 {
                selection = ride.step(&subdivider, &selection);
                charts.assert_whole(&ride, &mesh);
                let twins = ride.history.same_names(&whole.history).unwrap();
                let certificate = Certificate::new(&ride.mesh, &ride.history).unwrap();
                for ((v, label), value) in by_side(&ride) {
                    let (level, twin) = (certificate.exact_level(v).unwrap(), twins[v.index()].unwrap());
                    assert_eq!(levels[level].get(&(twin, label)), Some(&value), "{subdivider:?}: {v} at level {level}");
                    compared += usize::from(level > 0 && value.is_some());
                }
                if step == 1 {
                    selection = moved(&picks, &ride.mesh, step);
                }
            }
            assert!(compared > 0 || charts.numbers.iter().filter(|numbers| numbers.is_some()).count() < 10);
        }
        // Without restriction some are, and the certificate tells which.
        let mut ride = charts.ride(&mesh);
        let mut selection = picks.patch(&mesh);
        for level in levels.iter().skip(1) {
            selection = ride.step(&red_green, &selection);
            charts.assert_whole(&ride, &mesh);
            let twins = ride.history.same_names(&whole.history).unwrap();
            let certificate = Certificate::new(&ride.mesh, &ride.history).unwrap();
            for ((v, label), value) in by_side(&ride) {
                if certificate.is_certified(v) {
                    assert_eq!(level.get(&(twins[v.index()].unwrap(), label)), Some(&value), "{v}");
                }
            }
        }
        for step in 0..3 {
            ride.step(&red_green, &moved(&picks, &ride.mesh, step));
            charts.assert_whole(&ride, &mesh);
        }
    }
}

#[test]
fn values_on_each_side_of_a_seam_are_those_of_levels() {
    check(543, 12, values_are_those_of_levels::<Closed> as fn(_, _, _));
    check(544, 12, values_are_those_of_levels::<WithBoundary> as fn(_, _, _));
}

/// Channels and labels, added now.
fn add_late(ride: &mut Ride) {
    ride.add_positions(Blend::Linear);
    number_faces(ride);
}

#[test]
fn what_is_said_of_faces_of_a_hierarchy_joins_too_late() {
    for subdivider in methods(&Midpoint.into()) {
        let mut ride = Ride::new(&shapes::torus(6, 5, 2.0, 1.0));
        let selection: Selection = (0..12).map(VertexId::new).collect();
        let selection = ride.step(&subdivider, &selection);
        add_late(&mut ride);
        let Ride { mesh, history, attributes } = &mut ride;
        let (count, control) = (mesh.vertex_count(), &mut Control::default());
        let refused = attributes.step(&subdivider, mesh, history, &selection, &mut Scratch::new(), control);
        assert_eq!((refused.unwrap_err(), mesh.vertex_count()), (RefineError::JoinedLate, count));
        assert!(ride.values_at_corners("position").iter().all(Option::is_some));
    }
}

#[test]
fn a_hierarchy_that_begins_anew_is_followed() {
    let red_green = Subdivider::red_green(Loop::default()).unwrap();
    let mut ride = Ride::new(&shapes::torus(6, 5, 2.0, 1.0));
    let mut selection: Selection = (0..12).map(VertexId::new).collect();
    selection = ride.step(&red_green, &selection);
    selection = ride.step(&Subdivider::new(Loop::default(), Uniform), &selection);
    add_late(&mut ride);
    let input = ride.mesh.clone();
    let positions: Vec<[f64; 3]> = input.positions().iter().map(|p| p.to_array()).collect();
    for subdivider in [&red_green, &red_green, &Subdivider::new(Loop::default(), Uniform), &red_green, &red_green] {
        selection = ride.step(subdivider, &selection);
        let labels = ride.attributes.face_labels("number", &ride.mesh).unwrap();
        let inputs: Vec<Triangle> = input.triangles().collect();
        for (values, label) in ride.values_at_corners("position").into_iter().zip(labels) {
            // Linear values lie in the face whose label they have.
            let corners = inputs[label as usize].corners().map(|v| positions[v.index()]);
            for value in values.unwrap() {
                for k in 0..3 {
                    let [least, greatest] =
                        [f64::min, f64::max].map(|of| corners.map(|p| p[k]).into_iter().reduce(of).unwrap());
                    assert!(least - 1e-12 <= value[k] && value[k] <= greatest + 1e-12);
                }
            }
        }
    }
}

#[test]
fn what_was_given_up_is_followed_by_nobody() {
    let (mut ride, scheme) = (Ride::new(&shapes::icosahedron()), AnyScheme::from(Loop::default()));
    add_late(&mut ride);
    let (subdivider, v) = (Subdivider::dynamic(scheme.clone()).unwrap(), VertexId::new(0));
    let selection = ride.step(&subdivider, &[v].into_iter().collect());
    let Ride { mesh, history, attributes } = &mut ride;
    let scratch = &mut Scratch::new();
    Dynamic::new(scheme).unwrap().coarsen(mesh, history, v, 1, scratch).unwrap();
    let refused = attributes.step(&subdivider, mesh, history, &selection, scratch, &mut Control::default());
    assert_eq!(refused.unwrap_err(), RefineError::JoinedLate);
}
