//! `vv subdivide` as its user meets it: what it makes, what its options do, what it refuses.
#![cfg(feature = "cli")]

mod common;

use std::collections::BTreeSet;
use std::fs;

use common::desk::{Desk, FAULTS, METHODS, SCHEMES, keys, sorted};
use serde_json::Value;
use vvmesh::adaptive::{Incremental, Uniform};
use vvmesh::certify::Certificate;
use vvmesh::glam::DVec3;
use vvmesh::limit::{Limit, LoopLimit};
use vvmesh::mesh::{BoundaryPolicy, Sharpness, SharpnessRule};
use vvmesh::scheme::{Loop, LoopWeights};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Disk, Selection};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Edge, Mesh, VertexId, io, shapes};

// What it makes.

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

/// Of six triangles of a grid the one at its corner 0 has all corners selected.
#[test]
fn the_tables_of_sqrt3_name_what_it_makes() {
    let desk = Desk::new();
    let command = "subdivide grid.obj -o o.obj --scheme sqrt3 --vertex-table v.tsv --face-table f.tsv --json";
    let report = desk.done(&format!("{command} --levels 2 --method uniform")).json();
    let mesh = desk.mesh("o.obj");
    let rows: Vec<Vec<String>> =
        desk.read("v.tsv").lines().skip(1).map(|line| line.split('\t').map(str::to_owned).collect()).collect();
    assert_eq!(rows.len(), mesh.vertex_count());
    let count = |mark: char, times: usize| rows.iter().filter(|row| row[2].matches(mark).count() == times).count();
    let boundary_edges = shapes::grid(5, 4).rotation().boundary_edge_count();
    assert_eq!((count('>', 1), count(',', 1)), (2 * boundary_edges, 0));
    assert!(rows.iter().all(|row| row[4] == "-"), "nothing is certified");
    let step = &report["levels"][1];
    assert_eq!(
        (&step["split_edges"], &step["t_vertices"], &step["certified"]),
        (&boundary_edges.into(), &0.into(), &Value::Null)
    );

    desk.done(&format!("{command} --levels 1 --method simple --select disk:14,1"));
    let faces = desk.read("f.tsv");
    let kinds = |kind: &str| faces.lines().filter(|line| line.split('\t').nth(2) == Some(kind)).count();
    // Six triangles around a vertex: of the eighteen, six wait for the triangle outside.
    assert_eq!((kinds("odd"), kinds("even"), kinds("regular")), (6, faces.lines().count() - 1 - 6, 0));
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
        assert!(ran.err.contains("picks nothing"), "{}", ran.err);
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
fn what_is_not_carried_over_is_told() {
    let desk = Desk::new();
    let refine = "-o o.off --scheme loop --levels 1 --method uniform";
    assert_eq!(desk.done(&format!("subdivide grid.obj {refine}")).err, "");
    desk.write("named.obj", format!("o grid\n{}", desk.read("grid.obj")));
    let told = desk.done(&format!("subdivide named.obj {refine}")).err;
    assert!(told.starts_with("note: named.obj: only positions and faces are written again"), "{told}");
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

// Options of schemes.

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
    // On a straight side a boundary vertex stays anyway; the four corners of the grid tell the policies apart.
    let tips = [0, 5, 24, 29].map(VertexId::new);
    for (policy, staying) in [("smooth", 0), ("corners", 2), ("fixed", 4)] {
        desk.done(&format!(
            "subdivide grid.obj -o o.obj --scheme loop --levels 1 --method uniform --boundary {policy}"
        ));
        let fine = desk.mesh("o.obj");
        assert_eq!(tips.iter().filter(|&&v| fine.position(v) == grid.position(v)).count(), staying, "{policy}");
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

/// The mesh after two uniform steps of Loop.
fn refined_twice(mut mesh: Mesh) -> Mesh {
    let mut history = History::new(&mesh, Keep::default());
    let subdivider = Subdivider::new(Loop::default(), Uniform);
    for _ in 0..2 {
        let (mut scratch, mut control) = (Scratch::new(), Control::default());
        subdivider.step(&mut mesh, &mut history, &Selection::empty(), &mut scratch, &mut control).expect("a step");
    }
    mesh
}

/// The grid, bent, so that a sharp edge makes a difference.
fn bent(desk: &Desk) -> Mesh {
    let mut mesh = desk.mesh("grid.obj");
    for p in mesh.positions_mut() {
        p.z = p.x * p.y + p.y * p.y * p.y;
    }
    io::save(desk.path("bent.obj"), &mesh).expect("a file");
    mesh
}

#[test]
fn sharpness_is_read_from_a_file() {
    let desk = Desk::new();
    let input = bent(&desk);
    let [a, b, c] = [7, 8, 9].map(VertexId::new);
    let mut tagged = input.clone();
    for (edge, value) in [(Edge::new(a, b), 1.25), (Edge::new(b, c), 3.0)] {
        tagged.set_sharpness(edge, Sharpness::new(value).unwrap());
    }
    tagged.set_vertex_sharpness(a, Sharpness::new(0.5).unwrap());
    // The last line on an edge counts, and 0 takes a tag off.
    desk.write("sharp.txt", "7 8 inf\n8 7 1.25\n8 9 3e0 # three\n7 - .5\n9\n9 - 0\n13 14\n13 14 0\n");
    let refine = "subdivide bent.obj --scheme loop --levels 2 --method uniform";
    for (option, rule) in [("uniform", SharpnessRule::Uniform), ("chaikin", SharpnessRule::Chaikin)] {
        let ran = desk.done(&format!("{refine} -o {option}.obj --sharp sharp.txt --creases {option} --json"));
        tagged.set_sharpness_rule(rule);
        assert_eq!(desk.mesh(&format!("{option}.obj")).positions(), refined_twice(tagged.clone()).positions());
        assert_eq!(ran.json()["creases"], option);
    }
    assert!(desk.read("uniform.obj") != desk.read("chaikin.obj"));
    desk.done(&format!("{refine} -o default.obj --sharp sharp.txt"));
    assert!(desk.read("default.obj") == desk.read("uniform.obj"));
}

#[test]
fn no_limit_is_known_before_all_has_faded() {
    let desk = Desk::new();
    desk.write("sharp.txt", "7 8 2.5\n13 - 1\n");
    let refine = "subdivide grid.obj -o o.obj --scheme loop --sharp sharp.txt --limit";
    for (levels, left) in [(0, "3 more levels"), (1, "2 more levels"), (2, "1 more level everywhere")] {
        desk.vv(&format!("{refine} --method uniform --levels {levels}")).assert_refused(left);
        assert!(!desk.path("o.obj").exists());
    }
    desk.done(&format!("{refine} --method uniform --levels 3"));
    // What is not refined does not fade.
    let far = "--method incremental --levels 3 --select vertices:29";
    desk.vv(&format!("{refine} {far}")).assert_refused("3 more levels everywhere");
}

#[test]
fn butterfly_takes_no_finite_sharpness() {
    let desk = Desk::new();
    let refine =
        "subdivide grid.obj -o o.obj --scheme modified-butterfly --levels 1 --method uniform --sharp sharp.txt";
    desk.write("sharp.txt", "7 8 2.5\n");
    desk.vv(refine).assert_refused("--scheme modified-butterfly cannot blend masks");
    desk.write("sharp.txt", "7 8 2.5\n7 8 inf\n");
    desk.done(refine);
}

const TAGS: &str = "\
t crease 2/1/0 7 8 1.5
t crease 2/1/0 8 9 10
t corner 1/1/0 13 0.75
t interpolateboundary 1/0/0 1
t hole 1/0/0 3
";

#[test]
fn tag_lines_are_read_on_request() {
    let desk = Desk::new();
    let mut tagged = bent(&desk);
    desk.write("tagged.obj", desk.read("bent.obj") + TAGS);
    let refine = "subdivide tagged.obj -o o.obj --scheme loop --levels 2 --method uniform --tags obj";
    let [a, b, c, v] = [7, 8, 9, 13].map(VertexId::new);
    tagged.set_sharpness(Edge::new(a, b), Sharpness::new(1.5).unwrap());
    tagged.set_sharp(Edge::new(b, c), true);
    tagged.set_vertex_sharpness(v, Sharpness::new(0.75).unwrap());
    let mut cornered = tagged.clone();
    cornered.apply_boundary_policy(BoundaryPolicy::Corners);

    let ran = desk.done(&format!("{refine} --json"));
    assert!(ran.err.contains("1 unknown statement ignored, first 't hole'"), "{}", ran.err);
    assert!(!ran.err.contains("tag line"), "{}", ran.err);
    assert_eq!(ran.json()["boundary"], "corners");
    assert_eq!(desk.mesh("o.obj").positions(), refined_twice(cornered.clone()).positions());
    // Options win over the file.
    desk.done(&format!("{refine} --boundary smooth"));
    assert_eq!(desk.mesh("o.obj").positions(), refined_twice(tagged).positions());
    desk.write("sharp.txt", "8 7 0\n13 - 2\n");
    cornered.set_sharp(Edge::new(a, b), false);
    cornered.set_vertex_sharpness(v, Sharpness::new(2.0).unwrap());
    desk.done(&format!("{refine} --sharp sharp.txt"));
    assert_eq!(desk.mesh("o.obj").positions(), refined_twice(cornered).positions());

    let ran = desk.done("subdivide grid.obj -o o.obj --scheme loop --levels 0 --method uniform --tags obj");
    assert!(ran.err.contains("there are no tag lines in it"), "{}", ran.err);
}

#[test]
fn wrong_tag_lines_are_refused_where_they_are_read() {
    let desk = Desk::new();
    let grid = desk.read("grid.obj");
    let line = grid.lines().count() + 1;
    let refine = "subdivide tagged.obj -o o.obj --scheme loop --levels 1 --method uniform";
    for (tag, words) in [
        ("crease 2/1/0 7 8", "expected 't crease 2/1/0 V1 V2 S'"),
        ("crease 2/0/0 7 8 1", "expected 't crease 2/1/0 V1 V2 S'"),
        ("crease 2/1/0 7 8 -1", "expected a sharpness, 0 (smooth) or more, found '-1'"),
        ("crease 2/1/0 7 8 soft", "expected a number, found 'soft'"),
        ("crease 2/1/0 7 8.5 1", "expected a whole number, found '8.5'"),
        ("crease 2/1/0 7 30 1", "vertex (counted from 0) 30, there are 30"),
        ("crease 2/1/0 -1 7 1", "vertex (counted from 0) -1, there are 30"),
        ("crease 2/1/0 7 9 1", "no edge between the vertices 7 and 9, counted from 0"),
        ("crease 2/1/0 7 7 1", "no edge between the vertices 7 and 7"),
        ("corner 1/1/0 7", "expected 't corner 1/1/0 V S'"),
        ("corner 1/1/0 99 1", "vertex (counted from 0) 99"),
        ("interpolateboundary 1/0/0 0", "with 1 (edges and corners) or 2 (edges only), found"),
    ] {
        desk.write("tagged.obj", format!("{grid}t {tag}\n"));
        let ran = desk.vv(&format!("{refine} --tags obj"));
        ran.assert_refused(words);
        assert!(ran.err.contains(&format!("tagged.obj: line {line}: ")), "{}", ran.err);
        desk.done(refine);
        fs::remove_file(desk.path("o.obj")).unwrap();
    }
    let off = "subdivide torus.off -o o.obj --scheme loop --levels 1 --method uniform --tags obj";
    desk.vv(off).assert_refused("torus.off is OFF, which has no tag lines");
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
        ("0 1 nan", "expected a sharpness, 0 (smooth) or more or `inf`, found `nan`"),
        ("0 1 -0.5", "found `-0.5`"),
        ("0 - x", "expected a sharpness, 0 (smooth) or more or `inf`, found `x`"),
        ("0 -", "expected the id of a vertex, found `-`"),
        ("30 - 1", "no vertex 30"),
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
        ("--scheme modified-butterfly --method uniform --limit", "its vertices stay where they are made"),
        ("--scheme midpoint --method uniform --boundary smooth", "--boundary has no meaning with --scheme midpoint"),
        ("--scheme butterfly --method uniform --sharp sharp.txt", "--sharp has no meaning with --scheme butterfly"),
        ("--scheme midpoint --method uniform --sharp-angle 3", "--sharp-angle has no meaning"),
        ("--scheme sqrt3 --method uniform --sharp-angle 3", "--sharp-angle has no meaning with --scheme sqrt3"),
        ("--scheme sqrt3 --method simple --sharp sharp.txt", "--sharp has no meaning with --scheme sqrt3"),
        ("--scheme sqrt3 --method uniform --boundary fixed", "--boundary has no meaning with --scheme sqrt3"),
        ("--scheme sqrt3 --method uniform --weights loop", "--weights has no meaning with --scheme sqrt3"),
        ("--scheme sqrt3 --method simple --limit", "known after `uniform` steps only"),
        ("--scheme four-eight --method uniform --weights warren", "--weights has no meaning with --scheme four-eight"),
        ("--scheme four-eight --method uniform --limit", "its limits are not known"),
        ("--scheme four-eight --method uniform --boundary fixed", "--boundary has no meaning"),
        ("--scheme four-eight --method uniform --sharp sharp.txt", "--sharp has no meaning"),
        ("--scheme loop --method uniform --blocks maximum", "--blocks has no meaning with --scheme loop"),
        ("--scheme butterfly --method uniform --tags obj", "--tags has no meaning with --scheme butterfly"),
        ("--scheme modified-butterfly --method uniform --creases chaikin", "--creases has no meaning"),
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
        "--scheme four-eight --method simple --blocks longest-edge",
        "--scheme loop --method simple --creases chaikin",
    ] {
        desk.done(&format!("{refine} {options}"));
    }
}

#[test]
fn blocks_are_told_and_vertices_named() {
    let desk = Desk::new();
    let sphere = shapes::icosahedron();
    io::save(desk.path("sphere.off"), &sphere).unwrap();
    let refine = "subdivide sphere.off -o o.off --scheme four-eight --method uniform --levels 2 --vertex-table v.tsv";
    let all = desk.done(&format!("{refine} --face-table f.tsv --json"));
    assert_eq!(all.json()["totals"]["faces"], 80);
    assert!(!all.err.contains("in no block"), "{}", all.err);
    let table = desk.read("f.tsv");
    assert!(table.lines().skip(1).all(|line| line.split('\t').skip(1).take(2).eq(["2", "regular"])), "{table}");
    // Without a search some faces are left, whose centres have three parents.
    let some = desk.done(&format!("{refine} --blocks longest-edge"));
    assert!(some.err.contains("in no block and split in three"), "{}", some.err);
    let table = desk.read("v.tsv");
    let parents = table.lines().skip(1).map(|line| line.split('\t').nth(2).unwrap().split(',').count());
    let centers = parents.filter(|&count| count == 3).count();
    assert!(some.err.contains(&format!("{centers} faces")), "{centers}: {}", some.err);
}

// What is refused, and what is left then.

#[test]
fn too_many_faces_are_refused_before_they_are_made() {
    let desk = Desk::new();
    let refine =
        "subdivide torus.off -o o.off --scheme loop --levels 3 --report r.json --vertex-table v.tsv --max-faces";
    desk.vv(&format!("{refine} 1000 --method uniform"))
        .assert_refused("level 3 would have 3840 faces; --max-faces allows 1000");
    // The faces inside of the selection alone are not too many.
    let part = "subdivide torus.off -o o.off --scheme loop --levels 2 --method incremental --select disk:0,1";
    desk.vv(&format!("{part} --max-faces 250")).assert_refused("level 2 would have ");
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
        ("-o o.gltf", "the name must end in .obj, .off, .ply or .stl"),
        ("-o o", "the name must end in .obj, .off, .ply or .stl"),
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
#[allow(clippy::print_stderr, reason = "a test that is skipped must say so")]
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
            // What the tag lines of these meshes say is what holds without them.
            for tags in ["", "--tags obj"] {
                desk.done(&format!(
                    "subdivide {} -o o.obj --scheme loop --levels {level} --method uniform {tags}",
                    input.display()
                ));
                let [ours, theirs] =
                    [desk.path("o.obj"), reference.clone()].map(|path| io::read(path).unwrap().faces.positions);
                assert_eq!(ours.len(), theirs.len(), "{name} {level}");
                let is_near = |of: &[DVec3], p: DVec3| of.iter().any(|&q| (q - p).abs().max_element() <= 1e-6);
                assert!(
                    ours.iter().all(|&p| is_near(&theirs, p)) && theirs.iter().all(|&p| is_near(&ours, p)),
                    "{name} {level} {tags}"
                );
            }
        }
    }
}
