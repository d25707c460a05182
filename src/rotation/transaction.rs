//! Raw edits of single rings, which take effect together or not at all.
//!
//! An edit such as "insert x after a in the ring of v" breaks the symmetry of the rings until its counterpart is made, so
//! raw edits exist only here. They work on copies of the rings they touch; [`Transaction::commit`] judges these and puts
//! them in place, and a transaction that is dropped, or even forgotten, has changed nothing.
//!
//! The names of the edits are those of the vv language. Source: `[smith2003]`.
//!
//! **Deliberately not here**: edits that keep the rings whole by themselves; they are methods of
//! [`RotationSystem`] and cheaper.

use std::collections::BTreeMap;
use std::fmt;

use super::validate::{Sides, sides, valence_defect};
use super::{Ring, RingBuf, RotationSystem};
use crate::error::{EditError, RingDefect};
use crate::id::{DirectedEdge, VertexId};

/// Raw edits under way; made by [`RotationSystem::transaction`].
///
/// Every edit is judged by itself at once: the vertices exist, and a ring holds a neighbour once and never its own
/// vertex. An edit that is refused changes nothing, and the transaction goes on without it. Whether the rings fit
/// together is judged by [`Transaction::commit`].
///
/// Rings keep their start: a new neighbour never comes before slot 0 of a closed ring.
///
/// Every edit is O(valence + log n) for n rings touched so far; only those are copied.
///
/// ```
/// use vvmesh::RotationSystem;
/// let mut system = RotationSystem::new();
/// let mut transaction = system.transaction();
/// let a = transaction.add_vertex()?;
/// let b = transaction.add_vertex()?;
/// let c = transaction.add_vertex()?;
/// for (v, neighbors) in [(a, [b, c]), (b, [c, a]), (c, [a, b])] {
///     transaction.make(v, &neighbors)?;
///     transaction.open_gap(v, neighbors[1])?;
/// }
/// transaction.commit_triangles()?;
/// assert_eq!((system.edge_count(), system.triangle_count()), (3, 1));
/// # Ok::<(), vvmesh::error::EditError>(())
/// ```
#[must_use = "a transaction that is not committed changes nothing"]
pub struct Transaction<'a> {
    system: &'a mut RotationSystem,
    /// The rings touched, as they are to be; every new vertex is among them.
    staged: BTreeMap<VertexId, RingBuf>,
    vertex_count: usize,
}

impl RotationSystem {
    /// Starts raw edits.
    pub fn transaction(&mut self) -> Transaction<'_> {
        let vertex_count = self.vertex_count();
        Transaction { system: self, staged: BTreeMap::new(), vertex_count }
    }

    /// Adds an isolated vertex, named by the number of vertices there were.
    ///
    /// # Errors
    /// [`EditError::TooManyVertices`] if 32-bit ids name no more.
    pub fn add_vertex(&mut self) -> Result<VertexId, EditError> {
        let v = id_of_next(self.vertex_count())?;
        self.push_ring(RingBuf::default());
        Ok(v)
    }
}

/// The id of a vertex added to so many.
pub(super) fn id_of_next(vertex_count: usize) -> Result<VertexId, EditError> {
    VertexId::try_new(vertex_count).ok_or(EditError::TooManyVertices)
}

impl Transaction<'_> {
    /// How many vertices there are, new ones too.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.vertex_count
    }

    /// Whether the vertex exists.
    #[must_use]
    pub fn contains(&self, v: VertexId) -> bool {
        v.index() < self.vertex_count
    }

    /// The ring of a vertex as the edits so far have left it.
    ///
    /// # Panics
    /// If there is no such vertex.
    #[must_use]
    pub fn ring(&self, v: VertexId) -> Ring<'_> {
        self.staged.get(&v).map_or_else(|| self.system.ring(v), RingBuf::as_ring)
    }

    /// Adds an isolated vertex.
    ///
    /// # Errors
    /// [`EditError::TooManyVertices`] if 32-bit ids name no more.
    pub fn add_vertex(&mut self) -> Result<VertexId, EditError> {
        let v = id_of_next(self.vertex_count)?;
        self.staged.insert(v, RingBuf::default());
        self.vertex_count += 1;
        Ok(v)
    }

    /// Gives a vertex a new ring, closed and starting with the first of these neighbours; the old one is forgotten.
    ///
    /// O(n log n) for n neighbours.
    ///
    /// # Errors
    /// [`EditError::NoVertex`], [`EditError::SelfNeighbor`], and [`EditError::AlreadyNeighbor`] if one comes twice.
    pub fn make(&mut self, v: VertexId, neighbors: &[VertexId]) -> Result<(), EditError> {
        self.require(v)?;
        for &neighbor in neighbors {
            self.require_other(v, neighbor)?;
        }
        let mut sorted = neighbors.to_vec();
        sorted.sort_unstable();
        if let Some(two) = sorted.windows(2).find(|two| two[0] == two[1]) {
            return Err(EditError::AlreadyNeighbor { v, neighbor: two[0] });
        }
        self.staged.insert(v, RingBuf::closed(neighbors));
        Ok(())
    }

    /// Inserts `x` into the ring of `v` right after `a`. Behind the last neighbour of an open ring `x` becomes the last.
    ///
    /// # Errors
    /// [`EditError::NoVertex`], [`EditError::SelfNeighbor`], [`EditError::NotNeighbor`] for `a`,
    /// [`EditError::AlreadyNeighbor`] for `x`.
    pub fn splice_after(&mut self, v: VertexId, a: VertexId, x: VertexId) -> Result<(), EditError> {
        let slot = self.place_for(v, a, x)?;
        self.stage(v).insert(slot + 1, x);
        Ok(())
    }

    /// Inserts `x` into the ring of `v` right before `a`. Before the first neighbour of an open ring `x` becomes the
    /// first; in a closed one it becomes the last, which is the same place.
    ///
    /// # Errors
    /// As [`Transaction::splice_after`].
    pub fn splice_before(&mut self, v: VertexId, a: VertexId, x: VertexId) -> Result<(), EditError> {
        let slot = self.place_for(v, a, x)?;
        let ring = self.ring(v);
        let slot = if slot == 0 && !ring.is_open() { ring.valence() } else { slot };
        self.stage(v).insert(slot, x);
        Ok(())
    }

    /// Puts `x` in the place of `a` in the ring of `v`.
    ///
    /// # Errors
    /// As [`Transaction::splice_after`].
    pub fn replace(&mut self, v: VertexId, a: VertexId, x: VertexId) -> Result<(), EditError> {
        let slot = self.place_for(v, a, x)?;
        self.stage(v).set(slot, x);
        Ok(())
    }

    /// Takes `a` out of the ring of `v`. A ring that loses its last neighbour loses its gap too.
    ///
    /// # Errors
    /// [`EditError::NoVertex`], and [`EditError::NotNeighbor`] for `a`.
    pub fn erase(&mut self, v: VertexId, a: VertexId) -> Result<(), EditError> {
        let slot = self.slot_of(v, a)?;
        let ring = self.stage(v);
        if ring.as_ring().valence() == 1 {
            *ring = RingBuf::default();
        } else {
            ring.remove(slot);
        }
        Ok(())
    }

    /// Opens a gap in the ring of `v` right after `a`, which becomes the last neighbour; the one behind it becomes the
    /// first.
    ///
    /// # Errors
    /// [`EditError::NoVertex`], [`EditError::NotNeighbor`] for `a`, and [`EditError::SecondGap`] if the ring is open.
    pub fn open_gap(&mut self, v: VertexId, a: VertexId) -> Result<(), EditError> {
        let slot = self.slot_of(v, a)?;
        let ring = self.ring(v);
        if ring.is_open() {
            return Err(EditError::SecondGap(v));
        }
        let (until, behind) = ring.neighbors().split_at(slot + 1);
        let ring = RingBuf::open(&[behind, until].concat());
        self.staged.insert(v, ring);
        Ok(())
    }

    /// Closes the gap in the ring of `v`; its start stays.
    ///
    /// # Errors
    /// [`EditError::NoVertex`], and [`EditError::NoGap`] if the ring is closed.
    pub fn close_gap(&mut self, v: VertexId) -> Result<(), EditError> {
        self.require(v)?;
        let ring = self.ring(v);
        if !ring.is_open() {
            return Err(EditError::NoGap(v));
        }
        let ring = RingBuf::closed(ring.neighbors());
        self.staged.insert(v, ring);
        Ok(())
    }

    /// Puts the rings in place if the system is one afterwards (rules I1 to I3 of [`RotationSystem::validate`]).
    ///
    /// O(n log n) for n entries of the rings touched, before and after.
    ///
    /// # Errors
    /// [`EditError::Defects`] with every defect; nothing has changed then.
    pub fn commit(self) -> Result<(), EditError> {
        self.commit_checked(false)
    }

    /// Puts the rings in place if the system is one of triangles afterwards (rules I1 to I5 of
    /// [`RotationSystem::validate_triangles`]), provided that it was one before.
    ///
    /// Corners are judged where a ring was touched. O(n log n) for n entries of the rings touched, before and after; if
    /// there were other faces than triangles before, O(valence) more for each new corner.
    ///
    /// # Errors
    /// [`EditError::Defects`] with every defect; nothing has changed then.
    pub fn commit_triangles(self) -> Result<(), EditError> {
        self.commit_checked(true)
    }

    fn commit_checked(self, triangles: bool) -> Result<(), EditError> {
        let mut defects = Vec::new();
        let touched = Touched::new(&self);
        touched.find_edge_defects(&mut defects);
        if triangles {
            touched.find_triangle_defects(&mut defects);
        }
        if !defects.is_empty() {
            defects.sort_unstable();
            return Err(EditError::Defects(defects));
        }
        let Self { system, staged, vertex_count } = self;
        system.rings.resize(vertex_count, RingBuf::default());
        for (v, ring) in staged {
            system.set_ring(v, ring);
        }
        Ok(())
    }

    fn require(&self, v: VertexId) -> Result<(), EditError> {
        if self.contains(v) { Ok(()) } else { Err(EditError::NoVertex(v)) }
    }

    fn require_other(&self, v: VertexId, neighbor: VertexId) -> Result<(), EditError> {
        self.require(neighbor)?;
        if neighbor == v { Err(EditError::SelfNeighbor(v)) } else { Ok(()) }
    }

    fn slot_of(&self, v: VertexId, a: VertexId) -> Result<usize, EditError> {
        self.require(v)?;
        self.ring(v).slot_of(a).ok_or(EditError::NotNeighbor { v, neighbor: a })
    }

    /// The slot of `a`, provided that `x` may come into the ring.
    fn place_for(&self, v: VertexId, a: VertexId, x: VertexId) -> Result<usize, EditError> {
        let slot = self.slot_of(v, a)?;
        self.require_other(v, x)?;
        if self.ring(v).contains(x) { Err(EditError::AlreadyNeighbor { v, neighbor: x }) } else { Ok(slot) }
    }

    fn stage(&mut self, v: VertexId) -> &mut RingBuf {
        self.staged.entry(v).or_insert_with(|| RingBuf::from_ring(self.system.ring(v)))
    }
}

impl fmt::Debug for Transaction<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_map().entries(self.staged.iter().map(|(v, ring)| (v, ring.as_ring()))).finish()
    }
}

/// The directed edges that leave the vertices touched, before and after, by (from, to).
///
/// A ring that was not touched agreed with all its neighbours before. So it agrees with a touched neighbour afterwards
/// if and only if what that one says of their edge is the same as before, and need not be read: the cost is that of the
/// touched rings, whatever the valences beside them.
struct Touched<'t> {
    transaction: &'t Transaction<'t>,
    before: Vec<Entry>,
    after: Vec<Entry>,
}

struct Entry {
    edge: DirectedEdge,
    slot: usize,
    gaps: Sides,
}

impl<'t> Touched<'t> {
    fn new(transaction: &'t Transaction<'t>) -> Self {
        let mut before = Vec::new();
        let mut after = Vec::new();
        for (&v, ring) in &transaction.staged {
            if transaction.system.contains(v) {
                push_entries(&mut before, v, transaction.system.ring(v));
            }
            push_entries(&mut after, v, ring.as_ring());
        }
        Self { transaction, before, after }
    }

    /// Rules I2 and I3; every edit keeps I1.
    fn find_edge_defects(&self, defects: &mut Vec<RingDefect>) {
        for Entry { edge, gaps, .. } in &self.after {
            let one_sided = RingDefect::OneSided { v: edge.from, neighbor: edge.to };
            if self.is_touched(edge.to) {
                // The right side is compared when the reversed edge has its turn.
                match find(&self.after, edge.reversed()) {
                    None => defects.push(one_sided),
                    Some(back) if back.gaps.right != gaps.left => defects.push(RingDefect::Gap { edge: *edge }),
                    Some(_) => {}
                }
                continue;
            }
            let Some(was) = find(&self.before, *edge) else {
                defects.push(one_sided);
                continue;
            };
            if was.gaps.left != gaps.left {
                defects.push(RingDefect::Gap { edge: *edge });
            }
            if was.gaps.right != gaps.right {
                defects.push(RingDefect::Gap { edge: edge.reversed() });
            }
        }
        for Entry { edge, .. } in &self.before {
            if !self.is_touched(edge.to) && find(&self.after, *edge).is_none() {
                defects.push(RingDefect::OneSided { v: edge.to, neighbor: edge.from });
            }
        }
    }

    /// Rules I4 and I5.
    fn find_triangle_defects(&self, defects: &mut Vec<RingDefect>) {
        for (&v, ring) in &self.transaction.staged {
            let ring = ring.as_ring();
            defects.extend(valence_defect(v, ring));
            for (a, b) in ring.pairs() {
                let stood = find(&self.before, DirectedEdge::new(v, a))
                    .is_some_and(|was| self.transaction.system.ring(v).behind(was.slot) == Some(b));
                // Not judged: a corner as it was, in a ring as it was, and an edge in one ring only, which is told already.
                let back_at = |w: VertexId| match self.is_touched(w) {
                    true => find(&self.after, DirectedEdge::new(w, v)).map(|back| back.slot),
                    false if stood => None,
                    false => self.transaction.ring(w).slot_of(v),
                };
                let breaks_at_a = back_at(a).is_some_and(|slot| self.transaction.ring(a).ahead(slot) != Some(b));
                let breaks_at_b = back_at(b).is_some_and(|slot| self.transaction.ring(b).behind(slot) != Some(a));
                if breaks_at_a || breaks_at_b {
                    defects.push(RingDefect::NotTriangle { v, a, b });
                }
            }
        }
    }

    fn is_touched(&self, v: VertexId) -> bool {
        self.transaction.staged.contains_key(&v)
    }
}

/// Appends the edges that leave a vertex, by their end.
fn push_entries(entries: &mut Vec<Entry>, from: VertexId, ring: Ring<'_>) {
    let first = entries.len();
    entries.extend(ring.iter().enumerate().map(|(slot, to)| Entry {
        edge: DirectedEdge::new(from, to),
        slot,
        gaps: sides(ring, slot),
    }));
    entries[first..].sort_unstable_by_key(|entry| entry.edge.to);
}

fn find(entries: &[Entry], edge: DirectedEdge) -> Option<&Entry> {
    entries.binary_search_by_key(&edge, |entry| entry.edge).ok().map(|k| &entries[k])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn ids_end_at_the_limit_with_an_error() {
        assert_eq!(id_of_next(VertexId::MAX_INDEX), Ok(VertexId::new(VertexId::MAX_INDEX)));
        assert_eq!(id_of_next(VertexId::MAX_INDEX + 1), Err(EditError::TooManyVertices));
    }

    #[test]
    fn raw_edits_are_judged_one_by_one() {
        let mut system = shapes::octahedron().rotation().clone();
        let mut transaction = system.transaction();
        let v = VertexId::new(0);
        let [a, b, c, d] = transaction.ring(v).neighbors().try_into().unwrap();
        let x = transaction.add_vertex().unwrap();
        let outside = VertexId::new(99);
        let of = |neighbor| EditError::AlreadyNeighbor { v, neighbor };
        assert_eq!(transaction.splice_after(v, x, a), Err(EditError::NotNeighbor { v, neighbor: x }));
        assert_eq!(transaction.splice_after(v, a, c), Err(of(c)));
        assert_eq!(transaction.replace(v, a, v), Err(EditError::SelfNeighbor(v)));
        assert_eq!(transaction.make(v, &[a, b, a]), Err(of(a)));
        assert_eq!(transaction.make(v, &[a, outside]), Err(EditError::NoVertex(outside)));
        assert_eq!(transaction.close_gap(v), Err(EditError::NoGap(v)));
        assert_eq!(transaction.ring(v).neighbors(), [a, b, c, d]);
        transaction.splice_before(v, a, x).unwrap();
        assert_eq!(transaction.ring(v).neighbors(), [a, b, c, d, x]);
        transaction.open_gap(v, b).unwrap();
        assert_eq!(transaction.open_gap(v, b), Err(EditError::SecondGap(v)));
        assert_eq!(
            (transaction.ring(v).neighbors(), transaction.ring(v).is_open()),
            ([c, d, x, a, b].as_slice(), true)
        );
        transaction.erase(v, x).unwrap();
        transaction.splice_before(v, c, x).unwrap();
        assert_eq!(transaction.ring(v).neighbors(), [x, c, d, a, b]);
        for neighbor in [x, c, d, a, b] {
            transaction.erase(v, neighbor).unwrap();
        }
        assert_eq!((transaction.ring(v).valence(), transaction.ring(v).is_open()), (0, false));
    }

    #[test]
    fn a_commit_tells_every_defect_or_does_all() {
        let mut system = shapes::octahedron().rotation().clone();
        let before = format!("{system:?}");
        let v = VertexId::new(0);
        let [a, b, c, d] = system.neighbors(v).try_into().unwrap();

        let mut transaction = system.transaction();
        transaction.erase(v, a).unwrap();
        transaction.open_gap(v, d).unwrap();
        let defects = [
            RingDefect::OneSided { v: a, neighbor: v },
            RingDefect::Gap { edge: DirectedEdge::new(v, d) },
            RingDefect::Gap { edge: DirectedEdge::new(b, v) },
        ];
        let Err(EditError::Defects(found)) = transaction.commit() else { panic!("it must not be committed") };
        assert!(found.len() == 3 && defects.iter().all(|defect| found.contains(defect)), "{found:?}");
        assert_eq!(format!("{system:?}"), before);

        // Without one edge there is a quadrilateral: a rotation system, but not of triangles.
        let cut = |system: &mut RotationSystem, triangles: bool| {
            let mut transaction = system.transaction();
            transaction.erase(v, a).unwrap();
            transaction.erase(a, v).unwrap();
            if triangles { transaction.commit_triangles() } else { transaction.commit() }
        };
        let Err(EditError::Defects(found)) = cut(&mut system, true) else { panic!("it must not be committed") };
        assert!(found.contains(&RingDefect::NotTriangle { v, a: d, b }), "{found:?}");
        assert_eq!(format!("{system:?}"), before);
        assert_eq!(cut(&mut system, false), Ok(()));
        assert_eq!((system.edge_count(), system.face_count(), system.validate()), (11, 7, vec![]));
        assert_eq!(system.neighbors(v), [b, c, d]);

        // Back again: the corners beside the new edge are new, their outer rings untouched but read.
        let mut transaction = system.transaction();
        transaction.splice_after(v, d, a).unwrap();
        transaction.splice_after(a, b, v).unwrap();
        assert_eq!(transaction.commit_triangles(), Ok(()));
        assert_eq!(system.validate_triangles(), []);
    }

    #[test]
    fn a_commit_does_not_read_the_rings_beside_it() {
        // Every vertex of the rim is touched, the hub is not: its ring of 20000 is not searched 20000 times.
        let count = 20_000;
        let rim = |k: usize| VertexId::new(1 + k % count);
        let hub: Vec<VertexId> = (0..count).map(rim).collect();
        let mut system = RotationSystem::with_isolated(count + 1);
        let mut transaction = system.transaction();
        transaction.make(VertexId::new(0), &hub).unwrap();
        for k in 0..count {
            transaction.make(rim(k), &[rim(k + 1), VertexId::new(0), rim(k + count - 1)]).unwrap();
            transaction.open_gap(rim(k), rim(k + count - 1)).unwrap();
        }
        transaction.commit_triangles().unwrap();
        let mut transaction = system.transaction();
        for k in 0..count {
            transaction.close_gap(rim(k)).unwrap();
            transaction.open_gap(rim(k), rim(k + count - 1)).unwrap();
        }
        assert_eq!(transaction.commit_triangles(), Ok(()));
        assert_eq!(system.validate_triangles(), []);
    }
}
