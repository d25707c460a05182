//! `vv subdivide --method red-green` as its user meets it.
#![cfg(feature = "cli")]

mod common;

use common::desk::Desk;

#[test]
fn it_makes_conforming_meshes_with_every_scheme_that_splits_in_four() {
    let desk = Desk::new();
    for (mesh, out) in [("grid.obj", "fine.off"), ("torus.off", "fine.obj")] {
        for scheme in ["loop", "butterfly", "modified-butterfly", "midpoint"] {
            desk.done(&format!(
                "subdivide {mesh} -o {out} --scheme {scheme} --levels 3 --method red-green --select disk:8,1 --face-table f.tsv"
            ));
            desk.done(&format!("check {out}"));
            assert!(desk.read("f.tsv").contains("closure"));
        }
        for scheme in ["sqrt3", "four-eight"] {
            let command = format!("subdivide {mesh} -o {out} --scheme {scheme} --levels 1 --method red-green");
            desk.vv(&command).assert_refused(&format!("--scheme = {scheme}: "));
        }
    }
}

#[test]
fn colours_ride_along_and_what_lies_on_faces_is_lost_and_told() {
    let desk = Desk::new();
    let text = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 1 0 0 1\nv 0 1 0 1 1 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
                f 1/1 2/2 3/3\nf 1/1 3/3 4/4\n";
    desk.write("uv.obj", text);
    let command = "subdivide uv.obj -o out.obj --scheme loop --levels 2 --method red-green --select vertices:0,1,2";
    let ran = desk.done(command);
    assert!(ran.err.contains("are lost: --method red-green does not take them along"), "{}", ran.err);
    let out = desk.read("out.obj");
    assert!(!out.contains("vt ") && out.lines().any(|line| line.split_whitespace().count() == 7), "{out}");
    desk.vv(&format!("{command} --uv linear")).assert_refused("--uv has no meaning with --method red-green");
}
