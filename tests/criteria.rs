//! Every criterion that measures, on small meshes whose answer is known by hand.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

use vvmesh::glam::DVec3;
use vvmesh::limit::LoopLimit;
use vvmesh::mesh::Sharpness;
use vvmesh::query::curvature::gaussian;
use vvmesh::scheme::LoopWeights;
use vvmesh::scratch::Scratch;
use vvmesh::select::{Comparison, Criterion, Elements, Expression, Field, LimitError, Selection};
use vvmesh::{Camera, Edge, Length, Mesh, VertexId, shapes};

/// Straight above the middle of `grid(2, 2)`, which it sees at 10 pixels a unit.
const ABOVE: &str = "eye=1,1,10,at=1,1,0,up=0,1,0,fov=90,size=200x200";

fn parse(text: &str) -> Expression {
    let camera: Camera = ABOVE.parse().unwrap();
    Expression::parse_seen(text, camera, &mut |_| unreachable!("no file is named")).unwrap()
}

fn select(text: &str, mesh: &Mesh) -> Selection {
    parse(text).select(mesh, &mut Scratch::new()).unwrap()
}

fn vertices(text: &str, mesh: &Mesh) -> Vec<usize> {
    match select(text, mesh).elements() {
        Elements::Vertices(vertices) => vertices.iter().map(|v| v.index()).collect(),
        other => panic!("{text}: {other:?}"),
    }
}

fn edges(text: &str, mesh: &Mesh) -> Vec<[usize; 2]> {
    match select(text, mesh).elements() {
        Elements::Edges(edges) => edges.iter().map(|edge| edge.ends().map(VertexId::index)).collect(),
        other => panic!("{text}: {other:?}"),
    }
}

fn faces(text: &str, mesh: &Mesh) -> Vec<[usize; 3]> {
    match select(text, mesh).elements() {
        Elements::Faces(faces) => faces.iter().map(|face| face.corners().map(VertexId::index)).collect(),
        other => panic!("{text}: {other:?}"),
    }
}

/// The first text selects every vertex, the second none: the threshold lies between.
fn is_between(mesh: &Mesh, below: &str, above: &str) {
    assert_eq!(select(below, mesh), Selection::all(mesh.vertex_count()), "{below}");
    assert!(select(above, mesh).is_empty(), "{above}");
}

// ------------------------------------------------------------------------------------------------------- vertices

#[test]
fn a_limit_error_takes_the_neighbours_too() {
    // Valence 4 and the neighbours around the origin: 8nα / (3 + 8nα) = 31/55.
    is_between(&shapes::octahedron(), "limit-error:0.5636", "limit-error:0.5637");
    // A flat grid moves at its corners alone, a third of the way to the middle of two neighbours: √2/6 = 0.2357, which is
    // 4.167 % of the diagonal √32.
    let grid = shapes::grid(4, 4);
    let expected = [0, 1, 3, 4, 5, 6, 9, 15, 18, 19, 20, 21, 23, 24];
    for text in ["limit-error:0.2", "limit-error:0.235", "limit-error:4.1%"] {
        assert_eq!(vertices(text, &grid), expected, "{text}");
    }
    for text in ["limit-error:0.236", "limit-error:4.2%"] {
        assert!(select(text, &grid).is_empty(), "{text}");
    }
}

#[test]
fn a_limit_error_knows_features_and_weights() {
    let mut grid = shapes::grid(4, 4);
    for corner in [0, 4, 20, 24].map(VertexId::new) {
        grid.set_corner(corner, true);
    }
    assert!(select("limit-error:0.01", &grid).is_empty(), "corners stay");
    // What is semi-sharp has no limit that is known.
    grid.set_vertex_sharpness(VertexId::new(12), Sharpness::new(0.5).unwrap());
    assert_eq!(vertices("limit-error:1e9", &grid), [6, 7, 11, 12, 13, 17, 18]);
    // Warren: α = 3/32, 8nα = 3, so the distance is 1/2.
    let warren = LoopLimit::new(LoopWeights::Warren);
    let above = |length| LimitError::with(warren, Length::absolute(length).unwrap());
    let mesh = shapes::octahedron();
    assert_eq!(above(0.499).select(&mesh, &mut Scratch::new()), Ok(Selection::all(6)));
    assert!(above(0.501).select(&mesh, &mut Scratch::new()).unwrap().is_empty());
}

#[test]
fn gaussian_curvature_counts_up_and_down() {
    // 2π/3 over 2/√3.
    is_between(&shapes::octahedron(), "curvature:1.813", "curvature:1.814");
    let torus = shapes::torus(24, 12, 2.0, 1.0);
    let values = gaussian(&torus);
    let bent: Vec<usize> = (0..values.len()).filter(|&v| values[v].abs() > 0.5).collect();
    assert_eq!(vertices("curvature:0.5", &torus), bent);
    assert!(!bent.is_empty() && bent.iter().all(|&v| values[v] < 0.0), "only the inside is bent so much");
}

#[test]
fn the_top_of_the_curvature_is_a_share_of_the_vertices() {
    let cases: [(&str, &[usize]); 5] =
        [("0", &[]), ("8", &[]), ("10", &[0]), ("50", &[0, 1, 2]), ("100", &[0, 1, 2, 3, 4, 5])];
    for (percent, expected) in cases {
        assert_eq!(vertices(&format!("curvature-top:{percent}%"), &shapes::octahedron()), expected, "{percent}");
    }
    // The corners of a square turn by a right angle; 45 % of 9 are 4.
    assert_eq!(vertices("curvature-top:45%", &shapes::grid(2, 2)), [0, 2, 6, 8]);
}

#[test]
fn other_measures_of_bending() {
    let mesh = shapes::octahedron();
    is_between(&mesh, "mean-curvature:0.99", "mean-curvature:1.01");
    // atan √2.
    is_between(&mesh, "normal-cone:54.7", "normal-cone:54.8");
    // The neighbours of the top are 1 below it; the diagonal is 2√3.
    is_between(&mesh, "flatness:0.99", "flatness:1.01");
    is_between(&mesh, "flatness:28%", "flatness:29%");
    for text in ["mean-curvature:1e-9", "normal-cone:1e-6", "flatness:1e-9"] {
        assert!(select(text, &shapes::grid(3, 3)).is_empty(), "{text} on a plane");
    }
}

#[test]
fn valences_are_counted() {
    let grid = shapes::grid(2, 2);
    assert_eq!(vertices("valence:4", &grid), [4]);
    assert_eq!(vertices("valence:3", &grid), [1, 3, 4, 5, 7]);
    assert_eq!(vertices("!valence:2", &grid), [2, 6]);
}

#[test]
fn fields_are_compared() {
    let mesh = shapes::octahedron();
    let values = vec![0.0, 1.0, 2.0, 1.0, f64::NAN, -1.0];
    let told = |text: &str| {
        let expression = parse(text).with_fields(&mut |name| (name == "heat").then(|| values.clone()));
        expression.select(&mesh, &mut Scratch::new())
    };
    let cases: [(&str, &[usize]); 6] = [
        ("field:heat>1", &[2]),
        ("field:heat >= 1", &[1, 2, 3]),
        ("field:heat<0", &[5]),
        ("field:heat<=0", &[0, 5]),
        ("!field:heat<=0", &[1, 2, 3, 4]),
        ("field:heat>-1 & field:heat<1", &[0]),
    ];
    for (text, expected) in cases {
        let expected: Selection = expected.iter().copied().map(VertexId::new).collect();
        assert_eq!(told(text), Ok(expected), "{text}");
    }
    assert_eq!(told("field:cold>1").unwrap_err().to_string(), "there is no field `cold`");
    let short = Field::new("heat", Comparison::Above, 1.0).unwrap().of_values([1.0]);
    let error = short.select(&mesh, &mut Scratch::new()).unwrap_err();
    assert_eq!(error.to_string(), "the field `heat` is of 1 vertices, the mesh has 6");
}

// ---------------------------------------------------------------------------------------------------------- edges

const RIM: [[usize; 2]; 8] = [[0, 1], [0, 3], [1, 2], [2, 5], [3, 6], [5, 8], [6, 7], [7, 8]];
const DIAGONALS: [[usize; 2]; 4] = [[0, 4], [1, 5], [3, 7], [4, 8]];

#[test]
fn edges_by_length_boundary_and_tags() {
    let mut grid = shapes::grid(2, 2);
    for text in ["edge-length:1", "edge-length:1.4", "edge-length:49%", "pixel-length:12", "pixel-length:14.1"] {
        assert_eq!(edges(text, &grid), DIAGONALS, "{text}");
    }
    for text in ["edge-length:1.5", "edge-length:51%", "pixel-length:14.2"] {
        assert_eq!(edges(text, &grid), [[0; 2]; 0], "{text}");
    }
    assert_eq!(edges("boundary", &grid), RIM);
    assert_eq!(edges("sharp", &grid), RIM);
    grid.set_sharpness(Edge::new(VertexId::new(4), VertexId::new(5)), Sharpness::new(0.5).unwrap());
    assert_eq!(edges("sharp & !boundary", &grid), [[4, 5]]);
    assert_eq!(edges("boundary", &shapes::octahedron()), [[0; 2]; 0]);
}

#[test]
fn a_silhouette_lies_between_front_and_back() {
    let mesh = shapes::octahedron();
    let equator: Vec<[usize; 2]> =
        mesh.edges().map(|edge| edge.ends().map(VertexId::index)).filter(|ends| ends.iter().all(|&v| v < 4)).collect();
    assert_eq!(equator.len(), 4);
    for text in ["dir=0,0,1", "dir=0,0,-1e-300", "eye=0,0,5", "eye=0,0,-5"] {
        let mut found = edges(&format!("silhouette:{text}"), &mesh);
        found.sort_unstable();
        let mut expected = equator.clone();
        expected.sort_unstable();
        assert_eq!(found, expected, "{text}");
    }
    assert!(select("silhouette:eye=0,0,0", &mesh).is_empty(), "from inside all faces are alike");
    // A plane seen from the side: every edge but those on the boundary.
    assert_eq!(edges("silhouette:dir=1,0,0", &shapes::grid(2, 2)), edges("!boundary", &shapes::grid(2, 2)));
    // Without area there is no side.
    let mut flat = mesh.clone();
    flat.positions_mut().iter_mut().for_each(|p| *p = DVec3::X * p.x);
    assert!(select("silhouette:dir=1,0,0", &flat).is_empty());
}

// ---------------------------------------------------------------------------------------------------------- faces

#[test]
fn faces_by_area_and_pixels() {
    let mut grid = shapes::grid(2, 2);
    for (all, none) in [("area:0.49", "area:0.5"), ("pixel-area:49", "pixel-area:51")] {
        assert_eq!(faces(all, &grid).len(), 8, "{all}");
        assert_eq!(faces(none, &grid), [[0; 3]; 0], "{none}");
    }
    // The last corner goes out to (3, 3): the two faces at it have 1 in place of 1/2.
    grid.positions_mut()[8] = DVec3::new(3.0, 3.0, 0.0);
    let large = faces("area:0.9", &grid);
    assert_eq!(large, [[4, 5, 8], [4, 8, 7]]);
    assert_eq!(faces("pixel-area:90", &grid), large);
    assert_eq!(faces("!area:0.9", &grid).len(), 6);
}

#[test]
fn a_frustum_keeps_what_the_surface_may_reach() {
    // It sees from -0.1 to 1.9 in both directions.
    let camera: Camera = "eye=0.9,0.9,1,at=0.9,0.9,0,up=0,1,0,fov=90,size=100x100".parse().unwrap();
    let frustum = Expression::parse_seen("frustum", camera, &mut |_| unreachable!("no file is named")).unwrap();
    let grid = shapes::grid(6, 6);
    let kept = frustum.select(&grid, &mut Scratch::new()).unwrap();
    let least =
        |corners: [VertexId; 3], k: usize| corners.map(|v| grid.position(v)[k]).into_iter().fold(f64::MAX, f64::min);
    // The ring of a face from 2 on begins at 1, which is seen; that of one from 3 on at 2.
    let expected: Selection =
        grid.triangles().filter(|face| [0, 1].iter().all(|&k| least(face.corners(), k) < 3.0)).collect();
    assert_eq!((kept.len(), &kept), (18, &expected));
    // Seen from behind nothing is left.
    let away: Camera = "eye=0.9,0.9,1,at=0.9,0.9,2,up=0,1,0,fov=90,size=100x100".parse().unwrap();
    let behind = Expression::parse_seen("frustum", away, &mut |_| unreachable!("no file is named")).unwrap();
    assert!(behind.select(&grid, &mut Scratch::new()).unwrap().is_empty());
}

// ---------------------------------------------------------------------------------------------------- in general

#[test]
fn kinds_combine() {
    let grid = shapes::grid(2, 2);
    assert_eq!(edges("boundary | edge-length:1", &grid).len(), 12);
    assert_eq!(edges("boundary & edge-length:1", &grid), [[0; 2]; 0]);
    assert_eq!(faces("area:0.4 & frustum", &grid).len(), 8);
    // In a mix edges are their ends and faces their corners.
    assert_eq!(vertices("boundary & area:0.4", &grid), [0, 1, 2, 3, 5, 6, 7, 8]);
    assert_eq!(vertices("edge-length:1 & valence:5", &grid), [4]);
    assert_eq!(vertices("!(boundary | valence:9)", &grid), [4]);
}

const ALL: [&str; 16] = [
    "limit-error:0.1%",
    "curvature:0",
    "curvature-top:50%",
    "mean-curvature:0",
    "normal-cone:0",
    "flatness:0",
    "valence:3",
    "edge-length:1%",
    "boundary",
    "sharp",
    "silhouette:eye=1,2,3",
    "silhouette:dir=1,2,3",
    "pixel-length:0",
    "area:0",
    "frustum",
    "pixel-area:0",
];

/// What is broken is left out or kept, without a panic; what has no area is neither bent nor large.
#[test]
fn broken_meshes_are_looked_at_too() {
    let with = |change: &dyn Fn(&mut DVec3)| {
        let mut mesh = shapes::octahedron();
        mesh.positions_mut().iter_mut().for_each(change);
        mesh
    };
    let isolated = Mesh::from_triangles(vec![DVec3::ONE; 2], &[]).unwrap();
    let meshes = [
        Mesh::default(),
        isolated,
        with(&|p| *p = DVec3::ONE),
        with(&|p| p.z = 0.0),
        with(&|p| *p *= 1e300),
        with(&|p| *p *= 1e-300),
        with(&|p| p.x = f64::NAN),
        with(&|p| p.y = f64::INFINITY),
    ];
    for mesh in &meshes {
        for text in ALL {
            let _ = select(text, mesh);
        }
    }
    let point = &meshes[2];
    for text in
        ["curvature:0", "mean-curvature:0", "normal-cone:0", "flatness:0", "area:0", "pixel-area:0", "edge-length:0"]
    {
        assert!(select(text, point).is_empty(), "{text} of a point");
    }
}

#[test]
fn expressions_print_as_they_are_read() {
    for text in ALL {
        assert_eq!(parse(text).to_string(), text);
    }
    assert_eq!(parse("field: red >=1e300").to_string(), "field:red>=1e300");
    assert!(parse("all | frustum").uses_camera() && !parse("all").uses_camera());
}
