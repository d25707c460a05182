//! PLY and STL as the user of `vv` meets them: every command takes them, and what is lost is told.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use common::desk::{Desk, METHODS};
use vvmesh::{io, shapes};

/// The mesh of `torus.off` as PLY and STL beside it, in single precision and numbered as STL numbers.
fn desk() -> Desk {
    let desk = Desk::new();
    io::save(desk.path("torus.stl"), &desk.mesh("torus.off")).unwrap();
    let faces = io::read(desk.path("torus.stl")).unwrap().faces;
    io::save(desk.path("torus.ply"), &faces).unwrap();
    io::save(desk.path("torus.off"), &faces).unwrap();
    desk
}

#[test]
fn every_command_takes_them() {
    let desk = desk();
    for command in ["info", "check", "select --select disk:0,2"] {
        let [off, ply, stl] =
            ["off", "ply", "stl"].map(|ending| desk.done(&format!("{command} torus.{ending} --json")));
        assert_eq!((&ply.out, &stl.out), (&off.out, &off.out), "{command}");
        assert!(ply.err.is_empty(), "{}", ply.err);
        assert!(
            stl.err.contains("180 corners welded to 30 vertices") && stl.err.contains("normals of 60 faces ignored")
        );
    }
    for command in [
        "subdivide torus.IN -o o.OUT --scheme loop --levels 2 --method incremental --select disk:0,1",
        "subdivide torus.IN -o o.OUT --scheme four-eight --levels 3 --method simple --select disk:1,1",
        "limit torus.IN -o o.OUT",
    ] {
        desk.done(&command.replace("IN", "off").replace("OUT", "off"));
        let expected = io::read(desk.path("o.off")).unwrap().faces;
        for from in ["ply", "stl"] {
            desk.done(&command.replace("IN", from).replace("OUT", "ply"));
            assert_eq!(io::read(desk.path("o.ply")).unwrap().faces, expected, "{command} from {from}");
            let ran = desk.done(&command.replace("IN", from).replace("OUT", "stl"));
            assert!(ran.err.contains("rounded: STL has single precision"), "{command} from {from}: {}", ran.err);
            assert_eq!(io::read(desk.path("o.stl")).unwrap().faces.face_count(), expected.face_count());
        }
        desk.done("check o.ply");
        desk.done("check o.stl");
    }
    let matrix = |from: &str| {
        desk.done(&format!("matrix torus.{from} -o S.mtx --scheme loop --levels 1 --method uniform"));
        desk.read("S.mtx").lines().skip_while(|line| line.starts_with('%')).map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(matrix("ply"), matrix("off"));
    assert_eq!(matrix("stl"), matrix("off"));
    let many = "subdivide torus.ply -o many.ply --scheme loop --levels 9 --method uniform --max-faces 1000";
    desk.vv(many).assert_refused("--max-faces allows 1000");
    desk.vv("subdivide torus.stl -o o.ply --scheme loop --levels 1 --method uniform --tags obj")
        .assert_refused("STL, which has no tag lines");
    assert!(!desk.names().contains("many.ply"));
}

/// A square with a seam between its triangles, a colour at three vertices, a group, a normal.
const SQUARE: &str = "v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 1 1 0 0 0 1\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n\
    g half\nf 1/1/1 2/2/1 3/3/1\nf 1/2/1 3/4/1 4/3/1\n";

#[test]
fn colours_and_texture_coordinates_ride_along_and_the_rest_is_told() {
    let desk = desk();
    desk.write("square.obj", SQUARE);
    let call = "subdivide square.obj -o o.ply --scheme midpoint --method uniform --levels 1";
    let ran = desk.done(call);
    for note in [
        "only colours and two texture coordinates are written again, not groups",
        "1 vertex has no colour",
        "o.ply: colours of 6 vertices rounded to eight bits, or white where there is none",
    ] {
        assert_eq!(ran.err.matches(note).count(), 1, "no `{note}` in {}", ran.err);
    }
    let ply = io::read(desk.path("o.ply")).unwrap();
    desk.done(&call.replace("o.ply", "o.obj"));
    let obj = io::read(desk.path("o.obj")).unwrap();
    let texture = |loaded: &io::Loaded| {
        let at = |corner| loaded.attributes.texture_index(corner).unwrap();
        let value = |corner| loaded.attributes.texture_coordinates[at(corner)];
        (0..24).map(value).collect::<Vec<_>>()
    };
    assert_eq!(ply.faces, obj.faces);
    assert_eq!(texture(&ply), texture(&obj));
    assert_eq!(ply.attributes.vertex_colors[4], Some([128.0 / 255.0, 128.0 / 255.0, 0.0]));

    // From PLY on they go as those of OBJ do.
    let ran = desk
        .done("subdivide o.ply -o p.obj --scheme loop --method incremental --levels 2 --uv linear --colors nearest");
    assert!(ran.err.contains("colours of 9 vertices kept as attributes"), "{}", ran.err);
    let again = io::read(desk.path("p.obj")).unwrap().attributes;
    assert!(again.vertex_colors.iter().all(Option::is_some) && again.texture_index(0).is_some());
    let ran = desk.done("subdivide o.ply -o p.stl --scheme loop --method uniform --levels 1");
    assert!(ran.err.contains("STL has no place for them"), "{}", ran.err);
    for (options, words) in [
        ("-o p.ply --normals recompute", "--normals has no meaning with -o p.ply: only OBJ is written with it"),
        ("-o p.stl --colors linear", "--colors has no meaning with -o p.stl: only OBJ and PLY are written with it"),
    ] {
        let call = format!("subdivide square.obj {options} --scheme loop --method uniform --levels 1");
        desk.vv(&call).assert_refused(words);
    }
}

#[test]
fn what_stl_cannot_hold_is_told_or_refused() {
    let desk = desk();
    desk.write("lone.obj", "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 4\n");
    let ran = desk.done("subdivide lone.obj -o o.stl --scheme midpoint --method simple --levels 0");
    assert!(ran.err.contains("o.stl: 1 vertex without a face left out") && !ran.err.contains("rounded"), "{}", ran.err);
    desk.write("far.obj", "v 0 0 0\nv 1e40 0 0\nv 0 1e40 0\nf 1 2 3\n");
    for method in METHODS {
        desk.vv(&format!("subdivide far.obj -o far.stl --scheme midpoint --method {method} --levels 1"))
            .assert_refused("single precision");
    }
    assert!(!desk.names().contains("far.stl"));
    io::save(desk.path("cut.ply"), &shapes::torus(9, 9, 2.0, 1.0)).unwrap();
    let bytes = std::fs::read(desk.path("cut.ply")).unwrap();
    desk.write("cut.ply", &bytes[..1000]);
    desk.vv("info cut.ply").assert_refused("cut.ply: byte 1000: unexpected end of the file, expected vertex");
}
