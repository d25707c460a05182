//! Selections of vertices, of edges and of faces: how they combine, what every method makes of them, and what follows.

mod common;

use common::run::{Run, other_schemes, schemes};
use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::check::mesh_conformity;
use vvmesh::error::{RefineError, SelectError};
use vvmesh::query::measure::{corner_positions, edge_length, triangle_area};
use vvmesh::scheme::{AnyScheme, Midpoint};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Elements, Expression, Faces, Selection};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{AnyMethod, Control, Subdivider};
use vvmesh::{Accuracy, Edge, Mesh, Triangle, VertexId, shapes};

fn id(v: usize) -> VertexId {
    VertexId::new(v)
}

fn subdivider(scheme: &AnyScheme, method: &str) -> Option<Subdivider> {
    let accuracy = Accuracy::new(1e-3).expect("it is above 0");
    Subdivider::of(scheme.clone(), AnyMethod::named(method, Some(accuracy)).expect("a method")).ok()
}

fn faces(selection: &Selection) -> &[Triangle] {
    match selection.elements() {
        Elements::Faces(faces) => faces,
        other => panic!("{other:?} are no faces"),
    }
}

fn edges(selection: &Selection) -> &[Edge] {
    match selection.elements() {
        Elements::Edges(edges) => edges,
        other => panic!("{other:?} are no edges"),
    }
}

/// Faces of which some share edges, some a corner and some nothing.
fn some_faces(mesh: &Mesh) -> Selection {
    mesh.triangles().enumerate().filter(|(k, _)| k % 7 < 2 || k % 11 == 3).map(|(_, face)| face).collect()
}

fn some_edges(mesh: &Mesh) -> Selection {
    mesh.edges().enumerate().filter(|(k, _)| k % 5 == 0 || k % 13 == 4).map(|(_, edge)| edge).collect()
}

/// Whether selected faces and edges are followed by what lies in them.
fn keeps_the_kind(scheme: &AnyScheme, method: &str, selection: &Selection) -> bool {
    let in_four = schemes().iter().any(|(_, other)| other.name() == scheme.name());
    match selection.elements() {
        Elements::Vertices(_) => true,
        Elements::Edges(_) => in_four && method != "dynamic" && !method.starts_with("red-green"),
        Elements::Faces(_) => in_four && method != "dynamic",
    }
}

#[test]
fn every_method_takes_every_kind_and_what_follows_exists() {
    let meshes = [shapes::icosahedron(), shapes::grid(5, 4), shapes::torus(7, 5, 2.0, 1.0)];
    for (name, scheme) in schemes().into_iter().chain(other_schemes()) {
        for method in AnyMethod::NAMES {
            let Some(subdivider) = subdivider(&scheme, method) else { continue };
            for mesh in &meshes {
                for mut selection in [some_faces(mesh), some_edges(mesh)] {
                    let mut run = Run::new(mesh);
                    for level in 1..=3 {
                        let what = format!("{name}, {method}, level {level}");
                        let keeps = keeps_the_kind(&scheme, method, &selection);
                        let step = run.step(&subdivider, &selection);
                        assert!(mesh_conformity(&run.mesh, None).is_conforming(), "{what}");
                        assert_eq!(step.selected, selection.vertices().len(), "{what}");
                        let same_kind = std::mem::discriminant(&step.selection.elements())
                            == std::mem::discriminant(&selection.elements());
                        assert_eq!(same_kind, keeps, "{what}");
                        // A closure is refused if it names what does not exist.
                        let next = step.selection;
                        let found = (|_: &Mesh| next.clone()).select(&run.mesh, &mut Scratch::new());
                        assert_eq!(found.as_ref(), Ok(&next), "{what}");
                        selection = next;
                    }
                }
            }
        }
    }
}

/// Under midpoint refinement nothing leaves its place. So the area of what follows a face is that of the face, and the length
/// of what follows an edge that of the edge.
#[test]
fn what_follows_covers_what_was_selected() {
    let mesh = shapes::grid(6, 6);
    let area = |mesh: &Mesh, of: &Selection| -> f64 {
        faces(of).iter().map(|&face| triangle_area(corner_positions(mesh, face))).sum()
    };
    let length = |mesh: &Mesh, of: &Selection| -> f64 { edges(of).iter().map(|&edge| edge_length(mesh, edge)).sum() };
    for method in ["uniform", "simple", "incremental", "red-green", "red-green-restricted"] {
        let subdivider = subdivider(&Midpoint.into(), method).expect("they go together");
        let (mut run, mut selection) = (Run::new(&mesh), some_faces(&mesh));
        let (before, first) = (area(&mesh, &selection), selection.clone());
        for level in 1..=4 {
            let selected = faces(&selection).len();
            selection = run.step(&subdivider, &selection).selection;
            assert!((area(&run.mesh, &selection) - before).abs() < 1e-12, "{method}, level {level}");
            let count = faces(&selection).len();
            if method.starts_with("red-green") {
                // Leaves are split in four, some of them are bisected, too; what is half a leaf grows to the whole.
                assert!(count >= 4 * first.len(), "{method}, level {level}");
            } else {
                assert_eq!(count, 4 * selected, "{method}, level {level}");
            }
            // Each lies in a face that was selected first.
            let inside = |face: &Triangle| {
                let center = corner_positions(&run.mesh, *face).iter().sum::<vvmesh::glam::DVec3>() / 3.0;
                faces(&first).iter().any(|&old| {
                    let [a, b, c] = corner_positions(&mesh, old);
                    [(a, b), (b, c), (c, a)].iter().all(|&(p, q)| (q - p).cross(center - p).z > 0.0)
                })
            };
            assert!(faces(&selection).iter().all(inside), "{method}, level {level}");
        }
    }
    for method in ["uniform", "simple", "incremental"] {
        let subdivider = subdivider(&Midpoint.into(), method).expect("they go together");
        let (mut run, mut selection) = (Run::new(&mesh), some_edges(&mesh));
        let before = length(&mesh, &selection);
        for level in 1..=4 {
            let selected = edges(&selection).len();
            selection = run.step(&subdivider, &selection).selection;
            assert!((length(&run.mesh, &selection) - before).abs() < 1e-12, "{method}, level {level}");
            assert_eq!(edges(&selection).len(), 2 * selected, "{method}, level {level}");
        }
    }
}

/// Simple triangulation splits exactly the edges of selected faces, or the selected ones; so each adds a face on each side.
#[test]
fn simple_splits_what_is_selected_and_nothing_else() {
    for mesh in [shapes::icosahedron(), shapes::grid(5, 5)] {
        for selection in [some_faces(&mesh), some_edges(&mesh)] {
            let split: Vec<Edge> = match selection.elements() {
                Elements::Faces(faces) => {
                    let mut edges: Vec<Edge> = faces.iter().flat_map(|face| face.edges()).collect();
                    edges.sort_unstable();
                    edges.dedup();
                    edges
                }
                _ => edges(&selection).to_vec(),
            };
            let mut run = Run::new(&mesh);
            let step = run.step(&Subdivider::new(Midpoint, Simple), &selection);
            let sides = |edge: &Edge| {
                let [a, b] = edge.ends();
                if mesh.rotation().is_boundary_edge(a, b) { 1 } else { 2 }
            };
            assert_eq!(step.split_edges, split.len());
            assert_eq!(run.mesh.face_count(), mesh.face_count() + split.iter().map(sides).sum::<usize>());
        }
    }
}

/// Four corners of a square are selected as vertices, but only one of its two faces as a face.
#[test]
fn red_green_splits_selected_faces_alone() {
    let mesh = shapes::grid(3, 3);
    let middle: Vec<Triangle> = {
        let corners: Selection = [5, 6, 9, 10].map(id).into_iter().collect();
        mesh.triangles().filter(|&face| corners.contains_face(face)).collect()
    };
    assert_eq!(middle.len(), 2);
    for method in ["red-green", "red-green-restricted"] {
        let subdivider = subdivider(&Midpoint.into(), method).expect("they go together");
        let one: Selection = [middle[0]].into_iter().collect();
        let mut run = Run::new(&mesh);
        let step = run.step(&subdivider, &one);
        assert_eq!(run.mesh.face_count(), 18 + 3 + 3, "{method}");
        assert_eq!(step.selection.len(), 4, "{method}");
        // What is half of a leaf stands for the leaf.
        let green = run.mesh.triangles().find(|&face| {
            let [a, b, c] = face.corners();
            step.selection.contains(c) && !step.selection.contains_face(face) && a.index() < 16 && b.index() < 16
        });
        let half: Selection = green.into_iter().collect();
        assert_eq!(half.len(), 1);
        let step = run.step(&subdivider, &half);
        // The four of a leaf, of which those beside the first one may be bisected.
        assert!(step.selection.len() >= 4, "{method}");
    }
}

#[test]
fn incremental_is_exact_over_selected_faces() {
    let mesh = shapes::torus(9, 7, 2.0, 0.8);
    for (name, scheme) in schemes() {
        let subdivider = Subdivider::new(scheme.clone(), Incremental::new(1).expect("a ring"));
        let everything = Subdivider::new(scheme, Uniform);
        let (mut run, mut whole) = (Run::new(&mesh), Run::new(&mesh));
        let mut selection: Selection = mesh.triangles().filter(|face| face.corners()[0].index() < 4).collect();
        for _ in 0..3 {
            let step = run.step(&subdivider, &selection);
            whole.step(&everything, &Selection::empty());
            assert_eq!(step.unproven, [], "{name}");
            selection = step.selection;
            let same = run.history.same_names(&whole.history).expect("both keep names");
            for &v in selection.vertices() {
                let twin = same[v.index()].expect("it is in the uniform mesh");
                assert_eq!(run.mesh.position(v), whole.mesh.position(twin), "{name}");
            }
        }
    }
}

#[test]
fn chains_mean_the_same_in_any_order() {
    let mesh = shapes::grid(4, 4);
    let select = |text: &str| {
        let expression = Expression::parse(text, &mut |_| Ok(String::new())).expect(text);
        expression.select(&mesh, &mut Scratch::new()).expect(text)
    };
    let (one, two, some) = ("faces:0,1,2,3", "faces:2,3,9", "vertices:0,1,6,7");
    assert_eq!(select(&format!("{one} & {two}")), select("faces:2,3"));
    assert_eq!(select(&format!("{one} | {two}")), select("faces:0,1,2,3,9"));
    assert_eq!(select(&format!("!({one})")).len(), 32 - 4);
    for sign in ["&", "|"] {
        let orders = [[one, two, some], [one, some, two], [some, one, two]];
        let [first, rest @ ..] = orders.map(|order| select(&order.join(sign)));
        assert!(first.is_of_vertices());
        assert_eq!(rest, [first.clone(), first], "{sign}");
    }
    // Corners that both have, though the faces may not share them.
    let both = format!("{one} & {two} & all");
    assert_eq!(select(&both), select(one).to_vertices().intersection(&select(two).to_vertices()));
}

#[test]
fn vertices_have_the_faces_between_them() {
    let mesh = shapes::octahedron();
    for face in mesh.triangles() {
        let corners: Selection = face.corners().into_iter().collect();
        let inside: Selection = mesh.triangles().filter(|&face| corners.contains_face(face)).collect();
        assert_eq!(inside, [face].into_iter().collect());
        let sides: Selection = face.edges().into_iter().collect();
        assert!(sides.contains_face(face));
        assert!(!Selection::from_iter(mesh.triangles().filter(|&other| other != face)).contains_face(face));
    }
}

#[test]
fn what_does_not_exist_is_refused() {
    let mesh = shapes::octahedron();
    let face = mesh.triangles().next().expect("it has eight");
    let [one, other] = [face.reversed(), Triangle::new(id(0), id(1), id(9))];
    // Opposite vertices of the octahedron have no edge.
    let edge = mesh
        .vertices()
        .flat_map(|a| mesh.vertices().map(move |b| (a, b)))
        .find(|&(a, b)| a != b && !mesh.rotation().has_edge(a, b))
        .map(|(a, b)| Edge::new(a, b))
        .expect("it has three");
    let select = |selection: Selection| (move |_: &Mesh| selection.clone()).select(&mesh, &mut Scratch::new());
    assert_eq!(select([one].into_iter().collect()), Err(SelectError::NoFace(one)));
    assert_eq!(select([edge].into_iter().collect()), Err(SelectError::NoEdge(edge)));
    assert_eq!(select([other].into_iter().collect()), Err(SelectError::NoVertex { vertex: id(9), vertex_count: 6 }));
    assert_eq!(
        Faces::new([3, 8]).select(&mesh, &mut Scratch::new()),
        Err(SelectError::NoFaceNumber { number: 8, face_count: 8 })
    );
    let step = |selection: Selection| {
        let (mut mesh, mut history) = (mesh.clone(), History::new(&mesh, Keep::default()));
        let subdivider = Subdivider::new(Midpoint, Simple);
        subdivider.step(&mut mesh, &mut history, &selection, &mut Scratch::new(), &mut Control::default()).map(|_| ())
    };
    assert_eq!(step([one].into_iter().collect()), Err(RefineError::NoFace(one)));
    assert_eq!(step([edge].into_iter().collect()), Err(RefineError::NoEdge(edge)));
    assert_eq!(step([other].into_iter().collect()), Err(RefineError::NoVertex(id(9))));
    assert_eq!(step([face].into_iter().collect()), Ok(()));
}
