//! How many faces fit the memory of the machine.

use std::fmt::Display;
use std::ops::RangeInclusive;

use sysinfo::{MemoryRefreshKind, System};
use vvmesh::Mesh;

use crate::args::{MethodName, PenName, RefineArguments, SchemeName, StrokeArguments};
use crate::console::{Failure, refuse};

/// Bytes a face at the peak of a run. Up to 56 were measured, with all that can be kept; the rest is for rings longer than
/// usual and for systems that copy what grows.
const BYTES_A_FACE: u64 = 96;

/// The same by methods that keep a hierarchy. Up to 121 were measured, by `red-green`; 92 by the others.
const BYTES_A_FACE_ON_HIERARCHY: u64 = 192;

/// What a face takes more where a ray can find it. 110 were measured before anything was drawn; where much is drawn, as many
/// boxes may be there of faces that are no more, or be joined.
const BYTES_A_FACE_IN_BOXES: u64 = 256;

/// The same if attributes ride along. Up to 435 were measured, with texture coordinates, normals, colours and groups, under
/// `four-eight`.
const BYTES_A_FACE_WITH_ATTRIBUTES: u64 = 512;

/// The same by methods that keep a hierarchy, the charts one of their own. Up to 600 were measured, by `dynamic` under `loop`.
const BYTES_A_FACE_WITH_ATTRIBUTES_ON_HIERARCHY: u64 = 704;

/// The same under `sqrt3` by `simple`, which keeps where vertices and their values were born and where they tend to. Up to
/// 727 were measured.
const BYTES_A_FACE_WITH_ATTRIBUTES_IN_CLOSED_FORM: u64 = 832;

/// Bytes a weight at the peak of a run that makes a matrix. It takes 12; up to 35 were measured, under `four-eight`, where
/// half of the weights are those of rows that were replaced; the rest is for systems that copy what grows.
const BYTES_A_WEIGHT: f64 = 40.0;

/// The same under `sqrt3` by `simple`, with rows of where vertices were born and where they tend to. Up to 72 were measured.
const BYTES_A_WEIGHT_IN_CLOSED_FORM: f64 = 80.0;

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
    pub(crate) fn new(given: Option<u64>, method: MethodName) -> Self {
        Self::of(given, if method.is_on_hierarchy() { BYTES_A_FACE_ON_HIERARCHY } else { BYTES_A_FACE })
    }

    /// The same for a pen.
    pub(crate) fn of_pen(arguments: &StrokeArguments) -> Self {
        let bytes_a_face = match arguments.method {
            PenName::Incremental => BYTES_A_FACE,
            PenName::Dynamic => BYTES_A_FACE_ON_HIERARCHY,
        };
        Self::of(arguments.max_faces, bytes_a_face + BYTES_A_FACE_IN_BOXES)
    }

    /// The same if attributes ride along.
    pub(crate) fn with_attributes(arguments: &RefineArguments) -> Self {
        let bytes_a_face = match (arguments.scheme, arguments.method) {
            (SchemeName::Sqrt3, MethodName::Simple) => BYTES_A_FACE_WITH_ATTRIBUTES_IN_CLOSED_FORM,
            (_, method) if method.is_on_hierarchy() => BYTES_A_FACE_WITH_ATTRIBUTES_ON_HIERARCHY,
            _ => BYTES_A_FACE_WITH_ATTRIBUTES,
        };
        Self::of(arguments.max_faces, bytes_a_face)
    }

    /// The same if the matrix of the refinement of a mesh is made, too.
    pub(crate) fn with_matrix(arguments: &RefineArguments, mesh: &Mesh) -> Self {
        let bytes_a_weight = match (arguments.scheme, arguments.method) {
            (SchemeName::Sqrt3, MethodName::Simple) => BYTES_A_WEIGHT_IN_CLOSED_FORM,
            _ => BYTES_A_WEIGHT,
        };
        // There are half as many rows as faces.
        let bytes_a_row = weights_a_row(mesh, arguments.scheme) * bytes_a_weight;
        Self::of(arguments.max_faces, BYTES_A_FACE + (bytes_a_row / 2.0) as u64)
    }

    fn of(given: Option<u64>, bytes_a_face: u64) -> Self {
        let Some(faces) = given else {
            let bytes = available_bytes();
            return Self { faces: bytes / bytes_a_face, memory: Some(bytes) };
        };
        Self { faces, memory: None }
    }

    /// Whether so many faces are not too many.
    pub(crate) fn holds(self, faces: u64) -> bool {
        faces <= self.faces
    }

    /// Refuses levels of which some would be too large: at each step from this level on `growing` of the faces become `parts`
    /// times as many, and all that come of them go on.
    pub(crate) fn refuse_growth(
        self,
        faces: usize,
        growing: usize,
        parts: u64,
        levels: RangeInclusive<u8>,
    ) -> Result<(), Failure> {
        let (rest, mut grown) = ((faces - growing) as u64, growing as u64);
        for level in levels {
            grown = grown.saturating_mul(parts);
            let needed = grown.saturating_add(rest);
            if needed > self.faces && growing > 0 {
                return refuse(self.refusal_of(format_args!("level {level}"), needed));
            }
        }
        Ok(())
    }

    /// Why a mesh that is called by a name is not made.
    pub(crate) fn refusal_of(self, name: impl Display, needed: u64) -> String {
        format!("{}. Nothing was written", self.excess_of(name, needed))
    }

    /// How much too large a mesh is that is called by a name.
    pub(crate) fn excess_of(self, name: impl Display, needed: u64) -> String {
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
        format!("{name} would have {needed} faces; {why}")
    }
}

/// About how many weights a row of the matrix gets at most.
///
/// On a regular mesh that is what the numbers tend to as levels are added. Around vertices of n neighbours it is more if
/// masks read whole stars: a face of Loop's weighs the stars of its corners, with n + m + k − 6 vertices, 12 if regular, and
/// the mean of that is Σ n² / F − 6.
fn weights_a_row(mesh: &Mesh, scheme: SchemeName) -> f64 {
    let squares: f64 = mesh.vertices().map(|v| (mesh.ring(v).valence() as f64).powi(2)).sum();
    let stars = squares / mesh.face_count().max(1) as f64 - 6.0;
    let irregular = (stars / 12.0).max(1.0);
    match scheme {
        SchemeName::Midpoint => 3.0,
        SchemeName::Butterfly => 24.0,
        SchemeName::Loop => 12.0 * irregular,
        SchemeName::Sqrt3 => 18.0 * irregular,
        SchemeName::FourEight => 28.0 * irregular,
        SchemeName::ModifiedButterfly => 24.0 * irregular,
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
