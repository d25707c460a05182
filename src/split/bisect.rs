//! The bisection of triangles at their refinement edges: what a step splits, and the rings after it.
//!
//! A step splits every triangle of its region once, into two at its refinement edge; an input triangle that is in no
//! block is split into three at its centre. Splits are simultaneous for triangles of one generation, and those of a
//! lower one come first. More triangles than those of the region are split where one of these rules asks for it:
//!
//! 1. A triangle with a split edge is split itself. So both triangles beside a split edge are bisected at it, one of
//!    them perhaps as a half of a triangle that was bisected just before, and the mesh stays conforming.
//! 2. A triangle of generation g is split only when all triangles at its corners, and at those of its partner, have at
//!    least generation g. So the star of every corner is there in generation g, and with it the position that a mask
//!    reads.
//!
//! The rules lead from a triangle to others of lower generations, or to its partner, so their closure is found with a
//! list of triangles that are due, without recursion. **Balance**: triangles that share a vertex differ by one
//! generation at most. It holds for the input, and rule 2 keeps it: where a triangle becomes generation g + 1, none is
//! below g. Therefore every edge that a step splits is an edge of the mesh before it, and a triangle becomes two, three
//! or four (an input triangle in no block three to six).
//!
//! **Order.** Existing vertices keep the start of their rings: a new vertex takes the slot of the far end of its edge;
//! in the ring of an apex it comes directly after the one of the two ends that it came from, never before slot 0. The
//! ring of a new vertex starts at the older end of its edge, at an input triangle's centre at the smallest corner, and
//! at a boundary after the gap. New vertices are numbered by (smaller end, slot in its ring), a centre as if its
//! triangle were right behind the edge at that slot. So no order depends on ids that are given later, nor on the step
//! that splits a triangle.
//!
//! **Deliberately not here**: positions, and the pairs of input triangles ([`super::matching`]).

use super::generation::Generations;
use crate::error::RefineError;
use crate::id::{Edge, VertexId};
use crate::rotation::{Hubs, RingBuf, RotationSystem};
use crate::scratch::{Marks, Scratch};
use crate::step::{Lineage, Parent, Region, RegionKind};

/// No new vertex.
const NONE: u32 = u32::MAX;

/// What happens at one slot of a vertex: numbers of new vertices.
#[derive(Clone, Copy)]
struct Cell {
    /// On the edge to the neighbour at the slot.
    edge: u32,
    /// Opposite, in the triangle behind the slot: on its refinement edge, if the vertex is its apex, or at its centre.
    opposite: u32,
}

/// A new vertex.
#[derive(Clone, Copy)]
struct New {
    /// In which order it was met.
    met: u32,
    /// The generation of the triangles that it splits; its own level is one more.
    generation: u8,
    place: Place,
}

#[derive(Clone, Copy)]
enum Place {
    /// On the edge from `p` to `q`, with the slots at which each end stands in the ring of the other.
    Edge { p: VertexId, q: VertexId, slot_in_p: u32, slot_in_q: u32 },
    /// In an input triangle, from its smallest corner on, with the slots of the next corner in the ring of each.
    Center { corners: [VertexId; 3], slots: [u32; 3] },
}

impl New {
    /// What new vertices are numbered by.
    fn order(&self) -> (VertexId, u32, bool) {
        match self.place {
            Place::Edge { p, q, slot_in_p, .. } if p < q => (p, slot_in_p, false),
            Place::Edge { q, slot_in_q, .. } => (q, slot_in_q, false),
            Place::Center { corners, slots } => (corners[0], slots[0], true),
        }
    }
}

/// What lies on one side of a split edge, in the order round its new vertex.
#[derive(Clone, Copy)]
enum Side {
    /// A triangle of which it is the refinement edge, or was once the triangle is bisected: the new vertices beside the
    /// corner, if there are any, and the corner.
    Corner { before: Option<VertexId>, corner: VertexId, after: Option<VertexId> },
    /// A triangle that is split before, at this vertex.
    Split(VertexId),
}

impl Side {
    /// The third corner of the triangle that is bisected on this side.
    fn apex(self) -> VertexId {
        match self {
            Self::Corner { corner, .. } | Self::Split(corner) => corner,
        }
    }
}

/// What is split in a mesh that lies over another: where it has what the other one splits. Seeds ascend in the order in
/// which what they make is numbered.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Seed {
    /// The smaller end of an edge, or the smallest corner of a triangle that is split at its centre.
    pub(crate) v: VertexId,
    /// The slot of the edge, or the one that the triangle is behind.
    pub(crate) slot: usize,
    /// Whether it is the triangle.
    pub(crate) is_face: bool,
}

/// The memory of a plan, kept from step to step.
#[derive(Default)]
pub(crate) struct Lists {
    new: Vec<New>,
    touched: Vec<VertexId>,
    /// For every touched vertex where its cells start.
    starts: Vec<usize>,
    cells: Vec<Cell>,
    /// For every touched vertex the generation that all triangles at it must have.
    least: Vec<u8>,
    /// Triangles that have to be split, each by a corner and a slot of it.
    due: Vec<(VertexId, usize)>,
}

/// What a step will do, with the mesh before it.
pub(crate) struct Plan<'a> {
    rotation: &'a RotationSystem,
    generations: Generations<'a>,
    /// The place of a vertex among those that are touched.
    marks: Marks<'a>,
    hubs: Hubs,
    lists: Box<Lists>,
    /// How many vertices take part because the region names them.
    region: usize,
    added_faces: usize,
    is_too_deep: bool,
}

impl<'a> Plan<'a> {
    /// Finds what has to be split. O(triangles that are split and the rings of their corners).
    pub(crate) fn new(
        rotation: &'a RotationSystem,
        generations: Generations<'a>,
        region: &Region,
        scratch: &'a mut Scratch,
    ) -> Result<Self, RefineError> {
        let vertices = region.vertices(rotation.vertex_count());
        let hubs = Hubs::among(rotation, vertices.iter().copied());
        let mut plan = Self { region: vertices.len(), ..Self::empty(rotation, generations, hubs, scratch) };
        for &v in &*vertices {
            plan.touch(v);
        }
        plan.split_inside(region);
        plan.close()
    }

    /// Plans to split what lies over what is split in a mesh below. There the rules hold already, so nothing is added to
    /// it. O(triangles that are split and the rings of their corners).
    pub(crate) fn over(
        rotation: &'a RotationSystem,
        generations: Generations<'a>,
        seeds: impl Iterator<Item = Seed> + Clone,
        scratch: &'a mut Scratch,
    ) -> Result<Self, RefineError> {
        let hubs = Hubs::among(rotation, seeds.clone().map(|seed| seed.v));
        let mut plan = Self::empty(rotation, generations, hubs, scratch);
        for Seed { v, slot, is_face } in seeds {
            if is_face {
                plan.split(v, slot);
            } else {
                plan.split_exactly(v, slot);
            }
        }
        plan.close()
    }

    fn empty(rotation: &'a RotationSystem, generations: Generations<'a>, hubs: Hubs, scratch: &'a mut Scratch) -> Self {
        let count = rotation.vertex_count();
        Self {
            rotation,
            generations,
            lists: scratch.take::<Lists>(),
            marks: scratch.marks(count, u32::try_from(count).unwrap_or(u32::MAX).max(1)),
            hubs,
            region: 0,
            added_faces: 0,
            is_too_deep: false,
        }
    }

    /// Adds what the rules ask for, and numbers the new vertices.
    fn close(mut self) -> Result<Self, RefineError> {
        while let Some((v, slot)) = self.lists.due.pop() {
            self.split(v, slot);
        }
        if self.is_too_deep {
            return Err(RefineError::TooDeep);
        }
        self.number();
        Ok(self)
    }

    /// The lists, to be used again.
    pub(crate) fn into_lists(mut self) -> Box<Lists> {
        let Lists { new, touched, starts, cells, least, due } = &mut *self.lists;
        new.clear();
        touched.clear();
        starts.clear();
        cells.clear();
        least.clear();
        due.clear();
        self.lists
    }

    /// How many vertices the region names.
    pub(crate) fn region(&self) -> usize {
        self.region
    }

    pub(crate) fn new_count(&self) -> usize {
        self.lists.new.len()
    }

    pub(crate) fn added_faces(&self) -> usize {
        self.added_faces
    }

    /// The vertices beside what is split, those of the region first.
    pub(crate) fn touched(&self) -> &[VertexId] {
        &self.lists.touched
    }

    /// The place of a vertex in [`Plan::touched`].
    #[inline]
    pub(crate) fn place_of(&self, v: VertexId) -> Option<usize> {
        if v.index() < self.first() { self.marks.get(v).map(|place| place as usize) } else { None }
    }

    /// The number of the first new vertex.
    #[inline]
    pub(crate) fn first(&self) -> usize {
        self.rotation.vertex_count()
    }

    /// The generation in which a new vertex is made; its triangles have the next.
    #[inline]
    pub(crate) fn generation(&self, k: usize) -> u8 {
        self.lists.new[k].generation
    }

    /// What a new vertex is made of.
    pub(crate) fn lineage(&self, k: usize) -> Lineage {
        match self.lists.new[k].place {
            Place::Edge { p, q, .. } => Lineage::Edge([p, q]),
            Place::Center { corners, .. } => Lineage::Face(corners),
        }
    }

    /// The edge of a new vertex with the corners opposite to it when it is split, some of which may be new themselves;
    /// `None` for a centre.
    pub(crate) fn parent(&self, k: usize) -> Option<Parent> {
        let [right, left] = self.sides(k)?;
        let Place::Edge { p, q, .. } = self.lists.new[k].place else { return None };
        Some(Parent { p, q, left: left.map(Side::apex), right: right.map(Side::apex) })
    }

    /// The birth level of an old or a new vertex.
    #[inline]
    pub(crate) fn level(&self, v: VertexId) -> u8 {
        match v.index().checked_sub(self.first()) {
            None => self.generations.level(v),
            Some(k) => self.lists.new[k].generation + 1,
        }
    }

    /// Whether an old vertex lies on a boundary.
    pub(crate) fn is_open(&self, v: VertexId) -> bool {
        self.rotation.is_boundary(v)
    }

    fn touch(&mut self, v: VertexId) -> usize {
        if let Some(place) = self.marks.get(v) {
            return place as usize;
        }
        let Lists { touched, starts, cells, least, .. } = &mut *self.lists;
        let place = touched.len();
        self.marks.set(v, place as u32);
        touched.push(v);
        starts.push(cells.len());
        least.push(0);
        cells.resize(cells.len() + self.rotation.valence(v), Cell { edge: NONE, opposite: NONE });
        place
    }

    /// Makes the triangles due of which all edges are of the region.
    fn split_inside(&mut self, region: &Region) {
        for k in 0..self.region {
            let v = self.lists.touched[k];
            for slot in 0..self.rotation.ring(v).face_count() {
                let [_, a, b] = self.face(v, slot);
                let inside = |w: VertexId| self.place_of(w).is_some_and(|place| place < self.region);
                let is_split = match region.kind() {
                    RegionKind::Stars(_) => unreachable!("only the split in four is made around vertices"),
                    RegionKind::Everything => true,
                    RegionKind::Induced(_) => inside(a) && inside(b),
                    RegionKind::Edges(edges) => {
                        [(v, a), (a, b), (b, v)].iter().all(|&(p, q)| edges.binary_search(&Edge::new(p, q)).is_ok())
                    }
                };
                if v < a && v < b && is_split {
                    self.split(v, slot);
                }
            }
        }
    }

    fn cell(&self, v: VertexId, slot: usize) -> Cell {
        let empty = Cell { edge: NONE, opposite: NONE };
        self.place_of(v).map_or(empty, |place| self.lists.cells[self.lists.starts[place] + slot])
    }

    fn cell_mut(&mut self, v: VertexId, slot: usize) -> &mut Cell {
        let place = self.touch(v);
        let start = self.lists.starts[place];
        &mut self.lists.cells[start + slot]
    }

    fn slot(&self, v: VertexId, neighbor: VertexId) -> usize {
        self.hubs.slot(self.rotation, v, neighbor).expect("rings are symmetric")
    }

    /// The corners of the triangle behind a slot.
    fn face(&self, v: VertexId, slot: usize) -> [VertexId; 3] {
        let ring = self.rotation.ring(v);
        [v, ring.neighbors()[slot], ring.behind(slot).expect("a face is no gap")]
    }

    /// Splits the triangle behind a slot, if it is not split yet.
    fn split(&mut self, v: VertexId, slot: usize) {
        let corners = self.face(v, slot);
        let generation = self.generations.of(corners);
        match self.generations.apex(corners) {
            Some(apex) => self.split_edge(corners[(apex + 1) % 3], corners[(apex + 2) % 3], generation),
            None => self.split_at_center(corners),
        }
    }

    /// Splits the edge at a slot: the refinement edge of a triangle beside it, or of a half of that one.
    fn split_exactly(&mut self, v: VertexId, slot: usize) {
        let ring = self.rotation.ring(v);
        let w = ring.neighbors()[slot];
        let [behind, ahead] = ring.corners_at(slot);
        let corner = behind.or(ahead).expect("an edge has a triangle");
        let is_half = self.generations.apex([v, w, corner]) != Some(2);
        let generation = self.generations.of([v, w, corner]).saturating_add(u8::from(is_half));
        self.split_edge(v, w, generation);
    }

    /// Notes a new vertex, and answers in which order it was met.
    fn meet(&mut self, generation: u8, place: Place) -> u32 {
        let met = self.lists.new.len() as u32;
        self.lists.new.push(New { met, generation, place });
        self.is_too_deep |= generation == u8::MAX;
        met
    }

    /// Splits the refinement edge of a triangle of this generation.
    fn split_edge(&mut self, v: VertexId, w: VertexId, generation: u8) {
        let (slot_in_v, slot_in_w) = (self.slot(v, w), self.slot(w, v));
        if self.cell(v, slot_in_v).edge != NONE {
            return;
        }
        let [from_v, from_w] = [slot_in_v, slot_in_w].map(|slot| slot as u32);
        let met = self.meet(
            generation,
            if self.generations.is_first(v, w) {
                Place::Edge { p: v, q: w, slot_in_p: from_v, slot_in_q: from_w }
            } else {
                Place::Edge { p: w, q: v, slot_in_p: from_w, slot_in_q: from_v }
            },
        );
        for (from, to, slot) in [(v, w, slot_in_v), (w, v, slot_in_w)] {
            self.cell_mut(from, slot).edge = met;
            self.raise(from, generation);
            let Some(corner) = self.rotation.ring(from).behind(slot) else { continue };
            self.added_faces += 1;
            if self.generations.apex([from, to, corner]) == Some(2) {
                let slot = self.slot(corner, from);
                self.cell_mut(corner, slot).opposite = met;
                self.raise(corner, generation);
            } else {
                self.lists.due.push((from, slot));
            }
        }
    }

    /// Splits an input triangle that is in no block.
    fn split_at_center(&mut self, mut corners: [VertexId; 3]) {
        while corners[0] > corners[1] || corners[0] > corners[2] {
            corners.rotate_left(1);
        }
        let [a, b, c] = corners;
        let slots = [self.slot(a, b), self.slot(b, c), self.slot(c, a)];
        if self.cell(a, slots[0]).opposite != NONE {
            return;
        }
        let met = self.meet(0, Place::Center { corners, slots: slots.map(|slot| slot as u32) });
        for (v, slot) in corners.into_iter().zip(slots) {
            self.cell_mut(v, slot).opposite = met;
        }
        self.added_faces += 2;
    }

    /// Makes all triangles at a vertex due that are below this generation.
    fn raise(&mut self, v: VertexId, generation: u8) {
        let place = self.touch(v);
        if self.lists.least[place] >= generation {
            return;
        }
        self.lists.least[place] = generation;
        for slot in 0..self.rotation.ring(v).face_count() {
            if self.generations.of(self.face(v, slot)) < generation {
                self.lists.due.push((v, slot));
            }
        }
    }

    /// Numbers the new vertices.
    fn number(&mut self) {
        let Lists { new, cells, .. } = &mut *self.lists;
        new.sort_unstable_by_key(New::order);
        let mut numbers = vec![0; new.len()];
        for (number, new) in (0..).zip(new.iter()) {
            numbers[new.met as usize] = number;
        }
        for met in cells.iter_mut().flat_map(|cell| [&mut cell.edge, &mut cell.opposite]).filter(|met| **met != NONE) {
            *met = numbers[*met as usize];
        }
    }

    fn id(&self, number: u32) -> Option<VertexId> {
        (number != NONE).then(|| VertexId::new(self.first() + number as usize))
    }

    /// What lies right and left of the edge of a new vertex, `None` for a gap; `None` for a centre.
    fn sides(&self, k: usize) -> Option<[Option<Side>; 2]> {
        let Place::Edge { p, q, slot_in_p, slot_in_q } = self.lists.new[k].place else { return None };
        let (slot_in_p, slot_in_q) = (slot_in_p as usize, slot_in_q as usize);
        Some([self.side((q, slot_in_q), (p, slot_in_p)), self.side((p, slot_in_p), (q, slot_in_q))])
    }

    /// What lies left of `v -> w`, each given with the slot of the other in its ring, from `w` on round to `v`.
    fn side(&self, (v, slot_in_v): (VertexId, usize), (w, slot_in_w): (VertexId, usize)) -> Option<Side> {
        let corner_in_v = self.rotation.ring(v).slot_after(slot_in_v)?;
        let corner_in_w = self.rotation.ring(w).slot_before(slot_in_w)?;
        let [at_v, at_w] = [self.cell(v, slot_in_v), self.cell(w, corner_in_w)];
        Some(match self.id(at_v.opposite).or_else(|| self.id(at_w.opposite)) {
            Some(split) => Side::Split(split),
            None => Side::Corner {
                before: self.id(at_w.edge),
                corner: self.rotation.neighbors(v)[corner_in_v],
                after: self.id(self.cell(v, corner_in_v).edge),
            },
        })
    }

    /// The ring of a new vertex after the step.
    pub(crate) fn new_ring(&self, k: usize) -> RingBuf {
        let mut neighbors = Entries { list: [VertexId::GAP; 8], len: 0 };
        let Some([right, left]) = self.sides(k) else { return self.ring_of_center(k) };
        let Place::Edge { p, q, .. } = self.lists.new[k].place else { return self.ring_of_center(k) };
        if let Some(right) = right {
            neighbors.push(p);
            neighbors.side(right);
        }
        neighbors.push(q);
        if let Some(left) = left {
            neighbors.side(left);
        }
        if right.is_none() {
            neighbors.push(p);
        }
        let list = &neighbors.list[..neighbors.len];
        if right.is_some() && left.is_some() { RingBuf::closed(list) } else { RingBuf::open(list) }
    }

    fn ring_of_center(&self, k: usize) -> RingBuf {
        let mut neighbors = Entries { list: [VertexId::GAP; 8], len: 0 };
        if let Place::Center { corners, slots } = self.lists.new[k].place {
            for (v, slot) in corners.into_iter().zip(slots) {
                neighbors.push(v);
                neighbors.extend(self.id(self.cell(v, slot as usize).edge));
            }
        }
        RingBuf::closed(&neighbors.list[..neighbors.len])
    }

    /// The ring of an old vertex after the step; `None` if it does not change.
    pub(crate) fn old_ring(&self, v: VertexId) -> Option<RingBuf> {
        if self.cells(v).iter().all(|cell| cell.edge == NONE && cell.opposite == NONE) {
            return None;
        }
        let neighbors: Vec<VertexId> = self.neighbors_after(v).collect();
        let is_open = self.rotation.ring(v).is_open();
        Some(if is_open { RingBuf::open(&neighbors) } else { RingBuf::closed(&neighbors) })
    }

    /// The neighbours of an old vertex after the step.
    pub(crate) fn neighbors_after(&self, v: VertexId) -> impl Iterator<Item = VertexId> {
        let cells = self.cells(v);
        self.rotation.ring(v).iter().enumerate().flat_map(move |(slot, w)| match cells.get(slot) {
            Some(cell) => [self.id(cell.edge).or(Some(w)), self.id(cell.opposite)].into_iter().flatten(),
            None => [Some(w), None].into_iter().flatten(),
        })
    }

    fn cells(&self, v: VertexId) -> &[Cell] {
        self.place_of(v).map_or(&[], |place| {
            let start = self.lists.starts[place];
            &self.lists.cells[start..start + self.rotation.valence(v)]
        })
    }

    /// The least generation of the triangles at an old vertex before the step, and how many of the following it
    /// reaches: it has reached one when all triangles at it have. `None` without a triangle.
    pub(crate) fn advance(&self, v: VertexId) -> Option<(u8, u8)> {
        let ring = self.rotation.ring(v);
        let generation_of = |slot| self.generations.of(self.face(v, slot));
        let generation = (0..ring.face_count()).map(generation_of).min()?;
        let cells = self.cells(v);
        let mut count = if cells.is_empty() { 0 } else { 2 };
        for (slot, cell) in cells.iter().enumerate().take(ring.face_count()) {
            let next = if slot + 1 < cells.len() { slot + 1 } else { 0 };
            let edges = [cell.edge, cells[next].edge].map(|edge| edge != NONE);
            let is_split = edges[0] || edges[1] || cell.opposite != NONE;
            let reached = match generation_of(slot) - generation {
                // Both halves of it at the vertex are split again if both edges are.
                0 => u8::from(is_split) + u8::from(edges[0] && edges[1]),
                ahead => ahead + u8::from(is_split),
            };
            count = count.min(reached);
        }
        Some((generation, count))
    }

    /// Whether all triangles that a new vertex makes are split again in this step.
    pub(crate) fn advances_new(&self, k: usize) -> bool {
        let is_full = |side: Side| matches!(side, Side::Corner { before: Some(_), after: Some(_), .. });
        match (self.sides(k), self.lists.new[k].place) {
            (Some(sides), _) => sides.into_iter().flatten().all(is_full),
            (None, Place::Center { corners, slots }) => {
                corners.into_iter().zip(slots).all(|(v, slot)| self.cell(v, slot as usize).edge != NONE)
            }
            (None, Place::Edge { .. }) => false,
        }
    }

    /// Writes the neighbours of a touched vertex across exterior edges in the mesh of a generation, in the order of the
    /// ring: those edges that no triangle of the generation has as its refinement edge.
    pub(crate) fn exterior(&self, v: VertexId, generation: u8, neighbors: &mut Vec<VertexId>) {
        neighbors.clear();
        let made = |number: u32| (number != NONE).then(|| self.lists.new[number as usize].generation);
        for (w, cell) in self.rotation.ring(v).iter().zip(self.cells(v)) {
            match made(cell.edge) {
                Some(made) if made < generation => neighbors.extend(self.id(cell.edge)),
                Some(made) if made == generation => {}
                _ if self.generations.level(w) <= generation => neighbors.push(w),
                _ => {}
            }
            if made(cell.opposite).is_some_and(|made| made < generation) {
                neighbors.extend(self.id(cell.opposite));
            }
        }
    }

    /// The neighbours of a touched vertex along the boundary after the split of a generation, if that is the split at
    /// which it moves: the one by which both edges have been split in this pair of generations. `None` off the boundary
    /// too.
    pub(crate) fn along_boundary(&self, v: VertexId, generation: u8) -> Option<[VertexId; 2]> {
        let cells = self.cells(v);
        if cells.is_empty() || !self.is_open(v) {
            return None;
        }
        let [first, .., last] = self.rotation.neighbors(v) else { return None };
        let ends = [(*first, cells[0]), (*last, cells[cells.len() - 1])].map(|(w, cell)| {
            let made = self.id(cell.edge).filter(|&x| self.level(x) <= generation + 1);
            made.unwrap_or(w)
        });
        let fresh = ends.iter().filter(|&&end| self.level(end) == generation + 1).count();
        // Both edges are split by the same generation, or one by an even one and the other by the odd one that follows.
        (fresh == 2 || (fresh == 1 && generation % 2 == 1)).then_some(ends)
    }
}

/// A short list of neighbours.
struct Entries {
    list: [VertexId; 8],
    len: usize,
}

impl Entries {
    fn push(&mut self, v: VertexId) {
        self.list[self.len] = v;
        self.len += 1;
    }

    fn extend(&mut self, v: Option<VertexId>) {
        if let Some(v) = v {
            self.push(v);
        }
    }

    fn side(&mut self, side: Side) {
        match side {
            Side::Corner { before, corner, after } => {
                self.extend(before);
                self.push(corner);
                self.extend(after);
            }
            Side::Split(v) => self.push(v),
        }
    }
}
