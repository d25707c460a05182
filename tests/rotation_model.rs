//! Edit scripts against naive models, compared and validated after every edit.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]
#![allow(clippy::print_stderr, reason = "shown only if a test fails: the seed")]

#[path = "common/gen.rs"]
mod generate;
#[path = "common/model.rs"]
mod model;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::{AtomicUsize, Ordering};

use generate::{Closed, Script, WithBoundary, check};
use model::{PlainRing, Triangles, classes, is_rotation_system, is_triangular};
use vvmesh::error::EditError;
use vvmesh::glam::DVec3;
use vvmesh::mesh::Sharpness;
use vvmesh::{DirectedEdge, Edge, Mesh, RotationSystem, VertexId};

fn id(v: usize) -> VertexId {
    VertexId::new(v)
}

fn plain(system: &RotationSystem) -> Vec<PlainRing> {
    let indices = |v| system.neighbors(v).iter().map(|w| w.index()).collect();
    system.vertices().map(|v| (indices(v), system.is_boundary(v))).collect()
}

/// How often each kind of edit was made and refused, so that a test can say that it has seen both.
struct Seen<const N: usize>([[AtomicUsize; 2]; N]);

impl<const N: usize> Seen<N> {
    const fn new() -> Self {
        Self([const { [AtomicUsize::new(0), AtomicUsize::new(0)] }; N])
    }

    fn note(&self, kind: usize, made: bool) {
        self.0[kind][usize::from(made)].fetch_add(1, Ordering::Relaxed);
    }

    fn assert_at_least(&self, times: usize) {
        let counts = self.0.each_ref().map(|[refused, made]| [refused, made].map(|n| n.load(Ordering::Relaxed)));
        assert!(counts.as_flattened().iter().all(|&n| n >= times), "[refused, made] by kind: {counts:?}");
    }
}

// Triangles: split, flip and collapse on a mesh with a crease.

static TRIANGLE_EDITS: Seen<3> = Seen::new();

/// What is sharp, ascending, with its sharpness.
type Tagged<K> = Vec<(K, Sharpness)>;

/// All that a mesh is, bit by bit.
fn state(mesh: &Mesh) -> (Vec<PlainRing>, Vec<[u64; 3]>, Tagged<Edge>, Tagged<VertexId>) {
    let bits = mesh.positions().iter().map(|p| p.to_array().map(f64::to_bits)).collect();
    (plain(mesh.rotation()), bits, edges(mesh), vertices(mesh))
}

fn edges(mesh: &Mesh) -> Tagged<Edge> {
    mesh.tags().sharp_edges().into_iter().map(|edge| (edge, mesh.tags().sharpness(edge))).collect()
}

fn vertices(mesh: &Mesh) -> Tagged<VertexId> {
    mesh.tags().sharp_vertices().into_iter().map(|v| (v, mesh.tags().vertex_sharpness(v))).collect()
}

/// Of two that become one the sharper counts.
fn merged<K: Ord>(tags: impl IntoIterator<Item = (K, Sharpness)>) -> BTreeMap<K, Sharpness> {
    let mut merged = BTreeMap::new();
    for (key, sharpness) in tags {
        let kept = merged.entry(key).or_insert(sharpness);
        *kept = if sharpness > *kept { sharpness } else { *kept };
    }
    merged
}

fn run_on_triangles(mut mesh: Mesh, script: &Script) {
    let mut triangles = Triangles::new(mesh.triangles().map(|t| t.corners().map(VertexId::index)));
    let mut sharp = BTreeMap::new();
    for (k, edge) in mesh.edges().step_by(5).collect::<Vec<_>>().into_iter().enumerate() {
        let semi_sharp = k % 3 > 0 && !mesh.rotation().is_boundary_edge(edge.ends()[0], edge.ends()[1]);
        let sharpness = if semi_sharp { Sharpness::new(0.3 * k as f64).unwrap() } else { Sharpness::INFINITE };
        mesh.set_sharpness(edge, sharpness);
        sharp.insert(edge, sharpness);
    }
    let mut corners = BTreeMap::from([(id(0), Sharpness::INFINITE), (id(1), Sharpness::new(1.5).unwrap())]);
    for (&v, &sharpness) in &corners {
        mesh.set_vertex_sharpness(v, sharpness);
    }

    for (step, &(kind, at)) in script.iter().enumerate() {
        let [a, b] = choose_edge(&mesh, kind, at);
        let before = state(&mesh);
        let is_edge = triangles.edges().contains(&[a.min(b), a.max(b)]);
        let edge = Edge::new(id(a), id(b));
        let position = DVec3::new(step as f64, f64::from(at), 0.5);
        // What stands in the ring of v where w stood; nothing if many vertices came there.
        let mut image: Box<dyn Fn(usize, usize) -> Option<usize>> = Box::new(|_, w| Some(w));
        let kind = usize::from(kind) % 3;
        let (expected, made) = match kind {
            0 => {
                let x = mesh.vertex_count();
                let (left, right) = (triangles.left(a, b), triangles.left(b, a));
                let made = mesh.split_edge(id(a), id(b), position);
                if let Ok(made) = made {
                    assert_eq!(made, id(x));
                    let ring: Vec<usize> = match (left, right) {
                        (Some(left), Some(right)) => vec![a, right, b, left],
                        (None, Some(right)) => vec![a, right, b],
                        (left, _) => vec![b, left.unwrap(), a],
                    };
                    assert_eq!(plain(mesh.rotation())[x], (ring, left.is_none() || right.is_none()));
                    if let Some(sharpness) = sharp.remove(&edge) {
                        sharp.extend([a, b].map(|end| (Edge::new(id(end), id(x)), sharpness)));
                    }
                    image = Box::new(move |v, w| Some(if (v, w) == (a, b) || (v, w) == (b, a) { x } else { w }));
                }
                (is_edge.then(|| triangles.split(a, b, x)), made.err())
            }
            1 => {
                let expected = if sharp.contains_key(&edge) { None } else { triangles.flip(a, b) };
                let made = mesh.flip(id(a), id(b));
                if let Ok(made) = made {
                    let [c, d] = [(a, b), (b, a)].map(|(a, b)| id(triangles.left(a, b).unwrap()));
                    assert_eq!(made, Edge::new(c, d));
                }
                (expected, made.err())
            }
            _ => {
                let made = mesh.collapse(id(a), id(b), position);
                if made.is_ok() {
                    assert_eq!((mesh.position(id(a)), mesh.ring(id(b)).valence()), (position, 0));
                    let moved = |v: VertexId| if v == id(b) { id(a) } else { v };
                    let moved_edge = |e: Edge| Edge::new(moved(e.ends()[0]), moved(e.ends()[1]));
                    sharp.remove(&edge);
                    sharp = merged(sharp.iter().map(|(&e, &sharpness)| (moved_edge(e), sharpness)));
                    corners = merged(corners.iter().map(|(&v, &sharpness)| (moved(v), sharpness)));
                    let rings = before.0.clone();
                    image = Box::new(move |v, w| match w {
                        _ if (v, w) == (a, b) => None,
                        _ if w == b && !rings[v].0.contains(&a) => Some(a),
                        _ => Some(w),
                    });
                }
                (triangles.collapse(a, b), made.err())
            }
        };

        TRIANGLE_EDITS.note(kind, made.is_none());
        match (expected, made) {
            (Some(expected), None) => triangles = expected,
            (None, Some(_)) => assert_eq!(state(&mesh), before, "a refused edit changed the mesh"),
            (expected, made) => panic!("edit {kind} at {a}-{b}: legal is {}, but {made:?}", expected.is_some()),
        }
        assert_eq!(edges(&mesh), sharp.iter().map(|(&edge, &sharpness)| (edge, sharpness)).collect::<Vec<_>>());
        assert_eq!(vertices(&mesh), corners.iter().map(|(&v, &sharpness)| (v, sharpness)).collect::<Vec<_>>());
        compare_with_triangles(&mesh, &triangles);
        compare_starts(&before.0, &plain(mesh.rotation()), &image);
    }
}

/// Mostly an edge, sometimes two vertices that need not be one or exist.
fn choose_edge(mesh: &Mesh, kind: u8, at: u16) -> [usize; 2] {
    let at = usize::from(at);
    if kind >= 240 {
        let count = mesh.vertex_count() + 1;
        return [at % count, at / count % count];
    }
    let edge = mesh.rotation().directed_edges().nth(at % (2 * mesh.edge_count())).unwrap();
    [edge.from.index(), edge.to.index()]
}

fn compare_with_triangles(mesh: &Mesh, triangles: &Triangles) {
    let system = mesh.rotation();
    assert_eq!(system.validate_triangles(), []);
    assert_eq!(Triangles::new(mesh.triangles().map(|t| t.corners().map(VertexId::index))), *triangles);
    assert_eq!(mesh.positions().len(), system.vertex_count());
    assert_eq!((mesh.edge_count(), mesh.face_count()), (triangles.edges().len(), triangles.0.len()));
    let faces = system.faces();
    let listed: Vec<Vec<VertexId>> = mesh.triangles().map(|t| t.corners().to_vec()).collect();
    assert_eq!(faces.iter().map(<[_]>::to_vec).collect::<Vec<_>>(), listed);

    let rings = triangles.rings().unwrap();
    for (v, (ring, open)) in plain(system).into_iter().enumerate() {
        let Some((expected, expected_open)) = rings.get(&v) else {
            assert!(ring.is_empty() && !open, "{v} is isolated");
            continue;
        };
        let shift = if open { 0 } else { expected.iter().position(|&w| w == ring[0]).unwrap() };
        let turned: Vec<usize> = expected[shift..].iter().chain(&expected[..shift]).copied().collect();
        assert_eq!((ring, open), (turned, *expected_open), "ring of {v}");
    }
    let counts = triangles.counts();
    assert_eq!(system.euler_characteristic(), counts.euler_characteristic);
    assert_eq!(system.components().len(), counts.components);
    assert_eq!(system.boundary_loops().len(), counts.loops);
    assert_eq!(system.genus(), counts.genus);
}

/// A ring starts where it did: at the first of the old neighbours, or what came in its place, that is still there.
fn compare_starts(before: &[PlainRing], after: &[PlainRing], image: &dyn Fn(usize, usize) -> Option<usize>) {
    for (v, (old, new)) in before.iter().zip(after).enumerate().filter(|(_, (old, new))| old.1 == new.1) {
        let mut images = old.0.iter().map(|&w| image(v, w));
        let first = images.find(|w| w.is_none_or(|w| new.0.contains(&w))).flatten();
        assert!(first.is_none() || first == new.0.first().copied(), "start of {v}: {old:?} became {new:?}");
    }
}

#[test]
fn edits_of_triangles_agree_with_a_set_of_triangles() {
    check(300, (|case: Closed| run_on_triangles(case.mesh(), &case.script)) as fn(Closed));
    check(300, (|case: WithBoundary| run_on_triangles(case.mesh(), &case.script)) as fn(WithBoundary));
    TRIANGLE_EDITS.assert_at_least(100);
}

// Faces of any number of sides: split, insert and delete on a rotation system.

static GENERAL_EDITS: Seen<4> = Seen::new();

/// Cycles of vertices, faces or boundary loops, turned so that equal ones are equal.
fn turned(cycle: &[usize]) -> Vec<usize> {
    let turns = (0..cycle.len()).map(|k| [&cycle[k..], &cycle[..k]].concat());
    turns.min().unwrap()
}

fn cycles<'a>(lists: impl Iterator<Item = &'a [VertexId]>) -> Vec<Vec<usize>> {
    let mut cycles: Vec<_> = lists.map(|list| turned(&list.iter().map(|v| v.index()).collect::<Vec<_>>())).collect();
    cycles.sort();
    cycles
}

/// Faces as plain cycles, with the boundary loops among them.
struct Faces(Vec<(Vec<usize>, bool)>);

impl Faces {
    /// The face left of an edge, and where the edge starts in it.
    fn left(&self, edge: DirectedEdge) -> (usize, usize) {
        let ends = (edge.from.index(), edge.to.index());
        let find = |cycle: &[usize]| (0..cycle.len()).find(|&k| (cycle[k], cycle[(k + 1) % cycle.len()]) == ends);
        self.0.iter().enumerate().find_map(|(f, (cycle, _))| Some((f, find(cycle)?))).unwrap()
    }

    /// The cycle of a face from one of its places on.
    fn from(&self, (face, place): (usize, usize)) -> Vec<usize> {
        let cycle = &self.0[face].0;
        [&cycle[place..], &cycle[..place]].concat()
    }

    fn sorted(&self, holes: bool) -> Vec<Vec<usize>> {
        let mut cycles: Vec<_> = self.0.iter().filter(|f| f.1 == holes).map(|(cycle, _)| turned(cycle)).collect();
        cycles.sort();
        cycles
    }
}

fn run_on_faces(mut system: RotationSystem, script: &Script) {
    let as_cycles = |lists: Vec<Vec<usize>>, hole| lists.into_iter().map(move |cycle| (cycle, hole));
    let genus = system.genus();
    let mut faces = Faces(as_cycles(cycles(system.faces().iter()), false).collect());
    faces.0.extend(as_cycles(cycles(system.boundary_loops().iter()), true));
    for &(kind, at) in script {
        let at = usize::from(at);
        let edges: Vec<DirectedEdge> = system.directed_edges().collect();
        let edge = edges[at % edges.len()];
        let (here, back) = (faces.left(edge), faces.left(edge.reversed()));
        let before = plain(&system);
        let kind = usize::from(kind) % 4;
        let made = match kind {
            0 => {
                let made = system.split_edge(edge.from, edge.to);
                // Both sides of an edge are a gap only if it is all that its component has.
                let legal = !(faces.0[here.0].1 && faces.0[back.0].1);
                assert_eq!(made.is_ok(), legal, "{made:?}");
                if let Ok(x) = made {
                    for edge in [edge, edge.reversed()] {
                        let (face, place) = faces.left(edge);
                        faces.0[face].0.insert(place + 1, x.index());
                    }
                }
                legal
            }
            1 => {
                let made = system.delete_edge(edge.from, edge.to);
                let legal = here.0 != back.0 && !faces.0[here.0].1 && !faces.0[back.0].1;
                assert_eq!(made.is_ok(), legal, "{made:?}");
                if legal {
                    let merged = [&faces.from(here)[1..], &faces.from(back)[1..]].concat();
                    faces.0[here.0].0 = merged;
                    faces.0.remove(back.0);
                }
                legal
            }
            2 => {
                // Mostly a corner of the same face.
                let steps = at / edges.len();
                let cycle = faces.from(here);
                let corner = |k: usize| id(cycle[k % cycle.len()]);
                let other = match steps % 5 {
                    4 => edges[(at / 7) % edges.len()],
                    _ => DirectedEdge::new(corner(steps), corner(steps + 1)),
                };
                let there = faces.left(other);
                let (a, b) = (edge.from, other.from);
                let legal =
                    here.0 == there.0 && !faces.0[here.0].1 && a != b && !before[a.index()].0.contains(&b.index());
                let made = system.insert_edge(edge, other);
                assert_eq!(made.is_ok(), legal, "{made:?}");
                if legal {
                    let cycle = faces.from(here);
                    let cut = (there.1 + cycle.len() - here.1) % cycle.len();
                    // One face keeps a .. b and comes back from b to a, the other the rest.
                    faces.0[here.0].0 = cycle[..=cut].to_vec();
                    faces.0.push(([&cycle[cut..], &cycle[..1]].concat(), false));
                }
                legal
            }
            _ => {
                // A new vertex on a stalk, in the corner where the edge starts; in a gap that makes a loop longer only if
                // the new ring has a gap too, so here it is refused.
                let made = add_stalk(&mut system, edge);
                let legal = !faces.0[here.0].1;
                assert_eq!(made.is_ok(), legal, "{made:?}");
                if let Ok(x) = made {
                    let place = here.1;
                    faces.0[here.0].0.splice(place..place, [edge.from.index(), x.index()]);
                }
                legal
            }
        };
        GENERAL_EDITS.note(kind, made);
        if !made {
            assert_eq!(plain(&system), before, "a refused edit changed the system");
        }
        compare_with_faces(&system, &faces, genus);
    }
}

/// Puts a new vertex next to the start of an edge, in the corner on its left.
fn add_stalk(system: &mut RotationSystem, corner: DirectedEdge) -> Result<VertexId, EditError> {
    let mut transaction = system.transaction();
    let x = transaction.add_vertex()?;
    transaction.make(x, &[corner.from])?;
    transaction.splice_after(corner.from, corner.to, x)?;
    transaction.commit()?;
    Ok(x)
}

fn compare_with_faces(system: &RotationSystem, faces: &Faces, genus: usize) {
    assert_eq!(system.validate(), []);
    assert_eq!(cycles(system.faces().iter()), faces.sorted(false));
    assert_eq!(cycles(system.boundary_loops().iter()), faces.sorted(true));
    assert_eq!(system.genus(), genus);

    let rings = plain(system);
    let used: BTreeSet<usize> = (0..rings.len()).filter(|&v| !rings[v].0.is_empty()).collect();
    let pairs = rings.iter().enumerate().flat_map(|(v, (ring, _))| ring.iter().map(move |&w| (v, w)));
    let components = system.components();
    assert_eq!(components.len(), classes(&used, pairs));
    assert!(components.iter().all(<[_]>::is_sorted) && components.iter().map(|c| c[0]).is_sorted());
    assert_eq!(components.iter().flatten().map(|v| v.index()).collect::<BTreeSet<_>>(), used);

    // Every list starts where it says, and they come in that order.
    let number: BTreeMap<DirectedEdge, usize> = system.directed_edges().zip(0..).collect();
    let mut starts = Vec::new();
    for face in system.faces().iter() {
        let edges: Vec<DirectedEdge> =
            (0..face.len()).map(|k| DirectedEdge::new(face[k], face[(k + 1) % face.len()])).collect();
        assert_eq!(system.face(edges[0]).unwrap().collect::<Vec<_>>(), edges);
        starts.push(number[&edges[0]]);
        assert_eq!(edges.iter().map(|edge| number[edge]).min(), starts.last().copied());
    }
    assert!(starts.is_sorted());
    let loops = system.boundary_loops();
    assert!(
        loops.iter().all(|cycle| cycle.iter().min() == cycle.first()) && loops.iter().map(|cycle| cycle[0]).is_sorted()
    );

    for v in system.vertices() {
        let ring = system.ring(v);
        for w in ring {
            assert!(ring.next(w).is_none_or(|after| ring.prev(after) == Some(w)));
            assert!(ring.prev(w).is_none_or(|before| ring.next(before) == Some(w)));
            assert_eq!(ring.next(w).is_none(), ring.is_open() && ring.neighbors().last() == Some(&w));
        }
    }
}

#[test]
fn edits_of_any_faces_agree_with_lists_of_faces() {
    check(150, (|case: Closed| run_on_faces(case.mesh().rotation().clone(), &case.script)) as fn(Closed));
    check(150, (|case: WithBoundary| run_on_faces(case.mesh().rotation().clone(), &case.script)) as fn(WithBoundary));
    for kind in 1..4 {
        let [refused, made] = GENERAL_EDITS.0[kind].each_ref().map(|n| n.load(Ordering::Relaxed));
        assert!(refused >= 50 && made >= 50, "kind {kind}: {refused} refused, {made} made");
    }
}

// Raw edits: a transaction against plain lists.

static COMMITS: Seen<2> = Seen::new();

/// A raw edit, in the words of the transaction.
#[derive(Clone, Debug)]
enum Raw {
    Add,
    Make(usize, Vec<usize>),
    After(usize, usize, usize),
    Before(usize, usize, usize),
    Replace(usize, usize, usize),
    Erase(usize, usize),
    Open(usize, usize),
    Close(usize),
}

fn apply(transaction: &mut vvmesh::rotation::Transaction<'_>, raw: &Raw) -> bool {
    let made = match *raw {
        Raw::Add => transaction.add_vertex().map(|_| ()),
        Raw::Make(v, ref ring) => transaction.make(id(v), &ring.iter().map(|&w| id(w)).collect::<Vec<_>>()),
        Raw::After(v, a, x) => transaction.splice_after(id(v), id(a), id(x)),
        Raw::Before(v, a, x) => transaction.splice_before(id(v), id(a), id(x)),
        Raw::Replace(v, a, x) => transaction.replace(id(v), id(a), id(x)),
        Raw::Erase(v, a) => transaction.erase(id(v), id(a)),
        Raw::Open(v, a) => transaction.open_gap(id(v), id(a)),
        Raw::Close(v) => transaction.close_gap(id(v)),
    };
    made.is_ok()
}

/// The same on plain lists; `None` if it is not allowed.
fn apply_to_lists(rings: &[PlainRing], raw: &Raw) -> Option<Vec<PlainRing>> {
    let mut rings = rings.to_vec();
    let count = rings.len();
    let place = |v: usize, a: usize| rings.get(v)?.0.iter().position(|&w| w == a);
    let fits = |v: usize, x: usize| x < count && x != v && !rings[v].0.contains(&x);
    match *raw {
        Raw::Add => rings.push((vec![], false)),
        Raw::Make(v, ref ring) => {
            let distinct = ring.iter().collect::<BTreeSet<_>>().len() == ring.len();
            if v >= count || !distinct || !ring.iter().all(|&w| w < count && w != v) {
                return None;
            }
            rings[v] = (ring.clone(), false);
        }
        Raw::After(v, a, x) => {
            let k = place(v, a).filter(|_| fits(v, x))?;
            rings[v].0.insert(k + 1, x);
        }
        Raw::Before(v, a, x) => {
            let k = place(v, a).filter(|_| fits(v, x))?;
            let at_end = k == 0 && !rings[v].1;
            let k = if at_end { rings[v].0.len() } else { k };
            rings[v].0.insert(k, x);
        }
        Raw::Replace(v, a, x) => {
            let k = place(v, a).filter(|_| fits(v, x))?;
            rings[v].0[k] = x;
        }
        Raw::Erase(v, a) => {
            let k = place(v, a)?;
            rings[v].0.remove(k);
            rings[v].1 &= !rings[v].0.is_empty();
        }
        Raw::Open(v, a) => {
            let k = place(v, a).filter(|_| !rings[v].1)?;
            rings[v].0.rotate_left(k + 1);
            rings[v].1 = true;
        }
        Raw::Close(v) => {
            rings.get(v).filter(|ring| ring.1)?;
            rings[v].1 = false;
        }
    }
    Some(rings)
}

/// Raw edits that belong together, so that some transactions can be committed, or one taken at random.
fn raw_edits(rings: &[PlainRing], kind: u8, at: u16) -> Vec<Raw> {
    let at = usize::from(at);
    let edges: Vec<[usize; 2]> =
        rings.iter().enumerate().flat_map(|(v, ring)| ring.0.iter().map(move |&w| [v, w])).collect();
    let Some(&[a, b]) = edges.get(at % edges.len().max(1)) else { return vec![Raw::Add] };
    let beside = |v: usize, w: usize, step: usize| {
        let ring = &rings[v].0;
        ring.iter().position(|&u| u == w).map_or(w, |k| ring[(k + ring.len() + step - 1) % ring.len()])
    };
    let (left, right, x) = (beside(a, b, 2), beside(a, b, 0), rings.len());
    let any = (at / 5) % (rings.len() + 1);
    match kind % 12 {
        0 => vec![Raw::Erase(a, b), Raw::Erase(b, a)],
        1 => vec![Raw::Erase(a, b), Raw::Erase(b, a), Raw::After(left, a, right), Raw::After(right, b, left)],
        2 => vec![
            Raw::Add,
            Raw::Replace(a, b, x),
            Raw::Replace(b, a, x),
            Raw::Before(left, b, x),
            Raw::Before(right, a, x),
            Raw::Make(x, vec![a, right, b, left]),
        ],
        3 => {
            // The face left of the edge becomes a hole.
            let mut cycle = vec![[a, b]];
            while cycle.len() < 20 {
                let [v, w] = cycle[cycle.len() - 1];
                let next = [w, beside(w, v, 0)];
                if next == [a, b] {
                    break;
                }
                cycle.push(next);
            }
            cycle.into_iter().map(|[v, w]| Raw::Open(v, w)).collect()
        }
        4 => {
            // The boundary loop through a vertex becomes a face.
            let mut cycle = vec![a];
            while let Some(&w) = rings[cycle[cycle.len() - 1]].0.last().filter(|&w| !cycle.contains(w)) {
                cycle.push(w);
            }
            cycle.into_iter().map(Raw::Close).collect()
        }
        5 => vec![Raw::Add, Raw::Make(x, vec![a]), Raw::After(a, b, x)],
        6 => vec![Raw::Add],
        7 => vec![Raw::After(a, b, any)],
        8 => vec![Raw::Before(a, b, any), Raw::Close(any)],
        9 => vec![Raw::Replace(a, b, any)],
        10 => vec![Raw::Make(any, vec![a, b]), Raw::Make(a, vec![b, any, b])],
        _ => vec![Raw::Erase(a, any), Raw::Open(a, b)],
    }
}

fn run_on_transaction(mut system: RotationSystem, script: &Script) {
    let start = plain(&system);
    let mut rings = start.clone();
    let mut transaction = system.transaction();
    for &(kind, at) in script.iter().take(4) {
        let mut raws = raw_edits(&rings, kind, at);
        if at % 8 == 0 {
            raws.pop();
        }
        for raw in raws {
            let expected = apply_to_lists(&rings, &raw);
            assert_eq!(apply(&mut transaction, &raw), expected.is_some(), "{raw:?}");
            rings = expected.unwrap_or(rings);
            assert_eq!(transaction.vertex_count(), rings.len());
            for (v, ring) in rings.iter().enumerate() {
                let read = transaction.ring(id(v));
                assert_eq!((read.iter().map(|w| w.index()).collect(), read.is_open()), *ring, "{raw:?}");
            }
        }
    }
    let triangles = script.len() % 2 == 1;
    let legal = is_rotation_system(&rings) && (!triangles || is_triangular(&rings));
    if script.len() % 5 == 4 {
        drop(transaction);
        rings = start;
    } else {
        let committed = if triangles { transaction.commit_triangles() } else { transaction.commit() };
        COMMITS.note(usize::from(triangles), committed.is_ok());
        assert_eq!(committed.is_ok(), legal, "{committed:?}");
        if !legal {
            rings = start;
        }
    }
    assert_eq!(plain(&system), rings);
    assert_eq!(system.validate(), []);
    let edges = rings.iter().map(|ring| ring.0.len()).sum::<usize>() / 2;
    assert_eq!((system.edge_count(), system.boundary_edge_count()), (edges, rings.iter().filter(|r| r.1).count()));
}

#[test]
fn transactions_agree_with_plain_lists() {
    check(1500, (|case: Closed| run_on_transaction(case.mesh().rotation().clone(), &case.script)) as fn(Closed));
    check(
        1500,
        (|case: WithBoundary| run_on_transaction(case.mesh().rotation().clone(), &case.script)) as fn(WithBoundary),
    );
    COMMITS.assert_at_least(100);
}
