//! The name of a vertex: what it was made of.

use std::fmt;

use crate::id::VertexId;

/// What a vertex was made of. With the lineages of these vertices in turn it is a name that does not depend on ids.
///
/// It prints as the vertex table shows it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub enum Lineage {
    /// An edge in two, the older end first (as in [`Parent`](super::Parent)): `1,2`.
    Edge([VertexId; 2]),
    /// A triangle, counter-clockwise from its oldest corner, of input vertices from the smallest id: `1,2,5`.
    Face([VertexId; 3]),
    /// A boundary edge in three: `3>7`.
    Third {
        /// The end that the vertex is nearer to.
        near: VertexId,
        /// The other end.
        far: VertexId,
    },
}

impl Lineage {
    /// The vertices in the order in which they print.
    pub fn vertices(&self) -> impl Iterator<Item = VertexId> + use<> {
        let [a, b, c] = match *self {
            Self::Edge([a, b]) | Self::Third { near: a, far: b } => [Some(a), Some(b), None],
            Self::Face(corners) => corners.map(Some),
        };
        [a, b, c].into_iter().flatten()
    }

    /// The same made of other vertices; `None` if one of them is.
    pub(crate) fn renamed(&self, mut name: impl FnMut(VertexId) -> Option<VertexId>) -> Option<Self> {
        Some(match *self {
            Self::Edge([a, b]) => Self::Edge([name(a)?, name(b)?]),
            Self::Face([a, b, c]) => Self::Face([name(a)?, name(b)?, name(c)?]),
            Self::Third { near, far } => Self::Third { near: name(near)?, far: name(far)? },
        })
    }

    /// The same for every order in which a run may have come to it.
    pub(crate) fn unordered(self) -> Self {
        match self {
            Self::Edge(mut ends) => {
                ends.sort_unstable();
                Self::Edge(ends)
            }
            Self::Face(mut corners) => {
                corners.sort_unstable();
                Self::Face(corners)
            }
            third @ Self::Third { .. } => third,
        }
    }
}

impl fmt::Display for Lineage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Edge([a, b]) => write!(f, "{},{}", a.index(), b.index()),
            Self::Face([a, b, c]) => write!(f, "{},{},{}", a.index(), b.index(), c.index()),
            Self::Third { near, far } => write!(f, "{}>{}", near.index(), far.index()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lineages_print_as_in_the_vertex_table() {
        let [a, b, c] = [1, 2, 5].map(VertexId::new);
        let lineages = [Lineage::Edge([a, b]), Lineage::Face([a, b, c]), Lineage::Third { near: c, far: b }];
        assert_eq!(lineages.map(|lineage| lineage.to_string()), ["1,2", "1,2,5", "5>2"]);
        assert!(lineages.iter().map(|lineage| lineage.vertices().count()).eq([2, 3, 2]));
    }
}
