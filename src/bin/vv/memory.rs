//! How many faces fit the memory of the machine.

use sysinfo::{MemoryRefreshKind, System};

use crate::console::{Failure, refuse};

/// Bytes a face at the peak of a run. Up to 56 were measured, with all that can be kept; the rest is for rings longer than
/// usual and for systems that copy what grows.
const BYTES_A_FACE: u64 = 96;

/// How many faces a run may make, and why.
#[derive(Clone, Copy)]
pub(crate) struct FaceLimit {
    /// The number.
    pub(crate) faces: u64,
    /// The memory it comes from; `None` if the user chose it.
    memory: Option<u64>,
}

impl FaceLimit {
    /// The number that the user gave, else what fits the memory that is free now.
    pub(crate) fn new(given: Option<u64>) -> Self {
        let Some(faces) = given else {
            let bytes = available_bytes();
            return Self { faces: bytes / BYTES_A_FACE, memory: Some(bytes) };
        };
        Self { faces, memory: None }
    }

    /// Refuses a uniform run of which some level would be too large.
    pub(crate) fn refuse_uniform(self, faces: usize, levels: u8) -> Result<(), Failure> {
        let mut needed = faces as u64;
        for level in 1..=levels {
            needed = needed.saturating_mul(4);
            if needed > self.faces {
                return refuse(self.refusal(level, needed));
            }
        }
        Ok(())
    }

    /// Why a level is not made.
    pub(crate) fn refusal(self, level: u8, needed: u64) -> String {
        let why = match self.memory {
            Some(bytes) => format!(
                "the {:.1} GiB of free memory hold about {}; take fewer levels or a smaller selection, or allow more with --max-faces",
                bytes as f64 / (1_u64 << 30) as f64,
                self.faces
            ),
            None => {
                format!("--max-faces allows {}; take fewer levels, a smaller selection or a higher limit", self.faces)
            }
        };
        format!("level {level} would have {needed} faces; {why}. Nothing was written")
    }
}

/// The memory that this process may still take: what the machine has left, or its control group if that is less. Any
/// amount on a system that does not tell.
fn available_bytes() -> u64 {
    let mut system = System::new();
    system.refresh_memory_specifics(MemoryRefreshKind::nothing().with_ram());
    // File caches count as used there and are given back, so the group is asked for what its processes hold.
    let group = system.cgroup_limits().map_or(u64::MAX, |limits| limits.total_memory.saturating_sub(limits.rss));
    if system.total_memory() == 0 { u64::MAX } else { system.available_memory().min(group) }
}
