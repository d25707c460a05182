//! What is measured: the rows of the table.

use clap::ValueEnum;

use crate::workload::{Counts, Input};

/// One row. The names that clap gives them are also those by which every peer is asked.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug, ValueEnum)]
pub(crate) enum Task {
    /// Four levels of Loop.
    Loop4,
    /// One step of Loop from the result of `loop4`.
    Loop1,
    /// `loop1` with the vertices numbered at random.
    Shuffled,
    /// Four levels of modified Butterfly.
    Butterfly4,
    /// The library's structure, made from indexed faces.
    Build,
    /// For every vertex the sum of the differences to its neighbours.
    Laplacian,
    /// Distances from vertex 0, in edges.
    Search,
    /// One adaptive Loop step on a disk of radius 3 at a random place, selecting it included.
    Local,
    /// Whether the structure is what it should be.
    Validity,
    /// What the structure and its positions hold.
    Memory,
    /// Memory alone: writing to memory that was touched before.
    WriteTouched,
    /// Memory alone: writing to fresh memory.
    WriteFresh,
    /// Memory alone: copying to memory that was touched before.
    CopyTouched,
    /// Memory alone: copying to fresh memory.
    CopyFresh,
}

impl Task {
    /// The name by which a peer is asked.
    pub(crate) fn name(self) -> String {
        self.to_possible_value().expect("no task is hidden").get_name().to_owned()
    }

    pub(crate) fn title(self, counts: Counts) -> String {
        let millions = |faces: usize| format!("{:.2} M", faces as f64 * 1e-6);
        let (last, next) = (millions(counts.fine_faces), millions(4 * counts.fine_faces));
        match self {
            Self::Loop4 => format!("Loop x 4 levels ({last} faces), ns per face of the result"),
            Self::Loop1 => format!("Loop, one step to {next} faces, ns per face of the result"),
            Self::Shuffled => "the same, vertices shuffled first".to_owned(),
            Self::Butterfly4 => "modified Butterfly x 4 levels, ns per face of the result".to_owned(),
            Self::Build => format!("construction from {last} indexed faces, ns per face"),
            Self::Laplacian => "sum over all one-rings (Laplacian), ns per vertex".to_owned(),
            Self::Search => format!("breadth-first search over {last} faces, ns per vertex"),
            Self::Local => format!("local step, some 96 faces of {last}, ms per call"),
            Self::Validity => "validity check, ns per face".to_owned(),
            Self::Memory => "bytes held per face, topology + positions".to_owned(),
            Self::WriteTouched => format!("memory alone: {BYTES_A_FACE} bytes for each of {next} faces, written, ns"),
            Self::WriteFresh => "the same into fresh memory".to_owned(),
            Self::CopyTouched => "the same copied".to_owned(),
            Self::CopyFresh => "the same copied into fresh memory".to_owned(),
        }
    }

    /// What vvmesh wants to reach, in the unit of the row.
    pub(crate) fn aim(self) -> Option<f64> {
        match self {
            Self::Loop4 | Self::Loop1 => Some(15.0),
            Self::Shuffled => Some(35.0),
            Self::Butterfly4 | Self::Validity => Some(25.0),
            Self::Build => Some(70.0),
            Self::Laplacian => Some(10.0),
            Self::Search => Some(30.0),
            Self::Local => Some(0.05),
            Self::Memory => Some(32.0),
            Self::WriteTouched | Self::WriteFresh | Self::CopyTouched | Self::CopyFresh => None,
        }
    }

    /// How many nanoseconds or bytes of a sample make one of the row's unit.
    pub(crate) fn unit(self, counts: Counts) -> f64 {
        match self {
            Self::Loop4 | Self::Butterfly4 | Self::Build | Self::Validity | Self::Memory => counts.fine_faces as f64,
            Self::Laplacian | Self::Search => counts.fine_vertices as f64,
            Self::Local => 1e6,
            _ => 4.0 * counts.fine_faces as f64,
        }
    }

    /// What it starts from.
    pub(crate) fn input(self) -> Input {
        match self {
            Self::Loop4 | Self::Butterfly4 => Input::Coarse,
            Self::Shuffled => Input::Shuffled,
            _ => Input::Fine,
        }
    }

    /// How many numbers of the result belong together; `None` if there is no result to compare.
    pub(crate) fn result_width(self) -> Option<usize> {
        match self {
            Self::Loop4 | Self::Loop1 | Self::Shuffled | Self::Butterfly4 | Self::Laplacian => Some(3),
            Self::Search => Some(1),
            _ => None,
        }
    }
}

/// What vvmesh wrote for a face in a regular mesh when the table was laid out: half a vertex with a ring of 32 bytes and
/// a position of 24.
pub(crate) const BYTES_A_FACE: usize = 28;

/// How many local steps make one sample.
pub(crate) const LOCAL_STEPS: usize = 50;

/// The vertex around which local step `k` is made: far from the one before. Every peer has the same.
pub(crate) fn place(k: usize, vertices: usize) -> usize {
    k * 2_654_435_761 % vertices
}
