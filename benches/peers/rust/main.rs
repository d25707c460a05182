//! How fast is vvmesh beside other libraries, at the same tasks, on the same machine, in the same minutes?
//!
//! Every peer does every task in a process of its own, one thread, peer after peer and round after round, so that what the
//! machine does meanwhile meets them all. A mesh goes to a peer as a file of plain numbers, its answer comes back as a line
//! of JSON and a file of numbers, which is compared with what vvmesh computed. `README.md` beside this says what to install.
//!
//! Read in this order: `task` (the rows), `workload` (what they start from), `peer` (the columns), `native` (the peers in
//! Rust; `../cpp` and `../python` have the others), `agreement`, `outcome`, `report`.

mod agreement;
mod answer;
mod native;
mod outcome;
mod peer;
mod raw;
mod report;
mod task;
mod workload;

use std::env;
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand, ValueEnum};

use crate::agreement::Points;
use crate::outcome::Outcomes;
use crate::peer::{Pages, Peer, Ready};
use crate::report::report;
use crate::task::Task;
use crate::workload::Workload;

/// Runs the same tasks with vvmesh and with other libraries, and prints a table with ratios.
#[derive(Parser)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
struct Arguments {
    /// Closed meshes of triangles, OFF or OBJ.
    #[arg(required = true)]
    meshes: Vec<PathBuf>,
    /// How often every peer is asked.
    #[arg(long, default_value_t = 3)]
    rounds: usize,
    /// How long a task is repeated each time it is asked for; it is done once at least.
    #[arg(long, default_value_t = 0.3)]
    seconds: f64,
    /// Only these tasks.
    #[arg(long = "task", value_delimiter = ',')]
    tasks: Vec<Task>,
    /// Only these peers.
    #[arg(long = "peer", value_delimiter = ',')]
    peers: Vec<Peer>,
    #[command(subcommand)]
    process: Option<Process>,
}

#[derive(Subcommand)]
enum Process {
    /// Does one task as one of the peers in Rust.
    #[command(hide = true)]
    As(native::Request),
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match &arguments.process {
        Some(Process::As(request)) => request.serve(),
        None => compare(&arguments),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn compare(arguments: &Arguments) -> Result<(), Box<dyn Error>> {
    // Beside the program, so in Cargo's target folder.
    let folder = env::current_exe()?.with_file_name("peers-files");
    fs::create_dir_all(&folder)?;
    let wanted = if arguments.peers.is_empty() { Peer::value_variants() } else { &arguments.peers };
    let mut peers = Vec::new();
    for &peer in wanted {
        match Ready::new(peer, &folder) {
            Ok(ready) => peers.push(ready),
            Err(reason) => println!("- {reason}"),
        }
    }
    for path in &arguments.meshes {
        let workload = Workload::prepare(path, &folder).map_err(|error| format!("{}: {error}", path.display()))?;
        let outcomes = measure(arguments, &workload, &peers, &folder.join("result"))?;
        println!("\n{}", report(&workload, &peers, &outcomes));
    }
    Ok(())
}

/// Asks every peer for every task, round after round.
fn measure(
    arguments: &Arguments,
    workload: &Workload,
    peers: &[Ready],
    file: &Path,
) -> Result<Outcomes, Box<dyn Error>> {
    let tasks = if arguments.tasks.is_empty() { Task::value_variants() } else { &arguments.tasks };
    let mut outcomes = Outcomes::new();
    for &task in tasks {
        let mut ours = None;
        for round in 0..arguments.rounds {
            eprintln!("{}: {}, round {} of {}", workload.name, task.name(), round + 1, arguments.rounds);
            // Another peer is the first in each round: to it falls what a change of pages costs the machine.
            let order = || peers.iter().cycle().skip(round).take(peers.len());
            for (pages, ready) in Pages::ALL.iter().flat_map(|&pages| order().map(move |ready| (pages, ready))) {
                let answer = ready.ask(task, workload, pages, file, arguments.seconds);
                let Some(answer) = answer.transpose() else {
                    continue;
                };
                let outcome = outcomes.entry((pages, task, ready.peer)).or_default();
                match answer {
                    Ok(answer) => outcome.add(answer),
                    Err(error) => outcome.failure = Some(error.to_string()),
                }
                // The result is the same in every round.
                if round > 0 || pages != Pages::Usual || outcome.failure.is_some() {
                    continue;
                }
                if let Some(width) = task.result_width() {
                    let points = Points::new(&raw::read_result(file)?, width);
                    match &ours {
                        Some(ours) => outcome.compare(ours, &points),
                        None if ready.peer == Peer::Vvmesh => ours = Some(points),
                        None => {}
                    }
                }
            }
        }
    }
    Ok(outcomes)
}
