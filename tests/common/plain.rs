//! OFF, OBJ, PLY and STL in a few lines, so that what tests expect of a file does not hang on the crate's own readers.

#![allow(dead_code, reason = "no test file uses all of it")]
#![allow(clippy::unwrap_used, reason = "a file that cannot be read stops the test")]

use std::path::Path;

use vvmesh::Mesh;
use vvmesh::glam::DVec3;
use vvmesh::soup::FaceList;

/// Vertices and polygons of a file, anything else passed over.
pub(crate) fn read(path: &Path) -> FaceList {
    let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let text = String::from_utf8_lossy(&bytes);
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("off") => off(&text),
        Some("ply") => ply(&bytes),
        Some("stl") if text.contains("endsolid") => stl(text.lines().filter_map(|line| {
            let vertex = line.trim_start().strip_prefix("vertex")?;
            Some(point(vertex.split_whitespace()))
        })),
        Some("stl") => stl(bytes[84..].chunks(50).flat_map(|triangle| triangle[12..48].chunks(12).map(single))),
        _ => obj(&text),
    }
}

/// Three coordinates, and corners counted in a byte, as in all the files that there are.
fn ply(bytes: &[u8]) -> FaceList {
    const END: &[u8] = b"end_header\n";
    let start = bytes.windows(END.len()).position(|window| window == END).unwrap() + END.len();
    let header = std::str::from_utf8(&bytes[..start]).unwrap();
    assert!(header.contains("binary_little_endian") && header.contains("list uchar int"), "{header}");
    let count = |name: &str| -> usize {
        let line = header.lines().find_map(|line| line.strip_prefix("element ")?.strip_prefix(name));
        line.unwrap().trim().parse().unwrap()
    };
    let (vertices, faces) = bytes[start..].split_at(12 * count("vertex"));
    let mut list = FaceList::new(vertices.chunks(12).map(single).collect());
    let mut rest = faces;
    while let Some((&sides, more)) = rest.split_first() {
        let (corners, more) = more.split_at(4 * usize::from(sides));
        let corners: Vec<u32> = corners.chunks(4).map(|word| u32::from_le_bytes(word.try_into().unwrap())).collect();
        list.push_face(&corners);
        rest = more;
    }
    assert_eq!(list.face_count(), count("face"));
    list
}

/// Triangles of these corners, equal ones being one vertex.
fn stl(corners: impl Iterator<Item = DVec3>) -> FaceList {
    let mut list = FaceList::default();
    let corners: Vec<u32> = corners
        .map(|corner| {
            let known = list.positions.iter().position(|position| *position == corner);
            let vertex = known.unwrap_or(list.positions.len());
            if known.is_none() {
                list.positions.push(corner);
            }
            vertex as u32
        })
        .collect();
    corners.chunks(3).for_each(|triangle| list.push_face(triangle));
    list
}

fn single(bytes: &[u8]) -> DVec3 {
    let number = |word: &[u8]| f64::from(f32::from_le_bytes(word.try_into().unwrap()));
    DVec3::new(number(&bytes[..4]), number(&bytes[4..8]), number(&bytes[8..12]))
}

fn off(text: &str) -> FaceList {
    let mut lines = text.lines().map(|line| line.split('#').next().unwrap().trim()).filter(|line| !line.is_empty());
    assert!(lines.next().unwrap().ends_with("OFF"));
    let counts: Vec<usize> = lines.next().unwrap().split_whitespace().map(|n| n.parse().unwrap()).collect();
    let mut list = FaceList::new(lines.by_ref().take(counts[0]).map(|line| point(line.split_whitespace())).collect());
    for line in lines.take(counts[1]) {
        let mut numbers = line.split_whitespace();
        let sides: usize = numbers.next().unwrap().parse().unwrap();
        let corners: Vec<u32> = numbers.take(sides).map(|n| n.parse().unwrap()).collect();
        list.push_face(&corners);
    }
    list
}

fn obj(text: &str) -> FaceList {
    let mut list = FaceList::default();
    for line in text.trim_start_matches('\u{feff}').lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => list.positions.push(point(words)),
            Some("f") => {
                let count = list.positions.len() as i64;
                let index = |word: &str| match word.split('/').next().unwrap().parse::<i64>().unwrap() {
                    n if n < 0 => (count + n) as u32,
                    n => (n - 1) as u32,
                };
                let corners: Vec<u32> = words.map(index).collect();
                list.push_face(&corners);
            }
            _ => {}
        }
    }
    list
}

fn point<'a>(words: impl Iterator<Item = &'a str>) -> DVec3 {
    let numbers: Vec<f64> = words.take(3).map(|n| n.parse().unwrap()).collect();
    DVec3::new(numbers[0], numbers[1], numbers[2])
}

/// A row of the tables in the README of the mesh files: the file and its columns by name.
pub(crate) struct Row {
    /// The file below the folder.
    pub(crate) file: String,
    header: Vec<String>,
    cells: Vec<String>,
}

impl Row {
    /// The cell under a heading.
    pub(crate) fn cell(&self, heading: &str) -> &str {
        let at = self.header.iter().position(|name| name == heading);
        &self.cells[at.unwrap_or_else(|| panic!("no column {heading}"))]
    }
}

/// The rows of all files in the tables of the README.
pub(crate) fn tables(folder: &Path) -> Vec<Row> {
    let text = std::fs::read_to_string(folder.join("README.md")).expect("the folder has a README");
    let (mut place, mut header, mut rows) = (String::new(), Vec::new(), Vec::new());
    for line in text.lines() {
        if let Some(heading) = line.strip_prefix("## ") {
            place = heading.split_whitespace().next().unwrap_or_default().to_string();
        }
        let inner = line.strip_prefix("| ").and_then(|line| line.strip_suffix(" |"));
        let cells: Vec<String> = inner.unwrap_or_default().split(" | ").map(|cell| cell.trim().to_string()).collect();
        if cells[0] == "file" {
            header = cells;
        } else if header.iter().any(|name| name == "chi") && inner.is_some() && cells[0].contains('.') {
            rows.push(Row { file: format!("{place}{}", cells[0]), header: header.clone(), cells });
        } else if inner.is_none() {
            header.clear();
        }
    }
    rows
}

/// The manifold meshes among the models, polygons cut into triangles.
pub(crate) fn models(folder: &Path) -> Vec<(String, Mesh)> {
    let is_good = |row: &Row| row.cell("manifold") == "yes" && row.cell("genus") != "-";
    let rows = tables(folder).into_iter().filter(|row| row.file.starts_with("models/") && is_good(row));
    let model = |row: Row| {
        let list = read(&folder.join(&row.file));
        let triangles = list.triangulate().triangles;
        let mesh =
            Mesh::from_triangles(list.positions, &triangles).unwrap_or_else(|error| panic!("{}: {error}", row.file));
        (row.file, mesh)
    };
    let models: Vec<_> = rows.map(model).collect();
    assert!(models.len() >= 55, "only {} models", models.len());
    models
}
