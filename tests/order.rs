//! Other vertex numbers: what comes back, and what refining makes of them.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use common::random::{Closed, Picks, Random, Surface, WithBoundary, check, semi_sharp};
use common::run::{MeshBits, Run, bits, renamed};
use vvmesh::adaptive::{Incremental, Uniform};
use vvmesh::mesh::{Permutation, SharpnessRule};
use vvmesh::query::r_disk;
use vvmesh::scheme::{AnyScheme, Butterfly, Loop, Midpoint, ModifiedButterfly};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::subdivide::Subdivider;
use vvmesh::{Mesh, VertexId, shapes};

/// Any permutation is as likely as another.
fn random_permutation(mesh: &Mesh, random: &mut Random) -> Permutation {
    let mut order: Vec<VertexId> = mesh.vertices().collect();
    for k in (1..order.len()).rev() {
        order.swap(k, random.below(k + 1));
    }
    Permutation::new(order).unwrap()
}

fn the_way_back_gives_the_same_mesh<S: Surface>(surface: S, seed: u32) {
    let mesh = semi_sharp(surface.mesh(), u64::from(seed), SharpnessRule::Chaikin);
    let permutation = random_permutation(&mesh, &mut Random::new(u64::from(seed)));
    let shuffled = mesh.renumbered(&permutation);
    assert_eq!(shuffled.tags().rule(), SharpnessRule::Chaikin);
    assert_eq!(shuffled.rotation().validate_triangles(), []);
    assert_eq!(MeshBits::of(&shuffled.renumbered(&permutation.inverse())), MeshBits::of(&mesh));
    for v in mesh.vertices() {
        let (here, there) = (mesh.ring(v), shuffled.ring(permutation.new_of(v)));
        assert!(here.is_open() == there.is_open());
        assert!(here.iter().map(|w| permutation.new_of(w)).eq(there));
        assert_eq!(bits(mesh.position(v)), bits(shuffled.position(permutation.new_of(v))));
    }
    let mut tagged: Vec<_> = mesh.tags().corners().into_iter().map(|v| permutation.new_of(v)).collect();
    tagged.sort_unstable();
    assert_eq!(tagged, shuffled.tags().corners());

    let (local, order) = shuffled.reordered();
    assert_eq!(MeshBits::of(&local.renumbered(&order.inverse())), MeshBits::of(&shuffled));
    // All that is reached from the first vertex comes as a search meets it.
    let first = r_disk(shuffled.rotation(), [VertexId::new(0)], usize::MAX, &mut Scratch::new());
    assert!(first.vertices().iter().enumerate().all(|(k, &v)| order.new_of(v) == VertexId::new(k)));
}

#[test]
fn renumbering_can_be_undone() {
    check(71, 60, the_way_back_gives_the_same_mesh::<Closed> as fn(Closed, u32));
    check(72, 60, the_way_back_gives_the_same_mesh::<WithBoundary> as fn(WithBoundary, u32));
}

/// After how many steps a mesh refined under other numbers still has the same bits; `steps` if they never differ.
fn steps_of_equal_bits(mesh: &Mesh, permutation: &Permutation, subdivider: &Subdivider, selected: &Selection) -> usize {
    let (mut one, mut other) = (Run::new(mesh), Run::new(&mesh.renumbered(permutation)));
    let input: Vec<VertexId> = mesh.vertices().map(|v| permutation.new_of(v)).collect();
    let mut selection = [selected.clone(), selected.vertices().iter().map(|&v| permutation.new_of(v)).collect()];
    for step in 0..STEPS {
        selection = [one.step(subdivider, &selection[0]).selection, other.step(subdivider, &selection[1]).selection];
        let same = renamed(&one, &other, &input);
        let equal = |v: VertexId| bits(one.mesh.position(v)) == bits(other.mesh.position(same[v.index()]));
        if !one.mesh.vertices().all(equal) {
            return step;
        }
    }
    STEPS
}

const STEPS: usize = 3;

/// The schemes with the number of steps whose bits do not depend on the numbers.
fn promised() -> [(AnyScheme, usize); 4] {
    [(Midpoint.into(), STEPS), (Loop::default().into(), 1), (Butterfly.into(), 0), (ModifiedButterfly.into(), 0)]
}

fn bits_are_those_promised<S: Surface>(surface: S, picks: Picks, seed: u32) {
    let mesh = surface.mesh();
    let permutation = random_permutation(&mesh, &mut Random::new(u64::from(seed)));
    for (scheme, promised) in promised() {
        let uniform = Subdivider::new(scheme.clone(), Uniform);
        assert!(steps_of_equal_bits(&mesh, &permutation, &uniform, &Selection::empty()) >= promised);
        let incremental = Subdivider::new(scheme, Incremental::new(1).unwrap());
        assert!(steps_of_equal_bits(&mesh, &permutation, &incremental, &picks.patch(&mesh)) >= promised);
    }
}

#[test]
fn some_schemes_give_the_same_bits_whatever_the_numbers() {
    check(73, 15, bits_are_those_promised::<Closed> as fn(Closed, Picks, u32));
    check(74, 15, bits_are_those_promised::<WithBoundary> as fn(WithBoundary, Picks, u32));
}

#[test]
fn no_more_is_promised_than_holds() {
    let mut random = Random::new(75);
    let mut mesh = shapes::torus(9, 6, 2.0, 1.0);
    for position in mesh.positions_mut() {
        *position += 0.1 * random.vector();
    }
    let permutation = random_permutation(&mesh, &mut random);
    for (scheme, promised) in promised() {
        let uniform = Subdivider::new(scheme, Uniform);
        assert_eq!(steps_of_equal_bits(&mesh, &permutation, &uniform, &Selection::empty()), promised);
    }
}
