//! The chart mesh under the split in four.

use glam::DVec3;

use super::{Chart, Done};
use crate::attributes::{Blend, Channel, Seams};
use crate::id::{Edge, VertexId};
use crate::scheme::{Scheme, with_scheme};
use crate::split::quadrisect::{self, Closing, Plan};
use crate::step::SplitKind;

impl Chart {
    /// Splits the chart edges over the edges that a step split.
    ///
    /// Where a face has two split edges, the refined mesh tells which diagonal was drawn.
    pub(super) fn follow_quadrisection(
        &mut self,
        &Done { subdivider, splits, mesh, .. }: &Done<'_>,
        values: &mut Channel,
    ) {
        let mut edges: Vec<(VertexId, usize)> = Vec::with_capacity(splits.len());
        let mut below: Vec<VertexId> = Vec::with_capacity(splits.len());
        for (x, [p, q, _]) in splits.made() {
            self.edges_over([p, q], |v, slot| {
                edges.push((v, slot));
                below.push(x);
            });
        }
        let (mut plan, mut closing) = (Plan::default(), Closing::default());
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

        self.lift(mesh.vertex_count(), below);
        let Self { mesh: chart, base, .. } = self;
        let (rotation, positions, tags) = chart.parts_mut();
        if !tags.is_empty() {
            for (x, edge) in plan.odd() {
                let [p, q] = edge.ends();
                tags.split(Edge::new(p, q), x);
            }
        }
        let is_drawn = |a: VertexId, b: VertexId| mesh.rotation().has_edge(base[a.index()], base[b.index()]);
        quadrisect::apply(rotation, &plan, &mut closing, |quad, _| usize::from(!is_drawn(quad.ends[0], quad.odd[1])));
        positions.resize(rotation.vertex_count(), DVec3::ZERO);
        self.fix_outline();
        self.history.record(kind, self.base.len(), std::iter::empty(), &[], closing.max_valence);
    }
}
