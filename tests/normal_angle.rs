//! Faces by the angle between normals, one threshold a level: the tables of the paper on an iterative process for adaptive
//! Butterfly subdivision, and `papers/normal-angle.md`.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use common::load::load;
use common::run::Run;
use vvmesh::adaptive::{Simple, SimpleMoving};
use vvmesh::check::mesh_conformity;
use vvmesh::glam::DVec3;
use vvmesh::query::measure::dihedral_angle_rad;
use vvmesh::scheme::Butterfly;
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Expression, NormalAngle, Selection};
use vvmesh::split::Diagonal;
use vvmesh::subdivide::Subdivider;
use vvmesh::{Angle, Mesh, Triangle, shapes};

const DIAGONALS: [(&str, Diagonal); 4] = [
    ("longest", Diagonal::Longest),
    ("shortest", Diagonal::Shortest),
    ("valence", Diagonal::Valence),
    ("id", Diagonal::ById),
];

fn above(deg: f64) -> NormalAngle {
    NormalAngle::new(Angle::from_deg(deg)).unwrap()
}

fn select(criterion: &impl Criterion, mesh: &Mesh) -> Selection {
    criterion.select(mesh, &mut Scratch::new()).unwrap()
}

/// The number of faces before each step and after the last.
fn counts(mesh: &Mesh, subdivider: &Subdivider, degrees: &[f64]) -> Vec<usize> {
    let mut run = Run::new(mesh);
    let mut counts = vec![mesh.face_count()];
    for &deg in degrees {
        run.step(subdivider, &select(&above(deg), &run.mesh));
        assert!(mesh_conformity(&run.mesh, None).is_conforming());
        counts.push(run.mesh.face_count());
    }
    counts
}

fn simple(diagonal: Diagonal) -> Subdivider {
    Subdivider::new(Butterfly, Simple).with_diagonal(diagonal)
}

/// The model of a paper, or a stand-in with as many faces.
fn model(name: &str) -> Option<Mesh> {
    Some(load(&common::meshes()?.join("papers").join(name)))
}

fn assert_told(line: &str) {
    let page = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/papers/normal-angle.md")).unwrap();
    assert!(page.contains(line), "papers/normal-angle.md does not have `{line}`");
}

fn row(counts: &[usize]) -> String {
    counts.iter().map(usize::to_string).collect::<Vec<_>>().join(" | ")
}

#[test]
fn table_1_with_every_diagonal() {
    let Some(eight) = model("eight_1536.off") else { return };
    for (name, diagonal) in DIAGONALS {
        let found = counts(&eight, &simple(diagonal), &[10.0, 20.0, 30.0, 30.0]);
        assert_eq!(found, [1536, 6068, 6192, 6232, 6272], "{name}");
        assert_told(&format!("| here, any diagonal | {} |", row(&found)));
    }
}

#[test]
fn table_2_as_far_as_it_can_be_made() {
    let Some(eight) = model("eight_1536.off") else { return };
    for (name, diagonal) in DIAGONALS {
        let found = counts(&eight, &simple(diagonal), &[20.0; 4]);
        match name {
            "longest" => assert_eq!(found, [1536, 3624, 4268, 5104, 6148]),
            "shortest" => assert_eq!(found, [1536, 3624, 3780, 3904, 4044]),
            _ => {}
        }
        assert_told(&format!("| here, `{name}` | {} |", row(&found)));
    }
    // Where the fourth number of the paper may come from.
    assert_eq!(counts(&eight, &simple(Diagonal::Longest), &[15.0])[1], 5864);
}

/// Of the models of table 4 only the numbers of faces are known.
#[test]
fn table_4_on_other_models() {
    for (model_name, constant, growing) in [
        ("torso_1678", [15.0, 15.0], [15.0, 20.0]),
        ("dragon_2730", [30.0, 30.0], [30.0, 35.0]),
        ("foot_240", [15.0, 15.0], [10.0, 20.0]),
    ] {
        let Some(mesh) = model(&format!("{model_name}.off")) else { return };
        for (name, diagonal) in DIAGONALS {
            let [original, modified] = [constant, growing].map(|degrees| counts(&mesh, &simple(diagonal), &degrees));
            assert!(modified[2] < original[2], "{model_name}, {name}");
            if diagonal == Diagonal::Longest {
                assert_told(&format!("| {model_name} | here | {} | {} |", row(&original[1..]), row(&modified[1..])));
            }
        }
        // A greater angle never makes more faces of the same mesh.
        let after_one = |deg: u8| counts(&mesh, &simple(Diagonal::Longest), &[deg.into()])[1];
        let found: Vec<usize> = (1..12).map(|k| after_one(5 * k)).collect();
        assert!(found.is_sorted_by(|fewer, more| fewer >= more), "{model_name}: {found:?}");
    }
}

/// Faces are selected by the greatest angle at their edges, strictly, and those without area are not.
#[test]
fn a_face_is_selected_by_its_greatest_angle() {
    let mesh = shapes::torus(9, 6, 2.0, 0.7);
    let greatest = |face: Triangle| {
        let angles = face.edges().into_iter().filter_map(|edge| dihedral_angle_rad(&mesh, edge));
        angles.fold(0.0, f64::max)
    };
    for deg in [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 90.0, 180.0] {
        let expected: Selection =
            mesh.triangles().filter(|&face| greatest(face) > Angle::from_deg(deg).rad()).collect();
        assert_eq!(select(&above(deg), &mesh), expected, "{deg}");
        let neighbors = |face: &Triangle| {
            let corners = face.corners();
            expected.contains_face(*face)
                || [[0, 1], [1, 2], [2, 0]].into_iter().any(|[k, l]| {
                    let (a, b) = (corners[k], corners[l]);
                    mesh.rotation().right_of(a, b).is_some_and(|c| expected.contains_face(Triangle::new(b, a, c)))
                })
        };
        let with_neighbors: Selection = mesh.triangles().filter(neighbors).collect();
        assert_eq!(select(&above(deg).and_neighbors(), &mesh), with_neighbors, "{deg}");
    }
    // A square folded by a right angle: both faces at 90 degrees, none above.
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let fold = |positions: [DVec3; 4]| Mesh::from_triangles(positions.to_vec(), &[[0, 1, 2], [1, 0, 3]]).unwrap();
    assert_eq!(select(&above(89.9), &fold(corners)).len(), 2);
    assert!(select(&above(90.0), &fold(corners)).is_empty());
    let [a, b, c, _] = corners;
    assert!(select(&above(0.0), &fold([a, b, c, 0.5 * b])).is_empty());
    assert!(NormalAngle::new(Angle::from_deg(180.5)).is_err() && NormalAngle::new(Angle::from_deg(f64::NAN)).is_err());
}

/// An edge that hardly moves is not split on any side; more of them are not for a greater movement.
#[test]
fn edges_that_hardly_move_are_not_split() {
    let Some(eight) = model("eight_1536.off") else { return };
    let selection = select(&above(10.0), &eight);
    let all_edges = Run::new(&eight).step(&simple(Diagonal::Longest), &selection).split_edges;
    let mut before = all_edges;
    for least in [0.0, 0.0005, 0.001, 0.002, 1.0] {
        let subdivider = Subdivider::new(Butterfly, SimpleMoving::new(least).unwrap());
        for selection in [selection.clone(), selection.to_vertices(), eight.edges().collect()] {
            let mut run = Run::new(&eight);
            let step = run.step(&subdivider, &selection);
            assert!(mesh_conformity(&run.mesh, None).is_conforming(), "{least}");
            // What was made moved so far, and what was not would not have.
            for (x, [a, b]) in
                (eight.vertex_count()..run.mesh.vertex_count()).map(vvmesh::VertexId::new).map(|x| (x, ends(&run, x)))
            {
                let middle = eight.position(a).midpoint(eight.position(b));
                assert!(run.mesh.position(x).distance(middle) > least - 1e-12, "{least}");
            }
            if selection.is_of_vertices() || selection.len() == eight.edge_count() {
                continue;
            }
            assert!(step.split_edges <= before, "{least}");
            before = step.split_edges;
            // What follows selected faces covers as many corners.
            assert!(selection.vertices().iter().all(|&v| step.selection.contains(v)), "{least}");
        }
    }
    assert_eq!(before, 0);
    let none = Run::new(&eight).step(&Subdivider::new(Butterfly, SimpleMoving::new(0.0).unwrap()), &selection);
    assert_eq!(none.split_edges, all_edges);
    assert!([f64::NAN, f64::INFINITY, -1e-9].into_iter().all(|least| SimpleMoving::new(least).is_err()));
}

/// The ends of the edge that a vertex splits.
fn ends(run: &Run, x: vvmesh::VertexId) -> [vvmesh::VertexId; 2] {
    match run.history.parents(x) {
        Some(vvmesh::step::Lineage::Edge(ends)) => ends,
        other => panic!("{x} was made of {other:?}"),
    }
}

// -------------------------------------------------------------------------------------------- lists of thresholds

fn parse(text: &str) -> Expression {
    Expression::parse(text, &mut |_| Ok("3 1".to_owned())).unwrap_or_else(|error| panic!("{text}: {error}"))
}

#[test]
fn lists_have_a_value_a_level() {
    let expression = parse("normal-angle: 10/ 20 /3e1 +neighbors & !(dihedral:1/2/3 | faces:@ids)");
    assert_eq!(expression.level_count(), Some(3));
    assert_eq!(expression.to_string(), "normal-angle:10/20/3e1+neighbors&!(dihedral:1/2/3|faces:1,3)");
    assert_eq!(parse(&expression.to_string()).to_string(), expression.to_string());
    let levels =
        ["normal-angle:10+neighbors&!(dihedral:1|faces:1,3)", "", "normal-angle:30+neighbors&!(dihedral:3|faces:1,3)"];
    for (level, text) in [(1, levels[0]), (3, levels[2])] {
        let at = expression.at_level(level).unwrap();
        assert_eq!((at.to_string().as_str(), at.level_count()), (text, None));
        let mesh = shapes::octahedron();
        assert_eq!(select(&at, &mesh), select(&parse(text), &mesh));
    }
    assert!(expression.at_level(0).is_none() && expression.at_level(4).is_none());
    let error = expression.select(&shapes::octahedron(), &mut Scratch::new()).unwrap_err();
    assert_eq!(error.to_string(), "the expression has 3 values, one for each level; choose a level");

    let single = parse("normal-angle:10");
    assert_eq!((single.level_count(), single.at_level(77).unwrap().to_string()), (None, "normal-angle:10".to_owned()));
    let many = |count: usize| format!("dihedral:{}", vec!["5"; count].join("/"));
    assert_eq!(parse(&many(255)).level_count(), Some(255));
}

#[test]
fn wrong_lists_are_refused_in_their_column() {
    let many = format!("dihedral:{}", vec!["5"; 361].join("/"));
    for (text, words) in [
        ("normal-angle:", "column 14: expected 1 argument"),
        ("normal-angle:/", "column 14: expected angle"),
        ("normal-angle:10//20", "column 17: expected angle"),
        ("normal-angle:10/", "column 17: expected angle as in `normal-angle:DEG`, found the end"),
        ("normal-angle:/10", "column 14: expected angle"),
        ("normal-angle:10/NaN", "column 17: angle = NaN: expected a finite number"),
        ("normal-angle:10/1e999", "column 17: angle = 1e999: expected a finite number"),
        ("normal-angle:10/ 200", "column 18: angle = 200: expected degrees from 0 to 180"),
        ("normal-angle:10/20|dihedral:1/2/3", "column 29: expected 2 values as in column 14, found 3"),
        ("normal-angle:10+neighbors/20", "column 14: angle = 10+neighbors"),
        ("normal-angle:10+neighbours", "column 14: angle = 10+neighbours"),
        (&many, "column 10: expected at most 255 values, found 361"),
        ("disk:1/2,3", "column 6: V = 1/2"),
        ("sphere:0,0,0,1/2", "column 14: radius = 1/2"),
        ("faces:1/2", "column 7: face = 1/2"),
        ("vertices:1/2", "column 10: vertex = 1/2"),
        ("faces:-1", "column 7: face = -1: expected the number of a face, a whole number from 0"),
        ("faces:99999999999999999999999", "column 7: face = 99999999999999999999999"),
    ] {
        let error = Expression::parse(text, &mut |_| Ok(String::new())).expect_err(text).to_string();
        assert!(error.starts_with(words), "{text}: {error}");
    }
}
