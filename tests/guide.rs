//! Does `docs/criteria.md` name all criteria, and is it right?
#![cfg(feature = "cli")]
#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;
#[allow(dead_code, unreachable_pub, reason = "a program of its own, whose main is not called here")]
#[path = "../examples/drawings/main.rs"]
mod drawings;

use std::collections::BTreeSet;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use common::desk::Desk;
use drawings::criteria::{self, ROWS, Row};
use vvmesh::adaptive::Uniform;
use vvmesh::io::FaceAttributes;
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Expression, Selection};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, io};

fn docs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("docs")
}

fn page() -> String {
    fs::read_to_string(docs().join("criteria.md")).unwrap().replace('\r', "")
}

/// The name and the text of each entry, in the order of the page.
fn entries() -> Vec<(String, String)> {
    let page = page();
    let entries = page.split("\n### ").skip(1).map(|entry| entry.split_once('\n').unwrap());
    entries.map(|(name, text)| (name.to_owned(), text.to_owned())).collect()
}

/// What the page says of what a picture shows.
fn entry_of(row: &Row) -> String {
    let entry = entries().into_iter().find(|(name, _)| name == row.name());
    entry.unwrap_or_else(|| panic!("no entry for {}", row.name())).1
}

/// The commands in a text.
fn commands(text: &str) -> Vec<&str> {
    let blocks = text.split("```sh\n").skip(1).map(|rest| rest.split_once("```").unwrap().0);
    blocks.flat_map(str::lines).collect()
}

/// The words of a command; those in quotes are one.
fn words(line: &str) -> Vec<&str> {
    let outside_and_inside = line.split('\'').enumerate();
    outside_and_inside
        .flat_map(|(k, part)| if k % 2 == 0 { part.split_whitespace().collect() } else { vec![part] })
        .collect()
}

/// The model of a picture with its colours, as `mesh.obj`, and its sharp edges, as `sharp.txt`.
fn desk_with(row: &Row) -> Desk {
    let desk = Desk::new();
    let model = (row.model)();
    let mut colors = FaceAttributes::default();
    colors.vertex_colors = model.positions().iter().map(|&p| Some([criteria::red(p), 0.0, 0.0])).collect();
    io::save_with(desk.path("mesh.obj"), &model, &colors).unwrap();
    let mut sharp = String::new();
    for edge in model.tags().sharp_edges() {
        let [a, b] = edge.ends().map(usize::from);
        writeln!(sharp, "{a} {b}").unwrap();
    }
    desk.write("sharp.txt", sharp);
    desk
}

#[test]
fn every_criterion_has_an_entry_and_a_picture() {
    let entries = entries();
    let names: BTreeSet<&str> = entries.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names.len(), entries.len(), "an entry stands twice");
    assert_eq!(names, ROWS.iter().map(Row::name).collect(), "entries and pictures");
    let known: BTreeSet<&str> = Expression::known_criteria().map(|form| form.split(':').next().unwrap()).collect();
    assert_eq!(names, known, "entries and criteria");
    for form in Expression::known_criteria() {
        let name = form.split(':').next().unwrap();
        let (_, text) = entries.iter().find(|(entry, _)| entry == name).unwrap();
        assert!(text.contains(&format!("`{form}`")), "the entry of {name} does not say {form}");
        assert!(text.contains(&format!("](criteria/{name}.svg)")), "the entry of {name} has no picture");
    }
}

#[test]
fn pictures_show_what_vv_selects_and_are_small() {
    for row in ROWS {
        let desk = desk_with(row);
        let mut arguments = vec!["select", "mesh.obj", "--sharp", "sharp.txt", "--json", "--select", row.expression];
        let camera = criteria::camera().unwrap().to_string();
        if row.criterion(&(row.model)()).unwrap().uses_camera() {
            arguments.extend(["--camera", &camera]);
        }
        let answer = desk.run(&arguments).json();
        let kind = answer["kind"].as_str().unwrap();
        let selected = answer[format!("selected_{kind}")].as_array().unwrap().len();
        let entry = entry_of(row);
        assert!(entry.contains(&format!("\n- **Selects {kind}**: ")), "{} selects {kind}", row.name());

        let picture = fs::read_to_string(docs().join("criteria").join(row.name()).with_extension("svg")).unwrap();
        let caption = picture.lines().find(|line| line.contains("selects ")).unwrap();
        assert!(caption.contains(&format!(">selects {selected} of ")), "{}: {selected}, not {caption}", row.name());
        assert!(selected > 0 && caption.contains(kind), "{}: {selected} {kind}, not {caption}", row.name());
        assert!(picture.len() < 25_000, "{}.svg: {} bytes", row.name(), picture.len());
    }
}

#[test]
fn the_commands_of_the_page_work() {
    let work = |row: &Row, commands: &[&str]| {
        let desk = desk_with(row);
        assert!(!commands.is_empty(), "no command beside {}", row.name());
        for command in commands {
            let ran = desk.run(words(command).strip_prefix(&["vv"]).unwrap());
            assert_eq!(ran.code, Some(0), "{command}: {}", ran.err);
        }
    };
    for row in ROWS {
        let entry = entry_of(row);
        let commands = commands(&entry);
        assert!(commands.iter().all(|command| command.contains(row.name())), "{commands:?} in {}", row.name());
        work(row, &commands);
    }
    work(&ROWS[0], &commands(page().split("\n### ").next().unwrap()));
}

#[test]
fn expressions_to_begin_with_are_expressions() {
    let camera = criteria::camera().unwrap();
    let read = |text: &str| Expression::parse_seen(text, camera, &mut |_| Ok(String::new()));
    for (name, text) in entries() {
        let begin = text.split("- **Begin with** ").nth(1).unwrap();
        // Some begin with words instead, where a number depends on the mesh.
        if let Some(expression) = begin.strip_prefix('`').and_then(|rest| rest.split('`').next()) {
            assert!(expression.contains(&name) && read(expression).is_ok(), "{name}: {expression}");
        }
    }
}

#[test]
fn links_lead_to_what_they_say() {
    let page = page();
    let links: Vec<(&str, &str)> = page.split('[').filter_map(|part| part.split_once("](")).collect();
    assert!(links.len() > ROWS.len());
    let entries = entries();
    for (shown, rest) in links {
        let target = rest.split(')').next().unwrap();
        let Some(name) = target.strip_prefix('#') else {
            assert!(docs().join(target).is_file(), "there is no {target}");
            continue;
        };
        assert!(entries.iter().any(|(entry, _)| entry == name), "there is no entry {name}");
        // Numbers that depend on the mesh are letters, and lists are not for one level.
        let expression = shown.trim_matches('`');
        if expression.contains(':') && !expression.contains(|c: char| c.is_ascii_uppercase() || c == '/') {
            let read = Expression::parse_seen(expression, criteria::camera().unwrap(), &mut |_| Ok(String::new()));
            assert!(read.is_ok() && expression.contains(name), "{expression} in the link to {name}");
        }
    }
}

/// What is said to end by itself selects nothing of the models when they are fine, what is not still does.
#[test]
fn what_ends_by_itself_does() {
    for row in ROWS {
        let entry = entry_of(row);
        let ends = entry.contains("It ends by itself.");
        assert!(ends != entry.contains("It does not end by itself."), "{}", row.name());
        let fine = refined((row.model)());
        let selected = row.criterion(&fine).unwrap().select(&fine, &mut Scratch::new()).unwrap();
        assert_eq!(selected.is_empty(), ends, "{} of the fine mesh: {}", row.expression, selected.len());
    }
}

/// Everything in four, four times, by Loop.
fn refined(mut mesh: Mesh) -> Mesh {
    let mut history = History::new(&mesh, Keep::default());
    let uniform = Subdivider::new(Loop::default(), Uniform);
    for _ in 0..4 {
        uniform
            .step(&mut mesh, &mut history, &Selection::empty(), &mut Scratch::new(), &mut Control::default())
            .unwrap();
    }
    mesh
}
