//! A progress bar for work that takes long, on a terminal only.

use std::io::{IsTerminal, stderr};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use vvmesh::subdivide::Progress;

/// Work that is done sooner shows no bar.
const SHORT: Duration = Duration::from_secs(1);

/// How often what is shown moves.
const TICK: Duration = Duration::from_millis(100);

/// The bar of one command, which appears when the work turns out to be long.
pub(crate) struct Bar {
    started: Instant,
    terminal: bool,
    bar: Option<ProgressBar>,
}

impl Bar {
    /// Starts the clock.
    pub(crate) fn new() -> Self {
        Self { started: Instant::now(), terminal: stderr().is_terminal(), bar: None }
    }

    /// Shows how far a level is, and the greatest distance that is left before it, if that is known.
    pub(crate) fn show(&mut self, level: u8, error: Option<f64>, progress: Progress) -> ControlFlow<()> {
        if self.is_shown() {
            let bar = self.bar.get_or_insert_with(|| {
                let style = ProgressStyle::with_template("{msg} [{bar:40}] {percent}% of {len} positions");
                ProgressBar::no_length().with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
            });
            let error = error.map_or(String::new(), |error| format!(", error left {error:.3e}"));
            bar.set_message(format!("level {level}{error}"));
            bar.set_length(progress.total as u64);
            bar.set_position(progress.done as u64);
        }
        ControlFlow::Continue(())
    }

    /// Shows that something else is done, of which nobody knows how long it takes.
    pub(crate) fn show_stage(&mut self, stage: String) {
        self.hide();
        if self.is_shown() {
            let spinner = ProgressBar::new_spinner().with_message(stage);
            spinner.enable_steady_tick(TICK);
            self.bar = Some(spinner);
        }
    }

    /// Takes the bar away, so that lines can be written.
    pub(crate) fn hide(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.finish_and_clear();
        }
    }

    fn is_shown(&self) -> bool {
        self.terminal && self.started.elapsed() > SHORT
    }
}
