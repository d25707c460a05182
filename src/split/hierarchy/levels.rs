//! Rings and triangles at the levels of a hierarchy.

use crate::id::VertexId;
use crate::rotation::{Ring, RingBuf, RotationSystem};
use crate::step::{Birth, Hierarchy, Parent};

/// What the mesh is at each level, as far as it was made: a function of the map from edges to the vertices that split them,
/// and of the rings of input vertices. Those are read from the mesh that is shown, each neighbour standing for the input
/// neighbour in whose direction it lies; so of the input nothing has to be kept.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Levels<'a> {
    rotation: &'a RotationSystem,
    hierarchy: &'a Hierarchy,
}

/// What lies across an edge of a triangle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Across {
    /// A triangle of the same level, with this third corner.
    Corner(VertexId),
    /// The outside of the mesh.
    Gap,
    /// Nothing of this level yet: this triangle, one level below, is not split.
    Unmade([VertexId; 3]),
}

impl<'a> Levels<'a> {
    pub(crate) fn new(rotation: &'a RotationSystem, hierarchy: &'a Hierarchy) -> Self {
        Self { rotation, hierarchy }
    }

    pub(crate) fn hierarchy(self) -> &'a Hierarchy {
        self.hierarchy
    }

    /// The ring of an input vertex in the input. O(valence · levels).
    pub(crate) fn input_ring(self, v: VertexId) -> RingBuf {
        let ring = self.rotation.ring(v);
        RingBuf::collect(ring.iter().filter_map(|w| self.input_neighbor(v, w)), ring.is_open())
    }

    /// The input neighbour of an input vertex in the direction of a neighbour; `None` if that closes a crack.
    fn input_neighbor(self, v: VertexId, mut neighbor: VertexId) -> Option<VertexId> {
        while let Some(birth) = self.hierarchy.birth(neighbor) {
            neighbor = birth.other_end(v)?;
        }
        Some(neighbor)
    }

    /// The neighbour that a vertex had at the level of its birth in the direction of a neighbour of a later level.
    pub(crate) fn first_neighbor(self, v: VertexId, mut neighbor: VertexId) -> VertexId {
        let level = self.hierarchy.level(v);
        let later = |w| self.hierarchy.birth(w).filter(|birth| birth.level > level);
        while let Some(before) = later(neighbor).and_then(|birth| birth.other_end(v)) {
            neighbor = before;
        }
        neighbor
    }

    /// The ring of a vertex at a level at which its star is complete, from the start that it has in a uniform mesh.
    /// O(valence · levels).
    ///
    /// # Panics
    /// If the star is not complete.
    pub(crate) fn ring(self, v: VertexId, level: u8) -> RingBuf {
        let (mut ring, birth_level) = match self.hierarchy.birth(v) {
            Some(birth) => (self.birth_ring(birth), birth.level),
            None => (self.input_ring(v), 0),
        };
        for _ in birth_level..level {
            ring = RingBuf::like(ring.as_ring(), |w| self.required_odd(v, w));
        }
        ring
    }

    /// The ring of a vertex at the level of its birth.
    fn birth_ring(self, birth: &Birth) -> RingBuf {
        let Parent { p, q, left, right } = birth.parent;
        let beside = |a, b, c| [self.required_odd(a, c), self.required_odd(b, c)];
        match (left, right) {
            (Some(left), Some(right)) => {
                let ([right_p, right_q], [left_q, left_p]) = (beside(p, q, right), beside(q, p, left));
                RingBuf::regular([p, right_p, right_q, q, left_q, left_p])
            }
            (None, Some(right)) => {
                let [right_p, right_q] = beside(p, q, right);
                RingBuf::open(&[p, right_p, right_q, q])
            }
            (Some(left), None) => {
                let [left_q, left_p] = beside(q, p, left);
                RingBuf::open(&[q, left_q, left_p, p])
            }
            (None, None) => unreachable!("an edge has a triangle"),
        }
    }

    /// The triangles around a vertex at the level of its birth, as far as they are made, each counter-clockwise from there.
    /// O(valence · levels) for an input vertex, else O(1).
    pub(crate) fn first_triangles(self, v: VertexId) -> Vec<[VertexId; 3]> {
        let mut found = Vec::new();
        match self.hierarchy.birth(v) {
            None => found.extend(self.input_ring(v).as_ring().pairs().map(|(a, b)| [v, a, b])),
            Some(birth) => {
                for [b, a, c] in beside(&birth.parent).into_iter().flatten() {
                    let side = [Some(a), self.hierarchy.odd(a, c), self.hierarchy.odd(b, c), Some(b)];
                    found.extend(side.windows(2).filter_map(|pair| Some([v, pair[0]?, pair[1]?])));
                }
            }
        }
        found
    }

    fn required_odd(self, a: VertexId, b: VertexId) -> VertexId {
        self.hierarchy.odd(a, b).expect("the star is complete at the levels before")
    }

    /// The triangles one level below that the star of a vertex at a level is made of, counter-clockwise each: those of its
    /// star there, or at its birth those beside the edge that it splits. None for level 0.
    pub(crate) fn triangles_below(self, v: VertexId, level: u8) -> Below {
        match self.hierarchy.birth(v) {
            Some(birth) if birth.level == level => Below::Edge(birth.parent),
            _ if level == 0 => Below::Nothing,
            _ => Below::Star(v, self.ring(v, level - 1)),
        }
    }

    /// The triangles beside the edge that a vertex splits, counter-clockwise each, left and right of its direction.
    pub(crate) fn triangles_beside(self, x: VertexId) -> [Option<[VertexId; 3]>; 2] {
        self.hierarchy.birth(x).map_or([None; 2], |birth| beside(&birth.parent))
    }

    /// What lies across the edge `a -> b` of a triangle `a, b, c`. O(1) but at level 0, where it costs the valence.
    pub(crate) fn across(self, [a, b, c]: [VertexId; 3]) -> Across {
        let level = self.hierarchy.level_of([a, b]);
        let births = [a, b].map(|v| self.hierarchy.birth(v).filter(|birth| birth.level == level));
        match births {
            [None, None] => {
                let ring = self.input_ring(a);
                ring.as_ring().prev(b).map_or(Across::Gap, Across::Corner)
            }
            [Some(birth), None] => self.across_half(birth, b, c),
            [None, Some(birth)] => self.across_half(birth, a, c),
            [Some(at_a), Some(at_b)] => {
                let [apex, y, z] = at_a.cut_corner(at_b);
                Across::Corner(if c == apex { self.required_odd(y, z) } else { apex })
            }
        }
    }

    /// What lies across the half, at one end, of the edge that a vertex splits, seen from the side of `c`.
    fn across_half(self, birth: &Birth, end: VertexId, c: VertexId) -> Across {
        let Parent { p, q, left, right } = birth.parent;
        let is_side =
            |corner: Option<VertexId>| corner.is_some_and(|corner| self.hierarchy.odd(end, corner) == Some(c));
        // Counter-clockwise.
        let beyond = if is_side(left) { right.map(|right| [q, p, right]) } else { left.map(|left| [p, q, left]) };
        match beyond {
            None => Across::Gap,
            Some(triangle) if self.hierarchy.is_split(triangle) => Across::Corner(self.required_odd(end, triangle[2])),
            Some(triangle) => Across::Unmade(triangle),
        }
    }

    /// When and where a vertex is made that splits the edge `a -> b` of a triangle `a, b, c`, across which there is a triangle
    /// of the same level, or nothing. `None` if that is too deep.
    pub(crate) fn birth(self, [a, b, c]: [VertexId; 3]) -> Option<Birth> {
        let right = match self.across([a, b, c]) {
            Across::Corner(right) => Some(right),
            Across::Gap => None,
            Across::Unmade(_) => unreachable!("the triangle across is of the same level"),
        };
        let level = self.hierarchy.level_of([a, b]).checked_add(1)?;
        Some(Birth { level, parent: self.parent([a, b], Some(c), right) })
    }

    /// The edge `a -> b` with the corners left and right of it, read in the direction that the rule at [`Parent`] says.
    fn parent(self, [a, b]: [VertexId; 2], left: Option<VertexId>, right: Option<VertexId>) -> Parent {
        let inward = !self.is_first([a, b], left, right);
        Parent::read(a, b, [left, right], inward)
    }

    /// Whether of the edge `a -> b` with these corners beside it `a` is the end that is read first.
    pub(super) fn is_first(self, [a, b]: [VertexId; 2], left: Option<VertexId>, right: Option<VertexId>) -> bool {
        let [of_a, of_b] = [a, b].map(|v| self.hierarchy.level(v));
        if of_a != of_b {
            return of_a < of_b;
        }
        let older = |corner: Option<VertexId>| corner.is_some_and(|corner| self.hierarchy.level(corner) < of_a);
        if of_a == 0 { a < b } else { older(left) || !older(right) }
    }
}

/// The triangles left and right of an edge.
fn beside(&Parent { p, q, left, right }: &Parent) -> [Option<[VertexId; 3]>; 2] {
    [left.map(|left| [p, q, left]), right.map(|right| [q, p, right])]
}

/// Triangles that a star is made of.
pub(crate) enum Below {
    Nothing,
    /// The one or two beside an edge.
    Edge(Parent),
    /// All around a vertex.
    Star(VertexId, RingBuf),
}

impl Below {
    /// The triangles in order, counter-clockwise each.
    pub(crate) fn iter(&self) -> impl Iterator<Item = [VertexId; 3]> + '_ {
        let beside = match self {
            Self::Edge(parent) => beside(parent),
            _ => [None; 2],
        };
        let around = match self {
            Self::Star(v, ring) => Some((*v, ring.as_ring())),
            _ => None,
        };
        let around =
            around.into_iter().flat_map(|(v, ring): (VertexId, Ring<'_>)| ring.pairs().map(move |(a, b)| [v, a, b]));
        beside.into_iter().flatten().chain(around)
    }
}
