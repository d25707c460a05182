//! What one step refines.

use std::borrow::Cow;

use crate::id::{Edge, VertexId};

/// What one step refines: the vertices that take part and the edges that are split.
///
/// Even vertices of the region are moved by the scheme; faces of which only some edges are split are closed afterwards. A
/// bisection takes the faces of which all edges are of the region, and what has to be refined before them.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Region {
    kind: RegionKind,
}

#[derive(Clone, PartialEq, Eq, Debug)]
pub(crate) enum RegionKind {
    /// All vertices, all edges.
    Everything,
    /// Some vertices, ascending, and all edges between them.
    Induced(Vec<VertexId>),
    /// Some edges, ascending, and their ends.
    Edges(Vec<Edge>),
    /// Some vertices, ascending, and all edges of the faces around them.
    Stars(Vec<VertexId>),
}

impl Region {
    /// The whole mesh.
    #[must_use]
    pub fn everything() -> Self {
        Self { kind: RegionKind::Everything }
    }

    /// These vertices and every edge between two of them. A face then has 0, 1 or 3 split edges, never 2.
    #[must_use]
    pub fn induced(vertices: impl IntoIterator<Item = VertexId>) -> Self {
        let mut vertices: Vec<VertexId> = vertices.into_iter().collect();
        // Breadth-first order comes in, and is often sorted already.
        if !vertices.is_sorted() {
            vertices.sort_unstable();
        }
        vertices.dedup();
        Self { kind: RegionKind::Induced(vertices) }
    }

    /// These edges and their ends, as face selections and tests on edges give them. A face can have 2 split edges.
    #[must_use]
    pub fn edges(edges: impl IntoIterator<Item = Edge>) -> Self {
        let mut edges: Vec<Edge> = edges.into_iter().collect();
        edges.sort_unstable();
        edges.dedup();
        Self { kind: RegionKind::Edges(edges) }
    }

    /// These vertices, which come ascending, and every edge of a face with one of them as a corner. Only for the split in four.
    pub(crate) fn stars(vertices: Vec<VertexId>) -> Self {
        debug_assert!(vertices.is_sorted_by(|a, b| a < b));
        Self { kind: RegionKind::Stars(vertices) }
    }

    pub(crate) fn is_everything(&self) -> bool {
        self.kind == RegionKind::Everything
    }

    /// The vertices that take part, ascending, in a mesh with this many.
    pub(crate) fn vertices(&self, vertex_count: usize) -> Cow<'_, [VertexId]> {
        match &self.kind {
            RegionKind::Everything => (0..vertex_count).map(VertexId::new).collect(),
            RegionKind::Induced(vertices) | RegionKind::Stars(vertices) => Cow::Borrowed(vertices),
            RegionKind::Edges(edges) => {
                let mut ends: Vec<VertexId> = edges.iter().flat_map(|edge| edge.ends()).collect();
                ends.sort_unstable();
                ends.dedup();
                Cow::Owned(ends)
            }
        }
    }

    /// The list of vertices, for its memory.
    pub(crate) fn into_list(self) -> Vec<VertexId> {
        match self.kind {
            RegionKind::Induced(vertices) | RegionKind::Stars(vertices) => vertices,
            RegionKind::Everything | RegionKind::Edges(_) => Vec::new(),
        }
    }

    pub(crate) fn kind(&self) -> &RegionKind {
        &self.kind
    }
}
