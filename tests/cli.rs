//! The binary `vv` as its user meets it: help, info, check, select, demo, and what is common to all.
#![cfg(feature = "cli")]

mod common;

use std::fs;
use std::path::Path;
use std::process::Stdio;

use common::desk::{Desk, FAULTS, METHODS, keys, numbers, sorted};
use serde_json::Value;
use vvmesh::{io, shapes};

// Help and usage.

#[test]
fn every_command_has_help_with_an_example() {
    let desk = Desk::new();
    for command in ["demo", "info", "check", "select", "subdivide", "compare", "limit", "matrix", "predict", "stroke"] {
        let help = desk.done(&format!("{command} --help"));
        assert!(help.out.contains(&format!("Example:\n  vv {command}")), "{}", help.out);
        assert_eq!(help.err, "");
        assert!(help.out.lines().all(|line| line.chars().count() <= 100), "{}", help.out);
    }
    assert!(
        desk.done("--help")
            .out
            .contains("Exit codes: 0 done, 1 check found something or --until was not reached, 2 usage or input")
    );
    assert!(desk.done("--version").out.starts_with("vv 0."));
}

#[test]
fn without_a_command_help_is_shown_with_exit_2() {
    let ran = Desk::new().vv("");
    assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""));
    assert!(ran.err.contains("Usage: vv <COMMAND>") && ran.err.contains("Example:"));
}

#[test]
fn unknown_words_are_refused() {
    let desk = Desk::new();
    for (arguments, words) in [
        ("refine grid.obj", "unrecognized subcommand"),
        ("info", "<MESH>"),
        ("info grid.obj --tags", "--tags"),
        ("info grid.obj torus.off", "torus.off"),
        ("select grid.obj", "--select"),
        ("subdivide grid.obj -o o.obj --scheme doo-sabin --levels 1 --method uniform", "modified-butterfly"),
        ("subdivide grid.obj -o o.obj --scheme loop --levels 1 --method greedy", "incremental"),
        ("subdivide grid.obj -o o.obj --scheme loop --levels x --method uniform", "--levels"),
        ("subdivide grid.obj -o o.obj --scheme loop --levels -1 --method uniform", "0..=255"),
        ("subdivide grid.obj -o o.obj --scheme loop --levels 4000000000 --method uniform", "0..=255"),
        ("subdivide grid.obj -o o.obj --levels 1 --method uniform", "--scheme"),
        ("subdivide grid.obj --scheme loop --levels 1 --method uniform", "-o"),
    ] {
        desk.vv(arguments).assert_refused(words);
    }
    assert_eq!(desk.names().len(), 2);
}

// vv info.

#[test]
fn info_has_the_keys_and_the_numbers() {
    let desk = Desk::new();
    let info = desk.done("info grid.obj --json").json();
    let expected = sorted([
        "vertices",
        "isolated_vertices",
        "edges",
        "faces",
        "triangles",
        "components",
        "boundary_loops",
        "euler_characteristic",
        "genus",
        "orientable",
        "valence",
        "bounds",
    ]);
    assert_eq!(keys(&info), expected);
    assert_eq!(keys(&info["valence"]), sorted(["min", "mean", "max", "histogram"]));
    assert_eq!(keys(&info["bounds"]), sorted(["min", "max"]));
    let shape = [&info["vertices"], &info["edges"], &info["faces"], &info["boundary_loops"], &info["genus"]];
    assert_eq!(shape, [30, 69, 40, 1, 0]);
    assert_eq!(info["valence"]["histogram"], serde_json::json!({"2": 2, "3": 2, "4": 14, "6": 12}));
    assert_eq!(info["bounds"]["max"], serde_json::json!([5.0, 4.0, 0.0]));

    let torus = desk.done("info torus.off --json").json();
    assert_eq!([&torus["genus"], &torus["euler_characteristic"], &torus["boundary_loops"]], [1, 0, 0]);
    assert_eq!(torus["orientable"], true);
}

#[test]
fn info_counts_polygons_as_they_stand() {
    let desk = Desk::new();
    desk.write("house.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nv 9 9 9\nf 1 2 3 4 5\n");
    let info = desk.done("info house.obj --json").json();
    let counts =
        ["vertices", "isolated_vertices", "edges", "faces", "triangles"].map(|key| info[key].as_u64().unwrap());
    assert_eq!(counts, [6, 1, 5, 1, 3]);
    assert_eq!(info["bounds"]["max"], serde_json::json!([2.0, 3.0, 0.0]));

    desk.write(
        "moebius.off",
        "OFF\n5 5 0\n0 0 0\n1 0 0\n2 1 0\n0 1 1\n1 1 2\n3 0 1 2\n3 1 2 3\n3 2 3 4\n3 3 4 0\n3 4 0 1\n",
    );
    let info = desk.done("info moebius.off --json").json();
    assert_eq!((&info["orientable"], &info["genus"]), (&Value::from(false), &Value::Null));

    desk.write("points.obj", "v 0 0 0\nv 1 0 0\n");
    let info = desk.done("info points.obj --json").json();
    assert_eq!((&info["bounds"], &info["valence"]["mean"]), (&Value::Null, &Value::Null));
}

#[test]
fn info_without_json_is_for_people() {
    let text = Desk::new().done("info torus.off").out;
    assert!(text.starts_with("torus.off (OFF)\n"));
    let line = |name: &str| text.lines().find(|line| line.starts_with(name)).unwrap().split_whitespace().last();
    assert_eq!([line("vertices"), line("genus"), line("mean valence")], [Some("30"), Some("1"), Some("6.000")]);
}

// vv check.

#[test]
fn check_finds_each_kind_with_exit_1() {
    let desk = Desk::new();
    for (kind, faces) in FAULTS {
        desk.write("fault.obj", faces);
        let ran = desk.vv("check fault.obj --json");
        assert_eq!(ran.code, Some(1), "{kind}: {}", ran.err);
        let report = ran.json();
        assert_eq!(keys(&report), ["conforming", "findings"]);
        assert_eq!(report["conforming"], false);
        let findings = report["findings"].as_array().unwrap();
        assert_eq!(findings.iter().map(|finding| &finding["kind"]).collect::<Vec<_>>(), [kind], "{report}");
        assert_eq!(keys(&findings[0]), sorted(["kind", "message", "vertices", "faces"]));
        numbers(&findings[0]["vertices"]);
        numbers(&findings[0]["faces"]);

        let text = desk.vv("check fault.obj");
        assert_eq!(text.code, Some(1));
        assert!(text.out.starts_with("fault.obj: not conforming, 1 finding"), "{}", text.out);
        assert!(text.out.contains(findings[0]["message"].as_str().unwrap()), "{}", text.out);
    }
}

#[test]
fn sound_meshes_are_conforming() {
    let desk = Desk::new();
    for name in ["grid.obj", "torus.off"] {
        let report = desk.done(&format!("check {name} --json")).json();
        assert_eq!(report, serde_json::json!({"conforming": true, "findings": []}));
    }
    assert!(desk.done("check grid.obj").out.starts_with("grid.obj: conforming (tolerance"));
}

#[test]
fn isolated_vertices_are_told_and_do_no_harm() {
    let desk = Desk::new();
    desk.write("lone.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nf 1 2 3\n");
    let report = desk.done("check lone.obj --json").json();
    assert_eq!(report["conforming"], true);
    assert_eq!(report["findings"][0]["kind"], "isolated_vertex");
    assert_eq!(numbers(&report["findings"][0]["vertices"]), [3]);
}

#[test]
fn the_tolerance_decides_what_lies_on_an_edge() {
    let desk = Desk::new();
    desk.write("near.obj", "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 1 -1 0\nv 1 -.1 0\nf 1 2 3\nf 1 4 5\nf 5 4 2\n");
    let kind =
        |tolerance: &str| desk.vv(&format!("check near.obj --json {tolerance}")).json()["findings"][0]["kind"].clone();
    assert_eq!([kind(""), kind("--tolerance 0.2")], ["crack", "t_junction"]);
    for wrong in ["-1", "nan", "inf", "x"] {
        desk.vv(&format!("check grid.obj --tolerance {wrong}")).assert_refused("expected a distance, 0 or more");
    }
}

#[test]
fn many_findings_are_cut_short_for_people_only() {
    let desk = Desk::new();
    desk.write("points.obj", "v 0 0 0\n".repeat(50));
    let text = desk.done("check points.obj").out;
    assert!(text.lines().count() < 20 && text.contains("and 40 more; --json prints all"), "{text}");
    assert_eq!(desk.done("check points.obj --json").json()["findings"].as_array().unwrap().len(), 50);
}

// vv select.

#[test]
fn select_prints_ids_that_can_be_given_back() {
    let desk = Desk::new();
    let selected = desk.done("select grid.obj --select disk:8,1 --rings 1 --json").json();
    let expected = sorted([
        "expression",
        "kind",
        "rings",
        "vertices",
        "selected",
        "region",
        "selected_vertices",
        "region_vertices",
    ]);
    assert_eq!(keys(&selected), expected);
    assert_eq!(numbers(&selected["selected_vertices"]), [1, 2, 7, 8, 9, 14, 15]);
    assert_eq!([&selected["vertices"], &selected["selected"], &selected["rings"]], [30, 7, 1]);
    let region = numbers(&selected["region_vertices"]);
    assert_eq!(selected["region"], region.len());

    let text = desk.done("select grid.obj --select disk:8,1 --rings 1").out;
    assert!(text.starts_with(&format!("# disk:8,1: 7 of 30 vertices, {} within 1 ring\n", region.len())), "{text}");
    desk.write("ids.txt", text);
    let again = desk.done("select grid.obj --select vertices:@ids.txt --json").json();
    assert_eq!(numbers(&again["selected_vertices"]), region);
    assert_eq!(again["region_vertices"], again["selected_vertices"]);
}

#[test]
fn select_knows_the_language() {
    let desk = Desk::new();
    desk.write("a|b.txt", "3, 4 # two\n5");
    for (expression, expected) in [
        ("all & vertices:1,2", vec![1, 2]),
        ("!all", vec![]),
        ("vertices:1|vertices:2&vertices:3", vec![1]),
        ("(vertices:1|vertices:2)&!vertices:1", vec![2]),
        ("sphere:0,0,0,1", vec![0, 1, 6]),
        ("vertices:@\"a|b.txt\"", vec![3, 4, 5]),
        ("dihedral:1", vec![]),
    ] {
        let ran = desk.run(&["select", "grid.obj", "--select", expression, "--json"]);
        assert_eq!(ran.code, Some(0), "{expression}: {}", ran.err);
        assert_eq!(numbers(&ran.json()["selected_vertices"]), expected, "{expression}");
        assert_eq!(ran.err.contains("picks nothing"), expected.is_empty(), "{}", ran.err);
    }
}

#[test]
fn select_refuses_what_has_no_meaning() {
    let desk = Desk::new();
    for (expression, words) in [
        ("", "column 1"),
        ("al", "no criterion `al`"),
        ("vertices:30", "no vertex 30: the mesh has 30 vertices"),
        ("vertices:1,x", "column 12"),
        ("vertices:@nothing", "nothing could not be read"),
        ("(all", "`)`"),
        ("disk:1", "disk:V,R"),
        ("sphere:0,0,0,-1", "radius"),
    ] {
        desk.run(&["select", "grid.obj", "--select", expression]).assert_refused(words);
        let refine =
            ["subdivide", "grid.obj", "-o", "o.obj", "--scheme", "loop", "--levels", "1", "--method", "simple"];
        for option in ["--select", "--select-each"] {
            desk.run(&[&refine[..], &[option, expression]].concat()).assert_refused(words);
        }
    }
    desk.vv("select grid.obj --select all --rings -1").assert_refused("--rings");
    assert!(!desk.path("o.obj").exists());
}

// All commands.

#[test]
fn what_cannot_be_read_is_exit_2() {
    let desk = Desk::new();
    desk.write("empty.obj", "");
    desk.write("garbage.obj", (0..5000_u32).map(|k| (k.wrapping_mul(2_654_435_761) >> 13) as u8).collect::<Vec<_>>());
    desk.write("garbage.off", (0..5000_u32).map(|k| (k.wrapping_mul(2_654_435_761) >> 13) as u8).collect::<Vec<_>>());
    desk.write("zeros.off", [0; 100]);
    desk.write("huge.off", "OFF\n4000000000 4000000000 0\n0 0 0\n");
    desk.write("cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n");
    desk.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n");
    desk.write("words.txt", "hello world\n");
    fs::create_dir(desk.path("folder.obj")).unwrap();
    let before = desk.names();
    let files =
        ["empty.obj", "garbage.obj", "garbage.off", "zeros.off", "huge.off", "cut.off", "index.obj", "words.txt"];
    for file in files.into_iter().chain(["folder.obj", "nothing.obj"]) {
        for command in [
            format!("info {file} --json"),
            format!("check {file} --json"),
            format!("select {file} --select all --json"),
            format!("subdivide {file} -o o.obj --scheme loop --levels 1 --method uniform --json"),
        ] {
            let ran = desk.vv(&command);
            ran.assert_refused(file);
            assert!(ran.err.lines().count() < 5, "{}", ran.err);
        }
    }
    assert!(desk.vv("info index.obj").err.contains("line 4"));
    assert_eq!(desk.names(), before);
}

#[test]
fn a_reader_that_goes_away_is_no_failure() {
    let desk = Desk::new();
    io::save(desk.path("large.off"), &shapes::grid(200, 200)).unwrap();
    for command in [
        "info large.off --json",
        "info large.off",
        "check large.off",
        "select large.off --select all",
        "select large.off --select all --json",
        "subdivide large.off -o o.off --scheme midpoint --levels 0 --method simple --json",
        "demo",
        "--help",
        "subdivide --help",
    ] {
        let mut child = desk
            .command(&command.split(' ').collect::<Vec<_>>())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let told = String::from_utf8(output.stderr).unwrap();
        assert_eq!((output.status.code(), told.as_str()), (Some(0), ""), "{command}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_exit_2() {
    let desk = Desk::new();
    let full = fs::File::options().write(true).open("/dev/full").unwrap();
    let output = desk.command(&["info", "grid.obj"]).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().starts_with("error: standard output: "));
}

// vv demo.

#[test]
fn the_demo_compares_the_methods() {
    let desk = Desk::new();
    let text = desk.done("demo").out;
    let files = ["model.obj", "uniform.obj", "simple.obj", "incremental.obj"];
    for file in files {
        desk.done(&format!("check vv-demo/{file}"));
        assert!(text.contains(Path::new("vv-demo").join(file).to_str().unwrap()), "{text}");
    }
    let at = text.lines().position(|line| line.starts_with("method ")).unwrap();
    let table: Vec<&str> = text.lines().skip(at).take(4).collect();
    for header in ["faces", "greatest valence", "deviation", "certified vertices", "conforming", "time"] {
        assert!(table[0].contains(header), "{}", table[0]);
    }
    let width = table[0].chars().count();
    assert!(table.iter().all(|line| line.chars().count() == width), "{text}");
    let cells = |row: usize| table[row].split_whitespace().collect::<Vec<_>>();
    assert_eq!([cells(1)[0], cells(2)[0], cells(3)[0]], METHODS);
    assert_eq!([cells(1)[3], cells(3)[3]], ["0", "0"]);
    assert!(cells(2)[3].parse::<f64>().unwrap() > 1e-3);
    assert!((1..=3).all(|row| cells(row)[5] == "yes"));

    let demo = desk.done("demo -o other --json").json();
    let methods = demo["methods"].as_array().unwrap();
    assert_eq!(methods[2]["deviation"], 0.0);
    let numbers = |key: &str| methods.iter().map(|of| of[key].as_u64().unwrap()).collect::<Vec<_>>();
    let (faces, valence, certified) = (numbers("faces"), numbers("max_valence"), numbers("certified"));
    assert!(faces[1] < faces[2] && faces[2] < faces[0] && faces[0] == 64 * 180);
    assert!(valence[1] > valence[2] && certified[1] < certified[2] && certified[2] < certified[0]);
    for file in files {
        assert_eq!(desk.read(&format!("other/{file}")), desk.read(&format!("vv-demo/{file}")));
    }
    // The model has what it is said to have.
    let model = desk.done("info vv-demo/model.obj --json").json();
    assert_eq!([&model["boundary_loops"], &model["genus"], &model["components"]], [1, 0, 1]);
    // Once more into the same folder.
    desk.done("demo");
    desk.vv("demo -o grid.obj").assert_refused("grid.obj");
    desk.vv("demo -o grid.obj/inside").assert_refused("grid.obj");
}
