//! The points that adaptive √3 keeps of every vertex, while a step is made.
//!
//! Each is made by a mask of points that were made before it. If somebody follows the step, the masks are written down and
//! shown when the step is sure to be made, one a pass.
//!
//! **Deliberately not here**: the masks; see [`super::closed_form`].

use glam::DVec3;

use crate::id::VertexId;
use crate::scheme::{Mask, MaskSink};
use crate::step::{Lineage, Motion, Motions, Weights};
use crate::subdivide::ValueId;
use crate::subdivide::follow::MaskWriter;

/// The motions of all vertices, and what this step adds to them.
pub(super) struct Points {
    pub(super) motions: Motions,
    mask: Mask<ValueId>,
    /// If somebody follows.
    script: Option<Script>,
}

impl Points {
    pub(super) fn new(motions: Motions, is_followed: bool) -> Self {
        Self { motions, mask: Mask::default(), script: is_followed.then(Script::default) }
    }

    /// Appends an input vertex, born where it is shown.
    pub(super) fn push_input(&mut self, v: VertexId, position: DVec3) {
        self.motions.push(Motion::Open);
        self.motions.set_point(v, Motion::BIRTH, position);
        self.mask.clear();
        self.mask.group(1.0, [ValueId::Shown(v)]);
        self.write_down(ValueId::Kept(v, Motion::BIRTH), None);
    }

    /// Makes a point of others.
    pub(super) fn make(&mut self, v: VertexId, number: u8, write: impl FnOnce(&Motions, &mut Mask<ValueId>)) -> DVec3 {
        let point = self.apply(write);
        self.motions.set_point(v, number, point);
        self.write_down(ValueId::Kept(v, number), None);
        point
    }

    /// Where a vertex is to be shown: at a level, and if it is new, with what it was made of.
    pub(super) fn show(&mut self, v: VertexId, level: u8, lineage: Option<Lineage>) -> DVec3 {
        let position = self.apply(|motions, mask| add(mask, 1.0, v, motions.at(v, level)));
        self.write_down(ValueId::Shown(v), lineage);
        position
    }

    /// What was made in this step, in order; nothing if nobody follows.
    pub(super) fn script(&self) -> &Script {
        const EMPTY: &Script = &Script { made: Vec::new(), groups: Vec::new(), values: Vec::new() };
        self.script.as_ref().unwrap_or(EMPTY)
    }

    fn apply(&mut self, write: impl FnOnce(&Motions, &mut Mask<ValueId>)) -> DVec3 {
        let Self { motions, mask, .. } = self;
        mask.clear();
        write(motions, mask);
        mask.apply(|id| match id {
            ValueId::Kept(v, number) => motions.point(v, number),
            ValueId::Shown(_) => unreachable!("points are made of points"),
        })
    }

    fn write_down(&mut self, id: ValueId, lineage: Option<Lineage>) {
        if let Some(script) = &mut self.script {
            script.push(id, lineage, &self.mask);
        }
    }
}

/// Adds to a mask `scale` times where a vertex or a neighbour of it is.
pub(super) fn add(mask: &mut Mask<ValueId>, scale: f64, v: VertexId, weights: Weights) {
    for (number, weight) in (0..).zip(weights).filter(|(_, weight)| *weight != 0.0) {
        mask.group(scale * weight, [ValueId::Kept(v, number)]);
    }
}

/// Masks in the order in which they were applied.
#[derive(Default)]
pub(super) struct Script {
    /// What was made, if it is a new vertex of what, and of how many groups.
    made: Vec<(ValueId, Option<Lineage>, usize)>,
    /// The weight of each group, and of how many values.
    groups: Vec<(f64, usize)>,
    values: Vec<ValueId>,
}

impl Script {
    fn push(&mut self, id: ValueId, lineage: Option<Lineage>, mask: &Mask<ValueId>) {
        self.made.push((id, lineage, mask.groups().len()));
        for (weight, values) in mask.groups() {
            self.groups.push((*weight, values.len()));
            self.values.extend_from_slice(values);
        }
    }

    /// Shows the masks, each in a pass of its own.
    pub(super) fn play(&self, masks: &mut MaskWriter<'_>) {
        let (mut groups, mut values) = (self.groups.iter(), self.values.iter().copied());
        for &(id, lineage, group_count) in &self.made {
            let parents: Vec<VertexId> = lineage.iter().flat_map(Lineage::vertices).collect();
            masks.assign_value(id, &parents, |mask| {
                for &(weight, value_count) in groups.by_ref().take(group_count) {
                    mask.group(weight, values.by_ref().take(value_count));
                }
            });
            masks.next_pass();
        }
    }
}
