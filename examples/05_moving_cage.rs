//! 5. A cage that moves: refined once, and afterwards one product of its subdivision matrix a frame.

use std::error::Error;
use std::io::{self, Write};

use vvmesh::adaptive::Incremental;
use vvmesh::glam::{DMat3, DVec3};
use vvmesh::limit::LoopLimit;
use vvmesh::matrix::SubdivisionMatrix;
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Disk};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId, shapes};

/// Refines the surroundings of a vertex twice. The matrix goes along.
fn refine(cage: &Mesh) -> Result<(Mesh, SubdivisionMatrix), Box<dyn Error>> {
    let (mut mesh, mut matrix) = (cage.clone(), SubdivisionMatrix::new(cage));
    let (mut history, mut scratch) = (History::new(cage, Keep::default()), Scratch::new());
    let mut selection = Disk::new(VertexId::new(0), 2).select(cage, &mut scratch)?;
    let subdivider = Subdivider::new(Loop::default(), Incremental::new(1)?);
    for _ in 0..2 {
        let mut control = Control { follower: Some(&mut matrix), ..Control::default() };
        selection = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut control)?.selection;
    }
    Ok((mesh, matrix))
}

/// Twists a cage about the axis z, frame by frame.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let mut cage = shapes::torus(12, 8, 2.0, 1.0);
    let rest = cage.positions().to_vec();
    let (mesh, matrix) = refine(&cage)?;
    let weights = matrix.weights();
    writeln!(
        out,
        "the matrix: {} rows, {} columns, {} nonzeros, {} bytes",
        weights.row_count(),
        weights.column_count(),
        weights.nonzero_count(),
        weights.memory_bytes()
    )?;
    let limit = matrix.limit(&mesh, &LoopLimit::default());
    let tangents = matrix.tangents(&mesh, &LoopLimit::default());
    for frame in 0..4 {
        let twist = |p: &DVec3| DMat3::from_rotation_z(0.2 * f64::from(frame) * p.z) * *p;
        let moved: Vec<DVec3> = rest.iter().map(twist).collect();

        // Each is one product: the refined mesh, its vertices on the limit surface, the normals there.
        let (refined, surface, normals) = (weights.apply(&moved), limit.apply(&moved), tangents.normals(&moved));

        cage.positions_mut().copy_from_slice(&moved);
        let (again, _) = refine(&cage)?;
        let deviation = refined.iter().zip(again.positions()).map(|(one, other)| one.distance(*other));
        let lift = surface.iter().zip(&refined).map(|(one, other)| one.distance(*other));
        writeln!(
            out,
            "frame {frame}: {} vertices, {:.0e} at most from refining again, {:.3} at most from the limit, {} normals",
            refined.len(),
            deviation.fold(0.0, f64::max),
            lift.fold(0.0, f64::max),
            normals.iter().flatten().count()
        )?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
