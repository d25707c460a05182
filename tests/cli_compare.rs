//! `vv compare` as its user meets it.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use common::desk::{Desk, SCHEMES, keys, sorted};
use serde_json::Value;

const KEYS: [&str; 16] = [
    "method",
    "level",
    "faces",
    "vertices",
    "t_vertices",
    "o_vertices",
    "max_valence",
    "max_deviation",
    "mean_deviation",
    "max_limit_deviation",
    "equal_percent",
    "balance",
    "min_angle_deg",
    "passes",
    "seconds",
    "bytes",
];

const METHODS: [&str; 8] =
    ["uniform", "simple", "red-green", "red-green-restricted", "incremental-1", "incremental-2", "mobile", "dynamic"];

fn rows(report: &Value) -> &Vec<Value> {
    assert_eq!(keys(report), ["rows"]);
    report["rows"].as_array().expect("rows are a list")
}

#[test]
fn json_has_a_row_for_every_method_and_level() {
    let desk = Desk::new();
    let report = desk.done("compare torus.off --select disk:8,1 --levels 2 --accuracy 0.05 --json").json();
    let names = rows(&report).iter().map(|row| (row["method"].as_str().unwrap(), row["level"].as_u64().unwrap()));
    assert!(names.eq(METHODS.iter().flat_map(|&method| [(method, 1), (method, 2)])));
    for row in rows(&report) {
        assert_eq!(sorted(<[&str; 16]>::try_from(keys(row)).unwrap()), sorted(KEYS));
        assert!(row.as_object().unwrap().values().all(|value| !value.is_null()), "{row}");
    }
    let last = |method: &str| rows(&report).iter().rfind(|row| row["method"] == method).unwrap();
    assert_eq!(last("uniform")["faces"], 60 * 16);
    // Under restriction every vertex is where some uniform mesh has it, at the border one of a level before.
    for method in ["uniform", "incremental-1", "incremental-2", "dynamic"] {
        assert_eq!((&last(method)["equal_percent"], &last(method)["max_deviation"]), (&100.0.into(), &0.0.into()));
    }
    assert!(last("simple")["max_deviation"].as_f64().unwrap() > 1e-3);
}

#[test]
fn what_cannot_run_is_skipped_with_the_reason() {
    let desk = Desk::new();
    for scheme in SCHEMES {
        // The uniform mesh has one face too many.
        let (faces, max_faces) = match scheme {
            "sqrt3" => (120.into(), 119),
            "four-eight" => (Value::Null, 79),
            _ => (160.into(), 159),
        };
        let command =
            format!("compare grid.obj --select vertices:0 --levels 1 --scheme {scheme} --max-faces {max_faces} --json");
        let report = desk.done(&command).json();
        let row = |method: &str| rows(&report).iter().find(|row| row["method"] == method).unwrap();
        let skipped = |method: &str| {
            let row = row(method);
            assert!(row.get("skipped").is_none() || row["seconds"].is_null() && row["equal_percent"].is_null());
            row.get("skipped").map(|reason| reason.as_str().unwrap())
        };
        assert!(skipped("mobile").unwrap().starts_with("accuracy = none: "));
        assert_eq!((skipped("simple"), skipped("incremental-1")), (None, None));
        assert_eq!(skipped("dynamic").is_some(), ["sqrt3", "four-eight"].contains(&scheme));
        assert!(skipped("uniform").unwrap().contains(&format!("allowed are {max_faces}")));
        assert_eq!(row("uniform")["faces"], faces);
        assert_eq!(row("uniform")["vertices"].is_null(), faces.is_null());
    }
}

#[test]
fn tables_have_a_line_a_row() {
    let desk = Desk::new();
    let command = "compare torus.off --select disk:8,1 --levels 2";
    let csv = desk.done(&format!("{command} --csv")).out;
    let mut lines = csv.lines();
    assert_eq!(lines.next().unwrap(), format!("{},skipped", KEYS.join(",")));
    let lines: Vec<&str> = lines.collect();
    assert_eq!(lines.len(), 16);
    assert!(lines.iter().filter(|line| line.contains("accuracy = none")).count() == 2);
    assert!(lines.iter().filter(|line| line.ends_with(',')).count() == 14);

    let markdown = desk.done(&format!("{command} --markdown")).out;
    let table: Vec<&str> = markdown.lines().filter(|line| line.starts_with("| ")).collect();
    assert_eq!(table.len(), 2 + 16);
    assert!(table.iter().all(|line| line.matches('|').count() == 17), "{markdown}");
    assert!(markdown.ends_with(
        "mobile is skipped: accuracy = none: a distance from the limit; `mobile` moves what is farther from it\n"
    ));

    let text = desk.done(command).out;
    assert_eq!(text.lines().count(), 1 + 16 + 1, "{text}");
}

#[test]
fn what_has_no_meaning_is_refused() {
    let desk = Desk::new();
    let refused = |rest: &str, words: &str| desk.vv(&format!("compare torus.off {rest}")).assert_refused(words);
    refused("--select all --levels 0", "--levels");
    refused("--select all --levels 1 --json --csv", "--csv");
    refused("--select all --levels 1 --accuracy 0", "--accuracy");
    refused("--select disk:99,1 --levels 1", "--select");
    refused("--levels 1", "--select");
    refused("--select all --levels 1 --max-faces 100", "around the selection");
    let ran = desk.done("compare torus.off --select vertices:1&vertices:2 --levels 1");
    assert!(ran.err.contains("picks nothing"), "{}", ran.err);
}
