//! A reader of well-formed OBJ and OFF files, apart from that of the library; polygons become fans.

use std::path::Path;

use vvmesh::Mesh;
use vvmesh::glam::DVec3;

/// Reads a mesh.
///
/// # Panics
/// If there is no such file, or it is no mesh.
pub fn load(path: &Path) -> Mesh {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let (positions, faces) =
        if path.extension().is_some_and(|ending| ending == "off") { off(&text) } else { obj(&text) };
    let fan = |face: &Vec<u32>| (2..face.len()).map(|k| [face[0], face[k - 1], face[k]]).collect::<Vec<_>>();
    let triangles: Vec<[u32; 3]> = faces.iter().flat_map(fan).collect();
    Mesh::from_triangles(positions, &triangles).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn obj(text: &str) -> (Vec<DVec3>, Vec<Vec<u32>>) {
    let (mut positions, mut faces) = (Vec::new(), Vec::new());
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => positions.push(point(words)),
            Some("f") => faces.push(words.map(|word| index(word.split('/').next()) - 1).collect()),
            _ => {}
        }
    }
    (positions, faces)
}

fn off(text: &str) -> (Vec<DVec3>, Vec<Vec<u32>>) {
    let lines = text.lines().map(|line| line.split('#').next().unwrap_or_default().trim());
    let mut lines = lines.filter(|line| !line.is_empty() && *line != "OFF");
    let counts: Vec<usize> = {
        let line = lines.next().expect("an OFF file has counts");
        line.split_whitespace().map(|word| word.parse().expect("a count")).collect()
    };
    let positions = lines.by_ref().take(counts[0]).map(|line| point(line.split_whitespace())).collect();
    let faces = lines.take(counts[1]).map(|line| {
        let mut words = line.split_whitespace();
        let sides = index(words.next()) as usize;
        words.take(sides).map(|word| index(Some(word))).collect()
    });
    (positions, faces.collect())
}

fn point<'a>(mut words: impl Iterator<Item = &'a str>) -> DVec3 {
    let mut number = || words.next().and_then(|word| word.parse().ok()).expect("a coordinate");
    DVec3::new(number(), number(), number())
}

fn index(word: Option<&str>) -> u32 {
    word.and_then(|word| word.parse().ok()).expect("an index")
}
