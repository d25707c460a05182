//! What a peer says after a task: one line of JSON.

use serde::{Deserialize, Serialize};

/// Samples, and what is to be known about them.
#[derive(Clone, PartialEq, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Answer {
    /// Faces of the mesh afterwards.
    pub(crate) faces: usize,
    /// Nanoseconds of each repetition; bytes if the task asks for memory.
    pub(crate) samples: Vec<f64>,
    /// In which way the peer does something else than vvmesh; empty if it does not.
    pub(crate) note: String,
}
