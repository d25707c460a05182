//! PLY: text and both orders of bytes, what becomes attributes, what is told, errors with their places, hostile files.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;
#[path = "common/formats.rs"]
mod formats;
#[path = "common/tables.rs"]
mod tables;

use std::fmt::Write;

use common::random;
use formats::{bits, corners, fixture, never_panics};
use vvmesh::error::{ReadError, ReadErrorKind};
use vvmesh::glam::DVec3;
use vvmesh::io::{self, Format, Loaded, NoteKind};
use vvmesh::soup::FaceList;
use vvmesh::{Mesh, shapes};

fn read(text: &str) -> Loaded {
    io::read_ply(text.as_bytes()).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn error(bytes: &[u8]) -> ReadError {
    io::read_ply(bytes).expect_err(&String::from_utf8_lossy(bytes))
}

fn told(loaded: &Loaded) -> Vec<String> {
    loaded.notes.iter().map(ToString::to_string).collect()
}

/// Three vertices and a triangle, with more properties of vertices and their values.
fn triangle(properties: &str, values: [&str; 3]) -> String {
    let [a, b, c] = values;
    format!(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n{properties}\
         element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 {a}\n1 0 0 {b}\n0 1 0 {c}\n3 0 1 2\n"
    )
}

/// The same mesh with another way to write numbers.
fn binary(faces: &FaceList, big: bool, float: bool) -> Vec<u8> {
    let order = if big { "big" } else { "little" };
    let coordinate = if float { "float32" } else { "float64" };
    let mut bytes = format!(
        "ply\r\nformat binary_{order}_endian 1.0\r\ncomment \u{e9}\r\nelement vertex {}\r\nproperty {coordinate} x\r\nproperty \
         {coordinate} y\r\nproperty {coordinate} z\r\nelement face {}\r\nproperty list int16 uint32 vertex_index\r\nend_header\r\n",
        faces.vertex_count(),
        faces.face_count()
    )
    .into_bytes();
    let mut push = |little: &[u8]| {
        if big { bytes.extend(little.iter().rev()) } else { bytes.extend(little) }
    };
    for value in faces.positions.iter().flat_map(|position| position.to_array()) {
        if float { push(&(value as f32).to_le_bytes()) } else { push(&value.to_le_bytes()) }
    }
    for face in faces.faces() {
        push(&(face.len() as i16).to_le_bytes());
        face.iter().for_each(|v| push(&v.to_le_bytes()));
    }
    bytes
}

#[test]
fn all_ways_to_write_numbers_are_read() {
    let faces = shapes::icosahedron().to_face_list();
    let mut text = String::from(
        "ply\nformat ascii 1.0\nelement face 20\nproperty list uchar int vertex_index\nelement vertex 12\nproperty double x\n\
         property double y\nproperty double z\nend_header\n",
    );
    faces.faces().for_each(|face| writeln!(text, "3 {} {} {}", face[0], face[1], face[2]).unwrap());
    faces.positions.iter().for_each(|p| writeln!(text, "{} {} {}", p.x, p.y, p.z).unwrap());
    // Faces before vertices, lone \r, no end of the last line, a comment that is not UTF-8.
    for text in [text.clone(), text.replace('\n', "\r"), text.replace('\n', "\r\n"), text.trim_end().to_owned()] {
        assert_eq!(read(&text).faces, faces);
        let latin = [&b"ply\ncomment gr\xfc\xdfe"[..], &text.as_bytes()[3..]].concat();
        assert_eq!(io::read_ply(&latin).unwrap().faces, faces);
        assert_eq!(read(&format!("\u{feff}{text}")).faces, faces);
    }
    for big in [true, false] {
        assert_eq!(io::read_ply(&binary(&faces, big, false)).unwrap().faces, faces);
        let rounded = io::read_ply(&binary(&faces, big, true)).unwrap().faces;
        assert!(rounded.positions.iter().zip(&faces.positions).all(|(p, q)| *p == q.as_vec3().as_dvec3()));
    }
    let mac = String::from_utf8(binary(&FaceList::new(vec![DVec3::ZERO]), true, false)).unwrap().replace("\r\n", "\r");
    assert_eq!(io::read_ply(mac.as_bytes()).unwrap().faces.positions, [DVec3::ZERO]);
    // The type that the header gives counts.
    assert_eq!(
        read(&triangle("", ["", "", ""]).replace("double", "float").replace("1 0 0", "0.1 0 0")).faces.positions[1].x,
        f64::from(0.1_f32)
    );
}

#[test]
fn files_of_another_program_are_read_as_it_reads_them() {
    for name in ["text.ply", "binary.ply"] {
        let (bytes, expected) = fixture(name);
        let loaded = io::read_ply(&bytes).unwrap();
        assert_eq!(corners(&loaded.faces), expected, "{name}");
        let colors = &loaded.attributes.vertex_colors;
        assert_eq!(colors[0], Some([1.0, 0.0, 0.2]));
        assert_eq!(colors[2], Some([17, 34, 68].map(|value: u8| f64::from(value) / 255.0)));
        assert!((loaded.attributes.normals[0].length() - 1.0).abs() < 1e-6);
        assert_eq!(loaded.attributes.normal_index(1), Some(2));
        let notes = told(&loaded);
        assert_eq!(
            notes,
            ["colours of 4 vertices kept as attributes (line 4 on)", "property 'alpha' of 4 vertices ignored (line 4)"]
        );
    }
}

#[test]
fn every_file_has_its_counts_and_comes_back() {
    let Some(folder) = common::meshes() else { return };
    let mut read = 0;
    for row in tables::readme(&folder) {
        let loaded = io::read(folder.join(&row.file)).unwrap();
        if row.file.ends_with(".ply") {
            read += 1;
            assert_eq!(loaded.format, Format::Ply);
            assert_eq!(
                (loaded.faces.vertex_count(), loaded.faces.face_count()),
                (row.vertices, row.faces),
                "{}",
                row.file
            );
            let triangles = loaded.faces.triangulate().triangles;
            assert_eq!(Mesh::from_triangles(loaded.faces.positions.clone(), &triangles).is_ok(), row.is_manifold);
        }
        let mut ply = Vec::new();
        io::write_ply(&mut ply, &loaded.faces).unwrap();
        let again = io::read_ply(&ply).unwrap();
        assert_eq!(bits(&again.faces), bits(&loaded.faces), "{}", row.file);
        assert!(again.notes.is_empty() && again.attributes.is_empty());
    }
    assert!(read >= 4);
    for [file, reading, _] in tables::bad(&folder, ".ply") {
        match (io::read(folder.join(&file)), reading.strip_prefix("accept ")) {
            (Ok(loaded), Some(counts)) => {
                assert_eq!(format!("{}/{}", loaded.faces.vertex_count(), loaded.faces.face_count()), counts, "{file}");
            }
            (Err(error), None) => {
                assert!(error.to_string().contains(reading.strip_prefix("refuse ").unwrap()), "{error}")
            }
            (answer, _) => panic!("{file}: {reading}, but {answer:?}"),
        }
    }
}

#[test]
fn bits_and_attributes_survive() {
    let special = [f64::MIN_POSITIVE, 5e-324, f64::MAX, f64::NAN, f64::NEG_INFINITY, -0.0, 0.1, 1e-300, 3.0];
    let mut faces = FaceList::new(special.chunks(3).map(DVec3::from_slice).collect());
    faces.push_face(&[0, 1, 2]);
    // More corners than a byte counts.
    faces.push_face(&[0, 1, 2].repeat(100));
    let mut ply = Vec::new();
    io::write_ply(&mut ply, &faces).unwrap();
    assert_eq!(bits(&io::read_ply(&ply).unwrap().faces), bits(&faces));

    let text = "v 0 0 0 1 0 0.2\nv 1 0 0\nv 0 1 0 2 -1 0.501\nv 1 1 0 0 0 0\nvt 0.1 5e-324\nvt 1 -0\n\
        f 1/1 2/2 3/1\nf 2 4/1 3/2\nf 4/2 1/2 2/2\n";
    let loaded = io::read_obj(text.as_bytes()).unwrap();
    let mut ply = Vec::new();
    io::write_ply_with(&mut ply, &loaded.faces, &loaded.attributes).unwrap();
    let again = io::read_ply(&ply).unwrap();
    let eight_bits = |values: [u8; 3]| Some(values.map(|value| f64::from(value) / 255.0));
    let colors = [[255, 0, 51], [255, 255, 255], [255, 0, 128], [0, 0, 0]].map(eight_bits);
    assert_eq!(again.attributes.vertex_colors, colors);
    let texture = |loaded: &Loaded, corner| {
        let index = loaded.attributes.texture_index(corner)?;
        Some(loaded.attributes.texture_coordinates[index].map(f64::to_bits))
    };
    for corner in 0..9 {
        // A face has them at all corners or at none.
        let expected = if (3..6).contains(&corner) { None } else { texture(&loaded, corner) };
        assert_eq!(texture(&again, corner), expected, "corner {corner}");
    }
    // Once rounded, it stays as it is.
    let mut twice = Vec::new();
    io::write_ply_with(&mut twice, &again.faces, &again.attributes).unwrap();
    assert_eq!(twice, ply);
}

#[test]
fn properties_become_attributes_or_notes() {
    for (names, first) in [("s t", 0.25), ("u v", 0.25), ("texture_u texture_v", 0.25), ("texture_s texture_t", 0.25)] {
        let properties: String = names.split(' ').map(|name| format!("property float {name}\n")).collect();
        let loaded = read(&triangle(&properties, ["0.25 0.5", "1 2", "3 4"]));
        assert_eq!(loaded.attributes.texture_coordinates[0], [first, 0.5, 0.0]);
        assert!((0..3).all(|corner| loaded.attributes.texture_index(corner) == Some(corner)));
        assert!(loaded.notes.is_empty());
    }
    for (of, value, expected) in
        [("uint8", "51", 0.2), ("uint16", "13107", 0.2), ("float", "0.5", 0.5), ("double", "0.1", 0.1)]
    {
        let properties: String = ["red", "green", "blue"].map(|name| format!("property {of} {name}\n")).concat();
        let loaded = read(&triangle(&properties, [&[value; 3].join(" "); 3]));
        assert_eq!(loaded.attributes.vertex_colors, [Some([expected; 3]); 3], "{of}");
    }
    let normals = read(&triangle("property int nx\nproperty int ny\nproperty int nz\n", ["0 0 1"; 3]));
    assert_eq!((normals.attributes.normals[2], normals.attributes.normal_index(2)), (DVec3::Z, Some(2)));

    // Half a set is none; lists of vertices, elements, properties of faces, lines of the header.
    let text = "ply\nformat ascii 1.0\ncomment TextureFile skin.png\nobj_info nothing\nelement strip 2\nproperty list int int \
        vertex_indices\nelement nothing 4000000000\nelement vertex 3\nproperty float x\nproperty list uchar int near\nproperty \
        float y\nproperty float z\nproperty uchar red\nelement face 1\nproperty uchar red\nproperty list uchar uint \
        vertex_indices\nproperty list uchar float texcoord\nproperty int flags\nelement vertex 1\nproperty int x\nhue 3\nend_header\n\
        2 7 7\n0\n0 2 9 9 0 0 1\n1 0 0 0 2\n0 1 7 1 0 3\n\n9 3 0 1\n2 6 0 0 1 0 0 1 4\n5\n";
    let loaded = read(text);
    assert_eq!(loaded.faces.positions, [DVec3::ZERO, DVec3::X, DVec3::Y]);
    assert_eq!(loaded.attributes.texture_coordinates, [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    assert_eq!(
        told(&loaded),
        [
            "1 rendering statement ignored (line 3)",
            "1 unknown statement ignored, first 'hue' (line 21)",
            "element 'strip' with 2 rows ignored (line 5)",
            "element 'nothing' with 4000000000 rows ignored (line 7)",
            "properties 'near', 'red' of 3 vertices ignored (line 8)",
            "properties 'red', 'flags' of 1 face ignored (line 14)",
            "element 'vertex' with 1 row ignored (line 19)",
        ]
    );
    assert!(loaded.notes.iter().all(|note| !matches!(note.kind, NoteKind::VertexColors { .. })));
}

#[test]
fn errors_name_the_place_and_what_stands_there() {
    let good = triangle("property uchar red\n", ["1", "2", "3"]);
    for (from, to, line, message) in [
        ("3 0 1 2\n", "", 13, "unexpected end of the file, expected face 1 of 1"),
        ("vertex 3", "vertex 4000000000", 14, "unexpected end of the file, expected vertex 5 of 4000000000"),
        ("vertex 3", "vertex 4294967296", 10, "more vertices than 32-bit ids can name; split the file"),
        ("vertex 3", "vertex x", 3, "the header is wrong: Invalid element count: x"),
        ("3 0 1 2", "3 0 1 3", 14, "index out of range: vertex 3, there are 3"),
        ("3 0 1 2", "3 0 -1 2", 14, "index out of range: vertex -1, there are 3"),
        ("3 0 1 2", "2 0 1", 14, "a face has at least 3 corners, found 2"),
        ("3 0 1 2", "3 0 1 2 7", 14, "'7' stands after the last face; the counts in the header do not fit the file"),
        (
            "3 0 1 2",
            "300 0 1 2",
            14,
            "'300' does not fit the property vertex_indices (list of int32, counted in uint8)",
        ),
        (
            "3 0 1 2",
            "3 0 1.5 2",
            14,
            "'1.5' does not fit the property vertex_indices (list of int32, counted in uint8)",
        ),
        ("1 0 0 2", "1 nix 0 2", 12, "'nix' does not fit the property y (float64)"),
        ("1 0 0 2", "1 0 0 256", 12, "'256' does not fit the property red (uint8)"),
        ("end_header", "", 14, "unexpected end of the file, expected the line 'end_header'"),
        ("double x", "half x", 4, "the header is wrong: Unknown scalar type: half"),
        ("double x", "double q", 10, "the header is wrong: the element vertex has not all of the properties x, y, z"),
        (
            "int vertex_i",
            "float vertex_i",
            10,
            "the header is wrong: indices are whole numbers, vertex_indices are float32",
        ),
        (
            "list uchar",
            "list float",
            10,
            "the header is wrong: lists are counted in whole numbers, vertex_indices is not",
        ),
        ("vertex_indices", "corners", 10, "the header is wrong: the element face has not one list vertex_indices"),
        ("element vertex 3", "element point 3", 10, "the header is wrong: there is no element vertex"),
        ("format ascii", "format morse", 2, "the header is wrong: Unknown format: morse"),
    ] {
        let text = good.replace(from, to);
        assert_ne!(text, good);
        let error = error(text.as_bytes());
        assert_eq!((error.line, error.byte), (Some(line), None), "{text}{error}");
        assert_eq!(error.kind.to_string(), message, "{text}");
    }
    assert!(matches!(error(b" \n").kind, ReadErrorKind::Empty));

    let faces = shapes::tetrahedron().to_face_list();
    let whole = binary(&faces, false, false);
    let start = whole.len() - 4 * 14;
    let message = |bytes: &[u8]| error(bytes).to_string();
    let cut = &whole[..whole.len() - 1];
    assert_eq!(message(cut), format!("byte {}: unexpected end of the file, expected face 4 of 4", cut.len()));
    let cut = &whole[..start - 50];
    assert_eq!(message(cut), format!("byte {}: unexpected end of the file, expected vertex 2 of 4", cut.len()));
    let latin = [&b"ply\ncomment gr\xfc\xdfe"[..], &whole[4..whole.len() - 1]].concat();
    assert!(message(&latin).starts_with(&format!("byte {}: unexpected end", latin.len())), "{}", message(&latin));
    let more = [&whole[..], b"more"].concat();
    assert!(message(&more).contains(&format!("byte {}: 4 bytes stand after the last value", whole.len())));
    let mut outside = whole.clone();
    outside[start + 6] = 9;
    assert_eq!(message(&outside), format!("byte {}: index out of range: vertex 9, there are 4", start + 10));
    let mut negative = whole.clone();
    negative[start + 1] = 0x80;
    assert!(
        message(&negative).starts_with(&format!("byte {}: 'a length below 0'", start + 2)),
        "{}",
        message(&negative)
    );
}

#[test]
fn a_header_is_not_believed() {
    let list = "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
        element face 4000000000\nproperty list uint uint vertex_indices\nproperty list uint double texcoord\nend_header\n";
    let zeros = [&[0; 12][..], &[0xff; 4], &[0; 40]].concat();
    let bytes = [list.as_bytes(), &zeros].concat();
    assert!(error(&bytes).to_string().contains("expected face 1 of 4000000000"));
    let vertices = triangle("", [""; 3]).replace("vertex 3", "vertex 4294967295");
    assert!(error(vertices.as_bytes()).to_string().contains("of 4294967295"));
}

#[test]
fn broken_files_are_refused_without_a_panic() {
    let properties =
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float s\nproperty float t\n";
    never_panics(triangle(properties, ["1 2 3 0 0", "4 5 6 0 1", "7 8 9 1 0"]).as_bytes(), io::read_ply);
    let faces = shapes::tetrahedron().to_face_list();
    never_panics(&binary(&faces, false, true), io::read_ply);
    never_panics(&binary(&faces, true, false), io::read_ply);
    for name in ["text.ply", "binary.ply"] {
        never_panics(&fixture(name).0, io::read_ply);
    }
}
