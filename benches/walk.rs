//! What does it cost to walk over rings: all edges, all triangles, a sum round every vertex, a disk, a search over
//! everything by this crate and by petgraph, and seeing that all of it is sound?

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use petgraph::visit::{Bfs, Walker};
use vvmesh::glam::DVec3;
use vvmesh::scratch::Scratch;
use vvmesh::{Mesh, VertexId, petgraph, query, shapes};

/// For every vertex the sum of the ways to its neighbours: a Laplacian with equal weights.
fn laplacian(mesh: &Mesh, sums: &mut [DVec3]) {
    for (v, sum) in mesh.vertices().zip(sums) {
        let p = mesh.position(v);
        *sum = mesh.ring(v).iter().map(|w| mesh.position(w) - p).sum();
    }
}

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
    group.bench_function(BenchmarkId::new("validate", faces), |bencher| {
        bencher.iter(|| assert!(rotation.validate().is_empty()));
    });
    group.bench_function(BenchmarkId::new("validate-triangles", faces), |bencher| {
        bencher.iter(|| assert!(rotation.validate_triangles().is_empty()));
    });

    group.throughput(Throughput::Elements(mesh.vertex_count() as u64));
    let mut sums = vec![DVec3::ZERO; mesh.vertex_count()];
    group.bench_function(BenchmarkId::new("laplacian", faces), |bencher| {
        bencher.iter(|| {
            laplacian(&mesh, &mut sums);
            black_box(&mut sums);
        });
    });
    let start = VertexId::new(0);
    let (mut disk, mut scratch) = (query::Disk::new(), Scratch::new());
    group.bench_function(BenchmarkId::new("search-disk", faces), |bencher| {
        bencher.iter(|| {
            disk.search(rotation, [start], usize::MAX, &mut scratch);
            assert_eq!(disk.vertices().len(), mesh.vertex_count());
        });
    });
    group.bench_function(BenchmarkId::new("search-petgraph", faces), |bencher| {
        bencher.iter(|| assert_eq!(Bfs::new(rotation, start).iter(rotation).count(), mesh.vertex_count()));
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
