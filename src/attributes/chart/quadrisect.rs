//! The chart mesh under the split in four.

use glam::DVec3;

use super::{Chart, Done};
use crate::attributes::{Blend, Channel, Seams};
use crate::id::VertexId;
use crate::rotation::RotationSystem;
use crate::scheme::{Scheme, with_scheme};
use crate::scratch::Scratch;
use crate::split::Quad;
use crate::split::quadrisect::{self, Closing, Plan};
use crate::step::SplitKind;

impl Chart {
    /// Splits the chart edges over the edges that a step split.
    ///
    /// Where a face has two split edges, the refined mesh tells which diagonal was drawn.
    pub(super) fn follow_quadrisection(&mut self, done: &Done<'_>, values: &mut Channel, scratch: &mut Scratch) {
        let &Done { subdivider, splits, mesh, .. } = done;
        let mut edges: Vec<(VertexId, usize)> = Vec::with_capacity(splits.len());
        let mut below: Vec<VertexId> = Vec::with_capacity(splits.len());
        for (x, [p, q, _]) in splits.made() {
            self.edges_over([p, q], |v, slot| {
                edges.push((v, slot));
                below.push(x);
            });
        }
        let mut plan = Plan::default();
        quadrisect::plan_listed(&mut plan, self.mesh.rotation(), &self.history, edges.iter().copied());

        let around = self.mesh.neighborhood().with_hubs(plan.hubs());
        let kind = SplitKind::Quadrisect;
        with_scheme!(subdivider.scheme(), scheme => {
            for parent in plan.parents(around) {
                let is_inside = parent.left.is_some() && parent.right.is_some();
                let is_blended = values.blend() == Blend::Scheme
                    && (self.seams == Seams::Scheme || is_inside)
                    && splits.are_blended([parent.p, parent.q].map(|end| self.base(end)));
                let value = if is_blended {
                    let mut sum = values.sum();
                    scheme.odd(around, &parent, &mut sum);
                    sum.total().expect("a mask is not empty")
                } else {
                    values.without_mask(&[parent.p, parent.q], kind)
                };
                values.push(value);
            }
            let moved = splits.moved.iter().flat_map(|&v| self.over(v)).filter(|v| !self.is_fixed[v.index()]);
            values.move_by(moved, |values, v| {
                let mut sum = values.sum();
                scheme.even(around, v, &mut sum);
                sum.total()
            });
        }, else unreachable!("other schemes split otherwise"));

        self.lift.extend(mesh.vertex_count(), below);
        let (rotation, _, tags) = self.mesh.parts_mut();
        if !tags.is_empty() {
            for (x, split) in plan.odd() {
                tags.split(split.edge(), x);
            }
        }
        if subdivider.is_on_hierarchy() {
            self.redraw(done, &plan, scratch);
        } else {
            let mut closing = Closing::default();
            let is_drawn = |a, b| mesh.rotation().has_edge(self.lift.base(a), self.lift.base(b));
            let diagonal = |quad: Quad, _: &RotationSystem| usize::from(!is_drawn(quad.ends[0], quad.odd[1]));
            quadrisect::apply(rotation, &plan, &mut closing, diagonal);
            self.history.record(kind, self.lift.len(), std::iter::empty(), &[], closing.max_valence);
        }
        self.mesh.parts_mut().1.resize(self.lift.len(), DVec3::ZERO);
        self.fix_outline();
    }
}
