//! `vv check`: everything that keeps faces from being a conforming mesh.

use std::fmt::Write;

use serde::Serialize;
use vvmesh::check::{Finding, Report, conformity};

use crate::Outcome;
use crate::args::CheckArguments;
use crate::console::{Failure, print, print_json};
use crate::input;
use crate::table::count;

/// How many findings of a kind are printed for people; JSON has all of them.
const PRINTED: usize = 10;

#[derive(Serialize)]
struct Checked<'a> {
    conforming: bool,
    findings: Vec<Found<'a>>,
}

#[derive(Serialize)]
struct Found<'a> {
    kind: &'static str,
    message: &'a str,
    vertices: Vec<usize>,
    faces: &'a [usize],
}

pub(crate) fn run(arguments: &CheckArguments) -> Result<Outcome, Failure> {
    let loaded = input::read(&arguments.mesh)?;
    let report = conformity(&loaded.faces, arguments.tolerance);
    if arguments.json {
        let found = |finding| Found::from(finding);
        let findings = report.findings.iter().map(found).collect();
        print_json(&Checked { conforming: report.is_conforming(), findings })?;
    } else {
        print(&text(&arguments.mesh.display().to_string(), &report))?;
    }
    Ok(if report.is_conforming() { Outcome::Done } else { Outcome::Found })
}

impl<'a> From<&'a Finding> for Found<'a> {
    fn from(finding: &'a Finding) -> Self {
        Self {
            kind: finding.kind.name(),
            message: &finding.message,
            vertices: finding.vertices.iter().map(|v| v.index()).collect(),
            faces: &finding.faces,
        }
    }
}

fn text(name: &str, report: &Report) -> String {
    let verdict = if report.is_conforming() { "conforming" } else { "not conforming" };
    let findings = match report.findings.len() {
        0 => String::new(),
        found => format!(", {}", count(found, "finding", "findings")),
    };
    let mut text = format!("{name}: {verdict}{findings} (tolerance {:e})\n", report.tolerance);
    for same in report.findings.chunk_by(|p, q| p.kind == q.kind) {
        let harmless = if same[0].kind.is_harmless() { ", which does no harm" } else { "" };
        let _ = writeln!(text, "{}: {}{harmless}", same[0].kind, same.len());
        for finding in same.iter().take(PRINTED) {
            let _ = writeln!(text, "  {finding}");
        }
        if same.len() > PRINTED {
            let _ = writeln!(text, "  and {} more; --json prints all", same.len() - PRINTED);
        }
    }
    text
}
