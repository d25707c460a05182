//! What does it cost to go to the limit: all vertices with and without normals, and points of the Loop surface on triangles
//! that are regular, have one extraordinary corner, or several, or one on a crease, near and far from that corner? And what
//! to know in advance how far it is, of a mesh whose vertices are regular, or none?

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use vvmesh::limit::{AnyLimit, ButterflyLimit, Limit, LimitSurface, LoopLimit, ModifiedButterflyLimit, Sqrt3Limit};
use vvmesh::mesh::VertexClass;
use vvmesh::predict::{DistanceBound, Estimate};
use vvmesh::scheme::LoopWeights;
use vvmesh::{Edge, Mesh, Triangle, VertexId, shapes};

fn vertices(criterion: &mut Criterion) {
    let mesh = shapes::torus(200, 100, 2.0, 1.0);
    let limits: [(&str, AnyLimit); 4] = [
        ("loop", LoopLimit::default().into()),
        ("butterfly", ButterflyLimit.into()),
        ("modified-butterfly", ModifiedButterflyLimit.into()),
        ("sqrt3", Sqrt3Limit.into()),
    ];
    let mut group = criterion.benchmark_group("limit");
    group.sample_size(20).throughput(Throughput::Elements(mesh.vertex_count() as u64));
    for (name, limit) in limits {
        group.bench_function(BenchmarkId::new("positions", name), |bencher| bencher.iter(|| limit.positions(&mesh)));
        group.bench_function(BenchmarkId::new("normals", name), |bencher| bencher.iter(|| limit.normals(&mesh)));
    }
}

/// A torus, one edge of which was turned: two vertices of valence 5 and two of 7. The triangles: regular, with one of them,
/// with three.
fn turned() -> (Mesh, [(&'static str, Triangle); 3]) {
    let mut mesh = shapes::torus(20, 20, 2.0, 1.0);
    let edge = mesh.edges().nth(300).expect("a torus has more edges");
    let [a, b] = edge.ends();
    mesh.flip(a, b).expect("no two corners of the torus opposite to an edge are neighbours");
    let irregular = |triangle: &Triangle| triangle.corners().iter().filter(|&&v| mesh.ring(v).valence() != 6).count();
    let with = |count: usize| mesh.triangles().find(|triangle| irregular(triangle) == count).expect("there is one");
    let triangles = [("regular", with(0)), ("extraordinary", with(1)), ("three-extraordinary", with(3))];
    (mesh, triangles)
}

/// A torus with a crease of three edges that turns, so that beside its middle are not three faces but two and four.
fn creased() -> (Mesh, [(&'static str, Triangle); 1]) {
    let mut mesh = shapes::torus(20, 20, 2.0, 1.0);
    let v = VertexId::new(210);
    let ring = mesh.ring(v).neighbors().to_vec();
    for w in [ring[0], ring[2]] {
        mesh.set_sharp(Edge::new(v, w), true);
    }
    (mesh, [("crease", Triangle::new(v, ring[0], ring[1]))])
}

fn points(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("surface");
    let (turned, creased) = (turned(), creased());
    let all = [(&turned.0, &turned.1[..]), (&creased.0, &creased.1[..])];
    for (mesh, triangles) in all {
        let surface = LimitSurface::new(mesh, LoopWeights::Loop);
        for &(name, triangle) in triangles {
            group.bench_function(BenchmarkId::new("patch", name), |bencher| bencher.iter(|| surface.patch(triangle)));
            let patch = surface.patch(triangle).expect("the triangle is one of the mesh");
            let around = mesh.neighborhood();
            let irregular = |&v: &VertexId| mesh.ring(v).valence() != 6 || around.class(v) == VertexClass::Crease;
            let corner = triangle.corners().iter().position(irregular).unwrap_or(0);
            for (place, distance) in [("far", 0.6), ("near", 0.6 / f64::from(1 << 20))] {
                let mut at = [0.5 * distance; 3];
                at[corner] = 1.0 - distance;
                let id = BenchmarkId::new(format!("point-{place}"), name);
                group.bench_function(id, |bencher| bencher.iter(|| patch.evaluate(at[0], at[1])));
            }
        }
    }
}

fn foretold(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("predict");
    let regular = shapes::torus(100, 100, 2.0, 1.0);
    // Every vertex a corner, each of which is followed.
    let mut irregular = regular.clone();
    regular.vertices().for_each(|v| assert!(irregular.set_corner(v, true)));
    group.sample_size(20).throughput(Throughput::Elements(regular.vertex_count() as u64));
    for (name, mesh) in [("regular", &regular), ("irregular", &irregular)] {
        group.bench_function(BenchmarkId::new("estimate", name), |bencher| {
            bencher.iter(|| Estimate::new(mesh, LoopWeights::Loop));
        });
        group.bench_function(BenchmarkId::new("bound", name), |bencher| {
            bencher.iter(|| DistanceBound::new(mesh, LoopWeights::Loop));
        });
    }
}

criterion_group!(benches, vertices, points, foretold);
criterion_main!(benches);
