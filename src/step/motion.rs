//! How a vertex moves from level to level under √3, in closed form.
//!
//! Once the star of a vertex is complete, every further step scales its distance to the limit by a number that its valence
//! gives; so its position at any level follows from that at one level and the limit. On a boundary, where a step in two cuts
//! edges in three, the boundary neighbours of each level follow too: their mean comes nearer to the vertex by 1/9, their
//! difference by 1/3. Source: `[kobbelt2000]`, sections 3 and 5.
//!
//! **Deliberately not here**: when a star is complete; see [`crate::subdivide`].

use glam::DVec3;

use crate::id::VertexId;

/// How a vertex moves after its birth.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Motion {
    /// Not known before its first star is complete; until then it stands still.
    Open,
    /// From a level on, `offset` from the limit there and `rate` times as far at every further level.
    Inner { since: u8, limit: DVec3, offset: DVec3, rate: f64 },
    /// On a boundary, from an even level on: there the neighbours along the boundary, the one before it and the one after it
    /// with the mesh on the left, are at the position + bend/2 ∓ slope.
    Boundary { since: u8, limit: DVec3, bend: DVec3, slope: DVec3 },
}

impl Motion {
    /// That of an inner vertex.
    pub(crate) fn inner(since: u8, position: DVec3, limit: DVec3, rate: f64) -> Self {
        Self::Inner { since, limit, offset: position - limit, rate }
    }

    /// That of a boundary vertex between its neighbours along the boundary at a level.
    pub(crate) fn boundary(since: u8, [before, position, after]: [DVec3; 3]) -> Self {
        let bend = before + after - 2.0 * position;
        Self::Boundary { since, limit: position + bend / 6.0, bend, slope: (after - before) / 2.0 }
    }
}

/// For every vertex where it was born and how it moves from there.
#[derive(Clone, Debug, Default)]
pub(crate) struct Motions {
    births: Vec<DVec3>,
    motions: Vec<Motion>,
}

impl Motions {
    pub(crate) fn push(&mut self, birth: DVec3, motion: Motion) {
        self.births.push(birth);
        self.motions.push(motion);
    }

    pub(crate) fn truncate(&mut self, vertex_count: usize) {
        self.births.truncate(vertex_count);
        self.motions.truncate(vertex_count);
    }

    pub(crate) fn birth(&self, v: VertexId) -> DVec3 {
        self.births[v.index()]
    }

    pub(crate) fn set(&mut self, v: VertexId, motion: Motion) {
        self.motions[v.index()] = motion;
    }

    pub(crate) fn is_open(&self, v: VertexId) -> bool {
        self.motions[v.index()] == Motion::Open
    }

    /// Where a vertex is at a level, which is not below that of its birth.
    pub(crate) fn at(&self, v: VertexId, level: u8) -> DVec3 {
        match self.motions[v.index()] {
            Motion::Inner { since, limit, offset, rate } if since <= level => {
                limit + rate.powi(i32::from(level - since)) * offset
            }
            Motion::Open | Motion::Inner { .. } => self.birth(v),
            Motion::Boundary { since, limit, bend, .. } => limit - bend / 6.0 / 9f64.powi(cuts(since, level)),
        }
    }

    /// The neighbours of a boundary vertex along the boundary at a level: the one before it and the one after it, with the
    /// mesh on the left.
    pub(crate) fn along(&self, v: VertexId, level: u8) -> [DVec3; 2] {
        let Motion::Boundary { since, limit, bend, slope } = self.motions[v.index()] else {
            unreachable!("it is a boundary vertex")
        };
        let cuts = cuts(since, level);
        let (bend, slope) = (bend / 9f64.powi(cuts), slope / 3f64.powi(cuts));
        let middle = limit + bend / 3.0;
        [middle - slope, middle + slope]
    }

    /// Bytes held.
    pub(crate) fn memory_bytes(&self) -> usize {
        self.births.capacity() * size_of::<DVec3>() + self.motions.capacity() * size_of::<Motion>()
    }
}

/// How often boundary edges are cut in three between two levels: at every even one.
fn cuts(since: u8, level: u8) -> i32 {
    i32::from(level / 2) - i32::from(since / 2)
}
