//! Corner channels and labels of faces under √3 and 4-8.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::collections::{BTreeMap, BTreeSet};

use common::random::{Closed, Picks, Surface, WithBoundary, check};
use common::ride::Ride;
use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::attributes::{Blend, Channel, Seams};
use vvmesh::error::RefineError;
use vvmesh::glam::{DVec2, DVec3};
use vvmesh::query::measure::triangle_area;
use vvmesh::scheme::{AnyScheme, FourEight, Loop, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Edge, Mesh, Triangle, VertexId, io, shapes};

fn uniform(scheme: impl Into<AnyScheme>) -> Subdivider {
    Subdivider::new(scheme, Uniform)
}

/// Refines everything.
fn steps(ride: &mut Ride, subdivider: &Subdivider, count: usize) {
    for _ in 0..count {
        ride.step(subdivider, &Selection::empty());
    }
}

/// The control mesh of Spot with its texture coordinates.
fn spot(blend: Blend, seams: Seams) -> Option<Ride> {
    let loaded = io::read(common::meshes()?.join("models/spot_control_mesh.obj")).unwrap();
    let cut = loaded.faces.triangulate();
    let said = loaded.attributes.of_triangles(&loaded.faces, &cut);
    let mesh = Mesh::from_triangles(loaded.faces.positions.clone(), &cut.triangles).unwrap();
    let mut values = BTreeMap::new();
    for (k, triangle) in cut.triangles.iter().enumerate() {
        let turn = (0..3).min_by_key(|&corner| triangle[corner]).unwrap();
        let corners = [0, 1, 2].map(|corner| (corner + turn) % 3);
        let value = |corner| said.texture_index(3 * k + corner).unwrap() as u32;
        values.insert(corners.map(|corner| triangle[corner]), corners.map(value));
    }
    let corners: Vec<_> =
        mesh.triangles().map(|t| values.get(&t.corners().map(|v| v.index() as u32)).copied()).collect();
    let mut ride = Ride::new(&mesh);
    let channel = Channel::new("uv", blend, said.texture_coordinates.clone()).unwrap();
    ride.attributes.add_corner_channel(&ride.mesh, &ride.history, &channel, &corners, seams).unwrap();
    Some(ride)
}

/// For each edge of the mesh the pairs of chart vertices over its ends, one for each side that has a chart face.
fn sides(ride: &Ride) -> BTreeMap<Edge, Vec<[u32; 2]>> {
    let mut sides = BTreeMap::<Edge, Vec<[u32; 2]>>::new();
    for (triangle, face) in ride.mesh.triangles().zip(ride.corner("uv").faces(&ride.mesh)) {
        let corners = triangle.corners();
        for (face, (k, next)) in face.into_iter().flat_map(|face| [(0, 1), (1, 2), (2, 0)].map(|pair| (face, pair))) {
            let over = if corners[k] < corners[next] { [face[k], face[next]] } else { [face[next], face[k]] };
            sides.entry(Edge::new(corners[k], corners[next])).or_default().push(over);
        }
    }
    sides
}

fn seams(ride: &Ride) -> BTreeSet<Edge> {
    sides(ride)
        .into_iter()
        .filter(|(_, sides)| sides.len() == 2 && sides[0] != sides[1])
        .map(|(edge, _)| edge)
        .collect()
}

/// The charts as a mesh, with the texture coordinates as positions.
fn chart_mesh(ride: &Ride) -> Mesh {
    let positions = ride.corner("uv").values().values().map(|uv| DVec3::new(uv[0], uv[1], 0.0)).collect();
    let faces: Vec<[u32; 3]> = ride.corner("uv").faces(&ride.mesh).flatten().collect();
    Mesh::from_triangles(positions, &faces).unwrap()
}

/// The same points, up to rounding.
fn assert_same_points(one: &[DVec2], other: &[DVec2]) {
    assert_eq!(one.len(), other.len());
    let far = |p: &DVec2| other.iter().all(|q| q.distance(*p) > 1e-12);
    let far: Vec<_> = one.iter().filter(|p| far(p)).collect();
    assert!(far.is_empty(), "{} of {}: {:?}", far.len(), one.len(), &far[..far.len().min(5)]);
}

fn uv(ride: &Ride) -> Vec<DVec2> {
    ride.corner("uv").values().values().map(DVec2::from_slice).collect()
}

// Values.

/// Without seams a corner channel of the positions is the positions, and so is a channel of vertices.
fn positions_ride_along<S: Surface>(surface: S) {
    let mesh = surface.mesh();
    for scheme in [AnyScheme::from(Sqrt3::default()), FourEight::default().into()] {
        let mut ride = Ride::new(&mesh);
        ride.add_positions(Blend::Scheme);
        for _ in 0..4 {
            ride.step(&uniform(scheme.clone()), &Selection::empty());
            for (triangle, values) in ride.mesh.triangles().zip(ride.values_at_corners("position")) {
                let expected = triangle.corners().map(|v| ride.mesh.position(v).to_array().to_vec());
                assert_eq!(values, Some(expected), "{scheme:?}");
            }
            assert_eq!(ride.attributes.faces_across_seams("position", &ride.mesh), Some(0));
        }
    }
}

#[test]
fn positions_ride_along_on_closed_and_open_meshes() {
    check(511, 8, positions_ride_along::<Closed> as fn(_));
    check(512, 8, positions_ride_along::<WithBoundary> as fn(_));
}

/// Every way to choose a region.
fn regional() -> Vec<Subdivider> {
    let schemes = [AnyScheme::from(Sqrt3::default()), FourEight::default().into()];
    let with = |scheme: &AnyScheme| {
        let incremental = [1, 2].map(|rings| Subdivider::new(scheme.clone(), Incremental::new(rings).unwrap()));
        incremental.into_iter().chain([Subdivider::new(scheme.clone(), Simple)]).collect::<Vec<_>>()
    };
    schemes.iter().flat_map(with).collect()
}

/// The same for a region.
fn positions_ride_along_in_regions<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    for subdivider in regional() {
        let mut ride = Ride::new(&mesh);
        ride.add_positions(Blend::Scheme);
        let mut selection = picks.patch(&mesh);
        for _ in 0..4 {
            selection = ride.step(&subdivider, &selection);
            for (triangle, values) in ride.mesh.triangles().zip(ride.values_at_corners("position")) {
                let expected = triangle.corners().map(|v| ride.mesh.position(v).to_array().to_vec());
                assert_eq!(values, Some(expected), "{subdivider:?}");
            }
        }
    }
}

#[test]
fn positions_ride_along_in_regions_of_closed_and_open_meshes() {
    check(513, 8, positions_ride_along_in_regions::<Closed> as fn(_, _));
    check(514, 8, positions_ride_along_in_regions::<WithBoundary> as fn(_, _));
}

#[test]
fn charts_of_spot_are_refined_as_meshes_with_a_boundary() {
    let Some(read) = spot(Blend::Scheme, Seams::Scheme) else { return };
    // With a number for each chart vertex, so that no two touch in a point, which would have to stay.
    let mut ride = Ride::new(&read.mesh);
    let corners: Vec<_> = read.corner("uv").faces(&read.mesh).collect();
    let values = read.corner("uv").values();
    ride.attributes.add_corner_channel(&ride.mesh, &ride.history, values, &corners, Seams::Scheme).unwrap();
    let mut alone = Ride::new(&chart_mesh(&ride));
    for step in 1..=4 {
        steps(&mut ride, &uniform(Sqrt3::default()), 1);
        steps(&mut alone, &uniform(Sqrt3::default()), 1);
        let expected: Vec<DVec2> = alone.mesh.positions().iter().map(|p| p.truncate()).collect();
        assert_same_points(&uv(&ride), &expected);
        if step % 2 == 0 {
            assert_eq!(chart_mesh(&ride).face_count(), alone.mesh.face_count());
        }
    }
}

#[test]
fn every_second_step_of_sqrt3_is_whole_along_the_seams_of_spot() {
    let Some(mut ride) = spot(Blend::Scheme, Seams::Scheme) else { return };
    for _ in 0..2 {
        let before = seams(&ride);
        assert!(before.len() > 50);
        steps(&mut ride, &uniform(Sqrt3::default()), 1);
        // The turned edges have two faces each, and no other lacks values.
        assert_eq!(ride.attributes.faces_across_seams("uv", &ride.mesh), Some(2 * before.len()));
        steps(&mut ride, &uniform(Sqrt3::default()), 1);
        assert_eq!(ride.attributes.faces_across_seams("uv", &ride.mesh), Some(0));
        let after = seams(&ride);
        assert_eq!(after.len(), 3 * before.len());
        // Each old seam is now a line of three: of the ends of a third both, one or none are its ends.
        let is_end = |v: &VertexId| before.iter().any(|edge| edge.ends().contains(v));
        let ends = |edge: &Edge| edge.ends().iter().filter(|v| is_end(v)).count();
        assert_eq!(after.iter().filter(|edge| ends(edge) == 1).count(), 2 * before.len());
    }
    for (edge, sides) in sides(&ride) {
        for [p, q] in sides {
            let below = [p, q].map(|over| ride.corner("uv").vertex_below(over as usize));
            assert_eq!(below, edge.ends());
        }
    }
}

#[test]
fn four_eight_tears_no_seam_of_spot() {
    let Some(mut ride) = spot(Blend::Scheme, Seams::Scheme) else { return };
    for _ in 0..4 {
        let (before, count) = (seams(&ride), ride.mesh.vertex_count());
        steps(&mut ride, &uniform(FourEight::default()), 1);
        assert_eq!(ride.attributes.faces_across_seams("uv", &ride.mesh), Some(0));
        let after = seams(&ride);
        let mut halves = 0;
        for edge in after.iter().filter(|edge| !before.contains(edge)) {
            let middle = edge.ends().into_iter().max().unwrap();
            assert!(middle.index() >= count);
            let ends: Vec<VertexId> = ride.history.parents(middle).unwrap().vertices().collect();
            assert!(before.contains(&Edge::new(ends[0], ends[1])), "a seam where none was");
            halves += 1;
        }
        assert_eq!(halves, 2 * before.difference(&after).count());
        for (edge, sides) in sides(&ride) {
            for [p, q] in sides {
                let below = [p, q].map(|over| ride.corner("uv").vertex_below(over as usize));
                assert_eq!(below, edge.ends());
            }
        }
    }
}

/// The area of all faces in texture coordinates.
fn area(ride: &Ride) -> f64 {
    let uv = uv(ride);
    let of = |face: [u32; 3]| {
        let [a, b, c] = face.map(|k| uv[k as usize]);
        (b - a).perp_dot(c - a) / 2.0
    };
    ride.corner("uv").faces(&ride.mesh).flatten().map(of).sum()
}

#[test]
fn charts_keep_their_outline_if_asked_to() {
    for (scheme, count) in [(AnyScheme::from(Sqrt3::default()), 2), (FourEight::default().into(), 1)] {
        for (blend, rule) in [(Blend::Scheme, Seams::Linear), (Blend::Linear, Seams::Linear)] {
            let Some(mut ride) = spot(blend, rule) else { return };
            let before = area(&ride);
            for _ in 0..2 {
                steps(&mut ride, &uniform(scheme.clone()), count);
                assert!((area(&ride) - before).abs() < 1e-12 * before.abs(), "{scheme:?} {blend:?}");
            }
        }
    }
}

#[test]
fn a_region_that_ends_at_a_seam_is_whole_where_it_is_refined() {
    let Some(whole) = spot(Blend::Scheme, Seams::Scheme) else { return };
    for seed in [0, 40, 90] {
        let mut uniform_ride = spot(Blend::Scheme, Seams::Scheme).unwrap();
        let mut ride = spot(Blend::Scheme, Seams::Scheme).unwrap();
        let subdivider = Subdivider::new(Sqrt3::default(), Incremental::new(2).unwrap());
        let mut selection: Selection = (seed..seed + 20).map(VertexId::new).collect();
        for step in 1..=4 {
            selection = ride.step(&subdivider, &selection);
            steps(&mut uniform_ride, &uniform(Sqrt3::default()), 1);
            if step % 2 == 1 {
                continue;
            }
            let twins = ride.history.same_names(&uniform_ride.history).unwrap();
            let of = |ride: &Ride| -> BTreeMap<Triangle, Option<[u32; 3]>> {
                ride.mesh.triangles().zip(ride.corner("uv").faces(&ride.mesh)).collect()
            };
            let (here, there) = (of(&ride), of(&uniform_ride));
            let is_selected = |v: VertexId| selection.vertices().binary_search(&v).is_ok();
            for (triangle, face) in &here {
                let corners = triangle.corners();
                for (k, v) in corners.into_iter().enumerate().filter(|&(_, v)| is_selected(v)) {
                    let [a, b, c] = corners.map(|v| twins[v.index()].unwrap());
                    let twin = Triangle::new(a, b, c);
                    let place = twin.corners().iter().position(|&w| Some(w) == twins[v.index()]).unwrap();
                    let value = |ride: &Ride, k: u32| ride.corner("uv").values().value(k as usize).to_vec();
                    let [face, other] = [*face, there[&twin]].map(|face| face.expect("it is whole"));
                    assert_eq!(value(&ride, face[k]), value(&uniform_ride, other[place]), "{v} after {step}");
                }
            }
        }
    }
    assert!(!seams(&whole).is_empty());
}

#[test]
fn regions_tear_no_seam_of_spot() {
    for subdivider in regional() {
        let Some(mut ride) = spot(Blend::Scheme, Seams::Scheme) else { return };
        let mut selection: Selection = (20..50).map(VertexId::new).collect();
        for _ in 0..5 {
            selection = ride.step(&subdivider, &selection);
            for (edge, sides) in sides(&ride) {
                for [p, q] in sides {
                    let below = [p, q].map(|over| ride.corner("uv").vertex_below(over as usize));
                    assert_eq!(below, edge.ends());
                }
            }
            let across = ride.attributes.faces_across_seams("uv", &ride.mesh).unwrap();
            let without = ride.corner("uv").faces(&ride.mesh).filter(Option::is_none).count();
            assert_eq!(across, without);
            assert!(across == 0 || matches!(subdivider.scheme(), AnyScheme::Sqrt3(_)));
            assert!(across < ride.mesh.face_count() / 3, "{across} of {}", ride.mesh.face_count());
            assert!(uv(&ride).iter().all(|uv| uv.is_finite()));
        }
    }
}

#[test]
fn faces_without_values_have_none_later() {
    for scheme in [AnyScheme::from(Sqrt3::default()), FourEight::default().into()] {
        let mut ride = Ride::new(&shapes::torus(6, 5, 2.0, 1.0));
        let positions: Vec<[f64; 3]> = ride.mesh.positions().iter().map(|p| p.to_array()).collect();
        let channel = Channel::new("uv", Blend::Scheme, positions).unwrap();
        let corners: Vec<_> = ride.mesh.triangles().map(|t| t.corners().map(|v| v.index() as u32)).collect();
        let corners: Vec<_> = corners.iter().enumerate().map(|(k, corners)| (k % 3 > 0).then_some(*corners)).collect();
        let labels: Vec<u32> = corners.iter().map(|corners| u32::from(corners.is_some())).collect();
        ride.attributes.add_corner_channel(&ride.mesh, &ride.history, &channel, &corners, Seams::Scheme).unwrap();
        ride.attributes.add_face_labels(&ride.mesh, "has", &labels).unwrap();
        for step in 1..=4 {
            steps(&mut ride, &uniform(scheme.clone()), 1);
            let labels = ride.attributes.face_labels("has", &ride.mesh).unwrap();
            let across = ride.attributes.faces_across_seams("uv", &ride.mesh).unwrap();
            if step % 2 == 1 && matches!(scheme, AnyScheme::Sqrt3(_)) {
                assert!(across > 0);
                continue;
            }
            assert_eq!(across, 0);
            let has: Vec<u32> = ride.corner("uv").faces(&ride.mesh).map(|face| u32::from(face.is_some())).collect();
            assert_eq!(has, labels, "{scheme:?}");
        }
    }
}

#[test]
fn channels_may_be_added_on_the_way() {
    for scheme in [AnyScheme::from(Sqrt3::default()), FourEight::default().into()] {
        for before in 1..=2 {
            let mut ride = Ride::new(&shapes::grid(3, 2));
            steps(&mut ride, &uniform(scheme.clone()), before);
            ride.add_positions(Blend::Scheme);
            let numbers: Vec<u32> = (0..ride.mesh.face_count() as u32).collect();
            ride.attributes.add_face_labels(&ride.mesh, "number", &numbers).unwrap();
            steps(&mut ride, &uniform(scheme.clone()), 3);
            for (triangle, values) in ride.mesh.triangles().zip(ride.values_at_corners("position")) {
                let expected = triangle.corners().map(|v| ride.mesh.position(v).to_array().to_vec());
                assert_eq!(values, Some(expected));
            }
            let labels = ride.attributes.face_labels("number", &ride.mesh).unwrap();
            assert_eq!(labels.into_iter().collect::<BTreeSet<u32>>(), numbers.into_iter().collect());
        }
    }
}

#[test]
fn a_channel_that_joins_too_late_is_refused() {
    let mut ride = Ride::new(&shapes::torus(6, 5, 2.0, 1.0));
    let subdivider = Subdivider::new(Sqrt3::default(), Simple);
    let selection: Selection = (0..12).map(VertexId::new).collect();
    let selection = ride.step(&subdivider, &selection);
    let positions = ride.mesh.positions().iter().map(|p| p.to_array()).collect();
    let channel = Channel::new("uv", Blend::Scheme, positions).unwrap();
    let corners: Vec<_> = ride.mesh.triangles().map(|t| Some(t.corners().map(|v| v.index() as u32))).collect();
    ride.attributes.add_corner_channel(&ride.mesh, &ride.history, &channel, &corners, Seams::Scheme).unwrap();
    let Ride { mesh, history, attributes } = &mut ride;
    let (count, control) = (mesh.vertex_count(), &mut Control::default());
    let refused = attributes.step(&subdivider, mesh, history, &selection, &mut Scratch::new(), control);
    assert_eq!((refused.unwrap_err(), mesh.vertex_count()), (RefineError::JoinedLate, count));
}

// Labels.

/// Numbers the faces.
fn number_faces(ride: &mut Ride) -> usize {
    let numbers: Vec<u32> = (0..ride.mesh.face_count() as u32).collect();
    ride.attributes.add_face_labels(&ride.mesh, "number", &numbers).unwrap();
    numbers.len()
}

/// Each face has 3ⁿ descendants after n steps of √3, and those of two steps fill it.
fn faces_descend_by_threes<S: Surface>(surface: S) {
    let mut ride = Ride::new(&surface.mesh());
    let count = number_faces(&mut ride);
    let input = ride.mesh.clone();
    for step in 1..=4u32 {
        steps(&mut ride, &uniform(Sqrt3::default()), 1);
        let labels = ride.attributes.face_labels("number", &ride.mesh).unwrap();
        let mut sizes = vec![0; count];
        labels.iter().for_each(|&label| sizes[label as usize] += 1);
        assert_eq!(sizes, vec![3usize.pow(step); count], "after {step}");
        let across = ride.attributes.faces_across_labels("number", &ride.mesh).unwrap();
        if step % 2 == 1 {
            let inner = input.edge_count() - input.rotation().boundary_edge_count();
            assert_eq!(across, 2 * inner * 3usize.pow(step / 2));
            continue;
        }
        assert_eq!(across, 0);
        // What lies between two labels is as long as the old edge, in thirds.
        let of: BTreeMap<Triangle, u32> = ride.mesh.triangles().zip(labels).collect();
        let mut between = BTreeMap::<[u32; 2], usize>::new();
        for edge in ride.mesh.edges() {
            let [a, b] = edge.ends();
            let label = |v, w| ride.mesh.ring(v).next(w).map(|c| of[&Triangle::new(v, w, c)]);
            if let (Some(one), Some(other)) = (label(a, b), label(b, a)) {
                if one != other {
                    *between.entry([one.min(other), one.max(other)]).or_default() += 1;
                }
            }
        }
        let mut expected = BTreeMap::<[u32; 2], usize>::new();
        let numbers: BTreeMap<Triangle, u32> = input.triangles().zip(0..).collect();
        for edge in input.edges() {
            let [a, b] = edge.ends();
            let label = |v, w| input.ring(v).next(w).map(|c| numbers[&Triangle::new(v, w, c)]);
            if let (Some(one), Some(other)) = (label(a, b), label(b, a)) {
                *expected.entry([one.min(other), one.max(other)]).or_default() += 3usize.pow(step / 2);
            }
        }
        assert_eq!(between, expected);
    }
}

#[test]
fn faces_of_sqrt3_descend_by_threes() {
    check(515, 8, faces_descend_by_threes::<Closed> as fn(_));
    check(516, 8, faces_descend_by_threes::<WithBoundary> as fn(_));
}

/// Where a region is refined as the whole mesh is, its faces have the labels that they have there.
fn labels_do_not_depend_on_the_region<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    let mut ride = Ride::new(&mesh);
    let mut whole = Ride::new(&mesh);
    number_faces(&mut ride);
    number_faces(&mut whole);
    let subdivider = Subdivider::new(Sqrt3::default(), Incremental::new(1).unwrap());
    let mut selection = picks.patch(&mesh);
    for _ in 0..4 {
        selection = ride.step(&subdivider, &selection);
        steps(&mut whole, &uniform(Sqrt3::default()), 1);
        let twins = ride.history.same_names(&whole.history).unwrap();
        let labels = |ride: &Ride| -> BTreeMap<Triangle, u32> {
            ride.mesh.triangles().zip(ride.attributes.face_labels("number", &ride.mesh).unwrap()).collect()
        };
        let (here, there) = (labels(&ride), labels(&whole));
        for (triangle, label) in here {
            let twin = triangle.corners().map(|v| twins[v.index()]);
            if let [Some(a), Some(b), Some(c)] = twin {
                if let Some(other) = there.get(&Triangle::new(a, b, c)) {
                    assert_eq!(label, *other, "{triangle}");
                }
            }
        }
    }
}

#[test]
fn labels_of_sqrt3_do_not_depend_on_the_region() {
    check(517, 10, labels_do_not_depend_on_the_region::<Closed> as fn(_, _));
    check(518, 10, labels_do_not_depend_on_the_region::<WithBoundary> as fn(_, _));
}

/// Under 4-8 a face lies in the face whose label it has.
fn labels_stay_in_place<S: Surface>(surface: S) {
    let mut ride = Ride::new(&surface.mesh());
    let count = number_faces(&mut ride);
    let positions: Vec<[f64; 3]> = ride.mesh.positions().iter().map(|p| p.to_array()).collect();
    ride.attributes.add_vertex_channel(&ride.mesh, Channel::new("flat", Blend::Linear, positions).unwrap()).unwrap();
    let areas = |ride: &Ride| {
        let flat = ride.attributes.vertex_channel("flat").unwrap();
        let mut areas = vec![0.0; count];
        let labels = ride.attributes.face_labels("number", &ride.mesh).unwrap();
        for (triangle, label) in ride.mesh.triangles().zip(labels) {
            let at = triangle.corners().map(|v| DVec3::from_slice(flat.value(v.index())));
            areas[label as usize] += triangle_area(at);
        }
        areas
    };
    let before = areas(&ride);
    for _ in 0..5 {
        steps(&mut ride, &uniform(FourEight::default()), 1);
        for (now, before) in areas(&ride).into_iter().zip(&before) {
            assert!((now - before).abs() <= 1e-12, "{now} of {before}");
        }
        assert_eq!(ride.attributes.faces_across_labels("number", &ride.mesh), Some(0));
    }
}

#[test]
fn labels_of_four_eight_stay_in_place() {
    check(519, 8, labels_stay_in_place::<Closed> as fn(_));
    check(520, 8, labels_stay_in_place::<WithBoundary> as fn(_));
}

#[test]
fn tags_of_the_mesh_come_along_into_its_charts() {
    // Semi-sharp ones fade, and tags may be given on the way.
    let mut ride = Ride::new(&shapes::icosahedron());
    ride.add_positions(Blend::Scheme);
    let edges: Vec<Edge> = ride.mesh.edges().take(4).collect();
    for step in 0..4 {
        let sharpness = vvmesh::mesh::Sharpness::new(1.5 + step as f64).unwrap();
        if step < 3 {
            let edge = if step == 0 { edges[0] } else { ride.mesh.edges().nth(7 * step).unwrap() };
            assert!(ride.mesh.set_sharpness(edge, sharpness));
            assert!(ride.mesh.set_vertex_sharpness(VertexId::new(11 - step), sharpness));
        }
        steps(&mut ride, &uniform(Loop::default()), 1);
        for (triangle, values) in ride.mesh.triangles().zip(ride.values_at_corners("position")) {
            assert_eq!(values, Some(triangle.corners().map(|v| ride.mesh.position(v).to_array().to_vec())));
        }
    }
}
