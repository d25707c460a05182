//! Regular rings: six neighbours and no gap.
//!
//! Almost all rings of a refined mesh are like that. Their loops have a known end, so none is left when the program is
//! built, and nothing here branches on the place of a neighbour, which no pattern foretells.

use crate::id::VertexId;

/// The ring of a regular inner vertex.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) struct Regular<'a>(pub(crate) &'a [VertexId; 6]);

impl<'a> Regular<'a> {
    /// The neighbours in order, from the start of the ring.
    #[inline]
    pub(crate) fn neighbors(self) -> &'a [VertexId; 6] {
        self.0
    }

    /// The slot of a neighbour.
    #[inline]
    pub(crate) fn slot_of(self, neighbor: VertexId) -> usize {
        let numbers = (0..6).map(|slot| if self.0[slot] == neighbor { slot as u32 } else { 0 });
        numbers.fold(0, |found, slot| found | slot) as usize
    }

    /// The neighbours before and after one.
    #[inline]
    pub(crate) fn beside(self, neighbor: VertexId) -> [VertexId; 2] {
        let &[a, b, c, d, e, f] = self.0;
        found_at(self.0, neighbor, [[f, b], [a, c], [b, d], [c, e], [d, f], [e, a]])
    }

    /// The neighbours two before and two after one.
    #[inline]
    pub(crate) fn two_off(self, neighbor: VertexId) -> [VertexId; 2] {
        let &[a, b, c, d, e, f] = self.0;
        found_at(self.0, neighbor, [[e, c], [f, d], [a, e], [b, f], [c, a], [d, b]])
    }

    /// The neighbours before, at and after every slot.
    #[inline]
    pub(crate) fn threes(self) -> Threes {
        let &[a, b, c, d, e, f] = self.0;
        Threes([f, a, b, c, d, e, f, a])
    }

    /// The slots of neighbours that pass a test.
    #[inline]
    pub(crate) fn slots(self, test: impl Fn(VertexId) -> bool) -> Slots {
        self.slots_of_threes(|[_, w, _]| test(w))
    }

    /// The slots of neighbours that pass a test with the ones before and after them.
    #[inline]
    pub(crate) fn slots_of_threes(self, test: impl Fn([VertexId; 3]) -> bool) -> Slots {
        let threes = self.threes();
        Slots((0..6).fold(0, |set, slot| set | u8::from(test(threes.at(slot))) << slot))
    }
}

/// What belongs to the slot of a neighbour. All are looked at; the last one needs no look.
#[inline]
fn found_at<T: Copy>(six: &[VertexId; 6], neighbor: VertexId, choices: [T; 6]) -> T {
    let mut found = choices[5];
    for slot in 0..5 {
        if six[slot] == neighbor {
            found = choices[slot];
        }
    }
    found
}

/// A regular ring with its last neighbour before the first, and the first behind the last.
#[derive(Clone, Copy)]
pub(crate) struct Threes([VertexId; 8]);

impl Threes {
    /// The neighbours before, at and after a slot.
    #[inline]
    pub(crate) fn at(&self, slot: usize) -> [VertexId; 3] {
        let ring = &self.0;
        [ring[slot], ring[slot + 1], ring[slot + 2]]
    }
}

/// A set of slots below 8. As an iterator it gives them ascending.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(crate) struct Slots(u8);

/// How many slots before one are in a set: by the set, then the slot.
const RANKS: [[u8; 8]; 256] = {
    let mut ranks = [[0; 8]; 256];
    let mut set = 0;
    while set < 256 {
        let mut slot = 0;
        while slot < 7 {
            ranks[set][slot + 1] = ranks[set][slot] + (set >> slot & 1) as u8;
            slot += 1;
        }
        set += 1;
    }
    ranks
};

impl Slots {
    /// Slots are below this.
    pub(crate) const END: usize = 8;

    /// The slots of a ring with so many neighbours at most of those that pass a test.
    #[inline]
    pub(crate) fn among(neighbors: &[VertexId], test: impl Fn(VertexId) -> bool) -> Self {
        Self(neighbors.iter().zip(0..).fold(0, |set, (&w, slot)| set | u8::from(test(w)) << slot))
    }

    #[inline]
    pub(crate) fn contains(self, slot: usize) -> bool {
        self.0 >> slot & 1 == 1
    }

    #[inline]
    pub(crate) fn len(self) -> u32 {
        self.rank(7) + u32::from(self.0 >> 7)
    }

    /// How many slots before this one are in the set.
    #[inline]
    pub(crate) fn rank(self, slot: usize) -> u32 {
        RANKS[usize::from(self.0)][slot % 8].into()
    }

    /// The slots of a regular ring that are not in the set.
    #[inline]
    pub(crate) fn others(self) -> Self {
        Self(!self.0 & 0b11_1111)
    }
}

impl Iterator for Slots {
    type Item = usize;

    #[inline]
    fn next(&mut self) -> Option<usize> {
        let slot = self.0.trailing_zeros() as usize;
        let some = self.0 != 0;
        self.0 &= self.0.wrapping_sub(1);
        some.then_some(slot)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_neighbour_is_found_at_every_slot() {
        let six = [9, 4, 7, 1, 8, 3].map(VertexId::new);
        let ring = Regular(&six);
        for slot in 0..6 {
            let at = |steps: usize| six[(slot + steps) % 6];
            assert_eq!(ring.slot_of(six[slot]), slot);
            assert_eq!(ring.beside(six[slot]), [at(5), at(1)]);
            assert_eq!(ring.two_off(six[slot]), [at(4), at(2)]);
            assert_eq!(ring.threes().at(slot), [at(5), at(0), at(1)]);
        }
    }

    #[test]
    fn sets_of_slots_are_like_lists() {
        let six = [9, 4, 7, 1, 8, 3].map(VertexId::new);
        for bound in 0..11 {
            let set = Regular(&six).slots(|v| v.index() < bound);
            let list: Vec<usize> = (0..6).filter(|&slot| six[slot].index() < bound).collect();
            assert!(set.eq(list.iter().copied()));
            assert!(set.others().eq((0..6).filter(|slot| !list.contains(slot))));
            assert_eq!(set.len() as usize, list.len());
            for slot in 0..6 {
                assert_eq!(set.contains(slot), list.contains(&slot));
                assert_eq!(set.rank(slot) as usize, list.iter().filter(|&&other| other < slot).count());
            }
        }
    }
}
