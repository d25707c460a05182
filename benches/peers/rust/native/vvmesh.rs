//! vvmesh itself.

use std::error::Error;

use vvmesh::adaptive::{Incremental, Uniform};
use vvmesh::glam::DVec3;
use vvmesh::scheme::{AnyScheme, Loop, ModifiedButterfly};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Disk, Selection};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId};

use super::{Measured, Search, timed};
use crate::answer::Answer;
use crate::raw::RawMesh;
use crate::task::{LOCAL_STEPS, Task, place};
use crate::workload::LEVELS;

pub(super) fn run(task: Task, input: &RawMesh, seconds: f64) -> Result<Option<Measured>, Box<dyn Error>> {
    let positions: Vec<DVec3> = input.positions.iter().map(|&p| DVec3::from_array(p)).collect();
    let mesh = Mesh::from_triangles(positions.clone(), &input.triangles)?;
    Ok(Some(match task {
        Task::Loop4 => refined(&mesh, Loop::default(), LEVELS, seconds),
        Task::Loop1 | Task::Shuffled => refined(&mesh, Loop::default(), 1, seconds),
        Task::Butterfly4 => refined(&mesh, ModifiedButterfly, LEVELS, seconds),
        Task::Build => {
            let (samples, _) = timed(
                seconds,
                || (positions.clone(), None),
                |(positions, built)| {
                    let built_now = Mesh::from_triangles(std::mem::take(positions), &input.triangles);
                    *built = Some(built_now.expect("the mesh was built before"));
                },
            );
            on(&mesh, samples, Vec::new())
        }
        Task::Laplacian => {
            let (samples, sums) = timed(
                seconds,
                || vec![DVec3::ZERO; mesh.vertex_count()],
                |sums| {
                    for (v, sum) in mesh.vertices().zip(sums) {
                        let here = mesh.position(v);
                        *sum = mesh.ring(v).neighbors().iter().map(|&w| mesh.position(w) - here).sum();
                    }
                },
            );
            on(&mesh, samples, flat(&sums))
        }
        Task::Search => {
            let neighbors = |v: u32| mesh.ring(VertexId::new(v as usize)).neighbors().iter().map(|w| w.index() as u32);
            let (samples, search) = timed(seconds, || Search::new(mesh.vertex_count()), |search| search.run(neighbors));
            on(&mesh, samples, search.result())
        }
        Task::Local => local(&mesh, seconds),
        Task::Validity => {
            let (samples, defects) =
                timed(seconds, || 0, |defects| *defects = mesh.rotation().validate_triangles().len());
            assert_eq!(defects, 0, "a mesh has no defects");
            on(&mesh, samples, Vec::new())
        }
        Task::Memory => on(&mesh, vec![mesh.memory_bytes() as f64], Vec::new()),
        _ => return Ok(None),
    }))
}

fn on(mesh: &Mesh, samples: Vec<f64>, result: Vec<f64>) -> Measured {
    Measured { answer: Answer { faces: mesh.face_count(), samples, ..Answer::default() }, result }
}

fn flat(points: &[DVec3]) -> Vec<f64> {
    points.iter().flat_map(|p| p.to_array()).collect()
}

fn refined(mesh: &Mesh, scheme: impl Into<AnyScheme>, levels: usize, seconds: f64) -> Measured {
    let subdivider = Subdivider::new(scheme, Uniform);
    let (samples, mesh) = timed(
        seconds,
        || mesh.clone(),
        |mesh| {
            let mut history = History::new(mesh, Keep::default());
            let (mut scratch, mut control) = (Scratch::new(), Control::default());
            for _ in 0..levels {
                subdivider
                    .step(mesh, &mut history, &Selection::empty(), &mut scratch, &mut control)
                    .expect("a mesh of finite size can be refined");
            }
        },
    );
    let result = flat(mesh.positions());
    on(&mesh, samples, result)
}

/// A mesh that is refined here and there, with what one keeps between steps.
struct Local {
    mesh: Mesh,
    history: History,
    scratch: Scratch,
    subdivider: Subdivider,
}

impl Local {
    fn step(&mut self, center: usize) {
        let disk = Disk::new(VertexId::new(center), 3);
        let selection = disk.select(&self.mesh, &mut self.scratch).expect("the vertex is one of the mesh");
        self.subdivider
            .step(&mut self.mesh, &mut self.history, &selection, &mut self.scratch, &mut Control::default())
            .expect("a disk of a mesh can be refined");
    }
}

fn local(coarse: &Mesh, seconds: f64) -> Measured {
    let vertices = coarse.vertex_count();
    let (samples, local) = timed(
        seconds,
        || {
            let mut local = Local {
                mesh: coarse.clone(),
                history: History::new(coarse, Keep::default()),
                scratch: Scratch::new(),
                subdivider: Subdivider::new(Loop::default(), Incremental::new(1).expect("one ring is allowed")),
            };
            // What happens once in the life of a mesh is not timed: the marks are made, and the first growth of the copied
            // vectors moves all of them.
            let _ = local.scratch.marks(2 * vertices, 1);
            local.step(place(0, vertices));
            local
        },
        |local| (1..=LOCAL_STEPS).for_each(|k| local.step(place(k, vertices))),
    );
    let samples = samples.into_iter().map(|sample| sample / LOCAL_STEPS as f64).collect();
    on(&local.mesh, samples, Vec::new())
}
