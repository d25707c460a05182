//! Does every source named in the documentation stand in `papers/references.bib`, and is every entry used?
//!
//! A source is a key in brackets and backticks after the word `Source:`, as in ``Source: `[loop1987]`, section 3``.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

#[path = "common/sources.rs"]
mod sources;

use sources::rust_files;

#[test]
fn every_key_has_an_entry_and_every_entry_is_used() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let entries = entries(&fs::read_to_string(root.join("papers/references.bib")).unwrap());
    let used: BTreeSet<String> =
        rust_files(&root.join("src")).iter().flat_map(|path| keys(&fs::read_to_string(path).unwrap())).collect();
    assert!(used.len() > 3, "only {} keys were found", used.len());
    assert_eq!(used, entries, "keys in src, and in papers/references.bib");
}

#[test]
fn every_source_has_a_key() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for path in rust_files(&root.join("src")) {
        for (number, line) in fs::read_to_string(&path).unwrap().lines().enumerate() {
            let named = line.split_once("Source: ").is_none_or(|(_, source)| source.starts_with("`["));
            assert!(named, "{}:{}: a source without a key", path.display(), number + 1);
        }
    }
}

#[test]
fn keys_are_found_where_they_stand() {
    let text = "/// An array `[u32; 3]` and x.\n/// Source: `[loop1987]`, page 3; `[a-b2]`\n/// (`[c3]`).\nfn f() {}\n/// `[none]`";
    assert_eq!(keys(text), ["loop1987", "a-b2", "c3"]);
    assert_eq!(
        entries("@book{one,\n  title = {x}\n}\n@article{two2000,\n}"),
        ["one", "two2000"].map(String::from).into()
    );
}

/// The keys in `Source:` sentences; such a sentence ends with its comment.
fn keys(source: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut inside = false;
    for line in source.lines() {
        let comment = line.trim_start();
        let named = comment.split_once("Source: ");
        inside = comment.starts_with("//") && (inside || named.is_some());
        if !inside {
            continue;
        }
        let text = named.map_or(comment, |(_, after)| after);
        let bracketed = text.split("`[").skip(1).filter_map(|rest| rest.split_once("]`"));
        found.extend(bracketed.map(|(key, _)| key.to_string()));
    }
    found
}

fn entries(bibliography: &str) -> BTreeSet<String> {
    let key = |line: &str| line.strip_prefix('@')?.split_once('{')?.1.strip_suffix(',').map(str::to_string);
    bibliography.lines().filter_map(key).collect()
}
