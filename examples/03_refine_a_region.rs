//! 3. The main job: select, refine by a method, and compare with refining everything.

use std::error::Error;
use std::io::{self, Write};

use vvmesh::adaptive::{AdaptiveMethod, Incremental, Simple, Uniform};
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Disk, Selection};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId, check, shapes};

const LEVELS: usize = 3;

struct Refined {
    mesh: Mesh,
    history: History,
    selection: Selection,
}

fn refine(method: impl AdaptiveMethod + 'static) -> Result<Refined, Box<dyn Error>> {
    let mut mesh = shapes::torus(12, 8, 2.0, 1.0);
    let mut scratch = Scratch::new();
    let mut history = History::new(&mesh, Keep { names: true, ..Keep::default() });
    let mut selection = Disk::new(VertexId::new(0), 2).select(&mesh, &mut scratch)?;
    let subdivider = Subdivider::new(Loop::default(), method);
    for _ in 0..LEVELS {
        selection =
            subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default())?.selection;
    }
    Ok(Refined { mesh, history, selection })
}

/// Refines a disk of a torus by each method.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let uniform = refine(Uniform)?;
    for (name, refined) in [("simple", refine(Simple)?), ("incremental", refine(Incremental::new(1)?)?)] {
        let twins = refined.history.same_names(&uniform.history).ok_or("both runs keep names")?;
        let equal = |&&v: &&VertexId| {
            twins[v.index()].is_some_and(|twin| refined.mesh.position(v) == uniform.mesh.position(twin))
        };
        let selected = refined.selection.vertices();
        writeln!(
            out,
            "{name}: {} faces instead of {}; {} of {} selected vertices are where uniform refinement has them; {}",
            refined.mesh.face_count(),
            uniform.mesh.face_count(),
            selected.iter().filter(equal).count(),
            selected.len(),
            if check::mesh_conformity(&refined.mesh, None).is_conforming() { "conforming" } else { "not conforming" }
        )?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
