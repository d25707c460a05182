//! How large a mesh becomes.

use glam::DVec3;

use crate::mesh::Mesh;
use crate::rotation::RingBuf;

/// Neighbours that a ring has room for without memory of its own, the gap of an open one counted.
const INLINE: usize = 6;

/// The sizes of the mesh that uniform steps make, to be known before they are made.
///
/// ```
/// use vvmesh::{predict::FullSize, shapes};
/// let size = FullSize::new(&shapes::octahedron(), 3).unwrap();
/// assert_eq!((size.vertices, size.edges, size.faces), (258, 768, 512));
/// assert_eq!(FullSize::new(&shapes::octahedron(), 31), None);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct FullSize {
    /// Vertices, isolated ones counted.
    pub vertices: u64,
    /// Edges.
    pub edges: u64,
    /// Faces: those of the input, times 4 at each step.
    pub faces: u64,
    /// What its rings and positions take. To make it takes more for a moment, as the mesh before is still there.
    pub memory_bytes: u64,
}

impl FullSize {
    /// The mesh after so many steps; `None` if 64 bits do not hold the numbers. O(vertices + depth).
    #[must_use]
    pub fn new(mesh: &Mesh, depth: u32) -> Option<Self> {
        let mut sizes = [mesh.vertex_count(), mesh.edge_count(), mesh.face_count()].map(|size| size as u64);
        for _ in 0..depth {
            let [vertices, edges, faces] = sizes;
            sizes = [
                vertices.checked_add(edges)?,
                edges.checked_mul(2)?.checked_add(faces.checked_mul(3)?)?,
                faces.checked_mul(4)?,
            ];
        }
        // New rings are short: what the long ones hold is what it was.
        let entries = mesh.vertices().map(|v| mesh.ring(v).valence() + usize::from(mesh.is_boundary(v)));
        let long: usize = entries.filter(|&entries| entries > INLINE).sum();
        let [vertices, edges, faces] = sizes;
        let memory_bytes = vertices
            .checked_mul((size_of::<RingBuf>() + size_of::<DVec3>()) as u64)?
            .checked_add((long * size_of::<crate::id::VertexId>()) as u64)?;
        Some(Self { vertices, edges, faces, memory_bytes })
    }
}
