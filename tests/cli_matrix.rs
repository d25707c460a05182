//! `vv matrix` as its user meets it: the matrix of what `vv subdivide` makes, its sizes, what is refused.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use common::desk::{Desk, METHODS, SCHEMES, keys, sorted};
use vvmesh::glam::DVec3;

/// A matrix as it stands in a file.
struct Read {
    comments: Vec<String>,
    rows: usize,
    columns: usize,
    entries: Vec<(usize, usize, f64)>,
}

/// A number with a comma at every third digit.
fn grouped(number: &serde_json::Value) -> String {
    let digits = number.to_string();
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && (digits.len() - k) % 3 == 0 {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// Reads `coordinate real general` by the letter: a header, comments, sizes, entries counted from 1.
fn read(text: &str) -> Read {
    let mut lines = text.lines().peekable();
    assert_eq!(lines.next(), Some("%%MatrixMarket matrix coordinate real general"));
    let mut comments = Vec::new();
    while let Some(line) = lines.next_if(|line| line.starts_with('%')) {
        comments.push(line[1..].trim().to_owned());
    }
    let numbers = |line: &str| line.split(' ').map(|word| word.parse::<f64>().unwrap()).collect::<Vec<_>>();
    let sizes = numbers(lines.next().unwrap());
    let [rows, columns, count] = [0, 1, 2].map(|k| sizes[k] as usize);
    let entries: Vec<_> = lines
        .map(|line| {
            let entry = numbers(line);
            assert!(entry.len() == 3 && (1.0..=rows as f64).contains(&entry[0]), "{line}");
            assert!((1.0..=columns as f64).contains(&entry[1]), "{line}");
            (entry[0] as usize - 1, entry[1] as usize - 1, entry[2])
        })
        .collect();
    assert_eq!(entries.len(), count);
    Read { comments, rows, columns, entries }
}

impl Read {
    fn times(&self, positions: &[DVec3]) -> Vec<DVec3> {
        assert_eq!(positions.len(), self.columns);
        let mut product = vec![DVec3::ZERO; self.rows];
        for &(row, column, weight) in &self.entries {
            product[row] += weight * positions[column];
        }
        product
    }
}

fn is_near(made: &[DVec3], expected: &[DVec3]) -> bool {
    made.len() == expected.len() && made.iter().zip(expected).all(|(made, expected)| made.distance(*expected) < 1e-12)
}

#[test]
fn the_matrix_makes_what_subdivide_writes() {
    let desk = Desk::new();
    desk.write("sharp.txt", "0 1\n7 8\n14\n");
    for mesh in ["grid.obj", "torus.off"] {
        let cage = desk.mesh(mesh);
        for scheme in SCHEMES {
            for method in METHODS {
                let sharp = if scheme == "loop" && mesh == "grid.obj" { "--sharp sharp.txt" } else { "" };
                let options = format!(
                    "--scheme {scheme} --levels 3 --method {method} --select disk:8,1 --max-faces 10000 {sharp}"
                );
                desk.done(&format!("subdivide {mesh} -o fine.off {options}"));
                let ran = desk.done(&format!("matrix {mesh} -o S.mtx {options}"));
                let matrix = read(&desk.read("S.mtx"));
                let [rows, columns, nonzeros] = [matrix.rows, matrix.columns, matrix.entries.len()];
                assert_eq!(ran.out, format!("wrote S.mtx: {rows} rows, {columns} columns, {nonzeros} nonzeros\n"));
                assert!(is_near(&matrix.times(cage.positions()), desk.mesh("fine.off").positions()), "{options}");
            }
        }
    }
}

#[test]
fn limit_rows_make_limit_positions() {
    let desk = Desk::new();
    for levels in [0, 1, 2, 3] {
        for (mesh, scheme) in [("torus.off", "loop --weights warren"), ("torus.off", "sqrt3"), ("grid.obj", "sqrt3")] {
            let options = format!("--scheme {scheme} --levels {levels} --method uniform --limit");
            if mesh == "grid.obj" && levels % 2 == 1 {
                desk.vv(&format!("matrix {mesh} -o S.mtx {options}")).assert_refused("take an even number of levels");
                continue;
            }
            desk.done(&format!("subdivide {mesh} -o fine.off {options}"));
            desk.done(&format!("matrix {mesh} -o S.mtx {options}"));
            let made = read(&desk.read("S.mtx")).times(desk.mesh(mesh).positions());
            assert!(is_near(&made, desk.mesh("fine.off").positions()));
        }
    }
}

#[test]
fn no_levels_are_the_identity() {
    let desk = Desk::new();
    desk.done("matrix grid.obj -o I.MTX --scheme butterfly --levels 0 --method simple --select vertices:3");
    let matrix = read(&desk.read("I.MTX"));
    assert!(matrix.entries.into_iter().eq((0..30).map(|k| (k, k, 1.0))));
}

#[test]
fn the_file_names_its_command_and_the_sizes_are_told() {
    let desk = Desk::new();
    let arguments =
        ["matrix", "torus.off", "-o", "S.mtx", "--scheme=loop", "--levels", "1", "--method", "uniform", "--json"];
    let ran = desk.run(&[&arguments[..], &["--select", "all | all"]].concat());
    let sizes = ran.json();
    assert_eq!(keys(&sizes), sorted(["rows", "columns", "nonzeros", "bytes"]));
    let nonzeros = 7 * 30 + 4 * 90;
    assert_eq!([&sizes["rows"], &sizes["columns"], &sizes["nonzeros"]], [120, 30, nonzeros]);
    assert_eq!(sizes["bytes"], 12 * nonzeros + 8 * 121);
    let command = "matrix torus.off -o S.mtx --scheme=loop --levels 1 --method uniform --json --select \"all | all\"";
    assert_eq!(read(&desk.read("S.mtx")).comments, [format!("vv {} {command}", env!("CARGO_PKG_VERSION"))]);
}

#[test]
fn what_makes_no_sense_or_does_not_fit_is_refused_before_it_begins() {
    let desk = Desk::new();
    let names = desk.names();
    for (arguments, words) in [
        ("matrix torus.off -o S.txt --scheme loop --levels 1 --method uniform", "-o: S.txt: the name must end in .mtx"),
        ("matrix torus.off -o no/S.mtx --scheme loop --levels 1 --method uniform", "there is no folder no"),
        ("matrix torus.off -o S.mtx --scheme loop --levels 1 --method uniform --rings 2", "--rings has no meaning"),
        ("matrix torus.off -o S.mtx --scheme butterfly --levels 1 --method uniform --limit", "which is their limit"),
        ("matrix torus.off -o S.mtx --scheme sqrt3 --levels 2 --method simple --limit", "after `uniform` steps only"),
        ("matrix torus.off -o S.mtx --scheme four-eight --levels 1 --method uniform --limit", "limits are not known"),
        (
            "matrix torus.off -o S.mtx --scheme loop --levels 2 --method uniform --max-faces 959",
            "level 2 would have 960",
        ),
        ("matrix torus.off -o S.mtx --scheme loop --levels 40 --method uniform", "GiB of free memory hold about"),
        ("matrix torus.off -o S.mtx --scheme loop --levels 2 --method simple --max-faces 100", "level 1 would have"),
        ("matrix torus.off -o S.mtx --scheme loop --levels 1 --method simple --select disk:99,1", "--select"),
    ] {
        desk.vv(arguments).assert_refused(words);
        assert_eq!(desk.names(), names, "{arguments}");
    }
}

/// Rows near a vertex of 30,000 neighbours have 30,000 weights: terabytes, where a regular mesh takes little.
#[test]
fn a_matrix_that_would_be_full_is_refused() {
    let desk = Desk::new();
    let mut cone = "v 0 0 1\n".to_owned();
    for k in 0..30_000 {
        let angle = std::f64::consts::TAU * f64::from(k) / 30_000.0;
        cone += &format!("v {} {} 0\nf 1 {} {}\n", angle.cos(), angle.sin(), k + 2, (k + 1) % 30_000 + 2);
    }
    desk.write("cone.obj", cone);
    let refused = desk.vv("matrix cone.obj -o S.mtx --scheme loop --levels 5 --method uniform");
    refused.assert_refused("GiB of free memory hold about");
    desk.done("matrix cone.obj -o S.mtx --scheme midpoint --levels 1 --method uniform");
}

#[test]
fn the_sizes_in_the_record_are_these() {
    let Some(folder) = common::meshes() else { return };
    let path = folder.join("models/spot_control_mesh.obj");
    let record = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/benches/RECORD.md")).unwrap();
    let desk = Desk::new();
    for (name, options) in [
        ("Loop", "loop --method uniform"),
        ("Loop, limit positions", "loop --method uniform --limit"),
        ("Butterfly", "butterfly --method uniform"),
        ("modified Butterfly", "modified-butterfly --method uniform"),
        ("midpoint", "midpoint --method uniform"),
        ("√3", "sqrt3 --method uniform"),
        ("4-8", "four-eight --method uniform"),
        ("Loop, incremental", "loop --method incremental --select disk:0,4"),
        ("√3, incremental", "sqrt3 --method incremental --select disk:0,4"),
        ("√3, simple", "sqrt3 --method simple --select disk:0,4"),
        ("4-8, incremental", "four-eight --method incremental --select disk:0,4"),
    ] {
        let mut line = format!("| {name} |");
        for level in ["1", "2", "3", "4"] {
            let fixed = ["matrix", path.to_str().unwrap(), "-o", "S.mtx", "--json", "--levels", level, "--scheme"];
            let sizes = desk.run(&fixed.into_iter().chain(options.split(' ')).collect::<Vec<_>>()).json();
            line += &format!(" {} / {} |", grouped(&sizes["nonzeros"]), grouped(&sizes["bytes"]));
        }
        assert!(record.lines().any(|row| row == line), "the record has not this row:\n{line}");
    }
}
