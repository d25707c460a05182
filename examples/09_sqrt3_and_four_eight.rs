//! 9. Finer steps: √3 makes three triangles of one, and 4-8 two, where Loop makes four.

use std::error::Error;
use std::io::{self, Write};

use vvmesh::adaptive::{AdaptiveMethod, Incremental, Uniform};
use vvmesh::scheme::{AnyScheme, FourEight, Loop, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Disk};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId, shapes};

struct Refined {
    mesh: Mesh,
    history: History,
    /// How many faces there were before the first step and after each.
    faces: Vec<usize>,
    /// How many cracks were closed, each by an edge that no mask made.
    closed: usize,
}

/// Refines a torus, or the surroundings of its first vertex.
fn refine(scheme: AnyScheme, method: impl AdaptiveMethod + 'static, steps: usize) -> Result<Refined, Box<dyn Error>> {
    let (mut mesh, mut scratch) = (shapes::torus(12, 8, 2.0, 1.0), Scratch::new());
    let mut history = History::new(&mesh, Keep { names: true, ..Keep::default() });
    let mut selection = Disk::new(VertexId::new(0), 1).select(&mesh, &mut scratch)?;
    let (mut faces, mut closed) = (vec![mesh.face_count()], 0);
    let subdivider = Subdivider::new(scheme, method);
    for _ in 0..steps {
        let step = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default())?;
        faces.push(mesh.face_count());
        closed += step.t_vertices.len();
        selection = step.selection;
    }
    Ok(Refined { mesh, history, faces, closed })
}

/// Tells how fast meshes grow, how many cracks have to be closed at the border of a region, and what new vertices are made of.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let schemes: [(&str, AnyScheme, usize); 3] = [
        ("Loop", Loop::default().into(), 2),
        ("√3", Sqrt3::default().into(), 3),
        ("4-8", FourEight::default().into(), 4),
    ];
    for (name, scheme, steps) in schemes {
        let whole = refine(scheme.clone(), Uniform, steps)?;
        let part = refine(scheme, Incremental::new(1)?, steps)?;
        let new = VertexId::new(part.history.input_count());
        let parents = part.history.parents(new).ok_or("names are kept")?;
        writeln!(
            out,
            "{name}: {:?} faces, {:?} around a vertex with {} cracks to close; {new} is made of {parents}; valence {} at most",
            whole.faces,
            part.faces,
            part.closed,
            whole.mesh.vertices().map(|v| whole.mesh.ring(v).valence()).max().unwrap_or(0)
        )?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
