//! The chart mesh under the bisection of 4-8.

use glam::DVec3;

use super::{Chart, Done};
use crate::attributes::{Channel, Watch};
use crate::id::VertexId;
use crate::scratch::Scratch;
use crate::split::bisect::Seed;
use crate::step::{Bisections, History, InputBlocks, SplitKind};
use crate::subdivide::Control;

impl Chart {
    /// Bisects over the triangles that a step bisected.
    ///
    /// The charts have the blocks of the mesh; one whose refinement edge is a seam is two half blocks there. A chart
    /// vertex is in the generation that the faces around it in its chart have reached, which on a seam may be one more
    /// than in the mesh.
    pub(super) fn follow_bisection(
        &mut self,
        &Done { subdivider, splits, mesh, history }: &Done<'_>,
        values: &mut Channel,
        scratch: &mut Scratch,
    ) {
        if self.history.bisections().is_none() {
            // Before its first step nothing was ahead.
            self.take_blocks(history);
        }
        let mut seeds: Vec<(Seed, VertexId)> = Vec::with_capacity(splits.len());
        for (x, made_of) in splits.made() {
            let [a, b, c] = made_of;
            if b == c {
                self.edges_over([a, b], |v, slot| seeds.push((self.edge_seed(v, slot), x)));
            } else {
                seeds.extend(self.face_over(made_of).map(|face| (self.face_seed(face), x)));
            }
        }
        seeds.sort_unstable();

        let Self { mesh: chart, history, is_fixed, seams, .. } = self;
        let mut watch = Watch::over(values, SplitKind::Bisect, is_fixed, *seams);
        let control = &mut Control { follower: Some(&mut watch), ..Control::default() };
        let made = seeds.iter().map(|&(seed, _)| seed);
        subdivider.bisect_over(chart, history, made, scratch, control).expect("the step below was made");
        self.lift.extend(mesh.vertex_count(), seeds.into_iter().map(|(_, x)| x));
        self.fix_outline();
    }

    /// Takes over what a history says of bisections, if it says anything. Of blocks that are split already nothing is
    /// needed any more.
    pub(super) fn take_bisections(&mut self, history: &History) {
        let Some(bisections) = history.bisections() else { return };
        self.take_blocks(history);
        let ahead = bisections
            .behind
            .iter()
            .flat_map(|(&v, &(generation, _))| self.over(v).map(move |over| (over, (generation, DVec3::ZERO))));
        let behind = ahead.collect();
        self.history.bisections_mut().behind = behind;
    }

    fn take_blocks(&mut self, history: &History) {
        let blocks = history.bisections().map_or(&[][..], |bisections| bisections.blocks.edges());
        let edges = blocks.iter().flat_map(|&edge| self.sides_over(edge)).collect();
        *self.history.bisections_mut() = Bisections { blocks: InputBlocks::new(edges, 0), ..Bisections::default() };
    }

    fn edge_seed(&self, v: VertexId, slot: usize) -> Seed {
        let w = self.mesh.ring(v).neighbors()[slot];
        if v < w {
            return Seed { v, slot, is_face: false };
        }
        Seed { v: w, slot: self.mesh.ring(w).slot_of(v).expect("rings are symmetric"), is_face: false }
    }

    fn face_seed(&self, face: [VertexId; 3]) -> Seed {
        let smallest = (0..3).min_by_key(|&k| face[k]).unwrap_or(0);
        let [v, w] = [0, 1].map(|k| face[(smallest + k) % 3]);
        Seed { v, slot: self.mesh.ring(v).slot_of(w).expect("rings are symmetric"), is_face: true }
    }
}
