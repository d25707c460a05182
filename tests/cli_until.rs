//! `vv subdivide --until` as its user meets it, and what is refused before it takes long.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::time::{Duration, Instant};

use common::desk::{Desk, keys, sorted};
use vvmesh::query::measure::bounds;
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{AnyMethod, Control, Subdivider};
use vvmesh::until::{Measure, Until};
use vvmesh::{Accuracy, Mesh};

const UNTIL: &str = "subdivide torus.off -o near.obj --scheme loop --until";

/// The same by the library, with the greatest distance before each step and after the last.
fn reached(mut mesh: Mesh, accuracy: f64, measure: Measure, method: AnyMethod) -> (Mesh, Vec<f64>) {
    let mut history = History::new(&mesh, Keep::default());
    let until = Until::new(Loop::default(), Accuracy::new(accuracy).unwrap(), measure).unwrap();
    let subdivider = Subdivider::of(Loop::default(), method).unwrap();
    let (mut scratch, mut distances) = (Scratch::new(), Vec::new());
    loop {
        let left = until.look(&mesh, &history).unwrap();
        distances.push(left.distance);
        if left.is_reached() {
            return (mesh, distances);
        }
        subdivider.step(&mut mesh, &mut history, &left.selection, &mut scratch, &mut Control::default()).unwrap();
    }
}

#[test]
fn it_refines_until_the_accuracy_is_reached_and_tells_what_is_left() {
    let desk = Desk::new();
    for (options, measure, method) in [
        ("", Measure::Bound, AnyMethod::Dynamic),
        (" --measure vertex", Measure::Vertex, AnyMethod::Dynamic),
        (" --method red-green-restricted", Measure::Bound, AnyMethod::RedGreenRestricted),
        (" --method uniform --measure bound", Measure::Bound, AnyMethod::Uniform),
    ] {
        let (mesh, distances) = reached(desk.mesh("torus.off"), 0.03, measure, method);
        let json = desk.done(&format!("{UNTIL} 0.03{options} --json")).json();
        assert_eq!(desk.mesh("near.obj").positions(), mesh.positions(), "{options}");
        let until = &json["until"];
        assert_eq!(
            keys(until),
            sorted(["accuracy", "measure", "first_error", "error", "far_faces", "reached"]),
            "{options}"
        );
        assert_eq!((&until["measure"], &until["reached"]), (&measure.name().into(), &true.into()));
        assert_eq!((until["far_faces"].as_u64(), until["error"].as_f64()), (Some(0), distances.last().copied()));
        let rows = json["levels"].as_array().unwrap().iter().map(|row| &row["error"]);
        let told: Vec<f64> = [&until["first_error"]].into_iter().chain(rows).map(|x| x.as_f64().unwrap()).collect();
        assert_eq!(told, distances, "{options}");
        assert_eq!((&json["method"], &json["select"]), (&method.name().into(), &"until".into()));
    }
    let ran = desk.done(&format!("{UNTIL} 0.03"));
    assert!(ran.out.contains("error left") && ran.err.is_empty(), "{}{}", ran.out, ran.err);
    // Without it there is no such column.
    let plain = desk.done("subdivide torus.off -o o.obj --scheme loop --method dynamic --levels 1 --report r.json");
    assert!(!plain.out.contains("error left") && !desk.read("r.json").contains("\"error\""));
}

#[test]
fn percent_is_of_the_diagonal() {
    let desk = Desk::new();
    let diagonal = bounds(&desk.mesh("torus.off")).unwrap().diagonal();
    let json = desk.done(&format!("{UNTIL} 1% --json")).json();
    assert_eq!(json["until"]["accuracy"].as_f64(), Some(diagonal / 100.0));
    let percent = desk.read("near.obj");
    desk.done(&format!("{UNTIL} {}", diagonal / 100.0));
    assert_eq!(desk.read("near.obj"), percent);
    desk.write("point.obj", "v 1 2 3\n");
    desk.vv("subdivide point.obj -o o.obj --scheme loop --until 1%").assert_refused("no distance above 0");
}

#[test]
fn levels_and_faces_end_it_and_what_was_made_is_written() {
    let desk = Desk::new();
    for (option, faces) in [("--levels 1", 240), ("--max-faces 300", 240), ("--levels 0", 60)] {
        let ran = desk.vv(&format!("{UNTIL} 0.001 {option} --json"));
        assert_eq!(ran.code, Some(1), "{}", ran.err);
        assert!(ran.err.contains("--until: 1e-3 is not reached; ") && ran.err.contains("may be farther away, up to "));
        let json = ran.json();
        assert_eq!((&json["until"]["reached"], desk.mesh("near.obj").face_count()), (&false.into(), faces));
        assert!(json["until"]["error"].as_f64().unwrap() > 0.001 && json["until"]["far_faces"] == faces);
        assert_eq!(ran.err.contains("--max-faces allows 300"), option.starts_with("--max-faces"), "{}", ran.err);
    }
    let vertices = desk.vv(&format!("{UNTIL} 0.001 --levels 1 --measure vertex"));
    assert!(vertices.code == Some(1) && vertices.err.contains(" faces are farther away, up to "), "{}", vertices.err);
    // What is near enough already is copied.
    let ran = desk.done(&format!("{UNTIL} 100"));
    assert_eq!((desk.mesh("near.obj").face_count(), ran.out.contains("level")), (60, false));
}

#[test]
fn two_runs_make_what_one_makes() {
    let desk = Desk::new();
    desk.done(&format!("{UNTIL} 0.02"));
    let once = desk.read("near.obj");
    assert_eq!(desk.vv(&format!("{UNTIL} 0.02 --levels 1 --state s.json")).code, Some(1));
    desk.done(&format!("{UNTIL} 0.02 --state s.json"));
    assert_eq!(desk.read("near.obj"), once);
    // Another selection begins anew.
    desk.done(
        "subdivide torus.off -o o.obj --scheme loop --method dynamic --levels 1 --select vertices:0 --state s.json",
    );
}

#[test]
fn semi_sharp_edges_are_refined_until_they_have_faded() {
    let desk = Desk::new();
    desk.write("sharp.txt", "0 1 1.5\n1 2 1.5\n");
    let ran = desk.vv(&format!("{UNTIL} 0.05 --sharp sharp.txt --levels 1 --json"));
    assert_eq!((ran.code, &ran.json()["until"]["error"]), (Some(1), &serde_json::Value::Null));
    assert!(ran.err.contains("up to inf"), "{}", ran.err);
    assert_eq!(desk.done(&format!("{UNTIL} 0.05 --sharp sharp.txt --json")).json()["until"]["reached"], true);
}

#[test]
fn a_matrix_is_that_of_the_same_refinement() {
    let desk = Desk::new();
    let rows =
        |options: &str| desk.vv(&format!("matrix torus.off -o s.mtx --scheme loop --until 0.05 --json{options}"));
    desk.done(&format!("{UNTIL} 0.05"));
    assert_eq!(rows("").json()["rows"], desk.mesh("near.obj").vertex_count());
    assert_eq!(rows(" --levels 1").code, Some(1));
}

#[test]
fn what_has_no_meaning_is_refused() {
    let desk = Desk::new();
    let expected = "expected a finite distance above 0, or one in percent";
    for (options, words) in [
        ("0", expected),
        ("-1", expected),
        ("nan", expected),
        ("inf", expected),
        ("1%%", expected),
        ("%", expected),
        ("0%", expected),
        ("1e-20", "finer than rounding allows"),
        ("1 --select all", "cannot be used with"),
        ("1 --select-each all", "cannot be used with"),
        ("1 --method simple", "it is not exact where the selection moves"),
        ("1 --method incremental", "it is not exact where the selection moves"),
        ("1 --method red-green", "it is not exact where the selection moves"),
        ("1 --method mobile --accuracy 1", "an accuracy of its own"),
        ("1 --accuracy 1", "only `mobile` looks at limits"),
        ("1 --limit", "--limit has no meaning with --until"),
        ("1 --measure distance", "invalid value"),
    ] {
        desk.vv(&format!("{UNTIL} {options}")).assert_refused(words);
    }
    for scheme in ["butterfly", "modified-butterfly", "midpoint", "sqrt3", "four-eight"] {
        let ran = desk.vv(&format!("subdivide torus.off -o o.obj --scheme {scheme} --until 1"));
        ran.assert_refused("the distance to the limit surface is known under `loop` alone");
    }
    let plain = "subdivide torus.off -o o.obj --scheme loop --levels 1";
    desk.vv(&format!("{plain} --method dynamic --measure bound")).assert_refused("--until");
    desk.vv(plain).assert_refused("--method");
}

#[test]
fn what_is_too_large_in_advance_is_refused_at_once() {
    let (desk, started) = (Desk::new(), Instant::now());
    for method in ["uniform", "simple", "incremental", "red-green", "red-green-restricted", "dynamic"] {
        let call = format!("subdivide torus.off -o o.off --scheme loop --method {method} --select");
        desk.vv(&format!("{call} all --levels 30")).assert_refused("GiB of free memory");
        desk.vv(&format!("{call} all --levels 3 --max-faces 3839")).assert_refused("level 3 would have 3840 faces");
        desk.done(&format!("{call} all --levels 3 --max-faces 3840"));
        // A selection with faces inside; those around them come on top.
        desk.vv(&format!("{call} disk:0,2 --levels 30")).assert_refused("GiB of free memory");
    }
    for (scheme, faces) in [("sqrt3", 60 * 27), ("four-eight", 60 * 8)] {
        let call =
            format!("subdivide torus.off -o o.off --scheme {scheme} --method incremental --levels 3 --max-faces");
        desk.vv(&format!("{call} {}", faces - 1)).assert_refused(&format!("level 3 would have {faces} faces"));
        desk.done(&format!("{call} {faces}"));
    }
    for selection in ["all", "disk:0,2"] {
        let ran = desk.vv(&format!("compare torus.off --select {selection} --levels 20"));
        ran.assert_refused("around the selection the step would make");
    }
    assert!(started.elapsed() < Duration::from_secs(60), "{:?}", started.elapsed());
}
