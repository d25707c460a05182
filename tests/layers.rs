//! Do the modules keep to the levels of the table in `ARCHITECTURE.md`?
//!
//! An arrow is a `crate::` path in `src`, single or in a group, or a `super::` path that leaves its module. It has to
//! point to a lower level. Crates from outside have to be named in the row of the module that uses them. Comments do not
//! count, nor do the unit tests at the end of a file, which may use what a user may.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

#[path = "common/sources.rs"]
mod sources;

use sources::rust_files;

/// A row of the table.
#[derive(Debug)]
struct Row {
    level: u32,
    crates: BTreeSet<String>,
}

type Table = BTreeMap<String, Row>;

#[test]
fn arrows_point_down() {
    let table = table(&fs::read_to_string(root().join("ARCHITECTURE.md")).unwrap());
    let outside = dependencies(&fs::read_to_string(root().join("Cargo.toml")).unwrap());
    assert!(outside.len() > 3, "no dependencies found");

    let (mut files, mut arrows, mut wrong) = (0, 0, Vec::new());
    let mut crates: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for path in rust_files(&root().join("src")) {
        let name = path.strip_prefix(root().join("src")).unwrap().to_str().unwrap().replace('\\', "/");
        if name.starts_with("bin/") {
            continue;
        }
        let found = paths(&module_path(&name), &fs::read_to_string(&path).unwrap(), &outside);
        files += 1;
        arrows += found.len();
        wrong.extend(violations(&table, &name, &found));
        let used = found.into_iter().filter_map(Found::into_crate);
        crates.entry(module_of(&name)).or_default().extend(used);
    }
    assert!(files > 50 && arrows > 100, "only {files} files with {arrows} arrows were read");
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
    let rows: BTreeMap<_, _> = table.into_iter().map(|(module, row)| (module, row.crates)).collect();
    assert_eq!(crates, rows, "modules with their crates: in src, and in the table");
}

#[test]
fn a_wrong_arrow_is_found() {
    let table =
        table("| 0 | `id` | names | |\n| 2 | `soup` | lists | glam |\n| 3 | `mesh` | mesh | |\n| 3 | `walk` | | |\n");
    let outside = ["glam".to_string(), "petgraph".to_string()];
    let of = |name: &str, text: &str| violations(&table, name, &paths(&module_path(name), text, &outside)).len();

    assert_eq!(of("soup/mod.rs", "use crate::id::Edge; use glam::DVec3; use super::id; mod a; use self::a;"), 0);
    assert_eq!(of("soup/mod.rs", "use crate::mesh::Mesh;"), 1, "upward");
    assert_eq!(of("mesh/a.rs", "use crate::walk;"), 1, "sideways");
    assert_eq!(of("mesh/a.rs", "use crate::mesh::b; use super::Mesh;"), 0, "its own folder");
    assert_eq!(of("soup/a.rs", "use crate::{id::{Edge, VertexId}, mesh::{self, Mesh}, walk};"), 2, "a group");
    assert_eq!(of("soup/a.rs", "fn f(x: &crate::mesh::Mesh) { crate :: walk::g(x) }"), 2, "paths outside of `use`");
    assert_eq!(of("soup/a.rs", "use super::super::mesh::Mesh;"), 1, "through the root");
    assert_eq!(of("soup/a.rs", "use crate::Mesh;"), 1, "a re-export has no level");
    assert_eq!(of("soup/a.rs", "use petgraph::Graph;"), 1, "a crate that is not in the row");
    let quiet = "//! crate::mesh\n/// [`crate::mesh`]\n/* crate::mesh /* x */ crate::walk */ fn f() -> &'static str { \"crate::mesh\" }";
    assert_eq!(of("soup/a.rs", quiet), 0, "comments and texts");
    assert_eq!(of("soup/a.rs", "fn f<'a>(c: char) { c == '\"' } use crate::mesh; // \""), 1, "a quote in a character");
    assert_eq!(of("soup/a.rs", "#[cfg(test)]\nmod tests { use crate::mesh; }"), 0, "unit tests");
    assert_eq!(of("other.rs", ""), 1, "a module without a row");
}

/// What is wrong with the paths of one file.
fn violations(table: &Table, file: &str, found: &[Found]) -> Vec<String> {
    let from = module_of(file);
    let Some(row) = table.get(&from) else {
        return vec![format!("{file}: module `{from}` has no row in the table")];
    };
    let wrong = |found: &Found| match found {
        Found::Module(to) if *to == from => None,
        Found::Module(to) => match table.get(to) {
            Some(target) if target.level < row.level => None,
            Some(target) => Some(format!("{file}: level {} uses `{to}` of level {}", row.level, target.level)),
            None => Some(format!("{file}: `crate::{to}` is no module of the table")),
        },
        Found::Crate(name) if row.crates.contains(name) => None,
        Found::Crate(name) => Some(format!("{file}: the row of `{from}` does not name the crate `{name}`")),
    };
    found.iter().filter_map(wrong).collect()
}

#[derive(Clone, PartialEq, Eq, Debug)]
enum Found {
    Module(String),
    Crate(String),
}

impl Found {
    fn into_crate(self) -> Option<String> {
        match self {
            Found::Module(_) => None,
            Found::Crate(name) => Some(name),
        }
    }
}

/// The modules of this crate, and the crates from outside, that a file names.
fn paths(module: &[String], source: &str, outside: &[String]) -> Vec<Found> {
    let tokens = tokens(&code(source));
    let mut found = Vec::new();
    for (k, token) in tokens.iter().enumerate() {
        let after = |text| tokens.get(k + 1).is_some_and(|next| next == text);
        let before = |text| k > 0 && tokens[k - 1] == text;
        let is_whole = before("use") && after(";");
        if before("::") || !(after("::") || is_whole) {
            continue;
        }
        if token == "crate" {
            found.extend(heads(&tokens[k + 2..]).into_iter().map(Found::Module));
        } else if token == "super" {
            let ups = tokens[k..].chunks(2).take_while(|pair| pair == &["super", "::"]).count();
            if ups >= module.len() {
                found.extend(heads(&tokens[k + 2 * ups..]).into_iter().map(Found::Module));
            }
        } else if outside.contains(token) {
            found.push(Found::Crate(token.clone()));
        }
    }
    found
}

/// The first name of a path, or of every path in a group.
fn heads(tokens: &[String]) -> Vec<String> {
    if tokens.first().is_none_or(|token| token != "{") {
        return tokens.first().cloned().into_iter().collect();
    }
    let (mut depth, mut heads) = (0, Vec::new());
    for (k, token) in tokens.iter().enumerate() {
        match token.as_str() {
            "{" => depth += 1,
            "}" if depth == 1 => break,
            "}" => depth -= 1,
            _ if depth == 1 && (k == 1 || tokens[k - 1] == ",") => heads.push(token.clone()),
            _ => {}
        }
    }
    heads
}

fn tokens(code: &str) -> Vec<String> {
    let mut tokens: Vec<String> = Vec::new();
    let mut rest = code.trim_start();
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_alphanumeric() || c == '_';
        let length = match first {
            _ if is_word(first) => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            ':' if rest.starts_with("::") => 2,
            _ => first.len_utf8(),
        };
        tokens.push(rest[..length].to_string());
        rest = rest[length..].trim_start();
    }
    tokens
}

/// A source without comments, texts and the unit tests at its end.
fn code(source: &str) -> String {
    let source = source.split("#[cfg(test)]\nmod ").next().unwrap_or("");
    let mut code = String::new();
    let mut rest = source;
    while let Some(c) = rest.chars().next() {
        let skipped = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            block_comment(rest)
        } else if c == '"' {
            text(rest)
        } else if ["'\"'", "'\\\"'"].iter().any(|quote| rest.starts_with(quote)) {
            rest[1..].find('\'').map_or(rest.len(), |end| end + 2)
        } else {
            code.push(c);
            rest = &rest[c.len_utf8()..];
            continue;
        };
        code.push(' ');
        rest = &rest[skipped..];
    }
    code
}

/// The length of the block comment that a text begins with; they nest.
fn block_comment(rest: &str) -> usize {
    let (mut at, mut depth) = (0, 0);
    loop {
        if rest[at..].starts_with("/*") {
            depth += 1;
            at += 2;
        } else if rest[at..].starts_with("*/") {
            depth -= 1;
            at += 2;
        } else {
            match rest[at..].chars().next() {
                Some(c) => at += c.len_utf8(),
                None => return at,
            }
        }
        if depth == 0 {
            return at;
        }
    }
}

/// The length of the text in quotes that a source begins with.
fn text(rest: &str) -> usize {
    let mut escaped = false;
    for (at, c) in rest.char_indices().skip(1) {
        match c {
            _ if escaped => escaped = false,
            '\\' => escaped = true,
            '"' => return at + 1,
            _ => {}
        }
    }
    rest.len()
}

/// `step/history.rs` is the module `step`, `history`; `step/mod.rs` is `step`; `lib.rs` the root.
fn module_path(file: &str) -> Vec<String> {
    let path = file.trim_end_matches(".rs").trim_end_matches("/mod");
    if path == "lib" { Vec::new() } else { path.split('/').map(str::to_string).collect() }
}

/// The module of the table that a file belongs to.
fn module_of(file: &str) -> String {
    module_path(file).first().cloned().unwrap_or("lib".into())
}

/// The rows `| level | `module` | what for | crates |`.
fn table(document: &str) -> Table {
    let row = |line: &str| {
        let cells: Vec<&str> = line.trim().trim_matches('|').split('|').map(str::trim).collect();
        let [level, module, _, crates] = cells[..] else { return None };
        let crates = crates.split(',').map(str::trim).filter(|name| !name.is_empty()).map(str::to_string).collect();
        Some((module.trim_matches('`').to_string(), Row { level: level.parse().ok()?, crates }))
    };
    document.lines().filter_map(row).collect()
}

/// The names under `[dependencies]`.
fn dependencies(manifest: &str) -> Vec<String> {
    let section = manifest.split("\n[dependencies]\n").nth(1).unwrap_or("").split("\n[").next().unwrap_or("");
    section.lines().filter_map(|line| line.split_once(" = ")).map(|(name, _)| name.replace('-', "_")).collect()
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}
