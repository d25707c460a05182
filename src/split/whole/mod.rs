//! Splits of a whole mesh, for which no plan is kept.
//!
//! What a step makes, on edges or in triangles, is *owned* by one vertex beside it, and numbered in order of (owner, slot in
//! its ring). So every new ring, and what a new vertex is made of, is a function of the old mesh and a number: they are made
//! in any order and written once, beside the old ones.
//!
//! There is one file for each kind of split; here is what they share.

pub(crate) mod bisect;
pub(crate) mod quadrisect;
pub(crate) mod trisect;

use std::collections::HashMap;
use std::ops::Range;
use std::slice::IterMut;

use crate::id::VertexId;
use crate::parallel;
use crate::rotation::{Hubs, RingBuf, RotationSystem, Slots};

/// So many old vertices are taken at a time; what is made of them stays in the nearest cache.
const PART: usize = 1 << 8;

/// So many old vertices make a block.
const BLOCK: usize = 1 << 16;

/// The split of a whole mesh, as far as positions ask for it.
pub(crate) trait WholeSplit: Sync {
    /// What a new vertex is made of.
    type Made;

    /// The numbers of the new vertices.
    fn numbers(&self) -> &Numbers;

    /// Takes what each new vertex is made of that belongs to an old one, in order.
    fn each_new(&self, v: VertexId, take: impl FnMut(Self::Made));

    /// Appends the new vertices between an old one, to which they belong, and others that pass a test, in order.
    fn append_between(&self, v: VertexId, inside: impl Fn(VertexId) -> bool, list: &mut Vec<VertexId>);

    /// Appends what is made of each new vertex that belongs to one of the vertices, in order.
    fn append_new<T: Default + Send + Sync>(
        &self,
        vertices: Range<usize>,
        list: &mut Vec<T>,
        make: impl Fn(Self::Made) -> T + Sync,
    ) {
        parallel::append_parts(list, self.numbers().lengths(vertices.clone()), T::default, |_, part, new| {
            let mut new = new.iter_mut();
            for v in piece(vertices.clone(), PART, part) {
                self.each_new(VertexId::new(v), |made| *new.next().expect("there is one for each number") = make(made));
            }
        });
    }
}

/// The numbers of what the vertices of a mesh own.
pub(crate) struct Numbers {
    /// For each vertex, and behind them the number of all as the first of one more.
    own: Vec<Own>,
    hubs: Hubs,
    /// Of vertices with long rings, how much each owns before a slot.
    long: HashMap<VertexId, Vec<u32>>,
}

/// What a vertex owns: it has consecutive numbers.
#[derive(Clone, Copy, Default)]
struct Own {
    /// The first of them; as long as they are counted, how many there are.
    first: u32,
    /// The slots of a short ring at which something is owned.
    slots: Slots,
    /// Slots that are told apart, if a kind of split asks for it.
    told: Slots,
}

impl Numbers {
    /// Numbers what vertices own. `owned_from(v)` answers with what tells it of `v` and of the vertices behind, ascending;
    /// `owned_at` how much a vertex owns at a slot of its ring. O(edges), and 8 bytes a vertex.
    fn new<O: FnMut(VertexId) -> Own>(
        rotation: &RotationSystem,
        owned_from: impl Fn(VertexId) -> O + Sync,
        owned_at: impl Fn(VertexId, usize) -> u32,
    ) -> Self {
        let vertices = rotation.vertex_count();
        let mut own = Vec::with_capacity(vertices + 1);
        parallel::append_parts(&mut own, parts(0..vertices).map(|part| part.len()), Own::default, |_, part, own| {
            let mut owned_by = owned_from(VertexId::new(part * PART));
            for (v, own) in (part * PART..).map(VertexId::new).zip(own) {
                *own = owned_by(v);
            }
        });
        own.push(Own::default());
        let mut count = 0;
        for own in &mut own {
            count += std::mem::replace(&mut own.first, count);
        }
        let hubs = parallel::gather(0..vertices, |v| {
            let v = VertexId::new(v);
            Hubs::is_long(rotation, v).then_some(v)
        });
        let before_slots = |v: VertexId| {
            let owned = (0..rotation.valence(v)).scan(0, |count, slot| {
                let before = *count;
                *count += owned_at(v, slot);
                Some(before)
            });
            (v, owned.collect())
        };
        Self { own, long: hubs.iter().copied().map(before_slots).collect(), hubs: Hubs::among(rotation, hubs) }
    }

    /// How much there is in all.
    pub(crate) fn count(&self) -> usize {
        self.own[self.own.len() - 1].first as usize
    }

    /// Very long rings.
    pub(crate) fn hubs(&self) -> &Hubs {
        &self.hubs
    }

    /// All vertices in pieces, after each of which a caller can be asked whether to go on.
    pub(crate) fn blocks(&self) -> impl Iterator<Item = Range<usize>> + use<> {
        pieces(0..self.own.len() - 1, BLOCK)
    }

    /// Those of the pieces that own something.
    pub(crate) fn owning_blocks(&self) -> impl Iterator<Item = Range<usize>> {
        self.blocks().filter(|block| self.own[block.start].first < self.own[block.end].first)
    }

    #[inline]
    fn of(&self, v: VertexId) -> Own {
        self.own[v.index()]
    }

    /// The numbers of what a vertex owns.
    #[inline]
    fn range(&self, v: VertexId) -> Range<u32> {
        self.own[v.index()].first..self.own[v.index() + 1].first
    }

    /// How much a vertex owns before a slot of its ring, by counting; `owned_at` as in [`Numbers::new`].
    fn counted(&self, v: VertexId, slot: usize, owned_at: impl Fn(VertexId, usize) -> u32) -> u32 {
        match self.long.get(&v) {
            Some(before) => before[slot],
            None => (0..slot).map(|slot| owned_at(v, slot)).sum(),
        }
    }

    /// The new vertex with a number.
    #[inline]
    fn vertex(&self, number: u32) -> VertexId {
        VertexId::from_raw((self.own.len() - 1) as u32 + number)
    }

    /// How much belongs to the vertices of each part of a range.
    fn lengths(&self, vertices: Range<usize>) -> impl Iterator<Item = usize> {
        parts(vertices).map(|part| (self.own[part.end].first - self.own[part.start].first) as usize)
    }

    /// The rings after the split, those of the old vertices first: `even` writes that of one, `odd` those that one owns, in
    /// order, with help of the even ones. O(edges).
    fn rings(
        &self,
        even: impl Fn(VertexId, &mut RingBuf) + Sync,
        odd: impl Fn(VertexId, &[RingBuf], &mut IterMut<'_, RingBuf>) + Sync,
    ) -> Vec<RingBuf> {
        let vertices = 0..self.own.len() - 1;
        let mut rings = Vec::with_capacity(vertices.len() + self.count());
        let blank = || RingBuf::regular([VertexId::new(0); 6]);
        parallel::append_parts(&mut rings, parts(vertices.clone()).map(|part| part.len()), blank, |_, part, rings| {
            for (v, ring) in (part * PART..).map(VertexId::new).zip(rings) {
                even(v, ring);
            }
        });
        parallel::append_parts(&mut rings, self.lengths(vertices.clone()), blank, |evens, part, rings| {
            let mut rings = rings.iter_mut();
            for v in piece(vertices.clone(), PART, part) {
                odd(VertexId::new(v), evens, &mut rings);
            }
        });
        rings
    }
}

/// A range cut into pieces of a given length; the last may be shorter.
fn pieces(range: Range<usize>, length: usize) -> impl Iterator<Item = Range<usize>> {
    (0..range.len().div_ceil(length)).map(move |k| piece(range.clone(), length, k))
}

fn piece(range: Range<usize>, length: usize, k: usize) -> Range<usize> {
    let start = range.start + k * length;
    start..range.end.min(start + length)
}

fn parts(vertices: Range<usize>) -> impl Iterator<Item = Range<usize>> {
    pieces(vertices, PART)
}
