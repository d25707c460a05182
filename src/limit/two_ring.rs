//! Rows of weights on the surroundings of a vertex after one step, told in those before it.
//!
//! After a step all neighbours of a vertex are regular, so the masks next to it no longer depend on what lies around: the
//! matrix of the step is the same for all vertices of a kind, and its eigenvectors are known. They reach two rings: the new
//! neighbours (*spokes*), the new vertices on the edges opposite (*rims*), the old neighbours (*far*).

use smallvec::SmallVec;

use crate::id::VertexId;
use crate::mesh::{Neighborhood, Sector};
use crate::scheme::{MaskSink, Scheme};
use crate::step::Parent;

/// A vertex with its neighbours in order, all of them or those of a sector, under a scheme that moves no even vertex.
pub(super) struct TwoRing<'a, S> {
    scheme: S,
    around: Neighborhood<'a>,
    v: VertexId,
    neighbors: SmallVec<[VertexId; 8]>,
}

impl<'a, S: Scheme> TwoRing<'a, S> {
    /// All neighbours, from a slot on.
    pub(super) fn whole(scheme: S, around: Neighborhood<'a>, v: VertexId, slot: usize) -> Self {
        let (before, after) = around.ring(v).neighbors().split_at(slot);
        let neighbors = after.iter().chain(before).copied().collect();
        Self { scheme, around, v, neighbors }
    }

    /// The neighbours in a sector.
    pub(super) fn sector(scheme: S, around: Neighborhood<'a>, v: VertexId, sector: Sector<'_>) -> Self {
        Self { scheme, around, v, neighbors: sector.neighbors().collect() }
    }

    /// How many neighbours there are.
    pub(super) fn len(&self) -> usize {
        self.neighbors.len()
    }

    /// Begins a row.
    pub(super) fn row<'b, M: MaskSink>(&'b self, mask: &'b mut M) -> Row<'b, 'a, S, M> {
        Row { at: self, mask, sum: 0.0 }
    }

    fn neighbor(&self, j: usize) -> VertexId {
        self.neighbors[j % self.neighbors.len()]
    }
}

/// A row whose weights add to 0 in the end.
pub(super) struct Row<'b, 'a, S, M> {
    at: &'b TwoRing<'a, S>,
    mask: &'b mut M,
    sum: f64,
}

impl<S: Scheme, M: MaskSink> Row<'_, '_, S, M> {
    /// Weighs the new vertex on the edge to neighbour `j`.
    pub(super) fn spoke(&mut self, j: usize, weight: f64) {
        self.odd(self.at.v, self.at.neighbor(j), weight);
    }

    /// Weighs the new vertex on the edge from neighbour `j` to the one after it.
    pub(super) fn rim(&mut self, j: usize, weight: f64) {
        self.odd(self.at.neighbor(j), self.at.neighbor(j + 1), weight);
    }

    /// Weighs neighbour `j` itself.
    pub(super) fn far(&mut self, j: usize, weight: f64) {
        self.sum += weight;
        self.mask.group(weight, [self.at.neighbor(j)]);
    }

    /// Gives the vertex what lacks to 0.
    pub(super) fn finish(self) {
        self.mask.group(-self.sum, [self.at.v]);
    }

    fn odd(&mut self, p: VertexId, q: VertexId, weight: f64) {
        self.sum += weight;
        let around = self.at.around;
        let slot = around.slot_of(p, q).expect("the ends of an edge are neighbours");
        let [left, right] = around.ring(p).corners_at(slot);
        self.at.scheme.odd(around, &Parent { p, q, left, right }, &mut Scaled { weight, mask: &mut *self.mask });
    }
}

/// Hands a mask on, all weights multiplied.
struct Scaled<'a, M> {
    weight: f64,
    mask: &'a mut M,
}

impl<M: MaskSink> MaskSink for Scaled<'_, M> {
    fn group(&mut self, weight: f64, vertices: impl IntoIterator<Item = VertexId>) {
        self.mask.group(self.weight * weight, vertices);
    }
}
