//! alum: half-edges in Rust, after OpenMesh.

use std::error::Error;
use std::fs;

use alum::{DVec3, Handle, HasIterators, HasTopology, PolyMeshF64, VH};

use super::{Measured, Search, timed};
use crate::answer::Answer;
use crate::raw::RawMesh;
use crate::task::Task;
use crate::workload::LEVELS;

pub(super) fn run(task: Task, input: &RawMesh, seconds: f64) -> Result<Option<Measured>, Box<dyn Error>> {
    let positions: Vec<DVec3> = input.positions.iter().map(|&[x, y, z]| DVec3(x, y, z)).collect();
    let build = || build(&positions, &input.triangles);
    Ok(Some(match task {
        Task::Loop4 => refined(build(), LEVELS, seconds),
        Task::Loop1 | Task::Shuffled => refined(build(), 1, seconds),
        Task::Build => {
            let (samples, mesh) = timed(seconds, PolyMeshF64::new, |mesh| *mesh = build());
            on(&mesh, samples, Vec::new())
        }
        Task::Laplacian => {
            let mesh = build();
            let points = mesh.points();
            let points = points.try_borrow().expect("nothing of the mesh is borrowed");
            let (samples, sums) = timed(
                seconds,
                || vec![DVec3(0.0, 0.0, 0.0); mesh.num_vertices()],
                |sums| {
                    for (v, sum) in mesh.vertices().zip(sums) {
                        let here = points[v];
                        *sum = mesh.vv_ccw_iter(v).fold(*sum, |sum, w| sum + (points[w] - here));
                    }
                },
            );
            on(&mesh, samples, flat(&sums))
        }
        Task::Search => {
            let mesh = build();
            let neighbors = |v: u32| mesh.vv_ccw_iter(VH::from(v)).map(|w| w.index());
            let (samples, search) = timed(seconds, || Search::new(mesh.num_vertices()), |search| search.run(neighbors));
            on(&mesh, samples, search.result())
        }
        Task::Validity => {
            let mesh = build();
            let (samples, ()) = timed(seconds, || (), |()| mesh.check_topology().expect("what was built is valid"));
            on(&mesh, samples, Vec::new())
        }
        Task::Memory => {
            let before = resident_bytes()?;
            let mesh = build();
            let mut measured = on(&mesh, vec![resident_bytes()? - before], Vec::new());
            measured.answer.note = "memory: growth of what is resident".to_owned();
            measured
        }
        _ => return Ok(None),
    }))
}

/// What is refused here is no mesh, and then vvmesh refused it before.
fn build(positions: &[DVec3], triangles: &[[u32; 3]]) -> PolyMeshF64 {
    let (vertices, faces) = (positions.len(), triangles.len());
    let mut mesh = PolyMeshF64::with_capacity(vertices, 3 * faces / 2, faces);
    mesh.add_vertices(positions).expect("nothing of the mesh is borrowed");
    for &[a, b, c] in triangles {
        mesh.add_tri_face(a.into(), b.into(), c.into()).expect("the input is a mesh");
    }
    mesh
}

fn on(mesh: &PolyMeshF64, samples: Vec<f64>, result: Vec<f64>) -> Measured {
    Measured { answer: Answer { faces: mesh.num_faces(), samples, ..Answer::default() }, result }
}

fn flat(points: &[DVec3]) -> Vec<f64> {
    points.iter().flat_map(|&DVec3(x, y, z)| [x, y, z]).collect()
}

fn refined(mesh: PolyMeshF64, levels: usize, seconds: f64) -> Measured {
    let (samples, mesh) = timed(
        seconds,
        || mesh.try_clone().expect("nothing of the mesh is borrowed"),
        |mesh| mesh.subdivide_loop(levels, true).expect("the input is a mesh of triangles"),
    );
    let points = mesh.points();
    let result = flat(&points.try_borrow().expect("nothing of the mesh is borrowed"));
    on(&mesh, samples, result)
}

/// What the system says that this process holds, in pages of 4096 bytes.
fn resident_bytes() -> Result<f64, Box<dyn Error>> {
    let pages = fs::read_to_string("/proc/self/statm")?;
    let resident: u32 = pages.split(' ').nth(1).unwrap_or_default().parse()?;
    Ok(4096.0 * f64::from(resident))
}
