//! What rides along with a mesh: values of vertices and corners, labels of faces, and what OBJ files say.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::collections::BTreeMap;

use common::random::{Closed, Picks, Surface, WithBoundary, check};
use common::ride::Ride;
use common::run::schemes;
use vvmesh::adaptive::{AdaptiveMethod, Incremental, Simple, Uniform};
use vvmesh::attributes::{Attributes, Blend, Channel, CornerChannel, NormalRule, ObjAttributes, ObjRules, Seams};
use vvmesh::error::RefineError;
use vvmesh::glam::{DVec2, DVec3, DVec4};
use vvmesh::io::{self, FaceAttributes};
use vvmesh::limit::{Limit, LoopLimit};
use vvmesh::query::measure::{corner_positions, triangle_area};
use vvmesh::scheme::{AnyScheme, Butterfly, FourEight, Loop, Mask, Midpoint, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::soup::FaceList;
use vvmesh::split::Diagonal;
use vvmesh::step::{History, Keep, Lineage, Region};
use vvmesh::subdivide::{Control, Follower, StepMasks, Subdivider};
use vvmesh::{Edge, Mesh, VertexId, shapes};

/// Splits some edges, whatever that leaves of the faces: with one, two or three split edges.
#[derive(Debug)]
struct SomeEdges(u32);

impl AdaptiveMethod for SomeEdges {
    fn region(&self, mesh: &Mesh, _selection: &Selection, _scratch: &mut Scratch) -> Region {
        let is_picked = |edge: &Edge| {
            let [a, b] = edge.ends().map(|v| v.index() as u32);
            (a.wrapping_mul(0x9e37_79b9) ^ b.wrapping_mul(0x85eb_ca6b) ^ self.0).wrapping_mul(0xc2b2_ae35) >> 30 != 0
        };
        Region::edges(mesh.edges().filter(is_picked))
    }

    fn promises_exactness(&self) -> bool {
        false
    }
}

/// Every way to choose what is refined, with every diagonal for faces with two split edges.
fn subdividers(scheme: &AnyScheme) -> Vec<Subdivider> {
    let mut all = exact(scheme);
    all.push(Subdivider::new(scheme.clone(), Simple));
    for diagonal in [Diagonal::Valence, Diagonal::Longest, Diagonal::Shortest, Diagonal::ById] {
        all.push(Subdivider::new(scheme.clone(), SomeEdges(all.len() as u32)).with_diagonal(diagonal));
    }
    all
}

/// Methods for selections that follow.
fn exact(scheme: &AnyScheme) -> Vec<Subdivider> {
    vec![
        Subdivider::new(scheme.clone(), Uniform),
        Subdivider::new(scheme.clone(), Incremental::new(1).unwrap()),
        Subdivider::red_green(scheme.clone()).unwrap(),
        Subdivider::red_green_restricted(scheme.clone()).unwrap(),
        Subdivider::dynamic(scheme.clone()).unwrap(),
    ]
}

// Blends.

/// A channel that holds the positions has their bits after any steps; without seams a corner channel has them too.
fn positions_ride_along<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    for (name, scheme) in schemes() {
        for subdivider in subdividers(&scheme) {
            let mut ride = Ride::new(&mesh);
            ride.add_positions(Blend::Scheme);
            let mut selection = picks.patch(&mesh);
            for _ in 0..2 {
                selection = ride.step(&subdivider, &selection);
            }
            let bits = |values: &[f64]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
            let expected: Vec<_> = ride.mesh.positions().iter().map(|p| bits(&p.to_array())).collect();
            let channel = ride.attributes.vertex_channel("position").unwrap();
            assert!(channel.values().map(bits).eq(expected.iter().cloned()), "{name}: {subdivider:?}");
            for (triangle, values) in ride.mesh.triangles().zip(ride.values_at_corners("position")) {
                let values = values.expect("each face has values");
                for (v, value) in triangle.corners().into_iter().zip(&values) {
                    assert_eq!(bits(value), expected[v.index()], "{name}: {subdivider:?}: {v}");
                }
            }
        }
    }
}

#[test]
fn positions_ride_along_on_closed_and_open_meshes() {
    check(501, 6, positions_ride_along::<Closed> as fn(_, _));
    check(502, 6, positions_ride_along::<WithBoundary> as fn(_, _));
}

/// Twice the positions, which doubles without rounding, by each blend.
fn values_of_vertices_ride_along<S: Surface>(surface: S, picks: Picks) {
    let input = surface.mesh();
    let others: [(&str, AnyScheme); 2] = [("sqrt3", Sqrt3::default().into()), ("4-8", FourEight::default().into())];
    for (name, scheme) in schemes().into_iter().chain(others) {
        let incremental = |rings| Subdivider::new(scheme.clone(), Incremental::new(rings).unwrap());
        let [uniform, simple] = [Subdivider::new(scheme.clone(), Uniform), Subdivider::new(scheme.clone(), Simple)];
        for subdivider in [uniform, incremental(1), incremental(2), simple] {
            let mut ride = Ride::new(&input);
            let Ride { mesh, attributes, .. } = &mut ride;
            for (name, blend) in [("scheme", Blend::Scheme), ("linear", Blend::Linear), ("nearest", Blend::Nearest)] {
                let doubled = mesh.positions().iter().map(|p| [2.0 * p.x, 2.0 * p.y, 2.0 * p.z, p.x]).collect();
                attributes.add_vertex_channel(mesh, Channel::new(name, blend, doubled).unwrap()).unwrap();
            }
            let mut selection = picks.patch(mesh);
            for _ in 0..3 {
                selection = ride.step(&subdivider, &selection);
            }
            let value = |name: &str, v: VertexId| ride.attributes.vertex_channel(name).unwrap().value(v.index());
            for v in ride.mesh.vertices() {
                let p = ride.mesh.position(v);
                assert_eq!(value("scheme", v), [2.0 * p.x, 2.0 * p.y, 2.0 * p.z, p.x], "{name}");
                let Some(lineage) = ride.history.parents(v) else { continue };
                let parents: Vec<VertexId> = lineage.vertices().collect();
                assert_eq!(value("nearest", v), value("nearest", parents[0]));
                let weights = match lineage {
                    Lineage::Edge(_) => &[0.5; 2][..],
                    Lineage::Face(_) => &[1.0 / 3.0; 3][..],
                    Lineage::Third { .. } => &[2.0 / 3.0, 1.0 / 3.0][..],
                };
                let linear = |v| DVec4::from_slice(value("linear", v));
                let mean: DVec4 = parents.iter().zip(weights).map(|(&p, &weight)| weight * linear(p)).sum();
                assert!(linear(v).distance(mean) <= 1e-14 * mean.length().max(1.0), "{name}");
            }
        }
    }
}

#[test]
fn values_of_vertices_ride_along_with_every_scheme_and_method() {
    check(511, 3, values_of_vertices_ride_along::<Closed> as fn(_, _));
    check(512, 3, values_of_vertices_ride_along::<WithBoundary> as fn(_, _));
}

/// A channel that is added when others kept values of steps before has none of them.
#[test]
fn a_channel_joins_before_anything_is_kept() {
    let mut ride = Ride::new(&shapes::grid(4, 3));
    let subdivider = Subdivider::new(Sqrt3::default(), Simple);
    let add = |Ride { mesh, attributes, .. }: &mut Ride, name: &str, blend| {
        let heights = mesh.positions().iter().map(|p| [p.z]).collect();
        attributes.add_vertex_channel(mesh, Channel::new(name, blend, heights).unwrap()).unwrap();
    };
    add(&mut ride, "early", Blend::Scheme);
    let selection = ride.step(&subdivider, &(0..12).map(VertexId::new).collect());
    add(&mut ride, "linear", Blend::Linear);
    let selection = ride.step(&subdivider, &selection);
    add(&mut ride, "late", Blend::Scheme);
    let Ride { mesh, history, attributes } = &mut ride;
    let (before, control) = (mesh.vertex_count(), &mut Control::default());
    let result = attributes.step(&subdivider, mesh, history, &selection, &mut Scratch::new(), control);
    assert_eq!((result, mesh.vertex_count()), (Err(RefineError::JoinedLate), before));
    assert_eq!(attributes.vertex_channel("early").unwrap().len(), before);
}

#[test]
fn linear_values_are_those_of_midpoints_and_nearest_ones_are_never_new() {
    for subdivider in subdividers(&Loop::default().into()) {
        let mut ride = Ride::new(&shapes::torus(6, 5, 2.0, 1.0));
        ride.add_positions(Blend::Linear);
        let number: Vec<[f64; 1]> = ride.mesh.vertices().map(|v| [v.index() as f64]).collect();
        let older = Channel::new("older", Blend::Nearest, number).unwrap();
        ride.attributes.add_vertex_channel(&ride.mesh, older).unwrap();
        let mut midpoints = ride.mesh.positions().to_vec();
        let mut selection: Selection = [0, 1, 2, 6, 7, 8].map(VertexId::new).into_iter().collect();
        for _ in 0..2 {
            selection = ride.step(&subdivider, &selection);
            for v in ride.mesh.vertices().skip(midpoints.len()) {
                let ends: Vec<VertexId> = ride.history.parents(v).unwrap().vertices().collect();
                midpoints.push(midpoints[ends[0].index()].midpoint(midpoints[ends[1].index()]));
                let older = ride.attributes.vertex_channel("older").unwrap();
                assert_eq!(older.value(v.index()), older.value(ends[0].index()));
            }
        }
        let channel = ride.attributes.vertex_channel("position").unwrap();
        assert!(channel.values().eq(midpoints.iter().map(|p| p.as_ref() as &[f64])));
        for (triangle, values) in ride.mesh.triangles().zip(ride.values_at_corners("position")) {
            let expected = triangle.corners().map(|v| midpoints[v.index()].to_array().to_vec());
            assert_eq!(values, Some(expected));
        }
    }
}

#[test]
fn who_follows_already_follows_on() {
    struct Count(usize);
    impl Follower for Count {
        fn follow(&mut self, step: &StepMasks<'_>) {
            self.0 += step.vertex_count_after() - step.vertex_count_before();
        }

        fn has_kept(&self) -> bool {
            true
        }
    }
    let mut ride = Ride::new(&shapes::octahedron());
    ride.add_positions(Blend::Scheme);
    let mut count = Count(0);
    let mut control = Control { follower: Some(&mut count), ..Control::default() };
    let subdivider = Subdivider::new(Loop::default(), Uniform);
    let Ride { mesh, history, attributes } = &mut ride;
    for _ in 0..2 {
        attributes.step(&subdivider, mesh, history, &Selection::empty(), &mut Scratch::new(), &mut control).unwrap();
    }
    assert_eq!(count.0, 12 + 48);
}

#[test]
fn what_does_not_fit_is_refused_and_a_failed_step_changes_nothing() {
    let mut ride = Ride::new(&shapes::octahedron());
    let Ride { mesh, history, attributes } = &mut ride;
    let channel = |count| Channel::new("x", Blend::Linear, vec![[0.0]; count]).unwrap();
    let message = |error: vvmesh::error::ConfigError| error.to_string();
    assert_eq!(
        message(attributes.add_vertex_channel(mesh, channel(5)).unwrap_err()),
        "values of vertices = 5: 6 are needed"
    );
    assert_eq!(
        message(attributes.add_face_labels(mesh, "x", &[0; 9]).unwrap_err()),
        "labels of faces = 9: 8 are needed"
    );
    let mut add = |corners: &[_]| attributes.add_corner_channel(mesh, history, &channel(2), corners, Seams::Scheme);
    assert_eq!(message(add(&[None; 7]).unwrap_err()), "triangles with values = 7: 8 are needed");
    assert_eq!(
        message(add(&[Some([0, 1, 2]); 8]).unwrap_err()),
        "value at a corner = 2: less than 2, the number of values"
    );
    assert!(ride.attributes.is_empty());

    ride.add_positions(Blend::Scheme);
    let before = format!("{:?}", ride.attributes.vertex_channel("position"));
    let Ride { mesh, history, attributes } = &mut ride;
    let few = &mut Control { max_faces: Some(9), ..Control::default() };
    let refused =
        |scheme: AnyScheme, attributes: &mut Attributes, mesh: &mut Mesh, history: &mut History, control: &mut _| {
            let subdivider = Subdivider::new(scheme, Uniform);
            attributes.step(&subdivider, mesh, history, &Selection::empty(), &mut Scratch::new(), control).unwrap_err()
        };
    let error = refused(Loop::default().into(), attributes, mesh, history, few);
    assert!(matches!(error, RefineError::TooManyFaces { .. }));
    assert_eq!(format!("{:?}", ride.attributes.vertex_channel("position")), before);
    assert!(ride.values_at_corners("position").iter().all(Option::is_some));
}

// Labels.

/// A face lies in the face whose label it has: under the midpoint scheme areas stay, and corners lie in its plane.
fn labels_stay_in_place<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    let numbers: Vec<u32> = (0..mesh.face_count() as u32).collect();
    let areas = |mesh: &Mesh, labels: &[u32]| {
        let mut areas = vec![0.0; numbers.len()];
        for (triangle, &label) in mesh.triangles().zip(labels) {
            areas[label as usize] += triangle_area(corner_positions(mesh, triangle));
        }
        areas
    };
    let old: Vec<[DVec3; 3]> = mesh.triangles().map(|triangle| corner_positions(&mesh, triangle)).collect();
    for subdivider in subdividers(&Midpoint.into()) {
        let mut ride = Ride::new(&mesh);
        ride.attributes.add_face_labels(&mesh, "number", &numbers).unwrap();
        let mut selection = picks.patch(&mesh);
        for _ in 0..3 {
            selection = ride.step(&subdivider, &selection);
        }
        let labels = ride.attributes.face_labels("number", &ride.mesh).unwrap();
        for (new, old) in areas(&ride.mesh, &labels).into_iter().zip(areas(&mesh, &numbers)) {
            assert!((new - old).abs() <= 1e-12, "{subdivider:?}: {new} of {old}");
        }
        for (triangle, &label) in ride.mesh.triangles().zip(&labels) {
            let center: DVec3 = corner_positions(&ride.mesh, triangle).into_iter().sum::<DVec3>() / 3.0;
            let [a, b, c] = old[label as usize];
            let parts = [[center, b, c], [a, center, c], [a, b, center]].map(triangle_area).iter().sum::<f64>();
            let whole = triangle_area([a, b, c]);
            assert!((parts - whole).abs() <= 1e-12, "{subdivider:?}: {triangle} is not in face {label}");
        }
    }
}

#[test]
fn faces_lie_in_the_faces_whose_labels_they_have() {
    check(503, 6, labels_stay_in_place::<Closed> as fn(_, _));
    check(504, 6, labels_stay_in_place::<WithBoundary> as fn(_, _));
}

#[test]
fn labels_may_be_added_on_the_way() {
    let mut ride = Ride::new(&shapes::grid(2, 1));
    let subdivider = Subdivider::new(Loop::default(), Uniform);
    ride.attributes.add_face_labels(&ride.mesh, "first", &[0, 1, 2, 3]).unwrap();
    ride.step(&subdivider, &Selection::empty());
    let numbers: Vec<u32> = (0..16).collect();
    ride.attributes.add_face_labels(&ride.mesh, "second", &numbers).unwrap();
    let first = ride.attributes.face_labels("first", &ride.mesh).unwrap();
    ride.step(&subdivider, &Selection::empty());
    let [of_first, of_second] = ["first", "second"].map(|name| ride.attributes.face_labels(name, &ride.mesh).unwrap());
    assert!(of_second.iter().zip(&of_first).all(|(&second, label)| first[second as usize] == *label));
    assert!(numbers.iter().all(|number| of_second.iter().filter(|&label| label == number).count() == 4));
}

// Seams.

/// Two squares beside each other; the right one has texture coordinates of its own, apart from the left.
fn two_charts() -> Ride {
    let mut ride = Ride::new(&shapes::grid(2, 1));
    let is_left = |t: vvmesh::Triangle| corner_positions(&ride.mesh, t).iter().all(|p| p.x <= 1.0);
    let corners: Vec<_> = ride
        .mesh
        .triangles()
        .map(|t| Some(t.corners().map(|v| v.index() as u32 + if is_left(t) { 0 } else { 6 })))
        .collect();
    let at = |p: DVec3, shift: f64| [p.x + shift, p.y];
    let values = [0.0, 10.0].map(|shift| ride.mesh.positions().iter().map(|&p| at(p, shift)).collect::<Vec<_>>());
    let channel = Channel::new("uv", Blend::Scheme, values.concat()).unwrap();
    ride.attributes.add_corner_channel(&ride.mesh, &ride.history, &channel, &corners, Seams::Scheme).unwrap();
    ride
}

#[test]
fn each_side_of_a_seam_is_a_boundary_of_its_chart() {
    let mut ride = two_charts();
    assert_eq!(ride.corner("uv").values().len(), 8);
    // The left square by itself.
    let mut left = shapes::grid(1, 1);
    let mut history = History::new(&left, Keep::default());
    let subdivider = Subdivider::new(Loop::default(), Uniform);
    for _ in 0..3 {
        ride.step(&subdivider, &Selection::empty());
        let (scratch, control) = (&mut Scratch::new(), &mut Control::default());
        subdivider.step(&mut left, &mut history, &Selection::empty(), scratch, control).unwrap();
    }
    let key = |value: &[f64]| [value[0].to_bits(), value[1].to_bits()];
    let mut alone: Vec<_> = left.positions().iter().map(|p| key(&[p.x, p.y])).collect();
    let uv = ride.corner("uv").values();
    let mut in_chart: Vec<_> = uv.values().filter(|uv| uv[0] < 5.0).map(key).collect();
    alone.sort_unstable();
    in_chart.sort_unstable();
    assert_eq!(in_chart, alone);
    // Inside, where the seam is not felt, the mesh of both squares has moved otherwise.
    assert!(ride.mesh.positions().iter().any(|p| p.x < 1.0 && !alone.contains(&key(&[p.x, p.y]))));
}

#[test]
fn a_chart_that_touches_itself_in_a_point_does_so_after_refinement() {
    // Around vertex 4, the middle, the two squares at corners 0 and 8 have values of their own, but at 4 all are one.
    let mut ride = Ride::new(&shapes::grid(2, 2));
    let own = |t: vvmesh::Triangle| {
        let center = corner_positions(&ride.mesh, t).into_iter().sum::<DVec3>() / 3.0;
        if (center.x < 1.0) == (center.y < 1.0) { 0 } else { 9 }
    };
    let corner = |v: VertexId, shift: u32| if v.index() == 4 { 4 } else { v.index() as u32 + shift };
    let corners: Vec<_> = ride.mesh.triangles().map(|t| Some(t.corners().map(|v| corner(v, own(t))))).collect();
    let values = [ride.mesh.positions(), ride.mesh.positions()].concat().iter().map(|p| p.to_array()).collect();
    let channel = Channel::new("uv", Blend::Scheme, values).unwrap();
    ride.attributes.add_corner_channel(&ride.mesh, &ride.history, &channel, &corners, Seams::Scheme).unwrap();
    let middle = VertexId::new(4);
    for _ in 0..2 {
        ride.step(&Subdivider::new(Loop::default(), Uniform), &Selection::empty());
        let mut seen = 0;
        for (triangle, values) in ride.mesh.triangles().zip(ride.values_at_corners("uv")) {
            let place = triangle.corners().iter().position(|&v| v == middle);
            seen += place.map_or(0, |k| usize::from(values.unwrap()[k] == [1.0, 1.0, 0.0]));
        }
        assert_eq!(seen, ride.mesh.ring(middle).valence());
    }
}

#[test]
fn faces_without_values_have_none_later() {
    for subdivider in subdividers(&Loop::default().into()) {
        let mut ride = two_charts();
        let channel = Channel::new("half", Blend::Scheme, vec![[1.0], [2.0], [3.0]]).unwrap();
        let corners = [Some([0, 1, 2]), None, None, Some([2, 2, 0])];
        ride.attributes.add_corner_channel(&ride.mesh, &ride.history, &channel, &corners, Seams::Scheme).unwrap();
        ride.attributes.add_face_labels(&ride.mesh, "number", &[0, 1, 2, 3]).unwrap();
        for _ in 0..3 {
            ride.step(&subdivider, &[0, 1, 3, 4].map(VertexId::new).into_iter().collect());
            let labels = ride.attributes.face_labels("number", &ride.mesh).unwrap();
            let has_values: Vec<bool> = ride.corner("half").faces(&ride.mesh).map(|face| face.is_some()).collect();
            assert!(labels.iter().zip(&has_values).all(|(label, &has_values)| has_values == [0, 3].contains(label)));
        }
    }
}

#[test]
fn creases_and_corners_of_the_mesh_hold_in_its_charts() {
    let mut ride = Ride::new(&shapes::icosahedron());
    ride.add_positions(Blend::Scheme);
    // Tagged after the channel was added.
    let [a, b] = ride.mesh.edges().next().unwrap().ends();
    assert!(ride.mesh.set_sharp(Edge::new(a, b), true) && ride.mesh.set_corner(VertexId::new(7), true));
    for _ in 0..2 {
        ride.step(&Subdivider::new(Loop::default(), Uniform), &Selection::empty());
    }
    for (triangle, values) in ride.mesh.triangles().zip(ride.values_at_corners("position")) {
        assert_eq!(values, Some(triangle.corners().map(|v| ride.mesh.position(v).to_array().to_vec())));
    }
}

#[test]
fn values_go_to_the_limit_with_the_positions() {
    let limit = LoopLimit::default();
    let mut ride = Ride::new(&shapes::grid(3, 2));
    ride.add_positions(Blend::Scheme);
    ride.step(&Subdivider::new(Loop::default(), Uniform), &Selection::empty());
    ride.attributes.move_to_limit(&ride.mesh, &limit);
    for (triangle, values) in ride.mesh.triangles().zip(ride.values_at_corners("position")) {
        for (v, value) in triangle.corners().into_iter().zip(values.unwrap()) {
            let mut mask = Mask::default();
            limit.mask(ride.mesh.neighborhood(), v, &mut mask);
            let expected = mask.apply(|w| ride.mesh.position(w)).to_array();
            assert_eq!(value, expected);
            assert_eq!(ride.attributes.vertex_channel("position").unwrap().value(v.index()), expected);
        }
    }
}

// Spot.

struct Spot {
    mesh: Mesh,
    history: History,
    obj: ObjAttributes,
    selection: Selection,
}

impl Spot {
    fn new(rules: ObjRules) -> Option<Self> {
        let loaded = io::read(common::meshes()?.join("models/spot_control_mesh.obj")).unwrap();
        let cut = loaded.faces.triangulate();
        let said = loaded.attributes.of_triangles(&loaded.faces, &cut);
        let mesh = Mesh::from_triangles(loaded.faces.positions.clone(), &cut.triangles).unwrap();
        let history = History::new(&mesh, Keep { names: true, certificate: false });
        let faces = FaceList::from_triangles(loaded.faces.positions, &cut.triangles);
        let obj = ObjAttributes::new(&mesh, &history, &faces, said, rules).unwrap();
        Some(Self { mesh, history, obj, selection: (0..60).map(VertexId::new).collect() })
    }

    fn step(&mut self, subdivider: &Subdivider) {
        let Self { mesh, history, obj, selection } = self;
        let (scratch, control) = (&mut Scratch::new(), &mut Control::default());
        *selection = obj.step(subdivider, mesh, history, selection, scratch, control).unwrap().selection;
    }

    fn texture(&self) -> &CornerChannel {
        self.obj.attributes().corner_channel("texture").unwrap()
    }

    fn uv(&self, chart_vertex: u32) -> DVec2 {
        let value = self.texture().values().value(chart_vertex as usize);
        DVec2::new(value[0], value[1])
    }

    /// For each edge of the mesh the pairs of chart vertices over its ends, one for each side that has a face.
    fn sides(&self) -> BTreeMap<Edge, Vec<[u32; 2]>> {
        let mut sides = BTreeMap::<Edge, Vec<[u32; 2]>>::new();
        for (triangle, face) in self.mesh.triangles().zip(self.texture().faces(&self.mesh)) {
            let (corners, face) = (triangle.corners(), face.expect("all faces are textured"));
            for (k, next) in [(0, 1), (1, 2), (2, 0)] {
                let over = if corners[k] < corners[next] { [face[k], face[next]] } else { [face[next], face[k]] };
                sides.entry(Edge::new(corners[k], corners[next])).or_default().push(over);
            }
        }
        sides
    }

    /// The edges along which the sides differ, with both.
    fn seams(&self) -> BTreeMap<Edge, [[u32; 2]; 2]> {
        let sides = self.sides().into_iter();
        let seams = sides.filter_map(|(edge, sides)| match sides[..] {
            [one, other] if one != other => Some((edge, [one, other])),
            _ => None,
        });
        seams.collect()
    }

    /// The length of all seams in texture coordinates, both sides together, and the signed area of all faces.
    fn seam_length_and_area(&self) -> [f64; 2] {
        let length = |[a, b]: [u32; 2]| self.uv(a).distance(self.uv(b));
        let lengths = self.seams().into_values().flatten().map(length).sum();
        let area = |face: [u32; 3]| {
            let [a, b, c] = face.map(|k| self.uv(k));
            (b - a).perp_dot(c - a) / 2.0
        };
        [lengths, self.texture().faces(&self.mesh).flatten().map(area).sum()]
    }

    /// For each vertex the texture coordinates at the corners around it, in the order of its ring.
    fn around(&self) -> Vec<Vec<[u64; 2]>> {
        let faces: BTreeMap<_, _> = self.mesh.triangles().zip(self.texture().faces(&self.mesh)).collect();
        let at = |v: VertexId, triangle: vvmesh::Triangle| {
            let place = triangle.corners().iter().position(|&w| w == v).unwrap();
            self.uv(faces[&triangle].unwrap()[place]).to_array().map(f64::to_bits)
        };
        let around = |v| self.mesh.rotation().triangles_around(v).map(|triangle| at(v, triangle)).collect();
        self.mesh.vertices().map(around).collect()
    }
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs()
}

#[test]
fn the_seams_of_spot_stay_whole() {
    for scheme in [AnyScheme::from(Loop::default()), Butterfly.into()] {
        for (method, subdivider) in exact(&scheme).iter().enumerate() {
            // On a hierarchy edges are halved as they were at their level, which may not be the one that is shown.
            let halves_what_is_shown = method < 3 && matches!(scheme, AnyScheme::Loop(_));
            let Some(mut spot) = Spot::new(ObjRules::default()) else { return };
            let first = spot.seams();
            assert!(first.len() > 50, "spot has seams");
            let [mut length, area] = spot.seam_length_and_area();
            for _ in 0..3 {
                let before = spot.seams();
                let values_before = spot.texture().values().clone();
                spot.step(subdivider);
                let seams = spot.seams();
                // Seams lie on seams: an edge is one if and only if it is one of before, or half of one.
                let mut halves = 0;
                for (edge, sides) in &seams {
                    let [a, b] = edge.ends();
                    // Over the ends of an edge lie the ends of its sides.
                    for (over, below) in sides.iter().flat_map(|side| [(side[0], a), (side[1], b)]) {
                        assert_eq!(spot.texture().vertex_below(over as usize), below);
                    }
                    if before.contains_key(edge) {
                        continue;
                    }
                    let made = spot.history.parents(b.max(a)).unwrap();
                    let ends: Vec<VertexId> = made.vertices().collect();
                    assert!(before.contains_key(&Edge::new(ends[0], ends[1])), "a seam where none was");
                    halves += 1;
                    // A new vertex is the mean of the ends on each side by itself, but for Butterfly's longer rule.
                    let x = usize::from(b > a);
                    for side in sides.iter().filter(|_| halves_what_is_shown) {
                        let old = before[&Edge::new(ends[0], ends[1])];
                        let mean = |[p, q]: [u32; 2]| {
                            let at = |k: u32| DVec2::from_slice(values_before.value(k as usize));
                            at(p).midpoint(at(q))
                        };
                        let is_mean = |old| spot.uv(side[x]).distance(mean(old)) < 1e-15;
                        assert!(old.into_iter().any(is_mean), "{edge:?}");
                    }
                }
                let kept = before.keys().filter(|edge| seams.contains_key(edge)).count();
                assert_eq!(halves, 2 * (before.len() - kept));
                assert!(method > 0 || kept == 0);
                // An edge inside a chart has one chart edge, and all chart vertices are used.
                let sides = spot.sides();
                assert_eq!(sides.len(), spot.mesh.edge_count());
                let mut used: Vec<u32> = sides.values().flatten().flatten().copied().collect();
                used.sort_unstable();
                used.dedup();
                assert_eq!(used.len(), spot.texture().values().len());
                let [now, _] = spot.seam_length_and_area();
                if matches!(scheme, AnyScheme::Loop(_)) {
                    assert!(now < length && now > 0.8 * length, "boundary curves are smoothed: {now} of {length}");
                }
                length = now;
            }
            let [_, now] = spot.seam_length_and_area();
            assert!((now - area).abs() < 0.1 * area.abs(), "{now} of {area}");
        }
    }
}

#[test]
fn linear_texture_coordinates_of_spot_keep_lengths_and_area() {
    for rules in [
        ObjRules { texture: Blend::Linear, ..ObjRules::default() },
        ObjRules { seams: Seams::Linear, ..ObjRules::default() },
    ] {
        for subdivider in exact(&Loop::default().into()) {
            let Some(mut spot) = Spot::new(rules) else { return };
            let [length, area] = spot.seam_length_and_area();
            for _ in 0..3 {
                spot.step(&subdivider);
                let [now, area_now] = spot.seam_length_and_area();
                assert!(close(now, length), "{now} of {length}");
                // Charts keep their outline either way, and so their area.
                assert!(close(area_now, area), "{area_now} of {area}");
            }
        }
    }
}

#[test]
fn incremental_texture_coordinates_are_those_of_uniform_refinement() {
    for scheme in [AnyScheme::from(Loop::default()), Butterfly.into()] {
        let (Some(mut incremental), Some(mut uniform)) =
            (Spot::new(ObjRules::default()), Spot::new(ObjRules::default()))
        else {
            return;
        };
        for _ in 0..3 {
            incremental.step(&Subdivider::new(scheme.clone(), Incremental::new(1).unwrap()));
            uniform.step(&Subdivider::new(scheme.clone(), Uniform));
            let twins = incremental.history.same_names(&uniform.history).unwrap();
            let (here, there) = (incremental.around(), uniform.around());
            for &v in incremental.selection.vertices() {
                let twin = twins[v.index()].expect("a selected vertex is refined in both");
                assert_eq!(here[v.index()], there[twin.index()], "{v}");
            }
        }
    }
}

// Files.

fn refined(text: &str, rules: ObjRules, levels: usize) -> (FaceList, FaceAttributes) {
    let loaded = io::read_obj(text.as_bytes()).unwrap();
    let mut mesh = Mesh::from_face_list(&loaded.faces).unwrap();
    let mut history = History::new(&mesh, Keep::default());
    let mut obj = ObjAttributes::new(&mesh, &history, &loaded.faces, loaded.attributes, rules).unwrap();
    let subdivider = Subdivider::new(Midpoint, Uniform);
    for _ in 0..levels {
        let (scratch, control) = (&mut Scratch::new(), &mut Control::default());
        obj.step(&subdivider, &mut mesh, &mut history, &Selection::empty(), scratch, control).unwrap();
    }
    obj.finish(&mesh)
}

/// A roof of two slopes, each with a normal, a group and a material; the first face comes before all that.
const ROOF: &str = "mtllib roof.mtl\nv 0 0 0 1 0 0\nv 1 0 1 0 1 0\nv 0 1 0 1 0 0\nv 1 1 1\nv 2 0 0 0 0 1\n\
    v 2 1 0 0 0 1\nvn -1 0 1\nvn 1 0 1\nvn 1 0 1\nvt 5 5\nvt 0 0\nf 1//1 2//1 3//1\nusemtl red\ng left\nf 2//1 4//1 3//1\n\
    g right\nusemtl blue\ns 1\nf 5//2 6//3 2//2\ng left\nusemtl red\ns off\nf 6//2 4//2 2//3\n";

#[test]
fn faces_keep_their_groups_in_the_order_of_the_file() {
    let (faces, said) = refined(ROOF, ObjRules::default(), 2);
    let of = |face| (said.material(face), said.groups(face).collect::<Vec<_>>(), said.smoothing_group(face));
    assert_eq!(faces.face_count(), 64);
    for face in 0..64 {
        let expected = match face / 16 {
            0 => (None, vec![], 0),
            1 | 3 => (Some("red"), vec!["left"], 0),
            _ => (Some("blue"), vec!["right"], 1),
        };
        assert_eq!(of(face), expected, "face {face}");
    }
    assert_eq!(said.material_libraries, ["roof.mtl"]);
    let colors = &said.vertex_colors;
    assert_eq!([colors[0], colors[3]], [Some([1.0, 0.0, 0.0]), None]);
    // Half way between 0 and 1; and beside the vertex without a colour.
    let at = |p: DVec3| faces.positions.iter().position(|&q| q == p).unwrap();
    assert_eq!(colors[at(DVec3::new(0.5, 0.0, 0.5))], Some([0.5, 0.5, 0.0]));
    assert_eq!(colors[at(DVec3::new(1.0, 0.5, 1.0))], None);
}

#[test]
fn hard_edges_of_a_file_stay_hard_and_no_others_are() {
    let (faces, said) = refined(ROOF, ObjRules::default(), 1);
    assert_eq!(said.normals.len(), 2 * 9, "each slope has its own");
    for face in 0..faces.face_count() {
        let center = faces.face(face).iter().map(|&v| faces.positions[v as usize].x).sum::<f64>() / 3.0;
        let expected = DVec3::new(if center < 1.0 { -1.0 } else { 1.0 }, 0.0, 1.0).normalize();
        for corner in faces.corner_range(face) {
            assert!(said.normals[said.normal_index(corner).unwrap()].distance(expected) < 1e-15);
        }
    }
    // Without hard edges the ridge has one normal.
    let soft = ROOF.replace("//2", "//1").replace("//3", "//1");
    let (faces, said) = refined(&soft, ObjRules::default(), 1);
    let ridge = faces.positions.iter().position(|&p| p == DVec3::new(1.0, 0.5, 1.0)).unwrap() as u32;
    let corners = faces.faces().flatten().enumerate().filter(|&(_, &v)| v == ridge).map(|(k, _)| k);
    let up = |corner| said.normals[said.normal_index(corner).unwrap()].distance(DVec3::Z) < 1e-15;
    assert!(corners.clone().count() == 6 && corners.clone().all(up));
}

#[test]
fn limit_normals_differ_across_creases() {
    let mut mesh = shapes::octahedron();
    let equator: Vec<Edge> = mesh.edges().filter(|e| e.ends().iter().all(|&v| mesh.position(v).z == 0.0)).collect();
    equator.into_iter().for_each(|edge| assert!(mesh.set_sharp(edge, true)));
    let history = History::new(&mesh, Keep::default());
    let rules = ObjRules { normals: NormalRule::Limit(LoopLimit::default().into()), ..ObjRules::default() };
    let list = mesh.to_face_list();
    let mut obj = ObjAttributes::new(&mesh, &history, &list, FaceAttributes::default(), rules).unwrap();
    let limit = LoopLimit::default();
    obj.move_to_limit(&mesh, &limit);
    let old = mesh.clone();
    mesh.positions_mut().copy_from_slice(&limit.positions(&old));
    let (faces, said) = obj.finish(&mesh);
    for (corner, &v) in faces.faces().flatten().enumerate() {
        let normal = said.normals[said.normal_index(corner).unwrap()];
        let is_upper = faces.face(corner / 3).iter().any(|&v| mesh.positions()[v as usize].z > 0.0);
        assert_eq!(normal.z > 0.0, is_upper, "on its side");
        let id = VertexId::new(v as usize);
        let sides: Vec<_> = (0..limit.side_count(old.neighborhood(), id)).map(|k| limit.normal(&old, id, k)).collect();
        assert!(sides.contains(&Some(normal)));
    }
}

#[test]
fn nothing_is_lost_without_a_step_and_what_is_lost_by_one_is_told() {
    let text = ROOF.replace("f 1//1 2//1 3//1", "f 1/2/1 2/2/1 3//1").replace("f 5//2", "f 5");
    let loaded = io::read_obj(text.as_bytes()).unwrap();
    let (faces, said) = refined(&text, ObjRules::default(), 0);
    assert_eq!((&faces, &said), (&loaded.faces, &loaded.attributes));

    let mesh = Mesh::from_face_list(&loaded.faces).unwrap();
    let history = History::new(&mesh, Keep::default());
    let rules = ObjRules::default();
    let obj = ObjAttributes::new(&mesh, &history, &loaded.faces, loaded.attributes.clone(), rules).unwrap();
    let told = obj.left_out();
    assert_eq!([told.partly_textured, told.partly_normal, told.unused_texture, told.uncolored], [1; 4]);
    let (_, said) = refined(&text, rules, 1);
    assert!(said.texture_coordinates.is_empty());
    assert!((0..48).all(|corner| said.texture_index(corner).is_none()));

    // Normals on demand, or not at all.
    let none = refined(ROOF, ObjRules { normals: NormalRule::Drop, ..rules }, 0).1;
    assert!(none.normals.is_empty() && (0..12).all(|corner| none.normal_index(corner).is_none()));
    let anew =
        refined("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ObjRules { normals: NormalRule::Recompute, ..rules }, 0).1;
    assert_eq!(anew.normals, [DVec3::Z; 3]);

    let other = shapes::octahedron();
    let history = History::new(&other, Keep::default());
    assert!(ObjAttributes::new(&other, &history, &loaded.faces, loaded.attributes, rules).is_err());
}
