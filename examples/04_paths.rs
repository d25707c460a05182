//! 4. The rotation system is a graph: petgraph's algorithms run on it as it is.

use std::error::Error;
use std::io::{self, Write};

use vvmesh::petgraph::algo::{astar, connected_components};
use vvmesh::{DirectedEdge, VertexId, shapes};

/// Finds the shortest way along the edges from one side of a torus to the other.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let mesh = shapes::torus(24, 12, 2.0, 1.0);
    let graph = mesh.rotation();
    writeln!(out, "{} component", connected_components(graph))?;

    let [start, goal] = [0, 12 * 12].map(VertexId::new);
    let length = |edge: DirectedEdge| mesh.position(edge.from).distance(mesh.position(edge.to));
    let straight = |v: VertexId| mesh.position(v).distance(mesh.position(goal));
    let (cost, path) = astar(graph, start, |v| v == goal, length, straight).ok_or("a torus is connected")?;
    writeln!(
        out,
        "from {start} to {goal}: {} edges, length {cost:.6}, straight {:.6}",
        path.len() - 1,
        straight(start)
    )?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
