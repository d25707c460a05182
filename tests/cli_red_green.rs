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
