//! Vertices whose semi-sharp edges vanish: the rules between which a step blends.

use super::Neighborhood;
use crate::id::VertexId;

/// What the rule of an even vertex follows from: how many sharp edges it has, and where they lead.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Feature {
    /// At most one: smooth, or a dart.
    Smooth,
    /// Two: the neighbours along the crease, in ring order.
    Crease([VertexId; 2]),
    /// Three or more.
    Corner,
}

impl Feature {
    fn new(sharp: impl Iterator<Item = VertexId> + Clone) -> Self {
        let mut first = sharp.clone();
        match (first.next(), first.next(), first.next()) {
            (Some(a), Some(b), None) => Self::Crease([a, b]),
            (Some(_), Some(_), Some(_)) => Self::Corner,
            _ => Self::Smooth,
        }
    }
}

/// What the sharp edges at a vertex are in a step and after it.
///
/// The vertex takes `weight` of the rule of `now` and the rest of that of `after`: the smaller of 1 and the mean of the two
/// greatest sharpnesses at it. So a vertex between two edges of the same sharpness blends as they do, and while two edges
/// are sharp enough the rule of all that are sharp holds, whatever fades beside them:
///
/// - With two edges of sharpness 1.5 and 0.5 the crease holds once more, and then the vertex is a dart.
/// - A third edge that fades at a crease or ends on a boundary, of sharpness s, leaves a corner for ⌈s⌉ steps, and then the
///   crease that the other two are; the step between is not blended.
/// - A dart is as smooth as what it becomes.
///
/// The sharpness of the vertex itself counts on its own; see [`Loop`](crate::scheme::Loop).
///
/// Source: `[derose1998]`, section 3, which has the mean of the two edges of a crease; of more than two edges we take the
/// two that are sharpest. (Others take the mean of those that vanish in the step, so that a third edge is blended too and
/// one that fades beside a sharp one softens a crease earlier.)
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Transition {
    /// By the edges that are sharp before the step.
    pub now: Feature,
    /// By those whose halves are sharp after it.
    pub after: Feature,
    /// How much of the rule of `now` the vertex takes, 0 to 1.
    pub weight: f64,
}

impl Neighborhood<'_> {
    /// What a step that splits all edges at a vertex makes of those that are sharp. O(valence), and the square of the number
    /// of sharp edges.
    #[must_use]
    pub fn transition(&self, v: VertexId) -> Transition {
        let neighbors = self.ring(v).neighbors();
        let sharp = self.sharp_slots(v).map(|slot| neighbors[slot]);
        let [mut first, mut second] = [0.0_f64; 2];
        for w in sharp.clone() {
            let value = self.sharpness(v, w).value();
            second = second.max(value.min(first));
            first = first.max(value);
        }
        Transition {
            now: Feature::new(sharp.clone()),
            after: Feature::new(sharp.filter(|&w| self.child_sharpness(v, w).is_sharp())),
            weight: (0.5 * (first + second)).min(1.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mesh;
    use crate::id::Edge;
    use crate::mesh::{Sharpness, SharpnessRule};
    use crate::shapes;

    /// The transition at a vertex when edges to its neighbours, by slot, have a sharpness.
    fn transition(mut mesh: Mesh, v: VertexId, edges: &[(usize, f64)]) -> (Transition, Vec<VertexId>) {
        let ring = mesh.ring(v).neighbors().to_vec();
        for &(slot, value) in edges {
            let sharpness = Sharpness::new(value).expect("a sharpness");
            assert!(mesh.set_sharpness(Edge::new(v, ring[slot]), sharpness));
        }
        (mesh.neighborhood().transition(v), ring)
    }

    #[test]
    fn the_two_sharpest_edges_have_the_weight() {
        const INFINITE: f64 = f64::INFINITY;
        // Edges, how many of them are sharp before and after the step, and the weight.
        type Case<'a> = (&'a [(usize, f64)], [usize; 2], f64);
        let cases: [Case<'_>; 8] = [
            (&[], [0, 0], 0.0),
            (&[(0, 0.5), (2, 0.5)], [2, 0], 0.5),
            (&[(0, 0.25), (2, 0.5)], [2, 0], 0.375),
            (&[(0, 1.5), (2, 1.25)], [2, 2], 1.0),
            (&[(2, 1.5), (0, 0.5)], [2, 1], 1.0),
            (&[(0, 1.25), (2, 0.25)], [2, 1], 0.75),
            (&[(0, INFINITE), (2, INFINITE), (3, 0.5)], [3, 2], 1.0),
            (&[(0, 0.5), (1, 0.25), (2, 0.75)], [3, 0], 0.625),
        ];
        for (edges, sharp, weight) in cases {
            let (found, ring) = transition(shapes::octahedron(), VertexId::new(4), edges);
            let [now, after] = sharp.map(|count| match count {
                0 | 1 => Feature::Smooth,
                2 => Feature::Crease([ring[0], ring[2]]),
                _ => Feature::Corner,
            });
            assert_eq!(found, Transition { now, after, weight }, "{edges:?}");
        }
    }

    #[test]
    fn a_semi_sharp_edge_ends_on_a_boundary_at_a_corner() {
        // Slot 1 of 4 leads inwards.
        let (found, ring) = transition(shapes::grid(2, 1), VertexId::new(1), &[(1, 0.5)]);
        let along = Feature::Crease([ring[0], ring[3]]);
        assert_eq!(found, Transition { now: Feature::Corner, after: along, weight: 1.0 });
    }

    #[test]
    fn chaikin_may_keep_an_edge_that_would_vanish() {
        let mut mesh = shapes::octahedron();
        mesh.set_sharpness_rule(SharpnessRule::Chaikin);
        // 3/4 · 0.75 + 1/4 · 3 - 1 is above 0.
        let (found, ring) = transition(mesh, VertexId::new(4), &[(0, 0.75), (2, 3.0)]);
        let along = Feature::Crease([ring[0], ring[2]]);
        assert_eq!(found, Transition { now: along, after: along, weight: 1.0 });
    }
}
