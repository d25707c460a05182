//! `vv limit` as its user meets it.
#![cfg(feature = "cli")]

mod common;

use common::desk::Desk;
use vvmesh::glam::DVec3;
use vvmesh::limit::{AnyLimit, ButterflyLimit, Limit, LoopLimit, ModifiedButterflyLimit, Sqrt3Limit};
use vvmesh::scheme::LoopWeights;
use vvmesh::{VertexId, io, shapes};

const CUBE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
                    f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

#[test]
fn positions_are_those_of_the_library() {
    let desk = Desk::new();
    let limits: [(&str, AnyLimit); 5] = [
        ("", LoopLimit::default().into()),
        ("--scheme loop --weights warren", LoopLimit::new(LoopWeights::Warren).into()),
        ("--scheme butterfly", ButterflyLimit.into()),
        ("--scheme modified-butterfly", ModifiedButterflyLimit.into()),
        ("--scheme sqrt3", Sqrt3Limit.into()),
    ];
    for mesh in ["grid.obj", "torus.off"] {
        let input = desk.mesh(mesh);
        for (options, limit) in limits {
            let ran = desk.done(&format!("limit {mesh} -o o.off {options}"));
            assert!(ran.out.starts_with("wrote o.off: ") && ran.err.is_empty(), "{}{}", ran.out, ran.err);
            assert_eq!(desk.mesh("o.off").positions(), limit.positions(&input), "{mesh} {options}");
        }
    }
    desk.done("limit grid.obj -o o.off --boundary fixed");
    let (fixed, grid) = (desk.mesh("o.off"), shapes::grid(5, 4));
    assert!(grid.vertices().filter(|&v| grid.is_boundary(v)).all(|v| fixed.position(v) == grid.position(v)));
}

#[test]
fn corners_have_the_normals_of_their_side() {
    let desk = Desk::new();
    desk.write("cube.obj", CUBE);
    let ran = desk.done("limit cube.obj -o o.obj --normals --sharp-angle 40");
    assert!(ran.out.ends_with("8 vertices, 12 faces, 24 normals\n") && !ran.err.contains("warning"), "{}", ran.err);
    let loaded = io::read(desk.path("o.obj")).unwrap();
    let position = |v: u32| loaded.faces.positions[v as usize];
    for (k, face) in loaded.faces.faces().enumerate() {
        let flat = (position(face[1]) - position(face[0])).cross(position(face[2]) - position(face[0])).normalize();
        for corner in loaded.faces.corner_range(k) {
            let normal = loaded.attributes.normals[loaded.attributes.normal_index(corner).unwrap()];
            assert!(normal.distance(flat) < 1e-12, "face {k}: {normal}");
        }
    }

    let report = desk.done("limit torus.off -o o.obj --normals --json").json();
    assert_eq!((&report["scheme"], &report["normals"], &report["vertices"]), (&"loop".into(), &30.into(), &30.into()));
    let (torus, loaded) = (shapes::torus(6, 5, 2.0, 1.0), io::read(desk.path("o.obj")).unwrap());
    let expected: Vec<DVec3> = torus.vertices().map(|v| LoopLimit::default().normal(&torus, v, 0).unwrap()).collect();
    assert_eq!(loaded.attributes.normals, expected);
    let corners = loaded.faces.faces().flatten().enumerate();
    assert!(corners.into_iter().all(|(corner, &v)| loaded.attributes.normal_index(corner) == Some(v as usize)));
}

#[test]
fn what_has_no_normal_is_told_and_none_is_made_up() {
    let desk = Desk::new();
    io::save(desk.path("tetrahedron.obj"), &shapes::tetrahedron()).unwrap();
    let ran = desk.done("limit tetrahedron.obj -o o.obj --normals --scheme butterfly");
    assert!(ran.err.contains("warning: 4 vertices are without a normal"), "{}", ran.err);
    assert!(ran.err.contains("v0 (the scheme has no tangent plane there)") && ran.err.contains("..."), "{}", ran.err);
    assert!(!desk.read("o.obj").contains("vn") && !desk.read("o.obj").contains('/'));

    desk.write("tip.txt", "0\n");
    let ran = desk.done("limit tetrahedron.obj -o o.obj --normals --sharp tip.txt");
    assert!(
        ran.err.contains("1 vertex is without a normal") && ran.err.contains("v0 (the tip of a cone)"),
        "{}",
        ran.err
    );
    let faces: Vec<String> =
        desk.read("o.obj").lines().filter(|line| line.starts_with('f')).map(str::to_owned).collect();
    assert_eq!(faces.iter().filter(|line| line.contains("//")).count(), 1, "all others touch the tip");

    desk.write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 5 5 5\nf 1 2 3\n");
    let report = desk.done("limit flat.obj -o o.obj --normals --json");
    assert!(report.err.contains("v0 (its tangents vanish or are parallel)"), "{}", report.err);
    assert_eq!(report.json()["without_normal"], serde_json::json!([0, 1, 2, 3]));
    let quiet = desk.done("limit flat.obj -o o.obj --json");
    assert_eq!((quiet.json()["normals"].is_null(), quiet.err.contains("warning")), (true, false));
}

#[test]
fn options_without_meaning_are_refused() {
    let desk = Desk::new();
    desk.write("sharp.txt", "0 1\n");
    for (options, words) in [
        ("-o o.off --normals", "--normals: OFF has one normal"),
        ("-o o.ply --normals", "--normals: PLY has one normal"),
        ("-o o.stl --normals", "--normals: STL has normals of triangles"),
        ("-o o.gltf", "must end in .obj, .off, .ply or .stl"),
        ("-o o.obj --scheme midpoint", "invalid value"),
        ("-o o.obj --scheme sqrt3 --weights loop", "--weights has no meaning with --scheme sqrt3"),
        ("-o o.obj --scheme butterfly --sharp sharp.txt", "--sharp has no meaning with --scheme butterfly"),
        ("-o o.obj --scheme sqrt3 --boundary fixed", "--boundary has no meaning"),
        ("-o sharp.txt --sharp sharp.txt", "must end in"),
        ("-o o.obj --sharp-angle 3 --sharp sharp.txt", "cannot be used with"),
    ] {
        desk.vv(&format!("limit grid.obj {options}")).assert_refused(words);
    }
    assert_eq!(desk.mesh("grid.obj").position(VertexId::new(0)), DVec3::ZERO);
}
