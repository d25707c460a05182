//! The chart mesh on a hierarchy.
//!
//! Cut along its seams, the input is the input of another hierarchy. Whatever is split of the mesh is split over it in the
//! charts, at the same level; so closing draws over the edges that it draws in the mesh, and leaves as little behind. A star
//! that is complete in the mesh is complete in each chart over it, so masks find there what they read.

use std::collections::HashMap;

use glam::DVec3;

use super::{Chart, Done};
use crate::attributes::{Channel, Watch};
use crate::id::{Edge, VertexId};
use crate::scratch::Scratch;
use crate::split::hierarchy::{Grower, Growth, Levels, Shown, show};
use crate::split::quadrisect::Plan;
use crate::step::SplitKind;
use crate::subdivide::{Control, GrownOver};

impl Chart {
    /// Grows over what grew, by any number of levels.
    pub(super) fn follow_levels(
        &mut self,
        &Done { subdivider, splits, mesh, history: history_below }: &Done<'_>,
        values: &mut Channel,
        scratch: &mut Scratch,
    ) {
        let below = history_below.refinement().expect("the step was one on a hierarchy");
        let levels_below = Levels::new(mesh.rotation(), &below.hierarchy);
        let Self { mesh: chart, history, lift, .. } = self;
        let refinement = history.take_refinement(chart, below.scheme, below.goes_back);
        let mut refinement = refinement.expect("the charts are as old as the hierarchy below");
        let (first, mut growth) = (lift.len(), Growth::default());
        let (rotation, positions, _) = chart.parts_mut();
        let hierarchy = &mut refinement.hierarchy;
        let mut grower = Grower { rotation, hierarchy, growth: &mut growth, max_faces: None };
        for (x, _) in splits.made() {
            for triangle in levels_below.triangles_beside(x).into_iter().flatten() {
                if let Some(face) = lift.face_over(grower.levels(), &below.hierarchy, triangle) {
                    grower.split_edge(face).expect("32-bit ids name all chart vertices");
                }
            }
            let made = grower.hierarchy.vertex_count() - lift.len();
            lift.extend(mesh.vertex_count(), std::iter::repeat_n(x, made));
        }
        show(rotation, hierarchy, &growth.made, scratch, |_, _| {});
        positions.resize(rotation.vertex_count(), DVec3::ZERO);
        self.fix_outline();

        let Self { mesh: chart, history, lift, is_fixed, seams, .. } = self;
        for &(v, level) in splits.kept.iter().filter(|&&(v, level)| level > below.hierarchy.level(v)) {
            for over in lift.over(v).filter(|over| !is_fixed[over.index()]) {
                refinement.places.push(over, level, DVec3::ZERO, DVec3::ZERO);
                growth.steps.push((over, level));
            }
        }
        let level_below = |v| Shown::new(levels_below, v).1.level(below.goes_back);
        let moved = splits.moved.iter().map(|&v| (v, level_below(v)));
        let shown: Vec<_> = moved.flat_map(|(v, level)| lift.over(v).map(move |over| (over, level))).collect();
        let grown = GrownOver {
            mesh: chart,
            refinement: &refinement,
            first,
            steps: &growth.steps,
            shown: &shown,
            base: lift.bases(),
            below: (mesh, below),
        };
        let mut watch = Watch::over(values, SplitKind::Quadrisect, is_fixed, *seams);
        subdivider.show_over(&grown, &mut Control { follower: Some(&mut watch), ..Control::default() });
        history.keep_refinement(refinement);
        history.record(SplitKind::Quadrisect, lift.len(), std::iter::empty(), &[], 0);
        // Masks read those of the input.
        self.tags_of = None;
    }

    /// Writes the rings over those that a step of red-green refinement wrote. The new chart vertices are those of the plan,
    /// and lie over what they lie over already.
    pub(super) fn redraw(
        &mut self,
        &Done { mesh, history: history_below, .. }: &Done<'_>,
        plan: &Plan,
        scratch: &mut Scratch,
    ) {
        let below = history_below.hierarchy().expect("the step was one on a hierarchy");
        let levels_below = Levels::new(mesh.rotation(), below);
        let Self { mesh: chart, history, lift, .. } = self;
        let (rotation, ..) = chart.parts_mut();
        let mut hierarchy = history.take_hierarchy(plan.first);
        let new: HashMap<Edge, VertexId> = plan.odd().map(|(x, split)| (split.edge(), x)).collect();
        let mut made: Vec<VertexId> = lift.bases()[plan.first..].to_vec();
        // What lies across an edge is of its level, or a part of what is split before.
        made.sort_unstable_by_key(|&x| (below.level(x), x));
        made.dedup();
        for triangle in made.into_iter().flat_map(|x| levels_below.triangles_beside(x)).flatten() {
            let levels = Levels::new(rotation, &hierarchy);
            let Some([a, b, c]) = lift.face_over(levels, below, triangle) else { continue };
            if hierarchy.odd(a, b).is_none() {
                let birth = levels.birth([a, b, c]).expect("the edge below was split");
                hierarchy.insert(new[&Edge::new(a, b)], birth);
            }
        }
        let made: Vec<VertexId> = plan.odd().map(|(x, _)| x).collect();
        show(rotation, &hierarchy, &made, scratch, |_, _| {});
        history.record(SplitKind::Quadrisect, lift.len(), std::iter::empty(), &[], 0);
        history.keep_hierarchy(hierarchy);
    }
}
