//! The surroundings of a vertex or an edge at one level, from which masks are read.

use glam::DVec3;

use super::sharpness::LevelTags;
use crate::id::{Edge, VertexId};
use crate::limit::Fan;
use crate::mesh::{Mesh, Neighborhood, Tags};
use crate::rotation::{Ring, RingBuf, RotationSystem};
use crate::scheme::{LoopWeights, Mask, MaskSink, Reach, Scheme, WeightedSum};
use crate::split::hierarchy::{Levels, Shown};
use crate::step::{Parent, Places, Refinement};
use crate::subdivide::ValueId;
use crate::subdivide::follow::Named;
use crate::subdivide::positions::NO_POSITION;

/// All levels of a refinement, with positions.
#[derive(Clone, Copy)]
pub(super) struct View<'a> {
    pub(super) levels: Levels<'a>,
    pub(super) tags: LevelTags<'a>,
    places: &'a Places,
    positions: &'a [DVec3],
    asks_for_stars: bool,
}

impl<'a> View<'a> {
    /// `positions` are those of the mesh, in which vertices that have not moved lie where they were born.
    pub(super) fn new(rotation: &'a RotationSystem, positions: &'a [DVec3], refinement: &'a Refinement) -> Self {
        let levels = Levels::new(rotation, &refinement.hierarchy);
        let tags = LevelTags::new(levels, &refinement.input_tags);
        Self { levels, tags, places: &refinement.places, positions, asks_for_stars: refinement.goes_back }
    }

    /// Those of a mesh that lies over another, which has these sharp edges.
    pub(super) fn over(
        mesh: &'a Mesh,
        refinement: &'a Refinement,
        below: &'a LevelTags<'a>,
        base: &'a [VertexId],
    ) -> Self {
        let view = Self::new(mesh.rotation(), mesh.positions(), refinement);
        Self { tags: view.tags.over(below, base), ..view }
    }

    /// Whether a vertex has moved, so that it is known where it is at each of its levels.
    pub(super) fn has_moved(self, v: VertexId) -> bool {
        self.places.at(v, u8::MAX).is_some()
    }

    /// The level at which a vertex is shown.
    pub(super) fn shown_level(self, v: VertexId) -> u8 {
        Shown::new(self.levels, v).1.level(self.asks_for_stars)
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

/// What gets a position at the next level.
#[derive(Clone, Copy)]
pub(super) enum Center {
    /// A vertex whose star is complete.
    Vertex(VertexId),
    /// The vertex that splits an edge.
    Edge(Parent),
}

impl Patch {
    /// Where something goes, from a level to the next.
    pub(super) fn position<S: Scheme>(&mut self, scheme: &S, view: View<'_>, center: Center, level: u8) -> DVec3 {
        let center = self.gather(view, center, level, scheme.reach());
        self.positions.clear();
        self.positions.extend(self.names.iter().map(|&v| view.position(v, level)));
        let mut sum = WeightedSum::new(|v: VertexId| self.positions[v.index()]);
        self.write(scheme, center, &mut sum);
        sum.total().unwrap_or(NO_POSITION)
    }

    /// Writes the mask of that under other names.
    pub(super) fn mask<S: Scheme>(
        &mut self,
        scheme: &S,
        view: View<'_>,
        (center, level): (Center, u8),
        name: impl Fn(VertexId) -> ValueId,
        mask: &mut Mask<ValueId>,
    ) {
        let center = self.gather(view, center, level, scheme.reach());
        self.write(scheme, center, &mut Named { mask, name: |v: VertexId| name(self.names[v.index()]) });
    }

    fn write<S: Scheme>(&self, scheme: &S, center: Center, mask: &mut impl MaskSink) {
        let around = Neighborhood::new(&self.rotation, &self.tags);
        match center {
            Center::Vertex(v) => scheme.even(around, v, mask),
            Center::Edge(parent) => scheme.odd(around, &parent, mask),
        }
    }

    /// The fan of a vertex toward a neighbour at a level, if its star is complete there and not semi-sharp.
    pub(super) fn fan(
        &mut self,
        view: View<'_>,
        weights: LoopWeights,
        [v, next]: [VertexId; 2],
        level: u8,
    ) -> Option<Fan> {
        if level > 0 && !view.levels.hierarchy().has_star(v, level) {
            return None;
        }
        let center = VertexId::new(0);
        self.begin([v]);
        self.add_star(view, center, level);
        let around = Neighborhood::new(&self.rotation, &self.tags);
        if around.is_semi_sharp(center) {
            return None;
        }
        let next = self.names.iter().position(|&name| name == next).expect("they are neighbours at the level");
        let position = |w: VertexId| view.position(self.names[w.index()], level);
        Some(Fan::of(around, position, weights, [center, VertexId::new(next)]))
    }

    /// Takes in what the mask reads, and answers with the center by its numbers here.
    fn gather(&mut self, view: View<'_>, center: Center, level: u8, reach: Reach) -> Center {
        let [first, second] = [0, 1].map(VertexId::new);
        match center {
            Center::Vertex(v) => {
                self.begin([v]);
                self.add_star(view, first, level);
                Center::Vertex(first)
            }
            Center::Edge(parent) => {
                self.begin([parent.p, parent.q]);
                if reach == Reach::BothStars {
                    self.add_star(view, first, level);
                    self.add_star(view, second, level);
                } else {
                    self.add_edge(view, &parent, level);
                }
                let [left, right] = [parent.left, parent.right].map(|corner| corner.map(|corner| self.number(corner)));
                Center::Edge(Parent { p: first, q: second, left, right })
            }
        }
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

    /// Adds the star of the center with the next number.
    fn add_star(&mut self, view: View<'_>, center: VertexId, level: u8) {
        let v = self.names[center.index()];
        let ring = view.levels.ring(v, level);
        let local = RingBuf::like(ring.as_ring(), |w| self.number(w));
        self.rotation.push_ring(local);
        if !view.tags.is_empty() {
            self.add_tags(view, center, ring.as_ring(), level);
        }
    }

    fn add_tags(&mut self, view: View<'_>, center: VertexId, ring: Ring<'_>, level: u8) {
        let v = self.names[center.index()];
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
}
