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
        match rings(&positions, triangles.iter().copied()) {
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
        if let Some(rotation) = rotation_of(list) {
            return Ok(Self { rotation, positions: list.positions.clone(), tags: Tags::default() });
        }
        let others = list.faces().enumerate().filter(|(_, face)| face.len() != 3).map(|(k, face)| Defect {
            kind: DefectKind::NotTriangle,
            vertices: Vec::new(),
            faces: vec![k],
            message: format!("face {k} has {} sides, a triangle is needed: triangulate first", face.len()),
        });
        let others: Vec<Defect> = others.collect();
        Err(BuildError::new(if others.is_empty() { list.defects() } else { others }))
    }
}

/// The rings of a list of faces, if they are triangles without any defect.
pub(crate) fn rotation_of(list: &FaceList) -> Option<RotationSystem> {
    let triangles = list.triangles()?;
    rings(&list.positions, triangles).map(RotationSystem::from_rings)
}

/// The rings, or `None` if there is any defect.
fn rings(positions: &[DVec3], triangles: impl ExactSizeIterator<Item = [u32; 3]> + Clone) -> Option<Vec<RingBuf>> {
    let count = positions.len();
    VertexId::try_new(count.saturating_sub(1))?;
    let sound = triangles.clone().all(|[a, b, c]| {
        a != b && b != c && c != a && (a as usize) < count && (b as usize) < count && (c as usize) < count
    });
    if !sound || !positions.iter().all(|p| p.is_finite()) {
        return None;
    }

    // For every vertex the pairs (b, c) of its triangles (v, b, c), side by side. While they are put in place, the
    // start of each vertex grows to its end.
    let mut ends = vec![0_usize; count + 1];
    for v in triangles.clone().flatten() {
        ends[v as usize + 1] += 1;
    }
    for v in 0..count {
        ends[v + 1] += ends[v];
    }
    let mut pairs = vec![(0_u32, 0_u32); 3 * triangles.len()];
    for [a, b, c] in triangles {
        for (v, pair) in [(a, (b, c)), (b, (c, a)), (c, (a, b))] {
            let free = &mut ends[v as usize];
            pairs[*free] = pair;
            *free += 1;
        }
    }

    let mut ring = Vec::new();
    let mut start = 0;
    let chained =
        ends[..count].iter().map(|&end| chain(&mut pairs[std::mem::replace(&mut start, end)..end], &mut ring));
    chained.collect()
}

/// Chains the pairs around one vertex into a ring, or answers `None` if they form no single fan.
fn chain(pairs: &mut [(u32, u32)], ring: &mut Vec<VertexId>) -> Option<RingBuf> {
    let sorted = pairs.len() > SEARCHED;
    if sorted {
        pairs.sort_unstable();
        if pairs.windows(2).any(|two| two[0].0 == two[1].0) {
            return None;
        }
    }
    let pairs = Pairs { pairs, sorted };
    let Some(smallest) = pairs.smallest() else { return Some(RingBuf::default()) };
    match pairs.follow(smallest, ring)? {
        End::Start => (ring.len() == pairs.pairs.len() && ring.len() >= 3).then(|| RingBuf::closed(ring)),
        End::Gap => {
            pairs.follow(pairs.after_gap()?, ring)?;
            (ring.len() == pairs.pairs.len() + 1).then(|| RingBuf::open(ring))
        }
    }
}

/// The pairs (b, c) of the triangles (v, b, c) around a vertex, sorted if there are many.
///
/// Each neighbour has to start at most one pair, or the edge to it carries two triangles on one side. That need not be
/// looked for: the second of two such pairs is never found, so the ring comes out too short.
struct Pairs<'a> {
    pairs: &'a [(u32, u32)],
    sorted: bool,
}

/// Where a chain of pairs ends.
enum End {
    /// Where it started.
    Start,
    /// At a neighbour that starts no pair.
    Gap,
}

impl Pairs<'_> {
    /// The first pair that a neighbour starts.
    #[inline]
    fn from(&self, b: u32) -> Option<usize> {
        if self.sorted {
            self.pairs.binary_search_by_key(&b, |pair| pair.0).ok()
        } else {
            self.pairs.iter().position(|pair| pair.0 == b)
        }
    }

    /// The pair that the smallest neighbour starts.
    #[inline]
    fn smallest(&self) -> Option<usize> {
        (0..self.pairs.len()).min_by_key(|&k| self.pairs[k].0)
    }

    /// Lists the neighbours from the start of a pair on. `None` if the chain goes round without coming back there.
    fn follow(&self, first: usize, ring: &mut Vec<VertexId>) -> Option<End> {
        ring.clear();
        let mut at = first;
        while ring.len() < self.pairs.len() {
            let (b, c) = self.pairs[at];
            ring.push(VertexId::new(b as usize));
            match self.from(c) {
                Some(after) if after == first => return Some(End::Start),
                Some(after) => at = after,
                None => {
                    ring.push(VertexId::new(c as usize));
                    return Some(End::Gap);
                }
            }
        }
        None
    }

    /// The pair whose start ends no pair.
    fn after_gap(&self) -> Option<usize> {
        let mut ends: Vec<u32> = self.pairs.iter().map(|pair| pair.1).collect();
        ends.sort_unstable();
        (0..self.pairs.len()).find(|&k| ends.binary_search(&self.pairs[k].0).is_err())
    }
}
