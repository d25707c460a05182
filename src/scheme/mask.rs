//! The weights of one new position.

use crate::id::VertexId;

/// What takes a mask group by group: a [`Mask`] keeps it, the pipeline applies it to positions as it comes.
///
/// The order of the groups, and of the vertices in a group, is part of the mask: a group is summed first, from its first
/// vertex on, then scaled, and the groups are added in order. So equal masks give equal bits.
pub trait MaskSink {
    /// Adds `weight` times the sum of these vertices. A vertex may come more than once.
    fn group(&mut self, weight: f64, vertices: impl IntoIterator<Item = VertexId>);
}

/// A mask as data: groups of vertices, each with one weight.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Mask {
    groups: Vec<(f64, Vec<VertexId>)>,
}

impl Mask {
    /// The groups in their order.
    #[must_use]
    pub fn groups(&self) -> &[(f64, Vec<VertexId>)] {
        &self.groups
    }

    /// The sum of all weights.
    #[must_use]
    pub fn sum(&self) -> f64 {
        self.groups.iter().map(|(weight, vertices)| weight * vertices.len() as f64).sum()
    }

    /// The weight of one vertex, over all groups.
    #[must_use]
    pub fn weight_of(&self, v: VertexId) -> f64 {
        let times = |vertices: &[VertexId]| vertices.iter().filter(|&&w| w == v).count() as f64;
        self.groups.iter().map(|(weight, vertices)| weight * times(vertices)).sum()
    }
}

impl MaskSink for Mask {
    fn group(&mut self, weight: f64, vertices: impl IntoIterator<Item = VertexId>) {
        self.groups.push((weight, vertices.into_iter().collect()));
    }
}
