//! 2. A scheme answers with masks: which old vertices weigh how much in a new position.

use std::error::Error;
use std::io::{self, Write};

use vvmesh::scheme::{AnyScheme, Butterfly, Loop, Mask, Midpoint, ModifiedButterfly, Scheme};
use vvmesh::step::Parent;
use vvmesh::{VertexId, shapes};

/// Prints the mask of the new vertex on one edge, for each scheme.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let mesh = shapes::torus(8, 8, 2.0, 1.0);
    let p = VertexId::new(0);
    let q = mesh.ring(p).neighbors()[0];
    let parent = Parent { p, q, left: mesh.rotation().left_of(p, q), right: mesh.rotation().right_of(p, q) };

    let schemes: [(&str, AnyScheme); 4] = [
        ("Loop", Loop::default().into()),
        ("Butterfly", Butterfly.into()),
        ("modified Butterfly", ModifiedButterfly.into()),
        ("midpoint", Midpoint.into()),
    ];
    for (name, scheme) in schemes {
        let mut mask = Mask::default();
        let around = mesh.neighborhood();
        match scheme {
            AnyScheme::Loop(scheme) => scheme.odd(around, &parent, &mut mask),
            AnyScheme::Butterfly(scheme) => scheme.odd(around, &parent, &mut mask),
            AnyScheme::ModifiedButterfly(scheme) => scheme.odd(around, &parent, &mut mask),
            AnyScheme::Midpoint(scheme) => scheme.odd(around, &parent, &mut mask),
        }
        writeln!(out, "{name}, between {p} and {q}:")?;
        for (weight, vertices) in mask.groups() {
            writeln!(out, "  {weight:>7} for {vertices:?}")?;
        }
        writeln!(out, "  {:>7} in all", mask.sum())?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
