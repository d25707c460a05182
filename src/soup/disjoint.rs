//! Disjoint sets of numbers.

/// A partition of `0..count` that only ever gets coarser. Each operation is O(log count) amortised.
///
/// The name of a set is its smallest member, so results do not depend on the order of the joins.
#[derive(Clone, Debug)]
pub(crate) struct DisjointSets {
    parents: Vec<u32>,
}

impl DisjointSets {
    /// Every number by itself; `count` is at most 2³².
    pub(crate) fn new(count: usize) -> Self {
        Self { parents: (0..count).map(|k| k as u32).collect() }
    }

    /// The name of the set that holds `k`.
    pub(crate) fn find(&mut self, mut k: u32) -> u32 {
        while self.parents[k as usize] != k {
            let grandparent = self.parents[self.parents[k as usize] as usize];
            self.parents[k as usize] = grandparent;
            k = grandparent;
        }
        k
    }

    /// Makes one set of those that hold `j` and `k`.
    pub(crate) fn join(&mut self, j: u32, k: u32) {
        let (j, k) = (self.find(j), self.find(k));
        self.parents[j.max(k) as usize] = j.min(k);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_is_named_by_its_smallest_member() {
        let mut sets = DisjointSets::new(6);
        sets.join(5, 3);
        sets.join(1, 4);
        assert_eq!([0, 1, 2, 3, 4, 5].map(|k| sets.find(k)), [0, 1, 2, 3, 1, 3]);
        sets.join(4, 5);
        assert_eq!([3, 4, 5].map(|k| sets.find(k)), [1; 3]);
    }
}
