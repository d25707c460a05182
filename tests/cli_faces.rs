//! Selections of faces, lists of thresholds, diagonals and the least movement, as a user of `vv` meets them.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use common::desk::{Desk, numbers};

const ITERATIVE: &str = "--scheme butterfly --method simple";

#[test]
fn faces_are_printed_as_they_are_read() {
    let desk = Desk::new();
    let selected = desk.done("select torus.off --select faces:7,3,7,12 --json").json();
    assert_eq!([&selected["kind"], &selected["selected"]], [&"faces".into(), &serde_json::json!(8)]);
    assert_eq!(numbers(&selected["selected_faces"]), [3, 7, 12]);
    let text = desk.done("select torus.off --select faces:7,3,7,12").out;
    assert_eq!(text, "# faces:7,3,7,12: 3 of 60 faces\n3\n7\n12\n");
    desk.write("faces.txt", &text);
    let again = desk.done("select torus.off --select faces:@faces.txt --json").json();
    assert_eq!(again["selected_faces"], selected["selected_faces"]);
    // With rings, or vertices beside them, they are vertices.
    let ringed = desk.done("select torus.off --select faces:3 --rings 1").out;
    assert!(
        ringed.starts_with("# faces:3: 1 of 60 faces, ") && ringed.contains(" vertices within 1 ring\n"),
        "{ringed}"
    );
    let mixed = desk.run(&["select", "torus.off", "--select", "faces:3 & all", "--json"]).json();
    assert_eq!((mixed["kind"].as_str(), numbers(&mixed["selected_vertices"]).len()), (Some("vertices"), 3));
    assert!(mixed.get("selected_faces").is_none());
    desk.vv("select torus.off --select faces:60").assert_refused("there is no face 60: the mesh has 60 faces");
}

/// Numbers are those of the file, whatever the order is in which the mesh lists its faces.
#[test]
fn numbers_are_those_of_the_file() {
    let desk = Desk::new();
    desk.write("mixed.off", "OFF\n6 3 0\n0 0 0\n1 0 0\n2 0 0\n0 1 0\n1 1 0\n2 1 0\n4 1 2 5 4\n3 3 1 4\n3 1 3 0\n");
    let corners = |faces: &str| {
        numbers(&desk.done(&format!("select mixed.off --select {faces} --json")).json()["selected_vertices"])
    };
    assert_eq!(corners("faces:0,1"), [1, 2, 4, 5]);
    assert_eq!([corners("faces:2"), corners("faces:3")], [[1, 3, 4], [0, 1, 3]]);
    desk.vv("select mixed.off --select faces:4").assert_refused("the mesh has 4 faces, ids 0 to 3");
}

#[test]
fn selected_faces_are_followed_and_told_in_the_table() {
    let desk = Desk::new();
    for (method, faces) in [("simple", 16), ("incremental", 16), ("red-green", 16), ("uniform", 16)] {
        desk.done(&format!(
            "subdivide torus.off -o o.off --scheme loop --levels 2 --method {method} --select faces:5 --face-table f.tsv"
        ));
        desk.done("check o.off");
        let selected = desk.read("f.tsv").lines().filter(|line| line.ends_with("\t1")).count();
        assert_eq!(selected, faces, "{method}");
    }
    desk.vv("subdivide torus.off -o o.off --scheme loop --levels 2 --method simple --select-each faces:5")
        .assert_refused("if there was one, it was split");
    let rows = desk.done("compare torus.off --select faces:5,6 --levels 2 --json").json();
    let exact = |row: &&serde_json::Value| row["method"] == "incremental-1" && row["equal_percent"] == 100.0;
    assert_eq!(rows["rows"].as_array().unwrap().iter().filter(exact).count(), 2);
}

#[test]
fn lists_set_the_number_of_levels() {
    let desk = Desk::new();
    let list = "--select-each normal-angle:5/40/50";
    let report = desk.done(&format!("subdivide torus.off -o list.off {ITERATIVE} {list} --json")).json();
    assert_eq!(report["levels"].as_array().unwrap().len(), 3);
    assert_eq!((report["diagonal"].as_str(), report["min_move"].is_null()), (Some("valence"), true));
    desk.done("check list.off");
    desk.done(&format!("subdivide torus.off -o same.off {ITERATIVE} {list} --levels 3"));
    assert_eq!(desk.read("list.off"), desk.read("same.off"));
    // One value after the other.
    for degrees in [5, 40, 50] {
        let each = format!("--select-each normal-angle:{degrees} --levels 1 --state s.json");
        desk.done(&format!("subdivide torus.off -o steps.off {ITERATIVE} {each}"));
    }
    assert_eq!(desk.read("list.off"), desk.read("steps.off"));
    desk.done(&format!("matrix torus.off -o m.mtx {ITERATIVE} {list}"));

    let refused = |how: &str, words: &str| {
        desk.vv(&format!("subdivide torus.off -o no.off {ITERATIVE} {how}")).assert_refused(words);
        assert!(!desk.names().contains("no.off"));
    };
    refused(&format!("{list} --levels 2"), "--levels 2 does not agree with --select-each, which has 3 values");
    refused("--select-each normal-angle:5", "--levels <N> is missing");
    refused("--select normal-angle:5/6 --levels 2", "a list belongs to --select-each");
    refused("--select-each normal-angle:5/6/", "column 18: expected angle");
    desk.vv("select torus.off --select dihedral:5/6").assert_refused("a list belongs to --select-each");
    desk.vv("compare torus.off --levels 2 --select dihedral:5/6").assert_refused("a list belongs to --select-each");
}

#[test]
fn diagonals_and_the_least_movement_are_chosen_where_they_mean_something() {
    let desk = Desk::new();
    let each = "--levels 2 --select-each normal-angle:45";
    let mut made = Vec::new();
    for diagonal in ["longest", "shortest", "valence", "id"] {
        let command = format!("subdivide torus.off -o o.off {ITERATIVE} {each} --diagonal {diagonal} --json");
        assert_eq!(desk.done(&command).json()["diagonal"], diagonal);
        desk.done("check o.off");
        made.push(desk.read("o.off"));
    }
    assert_ne!(made[0], made[1]);
    desk.done(&format!("subdivide torus.off -o o.off {ITERATIVE} {each}"));
    assert_eq!(desk.read("o.off"), made[2]);

    let moved = |least: &str| {
        let command = format!("subdivide torus.off -o o.off {ITERATIVE} --levels 1 --min-move {least} --json");
        let report = desk.done(&command).json();
        desk.done("check o.off");
        report["levels"][0]["split_edges"].as_u64().unwrap()
    };
    assert_eq!((moved("0"), moved("100")), (90, 0));
    assert!(moved("0.05") < 90 && moved("0.05") > 0);

    for (how, words) in [
        ("--scheme butterfly --method incremental --diagonal id", "--diagonal has no meaning with --scheme butterfly"),
        ("--scheme sqrt3 --method simple --diagonal id", "--diagonal has no meaning with --scheme sqrt3"),
        ("--scheme loop --method dynamic --diagonal id", "a rule of its own"),
        ("--scheme loop --method simple --min-move 1", "--min-move has no meaning with --scheme loop"),
        ("--scheme butterfly --method uniform --min-move 1", "--min-move has no meaning with --method uniform"),
        ("--scheme butterfly --method simple --min-move -1", "expected a distance, 0 or more"),
        ("--scheme butterfly --method simple --min-move nan", "expected a distance, 0 or more"),
        ("--scheme butterfly --method simple --diagonal long", "invalid value 'long'"),
    ] {
        desk.vv(&format!("subdivide torus.off -o no.off --levels 1 {how}")).assert_refused(words);
    }
}

/// Table 1 of the paper on an iterative process.
#[test]
fn the_first_table_comes_out() {
    let Some(folder) = common::meshes() else { return };
    let desk = Desk::new();
    desk.write("eight.off", std::fs::read(folder.join("papers/eight_1536.off")).unwrap());
    let command = format!("subdivide eight.off -o o.off {ITERATIVE} --select-each normal-angle:10/20/30/30 --json");
    let report = desk.done(&command).json();
    let faces: Vec<_> = report["levels"].as_array().unwrap().iter().map(|row| row["faces"].as_u64().unwrap()).collect();
    assert_eq!(faces, [6068, 6192, 6232, 6272]);
    desk.done("check o.off");
}
