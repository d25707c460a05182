//! STL: text and binary, welding, what is told, errors with their places, hostile files.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;
#[path = "common/formats.rs"]
mod formats;
#[path = "common/tables.rs"]
mod tables;

use common::random;
use formats::{bits, corners, fixture, never_panics};
use vvmesh::error::{ReadError, ReadErrorKind, WriteErrorKind};
use vvmesh::glam::DVec3;
use vvmesh::io::{self, Format, Loaded};
use vvmesh::soup::FaceList;
use vvmesh::{Mesh, shapes};

fn read(text: &str) -> Loaded {
    io::read_stl(text.as_bytes()).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn error(bytes: &[u8]) -> ReadError {
    io::read_stl(bytes).expect_err(&String::from_utf8_lossy(bytes))
}

fn told(loaded: &Loaded) -> Vec<String> {
    loaded.notes.iter().map(ToString::to_string).collect()
}

fn facet(corners: [&str; 3]) -> String {
    let [a, b, c] = corners;
    format!(
        " facet normal nan nan nan\n  outer loop\n   vertex {a}\n   vertex {b}\n   vertex {c}\n  endloop\n endfacet\n"
    )
}

fn written(faces: &FaceList) -> Vec<u8> {
    let mut bytes = Vec::new();
    io::write_stl(&mut bytes, faces).unwrap();
    bytes
}

#[test]
fn files_of_another_program_are_read_as_it_reads_them() {
    for name in ["text.stl", "binary.stl"] {
        let (bytes, expected) = fixture(name);
        let loaded = io::read_stl(&bytes).unwrap();
        assert_eq!(corners(&loaded.faces), expected, "{name}");
        assert!(Mesh::from_face_list(&loaded.faces).is_ok());
        assert_eq!(
            told(&loaded),
            ["12 corners welded to 4 vertices where their positions are equal", "normals of 4 faces ignored"]
        );
    }
}

#[test]
fn every_file_has_its_counts_and_comes_back() {
    let Some(folder) = common::meshes() else { return };
    let rows = tables::readme(&folder);
    let files: Vec<_> = rows.iter().filter(|row| row.file.ends_with(".stl")).collect();
    assert!(files.len() >= 4);
    for row in &files {
        let loaded = io::read(folder.join(&row.file)).unwrap();
        assert_eq!(loaded.format, Format::Stl);
        assert_eq!((loaded.faces.vertex_count(), loaded.faces.face_count()), (row.vertices, row.faces), "{}", row.file);
        assert_eq!(Mesh::from_face_list(&loaded.faces).is_ok(), row.is_manifold);
        let rounded: Vec<_> = corners(&loaded.faces).iter().map(|p| p.as_vec3().as_dvec3()).collect();
        assert_eq!(corners(&io::read_stl(&written(&loaded.faces)).unwrap().faces), rounded, "{}", row.file);
    }
    for kind in ["stl_box", "icosahedron"] {
        let [text, binary] =
            ["ascii", "binary"].map(|way| io::read(folder.join(format!("models/{kind}_{way}.stl"))).unwrap());
        let single = corners(&text.faces).iter().map(|p| p.as_vec3().as_dvec3()).collect::<Vec<_>>();
        assert_eq!(single, corners(&binary.faces), "{kind}");
    }
    for [file, reading, _] in tables::bad(&folder, ".stl") {
        let list = io::read(folder.join(&file)).unwrap().faces;
        let counts = format!("accept {}/{} after welding", list.vertex_count(), list.face_count());
        assert_eq!(counts, reading, "{file}");
    }
}

#[test]
fn a_mesh_in_single_precision_comes_back() {
    for mesh in [shapes::icosahedron(), shapes::torus(12, 8, 2.0, 1.0), shapes::grid(4, 3)] {
        let mut faces = mesh.to_face_list();
        faces.positions.iter_mut().for_each(|position| *position = position.as_vec3().as_dvec3());
        let bytes = written(&faces);
        let again = io::read_stl(&bytes).unwrap().faces;
        assert_eq!(corners(&again), corners(&faces));
        assert_eq!(again.vertex_count(), faces.vertex_count());
        // Numbered by first use, it is a fixed point.
        assert_eq!(bits(&io::read_stl(&written(&again)).unwrap().faces), bits(&again));
        let normal = |k: usize| {
            DVec3::from_array(
                [0, 4, 8].map(|at| f32::from_le_bytes(bytes[84 + 50 * k + at..][..4].try_into().unwrap()).into()),
            )
        };
        for (k, face) in faces.faces().enumerate() {
            let [a, b, c] = [0, 1, 2].map(|corner| faces.positions[face[corner] as usize]);
            assert!(normal(k).distance((b - a).cross(c - a).normalize()) < 1e-6);
        }
    }
}

#[test]
fn corners_are_welded_by_bits_and_it_is_told() {
    let text = format!(
        "SOLID part # one\n{}{}endsolid part # one\n\n solid\n{}\nENDSOLID",
        facet(["0 0 0", "1 0 0", "0 1 0"]),
        facet(["-0 0 -0.0", "0 1 0", "0 0 1e0"]),
        facet(["0 0 0", "1e-300 0 0", "+1 0 0"])
    );
    for text in [text.clone(), text.replace('\n', "\r\n"), text.replace("\n  ", " ")] {
        let loaded = read(&text);
        assert_eq!(loaded.faces.vertex_count(), 5);
        assert!(loaded.faces.faces().eq([[0, 1, 2], [0, 2, 3], [0, 4, 1]]));
        assert_eq!(
            told(&loaded),
            [
                "9 corners welded to 5 vertices where their positions are equal",
                "normals of 3 faces ignored",
                "2 solids read as one"
            ]
        );
    }
    let mut bytes = written(&shapes::tetrahedron().to_face_list());
    bytes[84 + 48] = 1;
    bytes[84 + 50 + 49] = 0x80;
    // Some writers begin binary files so.
    bytes[..6].copy_from_slice(b"solid ");
    let loaded = io::read_stl(&bytes).unwrap();
    assert_eq!(told(&loaded)[2], "attribute bytes of 2 faces ignored");
    assert_eq!((loaded.faces.vertex_count(), loaded.faces.face_count()), (4, 4));
    let nothing = io::read_stl(&written(&FaceList::new(vec![DVec3::ONE]))).unwrap();
    assert!(nothing.faces.vertex_count() == 0 && nothing.notes.is_empty());
}

#[test]
fn errors_name_the_place_and_what_stands_there() {
    let good = format!("solid a\n{}endsolid a\n", facet(["0 0 0", "1 0 0", "0 1 0"]));
    for (from, to, line, message) in [
        ("normal", "abnormal", 2, "expected normal, found 'abnormal'"),
        ("outer loop", "loop", 3, "expected outer, found 'loop'"),
        ("1 0 0", "1 0 x", 5, "expected a number, found 'x'"),
        ("1 0 0", "1 0 0 0", 5, "expected vertex, found '0'"),
        ("  endloop", "  vertex 1 1 1\n  endloop", 7, "expected endloop, found 'vertex'"),
        (" endfacet\nendsolid a\n", "", 7, "unexpected end of the file, expected endfacet"),
        ("endsolid a\n", "", 8, "unexpected end of the file, expected 'facet' or 'endsolid'"),
        ("endsolid", "endsolids", 9, "expected 'facet' or 'endsolid', found 'endsolids'"),
        ("endsolid a\n", "endsolid\nv 1 2 3\n", 10, "expected solid, found 'v'"),
    ] {
        let error = error(good.replace(from, to).as_bytes());
        assert_eq!((error.line, error.byte), (Some(line), None), "{error}");
        assert_eq!(error.kind.to_string(), message);
    }
    assert!(matches!(error(b"\n \r").kind, ReadErrorKind::Empty));
    let bytes = written(&shapes::tetrahedron().to_face_list());
    let message = |bytes: &[u8]| error(bytes).to_string();
    assert_eq!(message(&bytes[..283]), "byte 283: unexpected end of the file, expected triangle 4 of 4");
    assert_eq!(
        message(&bytes[..50]),
        "byte 50: unexpected end of the file, expected 84 bytes before the first triangle"
    );
    let more = [&bytes[..], &[7; 60]].concat();
    assert!(message(&more).starts_with("byte 284: 60 bytes stand after the last value"), "{}", message(&more));
    let mut many = bytes.clone();
    many[80..84].fill(0xff);
    assert_eq!(message(&many), "byte 284: unexpected end of the file, expected triangle 5 of 4294967295");
}

#[test]
fn what_stl_cannot_hold_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("o.stl");
    let refused = |faces: &FaceList| match io::save(&path, faces).unwrap_err().kind {
        WriteErrorKind::Io(error) => error.to_string(),
        other => panic!("{other:?}"),
    };
    let mut square =
        FaceList::new([(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec());
    square.push_face(&[0, 1, 2, 3]);
    assert!(refused(&square).contains("a face has 4 corners"));
    let mut far = FaceList::new(vec![DVec3::ZERO, DVec3::X, DVec3::Y * 1e39]);
    far.push_face(&[0, 1, 2]);
    assert!(refused(&far).contains("single precision"));
    assert!(!path.exists());
    io::save(&path, &shapes::tetrahedron()).unwrap();
    assert_eq!(io::read(&path).unwrap().faces.face_count(), 4);
}

#[test]
fn broken_files_are_refused_without_a_panic() {
    for name in ["text.stl", "binary.stl"] {
        never_panics(&fixture(name).0, io::read_stl);
    }
    never_panics(&written(&shapes::octahedron().to_face_list()), io::read_stl);
    never_panics(
        format!("solid a\n{}endsolid a\nsolid\nendsolid", facet(["0 0 0", "1 0 0", "0 1 0"])).as_bytes(),
        io::read_stl,
    );
}
