//! What does it cost to walk over rings: all edges, all triangles, a disk, a neighbour after another?

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use vvmesh::scratch::Scratch;
use vvmesh::{VertexId, query, shapes};

fn walk(criterion: &mut Criterion) {
    let mesh = shapes::torus(1000, 500, 2.0, 1.0);
    let rotation = mesh.rotation();
    let faces = mesh.face_count();

    let mut group = criterion.benchmark_group("walk");
    group.sample_size(20).throughput(Throughput::Elements(faces as u64));
    group.bench_function(BenchmarkId::new("triangles", faces), |bencher| {
        bencher.iter(|| rotation.triangles().fold(0, |sum, triangle| sum ^ triangle.corners()[1].index()));
    });
    group.bench_function(BenchmarkId::new("edges", faces), |bencher| {
        bencher.iter(|| rotation.edges().fold(0, |sum, edge| sum ^ edge.ends()[1].index()));
    });
    group.bench_function(BenchmarkId::new("left-of-each-edge", faces), |bencher| {
        let left = |edge: vvmesh::DirectedEdge| rotation.left_of(edge.from, edge.to).map_or(0, VertexId::index);
        bencher.iter(|| rotation.directed_edges().fold(0, |sum, edge| sum ^ left(edge)));
    });
    group.finish();

    let mut group = criterion.benchmark_group("walk/disk");
    for radius in [1, 4, 16] {
        let mut scratch = Scratch::new();
        let (mut disk, mut center) = (query::Disk::new(), 0);
        group.throughput(Throughput::Elements(1 + 3 * radius * (radius + 1)));
        group.bench_function(BenchmarkId::new("radius", radius), |bencher| {
            bencher.iter(|| {
                center = (center + 7919) % mesh.vertex_count();
                disk.search(rotation, [VertexId::new(center)], radius as usize, &mut scratch);
                black_box(disk.vertices().len())
            });
        });
    }
    group.finish();
}

criterion_group!(benches, walk);
criterion_main!(benches);
