//! What is told to the user: results on standard output, all else on standard error.

use std::fmt::Display;
use std::io::{self, Write};

use serde::Serialize;

/// Why a command was refused or failed: a sentence for the user, and exit 2. (It is no `Error` itself, so that it can be
/// made of any.)
#[derive(Debug)]
pub(crate) struct Failure(pub(crate) String);

impl<E: std::error::Error> From<E> for Failure {
    fn from(error: E) -> Self {
        Self(error.to_string())
    }
}

/// Refuses with a sentence.
pub(crate) fn refuse<T>(message: impl Into<String>) -> Result<T, Failure> {
    Err(Failure(message.into()))
}

/// Writes a result to standard output. A reader that went away has had enough: that is success.
pub(crate) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => refuse(format!("standard output: {error}")),
        _ => Ok(()),
    }
}

/// Writes a report to standard output, as one line of JSON.
pub(crate) fn print_json(report: &impl Serialize) -> Result<(), Failure> {
    print(&json(report)?)
}

/// A report as one line of JSON.
pub(crate) fn json(report: &impl Serialize) -> Result<String, Failure> {
    let mut text = serde_json::to_string(report)?;
    text.push('\n');
    Ok(text)
}

/// Tells something worth knowing.
pub(crate) fn note(message: impl Display) {
    tell("note", message);
}

/// Tells something that may not be what the user meant.
pub(crate) fn warning(message: impl Display) {
    tell("warning", message);
}

/// Tells why a command failed.
pub(crate) fn error(message: impl Display) {
    tell("error", message);
}

fn tell(kind: &str, message: impl Display) {
    // When nobody listens on standard error there is nobody to tell.
    let _ = writeln!(io::stderr().lock(), "{kind}: {message}");
}
