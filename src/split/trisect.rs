//! The split of √3: a new vertex in a triangle, and old edges turned.
//!
//! All that a step has to know of a triangle follows from the birth levels of its corners. A triangle in which two corners or
//! more have the greatest level L, or L = 0, is *even*: it is whole at level L. One with a single corner of level L > 0, its
//! *apex*, is *odd*: a part of a triangle of level L − 1 that was split, waiting for the triangle across its *mate*, the edge
//! opposite to the apex. When that is split too, the mate is turned, and both become even.
//!
//! * An even triangle is split around a new vertex of level L + 1 into three odd ones, whose mates are its edges.
//! * An odd one whose mate lies on a boundary has nothing to wait for: it is whole at level L. It is split by cutting the mate
//!   in three, with two new vertices of level L + 1, into two odd triangles with an even one between.
//! * Any other odd one *lags*. It is not split; the triangle across its mate is, see [`across_mate`].
//!
//! Along a boundary this is the rule of Kobbelt: edges are cut in three in every second step, and two steps make nine of a
//! triangle. Source: `[kobbelt2000]`, sections 4 and 5.
//!
//! Triangles may be split in any number and order; each ring is a function of what was split around it. The slot of a
//! neighbour whose edge is turned is taken by what comes after it, a new vertex comes directly after the neighbour that its
//! triangle follows; the point that cuts off a boundary edge takes the slot of its far end. The ring of a new vertex starts at
//! the oldest corner of its triangle (of three input vertices: the smallest id), at a boundary behind the gap. So no
//! order depends on an id given later, and equal surroundings have equal rings from the same start on.

use crate::error::RefineError;
use crate::id::{Triangle, VertexId};
use crate::rotation::{Hubs, RingBuf, RotationSystem};
use crate::step::{History, Lineage};

/// The birth levels of all vertices while a step is made.
#[derive(Debug)]
pub(crate) struct Levels<'a> {
    history: &'a History,
    first: usize,
    /// Of the vertices that the step made so far.
    new: Vec<u8>,
}

impl<'a> Levels<'a> {
    /// Before a step of a mesh with so many vertices; what the step makes is noted in the memory of a list.
    pub(crate) fn before(history: &'a History, vertex_count: usize, mut list: Vec<u8>) -> Self {
        list.clear();
        Self { history, first: vertex_count, new: list }
    }

    /// The list, for its memory.
    pub(crate) fn into_list(self) -> Vec<u8> {
        self.new
    }

    /// Adds the levels of what was split.
    pub(crate) fn push(&mut self, faces: &[Face]) {
        self.new.extend(faces.iter().flat_map(|face| face.made().map(|_| face.level)));
    }

    #[inline]
    pub(crate) fn of(&self, v: VertexId) -> u8 {
        match v.index().checked_sub(self.first) {
            Some(k) => self.new[k],
            None => self.history.level(v).unwrap_or(0),
        }
    }

    /// The state of a triangle.
    #[inline]
    pub(crate) fn state(&self, triangle: Triangle) -> State {
        let corners = triangle.corners();
        let levels = corners.map(|v| self.of(v));
        let level = levels[0].max(levels[1]).max(levels[2]);
        let greatest = levels.map(|of| of == level);
        match greatest.iter().position(|&is| is) {
            Some(tip) if level > 0 && greatest.iter().filter(|&&is| is).count() == 1 => {
                State::Odd { level, mate: [corners[(tip + 1) % 3], corners[(tip + 2) % 3]] }
            }
            _ => State::Even { level },
        }
    }
}

/// What the levels of its corners tell of a triangle.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum State {
    /// Whole at this level.
    Even { level: u8 },
    /// With an apex of this level left of the mate.
    Odd { level: u8, mate: [VertexId; 2] },
}

impl State {
    /// The greatest level of its corners.
    #[inline]
    pub(crate) fn level(self) -> u8 {
        match self {
            Self::Even { level } | Self::Odd { level, .. } => level,
        }
    }
}

/// The triangle that has to be split instead of one that lags; `None` if a triangle does not lag. O(1) if it is even, else
/// O(valence) of the end of its mate that has fewer neighbours.
#[inline]
pub(crate) fn across_mate(rotation: &RotationSystem, state: State) -> Option<Triangle> {
    match state {
        State::Even { .. } => None,
        State::Odd { mate: [a, b], .. } => {
            let right = if rotation.valence(a) < rotation.valence(b) {
                rotation.right_of(a, b)
            } else {
                rotation.left_of(b, a)
            };
            right.map(|c| Triangle::new(b, a, c))
        }
    }
}

/// How a triangle is split.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Cut {
    /// Around a vertex inside; the corners start with the oldest.
    Center,
    /// By two vertices on the edge between the first two corners, the first near the first; it lies on a boundary.
    Thirds,
}

/// A triangle that is split.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Face {
    pub(crate) corners: [VertexId; 3],
    /// The level of what is new in it.
    pub(crate) level: u8,
    /// The first vertex that is new in it.
    first: VertexId,
    cut: Cut,
    /// For the edge from each corner to the next, if it is turned, the vertex to which it leads from inside the face.
    turned: [Option<VertexId>; 3],
}

impl Face {
    /// What is new in it, with what it is made of.
    pub(crate) fn made(&self) -> impl Iterator<Item = (VertexId, Lineage)> + use<> {
        let [a, b, _] = self.corners;
        let [one, two] = match self.cut {
            Cut::Center => [Some((self.first, Lineage::Face(self.corners))), None],
            Cut::Thirds => {
                let [p, q] = self.thirds();
                [Some((p, Lineage::Third { near: a, far: b })), Some((q, Lineage::Third { near: b, far: a }))]
            }
        };
        one.into_iter().chain(two)
    }

    /// The two vertices that cut its boundary edge, from the first corner to the second; `None` if it is split around a
    /// vertex inside.
    pub(crate) fn cutting(&self) -> Option<[VertexId; 2]> {
        (self.cut == Cut::Thirds).then(|| self.thirds())
    }

    fn thirds(&self) -> [VertexId; 2] {
        [self.first, VertexId::new(self.first.index() + 1)]
    }

    /// The new vertex that faces the edge from a corner to the next; `None` for an edge that is cut.
    fn facing(&self, corner: usize) -> Option<VertexId> {
        match (self.cut, corner) {
            (Cut::Center, _) => Some(self.first),
            (Cut::Thirds, 0) => None,
            (Cut::Thirds, 1) => Some(self.thirds()[1]),
            (Cut::Thirds, _) => Some(self.thirds()[0]),
        }
    }
}

/// What comes into a ring directly after a slot.
#[derive(Clone, Copy, Debug)]
enum After {
    /// What is new in a face of the plan, of which the vertex is this corner.
    Corner { face: u32, corner: u8 },
    /// A vertex across the mate of an odd face that is not split.
    Mate(VertexId),
}

#[derive(Clone, Copy, Debug)]
struct Record {
    v: VertexId,
    slot: u32,
    after: After,
}

/// What a step splits, pass by pass: what is split at once. New vertices are numbered in the order of the faces.
#[derive(Debug, Default)]
pub(crate) struct Plan {
    /// Of all passes so far.
    faces: Vec<Face>,
    /// The first face of the last pass.
    pass: usize,
    /// How many vertices there are afterwards.
    pub(crate) vertex_count: usize,
    /// Ascending by vertex and slot.
    records: Vec<Record>,
    entries: Vec<VertexId>,
}

impl Plan {
    /// Forgets an earlier step.
    pub(crate) fn clear(&mut self) {
        self.faces.clear();
        self.pass = 0;
    }

    /// What the step splits so far.
    pub(crate) fn faces(&self) -> &[Face] {
        &self.faces
    }

    /// What the last pass splits.
    pub(crate) fn pass(&self) -> &[Face] {
        &self.faces[self.pass..]
    }

    /// The apexes of odd triangles, not split, across the mates of which the last pass splits.
    pub(crate) fn apexes(&self) -> impl Iterator<Item = VertexId> {
        self.records.iter().filter(|record| matches!(record.after, After::Mate(_))).map(|record| record.v)
    }

    /// Plans the next pass: to split these triangles, each of which is even, or odd with its mate on a boundary.
    /// O(n log n) in their number, as long as rings are short.
    pub(crate) fn next_pass(
        &mut self,
        rotation: &RotationSystem,
        levels: &Levels<'_>,
        triangles: impl Iterator<Item = Triangle>,
    ) -> Result<(), RefineError> {
        self.pass = self.faces.len();
        self.records.clear();
        self.vertex_count = rotation.vertex_count();
        for triangle in triangles {
            let (level, cut, corners) = match levels.state(triangle) {
                State::Odd { level, mate: [a, b] } => (level, Cut::Thirds, rotated(triangle, |v| v != a && v != b)),
                State::Even { level } => (level, Cut::Center, oldest_first(triangle, levels)),
            };
            let level = level.checked_add(1).ok_or(RefineError::TooDeep)?;
            let needed = self.vertex_count as u64 + 2;
            let first = VertexId::try_new(self.vertex_count).ok_or(RefineError::TooManyVertices { needed })?;
            self.vertex_count += if cut == Cut::Center { 1 } else { 2 };
            self.faces.push(Face { corners, level, first, cut, turned: [None; 3] });
        }
        self.find_slots(rotation, levels);
        Ok(())
    }

    fn find_slots(&mut self, rotation: &RotationSystem, levels: &Levels<'_>) {
        let hubs = Hubs::among(rotation, self.faces[self.pass..].iter().flat_map(|face| face.corners));
        let slot_of = |v, w| hubs.slot(rotation, v, w).expect("rings are symmetric");
        self.records.reserve(3 * (self.faces.len() - self.pass));
        for (k, face) in self.faces.iter().enumerate().skip(self.pass) {
            for corner in 0..3 {
                let (v, w) = (face.corners[corner], face.corners[(corner + 1) % 3]);
                let slot = slot_of(v, w);
                let after = After::Corner { face: k as u32, corner: corner as u8 };
                self.records.push(Record { v, slot: slot as u32, after });
                let odd = rotation.ring(v).ahead(slot).filter(|&apex| levels.of(apex) == face.level);
                if let Some((apex, x)) = odd.zip(face.facing(corner)) {
                    self.records.push(Record { v: apex, slot: slot_of(apex, w) as u32, after: After::Mate(x) });
                }
            }
        }
        self.records.sort_unstable_by_key(|record| (record.v, record.slot));
    }

    /// The old vertices around which every triangle is split, or both boundary edges cut in three, ascending: those that move
    /// if all that the masks read is of one level.
    pub(crate) fn moving<'a>(&'a self, rotation: &'a RotationSystem) -> impl Iterator<Item = VertexId> + 'a {
        let chunks = self.records.chunk_by(|one, other| one.v == other.v);
        chunks.filter(|records| self.is_split_around(rotation, records)).map(|records| records[0].v)
    }

    fn is_split_around(&self, rotation: &RotationSystem, records: &[Record]) -> bool {
        let ring = rotation.ring(records[0].v);
        if !ring.is_open() {
            return records.len() == ring.valence()
                && records.iter().all(|record| matches!(record.after, After::Corner { .. }));
        }
        let cuts = |record: &Record, at: usize, slot: usize| match record.after {
            After::Corner { face, corner } => {
                usize::from(corner) == at
                    && record.slot as usize == slot
                    && self.faces[face as usize].cut == Cut::Thirds
            }
            After::Mate(_) => false,
        };
        let [first, last] = [records.first(), records.last()];
        first.is_some_and(|record| cuts(record, 0, 0))
            && last.is_some_and(|record| cuts(record, 1, ring.face_count() - 1))
    }

    /// Splits as planned and answers the greatest valence of a vertex that has another ring now. `replaced` is told the old
    /// ring of each. O(valence) for each corner of what is split.
    pub(crate) fn apply(
        &mut self,
        rotation: &mut RotationSystem,
        levels: &Levels<'_>,
        mut replaced: impl FnMut(VertexId, RingBuf),
    ) -> usize {
        let Self { faces, pass, records, entries, .. } = self;
        let mut max_valence = 0;
        for records in records.chunk_by(|one, other| one.v == other.v) {
            let v = records[0].v;
            rewrite(rotation, levels, faces, records, entries);
            max_valence = max_valence.max(entries.len());
            let open = rotation.ring(v).is_open();
            let ring = if open { RingBuf::open(entries) } else { RingBuf::closed(entries) };
            replaced(v, rotation.replace_ring(v, ring));
        }
        let faces = &faces[*pass..];
        rotation.reserve(faces.len());
        for face in faces {
            let ([a, b, c], [ab, bc, ca]) = (face.corners, face.turned);
            let mut push = |open: bool, ring: &[Option<VertexId>]| {
                entries.clear();
                entries.extend(ring.iter().flatten());
                max_valence = max_valence.max(entries.len());
                rotation.push_ring(if open { RingBuf::open(entries) } else { RingBuf::closed(entries) });
            };
            let [a, b, c] = [a, b, c].map(Some);
            match face.cut {
                Cut::Center => push(false, &[a, ab, b, bc, c, ca]),
                Cut::Thirds => {
                    let [p, q] = face.thirds().map(Some);
                    push(true, &[q, c, ca, a]);
                    push(true, &[b, bc, c, p]);
                }
            }
        }
        max_valence
    }
}

/// Writes into `entries` the ring of a vertex after the split, and into the faces around it which of their edges are turned.
fn rewrite(
    rotation: &RotationSystem,
    levels: &Levels<'_>,
    faces: &mut [Face],
    records: &[Record],
    entries: &mut Vec<VertexId>,
) {
    let v = records[0].v;
    let ring = rotation.ring(v);
    let level = levels.of(v);
    entries.clear();
    let mut ahead = records.last().filter(|last| last.slot as usize + 1 == ring.valence()).map(|last| last.after);
    let mut records = records.iter().peekable();
    for (slot, w) in ring.iter().enumerate() {
        let behind = records.next_if(|record| record.slot as usize == slot).map(|record| record.after);
        // What faces the edge from the left and from the right if it is the mate of odd triangles then: with its level.
        let old = |apex: Option<VertexId>| {
            let apex = apex.map(|apex| (apex, levels.of(apex)));
            apex.filter(|&(_, of_apex)| of_apex > level && of_apex > levels.of(w))
        };
        let new = |face: u32, corner: usize| {
            let face = &faces[face as usize];
            face.facing(corner).map(|x| (x, face.level))
        };
        let left = match behind {
            Some(After::Corner { face, corner }) => new(face, corner.into()),
            _ => old(ring.behind(slot)),
        };
        let right = match ahead {
            Some(After::Corner { face, corner }) => new(face, (usize::from(corner) + 2) % 3),
            _ => old(ring.ahead(slot)),
        };
        let is_new = |after| matches!(after, Some(After::Corner { .. }));
        let turned = match (left, right) {
            (Some(left), Some(right)) => left.1 == right.1 && (is_new(behind) || is_new(ahead)),
            _ => false,
        };
        if turned {
            if let Some(After::Corner { face, corner }) = behind {
                faces[face as usize].turned[usize::from(corner)] = right.map(|(x, _)| x);
            }
        } else {
            let cut = match (behind, ahead) {
                (Some(After::Corner { face, corner: 0 }), _) => faces[face as usize].cutting().map(|[p, _]| p),
                (_, Some(After::Corner { face, corner: 1 })) => faces[face as usize].cutting().map(|[_, q]| q),
                _ => None,
            };
            entries.push(cut.unwrap_or(w));
        }
        match behind {
            Some(After::Corner { face, corner }) => {
                let face = &faces[face as usize];
                match face.cut {
                    Cut::Center => entries.push(face.first),
                    Cut::Thirds if corner == 2 => entries.extend(face.thirds()),
                    Cut::Thirds => {}
                }
            }
            Some(After::Mate(x)) => entries.push(x),
            None => {}
        }
        ahead = behind;
    }
}

/// The corners of a triangle so that the one that passes the test comes last.
fn rotated(triangle: Triangle, is_last: impl Fn(VertexId) -> bool) -> [VertexId; 3] {
    let [a, b, c] = triangle.corners();
    match (is_last(a), is_last(b)) {
        (true, _) => [b, c, a],
        (_, true) => [c, a, b],
        _ => [a, b, c],
    }
}

/// The corners of a triangle from the oldest, or the smallest id of the oldest.
fn oldest_first(triangle: Triangle, levels: &Levels<'_>) -> [VertexId; 3] {
    let [a, b, c] = triangle.corners();
    let age = |v: VertexId| (levels.of(v), v);
    if age(a) < age(b) && age(a) < age(c) {
        [a, b, c]
    } else if age(b) < age(c) {
        [b, c, a]
    } else {
        [c, a, b]
    }
}
