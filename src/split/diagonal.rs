//! The diagonal of a face with two split edges.

use glam::DVec3;

use crate::id::VertexId;
use crate::rotation::RotationSystem;

/// What is left of a face when the corner between its two split edges is cut off: `ends[0], ends[1], odd[1], odd[0]`
/// counter-clockwise or clockwise. `odd[k]` lies on the split edge that starts at `ends[k]`.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Quad {
    /// The ends of the edge that is not split.
    pub ends: [VertexId; 2],
    /// The new vertices, each beside its end.
    pub odd: [VertexId; 2],
}

/// Which diagonal cuts the quad that a face with two split edges leaves. The sources fix none.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Diagonal {
    /// From the end of smaller valence before the step; of two equal ones from the smaller id.
    #[default]
    Valence,
    /// The longer one, measured after the step; of two equal ones from the smaller id.
    Longest,
    /// The shorter one, measured after the step; of two equal ones from the smaller id.
    Shortest,
    /// From the end of smaller id.
    ById,
}

impl Diagonal {
    /// The place in `quad.ends` of the end from which the diagonal goes to the new vertex beside the other end.
    ///
    /// `valences` still has the valences before the step.
    pub(crate) fn start(self, quad: Quad, valences: &RotationSystem, positions: &[DVec3]) -> usize {
        let [a, b] = quad.ends;
        let length = |end: VertexId, odd: VertexId| positions[end.index()].distance_squared(positions[odd.index()]);
        let (of_a, of_b) = (length(a, quad.odd[1]), length(b, quad.odd[0]));
        let b_first = match self {
            Self::Valence => (valences.valence(b), b) < (valences.valence(a), a),
            Self::Longest => of_b > of_a || (of_b == of_a && b < a),
            Self::Shortest => of_b < of_a || (of_b == of_a && b < a),
            Self::ById => b < a,
        };
        usize::from(b_first)
    }
}
