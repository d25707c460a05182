//! The chart mesh: the faces with their own corners, cut along the seams.

mod bisect;
mod cut;
mod hierarchy;
mod lift;
mod quadrisect;
mod trisect;

use cut::{Cutter, next};
use glam::DVec3;
use lift::Lift;
use smallvec::SmallVec;
use trisect::Waiting;

use super::channel::Channel;
use super::{Seams, Splits};
use crate::id::{Edge, VertexId};
use crate::limit::Limit;
use crate::mesh::{Mesh, Sharpness};
use crate::rotation::{RingBuf, RotationSystem};
use crate::scratch::Scratch;
use crate::step::{History, SplitKind};
use crate::subdivide::Subdivider;

/// A mesh over a mesh: each of its vertices lies over a vertex of the mesh, each of its faces over a face.
///
/// Over an inner edge of a chart lies one chart edge, over a seam lie two, over a face without values none. A step
/// splits the chart mesh over what it splits in the mesh, so faces stay over faces, and the two sides of a seam stay over
/// the same vertices: nothing is torn. Under √3 the mesh turns the edge of a seam where a chart, which has a boundary
/// there, keeps it; so the faces beside the turned edge have no chart face over them, until the next step cuts the
/// boundary in three and turns the edge back.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    /// Rings, tags where a scheme reads them (sharp over sharp edges, corners over corners), and no positions: all are 0.
    mesh: Mesh,
    /// Of the chart vertices.
    history: History,
    seams: Seams,
    lift: Lift,
    /// Which chart vertices keep their values.
    is_fixed: Vec<bool>,
    /// Chart vertices that must not move: several of the same value, over the same vertex.
    pinned: Vec<VertexId>,
    /// After how many edits the tags of the mesh were as these are; `None` if they are out of date.
    tags_of: Option<u64>,
    /// What √3 made in the mesh, and not in the chart mesh yet.
    waiting: Waiting,
}

/// What a step did, after it.
pub(super) struct Done<'a> {
    pub(super) subdivider: &'a Subdivider,
    pub(super) splits: &'a Splits,
    pub(super) mesh: &'a Mesh,
    pub(super) history: &'a History,
}

impl Chart {
    /// Cuts a mesh along its seams; answers the number of the value at each chart vertex too.
    ///
    /// `values` has the numbers of the values at the corners of each triangle of the mesh, in order. A seam is an edge
    /// at which they differ, at one end or both; a triangle without values is left out. O(faces).
    pub(super) fn new(mesh: &Mesh, history: &History, values: &[Option<[u32; 3]>], seams: Seams) -> (Self, Vec<u32>) {
        let cutter = Cutter::new(mesh, values);
        let mut sectors = Vec::new();
        let mut chart_of = vec![u32::MAX; cutter.corners.len()];
        let (mut base, mut value_of, mut pinned) = (Vec::new(), Vec::new(), Vec::new());
        for v in mesh.vertices() {
            let first = sectors.len();
            cutter.append_sectors(v, &mut sectors);
            for (k, sector) in sectors.iter().enumerate().skip(first) {
                let corners = cutter.corners(v, sector);
                base.push(v);
                value_of.push(corners.clone().next().and_then(|corner| cutter.value(corner)).expect("it has values"));
                corners.for_each(|corner| chart_of[corner] = k as u32);
            }
            let is_repeated = |k: &usize| (first..sectors.len()).any(|j| j != *k && value_of[j] == value_of[*k]);
            pinned.extend((first..sectors.len()).filter(is_repeated).map(VertexId::new));
        }
        let chart_vertex = |corner: usize| VertexId::new(chart_of[corner] as usize);
        let rings = sectors.iter().zip(&base).map(|(sector, &v)| {
            let corners = cutter.corners(v, sector);
            let mut ring: Vec<VertexId> = corners.clone().map(|corner| chart_vertex(next(corner))).collect();
            if sector.is_closed {
                return RingBuf::closed(&ring);
            }
            ring.extend(corners.last().map(|corner| chart_vertex(next(next(corner)))));
            RingBuf::open(&ring)
        });
        let rotation = RotationSystem::from_rings(rings.collect());
        let mut chart = Self {
            mesh: Mesh::from_parts(rotation, vec![DVec3::ZERO; base.len()], mesh.tags().none()),
            history: history.lifted(&base),
            seams,
            lift: Lift::default(),
            is_fixed: Vec::new(),
            pinned,
            tags_of: None,
            waiting: Waiting::default(),
        };
        chart.lift.extend(mesh.vertex_count(), base);
        chart.fix_outline();
        chart.pinned.iter().for_each(|v| chart.is_fixed[v.index()] = true);
        chart.take_bisections(history);
        (chart, value_of)
    }

    /// Takes note of which new chart vertices keep their values.
    fn fix_outline(&mut self) {
        let new = self.is_fixed.len()..self.lift.len();
        let (rotation, keeps_outline) = (self.mesh.rotation(), self.seams == Seams::Linear);
        self.is_fixed.extend(new.map(|v| keeps_outline && rotation.is_boundary(VertexId::new(v))));
    }

    /// The vertex of the mesh below a chart vertex.
    pub(super) fn base(&self, chart_vertex: VertexId) -> VertexId {
        self.lift.base(chart_vertex)
    }

    /// The chart vertices over a vertex, the last made first.
    pub(super) fn over(&self, v: VertexId) -> impl Iterator<Item = VertexId> {
        self.lift.over(v)
    }

    /// Tells the chart edges over an edge, none, one, or the two sides of a seam, each by an end and its slot there.
    #[inline]
    fn edges_over(&self, [p, q]: [VertexId; 2], mut take: impl FnMut(VertexId, usize)) {
        let rotation = self.mesh.rotation();
        let (p, q) = if self.neighbors_over(p) <= self.neighbors_over(q) { (p, q) } else { (q, p) };
        for over_p in self.over(p) {
            for (slot, &w) in rotation.neighbors(over_p).iter().enumerate() {
                if self.base(w) == q {
                    take(over_p, slot);
                }
            }
        }
    }

    /// How long it takes to look at all neighbours of what lies over a vertex.
    #[inline]
    fn neighbors_over(&self, v: VertexId) -> usize {
        self.over(v).map(|over| self.mesh.rotation().valence(over)).sum()
    }

    /// The chart face over a triangle of the mesh, corner by corner; `None` if it has no values.
    pub(super) fn face_over(&self, corners: [VertexId; 3]) -> Option<[VertexId; 3]> {
        let rotation = self.mesh.rotation();
        let start = (0..3).min_by_key(|&k| self.neighbors_over(corners[k])).unwrap_or(0);
        let [a, b, c] = [0, 1, 2].map(|k| corners[(start + k) % 3]);
        let found = self.over(a).find_map(|over_a| {
            let mut pairs = rotation.ring(over_a).pairs();
            pairs.find(|&(w, u)| self.base(w) == b && self.base(u) == c).map(|(w, u)| [over_a, w, u])
        });
        found.map(|mut face| {
            face.rotate_right(start);
            face
        })
    }

    /// The chart as a mesh of its own, in the place of the mesh below.
    pub(super) fn lifted(&self, mesh: &Mesh) -> Mesh {
        let positions = self.mesh.vertices().map(|v| mesh.position(self.base(v))).collect();
        Mesh::from_parts(self.mesh.rotation().clone(), positions, self.mesh.tags().clone())
    }

    /// Takes the tags of the mesh over, if they are not those that were taken and came along since. To be called before
    /// a step by a scheme that reads them.
    pub(super) fn take_tags(&mut self, mesh: &Mesh) {
        let below = mesh.tags();
        if self.tags_of == Some(below.edits()) {
            return;
        }
        let mut tags = below.none();
        for edge in below.sharp_edges() {
            let sharpness = below.sharpness(edge);
            self.sides_over(edge).for_each(|over| tags.set_sharpness(over, sharpness));
        }
        for v in below.sharp_vertices() {
            let sharpness = below.vertex_sharpness(v);
            self.over(v).for_each(|over| tags.set_vertex_sharpness(over, sharpness));
        }
        self.pinned.iter().for_each(|&pinned| tags.set_vertex_sharpness(pinned, Sharpness::INFINITE));
        *self.mesh.parts_mut().2 = tags;
        self.tags_of = Some(below.edits());
    }

    /// Takes over what a step left of the tags. The scheme must be one that reads them; the chart vertices from `first`
    /// on are new. O(step).
    fn follow_tags(&mut self, first: usize, Done { splits, mesh, .. }: &Done<'_>) {
        let (below, tags) = (mesh.tags(), self.mesh.tags());
        if tags.is_empty() {
            return;
        }
        let new = (first..self.lift.len()).map(VertexId::new);
        let halves = new.flat_map(|x| tags.sharp_neighbors(x).iter().map(move |&end| Edge::new(x, end)));
        let halves: Vec<Edge> = halves.collect();
        let moved: Vec<VertexId> = splits.moved.iter().flat_map(|&v| self.over(v)).collect();
        let (lift, pinned) = (&self.lift, &self.pinned);
        let tags = self.mesh.parts_mut().2;
        for half in halves {
            let [a, b] = half.ends().map(|v| lift.base(v));
            tags.set_sharpness(half, below.sharpness(Edge::new(a, b)));
        }
        for v in moved.into_iter().filter(|v| pinned.binary_search(v).is_err()) {
            let sharpness = below.vertex_sharpness(lift.base(v));
            if sharpness != tags.vertex_sharpness(v) {
                tags.set_vertex_sharpness(v, sharpness);
            }
        }
    }

    /// The chart edges over an edge.
    fn sides_over(&self, edge: Edge) -> impl Iterator<Item = Edge> + use<> {
        let mut sides = SmallVec::<[Edge; 2]>::new();
        self.edges_over(edge.ends(), |v, slot| sides.push(Edge::new(v, self.mesh.ring(v).neighbors()[slot])));
        sides.into_iter()
    }

    /// Whether its steps were those of √3.
    pub(super) fn is_trisected(&self) -> bool {
        self.history.split_kind() == Some(SplitKind::Trisect)
    }

    /// Whether a step may read values that earlier ones kept, and these were not there.
    pub(super) fn joined_late(&self, values: &Channel) -> bool {
        let is_ahead = self.history.bisections().is_some_and(|bisections| !bisections.behind.is_empty());
        (is_ahead || self.history.has_motions()) && !values.is_empty() && !values.has_kept()
    }

    /// Does over the mesh what a step did to it.
    pub(super) fn follow(&mut self, done: &Done<'_>, values: &mut Channel, scratch: &mut Scratch) {
        let first = self.lift.len();
        match done.subdivider.scheme().split_kind() {
            SplitKind::Quadrisect if done.history.refinement().is_some() => {
                return self.follow_levels(done, values, scratch);
            }
            SplitKind::Quadrisect => self.follow_quadrisection(done, values, scratch),
            SplitKind::Trisect => self.follow_trisection(done, values, scratch),
            SplitKind::Bisect => self.follow_bisection(done, values, scratch),
        }
        if done.subdivider.scheme().reads_tags() {
            self.follow_tags(first, done);
        } else {
            self.tags_of = None;
        }
    }

    /// Puts the values where infinitely many steps of a scheme would.
    pub(super) fn move_to_limit(&self, limit: &impl Limit, values: &mut Channel) {
        let around = self.mesh.neighborhood();
        let moved = self.mesh.vertices().filter(|v| !self.is_fixed[v.index()]);
        values.move_by(moved, |values, v| {
            let mut sum = values.sum();
            limit.mask(around, v, &mut sum);
            sum.total()
        });
    }
}
