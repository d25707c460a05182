//! The same mesh under other vertex numbers, such that neighbours are near to each other in memory.
//!
//! Rings and positions lie by vertex number. If neighbours have numbers far apart, as in a file that was shuffled, each
//! step from neighbour to neighbour waits for the memory as soon as the mesh is larger than the caches.
//!
//! New vertices are numbered by the ids of their parents, and some sums are formed in the order of ids. So nothing in
//! this crate reorders by itself, the program `vv` neither: what it writes has the numbers, and the bits, that follow
//! from those of the file.
//!
//! **Deliberately not here**: orders along a curve in space. [`Permutation::new`] takes any order; the breadth-first
//! one needs no positions and refinement was faster with it (see `benches/RECORD.md`).

use super::{Mesh, Permutation};
use crate::id::VertexId;
use crate::rotation::RotationSystem;

impl Mesh {
    /// The mesh with its vertices renumbered breadth-first, and the permutation that did it.
    ///
    /// Each component starts with its smallest vertex, and they are ordered by it; behind a vertex come its neighbours
    /// in the order of its ring, those that have no number yet. What else holds is said at [`Mesh::renumbered`].
    ///
    /// O(vertices + edges).
    ///
    /// ```
    /// use vvmesh::adaptive::Uniform;
    /// use vvmesh::scheme::Loop;
    /// use vvmesh::scratch::Scratch;
    /// use vvmesh::select::Selection;
    /// use vvmesh::step::{History, Keep};
    /// use vvmesh::subdivide::{Control, Subdivider};
    /// use vvmesh::{VertexId, shapes};
    ///
    /// let mesh = shapes::torus(12, 8, 2.0, 1.0);
    /// let (mut local, permutation) = mesh.reordered();
    /// let mut history = History::new(&local, Keep::default());
    /// let all = Selection::empty();
    /// Subdivider::new(Loop::default(), Uniform)
    ///     .step(&mut local, &mut history, &all, &mut Scratch::new(), &mut Control::default())?;
    ///
    /// // The input vertices get their numbers back, the new ones keep theirs.
    /// let refined = local.renumbered(&permutation.inverse().extended(local.vertex_count()));
    /// let v = VertexId::new(50);
    /// assert_eq!(refined.position(v), local.position(permutation.new_of(v)));
    /// # Ok::<(), vvmesh::error::RefineError>(())
    /// ```
    #[must_use]
    pub fn reordered(&self) -> (Self, Permutation) {
        let order = breadth_first(&self.rotation);
        let permutation = Permutation::new(order).expect("the search comes to every vertex once");
        (self.renumbered(&permutation), permutation)
    }

    /// The same mesh with other vertex numbers.
    ///
    /// Every ring has the same neighbours in the same order from the same start; positions and tags go along. So the
    /// [inverse](Permutation::inverse) gives the mesh back as it was, bit for bit. A
    /// [`Selection`](crate::select::Selection) or a [`History`](crate::step::History) of the mesh names its old
    /// numbers: make a history after this, and renumber again when the last step is made.
    ///
    /// O(vertices + edges).
    ///
    /// # Refining a renumbered mesh
    /// Each new vertex has its counterpart between the counterparts of its parents, with the same neighbours in the
    /// same cyclic order. (A method that splits two edges of a face may be given another
    /// [`Diagonal`](crate::split::Diagonal) where ids decide; the methods of this crate split one edge or all.) What
    /// differs:
    /// - New vertices are numbered by the smaller end of their edge, so they are numbered otherwise.
    /// - An edge between two input vertices is read from the smaller number, and the ring of an inner vertex on it
    ///   starts there. So sums may be formed in another order, and positions may differ in their last bits. With
    ///   [`Midpoint`](crate::scheme::Midpoint) they never do. With [`Loop`](crate::scheme::Loop) they are the same
    ///   after the first step, which starts from rings that were only renamed; from the second on they may differ. With
    ///   [`Butterfly`](crate::scheme::Butterfly) and [`ModifiedButterfly`](crate::scheme::ModifiedButterfly) they may
    ///   differ from the first step on.
    ///
    /// # Panics
    /// If the permutation is for another number of vertices.
    #[must_use]
    pub fn renumbered(&self, permutation: &Permutation) -> Self {
        assert_eq!(permutation.len(), self.vertex_count(), "a number for each vertex");
        let name = |v| permutation.new_of(v);
        Self {
            rotation: self.rotation.renumbered(permutation.order(), name),
            positions: permutation.applied_to(&self.positions),
            tags: self.tags.renamed(name),
        }
    }
}

/// All vertices, component after component.
fn breadth_first(rotation: &RotationSystem) -> Vec<VertexId> {
    let mut order = Vec::with_capacity(rotation.vertex_count());
    let mut seen = vec![false; rotation.vertex_count()];
    for start in rotation.vertices() {
        let mut reached = order.len();
        if !std::mem::replace(&mut seen[start.index()], true) {
            order.push(start);
        }
        while let Some(&v) = order.get(reached) {
            order.extend(rotation.ring(v).iter().filter(|w| !std::mem::replace(&mut seen[w.index()], true)));
            reached += 1;
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::id::Edge;
    use crate::rotation::RingBuf;
    use crate::shapes;

    #[test]
    fn numbers_spread_from_the_smallest_vertex() {
        let mesh = shapes::grid(2, 2);
        let (local, permutation) = mesh.reordered();
        let old: Vec<usize> = local.vertices().map(|v| permutation.old_of(v).index()).collect();
        assert_eq!(old, [0, 1, 4, 3, 2, 5, 8, 7, 6]);
    }

    #[test]
    fn components_and_isolated_vertices_keep_their_order() {
        let mut rings = vec![RingBuf::default(); 7];
        for (v, [a, b]) in [(1, [6, 4]), (6, [4, 1]), (4, [1, 6])] {
            rings[v] = RingBuf::open(&[a, b].map(VertexId::new));
        }
        let order = breadth_first(&RotationSystem::from_rings(rings));
        assert_eq!(order, [0, 1, 6, 4, 2, 3, 5].map(VertexId::new));
    }

    #[test]
    fn tags_and_gaps_go_along() {
        let mut mesh = shapes::grid(2, 1);
        let [a, b, c] = [4, 1, 0].map(VertexId::new);
        mesh.set_sharp(Edge::new(a, b), true);
        mesh.set_corner(c, true);
        let turned = mesh.renumbered(&Permutation::new(mesh.vertices().rev().collect()).unwrap());
        let [a, b, c] = [a, b, c].map(|v| VertexId::new(5 - v.index()));
        assert_eq!((turned.tags().sharp_edges(), turned.tags().corners()), (vec![Edge::new(a, b)], vec![c]));
        assert_eq!(turned.rotation().validate_triangles(), []);
        assert!(mesh.vertices().zip(turned.vertices().rev()).all(|(v, w)| {
            let renamed = mesh.ring(v).iter().map(|u| VertexId::new(5 - u.index()));
            turned.ring(w).iter().eq(renamed) && turned.is_boundary(w) == mesh.is_boundary(v)
        }));
    }
}
