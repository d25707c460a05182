//! The mesh that is shown: the leaves of a hierarchy, and how its cracks are closed.
//!
//! The ring of a vertex is a function of the hierarchy: its neighbours at the level of its birth, each brought nearer as often
//! as the edge to it is split, and between two of them, in a leaf with split edges, the vertex to which closing draws an edge.
//! So it does not matter in what order the hierarchy came to be what it is; rings have the start that they have in a uniform
//! mesh.

use super::Levels;
use crate::id::VertexId;
use crate::rotation::{RingBuf, RotationSystem};
use crate::scratch::Scratch;
use crate::step::{Birth, Hierarchy, Parent};

/// Writes the rings of all vertices that `changed` vertices, which were made or taken out, can reach; and tells how each that
/// is not taken out is shown. O(changed vertices, and the valences there).
pub(crate) fn show(
    rotation: &mut RotationSystem,
    hierarchy: &Hierarchy,
    changed: &[VertexId],
    scratch: &mut Scratch,
    mut tell: impl FnMut(VertexId, Shown),
) {
    for _ in rotation.vertex_count()..hierarchy.vertex_count() {
        rotation.push_ring(RingBuf::default());
    }
    let mut reached = scratch.take_list();
    let mut marks = scratch.marks(rotation.vertex_count(), 1);
    for &x in changed {
        if !is_split_by(hierarchy, x) {
            marks.set(x, 0);
            rotation.set_ring(x, RingBuf::default());
        }
    }
    for &x in changed {
        reach(hierarchy, x, |v| {
            if marks.insert(v) {
                reached.push(v);
            }
        });
    }
    for &v in &reached {
        let (ring, shown) = Shown::new(Levels::new(rotation, hierarchy), v);
        rotation.set_ring(v, ring);
        tell(v, shown);
    }
    scratch.give_list(reached);
}

/// Whether a vertex that was made splits its edge still.
fn is_split_by(hierarchy: &Hierarchy, x: VertexId) -> bool {
    hierarchy.birth(x).is_some_and(|birth| hierarchy.odd(birth.parent.p, birth.parent.q) == Some(x))
}

/// Goes through the vertices that are shown otherwise if a vertex splits its edge or not; to some more than once.
fn reach(hierarchy: &Hierarchy, x: VertexId, mut visit: impl FnMut(VertexId)) {
    let Some(&Birth { parent: Parent { p, q, left, right }, .. }) = hierarchy.birth(x) else { return };
    [x, p, q].into_iter().for_each(&mut visit);
    for corner in [left, right].into_iter().flatten() {
        visit(corner);
        [p, q].into_iter().filter_map(|end| hierarchy.odd(end, corner)).for_each(&mut visit);
    }
}

/// How a vertex is shown, beside its ring.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Shown {
    /// The greatest level at which its star is complete; if it is at none, that of its birth.
    pub(crate) star_level: u8,
    /// The greatest level of a leaf with this corner.
    pub(crate) leaf_level: u8,
    /// How many of its edges close cracks.
    pub(crate) closing: usize,
    /// Whether it lies on an edge of a triangle that is not split.
    pub(crate) hangs: bool,
}

impl Shown {
    /// The ring of a vertex, and how it is shown beside that. O(valence · levels).
    pub(crate) fn new(levels: Levels<'_>, v: VertexId) -> (RingBuf, Self) {
        let birth_level = levels.hierarchy().level(v);
        let (mut least, mut greatest) = (None, birth_level);
        let take_leaf = |leaf| {
            let level = levels.hierarchy().level_of(leaf);
            least = Some(least.map_or(level, |least: u8| least.min(level)));
            // Of a leaf that it hangs on it is no corner, but that is older.
            greatest = greatest.max(level);
        };
        let Entries { list, open, closing, hangs, .. } = Entries::of(levels, v, take_leaf);
        let star_level = birth_level.max(least.unwrap_or(0));
        let shown = Self { star_level, leaf_level: greatest, closing, hangs };
        (RingBuf::collect(list.into_iter(), open), shown)
    }

    /// The level at which it stands. Where stars are asked for, that of its star; where triangles are, that of the finest at
    /// it, so that all of a triangle that was split is where uniform refinement has it.
    pub(crate) fn level(&self, asks_for_stars: bool) -> u8 {
        if asks_for_stars { self.star_level } else { self.leaf_level }
    }
}

/// The leaves with a corner at a vertex, counter-clockwise each from there. O(valence · levels).
pub(crate) fn leaves_around(levels: Levels<'_>, v: VertexId) -> Vec<[VertexId; 3]> {
    let mut leaves = Vec::new();
    Entries::of(levels, v, |leaf| leaves.push(leaf));
    leaves.retain(|leaf| leaf[0] == v);
    leaves
}

/// The neighbours of a vertex, counter-clockwise, as they are found.
struct Entries<'a, F> {
    levels: Levels<'a>,
    v: VertexId,
    list: Vec<VertexId>,
    open: bool,
    closing: usize,
    hangs: bool,
    /// Takes the leaves around the vertex, and those that it hangs on.
    take_leaf: F,
}

impl<'a, F: FnMut([VertexId; 3])> Entries<'a, F> {
    fn of(levels: Levels<'a>, v: VertexId, take_leaf: F) -> Self {
        let mut entries = Self { levels, v, list: Vec::new(), open: false, closing: 0, hangs: false, take_leaf };
        match levels.hierarchy().birth(v) {
            None => entries.list_input(),
            Some(birth) => entries.list_odd(birth.parent),
        }
        entries
    }

    fn odd(&self, a: VertexId, b: VertexId) -> Option<VertexId> {
        self.levels.hierarchy().odd(a, b)
    }

    /// Lists the neighbours of an input vertex.
    fn list_input(&mut self) {
        let input = self.levels.input_ring(self.v);
        let ring = input.as_ring();
        for (slot, w) in ring.iter().enumerate() {
            self.toward(w);
            if let Some(next) = ring.behind(slot) {
                self.between(w, next);
            }
        }
        self.open = ring.is_open();
    }

    /// Lists the neighbours of a vertex on an edge.
    fn list_odd(&mut self, Parent { p, q, left, right }: Parent) {
        if let Some(right) = right {
            self.toward(p);
            self.side([p, q], right);
        }
        self.toward(q);
        if let Some(left) = left {
            self.side([q, p], left);
        }
        if right.is_none() {
            self.toward(p);
        }
        self.open = left.is_none() || right.is_none();
    }

    /// Lists the neighbour in the direction of one that it has at some level.
    fn toward(&mut self, mut neighbor: VertexId) {
        while let Some(nearer) = self.odd(self.v, neighbor) {
            neighbor = nearer;
        }
        self.list.push(neighbor);
    }

    fn close(&mut self, neighbor: VertexId) {
        self.list.push(neighbor);
        self.closing += 1;
    }

    /// Lists what stands between two neighbours `a` and `b` that are corners of one triangle at some level.
    fn between(&mut self, mut a: VertexId, mut b: VertexId) {
        let v = self.v;
        loop {
            let [opposite, at_b, at_a] = self.levels.hierarchy().odds([v, a, b]);
            match (opposite, at_a, at_b) {
                (Some(_), Some(nearer_a), Some(nearer_b)) => {
                    (a, b) = (nearer_a, nearer_b);
                    continue;
                }
                (Some(opposite), None, None) => self.close(opposite),
                // A corner is cut off; of the edge that stays `v` is one end.
                (Some(opposite), Some(_), None) if self.starts_diagonal([b, v], a) => self.close(opposite),
                (Some(opposite), None, Some(_)) if self.starts_diagonal([v, a], b) => self.close(opposite),
                _ => {}
            }
            (self.take_leaf)([v, a, b]);
            return;
        }
    }

    /// Lists the neighbours between the ends `a` and `b` of the edge that the vertex splits, counter-clockwise, in the
    /// triangle `b, a, c`.
    fn side(&mut self, [a, b]: [VertexId; 2], c: VertexId) {
        match (self.odd(a, c), self.odd(b, c)) {
            (Some(at_a), Some(at_b)) => {
                self.between(a, at_a);
                self.toward(at_a);
                self.between(at_a, at_b);
                self.toward(at_b);
                self.between(at_b, b);
                return;
            }
            (None, None) => self.close(c),
            (Some(at_a), None) => {
                self.close(at_a);
                if self.diagonal_comes_from(c, [c, b], a) {
                    self.close(c);
                }
            }
            (None, Some(at_b)) => {
                if self.diagonal_comes_from(c, [a, c], b) {
                    self.close(c);
                }
                self.close(at_b);
            }
        }
        self.hangs = true;
        (self.take_leaf)([b, a, c]);
    }

    fn starts_diagonal(&self, edge: [VertexId; 2], cut: VertexId) -> bool {
        self.diagonal_comes_from(self.v, edge, cut)
    }

    /// Whether the diagonal of a leaf whose corner `cut` is cut off comes from this end of the edge that stays.
    ///
    /// It comes from the end that is read last. That is the younger one, which is of regular valence, and no valence that
    /// closing itself changes is asked for.
    fn diagonal_comes_from(&self, end: VertexId, [a, b]: [VertexId; 2], cut: VertexId) -> bool {
        let last = if self.levels.is_first([a, b], Some(cut), None) { b } else { a };
        last == end
    }
}
