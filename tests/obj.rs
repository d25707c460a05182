//! OBJ: every file of the collection, every trap of tobj, errors with their lines, bits that come back.

mod common;
#[path = "common/tables.rs"]
mod tables;

use common::random::{check, check_up_to};
use vvmesh::error::{ReadError, ReadErrorKind, WriteErrorKind};
use vvmesh::glam::DVec3;
use vvmesh::io::{self, Format, Loaded, NoteKind};
use vvmesh::soup::FaceList;
use vvmesh::{Mesh, shapes};

fn read(text: &str) -> Loaded {
    io::read_obj(text.as_bytes()).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn error(text: &str) -> ReadError {
    io::read_obj(text.as_bytes()).expect_err(text)
}

fn faces(list: &FaceList) -> Vec<Vec<u32>> {
    list.faces().map(<[u32]>::to_vec).collect()
}

fn bits(list: &FaceList) -> Vec<[u64; 3]> {
    list.positions.iter().map(|p| p.to_array().map(f64::to_bits)).collect()
}

fn kinds(list: &FaceList) -> String {
    let mut counts = std::collections::BTreeMap::<usize, usize>::new();
    list.faces().for_each(|face| *counts.entry(face.len()).or_default() += 1);
    match counts.keys().collect::<Vec<_>>()[..] {
        [3] => "tri".to_owned(),
        [least, .., greatest] if counts.len() > 4 => format!("{least}..{greatest}-gons"),
        _ => counts.iter().map(|(sides, count)| format!("{count}x{sides}")).collect::<Vec<_>>().join(", "),
    }
}

#[test]
fn every_file_has_its_counts_and_comes_back() {
    let Some(folder) = common::meshes() else { return };
    let is_obj_or_off = |row: &tables::Row| row.file.ends_with("obj") || row.file.ends_with("off");
    for row in tables::readme(&folder).into_iter().filter(is_obj_or_off) {
        let loaded = io::read(folder.join(&row.file)).unwrap();
        assert_eq!(loaded.format, if row.file.ends_with("obj") { Format::Obj } else { Format::Off });
        let list = loaded.faces;
        assert_eq!((list.vertex_count(), list.face_count()), (row.vertices, row.faces), "{}", row.file);
        assert_eq!(kinds(&list), row.kinds, "{}", row.file);
        let corners: usize = list.faces().map(<[u32]>::len).sum();
        if loaded.format == Format::Obj {
            let attributes = &loaded.attributes;
            let has = |index: &dyn Fn(usize) -> bool| (0..corners).any(index);
            assert_eq!(has(&|k| attributes.texture_index(k).is_some()), row.has_texture, "{}", row.file);
            assert_eq!(has(&|k| attributes.normal_index(k).is_some()), row.has_normals, "{}", row.file);
        }
        let (mut obj, mut off) = (Vec::new(), Vec::new());
        io::write_obj(&mut obj, &list).unwrap();
        io::write_off(&mut off, &list).unwrap();
        for again in [io::read_obj(&obj).unwrap(), io::read_off(&off).unwrap()] {
            assert_eq!(bits(&again.faces), bits(&list), "{}", row.file);
            assert_eq!(faces(&again.faces), faces(&list), "{}", row.file);
            assert!(again.notes.is_empty());
        }
    }
}

#[test]
fn bad_files_are_read_or_refused_as_their_index_says() {
    let Some(folder) = common::meshes() else { return };
    for ending in [".obj", ".off"] {
        for [file, reading, building] in tables::bad(&folder, ending) {
            let answer = io::read(folder.join(&file));
            if let Some(expected) = reading.strip_prefix("accept ") {
                let list = answer.unwrap_or_else(|error| panic!("{error}")).faces;
                let counts = format!("{}/{}", list.vertex_count(), list.face_count());
                assert_eq!(counts, expected.split(',').next().unwrap(), "{file}");
                let is_mesh = Mesh::from_triangles(list.positions.clone(), &list.triangulate().triangles).is_ok();
                assert_eq!(is_mesh, !building.starts_with("refuse"), "{file}");
            } else if reading.contains("non-finite") {
                // Reading is lenient here, building is not.
                let list = answer.unwrap().faces;
                assert!(list.positions[5].z.is_nan());
                assert!(Mesh::from_triangles(list.positions.clone(), &list.triangulate().triangles).is_err());
            } else {
                let message = answer.unwrap_err().to_string();
                assert!(message.contains(reading.strip_prefix("refuse ").unwrap()), "{file}: {message}");
                assert!(message.contains(&file), "{message}");
            }
        }
    }
}

#[test]
fn groups_and_materials_split_nothing() {
    let text = "mtllib some where.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\n\
        o thing\ng left right\nusemtl red paint # not blue\nf 1 2 3\n\
        g other\ng left right\nf 1 3 4\n\
        usemtl green\ns 3\nf 4 3 5\n\
        o second\ng\ns off\nf 1 2 5\n";
    let loaded = read(text);
    assert_eq!(loaded.faces.vertex_count(), 5);
    assert_eq!(faces(&loaded.faces), [[0, 1, 2], [0, 2, 3], [3, 2, 4], [0, 1, 4]]);
    let attributes = &loaded.attributes;
    assert_eq!(attributes.material_libraries, ["some where.mtl"]);
    let of =
        |k| (attributes.object(k).unwrap(), attributes.groups(k).collect::<Vec<_>>(), attributes.material(k).unwrap());
    assert_eq!(of(0), ("thing", vec!["left", "right"], "red paint"));
    assert_eq!(of(1), of(0));
    assert_eq!(of(2), ("thing", vec!["left", "right"], "green"));
    assert_eq!(of(3), ("second", vec![], "green"));
    assert_eq!([0, 1, 2, 3].map(|k| attributes.smoothing_group(k)), [0, 0, 3, 0]);
    assert!(loaded.notes.is_empty());
}

#[test]
fn vertices_keep_their_numbers_used_or_not() {
    let loaded = read("v 9 9 9\nv 1 0 0\nv 8 8 8\nv 0 1 0\nv 0 0 0\nf 5 2 4\nv 7 7 7\n");
    assert_eq!(faces(&loaded.faces), [[4, 1, 3]]);
    assert_eq!(loaded.faces.positions[2], DVec3::splat(8.0));
    assert_eq!(loaded.faces.positions[5], DVec3::splat(7.0));
    // Vertices alone, in numbers around those that are named at once.
    for count in [1, 2, 3, 1023, 1024, 1025, 1026, 2051] {
        let text: String = (0..count).map(|k| format!("v {k} 0.5 -{k}\n")).collect();
        let list = read(&text).faces;
        assert_eq!((list.vertex_count(), list.face_count()), (count, 0));
        assert!(list.positions.iter().enumerate().all(|(k, p)| *p == DVec3::new(k as f64, 0.5, -(k as f64))));
    }
}

#[test]
fn corners_keep_their_texture_coordinates_and_normals() {
    let text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0.5\nvt 0.1 0.2\nvt 1 2 3\nvn 0 0 1\n\
        f 1 2 3\nf 1/2 2/-1 3\nf 1//1 2//1 3//-1\nf 1/1/1 2/ 3//\n";
    let loaded = read(text);
    assert_eq!(faces(&loaded.faces), [[0, 1, 2]; 4]);
    let attributes = &loaded.attributes;
    assert_eq!(attributes.texture_coordinates, [[0.5, 0.0, 0.0], [0.1, 0.2, 0.0], [1.0, 2.0, 3.0]]);
    assert_eq!(attributes.normals, [DVec3::Z]);
    let of = |face| loaded.faces.corner_range(face).map(|k| (attributes.texture_index(k), attributes.normal_index(k)));
    assert!(of(0).eq([(None, None); 3]));
    assert!(of(1).eq([(Some(1), None), (Some(2), None), (None, None)]));
    assert!(of(2).eq([(None, Some(0)); 3]));
    assert!(of(3).eq([(Some(0), Some(0)), (None, None), (None, None)]));
}

#[test]
fn what_is_read_is_written_again() {
    let Some(folder) = common::meshes() else { return };
    let mut with_attributes = 0;
    for row in tables::readme(&folder).iter().filter(|row| row.file.ends_with("obj")) {
        let loaded = io::read(folder.join(&row.file)).unwrap();
        with_attributes += usize::from(!loaded.attributes.is_empty());
        let again = written_and_read(&loaded);
        assert_eq!(again.faces, loaded.faces, "{}", row.file);
        assert_eq!(again.attributes, loaded.attributes, "{}", row.file);
    }
    assert!(with_attributes > 5, "there are files with attributes");
}

#[test]
fn attributes_of_every_sort_are_written_again() {
    let text = "mtllib some where.mtl\nmtllib b.mtl\nv 0 0 0 0.5 0.25 1\nv 1 0 0\nv 1 1 0 0 0 1e-300\nv 0 1 0\n\
        vt 0.1 0.2\nvt 1 2\nvt -0 5e-324\nvn 0 0 1\nvn 0 1 0\n\
        f 1 2 3\no thing\ng left right\nusemtl red paint\ns 3\nf 1/1 2/2 3/3 4/1\nf 1//2 3//1 4\n\
        o\ng\nusemtl\nf 1/3/2 2 3/1\ng left\ns off\nf 1/3/2 2/1/1 3/1/1\n";
    let loaded = read(text);
    let again = written_and_read(&loaded);
    assert_eq!(again.attributes, loaded.attributes);
    assert_eq!(again.faces, loaded.faces);
    let mut written = Vec::new();
    io::write_obj_with(&mut written, &loaded.faces, &loaded.attributes).unwrap();
    assert_eq!(String::from_utf8(written).unwrap(), text);
    // A third value anywhere is written for all.
    let deep = read("v 0 0 0\nvt 1\nvt 1 2 3\n");
    assert_eq!(written_and_read(&deep).attributes, deep.attributes);
}

fn written_and_read(loaded: &Loaded) -> Loaded {
    let mut written = Vec::new();
    io::write_obj_with(&mut written, &loaded.faces, &loaded.attributes).expect("a list can be written to");
    io::read_obj(&written).expect("what is written can be read")
}

#[test]
fn triangles_of_polygons_keep_what_is_said_of_their_corners() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n\
        g triangle\nf 2/2 5 3/3\ng quad\nf 1/1//1 2/2 3/3 4\n"
        .replace("//1", "/1");
    let loaded = read(&text);
    let cut = loaded.faces.triangulate();
    let attributes = loaded.attributes.of_triangles(&loaded.faces, &cut);
    assert_eq!(cut.face_of, [0, 1, 1]);
    for (k, (triangle, &face)) in cut.triangles.iter().zip(&cut.face_of).enumerate() {
        let face = face as usize;
        assert!(attributes.groups(k).eq(loaded.attributes.groups(face)));
        for (corner, v) in triangle.iter().enumerate() {
            let place = loaded.faces.face(face).iter().position(|w| w == v).unwrap();
            let of_face = loaded.faces.corner_range(face).start + place;
            assert_eq!(attributes.texture_index(3 * k + corner), loaded.attributes.texture_index(of_face));
            assert_eq!(attributes.normal_index(3 * k + corner), loaded.attributes.normal_index(of_face));
        }
    }
}

#[test]
fn lines_are_read_however_they_are_written() {
    let plain = read("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n").faces;
    for text in [
        "\u{feff}v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4",
        "v 0 0 0\rv 1 0 0\rv 1 1 0\rv 0 1 0\rf 1 2 3 4\r",
        "# C:\\\n\tv\t0 0\t0 # first\n  v +1.0 0. .0\n#x\nv 1e0 1 0 \t\nv 0 1 0 #\nf 1 2 3 4 # last",
        "v 0 \\\n 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 \\  \r\n 2 3\\\n4 # end\n",
        "v 0 0 0\nv 1 0 0\nf -2 -1 +3 4\nv 1 1 0\nv 0 1 0",
        "v 0 0 0 1\nv 1 0 0 2\nv 1 1 0\nv 0 1 0 0 0 0\nf 1 2 3 4\\",
    ] {
        let list = read(text).faces;
        assert_eq!(bits(&list), bits(&plain), "{text}");
        assert_eq!(faces(&list), [[0, 1, 2, 3]], "{text}");
    }
}

#[test]
fn numbers_are_double_precision_and_may_be_none() {
    let list = read("v 0.1 1e400 -nan\nv 1e-400 -0 4.9e-324\nv inf -Infinity NaN\n").faces;
    assert_eq!(list.positions[0].x.to_bits(), 0.1_f64.to_bits());
    assert_eq!(list.positions[0].y, f64::INFINITY);
    assert!(list.positions[0].z.is_nan() && list.positions[2].z.is_nan());
    assert_eq!(bits(&list)[1], [0.0, -0.0, 5e-324].map(f64::to_bits));
    assert_eq!(list.positions[2].y, f64::NEG_INFINITY);
}

#[test]
fn what_is_ignored_is_told() {
    let text = "t interpolateboundary 1/0/0 1\nv 0 0 0\nv 1 0 0 5\nv 0 1 0 0.5 0.25 1\nl 1 2 3\np 1\nvp 1 2\ncurv 1 2\n\
        lod 3\nfancy 1\nt x\nf 1 2 3\nfancier\n";
    let loaded = read(text);
    assert_eq!(faces(&loaded.faces), [[0, 1, 2]]);
    assert_eq!(loaded.faces.positions[1], DVec3::X);
    assert_eq!(loaded.attributes.vertex_colors, [None, None, Some([0.5, 0.25, 1.0])]);
    let told: Vec<String> = loaded.notes.iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        [
            "2 tag lines 't' ignored (line 1 on)",
            "fourth coordinate of 1 vertex ignored (line 3)",
            "colours of 1 vertex kept as attributes (line 4)",
            "1 polyline ignored (line 5)",
            "1 line of points ignored (line 6)",
            "2 lines of free-form geometry ignored (line 7 on)",
            "1 rendering statement ignored (line 9)",
            "2 unknown statements ignored, first 'fancy' (line 10 on)",
        ]
    );
}

#[test]
fn errors_name_the_line_and_what_stands_there() {
    let v = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    for (more, line, message) in [
        ("f 1 2 0", 4, "index out of range: vertex 0, indices count from 1"),
        ("f 1 2 -0", 4, "index out of range: vertex 0, indices count from 1"),
        ("\n# x\nf 1 2 4\n", 6, "index out of range: vertex 4, there are 3"),
        ("f 1 2 -4", 4, "index out of range: vertex -4, there are 3"),
        ("f 1 2 -9223372036854775809", 4, "index out of range: vertex -9223372036854775807, there are 3"),
        ("f 1 2 99999999999999999999", 4, "index out of range: vertex 9223372036854775807, there are 3"),
        ("f 1 2 4294967297", 4, "index out of range: vertex 4294967297, there are 3"),
        ("f 1 2 2.0", 4, "expected a whole number, found '2.0'"),
        ("f 1 2 x", 4, "expected a whole number, found 'x'"),
        ("f 1 2 /1", 4, "expected a whole number, found ''"),
        ("f 1 2 3/1", 4, "index out of range: texture coordinate 1, there are 0"),
        ("f 1 2 3//-1", 4, "index out of range: normal -1, there are 0"),
        ("vt 0\nvn 0 0 1\nf 1 2 3/1/1/1", 6, "expected a whole number, found '3/1/1/1'"),
        ("f 1 2", 4, "a face has at least 3 corners, found 2"),
        ("f", 4, "a face has at least 3 corners, found 0"),
        ("f 1 \\\n\\\n 2\nf 1 2 3", 4, "a face has at least 3 corners, found 2"),
        ("f 1 2 3\u{a0}1", 4, "expected a whole number, found '3\u{a0}1'"),
        ("v 1 2", 4, "a vertex has 3, 4, 6 or 7 numbers, found 2"),
        ("v", 4, "a vertex has 3, 4, 6 or 7 numbers, found 0"),
        ("v 1 2 3 4 5", 4, "a vertex has 3, 4, 6 or 7 numbers, found 5"),
        ("v 1 2,5 3\n", 4, "expected a number, found '2,5'"),
        ("v 1 2 \\\n1.#QNAN", 4, "expected a number, found '1.#QNAN'"),
        ("v 1 2 3 x # y", 4, "expected a number, found 'x'"),
        ("v 1 2 0x10 # y", 4, "expected a number, found '0x10'"),
        ("v 1 2 3\u{a0}4", 4, "expected a number, found '3\u{a0}4'"),
        ("v 1 2 3 1 1 red", 4, "expected a number, found 'red'"),
        ("vt", 4, "a texture coordinate has 1 to 3 numbers, found 0"),
        ("vn 1 2", 4, "a normal has 3 numbers, found 2"),
        ("vn 1 2 z", 4, "expected a number, found 'z'"),
    ] {
        let error = error(&format!("{v}{more}"));
        assert_eq!((error.line, error.kind.to_string().as_str()), (Some(line), message), "{more}");
    }
    for empty in ["", " \n\t", "# nothing\n", "\u{feff}"] {
        assert!(matches!(error(empty).kind, ReadErrorKind::Empty), "{empty}");
    }
    assert!(matches!(error("hello\nworld\n").kind, ReadErrorKind::NoVertex));
    assert!(io::read_obj(b"\xff\xfev\0 \0").unwrap_err().to_string().contains("UTF-16"));
    assert!(io::read_obj(b"# caf\xe9\ng \xe9t\xe9\nv 0 0 0\n").is_ok());
    let bad = io::read_obj(b"v 0 0 0\nv 0 \xe9 0\n").unwrap_err();
    assert_eq!(bad.to_string(), "line 2: expected a number, found '\u{fffd}'");
}

#[test]
fn the_content_tells_more_than_the_ending() {
    let folder = tempfile::tempdir().unwrap();
    let put = |name: &str, text: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        io::read(&path)
    };
    let (obj, off) = (b"# a\nv 0 0 0\n", b"# a\nOFF\n1 0 0\n0 0 0\n");
    for (name, text, format, told) in [
        ("a.obj", &obj[..], Format::Obj, false),
        ("a.OFF", &off[..], Format::Off, false),
        ("b.obj", &off[..], Format::Off, true),
        ("b.off", &obj[..], Format::Obj, true),
        ("c", &obj[..], Format::Obj, false),
        ("c.dat", &off[..], Format::Off, false),
        ("d.off", b"1 0 0\n0 0 0", Format::Off, false),
    ] {
        let loaded = put(name, text).unwrap();
        assert_eq!(loaded.format, format, "{name}");
        assert_eq!(loaded.faces.vertex_count(), 1);
        assert_eq!(loaded.notes.iter().any(|note| note.kind == NoteKind::Ending(format)), told, "{name}");
    }
    for (name, text, message) in [
        ("e.txt", &b"1 0 0"[..], "OBJ (.obj), OFF (.off), PLY (.ply) and STL (.stl) are read"),
        ("e.obj", b"glTF\x02\0\0\0", "this is glTF"),
        ("f.obj", b"\n", "empty"),
        ("g.obj", b"v 1 2 x", "line 1: expected a number, found 'x'"),
    ] {
        let message_found = put(name, text).unwrap_err().to_string();
        assert!(message_found.contains(message) && message_found.contains(name), "{message_found}");
    }
    assert!(matches!(io::read(folder.path().join("none.obj")).unwrap_err().kind, ReadErrorKind::Io(_)));
    assert!(matches!(io::read(folder.path()).unwrap_err().kind, ReadErrorKind::Io(_)));
}

#[test]
fn files_are_written_whole_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mesh.obj");
    let mesh = shapes::octahedron();
    io::save(&path, &mesh).unwrap();
    assert_eq!(io::read(&path).unwrap().faces, mesh.to_face_list());
    let before = std::fs::read(&path).unwrap();
    let failing = |out: &mut dyn std::io::Write| {
        out.write_all(&[b'x'; 100_000])?;
        Err(std::io::Error::other("the pen is dry"))
    };
    let error = io::write_atomically(&path, |out| failing(out)).unwrap_err();
    assert!(error.to_string().contains("the pen is dry") && error.to_string().contains("mesh.obj"));
    assert_eq!(std::fs::read(&path).unwrap(), before);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "a temporary file is left");

    let kind = |path: &std::path::Path| io::save(path, &mesh).unwrap_err().kind;
    assert!(matches!(kind(&folder.path().join("mesh.gltf")), WriteErrorKind::UnknownEnding));
    assert!(matches!(kind(&folder.path().join("none/mesh.obj")), WriteErrorKind::Io(_)));
    std::fs::create_dir(folder.path().join("folder.obj")).unwrap();
    assert!(matches!(kind(&folder.path().join("folder.obj")), WriteErrorKind::Folder));
    let mut permissions = std::fs::metadata(&path).unwrap().permissions();
    permissions.set_readonly(true);
    std::fs::set_permissions(&path, permissions).unwrap();
    assert!(matches!(kind(&path), WriteErrorKind::ReadOnly));
}

#[cfg(unix)]
#[test]
fn permissions_and_links_stay() {
    use std::os::unix::fs::{PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let [target, link, usual] = ["target.obj", "link.obj", "usual"].map(|name| folder.path().join(name));
    let mode = |path: &std::path::Path| std::fs::metadata(path).unwrap().permissions().mode() & 0o777;
    std::fs::write(&usual, "").unwrap();
    symlink("target.obj", &link).unwrap();
    io::save(&link, &shapes::tetrahedron()).unwrap();
    assert!(std::fs::symlink_metadata(&link).unwrap().is_symlink() && target.is_file());
    assert_eq!(mode(&target), mode(&usual));
    std::fs::set_permissions(&target, std::fs::Permissions::from_mode(0o640)).unwrap();
    io::save(&link, &shapes::octahedron()).unwrap();
    assert_eq!(mode(&target), 0o640);
    assert_eq!(io::read(&link).unwrap().faces.face_count(), 8);
    io::write_atomically("/dev/null", |out| std::io::Write::write_all(out, b"x")).unwrap();
    assert!(!std::path::Path::new("/dev/null").is_file());
}

#[test]
fn all_bits_come_back() {
    fn property(numbers: Vec<(u64, u64, u64)>) -> bool {
        let number = |bits: u64| Some(f64::from_bits(bits)).filter(|x| !x.is_nan()).unwrap_or(-0.0);
        let list =
            FaceList::new(numbers.into_iter().map(|(x, y, z)| DVec3::new(number(x), number(y), number(z))).collect());
        let (mut obj, mut off) = (Vec::new(), Vec::new());
        io::write_obj(&mut obj, &list).unwrap();
        io::write_off(&mut off, &list).unwrap();
        let from_off = io::read_off(&off).unwrap();
        bits(&from_off.faces) == bits(&list)
            && (list.positions.is_empty() || bits(&io::read_obj(&obj).unwrap().faces) == bits(&list))
    }
    check_up_to(50, 228, 100, property as fn(_) -> bool);
}

#[test]
fn no_bytes_do_harm() {
    fn random(bytes: Vec<u8>) {
        let _ = io::read_obj(&bytes);
        let _ = io::read_off(&bytes);
        let _ = io::read_off(&[&b"OFF\n2 3 0\n"[..], &bytes].concat());
    }
    /// Puts words together that mean something.
    fn words(choice: Vec<u8>) {
        const WORDS: [&str; 32] = [
            "v",
            "f",
            "vt",
            "vn",
            "g",
            "o",
            "usemtl",
            "\n",
            "\n",
            "\n",
            "\\\n",
            " ",
            "0",
            "1",
            "-1",
            "2",
            "3",
            "1/1",
            "1//1",
            "1/1/1",
            "nan",
            "1e999",
            "#",
            "l",
            "p",
            "s",
            "OFF",
            "COFF",
            "\u{a0}",
            "99999999999",
            "\r",
            "x",
        ];
        let text: String = choice.iter().map(|&k| format!("{} ", WORDS[k as usize % 32])).collect();
        for text in [text.clone(), format!("v 0 0 0\nv 1 0 0\nvt 0\nvn 0 0 1\n{text}"), format!("OFF 3 2 0\n{text}")] {
            for loaded in [io::read_obj(text.as_bytes()), io::read_off(text.as_bytes())].into_iter().flatten() {
                let list = loaded.faces;
                assert!(list.faces().flatten().all(|&corner| (corner as usize) < list.vertex_count()));
                let _ = list.triangulate();
                for face in 0..list.face_count() {
                    let _ = (loaded.attributes.groups(face).count(), loaded.attributes.material(face));
                }
            }
        }
    }
    fn mutated(place: usize, byte: u8) {
        let text =
            b"\xef\xbb\xbfv 0 0 0\nv 1 0 0 \\\r\nv 0 1 0 1 1 1\nvt 1 2\ng a b\nf 1/1 2/1 -1/1\nl 1 2\nf 1 2 3 1\n";
        let mut text = text.to_vec();
        let place = place % text.len();
        text[place] = byte;
        let _ = io::read_obj(&text);
        let _ = io::read_obj(&text[..place]);
    }
    check(229, 2000, random as fn(_));
    check(230, 2000, words as fn(_));
    check(231, 2000, mutated as fn(_, _));
}
