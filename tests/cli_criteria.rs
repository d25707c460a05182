//! The criteria of expressions as a user of `vv` meets them: kinds, the camera, fields, tags.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use common::desk::{Desk, numbers};
use vvmesh::select::Expression;

/// Straight above the grid of 5 x 4 squares, all of which it sees.
const ABOVE: &str = "eye=2,2,10,at=2,2,0,up=0,1,0,fov=90,size=200x200";

/// A square of four triangles around a red vertex; the others are blue.
const COLORED: &str = "v 0 0 0 0 0 1\nv 2 0 0 0 0 1\nv 2 2 0 0 0 1\nv 0 2 0 0 0 1\nv 1 1 0 1 0 0\n\
                       f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n";

#[test]
fn every_criterion_has_its_kind_and_stands_in_the_help() {
    let desk = Desk::new();
    let cases = [
        ("limit-error:1%", "vertices"),
        ("curvature:0.1", "vertices"),
        ("curvature-top:10%", "vertices"),
        ("mean-curvature:0.1", "vertices"),
        ("normal-cone:5", "vertices"),
        ("flatness:0.1%", "vertices"),
        ("valence:5", "vertices"),
        ("edge-length:10%", "edges"),
        ("boundary", "edges"),
        ("sharp", "edges"),
        ("silhouette:eye=9,9,9", "edges"),
        ("silhouette:dir=0,0,1", "edges"),
        ("area:0.1", "faces"),
    ];
    for (expression, kind) in cases {
        let ran = desk.run(&["select", "torus.off", "--select", expression, "--json"]);
        assert_eq!((ran.code, ran.json()["kind"].as_str()), (Some(0), Some(kind)), "{expression}: {}", ran.err);
    }
    for (expression, kind) in [("pixel-length:5", "edges"), ("frustum", "faces"), ("pixel-area:5", "faces")] {
        let ran = desk.run(&["select", "grid.obj", "--select", expression, "--camera", ABOVE, "--json"]);
        assert_eq!((ran.code, ran.json()["kind"].as_str()), (Some(0), Some(kind)), "{expression}: {}", ran.err);
        assert_eq!(ran.json()["selected"], 30, "{expression} is all of the grid");
    }
    for command in ["select", "subdivide", "compare", "matrix"] {
        let help = desk.done(&format!("{command} --help")).out;
        for form in Expression::known_criteria() {
            let name = form.split(':').next().unwrap();
            assert!(help.contains(&format!("\n  {name}")), "{command} --help does not name {form}");
        }
    }
}

#[test]
fn a_camera_is_given_if_and_only_if_something_looks_through_it() {
    let desk = Desk::new();
    let missing = "`frustum` looks through a camera, and there is none; give one with --camera";
    let unused = "nothing in it looks through a camera; leave it out";
    let refine = "grid.obj --scheme loop --levels 1 --method simple -o out";
    for command in ["select grid.obj", "compare grid.obj --levels 1", &format!("subdivide {refine}.obj")] {
        desk.vv(&format!("{command} --select all|frustum")).assert_refused(missing);
        desk.vv(&format!("{command} --select all --camera {ABOVE}")).assert_refused(unused);
        desk.vv(&format!("{command} --select frustum --camera fov=1")).assert_refused("--camera");
    }
    desk.vv(&format!("subdivide {refine}.obj --camera {ABOVE}")).assert_refused(unused);
    desk.vv(&format!("matrix {refine}.mtx --select frustum")).assert_refused(missing);
    let broken = [
        ("size=200x200", "size=0x200"),
        ("size=200x200", "size=200"),
        ("up=0,1,0", "up=0,0,1"),
        ("eye=2,2,10", "eye=2,2,0"),
        ("eye=2,2,10", "eye=2,2,1e999"),
        ("at=2,2,0", "at=nan,0,0"),
        ("fov=90", "fov=180"),
        (",fov=90", ""),
        ("fov=90", "fov=90,fov=90"),
        (ABOVE, "x"),
        (ABOVE, ""),
    ];
    for (part, other) in broken {
        let camera = ABOVE.replace(part, other);
        let ran = desk.run(&["select", "grid.obj", "--select", "frustum", "--camera", &camera]);
        assert_eq!((ran.code, ran.out.as_str()), (Some(2), ""), "{camera}: {}", ran.err);
    }
}

#[test]
fn a_run_that_goes_on_sees_another_camera() {
    let desk = Desk::new();
    let step = |camera: &str| {
        let run = "subdivide grid.obj -o out.obj --scheme loop --levels 1 --method simple --select pixel-area:5 --json";
        let report = desk.done(&format!("{run} --state state.json --camera {camera}")).json();
        report["levels"].as_array().unwrap().last().unwrap()["selected"].as_u64().unwrap()
    };
    assert_eq!(step(ABOVE), 30);
    // The same camera follows, one from far away picks nothing.
    assert!(step(ABOVE) > 30);
    assert_eq!(step(&ABOVE.replace("2,2,10", "2,2,1000")), 0);
}

#[test]
fn colours_are_fields_and_ride_along() {
    let desk = Desk::new();
    desk.write("colored.obj", COLORED);
    let picked = |expression: &str| {
        let ran = desk.run(&["select", "colored.obj", "--select", expression, "--json"]);
        numbers(&ran.json()["selected_vertices"])
    };
    assert_eq!(picked("field:red>0.5"), [4]);
    assert_eq!(picked("field:blue >= 1"), [0, 1, 2, 3]);
    assert_eq!(picked("field:green<0 | field:red<=0 & !disk:0,0"), [1, 2, 3]);

    let select = ["--select-each", "field:red>0.4"];
    let refine = "--scheme midpoint --levels 2 --method incremental --json";
    let run = |out: &str| {
        let arguments = format!("subdivide colored.obj -o {out} {refine}");
        let arguments: Vec<&str> = arguments.split_whitespace().chain(select).collect();
        desk.run(&arguments)
    };
    // After a step the four midpoints beside the red vertex are half red.
    let report = run("out.obj").json();
    assert_eq!((&report["levels"][0]["selected"], &report["levels"][1]["selected"]), (&1.into(), &5.into()));
    run("out.off").assert_refused("colours ride along only where they are written, to OBJ or PLY");

    let unknown = "the mesh has no field `heat`: there are red, green and blue";
    desk.vv("select colored.obj --select field:heat>1").assert_refused(unknown);
    desk.vv("compare colored.obj --levels 1 --select field:heat>1").assert_refused(unknown);
    desk.vv("select grid.obj --select !field:red>1").assert_refused("its vertices have no colours");
    desk.done("matrix colored.obj -o out.mtx --scheme loop --levels 1 --method simple --select field:red<1");
}

#[test]
fn select_reads_tags() {
    let desk = Desk::new();
    desk.write("sharp.txt", "7 8\n");
    let picked = |arguments: &str| {
        let ran = desk
            .run(&[&["select", "grid.obj", "--json", "--select"], &*arguments.split(' ').collect::<Vec<_>>()].concat());
        numbers(&ran.json()["selected_vertices"])
    };
    assert_eq!(picked("sharp&!boundary --sharp sharp.txt"), [7, 8]);
    assert_eq!(picked("sharp&!boundary"), [0; 0]);
    assert_eq!(picked("limit-error:0.01 --boundary fixed"), [0; 0]);
    desk.vv("select grid.obj --select sharp --creases chaikin").assert_refused("--creases has no meaning here");
}
