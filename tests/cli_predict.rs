//! `vv predict` as its user meets it.
#![cfg(feature = "cli")]

mod common;

use common::desk::{Desk, keys, numbers, sorted};
use serde_json::Value;
use vvmesh::predict::{DistanceBound, Estimate};
use vvmesh::scheme::LoopWeights;

const KEYS: [&str; 13] = [
    "m0",
    "max_valence",
    "n",
    "contraction",
    "depth",
    "full_faces",
    "vertex_depths",
    "vertex_depths_raw",
    "face_depths",
    "adaptive_bound",
    "memory_bytes",
    "rigorous",
    "measured",
];

#[test]
fn json_has_what_the_library_says() {
    let desk = Desk::new();
    let json = desk.done("predict torus.off --accuracy 0.01 --json").json();
    assert_eq!(keys(&json), sorted(KEYS));
    assert_eq!(keys(&json["rigorous"]), sorted(["depth", "full_faces", "bound"]));
    let torus = desk.mesh("torus.off");
    let estimate = Estimate::new(&torus, LoopWeights::Loop).unwrap();
    let bound = DistanceBound::new(&torus, LoopWeights::Loop).unwrap();
    assert_eq!(json["m0"].as_f64(), Some(estimate.greatest_distance()));
    assert_eq!((&json["max_valence"], &json["n"], &json["contraction"]), (&6.into(), &6.into(), &0.25.into()));
    assert_eq!((&json["depth"], &json["full_faces"]), (&4.into(), &(60 << 8).into()));
    assert_eq!(numbers(&json["vertex_depths"]).iter().sum::<u64>(), 30);
    assert_eq!(json["vertex_depths"], json["vertex_depths_raw"]);
    let faces = numbers(&json["face_depths"]);
    let adaptive: u64 = faces.iter().enumerate().map(|(depth, faces)| faces << (2 * depth)).sum();
    assert_eq!((faces.iter().sum::<u64>(), json["adaptive_bound"].as_u64()), (60, Some(adaptive)));
    assert_eq!(json["rigorous"]["bound"].as_f64(), Some(bound.at(4)));
    assert_eq!(json["measured"], Value::Null);
}

#[test]
fn what_is_measured_is_not_above_what_is_proven() {
    let desk = Desk::new();
    for call in ["torus.off --accuracy 0.05", "grid.obj --accuracy 0.1", "torus.off --accuracy 0.1 --sharp-angle 60"] {
        for weights in ["loop", "warren"] {
            let ran = desk.done(&format!("predict {call} --verify --json --weights {weights}"));
            let json = ran.json();
            let [measured, bound] = [&json["measured"], &json["rigorous"]["bound"]].map(|x| x.as_f64().unwrap());
            assert!(measured <= bound && measured > 0.1 * bound, "{call}: {json}");
            assert!(ran.err.contains("measured at 15 points of each face; at depth "), "{}", ran.err);
        }
    }
}

#[test]
fn a_budget_tells_the_finest_accuracies_that_fit() {
    let desk = Desk::new();
    let json = desk.done("predict torus.off --accuracy 1 --budget 5000 --json").json();
    let budget = &json["budget"];
    assert_eq!(keys(budget), sorted(["faces", "full_accuracy", "adaptive_accuracy", "rigorous_accuracy"]));
    let faces = |accuracy: f64, pointer: &str| {
        let json = desk.done(&format!("predict torus.off --accuracy {accuracy:e} --json")).json();
        json.pointer(pointer).and_then(Value::as_u64).unwrap()
    };
    for (name, pointer) in [
        ("full_accuracy", "/full_faces"),
        ("adaptive_accuracy", "/adaptive_bound"),
        ("rigorous_accuracy", "/rigorous/full_faces"),
    ] {
        let accuracy = budget[name].as_f64().unwrap();
        assert!(faces(accuracy, pointer) <= 5000, "{name}");
        assert!(faces(accuracy * (1.0 - 1e-12), pointer) > 5000, "{name}");
    }
    desk.vv("predict torus.off --accuracy 1 --budget 59").assert_refused("--budget 59: the mesh has 60 faces already");
}

#[test]
fn the_table_is_for_people() {
    let desk = Desk::new();
    let ran = desk.done("predict torus.off --accuracy 0.05 --budget 1000");
    assert!(ran.out.starts_with("torus.off: 30 vertices, 60 faces, greatest valence 6; for an accuracy of 0.05\n"));
    for words in ["estimated      2", "proven", "1000 faces allow an accuracy of", "by own valence"] {
        assert!(ran.out.contains(words), "no `{words}` in:\n{}", ran.out);
    }
    assert!(!ran.out.contains("measured") && ran.err.is_empty(), "{}", ran.err);
    assert!(desk.done("predict torus.off --accuracy 0.05 --verify").out.contains("measured"));
}

#[test]
fn what_cannot_be_foretold_is_refused() {
    let desk = Desk::new();
    for accuracy in ["0", "-1", "nan", "inf", "x"] {
        let ran = desk.vv(&format!("predict torus.off --accuracy {accuracy}"));
        assert!(ran.code == Some(2) && ran.err.contains("expected a finite distance above 0"), "{}", ran.err);
    }
    desk.vv("predict torus.off --accuracy 1e-15").assert_refused("cannot be proven for any depth");
    desk.vv("predict torus.off --accuracy 1e-40").assert_refused("more faces than can be counted");
    desk.vv("predict torus.off --accuracy 1e-8 --verify").assert_refused("--verify would make");
    desk.write("sharp.txt", "0 1 1.5\n");
    desk.vv("predict torus.off --accuracy 1 --sharp sharp.txt").assert_refused("refine everything until");
}
