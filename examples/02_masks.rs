//! 2. A scheme answers with masks: which old vertices weigh how much in a new position.

use std::error::Error;
use std::io::{self, Write};

use vvmesh::scheme::{Butterfly, Loop, Mask, Midpoint, ModifiedButterfly, Scheme, Sqrt3};
use vvmesh::step::Parent;
use vvmesh::{Mesh, VertexId, shapes};

/// Prints the mask of the new vertex on one edge, or in the triangle beside it, for each scheme.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let mesh = shapes::torus(8, 8, 2.0, 1.0);
    let p = VertexId::new(0);
    let q = mesh.ring(p).neighbors()[0];
    let left = mesh.rotation().left_of(p, q).ok_or("the torus has no boundary")?;
    let parent = Parent { p, q, left: Some(left), right: mesh.rotation().right_of(p, q) };

    let mut center = Mask::default();
    Sqrt3::default().center([p, q, left], &mut center);
    for (name, mask) in [
        ("Loop", odd(&Loop::default(), &mesh, &parent)),
        ("Butterfly", odd(&Butterfly, &mesh, &parent)),
        ("modified Butterfly", odd(&ModifiedButterfly, &mesh, &parent)),
        ("midpoint", odd(&Midpoint, &mesh, &parent)),
        ("square root of 3", center),
    ] {
        writeln!(out, "{name}, between {p} and {q}:")?;
        for (weight, vertices) in mask.groups() {
            writeln!(out, "  {weight:>7.5} for {vertices:?}")?;
        }
        writeln!(out, "  {:>7} in all", mask.sum())?;
    }
    Ok(())
}

/// The mask of the new vertex on an edge.
fn odd(scheme: &impl Scheme, mesh: &Mesh, parent: &Parent) -> Mask {
    let mut mask = Mask::default();
    scheme.odd(mesh.neighborhood(), parent, &mut mask);
    mask
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
