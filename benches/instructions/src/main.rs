//! Holds the instruction counts of the stages to a kept baseline.
//!
//! `cargo run -p instructions` counts and compares; `cargo run -p instructions -- move` counts and writes the new
//! baseline. Counts can only be compared where the same compiler made the program and valgrind shows it the same
//! processor; elsewhere the program says what differs and passes over.
//!
//! What is counted stands in `benches/stages.rs`.

mod baseline;
mod conditions;
mod counts;

use std::error::Error;
use std::path::Path;
use std::process::ExitCode;

use baseline::Baseline;

const BASELINE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/baseline.tsv");

fn main() -> ExitCode {
    let answer = match std::env::args().nth(1).as_deref() {
        None => compare(),
        Some("move") => move_baseline(),
        Some(conditions::PROBE) => {
            println!("{}", conditions::processor_features().join(" "));
            Ok(true)
        }
        Some(other) => Err(format!("expected `move` or nothing, found `{other}`").into()),
    };
    match answer {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// Whether the counts are those of the baseline, or cannot be compared with them.
fn compare() -> Result<bool, Box<dyn Error>> {
    let kept: Baseline = std::fs::read_to_string(BASELINE)?.parse()?;
    let conditions = conditions::here();
    let differences = kept.other_conditions(&conditions);
    if !differences.is_empty() {
        println!("the instruction counts are passed over, for the baseline was counted under other conditions:");
        differences.iter().for_each(|difference| println!("  {difference}"));
        return Ok(true);
    }
    let counts = counts::count()?;
    for (stage, count) in &counts {
        println!("{count:>12}  {stage}");
    }
    let changes = kept.changes(&counts);
    if changes.is_empty() {
        println!("{} stages are within {} % of the baseline", counts.len(), baseline::TOLERANCE_PERCENT);
        return Ok(true);
    }
    eprintln!("further than {} % from the baseline:", baseline::TOLERANCE_PERCENT);
    changes.iter().for_each(|change| eprintln!("  {change}"));
    eprintln!("If that is meant, move the baseline, and say why in the commit: cargo run -p instructions -- move");
    Ok(false)
}

fn move_baseline() -> Result<bool, Box<dyn Error>> {
    let conditions = conditions::here();
    if let Some((name, _)) = conditions.iter().find(|(_, value)| value.is_empty()) {
        return Err(format!("a baseline needs all conditions, and `{name}` is not to be had here").into());
    }
    let moved = Baseline { conditions, counts: counts::count()? };
    std::fs::write(BASELINE, moved.to_string())?;
    println!("{} stages counted; the baseline is {}", moved.counts.len(), Path::new(BASELINE).display());
    Ok(true)
}
