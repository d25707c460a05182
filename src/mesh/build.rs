//! A mesh from triangles: rings are chained from the pairs of neighbours that the triangles give.

use glam::DVec3;

use super::{Mesh, Tags};
use crate::error::{BuildError, Defect, DefectKind};
use crate::id::VertexId;
use crate::rotation::{RingBuf, RotationSystem};
use crate::soup::FaceList;

/// Up to this many triangles around a vertex the next one is searched for; above, the pairs are sorted first.
const SEARCHED: usize = 24;

impl Mesh {
    /// Builds a mesh from positions and triangles whose corners are indices into them, counter-clockwise seen from
    /// outside.
    ///
    /// Vertex `k` of the mesh is position `k`; vertices without a triangle are kept, isolated. The ring of an inner
    /// vertex starts at its smallest neighbour, that of a boundary vertex right after the gap, so the mesh does not
    /// depend on the order of the triangles.
    ///
    /// # Errors
    /// Every defect, as [`FaceList::defects`] finds them, when the triangles do not make an oriented 2-manifold.
    ///
    /// # Complexity
    /// O(vertices + triangles), and O(d log d) for a vertex of more than 24 triangles.
    pub fn from_triangles(positions: Vec<DVec3>, triangles: &[[u32; 3]]) -> Result<Self, BuildError> {
        match rings(&positions, triangles) {
            Some(rings) => Ok(Self { rotation: RotationSystem::from_rings(rings), positions, tags: Tags::default() }),
            None => Err(BuildError::new(FaceList::from_triangles(positions, triangles).defects())),
        }
    }

    /// Builds a mesh from a list of faces that are all triangles, as [`Mesh::from_triangles`] does.
    ///
    /// # Errors
    /// Every face that is no triangle ([`FaceList::triangulate`] makes triangles of polygons); else as
    /// [`Mesh::from_triangles`].
    pub fn from_face_list(list: &FaceList) -> Result<Self, BuildError> {
        let mut triangles = Vec::with_capacity(list.face_count());
        let mut others = Vec::new();
        for (k, face) in list.faces().enumerate() {
            match *face {
                [a, b, c] => triangles.push([a, b, c]),
                _ => others.push(Defect {
                    kind: DefectKind::NotTriangle,
                    vertices: Vec::new(),
                    faces: vec![k],
                    message: format!("face {k} has {} sides, a triangle is needed: triangulate first", face.len()),
                }),
            }
        }
        if others.is_empty() {
            Self::from_triangles(list.positions.clone(), &triangles)
        } else {
            Err(BuildError::new(others))
        }
    }
}

/// The rings, or `None` if there is any defect.
fn rings(positions: &[DVec3], triangles: &[[u32; 3]]) -> Option<Vec<RingBuf>> {
    let count = positions.len();
    VertexId::try_new(count.saturating_sub(1))?;
    let sound = triangles.iter().all(|&[a, b, c]| {
        a != b && b != c && c != a && (a as usize) < count && (b as usize) < count && (c as usize) < count
    });
    if !sound || !positions.iter().all(|p| p.is_finite()) {
        return None;
    }

    // For every vertex the pairs (b, c) of its triangles (v, b, c), side by side.
    let mut ends = vec![0_usize; count + 1];
    for &v in triangles.as_flattened() {
        ends[v as usize + 1] += 1;
    }
    for v in 0..count {
        ends[v + 1] += ends[v];
    }
    let mut pairs = vec![(0_u32, 0_u32); 3 * triangles.len()];
    let mut free = ends.clone();
    for &[a, b, c] in triangles {
        for (v, pair) in [(a, (b, c)), (b, (c, a)), (c, (a, b))] {
            pairs[free[v as usize]] = pair;
            free[v as usize] += 1;
        }
    }

    let mut ring = Vec::new();
    (0..count).map(|v| chain(&mut pairs[ends[v]..ends[v + 1]], &mut ring)).collect()
}

/// Chains the pairs around one vertex into a ring, or answers `None` if they form no single fan.
fn chain(pairs: &mut [(u32, u32)], ring: &mut Vec<VertexId>) -> Option<RingBuf> {
    ring.clear();
    if pairs.is_empty() {
        return Some(RingBuf::default());
    }
    let sorted = pairs.len() > SEARCHED;
    if sorted {
        pairs.sort_unstable();
        if pairs.windows(2).any(|two| two[0].0 == two[1].0) {
            return None;
        }
    }
    // Each neighbour starts at most one pair, or the edge to it carries two triangles on one side.
    let pair_from = |b: u32| -> Option<Option<usize>> {
        if sorted {
            return Some(pairs.binary_search_by_key(&b, |pair| pair.0).ok());
        }
        let mut found = None;
        for (k, pair) in pairs.iter().enumerate() {
            if pair.0 == b && found.replace(k).is_some() {
                return None;
            }
        }
        Some(found)
    };

    let first = start(pairs, sorted)?;
    let mut at = first;
    loop {
        ring.push(VertexId::new(pairs[at].0 as usize));
        if ring.len() > pairs.len() {
            return None;
        }
        match pair_from(pairs[at].1)? {
            Some(after) if after == first => break,
            Some(after) => at = after,
            None => {
                ring.push(VertexId::new(pairs[at].1 as usize));
                return (ring.len() == pairs.len() + 1).then(|| RingBuf::open(ring));
            }
        }
    }
    (ring.len() == pairs.len() && ring.len() >= 3).then(|| RingBuf::closed(ring))
}

/// The pair with which the ring starts: the one after the gap, else the one at the smallest neighbour. `None` if there
/// is more than one gap.
fn start(pairs: &[(u32, u32)], sorted: bool) -> Option<usize> {
    let mut ends: Vec<u32> = Vec::new();
    if sorted {
        ends.extend(pairs.iter().map(|pair| pair.1));
        ends.sort_unstable();
    }
    let is_end = |b: u32| {
        if sorted { ends.binary_search(&b).is_ok() } else { pairs.iter().any(|pair| pair.1 == b) }
    };
    let mut smallest = 0;
    let mut after_gap = None;
    for (k, pair) in pairs.iter().enumerate() {
        if pair.0 < pairs[smallest].0 {
            smallest = k;
        }
        if !is_end(pair.0) && after_gap.replace(k).is_some() {
            return None;
        }
    }
    Some(after_gap.unwrap_or(smallest))
}
