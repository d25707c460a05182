//! Does a step on a region cost what the region costs, whatever the size of the mesh?
//!
//! Incremental Loop steps on a disk of radius 3, which refine a region of radius 4 with 96 triangles, in tori of ten
//! thousand, a hundred thousand, a million and ten million triangles, and the same steps of √3 and 4-8 in a hundred thousand. Every step is at another place, chosen at random, so that neither
//! rings nor positions are in the cache because the step before used them. A step changes the mesh; when a tenth of it was
//! refined, it is replaced by a fresh copy. Copying is not timed, selecting the disk is.

use std::time::{Duration, Instant};

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, criterion_group, criterion_main};
use vvmesh::adaptive::Incremental;
use vvmesh::glam::DVec3;
use vvmesh::pick::Ray;
use vvmesh::scheme::{AnyScheme, FourEight, Loop, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion as _, Disk, Selection};
use vvmesh::step::{History, Keep};
use vvmesh::stroke::{Aim, Brush, Event, Pen, PenMethod, Radius};
use vvmesh::subdivide::{Control, Dynamic, Subdivider};
use vvmesh::{Mesh, VertexId, shapes};

/// A sequence of places, the same in every run (Knuth's multiplier of a linear congruence, the upper bits).
struct Places(u64);

impl Places {
    /// One of so many vertices.
    fn next(&mut self, vertices: usize) -> VertexId {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        VertexId::new((self.0 >> 33) as usize % vertices)
    }
}

fn adaptive(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("adaptive/disk-of-96");
    group.sample_size(50).measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_secs(1));
    for [along, around] in [[100, 50], [316, 158], [1000, 500], [3162, 1581]] {
        local_steps(&mut group, "loop", &Loop::default().into(), shapes::torus(along, around, 2.0, 1.0));
    }
    for (name, scheme) in [("sqrt3", Sqrt3::default().into()), ("four-eight", FourEight::default().into())] {
        local_steps(&mut group, name, &scheme, shapes::torus(316, 158, 2.0, 1.0));
    }
    group.finish();
}

fn local_steps(group: &mut BenchmarkGroup<'_, WallTime>, name: &str, scheme: &AnyScheme, mut coarse: Mesh) {
    let subdivider = Subdivider::new(scheme.clone(), Incremental::new(1).expect("one ring is allowed"));
    let (vertices, faces) = (coarse.vertex_count(), coarse.face_count());
    let (mut places, mut scratch, mut control) = (Places(1), Scratch::new(), Control::default());
    let steps_a_copy = faces as u64 / 1000;
    // Room for the growing mesh's marks; they are made once in a program's life.
    let _ = scratch.marks(2 * vertices, 1);
    let mut step = |mesh: &mut Mesh, history: &mut History| {
        let center = places.next(vertices);
        let start = Instant::now();
        let selection = Disk::new(center, 3).select(mesh, &mut scratch).expect("the vertex is one of the mesh");
        let step =
            subdivider.step(mesh, history, &selection, &mut scratch, &mut control).expect("a torus can be refined");
        step.recycle(&mut scratch);
        start.elapsed()
    };
    // The first step of 4-8 pairs all triangles.
    let mut fresh = History::new(&coarse, Keep::default());
    step(&mut coarse, &mut fresh);
    group.bench_function(BenchmarkId::new(name, faces), |bencher| {
        bencher.iter_custom(|iterations| {
            let mut spent = Duration::ZERO;
            let mut left = iterations;
            while left > 0 {
                // One step before the clock is read: the first growth of a copied vector moves all of it.
                let (mut mesh, mut history) = (coarse.clone(), fresh.clone());
                step(&mut mesh, &mut history);
                for _ in 0..left.min(steps_a_copy) {
                    spent += step(&mut mesh, &mut history);
                }
                left -= left.min(steps_a_copy);
            }
            spent
        });
    });
}

/// A pen goes 200 steps over a torus of a million faces; each refines what is near it by two levels more.
///
/// *dynamic* asks for the stars of a disk at level 2, at a place that overlaps with the one before, and gives those up that
/// the pen has left behind four places ago; *incremental* makes two steps there. The *drawn* ones are those of a [`Pen`], which
/// finds the place by a ray, touches what is near, refines it to level 2 or by one more level, and keeps the boxes around faces
/// up to date. The times of the single steps are printed, as their distribution is what a hand feels.
fn pen(criterion: &mut Criterion) {
    const STEPS: usize = 200;
    let coarse = shapes::torus(1000, 500, 2.0, 1.0);
    // Two vertices on, and now and then one to the side.
    let path: Vec<VertexId> = (0..STEPS).map(|k| VertexId::new((100 + 2 * k) * 500 + 100 + k / 7)).collect();
    let mut group = criterion.benchmark_group("adaptive/pen");
    group.sample_size(10);
    group.bench_function(BenchmarkId::new("dynamic", coarse.face_count()), |bencher| {
        bencher.iter_custom(|iterations| {
            let (dynamic, mut scratch) = (Dynamic::new(Loop::default()).expect("it splits in four"), Scratch::new());
            repeated(iterations, || {
                let (mut mesh, mut history) = (coarse.clone(), History::new(&coarse, Keep::default()));
                let disks: Vec<_> = path.iter().map(|&v| disk(&coarse, v, &mut scratch)).collect();
                let mut times = Vec::with_capacity(STEPS);
                for k in 0..disks.len() {
                    let start = Instant::now();
                    let (control, level) = (&mut Control::default(), 2);
                    dynamic.refine(&mut mesh, &mut history, &disks[k], level, &mut scratch, control).expect("a torus");
                    if let Some(left) = k.checked_sub(4).map(|left| &disks[left]) {
                        let held = near(&disks[k - 3..=k]);
                        let gone: Selection = left.vertices().iter().copied().filter(|&v| !held.contains(v)).collect();
                        dynamic.coarsen(&mut mesh, &mut history, &gone, level, &mut scratch).expect("it was asked for");
                    }
                    times.push(start.elapsed());
                }
                times
            })
        });
    });
    group.bench_function(BenchmarkId::new("incremental", coarse.face_count()), |bencher| {
        bencher.iter_custom(|iterations| {
            let subdivider = Subdivider::new(Loop::default(), Incremental::new(1).expect("one ring is allowed"));
            let mut scratch = Scratch::new();
            repeated(iterations, || {
                let (mut mesh, mut history) = (coarse.clone(), History::new(&coarse, Keep::default()));
                let mut times = Vec::with_capacity(STEPS);
                for &center in &path {
                    let start = Instant::now();
                    let mut selection = disk(&mesh, center, &mut scratch);
                    for _ in 0..2 {
                        let control = &mut Control::default();
                        let step = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, control);
                        selection = step.expect("a torus can be refined").selection;
                    }
                    times.push(start.elapsed());
                }
                times
            })
        });
    });
    for (name, method) in [("drawn-dynamic", PenMethod::Dynamic), ("drawn-incremental", PenMethod::Incremental)] {
        group.bench_function(BenchmarkId::new(name, coarse.face_count()), |bencher| {
            bencher.iter_custom(|iterations| repeated(iterations, || drawn(&coarse, &path, method)));
        });
    }
    group.finish();
}

/// The times of the events of a pen that is held above a path, each with another place to find.
fn drawn(coarse: &Mesh, path: &[VertexId], method: PenMethod) -> Vec<Duration> {
    let mut pen = Pen::new(coarse.clone(), Loop::default(), method).expect("it splits in four");
    // As far as three edges of the torus.
    let brush = Brush::new(Radius::Euclidean(0.045), 2, 0.0).expect("a sound brush");
    let draw = |(k, &v): (usize, &VertexId)| {
        // Not quite at a vertex, from above the torus.
        let above = coarse.position(v) + DVec3::new(1e-4, 2e-4, 3.0);
        let ray = Ray::new(above, DVec3::new(1e-3, 2e-3, -1.0)).expect("a direction");
        let event = Event { time: k as f64, aim: Aim::Along(ray), brush };
        let start = Instant::now();
        let touch = pen.touch(&event, &mut Control::default()).expect("a torus can be refined");
        let time = start.elapsed();
        assert!(touch.added > 0, "there is something left to refine in front of the pen");
        time
    };
    path.iter().enumerate().map(draw).collect()
}

fn disk(mesh: &Mesh, center: VertexId, scratch: &mut Scratch) -> Selection {
    Disk::new(center, 3).select(mesh, scratch).expect("the vertex is one of the mesh")
}

fn near(disks: &[Selection]) -> Selection {
    disks.iter().fold(Selection::empty(), |all, disk| all.union(disk))
}

/// Runs a stroke some times, prints how long its steps took, and answers the mean of a stroke times the runs.
#[expect(clippy::print_stdout, reason = "criterion tells of strokes, not of their steps")]
fn repeated(iterations: u64, mut stroke: impl FnMut() -> Vec<Duration>) -> Duration {
    let mut times: Vec<Duration> = (0..iterations).flat_map(|_| stroke()).collect();
    times.sort_unstable();
    let quantile = |part: usize| times[(times.len() * part / 100).min(times.len() - 1)];
    println!("a step: median {:?}, 99th percentile {:?}, greatest {:?}", quantile(50), quantile(99), quantile(100));
    times.iter().sum()
}

criterion_group!(benches, adaptive, pen);
criterion_main!(benches);
