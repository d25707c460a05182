//! Sharp edges and corners.

use std::collections::BTreeMap;

use smallvec::SmallVec;

use super::{Neighborhood, Sharpness, SharpnessRule};
use crate::id::{Edge, VertexId};
use crate::rotation::RotationSystem;

/// No entry in [`Tags::slots`].
const NONE: u32 = u32::MAX;

/// Which edges and vertices are tagged sharp, and how sharp they are.
///
/// An infinitely sharp vertex is a *corner*. A boundary edge is infinitely sharp without a tag. What has a sharpness of 0
/// has no tag. Everything is O(sharp edges at the vertex), and where a sharpness is asked for, the logarithm of the number
/// of semi-sharp ones; memory is 4 bytes a vertex as soon as there is a tag, and nothing before.
#[derive(Clone, Debug, Default)]
pub struct Tags {
    /// For every vertex up to the last tagged one the place of its entry, or [`NONE`].
    slots: Vec<u32>,
    entries: Vec<Entry>,
    /// The edges and vertices with an entry that are not infinitely sharp.
    semi_sharp_edges: BTreeMap<Edge, Sharpness>,
    semi_sharp_vertices: BTreeMap<VertexId, Sharpness>,
    rule: SharpnessRule,
    /// How often something was tagged, steps apart.
    edits: u64,
}

#[derive(Clone, Debug)]
struct Entry {
    vertex: VertexId,
    sharp: SmallVec<[VertexId; 2]>,
    /// Whether the vertex itself is sharp.
    itself: bool,
}

impl Tags {
    /// Whether there is no tag at all.
    #[inline]
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The vertices to which a tagged edge leads from this one, in the order in which they were tagged.
    #[inline]
    #[must_use]
    pub fn sharp_neighbors(&self, v: VertexId) -> &[VertexId] {
        self.entry(v).map_or(&[], |entry| &entry.sharp)
    }

    /// Whether an edge is tagged with a sharpness above 0.
    #[inline]
    #[must_use]
    pub fn is_sharp(&self, edge: Edge) -> bool {
        let [a, b] = edge.ends();
        self.sharp_neighbors(a).contains(&b)
    }

    /// With what sharpness an edge is tagged.
    #[must_use]
    pub fn sharpness(&self, edge: Edge) -> Sharpness {
        if self.is_sharp(edge) { self.sharpness_of_sharp(edge) } else { Sharpness::SMOOTH }
    }

    /// The vertices to which tagged edges lead from this one, with the sharpness of the edges, as
    /// [`Tags::sharp_neighbors`].
    pub(super) fn sharp_edges_at(&self, v: VertexId) -> impl Iterator<Item = (VertexId, Sharpness)> {
        self.sharp_neighbors(v).iter().map(move |&w| (w, self.sharpness_of_sharp(Edge::new(v, w))))
    }

    fn sharpness_of_sharp(&self, edge: Edge) -> Sharpness {
        self.semi_sharp_edges.get(&edge).copied().unwrap_or(Sharpness::INFINITE)
    }

    /// Whether a vertex is tagged a corner: infinitely sharp.
    #[inline]
    #[must_use]
    pub fn is_corner(&self, v: VertexId) -> bool {
        self.entry(v).is_some_and(|entry| entry.itself) && !self.semi_sharp_vertices.contains_key(&v)
    }

    /// With what sharpness a vertex is tagged.
    #[must_use]
    pub fn vertex_sharpness(&self, v: VertexId) -> Sharpness {
        if self.entry(v).is_some_and(|entry| entry.itself) {
            return self.semi_sharp_vertices.get(&v).copied().unwrap_or(Sharpness::INFINITE);
        }
        Sharpness::SMOOTH
    }

    /// Whether an edge or a vertex is tagged with a sharpness that is not infinite. O(1).
    #[inline]
    #[must_use]
    pub fn has_semi_sharp(&self) -> bool {
        !self.semi_sharp_edges.is_empty() || !self.semi_sharp_vertices.is_empty()
    }

    /// What the halves of semi-sharp edges inherit.
    #[must_use]
    pub fn rule(&self) -> SharpnessRule {
        self.rule
    }

    /// All edges tagged with a sharpness above 0, ascending. O(n log n) in their number.
    #[must_use]
    pub fn sharp_edges(&self) -> Vec<Edge> {
        let mut edges: Vec<Edge> = self
            .entries
            .iter()
            .flat_map(|entry| entry.sharp.iter().filter(|&&w| entry.vertex < w).map(|&w| Edge::new(entry.vertex, w)))
            .collect();
        edges.sort_unstable();
        edges
    }

    /// All vertices tagged corners, ascending. O(n log n) in the number of tags.
    #[must_use]
    pub fn corners(&self) -> Vec<VertexId> {
        self.sharp_vertices().into_iter().filter(|&v| self.is_corner(v)).collect()
    }

    /// All vertices tagged with a sharpness above 0, ascending. O(n log n) in the number of tags.
    #[must_use]
    pub fn sharp_vertices(&self) -> Vec<VertexId> {
        let mut vertices: Vec<VertexId> =
            self.entries.iter().filter(|entry| entry.itself).map(|entry| entry.vertex).collect();
        vertices.sort_unstable();
        vertices
    }

    /// No tags at all, with the same rule.
    pub(crate) fn none(&self) -> Self {
        Self { rule: self.rule, ..Self::default() }
    }

    /// A number that grows whenever something is tagged or loses its tag, but not by a step.
    pub(crate) fn edits(&self) -> u64 {
        self.edits
    }

    pub(crate) fn set_rule(&mut self, rule: SharpnessRule) {
        self.edits += 1;
        self.rule = rule;
    }

    pub(crate) fn set_sharpness(&mut self, edge: Edge, sharpness: Sharpness) {
        self.edits += 1;
        let [a, b] = edge.ends();
        for (v, w) in [(a, b), (b, a)] {
            self.update(v, |entry| match entry.sharp.iter().position(|&other| other == w) {
                Some(place) if !sharpness.is_sharp() => {
                    entry.sharp.remove(place);
                }
                None if sharpness.is_sharp() => entry.sharp.push(w),
                _ => {}
            });
        }
        keep_if_semi_sharp(&mut self.semi_sharp_edges, edge, sharpness);
    }

    pub(crate) fn set_vertex_sharpness(&mut self, v: VertexId, sharpness: Sharpness) {
        self.edits += 1;
        self.update(v, |entry| entry.itself = sharpness.is_sharp());
        keep_if_semi_sharp(&mut self.semi_sharp_vertices, v, sharpness);
    }

    /// Hands the sharpness of an edge on to its halves, undiminished: `a - b` becomes `a - x - b`. Does nothing for an edge
    /// without a tag.
    pub(crate) fn split(&mut self, edge: Edge, x: VertexId) {
        if !self.is_sharp(edge) {
            return;
        }
        let [a, b] = edge.ends();
        for (v, w) in [(a, b), (b, a)] {
            self.update(v, |entry| {
                for other in entry.sharp.iter_mut().filter(|other| **other == w) {
                    *other = x;
                }
            });
        }
        self.update(x, |entry| entry.sharp.extend([a, b]));
        if let Some(sharpness) = self.semi_sharp_edges.remove(&edge) {
            self.semi_sharp_edges.extend([a, b].map(|end| (Edge::new(end, x), sharpness)));
        }
    }

    /// Goes on to the mesh after a step: the halves of split edges inherit what the [`SharpnessRule`] says, and what took
    /// part in the step has 1 less. The rings are those before the step.
    pub(crate) fn refine(
        &mut self,
        rotation: &RotationSystem,
        split: impl Iterator<Item = (VertexId, Edge)> + Clone,
        moved: impl Iterator<Item = VertexId>,
    ) {
        let edits = self.edits;
        // All is read before anything is written.
        let (mut halves, mut vertices) = (Vec::new(), Vec::new());
        if self.has_semi_sharp() {
            let around = Neighborhood::new(rotation, self);
            let semi_sharp = split.clone().filter(|(_, edge)| self.semi_sharp_edges.contains_key(edge));
            halves.extend(semi_sharp.flat_map(|(x, edge)| {
                let [a, b] = edge.ends();
                [(a, b), (b, a)].map(|(v, w)| (Edge::new(v, x), around.child_sharpness(v, w)))
            }));
            let semi_sharp = moved.filter_map(|v| self.semi_sharp_vertices.get_key_value(&v));
            vertices.extend(semi_sharp.map(|(&v, sharpness)| (v, sharpness.decayed())));
        }
        for (x, edge) in split {
            self.split(edge, x);
        }
        for (half, sharpness) in halves {
            self.set_sharpness(half, sharpness);
        }
        for (v, sharpness) in vertices {
            self.set_vertex_sharpness(v, sharpness);
        }
        self.edits = edits;
    }

    /// Hands all tags of `remove` to `keep`, after the edge between them was drawn together. Of two edges, or vertices, that
    /// become one the sharper counts.
    pub(super) fn merge(&mut self, keep: VertexId, remove: VertexId) {
        let Some(entry) = self.entry(remove).cloned() else { return };
        for w in entry.sharp {
            let old = Edge::new(remove, w);
            let sharpness = self.sharpness(old);
            self.set_sharpness(old, Sharpness::SMOOTH);
            if w != keep {
                let new = Edge::new(keep, w);
                self.set_sharpness(new, sharpness.max(self.sharpness(new)));
            }
        }
        let sharpness = self.vertex_sharpness(remove).max(self.vertex_sharpness(keep));
        self.set_vertex_sharpness(remove, Sharpness::SMOOTH);
        self.set_vertex_sharpness(keep, sharpness);
    }

    /// The same tags under other names of the vertices.
    pub(super) fn renamed(&self, name: impl Fn(VertexId) -> VertexId) -> Self {
        let mut slots = Vec::new();
        let mut entries = self.entries.clone();
        for (slot, entry) in entries.iter_mut().enumerate() {
            entry.vertex = name(entry.vertex);
            entry.sharp.iter_mut().for_each(|w| *w = name(*w));
            if slots.len() <= entry.vertex.index() {
                slots.resize(entry.vertex.index() + 1, NONE);
            }
            slots[entry.vertex.index()] = slot as u32;
        }
        let rename_edge = |(edge, &sharpness): (&Edge, &Sharpness)| {
            let [a, b] = edge.ends().map(&name);
            (Edge::new(a, b), sharpness)
        };
        Self {
            slots,
            entries,
            semi_sharp_edges: self.semi_sharp_edges.iter().map(rename_edge).collect(),
            semi_sharp_vertices: self.semi_sharp_vertices.iter().map(|(&v, &sharpness)| (name(v), sharpness)).collect(),
            rule: self.rule,
            edits: self.edits,
        }
    }

    /// Bytes held; of the maps their entries, not what lies free between them.
    pub(super) fn memory_bytes(&self) -> usize {
        self.slots.capacity() * size_of::<u32>()
            + self.entries.capacity() * size_of::<Entry>()
            + self.semi_sharp_edges.len() * size_of::<(Edge, Sharpness)>()
            + self.semi_sharp_vertices.len() * size_of::<(VertexId, Sharpness)>()
    }

    #[inline]
    fn entry(&self, v: VertexId) -> Option<&Entry> {
        let slot = *self.slots.get(v.index())?;
        (slot != NONE).then(|| &self.entries[slot as usize])
    }

    /// Changes the entry of a vertex, which is made if there is none and dropped if nothing is left in it.
    fn update(&mut self, v: VertexId, change: impl FnOnce(&mut Entry)) {
        if self.slots.len() <= v.index() {
            self.slots.resize(v.index() + 1, NONE);
        }
        if self.slots[v.index()] == NONE {
            self.slots[v.index()] = self.entries.len() as u32;
            self.entries.push(Entry { vertex: v, sharp: SmallVec::new(), itself: false });
        }
        let slot = self.slots[v.index()] as usize;
        change(&mut self.entries[slot]);
        if self.entries[slot].sharp.is_empty() && !self.entries[slot].itself {
            self.entries.swap_remove(slot);
            self.slots[v.index()] = NONE;
            if let Some(moved) = self.entries.get(slot) {
                self.slots[moved.vertex.index()] = slot as u32;
            }
        }
    }
}

/// Writes a sharpness down where it is neither of the two that need no number.
fn keep_if_semi_sharp<K: Ord>(map: &mut BTreeMap<K, Sharpness>, key: K, sharpness: Sharpness) {
    if sharpness.is_semi_sharp() {
        map.insert(key, sharpness);
    } else {
        map.remove(&key);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_are_symmetric_and_can_be_taken_off() {
        let [a, b, c, x] = [3, 0, 7, 9].map(VertexId::new);
        let mut tags = Tags::default();
        for (p, q) in [(a, b), (a, c), (a, c)] {
            tags.set_sharpness(Edge::new(p, q), Sharpness::INFINITE);
        }
        tags.set_vertex_sharpness(b, Sharpness::INFINITE);
        assert_eq!(tags.sharp_neighbors(a), [b, c]);
        assert_eq!(tags.sharp_edges(), [Edge::new(b, a), Edge::new(a, c)]);
        tags.split(Edge::new(a, b), x);
        assert_eq!((tags.sharp_neighbors(a), tags.sharp_neighbors(b)), ([x, c].as_slice(), [x].as_slice()));
        assert!(tags.is_sharp(Edge::new(x, b)) && !tags.is_sharp(Edge::new(a, b)));
        for (p, q) in [(a, x), (x, b), (a, c)] {
            tags.set_sharpness(Edge::new(p, q), Sharpness::SMOOTH);
        }
        assert_eq!((tags.sharp_edges(), tags.corners()), (vec![], vec![b]));
        tags.set_vertex_sharpness(b, Sharpness::SMOOTH);
        assert!(tags.is_empty());
    }

    #[test]
    fn a_finite_sharpness_is_kept_until_it_is_set_split_or_merged() {
        let [a, b, c, x] = [0, 1, 2, 3].map(VertexId::new);
        let [low, high] = [0.25, 3.5].map(|value| Sharpness::new(value).expect("a sharpness"));
        let mut tags = Tags::default();
        tags.set_sharpness(Edge::new(a, b), low);
        tags.set_sharpness(Edge::new(b, c), high);
        tags.set_vertex_sharpness(c, high);
        assert!(tags.has_semi_sharp() && tags.is_sharp(Edge::new(a, b)) && !tags.is_corner(c));
        assert_eq!((tags.corners(), tags.sharp_vertices(), tags.vertex_sharpness(c)), (vec![], vec![c], high));
        tags.split(Edge::new(a, b), x);
        let found = [(a, b), (a, x), (x, b), (b, c), (a, c)].map(|(v, w)| tags.sharpness(Edge::new(v, w)));
        assert_eq!(found, [Sharpness::SMOOTH, low, low, high, Sharpness::SMOOTH]);
        // Drawn together with x, c has edges to b twice, and to nobody else.
        tags.merge(x, c);
        assert_eq!((tags.sharpness(Edge::new(x, b)), tags.vertex_sharpness(x)), (high, high));
        assert_eq!((tags.sharp_neighbors(c), tags.vertex_sharpness(c)), ([].as_slice(), Sharpness::SMOOTH));
        tags.set_sharpness(Edge::new(a, x), Sharpness::INFINITE);
        tags.set_sharpness(Edge::new(x, b), Sharpness::SMOOTH);
        tags.set_vertex_sharpness(x, Sharpness::INFINITE);
        assert!(!tags.has_semi_sharp() && tags.is_corner(x));
        assert_eq!(tags.sharp_edges(), [Edge::new(a, x)]);
    }
}
