//! The tables that come with the mesh files.

#![allow(dead_code, reason = "each test file uses a part of it")]
#![allow(clippy::unwrap_used, reason = "a table that cannot be read fails the test")]

use std::path::Path;

/// A row of the tables in the README of the mesh files.
pub(crate) struct Row {
    /// The path from the folder of mesh files.
    pub(crate) file: String,
    pub(crate) vertices: usize,
    pub(crate) faces: usize,
    /// `tri`, or counts by number of sides.
    pub(crate) kinds: String,
    pub(crate) is_manifold: bool,
    pub(crate) is_orientable: bool,
    pub(crate) euler_characteristic: i64,
    /// Whether a table says that corners have texture coordinates, or normals.
    pub(crate) has_texture: bool,
    pub(crate) has_normals: bool,
}

/// The rows of all files that are read; PLY is, with the feature for it.
pub(crate) fn readme(folder: &Path) -> Vec<Row> {
    let text = std::fs::read_to_string(folder.join("README.md")).unwrap();
    let mut rows = Vec::new();
    let mut section = "";
    for line in text.lines() {
        if let Some(title) = line.strip_prefix("## ") {
            section = title.split(' ').next().unwrap();
        }
        let cells: Vec<&str> = line.split('|').map(str::trim).collect();
        let is_mesh = |name: &str| {
            let is_read = |ending: &str| ending != "ply" || cfg!(feature = "ply");
            name.rsplit_once('.').is_some_and(|(_, ending)| is_read(ending))
        };
        if cells.len() != 15 || !section.ends_with('/') || !is_mesh(cells[1]) {
            continue;
        }
        rows.push(Row {
            file: format!("{section}{}", cells[1]),
            vertices: cells[2].parse().unwrap(),
            faces: cells[3].parse().unwrap(),
            kinds: cells[4].to_owned(),
            is_manifold: cells[5] == "yes",
            is_orientable: !cells[13].contains("non-orientable"),
            euler_characteristic: cells[9].parse().unwrap(),
            has_texture: cells[12].split(' ').any(|word| word == "vt"),
            has_normals: cells[12].split(' ').any(|word| word == "n"),
        });
    }
    assert!(rows.len() >= 74, "the tables have changed: {} rows", rows.len());
    rows
}

/// A row of `bad/INDEX.tsv`: file, what reading should do, what building should do.
pub(crate) fn bad(folder: &Path, ending: &str) -> Vec<[String; 3]> {
    let text = std::fs::read_to_string(folder.join("bad/INDEX.tsv")).unwrap();
    let cells = text.lines().skip(1).map(|line| line.split('\t').collect::<Vec<_>>());
    let rows: Vec<_> = cells
        .filter(|cells| cells[0].ends_with(ending))
        .map(|cells| [format!("bad/{}", cells[0]), cells[2].to_owned(), cells[3].to_owned()])
        .collect();
    assert!(!rows.is_empty());
    rows
}
