//! Criteria, and expressions read from text.

mod common;

use std::io;
use std::path::{Path, PathBuf};

use common::random::check;
use quickcheck::{Arbitrary, Gen};
use vvmesh::error::{Error, ExpressionError, ExpressionErrorKind, SelectError};
use vvmesh::glam::DVec3;
use vvmesh::scratch::Scratch;
use vvmesh::select::{
    All, Area, Boundary, Criterion, Curvature, CurvatureTop, Dihedral, Disk, EdgeLength, Expression, Faces, Flatness,
    LimitError, MeanCurvature, NormalAngle, NormalCone, Selection, Sharp, Silhouette, Sphere, Valence, Vertices,
};
use vvmesh::{Angle, Length, Mesh, VertexId, shapes};

fn set(indices: &[usize]) -> Selection {
    indices.iter().copied().map(VertexId::new).collect()
}

fn select(criterion: &impl Criterion, mesh: &Mesh) -> Selection {
    criterion.select(mesh, &mut Scratch::new()).expect("all vertices exist")
}

/// Reads an expression that names the one file `ids`.
fn parse_with(text: &str, ids: &str) -> Result<Expression, ExpressionError> {
    Expression::parse(text, &mut |path| {
        if path == Path::new("ids") { Ok(ids.to_owned()) } else { Err(io::Error::other("not there")) }
    })
}

fn parse(text: &str) -> Expression {
    parse_with(text, "").unwrap_or_else(|error| panic!("{text}: {error}"))
}

fn error(text: &str) -> String {
    parse_with(text, "").expect_err(text).to_string()
}

// ------------------------------------------------------------------------------------------------------ criteria

#[test]
fn a_disk_is_what_breadth_first_search_reaches() {
    let mesh = shapes::grid(6, 5);
    let mut scratch = Scratch::new();
    for center in mesh.vertices() {
        // Distances by relaxing all edges until nothing changes.
        let mut distance = vec![usize::MAX; mesh.vertex_count()];
        distance[center.index()] = 0;
        for _ in mesh.vertices() {
            for edge in mesh.edges() {
                let [a, b] = edge.ends().map(VertexId::index);
                distance[a] = distance[a].min(distance[b].saturating_add(1));
                distance[b] = distance[b].min(distance[a].saturating_add(1));
            }
        }
        for radius in (0..12).chain([usize::MAX]) {
            let expected: Selection = mesh.vertices().filter(|v| distance[v.index()] <= radius).collect();
            assert_eq!(Disk::new(center, radius).select(&mesh, &mut scratch), Ok(expected), "{center} {radius}");
        }
    }
}

#[test]
fn a_disk_stays_in_its_component() {
    let corners = (0..7).map(|k| DVec3::new(f64::from(k), f64::from(k * k), 0.0)).collect();
    let mesh = Mesh::from_triangles(corners, &[[0, 1, 2], [3, 4, 5]]).expect("two triangles");
    assert_eq!(select(&Disk::new(VertexId::new(4), usize::MAX), &mesh), set(&[3, 4, 5]));
    assert_eq!(select(&Disk::new(VertexId::new(6), usize::MAX), &mesh), set(&[6]));
}

#[test]
fn a_sphere_takes_its_surface() {
    let mesh = shapes::grid(4, 4);
    let around = |radius| Sphere::new(DVec3::new(2.0, 2.0, 0.0), radius).expect("a sound radius");
    assert_eq!(select(&around(0.0), &mesh), set(&[12]));
    assert_eq!(select(&around(1.0), &mesh), set(&[7, 11, 12, 13, 17]));
    assert_eq!(select(&around(1.0 - f64::EPSILON), &mesh), set(&[12]));
    assert_eq!(select(&around(f64::MAX), &mesh), Selection::all(25));
}

/// A roof of four triangles in two planes that meet at a right angle along 1-4, and a tail that lies flat.
fn roof() -> Mesh {
    let corners = [[0, 0, 0], [0, 1, 0], [0, 1, 1], [1, 0, 0], [1, 1, 0], [1, 1, 1], [0, -1, 0], [1, -1, 0]];
    let corners = corners.map(|[x, y, z]: [i32; 3]| DVec3::new(x.into(), y.into(), z.into())).to_vec();
    let triangles = [[0, 3, 4], [0, 4, 1], [1, 4, 5], [1, 5, 2], [6, 7, 3], [6, 3, 0]];
    Mesh::from_triangles(corners, &triangles).expect("a roof")
}

#[test]
fn a_fold_selects_its_ends_and_the_opposite_vertices() {
    let mesh = roof();
    let above = |degrees| Dihedral::new(Angle::from_deg(degrees)).expect("a sound angle");
    assert_eq!(select(&above(89.9), &mesh), set(&[0, 1, 4, 5]));
    assert_eq!(select(&above(90.0), &mesh), set(&[]), "the angle is strictly above");
    assert_eq!(select(&above(0.0), &mesh), set(&[0, 1, 4, 5]), "flat edges and boundaries do not count");
    assert_eq!(select(&above(0.0), &shapes::octahedron()), Selection::all(6));
    for degrees in [-0.1, 180.1, f64::NAN] {
        assert!(Dihedral::new(Angle::from_deg(degrees)).is_err());
    }
}

#[test]
fn faces_without_area_have_no_dihedral_angle() {
    // Two triangles stand upright on either side of a third, whose tip is pushed in until nothing is left of it.
    let with_tip_at = |y: f64| {
        let corners = vec![DVec3::ZERO, DVec3::X, DVec3::Z, DVec3::new(0.5, y, 0.0), DVec3::new(0.5, y, 1.0)];
        Mesh::from_triangles(corners, &[[0, 1, 2], [1, 0, 3], [0, 4, 3]]).expect("three triangles")
    };
    let folded = Dihedral::new(Angle::from_deg(0.0)).expect("0 is sound");
    assert_eq!(select(&folded, &with_tip_at(-1.0)), Selection::all(5));
    assert_eq!(select(&folded, &with_tip_at(0.0)), set(&[]));
}

#[test]
fn an_unknown_vertex_is_an_error_also_from_a_closure() {
    let mesh = shapes::tetrahedron();
    let mut scratch = Scratch::new();
    let v = VertexId::new;
    let unknown = |vertex| Err(SelectError::NoVertex { vertex: v(vertex), vertex_count: 4 });
    assert_eq!(Disk::new(v(4), 0).select(&mesh, &mut scratch), unknown(4));
    assert_eq!([9, 3, 7].map(v).into_iter().collect::<Vertices>().select(&mesh, &mut scratch), unknown(7));
    assert_eq!((|_: &Mesh| set(&[5])).select(&mesh, &mut scratch), unknown(5));
    // Nothing that stands beside it hides it.
    for text in ["vertices: & vertices:5", "all | vertices:5", "!vertices:5", "vertices:5 & vertices:"] {
        assert_eq!(parse(text).select(&mesh, &mut scratch), unknown(5), "{text}");
    }
    let message = |count| SelectError::NoVertex { vertex: v(5), vertex_count: count }.to_string();
    assert_eq!(message(4), "there is no vertex 5: the mesh has 4 vertices, ids 0 to 3");
    assert_eq!(message(1), "there is no vertex 5: the mesh has 1 vertex, id 0");
    assert_eq!(message(0), "there is no vertex 5: the mesh has no vertices");
}

#[test]
fn criteria_combine_and_can_be_boxed() {
    let mesh = shapes::grid(3, 3);
    let inner = |mesh: &Mesh| mesh.vertices().filter(|&v| !mesh.is_boundary(v)).collect::<Selection>();
    assert_eq!(select(&inner, &mesh), set(&[5, 6, 9, 10]));
    let near = Disk::new(VertexId::new(0), 1);
    assert_eq!(select(&near.and(inner), &mesh), set(&[5]));
    assert_eq!(select(&near.or(inner), &mesh), set(&[0, 1, 4, 5, 6, 9, 10]));
    assert_eq!(select(&All.not(), &mesh), set(&[]));
    let boxed: Box<dyn Criterion> = Box::new(near.and(inner.not()));
    assert_eq!(select(&boxed.or(parse("vertices:15")), &mesh), set(&[0, 1, 4, 15]));
}

// ---------------------------------------------------------------------------------------------------- expressions

#[test]
fn not_binds_tighter_than_and_tighter_than_or() {
    // Over six vertices, with a = 1 2 3, b = 2 3 4, c = 3 4 5.
    let cases: [(&str, &[usize]); 12] = [
        ("a | b & c", &[1, 2, 3, 4]),
        ("(a | b) & c", &[3, 4]),
        ("a & b | c", &[2, 3, 4, 5]),
        ("a & (b | c)", &[2, 3]),
        ("!a & b", &[4]),
        ("!(a & b)", &[0, 1, 4, 5]),
        ("!a | b", &[0, 2, 3, 4, 5]),
        ("!(a | b)", &[0, 5]),
        ("a & !b | c & !b", &[1, 5]),
        ("!!a", &[1, 2, 3]),
        ("a | !b & c", &[1, 2, 3, 5]),
        ("((a)) | (b | c) | !all", &[1, 2, 3, 4, 5]),
    ];
    let mesh = shapes::octahedron();
    for (text, expected) in cases {
        let [a, b, c] = ["vertices:1,2,3", "vertices : 4 , 3 ,2,2", "vertices:@ids"];
        let long = text.replace('c', c).replace('b', b).replace("all", "ALL").replace('a', a).replace("ALL", "all");
        for text in [long.clone(), long.replace(' ', ""), long.replace(' ', "\n\t ")] {
            let expression = parse_with(&text, "3 4 5").unwrap_or_else(|error| panic!("{text}: {error}"));
            assert_eq!(select(&expression, &mesh), set(expected), "{text}");
        }
    }
}

#[test]
fn every_criterion_is_read_with_its_parameters() {
    let above = |deg| NormalAngle::new(Angle::from_deg(deg)).expect("sound");
    let length = Length::absolute(0.9).expect("sound");
    let cases: [(&str, &dyn Criterion); 21] = [
        ("all", &All),
        ("disk:3,1", &Disk::new(VertexId::new(3), 1)),
        (" sphere : 1, -0.5 ,0e0,+.5 ", &Sphere::new(DVec3::new(1.0, -0.5, 0.0), 0.5).expect("sound")),
        ("dihedral:45.5", &Dihedral::new(Angle::from_deg(45.5)).expect("sound")),
        ("vertices:007", &Vertices::new(set(&[7]))),
        ("faces: 3,02,3", &Faces::new([2, 3])),
        ("normal-angle:45.5", &above(45.5)),
        ("normal-angle: 45.5 +neighbors", &above(45.5).and_neighbors()),
        ("limit-error: 1.5 %", &LimitError::new(Length::percent(1.5).expect("sound"))),
        ("curvature:0.5", &Curvature::new(0.5).expect("sound")),
        ("curvature-top:25%", &CurvatureTop::new(25.0).expect("sound")),
        ("mean-curvature:0", &MeanCurvature::new(0.0).expect("sound")),
        ("normal-cone:20", &NormalCone::new(Angle::from_deg(20.0)).expect("sound")),
        ("flatness:0.1", &Flatness::new(Length::absolute(0.1).expect("sound"))),
        ("valence:3", &Valence::new(3)),
        ("edge-length:0.9", &EdgeLength::new(length)),
        ("boundary", &Boundary),
        ("sharp", &Sharp),
        ("silhouette:eye=0,-9,1", &Silhouette::from_eye(DVec3::new(0.0, -9.0, 1.0)).expect("sound")),
        ("silhouette:dir = 0,1,-1", &Silhouette::along(DVec3::new(0.0, 1.0, -1.0)).expect("sound")),
        ("area:0.4", &Area::new(0.4).expect("sound")),
    ];
    // They need what is not in the text: see tests/criteria.rs.
    let told = ["field", "frustum", "pixel-area", "pixel-length"];
    // A roof has a boundary and no vertex inside, a torus the other way round.
    let meshes = [roof(), shapes::torus(5, 4, 2.0, 1.0)];
    for (text, criterion) in cases {
        for mesh in &meshes {
            assert_eq!(select(&parse(text), mesh), select(&criterion, mesh), "{text}");
        }
        assert!(meshes.iter().any(|mesh| !select(&criterion, mesh).is_empty()), "{text} would show nothing");
    }
    for form in Expression::known_criteria() {
        let name = form.split(':').next().expect("a name");
        let is_tested = told.contains(&name) || cases.iter().any(|(text, _)| text.trim().starts_with(name));
        assert!(is_tested, "{form} is not tested");
    }
}

#[test]
fn files_hold_ids_between_blanks_commas_and_lines() {
    for ids in ["1 2,3", "1\n2\r\n3\n", "# none here: 9\n1,2 # 8\n\n\t3,", "\u{feff}3, 2,,1 1", "1#\n2#7\n#\n3"] {
        assert_eq!(parse_with("vertices:@ids", ids).expect(ids).to_string(), "vertices:1,2,3");
    }
    for ids in ["", "\n \n", "# 1 2 3"] {
        assert_eq!(parse_with("vertices:@ids", ids).expect(ids).to_string(), "vertices:");
    }
    let line = |ids| parse_with("all & vertices:@ids", ids).expect_err(ids).to_string();
    let expected = "expected the id of a vertex, a whole number from 0 to 4294967294";
    assert_eq!(line("1 # x\n2 x"), format!("column 17: ids, line 2: vertex = x: {expected}"));
    assert_eq!(line("1\n\n-2"), format!("column 17: ids, line 3: vertex = -2: {expected}"));
    assert_eq!(line("4294967295"), format!("column 17: ids, line 1: vertex = 4294967295: {expected}"));
}

#[test]
fn file_names_end_at_a_sign_or_are_quoted() {
    let cases: [(&str, &[&str]); 9] = [
        ("vertices:@a.txt", &["a.txt"]),
        ("vertices:@dir/my ids.txt | all", &["dir/my ids.txt"]),
        ("(vertices : @ a.txt )&vertices:@b", &["a.txt", "b"]),
        ("vertices:@\"a|b.txt\"", &["a|b.txt"]),
        ("!vertices:@\" (1) & 2 \" | vertices:@c", &[" (1) & 2 ", "c"]),
        ("vertices:@C:\\ids,1!.txt", &["C:\\ids,1!.txt"]),
        ("vertices:@a\"b", &["a\"b"]),
        ("vertices:@(a", &["(a"]),
        ("vertices:@ü@|vertices:@\"é\"", &["ü@", "é"]),
    ];
    for (text, expected) in cases {
        let mut read = Vec::new();
        let expression = Expression::parse(text, &mut |path| {
            read.push(path.to_owned());
            Ok(String::new())
        });
        assert!(expression.is_ok(), "{text}");
        assert_eq!(read, expected.iter().map(PathBuf::from).collect::<Vec<_>>(), "{text}");
    }
}

#[test]
fn errors_name_the_column_and_what_was_expected() {
    let id = "expected the id of a vertex, a whole number from 0 to 4294967294";
    let known = format!("known are `{}`", Expression::known_criteria().collect::<Vec<_>>().join("`, `"));
    let cases = [
        ("", "column 1: expected a criterion, `!` or `(`, found the end".to_owned()),
        ("  ", "column 3: expected a criterion, `!` or `(`, found the end".to_owned()),
        ("all |", "column 6: expected a criterion, `!` or `(`, found the end".to_owned()),
        ("all || all", "column 6: expected a criterion, `!` or `(`, found `|`".to_owned()),
        ("()", "column 2: expected a criterion, `!` or `(`, found `)`".to_owned()),
        ("all all", "column 5: expected `|`, `&` or the end, found `all`".to_owned()),
        ("all:3", "column 4: expected `|`, `&` or the end, found `:`".to_owned()),
        ("all) | all", "column 4: expected `|`, `&` or the end, found `)`".to_owned()),
        ("!(all & (all)", "column 14: expected `|`, `&` or the `)` to the `(` in column 2, found the end".to_owned()),
        ("(all all)", "column 6: expected `|`, `&` or the `)` to the `(` in column 1, found `all`".to_owned()),
        ("ALL", format!("column 1: there is no criterion `ALL`; {known}")),
        ("all & dïsk:1,2", format!("column 7: there is no criterion `dïsk`; {known}")),
        ("disk", "column 5: expected `:` and arguments as in `disk:V,R`, found the end".to_owned()),
        ("disk 3,1", "column 6: expected `:` and arguments as in `disk:V,R`, found `3`".to_owned()),
        ("disk:", "column 6: expected 2 arguments as in `disk:V,R`, found none".to_owned()),
        ("disk:3", "column 6: expected 2 arguments as in `disk:V,R`, found 1".to_owned()),
        ("disk:3,1,2,2|all", "column 6: expected 2 arguments as in `disk:V,R`, found 4".to_owned()),
        ("disk:@ids", "column 7: expected 2 arguments as in `disk:V,R`, found a file".to_owned()),
        ("disk:3, ", "column 9: expected R as in `disk:V,R`, found the end".to_owned()),
        ("disk:,1", "column 6: expected V as in `disk:V,R`, found `,`".to_owned()),
        ("disk:x,1", format!("column 6: V = x: {id}")),
        ("disk:+1,1", format!("column 6: V = +1: {id}")),
        ("disk:3, -1", format!("column 9: R = -1: expected a whole number from 0 to {}", usize::MAX)),
        (
            "disk:3,99999999999999999999",
            format!("column 8: R = 99999999999999999999: expected a whole number from 0 to {}", usize::MAX),
        ),
        ("sphere:0,0,0", "column 8: expected 4 arguments as in `sphere:x,y,z,radius`, found 3".to_owned()),
        ("sphere:0,0,0,-1", "column 14: radius = -1: expected a finite number, 0 or more".to_owned()),
        ("sphere:0,nan,0,1", "column 10: y = nan: expected a finite number".to_owned()),
        ("sphere:0,0,0,1e999", "column 14: radius = 1e999: expected a finite number".to_owned()),
        ("dihedral:", "column 10: expected 1 argument as in `dihedral:DEG`, found none".to_owned()),
        ("dihedral:30°", "column 10: angle = 30°: expected a finite number".to_owned()),
        ("dihedral:180.5", "column 10: angle = 180.5: expected degrees from 0 to 180".to_owned()),
        ("curvature:-1", "column 11: curvature = -1: expected a finite number, 0 or more".to_owned()),
        ("curvature-top:5", "column 15: percent = 5: expected a number with `%` behind it".to_owned()),
        ("curvature-top:101%", "column 15: percent = 101: expected a number from 0 to 100".to_owned()),
        ("mean-curvature:nan", "column 16: curvature = nan: expected a finite number".to_owned()),
        ("limit-error:-1%", "column 13: percent = -1: expected a finite number, 0 or more".to_owned()),
        ("flatness:1e999", "column 10: L = 1e999: expected a finite number".to_owned()),
        ("edge-length:%", "column 13: expected L as in `edge-length:L`, found `%`".to_owned()),
        ("area:1%", "column 6: area = 1%: expected a finite number".to_owned()),
        ("valence:-1", format!("column 9: N = -1: expected a whole number from 0 to {}", usize::MAX)),
        ("normal-cone:181", "column 13: angle = 181: expected degrees from 0 to 180".to_owned()),
        ("field:red", "column 7: field = red: expected `>`, `>=`, `<` or `<=` in it".to_owned()),
        ("field: >1", "column 8: field = >1: expected its name before the sign".to_owned()),
        ("field:red>", "column 11: expected VALUE as in `field:NAME>VALUE`, found the end".to_owned()),
        ("field:red >= x", "column 14: VALUE = x: expected a finite number".to_owned()),
        ("field:@ids", "column 8: expected 1 argument as in `field:NAME>VALUE`, found a file".to_owned()),
        ("silhouette:1,2,3", "column 12: silhouette = 1: expected eye=x,y,z or dir=x,y,z".to_owned()),
        ("silhouette:eye=1,2", "column 12: expected 3 arguments as in `silhouette:eye=x,y,z`, found 2".to_owned()),
        ("silhouette:dir=0,0,0", "column 16: dir = [0, 0, 0]: expected finite coordinates, not all 0".to_owned()),
        ("boundary:1", "column 9: expected `|`, `&` or the end, found `:`".to_owned()),
        ("all & frustum", "column 7: `frustum` looks through a camera, and there is none".to_owned()),
        ("pixel-area:5", "column 1: `pixel-area` looks through a camera, and there is none".to_owned()),
        ("vertices:1 2", format!("column 10: vertex = 1 2: {id}")),
        ("vertices:1,@ids", format!("column 12: vertex = @ids: {id}")),
        ("vertices:1,,2", "column 12: expected vertex as in `vertices:V,V,...`, found `,`".to_owned()),
        ("vertices:1,", "column 12: expected vertex as in `vertices:V,V,...`, found the end".to_owned()),
        ("vertices:@", "column 11: expected the name of a file, found the end".to_owned()),
        ("vertices:@ | all", "column 12: expected the name of a file, found `|`".to_owned()),
        ("vertices:@\"\"", "column 11: expected the name of a file, found `\"\"`".to_owned()),
        ("vertices:@\"a", "column 13: expected the `\"` to the one in column 11, found the end".to_owned()),
        ("vertices:@\"ids\"x", "column 16: expected `|`, `&` or the end, found `x`".to_owned()),
        ("vertices:@none", "column 11: none could not be read: not there".to_owned()),
        ("al\u{7}l", format!("column 1: there is no criterion `al\u{fffd}l`; {known}")),
    ];
    for (text, expected) in cases {
        assert_eq!(error(text), expected, "{text}");
    }
    let long = "x".repeat(1000);
    assert_eq!(error(&long), format!("column 1: there is no criterion `{}...`; {known}", &long[..40]));
    let source = std::error::Error::source(&Error::from(parse_with("vertices:@none", "").expect_err("no file")))
        .map(ToString::to_string);
    assert_eq!(source.as_deref(), Some("not there"));
}

#[test]
fn depth_is_bounded_and_length_is_not() {
    let nested = |open: &str, close: &str, depth| [open.repeat(depth), "all".to_owned(), close.repeat(depth)].concat();
    for (open, close) in [("(", ")"), ("!", ""), ("!(", ")"), ("(all&", ")"), ("(all|!", ")")] {
        let signs = open.matches(['(', '!']).count();
        assert!(parse_with(&nested(open, close, Expression::MAX_DEPTH / signs), "").is_ok(), "{open}");
        for depth in [Expression::MAX_DEPTH / signs + 1, 100_000] {
            let error = parse_with(&nested(open, close, depth), "").expect_err(open);
            assert!(matches!(error.kind, ExpressionErrorKind::TooDeep { allowed: 64 }), "{open}: {error}");
        }
    }
    assert_eq!(
        error(&"!".repeat(100_000)),
        "column 65: at most 64 parentheses and `!` may stand inside each other; write fewer"
    );
    assert!(error(&"(".repeat(100_000)).starts_with("column 65: at most 64"));
    assert!(error(&")".repeat(100_000)).starts_with("column 1: expected a criterion"));

    let mesh = shapes::grid(20, 20);
    let disks: Vec<String> = (0..100_000).map(|k| format!("disk:{},1", k % 441)).collect();
    assert_eq!(select(&parse(&disks.join("|")), &mesh), Selection::all(441));
    assert_eq!(select(&parse(&disks.join("&")), &mesh), set(&[]));
}

/// The text of an expression, with needless parentheses and blanks.
#[derive(Clone, Debug)]
struct Written(String);

impl Arbitrary for Written {
    fn arbitrary(g: &mut Gen) -> Self {
        fn write(depth: usize, g: &mut Gen) -> String {
            let blank = *g.choose(&["", "", " ", "\t\n"]).expect("some");
            let kind = if depth == 0 { 0 } else { u8::arbitrary(g) % 5 };
            let mut inner = || write(depth - 1, g);
            let text = match kind {
                1 => format!("!{}", single(inner())),
                2 => format!("({})", inner()),
                3 => format!("{}{blank}&{}", inner(), inner()),
                4 => format!("{}|{blank}{}", inner(), inner()),
                _ => criterion(g),
            };
            format!("{blank}{text}")
        }
        fn single(text: String) -> String {
            if text.contains(['&', '|']) { format!("({text})") } else { text }
        }
        fn criterion(g: &mut Gen) -> String {
            let number = |g: &mut Gen| loop {
                let number = f64::from_bits(u64::arbitrary(g));
                if number.is_finite() {
                    return number;
                }
            };
            match u8::arbitrary(g) % 14 {
                0 => "all".to_owned(),
                1 => format!(
                    "vertices:{}",
                    Vec::<u16>::arbitrary(g).iter().map(u16::to_string).collect::<Vec<_>>().join(" ,")
                ),
                2 => "vertices:@ids".to_owned(),
                3 => format!("disk: {},{}", u16::arbitrary(g), usize::arbitrary(g)),
                4 => format!("sphere:{},{} ,{:?},{}", number(g), number(g), number(g), number(g).abs()),
                5 => format!("faces:{}", usize::arbitrary(g)),
                6 => format!("normal-angle:{}+neighbors", f64::from(u8::arbitrary(g) % 180)),
                7 => format!("limit-error:{:?}%", number(g).abs()),
                8 => format!("curvature:{:?}", number(g).abs()),
                9 => format!("silhouette:dir={},{:?},1", number(g), number(g)),
                10 => format!("field:red {} {:?}", g.choose(&[">", ">=", "<", "<="]).expect("some"), number(g)),
                11 => format!("curvature-top:{}%", f64::from(u8::arbitrary(g)) / 2.55),
                12 => (*g.choose(&["boundary", "sharp", "valence:6"]).expect("some")).to_owned(),
                _ => format!("dihedral:{}", f64::from(u32::arbitrary(g)) / f64::from(u32::MAX) * 180.0),
            }
        }
        let depth = usize::arbitrary(g) % 6;
        Self(write(depth, g))
    }
}

/// What an expression prints reads back as the same, to the last bit of its numbers.
#[test]
fn printing_and_reading_return_the_same() {
    fn property(written: Written) -> bool {
        let expression =
            parse_with(&written.0, "8 5 # five\n 8").unwrap_or_else(|error| panic!("{}: {error}", written.0));
        let printed = expression.to_string();
        let again = parse(&printed);
        printed == again.to_string()
            && format!("{expression:?}") == format!("{again:?}")
            && !printed.contains(char::is_whitespace)
    }
    check(209, 100, property as fn(Written) -> bool);
}

/// Text of all kinds is read or refused, with a column in it or right behind it.
#[test]
fn garbage_is_refused_without_a_panic() {
    fn property(text: String) -> bool {
        parse_with(&text, &text).err().is_none_or(|error| {
            error.column >= 1 && error.column <= text.chars().count() + 1 && !error.to_string().is_empty()
        })
    }
    check(210, 100, property as fn(String) -> bool);
}

/// The same for text that is made of the right pieces in the wrong order.
#[test]
fn shuffled_pieces_are_refused_without_a_panic() {
    fn property(pieces: Vec<u8>) -> bool {
        const PIECES: [&str; 33] = [
            "all",
            "vertices",
            "disk",
            "sphere",
            "dihedral",
            "faces",
            "normal-angle",
            "+neighbors",
            "limit-error",
            "curvature-top",
            "field",
            "silhouette",
            "boundary",
            "frustum",
            "eye=",
            "%",
            ">=",
            "/",
            ":",
            ",",
            "|",
            "&",
            "!",
            "(",
            ")",
            "@",
            "\"",
            " ",
            "1",
            "-2.5",
            "ids",
            "é",
            "1e9",
        ];
        let text: String = pieces.iter().map(|&k| PIECES[usize::from(k) % PIECES.len()]).collect();
        let mesh = shapes::octahedron();
        match parse_with(&text, "1 2") {
            Ok(expression) => {
                let _ = expression.select(&mesh, &mut Scratch::new());
                true
            }
            Err(error) => error.column <= text.chars().count() + 1,
        }
    }
    check(211, 100, property as fn(Vec<u8>) -> bool);
}
