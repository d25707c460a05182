//! What becomes of a boundary.

use super::{Mesh, Sharpness};

/// How the vertices of a boundary are treated; it is put on a mesh as corner tags before the first step.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum BoundaryPolicy {
    /// Boundaries are smooth curves; no vertex is a corner for lying on one.
    #[default]
    Smooth,
    /// Boundary vertices of valence 2, the tips of single triangles, are corners.
    Corners,
    /// All boundary vertices that the mesh has now are corners; those made later lie on smooth curves between them.
    Fixed,
}

impl Mesh {
    /// Tags boundary vertices as corners, as the policy says. Corners that are tagged already stay so. O(vertices).
    pub fn apply_boundary_policy(&mut self, policy: BoundaryPolicy) {
        for v in self.vertices() {
            let ring = self.ring(v);
            let corner = ring.is_open()
                && match policy {
                    BoundaryPolicy::Smooth => false,
                    BoundaryPolicy::Corners => ring.valence() == 2,
                    BoundaryPolicy::Fixed => true,
                };
            if corner {
                self.tags.set_vertex_sharpness(v, Sharpness::INFINITE);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn a_grid_has_two_tips_and_ten_boundary_vertices() {
        let tagged = |policy| {
            let mut mesh = shapes::grid(3, 2);
            mesh.apply_boundary_policy(policy);
            mesh.tags().corners().len()
        };
        assert_eq!([BoundaryPolicy::Smooth, BoundaryPolicy::Corners, BoundaryPolicy::Fixed].map(tagged), [0, 2, 10]);
    }
}
