//! Which vertex is which after all of them were given other numbers.

use crate::id::VertexId;

/// Other numbers for the vertices `0..len`: every old vertex has one new number, and every new number one old vertex.
///
/// ```
/// use vvmesh::{VertexId, mesh::Permutation};
/// let [a, b, c] = [0, 1, 2].map(VertexId::new);
/// let permutation = Permutation::new(vec![c, a, b]).expect("each comes once");
/// assert_eq!((permutation.old_of(a), permutation.new_of(c)), (c, a));
/// assert_eq!(permutation.applied_to(&["at a", "at b", "at c"]), ["at c", "at a", "at b"]);
/// assert!(Permutation::new(vec![a, a, c]).is_none());
/// ```
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Permutation {
    old: Vec<VertexId>,
    new: Vec<VertexId>,
}

impl Permutation {
    /// The permutation under which the vertices come in this order; `None` if one of `0..len` is not among them.
    /// O(length).
    #[must_use]
    pub fn new(order: Vec<VertexId>) -> Option<Self> {
        let mut new = vec![VertexId::GAP; order.len()];
        for (k, v) in order.iter().enumerate() {
            let place = new.get_mut(v.index()).filter(|place| **place == VertexId::GAP)?;
            *place = VertexId::new(k);
        }
        Some(Self { old: order, new })
    }

    /// How many vertices it renumbers.
    #[must_use]
    pub fn len(&self) -> usize {
        self.old.len()
    }

    /// Whether it renumbers no vertex.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.old.is_empty()
    }

    /// The new number of a vertex.
    ///
    /// # Panics
    /// If it has none.
    #[inline]
    #[must_use]
    pub fn new_of(&self, old: VertexId) -> VertexId {
        self.new[old.index()]
    }

    /// The vertex that has a number now.
    ///
    /// # Panics
    /// If none has it.
    #[inline]
    #[must_use]
    pub fn old_of(&self, new: VertexId) -> VertexId {
        self.old[new.index()]
    }

    /// The way back.
    #[must_use]
    pub fn inverse(&self) -> Self {
        Self { old: self.new.clone(), new: self.old.clone() }
    }

    /// The same for a mesh of so many vertices, those that were added keeping their numbers.
    ///
    /// # Panics
    /// If `len` is less than it is.
    #[must_use]
    pub fn extended(mut self, len: usize) -> Self {
        assert!(len >= self.len(), "{} vertices have other numbers already, more than {len}", self.len());
        let added = (self.len()..len).map(VertexId::new);
        self.old.extend(added.clone());
        self.new.extend(added);
        self
    }

    /// What belonged to each vertex, listed by old numbers, in the order of the new ones.
    ///
    /// # Panics
    /// If the list has another length.
    #[must_use]
    pub fn applied_to<T: Clone>(&self, list: &[T]) -> Vec<T> {
        assert_eq!(list.len(), self.len(), "something for each vertex");
        self.old.iter().map(|v| list[v.index()].clone()).collect()
    }

    /// The old vertices in the order of their new numbers.
    pub(super) fn order(&self) -> impl ExactSizeIterator<Item = VertexId> {
        self.old.iter().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_way_back_undoes_it() {
        let order = [3, 0, 4, 1, 2].map(VertexId::new);
        let permutation = Permutation::new(order.to_vec()).unwrap();
        let back = permutation.inverse();
        for v in order {
            assert_eq!((permutation.old_of(permutation.new_of(v)), back.new_of(permutation.new_of(v))), (v, v));
        }
        assert_eq!(back.applied_to(&permutation.applied_to(&[1, 2, 3, 4, 5])), [1, 2, 3, 4, 5]);
        let extended = permutation.clone().extended(7);
        assert_eq!(extended.applied_to(&[1, 2, 3, 4, 5, 6, 7]), [4, 1, 5, 2, 3, 6, 7]);
        assert_eq!(extended.inverse(), back.extended(7));
    }

    #[test]
    fn what_is_no_permutation_is_refused() {
        for wrong in [&[1][..], &[0, 0], &[0, 2]] {
            assert_eq!(Permutation::new(wrong.iter().copied().map(VertexId::new).collect()), None);
        }
        assert!(Permutation::new(Vec::new()).is_some_and(|nothing| nothing.is_empty()));
    }
}
