//! Are the drawings in `docs` those that `examples/drawings` makes?

use std::fs;
use std::path::Path;

#[allow(dead_code, unreachable_pub, reason = "a program of its own, whose main is not called here")]
#[path = "../examples/drawings/main.rs"]
mod drawings;

#[test]
fn the_committed_drawings_are_up_to_date() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let made = drawings::all().unwrap();
    let folders = [folder.clone(), folder.join("criteria")];
    let committed = folders.iter().flat_map(|folder| fs::read_dir(folder).unwrap()).map(|entry| entry.unwrap().path());
    let committed = committed.filter(|path| path.extension().is_some_and(|extension| extension == "svg")).count();
    assert_eq!(committed, made.len(), "drawings in docs");
    for (name, drawing) in made {
        // A checkout may have changed the ends of lines.
        let file = fs::read_to_string(folder.join(&name).with_extension("svg")).unwrap().replace('\r', "");
        assert!(file == drawing, "docs/{name}.svg is old: run `cargo run --example drawings`");
        assert!(!drawing.contains("\n\n"), "an empty line would end the drawing inside of Markdown");
    }
}
