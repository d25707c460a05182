//! What does a mesh cost whose neighbours have numbers far apart, and what does reordering it save?
//!
//! A torus of 250,000 triangles, as it is made and with vertices and triangles shuffled: one Loop step to a million
//! triangles, building it, a search over all of it. The mesh is copied for each step, which is not timed; for
//! `loop/reordered-first` the reordering is.

use std::hint::black_box;

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use vvmesh::adaptive::Uniform;
use vvmesh::mesh::Permutation;
use vvmesh::query::Disk;
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId, shapes};

/// Puts a list into an order without order, the same in every run (Fisher and Yates, with Knuth's multiplier).
fn shuffle<T>(list: &mut [T]) {
    let mut state = 1_u64;
    for k in (1..list.len()).rev() {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        list.swap(k, (state >> 33) as usize % (k + 1));
    }
}

fn triangles(mesh: &Mesh) -> Vec<[u32; 3]> {
    mesh.triangles().map(|triangle| triangle.corners().map(|v| v.index() as u32)).collect()
}

fn refined(mut mesh: Mesh) -> Mesh {
    let mut history = History::new(&mesh, Keep::default());
    let (mut scratch, mut control) = (Scratch::new(), Control::default());
    Subdivider::new(Loop::default(), Uniform)
        .step(&mut mesh, &mut history, &Selection::empty(), &mut scratch, &mut control)
        .expect("a torus can be refined");
    mesh
}

fn locality(criterion: &mut Criterion) {
    let ordered = shapes::torus(500, 250, 2.0, 1.0);
    let mut order: Vec<VertexId> = ordered.vertices().collect();
    shuffle(&mut order);
    let shuffled = ordered.renumbered(&Permutation::new(order).expect("shuffling keeps every vertex"));
    let (reordered, _) = shuffled.reordered();
    let faces = ordered.face_count();

    let mut group = criterion.benchmark_group("locality");
    group.sample_size(10).throughput(Throughput::Elements(faces as u64));
    let mut shuffled_triangles = triangles(&shuffled);
    shuffle(&mut shuffled_triangles);
    let lists = [("ordered", &ordered, triangles(&ordered)), ("shuffled", &shuffled, shuffled_triangles)];
    for (name, mesh, triangles) in lists {
        group.bench_function(BenchmarkId::new("build", name), |bencher| {
            let build = |positions| Mesh::from_triangles(positions, &triangles).expect("a torus is a mesh");
            bencher.iter_batched(|| mesh.positions().to_vec(), build, BatchSize::PerIteration);
        });
    }
    group.bench_function("reorder", |bencher| bencher.iter_with_large_drop(|| shuffled.reordered()));
    for (name, mesh) in [("ordered", &ordered), ("shuffled", &shuffled), ("reordered", &reordered)] {
        let (mut disk, mut scratch) = (Disk::new(), Scratch::new());
        group.bench_function(BenchmarkId::new("search", name), |bencher| {
            bencher.iter(|| {
                disk.search(mesh.rotation(), [VertexId::new(0)], usize::MAX, &mut scratch);
                black_box(disk.vertices().len())
            });
        });
    }

    group.throughput(Throughput::Elements(4 * faces as u64));
    for (name, mesh) in [("ordered", &ordered), ("shuffled", &shuffled), ("reordered", &reordered)] {
        group.bench_function(BenchmarkId::new("loop", name), |bencher| {
            bencher.iter_batched(|| mesh.clone(), refined, BatchSize::PerIteration);
        });
    }
    group.bench_function(BenchmarkId::new("loop", "reordered-first"), |bencher| {
        bencher.iter_batched(|| (), |()| refined(shuffled.reordered().0), BatchSize::PerIteration);
    });
    group.finish();
}

criterion_group!(benches, locality);
criterion_main!(benches);
