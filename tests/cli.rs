//! The binary `vv` as its user meets it: options, refusals, exit codes, reports, tables.
#![cfg(feature = "cli")]

mod common;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;
use tempfile::TempDir;
use vvmesh::adaptive::{Incremental, Uniform};
use vvmesh::certify::Certificate;
use vvmesh::glam::DVec3;
use vvmesh::limit::LoopLimit;
use vvmesh::scheme::{Loop, LoopWeights};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Disk, Selection};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Edge, Mesh, VertexId, io, shapes};

const SCHEMES: [&str; 4] = ["loop", "butterfly", "modified-butterfly", "midpoint"];
const METHODS: [&str; 3] = ["uniform", "simple", "incremental"];

/// What became of one call.
struct Ran {
    code: Option<i32>,
    out: String,
    err: String,
}

impl Ran {
    fn json(&self) -> Value {
        assert_eq!(self.out.lines().count(), 1, "{}", self.out);
        serde_json::from_str(&self.out).unwrap_or_else(|error| panic!("{error}: {}{}", self.out, self.err))
    }

    /// The call was refused for a reason that holds these words, and nothing stands on standard output.
    fn assert_refused(&self, words: &str) {
        assert_eq!((self.code, self.out.as_str()), (Some(2), ""), "{}", self.err);
        assert!(self.err.starts_with("error: ") || self.err.contains("\nerror: "), "{}", self.err);
        assert!(self.err.contains(words), "no `{words}` in: {}", self.err);
    }
}

/// A folder with some meshes, in which `vv` is called.
struct Desk {
    folder: TempDir,
}

impl Desk {
    /// `grid.obj` (5 x 4 squares), `torus.off` (6 x 5 quads).
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        io::save(folder.path().join("grid.obj"), &shapes::grid(5, 4)).unwrap();
        io::save(folder.path().join("torus.off"), &shapes::torus(6, 5, 2.0, 1.0)).unwrap();
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    fn mesh(&self, name: &str) -> Mesh {
        Mesh::from_face_list(&io::read(self.path(name)).unwrap().faces).unwrap()
    }

    fn names(&self) -> BTreeSet<String> {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_vv"));
        command.args(arguments).current_dir(self.folder.path()).stdin(Stdio::null());
        command
    }

    /// Calls with arguments; whatever happens, it is no panic.
    fn run(&self, arguments: &[&str]) -> Ran {
        let output = self.command(arguments).output().unwrap();
        let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        assert!(!err.contains("panicked"), "{arguments:?}: {err}");
        Ran { code: output.status.code(), out, err }
    }

    /// Calls with arguments in one text, split at blanks.
    fn vv(&self, arguments: &str) -> Ran {
        self.run(&arguments.split_whitespace().collect::<Vec<_>>())
    }

    fn done(&self, arguments: &str) -> Ran {
        let ran = self.vv(arguments);
        assert_eq!(ran.code, Some(0), "vv {arguments}: {}{}", ran.out, ran.err);
        ran
    }
}

fn keys(object: &Value) -> Vec<&str> {
    let Value::Object(entries) = object else { panic!("no object: {object}") };
    entries.keys().map(String::as_str).collect()
}

fn sorted<const N: usize>(mut names: [&str; N]) -> Vec<&str> {
    names.sort_unstable();
    names.to_vec()
}

fn numbers(array: &Value) -> Vec<u64> {
    array.as_array().unwrap().iter().map(|number| number.as_u64().unwrap()).collect()
}

// Help and usage.

#[test]
fn every_command_has_help_with_an_example() {
    let desk = Desk::new();
    for command in ["demo", "info", "check", "select", "subdivide"] {
        let help = desk.done(&format!("{command} --help"));
        assert!(help.out.contains(&format!("Example:\n  vv {command}")), "{}", help.out);
        assert_eq!(help.err, "");
        assert!(help.out.lines().all(|line| line.chars().count() <= 100), "{}", help.out);
    }
    assert!(desk.done("--help").out.contains("Exit codes: 0 done, 1 check found something, 2 usage or input"));
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
        ("subdivide grid.obj -o o.obj --scheme sqrt3 --levels 1 --method uniform", "modified-butterfly"),
        ("subdivide grid.obj -o o.obj --scheme loop --levels 1 --method red-green", "incremental"),
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

/// Faces with one fault each, and the kind that is found.
const FAULTS: [(&str, &str); 9] = [
    ("t_junction", "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 1 -1 0\nv 1 0 0\nf 1 2 3\nf 1 4 5\nf 5 4 2\n"),
    ("crack", "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 1 -1 0\nv 1 -.1 0\nf 1 2 3\nf 1 4 5\nf 5 4 2\n"),
    ("non_manifold_edge", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n"),
    ("bow_tie", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 -1 0\nf 1 2 3\nf 1 4 5\n"),
    ("orientation", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n"),
    ("non_orientable", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 0 1 1\nv 1 1 2\nf 1 2 3\nf 2 3 4\nf 3 4 5\nf 4 5 1\nf 5 1 2\n"),
    ("duplicate_face", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 2 3 1\n"),
    ("degenerate_face", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\n"),
    ("non_finite", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n"),
];

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
    let expected =
        sorted(["expression", "rings", "vertices", "selected", "region", "selected_vertices", "region_vertices"]);
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
        assert_eq!(ran.err.contains("picks no vertex"), expected.is_empty(), "{}", ran.err);
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

// vv subdivide: what it makes.

#[test]
fn every_scheme_and_method_makes_a_conforming_mesh() {
    let desk = Desk::new();
    for (mesh, out) in [("grid.obj", "fine.off"), ("torus.off", "fine.obj")] {
        for scheme in SCHEMES {
            for method in METHODS {
                desk.done(&format!(
                    "subdivide {mesh} -o {out} --scheme {scheme} --levels 3 --method {method} --select disk:8,1"
                ));
                desk.done(&format!("check {out}"));
            }
        }
    }
}

#[test]
fn the_report_has_a_row_a_step() {
    let desk = Desk::new();
    let command = "subdivide torus.off -o o.off --scheme loop --levels 2 --method incremental --select disk:0,1";
    let report = desk.done(&format!("{command} --json --report r.json")).json();
    let written: Value = serde_json::from_str(&desk.read("r.json")).unwrap();
    assert_eq!(report, written);
    let levels = report["levels"].as_array().unwrap();
    let expected = sorted([
        "level",
        "selected",
        "region",
        "split_edges",
        "vertices",
        "edges",
        "faces",
        "t_vertices",
        "o_vertices",
        "max_valence",
        "certified",
        "seconds",
    ]);
    assert!(levels.len() == 2 && levels.iter().all(|row| keys(row) == expected), "{report}");

    // The same by the library.
    let mut mesh = shapes::torus(6, 5, 2.0, 1.0);
    let mut history = History::new(&mesh, Keep { names: false, certificate: true });
    let subdivider = Subdivider::new(Loop::default(), Incremental::new(1).unwrap());
    let mut scratch = Scratch::new();
    let mut selection = Disk::new(VertexId::new(0), 1).select(&mesh, &mut scratch).unwrap();
    for (k, row) in levels.iter().enumerate() {
        let step = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default()).unwrap();
        let expected = [k + 1, step.selected, step.region, step.split_edges, mesh.vertex_count(), mesh.edge_count()];
        let keys = ["level", "selected", "region", "split_edges", "vertices", "edges"];
        assert_eq!(keys.map(|key| row[key].as_u64().unwrap() as usize), expected);
        let expected = [mesh.face_count(), step.t_vertices.len(), step.o_vertices.len(), history.max_valence()];
        assert_eq!(
            ["faces", "t_vertices", "o_vertices", "max_valence"].map(|key| row[key].as_u64().unwrap() as usize),
            expected
        );
        assert_eq!(row["certified"], Certificate::new(&mesh, &history).unwrap().certified().count());
        assert!(row["seconds"].as_f64().unwrap() > 0.0);
        selection = step.selection;
    }
    assert_eq!(report["totals"]["faces"], mesh.face_count());
    assert_eq!(report["totals"]["selected"], selection.len());
    assert_eq!(desk.mesh("o.off").positions(), mesh.positions());

    let text = desk.done(command).out;
    let header = "level  selected  region  split  vertices  edges  faces  T  O  max valence  certified";
    let words: Vec<&str> = text.lines().next().unwrap().split_whitespace().collect();
    assert_eq!(words.join(" "), header.split_whitespace().chain(["time"]).collect::<Vec<_>>().join(" "));
    assert!(text.contains("wrote o.off: "), "{text}");
}

#[test]
fn the_vertex_table_names_parents_and_flags() {
    let desk = Desk::new();
    desk.done(
        "subdivide grid.obj -o o.obj --scheme loop --levels 2 --method incremental --select vertices:14,15 --vertex-table v.tsv",
    );
    let mesh = desk.mesh("o.obj");
    let table = desk.read("v.tsv");
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("id\tlevel\tparents\tselected\tcertified"));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split('\t').collect()).collect();
    assert_eq!(rows.len(), mesh.vertex_count());
    let level = |v: usize| rows[v][1].parse::<u8>().unwrap();
    for (k, row) in rows.iter().enumerate() {
        assert_eq!((row.len(), row[0]), (5, k.to_string().as_str()));
        assert!(row[3..].iter().all(|flag| ["0", "1"].contains(flag)));
        match row[2].split_once(',') {
            None => assert_eq!((k < 30, row[2], row[1]), (true, "", "0")),
            Some((p, q)) => {
                let [p, q] = [p, q].map(|end| end.parse::<usize>().unwrap());
                assert!(k >= 30 && p < k && q < k);
                assert_eq!(level(k), 1 + level(p).max(level(q)));
            }
        }
    }
    // Two vertices and the one between them, three and the two between those.
    let selected: Vec<&Vec<&str>> = rows.iter().filter(|row| row[3] == "1").collect();
    assert_eq!(selected.len(), 5);
    assert!(selected.iter().all(|row| row[4] == "1"), "incremental: what is selected is certified");
    assert!(rows.iter().any(|row| row[4] == "0"));
}

#[test]
fn the_face_table_tells_closure_from_regular() {
    let desk = Desk::new();
    let command = "subdivide grid.obj -o o.obj --scheme loop --levels 1 --select disk:14,1 --face-table f.tsv --method";
    desk.done(&format!("{command} simple"));
    let mesh = desk.mesh("o.obj");
    let table = desk.read("f.tsv");
    let mut lines = table.lines();
    assert_eq!(lines.next(), Some("id\tlevel\tkind\tselected"));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split('\t').collect()).collect();
    assert_eq!(rows.len(), mesh.face_count());
    assert!(rows.iter().enumerate().all(|(k, row)| row.len() == 4 && row[0] == k.to_string()));
    let count = |level: &str, kind: &str| rows.iter().filter(|row| row[1..3] == [level, kind]).count();
    // Six faces are split, the six around them bisected, the rest stay.
    assert_eq!([count("1", "regular"), count("0", "closure"), count("0", "regular")], [24, 12, 28]);
    // The disk of seven and the twelve new ones between them fill the six faces.
    let inside = |row: &&Vec<&str>| row[3] == "1";
    assert!(rows.iter().filter(inside).all(|row| row[1..3] == ["1", "regular"]));
    assert_eq!(rows.iter().filter(inside).count(), 24);

    desk.done(&format!("{command} uniform"));
    assert!(desk.read("f.tsv").lines().skip(1).all(|line| line.contains("\t1\tregular\t")));
}

#[test]
fn no_level_is_a_copy() {
    let desk = Desk::new();
    let ran = desk.done(
        "subdivide torus.off -o o.off --scheme loop --levels 0 --method simple --select disk:0,1 \
         --vertex-table v.tsv --face-table f.tsv --json",
    );
    assert_eq!(desk.read("o.off"), desk.read("torus.off"));
    assert_eq!(ran.json()["levels"], serde_json::json!([]));
    assert_eq!(ran.json()["totals"]["certified"], 30);
    assert_eq!(desk.read("v.tsv").lines().nth(1), Some("0\t0\t\t1\t1"));
    assert_eq!(desk.read("v.tsv").lines().filter(|line| line.ends_with("\t\t1\t1")).count(), 7);
    assert_eq!(desk.read("f.tsv").lines().filter(|line| line.ends_with("\t0\tregular\t1")).count(), 6);
}

#[test]
fn a_selection_is_followed_or_chosen_anew() {
    let desk = Desk::new();
    let command = "subdivide torus.off -o o.off --scheme loop --levels 3 --method incremental --json";
    let selected = |option: &str| {
        let ran = desk
            .run(&[&command.split(' ').collect::<Vec<_>>()[..], &option.splitn(2, ' ').collect::<Vec<_>>()].concat());
        assert_eq!(ran.code, Some(0), "{}", ran.err);
        let report = ran.json();
        let levels = report["levels"].as_array().unwrap();
        (levels.iter().map(|row| row["selected"].as_u64().unwrap()).collect::<Vec<_>>(), ran.err)
    };
    assert_eq!(selected("--select disk:0,1"), (vec![7, 19, 61], String::new()));
    // The disk is counted in the edges of each level, so it shrinks, and stays inside of the one before.
    assert_eq!(selected("--select-each disk:0,1"), (vec![7, 7, 7], String::new()));
    let (_, told) = selected("--select-each !disk:0,2");
    assert!(told.contains("warning: level 3: for ") && told.contains("not proven equal to uniform"), "{told}");
    assert!(["T-vertex v", "O-vertex v", "coarser"].iter().any(|cause| told.contains(cause)), "{told}");

    let both = format!("{command} --select all --select-each all");
    desk.vv(&both).assert_refused("cannot be used with");
}

#[test]
fn an_empty_selection_is_legal_and_told() {
    let desk = Desk::new();
    for option in ["--select", "--select-each"] {
        let ran = desk.done(&format!(
            "subdivide torus.off -o o.off --scheme loop --levels 1 --method incremental --json {option} !all"
        ));
        assert!(ran.err.contains("picks no vertex"), "{}", ran.err);
        assert_eq!([&ran.json()["levels"][0]["selected"], &ran.json()["totals"]["faces"]], [0, 60]);
    }
    let ran = desk.done("subdivide torus.off -o o.off --scheme loop --levels 1 --method uniform --json --select !all");
    assert_eq!([&ran.json()["levels"][0]["selected"], &ran.json()["totals"]["faces"]], [0, 240]);
}

#[test]
fn polygons_are_cut_and_it_is_told() {
    let desk = Desk::new();
    desk.write("house.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nv 1 -1 0\nf 1 2 3 4 5\nf 2 1 6\n");
    let ran = desk.done("subdivide house.obj -o o.obj --scheme midpoint --levels 0 --method uniform --json");
    assert!(
        ran.err.contains("1 polygon was cut into triangles (1 convex by a fan, 0 others by ear clipping)"),
        "{}",
        ran.err
    );
    assert_eq!(ran.json()["totals"]["faces"], 4);
    desk.write("bad.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nf 1 2 3 4\nf 1 2 2\n");
    desk.vv("subdivide bad.obj -o o.obj --scheme loop --levels 1 --method uniform").assert_refused("face 1 ");
}

#[test]
fn tag_lines_are_told_and_ignored() {
    let desk = Desk::new();
    desk.write("tagged.obj", format!("{}t crease 2/1/0 8 14 inf\n", desk.read("grid.obj")));
    let refine = "--scheme loop --levels 1 --method uniform";
    let ran = desk.done(&format!("subdivide tagged.obj -o tagged_1.obj {refine}"));
    assert!(ran.err.contains("1 tag line 't' ignored"), "{}", ran.err);
    desk.done(&format!("subdivide grid.obj -o grid_1.obj {refine}"));
    assert_eq!(desk.read("tagged_1.obj"), desk.read("grid_1.obj"));
}

// vv subdivide: options of schemes.

#[test]
fn weights_and_limit_are_those_of_the_library() {
    let desk = Desk::new();
    let mut tip = shapes::octahedron();
    io::save(desk.path("octahedron.off"), &tip).unwrap();
    let refine = "subdivide octahedron.off -o o.off --scheme loop --method uniform";
    desk.done(&format!("{refine} --levels 0 --limit"));
    let limit = LoopLimit::new(LoopWeights::Loop);
    let expected: Vec<DVec3> = tip.vertices().map(|v| limit.position(&tip, v)).collect();
    assert_eq!(desk.mesh("o.off").positions(), expected);

    desk.done(&format!("{refine} --levels 1 --weights warren"));
    let mut history = History::new(&tip, Keep::default());
    let subdivider = Subdivider::new(Loop::new(LoopWeights::Warren), Uniform);
    let (all, mut scratch) = (Selection::all(6), Scratch::new());
    subdivider.step(&mut tip, &mut history, &all, &mut scratch, &mut Control::default()).unwrap();
    assert_eq!(desk.mesh("o.off").positions(), tip.positions());
    desk.done(&format!("{refine} --levels 1 --weights loop"));
    assert_ne!(desk.mesh("o.off").positions(), tip.positions());
}

#[test]
fn the_boundary_policy_decides_what_stays() {
    let desk = Desk::new();
    let grid = desk.mesh("grid.obj");
    for (policy, staying) in [("smooth", 0), ("corners", 2), ("fixed", 18)] {
        desk.done(&format!(
            "subdivide grid.obj -o o.obj --scheme loop --levels 1 --method uniform --boundary {policy}"
        ));
        let fine = desk.mesh("o.obj");
        // A boundary vertex on a straight side stays anyway; the four corners of the grid tell the policies apart.
        let tips = [0, 5, 24, 29].map(VertexId::new);
        let stay = tips.iter().filter(|&&v| fine.position(v) == grid.position(v)).count();
        assert_eq!(stay, [0, 2, 4][[0, 2, 18].iter().position(|&k| k == staying).unwrap()], "{policy}");
    }
}

#[test]
fn sharp_edges_come_by_angle_or_from_a_file() {
    let desk = Desk::new();
    io::save(desk.path("octahedron.off"), &shapes::octahedron()).unwrap();
    let refine = "subdivide octahedron.off -o o.off --scheme loop --levels 1 --method uniform";
    // Folded by 70.5 degrees everywhere: every vertex becomes a corner.
    desk.done(&format!("{refine} --sharp-angle 70"));
    assert_eq!(desk.mesh("o.off").positions()[..6], *shapes::octahedron().positions());
    desk.done(&format!("{refine} --sharp-angle 71"));
    assert_ne!(desk.mesh("o.off").positions()[..6], *shapes::octahedron().positions());

    // A crease around the middle, one corner, a comment.
    desk.write("sharp.txt", "# the middle\n0 1\n2 1 inf # sharp\n2\t3\n3 0 infinity\n\n4\n");
    desk.done(&format!("{refine} --sharp sharp.txt"));
    let mut octahedron = shapes::octahedron();
    for [a, b] in [[0, 1], [1, 2], [2, 3], [3, 0]] {
        assert!(octahedron.set_sharp(Edge::new(VertexId::new(a), VertexId::new(b)), true));
    }
    octahedron.set_corner(VertexId::new(4), true);
    let mut history = History::new(&octahedron, Keep::default());
    let subdivider = Subdivider::new(Loop::default(), Uniform);
    let (none, mut scratch) = (Selection::empty(), Scratch::new());
    subdivider.step(&mut octahedron, &mut history, &none, &mut scratch, &mut Control::default()).unwrap();
    assert_eq!(desk.mesh("o.off").positions(), octahedron.positions());
}

#[test]
fn a_wrong_sharp_file_is_refused_at_its_line() {
    let desk = Desk::new();
    let refine = "subdivide torus.off -o o.off --scheme loop --levels 1 --method uniform --sharp";
    for (line, words) in [
        ("0 20", "no edge between vertices 0 and 20"),
        ("0 30", "no vertex 30"),
        ("99999999999999999999999", "no vertex 99999999999999999999999"),
        ("5 5", "from vertex 5 to itself"),
        ("0 1 2.5", "finite sharpness (2.5) is not supported"),
        ("0 1 0", "finite sharpness (0)"),
        ("0 1 nan", "expected the sharpness `inf`, found `nan`"),
        ("0 1 -inf", "found `-inf`"),
        ("0 1 sharp", "found `sharp`"),
        ("-1", "expected the id of a vertex, found `-1`"),
        ("v1 v2", "found `v1`"),
        ("0 1 inf inf", "found 4 words"),
    ] {
        desk.write("sharp.txt", format!("# first\n0\n{line}\n"));
        let ran = desk.vv(&format!("{refine} sharp.txt"));
        ran.assert_refused(words);
        assert!(ran.err.contains("sharp.txt:3: "), "{}", ran.err);
    }
    desk.vv(&format!("{refine} nothing.txt")).assert_refused("nothing.txt");
    desk.write("sharp.txt", [0xff, 0xfe, 0x00]);
    desk.vv(&format!("{refine} sharp.txt")).assert_refused("sharp.txt");
    assert!(!desk.path("o.off").exists());
}

#[test]
fn options_without_meaning_are_refused() {
    let desk = Desk::new();
    desk.write("sharp.txt", "0\n");
    let refine = "subdivide torus.off -o o.off --levels 1";
    for (options, words) in [
        ("--scheme loop --method uniform --rings 1", "--rings has no meaning with --method uniform"),
        ("--scheme loop --method simple --rings 1", "--rings has no meaning with --method simple"),
        ("--scheme loop --method incremental --rings 0", "without a ring the method is `simple`"),
        ("--scheme butterfly --method uniform --weights loop", "--weights has no meaning with --scheme butterfly"),
        ("--scheme modified-butterfly --method uniform --limit", "--limit has no meaning"),
        ("--scheme midpoint --method uniform --boundary smooth", "--boundary has no meaning with --scheme midpoint"),
        ("--scheme butterfly --method uniform --sharp sharp.txt", "--sharp has no meaning with --scheme butterfly"),
        ("--scheme midpoint --method uniform --sharp-angle 3", "--sharp-angle has no meaning"),
        ("--scheme loop --method uniform --sharp sharp.txt --sharp-angle 3", "cannot be used with"),
        ("--scheme loop --method uniform --sharp-angle 181", "expected degrees from 0 to 180"),
        ("--scheme loop --method uniform --sharp-angle -1", "expected degrees from 0 to 180"),
        ("--scheme loop --method uniform --sharp-angle nan", "expected degrees from 0 to 180"),
    ] {
        desk.vv(&format!("{refine} {options}")).assert_refused(words);
        assert!(!desk.path("o.off").exists(), "{options}");
    }
    // And those with a meaning are not.
    for options in [
        "--scheme loop --method incremental --rings 2 --weights warren --limit --boundary fixed --sharp sharp.txt",
        "--scheme modified-butterfly --method simple --boundary corners --sharp-angle 30",
    ] {
        desk.done(&format!("{refine} {options}"));
    }
}

// vv subdivide: what is refused, and what is left then.

#[test]
fn too_many_faces_are_refused_before_they_are_made() {
    let desk = Desk::new();
    let refine =
        "subdivide torus.off -o o.off --scheme loop --levels 3 --report r.json --vertex-table v.tsv --max-faces";
    desk.vv(&format!("{refine} 1000 --method uniform"))
        .assert_refused("level 3 would have 3840 faces; --max-faces allows 1000");
    desk.vv(&format!("{refine} 250 --method incremental --select disk:0,1")).assert_refused("level 2 would have ");
    desk.done(&format!("{refine} 3840 --method uniform"));
    let before = desk.read("o.off");
    desk.vv(&format!("{refine} 3839 --method uniform")).assert_refused("Nothing was written");
    assert_eq!(desk.read("o.off"), before);

    // Without a number the memory of the machine decides.
    let ran = desk.vv("subdivide torus.off -o p.off --scheme loop --levels 255 --method uniform");
    ran.assert_refused("GiB of free memory");
    assert!(!desk.path("p.off").exists());
}

#[test]
fn outputs_are_looked_at_before_any_work() {
    let desk = Desk::new();
    fs::create_dir(desk.path("folder.off")).unwrap();
    let before = desk.names();
    let refine = "--scheme loop --levels 1 --method uniform";
    for (options, words) in [
        ("-o o.ply", "the name must end in .obj or .off"),
        ("-o o", "the name must end in .obj or .off"),
        ("-o nowhere/o.off", "there is no folder nowhere"),
        ("-o grid.obj/o.off", "grid.obj"),
        ("-o folder.off", "this is a folder"),
        ("-o o.off --report o.off", "--report: o.off is the file of -o too"),
        ("-o o.off --report folder.off/../o.off", "is the file of -o too"),
        ("-o o.off --vertex-table t --face-table ./t", "is the file of --vertex-table too"),
        ("-o o.off --report torus.off", "is the file of MESH too"),
        ("-o o.off --report nowhere/r.json", "--report: nowhere/r.json: there is no folder nowhere"),
        ("-o o.off --face-table folder.off", "this is a folder"),
        ("-o o.off --report ..", "names no file"),
    ] {
        desk.vv(&format!("subdivide torus.off {options} {refine}")).assert_refused(words);
    }
    assert_eq!(desk.names(), before);
    desk.write("ids.txt", "0");
    desk.vv(&format!("subdivide torus.off -o o.off {refine} --select vertices:@ids.txt --report ids.txt"))
        .assert_refused("is the file of --select too");
    assert_eq!(desk.read("ids.txt"), "0");
}

#[test]
fn the_input_may_be_replaced_on_purpose() {
    let desk = Desk::new();
    desk.done("subdivide torus.off -o torus.off --scheme loop --levels 1 --method uniform");
    assert_eq!(desk.mesh("torus.off").face_count(), 240);
    assert_eq!(desk.names().len(), 2, "no temporary file is left");
}

#[cfg(unix)]
#[test]
fn what_is_write_protected_stays() {
    use std::os::unix::fs::PermissionsExt;
    let desk = Desk::new();
    let protect = |name: &str, mode| fs::set_permissions(desk.path(name), fs::Permissions::from_mode(mode)).unwrap();
    let refine = "--scheme loop --levels 1 --method uniform";
    desk.write("o.off", "old");
    protect("o.off", 0o444);
    desk.vv(&format!("subdivide torus.off -o o.off {refine}")).assert_refused("read-only");
    assert_eq!(desk.read("o.off"), "old");

    fs::create_dir(desk.path("closed")).unwrap();
    protect("closed", 0o555);
    if fs::write(desk.path("closed/probe"), "").is_ok() {
        eprintln!("skipped: this user may write in read-only folders");
        return;
    }
    desk.vv(&format!("subdivide torus.off -o closed/o.off {refine}"))
        .assert_refused("no file can be written in closed");
    protect("closed", 0o755);
}

#[test]
fn defects_are_named_with_whether_turning_faces_would_do() {
    let desk = Desk::new();
    let refine = "-o o.obj --scheme loop --levels 1 --method uniform";
    for (kind, faces) in FAULTS {
        desk.write("fault.obj", faces);
        let ran = desk.vv(&format!("subdivide fault.obj {refine}"));
        ran.assert_refused("fault.obj: not an oriented manifold of triangles: ");
        assert_eq!(ran.err.contains("turning faces round so that they agree would mend it"), kind == "orientation");
        assert!(!desk.path("o.obj").exists());
    }
}

#[test]
fn positions_out_of_range_are_refused() {
    let desk = Desk::new();
    desk.write(
        "far.obj",
        "v 1e308 0 0\nv 1.7e308 1e308 0\nv 1.7e308 0 1e308\nv 0 0 0\nf 1 2 3\nf 2 1 4\nf 3 2 4\nf 1 3 4\n",
    );
    let ran = desk.vv("subdivide far.obj -o o.obj --scheme loop --levels 1 --method uniform");
    ran.assert_refused("is not finite; scale the mesh down");
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

// With the mesh files.

#[test]
fn real_meshes_run_through_every_command() {
    let Some(meshes) = common::meshes() else { return };
    let desk = Desk::new();
    for name in ["models/spot_control_mesh.obj", "models/cube_poly.off", "papers/eight_96.off", "papers/foot_240.off"] {
        let path = meshes.join(name);
        let path = path.to_str().unwrap();
        desk.done(&format!("info {path} --json")).json();
        desk.done(&format!("check {path}"));
        for scheme in SCHEMES {
            for method in METHODS {
                desk.done(&format!(
                    "subdivide {path} -o o.off --scheme {scheme} --levels 2 --method {method} --select disk:0,2"
                ));
                desk.done("check o.off");
            }
        }
    }
    let moebius = meshes.join("models/moebius.obj");
    let refine = format!("subdivide {} -o x.off --scheme loop --levels 1 --method uniform", moebius.display());
    desk.vv(&refine).assert_refused("one-sided");
}

#[test]
fn uniform_loop_equals_the_reference() {
    let Some(meshes) = common::meshes() else { return };
    let desk = Desk::new();
    let folder = meshes.join("loop_reference");
    let entries = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let names: BTreeSet<String> = entries.filter_map(|name| name.strip_suffix("_0.obj").map(str::to_owned)).collect();
    assert!(!names.is_empty());
    for name in names {
        for level in 1..=3 {
            let reference = folder.join(format!("{name}_{level}.obj"));
            if !reference.exists() {
                continue;
            }
            let input = folder.join(format!("{name}_0.obj"));
            desk.done(&format!(
                "subdivide {} -o o.obj --scheme loop --levels {level} --method uniform",
                input.display()
            ));
            let [ours, theirs] = [desk.path("o.obj"), reference].map(|path| io::read(path).unwrap().faces.positions);
            assert_eq!(ours.len(), theirs.len(), "{name} {level}");
            let is_near = |of: &[DVec3], p: DVec3| of.iter().any(|q| q.distance(p) <= 2e-6);
            assert!(
                ours.iter().all(|&p| is_near(&theirs, p)) && theirs.iter().all(|&p| is_near(&ours, p)),
                "{name} {level}"
            );
        }
    }
}
