//! Every scheme with every method and every criterion: what the table promises holds after three steps, and what it refuses is
//! refused when it is made.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use common::run::{Beside, MeshBits, Run, bits};
use vvmesh::adaptive::Uniform;
use vvmesh::certify::Certificate;
use vvmesh::check::mesh_conformity;
use vvmesh::glam::DVec3;
use vvmesh::limit::{Limit, LoopLimit};
use vvmesh::scheme::AnyScheme;
use vvmesh::scratch::Scratch;
use vvmesh::select::{All, Criterion, Dihedral, Disk, Expression, Selection, Sphere, Vertices};
use vvmesh::subdivide::{AnyMethod, Promise, Subdivider, promise};
use vvmesh::{Accuracy, Angle, Mesh, VertexId, shapes};

const STEPS: usize = 3;

/// What is near enough for *mobile*: some vertices of the meshes are, some not.
const ACCURACY: f64 = 0.1;

fn accuracy() -> Accuracy {
    Accuracy::new(ACCURACY).unwrap()
}

fn schemes() -> [AnyScheme; 6] {
    AnyScheme::NAMES.map(|name| AnyScheme::named(name).unwrap())
}

fn methods() -> [AnyMethod; 7] {
    AnyMethod::NAMES.map(|name| AnyMethod::named(name, Some(accuracy())).unwrap())
}

/// A closed mesh and one with a boundary, both uneven.
fn meshes() -> [Mesh; 2] {
    [shapes::torus(9, 7, 2.0, 0.9), shapes::grid(7, 6)].map(|mut mesh| {
        for (k, position) in mesh.positions_mut().iter_mut().enumerate() {
            *position += 0.2 * DVec3::new((k * k) as f64, (3 * k) as f64, (7 * k + 1) as f64).map(f64::sin);
        }
        mesh
    })
}

/// Every criterion, and combinations.
fn criteria() -> Vec<(&'static str, Box<dyn Criterion>)> {
    let patch: Selection = [16, 17, 18, 24, 25, 26, 32].map(VertexId::new).into_iter().collect();
    let parsed = |text| Expression::parse(text, &mut |_: &Path| Ok(String::new())).unwrap();
    vec![
        ("all", Box::new(All)),
        ("vertices", Box::new(Vertices::new(patch))),
        ("disk", Box::new(Disk::new(VertexId::new(20), 1))),
        ("sphere", Box::new(Sphere::new(DVec3::new(2.0, 1.0, 0.0), 1.6).unwrap())),
        ("dihedral", Box::new(Dihedral::new(Angle::from_deg(12.0)).unwrap())),
        ("and, not", Box::new(Disk::new(VertexId::new(30), 2).and(Disk::new(VertexId::new(33), 1).not()))),
        ("limit error", Box::new(parsed("limit-error:1%"))),
        ("edges", Box::new(parsed("edge-length:1.1"))),
        ("faces", Box::new(parsed("area:0.6"))),
        ("an expression", Box::new(parsed("disk:10,1 | disk:40,1 & !vertices:41"))),
        ("a closure", Box::new(|mesh: &Mesh| mesh.vertices().filter(|v| v.index() % 5 < 3).collect::<Selection>())),
    ]
}

/// The uniform run after no step, one, and so on.
fn uniform_levels(mesh: &Mesh, scheme: &AnyScheme) -> Vec<Run> {
    let subdivider = Subdivider::new(scheme.clone(), Uniform);
    let mut levels = vec![Run::new(mesh)];
    for k in 0..STEPS {
        let mut run = levels[k].clone();
        run.step(&subdivider, &Selection::empty());
        levels.push(run);
    }
    levels
}

#[test]
fn what_is_refused_is_refused_when_it_is_made_with_the_reason() {
    let mut refused = 0;
    for (scheme, method) in schemes().into_iter().flat_map(|scheme| methods().map(|method| (scheme.clone(), method))) {
        let said = promise(&scheme, method.name());
        let made = Subdivider::of(scheme.clone(), method);
        if let Err(error) = said {
            assert_eq!(made.unwrap_err(), error);
            assert_eq!((error.name, error.value.as_str()), ("scheme", scheme.name()));
            assert!(error.expected.len() > 20);
            refused += 1;
        } else {
            assert!(made.is_ok(), "{} {method}", scheme.name());
        }
    }
    assert_eq!(refused, 3 * 2 + 5);
    assert!(promise(&schemes()[0], "unheard-of").is_err());
}

#[test]
fn what_is_promised_holds() {
    let mut seen = BTreeMap::new();
    for mesh in meshes() {
        for scheme in schemes() {
            let uniform = uniform_levels(&mesh, &scheme);
            for method in methods() {
                let Ok(promise) = promise(&scheme, method.name()) else { continue };
                let subdivider = Subdivider::of(scheme.clone(), method).unwrap();
                for (name, criterion) in criteria() {
                    let what = format!("{} by {method} on {name}", scheme.name());
                    let selection = criterion.select(&mesh, &mut Scratch::new()).unwrap();
                    assert!(!selection.is_empty(), "{what}");
                    let checked = holds(promise, &mesh, &subdivider, selection, &uniform, &what);
                    *seen.entry(promise as u8).or_insert(0) += checked;
                }
            }
        }
    }
    assert_eq!(seen.len(), 6);
    assert!(seen.values().all(|&checked| checked > 1000), "{seen:?}");
}

/// Three steps: the mesh conforms after each and the promise holds. Answers for how many vertices it was looked at.
fn holds(
    promise: Promise,
    mesh: &Mesh,
    subdivider: &Subdivider,
    mut selection: Selection,
    uniform: &[Run],
    what: &str,
) -> usize {
    let mut run = Run::new(mesh);
    for k in 0..STEPS {
        let before = run.mesh.clone();
        let step = run.step(subdivider, &selection);
        assert!(mesh_conformity(&run.mesh, None).is_conforming(), "{what}");
        // Later on who may move depends on the steps before.
        if promise == Promise::Accuracy && k == 0 {
            assert_moves_what_is_far(&before, &selection, &run.mesh, what);
        }
        selection = step.selection;
    }
    if promise == Promise::Accuracy {
        return run.mesh.vertex_count();
    }
    let finest = uniform.last().unwrap();
    let beside = Beside::new(&run, finest);
    let is_there = |v: &VertexId| run.mesh.ring(*v).valence() > 0;
    match promise {
        Promise::Uniform => {
            assert!(run.bits() == MeshBits::of(&finest.mesh), "{what}");
            run.mesh.vertex_count()
        }
        Promise::Selected => {
            let exact = |v: &VertexId| beside.position_is_same(*v) && beside.rotation_is_same(*v);
            assert!(selection.vertices().iter().all(exact), "{what}");
            selection.len()
        }
        Promise::Levels | Promise::NearlyLevels => {
            let nearly = promise == Promise::NearlyLevels;
            for v in run.mesh.vertices().filter(is_there) {
                let twin = beside.twin(v).unwrap();
                let there = uniform.iter().filter(|level| twin.index() < level.mesh.vertex_count());
                let is_at = |level: &Run| {
                    let (here, there) = (run.mesh.position(v), level.mesh.position(twin));
                    bits(here) == bits(there) || nearly && here.distance(there) < 1e-12
                };
                assert!(there.into_iter().any(is_at), "{what}: {v}");
            }
            run.mesh.vertex_count()
        }
        Promise::Certified => {
            let certificate = Certificate::new(&run.mesh, &run.history).unwrap();
            let certified: Vec<VertexId> = certificate.certified().collect();
            assert!(certified.iter().all(|&v| beside.star_is_same(v)), "{what}");
            certified.len()
        }
        Promise::Accuracy => unreachable!("it was looked at in the first step"),
    }
}

/// What is selected and farther from its limit moves, all else stays.
fn assert_moves_what_is_far(before: &Mesh, selection: &Selection, after: &Mesh, what: &str) {
    for v in before.vertices() {
        let far = LoopLimit::default().position(before, v).distance(before.position(v)) > ACCURACY;
        let moved = before.position(v) != after.position(v);
        assert_eq!(moved, far && selection.contains(v), "{what}: {v}");
    }
}

// The table in the README.

const MARKS: [&str; 2] = ["<!-- written by tests/combinations.rs -->\n", "<!-- end -->\n"];

fn readme() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("README.md")
}

/// The table of all pairs, with the reasons below.
fn table() -> String {
    let word = |promise| match promise {
        Promise::Uniform => "all",
        Promise::Selected => "selected",
        Promise::Levels => "levels",
        Promise::NearlyLevels => "levels, rounded",
        Promise::Certified => "certified",
        Promise::Accuracy => "accuracy",
    };
    let mut text =
        format!("\n| | {} |\n|{}\n", AnyScheme::NAMES.join(" | "), "---|".repeat(AnyScheme::NAMES.len() + 1));
    let mut reasons = BTreeMap::<String, BTreeSet<&str>>::new();
    for method in AnyMethod::NAMES {
        let cell = |scheme: &AnyScheme| match promise(scheme, method) {
            Ok(promise) => word(promise),
            Err(error) => {
                reasons.entry(error.expected).or_default().insert(method);
                "–"
            }
        };
        let _ = writeln!(text, "| `{method}` | {} |", schemes().each_ref().map(cell).join(" | "));
    }
    text.push('\n');
    text.extend(reasons.into_iter().map(|(reason, methods)| {
        let methods: Vec<&str> = methods.into_iter().collect();
        format!("- no `{}`: {reason}.\n", methods.join("`, `"))
    }));
    text.push('\n');
    text
}

/// The README with what stands between the marks, and what does.
fn parts(readme: &str) -> [&str; 3] {
    let (before, rest) = readme.split_once(MARKS[0]).unwrap();
    let (table, after) = rest.split_once(MARKS[1]).unwrap();
    [before, table, after]
}

#[test]
fn the_table_in_the_readme_is_up_to_date() {
    // A checkout may have changed the ends of lines.
    let readme = fs::read_to_string(readme()).unwrap().replace('\r', "");
    let [_, written, _] = parts(&readme);
    let advice = "is old: run `cargo test --test combinations -- --ignored`";
    assert!(written == table(), "the table of schemes and methods {advice}");
}

#[test]
#[ignore = "it writes the README"]
fn write_the_table() {
    let old = fs::read_to_string(readme()).unwrap().replace('\r', "");
    let [before, _, after] = parts(&old);
    fs::write(readme(), [before, MARKS[0], &table(), MARKS[1], after].concat()).unwrap();
}
