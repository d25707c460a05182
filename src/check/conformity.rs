//! Whether faces make a conforming mesh: what they share is nothing, one vertex or one whole edge.

use glam::DVec3;

use super::geometry::Boundary;
use super::{Finding, FindingKind};
use crate::error::{Defect, DefectKind};
use crate::id::VertexId;
use crate::mesh::{self, Mesh};
use crate::parallel;
use crate::rotation::RotationSystem;
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
/// Faces may have any number of sides. Faces with an index out of range, degenerate ones and duplicates are told and
/// set aside first, so a face that stands twice hides no boundary.
///
/// - A *T-junction* is a boundary edge with a boundary vertex within the tolerance of its inside; a vertex within the
///   tolerance of one of the ends is not inside. There is one finding for each such edge, with its ends and the
///   vertices on it from the smaller end on (the first 64 found, if there are more), and its face.
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
/// O(n log n) in the number of corners for the rules on ids, O(n) if they are those of a mesh. The places of boundary
/// vertices stand in an R-tree, which is searched along each boundary edge: O(log n) for each edge where the vertices
/// near to it are few.
#[must_use]
pub fn conformity(list: &FaceList, tolerance: Option<f64>) -> Report {
    match mesh::rotation_of(list) {
        Some(rotation) if is_closed(&rotation) => of_mesh(&list.positions, &FaceList::default(), &rotation, tolerance),
        Some(rotation) => of_mesh(&list.positions, list, &rotation, tolerance),
        None => of_any_faces(list, tolerance),
    }
}

/// As [`conformity`], for a mesh: what can be found is what depends on positions, and isolated vertices.
///
/// # Complexity
/// O(vertices + triangles), and along the boundary as for [`conformity`].
#[must_use]
pub fn mesh_conformity(mesh: &Mesh, tolerance: Option<f64>) -> Report {
    let list = if is_closed(mesh.rotation()) { FaceList::default() } else { mesh.to_face_list() };
    of_mesh(mesh.positions(), &list, mesh.rotation(), tolerance)
}

/// Whether there is no boundary: then [`of_mesh`] asks nothing of faces.
fn is_closed(rotation: &RotationSystem) -> bool {
    rotation.boundary_edge_count() == 0
}

/// Findings on the triangles of a mesh: there are rings exactly if there is no [`Defect`], so what is left is what
/// depends on positions, and isolated vertices. The faces of a closed mesh need not be listed.
fn of_mesh(positions: &[DVec3], faces: &FaceList, rotation: &RotationSystem, tolerance: Option<f64>) -> Report {
    let mut used = Vec::with_capacity(positions.len());
    parallel::append(&mut used, 0..positions.len(), |v| rotation.valence(VertexId::new(v)) > 0);
    // Between two boundary vertices an edge has all its faces among those at the boundary.
    let on_boundary = |v: u32| rotation.is_boundary(VertexId::new(v as usize));
    let mut at_boundary = Vec::with_capacity(faces.face_count());
    parallel::append(&mut at_boundary, 0..faces.face_count(), |k| faces.face(k).iter().any(|&v| on_boundary(v)));
    let table = EdgeTable::new(faces, &at_boundary);
    let edges = table.edges().filter(|edge| edge.is_boundary() && edge.ends().into_iter().all(on_boundary));
    let boundary = Boundary::new(positions, &table, edges.collect(), &used, tolerance);

    let mut findings = boundary.t_junctions().findings;
    findings.extend(boundary.cracks().findings);
    findings.extend(isolated(&used));
    findings.extend(soup::non_finite(positions).into_iter().filter_map(finding));
    Report { findings, tolerance: boundary.tolerance() }
}

/// Findings on whatever stands in a list of faces.
fn of_any_faces(list: &FaceList, tolerance: Option<f64>) -> Report {
    let sieve = Sieve::new(list);
    let table = EdgeTable::new(list, &sieve.kept);
    let used = list.used();
    let edges = table.edges().filter(|edge| edge.is_boundary()).collect();
    let boundary = Boundary::new(&list.positions, &table, edges, &used, tolerance);
    let t_junctions = boundary.t_junctions();
    let cracks = boundary.cracks();

    let mut fans = Fans::new(&table);
    for &[a, x] in t_junctions.glued.iter().chain(&cracks.glued) {
        fans.join(a, x);
    }

    let mut defects = sieve.defects;
    defects.extend(soup::non_finite(&list.positions[..list.vertex_limit()]));
    defects.extend(soup::non_manifold_edges(&table));
    defects.extend(soup::bow_ties(&table, &mut fans));
    defects.extend(soup::orientation(&table));
    defects.extend(soup::too_many_vertices(list));

    let mut findings = t_junctions.findings;
    findings.extend(cracks.findings);
    findings.extend(defects.into_iter().filter_map(finding));
    findings.extend(isolated(&used[..list.vertex_limit()]));
    findings.sort_by_key(|finding| finding.kind);
    Report { findings, tolerance: boundary.tolerance() }
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

fn isolated(used: &[bool]) -> Vec<Finding> {
    parallel::gather(0..used.len(), |k| {
        let v = VertexId::new(k);
        (!used[k]).then(|| Finding {
            kind: FindingKind::IsolatedVertex,
            message: format!("{v} has no face"),
            vertices: vec![v],
            faces: Vec::new(),
        })
    })
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::shapes;

    /// A grid of which some triangles are missing and others are cut in two, without the neighbour knowing, at a point
    /// on an edge or a little off it. `choose` answers with a number below its argument.
    fn worn(mut choose: impl FnMut(u32) -> u32) -> FaceList {
        let grid = shapes::grid(5, 5).to_face_list();
        let mut list = FaceList::new(grid.positions.clone());
        list.positions.extend([DVec3::ONE]);
        for face in grid.faces() {
            let [a, b, c] = [0, 1, 2].map(|k| face[k]);
            match choose(50) {
                0 => {}
                1 | 2 => {
                    let x = list.positions.len() as u32;
                    let middle = list.positions[a as usize].midpoint(list.positions[b as usize]);
                    list.positions.push(middle + f64::from(choose(2)) * DVec3::new(0.0, 0.0, 0.01));
                    list.push_face(&[a, x, c]);
                    list.push_face(&[x, b, c]);
                }
                _ => list.push_face(face),
            }
        }
        list
    }

    #[test]
    fn a_mesh_has_the_findings_of_its_faces() {
        let mut state = 1_u64;
        let mut choose = |bound: u32| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as u32 % bound
        };
        let mut met = Vec::new();
        for _ in 0..600 {
            let list = worn(&mut choose);
            let tolerance = [None, Some(0.02)][choose(2) as usize];
            let expected = of_any_faces(&list, tolerance);
            assert_eq!(conformity(&list, tolerance), expected);
            if let Ok(mut mesh) = Mesh::from_face_list(&list) {
                assert_eq!(mesh_conformity(&mesh, tolerance), of_any_faces(&mesh.to_face_list(), tolerance));
                met.extend(expected.findings.iter().map(|finding| finding.kind));
                mesh.positions_mut()[choose(36) as usize].y = f64::NAN;
                assert_eq!(mesh_conformity(&mesh, tolerance), of_any_faces(&mesh.to_face_list(), tolerance));
            }
        }
        for kind in [FindingKind::TJunction, FindingKind::Crack, FindingKind::IsolatedVertex] {
            assert!(met.iter().filter(|&&other| other == kind).count() > 15, "{kind}");
        }
    }
}
