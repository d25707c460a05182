//! Does a step on a region cost what the region costs, whatever the size of the mesh?
//!
//! Incremental Loop steps on a disk of radius 3, which refine a region of radius 4 with 96 triangles, in tori of ten
//! thousand, a hundred thousand and a million triangles. Every step is at another place, chosen at random, so that neither
//! rings nor positions are in the cache because the step before used them. A step changes the mesh; when a tenth of it was
//! refined, it is replaced by a fresh copy. Copying is not timed, selecting the disk is.

use std::time::{Duration, Instant};

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use vvmesh::adaptive::Incremental;
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion as _, Disk};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId, shapes};

/// A sequence of places, the same in every run (Knuth's multiplier of a linear congruence, the upper bits).
struct Places(u64);

impl Places {
    fn next(&mut self, mesh: &Mesh) -> VertexId {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        VertexId::new((self.0 >> 33) as usize % mesh.vertex_count())
    }
}

fn adaptive(criterion: &mut Criterion) {
    let subdivider = Subdivider::new(Loop::default(), Incremental::new(1).expect("one ring is allowed"));
    let mut group = criterion.benchmark_group("adaptive/disk-of-96");
    group.sample_size(50).measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_secs(1));
    for (along, around) in [(100, 50), (316, 158), (1000, 500), (3162, 1581)] {
        let coarse = shapes::torus(along, around, 2.0, 1.0);
        let fresh = History::new(&coarse, Keep::default());
        let (mut places, mut scratch, mut control) = (Places(1), Scratch::new(), Control::default());
        let steps_a_copy = coarse.face_count() as u64 / 1000;
        // Room for the growing mesh's marks; they are made once in a program's life.
        let _ = scratch.marks(2 * coarse.vertex_count(), 1);
        group.bench_function(BenchmarkId::from_parameter(coarse.face_count()), |bencher| {
            bencher.iter_custom(|iterations| {
                let mut spent = Duration::ZERO;
                let mut left = iterations;
                while left > 0 {
                    // One step before the clock is read: the first growth of a copied vector moves all of it.
                    let (mut mesh, mut history) = (coarse.clone(), fresh.clone());
                    let mut step = |mesh: &mut Mesh| {
                        let center = places.next(&coarse);
                        let start = Instant::now();
                        let selection =
                            Disk::new(center, 3).select(mesh, &mut scratch).expect("the vertex is one of the mesh");
                        let step = subdivider
                            .step(mesh, &mut history, &selection, &mut scratch, &mut control)
                            .expect("a torus can be refined");
                        step.recycle(&mut scratch);
                        start.elapsed()
                    };
                    step(&mut mesh);
                    for _ in 0..left.min(steps_a_copy) {
                        spent += step(&mut mesh);
                    }
                    left -= left.min(steps_a_copy);
                }
                spent
            });
        });
    }
    group.finish();
}

criterion_group!(benches, adaptive);
criterion_main!(benches);
