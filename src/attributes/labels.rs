//! Labels of faces: a face of the refined mesh has the label of the input face in which it lies.

use smallvec::SmallVec;

use crate::id::{Triangle, VertexId};
use crate::mesh::Mesh;

/// From which faces the faces of a refined mesh descend.
///
/// Nothing is kept of a face: where its corners come from tells the face of the step before in which it lies, and so on
/// back. 8 bytes a new vertex.
#[derive(Clone, Debug)]
pub(super) struct Ancestry {
    /// How many vertices there were at the start, and after each step.
    starts: Vec<usize>,
    /// Of every vertex made since the start the ends of the edge it was made on.
    parents: Vec<[VertexId; 2]>,
}

impl Ancestry {
    pub(super) fn new(mesh: &Mesh) -> Self {
        Self { starts: vec![mesh.vertex_count()], parents: Vec::new() }
    }

    /// Takes the vertices that a step made.
    pub(super) fn record(&mut self, parents: &[[VertexId; 2]]) {
        self.parents.extend_from_slice(parents);
        self.starts.push(self.starts[0] + self.parents.len());
    }

    /// The corners, ascending, of the face in which a face lies in the mesh as it was when it had so many vertices.
    /// O(steps).
    fn face_among(&self, vertex_count: usize, face: Triangle) -> [VertexId; 3] {
        let mut corners = face.corners();
        corners.sort_unstable();
        while corners[2].index() >= vertex_count {
            corners = self.face_before(corners);
        }
        corners
    }

    /// The corners, ascending, of the face that the step made a face of by which its newest corner was made.
    ///
    /// A step leaves a face as it is, or makes faces of it that all have a new corner. New corners lie on the edges of
    /// the old face, so with both ends for each of them its three corners come out.
    fn face_before(&self, corners: [VertexId; 3]) -> [VertexId; 3] {
        let step = self.starts.partition_point(|&start| start <= corners[2].index());
        let start = self.starts[step - 1];
        let mut old: SmallVec<[VertexId; 6]> = SmallVec::new();
        for v in corners {
            if v.index() < start {
                old.push(v);
            } else {
                old.extend(self.parents[v.index() - self.starts[0]]);
            }
        }
        old.sort_unstable();
        old.dedup();
        <[VertexId; 3]>::try_from(&old[..]).expect("a face lies in one face of the step before")
    }
}

/// A named label for each face that there was when they were added.
#[derive(Clone, Debug)]
pub(super) struct FaceLabels {
    name: String,
    /// How many vertices there were.
    vertex_count: usize,
    /// By the corners of the face, ascending.
    labels: Vec<([VertexId; 3], u32)>,
}

impl FaceLabels {
    /// Labels of the triangles of a mesh, in their order.
    pub(super) fn new(name: String, mesh: &Mesh, labels: &[u32]) -> Self {
        let corners = mesh.triangles().map(|triangle| {
            let mut corners = triangle.corners();
            corners.sort_unstable();
            corners
        });
        let mut labels: Vec<_> = corners.zip(labels.iter().copied()).collect();
        labels.sort_unstable();
        Self { name, vertex_count: mesh.vertex_count(), labels }
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// The label of the face in which a face lies. O(steps + log faces).
    pub(super) fn of(&self, face: Triangle, ancestry: &Ancestry) -> u32 {
        let corners = ancestry.face_among(self.vertex_count, face);
        let place = self.labels.binary_search_by_key(&corners, |&(corners, _)| corners);
        self.labels[place.expect("it was a face")].1
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn faces_are_traced_back_over_steps() {
        let [a, b, c, d, e, x, y] = [0, 1, 2, 3, 4, 5, 6].map(VertexId::new);
        let mut ancestry = Ancestry { starts: vec![4], parents: Vec::new() };
        // 4 on 0-1, then 5 on 0-4 and 6 on 4-2.
        ancestry.record(&[[a, b]]);
        ancestry.record(&[[a, e], [e, c]]);
        assert_eq!(ancestry.starts, [4, 5, 7]);
        assert_eq!(ancestry.face_among(5, Triangle::new(x, y, a)), [a, c, e]);
        assert_eq!(ancestry.face_among(4, Triangle::new(x, y, a)), [a, b, c]);
        assert_eq!(ancestry.face_among(4, Triangle::new(c, b, d)), [b, c, d]);
    }

    #[test]
    fn labels_are_those_of_the_faces_in_order() {
        let mesh = shapes::octahedron();
        let labels = FaceLabels::new("number".into(), &mesh, &[0, 1, 2, 3, 4, 5, 6, 7]);
        let ancestry = Ancestry::new(&mesh);
        assert!(mesh.triangles().map(|face| labels.of(face, &ancestry)).eq(0..8));
    }
}
