//! A mesh from triangles: rings are chained from the pairs of neighbours that the triangles give.

use std::ops::Range;

use glam::DVec3;
use smallvec::SmallVec;

use super::{Mesh, Tags};
use crate::error::{BuildError, Defect, DefectKind};
use crate::id::VertexId;
use crate::parallel;
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
        match rings(&positions, triangles.as_flattened()) {
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
    rings(&list.positions, list.triangles()?).map(RotationSystem::from_rings)
}

/// The rings, or `None` if there is any defect. The corners are those of triangles, three each.
fn rings(positions: &[DVec3], corners: &[u32]) -> Option<Vec<RingBuf>> {
    let count = positions.len();
    VertexId::try_new(count.saturating_sub(1))?;
    let is_unsound = |k: usize| {
        let [a, b, c] = [corners[3 * k], corners[3 * k + 1], corners[3 * k + 2]];
        a == b || b == c || c == a || a.max(b).max(c) as usize >= count
    };
    if parallel::find(0..corners.len() / 3, is_unsound).is_some()
        || parallel::find(0..count, |v| !positions[v].is_finite()).is_some()
    {
        return None;
    }

    let mut rings = Vec::with_capacity(count);
    for table in parallel::shares(0..count, |vertices| PairTable::new(corners, vertices)) {
        // In place of a ring that is none stands a gap without neighbours.
        parallel::append(&mut rings, 0..table.ends.len(), |place| {
            chain(table.pairs(place)).unwrap_or_else(|| RingBuf::open(&[]))
        });
    }
    let is_none = |v: usize| rings[v].as_ring().is_open() && rings[v].as_ring().valence() == 0;
    parallel::find(0..count, is_none).is_none().then_some(rings)
}

/// For some consecutive vertices the pairs (b, c) of their triangles (v, b, c), side by side.
///
/// Whoever makes one reads all triangles, but writes nothing that others write.
struct PairTable {
    /// Where the pairs of each vertex end.
    ends: Vec<usize>,
    pairs: Vec<(u32, u32)>,
}

impl PairTable {
    fn new(corners: &[u32], vertices: Range<usize>) -> Self {
        // While pairs are put in place, the start of each vertex grows to its end.
        let mut ends = vec![0_usize; vertices.len()];
        let place = |v: u32| (v as usize).wrapping_sub(vertices.start);
        for &v in corners {
            if let Some(count) = ends.get_mut(place(v)) {
                *count += 1;
            }
        }
        let mut total = 0;
        for count in &mut ends {
            total += std::mem::replace(count, total);
        }
        let mut pairs = vec![(0_u32, 0_u32); total];
        for triangle in corners.chunks_exact(3) {
            let [a, b, c] = [triangle[0], triangle[1], triangle[2]];
            for (v, pair) in [(a, (b, c)), (b, (c, a)), (c, (a, b))] {
                if let Some(free) = ends.get_mut(place(v)) {
                    pairs[*free] = pair;
                    *free += 1;
                }
            }
        }
        Self { ends, pairs }
    }

    /// The pairs of the vertex at a place among them.
    #[inline]
    fn pairs(&self, place: usize) -> &[(u32, u32)] {
        let start = if place == 0 { 0 } else { self.ends[place - 1] };
        &self.pairs[start..self.ends[place]]
    }
}

/// Neighbours on their way into a ring; a vertex whose pairs are sorted may need more room.
type Chain = SmallVec<[VertexId; SEARCHED + 1]>;

/// Chains the pairs around one vertex into a ring, or answers `None` if they form no single fan.
fn chain(pairs: &[(u32, u32)]) -> Option<RingBuf> {
    if pairs.len() <= SEARCHED {
        return Pairs { pairs, sorted: false }.chain();
    }
    let mut pairs = pairs.to_vec();
    pairs.sort_unstable();
    let repeats = pairs.windows(2).any(|two| two[0].0 == two[1].0);
    if repeats { None } else { Pairs { pairs: &pairs, sorted: true }.chain() }
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
    #[inline]
    fn chain(&self) -> Option<RingBuf> {
        let Some(smallest) = self.smallest() else { return Some(RingBuf::default()) };
        let mut ring = Chain::new();
        match self.follow(smallest, &mut ring)? {
            End::Start => (ring.len() == self.pairs.len() && ring.len() >= 3).then(|| RingBuf::closed(&ring)),
            End::Gap => {
                self.follow(self.after_gap()?, &mut ring)?;
                (ring.len() == self.pairs.len() + 1).then(|| RingBuf::open(&ring))
            }
        }
    }

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
    fn follow(&self, first: usize, ring: &mut Chain) -> Option<End> {
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
