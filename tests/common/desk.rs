//! A folder in which `vv` is called, and what the answers are looked at with.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use serde_json::Value;
use tempfile::TempDir;
use vvmesh::{Mesh, io, shapes};

pub const SCHEMES: [&str; 6] = ["loop", "butterfly", "modified-butterfly", "midpoint", "sqrt3", "four-eight"];
pub const METHODS: [&str; 3] = ["uniform", "simple", "incremental"];

/// Faces with one fault each, and the kind that is found.
pub const FAULTS: [(&str, &str); 9] = [
    ("t_junction", "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 1 -1 0\nv 1 0 0\nf 1 2 3\nf 1 4 5\nf 5 4 2\n"),
    ("crack", "v 0 0 0\nv 2 0 0\nv 1 1 0\nv 1 -1 0\nv 1 -.1 0\nf 1 2 3\nf 1 4 5\nf 5 4 2\n"),
    ("non_manifold_edge", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 -1 0\nv 0 0 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n"),
    ("bow_tie", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv -1 0 0\nv -1 -1 0\nf 1 2 3\nf 1 4 5\n"),
    ("orientation", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 3 4\n"),
    ("non_orientable", "v 0 0 0\nv 1 0 0\nv 2 1 0\nv 0 1 1\nv 1 1 2\nf 1 2 3\nf 2 3 4\nf 3 4 5\nf 4 5 1\nf 5 1 2\n"),
    ("duplicate_face", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 2 3 1\n"),
    ("degenerate_face", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 2\n"),
    ("non_finite", "v 0 0 0\nv 1 0 nan\nv 0 1 0\nf 1 2 3\n"),
];

/// What became of one call.
pub struct Ran {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Ran {
    pub fn json(&self) -> Value {
        assert_eq!(self.out.lines().count(), 1, "{}", self.out);
        serde_json::from_str(&self.out).unwrap_or_else(|error| panic!("{error}: {}{}", self.out, self.err))
    }

    /// The call was refused for a reason that holds these words, and nothing stands on standard output.
    pub fn assert_refused(&self, words: &str) {
        assert_eq!((self.code, self.out.as_str()), (Some(2), ""), "{}", self.err);
        assert!(self.err.starts_with("error: ") || self.err.contains("\nerror: "), "{}", self.err);
        assert!(self.err.contains(words), "no `{words}` in: {}", self.err);
    }
}

/// A folder with some meshes, in which `vv` is called.
pub struct Desk {
    folder: TempDir,
}

impl Desk {
    /// `grid.obj` (5 x 4 squares), `torus.off` (6 x 5 quads).
    pub fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        io::save(folder.path().join("grid.obj"), &shapes::grid(5, 4)).unwrap();
        io::save(folder.path().join("torus.off"), &shapes::torus(6, 5, 2.0, 1.0)).unwrap();
        Self { folder }
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.path(name), content).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap()
    }

    /// A mesh in the folder.
    pub fn mesh(&self, name: &str) -> Mesh {
        Mesh::from_face_list(&io::read(self.path(name)).unwrap().faces).unwrap()
    }

    pub fn names(&self) -> BTreeSet<String> {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
    }

    pub fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_vv"));
        command.args(arguments).current_dir(self.folder.path()).stdin(Stdio::null());
        command
    }

    /// Calls with arguments; whatever happens, it is no panic.
    pub fn run(&self, arguments: &[&str]) -> Ran {
        let output = self.command(arguments).output().unwrap();
        let [out, err] = [output.stdout, output.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
        assert!(!err.contains("panicked"), "{arguments:?}: {err}");
        Ran { code: output.status.code(), out, err }
    }

    /// Calls with arguments in one text, split at blanks.
    pub fn vv(&self, arguments: &str) -> Ran {
        self.run(&arguments.split_whitespace().collect::<Vec<_>>())
    }

    pub fn done(&self, arguments: &str) -> Ran {
        let ran = self.vv(arguments);
        assert_eq!(ran.code, Some(0), "vv {arguments}: {}{}", ran.out, ran.err);
        ran
    }
}

pub fn keys(object: &Value) -> Vec<&str> {
    let Value::Object(entries) = object else { panic!("no object: {object}") };
    entries.keys().map(String::as_str).collect()
}

pub fn sorted<const N: usize>(mut names: [&str; N]) -> Vec<&str> {
    names.sort_unstable();
    names.to_vec()
}

pub fn numbers(array: &Value) -> Vec<u64> {
    array.as_array().unwrap().iter().map(|number| number.as_u64().unwrap()).collect()
}
