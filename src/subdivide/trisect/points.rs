//! The points that adaptive √3 keeps of every vertex, while a step is made.
//!
//! Each is made by a mask of points that were made before it. If somebody follows the step, the masks are written down and
//! shown when the step is sure to be made, one a pass.
//!
//! **Deliberately not here**: the masks; see [`super::closed_form`].

use glam::DVec3;

use crate::id::VertexId;
use crate::scheme::MaskSink;
use crate::step::{Lineage, Motion, Motions, Weights};
use crate::subdivide::ValueId;
use crate::subdivide::follow::MaskWriter;

/// The motions of all vertices, and what this step adds to them.
pub(super) struct Points {
    pub(super) motions: Motions,
    /// If somebody follows.
    script: Option<Script>,
}

impl Points {
    pub(super) fn new(motions: Motions, is_followed: bool) -> Self {
        Self { motions, script: is_followed.then(Script::default) }
    }

    /// Appends an input vertex, born where it is shown.
    pub(super) fn push_input(&mut self, v: VertexId, position: DVec3) {
        self.motions.push(Motion::Open);
        self.motions.set_point(v, Motion::BIRTH, position);
        if let Some(script) = &mut self.script {
            script.terms.push((1.0, ValueId::Shown(v)));
            script.close(ValueId::Kept(v, Motion::BIRTH), None);
        }
    }

    /// Makes a point of others, of which there are some.
    pub(super) fn make(&mut self, v: VertexId, number: u8, write: impl FnOnce(&mut PointSum<'_>)) {
        let point = self.sum(ValueId::Kept(v, number), None, write);
        self.motions.set_point(v, number, point);
    }

    /// Where a vertex is to be shown: at a level, and if it is new, with what it was made of.
    pub(super) fn show(&mut self, v: VertexId, level: u8, lineage: Option<Lineage>) -> DVec3 {
        self.sum(ValueId::Shown(v), lineage, |sum| sum.add(1.0, v, level))
    }

    /// What was made in this step; nothing if nobody follows.
    pub(super) fn script(&self) -> &Script {
        const EMPTY: &Script = &Script { made: Vec::new(), terms: Vec::new() };
        self.script.as_ref().unwrap_or(EMPTY)
    }

    fn sum(&mut self, id: ValueId, lineage: Option<Lineage>, write: impl FnOnce(&mut PointSum<'_>)) -> DVec3 {
        let mut sum = PointSum { motions: &self.motions, total: None, script: self.script.as_mut() };
        write(&mut sum);
        let total = sum.total;
        if let Some(script) = &mut self.script {
            script.close(id, lineage);
        }
        total.expect("a point is made of some")
    }
}

/// A weighted sum of points, term by term; a mask of as many groups, with the same bits.
pub(super) struct PointSum<'a> {
    motions: &'a Motions,
    total: Option<DVec3>,
    script: Option<&'a mut Script>,
}

impl PointSum<'_> {
    /// Adds a part of where a vertex is at a level.
    pub(super) fn add(&mut self, part: f64, v: VertexId, level: u8) {
        self.add_weights(part, v, self.motions.at(v, level));
    }

    /// Adds a part of where the neighbour before a boundary vertex is at a level.
    pub(super) fn add_before(&mut self, part: f64, v: VertexId, level: u8) {
        self.add_weights(part, v, self.motions.along(v, level)[0]);
    }

    /// The same of the neighbour after it.
    pub(super) fn add_after(&mut self, part: f64, v: VertexId, level: u8) {
        self.add_weights(part, v, self.motions.along(v, level)[1]);
    }

    /// Adds a part of a point.
    pub(super) fn add_point(&mut self, part: f64, v: VertexId, number: u8) {
        let term = part * self.motions.point(v, number);
        self.total = Some(self.total.map_or(term, |total| total + term));
        if let Some(script) = &mut self.script {
            script.terms.push((part, ValueId::Kept(v, number)));
        }
    }

    fn add_weights(&mut self, part: f64, v: VertexId, weights: Weights) {
        for (number, weight) in (0..).zip(weights).filter(|(_, weight)| *weight != 0.0) {
            self.add_point(part * weight, v, number);
        }
    }
}

/// Masks in the order in which they were applied.
#[derive(Default)]
pub(super) struct Script {
    /// What was made, if it is a new vertex of what, and where its terms end.
    made: Vec<(ValueId, Option<Lineage>, usize)>,
    terms: Vec<(f64, ValueId)>,
}

impl Script {
    /// Ends a mask, which makes this value.
    fn close(&mut self, id: ValueId, lineage: Option<Lineage>) {
        self.made.push((id, lineage, self.terms.len()));
    }

    /// Shows the masks, each in a pass of its own.
    pub(super) fn play(&self, masks: &mut MaskWriter<'_>) {
        let mut start = 0;
        for &(id, lineage, end) in &self.made {
            let parents: Vec<VertexId> = lineage.iter().flat_map(Lineage::vertices).collect();
            masks.assign_value(id, &parents, |mask| {
                self.terms[start..end].iter().for_each(|&(weight, value)| mask.group(weight, [value]));
            });
            masks.next_pass();
            start = end;
        }
    }
}
