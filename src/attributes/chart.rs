//! The chart mesh: the faces with their own corners, cut along the seams.

use super::channel::Channel;
use super::{Seams, Splits};
use crate::id::{Edge, VertexId};
use crate::limit::Limit;
use crate::mesh::{Mesh, Neighborhood, Sharpness, Tags};
use crate::rotation::{Hubs, RingBuf, RotationSystem};
use crate::scheme::{AnyScheme, Mask, Midpoint, Scheme, with_scheme};
use crate::scratch::Scratch;
use crate::split::quadrisect::{self, Closing, Plan};
use crate::step::{History, Region, SplitKind};

/// In place of a chart vertex where a list ends.
const END: u32 = u32::MAX;

/// A mesh over a mesh: each of its vertices lies over a vertex of the mesh, each of its faces over a face.
///
/// Over an inner edge of a chart lies one chart edge, over a seam lie two, over a face without values none. A step
/// splits the chart edges over the edges that it splits in the mesh, so faces stay over faces, and the two sides of a
/// seam stay over the same vertices: nothing is torn.
#[derive(Clone, Debug)]
pub(super) struct Chart {
    rotation: RotationSystem,
    /// Sharp over sharp edges, corners over corners.
    tags: Tags,
    /// Of the chart vertices, for the direction in which edges are read.
    history: History,
    /// The vertex of the mesh below each chart vertex.
    base: Vec<VertexId>,
    /// For each vertex of the mesh the last chart vertex over it, and for each chart vertex the one before; or [`END`].
    last_over: Vec<u32>,
    before: Vec<u32>,
    /// Chart vertices that must not move: several of the same value, over the same vertex.
    pinned: Vec<VertexId>,
}

impl Chart {
    /// Cuts a mesh along its seams; answers the number of the value at each chart vertex too.
    ///
    /// `values` has the numbers of the values at the corners of each triangle of the mesh, in order. A seam is an edge
    /// at which they differ, at one end or both; a triangle without values is left out. O(faces).
    pub(super) fn new(mesh: &Mesh, history: &History, values: &[Option<[u32; 3]>]) -> (Self, Vec<u32>) {
        let cutter = Cutter::new(mesh, values);
        let mut sectors = Vec::new();
        let mut chart_of = vec![END; cutter.corners.len()];
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
        let history = history.lifted(|count| base.partition_point(|v| v.index() < count));
        let mut chart = Self {
            rotation,
            tags: Tags::default(),
            history,
            base: Vec::new(),
            last_over: Vec::new(),
            before: Vec::new(),
            pinned,
        };
        chart.lift(mesh.vertex_count(), base);
        (chart, value_of)
    }

    /// Puts new chart vertices over vertices of a mesh that has this many.
    fn lift(&mut self, vertex_count: usize, base: impl IntoIterator<Item = VertexId>) {
        self.last_over.resize(vertex_count, END);
        for v in base {
            let chart_vertex = self.base.len() as u32;
            self.before.push(std::mem::replace(&mut self.last_over[v.index()], chart_vertex));
            self.base.push(v);
        }
    }

    /// The vertex of the mesh below a chart vertex.
    pub(super) fn base(&self, chart_vertex: VertexId) -> VertexId {
        self.base[chart_vertex.index()]
    }

    /// The chart vertices over a vertex, the last made first.
    pub(super) fn over(&self, v: VertexId) -> impl Iterator<Item = VertexId> {
        let some = |chart_vertex: u32| (chart_vertex != END).then_some(chart_vertex);
        let before = move |&chart_vertex: &u32| some(self.before[chart_vertex as usize]);
        std::iter::successors(some(self.last_over[v.index()]), before).map(|id| VertexId::new(id as usize))
    }

    /// The chart edges over an edge: none, one, or the two sides of a seam.
    fn edges_over(&self, [p, q]: [VertexId; 2]) -> impl Iterator<Item = Edge> {
        let neighbors = |v| self.over(v).map(|over| self.rotation.valence(over)).sum::<usize>();
        let (p, q) = if neighbors(p) <= neighbors(q) { (p, q) } else { (q, p) };
        self.over(p).flat_map(move |over_p| {
            let ring = self.rotation.ring(over_p).iter();
            ring.filter(move |&w| self.base(w) == q).map(move |w| Edge::new(over_p, w))
        })
    }

    /// The chart face over a triangle of the mesh, corner by corner; `None` if it has no values.
    pub(super) fn face_over(&self, mesh: &Mesh, corners: [VertexId; 3]) -> Option<[VertexId; 3]> {
        let start = (0..3).min_by_key(|&k| mesh.ring(corners[k]).valence()).unwrap_or(0);
        let [a, b, c] = [0, 1, 2].map(|k| corners[(start + k) % 3]);
        let found = self.over(a).find_map(|over_a| {
            let mut pairs = self.rotation.ring(over_a).pairs();
            pairs.find(|&(w, u)| self.base(w) == b && self.base(u) == c).map(|(w, u)| [over_a, w, u])
        });
        found.map(|mut face| {
            face.rotate_right(start);
            face
        })
    }

    /// The chart as a mesh of its own, in the place of the mesh below.
    pub(super) fn lifted(&self, mesh: &Mesh) -> Mesh {
        let positions = self.base.iter().map(|&v| mesh.position(v)).collect();
        Mesh::from_parts(self.rotation.clone(), positions, self.tags.clone())
    }

    /// Takes the tags of the mesh over.
    pub(super) fn take_tags(&mut self, mesh: &Mesh) {
        let (below, mut tags) = (mesh.tags(), Tags::default());
        tags.set_rule(below.rule());
        for edge in below.sharp_edges() {
            let sharpness = below.sharpness(edge);
            self.edges_over(edge.ends()).for_each(|over| tags.set_sharpness(over, sharpness));
        }
        for v in below.sharp_vertices() {
            let sharpness = below.vertex_sharpness(v);
            self.over(v).for_each(|over| tags.set_vertex_sharpness(over, sharpness));
        }
        self.pinned.iter().for_each(|&pinned| tags.set_vertex_sharpness(pinned, Sharpness::INFINITE));
        self.tags = tags;
    }

    /// Does over the mesh what a step did to it; `mesh` is the mesh after the step, the tags are those before it.
    pub(super) fn follow(
        &mut self,
        splits: &Splits,
        mesh: &Mesh,
        scheme: &AnyScheme,
        channel: &mut Channel,
        seams: Seams,
        scratch: &mut Scratch,
    ) {
        let mut over: Vec<(Edge, VertexId)> = Vec::new();
        for (x, ends) in splits.made() {
            over.extend(self.edges_over(ends).map(|edge| (edge, x)));
        }
        over.sort_unstable();
        let region = Region::edges(over.iter().map(|&(edge, _)| edge));
        let ends = region.vertices(self.base.len());
        let (mut plan, mut closing) = (Plan::default(), Closing::default());
        quadrisect::plan(&mut plan, &self.rotation, &self.history, &region, &ends, scratch);

        let around = Neighborhood::new(&self.rotation, &self.tags).with_hubs(plan.hubs());
        let mut mask = Mask::default();
        with_scheme!(scheme, scheme => {
            for parent in plan.parents(around) {
                mask.clear();
                let is_inside = parent.left.is_some() && parent.right.is_some();
                let is_blended = (seams == Seams::Scheme || is_inside)
                    && splits.are_blended([parent.p, parent.q].map(|end| self.base(end)));
                if is_blended {
                    scheme.odd(around, &parent, &mut mask);
                } else {
                    Midpoint.odd(around, &parent, &mut mask);
                }
                channel.push(channel.odd(&mask, &[parent.p, parent.q], SplitKind::Quadrisect));
            }
            let moved = splits.moved.iter().flat_map(|&v| self.over(v)).filter(|&v| self.moves(v, seams));
            channel.move_by(moved, |v, mask| scheme.even(around, v, mask));
        }, else unreachable!("other splits are refused"));

        let below = |ends: [VertexId; 2]| {
            let edge = Edge::new(ends[0], ends[1]);
            over[over.partition_point(|&(other, _)| other < edge)].1
        };
        self.lift(mesh.vertex_count(), plan.odd().map(|(_, edge)| below(edge.ends())));
        let Self { rotation, base, .. } = self;
        let is_drawn = |a: VertexId, b: VertexId| mesh.rotation().has_edge(base[a.index()], base[b.index()]);
        quadrisect::apply(rotation, &plan, &mut closing, |quad, _| usize::from(!is_drawn(quad.ends[0], quad.odd[1])));
        self.history.record(SplitKind::Quadrisect, self.base.len(), std::iter::empty(), &[], closing.max_valence);
    }

    /// Puts the values where infinitely many steps of Loop's scheme would.
    pub(super) fn move_to_limit(&self, limit: &impl Limit, channel: &mut Channel, seams: Seams) {
        let around = Neighborhood::new(&self.rotation, &self.tags);
        let moved = self.rotation.vertices().filter(|&v| self.moves(v, seams));
        channel.move_by(moved, |v, mask| limit.mask(around, v, mask));
    }

    /// Whether the scheme may move a value that follows it.
    fn moves(&self, v: VertexId, seams: Seams) -> bool {
        seams == Seams::Scheme || !self.rotation.is_boundary(v)
    }
}

/// Faces around a vertex without a seam between them: so many from a slot on.
struct Sector {
    first_slot: usize,
    faces: usize,
    /// Whether they are all around the vertex, and no seam ends there.
    is_closed: bool,
}

/// Corners by number: three a triangle, in the order of the mesh.
struct Cutter<'a> {
    mesh: &'a Mesh,
    values: &'a [Option<[u32; 3]>],
    /// Where the corners at each vertex start in `corners`, and behind them their number.
    starts: Vec<usize>,
    /// The corners at each vertex, in the order of its ring.
    corners: Vec<usize>,
}

/// The corner after a corner of a triangle.
fn next(corner: usize) -> usize {
    if corner % 3 == 2 { corner - 2 } else { corner + 1 }
}

impl<'a> Cutter<'a> {
    fn new(mesh: &'a Mesh, values: &'a [Option<[u32; 3]>]) -> Self {
        let rotation = mesh.rotation();
        let mut starts = vec![0];
        for v in mesh.vertices() {
            starts.push(starts[v.index()] + rotation.ring(v).face_count());
        }
        let hubs = Hubs::among(rotation, mesh.vertices());
        let mut corners = vec![0; 3 * mesh.face_count()];
        for (k, triangle) in mesh.triangles().enumerate() {
            let [a, b, c] = triangle.corners();
            for (corner, (v, w)) in (3 * k..).zip([(a, b), (b, c), (c, a)]) {
                let slot = hubs.slot(rotation, v, w).expect("a triangle has edges");
                corners[starts[v.index()] + slot] = corner;
            }
        }
        Self { mesh, values, starts, corners }
    }

    /// The number of the value at a corner; `None` if its triangle has none.
    fn value(&self, corner: usize) -> Option<u32> {
        self.values[corner / 3].map(|values| values[corner % 3])
    }

    fn at(&self, v: VertexId) -> &[usize] {
        &self.corners[self.starts[v.index()]..self.starts[v.index() + 1]]
    }

    /// The corners of a sector, in ring order.
    fn corners(&self, v: VertexId, sector: &Sector) -> impl DoubleEndedIterator<Item = usize> + Clone {
        let at = self.at(v);
        let slots = sector.first_slot..sector.first_slot + sector.faces;
        slots.map(move |slot| at[slot % at.len()])
    }

    /// Whether there is no seam between the triangles of two corners that follow one another around a vertex.
    fn are_joined(&self, corner: usize, after: usize) -> bool {
        let ends = |corner, other| self.value(corner).zip(self.value(other));
        ends(corner, next(next(corner))).is_some_and(|ends_here| ends(after, next(after)) == Some(ends_here))
    }

    /// Appends the sectors with values, by first slot.
    fn append_sectors(&self, v: VertexId, sectors: &mut Vec<Sector>) {
        let at = self.at(v);
        let is_open = self.mesh.is_boundary(v);
        let starts_here = |slot: &usize| match slot.checked_sub(1) {
            Some(before) => !self.are_joined(at[before], at[*slot]),
            None => is_open || !self.are_joined(at[at.len() - 1], at[0]),
        };
        let cuts: Vec<usize> = (0..at.len()).filter(starts_here).collect();
        if cuts.is_empty() && !at.is_empty() {
            sectors.push(Sector { first_slot: 0, faces: at.len(), is_closed: true });
        }
        for (k, &first_slot) in cuts.iter().enumerate() {
            let end = cuts.get(k + 1).copied().unwrap_or(if is_open { at.len() } else { cuts[0] + at.len() });
            if self.value(at[first_slot]).is_some() {
                sectors.push(Sector { first_slot, faces: end - first_slot, is_closed: false });
            }
        }
    }
}
