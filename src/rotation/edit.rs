//! Edits that keep the rings a rotation system: each is made whole, or refused with everything as it was.
//!
//! [`RotationSystem::split_edge`], [`RotationSystem::insert_edge`] and [`RotationSystem::delete_edge`] work on faces of any
//! number of sides. [`RotationSystem::split_edge_triangles`], [`RotationSystem::flip`] and [`RotationSystem::collapse`]
//! turn triangles into triangles. None changes the Euler characteristic or the genus, and all keep the start of a ring:
//! a neighbour's slot is given to another, or a new one comes right behind its predecessor.
//!
//! **Deliberately not here**: positions and tags; see [`Mesh`](crate::Mesh) for the same edits on both. Edits that break
//! the symmetry for a moment; see [`Transaction`](super::Transaction).

use super::transaction::id_of_next;
use super::validate::{least_valence, sides};
use super::{Ring, RingBuf, RotationSystem};
use crate::error::EditError;
use crate::id::{DirectedEdge, Edge, VertexId};

impl RotationSystem {
    /// Puts a new vertex in the middle of an edge and answers its id. The faces beside the edge gain a side.
    ///
    /// The new ring starts at `p`; at a boundary right after the gap. O(valence).
    ///
    /// # Errors
    /// [`EditError::NoVertex`], [`EditError::NoEdge`], [`EditError::TooManyVertices`]; [`EditError::SecondGap`] for an edge
    /// with a gap on both sides.
    pub fn split_edge(&mut self, p: VertexId, q: VertexId) -> Result<VertexId, EditError> {
        let slot = self.edge_slot(p, q)?;
        let x = id_of_next(self.vertex_count())?;
        let gaps = sides(self.ring(p), slot);
        let ring = match (gaps.left, gaps.right) {
            (false, false) => RingBuf::closed(&[p, q]),
            (true, false) => RingBuf::open(&[p, q]),
            (false, true) => RingBuf::open(&[q, p]),
            (true, true) => return Err(EditError::SecondGap(x)),
        };
        self.replace(p, q, x);
        self.replace(q, p, x);
        self.push_ring(ring);
        Ok(x)
    }

    /// Splits an edge as [`RotationSystem::split_edge`] does, and joins the new vertex to the corners opposite: of each
    /// triangle beside the edge become two.
    ///
    /// The new ring is `[p, right, q, left]`, where `left` is the corner left of `p -> q`; at a boundary it is
    /// `[p, right, q]` or `[q, left, p]`. O(valence) of the four.
    ///
    /// # Errors
    /// Those of [`RotationSystem::split_edge`]; [`EditError::NotTriangle`] for a face of other sides;
    /// [`EditError::Valence`] if both triangles have the same corners.
    ///
    /// ```
    /// use vvmesh::shapes;
    /// let mut system = shapes::tetrahedron().rotation().clone();
    /// let edge = system.edges().next().unwrap();
    /// let [p, q] = edge.ends();
    /// let x = system.split_edge_triangles(p, q)?;
    /// assert_eq!((system.valence(x), system.triangle_count()), (4, 6));
    /// assert!(system.validate_triangles().is_empty());
    /// # Ok::<(), vvmesh::error::EditError>(())
    /// ```
    pub fn split_edge_triangles(&mut self, p: VertexId, q: VertexId) -> Result<VertexId, EditError> {
        let (left, right) = self.triangles_beside(p, q)?;
        let x = id_of_next(self.vertex_count())?;
        let ring = match (left, right) {
            (Some(left), Some(right)) => RingBuf::closed(&[p, right, q, left]),
            (None, Some(right)) => RingBuf::open(&[p, right, q]),
            (Some(left), None) => RingBuf::open(&[q, left, p]),
            (None, None) => return Err(EditError::SecondGap(x)),
        };
        self.replace(p, q, x);
        self.replace(q, p, x);
        if let Some(left) = left {
            self.splice(left, p, x);
        }
        if let Some(right) = right {
            self.splice(right, q, x);
        }
        self.push_ring(ring);
        Ok(x)
    }

    /// Joins two corners of one face by an edge, which makes two faces of it.
    ///
    /// A corner is named by the directed edge that leaves it with the face on its left. In the rings the new neighbours
    /// come right behind the ends of these. O(sides of the face · valence).
    ///
    /// # Errors
    /// [`EditError::NoVertex`], [`EditError::NoEdge`]; [`EditError::SelfNeighbor`] and [`EditError::AlreadyNeighbor`], since
    /// an edge joins two vertices and only once; [`EditError::GapOnLeft`]; [`EditError::DifferentFaces`].
    pub fn insert_edge(&mut self, from: DirectedEdge, to: DirectedEdge) -> Result<Edge, EditError> {
        let at_from = self.edge_slot(from.from, from.to)?;
        let at_to = self.edge_slot(to.from, to.to)?;
        let (a, b) = (from.from, to.from);
        if a == b {
            return Err(EditError::SelfNeighbor(a));
        }
        if self.has_edge(a, b) {
            return Err(EditError::AlreadyNeighbor { v: a, neighbor: b });
        }
        self.face(to).ok_or(EditError::GapOnLeft(to))?;
        if !self.face(from).ok_or(EditError::GapOnLeft(from))?.any(|edge| edge == to) {
            return Err(EditError::DifferentFaces(from, to));
        }
        self.insert_after(a, at_from, b);
        self.insert_after(b, at_to, a);
        Ok(Edge::new(a, b))
    }

    /// Takes out an edge between two faces, which makes one of them.
    ///
    /// O(sides of a face · valence).
    ///
    /// # Errors
    /// [`EditError::NoVertex`], [`EditError::NoEdge`]; [`EditError::GapOnLeft`] at a boundary; [`EditError::SameFace`] if one
    /// face is on both sides.
    pub fn delete_edge(&mut self, a: VertexId, b: VertexId) -> Result<(), EditError> {
        self.edge_slot(a, b)?;
        let edge = DirectedEdge::new(a, b);
        self.face(edge.reversed()).ok_or(EditError::GapOnLeft(edge.reversed()))?;
        if self.face(edge).ok_or(EditError::GapOnLeft(edge))?.any(|other| other == edge.reversed()) {
            return Err(EditError::SameFace(edge.edge()));
        }
        self.erase(a, b);
        self.erase(b, a);
        Ok(())
    }

    /// Turns the edge between two triangles to join the corners opposite to it, and answers the new edge.
    ///
    /// O(valence) of the four vertices.
    ///
    /// # Errors
    /// [`EditError::NoVertex`], [`EditError::NoEdge`]; [`EditError::GapOnLeft`] at a boundary; [`EditError::NotTriangle`];
    /// [`EditError::Valence`] if an end would keep fewer than 3 neighbours, 2 at a boundary;
    /// [`EditError::AlreadyNeighbor`] if the opposite corners are joined already.
    pub fn flip(&mut self, a: VertexId, b: VertexId) -> Result<Edge, EditError> {
        let [c, d] = self.flipped(a, b)?;
        self.erase(a, b);
        self.erase(b, a);
        self.splice(c, a, d);
        self.splice(d, b, c);
        Ok(Edge::new(c, d))
    }

    /// The corners left and right of an edge that may be flipped.
    fn flipped(&self, a: VertexId, b: VertexId) -> Result<[VertexId; 2], EditError> {
        let (left, right) = self.triangles_beside(a, b)?;
        let c = left.ok_or(EditError::GapOnLeft(DirectedEdge::new(a, b)))?;
        let d = right.ok_or(EditError::GapOnLeft(DirectedEdge::new(b, a)))?;
        self.may_lose_neighbor(a)?;
        self.may_lose_neighbor(b)?;
        if self.has_edge(c, d) {
            return Err(EditError::AlreadyNeighbor { v: c, neighbor: d });
        }
        Ok([c, d])
    }

    /// Draws an edge together: `remove` goes to `keep`, the triangles beside the edge vanish, and `remove` stays behind as
    /// an isolated vertex.
    ///
    /// It is legal where it changes nothing but the number of triangles, which is the *link condition* (Dey, Edelsbrunner,
    /// Guha and Nekhayev 1999): the links of the two ends have in common the link of the edge and nothing more.
    ///
    /// What `remove` had as neighbours comes to the slot it had in the ring of `keep`; only if `keep` gains a gap its ring
    /// starts anew. O(valence) of both ends and of the neighbours of `remove`, and O(n log n) for n neighbours of the ends.
    ///
    /// # Errors
    /// [`EditError::NoVertex`], [`EditError::NoEdge`]; [`EditError::NotTriangle`]; [`EditError::SecondGap`] for an edge with a
    /// gap on both sides. The link condition: [`EditError::CommonNeighbor`] if both ends are next to a vertex that makes
    /// no triangle with them; [`EditError::JoinsBoundaries`] for an inner edge between boundary vertices;
    /// [`EditError::Valence`] if an opposite corner would keep fewer than 3 neighbours, 2 at a boundary.
    pub fn collapse(&mut self, keep: VertexId, remove: VertexId) -> Result<(), EditError> {
        let (left, right) = self.collapsible(keep, remove)?;
        let ring = self.drawn_together(keep, remove, left, right);
        let neighbors = RingBuf::from_ring(self.ring(remove));
        for w in neighbors.as_ring().iter().filter(|&w| w != keep) {
            if Some(w) == left || Some(w) == right {
                self.erase(w, remove);
            } else {
                self.replace(w, remove, keep);
            }
        }
        self.set_ring(keep, ring);
        self.set_ring(remove, RingBuf::default());
        Ok(())
    }

    /// The corners beside an edge that may be collapsed.
    fn collapsible(&self, a: VertexId, b: VertexId) -> Result<(Option<VertexId>, Option<VertexId>), EditError> {
        let (left, right) = self.triangles_beside(a, b)?;
        match (left, right) {
            (None, None) => return Err(EditError::SecondGap(a)),
            (Some(_), Some(_)) if self.is_boundary(a) && self.is_boundary(b) => {
                return Err(EditError::JoinsBoundaries(Edge::new(a, b)));
            }
            _ => {}
        }
        let mut around_b = self.neighbors(b).to_vec();
        around_b.sort_unstable();
        let is_alien = |w: &VertexId| Some(*w) != left && Some(*w) != right && around_b.binary_search(w).is_ok();
        if let Some(neighbor) = self.ring(a).iter().find(is_alien) {
            return Err(EditError::CommonNeighbor { edge: Edge::new(a, b), neighbor });
        }
        for corner in [left, right].into_iter().flatten() {
            self.may_lose_neighbor(corner)?;
        }
        Ok((left, right))
    }

    /// The ring of `a` after `b` has come to it.
    fn drawn_together(&self, a: VertexId, b: VertexId, left: Option<VertexId>, right: Option<VertexId>) -> RingBuf {
        let (ring, other) = (self.ring(a), self.ring(b));
        let is_new = |&w: &VertexId| Some(w) != left && Some(w) != right;
        let from_b = other.circulate(a).expect("the ends of an edge are neighbours").skip(1).filter(is_new);
        if ring.is_open() || !other.is_open() {
            let slot = ring.slot_of(b).expect("the ends of an edge are neighbours");
            let (until, from) = ring.neighbors().split_at(slot);
            let merged: Vec<VertexId> = until.iter().copied().chain(from_b).chain(from[1..].iter().copied()).collect();
            return if ring.is_open() { RingBuf::open(&merged) } else { RingBuf::closed(&merged) };
        }
        // From the gap of b to the left corner, round a to the right corner, and back to the gap.
        let slot = other.slot_of(a).expect("the ends of an edge are neighbours");
        let (until, from) = other.neighbors().split_at(slot);
        let around_a = ring.circulate(b).expect("the ends of an edge are neighbours").skip(1);
        let merged: Vec<VertexId> = until
            .iter()
            .copied()
            .filter(is_new)
            .chain(around_a)
            .chain(from[1..].iter().copied().filter(is_new))
            .collect();
        RingBuf::open(&merged)
    }

    /// The slot of `b` in the ring of `a`.
    fn edge_slot(&self, a: VertexId, b: VertexId) -> Result<usize, EditError> {
        for v in [a, b] {
            if !self.contains(v) {
                return Err(EditError::NoVertex(v));
            }
        }
        self.ring(a).slot_of(b).ok_or(EditError::NoEdge(Edge::new(a, b)))
    }

    /// The third corners of the triangles left and right of `a -> b`, `None` where a gap is.
    fn triangles_beside(&self, a: VertexId, b: VertexId) -> Result<(Option<VertexId>, Option<VertexId>), EditError> {
        self.edge_slot(a, b)?;
        let (left, right) = (self.triangle_left(a, b)?, self.triangle_left(b, a)?);
        if left.is_some() && left == right {
            return Err(EditError::Valence { v: a, valence: self.valence(a), needed: least_valence(false) });
        }
        Ok((left, right))
    }

    fn triangle_left(&self, a: VertexId, b: VertexId) -> Result<Option<VertexId>, EditError> {
        let Some(c) = self.ring(a).next(b) else { return Ok(None) };
        if self.ring(b).prev(a) == Some(c) && self.ring(c).prev(b) == Some(a) {
            Ok(Some(c))
        } else {
            Err(EditError::NotTriangle(DirectedEdge::new(a, b)))
        }
    }

    fn may_lose_neighbor(&self, v: VertexId) -> Result<(), EditError> {
        let ring: Ring<'_> = self.ring(v);
        let (valence, needed) = (ring.valence() - 1, least_valence(ring.is_open()));
        if valence < needed { Err(EditError::Valence { v, valence, needed }) } else { Ok(()) }
    }
}

/// The raw edits of the vv language. What is looked up was found before.
impl RotationSystem {
    fn replace(&mut self, v: VertexId, a: VertexId, x: VertexId) {
        let slot = self.ring(v).slot_of(a).expect("neighbours name each other");
        self.set_neighbor(v, slot, x);
    }

    fn splice(&mut self, v: VertexId, a: VertexId, x: VertexId) {
        let slot = self.ring(v).slot_of(a).expect("neighbours name each other");
        self.insert_after(v, slot, x);
    }

    fn erase(&mut self, v: VertexId, a: VertexId) {
        let slot = self.ring(v).slot_of(a).expect("neighbours name each other");
        self.remove_at(v, slot);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    fn ids<const N: usize>(indices: [usize; N]) -> [VertexId; N] {
        indices.map(VertexId::new)
    }

    #[test]
    fn a_split_edge_is_a_path_or_four_triangles() {
        let mut system = shapes::grid(1, 1).rotation().clone();
        // Corners a b / d c with the diagonal a-c: (a b c) and (a c d).
        let [a, b, d, c] = ids([0, 1, 2, 3]);
        let x = system.split_edge(a, c).unwrap();
        assert_eq!(system.neighbors(x), [a, c]);
        assert_eq!(system.faces().iter().collect::<Vec<_>>(), [[a, b, c, x], [a, x, c, d]]);

        let mut system = shapes::grid(1, 1).rotation().clone();
        let x = system.split_edge_triangles(a, c).unwrap();
        assert_eq!((system.neighbors(x), system.is_boundary(x)), ([a, b, c, d].as_slice(), false));
        let y = system.split_edge_triangles(a, b).unwrap();
        assert_eq!((system.neighbors(y), system.is_boundary(y)), ([b, x, a].as_slice(), true));
        let z = system.split_edge_triangles(c, b).unwrap();
        assert_eq!((system.neighbors(z), system.is_boundary(z)), ([c, x, b].as_slice(), true));
        assert_eq!((system.validate_triangles(), system.triangle_count()), (vec![], 6));
    }

    #[test]
    fn inserting_takes_deleting_back() {
        let mut system = shapes::octahedron().rotation().clone();
        let [a, b] = system.edges().next().unwrap().ends();
        let (c, d) = (system.left_of(a, b).unwrap(), system.right_of(a, b).unwrap());
        system.delete_edge(a, b).unwrap();
        assert_eq!((system.face_count(), system.genus()), (7, 0));
        assert_eq!(system.delete_edge(a, b), Err(EditError::NoEdge(Edge::new(a, b))));
        // The face on the left is now a d b c: of its corners at a and b the directed edges a->d and b->c start there.
        let (at_a, at_b) = (DirectedEdge::new(a, d), DirectedEdge::new(b, c));
        let elsewhere = DirectedEdge::new(b, system.neighbors(b).iter().copied().find(|&w| w != c && w != d).unwrap());
        assert_eq!(system.insert_edge(at_a, elsewhere), Err(EditError::DifferentFaces(at_a, elsewhere)));
        assert_eq!(system.insert_edge(at_a, at_a), Err(EditError::SelfNeighbor(a)));
        assert_eq!(system.insert_edge(at_a, at_b), Ok(Edge::new(a, b)));
        assert_eq!(system.validate_triangles(), []);
    }

    #[test]
    fn a_flip_says_why_not() {
        let mut tetrahedron = shapes::tetrahedron().rotation().clone();
        let [a, b] = ids([0, 1]);
        assert_eq!(tetrahedron.flip(a, b), Err(EditError::Valence { v: a, valence: 2, needed: 3 }));
        let mut grid = shapes::grid(1, 1).rotation().clone();
        let [c, d] = ids([2, 3]);
        assert_eq!(grid.flip(a, b), Err(EditError::GapOnLeft(DirectedEdge::new(b, a))));
        assert_eq!(grid.flip(b, c), Err(EditError::NoEdge(Edge::new(b, c))));
        assert_eq!(grid.flip(a, VertexId::new(4)), Err(EditError::NoVertex(VertexId::new(4))));
        assert_eq!(grid.flip(a, d), Ok(Edge::new(b, c)));
        grid.delete_edge(b, c).unwrap();
        assert_eq!(grid.split_edge_triangles(a, b), Err(EditError::NotTriangle(DirectedEdge::new(a, b))));
    }

    #[test]
    fn a_collapse_keeps_the_link_condition() {
        let mut tetrahedron = shapes::tetrahedron().rotation().clone();
        let [a, b, ..] = ids([0, 1]);
        assert!(matches!(tetrahedron.collapse(a, b), Err(EditError::Valence { valence: 2, needed: 3, .. })));
        let mut grid = shapes::grid(1, 1).rotation().clone();
        let [a, b, c] = ids([0, 1, 3]);
        assert_eq!(grid.collapse(a, c), Err(EditError::JoinsBoundaries(Edge::new(a, c))));
        assert_eq!(grid.collapse(a, b), Ok(()));
        assert_eq!((grid.triangle_count(), grid.valence(b), grid.validate_triangles()), (1, 0, vec![]));
        assert!(matches!(grid.collapse(a, c), Err(EditError::Valence { valence: 1, needed: 2, .. })));

        // A band of six triangles round a triangular hole.
        let ring = [[0, 4, 1], [0, 3, 4], [1, 5, 2], [1, 4, 5], [2, 3, 0], [2, 5, 3]];
        let mesh = crate::Mesh::from_triangles(vec![glam::DVec3::ZERO; 6], &ring).unwrap();
        let mut system = mesh.rotation().clone();
        let [a, b, other] = ids([0, 1, 2]);
        let edge = Edge::new(a, b);
        assert_eq!(system.collapse(a, b), Err(EditError::CommonNeighbor { edge, neighbor: other }));
    }

    #[test]
    fn a_vertex_that_gains_a_gap_starts_behind_it() {
        let grid = shapes::grid(2, 2);
        let [inner, side] = ids([4, 1]);
        for (keep, remove) in [(inner, side), (side, inner)] {
            let mut system = grid.rotation().clone();
            system.collapse(keep, remove).unwrap();
            assert_eq!((system.validate_triangles(), system.triangle_count()), (vec![], 6));
            assert!(system.is_boundary(keep) && system.valence(remove) == 0);
        }
    }
}
