//! Faces, boundary loops and components: what follows from the rings of any rotation system, of triangles or not.
//!
//! Left of a directed edge `v -> w` lies a face or a gap. Round a face one comes from `v -> w` to `w -> u`, where `u` is
//! the neighbour of `w` before `v`; a face is an orbit of this step. Before the first neighbour of an open ring there is
//! nothing, so the edges with a gap on their left belong to no face. They make the boundary loops.
//!
//! An isolated vertex belongs to no face, loop or component, and no number here counts it. For all else
//! V − E + F = 2·components − 2·genus − loops.
//!
//! **Deliberately not here**: walks that measure anything, and searches to a distance; see [`crate::query`].

use std::iter::FusedIterator;

use super::RotationSystem;
use super::reverse::ReverseSlots;
use crate::id::{DirectedEdge, VertexId};

/// Lists of vertices laid end to end: faces, boundary loops or components.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct VertexLists {
    vertices: Vec<VertexId>,
    /// Where each list ends in `vertices`.
    ends: Vec<usize>,
}

impl VertexLists {
    /// How many lists there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is no list.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The vertices of list `k`, or `None` if there is no such list.
    #[must_use]
    pub fn get(&self, k: usize) -> Option<&[VertexId]> {
        let end = *self.ends.get(k)?;
        let start = if k == 0 { 0 } else { self.ends[k - 1] };
        Some(&self.vertices[start..end])
    }

    /// The lists in their order.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &[VertexId]> + DoubleEndedIterator + Clone {
        (0..self.len()).map(|k| self.get(k).expect("k is below the number of lists"))
    }

    fn end_list(&mut self) {
        self.ends.push(self.vertices.len());
    }
}

/// The directed edges of one face, once round; made by [`RotationSystem::face`].
#[derive(Clone, Debug)]
pub struct FaceWalk<'a> {
    system: &'a RotationSystem,
    first: DirectedEdge,
    at: Option<DirectedEdge>,
}

impl Iterator for FaceWalk<'_> {
    type Item = DirectedEdge;

    fn next(&mut self) -> Option<DirectedEdge> {
        let edge = self.at?;
        self.at = self.system.next_in_face(edge).filter(|&next| next != self.first);
        Some(edge)
    }
}

impl FusedIterator for FaceWalk<'_> {}

impl RotationSystem {
    /// The directed edge after this one round the face on its left; `None` if a gap is there, or no such edge.
    ///
    /// O(valence of its end).
    ///
    /// ```
    /// use vvmesh::{DirectedEdge, shapes};
    /// let mesh = shapes::tetrahedron();
    /// let edge = mesh.rotation().directed_edges().next().unwrap();
    /// let next = mesh.rotation().next_in_face(edge).unwrap();
    /// assert_eq!(next, DirectedEdge::new(edge.to, mesh.rotation().left_of(edge.from, edge.to).unwrap()));
    /// ```
    #[must_use]
    pub fn next_in_face(&self, edge: DirectedEdge) -> Option<DirectedEdge> {
        let DirectedEdge { from, to } = edge;
        if !self.contains(from) || !self.contains(to) {
            return None;
        }
        Some(DirectedEdge::new(to, self.ring(to).prev(from)?))
    }

    /// The face on the left of a directed edge, as its directed edges from this one on; `None` if a gap is there, or no
    /// such edge.
    ///
    /// O(valence) a step, no allocation. In a system that is not of triangles a vertex may come more than once, and both
    /// directions of an edge.
    #[must_use]
    pub fn face(&self, edge: DirectedEdge) -> Option<FaceWalk<'_>> {
        self.next_in_face(edge)?;
        Some(FaceWalk { system: self, first: edge, at: Some(edge) })
    }

    /// Every face once, as its vertices in the order in which its directed edges start.
    ///
    /// Faces come in the order of the first of their edges in [`RotationSystem::directed_edges`], and each starts with
    /// it: by its smallest vertex, then in the order of that vertex's ring. If all faces are triangles this is the order
    /// of [`RotationSystem::triangles`].
    ///
    /// O(vertices + edges), whatever the valences.
    #[must_use]
    pub fn faces(&self) -> VertexLists {
        let mut faces = VertexLists::default();
        self.trace_faces(|step| match step {
            Step::Vertex(v) => faces.vertices.push(v),
            Step::End => faces.end_list(),
        });
        faces
    }

    /// How many faces there are, of any number of sides. O(vertices + edges).
    ///
    /// [`RotationSystem::triangle_count`] tells it in O(1) if all are triangles.
    #[must_use]
    pub fn face_count(&self) -> usize {
        let mut count = 0;
        self.trace_faces(|step| count += usize::from(matches!(step, Step::End)));
        count
    }

    /// Every boundary loop once, with the gap on its left: behind `v` comes the last neighbour of `v`.
    ///
    /// Each starts at its smallest vertex, and they are ordered by it. O(vertices).
    #[must_use]
    pub fn boundary_loops(&self) -> VertexLists {
        let mut loops = VertexLists::default();
        let mut visited = vec![false; self.vertex_count()];
        for start in self.vertices().filter(|&v| self.is_boundary(v)) {
            if visited[start.index()] {
                continue;
            }
            let mut v = start;
            while !std::mem::replace(&mut visited[v.index()], true) {
                loops.vertices.push(v);
                v = *self.neighbors(v).last().expect("an open ring is not empty");
            }
            loops.end_list();
        }
        loops
    }

    /// The connected components, each as its vertices ascending, ordered by their smallest vertex.
    ///
    /// An isolated vertex is no component: it carries no piece of surface. O(vertices + edges).
    #[must_use]
    pub fn components(&self) -> VertexLists {
        const NONE: u32 = u32::MAX;
        let mut component = vec![NONE; self.vertex_count()];
        let mut sizes: Vec<usize> = Vec::new();
        let mut open = Vec::new();
        for start in self.vertices().filter(|&v| self.valence(v) > 0) {
            if component[start.index()] != NONE {
                continue;
            }
            let name = sizes.len() as u32;
            component[start.index()] = name;
            open.push(start);
            let mut size = 0;
            while let Some(v) = open.pop() {
                size += 1;
                for w in self.ring(v) {
                    if component[w.index()] == NONE {
                        component[w.index()] = name;
                        open.push(w);
                    }
                }
            }
            sizes.push(size);
        }
        let mut free = Vec::with_capacity(sizes.len());
        let mut total = 0;
        for size in &mut sizes {
            free.push(total);
            total += *size;
            *size = total;
        }
        let mut vertices = vec![VertexId::GAP; total];
        for v in self.vertices().filter(|v| component[v.index()] != NONE) {
            let place = &mut free[component[v.index()] as usize];
            vertices[*place] = v;
            *place += 1;
        }
        VertexLists { vertices, ends: sizes }
    }

    /// Vertices − edges + faces. Isolated vertices are not counted, and gaps are no faces. O(vertices + edges).
    #[must_use]
    pub fn euler_characteristic(&self) -> i64 {
        let used = self.vertices().filter(|&v| self.valence(v) > 0).count();
        used as i64 - self.edge_count() as i64 + self.face_count() as i64
    }

    /// The genus, summed over the components: how many handles the surface has once its holes are filled.
    ///
    /// O(vertices + edges).
    ///
    /// ```
    /// use vvmesh::shapes;
    /// let torus = shapes::torus(5, 4, 2.0, 1.0);
    /// assert_eq!((torus.rotation().euler_characteristic(), torus.rotation().genus()), (0, 1));
    /// let grid = shapes::grid(3, 2);
    /// assert_eq!((grid.rotation().euler_characteristic(), grid.rotation().genus()), (1, 0));
    /// ```
    #[must_use]
    pub fn genus(&self) -> usize {
        // With its holes filled a component has V − E + F = 2 − 2g.
        let filled = self.euler_characteristic() + self.boundary_loops().len() as i64;
        let twice = 2 * self.components().len() as i64 - filled;
        usize::try_from(twice / 2).expect("a surface has a genus of at least 0")
    }

    /// Goes round every face, in the order of [`RotationSystem::faces`].
    fn trace_faces(&self, mut visit: impl FnMut(Step)) {
        let reverse = ReverseSlots::new(self);
        let mut visited = vec![false; reverse.edge_count()];
        // The end of an edge, and the slot there at which its face goes on; `None` if a gap is on its left.
        let step = |v: VertexId, slot: usize| {
            let w = self.neighbors(v)[slot];
            let arriving = reverse.get(v, slot).expect("a committed system is symmetric");
            self.ring(w).slot_before(arriving).map(|slot| (w, slot))
        };
        for v in self.vertices() {
            for slot in 0..self.valence(v) {
                let first = reverse.number(v, slot);
                if visited[first] || step(v, slot).is_none() {
                    continue;
                }
                let mut at = (v, slot);
                while !std::mem::replace(&mut visited[reverse.number(at.0, at.1)], true) {
                    visit(Step::Vertex(at.0));
                    at = step(at.0, at.1).expect("a face has no gap on its left anywhere");
                }
                visit(Step::End);
            }
        }
    }
}

/// What is met on the way round the faces.
enum Step {
    /// The start of the next directed edge.
    Vertex(VertexId),
    /// The face is round.
    End,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::id::Triangle;
    use crate::rotation::RingBuf;
    use crate::shapes;

    fn ids<const N: usize>(indices: [usize; N]) -> [VertexId; N] {
        indices.map(VertexId::new)
    }

    #[test]
    fn faces_of_a_tetrahedron_are_its_triangles_seen_from_outside() {
        let mesh = shapes::tetrahedron();
        let faces: Vec<Triangle> =
            mesh.rotation().faces().iter().map(|face| Triangle::new(face[0], face[1], face[2])).collect();
        assert_eq!(faces, mesh.triangles().collect::<Vec<_>>());
        assert!(faces.contains(&Triangle::new(VertexId::new(0), VertexId::new(1), VertexId::new(2))));
    }

    #[test]
    fn a_triangular_hole_is_a_loop_and_no_face() {
        let [a, b, c] = ids([0, 1, 2]);
        let mesh = crate::Mesh::from_triangles(vec![glam::DVec3::ZERO; 4], &[[0, 1, 2]]).unwrap();
        let system = mesh.rotation();
        assert_eq!(system.faces().iter().collect::<Vec<_>>(), [[a, b, c]]);
        assert_eq!(system.boundary_loops().iter().collect::<Vec<_>>(), [[a, c, b]]);
        assert_eq!(system.components().iter().collect::<Vec<_>>(), [[a, b, c]]);
        assert_eq!((system.euler_characteristic(), system.genus()), (1, 0));
        assert!(system.face(DirectedEdge::new(b, a)).is_none());
        assert_eq!(system.face(DirectedEdge::new(b, c)).unwrap().count(), 3);
    }

    #[test]
    fn any_rotation_system_has_faces() {
        // A path of three vertices on a sphere: one face that sees both sides of both edges.
        let [a, b, c, d] = ids([0, 1, 2, 3]);
        let path =
            RotationSystem::from_rings(vec![RingBuf::closed(&[b]), RingBuf::closed(&[a, c]), RingBuf::closed(&[b])]);
        assert_eq!(path.faces().iter().collect::<Vec<_>>(), [[a, b, c, b]]);
        assert_eq!((path.euler_characteristic(), path.genus()), (2, 0));
        // Four vertices, each next to all others, with rings that make a torus.
        let torus = RotationSystem::from_rings(vec![
            RingBuf::closed(&[b, c, d]),
            RingBuf::closed(&[a, c, d]),
            RingBuf::closed(&[a, b, d]),
            RingBuf::closed(&[a, b, c]),
        ]);
        assert_eq!((torus.face_count(), torus.euler_characteristic(), torus.genus()), (2, 0, 1));
        // An edge with the outside all around it.
        let edge = RotationSystem::from_rings(vec![RingBuf::open(&[b]), RingBuf::open(&[a])]);
        assert_eq!((edge.face_count(), edge.boundary_loops().len(), edge.genus()), (0, 1, 0));
        let nothing = RotationSystem::with_isolated(3);
        assert_eq!((nothing.components().len(), nothing.euler_characteristic(), nothing.genus()), (0, 0, 0));
    }

    #[test]
    fn a_vertex_of_high_valence_costs_no_more() {
        let count = 100_000;
        let rim = |k: usize| VertexId::new(1 + k % count);
        let hub: Vec<VertexId> = (0..count).map(rim).collect();
        let mut rings = vec![RingBuf::closed(&hub)];
        rings.extend((0..count).map(|k| RingBuf::open(&[rim(k + 1), VertexId::new(0), rim(k + count - 1)])));
        let wheel = RotationSystem::from_rings(rings);
        assert_eq!((wheel.face_count(), wheel.boundary_loops().len(), wheel.genus()), (count, 1, 0));
    }
}
