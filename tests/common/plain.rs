//! OFF and OBJ in a few lines, so that what tests expect of a file does not hang on the crate's own readers.

#![allow(dead_code, reason = "no test file uses all of it")]
#![allow(clippy::unwrap_used, reason = "a file that cannot be read stops the test")]

use std::path::Path;

use vvmesh::glam::DVec3;
use vvmesh::soup::FaceList;

/// Vertices and polygons of a file, anything else passed over.
pub(crate) fn read(path: &Path) -> FaceList {
    let text = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    if path.extension().is_some_and(|ending| ending == "off") { off(&text) } else { obj(&text) }
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

/// The rows of all OBJ and OFF files in the tables of the README.
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
        } else if header.iter().any(|name| name == "chi") && (cells[0].ends_with(".off") || cells[0].ends_with(".obj"))
        {
            rows.push(Row { file: format!("{place}{}", cells[0]), header: header.clone(), cells });
        } else if inner.is_none() {
            header.clear();
        }
    }
    rows
}
