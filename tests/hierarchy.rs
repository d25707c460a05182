//! Methods on a hierarchy: every vertex is where uniform refinement has it, whatever the selections; what is given up goes.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::collections::{BTreeMap, BTreeSet};

use common::load::load;
use common::random::{Closed, Picks, Random, Surface, WithBoundary, check, semi_sharp};
use common::run::{Beside, MeshBits, Run, bits, schemes};
use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::certify::Certificate;
use vvmesh::check::mesh_conformity;
use vvmesh::error::{ConfigError, RefineError};
use vvmesh::glam::DVec3;
use vvmesh::limit::{Limit, LoopLimit};
use vvmesh::mesh::SharpnessRule;
use vvmesh::query::r_disk;
use vvmesh::scheme::{AnyScheme, FourEight, Loop, Midpoint, ModifiedButterfly, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::Lineage;
use vvmesh::subdivide::{Control, Dynamic, Progress, Subdivider, Values};
use vvmesh::{Mesh, VertexId, shapes};

type Make = fn(AnyScheme) -> Result<Subdivider, ConfigError>;

const METHODS: [(&str, Make); 2] = [
    ("red-green-restricted", |scheme| Subdivider::red_green_restricted(scheme)),
    ("dynamic", |scheme| Subdivider::dynamic(scheme)),
];

/// The uniform run before the first step and after each.
fn uniform_levels(scheme: &AnyScheme, mesh: &Mesh, count: usize) -> Vec<Run> {
    let subdivider = Subdivider::new(scheme.clone(), Uniform);
    let mut levels = vec![Run::new(mesh)];
    for k in 0..count {
        let mut next = levels[k].clone();
        next.step(&subdivider, &Selection::empty());
        levels.push(next);
    }
    levels
}

/// Whether there is such a vertex, and its id is not free.
fn is_there(run: &Run, v: VertexId) -> bool {
    v.index() < run.history.input_count() || run.history.parents(v).is_some()
}

/// Asserts that the mesh is one, conforming and balanced.
fn assert_is_whole(run: &Run, boundary_loops: usize, what: &str) {
    assert_eq!(run.mesh.rotation().validate_triangles(), [], "{what}");
    assert!(mesh_conformity(&run.mesh, None).is_conforming(), "{what}");
    assert_eq!(run.mesh.rotation().boundary_loops().len(), boundary_loops, "{what}");
    let closing = run.history.closing_edges(&run.mesh).unwrap();
    for v in run.mesh.vertices() {
        let around = run.mesh.rotation().triangles_around(v);
        let levels: Vec<u8> = around.map(|face| run.history.face_level(face, &closing).unwrap().0).collect();
        let (least, greatest) = (levels.iter().min().unwrap_or(&0), levels.iter().max().unwrap_or(&0));
        assert!(greatest - least <= 1, "{what}: levels {least} and {greatest} at {v}");
    }
}

/// Asserts that every vertex is where uniform refinement of as many levels as it says has it, and as sharp; answers how many
/// are at the level of the last of them.
fn assert_exact(run: &Run, uniform: &[Run], what: &str) -> usize {
    let finest = uniform.last().unwrap();
    let same = run.history.same_names(&finest.history).unwrap();
    let certificate = Certificate::new(&run.mesh, &run.history).unwrap();
    let mut at_last = 0;
    for v in run.mesh.vertices().filter(|&v| is_there(run, v)) {
        let level = certificate.exact_level(v).unwrap();
        let (there, twin) = (&uniform[level].mesh, same[v.index()].unwrap());
        assert_eq!(bits(run.mesh.position(v)), bits(there.position(twin)), "{what}: {v} at level {level}");
        assert_eq!(run.mesh.tags().vertex_sharpness(v), there.tags().vertex_sharpness(twin), "{what}: {v}");
        at_last += usize::from(level + 1 == uniform.len());
    }
    if run.history.step_count() + 1 == uniform.len() {
        let beside = Beside::new(run, finest);
        assert!(certificate.certified().all(|v| beside.star_is_same(v)), "{what}");
    }
    for edge in run.mesh.edges() {
        let ends = edge.ends();
        let level = ends.map(|v| usize::from(run.history.level(v).unwrap())).into_iter().max().unwrap();
        let [a, b] = ends.map(|v| same[v.index()].unwrap());
        let there = &uniform[level].mesh;
        if there.rotation().has_edge(a, b) {
            let here = run.mesh.neighborhood().sharpness(ends[0], ends[1]);
            assert_eq!(here, there.neighborhood().sharpness(a, b), "{what}: {edge}");
        }
    }
    at_last
}

/// What a random selection of a few vertices is, some of them near each other.
fn moving(run: &Run, random: &mut Random) -> Selection {
    let center = loop {
        let v = VertexId::new(random.below(run.mesh.vertex_count()));
        if run.mesh.ring(v).valence() > 0 {
            break v;
        }
    };
    let radius = 1 + random.below(2);
    r_disk(run.mesh.rotation(), [center], radius, &mut Scratch::new()).vertices().iter().copied().collect()
}

/// Steps with selections that follow, and that are chosen anew: all is exact.
fn steps_are_exact<S: Surface, const SCHEME: usize>(surface: S, picks: Picks, seed: u64) {
    const LEVELS: usize = 4;
    let (name, scheme) = schemes()[SCHEME].clone();
    let mesh = surface.mesh();
    let loops = mesh.rotation().boundary_loops().len();
    let uniform = uniform_levels(&scheme, &mesh, LEVELS);
    for (method, make) in METHODS {
        for moves in [false, true] {
            let subdivider = make(scheme.clone()).unwrap();
            let (mut run, mut selection) = (Run::new(&mesh), picks.patch(&mesh));
            let mut random = Random::new(seed);
            for k in 1..=LEVELS {
                let what = format!("{name}, {method}, level {k}, moving {moves}");
                let step = run.step(&subdivider, &selection);
                assert_is_whole(&run, loops, &what);
                let fine = assert_exact(&run, &uniform[..=k], &what);
                let certificate = Certificate::new(&run.mesh, &run.history).unwrap();
                assert_eq!(step.certified, Some(certificate.certified().count()), "{what}");
                assert!(fine >= step.certified.unwrap());
                if method == "dynamic" {
                    // Every selected star is complete at the level of the step.
                    let at = |v: &VertexId| certificate.exact_level(*v) == Some(k);
                    assert!(selection.vertices().iter().all(at) && fine >= step.selection.len(), "{what}");
                }
                if moves {
                    selection = moving(&run, &mut random);
                } else {
                    assert_follows(&selection, &step.selection, &run, &what);
                    selection = picks.part(&step.selection, k - 1);
                }
            }
        }
    }
}

/// S' is S with every vertex on an edge between two vertices of S that was split by then.
fn assert_follows(before: &Selection, after: &Selection, run: &Run, what: &str) {
    for v in run.mesh.vertices().filter(|&v| after.contains(v) && !before.contains(v)) {
        let parents = run.history.parents(v).unwrap();
        assert!(parents.vertices().all(|end| before.contains(end)), "{what}: {v} of {parents}");
    }
    assert!(before.vertices().iter().all(|&v| after.contains(v)), "{what}");
}

fn steps_are_exact_on_random_meshes<const SCHEME: usize>(seed: u64) {
    check(seed, 6, steps_are_exact::<Closed, SCHEME> as fn(Closed, Picks, u64));
    check(seed + 1, 6, steps_are_exact::<WithBoundary, SCHEME> as fn(WithBoundary, Picks, u64));
}

#[test]
fn loop_steps_are_exact() {
    steps_are_exact_on_random_meshes::<0>(1);
}

#[test]
fn loop_steps_with_warrens_weights_are_exact() {
    steps_are_exact_on_random_meshes::<1>(3);
}

#[test]
fn butterfly_steps_are_exact() {
    steps_are_exact_on_random_meshes::<2>(5);
}

#[test]
fn modified_butterfly_steps_are_exact() {
    steps_are_exact_on_random_meshes::<3>(7);
}

#[test]
fn midpoint_steps_are_exact() {
    steps_are_exact_on_random_meshes::<4>(9);
}

/// What does not depend on ids: vertices, by what they were made of, with their positions and how sharp they are; faces.
type Named = (BTreeMap<String, ([u64; 3], u64)>, BTreeSet<[String; 3]>);

fn named(run: &Run) -> Named {
    let mut names: BTreeMap<VertexId, String> = BTreeMap::new();
    fn name(run: &Run, v: VertexId, names: &mut BTreeMap<VertexId, String>) -> String {
        if let Some(known) = names.get(&v) {
            return known.clone();
        }
        let made = match run.history.parents(v) {
            None => v.index().to_string(),
            Some(Lineage::Edge([p, q])) => format!("({} {})", name(run, p, names), name(run, q, names)),
            Some(other) => panic!("{other} is no edge"),
        };
        names.insert(v, made.clone());
        made
    }
    let vertices = run.mesh.vertices().filter(|&v| is_there(run, v)).map(|v| {
        let sharpness = run.mesh.tags().vertex_sharpness(v).value().to_bits();
        (name(run, v, &mut names), (bits(run.mesh.position(v)), sharpness))
    });
    let vertices = vertices.collect();
    let faces = run.mesh.triangles().map(|face| {
        let mut corners = face.corners().map(|v| names[&v].clone());
        let least = (0..3).min_by_key(|&k| corners[k].clone()).unwrap();
        corners.rotate_left(least);
        corners
    });
    (vertices, faces.collect())
}

/// A small mesh, closed or open, with creases and semi-sharp tags if the scheme can blend them.
fn small(random: &mut Random, scheme: &AnyScheme) -> Mesh {
    let mesh = match random.below(8) {
        0 => shapes::tetrahedron(),
        1 => shapes::octahedron(),
        2 => shapes::icosahedron(),
        3 => shapes::torus(3, 3, 2.0, 1.0),
        4 => shapes::torus(5, 4, 2.0, 1.0),
        5 => shapes::grid(1, 1),
        6 => shapes::grid(3, 2),
        _ => shapes::grid(1, 5),
    };
    let mut mesh = mesh;
    for position in mesh.positions_mut() {
        *position += 0.2 * random.vector();
    }
    if random.below(2) == 0 {
        return mesh;
    }
    if scheme.blends_sharpness() {
        let rule = if random.below(2) == 0 { SharpnessRule::Uniform } else { SharpnessRule::Chaikin };
        return semi_sharp(mesh, random.next(), rule);
    }
    let edges: Vec<_> = mesh.edges().collect();
    for edge in edges {
        if random.below(4) == 0 {
            mesh.set_sharp(edge, true);
        }
    }
    mesh
}

/// A run of a script of stars that are asked for and given up.
struct Scripted {
    dynamic: Dynamic,
    run: Run,
    loops: usize,
}

impl Scripted {
    fn new(scheme: &AnyScheme, mesh: &Mesh) -> Self {
        let loops = mesh.rotation().boundary_loops().len();
        Self { dynamic: Dynamic::new(scheme.clone()).unwrap(), run: Run::new(mesh), loops }
    }

    fn refine(&mut self, v: VertexId, level: u8) -> Result<(), RefineError> {
        let Run { mesh, history } = &mut self.run;
        let change = self.dynamic.refine(mesh, history, v, level, &mut Scratch::new(), &mut Control::default())?;
        assert!(change.removed.is_empty() && change.added.iter().all(|x| change.changed.contains(x)));
        Ok(())
    }

    fn coarsen(&mut self, v: VertexId, level: u8) -> Result<(), RefineError> {
        let Run { mesh, history } = &mut self.run;
        let change = self.dynamic.coarsen(mesh, history, v, level, &mut Scratch::new())?;
        assert!(change.added.is_empty());
        Ok(())
    }

    fn operate(&mut self, random: &mut Random, greatest: u8) {
        let asked: Vec<(VertexId, u8)> = self.run.history.asked_stars().collect();
        if !asked.is_empty() && random.below(5) < 2 {
            let (v, level) = asked[random.below(asked.len())];
            self.coarsen(v, level).unwrap();
        } else {
            let there: Vec<VertexId> = self.run.mesh.vertices().filter(|&v| is_there(&self.run, v)).collect();
            let v = there[random.below(there.len())];
            let level = self.run.history.level(v).unwrap() + random.below(3) as u8;
            self.refine(v, level.min(greatest)).ok();
        }
        assert_is_whole(&self.run, self.loops, "an operation");
    }
}

/// Scripts that leave the same stars leave the same mesh, and when all is given up the input, bit for bit.
fn scripts_come_back(seed: u64) {
    let mut random = Random::new(seed);
    let scheme = schemes()[random.below(5)].1.clone();
    let mesh = small(&mut random, &scheme);
    let mut script = Scripted::new(&scheme, &mesh);
    for _ in 0..4 + random.below(12) {
        script.operate(&mut random, 3);
    }

    // The same stars in another order, with detours; a vertex is found by its name.
    let mut asked: Vec<(VertexId, u8)> = script.run.history.asked_stars().collect();
    let mut other = Scripted::new(&scheme, &mesh);
    for _ in 0..random.below(4) {
        other.operate(&mut random, 2);
    }
    let detours: Vec<(VertexId, u8)> = other.run.history.asked_stars().collect();
    while !asked.is_empty() {
        // Only of vertices that are there already.
        let same = script.run.history.same_names(&other.run.history).unwrap();
        let ready: Vec<usize> = (0..asked.len()).filter(|&k| same[asked[k].0.index()].is_some()).collect();
        let k = if ready.is_empty() { None } else { Some(ready[random.below(ready.len())]) };
        // If none is, what the next one was made of is asked for on the way.
        let Some(k) = k else {
            make_room(&script.run, &mut other, asked[0].0);
            continue;
        };
        let (v, level) = asked.swap_remove(k);
        other.refine(same[v.index()].unwrap(), level).unwrap();
    }
    let same = script.run.history.same_names(&other.run.history).unwrap();
    let wanted: BTreeSet<(VertexId, u8)> =
        script.run.history.asked_stars().map(|(v, level)| (same[v.index()].unwrap(), level)).collect();
    let extra: Vec<(VertexId, u8)> = other.run.history.asked_stars().filter(|star| !wanted.contains(star)).collect();
    assert!(extra.len() <= detours.len() + 100);
    for (v, level) in extra {
        other.coarsen(v, level).unwrap();
    }
    assert_eq!(named(&script.run), named(&other.run));

    let uniform = uniform_levels(&scheme, &mesh, 5);
    assert_exact(&script.run, &uniform, "a script");
    for (v, level) in script.run.history.asked_stars().collect::<Vec<_>>() {
        script.coarsen(v, level).unwrap();
    }
    assert_eq!(script.run.bits(), MeshBits::of(&mesh));
    for v in mesh.vertices() {
        assert_eq!(script.run.mesh.tags().sharp_neighbors(v), mesh.tags().sharp_neighbors(v));
    }
}

/// Makes a vertex of one run in another, by asking for stars of what it was made of.
fn make_room(run: &Run, other: &mut Scripted, v: VertexId) {
    let same = run.history.same_names(&other.run.history).unwrap();
    if same[v.index()].is_some() {
        return;
    }
    let ends: Vec<VertexId> = run.history.parents(v).unwrap().vertices().collect();
    for &end in &ends {
        make_room(run, other, end);
    }
    let same = run.history.same_names(&other.run.history).unwrap();
    let level = run.history.level(v).unwrap();
    other.refine(same[ends[0].index()].unwrap(), level).unwrap();
}

#[test]
fn a_thousand_scripts_come_back() {
    check(11, 1000, scripts_come_back as fn(u64));
}

/// Closed and open meshes of 100 to 400 faces, as made by people.
const SHARED: [&str; 10] = [
    "papers/spot_280.off",
    "papers/eight_384.off",
    "papers/top_144.off",
    "papers/torus_288.off",
    "papers/foot_240.off",
    "papers/strip_320.off",
    "models/cat_head.obj",
    "models/hole_capsule.off",
    "models/mpi_triang.off",
    "models/patch-13.off",
];

/// Five levels on meshes as made by people; simple and incremental deviate where the selection moves, and say so.
#[test]
fn moving_selections_on_shared_meshes_are_exact() {
    const LEVELS: usize = 5;
    let Some(folder) = common::meshes() else { return };
    let (mut deviating, mut told) = ([0; 2], [0; 2]);
    for (number, name) in SHARED.iter().enumerate() {
        let mesh = load(&folder.join(name));
        let scheme: AnyScheme = if number % 3 == 2 { ModifiedButterfly.into() } else { Loop::default().into() };
        let loops = mesh.rotation().boundary_loops().len();
        let uniform = uniform_levels(&scheme, &mesh, LEVELS);
        for (method, make) in METHODS {
            let subdivider = make(scheme.clone()).unwrap();
            for moves in [false, true] {
                let (mut run, mut random) = (Run::new(&mesh), Random::new(number as u64));
                let mut selection = moving(&run, &mut random);
                for k in 1..=LEVELS {
                    let what = format!("{name}, {method}, level {k}");
                    let step = run.step(&subdivider, &selection);
                    assert_is_whole(&run, loops, &what);
                    assert_exact(&run, &uniform[..=k], &what);
                    selection = if moves { moving(&run, &mut random) } else { step.selection };
                }
            }
        }
        let methods = [Subdivider::new(scheme.clone(), Simple), Subdivider::new(scheme, Incremental::new(1).unwrap())];
        for (k, subdivider) in methods.iter().enumerate() {
            let (mut run, mut random) = (Run::new(&mesh), Random::new(number as u64));
            for uniform in &uniform[1..=3] {
                let selection = moving(&run, &mut random);
                run.step(subdivider, &selection);
                let beside = Beside::new(&run, uniform);
                let certificate = Certificate::new(&run.mesh, &run.history).unwrap();
                for &v in selection.vertices() {
                    let same = beside.star_is_same(v);
                    deviating[k] += usize::from(!same);
                    told[k] += usize::from(!certificate.is_certified(v));
                    assert!(same || !certificate.is_certified(v), "{name}: {v} is certified and deviates");
                }
            }
        }
    }
    assert!(deviating.iter().zip(told).all(|(&deviating, told)| deviating > 50 && told >= deviating), "{deviating:?}");
}

/// Positions kept by level are those of the closed form: v∞ + λᵏ⁻ᵇ (vᵇ − v∞), with birth position and limit alone.
#[test]
fn positions_of_levels_follow_the_closed_form() {
    let mesh = shapes::grid(4, 3);
    let mut run = Scripted::new(&Loop::default().into(), &mesh);
    let limit = LoopLimit::default();
    for v in [VertexId::new(6), VertexId::new(2), VertexId::new(11)] {
        let mut expected: Option<(DVec3, DVec3, f64)> = None;
        for level in 0..6 {
            run.refine(v, level).unwrap();
            let position = run.run.mesh.position(v);
            let (end, offset, rate) = *expected.get_or_insert_with(|| {
                let end = limit.position(&mesh, v);
                (end, position - end, limit.contraction(mesh.neighborhood(), v).unwrap())
            });
            assert!((end + rate.powi(level.into()) * offset).distance(position) < 1e-14, "{v}, level {level}");
        }
    }
}

#[test]
fn everything_refined_is_the_uniform_mesh() {
    for (name, scheme) in schemes() {
        for mesh in [shapes::icosahedron(), shapes::grid(3, 2)] {
            let uniform = uniform_levels(&scheme, &mesh, 3);
            for (method, make) in METHODS {
                let subdivider = make(scheme.clone()).unwrap();
                let mut run = Run::new(&mesh);
                let mut selection = Selection::all(mesh.vertex_count());
                for (k, uniform) in uniform.iter().enumerate().skip(1) {
                    let step = run.step(&subdivider, &selection);
                    selection = step.selection;
                    assert_eq!(selection.len(), run.mesh.vertex_count(), "{name}, {method}, level {k}");
                    assert_eq!(named(&run), named(uniform), "{name}, {method}, level {k}");
                }
                assert_eq!(run.history.closing_edges(&run.mesh), Some(vec![]));
            }
        }
    }
}

#[test]
fn errors_leave_everything_as_it_was() {
    let mesh = shapes::icosahedron();
    let mut script = Scripted::new(&Loop::default().into(), &mesh);
    let [v, w] = [0, 5].map(VertexId::new);
    assert_eq!(script.coarsen(v, 1), Err(RefineError::NotAsked { vertex: v, level: 1 }));
    script.refine(v, 2).unwrap();
    let x = VertexId::new(mesh.vertex_count());
    assert_eq!(script.refine(x, 0), Err(RefineError::NoStar { vertex: x, level: 0, birth: 1 }));
    let nobody = VertexId::new(script.run.mesh.vertex_count());
    assert_eq!(script.refine(nobody, 1), Err(RefineError::NoVertex(nobody)));
    assert_eq!(script.coarsen(v, 1), Err(RefineError::NotAsked { vertex: v, level: 1 }));

    let before = (script.run.bits(), named(&script.run));
    let Run { mesh, history } = &mut script.run;
    let (faces, scratch) = (mesh.face_count() as u64, &mut Scratch::new());
    let mut few = Control { max_faces: Some(faces + 20), ..Control::default() };
    let error = script.dynamic.refine(mesh, history, w, 4, scratch, &mut few).unwrap_err();
    assert!(matches!(error, RefineError::TooManyFaces { allowed, .. } if allowed == faces + 20), "{error}");
    let mut stop = |_: Progress| std::ops::ControlFlow::Break(());
    let mut stopping = Control { progress: Some(&mut stop), ..Control::default() };
    let error = script.dynamic.refine(mesh, history, w, 4, scratch, &mut stopping).unwrap_err();
    assert_eq!(error, RefineError::Cancelled);
    // Other methods and schemes cannot go on from here.
    let selection = Selection::all(3);
    let others = [
        (Subdivider::new(Loop::default(), Simple), RefineError::OtherHistory),
        (Subdivider::red_green_restricted(Loop::default()).unwrap(), RefineError::OtherHistory),
        (Subdivider::dynamic(Midpoint).unwrap(), RefineError::OtherScheme { made: "loop", asked: "midpoint" }),
    ];
    for (other, expected) in others {
        assert_eq!(other.step(mesh, history, &selection, scratch, &mut Control::default()), Err(expected));
    }
    assert_eq!((script.run.bits(), named(&script.run)), before);
    script.coarsen(v, 2).unwrap();
    assert_eq!(script.run.bits(), MeshBits::of(&shapes::icosahedron()));
}

#[test]
fn what_is_not_finite_is_not_kept() {
    let mut mesh = shapes::icosahedron();
    mesh.positions_mut().iter_mut().for_each(|position| *position *= 1e308);
    let mut script = Scripted::new(&Loop::default().into(), &mesh);
    assert!(matches!(script.refine(VertexId::new(0), 3), Err(RefineError::NonFinite(_))));
    assert_eq!((script.run.bits(), script.run.history.split_kind()), (MeshBits::of(&mesh), None));
}

#[test]
fn schemes_that_leave_no_cracks_are_refused() {
    for scheme in [AnyScheme::from(Sqrt3::default()), FourEight::default().into()] {
        for (_, make) in METHODS {
            let error = make(scheme.clone()).unwrap_err().to_string();
            assert!(error.contains("one that splits triangles in four"), "{error}");
        }
        assert!(Dynamic::new(scheme).is_err());
    }
}

/// A value that is a position goes where the position goes, to the bit; not after something was given up.
#[test]
fn what_follows_goes_where_positions_go() {
    for (name, scheme) in schemes() {
        for (method, make) in METHODS {
            let mut random = Random::new(7);
            let mesh = shapes::grid(5, 4);
            let mut run = Run::new(&mesh);
            let mut values = Values::new(mesh.positions().to_vec());
            for level in 1..=4 {
                let selection = moving(&run, &mut random);
                let mut control = Control { follower: Some(&mut values), ..Control::default() };
                let (mesh, history) = (&mut run.mesh, &mut run.history);
                let subdivider = make(scheme.clone()).unwrap();
                subdivider.step(mesh, history, &selection, &mut Scratch::new(), &mut control).unwrap();
                let found = values.shown().iter().map(|&value| bits(value));
                assert!(found.eq(run.mesh.positions().iter().map(|&p| bits(p))), "{name}, {method}, level {level}");
            }
        }
    }
    let mut script = Scripted::new(&Loop::default().into(), &shapes::octahedron());
    let v = VertexId::new(0);
    script.refine(v, 2).unwrap();
    script.coarsen(v, 2).unwrap();
    let mut values = Values::new(script.run.mesh.positions().to_vec());
    let mut control = Control { follower: Some(&mut values), ..Control::default() };
    let Run { mesh, history } = &mut script.run;
    let refined = script.dynamic.refine(mesh, history, v, 1, &mut Scratch::new(), &mut control);
    assert_eq!(refined, Err(RefineError::JoinedLate));
}

#[test]
fn a_face_and_a_selection_ask_for_their_vertices() {
    let mesh = shapes::torus(8, 6, 2.0, 1.0);
    let dynamic = Dynamic::new(Loop::default()).unwrap();
    let face = mesh.triangles().next().unwrap();
    let selection: Selection = face.corners().into_iter().collect();
    let (mut one, mut other) = (Run::new(&mesh), Run::new(&mesh));
    let (scratch, control) = (&mut Scratch::new(), &mut Control::default());
    let change = dynamic.refine(&mut one.mesh, &mut one.history, face, 2, scratch, control).unwrap();
    dynamic.refine(&mut other.mesh, &mut other.history, &selection, 2, scratch, control).unwrap();
    assert_eq!(named(&one), named(&other));
    assert!(change.t_vertices.iter().all(|t| change.added.contains(t)) && !change.o_vertices.is_empty());
    // One of two that ask: nothing goes but what the other does not need.
    dynamic.coarsen(&mut one.mesh, &mut one.history, face.corners()[0], 2, scratch).unwrap();
    assert!(one.mesh.face_count() > mesh.face_count() && one.mesh.face_count() < other.mesh.face_count());
    dynamic.coarsen(&mut other.mesh, &mut other.history, face, 2, scratch).unwrap();
    assert_eq!(other.bits(), MeshBits::of(&mesh));
}
