//! The peers written in Rust. Each runs as a process of its own, of this same program.

mod alum;
mod plain;
mod vvmesh;

use std::error::Error;
use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};

use crate::answer::Answer;
use crate::raw::{RawMesh, write_result};
use crate::task::Task;

/// Which peer a process is.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum Native {
    Vvmesh,
    Plain,
    Alum,
}

/// What a process is to do. Without a task it tells the version of its library.
#[derive(Args, Debug)]
pub(crate) struct Request {
    peer: Native,
    #[arg(requires_all = ["input", "output", "seconds"])]
    task: Option<Task>,
    input: Option<PathBuf>,
    output: Option<PathBuf>,
    seconds: Option<f64>,
}

impl Request {
    /// Prints the version or the answer, and nothing for a task that the library does not offer.
    pub(crate) fn serve(&self) -> Result<(), Box<dyn Error>> {
        let (Some(task), Some(input), Some(output), Some(seconds)) =
            (self.task, &self.input, &self.output, self.seconds)
        else {
            println!("{}", self.version());
            return Ok(());
        };
        let mesh = RawMesh::read(input)?;
        let run = match self.peer {
            Native::Vvmesh => vvmesh::run,
            Native::Plain => plain::run,
            Native::Alum => alum::run,
        };
        if let Some(measured) = run(task, &mesh, seconds)? {
            write_result(output, &measured.result)?;
            println!("{}", serde_json::to_string(&measured.answer)?);
        }
        Ok(())
    }

    /// The version that Cargo chose.
    fn version(&self) -> &'static str {
        let name = match self.peer {
            Native::Vvmesh => "name = \"vvmesh\"\nversion = \"",
            Native::Alum => "name = \"alum\"\nversion = \"",
            Native::Plain => return "",
        };
        let lock = include_str!("../../../../Cargo.lock");
        lock.split_once(name).and_then(|(_, rest)| rest.split('"').next()).unwrap_or_default()
    }
}

/// What a peer measured, and what it computed.
struct Measured {
    answer: Answer,
    /// Positions, vectors or distances, one number after another.
    result: Vec<f64>,
}

/// Times work on a state that is made anew for every sample, until so many seconds were spent in the work.
///
/// Making a state and dropping it is not timed. Answers with nanoseconds, and with the last state.
fn timed<S>(seconds: f64, mut setup: impl FnMut() -> S, mut work: impl FnMut(&mut S)) -> (Vec<f64>, S) {
    let mut samples = Vec::new();
    let mut spent = 0.0;
    loop {
        let mut state = setup();
        let start = Instant::now();
        work(&mut state);
        let took = start.elapsed().as_secs_f64();
        samples.push(took * 1e9);
        spent += took;
        if spent >= seconds {
            return (samples, state);
        }
    }
}

/// Distances from vertex 0 by a queue, `visit` calling for every neighbour of a vertex.
struct Search {
    distances: Vec<u32>,
    queue: Vec<u32>,
}

impl Search {
    /// With the arrays that it needs, so that a search allocates nothing.
    fn new(vertices: usize) -> Self {
        Self { distances: vec![u32::MAX; vertices], queue: Vec::with_capacity(vertices) }
    }

    fn run<I: Iterator<Item = u32>>(&mut self, neighbors: impl Fn(u32) -> I) {
        self.distances[0] = 0;
        self.queue.push(0);
        let mut head = 0;
        while let Some(&v) = self.queue.get(head) {
            head += 1;
            let next = self.distances[v as usize] + 1;
            for w in neighbors(v) {
                if self.distances[w as usize] == u32::MAX {
                    self.distances[w as usize] = next;
                    self.queue.push(w);
                }
            }
        }
    }

    fn result(&self) -> Vec<f64> {
        self.distances.iter().map(|&distance| f64::from(distance)).collect()
    }
}
