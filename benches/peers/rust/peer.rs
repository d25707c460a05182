//! Who takes part, and how each peer is made ready and asked.

use std::env;
use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};
use std::process::Command;

use clap::ValueEnum;

use crate::answer::Answer;
use crate::task::Task;
use crate::workload::Workload;

/// One column of the table.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, ValueEnum)]
#[value(rename_all = "lower")]
pub(crate) enum Peer {
    Vvmesh,
    Plain,
    Alum,
    OpenMesh,
    OpenSubdiv,
    Cgal,
    Libigl,
    Trimesh,
    PyMeshLab,
    Vtk,
}

/// What a peer is written in.
enum Program {
    /// A part of this program, by its name.
    Native(&'static str),
    /// A file in `cpp`, with the libraries it is linked to.
    Cpp(&'static str, &'static [&'static str]),
    /// A file in `python`.
    Python(&'static str),
}

impl Peer {
    fn program(self) -> Program {
        match self {
            Self::Vvmesh => Program::Native("vvmesh"),
            Self::Plain => Program::Native("plain"),
            Self::Alum => Program::Native("alum"),
            Self::OpenMesh => Program::Cpp("openmesh", &["-lOpenMeshTools", "-lOpenMeshCore"]),
            Self::OpenSubdiv => Program::Cpp("opensubdiv", &["-losdCPU"]),
            Self::Cgal => Program::Cpp("cgal", &[]),
            Self::Libigl => Program::Python("igl_peer.py"),
            Self::Trimesh => Program::Python("trimesh_peer.py"),
            Self::PyMeshLab => Program::Python("pymeshlab_peer.py"),
            Self::Vtk => Program::Python("vtk_peer.py"),
        }
    }

    /// The package to install.
    fn package(self) -> &'static str {
        match self {
            Self::Vvmesh | Self::Plain | Self::Alum => "a part of this program",
            Self::OpenMesh => "Debian: libopenmesh-dev",
            Self::OpenSubdiv => "Debian: libosd-dev",
            Self::Cgal => "Debian: libcgal-dev",
            Self::Libigl => "PyPI: libigl",
            Self::Trimesh => "PyPI: trimesh, scipy",
            Self::PyMeshLab => "PyPI: pymeshlab",
            Self::Vtk => "PyPI: vtk",
        }
    }
}

impl fmt::Display for Peer {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Vvmesh => "vvmesh",
            Self::Plain => "plain arrays",
            Self::Alum => "alum",
            Self::OpenMesh => "OpenMesh",
            Self::OpenSubdiv => "OpenSubdiv",
            Self::Cgal => "CGAL",
            Self::Libigl => "libigl",
            Self::Trimesh => "trimesh",
            Self::PyMeshLab => "PyMeshLab",
            Self::Vtk => "VTK",
        })
    }
}

/// How the C library hands out memory, alike for all peers.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) enum Pages {
    /// As the system is.
    Usual,
    /// Asking for huge pages.
    Huge,
}

impl Pages {
    pub(crate) const ALL: [Self; 2] = [Self::Usual, Self::Huge];
}

impl fmt::Display for Pages {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Usual => "memory as the system gives it",
            Self::Huge => "huge pages (`GLIBC_TUNABLES=glibc.malloc.hugetlb=1`)",
        })
    }
}

/// A peer that is installed, compiled and has told its version.
pub(crate) struct Ready {
    pub(crate) peer: Peer,
    pub(crate) version: String,
    program: PathBuf,
    /// What stands before the task.
    arguments: Vec<PathBuf>,
}

impl Ready {
    /// Makes a peer ready, or says in a line why it is skipped.
    pub(crate) fn new(peer: Peer, folder: &Path) -> Result<Self, String> {
        let skipped = |reason: Box<dyn Error>| format!("{peer}: skipped, {reason} ({})", peer.package());
        let sources = Path::new(env!("CARGO_MANIFEST_DIR"));
        let (program, arguments) = match peer.program() {
            Program::Native(name) => {
                let this = env::current_exe().map_err(|error| skipped(error.into()))?;
                (this, vec!["as".into(), name.into()])
            }
            Program::Cpp(name, libraries) => {
                let binary = folder.join(name);
                compile(&sources.join("cpp").join(name).with_extension("cc"), &binary, libraries).map_err(skipped)?;
                (binary, Vec::new())
            }
            Program::Python(name) => ("python3".into(), vec![sources.join("python").join(name)]),
        };
        let version = output(Command::new(&program).args(&arguments)).map_err(skipped)?;
        Ok(Self { peer, version: version.trim().to_owned(), program, arguments })
    }

    /// Lets the peer do a task in a process of its own. `None` if the library does not offer it.
    pub(crate) fn ask(
        &self,
        task: Task,
        workload: &Workload,
        pages: Pages,
        result: &Path,
        seconds: f64,
    ) -> Result<Option<Answer>, Box<dyn Error>> {
        let mut command = Command::new(&self.program);
        command.args(&self.arguments).arg(task.name()).arg(workload.file(task.input())).arg(result);
        command.arg(seconds.to_string());
        // One thread each.
        command.envs(["OMP_NUM_THREADS", "IGL_NUM_THREADS", "VTK_SMP_MAX_THREADS"].map(|name| (name, "1")));
        let mut tunables = Vec::new();
        if pages == Pages::Huge {
            tunables.push("glibc.malloc.hugetlb=1");
        }
        if task == Task::Memory {
            // What was given back before does not stay resident: the usual threshold, but one that does not grow.
            tunables.push("glibc.malloc.mmap_threshold=131072");
        }
        command.env("GLIBC_TUNABLES", tunables.join(":"));
        // A library may print before the answer.
        match output(&mut command)?.lines().last() {
            Some(line) => Ok(Some(serde_json::from_str(line)?)),
            None => Ok(None),
        }
    }
}

/// With optimization and for any processor of its kind, as Cargo compiles Rust.
fn compile(source: &Path, binary: &Path, libraries: &[&str]) -> Result<(), Box<dyn Error>> {
    let mut command = Command::new("c++");
    command.args(["-std=c++17", "-O3", "-DNDEBUG", "-o"]).args([binary, source]).args(libraries);
    output(&mut command).map(drop)
}

/// What a program prints; if it fails, the line of its complaint that says most.
fn output(command: &mut Command) -> Result<String, Box<dyn Error>> {
    // Python leaves nothing beside its sources.
    let output = command.env("PYTHONDONTWRITEBYTECODE", "1").output();
    let output = output.map_err(|error| format!("{}: {error}", command.get_program().display()))?;
    if output.status.success() {
        return Ok(String::from_utf8(output.stdout)?);
    }
    let complaint = String::from_utf8_lossy(&output.stderr);
    // Compilers say `error: `, Python says `ModuleNotFoundError: `.
    let reason = complaint.lines().find_map(|line| Some(line.split_once("rror: ")?.1)).or(complaint.lines().last());
    Err(reason.map_or_else(|| output.status.to_string(), str::to_owned).into())
}
