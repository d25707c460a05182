//! The table, in Markdown.

use std::fmt::Write;

use clap::ValueEnum;

use crate::outcome::{Outcome, Outcomes, ROUNDING};
use crate::peer::{Pages, Peer, Ready};
use crate::task::Task;
use crate::workload::Workload;

/// The tables of one mesh, and what is to be known about them.
pub(crate) fn report(workload: &Workload, peers: &[Ready], outcomes: &Outcomes) -> String {
    let mut text = format!("## {}, {} faces\n", workload.name, workload.counts.coarse_faces);
    for pages in Pages::ALL {
        let _ = write!(text, "\n### {}: {pages}\n\n", workload.name);
        table(&mut text, workload, peers, outcomes, pages);
    }
    text.push_str(
        "\nBest / median, in brackets the median in those of vvmesh; `*`: the result is another one.\nBeside vvmesh:\n\n",
    );
    agreement(&mut text, peers, outcomes);
    text
}

fn table(text: &mut String, workload: &Workload, peers: &[Ready], outcomes: &Outcomes, pages: Pages) {
    text.push_str("| task | aim |");
    for ready in peers {
        let _ = write!(text, " {} |", format!("{} {}", ready.peer, ready.version).trim_end());
    }
    let _ = write!(text, "\n|---|---|{}\n", "---|".repeat(peers.len()));
    for &task in Task::value_variants() {
        let outcome = |peer| outcomes.get(&(pages, task, peer));
        if !peers.iter().any(|ready| outcome(ready.peer).is_some()) {
            continue;
        }
        let aim = task.aim().map_or_else(|| "-".to_owned(), |aim| format!("<= {aim}"));
        let _ = write!(text, "| {} | {aim} |", task.title(workload.counts));
        let unit = task.unit(workload.counts);
        for &Ready { peer, .. } in peers {
            let Some(measured) = outcome(peer) else {
                text.push_str(" - |");
                continue;
            };
            let ours = outcome(Peer::Vvmesh).filter(|_| peer != Peer::Vvmesh);
            let compared = outcomes.get(&(Pages::Usual, task, peer));
            let mark = if compared.is_some_and(Outcome::is_another) { "*" } else { "" };
            let _ = write!(text, " {}{mark} |", cell(measured, ours, unit));
        }
        text.push('\n');
    }
}

/// Best and median, the median also in those of vvmesh. A single sample is all of them.
fn cell(measured: &Outcome, ours: Option<&Outcome>, unit: f64) -> String {
    let samples = &measured.answer.samples;
    if measured.failure.is_some() {
        return "failed".to_owned();
    }
    let best = samples.iter().copied().fold(f64::INFINITY, f64::min);
    let middle = median(samples);
    let mut cell = figures(best / unit);
    if samples.len() > 1 {
        let _ = write!(cell, " / {}", figures(middle / unit));
    }
    if let Some(ours) = ours.filter(|ours| ours.failure.is_none()) {
        let _ = write!(cell, " ({})", figures(middle / median(&ours.answer.samples)));
    }
    cell
}

/// Three significant figures.
fn figures(x: f64) -> String {
    let decimals = (2 - x.abs().log10().floor() as i32).max(0) as usize;
    format!("{x:.decimals$}")
}

fn median(samples: &[f64]) -> f64 {
    let mut sorted = samples.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    let middle = sorted.len() / 2;
    if sorted.len() % 2 == 1 { sorted[middle] } else { f64::midpoint(sorted[middle - 1], sorted[middle]) }
}

/// For every peer how far its results are from vvmesh's, and its notes.
fn agreement(text: &mut String, peers: &[Ready], outcomes: &Outcomes) {
    for ready in peers.iter().filter(|ready| ready.peer != Peer::Vvmesh) {
        let mut remarks = Vec::new();
        for (&(_, task, _), outcome) in
            outcomes.iter().filter(|((pages, _, peer), _)| (*pages, *peer) == (Pages::Usual, ready.peer))
        {
            if let Some(reason) = &outcome.failure {
                remarks.push(format!("**{} failed: {reason}**", task.name()));
                continue;
            }
            match &outcome.difference {
                Some(Ok(0.0)) => remarks.push(format!("{} equal", task.name())),
                Some(Ok(apart @ ..=ROUNDING)) => remarks.push(format!("{} within {apart:.0e}", task.name())),
                Some(Ok(apart)) => remarks.push(format!("**{} differs by {apart:.0e}**", task.name())),
                Some(Err(reason)) => remarks.push(format!("**{}: {reason}**", task.name())),
                None => {}
            }
            let faces = outcome.answer.faces;
            let ours = outcomes.get(&(Pages::Usual, task, Peer::Vvmesh)).map_or(faces, |ours| ours.answer.faces);
            if faces != ours {
                remarks.push(format!("{}: {faces} faces, not {ours}", task.name()));
            }
            let note = &outcome.answer.note;
            if !note.is_empty() && !remarks.contains(note) {
                remarks.push(note.clone());
            }
        }
        if !remarks.is_empty() {
            let _ = writeln!(text, "- {}: {}", ready.peer, remarks.join("; "));
        }
    }
}
