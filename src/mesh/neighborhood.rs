//! What a scheme may see of a mesh: rings and tags around one place.

use smallvec::SmallVec;

use super::{Sharpness, SharpnessRule, Tags};
use crate::id::{Edge, VertexId};
use crate::rotation::{Hubs, Regular, Ring, RotationSystem};

/// How sharp the surroundings of a vertex are, by the number of sharp edges at it, boundary edges counted; those that are
/// semi-sharp count like any other.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum VertexClass {
    /// No sharp edge.
    Smooth,
    /// One sharp edge: the end of a crease.
    Dart,
    /// Two sharp edges.
    Crease,
    /// Three or more sharp edges, or tagged a corner, infinitely sharp itself.
    Corner,
}

/// A read-only view of rings and tags, without positions.
#[derive(Clone, Copy, Debug)]
pub struct Neighborhood<'a> {
    rotation: &'a RotationSystem,
    tags: &'a Tags,
    hubs: Option<&'a Hubs>,
}

impl<'a> Neighborhood<'a> {
    pub(crate) fn new(rotation: &'a RotationSystem, tags: &'a Tags) -> Self {
        Self { rotation, tags, hubs: None }
    }

    /// The same, with help for very long rings.
    pub(crate) fn with_hubs(self, hubs: &'a Hubs) -> Self {
        Self { hubs: Some(hubs), ..self }
    }

    /// The slot of a neighbour in the ring of a vertex, or `None` if it is none. O(valence), and while a step is made
    /// O(log valence) in very long rings.
    #[inline]
    #[must_use]
    pub fn slot_of(&self, v: VertexId, neighbor: VertexId) -> Option<usize> {
        match self.hubs {
            Some(hubs) => hubs.slot(self.rotation, v, neighbor),
            None => self.ring(v).slot_of(neighbor),
        }
    }

    /// The ring of a vertex if it is regular and off the boundary. One that was longer before may be left out.
    #[inline]
    pub(crate) fn regular_ring(&self, v: VertexId) -> Option<Regular<'a>> {
        self.rotation.regular(v)
    }

    /// Whether nothing is tagged in the whole mesh.
    #[inline]
    pub(crate) fn has_no_tags(&self) -> bool {
        self.tags.is_empty()
    }

    /// The ring of a vertex.
    #[inline]
    #[must_use]
    pub fn ring(&self, v: VertexId) -> Ring<'a> {
        self.rotation.ring(v)
    }

    /// Whether an edge between two neighbours is sharp: tagged, or on a boundary. O(valence).
    #[inline]
    #[must_use]
    pub fn is_sharp(&self, a: VertexId, b: VertexId) -> bool {
        self.tags.is_sharp(Edge::new(a, b)) || self.rotation.is_boundary_edge(a, b)
    }

    /// Whether an edge is tagged sharp; one on a boundary is sharp without a tag. O(tagged edges at `a`), and a test of a
    /// length where nothing is tagged.
    #[inline]
    #[must_use]
    pub fn is_tagged(&self, a: VertexId, b: VertexId) -> bool {
        !self.tags.is_empty() && self.tags.is_sharp(Edge::new(a, b))
    }

    /// How sharp an edge between two neighbours is; infinitely, whatever its tag, on a boundary.
    #[must_use]
    pub fn sharpness(&self, a: VertexId, b: VertexId) -> Sharpness {
        if self.rotation.is_boundary_edge(a, b) { Sharpness::INFINITE } else { self.tags.sharpness(Edge::new(a, b)) }
    }

    /// How sharp a vertex is itself, whatever its edges are.
    #[inline]
    #[must_use]
    pub fn vertex_sharpness(&self, v: VertexId) -> Sharpness {
        self.tags.vertex_sharpness(v)
    }

    /// How sharp the half at `v` of an edge to a neighbour `w` will be after a step that splits all edges at `v`, as the
    /// mesh's [`SharpnessRule`] has it. O(sharp edges at `v`), as the next two.
    #[must_use]
    pub fn child_sharpness(&self, v: VertexId, w: VertexId) -> Sharpness {
        let others = self.tagged_edges(v).filter(|&(u, _)| u != w).map(|(_, sharpness)| sharpness);
        self.tags.rule().child(self.sharpness(v, w), others)
    }

    /// Whether the halves of an edge inherit from other edges at its ends too.
    pub(crate) fn averages_sharpness(&self, a: VertexId, b: VertexId) -> bool {
        self.tags.rule() == SharpnessRule::Chaikin && self.tags.has_semi_sharp() && self.sharpness(a, b).is_semi_sharp()
    }

    /// Whether a vertex or an edge at it is semi-sharp: what the rules make of the vertex changes from step to step. Where
    /// nothing is semi-sharp, a test of two lengths.
    #[inline]
    #[must_use]
    pub fn is_semi_sharp(&self, v: VertexId) -> bool {
        // A copy goes to the rare search, so that the view itself can stay in registers.
        self.tags.has_semi_sharp() && Self::search_semi_sharp(*self, v)
    }

    #[inline(never)]
    fn search_semi_sharp(self, v: VertexId) -> bool {
        self.semi_sharp_steps(v) > 0
    }

    /// After how many steps, all around the vertex, neither it nor an edge at it is semi-sharp; 0 if none is now. With
    /// [`SharpnessRule::Chaikin`] it may be fewer.
    #[must_use]
    pub fn semi_sharp_steps(&self, v: VertexId) -> u32 {
        let edges = self.tagged_edges(v).map(|(_, sharpness)| sharpness);
        let semi_sharp = edges.chain([self.vertex_sharpness(v)]).filter(|sharpness| sharpness.is_semi_sharp());
        semi_sharp.map(Sharpness::steps).max().unwrap_or(0)
    }

    /// The tagged edges at a vertex by their other ends, with how sharp they are.
    fn tagged_edges(&self, v: VertexId) -> impl Iterator<Item = (VertexId, Sharpness)> {
        self.tags.sharp_edges_at(v).map(move |(w, sharpness)| {
            (w, if self.rotation.is_boundary_edge(v, w) { Sharpness::INFINITE } else { sharpness })
        })
    }

    /// The class of a vertex. O(sharp edges at it).
    #[inline]
    #[must_use]
    pub fn class(&self, v: VertexId) -> VertexClass {
        if !self.tags.is_empty() {
            return Self::class_by_tags(*self, v);
        }
        if self.rotation.ring(v).is_open() { VertexClass::Crease } else { VertexClass::Smooth }
    }

    #[inline(never)]
    fn class_by_tags(self, v: VertexId) -> VertexClass {
        if self.tags.is_corner(v) {
            return VertexClass::Corner;
        }
        let tagged = self.tags.sharp_neighbors(v);
        let sharp = if self.rotation.ring(v).is_open() {
            let on_boundary = |w: &&VertexId| self.rotation.is_boundary_edge(v, **w);
            2 + tagged.len() - tagged.iter().filter(on_boundary).count()
        } else {
            tagged.len()
        };
        match sharp {
            0 => VertexClass::Smooth,
            1 => VertexClass::Dart,
            2 => VertexClass::Crease,
            _ => VertexClass::Corner,
        }
    }

    /// The slots in the ring of a vertex to which sharp edges lead, ascending; empty for a smooth vertex.
    /// O(valence), times the logarithm of the tagged edges at the vertex.
    #[must_use]
    pub fn sharp_slots(&self, v: VertexId) -> impl ExactSizeIterator<Item = usize> + Clone + use<> {
        let ring = self.rotation.ring(v);
        let mut tagged: SmallVec<[VertexId; 8]> = SmallVec::from_slice(self.tags.sharp_neighbors(v));
        tagged.sort_unstable();
        let last = ring.valence().saturating_sub(1);
        let slots: SmallVec<[usize; 4]> = ring
            .iter()
            .enumerate()
            .filter(|(slot, w)| (ring.is_open() && (*slot == 0 || *slot == last)) || tagged.binary_search(w).is_ok())
            .map(|(slot, _)| slot)
            .collect();
        slots.into_iter()
    }
}
