//! Limits against a subdivision that knows nothing of this crate: triangles by index, refined again and again.

#![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

mod common;
mod scheme_support;

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use common::random::check;
use common::run::Run;
use scheme_support::{apply, even, odd, scripted, star};
use vvmesh::adaptive::Incremental;
use vvmesh::glam::DVec3;
use vvmesh::limit::{Limit, LoopLimit};
use vvmesh::mesh::VertexClass;
use vvmesh::scheme::{Loop, LoopWeights, Mask};
use vvmesh::select::Selection;
use vvmesh::subdivide::Subdivider;
use vvmesh::{Edge, Mesh, VertexId};

const WEIGHTS: [LoopWeights; 2] = [LoopWeights::Loop, LoopWeights::Warren];

fn id(index: usize) -> VertexId {
    VertexId::new(index)
}

/// The triangles around vertex 0, which are all that its next position and its next neighbours depend on.
#[derive(Clone)]
struct Naive {
    points: Vec<DVec3>,
    faces: Vec<[usize; 3]>,
    sharp: Vec<[usize; 2]>,
    corner: bool,
    weights: LoopWeights,
}

fn key(a: usize, b: usize) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

impl Naive {
    /// The star of a vertex of a mesh; the vertex gets number 0, its neighbours follow in ring order.
    fn of(mesh: &Mesh, v: VertexId, weights: LoopWeights) -> Self {
        let old: Vec<VertexId> = std::iter::once(v).chain(mesh.ring(v)).collect();
        let number = |w: VertexId| old.iter().position(|&x| x == w).unwrap();
        let faces = mesh.triangles().map(|t| t.corners()).filter(|corners| corners.contains(&v));
        let sharp = mesh.ring(v).iter().filter(|&w| mesh.tags().is_sharp(Edge::new(v, w)));
        Self {
            points: old.iter().map(|&w| mesh.position(w)).collect(),
            faces: faces.map(|corners| corners.map(number)).collect(),
            sharp: sharp.map(|w| key(0, number(w))).collect(),
            corner: mesh.tags().is_corner(v),
            weights,
        }
    }

    fn refined(&self) -> Self {
        let mut apexes: BTreeMap<[usize; 2], Vec<usize>> = BTreeMap::new();
        for &[a, b, c] in &self.faces {
            for (p, q, apex) in [(a, b, c), (b, c, a), (c, a, b)] {
                apexes.entry(key(p, q)).or_default().push(apex);
            }
        }
        let is_sharp = |edge: &[usize; 2]| apexes[edge].len() == 1 || self.sharp.contains(edge);
        let sum = |vertices: &[usize]| vertices.iter().map(|&v| self.points[v]).sum::<DVec3>();

        let mut odd = BTreeMap::new();
        let mut points = vec![self.even(&apexes, is_sharp)];
        for edge in apexes.keys().filter(|edge| edge[0] == 0) {
            odd.insert(*edge, points.len());
            points.push(if is_sharp(edge) { 0.5 * sum(edge) } else { (3.0 * sum(edge) + sum(&apexes[edge])) / 8.0 });
        }
        let faces = self.faces.iter().map(|&face| {
            let [_, b, c] = match face {
                [0, b, c] | [c, 0, b] | [b, c, 0] => [0, b, c],
                _ => panic!("a triangle away from the vertex"),
            };
            [0, odd[&key(0, b)], odd[&key(0, c)]]
        });
        let sharp = self.sharp.iter().map(|edge| key(0, odd[edge])).collect();
        Self { faces: faces.collect(), points, sharp, ..self.clone() }
    }

    fn even(&self, apexes: &BTreeMap<[usize; 2], Vec<usize>>, is_sharp: impl Fn(&[usize; 2]) -> bool) -> DVec3 {
        let edges: Vec<[usize; 2]> = apexes.keys().copied().filter(|edge| edge[0] == 0).collect();
        let along: Vec<DVec3> = edges.iter().filter(|edge| is_sharp(edge)).map(|edge| self.points[edge[1]]).collect();
        let n = edges.len() as f64;
        let center = 0.375 + 0.25 * (TAU / n).cos();
        let alpha = match self.weights {
            LoopWeights::Warren if n > 3.0 => 0.375 / n,
            _ => (0.625 - center * center) / n,
        };
        let all = edges.iter().map(|edge| self.points[edge[1]]).sum::<DVec3>();
        match along[..] {
            _ if self.corner => self.points[0],
            [] | [_] if !edges.is_empty() => self.points[0] * (1.0 - n * alpha) + all * alpha,
            [a, b] => (6.0 * self.points[0] + a + b) / 8.0,
            _ => self.points[0],
        }
    }

    /// Moves the vertex to 0 and scales the longest spoke to 1, so that deep levels keep their digits.
    fn rescaled(mut self) -> Self {
        let center = self.points[0];
        let scale = self.points.iter().map(|x| x.distance(center)).fold(0.0, f64::max);
        self.points.iter_mut().for_each(|x| *x = (*x - center) / scale);
        self
    }

    /// The mean of the triangles' normals around the vertex in a sector that starts at a neighbour, by its number in the
    /// ring from 1.
    fn normal(&self, sector: impl Iterator<Item = usize>) -> DVec3 {
        let [center, points] = [&self.points[..1], &self.points[1..]];
        let ends: Vec<usize> = sector.collect();
        let cross = |two: &[usize]| (points[two[0] - 1] - center[0]).cross(points[two[1] - 1] - center[0]).normalize();
        ends.windows(2).map(cross).sum::<DVec3>().normalize()
    }
}

/// Neighbours keep their order, as new ones are numbered by the old, so deep stars can be compared spoke by spoke.
fn deep(mesh: &Mesh, v: VertexId, weights: LoopWeights, levels: usize) -> Naive {
    (0..levels).fold(Naive::of(mesh, v, weights), |star, _| star.refined().rescaled())
}

fn limits_agree(mesh: &Mesh, v: VertexId, weights: LoopWeights) -> bool {
    let limit = LoopLimit::new(weights);
    let expected = limit.position(mesh, v);
    let mut star = Naive::of(mesh, v, weights);
    let rate = limit.contraction(mesh.neighborhood(), v);
    for _ in 0..80 {
        let next = star.refined();
        if let Some(rate) = rate {
            let [before, after] = [&star, &next].map(|star| star.points[0] - expected);
            if (after - rate * before).length() > 1e-13 {
                return false;
            }
        }
        star = next;
    }
    star.points[0].distance(expected) < 1e-12
}

/// A star lifted off the plane, so that nothing about it is symmetric.
fn bent_star(n: usize, closed: bool, sharp: &[usize]) -> Mesh {
    let mut mesh = star(n, closed);
    for (k, x) in mesh.positions_mut().iter_mut().enumerate() {
        let wave = |salt: usize| ((k * 37 + salt * 17) % 23) as f64 / 23.0 - 0.5;
        *x += DVec3::new(0.3 * wave(1) / n as f64, 0.3 * wave(2) / n as f64, 0.4 * wave(3));
    }
    for &w in sharp {
        assert!(mesh.set_sharp(Edge::new(id(0), id(w)), true));
    }
    mesh
}

#[test]
fn limit_positions_are_limits() {
    fn property(script: Vec<(u8, u16)>) -> bool {
        let mesh = scripted(&script);
        WEIGHTS.into_iter().all(|weights| mesh.vertices().all(|v| limits_agree(&mesh, v, weights)))
    }
    check(201, 100, property as fn(Vec<(u8, u16)>) -> bool);
}

#[test]
fn limit_positions_converge_at_their_rate_at_every_valence() {
    for weights in WEIGHTS {
        for n in 3..=12 {
            for sharp in [&[][..], &[2], &[1, 2], &[1, 3], &[1, 2, 3]] {
                let mesh = bent_star(n, true, sharp);
                assert!(limits_agree(&mesh, id(0), weights), "{weights:?}, valence {n}, sharp {sharp:?}");
            }
        }
        for n in 2..=8 {
            assert!(limits_agree(&bent_star(n, false, &[]), id(0), weights), "boundary valence {n}");
        }
    }
}

/// The same by this crate's own steps, of the surroundings of the vertex alone.
#[test]
fn eight_levels_come_near_at_the_rate() {
    let levels = 8;
    for weights in WEIGHTS {
        let limit = LoopLimit::new(weights);
        let check = |mesh: Mesh, what: &str| {
            let subdivider = Subdivider::new(Loop::new(weights), Incremental::new(1).unwrap());
            let selection: Selection = [id(0)].into_iter().collect();
            let mut run = Run::new(&mesh);
            let expected = limit.position(&mesh, id(0));
            let start = mesh.position(id(0)) - expected;
            for level in 1..=levels {
                run.step(&subdivider, &selection);
                let here = run.mesh.position(id(0)) - expected;
                match limit.contraction(mesh.neighborhood(), id(0)) {
                    Some(rate) => assert!((here - rate.powi(level) * start).length() < 1e-14, "{what}, level {level}"),
                    // The greatest eigenvalue of a dart that its limit sees, the slower tangent's, is 0.5659 at valence 12.
                    None => assert!(here.length() < 0.566_f64.powi(level), "{what}, level {level}"),
                }
            }
        };
        for n in 3..=12 {
            for (kind, sharp) in [("smooth", &[][..]), ("dart", &[2]), ("crease", &[1, 3]), ("corner", &[1, 2, 3])] {
                check(bent_star(n, true, sharp), &format!("{weights:?}, {kind}, valence {n}"));
            }
            check(bent_star(n - 1, false, &[]), &format!("{weights:?}, boundary valence {}", n - 1));
        }
    }
}

#[test]
fn distances_to_the_limit_have_their_factors() {
    for weights in WEIGHTS {
        let limit = LoopLimit::new(weights);
        assert_eq!(limit.distance_factor(6), 0.5);
        for n in 3..=12 {
            let mesh = bent_star(n, true, &[]);
            let mean = mesh.ring(id(0)).iter().map(|w| mesh.position(w)).sum::<DVec3>() / n as f64;
            let v = mesh.position(id(0));
            let distance = v - limit.position(&mesh, id(0));
            assert!((distance - limit.distance_factor(n) * (v - mean)).length() < 1e-15, "valence {n}");
        }
    }
    let rate = |mesh: &Mesh| LoopLimit::default().contraction(mesh.neighborhood(), id(0));
    assert_eq!(rate(&bent_star(6, true, &[])), Some(0.25));
    assert_eq!(rate(&bent_star(6, true, &[1])), None);
    assert_eq!(rate(&bent_star(6, true, &[1, 3])), Some(0.25));
    assert_eq!(rate(&bent_star(6, true, &[1, 3, 4])), Some(0.0));
    assert_eq!(rate(&Mesh::from_triangles(vec![DVec3::X], &[]).unwrap()), Some(0.0));
}

#[test]
fn limit_masks_of_the_regular_cases_are_the_known_ones() {
    let mask = |mesh: &Mesh| {
        let mut mask = Mask::default();
        LoopLimit::default().mask(mesh.neighborhood(), id(0), &mut mask);
        mask
    };
    let mesh = star(6, true);
    assert_eq!(mask(&mesh).groups(), [(0.5, vec![id(0)]), (1.0 / 12.0, mesh.ring(id(0)).iter().collect())]);
    let mesh = star(4, false);
    assert_eq!(mask(&mesh).groups(), [(2.0 / 3.0, vec![id(0)]), (1.0 / 6.0, vec![id(1), id(4)])]);
    let mut mesh = star(4, true);
    mesh.set_corner(id(0), true);
    assert_eq!(mask(&mesh).groups(), [(1.0, vec![id(0)])]);
    let mesh = bent_star(7, true, &[2]);
    assert_eq!(apply(&mask(&mesh), |v| mesh.position(v)), LoopLimit::default().position(&mesh, id(0)));
}

/// The row of a mask, for vertex 0 and its neighbours.
fn row(mesh: &Mesh, mask: &Mask) -> Vec<f64> {
    mesh.vertices().map(|v| mask.weight_of(v)).collect()
}

/// What a row of weights on a star becomes when the star is first refined.
fn pulled_back(mesh: &Mesh, weights: LoopWeights, left: &[f64]) -> Vec<f64> {
    let scheme = Loop::new(weights);
    let rows = std::iter::once(even(&scheme, mesh, id(0)))
        .chain((1..mesh.vertex_count()).map(|w| odd(&scheme, mesh, id(0), id(w))))
        .map(|mask| row(mesh, &mask));
    let mut sum = vec![0.0; mesh.vertex_count()];
    for (weight, row) in left.iter().zip(rows) {
        sum.iter_mut().zip(row).for_each(|(sum, entry)| *sum += weight * entry);
    }
    sum
}

/// By how much a row is multiplied when it is pulled back, if it is an eigenvector.
fn eigenvalue(mesh: &Mesh, weights: LoopWeights, mask: &Mask) -> Option<f64> {
    let left = row(mesh, mask);
    let image = pulled_back(mesh, weights, &left);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(x, y)| x * y).sum::<f64>();
    let value = dot(&left, &image) / dot(&left, &left);
    let rest = left.iter().zip(&image).map(|(x, y)| (y - value * x).powi(2)).sum::<f64>().sqrt();
    (rest < 1e-12 * dot(&left, &left).sqrt()).then_some(value)
}

#[test]
fn all_masks_are_eigenvectors_of_the_one_ring() {
    let close = |found: Option<f64>, value: f64| found.is_some_and(|found| (found - value).abs() < 1e-12);
    for weights in WEIGHTS {
        let limit = LoopLimit::new(weights);
        let check = |mesh: &Mesh, what: &str, values: [Option<f64>; 2]| {
            let around = mesh.neighborhood();
            let mut position = Mask::default();
            limit.mask(around, id(0), &mut position);
            assert!(close(eigenvalue(mesh, weights, &position), 1.0), "{what}: position");
            assert!((position.sum() - 1.0).abs() < 1e-14, "{what}: {}", position.sum());
            for side in 0..limit.side_count(around, id(0)) {
                let mut tangents = [Mask::default(), Mask::default()];
                let [first, second] = &mut tangents;
                limit.tangent_masks(around, id(0), side, first, second);
                for (tangent, value) in tangents.iter().zip(values) {
                    let found = eigenvalue(mesh, weights, tangent);
                    assert!(found.is_some() && tangent.sum().abs() < 1e-12, "{what}, side {side}: {found:?}");
                    assert!(value.is_none_or(|value| close(found, value)), "{what}, side {side}: {found:?}");
                }
            }
        };
        for n in 3..=40 {
            let angle = TAU / n as f64;
            let mu = 0.375 + 0.25 * angle.cos();
            check(&star(n, true), &format!("smooth {n}"), [Some(mu), Some(mu)]);
            for sharp in [1, n / 2 + 1] {
                let mesh = bent_star(n, true, &[sharp]);
                check(&mesh, &format!("dart {n}"), [None, Some(mu)]);
            }
            let faces = n - 1;
            let across = 0.375 + 0.25 * (0.5 * TAU / faces as f64).cos();
            check(&star(n, false), &format!("boundary {n}"), [Some(0.5), Some(across)]);
            check(&bent_star(n, true, &[1, 3]), &format!("crease {n}"), [Some(0.5), None]);
            check(&bent_star(n, true, &[1, 2, 3]), &format!("corner {n}"), [Some(0.5), Some(0.5)]);
        }
        check(&star(2, false), "boundary 2", [Some(0.5), Some(0.25)]);
    }
}

#[test]
fn normals_are_those_of_deep_refinement() {
    // After so many levels the triangles of the star lie in the tangent plane as far as the third eigenvalue is below the
    // second (for a smooth vertex of valence 12 (0.50/0.59)^k), and have not degenerated where the first two differ.
    let close = |found: Option<DVec3>, expected: DVec3, tolerance: f64, what: &str| {
        let apart = found.unwrap_or_else(|| panic!("{what}: no normal")).distance(expected);
        assert!(apart < tolerance, "{what}: {apart:e}");
    };
    for weights in WEIGHTS {
        let limit = LoopLimit::new(weights);
        for n in 3..=12 {
            let mesh = bent_star(n, true, &[]);
            let naive = deep(&mesh, id(0), weights, 120).normal((1..=n).chain([1]));
            close(limit.normal(&mesh, id(0), 0), naive, 1e-7, &format!("smooth {n}"));

            let mesh = bent_star(n, true, &[2]);
            let levels = if n < 6 { 20 } else { 80 };
            let naive = deep(&mesh, id(0), weights, levels).normal((1..=n).chain([1]));
            close(limit.normal(&mesh, id(0), 0), naive, 1e-3, &format!("dart {n}"));
        }
        for (faces, levels) in [(1, 10), (2, 30), (3, 40), (4, 60), (5, 100)] {
            let mesh = bent_star(faces + 1, false, &[]);
            let naive = deep(&mesh, id(0), weights, levels).normal(1..=faces + 1);
            close(limit.normal(&mesh, id(0), 0), naive, 1e-4, &format!("boundary, {faces} faces"));
        }
        // A crease with 3 faces on one side and 2 on the other; a corner with sectors of 2, 2 and 1 faces.
        let mesh = bent_star(5, true, &[1, 4]);
        assert_eq!(limit.side_count(mesh.neighborhood(), id(0)), 2);
        let naive = deep(&mesh, id(0), weights, 30);
        close(limit.normal(&mesh, id(0), 0), naive.normal([1, 2, 3, 4].into_iter()), 1e-4, "crease, first side");
        close(limit.normal(&mesh, id(0), 1), naive.normal([4, 5, 1].into_iter()), 1e-4, "crease, second side");
        let mesh = bent_star(5, true, &[1, 3, 5]);
        assert_eq!(limit.side_count(mesh.neighborhood(), id(0)), 3);
        let naive = deep(&mesh, id(0), weights, 40);
        for (side, sector) in [&[1, 2, 3][..], &[3, 4, 5], &[5, 1]].into_iter().enumerate() {
            let expected = naive.normal(sector.iter().copied());
            close(limit.normal(&mesh, id(0), side), expected, 1e-4, &format!("corner, side {side}"));
        }
    }
}

#[test]
fn where_there_is_no_normal_none_is_told() {
    let limit = LoopLimit::default();
    let isolated = Mesh::from_triangles(vec![DVec3::X], &[]).unwrap();
    assert_eq!(limit.side_count(isolated.neighborhood(), id(0)), 0);
    let mut cone = bent_star(5, true, &[]);
    cone.set_corner(id(0), true);
    assert_eq!(limit.side_count(cone.neighborhood(), id(0)), 0);
    cone.set_sharp(Edge::new(id(0), id(3)), true);
    assert_eq!(limit.side_count(cone.neighborhood(), id(0)), 1);
    assert_eq!(limit.normal(&cone, id(0), 0), None, "from one edge around to itself");

    for flat in [DVec3::ZERO, DVec3::new(0.3, 0.7, -0.1), DVec3::NAN, DVec3::splat(f64::MAX)] {
        let mut mesh = bent_star(6, true, &[]);
        mesh.positions_mut().iter_mut().enumerate().for_each(|(k, x)| *x = flat * ((k * k) as f64 - 2.5));
        assert_eq!(limit.normal(&mesh, id(0), 0), None, "{flat}");
        assert_eq!(limit.normal(&mesh, id(1), 0), None, "{flat}");
    }
    let mut tiny = star(6, true);
    tiny.positions_mut().iter_mut().for_each(|x| *x *= 1e-200);
    assert_eq!(limit.normal(&tiny, id(0), 0), Some(DVec3::Z));
    assert_eq!(tiny.neighborhood().class(id(1)), VertexClass::Crease);
    assert!(limit.normal(&tiny, id(1), 0).unwrap().distance(DVec3::Z) < 1e-12);
}
