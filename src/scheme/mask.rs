//! The weights of one new position.

use std::ops::{Add, Mul};

use crate::id::VertexId;

/// What takes a mask group by group: a [`Mask`] keeps it, the pipeline applies it to positions as it comes.
///
/// The order of the groups, and of the vertices in a group, is part of the mask: a group is summed first, from its first
/// vertex on, then scaled, and the groups are added in order. So equal masks give equal bits.
///
/// Schemes name vertices. A step also weighs values that it keeps beside those of the vertices, under names of type `V`.
pub trait MaskSink<V = VertexId> {
    /// Adds `weight` times the sum of these vertices. A vertex may come more than once.
    fn group(&mut self, weight: f64, vertices: impl IntoIterator<Item = V>);
}

/// A mask as data: groups of vertices, or of whatever `V` names, each with one weight.
#[derive(Clone, Debug)]
pub struct Mask<V = VertexId> {
    groups: Vec<(f64, Vec<V>)>,
    /// The lists of groups that were cleared, for their memory.
    spare: Vec<Vec<V>>,
}

impl<V> Default for Mask<V> {
    fn default() -> Self {
        Self { groups: Vec::new(), spare: Vec::new() }
    }
}

impl<V: Copy + PartialEq> Mask<V> {
    /// The groups in their order.
    #[must_use]
    pub fn groups(&self) -> &[(f64, Vec<V>)] {
        &self.groups
    }

    /// The sum of all weights.
    #[must_use]
    pub fn sum(&self) -> f64 {
        self.groups.iter().map(|(weight, vertices)| weight * vertices.len() as f64).sum()
    }

    /// The weight of one vertex, over all groups.
    #[must_use]
    pub fn weight_of(&self, v: V) -> f64 {
        let times = |vertices: &[V]| vertices.iter().filter(|&&w| w == v).count() as f64;
        self.groups.iter().map(|(weight, vertices)| weight * times(vertices)).sum()
    }

    /// The mask applied to values of vertices, added in the order of the pipeline: positions come out with the bits that a
    /// step gives them. Zero for an empty mask.
    ///
    /// ```
    /// use vvmesh::{VertexId, scheme::{Mask, MaskSink}};
    /// let mut mask = Mask::default();
    /// mask.group(0.5, [VertexId::new(1), VertexId::new(3)]);
    /// assert_eq!(mask.apply(|v| v.index() as f64), 2.0);
    /// ```
    pub fn apply<T>(&self, value: impl Fn(V) -> T) -> T
    where
        T: Copy + Default + Add<Output = T>,
        f64: Mul<T, Output = T>,
    {
        let mut sum = WeightedSum::new(value);
        for (weight, vertices) in &self.groups {
            sum.group(*weight, vertices.iter().copied());
        }
        sum.total().unwrap_or_default()
    }

    /// Takes all groups out; their memory is used again.
    pub fn clear(&mut self) {
        for (_, mut vertices) in self.groups.drain(..) {
            vertices.clear();
            self.spare.push(vertices);
        }
    }
}

impl<V: PartialEq> PartialEq for Mask<V> {
    fn eq(&self, other: &Self) -> bool {
        self.groups == other.groups
    }
}

impl<V> MaskSink<V> for Mask<V> {
    fn group(&mut self, weight: f64, vertices: impl IntoIterator<Item = V>) {
        let mut list = self.spare.pop().unwrap_or_default();
        list.extend(vertices);
        self.groups.push((weight, list));
    }
}

/// A mask applied to values as it comes, group by group.
pub(crate) struct WeightedSum<T, F> {
    value: F,
    /// `None` before the first group, as 0 + (-0) is not -0.
    total: Option<T>,
}

impl<T, F> WeightedSum<T, F> {
    #[inline]
    pub(crate) fn new(value: F) -> Self {
        Self { value, total: None }
    }

    /// The sum; `None` of an empty mask.
    #[inline]
    pub(crate) fn total(self) -> Option<T> {
        self.total
    }
}

impl<V, T, F> MaskSink<V> for WeightedSum<T, F>
where
    F: Fn(V) -> T,
    T: Copy + Add<Output = T>,
    f64: Mul<T, Output = T>,
{
    #[inline]
    fn group(&mut self, weight: f64, vertices: impl IntoIterator<Item = V>) {
        // With a reference to the function instead, ids go through memory and are read back in wider pieces than they were
        // written in, for which the processor waits: a third more time for a step of midpoint.
        let group = vertices.into_iter().map(|v| (self.value)(v)).reduce(|sum, value| sum + value);
        if let Some(group) = group {
            let group = weight * group;
            self.total = Some(self.total.map_or(group, |total| total + group));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cleared_mask_is_an_empty_one() {
        let v = VertexId::new;
        let mut mask = Mask::default();
        mask.group(0.25, [v(0), v(1)]);
        mask.clear();
        assert_eq!((&mask, mask.apply(|_| 1.0)), (&Mask::default(), 0.0));
        mask.group(-1.0, [v(2)]);
        assert_eq!(mask.groups(), [(-1.0, vec![v(2)])]);
        // Of -0 alone, which 0 + (-0) is not.
        assert!(mask.apply(|_| 0.0).is_sign_negative());
    }
}
