//! OFF: its variants, errors with their lines.

use vvmesh::error::{ReadError, ReadErrorKind};
use vvmesh::glam::DVec3;
use vvmesh::io::{self, Loaded};

fn read(text: &str) -> Loaded {
    io::read_off(text.as_bytes()).unwrap_or_else(|error| panic!("{error}: {text}"))
}

fn error(text: &str) -> ReadError {
    io::read_off(text.as_bytes()).expect_err(text)
}

const VERTICES: &str = "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
const FACES: &str = "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

fn assert_is_tetrahedron(loaded: &Loaded, text: &str) {
    assert_eq!(loaded.faces.positions, [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z], "{text}");
    assert!(loaded.faces.faces().eq([[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]), "{text}");
}

#[test]
fn headers_and_counts_in_all_ways() {
    for head in [
        "OFF\n4 4 6\n",
        "OFF 4 4 6\n",
        "OFF 4 4\n",
        "OFF\n4 4\n",
        "off\r\n4\r\n4\r\n6\r\n\r\n",
        "OFF # a\n# 7 7 7\n\n4 # vertices\n4 0 # faces\n",
        "4 4 6\n",
        "\u{feff}OFF\n4 4 6\n",
        "OFF\n4 4\n6\n",
    ] {
        let text = format!("{head}{VERTICES}# between\n{FACES}");
        let loaded = read(&text);
        assert_is_tetrahedron(&loaded, &text);
        assert_eq!(loaded.notes.len(), usize::from(head.starts_with('4')), "{head}");
        // Words are words, however they are broken into lines.
        let words =
            |between: &str| text.lines().map(|line| line.split('#').next().unwrap()).collect::<Vec<_>>().join(between);
        if head.contains('6') {
            assert_is_tetrahedron(&read(&words(" ")), &text);
        }
        assert_is_tetrahedron(&read(&text.replace('\n', "\r")), &text);
    }
    let stream = format!("OFF 4 4 6 {VERTICES}{FACES}");
    assert_is_tetrahedron(&read(&stream.replace([' ', '\n'], "\n")), &stream);
    assert_eq!(read("OFF\n0 0 0\n").faces.vertex_count(), 0);
}

#[test]
fn normals_colours_and_texture_are_skipped_and_told() {
    for (head, more, notes) in [
        ("COFF", "255 0 0 255", "colours of 4 vertices ignored (line 3 on)"),
        ("COFF", "0.5 0 0", "colours of 4 vertices ignored (line 3 on)"),
        ("COFF", "", ""),
        ("NOFF", "0 0 1", "normals of 4 vertices ignored (line 3 on)"),
        ("STOFF", "0.5 0.5", "texture coordinates of 4 vertices ignored (line 3 on)"),
        (
            "STCNOFF",
            "0 0 1 1 1 1 1 0.5 0.5",
            "normals of 4 vertices ignored (line 3 on)/colours of 4 vertices ignored (line 3 on)/\
             texture coordinates of 4 vertices ignored (line 3 on)",
        ),
        ("NCOFF", "0 0 1 9 9 9", "normals of 4 vertices ignored (line 3 on)/colours of 4 vertices ignored (line 3 on)"),
    ] {
        let vertices: String = VERTICES.lines().map(|line| format!("{line} {more}\n")).collect();
        let text = format!("{head}\n4 4 0\n{vertices}{FACES}");
        let loaded = read(&text);
        assert_is_tetrahedron(&loaded, &text);
        let told: Vec<String> = loaded.notes.iter().map(ToString::to_string).collect();
        assert_eq!(told.join("/"), notes, "{head}");
    }
    for (color, count) in [(" 7", 4), (" 255 0 0", 4), (" 0.1 0.2 0.3 1 # red", 4), (" # 1 2 3", 0)] {
        let faces: String = FACES.lines().map(|line| format!("{line}{color}\n")).collect();
        let text = format!("OFF\n4 4 0\n{VERTICES}{faces}");
        let loaded = read(&text);
        assert_is_tetrahedron(&loaded, &text);
        assert_eq!(loaded.notes.iter().map(|note| note.count).sum::<usize>(), count);
    }
}

#[test]
fn errors_name_the_line_and_what_stands_there() {
    for (text, line, message) in [
        ("OFF\n4 4 0\n0 0 0\n1 0 0\n", 4, "unexpected end of the file, expected vertex 3 of 4"),
        ("OFF\n2 0 0\n0 0 0\n1 0", 4, "unexpected end of the file, expected vertex 2 of 2"),
        ("OFF\n3 2 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n3 0 1\n", 5, "unexpected end of the file, expected face 2 of 2"),
        ("OFF", 1, "unexpected end of the file, expected the count of vertices"),
        ("OFF\n3", 2, "unexpected end of the file, expected the count of faces"),
        ("OFF\n4294967295 99999999999999999999 0\n", 2, "unexpected end of the file, expected vertex 1 of 4294967295"),
        ("OFF\n4294967296 0 0\n", 2, "more vertices than 32-bit ids can name; split the file"),
        ("OFF\n3 9999999999 0\n0 0 0 1 0 0 0 1 0\n", 3, "unexpected end of the file, expected face 1 of 9999999999"),
        ("OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n4294967295 0 1 2\n", 4, "unexpected end of the file, expected face 1 of 1"),
        ("OFF\n-1 0 0\n", 2, "expected a whole number, found '-1'"),
        ("OFF\n3.0 0 0\n", 2, "expected a whole number, found '3.0'"),
        ("OFF\n1 0 0\n0 x 0\n", 3, "expected a number, found 'x'"),
        ("OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 3\n", 4, "index out of range: vertex 3, there are 3"),
        ("OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n3 0\n1 -1\n", 5, "index out of range: vertex -1, there are 3"),
        ("OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2.5\n", 4, "expected a whole number, found '2.5'"),
        ("OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n2 0 1\n", 4, "a face has at least 3 corners, found 2"),
        ("OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n-3 0 1\n", 4, "a face has at least 3 corners, found 0"),
        ("OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2 red 0 0\n", 4, "expected a number, found 'red'"),
        (
            "OFF\n3 1 0\n0 0 0 1 0 0 0 1 0\n3 0 1 2\n\n3 2 1 0\n",
            6,
            "'3' stands after the last face; the counts in the header do not fit the file",
        ),
        ("solid\n", 1, "expected a whole number, found 'solid'"),
    ] {
        let error = error(text);
        assert_eq!((error.line, error.kind.to_string().as_str()), (Some(line), message), "{text}");
    }
    for (text, name) in [
        ("4OFF\n1 0 0\n", "vertices that have not 3 coordinates"),
        ("nOFF 2\n", "vertices that have not 3 coordinates"),
        ("CN4nOFF\n", "vertices that have not 3 coordinates"),
        ("OFF BINARY\n\0\0\0\u{1}", "binary OFF"),
    ] {
        assert!(error(text).to_string().contains(name), "{text}");
    }
    for empty in ["", "# nothing\n \n"] {
        assert!(matches!(error(empty).kind, ReadErrorKind::Empty));
    }
}

#[test]
fn one_long_line_takes_no_long_time() {
    let count = 200_000;
    let mut text = format!("OFF 3 {count} 0 0 0 0 1 0 0 0 1 0 ");
    text.extend(std::iter::repeat_n("3 0 1 2 ", count));
    let start = std::time::Instant::now();
    assert_eq!(read(&text).faces.face_count(), count);
    assert!(start.elapsed() < std::time::Duration::from_secs(10));
}
