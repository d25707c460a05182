//! `vv subdivide --state`: runs that are left and gone on with, by every method; and methods on a hierarchy as a user meets them.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use common::desk::{Desk, SCHEMES};
use serde_json::{Value, json};

const METHODS: [&str; 6] = ["uniform", "simple", "incremental", "red-green", "red-green-restricted", "dynamic"];
const HIERARCHICAL: [&str; 2] = ["red-green-restricted", "dynamic"];

fn splits_in_four(scheme: &str) -> bool {
    !["sqrt3", "four-eight"].contains(&scheme)
}

/// Asserts that three runs of one level make what one run of three makes, from the first mesh on or from the last.
fn assert_goes_on(desk: &Desk, mesh: &str, how: &str) {
    let (first, ending) = (mesh, &mesh[mesh.len() - 3..]);
    desk.done(&format!("subdivide {first} -o whole.{ending} --levels 3 --vertex-table whole.tsv {how}"));
    for chained in [true, false] {
        let state = format!("state-{chained}.json");
        let _ = std::fs::remove_file(desk.path(&state));
        for level in 0..3 {
            let from = if chained && level > 0 { format!("part.{ending}") } else { first.to_owned() };
            let tags = if level == 0 { how.to_owned() } else { how.split(" --sharp").next().unwrap().to_owned() };
            desk.done(&format!(
                "subdivide {from} -o part.{ending} --levels 1 --vertex-table part.tsv --state {state} {tags}"
            ));
        }
        for (part, whole) in
            [(format!("part.{ending}"), format!("whole.{ending}")), ("part.tsv".into(), "whole.tsv".into())]
        {
            assert!(desk.read(&part) == desk.read(&whole), "{mesh} {how}, {part}, chained {chained}");
        }
    }
}

#[test]
fn runs_of_one_level_make_what_one_run_makes() {
    let desk = Desk::new();
    for scheme in SCHEMES {
        for method in METHODS
            .iter()
            .filter(|method| !method.starts_with("red") && **method != "dynamic" || splits_in_four(scheme))
        {
            assert_goes_on(&desk, "torus.off", &format!("--scheme {scheme} --method {method} --select disk:8,1"));
        }
    }
    assert_goes_on(&desk, "grid.obj", "--scheme loop --method dynamic --select-each sphere:2,2,0,1.5");
    for method in METHODS {
        assert_goes_on(&desk, "torus.off", &format!("--scheme loop --method {method} --select faces:0,1,5,8"));
    }
    desk.write("sharp.txt", "7 8 1.5\n8 9 2.25\n8 14 1.75\n14 20 inf\n3 - 1.25\n");
    let sharp = "--method incremental --rings 2 --select disk:8,2 --weights warren --sharp sharp.txt --creases chaikin";
    assert_goes_on(&desk, "grid.obj", &format!("--scheme loop {sharp}"));
    assert_goes_on(&desk, "grid.obj", "--scheme loop --method mobile --accuracy 0.01 --close");
}

#[test]
fn what_does_not_belong_to_a_state_is_refused() {
    let desk = Desk::new();
    let command = |mesh: &str, how: &str| format!("subdivide {mesh} -o out.obj --levels 1 --state s.json {how}");
    let how = "--scheme loop --method dynamic --select disk:8,1";
    desk.done(&command("grid.obj", how));
    let (good, mesh) = (desk.read("s.json"), desk.read("out.obj"));
    desk.vv(&command("torus.off", how)).assert_refused("does not belong to torus.off");
    desk.vv(&command("grid.obj", "--scheme butterfly --method dynamic"))
        .assert_refused("it was begun with --scheme loop");
    desk.vv(&command("grid.obj", "--scheme loop --method simple")).assert_refused("and cannot go on with");
    desk.vv(&command("grid.obj", &format!("{how} --boundary corners"))).assert_refused("leave --boundary out");
    desk.vv(&command("grid.obj", &format!("{how} --limit"))).assert_refused("--limit");
    desk.vv("subdivide grid.obj -o out.obj --levels 1 --scheme loop --method simple --state grid.obj")
        .assert_refused("is the file of");

    // Whatever stands in the file, it is refused with a reason, and nothing is written.
    let parsed: Value = serde_json::from_str(&good).unwrap();
    let set = |path: &str, value: Value| {
        let mut changed = parsed.clone();
        *changed.pointer_mut(path).unwrap() = value;
        changed.to_string()
    };
    let nan = f64::NAN.to_bits();
    let bad = [
        (String::new(), "no state of `vv`"),
        ("{".repeat(10_000), "no state of `vv`"),
        ("[".repeat(1_000_000), "no state of `vv`"),
        (good[..good.len() / 2].to_owned(), "no state of `vv`"),
        (set("/format", json!("something")), "no state of `vv`"),
        (set("/version", json!(1)), "version 1 of the format is not read"),
        (set("/boundary", json!("round")), "s.json: "),
        (set("/mesh/positions/3/1", json!(nan)), "the position of vertex 3 is not finite"),
        (set("/mesh/positions/3", json!([1, 2])), "s.json: "),
        (set("/mesh/triangles/0", json!([0, 1, 4_294_967_295_u32])), "s.json: "),
        (set("/mesh/triangles/0", json!([0, 0, 1])), "s.json: "),
        (set("/mesh/triangles", json!([])), "does not"),
        (set("/mesh/sharp_edges", json!([[0, 29, 0]])), "the sharp edge 0-29 does not exist"),
        (set("/mesh/sharp_edges", json!([[0, 1, nan]])), "sharpness"),
        (set("/mesh/sharp_vertices", json!([[4_294_967_295_u32, 0]])), "a sharp vertex does not exist"),
        (set("/steps/0", json!({"vertices": [[0, 4_294_967_295_u32]]})), "step 1 selects vertices that do not exist"),
        (set("/steps/0", json!({"vertices": [[5, 4]]})), "step 1 selects vertices"),
        (set("/steps/0", json!({"vertices": [[5, 7], [1, 2]]})), "step 1 selects vertices"),
        (set("/steps/0", json!({"edges": [[0, 30]]})), "step 1 selects vertices"),
        (set("/steps/0", json!({"edges": [[0, 29]]})), "cannot be made again: the selection names the edge v0-v29"),
        (set("/steps/0", json!({"faces": [[0, 1, 4_294_967_295_u32]]})), "step 1 selects vertices"),
        (
            set("/steps/0", json!({"faces": [[0, 1, 2]]})),
            "cannot be made again: the selection names the face (v0 v1 v2)",
        ),
        (set("/steps/0", json!([[0, 1]])), "s.json: "),
        (set("/steps", json!(vec![json!({"vertices": [[0, 30]]}); 9])), "cannot be made again"),
    ];
    for (text, words) in bad {
        desk.write("s.json", &text);
        desk.vv(&command("out.obj", &format!("{how} --max-faces 500"))).assert_refused(words);
        assert_eq!((desk.read("s.json"), desk.read("out.obj")), (text, mesh.clone()));
    }
}

/// On a hierarchy faces are taken back, so what is said of them rides along from the first mesh on.
#[test]
fn texture_coordinates_ride_along_from_the_mesh_with_which_a_run_began() {
    let desk = Desk::new();
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    desk.write("uv.obj", text);
    for method in ["red-green", "red-green-restricted", "dynamic"] {
        let how = format!("--scheme loop --method {method} --select vertices:0,1,2");
        let state = format!("--levels 1 --state {method}.json");
        desk.done(&format!("subdivide uv.obj -o whole.obj --levels 2 {how}"));
        desk.done(&format!("subdivide uv.obj -o first.obj {state} {how}"));
        desk.vv(&format!("subdivide first.obj -o out.obj {state} {how}"))
            .assert_refused(&format!("give the mesh with which {method}.json began"));
        desk.done(&format!("subdivide uv.obj -o out.obj {state} {how}"));
        assert_eq!(desk.read("out.obj"), desk.read("whole.obj"));
    }
}

#[test]
fn methods_on_a_hierarchy_make_conforming_meshes_and_matrices() {
    let desk = Desk::new();
    for method in HIERARCHICAL {
        for scheme in SCHEMES {
            let how = format!("--scheme {scheme} --levels 3 --method {method} --select disk:8,1");
            if !splits_in_four(scheme) {
                desk.vv(&format!("subdivide torus.off -o f.obj {how}"))
                    .assert_refused(&format!("--scheme = {scheme}: "));
                continue;
            }
            let report = desk.done(&format!("subdivide torus.off -o f.obj --face-table f.tsv --json {how}")).json();
            let last = report["levels"].as_array().unwrap().last().unwrap().clone();
            assert!(last["certified"].as_u64().unwrap() > 6 && last["t_vertices"].as_u64().unwrap() > 0, "{last}");
            desk.done("check f.obj");
            assert!(desk.read("f.tsv").contains("closure"));
            desk.done(&format!("matrix torus.off -o f.mtx {how}"));
        }
    }
}
