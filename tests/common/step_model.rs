//! One step of refinement as a list of faces would do it: a model of rings, numbering and closing to compare with.

use std::collections::{BTreeMap, BTreeSet};

use super::run::{Run, ring};
use vvmesh::split::Diagonal;
use vvmesh::step::Lineage;
use vvmesh::{Edge, Mesh, Triangle, VertexId};

/// A set of split edges on a mesh, with the ids that rule gives the new vertices.
pub struct StepModel {
    before: Mesh,
    odd: BTreeMap<Edge, VertexId>,
}

impl StepModel {
    /// Numbers the new vertices in order of (smaller end, place in its ring).
    pub fn new(before: &Mesh, is_split: impl Fn(Edge) -> bool) -> Self {
        let mut odd = BTreeMap::new();
        for v in before.vertices() {
            for w in before.ring(v).iter().filter(|&w| v < w && is_split(Edge::new(v, w))) {
                odd.insert(Edge::new(v, w), VertexId::new(before.vertex_count() + odd.len()));
            }
        }
        Self { before: before.clone(), odd }
    }

    pub fn odd(&self, a: VertexId, b: VertexId) -> Option<VertexId> {
        self.odd.get(&Edge::new(a, b)).copied()
    }

    /// How many faces have 0, 1, 2 and 3 split edges.
    pub fn face_counts(&self) -> [usize; 4] {
        let mut counts = [0; 4];
        for triangle in self.before.triangles() {
            let [a, b, c] = triangle.corners();
            counts[[(a, b), (b, c), (c, a)].iter().filter(|&&(p, q)| self.odd(p, q).is_some()).count()] += 1;
        }
        counts
    }

    /// The faces after the step. `after` gives the positions that some diagonals are measured with.
    pub fn faces(&self, after: &Mesh, diagonal: Diagonal) -> BTreeSet<Triangle> {
        let mut faces = BTreeSet::new();
        for triangle in self.before.triangles() {
            let mut corners = triangle.corners();
            // Turned so that the first edge is split and, of two, the last is not; the split ones come first.
            let split = |[a, b, c]: [VertexId; 3]| [(a, b), (b, c), (c, a)].map(|(p, q)| self.odd(p, q));
            while !matches!(split(corners), [None, None, None] | [Some(_), _, None] | [Some(_), Some(_), Some(_)]) {
                corners.rotate_left(1);
            }
            let [a, b, c] = corners;
            match split(corners) {
                [Some(x), Some(y), Some(z)] => {
                    faces.extend([[a, x, z], [b, y, x], [c, z, y], [x, y, z]].map(|[a, b, c]| Triangle::new(a, b, c)));
                }
                [Some(x), Some(y), None] => {
                    // The corner b is cut off; the quad a, x, y, c is left.
                    faces.insert(Triangle::new(x, b, y));
                    let cut = if self.starts_at_first([a, c], [x, y], after, diagonal) {
                        [[a, x, y], [a, y, c]]
                    } else {
                        [[a, x, c], [x, y, c]]
                    };
                    faces.extend(cut.map(|[a, b, c]| Triangle::new(a, b, c)));
                }
                [Some(x), None, None] => {
                    faces.extend([[a, x, c], [x, b, c]].map(|[a, b, c]| Triangle::new(a, b, c)));
                }
                _ => {
                    faces.insert(triangle);
                }
            }
        }
        faces
    }

    /// Whether the diagonal of the quad goes from `a` to the new vertex beside `c`.
    fn starts_at_first(&self, [a, c]: [VertexId; 2], [x, y]: [VertexId; 2], after: &Mesh, diagonal: Diagonal) -> bool {
        let valence = |v| self.before.ring(v).valence();
        let length = |v, w| after.position(v).distance_squared(after.position(w));
        let order = match diagonal {
            Diagonal::Valence => valence(a).cmp(&valence(c)),
            Diagonal::Shortest => length(a, y).total_cmp(&length(c, x)),
            Diagonal::Longest => length(c, x).total_cmp(&length(a, y)),
            Diagonal::ById => std::cmp::Ordering::Equal,
        };
        order.then(a.cmp(&c)).is_lt()
    }

    /// Asserts the faces, the valid rings, their starts, and the parents, in order, of the new vertices.
    ///
    /// `born` is the number of the step that made a vertex of the mesh before, 0 for an input vertex.
    pub fn assert_made(&self, run: &Run, diagonal: Diagonal, born: impl Fn(VertexId) -> usize) {
        let (before, after) = (&self.before, &run.mesh);
        assert_eq!(after.rotation().validate_triangles(), []);
        assert_eq!(after.triangles().collect::<BTreeSet<_>>(), self.faces(after, diagonal));
        assert_eq!(after.vertex_count(), before.vertex_count() + self.odd.len());
        let [_, one, two, three] = self.face_counts();
        assert_eq!(after.face_count(), before.face_count() + one + 2 * two + 3 * three);

        for v in before.vertices() {
            // What is new and stands opposite comes after what stood there; nothing else moves, so the start stays.
            let old = before.ring(v).iter().map(|w| self.odd(v, w).unwrap_or(w));
            let (new, open) = ring(after, v);
            let stood: Vec<VertexId> = old.collect();
            let stood_first = stood.first().copied();
            let kept: Vec<VertexId> = new.iter().copied().filter(|w| stood.contains(w)).collect();
            assert_eq!((kept, open), (stood, before.ring(v).is_open()), "the ring of {v}");
            assert_eq!(new.first(), stood_first.as_ref(), "the start of the ring of {v}");
        }
        for (edge, &x) in &self.odd {
            let [p, q] = self.ordered(*edge, &born);
            assert_eq!(run.history.parents(x), Some(Lineage::Edge([p, q])), "the parents of {x}");
            // From p; at a boundary from the gap, which is before p unless it lies right of p -> q.
            let start = if before.rotation().right_of(p, q).is_none() { q } else { p };
            assert_eq!(after.ring(x).iter().next(), Some(start), "the start of the ring of {x}");
        }
    }

    /// The ends in the order in which masks read them.
    fn ordered(&self, edge: Edge, born: impl Fn(VertexId) -> usize) -> [VertexId; 2] {
        let [a, b] = edge.ends();
        if born(a) != born(b) {
            return if born(a) < born(b) { [a, b] } else { [b, a] };
        }
        let older = |corner: Option<VertexId>| corner.is_some_and(|corner| born(corner) < born(a));
        let rotation = self.before.rotation();
        if older(rotation.right_of(a, b)) && !older(rotation.left_of(a, b)) { [b, a] } else { [a, b] }
    }
}
