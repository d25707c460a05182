//! 1. A mesh is rings: for every vertex its neighbours, counter-clockwise. All else follows from them.

use std::error::Error;
use std::io::{self, Write};

use vvmesh::{DirectedEdge, VertexId, shapes};

/// Walks over the rings of a grid of two by two squares.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let mesh = shapes::grid(2, 2);
    let middle = VertexId::new(4);
    let ring = mesh.ring(middle);
    writeln!(out, "the ring of {middle}: {:?}", ring.neighbors())?;

    let first = ring.neighbors()[0];
    let second = ring.next(first).ok_or("the ring is closed")?;
    writeln!(out, "after {first} comes {second}, so {middle}, {first} and {second} are a triangle")?;

    let corner = VertexId::new(0);
    writeln!(
        out,
        "{corner} is on the boundary; behind its last neighbour is a gap: {:?}",
        mesh.ring(corner).neighbors()
    )?;

    let rotation = mesh.rotation();
    let face = rotation.face(DirectedEdge::new(middle, first)).ok_or("there is such a face")?;
    writeln!(out, "the face left of {middle} -> {first} has {} sides", face.count())?;
    writeln!(
        out,
        "{} vertices - {} edges + {} faces = {}, with {} boundary loop",
        rotation.vertex_count(),
        rotation.edge_count(),
        rotation.face_count(),
        rotation.euler_characteristic(),
        rotation.boundary_loops().len()
    )?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
