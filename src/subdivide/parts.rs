//! What becomes of selected edges and faces where triangles are split in four: their halves, and the faces made of them.
//!
//! Vertices stay, so a selection of those is followed by itself and what is new between them; an edge that is split is no more,
//! and neither is a face at it.
//!
//! **Deliberately not here**: selections of vertices, which each kind of split follows in its own way.

use crate::id::{Edge, Triangle, VertexId};
use crate::rotation::RotationSystem;
use crate::select::{Elements, Selection};
use crate::split::hierarchy::leaf_of;
use crate::step::Hierarchy;

/// What becomes of selected edges and faces where these edges are split. `odd` has the vertex that splits one, and the rings
/// are those after the step; of these only those of faces with two split edges are read.
pub(super) fn follow(
    edges_or_faces: &Selection,
    odd: impl Fn(Edge) -> Option<VertexId>,
    rotation: &RotationSystem,
) -> Selection {
    match edges_or_faces.elements() {
        Elements::Vertices(_) => unreachable!("vertices stay"),
        Elements::Edges(edges) => edges.iter().flat_map(|&edge| halves(edge, odd(edge))).collect(),
        Elements::Faces(faces) => {
            let parts = |face: &Triangle| {
                let [ab, bc, ca] = face.edges();
                parts(face.corners(), [bc, ca, ab].map(&odd), rotation)
            };
            faces.iter().flat_map(parts).flatten().collect()
        }
    }
}

/// The leaves in which these faces lie, each once.
pub(super) fn leaves(hierarchy: &Hierarchy, faces: &[Triangle]) -> Vec<[VertexId; 3]> {
    let mut leaves: Vec<[VertexId; 3]> = faces.iter().map(|&face| leaf_of(hierarchy, face)).collect();
    leaves.sort_unstable_by_key(|&[a, b, c]| Triangle::new(a, b, c));
    leaves.dedup_by_key(|&mut [a, b, c]| Triangle::new(a, b, c));
    leaves
}

/// What is shown of triangles of a hierarchy in which no leaf has two split edges.
pub(super) fn shown(hierarchy: &Hierarchy, rotation: &RotationSystem, mut triangles: Vec<[VertexId; 3]>) -> Selection {
    let mut faces = Vec::new();
    while let Some(corners) = triangles.pop() {
        let made = parts(corners, hierarchy.odds(corners), rotation).into_iter().flatten();
        if hierarchy.is_split(corners) {
            triangles.extend(made.map(Triangle::corners));
        } else {
            faces.extend(made);
        }
    }
    faces.into_iter().collect()
}

fn halves(edge: Edge, odd: Option<VertexId>) -> impl Iterator<Item = Edge> {
    let [p, q] = edge.ends();
    let halves = match odd {
        Some(x) => [Some(Edge::new(p, x)), Some(Edge::new(x, q))],
        None => [Some(edge), None],
    };
    halves.into_iter().flatten()
}

/// The faces made of a triangle. `odds` are the vertices that split its edges: opposite to the first corner, to the second,
/// to the third.
fn parts(corners: [VertexId; 3], odds: [Option<VertexId>; 3], rotation: &RotationSystem) -> [Option<Triangle>; 4] {
    let [a, b, c] = corners;
    let face = |a, b, c| Some(Triangle::new(a, b, c));
    match odds {
        [None, None, None] => [face(a, b, c), None, None, None],
        [None, None, Some(ab)] => [face(a, ab, c), face(ab, b, c), None, None],
        [Some(bc), Some(ca), None] => {
            let diagonal = match rotation.left_of(a, b) == Some(bc) {
                true => [face(a, b, bc), face(a, bc, ca)],
                false => [face(a, b, ca), face(b, bc, ca)],
            };
            [face(bc, c, ca), diagonal[0], diagonal[1], None]
        }
        [Some(bc), Some(ca), Some(ab)] => [face(a, ab, ca), face(ab, b, bc), face(ca, bc, c), face(ab, bc, ca)],
        // The same from another corner.
        [of_a, of_b, of_c] => parts([b, c, a], [of_b, of_c, of_a], rotation),
    }
}
