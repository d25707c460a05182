//! Normals at the corners of faces, computed from a mesh.

use glam::DVec3;

use super::chart::Chart;
use crate::id::VertexId;
use crate::limit::LoopLimit;
use crate::mesh::{Mesh, VertexClass};
use crate::query::measure::{NormalWeight, vertex_normal};

/// What becomes of the normals that a file has.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Normals {
    /// They stay until the mesh is refined; then it is [`Normals::Recompute`], if there were any.
    #[default]
    Keep,
    /// The mean of the faces around each vertex, weighted by their angles. Where the normals of the file differed on the two
    /// sides of an edge, the edge is hard: the faces on each side are taken by themselves.
    Recompute,
    /// The normals of the limit surface of Loop's scheme, which differ on the two sides of sharp edges.
    Limit(LoopLimit),
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
    /// [`Normals::Recompute`]: one for each vertex of the chart mesh whose boundaries are the hard edges; without one there
    /// are none.
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
            match chart.face_over(mesh, face) {
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

/// [`Normals::Limit`]: one for each side of each vertex.
#[derive(Clone, Debug)]
pub(super) struct SideNormals {
    values: Vec<DVec3>,
    /// Of all sides, those of one vertex after those of another; `None` where none is defined.
    numbers: Vec<Option<u32>>,
    /// Where the sides of each vertex start.
    first_side: Vec<usize>,
}

impl SideNormals {
    /// Those of the limit of a mesh.
    pub(super) fn new(mesh: &Mesh, limit: LoopLimit) -> Self {
        let around = mesh.neighborhood();
        let mut sides = Self { values: Vec::new(), numbers: Vec::new(), first_side: Vec::new() };
        for v in mesh.vertices() {
            sides.first_side.push(sides.numbers.len());
            for side in 0..limit.side_count(around, v) {
                let normal = limit.normal(mesh, v, side);
                sides.numbers.push(normal.map(|_| sides.values.len() as u32));
                sides.values.extend(normal);
            }
        }
        sides
    }

    /// Those at the corners of faces.
    pub(super) fn at_corners(self, mesh: &Mesh, faces: &[[VertexId; 3]]) -> CornerNormals {
        let around = mesh.neighborhood();
        let side = |v: VertexId, next: VertexId| match around.class(v) {
            VertexClass::Smooth | VertexClass::Dart => Some(0),
            VertexClass::Crease | VertexClass::Corner => {
                let slot = around.slot_of(v, next)?;
                around.sectors(v).position(|sector| sector.has_face(slot))
            }
        };
        let directed = faces.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let number = |(v, next): (VertexId, VertexId)| {
            self.numbers.get(self.first_side[v.index()] + side(v, next)?).copied().flatten()
        };
        CornerNormals { corners: directed.map(number).collect(), values: self.values }
    }
}
