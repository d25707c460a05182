//! What is wrong with a list of faces.

use glam::DVec3;

use super::FaceList;
use super::disjoint::DisjointSets;
use super::sieve::Sieve;
use super::table::{EdgeTable, Fans, TableEdge};
use crate::error::{Defect, DefectKind};
use crate::id::VertexId;
use crate::parallel;

impl FaceList {
    /// Every defect of the list: whatever keeps its faces from being an oriented 2-manifold, with or without boundary.
    ///
    /// Each face is looked at by itself first; those with an index out of range, degenerate ones and duplicates are told
    /// and set aside, so one of them does not bring forth other defects. Of the rest each edge with three or more faces
    /// is told, each vertex whose faces form two or more fans, and each edge whose two faces run the same way. If a
    /// component cannot be mended by turning faces round, that is told once, in place of its edges. The list is empty
    /// exactly if [`Mesh::from_triangles`](crate::Mesh::from_triangles) accepts the faces, provided they are triangles;
    /// faces of more sides are no defect here.
    ///
    /// In the order of [`DefectKind`], then by ids.
    ///
    /// ```
    /// use vvmesh::{error::DefectKind, glam::DVec3, soup::FaceList};
    /// let list = FaceList::from_triangles(vec![DVec3::ZERO; 4], &[[0, 1, 2], [0, 1, 3]]);
    /// let defects = list.defects();
    /// assert_eq!((defects.len(), defects[0].kind), (1, DefectKind::Orientation));
    /// assert_eq!(defects[0].to_string(), "faces 0 and 1 both run from v0 to v1");
    /// ```
    ///
    /// # Complexity
    /// O(n log n) in the number of corners, O(n) for short faces of few neighbours.
    #[must_use]
    pub fn defects(&self) -> Vec<Defect> {
        let sieve = Sieve::new(self);
        let table = EdgeTable::new(self, &sieve.kept);
        let mut defects = sieve.defects;
        defects.extend(non_finite(&self.positions[..self.vertex_limit()]));
        defects.extend(non_manifold_edges(&table));
        defects.extend(bow_ties(&table, &mut Fans::new(&table)));
        defects.extend(orientation(&table));
        defects.extend(too_many_vertices(self));
        defects.sort_by_key(|defect| defect.kind);
        defects
    }

    /// One more than the greatest index that names a vertex.
    pub(crate) fn vertex_limit(&self) -> usize {
        self.vertex_count().min(VertexId::MAX_INDEX + 1)
    }
}

/// One for each vertex with a coordinate that is no finite number.
pub(crate) fn non_finite(positions: &[DVec3]) -> Vec<Defect> {
    parallel::gather(0..positions.len(), |k| {
        let (v, p) = (VertexId::new(k), positions[k]);
        (!p.is_finite()).then(|| Defect {
            kind: DefectKind::NonFinite,
            vertices: vec![v],
            faces: Vec::new(),
            message: format!("{v} is at ({}, {}, {}), which is not finite", p.x, p.y, p.z),
        })
    })
}

/// One for each edge with three or more faces.
pub(crate) fn non_manifold_edges(table: &EdgeTable<'_>) -> impl Iterator<Item = Defect> {
    table.edges().filter(|edge| edge.face_count() > 2).map(|edge| {
        let faces: Vec<usize> = edge.faces().collect();
        Defect {
            kind: DefectKind::NonManifoldEdge,
            vertices: edge.name().ends().to_vec(),
            message: format!(
                "edge {} has {} faces ({}), at most 2 are possible",
                edge.name(),
                faces.len(),
                enumerated(faces.iter().map(usize::to_string))
            ),
            faces,
        }
    })
}

/// One for each vertex with two or more fans.
pub(crate) fn bow_ties(table: &EdgeTable<'_>, fans: &mut Fans) -> Vec<Defect> {
    let counts = fans.counts(table);
    let mut around: Vec<(u32, usize)> =
        table.corners().filter(|&(_, v, _)| counts[v as usize] > 1).map(|(_, v, face)| (v, face)).collect();
    around.sort_unstable();
    let defect = |at: &[(u32, usize)]| {
        let (v, fans) = (VertexId::new(at[0].0 as usize), counts[at[0].0 as usize]);
        let faces: Vec<usize> = at.iter().map(|&(_, face)| face).collect();
        let names = enumerated(faces.iter().map(usize::to_string));
        Defect {
            kind: DefectKind::BowTie,
            vertices: vec![v],
            message: format!("{fans} fans of faces meet in {v} alone (faces {names})"),
            faces,
        }
    };
    around.chunk_by(|p, q| p.0 == q.0).map(defect).collect()
}

/// One for each edge with two faces that run the same way, but for a component that no turning of faces mends only one.
///
/// Two faces belong to one component if a chain of edges with two faces leads from one to the other.
pub(crate) fn orientation(table: &EdgeTable<'_>) -> Vec<Defect> {
    let two_sided = || table.edges().filter(|edge| edge.face_count() == 2);
    let runs_same_way = |edge: TableEdge<'_>| {
        let mut directions = edge.directions();
        directions.next() == directions.next()
    };
    if !two_sided().any(runs_same_way) {
        return Vec::new();
    }
    // Each face stands twice, as it is (2f) and turned round (2f + 1). An edge links what agrees across it; a component
    // is one-sided exactly if it links a face to its own reverse.
    let mut sheets = DisjointSets::new(2 * table.face_limit());
    let mut failing = Vec::new();
    for edge in two_sided() {
        let [f, g] = two_faces(edge);
        let turned = u32::from(runs_same_way(edge));
        if sheets.find(2 * f) == sheets.find((2 * g + 1) ^ turned) && sheets.find(2 * f) != sheets.find(2 * f + 1) {
            failing.push(edge);
        }
        sheets.join(2 * f, (2 * g) ^ turned);
        sheets.join(2 * f + 1, (2 * g + 1) ^ turned);
    }
    let mut defects = Vec::new();
    for edge in two_sided().filter(|&edge| runs_same_way(edge)) {
        let [f, g] = two_faces(edge);
        if sheets.find(2 * f) != sheets.find(2 * f + 1) {
            let [mut a, mut b] = edge.name().ends();
            if edge.directions().next() == Some(false) {
                (a, b) = (b, a);
            }
            let message = format!("faces {f} and {g} both run from {a} to {b}");
            defects.push(at_edge(DefectKind::Orientation, edge, message));
        }
    }
    // Components that failed apart may have been linked afterwards; the first edge speaks for both.
    let mut told: Vec<(u32, usize)> =
        failing.iter().enumerate().map(|(k, &edge)| (sheets.find(2 * two_faces(edge)[0]), k)).collect();
    told.sort_unstable();
    told.dedup_by_key(|&mut (component, _)| component);
    told.sort_unstable_by_key(|&(_, k)| k);
    for (_, k) in told {
        let ([f, g], name) = (two_faces(failing[k]), failing[k].name());
        let message = format!(
            "the component of face {f} is one-sided: however its faces are turned, some disagree, \
             for example faces {f} and {g} at edge {name}"
        );
        defects.push(at_edge(DefectKind::NonOrientable, failing[k], message));
    }
    defects
}

fn two_faces(edge: TableEdge<'_>) -> [u32; 2] {
    let mut faces = edge.faces().map(|face| face as u32);
    [(); 2].map(|()| faces.next().expect("the edge has two faces"))
}

fn at_edge(kind: DefectKind, edge: TableEdge<'_>, message: String) -> Defect {
    Defect { kind, vertices: edge.name().ends().to_vec(), faces: edge.faces().collect(), message }
}

/// One if there are too many.
pub(crate) fn too_many_vertices(list: &FaceList) -> Option<Defect> {
    let (count, limit) = (list.vertex_count(), list.vertex_limit());
    (count > limit).then(|| Defect {
        kind: DefectKind::TooManyVertices,
        vertices: Vec::new(),
        faces: Vec::new(),
        message: format!("there are {count} vertices, 32-bit ids name at most {limit}"),
    })
}

/// Names for vertices that exist.
pub(super) fn vertex_ids(indices: impl Iterator<Item = u32>) -> Vec<VertexId> {
    indices.map(|v| VertexId::new(v as usize)).collect()
}

/// How many things a sentence names; the rest are counted.
const NAMED: usize = 8;

/// Things one by one, as in "1, 2 and 3", or the first of many and the number of the rest.
pub(crate) fn enumerated(things: impl ExactSizeIterator<Item = String>) -> String {
    let count = things.len();
    let mut text = String::new();
    for (k, thing) in things.take(NAMED).enumerate() {
        let separator = match k {
            0 => "",
            _ if k + 1 == count => " and ",
            _ => ", ",
        };
        text.push_str(separator);
        text.push_str(&thing);
    }
    if count > NAMED {
        text.push_str(&format!(" and {} more", count - NAMED));
    }
    text
}
