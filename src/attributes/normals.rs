//! Normals at the corners of faces, computed from a mesh.

use glam::DVec3;

use super::chart::Chart;
use crate::id::VertexId;
use crate::limit::{AnyLimit, Limit, Normals};
use crate::mesh::Mesh;
use crate::query::measure::{NormalWeight, vertex_normal};

/// What becomes of the normals that a file has.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum NormalRule {
    /// They stay until the mesh is refined; then it is [`NormalRule::Recompute`], if there were any.
    #[default]
    Keep,
    /// The mean of the faces around each vertex, weighted by their angles. Where the normals of the file differed on
    /// the two sides of an edge, the edge is hard: the faces on each side are taken by themselves.
    Recompute,
    /// The normals of the limit surface of a scheme, which differ on the two sides of sharp edges.
    Limit(AnyLimit),
    /// There are none.
    Drop,
}

/// Normals, with the number of the one at each corner of each face; `None` where it is not defined.
#[derive(Default)]
pub(super) struct CornerNormals {
    pub(super) values: Vec<DVec3>,
    pub(super) corners: Vec<Option<u32>>,
}

impl CornerNormals {
    /// [`NormalRule::Recompute`]: one for each vertex of the chart mesh whose boundaries are the hard edges; without a chart
    /// mesh there are none.
    pub(super) fn recomputed(mesh: &Mesh, chart: Option<&Chart>, faces: &[[VertexId; 3]]) -> Self {
        let weight = NormalWeight::default();
        let Some(chart) = chart else {
            let mut normals = Self::default();
            let number_of: Vec<_> = mesh.vertices().map(|v| normals.push(vertex_normal(mesh, v, weight))).collect();
            normals.corners.extend(faces.iter().flatten().map(|v| number_of[v.index()]));
            return normals;
        };
        let lifted = chart.lifted(mesh);
        let mut normals = Self::default();
        let number_of: Vec<_> = lifted.vertices().map(|v| normals.push(vertex_normal(&lifted, v, weight))).collect();
        for &face in faces {
            match chart.face_over(face) {
                Some(over) => normals.corners.extend(over.map(|v| number_of[v.index()])),
                None => normals.corners.extend([None; 3]),
            }
        }
        normals
    }

    /// Keeps a normal, and answers its number.
    fn push(&mut self, normal: Option<DVec3>) -> Option<u32> {
        let number = self.values.len() as u32;
        self.values.extend(normal);
        normal.map(|_| number)
    }
}

/// [`NormalRule::Limit`]: one for each side of each vertex.
#[derive(Clone, Debug)]
pub(super) struct SideNormals {
    limit: AnyLimit,
    normals: Normals,
}

impl SideNormals {
    /// Those of the limit of a mesh.
    pub(super) fn new(mesh: &Mesh, limit: AnyLimit) -> Self {
        Self { limit, normals: limit.normals(mesh) }
    }

    /// Those of the vertices.
    pub(super) fn normals(&self) -> &Normals {
        &self.normals
    }

    /// Those at the corners of faces.
    pub(super) fn at_corners(&self, mesh: &Mesh, faces: &[[VertexId; 3]]) -> CornerNormals {
        let mut normals = CornerNormals::default();
        let number_of: Vec<_> =
            mesh.vertices().flat_map(|v| self.normals.of(v)).map(|&normal| normals.push(normal)).collect();
        let around = mesh.neighborhood();
        let number = |(v, next): (VertexId, VertexId)| {
            let places = self.normals.places(v);
            let side = if places.len() == 1 { 0 } else { self.limit.side_at(around, v, around.slot_of(v, next)?)? };
            number_of[places.start + side]
        };
        let directed = faces.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        normals.corners.extend(directed.map(number));
        normals
    }
}
