//! Marks on vertices that cost nothing to forget.
//!
//! A search over a small part of a large mesh must not touch the rest, so it can neither clear nor allocate an array of
//! the mesh's size. A [`Scratch`] is kept by the caller and used again and again: a mark is a stamp, and starting anew is
//! taking higher stamps.
//!
//! **Deliberately not here**: what the marks mean.

use crate::id::VertexId;

/// Stamps of 4 bytes a vertex, allocated once and kept from search to search.
#[derive(Clone, Debug, Default)]
pub struct Scratch {
    stamps: Vec<u32>,
    /// All stamps so far are at most this.
    used: u32,
}

impl Scratch {
    /// An empty scratch; it grows to the mesh at its first use.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Fresh marks on `vertex_count` vertices, each of which can carry a value below `values`.
    ///
    /// O(1), but for growing to a greater number of vertices than before, and for starting over after 2³² values.
    ///
    /// # Panics
    /// If `values` is 0.
    pub fn marks(&mut self, vertex_count: usize, values: u32) -> Marks<'_> {
        assert!(values > 0, "a mark has at least one value");
        if self.stamps.len() < vertex_count {
            self.stamps.resize(vertex_count, 0);
        }
        let base = match self.used.checked_add(values) {
            Some(used) => {
                self.used = used;
                used - values + 1
            }
            None => {
                self.stamps.fill(0);
                self.used = values;
                1
            }
        };
        Marks { stamps: &mut self.stamps, base, values }
    }

    /// Bytes held.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        self.stamps.capacity() * size_of::<u32>()
    }
}

/// Marks of one search.
#[derive(Debug)]
pub struct Marks<'a> {
    stamps: &'a mut [u32],
    base: u32,
    values: u32,
}

impl Marks<'_> {
    /// Marks a vertex with a value, in place of an earlier one.
    #[inline]
    pub fn set(&mut self, v: VertexId, value: u32) {
        debug_assert!(value < self.values);
        self.stamps[v.index()] = self.base + value;
    }

    /// The value of a vertex, if it was marked.
    #[inline]
    #[must_use]
    pub fn get(&self, v: VertexId) -> Option<u32> {
        self.stamps[v.index()].checked_sub(self.base)
    }

    /// Whether a vertex was marked.
    #[inline]
    #[must_use]
    pub fn is_set(&self, v: VertexId) -> bool {
        self.stamps[v.index()] >= self.base
    }

    /// Marks a vertex with 0 and answers whether it was not marked before.
    #[inline]
    pub fn insert(&mut self, v: VertexId) -> bool {
        let fresh = !self.is_set(v);
        if fresh {
            self.set(v, 0);
        }
        fresh
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_forgotten_at_the_next_search() {
        let mut scratch = Scratch::new();
        let v = VertexId::new(1);
        let mut marks = scratch.marks(2, 3);
        assert!(marks.insert(v) && !marks.insert(v));
        marks.set(v, 2);
        assert_eq!(marks.get(v), Some(2));
        assert_eq!(scratch.marks(5, 1).get(v), None);
        let mut marks = scratch.marks(5, u32::MAX - 1);
        assert_eq!(marks.get(v), None);
        marks.set(v, 7);
        assert_eq!(scratch.marks(5, 2).get(v), None);
    }
}
