//! The rotation system as a graph for petgraph's algorithms.
//!
//! petgraph's visit traits are implemented on [`RotationSystem`] itself, so its algorithms read the rings where they
//! are: nothing is copied or built before. The graph is simple and undirected. Its nodes are the vertices, in the order of
//! their ids and without holes; the neighbours of a node come in the order of its ring. An edge is named by its [`Edge`]
//! and handed out as a [`DirectedEdge`], from the node that was asked for; a walk over all edges meets each once, from its
//! smaller end. Nodes and edges have the weight `()`: lengths are given to an algorithm as a function of the edge.
//!
//! Shortest paths along the edges of a mesh, by length:
//! ```
//! use petgraph::algo::dijkstra;
//! use vvmesh::{DirectedEdge, VertexId, petgraph, shapes};
//! let mesh = shapes::grid(3, 3);
//! let length = |e: DirectedEdge| mesh.position(e.from).distance(mesh.position(e.to));
//! let [start, goal] = [0, 15].map(VertexId::new);
//! let distances = dijkstra(mesh.rotation(), start, None, length);
//! assert!((distances[&goal] - 18_f64.sqrt()).abs() < 1e-12); // along three diagonals
//! ```
//! Pieces, and a forest that spans them:
//! ```
//! use petgraph::algo::{connected_components, min_spanning_tree};
//! use petgraph::data::Element;
//! use vvmesh::{petgraph, shapes};
//! let mesh = shapes::torus(8, 5, 3.0, 1.0);
//! assert_eq!(connected_components(mesh.rotation()), 1);
//! let edges = min_spanning_tree(mesh.rotation()).filter(|e| matches!(e, Element::Edge { .. }));
//! assert_eq!(edges.count(), mesh.vertex_count() - 1);
//! ```
//! A walk, nearest vertices first:
//! ```
//! use petgraph::visit::{Bfs, Walker};
//! use vvmesh::{VertexId, petgraph, shapes};
//! let mesh = shapes::icosahedron();
//! let start = VertexId::new(7);
//! let order: Vec<VertexId> = Bfs::new(mesh.rotation(), start).iter(mesh.rotation()).collect();
//! assert_eq!((order[0], order.len()), (start, 12));
//! assert_eq!(order[1..6], *mesh.rotation().neighbors(start));
//! ```
//! A method of [`RotationSystem`] hides petgraph's of the same name, as `edges`: write `IntoEdges::edges(rotation, v)`.
//!
//! **Deliberately not here**: `EdgeIndexable`, because edges have no numbers (where an algorithm wants them, count
//! [`RotationSystem::edges`]), weights, and the dual graph, whose nodes would be the triangles.

use std::iter::{Copied, Map};
use std::ops::Range;
use std::slice;

use petgraph::data::DataMap;
use petgraph::visit::{
    Data, EdgeCount, EdgeRef, GetAdjacencyMatrix, GraphBase, GraphProp, IntoEdgeReferences, IntoEdges,
    IntoEdgesDirected, IntoNeighbors, IntoNeighborsDirected, IntoNodeIdentifiers, IntoNodeReferences,
    NodeCompactIndexable, NodeCount, NodeIndexable, VisitMap, Visitable,
};
use petgraph::{Direction, Undirected};

use crate::id::{DirectedEdge, Edge, VertexId};
use crate::rotation::RotationSystem;

impl GraphBase for RotationSystem {
    type NodeId = VertexId;
    type EdgeId = Edge;
}

impl GraphProp for RotationSystem {
    type EdgeType = Undirected;
}

impl Data for RotationSystem {
    type NodeWeight = ();
    type EdgeWeight = ();
}

impl DataMap for RotationSystem {
    fn node_weight(&self, v: VertexId) -> Option<&()> {
        self.contains(v).then_some(&())
    }

    fn edge_weight(&self, edge: Edge) -> Option<&()> {
        let [a, b] = edge.ends();
        self.has_edge(a, b).then_some(&())
    }
}

impl NodeCount for RotationSystem {
    #[inline]
    fn node_count(&self) -> usize {
        self.vertex_count()
    }
}

impl EdgeCount for RotationSystem {
    #[inline]
    fn edge_count(&self) -> usize {
        RotationSystem::edge_count(self)
    }
}

impl NodeIndexable for RotationSystem {
    #[inline]
    fn node_bound(&self) -> usize {
        self.vertex_count()
    }

    #[inline]
    fn to_index(&self, v: VertexId) -> usize {
        v.index()
    }

    #[inline]
    fn from_index(&self, index: usize) -> VertexId {
        VertexId::new(index)
    }
}

impl NodeCompactIndexable for RotationSystem {}

impl IntoNodeIdentifiers for &RotationSystem {
    type NodeIdentifiers = Map<Range<usize>, fn(usize) -> VertexId>;

    fn node_identifiers(self) -> Self::NodeIdentifiers {
        (0..self.vertex_count()).map(VertexId::new)
    }
}

impl IntoNodeReferences for &RotationSystem {
    type NodeRef = (VertexId, ());
    type NodeReferences = Map<Range<usize>, fn(usize) -> (VertexId, ())>;

    fn node_references(self) -> Self::NodeReferences {
        (0..self.vertex_count()).map(|index| (VertexId::new(index), ()))
    }
}

impl<'a> IntoNeighbors for &'a RotationSystem {
    type Neighbors = Copied<slice::Iter<'a, VertexId>>;

    #[inline]
    fn neighbors(self, v: VertexId) -> Self::Neighbors {
        self.ring(v).iter()
    }
}

/// Both directions are the same in an undirected graph.
impl<'a> IntoNeighborsDirected for &'a RotationSystem {
    type NeighborsDirected = Copied<slice::Iter<'a, VertexId>>;

    #[inline]
    fn neighbors_directed(self, v: VertexId, _: Direction) -> Self::NeighborsDirected {
        self.ring(v).iter()
    }
}

/// An edge as an algorithm meets it: its ends are told apart, its name is not directed.
impl EdgeRef for DirectedEdge {
    type NodeId = VertexId;
    type EdgeId = Edge;
    type Weight = ();

    #[inline]
    fn source(&self) -> VertexId {
        self.from
    }

    #[inline]
    fn target(&self) -> VertexId {
        self.to
    }

    #[inline]
    fn weight(&self) -> &() {
        &()
    }

    #[inline]
    fn id(&self) -> Edge {
        self.edge()
    }
}

impl<'a> IntoEdges for &'a RotationSystem {
    type Edges = EdgesAt<'a>;

    #[inline]
    fn edges(self, v: VertexId) -> EdgesAt<'a> {
        self.edges_directed(v, Direction::Outgoing)
    }
}

impl<'a> IntoEdgesDirected for &'a RotationSystem {
    type EdgesDirected = EdgesAt<'a>;

    #[inline]
    fn edges_directed(self, v: VertexId, direction: Direction) -> EdgesAt<'a> {
        EdgesAt { v, neighbors: self.ring(v).iter(), direction }
    }
}

/// The edges at a vertex in the order of its ring, all from it or all to it.
#[derive(Clone, Debug)]
pub struct EdgesAt<'a> {
    v: VertexId,
    neighbors: Copied<slice::Iter<'a, VertexId>>,
    direction: Direction,
}

impl EdgesAt<'_> {
    #[inline]
    fn edge_with(&self, w: VertexId) -> DirectedEdge {
        match self.direction {
            Direction::Outgoing => DirectedEdge::new(self.v, w),
            Direction::Incoming => DirectedEdge::new(w, self.v),
        }
    }
}

impl Iterator for EdgesAt<'_> {
    type Item = DirectedEdge;

    #[inline]
    fn next(&mut self) -> Option<DirectedEdge> {
        self.neighbors.next().map(|w| self.edge_with(w))
    }

    #[inline]
    fn size_hint(&self) -> (usize, Option<usize>) {
        self.neighbors.size_hint()
    }
}

impl DoubleEndedIterator for EdgesAt<'_> {
    #[inline]
    fn next_back(&mut self) -> Option<DirectedEdge> {
        self.neighbors.next_back().map(|w| self.edge_with(w))
    }
}

impl ExactSizeIterator for EdgesAt<'_> {}

impl<'a> IntoEdgeReferences for &'a RotationSystem {
    type EdgeRef = DirectedEdge;
    type EdgeReferences = EdgesOnce<'a>;

    fn edge_references(self) -> EdgesOnce<'a> {
        EdgesOnce { rotation: self, v: 0, rest: [].iter() }
    }
}

/// All edges, each once from its smaller end: by that end, then in the order of its ring.
#[derive(Clone, Debug)]
pub struct EdgesOnce<'a> {
    rotation: &'a RotationSystem,
    /// Vertices below this one have been entered, the last of them has `rest` left.
    v: usize,
    rest: slice::Iter<'a, VertexId>,
}

impl Iterator for EdgesOnce<'_> {
    type Item = DirectedEdge;

    fn next(&mut self) -> Option<DirectedEdge> {
        loop {
            for &w in &mut self.rest {
                if w.index() >= self.v {
                    return Some(DirectedEdge::new(VertexId::new(self.v - 1), w));
                }
            }
            if self.v == self.rotation.vertex_count() {
                return None;
            }
            self.rest = self.rotation.neighbors(VertexId::new(self.v)).iter();
            self.v += 1;
        }
    }
}

impl Visitable for RotationSystem {
    type Map = VisitBits;

    fn visit_map(&self) -> VisitBits {
        VisitBits { words: vec![0; self.vertex_count().div_ceil(64)] }
    }

    fn reset_map(&self, map: &mut VisitBits) {
        map.words.clear();
        map.words.resize(self.vertex_count().div_ceil(64), 0);
    }
}

/// One bit a vertex: whether it was visited.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct VisitBits {
    words: Vec<u64>,
}

/// The word of a vertex and its bit there.
#[inline]
fn place(v: VertexId) -> (usize, u64) {
    (v.index() / 64, 1 << (v.index() % 64))
}

/// Only for vertices that existed when the map was made or reset; others may panic.
impl VisitMap<VertexId> for VisitBits {
    #[inline]
    fn visit(&mut self, v: VertexId) -> bool {
        let (word, bit) = place(v);
        let fresh = self.words[word] & bit == 0;
        self.words[word] |= bit;
        fresh
    }

    #[inline]
    fn is_visited(&self, v: &VertexId) -> bool {
        let (word, bit) = place(*v);
        self.words[word] & bit != 0
    }

    #[inline]
    fn unvisit(&mut self, v: VertexId) -> bool {
        let (word, bit) = place(v);
        let visited = self.words[word] & bit != 0;
        self.words[word] &= !bit;
        visited
    }
}

/// The rings serve as the matrix: nothing is built, and a question costs O(smaller valence of the two).
impl GetAdjacencyMatrix for RotationSystem {
    type AdjMatrix = ();

    fn adjacency_matrix(&self) {}

    fn is_adjacent(&self, (): &(), a: VertexId, b: VertexId) -> bool {
        let [a, b] = if self.valence(a) <= self.valence(b) { [a, b] } else { [b, a] };
        self.has_edge(a, b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn all_edges_come_once_from_the_smaller_end() {
        for mesh in [shapes::grid(3, 2), shapes::octahedron(), shapes::torus(4, 3, 2.0, 1.0)] {
            let rotation = mesh.rotation();
            let references: Vec<_> = rotation.edge_references().collect();
            assert!(references.iter().all(|e| e.source() < e.target()));
            assert!(references.iter().map(EdgeRef::id).eq(rotation.edges()));
            assert_eq!(references.len(), EdgeCount::edge_count(rotation));
        }
        assert_eq!(RotationSystem::with_isolated(3).edge_references().count(), 0);
    }

    #[test]
    fn edges_at_a_vertex_start_or_end_there() {
        let mesh = shapes::grid(2, 2);
        let (rotation, v) = (mesh.rotation(), VertexId::new(4));
        let outgoing = IntoEdges::edges(rotation, v);
        assert_eq!(outgoing.len(), 6);
        assert!(outgoing.clone().all(|e| e.source() == v));
        assert!(outgoing.clone().map(|e| e.target()).eq(IntoNeighbors::neighbors(rotation, v)));
        let incoming = rotation.edges_directed(v, Direction::Incoming);
        assert!(incoming.rev().map(|e| e.reversed()).eq(outgoing.rev()));
    }

    #[test]
    fn a_visit_map_remembers_and_is_reset_to_a_new_size() {
        let [small, large] = [3, 200].map(RotationSystem::with_isolated);
        let mut map = small.visit_map();
        let v = VertexId::new(2);
        assert!(map.visit(v) && !map.visit(v) && map.is_visited(&v));
        assert!(map.unvisit(v) && !map.unvisit(v) && !map.is_visited(&v));
        map.visit(v);
        large.reset_map(&mut map);
        assert!(large.vertices().all(|w| map.visit(w)));
        assert_eq!(map.words.len(), 4);
        large.reset_map(&mut map);
        assert_eq!(map, large.visit_map());
    }

    #[test]
    fn adjacency_is_read_from_either_ring() {
        let mesh = shapes::grid(3, 3);
        let rotation = mesh.rotation();
        let () = rotation.adjacency_matrix();
        for a in rotation.vertices() {
            for b in rotation.vertices() {
                let expected = rotation.neighbors(a).contains(&b);
                assert_eq!(rotation.is_adjacent(&(), a, b), expected);
                assert_eq!(rotation.edge_weight(Edge::new(a, b)).is_some(), expected);
            }
        }
        assert!(rotation.node_weight(VertexId::new(16)).is_none());
    }
}
