//! How much faster is work on a whole mesh on two threads than on one?
//!
//! A mesh of 1.3 million triangles, of √3 one million. The same work is done on one thread and on two in turns, as a machine's speed drifts; told
//! are the best times and their ratio. The rows of the machine say what it gives at most: to arithmetic in registers, and to
//! adding in place in memory of a size that its second cache holds, its third, or none.
//! `cargo bench --bench threads -- NAME` measures what has the name in its own; `--test` does everything once.

#![allow(clippy::print_stdout, reason = "the ratios are the result")]

use std::hint::black_box;
use std::time::{Duration, Instant};

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use vvmesh::adaptive::Uniform;
use vvmesh::check::{conformity, mesh_conformity};
use vvmesh::glam::DVec3;
use vvmesh::limit::{Limit, LoopLimit};
use vvmesh::scheme::{AnyScheme, Butterfly, FourEight, Loop, Midpoint, ModifiedButterfly, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Dihedral, Selection, Sphere};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Angle, Mesh, shapes};

/// It keeps what was given back for a second, so that a run finds pages that were touched before.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const ROUNDS: usize = 40;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let rounds = if arguments.iter().any(|argument| argument == "--test") { 1 } else { ROUNDS };
    let wanted = arguments.into_iter().find(|argument| !argument.starts_with('-')).unwrap_or_default();
    let pools =
        [1, 2].map(|threads| ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started"));
    let measure = |name: &str, work: &mut dyn FnMut(&ThreadPool) -> Duration| {
        if !name.contains(&wanted) {
            return;
        }
        let mut best = [Duration::MAX; 2];
        for _ in 0..rounds {
            for (best, pool) in best.iter_mut().zip(&pools) {
                *best = work(pool).min(*best);
            }
        }
        let [one, two] = best.map(|time| 1e3 * time.as_secs_f64());
        println!("threads/{name}: {one:.1} ms on one, {two:.1} ms on two, {:.2} times as fast", one / two);
    };

    measure("machine-arithmetic", &mut |pool| timed(pool, || (0..64_u64).into_par_iter().map(churn).sum::<u64>()));
    for (name, bytes) in [("cache-2", 1 << 19), ("cache-3", 1 << 23), ("memory", 1 << 26)] {
        // Each of two halves is of that size; so often that all is the same work.
        let (half, times) = (bytes / size_of::<u64>(), (1 << 27) / bytes);
        let mut numbers = vec![1_u64; 2 * half];
        measure(&format!("machine-{name}"), &mut |pool| {
            timed(pool, || {
                numbers.par_chunks_mut(half).for_each(|half| {
                    for k in 0..times {
                        half.iter_mut().for_each(|number| *number = number.wrapping_add(k as u64));
                        black_box(&mut *half);
                    }
                });
            })
        });
    }

    let coarse = shapes::torus(640, 256, 2.0, 1.0);
    // Each with how many steps are made before: the first one of 4-8 pairs the triangles.
    let schemes: [(&str, AnyScheme, usize); 6] = [
        ("loop", Loop::default().into(), 0),
        ("butterfly", Butterfly.into(), 0),
        ("modified-butterfly", ModifiedButterfly.into(), 0),
        ("midpoint", Midpoint.into(), 0),
        ("sqrt3", Sqrt3::default().into(), 0),
        ("four-eight", FourEight::default().into(), 1),
    ];
    for (name, scheme, steps_before) in schemes {
        let subdivider = Subdivider::new(scheme, Uniform);
        let (mut fresh, mut history) = (coarse.clone(), History::new(&coarse, Keep::default()));
        for _ in 0..steps_before {
            refine(&subdivider, &mut fresh, &mut history);
        }
        measure(&format!("uniform-{name}"), &mut |pool| {
            let (mut mesh, mut history) = (fresh.clone(), history.clone());
            timed(pool, || refine(&subdivider, &mut mesh, &mut history))
        });
    }

    let (mut mesh, mut history) = (coarse.clone(), History::new(&coarse, Keep::default()));
    refine(&Subdivider::new(Loop::default(), Uniform), &mut mesh, &mut history);
    let list = mesh.to_face_list();
    let sphere = Sphere::new(DVec3::X, 2.0).expect("a radius");
    let folded = Dihedral::new(Angle::from_deg(0.5)).expect("an angle");
    let triangles: Vec<[u32; 3]> =
        mesh.triangles().map(|triangle| triangle.corners().map(|v| v.index() as u32)).collect();
    measure("build", &mut |pool| {
        let positions = list.positions.clone();
        timed(pool, || Mesh::from_triangles(positions, &triangles))
    });
    measure("validate", &mut |pool| timed(pool, || mesh.rotation().validate_triangles()));
    measure("conformity", &mut |pool| timed(pool, || conformity(&list, None)));
    measure("mesh-conformity", &mut |pool| timed(pool, || mesh_conformity(&mesh, None)));
    measure("limit", &mut |pool| timed(pool, || LoopLimit::default().positions(&mesh)));
    for (name, criterion) in [("sphere", &sphere as &(dyn Criterion + Sync)), ("dihedral", &folded)] {
        measure(&format!("select-{name}"), &mut |pool| timed(pool, || criterion.select(&mesh, &mut Scratch::new())));
    }
}

/// Arithmetic that needs no memory and can not be cut short.
fn churn(seed: u64) -> u64 {
    (0..1 << 17).fold(seed, |state, k| black_box(state).wrapping_mul(6_364_136_223_846_793_005).wrapping_add(k))
}

fn timed<T: Send>(pool: &ThreadPool, work: impl FnOnce() -> T + Send) -> Duration {
    pool.install(|| {
        let start = Instant::now();
        let result = black_box(work());
        let time = start.elapsed();
        drop(result);
        time
    })
}

fn refine(subdivider: &Subdivider, mesh: &mut Mesh, history: &mut History) {
    subdivider
        .step(mesh, history, &Selection::empty(), &mut Scratch::new(), &mut Control::default())
        .expect("a torus can be refined");
}
