//! Sharp edges and vertices at every level.
//!
//! They follow from the tags of the input and the number of steps, so of a level nothing is kept, and nothing has to be found
//! again when edges are made whole.

use crate::id::{Edge, VertexId};
use crate::mesh::{Sharpness, SharpnessRule, Tags};
use crate::split::hierarchy::Levels;

/// How sharp a vertex itself is at a level, by the tags of the input.
pub(super) fn of_vertex(input: &Tags, v: VertexId, level: u8) -> Sharpness {
    (0..level).fold(
        input.vertex_sharpness(v),
        |sharpness, _| {
            if sharpness.is_semi_sharp() { sharpness.decayed() } else { sharpness }
        },
    )
}

/// The tags of all levels.
#[derive(Clone, Copy)]
pub(super) struct LevelTags<'a> {
    levels: Levels<'a>,
    input: &'a Tags,
    /// Of a mesh that lies over another the tags of that one, with the vertex below each of its vertices: how sharp an edge
    /// is follows from all edges around its ends, and at a seam one side has not all of them.
    below: Option<(&'a LevelTags<'a>, &'a [VertexId])>,
}

impl<'a> LevelTags<'a> {
    pub(super) fn new(levels: Levels<'a>, input: &'a Tags) -> Self {
        Self { levels, input, below: None }
    }

    /// The same of a mesh that lies over another, with vertices over these.
    pub(super) fn over(self, below: &'a Self, base: &'a [VertexId]) -> Self {
        Self { below: Some((below, base)), ..self }
    }

    pub(super) fn is_empty(self) -> bool {
        self.input.is_empty()
    }

    pub(super) fn rule(self) -> SharpnessRule {
        self.input.rule()
    }

    /// How sharp a vertex itself is at a level.
    pub(super) fn of_vertex(self, v: VertexId, level: u8) -> Sharpness {
        of_vertex(self.input, v, level)
    }

    /// How sharp an edge of a level is, which leads from `v` to `w`.
    pub(super) fn of_edge(self, v: VertexId, w: VertexId, level: u8) -> Sharpness {
        let first = self.levels.first_neighbor(v, w);
        let found = self.around(v, level).into_iter().find(|(neighbor, _)| *neighbor == first);
        found.map_or(Sharpness::SMOOTH, |(_, sharpness)| sharpness)
    }

    /// The sharp edges at a vertex at a level, not below that of its birth, by the neighbours to which they led there; in the
    /// order in which they stand in the tags of a uniform mesh.
    pub(super) fn around(self, v: VertexId, level: u8) -> Vec<(VertexId, Sharpness)> {
        let birth = self.levels.hierarchy().birth(v);
        if let Some((below, base)) = self.below {
            let neighbors = match birth {
                None => self.levels.input_ring(v).as_ring().iter().collect(),
                Some(birth) => vec![birth.parent.p, birth.parent.q],
            };
            let over = |first| neighbors.iter().copied().filter(move |w| base[w.index()] == first);
            let edges = below.around(base[v.index()], level).into_iter();
            return edges.flat_map(|(first, sharpness)| over(first).map(move |w| (w, sharpness))).collect();
        }
        let mut edges = match birth {
            None => {
                let neighbors = self.input.sharp_neighbors(v).iter();
                neighbors.map(|&w| (w, self.input.sharpness(Edge::new(v, w)))).collect()
            }
            Some(birth) => {
                let (p, q, level) = (birth.parent.p, birth.parent.q, birth.level - 1);
                let [a, b] = if p < q { [p, q] } else { [q, p] };
                let half = |end, other| (end, self.half(end, other, level));
                [half(a, b), half(b, a)].into_iter().filter(|(_, half)| half.is_sharp()).collect::<Vec<_>>()
            }
        };
        for _ in birth.map_or(0, |birth| birth.level)..level {
            self.go_on(&mut edges);
        }
        edges
    }

    /// How sharp the half at its end `v` is of an edge of a level that leads to `w`.
    fn half(self, v: VertexId, w: VertexId, level: u8) -> Sharpness {
        let mut edges = self.around(v, level);
        self.go_on(&mut edges);
        let first = self.levels.first_neighbor(v, w);
        let found = edges.into_iter().find(|(neighbor, _)| *neighbor == first);
        found.map_or(Sharpness::SMOOTH, |(_, sharpness)| sharpness)
    }

    /// Goes on to the next level.
    fn go_on(self, edges: &mut Vec<(VertexId, Sharpness)>) {
        let before = edges.clone();
        for (k, (_, sharpness)) in edges.iter_mut().enumerate() {
            let others = before.iter().enumerate().filter(|(other, _)| *other != k).map(|(_, edge)| edge.1);
            *sharpness = self.input.rule().child(*sharpness, others);
        }
        edges.retain(|(_, sharpness)| sharpness.is_sharp());
    }
}
