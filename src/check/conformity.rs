//! Whether faces make a conforming mesh: what they share is nothing, one vertex or one whole edge.

use super::geometry::Boundary;
use super::{Finding, FindingKind};
use crate::error::{Defect, DefectKind};
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::soup::{self, EdgeTable, FaceList, Fans, Sieve};

/// What [`conformity`] found.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub struct Report {
    /// Everything that was found, in the order of [`FindingKind`], then by ids.
    pub findings: Vec<Finding>,
    /// The distance up to which a vertex counts as lying on an edge.
    pub tolerance: f64,
}

impl Report {
    /// Whether nothing was found, isolated vertices apart. A boundary is no defect.
    #[must_use]
    pub fn is_conforming(&self) -> bool {
        self.findings.iter().all(|finding| finding.kind.is_harmless())
    }
}

/// Looks for everything that keeps a list of faces from being a conforming mesh.
///
/// Faces may have any number of sides. Faces with an index out of range, degenerate ones and duplicates are told and set
/// aside first, so a face that stands twice hides no boundary.
///
/// - A *T-junction* is a boundary edge with a boundary vertex within the tolerance of its inside; a vertex within the
///   tolerance of one of the ends is not inside. There is one finding for each such edge, with its ends and the vertices
///   on it from the smaller end on (the first 64 found, if there are more), and its face.
/// - A *crack* is a loop of three boundary edges, of which the vertex off the longest edge is away from it by more than
///   the tolerance and by less than a quarter of its length, and stands over its middle half. At one of the three
///   vertices the loop must be all of the boundary there, and the loop must not be the outline of one single face. Any
///   other triangular loop is a hole and no finding.
/// - A *bow-tie* is told where it would stay one after closing T-junctions and cracks: along a chain of them every
///   vertex has a fan on either side, which is no second defect.
/// - The other kinds are those of [`FaceList::defects`]. Isolated vertices are told, but the rest can be conforming.
///
/// `tolerance` is a distance; what is no positive number counts as 0. The default is 10⁻⁶ of the diagonal of the box
/// around the vertices in use: far above the rounding of coordinates, far below any length that is meant.
///
/// ```
/// use vvmesh::{check::{FindingKind, conformity}, glam::DVec3, soup::FaceList};
/// let corners = [(0., 0.), (2., 0.), (1., 1.), (1., -1.), (1., 0.)].map(|(x, y)| DVec3::new(x, y, 0.0));
/// let halves = FaceList::from_triangles(corners.to_vec(), &[[0, 1, 2], [0, 3, 4], [4, 3, 1]]);
/// let report = conformity(&halves, None);
/// assert_eq!((report.findings.len(), report.findings[0].kind), (1, FindingKind::TJunction));
/// assert_eq!(report.findings[0].message, "v4 lies on the inside of edge v0-v1 of face 0");
/// ```
///
/// # Complexity
/// O(n log n) in the number of corners for the rules on ids. The places of boundary vertices stand in an R-tree, which
/// is searched along each boundary edge: O(log n) for each edge where the vertices near to it are few.
#[must_use]
pub fn conformity(list: &FaceList, tolerance: Option<f64>) -> Report {
    let sieve = Sieve::new(list);
    let table = EdgeTable::new(list, &sieve.kept);
    let used = list.used();
    let boundary = Boundary::new(list, &table, &used, tolerance);
    let t_junctions = boundary.t_junctions();
    let cracks = boundary.cracks();

    let mut fans = Fans::new(&table);
    for &[a, x] in t_junctions.glued.iter().chain(&cracks.glued) {
        fans.join(a, x);
    }

    let mut defects = sieve.defects;
    defects.extend(soup::non_finite(list));
    defects.extend(soup::non_manifold_edges(&table));
    defects.extend(soup::bow_ties(&table, &mut fans));
    defects.extend(soup::orientation(&table));
    defects.extend(soup::too_many_vertices(list));

    let mut findings = t_junctions.findings;
    findings.extend(cracks.findings);
    findings.extend(defects.into_iter().filter_map(finding));
    findings.extend(isolated(list, &used));
    findings.sort_by_key(|finding| finding.kind);
    Report { findings, tolerance: boundary.tolerance() }
}

/// As [`conformity`], for a mesh: what can be found is what depends on positions, and isolated vertices.
#[must_use]
pub fn mesh_conformity(mesh: &Mesh, tolerance: Option<f64>) -> Report {
    conformity(&mesh.to_face_list(), tolerance)
}

/// A defect in the words of a check. A face of more than three sides is none here.
fn finding(defect: Defect) -> Option<Finding> {
    let kind = match defect.kind {
        DefectKind::IndexOutOfRange => FindingKind::IndexOutOfRange,
        DefectKind::NonFinite => FindingKind::NonFinite,
        DefectKind::DegenerateFace => FindingKind::DegenerateFace,
        DefectKind::DuplicateFace => FindingKind::DuplicateFace,
        DefectKind::NonManifoldEdge => FindingKind::NonManifoldEdge,
        DefectKind::BowTie => FindingKind::BowTie,
        DefectKind::Orientation => FindingKind::Orientation,
        DefectKind::NonOrientable => FindingKind::NonOrientable,
        DefectKind::TooManyVertices => FindingKind::TooManyVertices,
        DefectKind::NotTriangle => return None,
    };
    Some(Finding { kind, message: defect.message, vertices: defect.vertices, faces: defect.faces })
}

fn isolated(list: &FaceList, used: &[bool]) -> impl Iterator<Item = Finding> {
    (0..list.vertex_limit()).filter(|&k| !used[k]).map(|k| {
        let v = VertexId::new(k);
        Finding {
            kind: FindingKind::IsolatedVertex,
            message: format!("{v} has no face"),
            vertices: vec![v],
            faces: Vec::new(),
        }
    })
}
