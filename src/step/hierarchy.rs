//! The hierarchy of triangles over an input mesh, as the edges that are split and nothing else.
//!
//! Splitting a triangle of level l in four makes triangles of level l + 1; its edges and corners belong to level l too. At a
//! level l ≥ 1 every edge has an end that was born at l. So the level of an edge is the greater birth level of its ends, two
//! vertices are neighbours at one level at most, and one map from edges to the vertices that split them is all there is to
//! know: triangles, stars and rings of every level are functions of it and of the input.
//!
//! A vertex that splits no edge any more is taken out. Its id is *free*: the vertex is isolated until the id is used again,
//! the smallest first; free ids at the end are given up.
//!
//! **Deliberately not here**: what is split and when ([`crate::split`]), where vertices are.

use std::collections::{BTreeSet, HashMap};

use super::{Lineage, Parent};
use crate::id::{Edge, VertexId};

/// When and where a vertex was made that splits an edge.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Birth {
    /// One more than the level of the edge.
    pub(crate) level: u8,
    /// The edge with the corners opposite to it at its level.
    pub(crate) parent: Parent,
}

impl Birth {
    /// The other end of the edge that the vertex splits; `None` if `v` is no end.
    pub(crate) fn other_end(&self, v: VertexId) -> Option<VertexId> {
        let Parent { p, q, .. } = self.parent;
        if v == p {
            Some(q)
        } else if v == q {
            Some(p)
        } else {
            None
        }
    }

    /// The name of the vertex.
    pub(crate) fn lineage(&self) -> Lineage {
        Lineage::Edge([self.parent.p, self.parent.q])
    }

    /// The corner that this vertex and another one cut off a triangle two edges of which they split, and the other ends of
    /// those edges.
    pub(crate) fn cut_corner(&self, other: &Self) -> [VertexId; 3] {
        let Parent { p, q, .. } = self.parent;
        match (other.other_end(p), other.other_end(q)) {
            (Some(z), _) => [p, q, z],
            (_, Some(z)) => [q, p, z],
            _ => unreachable!("they split two edges of one triangle"),
        }
    }
}

/// Which vertex splits which edge, and up to which level stars are required to be complete.
#[derive(Clone, Debug, Default)]
pub(crate) struct Hierarchy {
    input_count: usize,
    /// Of every vertex that is no input vertex; `None` if its id is free.
    births: Vec<Option<Birth>>,
    odd: HashMap<Edge, VertexId>,
    free: BTreeSet<VertexId>,
    /// How many stars of a vertex are required, from that of its birth level on; 0 for those behind the end.
    stars: Vec<u16>,
}

impl Hierarchy {
    /// The hierarchy of a mesh with so many vertices, of which nothing is split.
    pub(crate) fn new(input_count: usize) -> Self {
        Self { input_count, ..Self::default() }
    }

    /// How many ids there are, free ones too.
    pub(crate) fn vertex_count(&self) -> usize {
        self.input_count + self.births.len()
    }

    /// How many vertices the input has.
    pub(crate) fn input_count(&self) -> usize {
        self.input_count
    }

    /// Whether nothing is split.
    pub(crate) fn is_input_alone(&self) -> bool {
        self.births.is_empty()
    }

    pub(crate) fn is_input(&self, v: VertexId) -> bool {
        v.index() < self.input_count
    }

    /// Whether there is such a vertex, whose id is not free.
    pub(crate) fn contains(&self, v: VertexId) -> bool {
        self.is_input(v) || self.birth(v).is_some()
    }

    /// When and where a vertex was made; `None` for an input vertex, and if there is no such vertex.
    #[inline]
    pub(crate) fn birth(&self, v: VertexId) -> Option<&Birth> {
        self.births.get(v.index().checked_sub(self.input_count)?)?.as_ref()
    }

    /// The level at which a vertex was made: 0 for an input vertex.
    #[inline]
    pub(crate) fn level(&self, v: VertexId) -> u8 {
        self.birth(v).map_or(0, |birth| birth.level)
    }

    /// The level of a triangle or an edge with these corners.
    #[inline]
    pub(crate) fn level_of<const N: usize>(&self, corners: [VertexId; N]) -> u8 {
        corners.into_iter().map(|v| self.level(v)).max().unwrap_or(0)
    }

    /// The vertex that splits an edge.
    #[inline]
    pub(crate) fn odd(&self, a: VertexId, b: VertexId) -> Option<VertexId> {
        self.odd.get(&Edge::new(a, b)).copied()
    }

    /// The vertices that split the edges of a triangle: opposite to the first corner, to the second, to the third.
    #[inline]
    pub(crate) fn odds(&self, [a, b, c]: [VertexId; 3]) -> [Option<VertexId>; 3] {
        [self.odd(b, c), self.odd(c, a), self.odd(a, b)]
    }

    /// Whether a triangle is split in four: whether all its edges are split.
    pub(crate) fn is_split(&self, corners: [VertexId; 3]) -> bool {
        self.odds(corners).iter().all(Option::is_some)
    }

    /// Whether an edge of the mesh that is shown closes a crack, and is thus none of any level. O(1).
    pub(crate) fn is_closing(&self, [a, b]: [VertexId; 2]) -> bool {
        match (self.birth(a), self.birth(b)) {
            (None, None) => false,
            (Some(at_a), Some(at_b)) if at_a.level == at_b.level => {
                let [_, y, z] = at_a.cut_corner(at_b);
                self.odd(y, z).is_none()
            }
            (at_a, at_b) => {
                let (older, younger) = if self.level(a) < self.level(b) { (a, at_b) } else { (b, at_a) };
                younger.is_some_and(|birth| birth.other_end(older).is_none())
            }
        }
    }

    /// All vertices that are no input vertices, by id.
    pub(crate) fn births(&self) -> impl Iterator<Item = (VertexId, &Birth)> {
        let numbered = (self.input_count..).zip(&self.births);
        numbered.filter_map(|(k, birth)| birth.as_ref().map(|birth| (VertexId::new(k), birth)))
    }

    /// The id that the next vertex gets; `None` if 32 bits are not enough.
    pub(crate) fn next_id(&self) -> Option<VertexId> {
        self.free.first().copied().or_else(|| VertexId::try_new(self.vertex_count()))
    }

    /// Splits an edge; `x` is [`Hierarchy::next_id`], or one behind it if those between come next.
    pub(crate) fn insert(&mut self, x: VertexId, birth: Birth) {
        let k = x.index() - self.input_count;
        if k >= self.births.len() {
            self.births.resize(k + 1, None);
        } else {
            self.free.remove(&x);
        }
        self.odd.insert(Edge::new(birth.parent.p, birth.parent.q), x);
        self.births[k] = Some(birth);
    }

    /// Makes an edge whole again. Until [`Hierarchy::release`] it is still told where the vertex was.
    pub(crate) fn join(&mut self, a: VertexId, b: VertexId) -> Option<VertexId> {
        self.odd.remove(&Edge::new(a, b))
    }

    /// Frees the id of a vertex whose edge is whole again.
    pub(crate) fn release(&mut self, x: VertexId) {
        self.births[x.index() - self.input_count] = None;
        self.free.insert(x);
        while self.births.last().is_some_and(Option::is_none) {
            self.births.pop();
            self.free.pop_last();
        }
        self.stars.truncate(self.vertex_count());
    }

    /// How many stars of a vertex are required, from that of its birth level on.
    #[inline]
    pub(crate) fn star_count(&self, v: VertexId) -> u16 {
        self.stars.get(v.index()).copied().unwrap_or(0)
    }

    /// Whether the star of a vertex at a level, which is not below that of its birth, is required.
    #[inline]
    pub(crate) fn has_star(&self, v: VertexId, level: u8) -> bool {
        u16::from(level) < u16::from(self.level(v)) + self.star_count(v)
    }

    /// The greatest level at which the star of a vertex is required; `None` if it is at none.
    pub(crate) fn top_star(&self, v: VertexId) -> Option<u8> {
        let above = self.star_count(v).checked_sub(1)?;
        Some((u16::from(self.level(v)) + above) as u8)
    }

    /// Requires the star at the next level.
    pub(crate) fn push_star(&mut self, v: VertexId) {
        if self.stars.len() <= v.index() {
            self.stars.resize(v.index() + 1, 0);
        }
        self.stars[v.index()] += 1;
    }

    /// Gives up the star at the greatest level at which it was required.
    pub(crate) fn pop_star(&mut self, v: VertexId) {
        self.stars[v.index()] -= 1;
    }

    pub(crate) fn memory_bytes(&self) -> usize {
        self.births.capacity() * size_of::<Option<Birth>>()
            + self.odd.capacity() * size_of::<(Edge, VertexId)>()
            + self.free.len() * size_of::<VertexId>()
            + self.stars.capacity() * size_of::<u16>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_free_id_is_used_first_and_the_last_ones_are_given_up() {
        let v = VertexId::new;
        let mut hierarchy = Hierarchy::new(3);
        let edges = [[0, 1], [1, 2], [0, 2]].map(|ends| ends.map(v));
        let birth = |[p, q]: [VertexId; 2]| Birth { level: 1, parent: Parent { p, q, left: None, right: None } };
        for ends in edges {
            let x = hierarchy.next_id().unwrap();
            hierarchy.insert(x, birth(ends));
        }
        assert_eq!(hierarchy.odds([v(0), v(1), v(2)]), [4, 5, 3].map(|k| Some(v(k))));
        for [a, b] in [edges[1], edges[0]] {
            let x = hierarchy.join(a, b).unwrap();
            hierarchy.release(x);
        }
        assert_eq!((hierarchy.vertex_count(), hierarchy.next_id()), (6, Some(v(3))));
        hierarchy.insert(v(3), birth(edges[1]));
        assert_eq!((hierarchy.next_id(), hierarchy.births().count()), (Some(v(4)), 2));
        for [a, b] in [edges[2], edges[1]] {
            let x = hierarchy.join(a, b).unwrap();
            hierarchy.release(x);
        }
        assert_eq!((hierarchy.vertex_count(), hierarchy.next_id()), (3, Some(v(3))));
    }
}
