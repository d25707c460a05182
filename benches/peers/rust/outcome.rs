//! What came of the tasks.

use std::collections::BTreeMap;

use crate::agreement::Points;
use crate::answer::Answer;
use crate::peer::{Pages, Peer};
use crate::task::Task;

/// What came of one task of one peer.
#[derive(Default)]
pub(crate) struct Outcome {
    /// Of all rounds.
    pub(crate) answer: Answer,
    /// Why it came to nothing, if it did.
    pub(crate) failure: Option<String>,
    /// How far its points are from those of vvmesh, or why they cannot be compared; `None` if they were not.
    pub(crate) difference: Option<Result<f64, String>>,
}

/// All that was measured on one mesh.
pub(crate) type Outcomes = BTreeMap<(Pages, Task, Peer), Outcome>;

/// Above this a difference is no rounding, not even of single precision.
pub(crate) const ROUNDING: f64 = 1e-6;

impl Outcome {
    /// Adds the samples of one more round.
    pub(crate) fn add(&mut self, answer: Answer) {
        self.answer.samples.extend(answer.samples);
        self.answer.faces = answer.faces;
        self.answer.note = answer.note;
    }

    pub(crate) fn compare(&mut self, ours: &Points, theirs: &Points) {
        self.difference = Some(if theirs.count() == ours.count() {
            Ok(ours.difference(theirs))
        } else {
            Err(format!("{} vertices, not {}", theirs.count(), ours.count()))
        });
    }

    /// Whether the peer computed something else than vvmesh.
    pub(crate) fn is_another(&self) -> bool {
        !matches!(self.difference, None | Some(Ok(..=ROUNDING)))
    }
}
