//! Memory that is used again: marks on vertices that cost nothing to forget, and buffers.
//!
//! A search over a small part of a large mesh must not touch the rest, so it can neither clear nor allocate an array of
//! the mesh's size. A [`Scratch`] is kept by the caller and used again and again: a mark is a stamp, and starting anew is
//! taking higher stamps. What else a step needs it takes from there and gives back.
//!
//! **Deliberately not here**: what marks and buffers mean.

use std::any::Any;
use std::fmt;

use crate::id::VertexId;

/// So many lists are kept; a step takes four.
const LISTS: usize = 8;

/// Stamps of 4 bytes a vertex and some buffers, allocated once and kept from search to search and from step to step.
#[derive(Default)]
pub struct Scratch {
    stamps: Vec<u32>,
    /// All stamps so far are at most this.
    used: u32,
    lists: Vec<Vec<VertexId>>,
    /// At most one of each type.
    buffers: Vec<Box<dyn Any + Send + Sync>>,
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

    /// Marks of one value on these vertices of a mesh with this many. O(marked vertices), as for [`Scratch::marks`].
    pub(crate) fn marked(&mut self, vertex_count: usize, vertices: &[VertexId]) -> Marks<'_> {
        let mut marks = self.marks(vertex_count, 1);
        for &v in vertices {
            marks.set(v, 0);
        }
        marks
    }

    /// An empty list, in memory that was given back if there is any.
    #[must_use]
    pub fn take_list(&mut self) -> Vec<VertexId> {
        self.lists.pop().unwrap_or_default()
    }

    /// Gives the memory of a list back, to be kept unless there is much already.
    pub fn give_list(&mut self, mut list: Vec<VertexId>) {
        if list.capacity() > 0 && self.lists.len() < LISTS {
            list.clear();
            self.lists.push(list);
        }
    }

    /// The buffer of a type, as it was given back.
    pub(crate) fn take<T: Any + Default + Send + Sync>(&mut self) -> Box<T> {
        let place = self.buffers.iter().position(|buffer| (**buffer).is::<T>());
        let found = place.map(|place| self.buffers.swap_remove(place).downcast());
        found.and_then(Result::ok).unwrap_or_default()
    }

    /// Gives the buffer of a type back.
    pub(crate) fn give<T: Any + Send + Sync>(&mut self, buffer: Box<T>) {
        self.buffers.push(buffer);
    }

    /// Bytes held by stamps and lists.
    #[must_use]
    pub fn memory_bytes(&self) -> usize {
        let lists: usize = self.lists.iter().map(Vec::capacity).sum();
        self.stamps.capacity() * size_of::<u32>() + lists * size_of::<VertexId>()
    }
}

impl fmt::Debug for Scratch {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Scratch").field("memory_bytes", &self.memory_bytes()).finish_non_exhaustive()
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
    fn memory_is_given_back_and_taken_again() {
        let mut scratch = Scratch::new();
        let mut list = scratch.take_list();
        list.push(VertexId::new(3));
        let memory = list.as_ptr();
        scratch.give_list(list);
        let list = scratch.take_list();
        assert_eq!((list.len(), list.as_ptr()), (0, memory));
        for _ in 0..2 * LISTS {
            scratch.give_list(vec![VertexId::new(0)]);
        }
        assert_eq!(scratch.memory_bytes(), LISTS * size_of::<VertexId>());
        let mut numbers: Box<Vec<u8>> = scratch.take();
        numbers.push(7);
        scratch.give(numbers);
        assert_eq!(*scratch.take::<Vec<u16>>(), []);
        assert_eq!(*scratch.take::<Vec<u8>>(), [7]);
        assert_eq!(*scratch.take::<Vec<u8>>(), []);
    }

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
