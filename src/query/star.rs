//! A vertex and what touches it.

use crate::id::{DirectedEdge, Edge, Triangle, VertexId};
use crate::rotation::{Ring, RotationSystem};

/// The star of a vertex: the vertex with the edges and triangles at it, and the link around them.
///
/// ```text
///        c-------b          one-ring  a b c d e f
///       / \     / \         edges     v-a v-b ... v-f
///      /   \   /   \        triangles (v a b) (v b c) ... (v f a)
///     d-----v-----a         link      a->b b->c ... f->a
///      \   /   \   /
///       \ /     \ /         without (v f a), v on a boundary: the link
///        e-------f          is the path a->b b->c ... e->f
/// ```
///
/// Every order is that of the ring: counter-clockwise seen from outside, from the gap on if there is one. The iterators
/// read the ring in place, from both ends, and allocate nothing. Triangles and link are right provided that all faces at
/// the vertex are triangles, as in every [`Mesh`](crate::mesh::Mesh).
///
/// ```
/// use vvmesh::{VertexId, query, shapes};
/// let mesh = shapes::grid(2, 2);
/// let inner = query::star(mesh.rotation(), VertexId::new(4));
/// assert_eq!((inner.edges().len(), inner.triangles().len(), inner.link().len()), (6, 6, 6));
/// let corner = query::star(mesh.rotation(), VertexId::new(0));
/// assert_eq!((corner.edges().len(), corner.triangles().len(), corner.link().len()), (3, 2, 2));
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Star<'a> {
    center: VertexId,
    ring: Ring<'a>,
}

/// The star of a vertex. O(1).
///
/// # Panics
/// If there is no such vertex.
#[inline]
#[must_use]
pub fn star(rotation: &RotationSystem, v: VertexId) -> Star<'_> {
    Star { center: v, ring: rotation.ring(v) }
}

impl<'a> Star<'a> {
    /// The vertex in the middle.
    #[inline]
    #[must_use]
    pub fn center(self) -> VertexId {
        self.center
    }

    /// The vertices of the one-ring.
    pub fn one_ring(self) -> impl ExactSizeIterator<Item = VertexId> + DoubleEndedIterator + Clone + use<'a> {
        self.ring.iter()
    }

    /// The edges at the vertex.
    pub fn edges(self) -> impl ExactSizeIterator<Item = Edge> + DoubleEndedIterator + Clone + use<'a> {
        self.ring.iter().map(move |w| Edge::new(self.center, w))
    }

    /// The triangles at the vertex.
    pub fn triangles(self) -> impl ExactSizeIterator<Item = Triangle> + DoubleEndedIterator + Clone + use<'a> {
        self.ring.pairs().map(move |(a, b)| Triangle::new(self.center, a, b))
    }

    /// The edges opposite to the vertex, one a triangle, each with its triangle on the left: a cycle, or at a boundary a
    /// path.
    pub fn link(self) -> impl ExactSizeIterator<Item = DirectedEdge> + DoubleEndedIterator + Clone + use<'a> {
        self.ring.pairs().map(|(a, b)| DirectedEdge::new(a, b))
    }

    /// Whether the link is a path: the vertex lies on a boundary.
    #[inline]
    #[must_use]
    pub fn is_open(self) -> bool {
        self.ring.is_open()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    fn is_chain(link: &[DirectedEdge]) -> bool {
        link.windows(2).all(|pair| pair[0].to == pair[1].from)
    }

    #[test]
    fn a_link_is_a_cycle_inside_and_a_path_at_a_boundary() {
        let mesh = shapes::grid(3, 2);
        for v in mesh.vertices() {
            let star = star(mesh.rotation(), v);
            let link: Vec<_> = star.link().collect();
            assert!(is_chain(&link));
            assert_eq!(link.last().map(|e| e.to) == link.first().map(|e| e.from), !star.is_open());
            assert_eq!(star.edges().len() - link.len(), usize::from(star.is_open()));
        }
    }

    #[test]
    fn triangles_are_the_center_joined_to_the_link() {
        let mesh = shapes::icosahedron();
        for v in mesh.vertices() {
            let star = star(mesh.rotation(), v);
            assert!(star.triangles().eq(star.link().map(|e| Triangle::new(star.center(), e.from, e.to))));
            assert!(star.triangles().eq(mesh.rotation().triangles_around(v)));
            let mut back: Vec<_> = star.edges().rev().collect();
            back.reverse();
            assert!(star.edges().eq(back));
            assert!(star.one_ring().all(|w| mesh.rotation().has_edge(v, w)));
        }
    }

    #[test]
    fn an_isolated_vertex_has_an_empty_star() {
        let rotation = RotationSystem::with_isolated(1);
        let star = star(&rotation, VertexId::new(0));
        assert_eq!((star.one_ring().len(), star.triangles().len(), star.link().len()), (0, 0, 0));
        assert!(!star.is_open());
    }
}
