//! How long does uniform refinement take for each face of the result?
//!
//! A torus of 5,120 triangles is refined to 1.3 million by four steps, by five of √3 to 1.2 million, by eight of 4-8. Beside it stand plain copies of as many bytes as the
//! result holds: into memory that is asked for anew, as for a growing mesh, and into memory that was touched before. All on
//! one thread; `threads` compares.

#![allow(clippy::print_stdout, reason = "the memory is told beside the times")]

use std::hint::black_box;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use vvmesh::adaptive::Uniform;
use vvmesh::scheme::{AnyScheme, Butterfly, FourEight, Loop, Midpoint, ModifiedButterfly, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, shapes};

/// It keeps what was given back for a second, so that a run finds pages that were touched before.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const STEPS: u32 = 4;

fn refined(subdivider: &Subdivider, steps: u32, mut mesh: Mesh) -> Mesh {
    let mut history = History::new(&mesh, Keep::default());
    let (mut scratch, mut control) = (Scratch::new(), Control::default());
    for _ in 0..steps {
        subdivider
            .step(&mut mesh, &mut history, &Selection::empty(), &mut scratch, &mut control)
            .expect("a torus can be refined");
    }
    mesh
}

fn uniform(criterion: &mut Criterion) {
    rayon::ThreadPoolBuilder::new().num_threads(1).build_global().expect("no pool was made before");
    let coarse = shapes::torus(80, 32, 2.0, 1.0);
    let mut group = criterion.benchmark_group("uniform");
    group.sample_size(10);

    // Each with how many steps it makes and how many triangles of one.
    let schemes: [(&str, AnyScheme, u32, usize); 6] = [
        ("loop", Loop::default().into(), STEPS, 4),
        ("butterfly", Butterfly.into(), STEPS, 4),
        ("modified-butterfly", ModifiedButterfly.into(), STEPS, 4),
        ("midpoint", Midpoint.into(), STEPS, 4),
        ("sqrt3", Sqrt3::default().into(), 5, 3),
        ("four-eight", FourEight::default().into(), 2 * STEPS, 2),
    ];
    for (name, scheme, steps, children) in schemes {
        let subdivider = Subdivider::new(scheme, Uniform);
        let faces = coarse.face_count() * children.pow(steps);
        group.throughput(Throughput::Elements(faces as u64));
        group.bench_function(BenchmarkId::new(name, faces), |bencher| {
            bencher.iter_batched(|| coarse.clone(), |mesh| refined(&subdivider, steps, mesh), BatchSize::PerIteration);
        });
    }

    let faces = coarse.face_count() * 4_usize.pow(STEPS);
    group.throughput(Throughput::Elements(faces as u64));
    let result = refined(&Subdivider::new(Loop::default(), Uniform), STEPS, coarse.clone());
    assert_eq!(result.face_count(), faces);
    let rings = result.rotation().memory_bytes();
    println!(
        "uniform/memory: {faces} faces, {:.1} bytes a vertex for the rings, {:.1} with positions",
        rings as f64 / result.vertex_count() as f64,
        result.memory_bytes() as f64 / result.vertex_count() as f64
    );
    let bytes = vec![1_u8; result.memory_bytes()];
    group.bench_function(BenchmarkId::new("copy-fresh", faces), |bencher| {
        bencher.iter_with_large_drop(|| black_box(&bytes).clone());
    });
    let mut touched = bytes.clone();
    group.bench_function(BenchmarkId::new("copy-touched", faces), |bencher| {
        bencher.iter(|| {
            touched.copy_from_slice(black_box(&bytes));
            black_box(&mut touched);
        });
    });
    group.finish();
}

criterion_group!(benches, uniform);
criterion_main!(benches);
