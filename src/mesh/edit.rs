//! Local edits of a mesh: rings, positions and tags together, or nothing.
//!
//! **Deliberately not here**: where a new vertex should be. The caller says it.

use glam::DVec3;

use super::Mesh;
use crate::error::EditError;
use crate::id::{Edge, VertexId};

impl Mesh {
    /// Puts a new vertex on an edge, joins it to the corners opposite, and answers its id: of each triangle beside the
    /// edge become two.
    ///
    /// The halves of a sharp edge are as sharp as it was: this is no step, in which sharpness fades. The new ring is
    /// `[a, right, b, left]` as told at
    /// [`RotationSystem::split_edge_triangles`](crate::RotationSystem::split_edge_triangles). O(valence).
    ///
    /// # Errors
    /// [`EditError::NonFinite`], [`EditError::NoVertex`], [`EditError::NoEdge`], [`EditError::TooManyVertices`].
    ///
    /// ```
    /// use vvmesh::shapes;
    /// let mut mesh = shapes::icosahedron();
    /// let [a, b] = mesh.edges().next().unwrap().ends();
    /// let middle = mesh.position(a).midpoint(mesh.position(b));
    /// let x = mesh.split_edge(a, b, middle)?;
    /// assert_eq!((mesh.face_count(), mesh.ring(x).valence(), mesh.position(x)), (22, 4, middle));
    /// # Ok::<(), vvmesh::error::EditError>(())
    /// ```
    pub fn split_edge(&mut self, a: VertexId, b: VertexId, position: DVec3) -> Result<VertexId, EditError> {
        require_finite(position)?;
        let x = self.rotation.split_edge_triangles(a, b)?;
        self.positions.push(position);
        self.tags.split(Edge::new(a, b), x);
        Ok(x)
    }

    /// Turns the edge between two triangles to join the corners opposite to it, and answers the new edge, which is not
    /// sharp.
    ///
    /// O(valence).
    ///
    /// # Errors
    /// [`EditError::Sharp`] for an edge tagged sharp; else as
    /// [`RotationSystem::flip`](crate::RotationSystem::flip).
    pub fn flip(&mut self, a: VertexId, b: VertexId) -> Result<Edge, EditError> {
        let edge = Edge::new(a, b);
        if self.tags.is_sharp(edge) {
            return Err(EditError::Sharp(edge));
        }
        self.rotation.flip(a, b)
    }

    /// Draws an edge together: `remove` goes to `keep`, which takes the position given, and stays behind as an isolated
    /// vertex where it was.
    ///
    /// Tags go along: an edge is as sharp afterwards as the sharper of those it came from, and so is `keep`. So creases that
    /// end at the collapsed edge are joined there. `remove` keeps no tag. O(valence) of both ends and of the neighbours of
    /// `remove`.
    ///
    /// # Errors
    /// [`EditError::NonFinite`]; else as [`RotationSystem::collapse`](crate::RotationSystem::collapse), the link condition.
    pub fn collapse(&mut self, keep: VertexId, remove: VertexId, position: DVec3) -> Result<(), EditError> {
        require_finite(position)?;
        self.rotation.collapse(keep, remove)?;
        self.positions[keep.index()] = position;
        self.tags.merge(keep, remove);
        Ok(())
    }
}

fn require_finite(position: DVec3) -> Result<(), EditError> {
    if position.is_finite() { Ok(()) } else { Err(EditError::NonFinite) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn a_crease_survives_split_and_collapse_and_is_not_flipped() {
        // The middle row of the grid is a crease, 3-4-5.
        let mut mesh = shapes::grid(2, 2);
        let [a, b, c] = [3, 4, 5].map(VertexId::new);
        for edge in [Edge::new(a, b), Edge::new(b, c)] {
            assert!(mesh.set_sharp(edge, true));
        }
        mesh.set_corner(b, true);
        assert_eq!(mesh.flip(a, b), Err(EditError::Sharp(Edge::new(a, b))));
        let x = mesh.split_edge(a, b, DVec3::new(0.25, 1.0, 0.0)).unwrap();
        assert_eq!(mesh.tags().sharp_edges(), [Edge::new(a, x), Edge::new(b, c), Edge::new(b, x)]);
        mesh.collapse(x, b, DVec3::ONE).unwrap();
        assert_eq!(mesh.tags().sharp_edges(), [Edge::new(a, x), Edge::new(c, x)]);
        assert_eq!((mesh.tags().corners(), mesh.position(x)), (vec![x], DVec3::ONE));
        assert!(mesh.tags().sharp_neighbors(b).is_empty());
        assert_eq!(mesh.rotation().validate_triangles(), []);
    }

    #[test]
    fn nothing_changes_without_a_number() {
        let mut mesh = shapes::octahedron();
        let [a, b] = mesh.edges().next().unwrap().ends();
        let nowhere = DVec3::new(0.0, f64::NAN, 0.0);
        assert_eq!(mesh.split_edge(a, b, nowhere), Err(EditError::NonFinite));
        assert_eq!(mesh.collapse(a, b, nowhere), Err(EditError::NonFinite));
        assert_eq!((mesh.vertex_count(), mesh.face_count()), (6, 8));
    }
}
