//! How a vertex moves from level to level under √3, in closed form.
//!
//! Once the star of a vertex is complete, every further step scales its distance to the limit by a number that its valence
//! gives; so its position at any level follows from that at one level and the limit. On a boundary, where a step in two cuts
//! edges in three, the boundary neighbours of each level follow too: their mean comes nearer to the vertex by 1/9, their
//! difference by 1/3. Source: `[kobbelt2000]`, sections 3 and 5.
//!
//! So of each vertex a few points are kept, and where it is at a level is a weighted sum of them. What goes along with the
//! mesh keeps the same of its own.
//!
//! **Deliberately not here**: when a star is complete, and what the points are made of; see [`crate::subdivide`].

use glam::DVec3;

use crate::id::VertexId;

/// How many points are kept of a vertex at most.
const KEPT: usize = 3;

/// The weights of the points of a vertex. One with the weight 0 may not be there.
pub(crate) type Weights = [f64; KEPT];

/// How a vertex moves after its birth.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Motion {
    /// Not known before its first star is complete; until then it stands still.
    Open,
    /// From a level on, at which it is at the point `start`, at every further level `rate` times as far from the limit.
    Inner { since: u8, start: u8, rate: f64 },
    /// On a boundary, from an even level on.
    Boundary { since: u8 },
}

impl Motion {
    /// The number of the point at which a vertex was born.
    pub(crate) const BIRTH: u8 = 0;
    /// Of an inner vertex: the limit.
    pub(crate) const LIMIT: u8 = 1;
    /// Of an inner vertex that begins to move a level after its birth: from where.
    pub(crate) const START: u8 = 2;
    /// Of a boundary vertex: its neighbour along the boundary at its birth that comes before it, with the mesh on the left.
    pub(crate) const BEFORE: u8 = 1;
    /// The same, of the one that comes after it.
    pub(crate) const AFTER: u8 = 2;

    /// Where the vertex is at a level, which is not below that of its birth.
    fn at(self, level: u8) -> Weights {
        let mut weights = [0.0; KEPT];
        match self {
            Self::Inner { since, start, rate } if since <= level => {
                let part = rate.powi(i32::from(level - since));
                weights[usize::from(start)] = part;
                weights[usize::from(Self::LIMIT)] = 1.0 - part;
            }
            Self::Open | Self::Inner { .. } => weights[usize::from(Self::BIRTH)] = 1.0,
            Self::Boundary { since } => {
                // A sixth of before + after − 2 birth leads to the limit.
                let bend = (1.0 - 9f64.powi(-cuts(since, level))) / 6.0;
                weights = [1.0 - 2.0 * bend, bend, bend];
            }
        }
        weights
    }

    /// Where the neighbours of a boundary vertex along the boundary are at a level: the one before it and the one after it.
    fn along(self, level: u8) -> [Weights; 2] {
        let Self::Boundary { since } = self else { unreachable!("it is a boundary vertex") };
        let cuts = cuts(since, level);
        let (middle, slope) = (1.0 / 6.0 + 9f64.powi(-cuts) / 3.0, 3f64.powi(-cuts) / 2.0);
        let birth = 1.0 - 2.0 * middle;
        [[birth, middle + slope, middle - slope], [birth, middle - slope, middle + slope]]
    }
}

/// For every vertex the points that are kept of it and how it moves between them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Motions {
    points: Vec<[DVec3; KEPT]>,
    motions: Vec<Motion>,
}

impl Motions {
    /// Appends a vertex of which no point is known.
    pub(crate) fn push(&mut self, motion: Motion) {
        self.points.push([DVec3::NAN; KEPT]);
        self.motions.push(motion);
    }

    /// Those of vertices that lie over these.
    pub(crate) fn lifted(&self, below: &[VertexId]) -> Self {
        let (points, motions) = below.iter().map(|v| (self.points[v.index()], self.motions[v.index()])).unzip();
        Self { points, motions }
    }

    pub(crate) fn truncate(&mut self, vertex_count: usize) {
        self.points.truncate(vertex_count);
        self.motions.truncate(vertex_count);
    }

    pub(crate) fn point(&self, v: VertexId, number: u8) -> DVec3 {
        self.points[v.index()][usize::from(number)]
    }

    pub(crate) fn set_point(&mut self, v: VertexId, number: u8, point: DVec3) {
        self.points[v.index()][usize::from(number)] = point;
    }

    pub(crate) fn set(&mut self, v: VertexId, motion: Motion) {
        self.motions[v.index()] = motion;
    }

    pub(crate) fn is_open(&self, v: VertexId) -> bool {
        self.motions[v.index()] == Motion::Open
    }

    /// Where a vertex is at a level, which is not below that of its birth.
    pub(crate) fn at(&self, v: VertexId, level: u8) -> Weights {
        self.motions[v.index()].at(level)
    }

    /// Where the neighbours of a boundary vertex along the boundary are at a level: the one before it and the one after it,
    /// with the mesh on the left.
    pub(crate) fn along(&self, v: VertexId, level: u8) -> [Weights; 2] {
        self.motions[v.index()].along(level)
    }

    /// Bytes held.
    pub(crate) fn memory_bytes(&self) -> usize {
        self.points.capacity() * size_of::<[DVec3; KEPT]>() + self.motions.capacity() * size_of::<Motion>()
    }
}

/// How often boundary edges are cut in three between two levels: at every even one.
fn cuts(since: u8, level: u8) -> i32 {
    i32::from(level / 2) - i32::from(since / 2)
}
