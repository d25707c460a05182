//! Counts of a list of faces.

use glam::DVec3;

use super::FaceList;
use super::defects::orientation;
use super::disjoint::DisjointSets;
use super::sieve::degeneracy;
use super::table::{EdgeTable, Fans};
use crate::error::DefectKind;
use crate::parallel;

/// Counts of a list of faces as they stand: no face is cut, set aside or mended.
///
/// All counts have a meaning for any list. A vertex is *used* if a face names it. An edge is a pair of different
/// vertices that stand next to each other in a face; it is a boundary edge if that happens once.
#[derive(Clone, PartialEq, Debug)]
#[non_exhaustive]
pub struct Census {
    /// All vertices, used or not.
    pub vertices: usize,
    /// Vertices that no face names. They count here and in `vertices`, nowhere else.
    pub isolated_vertices: usize,
    /// Edges.
    pub edges: usize,
    /// Faces of any number of sides.
    pub faces: usize,
    /// Faces after triangulation: a face of n sides gives n - 2.
    pub triangles: usize,
    /// Components of the used vertices, those of one face being connected.
    pub components: usize,
    /// Boundary loops: chains of boundary edges. At a vertex of several fans they are followed as if each fan had a
    /// vertex of its own.
    pub boundary_loops: usize,
    /// Used vertices - edges + faces.
    pub euler_characteristic: i64,
    /// The genus, summed over all components, or `None` if the faces form no orientable manifold.
    pub genus: Option<usize>,
    /// Whether the faces can be turned so that any two at an edge with two faces agree.
    pub orientable: bool,
    /// Numbers of edges at the used vertices.
    pub valence: Valences,
    /// The least and greatest coordinates of the used vertices, those that are not finite passed over; `None` if there
    /// are no others.
    pub bounds: Option<[DVec3; 2]>,
}

/// How many edges lead from the used vertices.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Valences {
    /// The least valence; `None` if no vertex is used, as for `mean` and `max`.
    pub min: Option<usize>,
    /// The mean.
    pub mean: Option<f64>,
    /// The greatest valence.
    pub max: Option<usize>,
    /// Each valence that occurs, with the number of its vertices, ascending.
    pub histogram: Vec<(usize, usize)>,
}

impl FaceList {
    /// Counts everything that a user asks first: sizes, components, boundary loops, genus, valences, bounds.
    ///
    /// The sides of a face that names a vertex out of range are no edges, and there is no genus then.
    ///
    /// ```
    /// let census = vvmesh::shapes::torus(5, 4, 2.0, 1.0).to_face_list().census();
    /// assert_eq!((census.vertices, census.edges, census.faces), (20, 60, 40));
    /// assert_eq!((census.genus, census.boundary_loops), (Some(1), 0));
    /// assert_eq!(census.valence.histogram, [(6, 20)]);
    /// ```
    ///
    /// # Complexity
    /// O(n log n) in the number of corners, O(n) for few neighbours a vertex.
    #[must_use]
    pub fn census(&self) -> Census {
        let sound = self.in_range();
        let used = self.used();
        let used_count = used.iter().filter(|&&used| used).count();
        let table = EdgeTable::new(self, &sound);
        let mut fans = Fans::new(&table);
        let mut valences = vec![0_usize; self.vertex_count()];
        let mut edges = 0;
        let mut buffer = Vec::new();
        let mut is_manifold =
            sound.iter().all(|&sound| sound) && self.faces().all(|face| degeneracy(face, &mut buffer).is_none());
        for edge in table.edges() {
            edges += 1;
            is_manifold &= edge.face_count() <= 2;
            for v in edge.ends() {
                valences[v as usize] += 1;
            }
        }
        is_manifold &= fans.counts(&table).iter().all(|&count| count <= 1);
        let orientable = orientation(&table).iter().all(|defect| defect.kind != DefectKind::NonOrientable);
        let components = self.component_count(&used);
        let boundary_loops = fans.boundary_loop_count(&table);
        let euler_characteristic = used_count as i64 - edges as i64 + self.face_count() as i64;
        // V - E + F = 2 - 2g - loops for each component.
        let twice_genus = 2 * components as i64 - euler_characteristic - boundary_loops as i64;
        Census {
            vertices: self.vertex_count(),
            isolated_vertices: self.vertex_count() - used_count,
            edges,
            faces: self.face_count(),
            triangles: self.faces().map(|face| face.len().saturating_sub(2)).sum(),
            components,
            boundary_loops,
            euler_characteristic,
            genus: if is_manifold && orientable { usize::try_from(twice_genus / 2).ok() } else { None },
            orientable,
            valence: Valences::new(valences.iter().zip(&used).filter(|(_, used)| **used).map(|(&valence, _)| valence)),
            bounds: bounds(&self.positions, &used),
        }
    }

    /// For every face whether all its vertices exist.
    fn in_range(&self) -> Vec<bool> {
        let limit = self.vertex_limit();
        self.faces().map(|face| face.iter().all(|&v| (v as usize) < limit)).collect()
    }

    /// For every vertex whether a face names it.
    pub(crate) fn used(&self) -> Vec<bool> {
        let mut used = vec![false; self.vertex_count()];
        for face in self.faces() {
            for v in self.existing(face) {
                used[v as usize] = true;
            }
        }
        used
    }

    /// The corners of a face that are vertices of the list.
    fn existing<'a>(&self, face: &'a [u32]) -> impl Iterator<Item = u32> + use<'a> {
        let limit = self.vertex_limit();
        face.iter().copied().filter(move |&v| (v as usize) < limit)
    }

    fn component_count(&self, used: &[bool]) -> usize {
        let mut sets = DisjointSets::new(self.vertex_limit());
        for face in self.faces() {
            let mut corners = self.existing(face);
            if let Some(first) = corners.next() {
                corners.for_each(|v| sets.join(first, v));
            }
        }
        (0..self.vertex_limit() as u32).filter(|&v| used[v as usize] && sets.find(v) == v).count()
    }
}

/// The least and greatest coordinates of the finite ones among some positions.
pub(crate) fn bounds(positions: &[DVec3], of: &[bool]) -> Option<[DVec3; 2]> {
    // Of equal numbers, as 0 and -0 are, the last counts; so it does not matter where the list is cut.
    let join = |[min, max]: [DVec3; 2], [p, q]: [DVec3; 2]| [min.min(p), max.max(q)];
    let parts = parallel::shares(0..positions.len(), |part| {
        let points = part.filter(|&k| of[k] && positions[k].is_finite());
        points.map(|k| [positions[k]; 2]).reduce(join)
    });
    parts.into_iter().flatten().reduce(join)
}

impl Valences {
    fn new(valences: impl Iterator<Item = usize>) -> Self {
        let mut valences: Vec<usize> = valences.collect();
        valences.sort_unstable();
        let sum: usize = valences.iter().sum();
        Self {
            min: valences.first().copied(),
            mean: (!valences.is_empty()).then(|| sum as f64 / valences.len() as f64),
            max: valences.last().copied(),
            histogram: valences.chunk_by(|p, q| p == q).map(|same| (same[0], same.len())).collect(),
        }
    }
}
