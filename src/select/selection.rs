//! A set of vertices.

use crate::id::VertexId;
use crate::parallel;

/// A set of vertices, kept ascending.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Selection {
    vertices: Vec<VertexId>,
}

impl Selection {
    /// The empty set.
    #[must_use]
    pub fn empty() -> Self {
        Self::default()
    }

    /// All vertices of a mesh with this many.
    #[must_use]
    pub fn all(vertex_count: usize) -> Self {
        Self { vertices: (0..vertex_count).map(VertexId::new).collect() }
    }

    /// These vertices, which come ascending, each once.
    pub(crate) fn ascending(vertices: Vec<VertexId>) -> Self {
        debug_assert!(vertices.is_sorted_by(|a, b| a < b));
        Self { vertices }
    }

    /// The vertices, ascending, as the list itself.
    #[must_use]
    pub fn into_vertices(self) -> Vec<VertexId> {
        self.vertices
    }

    /// Those of a mesh with this many vertices that pass a test.
    pub(super) fn of_those(vertex_count: usize, test: impl Fn(VertexId) -> bool + Sync + Send) -> Self {
        let passing = |v: usize| Some(VertexId::new(v)).filter(|&v| test(v));
        Self { vertices: parallel::gather(0..vertex_count, passing) }
    }

    /// The vertices, ascending.
    #[must_use]
    pub fn vertices(&self) -> &[VertexId] {
        &self.vertices
    }

    /// How many vertices there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.vertices.len()
    }

    /// Whether there is none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.vertices.is_empty()
    }

    /// Whether a vertex is in the set. O(log n).
    #[must_use]
    pub fn contains(&self, v: VertexId) -> bool {
        self.vertices.binary_search(&v).is_ok()
    }

    /// What is in one of the two. O(n).
    #[must_use]
    pub fn union(&self, other: &Self) -> Self {
        let mut vertices = [self.vertices.as_slice(), &other.vertices].concat();
        // The stable sort finds the two runs and merges them.
        vertices.sort();
        vertices.dedup();
        Self { vertices }
    }

    /// What is in both. O(n log m) with n vertices in the smaller set and m in the other.
    #[must_use]
    pub fn intersection(&self, other: &Self) -> Self {
        let (small, large) = if self.len() <= other.len() { (self, other) } else { (other, self) };
        Self { vertices: small.vertices.iter().copied().filter(|&v| large.contains(v)).collect() }
    }

    /// What a mesh with this many vertices has outside of the set. O(vertices).
    #[must_use]
    pub fn complement(&self, vertex_count: usize) -> Self {
        let mut inside = self.vertices.iter().copied().peekable();
        let outside = |v: &VertexId| {
            let found = inside.peek() == Some(v);
            if found {
                inside.next();
            }
            !found
        };
        Self { vertices: (0..vertex_count).map(VertexId::new).filter(outside).collect() }
    }
}

/// In any order, with repetitions.
impl FromIterator<VertexId> for Selection {
    fn from_iter<I: IntoIterator<Item = VertexId>>(vertices: I) -> Self {
        let mut vertices: Vec<VertexId> = vertices.into_iter().collect();
        vertices.sort_unstable();
        vertices.dedup();
        Self { vertices }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn set(indices: &[usize]) -> Selection {
        indices.iter().copied().map(VertexId::new).collect()
    }

    #[test]
    fn sets_combine() {
        let (a, b) = (set(&[4, 1, 1, 3]), set(&[3, 0]));
        assert_eq!(a.union(&b), set(&[0, 1, 3, 4]));
        assert_eq!(a.intersection(&b), set(&[3]));
        assert_eq!(a.complement(6), set(&[0, 2, 5]));
        assert_eq!(set(&[]).complement(2), Selection::all(2));
    }
}
