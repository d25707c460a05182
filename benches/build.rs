//! How long does it take to make a mesh of triangles, to find that it is none, and to check it?

use criterion::{BatchSize, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use vvmesh::soup::FaceList;
use vvmesh::{Mesh, check, shapes};

fn build(criterion: &mut Criterion) {
    let list = shapes::torus(1000, 500, 2.0, 1.0).to_face_list();
    let faces = list.face_count();
    let mut broken = list.clone();
    broken.push_face(&[0, 1, 2]);

    let mut group = criterion.benchmark_group("build");
    group.sample_size(10).throughput(Throughput::Elements(faces as u64));
    let mesh_of = |list: &FaceList| Mesh::from_face_list(list);
    group.bench_function(BenchmarkId::new("mesh", faces), |bencher| {
        bencher.iter_with_large_drop(|| mesh_of(&list).expect("a torus is a mesh"));
    });
    group.bench_function(BenchmarkId::new("refused", faces), |bencher| {
        bencher.iter_with_large_drop(|| mesh_of(&broken).expect_err("a face too much is on an edge"));
    });
    group.bench_function(BenchmarkId::new("conformity", faces), |bencher| {
        bencher.iter_batched(|| (), |()| check::conformity(&list, None), BatchSize::PerIteration);
    });
    let mesh = mesh_of(&list).expect("a torus is a mesh");
    group.bench_function(BenchmarkId::new("mesh-conformity", faces), |bencher| {
        bencher.iter_batched(|| (), |()| check::mesh_conformity(&mesh, None), BatchSize::PerIteration);
    });
    group.finish();
}

criterion_group!(benches, build);
criterion_main!(benches);
