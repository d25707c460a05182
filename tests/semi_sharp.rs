//! Semi-sharp creases: a case computed by hand, what infinite sharpness is the limit of, decay, and exactness of incremental
//! refinement under both rules.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::sync::atomic::{AtomicUsize, Ordering};

use common::random::{Closed, Picks, Random, Surface, WithBoundary, check, semi_sharp};
use common::run::{Beside, MeshBits, Run};
use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::certify::Certificate;
use vvmesh::error::RefineError;
use vvmesh::glam::DVec3;
use vvmesh::limit::{Limit, LimitSurface, LoopLimit};
use vvmesh::mesh::{Sharpness, SharpnessRule};
use vvmesh::query::r_disk;
use vvmesh::scheme::{AnyScheme, Butterfly, Loop, LoopWeights, Midpoint, ModifiedButterfly};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep, Lineage};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Edge, Mesh, VertexId, shapes};

const RULES: [SharpnessRule; 2] = [SharpnessRule::Uniform, SharpnessRule::Chaikin];

/// How many steps are compared.
const LEVELS: usize = 4;

fn id(index: usize) -> VertexId {
    VertexId::new(index)
}

fn edge(a: usize, b: usize) -> Edge {
    Edge::new(id(a), id(b))
}

fn sharpness(value: f64) -> Sharpness {
    Sharpness::new(value).unwrap()
}

fn uniform_loop() -> Subdivider {
    Subdivider::new(Loop::default(), Uniform)
}

/// The vertex between two others in the mesh of a run.
fn between(run: &Run, a: VertexId, b: VertexId) -> VertexId {
    let parents = |v| {
        run.history.parents(v).map(|lineage| match lineage {
            Lineage::Edge([p, q]) => Edge::new(p, q),
            other => panic!("{v} comes from {other}"),
        })
    };
    run.mesh.vertices().find(|&v| parents(v) == Some(Edge::new(a, b))).unwrap()
}

/// One edge of sharpness 1.5 on the octahedron with vertices ±X, ±Y, ±Z, two levels by hand.
///
/// All valences are 4 at first: α = 31/256, so an even smooth vertex takes 33/64 of itself. The edge a-b runs from a = X to
/// b = Y, and by symmetry what holds of a holds of b with x and y exchanged.
///
/// Level 1, where the edge is sharp:
/// - a is a dart. Its neighbours ±Y, ±Z add to 0: a' = (33/64, 0, 0).
/// - x on the edge is the midpoint: (1/2, 1/2, 0).
/// - On a-(±Z), with apexes ±Y that cancel, 3/8 (X ± Z) = (3/8, 0, ±3/8); on a-(-Y) likewise (3/8, -3/8, 0).
///
/// Level 2, where both halves have sharpness 1/2:
/// - x has two edges of 1/2, which vanish: half of the crease rule, half of the smooth rule of valence 6. Its neighbours are
///   a' and b' with sum (33/64, 33/64, 0), and four with sum (3/4, 3/4, 0). Of each coordinate
///   crease 3/4 · 1/2 + 1/8 · 33/64 = 225/512, smooth 5/8 · 1/2 + 1/16 (33/64 + 3/4) = 401/1024, mean 851/2048.
/// - y on a'-x: half of the midpoint (65/128, 1/4, 0), half of 3/8 (a' + x) + 1/8 (apexes with sum (3/4, 0, 0))
///   = (243/512, 3/16, 0). So y = (503/1024, 7/32, 0).
/// - a' is a dart still. Its neighbours (1/2, 1/2, 0), (3/8, -3/8, 0), (3/8, 0, ±3/8) add to (13/8, 1/8, 0):
///   33/64 · 33/64 + 31/256 · 13/8 = 1895/4096, and 31/256 · 1/8 = 31/2048.
///
/// All these numbers are sums of few powers of 2, so there is no rounding.
#[test]
fn an_edge_of_sharpness_one_and_a_half_is_as_computed_by_hand() {
    let mut mesh = shapes::octahedron();
    let at = |p: DVec3| mesh.vertices().find(|&v| mesh.position(v) == p).unwrap();
    let [a, b] = [DVec3::X, DVec3::Y].map(at);
    assert!(mesh.set_sharpness(Edge::new(a, b), sharpness(1.5)));
    for rule in RULES {
        mesh.set_sharpness_rule(rule);
        let mut run = Run::new(&mesh);

        run.step(&uniform_loop(), &Selection::empty());
        let x = between(&run, a, b);
        assert_eq!(run.mesh.position(a), DVec3::new(33.0 / 64.0, 0.0, 0.0));
        assert_eq!(run.mesh.position(x), DVec3::new(0.5, 0.5, 0.0));
        assert_eq!(run.mesh.tags().sharp_edges().len(), 2);
        for end in [a, b] {
            assert_eq!(run.mesh.tags().sharpness(Edge::new(end, x)), sharpness(0.5));
        }

        run.step(&uniform_loop(), &Selection::empty());
        let y = between(&run, a, x);
        assert_eq!(run.mesh.position(x), DVec3::new(851.0, 851.0, 0.0) / 2048.0);
        assert_eq!(run.mesh.position(y), DVec3::new(503.0 / 1024.0, 7.0 / 32.0, 0.0));
        assert_eq!(run.mesh.position(a), DVec3::new(1895.0 / 4096.0, 31.0 / 2048.0, 0.0));
        assert!(run.mesh.tags().is_empty(), "nothing is left of 1.5 after two steps");
    }
}

/// A vertex of sharpness 1.25 stays for a step, and takes 1/4 of that in the next.
#[test]
fn a_semi_sharp_vertex_stays_for_a_part() {
    let mut mesh = shapes::octahedron();
    assert!(mesh.set_vertex_sharpness(id(0), sharpness(1.25)));
    let (mut run, at_first) = (Run::new(&mesh), mesh.position(id(0)));
    run.step(&uniform_loop(), &Selection::empty());
    assert_eq!(run.mesh.position(id(0)), at_first);
    assert_eq!(run.mesh.tags().vertex_sharpness(id(0)), sharpness(0.25));
    let mut smooth = Run::new(&run.mesh);
    smooth.mesh.set_vertex_sharpness(id(0), Sharpness::SMOOTH);
    for run in [&mut run, &mut smooth] {
        run.step(&uniform_loop(), &Selection::empty());
    }
    let mean = 0.25 * at_first + 0.75 * smooth.mesh.position(id(0));
    assert!(run.mesh.position(id(0)).distance(mean) < 1e-15);
    assert!(run.mesh.tags().is_empty());
}

/// Along 0 - 1 - 2 - 3 - 4 on a grid, under Chaikin's rule: the halves lean towards the next edge.
#[test]
fn chaikins_rule_evens_sharpness_out_along_a_crease() {
    // The middle row of a grid of 5 x 3 vertices, whose ends lie on the boundary.
    let mut mesh = shapes::grid(4, 2);
    let row: Vec<VertexId> = (5..10).map(id).collect();
    for (k, value) in [3.0, 1.0, f64::INFINITY, 2.0].into_iter().enumerate() {
        assert!(mesh.set_sharpness(Edge::new(row[k], row[k + 1]), sharpness(value)));
    }
    mesh.set_sharpness_rule(SharpnessRule::Chaikin);
    let mut run = Run::new(&mesh);
    run.step(&uniform_loop(), &Selection::empty());
    let halves = row.windows(2).flat_map(|ends| {
        let x = between(&run, ends[0], ends[1]);
        [ends[0], ends[1]].map(|end| run.mesh.tags().sharpness(Edge::new(end, x)).value())
    });
    // Alone at the boundary 3 - 1; beside 1: 9/4 + 1/4 - 1; beside 3: 3/4 + 3/4 - 1; beside the infinite one 1 - 1, and
    // 2 - 1.
    let infinite = f64::INFINITY;
    assert_eq!(halves.collect::<Vec<_>>(), [2.0, 1.5, 0.5, 0.0, infinite, infinite, 1.0, 1.0]);
}

#[test]
fn an_edge_of_the_boundary_is_infinitely_sharp() {
    let mut mesh = shapes::grid(2, 1);
    assert!(mesh.set_sharpness(edge(0, 1), sharpness(0.5)));
    assert_eq!(mesh.tags().sharpness(edge(0, 1)), Sharpness::INFINITE);
    assert!(!mesh.tags().has_semi_sharp());
    assert!(!mesh.set_sharpness(edge(0, 5), sharpness(0.5)), "there is no such edge");
}

/// As long as sharpness stays at 1 or more, the bits are those of infinite sharpness.
fn great_sharpness_is_infinite<S: Surface>(surface: S, chaikin: bool) {
    let infinite = surface.mesh();
    let mut great = infinite.clone();
    great.set_sharpness_rule(RULES[usize::from(chaikin)]);
    for edge in infinite.tags().sharp_edges() {
        great.set_sharpness(edge, sharpness(LEVELS as f64));
    }
    for v in infinite.tags().corners() {
        great.set_vertex_sharpness(v, sharpness(LEVELS as f64));
    }
    let mut runs = [Run::new(&infinite), Run::new(&great)];
    for _ in 0..LEVELS {
        let [infinite, great] = runs.each_mut().map(|run| {
            run.step(&uniform_loop(), &Selection::empty());
            run.mesh.positions().iter().map(|&p| common::run::bits(p)).collect::<Vec<_>>()
        });
        assert!(infinite == great);
    }
    // Then only what the boundary makes infinite is left.
    assert!(!runs[1].mesh.tags().has_semi_sharp());
}

#[test]
fn great_sharpness_is_infinite_for_a_while() {
    check(81, 10, great_sharpness_is_infinite::<Closed> as fn(Closed, bool));
    check(82, 10, great_sharpness_is_infinite::<WithBoundary> as fn(WithBoundary, bool));
}

/// A semi-sharp random mesh.
fn random_mesh<S: Surface>(surface: &S, seed: u32, chaikin: bool) -> Mesh {
    semi_sharp(surface.mesh(), u64::from(seed), RULES[usize::from(chaikin)])
}

/// The longest that a vertex of a mesh stays semi-sharp.
fn steps(mesh: &Mesh) -> u32 {
    mesh.vertices().map(|v| mesh.neighborhood().semi_sharp_steps(v)).max().unwrap()
}

/// Sharpness fades by 1 and more at each step, everywhere; the limit is known when it is gone, and not before.
fn everything_fades<S: Surface>(surface: S, seed: u32, chaikin: bool) {
    let mesh = random_mesh(&surface, seed, chaikin);
    let limit = LoopLimit::new(LoopWeights::Loop);
    let mut run = Run::new(&mesh);
    for _ in 0..6 {
        let (before, around) = (steps(&run.mesh), run.mesh.neighborhood());
        let known = |v| !around.is_semi_sharp(v);
        assert!(run.mesh.vertices().all(|v| known(v) == (around.semi_sharp_steps(v) == 0)));
        assert!(
            run.mesh
                .vertices()
                .filter(|&v| !known(v))
                .all(|v| { limit.side_count(around, v) == 0 && limit.contraction(around, v).is_none() })
        );
        let surface = LimitSurface::new(&run.mesh, LoopWeights::Loop);
        assert!(
            run.mesh
                .triangles()
                .all(|triangle| { surface.patch(triangle).is_some() == triangle.corners().into_iter().all(known) })
        );
        assert_eq!(run.mesh.tags().has_semi_sharp(), before > 0);
        let infinite = |mesh: &Mesh| {
            let edges = mesh.tags().sharp_edges();
            edges.into_iter().filter(|&edge| mesh.tags().sharpness(edge) == Sharpness::INFINITE).count()
        };
        let count = infinite(&run.mesh);
        run.step(&uniform_loop(), &Selection::empty());
        let after = steps(&run.mesh);
        assert!(after == before.saturating_sub(1) || (chaikin && after < before), "{before} steps, then {after}");
        assert_eq!(infinite(&run.mesh), 2 * count);
        if run.mesh.vertex_count() > 5000 {
            return;
        }
    }
}

#[test]
fn everything_semi_sharp_fades() {
    check(83, 10, everything_fades::<Closed> as fn(Closed, u32, bool));
    check(84, 10, everything_fades::<WithBoundary> as fn(WithBoundary, u32, bool));
}

/// For nested selections, r = 1, 2, 3 and all levels; tags are the same too.
fn exact<S: Surface>(surface: S, picks: Picks, seed: u32, chaikin: bool) {
    let mesh = random_mesh(&surface, seed, chaikin);
    let patch = picks.patch(&mesh);
    let mut uniform = vec![Run::new(&mesh)];
    for k in 0..LEVELS {
        let mut next = uniform[k].clone();
        next.step(&uniform_loop(), &Selection::empty());
        uniform.push(next);
    }
    for rings in 1..=3 {
        let subdivider = Subdivider::new(Loop::default(), Incremental::new(rings).unwrap());
        let (mut run, mut selection) = (Run::new(&mesh), patch.clone());
        for (k, uniform) in uniform.iter().enumerate().skip(1) {
            let step = run.step(&subdivider, &selection);
            let beside = Beside::new(&run, uniform);
            for &v in step.selection.vertices() {
                assert!(beside.star_is_same(v), "r {rings}, level {k}: another star at {v}");
                assert!(beside.sharpness_is_same(v), "r {rings}, level {k}: another sharpness at {v}");
            }
            assert_eq!(step.unproven, [], "r {rings}, level {k}");
            selection = picks.part(&step.selection, k - 1);
        }
    }
}

#[test]
fn incremental_refinement_is_exact() {
    check(85, 16, exact::<Closed> as fn(Closed, Picks, u32, bool));
    check(86, 16, exact::<WithBoundary> as fn(WithBoundary, Picks, u32, bool));
}

/// How many stars were proven off the input's, and how many of them between semi-sharp halves.
static PROVEN: AtomicUsize = AtomicUsize::new(0);
static SEMI_SHARP: AtomicUsize = AtomicUsize::new(0);

/// Whatever is selected, what is certified has the star and the tags of the uniform mesh.
fn certificate_is_sound<S: Surface>(surface: S, seed: u32, chaikin: bool) {
    let mesh = random_mesh(&surface, seed, chaikin);
    let mut random = Random::new(u64::from(seed));
    let (mut run, mut uniform) = (Run::new(&mesh), Run::new(&mesh));
    for level in 1..=3 {
        // Splitting without smoothing fades sharpness as well.
        let scheme: AnyScheme = if random.below(4) == 0 { Midpoint.into() } else { Loop::default().into() };
        let subdivider = match random.below(3) {
            0 => Subdivider::new(scheme.clone(), Simple),
            rings => Subdivider::new(scheme.clone(), Incremental::new(rings).unwrap()),
        };
        let center = id(random.below(run.mesh.vertex_count()));
        let disk = r_disk(run.mesh.rotation(), [center], 2 + random.below(4), &mut Scratch::new());
        run.step(&subdivider, &disk.into_vertices().into_iter().collect());
        uniform.step(&Subdivider::new(scheme, Uniform), &Selection::empty());
        let (beside, certificate) = (Beside::new(&run, &uniform), Certificate::new(&run.mesh, &run.history).unwrap());
        for v in certificate.certified() {
            assert!(beside.star_is_same(v), "level {level}: {v} is certified, but its star is another");
            assert!(beside.sharpness_is_same(v), "level {level}: {v} is certified, but its sharpness is another");
            PROVEN.fetch_add(1, Ordering::Relaxed);
            SEMI_SHARP.fetch_add(usize::from(run.mesh.neighborhood().is_semi_sharp(v)), Ordering::Relaxed);
        }
    }
}

#[test]
fn the_certificate_is_sound() {
    check(87, 60, certificate_is_sound::<Closed> as fn(Closed, u32, bool));
    check(88, 60, certificate_is_sound::<WithBoundary> as fn(WithBoundary, u32, bool));
    let [proven, semi_sharp] = [&PROVEN, &SEMI_SHARP].map(|count| count.load(Ordering::Relaxed));
    assert!(proven > 1000 && semi_sharp > 100, "{proven} proven, {semi_sharp} of them semi-sharp");
}

/// What a step leaves out keeps its sharpness.
#[test]
fn what_is_not_refined_does_not_fade() {
    let mut mesh = shapes::grid(12, 12);
    let (near, far) = (edge(13 * 6 + 1, 13 * 6 + 2), edge(13 * 6 + 9, 13 * 6 + 10));
    for edge in [near, far] {
        assert!(mesh.set_sharpness(edge, sharpness(0.75)));
    }
    let corners = [13 * 6 + 1, 13 * 6 + 9].map(id);
    for v in corners {
        assert!(mesh.set_vertex_sharpness(v, sharpness(1.75)));
    }
    let mut run = Run::new(&mesh);
    let subdivider = Subdivider::new(Loop::default(), Incremental::new(1).unwrap());
    run.step(&subdivider, &near.ends().into_iter().collect());
    assert_eq!(run.mesh.tags().sharp_edges(), [far]);
    assert_eq!(run.mesh.tags().sharpness(far), sharpness(0.75));
    assert_eq!(corners.map(|v| run.mesh.tags().vertex_sharpness(v).value()), [0.75, 1.75]);
}

#[test]
fn a_scheme_that_cannot_blend_refuses() {
    let mut mesh = shapes::octahedron();
    let step = |mesh: &mut Mesh, scheme: AnyScheme| {
        let (mut history, mut scratch) = (History::new(mesh, Keep::default()), Scratch::new());
        let subdivider = Subdivider::new(scheme, Uniform);
        subdivider.step(mesh, &mut history, &Selection::empty(), &mut scratch, &mut Control::default()).map(|_| ())
    };
    mesh.set_sharpness(edge(0, 4), sharpness(0.5));
    let before = MeshBits::of(&mesh);
    assert_eq!(step(&mut mesh, ModifiedButterfly.into()), Err(RefineError::SemiSharp));
    assert_eq!(MeshBits::of(&mesh), before);
    // To these tags mean nothing.
    for scheme in [AnyScheme::from(Butterfly), Midpoint.into()] {
        assert_eq!(step(&mut mesh.clone(), scheme), Ok(()));
    }
    mesh.set_sharpness(edge(0, 4), Sharpness::INFINITE);
    assert_eq!(step(&mut mesh, ModifiedButterfly.into()), Ok(()));
}
