//! Does a local step allocate nothing once it has run?

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

use vvmesh::adaptive::Incremental;
#[cfg(feature = "matrix")]
use vvmesh::matrix::SubdivisionMatrix;
use vvmesh::scheme::{AnyScheme, Butterfly, Loop, ModifiedButterfly, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId, query, shapes};

/// Allocations that a step may need: one for each ring that outgrows six entries.
fn long_rings(mesh: &Mesh) -> u64 {
    let long = |v: &VertexId| mesh.ring(*v).valence() + usize::from(mesh.ring(*v).is_open()) > 6;
    mesh.vertices().filter(long).count() as u64
}

/// Steps on disks all over a torus; answers for the last ten of thirty with the allocations and with those that long rings
/// explain. The first steps fill the scratch.
fn allocations(scheme: AnyScheme, keep: Keep, recycle: bool) -> Vec<(u64, u64)> {
    let mut mesh = shapes::torus(300, 60, 2.0, 1.0);
    let mut history = History::new(&mesh, keep);
    let subdivider = Subdivider::new(scheme, Incremental::new(1).unwrap());
    let mut scratch = Scratch::new();
    let mut found = Vec::new();
    for k in 0..30 {
        let center = VertexId::new(600 * k + 7);
        let disk = query::r_disk(mesh.rotation(), [center], 2, &mut scratch);
        let selection: Selection = disk.into_vertices().into_iter().collect();
        let before = long_rings(&mesh);
        let counted = allocation_counter::measure(|| {
            let control = &mut Control::default();
            let step = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, control).unwrap();
            assert_eq!((step.selected, step.region), (19, 37));
            if recycle {
                step.recycle(&mut scratch);
            }
        });
        found.push((counted.count_total, long_rings(&mesh) - before));
    }
    found.split_off(20)
}

/// A growing mesh moves to new memory when it has doubled, so hardly any step is free to.
fn growths(found: &[(u64, u64)]) -> usize {
    found.iter().filter(|(count, explained)| count > explained).count()
}

#[test]
fn a_step_allocates_only_for_long_rings_and_growth() {
    let schemes: [AnyScheme; 3] = [Loop::default().into(), Butterfly.into(), ModifiedButterfly.into()];
    for scheme in schemes {
        for names in [false, true] {
            let found = allocations(scheme.clone(), Keep { names, certificate: false }, true);
            // The mesh grows by a sixth in all, so it doubles in the first step and not again; each of the two lists of names
            // may double once in the last third.
            assert!(growths(&found) <= if names { 2 } else { 0 }, "{found:?}");
        }
    }
}

/// Its levels, a byte a new vertex, are a list that may double once in the last third.
#[test]
fn a_step_of_sqrt3_allocates_only_for_long_rings_and_growth() {
    let found = allocations(Sqrt3::default().into(), Keep::default(), true);
    assert!(growths(&found) <= 1, "{found:?}");
}

#[test]
fn without_recycling_every_step_allocates() {
    let found = allocations(Loop::default().into(), Keep::default(), false);
    assert_eq!(growths(&found), found.len(), "{found:?}");
}

/// A matrix that goes along takes memory for the rows that a step makes, whatever the number of those there are.
#[cfg(feature = "matrix")]
#[test]
fn a_matrix_grows_by_what_a_step_makes() {
    let mut mesh = shapes::torus(300, 60, 2.0, 1.0);
    let (mut history, mut scratch) = (History::new(&mesh, Keep::default()), Scratch::new());
    let mut matrix = SubdivisionMatrix::new(&mesh);
    let subdivider = Subdivider::new(Loop::default(), Incremental::new(1).unwrap());
    let mut bytes = Vec::new();
    for k in 0..30 {
        let disk = query::r_disk(mesh.rotation(), [VertexId::new(600 * k + 7)], 2, &mut scratch);
        let selection: Selection = disk.into_vertices().into_iter().collect();
        let counted = allocation_counter::measure(|| {
            let control = &mut Control { follower: Some(&mut matrix), ..Control::default() };
            subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, control).unwrap();
        });
        bytes.push(counted.bytes_total);
    }
    // The first step doubles all lists; after it hardly one does.
    let whole = matrix.weights().memory_bytes() as u64;
    assert!(bytes[1..].iter().filter(|&&bytes| bytes > whole / 50).count() <= 1, "{bytes:?} of {whole}");
}
