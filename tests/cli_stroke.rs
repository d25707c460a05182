//! `vv stroke` as its user meets it.
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use std::fs;
use std::path::Path;

use common::desk::{Desk, Ran, keys, sorted};
use serde_json::{Value, json};
use vvmesh::check::mesh_conformity;
use vvmesh::io;
use vvmesh::{Mesh, shapes};

/// A line over a head: from its ear over the cheek to the eye, slower and slower, and there in a ring.
///
/// `tests/fixtures/stroke/head.json` is what this makes.
fn head_stroke() -> Value {
    let number = |x: f64| (x * 100.0).round() / 100.0;
    let events: Vec<Value> = (0..85)
        .map(|k| {
            let time = f64::from(k);
            let screen = if k < 45 {
                let part = time / 44.0;
                let part = part * (2.0 - part);
                [452.0 - 232.0 * part, 233.0 - 24.0 * part + 45.0 * part * (1.0 - part)]
            } else {
                let turn = (time - 44.0) / 40.0 * std::f64::consts::TAU;
                [240.0 - 20.0 * turn.cos(), 209.0 - 14.0 * turn.sin()]
            };
            json!({ "time": number(time / 20.0), "screen": screen.map(number) })
        })
        .collect();
    json!({
        "format": "vv stroke",
        "version": 1,
        "brush": { "euclidean": 0.03, "level": 3, "pace": 0.1 },
        "camera": { "eye": [1.0, 0.1, 0.9], "at": [0, 0, 0], "up": [0, 1, 0], "fov": 34, "size": [640, 480] },
        "events": events
    })
}

fn fixture() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fixtures/stroke/head.json");
    if std::env::var_os("VV_WRITE_FIXTURES").is_some() {
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(&path, serde_json::to_string(&head_stroke()).unwrap() + "\n").unwrap();
    }
    fs::read_to_string(path).unwrap()
}

/// A desk with a stroke over its torus, `pen.json`: around on top, with an event that misses.
fn desk() -> Desk {
    let desk = Desk::new();
    desk.write("pen.json", torus_stroke().to_string());
    desk
}

fn torus_stroke() -> Value {
    let ray = |x: f64, y: f64| json!({ "origin": [x, y, 5], "direction": [0, 0, -1] });
    json!({
        "format": "vv stroke",
        "version": 1,
        "brush": { "edges": 1, "level": 2 },
        "events": [
            { "time": 0, "ray": ray(2.0, 0.2) },
            { "time": 0.5, "ray": ray(1.9, 0.6) },
            { "time": 0.5, "ray": ray(0.0, 0.0) },
            { "time": 1, "ray": ray(1.4, 1.4), "brush": { "euclidean": 0.7, "level": 3, "pace": 0.25 } },
            { "time": 2, "place": { "face": [0, 5, 6], "weights": [1, 1, 2] } },
            { "time": 2, "place": { "face": [0, 5, 6], "weights": [1, 1, 2] }, "brush": { "edge_path": 0.5, "level": 1 } }
        ]
    })
}

/// The first face of the torus takes the place of the one that the stroke names.
fn with_face(mut stroke: Value, mesh: &Mesh) -> Value {
    let face = mesh.triangles().next().unwrap().corners().map(|v| v.index());
    for event in stroke["events"].as_array_mut().unwrap() {
        if let Some(place) = event.get_mut("place") {
            place["face"] = json!(face);
        }
    }
    stroke
}

fn torus_desk() -> Desk {
    let desk = desk();
    desk.write("pen.json", with_face(torus_stroke(), &desk.mesh("torus.off")).to_string());
    desk
}

const ROW: [&str; 10] =
    ["event", "time", "place", "touched", "wanted", "refined", "proven", "region", "added", "faces"];

#[test]
fn a_recorded_stroke_over_a_head_gives_the_same_bytes() {
    assert_eq!(serde_json::from_str::<Value>(&fixture()).unwrap(), head_stroke());
    let Some(meshes) = common::meshes() else { return };
    let desk = Desk::new();
    fs::copy(meshes.join("papers/head_1200.off"), desk.path("head.off")).unwrap();
    desk.write("pen.json", fixture());
    for method in ["incremental", "dynamic"] {
        let draw = |folder: &str, threads: &str| {
            let arguments =
                format!("stroke head.off --stroke pen.json -o {folder} --method {method} --frames 5 --scheme loop");
            let mut command = desk.command(&arguments.split(' ').collect::<Vec<_>>());
            let output = command.env("RAYON_NUM_THREADS", threads).output().unwrap();
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        };
        let (one, other) = (format!("{method}-1"), format!("{method}-2"));
        draw(&one, "1");
        draw(&other, "3");
        let files = ["mesh.off", "report.json", "frame-17.off", "frame-34.off", "frame-51.off", "frame-68.off"];
        for file in files.iter().chain(&["frame-85.off"]) {
            assert!(desk.read(&format!("{one}/{file}")) == desk.read(&format!("{other}/{file}")), "{method} {file}");
        }
        assert_eq!(desk.read(&format!("{one}/mesh.off")), desk.read(&format!("{one}/frame-85.off")));
        let mut names: Vec<_> =
            fs::read_dir(desk.path(&one)).unwrap().map(|entry| entry.unwrap().file_name()).collect();
        names.sort_unstable();
        assert_eq!(names.len(), 7, "{names:?}");
        let mesh = desk.mesh(&format!("{one}/mesh.off"));
        assert!(mesh_conformity(&mesh, None).is_conforming());
        assert!(mesh.face_count() > 3000, "{}", mesh.face_count());
        let report: Value = serde_json::from_str(&desk.read(&format!("{one}/report.json"))).unwrap();
        assert_eq!((report["totals"]["missed"].as_u64(), report["input"]["faces"].as_u64()), (Some(0), Some(1200)));
    }
}

#[test]
fn the_report_has_a_row_an_event() {
    let desk = torus_desk();
    let ran = desk.done("stroke torus.off --stroke pen.json -o drawn --json");
    assert!(ran.err.contains("note: 1 event meets nothing: 3"), "{}", ran.err);
    let report = ran.json();
    assert_eq!(ran.out, desk.read("drawn/report.json"));
    assert_eq!(
        sorted(<[&str; 7]>::try_from(keys(&report)).unwrap()),
        sorted(["mesh", "stroke", "scheme", "method", "input", "events", "totals"])
    );
    let rows = report["events"].as_array().unwrap();
    for (row, number) in rows.iter().zip(1..) {
        assert_eq!(sorted(<[&str; 10]>::try_from(keys(row)).unwrap()), sorted(ROW));
        assert_eq!((row["event"].as_u64(), row["place"].is_null()), (Some(number), number == 3), "{row}");
    }
    let wanted: Vec<u64> = rows.iter().map(|row| row["wanted"].as_u64().unwrap()).collect();
    assert_eq!(wanted, [2, 2, 0, 1, 2, 1]);
    assert_eq!(rows[0]["proven"], rows[0]["refined"]);
    assert_eq!(rows[5]["faces"].as_u64().map(|faces| faces as usize), Some(desk.mesh("drawn/mesh.off").face_count()));
    // Times are told only if they are asked for.
    let timed = desk.done("stroke torus.off --stroke pen.json -o drawn --json --times").json();
    assert!(timed["events"].as_array().unwrap().iter().all(|row| row["ms"].as_f64().is_some_and(|ms| ms > 0.0)));
    let text = desk.done("stroke torus.off --stroke pen.json -o drawn --method dynamic").out;
    assert!(text.starts_with("6 events: ") && text.contains("\nwrote drawn/mesh.off: "), "{text}");
}

#[test]
fn frames_are_spread_over_the_events() {
    let desk = torus_desk();
    let frames = |frames: &str| {
        let folder = format!("frames-{frames}");
        desk.done(&format!("stroke torus.off --stroke pen.json -o {folder} --frames {frames}"));
        let names =
            fs::read_dir(desk.path(&folder)).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
        let mut names: Vec<String> = names.filter(|name| name.starts_with("frame")).collect();
        names.sort_unstable();
        names.concat().replace("frame-", "").replace(".off", " ")
    };
    assert_eq!(frames("1"), "6 ");
    assert_eq!(frames("4"), "2 3 5 6 ");
    assert_eq!((frames("all"), frames("99")), ("1 2 3 4 5 6 ".to_owned(), "1 2 3 4 5 6 ".to_owned()));
    for wrong in ["0", "-1", "most", "1.5"] {
        desk.vv(&format!("stroke torus.off --stroke pen.json -o d --frames {wrong}")).assert_refused("--frames");
    }
}

/// Draws a stroke of this text, which has to be refused for a reason that holds these words, without leaving a folder.
fn refused(desk: &Desk, text: impl AsRef<[u8]>, words: &str) {
    desk.write("wrong.json", text);
    let ran: Ran = desk.vv("stroke torus.off --stroke wrong.json -o refused");
    ran.assert_refused(words);
    assert!(!desk.path("refused").exists());
}

#[test]
fn what_is_no_stroke_is_refused_with_its_event_or_line() {
    let desk = torus_desk();
    let good = with_face(torus_stroke(), &desk.mesh("torus.off"));
    let edited = |edit: &dyn Fn(&mut Value)| {
        let mut stroke = good.clone();
        edit(&mut stroke);
        stroke.to_string()
    };
    let set = |path: &str, value: Value| edited(&|stroke| *stroke.pointer_mut(path).unwrap() = value.clone());
    let add = |path: &str, key: &str, value: Value| {
        edited(&|stroke| {
            stroke.pointer_mut(path).unwrap().as_object_mut().unwrap().insert(key.to_owned(), value.clone());
        })
    };
    desk.vv("stroke torus.off --stroke none.json -o refused").assert_refused("--stroke: none.json: ");
    refused(&desk, "", "this is no stroke of `vv`");
    refused(&desk, "OFF\n", "this is no stroke of `vv`");
    refused(&desk, [0xff, 0xfe, b'{'], "this is no stroke of `vv`");
    refused(&desk, set("/format", json!("vv state")), "this is no stroke of `vv`");
    refused(&desk, set("/version", json!(2)), "version 2 of the format is not read, only version 1");
    refused(&desk, add("", "colour", json!(1)), "unknown field `colour`");
    refused(&desk, set("/brush/level", json!(256)), "invalid value");
    refused(&desk, set("/brush/edges", json!(-1)), "invalid value");
    refused(&desk, set("/brush/edges", Value::Null), "a brush has one of `euclidean`, `edge_path` and `edges`");
    refused(&desk, add("/brush", "euclidean", json!(1.0)), "a brush has one of");
    refused(&desk, add("/brush", "pace", json!(-1.0)), "pace = -1: expected a finite number, 0 or more");
    refused(&desk, set("/events/1/time", json!(-0.5)), "event 2: its time -0.5 is before 0");
    refused(&desk, set("/events/3/brush/euclidean", json!(-0.5)), "event 4: euclidean = -0.5");
    refused(&desk, set("/events/1/ray/direction", json!([0, 0, 0])), "event 2: direction = [0, 0, 0]");
    refused(
        &desk,
        add("/events/1", "screen", json!([1, 2])),
        "event 2: an event has one of `ray`, `screen` and `place`",
    );
    refused(&desk, set("/events/1", json!({ "time": 0.5 })), "event 2: an event has one of");
    refused(&desk, set("/events/1", json!({ "time": 0.5, "screen": [1, 2] })), "event 2: `screen` needs a `camera`");
    refused(&desk, set("/events/4/place/face", json!([0, 1, 2000])), "event 5: the mesh has no face 0, 1, 2000");
    refused(&desk, set("/events/4/place/face", json!([0, 0, 0])), "event 5: the mesh has no face 0, 0, 0");
    refused(&desk, set("/events/4/place/weights", json!([0, 0, 0])), "event 5: weights are 0 or more, and not all 0");
    refused(&desk, set("/events/4/place/weights", json!([1, -1, 1])), "event 5: weights are 0 or more");
    let camera = |part: &str, value: Value| {
        let mut camera = json!({ "eye": [1, 2, 3], "at": [0, 0, 0], "up": [0, 1, 0], "fov": 40, "size": [4, 3] });
        camera[part] = value;
        add("", "camera", camera)
    };
    refused(&desk, camera("at", json!([1, 2, 3])), "camera: at = [1, 2, 3]: expected another point than the eye");
    refused(&desk, camera("up", json!([1, 2, 3])), "camera: up = [1, 2, 3]: expected a direction across");
    refused(&desk, camera("fov", json!(180)), "camera: fov = 180");
    refused(&desk, camera("size", json!([0, 3])), "camera: size = 0x3: expected at least 1x1 pixels");
    // No number of JSON, or one that is too large, is told with its line.
    refused(&desk, good.to_string().replace("0.5", "NaN"), "line 1 column");
    refused(&desk, good.to_string().replace("0.5", "1e999"), "line 1 column");
    desk.vv("stroke torus.off --stroke pen.json -o d --scheme sqrt3").assert_refused("--scheme = sqrt3");
    desk.vv("stroke torus.off --stroke pen.json -o d --scheme butterfly --boundary fixed").assert_refused("--boundary");
    let creases = "stroke torus.off --stroke pen.json -o d --scheme modified-butterfly --creases chaikin";
    desk.vv(creases).assert_refused("--creases");
    desk.vv("stroke torus.off --stroke pen.json -o torus.off").assert_refused("-o: torus.off");
}

#[test]
fn a_stroke_that_is_cut_off_anywhere_is_refused() {
    let desk = torus_desk();
    let text = desk.read("pen.json");
    // Each call is a process, so not at every byte.
    for end in (0..text.len() - 1).step_by(37) {
        refused(&desk, &text[..end], "--stroke: wrong.json: ");
    }
}

#[test]
fn what_is_too_large_is_refused_and_nothing_is_written() {
    let desk = torus_desk();
    for method in ["incremental", "dynamic"] {
        let ran =
            desk.vv(&format!("stroke torus.off --stroke pen.json -o d --method {method} --max-faces 100 --frames all"));
        ran.assert_refused("--max-faces allows 100");
        assert!(ran.err.contains("event ") && ran.err.contains("Nothing was written"), "{}", ran.err);
        assert_eq!(fs::read_dir(desk.path("d")).unwrap().count(), 0);
    }
    // Levels that nothing can hold, at once or step by step.
    let mut stroke = torus_stroke();
    stroke["brush"] = json!({ "euclidean": 1e308, "level": 254 });
    let ray = stroke["events"][0].clone();
    stroke["events"] = json!(vec![ray; 9]);
    desk.write("deep.json", stroke.to_string());
    for method in ["incremental", "dynamic"] {
        let arguments = format!("stroke torus.off --stroke deep.json -o d --method {method} --max-faces 20000");
        desk.vv(&arguments).assert_refused("--max-faces allows 20000");
    }
    // Many events that find nothing to do are handled.
    stroke["brush"] = json!({ "edges": 0, "level": 1 });
    stroke["events"] = json!(vec![stroke["events"][0].clone(); 20_000]);
    desk.write("long.json", stroke.to_string());
    let report = desk.done("stroke torus.off --stroke long.json -o d --json").json();
    assert_eq!(report["totals"]["refined"], 3);
}

#[test]
fn a_mesh_is_written_as_it_was_read_and_never_over_what_is_read() {
    let desk = torus_desk();
    for ending in ["obj", "ply", "stl"] {
        io::save(desk.path(&format!("torus.{ending}")), &shapes::torus(6, 5, 2.0, 1.0)).unwrap();
        let mut stroke = torus_stroke();
        stroke["events"].as_array_mut().unwrap().truncate(4);
        desk.write("rays.json", stroke.to_string());
        desk.done(&format!("stroke torus.{ending} --stroke rays.json -o {ending} --boundary corners"));
        assert!(desk.mesh(&format!("{ending}/mesh.{ending}")).face_count() > 60);
    }
    io::save(desk.path("mesh.off"), &shapes::torus(6, 5, 2.0, 1.0)).unwrap();
    let before = desk.read("mesh.off");
    desk.vv("stroke mesh.off --stroke pen.json -o .").assert_refused("is the file of the mesh too");
    assert_eq!(desk.read("mesh.off"), before);
}
