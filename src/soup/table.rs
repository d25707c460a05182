//! The edges of a list of faces, each with the faces at it, and the fans of faces around each vertex.
//!
//! All is arrays that are filled by counting and sorted in short pieces, so it is fast, takes about 16 bytes a corner,
//! and has one order whatever the machine.

use super::FaceList;
use super::disjoint::DisjointSets;
use crate::id::{Edge, VertexId};

/// In place of the face of a corner whose face was left out. Zeros need not be written, so what is left out costs nothing.
const LEFT_OUT: u32 = 0;

/// The edges of some of the faces of a list, by their smaller end, then their larger.
///
/// An edge is a pair of different vertices that stand next to each other in a face. A *corner* is named by its place in
/// the corners of all faces.
#[derive(Debug)]
pub(crate) struct EdgeTable<'a> {
    list: &'a FaceList,
    /// One more than the face of each corner, or [`LEFT_OUT`].
    face_after: Vec<u32>,
    /// For every vertex where the uses of its edges to greater vertices start.
    starts: Vec<u32>,
    uses: Vec<Use>,
}

/// One face at an edge, by the corner at which it enters the edge.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
struct Use {
    greater: u32,
    corner: u32,
}

impl<'a> EdgeTable<'a> {
    /// The table of the faces for which `included` holds; all their corners must be in range.
    ///
    /// O(vertices + corners), and O(d log d) for the d greater neighbours of a vertex.
    pub(crate) fn new(list: &'a FaceList, included: &[bool]) -> Self {
        let mut face_after = vec![LEFT_OUT; list.corners.len()];
        let mut starts = vec![0_u32; list.vertex_count() + 1];
        for (k, corners) in list.corner_ranges().enumerate().filter(|&(k, _)| included[k]) {
            face_after[corners.clone()].fill(k as u32 + 1);
            for [a, b] in sides(&list.corners[corners]).filter(|[a, b]| a != b) {
                starts[a.min(b) as usize + 1] += 1;
            }
        }
        for v in 1..starts.len() {
            starts[v] += starts[v - 1];
        }
        let mut free = starts.clone();
        let mut uses = vec![Use { greater: 0, corner: 0 }; starts[starts.len() - 1] as usize];
        for (_, corners) in list.corner_ranges().enumerate().filter(|&(k, _)| included[k]) {
            for (corner, [a, b]) in corners.clone().zip(sides(&list.corners[corners])).filter(|(_, [a, b])| a != b) {
                let place = &mut free[a.min(b) as usize];
                uses[*place as usize] = Use { greater: a.max(b), corner: corner as u32 };
                *place += 1;
            }
        }
        for ends in starts.windows(2) {
            uses[ends[0] as usize..ends[1] as usize].sort_unstable();
        }
        Self { list, face_after, starts, uses }
    }

    /// All edges in their order.
    pub(crate) fn edges(&self) -> impl Iterator<Item = TableEdge<'_>> {
        (0..self.list.vertex_count() as u32).flat_map(move |smaller| {
            let same = |p: &Use, q: &Use| p.greater == q.greater;
            self.from(smaller).chunk_by(same).map(move |uses| TableEdge { table: self, smaller, uses })
        })
    }

    /// The edge between two vertices that exist, if there is one. O(log of the valence).
    pub(crate) fn edge(&self, a: u32, b: u32) -> Option<TableEdge<'_>> {
        let (smaller, greater) = (a.min(b), a.max(b));
        let from = self.from(smaller);
        let first = from.partition_point(|one| one.greater < greater);
        let end = from.partition_point(|one| one.greater <= greater);
        (first < end).then(|| TableEdge { table: self, smaller, uses: &from[first..end] })
    }

    /// The corners of all faces, each with its vertex and its face.
    pub(crate) fn corners(&self) -> impl Iterator<Item = (u32, u32, usize)> {
        let corners = self.list.corners.iter().zip(&self.face_after).enumerate();
        let included = corners.filter(|(_, (_, face_after))| **face_after != LEFT_OUT);
        included.map(|(k, (&v, &face_after))| (k as u32, v, face_after as usize - 1))
    }

    /// One more than the greatest face.
    pub(crate) fn face_limit(&self) -> usize {
        self.list.face_count()
    }

    fn from(&self, smaller: u32) -> &[Use] {
        &self.uses[self.starts[smaller as usize] as usize..self.starts[smaller as usize + 1] as usize]
    }

    /// The face of a corner that was not left out.
    fn face(&self, corner: u32) -> usize {
        self.face_after[corner as usize] as usize - 1
    }

    /// The corner behind a corner in its face.
    fn next(&self, corner: u32) -> u32 {
        let face = self.face(corner);
        if corner + 1 < self.list.ends[face] { corner + 1 } else { self.list.corner_range(face).start as u32 }
    }
}

/// An edge with the faces at it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TableEdge<'a> {
    table: &'a EdgeTable<'a>,
    smaller: u32,
    /// At least one.
    uses: &'a [Use],
}

impl<'a> TableEdge<'a> {
    /// Both ends, the smaller first.
    pub(crate) fn ends(self) -> [u32; 2] {
        [self.smaller, self.uses[0].greater]
    }

    /// The name of the edge.
    pub(crate) fn name(self) -> Edge {
        let [a, b] = self.ends().map(|v| VertexId::new(v as usize));
        Edge::new(a, b)
    }

    /// How many faces there are.
    pub(crate) fn face_count(self) -> usize {
        self.uses.len()
    }

    /// Whether there is one face.
    pub(crate) fn is_boundary(self) -> bool {
        self.uses.len() == 1
    }

    /// The faces, ascending.
    pub(crate) fn faces(self) -> impl ExactSizeIterator<Item = usize> + use<'a> {
        self.uses.iter().map(move |one| self.table.face(one.corner))
    }

    /// For every face whether it runs from the smaller end to the larger.
    pub(crate) fn directions(self) -> impl ExactSizeIterator<Item = bool> + use<'a> {
        self.uses.iter().map(move |one| self.table.list.corners[one.corner as usize] == self.smaller)
    }

    /// For every face its corners at the smaller end and at the larger.
    pub(crate) fn corners(self) -> impl ExactSizeIterator<Item = [u32; 2]> + use<'a> {
        self.uses.iter().zip(self.directions()).map(move |(one, ascends)| {
            let next = self.table.next(one.corner);
            if ascends { [one.corner, next] } else { [next, one.corner] }
        })
    }

    /// The corner of the first face at one of the ends.
    pub(crate) fn corner_at(self, end: u32) -> u32 {
        let corner = self.uses[0].corner;
        if self.table.list.corners[corner as usize] == end { corner } else { self.table.next(corner) }
    }
}

/// The fans of faces: two corners at a vertex belong to one fan if a chain of faces leads from one to the other, each
/// sharing an edge at the vertex with the one before.
#[derive(Clone, Debug)]
pub(crate) struct Fans {
    sets: DisjointSets,
}

impl Fans {
    /// The fans of the faces of a table.
    pub(crate) fn new(table: &EdgeTable<'_>) -> Self {
        let mut fans = Self { sets: DisjointSets::new(table.list.corners.len()) };
        for edge in table.edges().filter(|edge| !edge.is_boundary()) {
            let mut corners = edge.corners();
            let first = corners.next().expect("an edge has a face");
            for other in corners {
                fans.join(first[0], other[0]);
                fans.join(first[1], other[1]);
            }
        }
        fans
    }

    /// Makes one fan of those of two corners.
    pub(crate) fn join(&mut self, j: u32, k: u32) {
        self.sets.join(j, k);
    }

    /// The number of fans around each vertex.
    pub(crate) fn counts(&mut self, table: &EdgeTable<'_>) -> Vec<u32> {
        let mut counts = vec![0; table.list.vertex_count()];
        for (corner, v, _) in table.corners() {
            counts[v as usize] += u32::from(self.sets.find(corner) == corner);
        }
        counts
    }

    /// The number of boundary loops: chains of edges with one face, linked where they end in the same fan.
    ///
    /// This is their number after giving each fan a vertex of its own.
    pub(crate) fn boundary_loop_count(mut self, table: &EdgeTable<'_>) -> usize {
        let corners: Vec<[u32; 2]> =
            table.edges().filter(|edge| edge.is_boundary()).flat_map(TableEdge::corners).collect();
        for &[a, b] in &corners {
            self.join(a, b);
        }
        let mut loops: Vec<u32> = corners.iter().map(|&[a, _]| self.sets.find(a)).collect();
        loops.sort_unstable();
        loops.dedup();
        loops.len()
    }
}

/// The sides of a face from corner to next corner, in its order.
pub(super) fn sides(corners: &[u32]) -> impl Iterator<Item = [u32; 2]> {
    corners.iter().zip(corners.iter().cycle().skip(1)).map(|(&a, &b)| [a, b])
}
