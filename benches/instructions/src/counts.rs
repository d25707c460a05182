//! Runs the bench `stages` under callgrind, and reads its counts.

use std::collections::BTreeMap;
use std::error::Error;
use std::ffi::OsString;
use std::path::Path;
use std::process::{Command, Stdio};

use serde_json::Value;

/// Instructions by stage.
pub(crate) type Counts = BTreeMap<String, u64>;

/// Counts all stages.
///
/// # Errors
/// A command that fails, and an answer of the harness that is not understood.
pub(crate) fn count() -> Result<Counts, Box<dyn Error>> {
    let this_program = std::env::current_exe()?;
    let tools = this_program.parent().ok_or("this program lies in no folder")?.join("tools");
    install_runner(&tools)?;
    let mut path = OsString::from(tools.join("bin"));
    if let Some(others) = std::env::var_os("PATH") {
        path.push(":");
        path.push(others);
    }
    let bench = ["bench", "-q", "-p", "instructions", "--bench", "stages", "--", "--output-format=json", "--nosummary"];
    let counts = output(cargo().env("PATH", path).args(bench))?.lines().map(count_of).collect::<Result<Counts, _>>()?;
    if counts.is_empty() { Err("the harness counted nothing".into()) } else { Ok(counts) }
}

/// Builds the program to which the harness leaves running valgrind, of the very version that `Cargo.lock` has.
///
/// It lies beside this program, so that nothing is installed for the user, and is built once. It does little itself, so
/// it is built without optimization, which takes half the time.
fn install_runner(tools: &Path) -> Result<(), Box<dyn Error>> {
    let locked = output(cargo().args(["pkgid", "gungraun-runner"]))?;
    let (_, version) = locked.trim().rsplit_once('@').ok_or_else(|| format!("no version in {locked}"))?;
    let install = ["install", "gungraun-runner", "--quiet", "--locked", "--debug", "--version", version, "--root"];
    output(cargo().env("CARGO_PROFILE_DEV_DEBUG", "false").args(install).arg(tools)).map(drop)
}

/// The stage and its count in a line of the harness.
fn count_of(line: &str) -> Result<(String, u64), Box<dyn Error>> {
    let line: Value = serde_json::from_str(line)?;
    let text = |key: &str| line[key].as_str().ok_or_else(|| format!("no `{key}` in {line}"));
    let count = line.pointer("/profiles/0/data/total/metrics/Ir/values/new").and_then(Value::as_u64);
    Ok((format!("{}/{}", text("function_name")?, text("id")?), count.ok_or_else(|| format!("no count in {line}"))?))
}

/// The cargo that runs this program.
fn cargo() -> Command {
    Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
}

/// What a command writes; its errors go where ours go.
fn output(command: &mut Command) -> Result<String, Box<dyn Error>> {
    let output = command.stderr(Stdio::inherit()).output()?;
    if !output.status.success() {
        return Err(format!("{command:?} failed").into());
    }
    Ok(String::from_utf8(output.stdout)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_of_the_harness_is_read() {
        let line = |ir: &str| {
            let total = format!(r#"{{"metrics":{{"Ir":{{"values":{{{ir}}}}}}}}}"#);
            format!(r#"{{"function_name":"read","id":"off","profiles":[{{"data":{{"total":{total}}}}}]}}"#)
        };
        let count = |ir: &str| count_of(&line(ir)).ok();
        assert_eq!(count(r#""new":12,"old":11"#), Some(("read/off".to_string(), 12)));
        assert_eq!(count(r#""old":11"#), None);
        assert_eq!(count_of("{}").unwrap_err().to_string(), "no `function_name` in {}");
    }
}
