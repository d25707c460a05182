//! petgraph's algorithms give the same on a rotation system as on a `petgraph` graph with the same nodes and edges.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]
#![allow(clippy::print_stderr, reason = "shown only if a test fails: which mesh it was")]

mod common;

use std::collections::{HashMap, HashSet};
use std::fmt::Debug;
use std::hash::Hash;
use std::path::Path;

use petgraph::adj::List;
use petgraph::algo::articulation_points::articulation_points;
use petgraph::algo::bridges::bridges;
use petgraph::algo::dominators::simple_fast;
use petgraph::algo::{
    astar, connected_components, dijkstra, dsatur_coloring, floyd_warshall, has_path_connecting,
    is_bipartite_undirected, is_cyclic_undirected, is_isomorphic, is_isomorphic_matching, k_shortest_path,
    kosaraju_scc, maximal_cliques, maximum_matching, min_spanning_tree, page_rank, spfa,
};
use petgraph::data::{DataMap, Element};
use petgraph::graph::{EdgeReference, NodeIndex, UnGraph};
use petgraph::visit::{
    Bfs, Dfs, DfsPostOrder, EdgeRef, IntoEdgeReferences, IntoEdges, IntoNeighbors, IntoNodeReferences, NodeIndexable,
    NodeRef, Walker,
};
use vvmesh::glam::DVec3;
use vvmesh::{DirectedEdge, Mesh, RotationSystem, VertexId, shapes};

/// A mesh, and petgraph's own graph of it: the same nodes, the edges in the order of `Mesh::edges`, weighted by length.
struct Case {
    name: String,
    mesh: Mesh,
    graph: UnGraph<(), f64>,
}

impl Case {
    fn new(name: &str, mut mesh: Mesh) -> Self {
        // Shaken a little, so that no two paths have the same length and every answer is the only one.
        for (k, p) in mesh.positions_mut().iter_mut().enumerate() {
            let k = k as f64;
            *p += 0.05 * DVec3::new((12.9898 * k).sin(), (78.233 * k).sin(), (37.719 * k).sin());
        }
        let mut graph = UnGraph::with_capacity(mesh.vertex_count(), mesh.edge_count());
        mesh.vertices().for_each(|_| _ = graph.add_node(()));
        for edge in mesh.edges() {
            let [a, b] = edge.ends();
            graph.add_edge(node(a), node(b), mesh.position(a).distance(mesh.position(b)));
        }
        Self { name: name.to_owned(), mesh, graph }
    }

    fn rotation(&self) -> &RotationSystem {
        self.mesh.rotation()
    }

    fn length(&self) -> impl Fn(DirectedEdge) -> f64 + Copy {
        |e| self.mesh.position(e.from).distance(self.mesh.position(e.to))
    }

    /// Some vertices, far from each other by number.
    fn some_vertices(&self) -> Vec<VertexId> {
        let count = self.mesh.vertex_count();
        [0, count / 3, count / 2, count - 1].map(VertexId::new).to_vec()
    }
}

fn node(v: VertexId) -> NodeIndex {
    NodeIndex::new(v.index())
}

fn vertex(node: NodeIndex) -> VertexId {
    VertexId::new(node.index())
}

fn weight(edge: EdgeReference<'_, f64>) -> f64 {
    *edge.weight()
}

fn by_vertex<K>(by_node: impl IntoIterator<Item = (NodeIndex, K)>) -> impl Iterator<Item = (VertexId, K)> {
    by_node.into_iter().map(|(node, value)| (vertex(node), value))
}

/// The shapes, an isolated vertex, two pieces, and (where the folder is) some of the shared meshes.
fn cases() -> Vec<Case> {
    let grid = shapes::grid(5, 3);
    let count = grid.vertex_count() as u32;
    let mut corners = grid.positions().to_vec();
    corners.extend(grid.positions().iter().map(|&p| p * 1.1 + DVec3::Z));
    corners.push(DVec3::ONE);
    let one = grid.triangles().map(|t| t.corners().map(|v| v.index() as u32));
    let both: Vec<[u32; 3]> = one.clone().chain(one.map(|t| t.map(|k| k + count))).collect();
    let pieces = Mesh::from_triangles(corners, &both).unwrap();
    let mut cases = vec![
        Case::new("tetrahedron", shapes::tetrahedron()),
        Case::new("octahedron", shapes::octahedron()),
        Case::new("icosahedron", shapes::icosahedron()),
        Case::new("grid", shapes::grid(9, 6)),
        Case::new("torus", shapes::torus(8, 6, 3.0, 1.0)),
        Case::new("pieces", pieces),
        Case::new("isolated", Mesh::from_triangles(vec![DVec3::ZERO; 3], &[]).unwrap()),
    ];
    if let Some(folder) = common::meshes() {
        for name in ["papers/eight_96.off", "papers/foot_240.off", "papers/strip_40.off", "papers/top_144.off"] {
            cases.push(Case::new(name, read_off(&folder.join(name))));
        }
    }
    cases
}

/// Reads a plain OFF file of triangles without comments.
fn read_off(path: &Path) -> Mesh {
    let text = std::fs::read_to_string(path).unwrap();
    let mut words = text.strip_prefix("OFF").unwrap().split_whitespace();
    let mut count = || words.next().unwrap().parse::<usize>().unwrap();
    let [vertices, faces, _] = [count(), count(), count()];
    let mut number = || words.next().unwrap().parse::<f64>().unwrap();
    let corners = (0..vertices).map(|_| DVec3::new(number(), number(), number())).collect();
    let triangles: Vec<[u32; 3]> = (0..faces)
        .map(|_| {
            assert_eq!(number(), 3.0);
            [number(), number(), number()].map(|k| k as u32)
        })
        .collect();
    Mesh::from_triangles(corners, &triangles).unwrap()
}

fn check(mut test: impl FnMut(&Case)) {
    for case in cases() {
        eprintln!("{}", case.name);
        test(&case);
    }
}

fn assert_close<N: Eq + Hash + Debug>(
    found: impl IntoIterator<Item = (N, f64)>,
    expected: impl IntoIterator<Item = (N, f64)>,
) {
    let (found, expected): (HashMap<_, _>, HashMap<_, _>) =
        (found.into_iter().collect(), expected.into_iter().collect());
    assert_eq!(found.len(), expected.len());
    for (n, value) in expected {
        assert!((found[&n] - value).abs() <= 1e-12 * value.abs(), "{n:?}: {} and {value}", found[&n]);
    }
}

#[test]
fn dijkstra_finds_the_same_distances() {
    check(|case| {
        for v in case.some_vertices() {
            let found = dijkstra(case.rotation(), v, None, case.length());
            assert_close(found, by_vertex(dijkstra(&case.graph, node(v), None, weight)));
        }
    });
}

#[test]
fn astar_finds_the_same_path() {
    check(|case| {
        let at = |v: VertexId| case.mesh.position(v);
        for start in case.some_vertices() {
            for goal in case.some_vertices() {
                let ahead = |v: VertexId| at(v).distance(at(goal));
                let found = astar(case.rotation(), start, |v| v == goal, case.length(), ahead);
                let expected =
                    astar(&case.graph, node(start), |n| n == node(goal), weight, |n: NodeIndex| ahead(vertex(n)));
                let expected =
                    expected.map(|(length, path)| (length, path.into_iter().map(vertex).collect::<Vec<_>>()));
                assert_eq!(found, expected);
            }
        }
    });
}

#[test]
fn k_shortest_paths_have_the_same_lengths() {
    check(|case| {
        let v = case.some_vertices()[1];
        let found = k_shortest_path(case.rotation(), v, None, 3, case.length());
        assert_close(found, by_vertex(k_shortest_path(&case.graph, node(v), None, 3, weight)));
    });
}

#[test]
fn all_pairs_and_a_queue_give_the_same_distances() {
    check(|case| {
        if case.mesh.vertex_count() > 60 {
            return;
        }
        let found = floyd_warshall(case.rotation(), case.length()).unwrap();
        let expected = floyd_warshall(&case.graph, weight).unwrap();
        assert_close(found, expected.into_iter().map(|((a, b), d)| ((vertex(a), vertex(b)), d)));
        for v in case.some_vertices() {
            let found = spfa(case.rotation(), v, case.length()).unwrap();
            let expected = spfa(&case.graph, node(v), weight).unwrap();
            assert_eq!(found.distances, expected.distances);
            assert_eq!(
                found.predecessors,
                expected.predecessors.into_iter().map(|n| n.map(vertex)).collect::<Vec<_>>()
            );
        }
    });
}

#[test]
fn components_and_paths_are_the_same() {
    let mut counts = HashMap::new();
    check(|case| {
        let count = connected_components(case.rotation());
        assert_eq!(count, connected_components(&case.graph));
        counts.insert(case.name.clone(), count);
        assert_eq!(kosaraju_scc(case.rotation()).len(), count);
        for a in case.some_vertices() {
            for b in case.some_vertices() {
                let found = has_path_connecting(case.rotation(), a, b, None);
                assert_eq!(found, has_path_connecting(&case.graph, node(a), node(b), None));
            }
        }
    });
    assert_eq!([counts["pieces"], counts["isolated"], counts["torus"]], [3, 3, 1]);
}

#[test]
fn spanning_forests_are_the_same() {
    check(|case| {
        // Without weights, as the rotation system has none: ties are decided by the order of nodes and edges.
        let graph = case.graph.map(|_, ()| (), |_, _| ());
        let found: Vec<_> = min_spanning_tree(case.rotation()).map(plain).collect();
        assert_eq!(found, min_spanning_tree(&graph).map(plain).collect::<Vec<_>>());
        let edges = found.iter().filter(|element| element.is_some()).count();
        assert_eq!(edges, case.mesh.vertex_count() - connected_components(case.rotation()));
    });

    fn plain(element: Element<(), ()>) -> Option<(usize, usize)> {
        match element {
            Element::Node { .. } => None,
            Element::Edge { source, target, .. } => Some((source, target)),
        }
    }
}

#[test]
fn a_mesh_with_triangles_is_cyclic_and_not_bipartite() {
    check(|case| {
        let has_faces = case.mesh.face_count() > 0;
        assert_eq!(is_cyclic_undirected(case.rotation()), has_faces);
        assert_eq!(is_cyclic_undirected(&case.graph), has_faces);
        for v in case.some_vertices() {
            let found = is_bipartite_undirected(case.rotation(), v);
            assert_eq!(found, is_bipartite_undirected(&case.graph, node(v)));
            assert_eq!(found, case.mesh.ring(v).valence() == 0);
        }
    });
}

#[test]
fn walks_meet_the_same_vertices_in_the_same_order() {
    check(|case| {
        // A list of successors keeps an order of its own, so it can be given that of the rings.
        let mut list = List::<()>::new();
        case.mesh.vertices().for_each(|_| _ = list.add_node());
        for e in case.rotation().directed_edges() {
            list.add_edge(e.from.index() as u32, e.to.index() as u32, ());
        }
        let vertices = |nodes: Vec<u32>| nodes.into_iter().map(|n| VertexId::new(n as usize)).collect::<Vec<_>>();
        for v in case.some_vertices() {
            let (rotation, n) = (case.rotation(), v.index() as u32);
            let found: Vec<_> = Bfs::new(rotation, v).iter(rotation).collect();
            assert_eq!(found, vertices(Bfs::new(&list, n).iter(&list).collect()));
            let found: Vec<_> = Dfs::new(rotation, v).iter(rotation).collect();
            assert_eq!(found, vertices(Dfs::new(&list, n).iter(&list).collect()));
            let found: Vec<_> = DfsPostOrder::new(rotation, v).iter(rotation).collect();
            assert_eq!(found, vertices(DfsPostOrder::new(&list, n).iter(&list).collect()));
            let reached: HashSet<_> = found.into_iter().collect();
            assert_eq!(reached, Dfs::new(&case.graph, node(v)).iter(&case.graph).map(vertex).collect());
        }
    });
}

#[test]
fn dominators_are_the_same() {
    check(|case| {
        for v in case.some_vertices() {
            let (found, expected) = (simple_fast(case.rotation(), v), simple_fast(&case.graph, node(v)));
            for w in case.mesh.vertices() {
                assert_eq!(found.immediate_dominator(w), expected.immediate_dominator(node(w)).map(vertex));
            }
        }
    });
}

#[test]
fn a_mesh_has_no_bridge_and_no_articulation_point() {
    check(|case| {
        assert_eq!(bridges(case.rotation()).count(), bridges(&case.graph).count());
        assert_eq!(bridges(case.rotation()).count(), 0);
        assert_eq!(articulation_points(case.rotation()).len(), articulation_points(&case.graph).len());
        assert_eq!(articulation_points(case.rotation()).len(), 0);
    });
}

#[test]
fn page_ranks_are_the_same() {
    check(|case| {
        let (found, expected) = (page_rank(case.rotation(), 0.85, 20), page_rank(&case.graph, 0.85, 20));
        assert_eq!(found.len(), case.mesh.vertex_count());
        assert!(found.iter().zip(&expected).all(|(a, b): (&f64, &f64)| (a - b).abs() < 1e-14));
    });
}

#[test]
fn matchings_have_the_same_size_and_are_matchings() {
    check(|case| {
        let found = maximum_matching(case.rotation());
        assert_eq!(found.len(), maximum_matching(&case.graph).len());
        let mut met = HashSet::new();
        for (a, b) in found.edges() {
            assert!(case.rotation().has_edge(a, b) && met.insert(a) && met.insert(b));
        }
    });
}

#[test]
fn cliques_and_colours_are_the_same() {
    check(|case| {
        let sorted = |cliques: Vec<Vec<VertexId>>| {
            let mut cliques = cliques;
            cliques.iter_mut().for_each(|clique| clique.sort());
            cliques.sort();
            cliques
        };
        let found = maximal_cliques(case.rotation()).into_iter().map(|clique| clique.into_iter().collect()).collect();
        let expected = maximal_cliques(&case.graph);
        let expected = expected.into_iter().map(|clique| clique.into_iter().map(vertex).collect()).collect();
        assert_eq!(sorted(found), sorted(expected));
        let (colours, count) = dsatur_coloring(case.rotation());
        assert!(colours.values().all(|&colour| colour < count));
        assert!(case.mesh.edges().all(|e| colours[&e.ends()[0]] != colours[&e.ends()[1]]));
    });
}

#[test]
fn a_rotation_system_is_isomorphic_to_its_graph_and_to_no_other() {
    check(|case| {
        if case.mesh.vertex_count() > 60 {
            return;
        }
        assert!(is_isomorphic(case.rotation(), &case.graph));
        assert!(is_isomorphic_matching(case.rotation(), case.rotation(), |(), ()| true, |(), ()| true));
        let mut graph = case.graph.clone();
        if graph.remove_edge(petgraph::graph::EdgeIndex::new(0)).is_some() {
            assert!(!is_isomorphic(case.rotation(), &graph));
            // The same number of edges, one of them elsewhere: twice between the same ends.
            let (a, b) = graph.edge_endpoints(petgraph::graph::EdgeIndex::new(1)).unwrap();
            graph.add_edge(a, b, 1.0);
            assert!(!is_isomorphic(case.rotation(), &graph));
        }
    });
}

#[test]
fn the_views_agree_with_each_other() {
    check(|case| {
        let rotation = case.rotation();
        let edges: Vec<_> = rotation.edge_references().map(|e| (node(e.source()), node(e.target()))).collect();
        let expected: Vec<_> = case.graph.edge_references().map(|e| (e.source(), e.target())).collect();
        assert_eq!(edges, expected);
        for (index, reference) in rotation.node_references().enumerate() {
            let v = reference.id();
            assert_eq!((rotation.to_index(v), NodeIndexable::from_index(&rotation, index)), (index, v));
            assert_eq!(rotation.node_weight(v), Some(&()));
            let neighbors: Vec<_> = IntoNeighbors::neighbors(rotation, v).collect();
            assert_eq!(neighbors, rotation.ring(v).neighbors());
            assert!(IntoEdges::edges(rotation, v).all(|e| e.source() == v && e.id() == e.edge()));
            assert!(IntoEdges::edges(rotation, v).map(|e| e.target()).eq(neighbors));
        }
    });
}
