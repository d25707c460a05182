//! `vv subdivide --method mobile` as its user meets it.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use common::desk::Desk;
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Accuracy, Mesh, io};

const MOBILE: &str = "--scheme loop --method mobile --accuracy 0.02";

/// The same by the library.
fn refined(mut mesh: Mesh) -> (Mesh, History) {
    let mut history = History::new(&mesh, Keep::default());
    let subdivider = Subdivider::mobile(Loop::default(), Accuracy::new(0.02).unwrap()).unwrap();
    let (mut selection, mut scratch) = (Selection::all(mesh.vertex_count()), Scratch::new());
    loop {
        let step = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default()).unwrap();
        if step.did_nothing() {
            return (mesh, history);
        }
        selection = step.selection;
    }
}

#[test]
fn it_makes_as_many_levels_as_it_takes_with_cracks_or_without() {
    let desk = Desk::new();
    let (mesh, history) = refined(desk.mesh("torus.off"));
    let open = history.unclosed(&mesh).unwrap();
    let levels = history.step_count();
    assert!(levels >= 2 && open.face_count() < mesh.face_count());

    let ran = desk.done(&format!("subdivide torus.off -o open.obj {MOBILE} --report r.json --face-table f.tsv"));
    let said = format!("wrote open.obj: {} vertices, {} faces", mesh.vertex_count(), open.face_count());
    assert!(ran.out.contains(&said) && ran.out.contains("faces of 0/1/2/3 mobile corners"), "{}", ran.out);
    assert_eq!(io::read(desk.path("open.obj")).unwrap().faces, open);
    let check = desk.vv("check open.obj --json");
    assert_eq!(check.code, Some(1));
    assert!(check.json()["findings"].as_array().unwrap().iter().all(|finding| finding["kind"] == "t_junction"));
    let table = desk.read("f.tsv");
    assert!(table.lines().count() == open.face_count() + 1 && !table.contains("closure"));

    let report: serde_json::Value = serde_json::from_str(&desk.read("r.json")).unwrap();
    assert_eq!((report["accuracy"].as_f64(), report["closed"].as_bool()), (Some(0.02), Some(false)));
    let rows = report["levels"].as_array().unwrap();
    assert_eq!(rows.len(), levels);
    assert_eq!(rows[levels - 1]["unclosed_faces"], open.face_count());
    assert_eq!(rows[levels - 1]["faces"], mesh.face_count());
    assert_eq!(rows[0]["faces_by_mobile_corners"].as_array().unwrap().len(), 4);
    assert_eq!(rows[0]["region"].as_u64().unwrap() + rows[0]["static_vertices"].as_u64().unwrap(), 30);

    let ran = desk.done(&format!("subdivide torus.off -o closed.off {MOBILE} --close --face-table f.tsv"));
    assert!(ran.out.contains(&format!("{} faces", mesh.face_count())), "{}", ran.out);
    assert_eq!(desk.mesh("closed.off").positions(), mesh.positions());
    desk.done("check closed.off");
    assert!(desk.read("f.tsv").contains("closure"));
}

#[test]
fn levels_are_a_cap_and_nothing_to_do_is_no_fault() {
    let desk = Desk::new();
    desk.done(&format!("subdivide torus.off -o one.off {MOBILE} --levels 1 --close"));
    assert!(desk.mesh("one.off").face_count() <= 4 * 60);
    desk.done(&format!("subdivide torus.off -o none.off {MOBILE} --levels 0"));
    desk.done("subdivide torus.off -o far.off --scheme loop --method mobile --accuracy 10");
    let input = desk.mesh("torus.off");
    for name in ["none.off", "far.off"] {
        assert_eq!(desk.mesh(name).positions(), input.positions());
    }
    desk.vv("subdivide torus.off -o o.off --scheme loop --method mobile --accuracy 1e-9 --max-faces 5000")
        .assert_refused("--max-faces allows 5000");
    assert!(!desk.path("o.off").exists());
}

#[test]
fn what_rides_along_needs_closed_faces() {
    let desk = Desk::new();
    let uv = "v 0 0 0\nv 1 0 0\nv 1 1 1\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    desk.write("uv.obj", uv);
    let ran = desk.done(&format!("subdivide uv.obj -o open.obj {MOBILE}"));
    assert!(ran.err.contains("see --close"), "{}", ran.err);
    assert!(!desk.read("open.obj").contains("vt "));
    let ran = desk.done(&format!("subdivide uv.obj -o closed.obj {MOBILE} --close"));
    assert!(!ran.err.contains("see --close") && desk.read("closed.obj").contains("vt "), "{}", ran.err);
    desk.vv(&format!("subdivide uv.obj -o o.obj {MOBILE} --uv linear")).assert_refused("without --close");
}

#[test]
fn a_matrix_follows() {
    let desk = Desk::new();
    desk.done(&format!("matrix torus.off -o s.mtx {MOBILE}"));
    let (mesh, _) = refined(desk.mesh("torus.off"));
    let rows = format!("{} 30 ", mesh.vertex_count());
    assert!(desk.read("s.mtx").lines().any(|line| line.starts_with(&rows)));
}

#[test]
fn what_has_no_meaning_is_refused() {
    let desk = Desk::new();
    let refused = |rest: &str, words: &str| {
        desk.vv(&format!("subdivide torus.off -o o.off {rest}")).assert_refused(words);
    };
    refused("--scheme loop --method mobile", "--accuracy <EPS>");
    refused("--scheme loop --method simple", "--levels <N>");
    refused("--scheme loop --method simple --accuracy 1", "only `mobile` looks at limits");
    refused("--scheme loop --method simple --levels 1 --close", "it leaves no cracks");
    refused(&format!("{MOBILE} --limit"), "vertices stay where they are near enough");
    for accuracy in ["0", "-1", "nan", "inf"] {
        refused(&format!("--scheme loop --method mobile --accuracy {accuracy}"), "a finite distance above 0");
    }
    for scheme in ["butterfly", "modified-butterfly", "midpoint", "sqrt3", "four-eight"] {
        refused(&format!("--scheme {scheme} --method mobile --accuracy 1"), &format!("--scheme = {scheme}: "));
    }
}
