//! Sharp edges and corners.

use smallvec::SmallVec;

use crate::id::{Edge, VertexId};

/// No entry in [`Tags::slots`].
const NONE: u32 = u32::MAX;

/// Which edges are tagged sharp and which vertices are tagged corners.
///
/// A boundary edge is sharp without a tag. Everything is O(sharp edges at the vertex); memory is 4 bytes a vertex as soon
/// as there is a tag, and nothing before.
#[derive(Clone, Debug, Default)]
pub struct Tags {
    /// For every vertex up to the last tagged one the place of its entry, or [`NONE`].
    slots: Vec<u32>,
    entries: Vec<Entry>,
}

#[derive(Clone, Debug)]
struct Entry {
    vertex: VertexId,
    sharp: SmallVec<[VertexId; 2]>,
    corner: bool,
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

    /// Whether an edge is tagged sharp.
    #[inline]
    #[must_use]
    pub fn is_sharp(&self, edge: Edge) -> bool {
        let [a, b] = edge.ends();
        self.sharp_neighbors(a).contains(&b)
    }

    /// Whether a vertex is tagged a corner.
    #[inline]
    #[must_use]
    pub fn is_corner(&self, v: VertexId) -> bool {
        self.entry(v).is_some_and(|entry| entry.corner)
    }

    /// All edges tagged sharp, ascending. O(n log n) in their number.
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
        let mut corners: Vec<VertexId> =
            self.entries.iter().filter(|entry| entry.corner).map(|entry| entry.vertex).collect();
        corners.sort_unstable();
        corners
    }

    pub(crate) fn set_sharp(&mut self, edge: Edge, sharp: bool) {
        let [a, b] = edge.ends();
        for (v, w) in [(a, b), (b, a)] {
            self.update(v, |entry| {
                entry.sharp.retain(|&mut other| other != w);
                if sharp {
                    entry.sharp.push(w);
                }
            });
        }
    }

    pub(crate) fn set_corner(&mut self, v: VertexId, corner: bool) {
        self.update(v, |entry| entry.corner = corner);
    }

    /// Hands a sharp edge down to its halves: `a - b` becomes `a - x - b`. Does nothing for an edge without a tag.
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
    }

    /// Hands all tags of `remove` to `keep`, after the edge between them was drawn together.
    pub(crate) fn merge(&mut self, keep: VertexId, remove: VertexId) {
        let Some(entry) = self.entry(remove).cloned() else { return };
        for w in entry.sharp {
            self.set_sharp(Edge::new(remove, w), false);
            if w != keep {
                self.set_sharp(Edge::new(keep, w), true);
            }
        }
        if entry.corner {
            self.set_corner(remove, false);
            self.set_corner(keep, true);
        }
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
        Self { slots, entries }
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        self.slots.capacity() * size_of::<u32>() + self.entries.capacity() * size_of::<Entry>()
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
            self.entries.push(Entry { vertex: v, sharp: SmallVec::new(), corner: false });
        }
        let slot = self.slots[v.index()] as usize;
        change(&mut self.entries[slot]);
        if self.entries[slot].sharp.is_empty() && !self.entries[slot].corner {
            self.entries.swap_remove(slot);
            self.slots[v.index()] = NONE;
            if let Some(moved) = self.entries.get(slot) {
                self.slots[moved.vertex.index()] = slot as u32;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tags_are_symmetric_and_can_be_taken_off() {
        let [a, b, c, x] = [3, 0, 7, 9].map(VertexId::new);
        let mut tags = Tags::default();
        tags.set_sharp(Edge::new(a, b), true);
        tags.set_sharp(Edge::new(a, c), true);
        tags.set_sharp(Edge::new(a, c), true);
        tags.set_corner(b, true);
        assert_eq!(tags.sharp_neighbors(a), [b, c]);
        assert_eq!(tags.sharp_edges(), [Edge::new(b, a), Edge::new(a, c)]);
        tags.split(Edge::new(a, b), x);
        assert_eq!((tags.sharp_neighbors(a), tags.sharp_neighbors(b)), ([x, c].as_slice(), [x].as_slice()));
        assert!(tags.is_sharp(Edge::new(x, b)) && !tags.is_sharp(Edge::new(a, b)));
        for (p, q) in [(a, x), (x, b), (a, c)] {
            tags.set_sharp(Edge::new(p, q), false);
        }
        assert_eq!((tags.sharp_edges(), tags.corners()), (vec![], vec![b]));
        tags.set_corner(b, false);
        assert!(tags.is_empty());
    }
}
