//! The surroundings of a vertex or an edge at one level, from which masks are read.

use glam::DVec3;

use super::sharpness::LevelTags;
use crate::id::{Edge, VertexId};
use crate::mesh::{Neighborhood, Tags};
use crate::rotation::{Ring, RingBuf, RotationSystem};
use crate::scheme::{Reach, Scheme, WeightedSum};
use crate::split::hierarchy::Levels;
use crate::step::{Parent, Places, Refinement};
use crate::subdivide::positions::NO_POSITION;

/// All levels of a refinement, with positions.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) levels: Levels<'a>,
    pub(super) tags: LevelTags<'a>,
    places: &'a Places,
    positions: &'a [DVec3],
}

impl<'a> View<'a> {
    /// `positions` are those of the mesh, in which vertices that have not moved lie where they were born.
    pub(super) fn new(rotation: &'a RotationSystem, positions: &'a [DVec3], refinement: &'a Refinement) -> Self {
        let levels = Levels::new(rotation, &refinement.hierarchy);
        let tags = LevelTags::new(levels, &refinement.input_tags);
        Self { levels, tags, places: &refinement.places, positions }
    }

    /// Where a vertex is at a level.
    pub(super) fn position(self, v: VertexId, level: u8) -> DVec3 {
        self.places.at(v, level).unwrap_or(self.positions[v.index()])
    }
}

/// A few stars of one level, with numbers of their own, in memory that is used again.
#[derive(Default)]
pub(super) struct Patch {
    /// The rings of the vertices whose stars are there, which have the first numbers.
    rotation: RotationSystem,
    tags: Tags,
    names: Vec<VertexId>,
    positions: Vec<DVec3>,
}

impl Patch {
    /// Where a vertex goes at the level after one at which its star is complete.
    pub(super) fn even<S: Scheme>(&mut self, scheme: &S, view: View<'_>, v: VertexId, level: u8) -> DVec3 {
        self.begin([v]);
        self.add_star(view, 0, level);
        let center = VertexId::new(0);
        self.sum(view, level, |around, sum| scheme.even(around, center, sum))
    }

    /// Where the vertex is made that splits an edge of a level.
    pub(super) fn odd<S: Scheme>(&mut self, scheme: &S, view: View<'_>, parent: &Parent, level: u8) -> DVec3 {
        let Parent { p, q, left, right } = *parent;
        self.begin([p, q]);
        if scheme.reach() == Reach::BothStars {
            self.add_star(view, 0, level);
            self.add_star(view, 1, level);
        } else {
            self.add_edge(view, parent, level);
        }
        let [left, right] = [left, right].map(|corner| corner.map(|corner| self.number(corner)));
        let local = Parent { p: VertexId::new(0), q: VertexId::new(1), left, right };
        self.sum(view, level, |around, sum| scheme.odd(around, &local, sum))
    }

    fn begin<const N: usize>(&mut self, centers: [VertexId; N]) {
        self.rotation.truncate(0);
        if !self.tags.is_empty() {
            self.tags = Tags::default();
        }
        self.names.clear();
        self.names.extend(centers);
    }

    /// The number of a vertex here; it gets one if it has none.
    fn number(&mut self, v: VertexId) -> VertexId {
        let number = self.names.iter().position(|&name| name == v).unwrap_or_else(|| {
            self.names.push(v);
            self.names.len() - 1
        });
        VertexId::new(number)
    }

    /// Adds the star of the vertex with the next number.
    fn add_star(&mut self, view: View<'_>, number: usize, level: u8) {
        let v = self.names[number];
        let ring = view.levels.ring(v, level);
        let local = RingBuf::like(ring.as_ring(), |w| self.number(w));
        self.rotation.push_ring(local);
        if !view.tags.is_empty() {
            self.add_tags(view, number, ring.as_ring(), level);
        }
    }

    fn add_tags(&mut self, view: View<'_>, number: usize, ring: Ring<'_>, level: u8) {
        let (v, center) = (self.names[number], VertexId::new(number));
        self.tags.set_rule(view.tags.rule());
        self.tags.set_vertex_sharpness(center, view.tags.of_vertex(v, level));
        for (first, sharpness) in view.tags.around(v, level) {
            let neighbor = ring.iter().find(|&w| view.levels.first_neighbor(v, w) == first);
            let neighbor = neighbor.expect("a neighbour stands for each it had before");
            let edge = Edge::new(center, self.number(neighbor));
            self.tags.set_sharpness(edge, sharpness);
        }
    }

    /// Adds the two triangles beside an edge, which is all that schemes read that do not reach further.
    fn add_edge(&mut self, view: View<'_>, parent: &Parent, level: u8) {
        let q = VertexId::new(1);
        let [left, right] = [parent.left, parent.right].map(|corner| corner.map(|corner| self.number(corner)));
        // The edge is at an end of the ring if and only if it lies on a boundary.
        self.rotation.push_ring(RingBuf::collect(right.into_iter().chain([q]).chain(left), true));
        if !view.tags.is_empty() {
            let sharpness = view.tags.of_edge(parent.p, parent.q, level);
            self.tags.set_sharpness(Edge::new(VertexId::new(0), q), sharpness);
        }
    }

    /// Applies a mask to positions of a level.
    fn sum(
        &mut self,
        view: View<'_>,
        level: u8,
        write: impl FnOnce(Neighborhood<'_>, &mut WeightedSum<DVec3, &dyn Fn(VertexId) -> DVec3>),
    ) -> DVec3 {
        self.positions.clear();
        self.positions.extend(self.names.iter().map(|&v| view.position(v, level)));
        let position = |v: VertexId| self.positions[v.index()];
        let mut sum = WeightedSum::new(&position as &dyn Fn(VertexId) -> DVec3);
        write(Neighborhood::new(&self.rotation, &self.tags), &mut sum);
        sum.total().unwrap_or(NO_POSITION)
    }
}
