//! 8. How deep for an accuracy: what is estimated, what is proven, and what is so.

use std::error::Error;
use std::io::{self, Write};

use vvmesh::adaptive::Uniform;
use vvmesh::predict::{DistanceBound, Estimate, FullSize, Measured};
use vvmesh::scheme::{Loop, LoopWeights};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Accuracy, shapes};

/// Foretells the distance of an icosahedron to its limit surface, and measures it level by level.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let (mut mesh, weights, accuracy) = (shapes::icosahedron(), LoopWeights::Loop, Accuracy::new(0.005)?);
    let (estimate, bound) = (Estimate::new(&mesh, weights)?, DistanceBound::new(&mesh, weights)?);
    let depths = [Some(estimate.depth(accuracy)), bound.depth(accuracy)];
    for (depth, word) in depths.into_iter().zip(["estimated", "proven"]) {
        let depth = depth.ok_or("no depth has this accuracy")?;
        let size = FullSize::new(&mesh, depth).ok_or("too many faces")?;
        writeln!(out, "depth {depth} with {} faces is {word} for {}", size.faces, accuracy.distance())?;
    }

    writeln!(out, "depth  estimated  measured    proven")?;
    let estimated = [0, 1, 2, 3, 4].map(|depth| estimate.greatest_distance() * estimate.contraction().powi(depth));
    let subdivider = Subdivider::new(Loop::new(weights), Uniform);
    let (mut history, mut scratch) = (History::new(&mesh, Keep::default()), Scratch::new());
    for (depth, estimated) in (0..).zip(estimated) {
        let measured = Measured::new(&mesh, weights, 4)?.distance;
        writeln!(out, "{depth:5}  {estimated:9.6} {measured:9.6} {:9.6}", bound.at(depth))?;
        subdivider.step(&mut mesh, &mut history, &Selection::empty(), &mut scratch, &mut Control::default())?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
