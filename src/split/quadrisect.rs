//! The 1-to-4 split of a region, in place, and the closing of its cracks.
//!
//! Every split edge gets a new vertex; a face with three split edges becomes four faces, one with fewer is closed: with
//! one it is bisected, with two it becomes three faces. Whatever the mix, each split edge adds one face on each side.
//!
//! Existing vertices keep their ids and the start of their ring: the slot of a neighbour takes the new vertex between,
//! and closing inserts directly after a neighbour. So equal surroundings have equal rings, from the same start on,
//! however much was refined elsewhere.

use super::Quad;
use super::peers::Peers;
use crate::id::{Edge, VertexId};
use crate::mesh::Neighborhood;
use crate::query::expand;
use crate::rotation::{Hubs, RingBuf, RotationSystem};
use crate::scratch::Scratch;
use crate::step::{History, Parent, Region, RegionKind};

/// Up to this many neighbours are put into a ring one by one; for more the ring is made anew, or a long one would be moved
/// along for each.
const SINGLY: usize = 8;

/// An edge that is split, with the slots at which each end stands in the ring of the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SplitEdge {
    p: VertexId,
    q: VertexId,
    /// Where `q` stands in the ring of `p`.
    slot_in_p: u32,
    slot_in_q: u32,
}

impl SplitEdge {
    /// The edge with its opposite corners, in the rings before the step.
    #[inline]
    fn parent(&self, around: Neighborhood<'_>) -> Parent {
        let [left, right] = around.ring(self.p).corners_at(self.slot_in_p as usize);
        Parent { p: self.p, q: self.q, left, right }
    }

    #[inline]
    pub(crate) fn ends(&self) -> [VertexId; 2] {
        [self.p, self.q]
    }

    #[inline]
    pub(crate) fn edge(&self) -> Edge {
        Edge::new(self.p, self.q)
    }
}

/// What a step will do to the topology: the new vertices, numbered from `first` in the order of `edges`.
#[derive(Debug, Default)]
pub(crate) struct Plan {
    /// The number of vertices before the step.
    pub(crate) first: usize,
    /// In order of (smaller end, slot in its ring).
    pub(crate) edges: Vec<SplitEdge>,
    /// How many faces the step adds.
    pub(crate) added_faces: usize,
    hubs: Hubs,
}

impl Plan {
    /// The split edges as parents, in order, with their surroundings before the step.
    pub(crate) fn parents(&self, around: Neighborhood<'_>) -> impl ExactSizeIterator<Item = Parent> {
        self.edges.iter().map(move |edge| edge.parent(around))
    }

    /// Very long rings among those of the region.
    pub(crate) fn hubs(&self) -> &Hubs {
        &self.hubs
    }

    /// The new vertices with what they split.
    pub(crate) fn odd(&self) -> impl ExactSizeIterator<Item = (VertexId, &SplitEdge)> + Clone {
        self.edges.iter().enumerate().map(|(k, edge)| (VertexId::new(self.first + k), edge))
    }
}

/// Reads what is to be split, in place of what an earlier plan held. O(edges at the vertices of the region, which come
/// with it).
pub(crate) fn plan(
    plan: &mut Plan,
    rotation: &RotationSystem,
    history: &History,
    region: &Region,
    vertices: &[VertexId],
    scratch: &mut Scratch,
) {
    plan.first = rotation.vertex_count();
    plan.edges.clear();
    plan.added_faces = 0;
    plan.hubs = Hubs::among(rotation, vertices.iter().copied());
    let mut planner = Planner { rotation, history, peers: Peers::of(history, VertexId::new(0)), plan };
    match region.kind() {
        RegionKind::Everything => {
            planner.plan.edges.reserve_exact(rotation.edge_count());
            planner.split_between(vertices, |_| true);
        }
        RegionKind::Induced(_) => {
            let marks = scratch.marked(rotation.vertex_count(), vertices);
            planner.split_between(vertices, |v| marks.is_set(v));
        }
        RegionKind::Edges(edges) => planner.split_listed(edges),
        RegionKind::Stars(centers) => {
            let mut near = scratch.take_list();
            near.extend_from_slice(centers);
            expand(rotation, &mut near, 1, scratch);
            near.sort_unstable();
            planner.plan.hubs = Hubs::among(rotation, near.iter().copied());
            let marks = scratch.marked(rotation.vertex_count(), centers);
            planner.split_around(&near, |v| marks.is_set(v));
            scratch.give_list(near);
        }
    }
}

/// Reads what is to be split as [`plan`] does, but edges of a list, each given by one end and a slot of its ring; new
/// vertices come in the order of the list. O(edges).
pub(crate) fn plan_listed(
    plan: &mut Plan,
    rotation: &RotationSystem,
    history: &History,
    edges: impl Iterator<Item = (VertexId, usize)> + Clone,
) {
    plan.first = rotation.vertex_count();
    plan.edges.clear();
    plan.added_faces = 0;
    plan.hubs = Hubs::among(rotation, edges.clone().flat_map(|(v, slot)| [v, rotation.neighbors(v)[slot]]));
    let mut planner = Planner { rotation, history, peers: Peers::of(history, VertexId::new(0)), plan };
    for (v, slot) in edges {
        let w = rotation.neighbors(v)[slot];
        if v < w {
            planner.split(v, slot);
        } else {
            let slot = planner.slot(w, v);
            planner.split(w, slot);
        }
    }
}

struct Planner<'a> {
    rotation: &'a RotationSystem,
    history: &'a History,
    /// Of the vertex at hand.
    peers: Peers,
    plan: &'a mut Plan,
}

impl Planner<'_> {
    #[inline]
    fn split_between(&mut self, vertices: &[VertexId], inside: impl Fn(VertexId) -> bool) {
        for &v in vertices {
            for (slot, &w) in self.rotation.neighbors(v).iter().enumerate() {
                if v < w && inside(w) {
                    self.split(v, slot);
                }
            }
        }
    }

    /// Splits all edges of the faces that have a corner among the `centers`; `near` are all vertices of these.
    fn split_around(&mut self, near: &[VertexId], is_center: impl Fn(VertexId) -> bool) {
        for &v in near {
            let ring = self.rotation.ring(v);
            for (slot, &w) in ring.neighbors().iter().enumerate() {
                let is_beside = || ring.corners_at(slot).into_iter().flatten().any(&is_center);
                if v < w && (is_center(v) || is_center(w) || is_beside()) {
                    self.split(v, slot);
                }
            }
        }
    }

    fn split_listed(&mut self, edges: &[Edge]) {
        let mut at: Vec<(VertexId, usize)> = Vec::with_capacity(edges.len());
        for edge in edges {
            let [a, b] = edge.ends();
            at.push((a, self.slot(a, b)));
        }
        at.sort_unstable();
        for (v, slot) in at {
            self.split(v, slot);
        }
    }

    #[inline]
    fn slot(&self, v: VertexId, neighbor: VertexId) -> usize {
        self.plan.hubs.slot(self.rotation, v, neighbor).expect("rings are symmetric")
    }

    /// Plans the edge from `v` to the greater neighbour at a slot.
    #[inline]
    fn split(&mut self, v: VertexId, slot: usize) {
        let ring = self.rotation.ring(v);
        let w = ring.neighbors()[slot];
        let sides = [ring.slot_before(slot), ring.slot_after(slot)];
        self.plan.added_faces += sides.into_iter().flatten().count();
        self.peers.move_to(self.history, v);
        let runs_down = self.peers.run_inward(ring.corners_at(slot), w);
        let (slot, slot_in_w) = (slot as u32, self.slot(w, v) as u32);
        let edge = if runs_down {
            SplitEdge { p: w, q: v, slot_in_p: slot_in_w, slot_in_q: slot }
        } else {
            SplitEdge { p: v, q: w, slot_in_p: slot, slot_in_q: slot_in_w }
        };
        self.plan.edges.push(edge);
    }
}

/// What closing did.
#[derive(Debug, Default)]
pub(crate) struct Closing {
    /// The edges drawn to close faces, in the order of the new vertices.
    pub(crate) edges: Vec<Edge>,
    /// New vertices with a triangle that was not split in four, ascending.
    pub(crate) t_vertices: Vec<VertexId>,
    /// Old vertices that got a neighbour more, ascending.
    pub(crate) o_vertices: Vec<VertexId>,
    /// The greatest valence of a vertex that is new or got a neighbour more.
    pub(crate) max_valence: usize,
    /// (vertex, neighbour after which, new neighbour)
    insertions: Vec<(VertexId, VertexId, VertexId)>,
    shifts: Vec<Shift>,
}

/// Splits as planned, and says in `closing` what that did, in place of what an earlier step did. O(split edges), and
/// O(valence) for each old vertex that closing reaches.
///
/// `diagonal` answers from which of the two ends of a [`Quad`] its diagonal goes; it sees the valences before the step.
pub(crate) fn apply(
    rotation: &mut RotationSystem,
    plan: &Plan,
    closing: &mut Closing,
    diagonal: impl Fn(Quad, &RotationSystem) -> usize,
) {
    for (x, edge) in plan.odd() {
        rotation.set_neighbor(edge.p, edge.slot_in_p as usize, x);
        rotation.set_neighbor(edge.q, edge.slot_in_q as usize, x);
    }

    rotation.reserve(plan.edges.len());
    closing.clear();
    let mut closer = Closer { first: plan.first, diagonal, closing };
    for (x, edge) in plan.odd() {
        let ring = closer.ring(rotation, x, edge);
        closer.closing.max_valence = closer.closing.max_valence.max(ring.as_ring().valence());
        rotation.push_ring(ring);
    }

    // Only now, as the slots of the plan hold until here.
    let Closing { insertions, shifts, o_vertices, max_valence, .. } = closing;
    let hubs = Hubs::among(rotation, insertions.iter().map(|&(o, ..)| o));
    let slot_of = |o, pred| hubs.slot(rotation, o, pred).expect("it is a neighbour");
    shifts.extend(insertions.iter().map(|&(o, pred, x)| (o, slot_of(o, pred), x)));
    shifts.sort_unstable();
    for at_one in shifts.chunk_by(|one, other| one.0 == other.0) {
        insert(rotation, at_one);
        o_vertices.push(at_one[0].0);
    }
    let grown = o_vertices.iter().map(|&o| rotation.valence(o)).max().unwrap_or(0);
    *max_valence = (*max_valence).max(grown);
}

impl Closing {
    pub(crate) fn clear(&mut self) {
        self.edges.clear();
        self.t_vertices.clear();
        self.o_vertices.clear();
        self.max_valence = 0;
        self.insertions.clear();
        self.shifts.clear();
    }
}

/// (vertex, slot after which, new neighbour)
type Shift = (VertexId, usize, VertexId);

/// Puts new neighbours, ascending by slot, into the ring of one vertex. A slot has one at most: it stands for one face.
fn insert(rotation: &mut RotationSystem, shifts: &[Shift]) {
    let o = shifts[0].0;
    if shifts.len() <= SINGLY {
        // From the back, so that slots in front stay what they were.
        for &(_, slot, x) in shifts.iter().rev() {
            rotation.insert_after(o, slot, x);
        }
        return;
    }
    let ring = rotation.ring(o);
    let mut after = shifts.iter().peekable();
    let mut neighbors = Vec::with_capacity(ring.valence() + shifts.len());
    for (slot, w) in ring.iter().enumerate() {
        neighbors.push(w);
        neighbors.extend(after.next_if(|shift| shift.1 == slot).map(|shift| shift.2));
    }
    let ring = if ring.is_open() { RingBuf::open(&neighbors) } else { RingBuf::closed(&neighbors) };
    rotation.set_ring(o, ring);
}

struct Closer<'a, D> {
    first: usize,
    diagonal: D,
    closing: &'a mut Closing,
}

/// The ring of a new vertex while it is put together: at most two ends and two neighbours on each side.
struct Entries {
    list: [VertexId; 6],
    len: usize,
}

impl Entries {
    #[inline]
    fn push(&mut self, v: VertexId) {
        self.list[self.len] = v;
        self.len += 1;
    }
}

/// The neighbours of a new vertex that its ends show on one side: beside it in the ring of the end where the side starts,
/// counter-clockwise, and in that of the end where it stops. `None` if there is no face.
type Side = Option<[VertexId; 2]>;

impl<D: Fn(Quad, &RotationSystem) -> usize> Closer<'_, D> {
    #[inline]
    fn is_new(&self, v: VertexId) -> bool {
        v.index() >= self.first
    }

    /// The ring of the new vertex `x`: from `p` counter-clockwise, or from the gap.
    #[inline]
    fn ring(&mut self, rotation: &RotationSystem, x: VertexId, edge: &SplitEdge) -> RingBuf {
        let [left_p, right_p] = rotation.ring(edge.p).corners_at(edge.slot_in_p as usize);
        let [right_q, left_q] = rotation.ring(edge.q).corners_at(edge.slot_in_q as usize);
        // Inside of the region nothing is to be closed, and there it must be fast.
        if let (Some(right_p), Some(right_q), Some(left_q), Some(left_p)) = (right_p, right_q, left_q, left_p) {
            let around = [right_p, right_q, left_q, left_p];
            if around.into_iter().all(|v| self.is_new(v)) {
                return RingBuf::regular([edge.p, right_p, right_q, edge.q, left_q, left_p]);
            }
        }
        let right = right_p.zip(right_q).map(|(p, q)| [p, q]);
        let left = left_q.zip(left_p).map(|(q, p)| [q, p]);
        self.border_ring(rotation, x, edge, right, left)
    }

    /// The ring of a new vertex on a boundary, or with a face that is to be closed.
    fn border_ring(
        &mut self,
        rotation: &RotationSystem,
        x: VertexId,
        edge: &SplitEdge,
        right: Side,
        left: Side,
    ) -> RingBuf {
        let mut entries = Entries { list: [VertexId::GAP; 6], len: 0 };
        let mut whole = true;
        if let Some(between) = right {
            entries.push(edge.p);
            whole &= self.side(rotation, x, [edge.p, edge.q], between, &mut entries);
        }
        entries.push(edge.q);
        if let Some(between) = left {
            whole &= self.side(rotation, x, [edge.q, edge.p], between, &mut entries);
        }
        if right.is_none() {
            entries.push(edge.p);
        }
        if !whole {
            self.closing.t_vertices.push(x);
        }
        let neighbors = &entries.list[..entries.len];
        if right.is_some() && left.is_some() { RingBuf::closed(neighbors) } else { RingBuf::open(neighbors) }
    }

    /// One side of the new vertex `x`: its neighbours counter-clockwise between the end `a` and the end `b`, in the face
    /// `b, a, c`. Answers whether the face becomes four.
    fn side(
        &mut self,
        rotation: &RotationSystem,
        x: VertexId,
        [a, b]: [VertexId; 2],
        [at_a, at_b]: [VertexId; 2],
        entries: &mut Entries,
    ) -> bool {
        match (self.is_new(at_a), self.is_new(at_b)) {
            (true, true) => {
                entries.push(at_a);
                entries.push(at_b);
                return true;
            }
            // Both ends show the corner c itself.
            (false, false) => {
                entries.push(at_a);
                self.insert(x, at_a, b);
            }
            // Also a - c is split: the corner a is cut off, c and b are the ends of the edge that stays.
            (true, false) => {
                let c = at_b;
                entries.push(at_a);
                self.cut(x, at_a);
                if (self.diagonal)(Quad { ends: [c, b], odd: [at_a, x] }, rotation) == 0 {
                    entries.push(c);
                    self.insert(x, c, b);
                }
            }
            // Also b - c is split: the corner b is cut off.
            (false, true) => {
                let c = at_a;
                self.cut(x, at_b);
                if (self.diagonal)(Quad { ends: [a, c], odd: [x, at_b] }, rotation) == 1 {
                    entries.push(c);
                    self.insert(x, c, at_b);
                }
                entries.push(at_b);
            }
        }
        false
    }

    /// Draws the edge from `x` to the opposite corner `c`, in whose ring `x` comes directly after `pred`.
    fn insert(&mut self, x: VertexId, c: VertexId, pred: VertexId) {
        self.closing.insertions.push((c, pred, x));
        self.closing.edges.push(Edge::new(c, x));
    }

    /// Draws the edge that cuts off a corner; both its ends come here, one of them counts.
    fn cut(&mut self, x: VertexId, other: VertexId) {
        if x < other {
            self.closing.edges.push(Edge::new(x, other));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;
    use crate::step::Keep;

    fn ids(indices: &[usize]) -> Vec<VertexId> {
        indices.iter().copied().map(VertexId::new).collect()
    }

    /// The rotation of a shape with the edges between these vertices split.
    fn split(mesh: &crate::Mesh, vertices: &[usize]) -> (RotationSystem, Closing) {
        let mut rotation = mesh.rotation().clone();
        let history = History::new(mesh, Keep::default());
        let (mut plan, mut closing) = (Plan::default(), Closing::default());
        let (region, vertices) = (Region::induced(ids(vertices)), ids(vertices));
        super::plan(&mut plan, &rotation, &history, &region, &vertices, &mut Scratch::new());
        apply(&mut rotation, &plan, &mut closing, |_, _| unreachable!("no face has two split edges"));
        (rotation, closing)
    }

    /// Two triangles 0 1 3 and 0 3 2; the vertices are those of a unit square.
    #[test]
    fn one_triangle_is_split_and_the_next_closed() {
        let (rotation, closing) = split(&shapes::grid(1, 1), &[0, 1, 3]);
        // In the ring of 0 the neighbours are 1, 3, 2: so 4 lies on 0-1, 5 on 0-3, 6 on 1-3.
        let rings: Vec<Vec<VertexId>> = rotation.vertices().map(|v| rotation.neighbors(v).to_vec()).collect();
        let expected: [&[usize]; 7] =
            [&[4, 5, 2], &[6, 4], &[0, 5, 3], &[2, 5, 6], &[1, 6, 5, 0], &[0, 4, 6, 3, 2], &[3, 5, 4, 1]];
        assert_eq!(rings, expected.map(ids));
        assert_eq!((closing.t_vertices, closing.o_vertices), (ids(&[5]), ids(&[2])));
        assert_eq!(closing.edges, [Edge::new(VertexId::new(2), VertexId::new(5))]);
        assert_eq!(closing.max_valence, 5);
    }

    /// The twelve corners of an icosahedron but one: that one gets a neighbour for each of its faces.
    #[test]
    fn an_opposite_vertex_gets_a_neighbour_for_each_face() {
        let mesh = shapes::icosahedron();
        let o = VertexId::new(11);
        let (rotation, closing) = split(&mesh, &(0..11).collect::<Vec<_>>());
        let old: Vec<VertexId> = rotation.neighbors(o).iter().copied().step_by(2).collect();
        assert_eq!((old, rotation.valence(o)), (mesh.ring(o).neighbors().to_vec(), 10));
        assert_eq!((closing.o_vertices, closing.t_vertices.len(), closing.max_valence), (vec![o], 5, 10));
    }
}
