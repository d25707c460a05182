//! What `vv subdivide` keeps of an OBJ file beside its shape, what it tells, and what it refuses.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use common::desk::Desk;
use vvmesh::glam::DVec3;
use vvmesh::io;

/// Two squares with a seam between them, a colour each, a normal for all.
const SQUARES: &str = "mtllib m.mtl\nv 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 2 0 0 0 0 1\nv 0 1 0 1 0 0\nv 1 1 0 1 0 0\n\
    v 2 1 0 0 0 1\nvt 0 0\nvt 0.4 0\nvt 0.6 0\nvt 1 0\nvt 0 1\nvt 0.4 1\nvt 0.6 1\nvt 1 1\nvn 0 0 1\n\
    o two\ng left\nusemtl red\nf 1/1/1 2/2/1 5/6/1 4/5/1\ng right\nusemtl blue\nf 2/3/1 3/4/1 6/8/1 5/7/1\n";

fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("squares.obj", SQUARES);
    desk
}

const MIDPOINT: &str = "subdivide squares.obj -o o.obj --scheme midpoint --method uniform --levels";
const LOOP: &str = "subdivide squares.obj -o o.obj --scheme loop --method uniform --levels";

#[test]
fn level_0_copies_everything() {
    let desk = desk();
    let ran = desk.done(&format!("{MIDPOINT} 0"));
    assert!(!ran.err.contains("normals") && !ran.err.contains("only positions"), "{}", ran.err);
    let written = desk.read("o.obj");
    let (before_faces, faces) = written.split_at(written.find("o two").unwrap());
    assert!(SQUARES.starts_with(before_faces));
    assert_eq!(
        faces,
        "o two\ng left\nusemtl red\nf 1/1/1 2/2/1 5/6/1\nf 1/1/1 5/6/1 4/5/1\n\
         g right\nusemtl blue\nf 2/3/1 3/4/1 6/8/1\nf 2/3/1 6/8/1 5/7/1\n"
    );
}

#[test]
fn refined_faces_keep_what_is_said_of_them() {
    let desk = desk();
    let ran = desk.done(&format!("{MIDPOINT} 2 --face-table f.tsv"));
    assert!(ran.err.contains("normals are computed anew"), "{}", ran.err);
    let loaded = io::read(desk.path("o.obj")).unwrap();
    let (faces, said) = (&loaded.faces, &loaded.attributes);
    assert_eq!((faces.face_count(), said.texture_coordinates.len()), (64, 2 * 25));
    assert_eq!(desk.read("f.tsv").lines().count(), 65);
    for face in 0..64 {
        let is_left = faces.face(face).iter().all(|&v| faces.positions[v as usize].x <= 1.0);
        let expected = if is_left { ("red", "left") } else { ("blue", "right") };
        assert_eq!((said.material(face).unwrap(), said.groups(face).next().unwrap()), expected);
        assert_eq!(said.object(face), Some("two"));
        for (corner, &v) in faces.corner_range(face).zip(faces.face(face)) {
            let p = faces.positions[v as usize];
            let u = if is_left { 0.4 * p.x } else { 0.6 + 0.4 * (p.x - 1.0) };
            let uv = said.texture_coordinates[said.texture_index(corner).unwrap()];
            assert!((uv[0] - u).abs() < 1e-15 && uv[1] == p.y, "{uv:?} at {p}");
            assert!(said.normals[said.normal_index(corner).unwrap()].distance(DVec3::Z) < 1e-15);
            let blue = (p.x - 1.0).max(0.0);
            assert_eq!(said.vertex_colors[v as usize], Some([1.0 - blue, 0.0, blue]));
        }
    }
}

#[test]
fn options_choose_how_values_are_made() {
    let desk = desk();
    let texture = |options: &str| {
        desk.done(&format!("{LOOP} 1 {options}"));
        io::read(desk.path("o.obj")).unwrap().attributes
    };
    let has = |uv: &[[f64; 3]], u: f64, v: f64| {
        uv.iter().any(|value| (value[0] - u).abs() < 1e-15 && (value[1] - v).abs() < 1e-15)
    };
    // The corner of the chart is pulled in by its two neighbours along the boundary: 3/4, 1/8, 1/8.
    let by_scheme = texture("").texture_coordinates;
    assert!(has(&by_scheme, 0.05, 0.125) && !has(&by_scheme, 0.0, 0.0));
    assert_eq!(texture("--uv scheme").texture_coordinates, by_scheme);
    for straight in ["--uv linear-seams", "--uv linear"] {
        assert!(has(&texture(straight).texture_coordinates, 0.0, 0.0));
    }
    assert_ne!(texture("").vertex_colors, texture("--colors linear").vertex_colors);
    let nearest = texture("--colors nearest").vertex_colors;
    assert!(nearest.iter().all(|color| [Some([1.0, 0.0, 0.0]), Some([0.0, 0.0, 1.0])].contains(color)));
    assert!(texture("--normals drop").normals.is_empty());
    assert_eq!(texture("--normals limit").normals.len(), 15);
    assert_eq!(texture("--normals limit --limit").normals.len(), 15);
    assert!(
        desk.done("subdivide grid.obj -o n.obj --scheme loop --levels 0 --method uniform --normals recompute").code
            == Some(0)
    );
    assert_eq!(io::read(desk.path("n.obj")).unwrap().attributes.normals.len(), 30);
}

#[test]
fn a_region_keeps_them_too() {
    let desk = desk();
    for method in ["simple", "incremental", "red-green", "red-green-restricted", "dynamic"] {
        for scheme in ["loop", "butterfly", "modified-butterfly", "midpoint"] {
            let ran = desk.done(&format!(
                "subdivide squares.obj -o o.obj --scheme {scheme} --method {method} --levels 3 --select vertices:0,1,4"
            ));
            assert!(!ran.err.contains("lost") && !ran.err.contains("not take"), "{}", ran.err);
            desk.done("check o.obj");
            let loaded = io::read(desk.path("o.obj")).unwrap();
            let (faces, said) = (&loaded.faces, &loaded.attributes);
            for face in 0..faces.face_count() {
                let is_left = said.material(face) == Some("red");
                assert_eq!(said.groups(face).next(), Some(if is_left { "left" } else { "right" }));
                for corner in faces.corner_range(face) {
                    let uv = said.texture_coordinates[said.texture_index(corner).unwrap()];
                    assert!(if is_left { uv[0] < 0.5 } else { uv[0] > 0.5 }, "{uv:?}");
                    assert!(said.normal_index(corner).is_some());
                }
            }
        }
    }
}

#[test]
fn what_is_lost_is_told_once() {
    let desk = desk();
    let ran = desk.done(&MIDPOINT.replace("o.obj", "o.off").replace("--levels", "--levels 1"));
    assert_eq!(ran.err.matches("only positions and faces are written").count(), 1, "{}", ran.err);
    desk.write("part.obj", SQUARES.replace("f 2/3/1", "f 2//1").replace("vn 0", "vt 7 7\nlod 3\nvn 0"));
    let ran = desk.done(&MIDPOINT.replace("squares", "part").replace("--levels", "--levels 1"));
    for note in [
        "texture coordinates of 2 triangles lost, as some corners have none",
        "2 unused texture coordinates lost",
        "1 rendering statement ignored",
    ] {
        assert_eq!(ran.err.matches(note).count(), 1, "no `{note}` in {}", ran.err);
    }
}

#[test]
fn every_scheme_and_method_keeps_what_is_said() {
    let desk = desk();
    for scheme in ["sqrt3", "four-eight"] {
        for method in ["uniform", "incremental", "simple"] {
            let ran =
                desk.done(&format!("subdivide squares.obj -o o.obj --scheme {scheme} --levels 2 --method {method}"));
            assert!(!ran.err.contains("lost") && !ran.err.contains("across"), "{}", ran.err);
            let loaded = io::read(desk.path("o.obj")).unwrap();
            let (faces, said) = (&loaded.faces, &loaded.attributes);
            assert!(said.vertex_colors.len() > 6 && said.vertex_colors.iter().all(Option::is_some));
            for face in 0..faces.face_count() {
                let is_left = said.material(face) == Some("red");
                assert_eq!(said.groups(face).next(), Some(if is_left { "left" } else { "right" }));
                for corner in faces.corner_range(face) {
                    let uv = said.texture_coordinates[said.texture_index(corner).unwrap()];
                    assert!(if is_left { uv[0] < 0.41 } else { uv[0] > 0.59 }, "{uv:?}");
                    assert!(said.normal_index(corner).is_some());
                }
            }
        }
    }
}

#[test]
fn what_lies_across_is_told() {
    let desk = desk();
    let call = "subdivide squares.obj -o o.obj --scheme sqrt3 --method uniform --levels";
    for levels in [1, 3] {
        let ran = desk.done(&format!("{call} {levels}"));
        // One edge between the squares, or three.
        for note in [
            format!("{} triangles lie across seams, without texture coordinates: sqrt3 turns", 2 * levels),
            format!("{} triangles lie across borders of groups or materials, with the one or the other", 2 * levels),
        ] {
            assert_eq!(ran.err.matches(&note).count(), 1, "no `{note}` in {}", ran.err);
        }
        let loaded = io::read(desk.path("o.obj")).unwrap();
        let bare = (0..loaded.faces.face_count())
            .filter(|&face| loaded.attributes.texture_index(loaded.faces.corner_range(face).start).is_none());
        assert_eq!(bare.count(), 2 * levels);
    }
    assert!(!desk.done(&format!("{call} 2")).err.contains("across"));
    assert!(!desk.done(&format!("{call} 1 --uv linear")).err.contains("error"));
}

#[test]
fn options_without_meaning_are_refused() {
    let desk = desk();
    desk.vv(&format!("{MIDPOINT} 1 --normals limit")).assert_refused("limit normals are known for `loop` only");
    for (option, what) in
        [("--uv linear", "texture coordinates"), ("--colors linear", "colours"), ("--normals drop", "normals")]
    {
        let call = format!("subdivide grid.obj -o o.obj --scheme loop --method uniform --levels 1 {option}");
        desk.vv(&call).assert_refused(&format!("it has no {what}"));
        let call = format!("subdivide squares.obj -o o.off --scheme loop --method uniform --levels 1 {option}");
        desk.vv(&call).assert_refused("written with it");
    }
    desk.write("bad.obj", SQUARES.replace("5/6/1", "5/9/1"));
    let call = "subdivide bad.obj -o o.obj --scheme loop --method uniform --levels 1";
    desk.vv(call).assert_refused("line 20: index out of range: texture coordinate 9, there are 8");
    assert!(!desk.names().contains("o.obj"));
}
