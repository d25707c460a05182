//! Random meshes, selections and seeds for quickcheck.
//!
//! What is generated is a **script**: a base shape and a list of numbers that are read as edits. So shrinking is that of
//! lists, and a failure prints a short script. Edits work on a bare list of triangles, so nothing that is tested takes
//! part in making the mesh but [`Mesh::from_triangles`], which also judges whether an edit leaves a manifold.

use std::collections::{BTreeMap, BTreeSet};

use quickcheck::{Arbitrary, Gen, QuickCheck, Testable};
use vvmesh::glam::DVec3;
use vvmesh::mesh::{Sharpness, SharpnessRule};
use vvmesh::select::Selection;
use vvmesh::{Edge, Mesh, VertexId, shapes};

/// Tries a property on `tests` random cases from a fixed seed. `VV_SEED` takes another one, `VV_TESTS` more cases.
pub fn check(seed: u64, tests: u64, property: impl Testable) {
    check_up_to(40, seed, tests, property);
}

/// The same with lists of any length below `size`.
#[allow(clippy::print_stderr, reason = "shown only when the test fails")]
pub fn check_up_to(size: usize, seed: u64, tests: u64, property: impl Testable) {
    let number = |name| std::env::var(name).ok().and_then(|text: String| text.parse().ok());
    let (seed, tests) = (number("VV_SEED").unwrap_or(seed), number("VV_TESTS").unwrap_or(tests));
    eprintln!("seed {seed}, {tests} cases");
    QuickCheck::new()
        .rng(Gen::from_size_and_seed(size, seed))
        .tests(tests)
        // Else there are 10,000 at most, of which those that a property turns down are no tests.
        .max_tests(tests.saturating_mul(100))
        .min_tests_passed(tests)
        .quickcheck(property);
}

/// Valences that edits may leave.
const VALENCES: std::ops::RangeInclusive<usize> = 3..=12;

/// A script for a mesh of some 60 to 250 faces.
#[derive(Clone, Debug)]
pub struct Script {
    base: u8,
    seed: u16,
    edits: Vec<(u8, u16)>,
    open: bool,
}

/// A script for a mesh without boundary, of genus 0 to about 3.
#[derive(Clone, Debug)]
pub struct Closed(Script);

/// A script for a mesh with boundary loops, in most cases several.
#[derive(Clone, Debug)]
pub struct WithBoundary(Script);

/// What a property takes to work on both kinds.
pub trait Surface: Arbitrary + std::fmt::Debug {
    /// The mesh that the script makes.
    fn mesh(&self) -> Mesh;
}

impl Script {
    fn arbitrary(g: &mut Gen, open: bool) -> Self {
        Self { base: u8::arbitrary(g), seed: u16::arbitrary(g), edits: Vec::arbitrary(g), open }
    }

    fn shrink(&self) -> impl Iterator<Item = Self> + use<> {
        let whole = self.clone();
        self.edits.shrink().map(move |edits| Self { edits, ..whole.clone() })
    }

    fn mesh(&self) -> Mesh {
        let mut draft = Draft::of(&self.base(), self.seed);
        if self.open {
            draft.remove_faces(usize::from(self.seed));
        }
        for &(kind, k) in &self.edits {
            draft.edit(kind, usize::from(k), self.open);
        }
        draft.finish()
    }

    fn base(&self) -> Mesh {
        match (self.base % 4, self.open) {
            (0, true) => shapes::grid(8, 6),
            (1, true) => shapes::grid(16, 3),
            (0 | 1, false) => quadrisected(&shapes::icosahedron()),
            (2, _) => shapes::torus(9, 6, 2.0, 1.0),
            _ => quadrisected(&quadrisected(&shapes::octahedron())),
        }
    }
}

macro_rules! domain {
    ($name:ident, $open:expr) => {
        impl Arbitrary for $name {
            fn arbitrary(g: &mut Gen) -> Self {
                Self(Script::arbitrary(g, $open))
            }

            fn shrink(&self) -> Box<dyn Iterator<Item = Self>> {
                Box::new(self.0.shrink().map(Self))
            }
        }

        impl Surface for $name {
            fn mesh(&self) -> Mesh {
                self.0.mesh()
            }
        }
    };
}

domain!(Closed, false);
domain!(WithBoundary, true);

/// A mesh in the making: triangles in no order, and tags.
struct Draft {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    sharp: BTreeSet<[u32; 2]>,
    corners: BTreeSet<u32>,
}

impl Draft {
    /// The triangles of a mesh, every vertex moved a little so that no symmetry hides a difference.
    fn of(mesh: &Mesh, seed: u16) -> Self {
        let mut random = Random::new(u64::from(seed));
        let positions = mesh.positions().iter().map(|&p| p + 0.1 * random.vector()).collect();
        Self { positions, triangles: triangles(mesh), sharp: BTreeSet::new(), corners: BTreeSet::new() }
    }

    fn edit(&mut self, kind: u8, k: usize, open: bool) {
        let face = k % self.triangles.len();
        let edges = self.edges();
        let (&edge, sides) = edges.iter().nth(k % edges.len()).expect("there are faces");
        match kind % 16 {
            0..=5 => self.flip(edge, sides),
            6 | 7 => self.split(edge, sides),
            8 => self.insert(face),
            9 => self.tube(face, k / 7),
            10 | 11 => self.crease(k, &edges),
            12 => {
                self.corners.insert(edge[0]);
            }
            13 | 14 if open => self.remove_faces(k),
            _ => self.positions[edge[0] as usize] += 0.2 * Random::new(k as u64).vector(),
        }
    }

    /// Every edge with the third corners of its triangles and the triangles.
    fn edges(&self) -> BTreeMap<[u32; 2], Vec<(u32, usize)>> {
        let mut edges: BTreeMap<[u32; 2], Vec<(u32, usize)>> = BTreeMap::new();
        for (k, &[a, b, c]) in self.triangles.iter().enumerate() {
            for (p, q, third) in [(a, b, c), (b, c, a), (c, a, b)] {
                edges.entry([p.min(q), p.max(q)]).or_default().push((third, k));
            }
        }
        edges
    }

    /// Takes other triangles if they make a manifold whose valences are within bounds.
    fn try_triangles(&mut self, triangles: Vec<[u32; 3]>) -> bool {
        let Ok(mesh) = Mesh::from_triangles(self.positions.clone(), &triangles) else { return false };
        let bounded = mesh.vertices().map(|v| mesh.ring(v)).all(|ring| {
            let n = ring.valence();
            n == 0 || VALENCES.contains(&n) || (n == 2 && ring.is_open())
        });
        if bounded && !triangles.is_empty() {
            self.triangles = triangles;
        }
        bounded
    }

    fn replace(&mut self, removed: &[usize], added: &[[u32; 3]]) -> bool {
        let kept = self.triangles.iter().enumerate().filter(|(k, _)| !removed.contains(k)).map(|(_, &t)| t);
        let triangles = kept.chain(added.iter().copied()).collect();
        self.try_triangles(triangles)
    }

    fn flip(&mut self, [a, b]: [u32; 2], sides: &[(u32, usize)]) {
        if let &[(c, one), (d, other)] = sides {
            // The triangle at `c` runs along a -> b or b -> a.
            let (a, b) = if runs(self.triangles[one], a, b) { (a, b) } else { (b, a) };
            self.replace(&[one, other], &[[c, a, d], [d, b, c]]);
        }
    }

    fn split(&mut self, [a, b]: [u32; 2], sides: &[(u32, usize)]) {
        let x = self.positions.len() as u32;
        self.positions.push((self.positions[a as usize] + self.positions[b as usize]) * 0.5);
        let halves = |&(_, k): &(u32, usize)| {
            let half = |from, to| self.triangles[k].map(|v| if v == from { to } else { v });
            [half(a, x), half(b, x)]
        };
        let added: Vec<[u32; 3]> = sides.iter().flat_map(halves).collect();
        let removed: Vec<usize> = sides.iter().map(|side| side.1).collect();
        self.replace(&removed, &added);
    }

    fn insert(&mut self, face: usize) {
        let [a, b, c] = self.triangles[face];
        let x = self.positions.len() as u32;
        let sum: DVec3 = [a, b, c].iter().map(|&v| self.positions[v as usize]).sum();
        self.positions.push(sum / 3.0);
        self.replace(&[face], &[[a, b, x], [b, c, x], [c, a, x]]);
    }

    /// Puts a tube between two faces: one more handle.
    fn tube(&mut self, face: usize, steps: usize) {
        let other = (face + 3 + steps) % self.triangles.len();
        let ([a, b, c], [d, e, f]) = (self.triangles[face], self.triangles[other]);
        if face != other {
            // The far face runs the other way round, so its corners stand opposite as d, f, e.
            self.replace(&[face, other], &[[a, b, d], [b, f, d], [b, c, f], [c, e, f], [c, a, e], [a, d, e]]);
        }
    }

    /// Tags a chain of edges that runs on as straight as its numbers go.
    fn crease(&mut self, k: usize, edges: &BTreeMap<[u32; 2], Vec<(u32, usize)>>) {
        let [mut a, mut b] = *edges.keys().nth(k % edges.len()).expect("there are faces");
        for _ in 0..1 + k % 5 {
            self.sharp.insert([a.min(b), a.max(b)]);
            let far = |v: u32| (self.positions[v as usize] - self.positions[a as usize]).length();
            let ends = edges.keys().filter(|edge| edge.contains(&b)).map(|edge| edge[0] + edge[1] - b);
            let next = ends.max_by(|&v, &w| far(v).total_cmp(&far(w))).expect("it has a neighbour");
            (a, b) = (b, next);
        }
    }

    /// Takes out a face, and most times its neighbours too.
    fn remove_faces(&mut self, k: usize) {
        // Enough is left to select in.
        if self.triangles.len() < 50 {
            return;
        }
        let center = self.triangles[k % self.triangles.len()];
        let removed: Vec<usize> = match k % 3 {
            0 => vec![k % self.triangles.len()],
            1 => self.touching(&center[..1]),
            _ => self.touching(&center[..2]),
        };
        self.replace(&removed, &[]);
    }

    fn touching(&self, vertices: &[u32]) -> Vec<usize> {
        let touches = |t: &[u32; 3]| t.iter().any(|v| vertices.contains(v));
        (0..self.triangles.len()).filter(|&k| touches(&self.triangles[k])).collect()
    }

    fn finish(self) -> Mesh {
        let mut mesh = Mesh::from_triangles(self.positions, &self.triangles).expect("edits keep a manifold");
        let id = |v: u32| VertexId::new(v as usize);
        for [a, b] in self.sharp {
            // Tags of edges that were flipped away since are left out.
            mesh.set_sharp(Edge::new(id(a), id(b)), true);
        }
        for v in self.corners {
            mesh.set_corner(id(v), true);
        }
        mesh
    }
}

fn runs([a, b, c]: [u32; 3], p: u32, q: u32) -> bool {
    [(a, b), (b, c), (c, a)].contains(&(p, q))
}

/// The triangles of a mesh as numbers.
pub fn triangles(mesh: &Mesh) -> Vec<[u32; 3]> {
    mesh.triangles().map(|triangle| triangle.corners().map(|v| v.index() as u32)).collect()
}

/// Every triangle cut in four at the midpoints, by a list of faces and a map of edges: a model to compare with.
pub fn quadrisected(mesh: &Mesh) -> Mesh {
    let mut positions = mesh.positions().to_vec();
    let mut middles = BTreeMap::new();
    let mut cut = Vec::new();
    for [a, b, c] in triangles(mesh) {
        let [ab, bc, ca] = [(a, b), (b, c), (c, a)].map(|(p, q)| {
            *middles.entry((p.min(q), p.max(q))).or_insert_with(|| {
                positions.push((mesh.positions()[p as usize] + mesh.positions()[q as usize]) * 0.5);
                positions.len() as u32 - 1
            })
        });
        cut.extend([[a, ab, ca], [b, bc, ab], [c, ca, bc], [ab, bc, ca]]);
    }
    Mesh::from_triangles(positions, &cut).expect("a mesh cut in four is a mesh")
}

/// A sharpness of up to 4: infinite, 0, a multiple of 1/4 or any number.
pub fn sharpness(random: &mut Random) -> Sharpness {
    let value = match random.below(8) {
        0 => f64::INFINITY,
        1 => 0.0,
        2..=4 => 0.25 * (1 + random.below(16)) as f64,
        _ => 2.0 + 2.0 * random.signed(),
    };
    Sharpness::new(value).expect("0 or more")
}

/// A mesh with some more tags, all of random sharpness.
pub fn semi_sharp(mut mesh: Mesh, seed: u64, rule: SharpnessRule) -> Mesh {
    let mut random = Random::new(seed);
    let (edges, vertices) = (mesh.edges().collect::<Vec<_>>(), mesh.vertices());
    for edge in edges {
        if mesh.tags().is_sharp(edge) || random.below(5) == 0 {
            assert!(mesh.set_sharpness(edge, sharpness(&mut random)));
        }
    }
    for v in vertices {
        if mesh.tags().is_corner(v) || random.below(12) == 0 {
            assert!(mesh.set_vertex_sharpness(v, sharpness(&mut random)));
        }
    }
    mesh.set_sharpness_rule(rule);
    mesh
}

/// A script for selections: a patch grown from a vertex, and what is left of it at each level.
#[derive(Clone, Debug)]
pub struct Picks {
    start: u16,
    growth: Vec<u16>,
    kept: Vec<u8>,
}

impl Arbitrary for Picks {
    fn arbitrary(g: &mut Gen) -> Self {
        Self { start: u16::arbitrary(g), growth: Vec::arbitrary(g), kept: Vec::arbitrary(g) }
    }

    fn shrink(&self) -> Box<dyn Iterator<Item = Self>> {
        let whole = self.clone();
        let scripts = (self.growth.clone(), self.kept.clone()).shrink();
        Box::new(scripts.map(move |(growth, kept)| Self { growth, kept, ..whole.clone() }))
    }
}

impl Picks {
    /// The fewest vertices of a patch.
    pub const LEAST: usize = 7;

    /// A connected patch of at least [`Picks::LEAST`] vertices of the largest component, and at most half of it.
    pub fn patch(&self, mesh: &Mesh) -> Selection {
        let component = largest_component(mesh);
        let mut patch = vec![component[usize::from(self.start) % component.len()]];
        let size = (Self::LEAST + self.growth.len()).min(component.len() / 2);
        for k in 0..size - 1 {
            let around = patch.iter().flat_map(|&v| mesh.ring(v));
            let next: Vec<VertexId> =
                around.filter(|w| !patch.contains(w)).collect::<BTreeSet<_>>().into_iter().collect();
            let step = self.growth.get(k).map_or(0, |&step| usize::from(step));
            patch.push(next[step % next.len()]);
        }
        patch.into_iter().collect()
    }

    /// A random part of a selection, at least [`Picks::LEAST`] vertices of it; all of it when the script has ended.
    pub fn part(&self, selection: &Selection, level: usize) -> Selection {
        let Some(&seed) = self.kept.get(level) else { return selection.clone() };
        let mut random = Random::new(u64::from(seed));
        let share = 1 + random.below(4);
        let part: Selection = selection.vertices().iter().copied().filter(|_| random.below(4) < share).collect();
        if part.len() < Self::LEAST { selection.clone() } else { part }
    }
}

/// The vertices of the component with the most, by id.
pub fn largest_component(mesh: &Mesh) -> Vec<VertexId> {
    let mut seen = vec![false; mesh.vertex_count()];
    let mut largest = Vec::new();
    for v in mesh.vertices() {
        if std::mem::replace(&mut seen[v.index()], true) {
            continue;
        }
        let mut found = vec![v];
        let mut next = 0;
        while let Some(&v) = found.get(next) {
            found.extend(mesh.ring(v).iter().filter(|w| !std::mem::replace(&mut seen[w.index()], true)));
            next += 1;
        }
        if found.len() > largest.len() {
            largest = found;
        }
    }
    largest.sort_unstable();
    largest
}

/// SplitMix64, for numbers that a script needs in bulk.
pub struct Random(u64);

impl Random {
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    pub fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound as u64) as usize
    }

    /// Between -1 and 1.
    pub fn signed(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }

    pub fn vector(&mut self) -> DVec3 {
        DVec3::new(self.signed(), self.signed(), self.signed())
    }
}
