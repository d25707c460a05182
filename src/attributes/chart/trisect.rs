//! The chart mesh under √3.
//!
//! A chart is a mesh with a boundary, and is refined as one: in every second step its boundary edges are cut in three.
//! Along a seam the mesh does something else, and yet both come together again. The first step turns the edge a-b of a
//! seam, and leaves in the mesh two triangles across it, of the centres c and d beside it with a and with b, for which no
//! chart can have a face. The next step splits these at their centres p and q, and turns c-d to p-q: now a, p, q, b lie on
//! one line of edges, and p and q are the two points that cut the edge of each chart in three. So every second step is
//! whole, corner by corner.
//!
//! In a region that ends at a seam, one of the two may be made and the other not. It waits for the other, and what is made
//! of it waits with it; what the mesh has there has no values until then.

use std::collections::{BTreeMap, HashSet};

use super::{Chart, Done};
use crate::attributes::{Channel, Watch};
use crate::id::{Edge, Triangle, VertexId};
use crate::scratch::Scratch;
use crate::split::trisect::{Levels, State};
use crate::step::SplitKind;
use crate::subdivide::Control;

/// A new vertex with what it was made of, as in [`Splits`](crate::attributes::Splits).
type Made = (VertexId, [VertexId; 3]);

/// What the mesh has, and the charts do not yet.
#[derive(Clone, Debug, Default)]
pub(super) struct Waiting {
    /// For boundary edges of charts, with their face on the left, the points that will cut them: near the first end, and
    /// near the second.
    thirds: BTreeMap<[VertexId; 2], [Option<VertexId>; 2]>,
    /// All others, ascending.
    made: Vec<Made>,
}

/// A chart face to be split, with the vertices below those that are new in it.
struct Cut {
    triangle: Triangle,
    /// Twice the same if it is split at its centre.
    below: [VertexId; 2],
}

impl Cut {
    fn below(&self) -> impl Iterator<Item = VertexId> {
        let [one, other] = self.below;
        [Some(one), (other != one).then_some(other)].into_iter().flatten()
    }
}

impl Chart {
    /// Splits over the triangles that a step split, as far as they lie below chart faces.
    pub(super) fn follow_trisection(&mut self, done: &Done<'_>, values: &mut Channel, scratch: &mut Scratch) {
        let &Done { subdivider, splits, mesh, .. } = done;
        self.waiting.made.extend(splits.made());
        loop {
            let cuts = self.next_cuts(done);
            if cuts.is_empty() {
                return;
            }
            let triangles = cuts.iter().map(|cut| cut.triangle).collect();
            let Self { mesh: chart, history, is_fixed, seams, .. } = self;
            let mut watch = Watch::over(values, SplitKind::Trisect, is_fixed, *seams);
            let control = &mut Control { follower: Some(&mut watch), ..Control::default() };
            subdivider.trisect_over(chart, history, triangles, scratch, control).expect("the step below was made");
            self.lift.extend(mesh.vertex_count(), cuts.iter().flat_map(Cut::below));
            self.fix_outline();
        }
    }

    /// What can be cut now, in the order of what that makes.
    fn next_cuts(&mut self, done: &Done<'_>) -> Vec<Cut> {
        let mut cuts = Vec::new();
        let mut waiting: HashSet<VertexId> = self.waiting.thirds.values().flatten().flatten().copied().collect();
        for (x, made_of) in std::mem::take(&mut self.waiting.made) {
            let [a, b, c] = made_of;
            let is_on_edge = b == c;
            let face = if is_on_edge { None } else { self.face_over(made_of) };
            let face = face.map(|[a, b, c]| Triangle::new(a, b, c));
            if let Some(triangle) = face.filter(|&face| done.subdivider.can_trisect(&self.mesh, &self.history, face)) {
                cuts.push(Cut { triangle, below: [x; 2] });
                continue;
            }
            let is_noted = match face {
                Some(_) => false,
                None if is_on_edge => self.note_boundary_third(x, [a, b]),
                None => self.note_seam_third(x, made_of),
            };
            let waits_for_others = face.is_some() || made_of.iter().any(|v| waiting.contains(v));
            if is_noted || waits_for_others {
                waiting.insert(x);
            }
            if waits_for_others && !is_noted {
                self.waiting.made.push((x, made_of));
            }
            // Any other lies in a face without values.
        }
        self.cut_boundaries(done, &mut cuts);
        cuts.sort_unstable_by_key(|cut| cut.below);
        cuts
    }

    /// Adds the faces at the boundary edges for which both points are there.
    fn cut_boundaries(&mut self, done: &Done<'_>, cuts: &mut Vec<Cut>) {
        let mut thirds = std::mem::take(&mut self.waiting.thirds);
        thirds.retain(|&[a, b], thirds| {
            let &mut [Some(near_a), Some(near_b)] = thirds else { return true };
            let Some(apex) = self.mesh.rotation().left_of(a, b) else { return true };
            let triangle = Triangle::new(a, b, apex);
            let is_next = self.boundary_mate([a, b, apex]) == Some([a, b])
                && self.history.level(apex).map(|level| level + 1) == done.history.level(near_a);
            let is_due = is_next && done.subdivider.can_trisect(&self.mesh, &self.history, triangle);
            if is_due {
                cuts.push(Cut { triangle, below: [near_a, near_b] });
            }
            !is_due
        });
        self.waiting.thirds = thirds;
    }

    /// Notes a point that cuts a boundary edge of the mesh near its first end; answers whether a chart edge lies over it.
    fn note_boundary_third(&mut self, x: VertexId, [near, far]: [VertexId; 2]) -> bool {
        let rotation = self.mesh.rotation();
        let Some(edge) = self.sides_over(Edge::new(near, far)).next() else { return false };
        let [v, w] = edge.ends();
        let [a, b] = if rotation.right_of(v, w).is_none() { [v, w] } else { [w, v] };
        let is_near_b = self.base(b) == near;
        self.waiting.thirds.entry([a, b]).or_default()[usize::from(is_near_b)] = Some(x);
        true
    }

    /// Notes the centre of a triangle across a seam as a point that will cut the boundary edges of the charts on both
    /// sides; answers whether it is one.
    ///
    /// An edge of such a triangle leads from an end of the seam to the centre of the triangle that the seam had on one
    /// side. In the chart there is still the boundary edge opposite to that centre.
    fn note_seam_third(&mut self, x: VertexId, [a, b, c]: [VertexId; 3]) -> bool {
        let mut found = Vec::new();
        for [from, to] in [[a, b], [b, c], [c, a]] {
            for v in self.over(from) {
                for (w, left) in self.mesh.ring(v).pairs().filter(|&(w, _)| self.base(w) == to) {
                    let mate = self.boundary_mate([v, w, left]).filter(|&mate| mate != [v, w]);
                    // One end of the edge is opposite to the mate, and `x` is nearer to the other one.
                    found.extend(mate.map(|mate| (mate, usize::from(v == mate[1]))));
                }
            }
        }
        for &(mate, near) in &found {
            self.waiting.thirds.entry(mate).or_default()[near] = Some(x);
        }
        !found.is_empty()
    }

    /// The boundary edge that is cut when a chart face is split next, with the face on its left; `None` if that is not so.
    fn boundary_mate(&self, [a, b, c]: [VertexId; 3]) -> Option<[VertexId; 2]> {
        match Levels::before(&self.history, self.lift.len(), Vec::new()).state(Triangle::new(a, b, c)) {
            State::Odd { mate: [start, end], .. } if self.mesh.rotation().right_of(start, end).is_none() => {
                Some([start, end])
            }
            _ => None,
        }
    }
}
