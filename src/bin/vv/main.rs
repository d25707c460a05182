//! The command-line tool of vvmesh.
//!
//! One file a command; the rest is what several of them need: reading, tables, output that is checked before any work.
//! It uses the public interface of the library only.

mod aim;
mod args;
mod attributes;
mod check;
mod compare;
mod console;
mod demo;
mod demo_model;
mod fields;
mod info;
mod input;
mod limit;
mod matrix;
mod memory;
mod outputs;
mod predict;
mod progress;
mod refine;
mod report;
mod run;
mod select;
mod sharp;
mod state;
mod stroke;
mod stroke_file;
mod subdivide;
mod table;
mod tsv;

use std::process::ExitCode;

use clap::Parser;

use args::{Arguments, Command};
use console::Failure;

/// How a command ended that was not refused.
enum Outcome {
    /// Done: exit 0.
    Done,
    /// Done, and what was looked for is there, or what was to be reached is not: exit 1.
    Found,
}

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(usage) => {
            // Help goes to standard output with exit 0, all else to standard error with exit 2. A closed pipe is no error.
            let _ = usage.print();
            return ExitCode::from(if usage.use_stderr() { 2 } else { 0 });
        }
    };
    let outcome = match arguments.command {
        Command::Demo(arguments) => demo::run(&arguments),
        Command::Info(arguments) => info::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Select(arguments) => select::run(&arguments),
        Command::Subdivide(mut arguments) => subdivide::run(&mut arguments),
        Command::Matrix(mut arguments) => matrix::run(&mut arguments),
        Command::Limit(arguments) => limit::run(&arguments),
        Command::Predict(arguments) => predict::run(&arguments),
        Command::Stroke(arguments) => stroke::run(&arguments),
    };
    match outcome {
        Ok(Outcome::Done) => ExitCode::SUCCESS,
        Ok(Outcome::Found) => ExitCode::from(1),
        Err(Failure(message)) => {
            console::error(&message);
            ExitCode::from(2)
        }
    }
}
