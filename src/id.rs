//! Names of vertices, edges and triangles.
//!
//! A vertex is named by a number, everything else by its vertices: nothing is stored per edge or per triangle, so their
//! names are values that can be made, compared and thrown away.
//!
//! **Deliberately not here**: whether the thing named exists. Only a [`RotationSystem`](crate::rotation::RotationSystem)
//! knows.

use std::fmt;

/// The name of a vertex: its place in the list of vertices, from 0.
///
/// It prints as `v12`. The greatest index is [`VertexId::MAX_INDEX`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(transparent)]
pub struct VertexId(u32);

impl VertexId {
    /// The greatest index of a vertex, 2³² − 2: one value is kept to mark the gap of an open ring.
    pub const MAX_INDEX: usize = u32::MAX as usize - 1;

    /// What stands behind the last neighbour of an open ring. It names no vertex.
    pub(crate) const GAP: VertexId = VertexId(u32::MAX);

    /// The vertex with this index.
    ///
    /// # Panics
    /// If `index` is greater than [`VertexId::MAX_INDEX`]; [`VertexId::try_new`] answers `None` instead.
    #[inline]
    #[must_use]
    pub fn new(index: usize) -> Self {
        Self::try_new(index).expect("a vertex index is at most 2^32 - 2")
    }

    /// The vertex with this index, or `None` above [`VertexId::MAX_INDEX`].
    #[inline]
    #[must_use]
    pub fn try_new(index: usize) -> Option<Self> {
        (index <= Self::MAX_INDEX).then_some(Self(index as u32))
    }

    /// The vertex with this index, which is known not to be above [`VertexId::MAX_INDEX`].
    #[inline]
    pub(crate) fn from_raw(index: u32) -> Self {
        debug_assert_ne!(index, Self::GAP.0, "the gap is no vertex");
        Self(index)
    }

    /// The index as a number that reaches into a slice.
    #[inline]
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl From<VertexId> for usize {
    fn from(v: VertexId) -> usize {
        v.index()
    }
}

impl fmt::Display for VertexId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "v{}", self.0)
    }
}

impl fmt::Debug for VertexId {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// The name of an edge: its two ends, the smaller first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Edge {
    a: VertexId,
    b: VertexId,
}

impl Edge {
    /// The edge between two vertices, given in any order.
    #[inline]
    #[must_use]
    pub fn new(a: VertexId, b: VertexId) -> Self {
        if a <= b { Self { a, b } } else { Self { a: b, b: a } }
    }

    /// Both ends, the smaller first.
    #[inline]
    #[must_use]
    pub fn ends(self) -> [VertexId; 2] {
        [self.a, self.b]
    }
}

impl fmt::Display for Edge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}-{}", self.a, self.b)
    }
}

/// The name of an edge with a direction; its face lies on the left.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct DirectedEdge {
    /// Where it starts.
    pub from: VertexId,
    /// Where it ends.
    pub to: VertexId,
}

impl DirectedEdge {
    /// The directed edge from one vertex to another.
    #[inline]
    #[must_use]
    pub fn new(from: VertexId, to: VertexId) -> Self {
        Self { from, to }
    }

    /// The same edge, run the other way.
    #[inline]
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { from: self.to, to: self.from }
    }

    /// The edge without its direction.
    #[inline]
    #[must_use]
    pub fn edge(self) -> Edge {
        Edge::new(self.from, self.to)
    }
}

impl fmt::Display for DirectedEdge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}->{}", self.from, self.to)
    }
}

/// The name of a triangle: its corners counter-clockwise, the smallest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct Triangle([VertexId; 3]);

impl Triangle {
    /// The triangle with these corners in counter-clockwise order, given from any of them.
    #[inline]
    #[must_use]
    pub fn new(a: VertexId, b: VertexId, c: VertexId) -> Self {
        if a <= b && a <= c {
            Self([a, b, c])
        } else if b <= c {
            Self([b, c, a])
        } else {
            Self([c, a, b])
        }
    }

    /// The corners counter-clockwise, the smallest first.
    #[inline]
    #[must_use]
    pub fn corners(self) -> [VertexId; 3] {
        self.0
    }

    /// The edges in the order of the corners: the first leads from the first corner to the second.
    #[inline]
    #[must_use]
    pub fn edges(self) -> [Edge; 3] {
        let [a, b, c] = self.0;
        [Edge::new(a, b), Edge::new(b, c), Edge::new(c, a)]
    }

    /// The same triangle seen from behind.
    #[inline]
    #[must_use]
    pub fn reversed(self) -> Self {
        let [a, b, c] = self.0;
        Self([a, c, b])
    }
}

impl fmt::Display for Triangle {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "({} {} {})", self.0[0], self.0[1], self.0[2])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_triangle_keeps_its_orientation_and_starts_with_the_smallest() {
        let [a, b, c] = [0, 1, 2].map(VertexId::new);
        assert_eq!(Triangle::new(a, b, c), Triangle::new(c, a, b));
        assert_eq!(Triangle::new(b, c, a).corners(), [a, b, c]);
        assert_ne!(Triangle::new(a, c, b), Triangle::new(a, b, c));
        assert_eq!(Triangle::new(a, c, b), Triangle::new(a, b, c).reversed());
    }

    #[test]
    fn the_gap_names_no_vertex() {
        assert_eq!(VertexId::try_new(u32::MAX as usize), None);
        assert_eq!(VertexId::new(VertexId::MAX_INDEX).index(), VertexId::MAX_INDEX);
    }
}
