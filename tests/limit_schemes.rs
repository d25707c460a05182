//! Tangents of the schemes that are not Loop's, against their own refinement.

#![allow(clippy::unwrap_used, reason = "helpers of a test may fail it")]

mod common;
mod scheme_support;

use std::f64::consts::PI;

use common::random::check;
use common::run::Run;
use scheme_support::{scripted, star};
use vvmesh::adaptive::Incremental;
use vvmesh::glam::DVec3;
use vvmesh::limit::{AnyLimit, ButterflyLimit, Limit, ModifiedButterflyLimit, Sqrt3Limit};
use vvmesh::scheme::{AnyScheme, Butterfly, Mask, ModifiedButterfly};
use vvmesh::select::Selection;
use vvmesh::subdivide::Subdivider;
use vvmesh::{Edge, Mesh, VertexId, shapes};

fn id(index: usize) -> VertexId {
    VertexId::new(index)
}

fn schemes() -> [(AnyScheme, AnyLimit); 2] {
    [(Butterfly.into(), ButterflyLimit.into()), (ModifiedButterfly.into(), ModifiedButterflyLimit.into())]
}

/// A star whose neighbours are irregular, lifted off the plane so that nothing about it is symmetric.
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

/// The mesh refined around one vertex, which the schemes here do not move; it is put at 0, so that deep levels keep digits.
fn refined_around(mesh: &Mesh, v: VertexId, scheme: &AnyScheme, levels: usize) -> Mesh {
    let mut mesh = mesh.clone();
    let center = mesh.position(v);
    mesh.positions_mut().iter_mut().for_each(|x| *x -= center);
    let subdivider = Subdivider::new(scheme.clone(), Incremental::new(1).unwrap());
    let mut run = Run::new(&mesh);
    let selection: Selection = [v].into_iter().collect();
    for _ in 0..levels {
        run.step(&subdivider, &selection);
    }
    run.mesh
}

/// By which factor a step multiplies a tangent, if it does nothing else.
fn factor(before: DVec3, after: DVec3, scale: f64) -> Option<f64> {
    let factor = before.dot(after) / before.length_squared();
    (after.distance(factor * before) < 1e-12 * scale).then_some(factor)
}

/// The factors of the tangents of all sides that have any.
fn factors(mesh: &Mesh, v: VertexId, scheme: &AnyScheme, limit: &AnyLimit) -> Vec<[f64; 2]> {
    let [before, after] = [0, 1].map(|levels| refined_around(mesh, v, scheme, levels));
    let scale = before.positions().iter().map(|x| x.length()).fold(1.0, f64::max) * 2000.0;
    let mut factors = Vec::new();
    for side in 0..limit.side_count(mesh.neighborhood(), v) {
        let Some([first, second]) = limit.tangents(&before, v, side) else { continue };
        // One that vanishes, as across a straight boundary with one triangle, has no factor.
        if [first, second].iter().any(|tangent| tangent.length() < 1e-12 * scale) {
            continue;
        }
        let [next_first, next_second] = limit.tangents(&after, v, side).unwrap();
        let found = [(first, next_first), (second, next_second)].map(|(p, q)| factor(p, q, scale));
        factors.push(found.map(|factor| factor.unwrap_or_else(|| panic!("{v}, side {side} is no eigenvector"))));
    }
    factors
}

#[test]
fn the_position_is_the_vertex() {
    for (_, limit) in schemes() {
        let mesh = bent_star(5, true, &[1]);
        assert_eq!(limit.positions(&mesh), mesh.positions());
    }
}

#[test]
fn butterfly_has_tangents_where_its_limit_is_smooth() {
    let [(scheme, limit), _] = schemes();
    // The eigenvalues of the dense matrices.
    for (n, value) in [(4, 0.46904), (5, 0.50668), (6, 0.5), (7, 0.48191)] {
        let found = factors(&bent_star(n, true, &[]), id(0), &scheme, &limit);
        assert!(found.len() == 1 && found[0].iter().all(|factor| (factor - value).abs() < 1e-5), "{n}: {found:?}");
    }
    for n in [3, 8, 9, 10, 11, 12, 30] {
        assert_eq!(limit.tangents(&bent_star(n, true, &[]), id(0), 0), None, "valence {n}");
    }
    assert_eq!(limit.tangents(&bent_star(19, false, &[]), id(0), 0), None, "boundary valence 19");
    for n in 2..=18 {
        let found = factors(&bent_star(n, false, &[]), id(0), &scheme, &limit);
        assert!(found[0].iter().all(|factor| (factor - 0.5).abs() < 1e-9), "boundary valence {n}: {found:?}");
    }
}

#[test]
fn modified_butterfly_has_tangents_of_one_half() {
    let [_, (scheme, limit)] = schemes();
    let check = |mesh: &Mesh, sides: usize, across: f64, what: &str| {
        let found = factors(mesh, id(0), &scheme, &limit);
        assert_eq!(found.len(), sides, "{what}");
        for [first, second] in found {
            assert!((first - 0.5).abs() < 1e-9 && (second - across).abs() < 1e-9, "{what}: {first} {second}");
        }
    };
    for n in 3..=12 {
        check(&bent_star(n, true, &[]), 1, 0.5, &format!("smooth {n}"));
        check(&bent_star(n, true, &[2]), 1, 0.5, &format!("dart {n}"));
        check(&bent_star(n + 1, false, &[]), 1, 0.5, &format!("boundary {n}"));
        let mut cone = bent_star(n, true, &[]);
        cone.set_corner(id(0), true);
        check(&cone, 1, 0.5, &format!("tagged {n}"));
    }
    check(&bent_star(2, false, &[]), 1, 0.25, "boundary 2");
    check(&bent_star(7, true, &[1, 4]), 2, 0.5, "crease of 3 and 4 faces");
    // Sectors of 1, 1 and 3 faces; the last has no tangent plane.
    check(&bent_star(5, true, &[1, 2, 3]), 2, 0.5, "corner");
    let corner = bent_star(5, true, &[1, 2, 3]);
    assert_eq!(limit.tangents(&corner, id(0), 2), None);
    assert_eq!(limit.normals(&corner).of(id(0)).iter().filter(|normal| normal.is_none()).count(), 1);
}

#[test]
fn tangents_of_any_mesh_are_eigenvectors() {
    fn property(script: Vec<(u8, u16)>) -> bool {
        let mesh = scripted(&script);
        for (scheme, limit) in schemes() {
            for v in mesh.vertices() {
                let found = factors(&mesh, v, &scheme, &limit);
                assert!(found.iter().flatten().all(|factor| (0.2..0.6).contains(factor)), "{v}: {found:?}");
            }
        }
        true
    }
    check(202, 100, property as fn(Vec<(u8, u16)>) -> bool);
}

/// The mean normal of the triangles of a sector, counted in the ring.
fn sector_normal(mesh: &Mesh, v: VertexId, slots: impl Iterator<Item = usize>) -> DVec3 {
    let pairs: Vec<(VertexId, VertexId)> = mesh.ring(v).pairs().collect();
    let spoke = |w: VertexId| (mesh.position(w) - mesh.position(v)).normalize();
    slots.map(|slot| spoke(pairs[slot].0).cross(spoke(pairs[slot].1)).normalize()).sum::<DVec3>().normalize()
}

#[test]
fn normals_are_those_of_deep_refinement() {
    let close = |mesh: &Mesh, (scheme, limit): &(AnyScheme, AnyLimit), levels: usize, what: &str| {
        let deep = refined_around(mesh, id(0), scheme, levels);
        let around = mesh.neighborhood();
        for (side, normal) in limit.normals(mesh).of(id(0)).iter().enumerate() {
            let Some(normal) = normal else { continue };
            let slots = 0..mesh.ring(id(0)).face_count();
            let in_side = slots.filter(|&slot| limit.side_at(around, id(0), slot) == Some(side));
            let apart = normal.distance(sector_normal(&deep, id(0), in_side));
            assert!(apart < 1e-3, "{what}, side {side}: {apart:e}");
        }
    };
    let [butterfly, modified] = schemes();
    for n in 4..=7 {
        close(&bent_star(n, true, &[]), &butterfly, 60, &format!("butterfly {n}"));
    }
    for n in 2..=6 {
        close(&bent_star(n, false, &[]), &butterfly, 120, &format!("butterfly, boundary {n}"));
    }
    for n in 3..=12 {
        close(&bent_star(n, true, &[]), &modified, 40, &format!("modified {n}"));
        close(&bent_star(n, true, &[2]), &modified, 60, &format!("modified, dart {n}"));
        close(&bent_star(n, false, &[]), &modified, 40, &format!("modified, boundary {n}"));
        close(&bent_star(n, true, &[1, 3]), &modified, 40, &format!("modified, crease {n}"));
    }
    close(&bent_star(5, true, &[1, 2, 3]), &modified, 40, "modified, corner");
}

/// The ring of a vertex after a step of √3 inside, or after two on a boundary; the vertex first.
fn sqrt3_step(points: &[DVec3], open: bool) -> Vec<DVec3> {
    let (v, ring) = (points[0], &points[1..]);
    let n = ring.len();
    if !open {
        let a = (4.0 - 2.0 * (2.0 * PI / n as f64).cos()) / 9.0;
        let mean = ring.iter().sum::<DVec3>() / n as f64;
        let centers = (0..n).map(|j| (v + ring[j] + ring[(j + 1) % n]) / 3.0);
        return std::iter::once((1.0 - a) * v + a * mean).chain(centers).collect();
    }
    let (first, last) = (ring[0], ring[n - 1]);
    let inner: Vec<DVec3> = (1..n).map(|j| (v + ring[j - 1] + ring[j]) / 3.0).collect();
    let mut points = vec![(4.0 * first + 19.0 * v + 4.0 * last) / 27.0, (last + 16.0 * v + 10.0 * first) / 27.0];
    points.extend(inner.windows(2).map(|pair| (v + pair[0] + pair[1]) / 3.0));
    points.push((first + 16.0 * v + 10.0 * last) / 27.0);
    points
}

fn set(mesh: &Mesh, points: &[DVec3]) -> Mesh {
    let mut mesh = mesh.clone();
    mesh.positions_mut().copy_from_slice(points);
    mesh
}

#[test]
fn sqrt3_masks_are_those_of_its_matrix() {
    for (n, open) in (3..=12).map(|n| (n, false)).chain((2..=6).map(|n| (n, true))) {
        let mesh = bent_star(n, !open, &[]);
        let what = format!("valence {n}, open: {open}");
        let after = set(&mesh, &sqrt3_step(mesh.positions(), open));
        let [limit, same] = [&mesh, &after].map(|mesh| Sqrt3Limit.position(mesh, id(0)));
        assert!(limit.distance(same) < 1e-14, "{what}");
        // Far on, the star is at the limit, and in the plane.
        let mut points = mesh.positions().to_vec();
        // But not so far that a single face on a boundary degenerates, which shrinks by 1/9 across and 1/3 along.
        for _ in 0..if n == 2 { 12 } else { 60 } {
            points = sqrt3_step(&points, open);
            let center = points[0];
            let scale = points.iter().map(|x| x.distance(center)).fold(0.0, f64::max);
            points.iter_mut().for_each(|x| *x = (*x - center) / scale);
        }
        let naive = sector_normal(&set(&mesh, &points), id(0), 0..mesh.ring(id(0)).face_count());
        assert!(Sqrt3Limit.normal(&mesh, id(0), 0).unwrap().distance(naive) < 1e-3, "{what}");
        let far = (0..200).fold(mesh.positions().to_vec(), |points, _| sqrt3_step(&points, open));
        assert!(far[0].distance(limit) < 1e-13, "{what}");
        // The tangents on a boundary are eigenvectors; inside they turn by half a neighbour.
        let [before, after] = [&mesh, &after].map(|mesh| Sqrt3Limit.tangents(mesh, id(0), 0).unwrap());
        let turn = if open { 0.0 } else { PI / n as f64 };
        let turned = [turn.cos() * before[0] + turn.sin() * before[1], turn.cos() * before[1] - turn.sin() * before[0]];
        for (before, after) in turned.into_iter().zip(after) {
            assert!(factor(before, after, 10.0).is_some(), "{what}");
        }
    }
}

#[test]
fn tangents_of_every_limit_add_to_nothing() {
    let mesh = shapes::grid(3, 2);
    for limit in [ButterflyLimit.into(), ModifiedButterflyLimit.into(), AnyLimit::Sqrt3(Sqrt3Limit)] {
        for v in mesh.vertices() {
            let [mut first, mut second] = [Mask::default(), Mask::default()];
            assert!(limit.tangent_masks(mesh.neighborhood(), v, 0, &mut first, &mut second));
            assert!(first.sum().abs() < 1e-11 && second.sum().abs() < 1e-11, "{v}");
            assert!(limit.normal(&mesh, v, 0).unwrap().distance(DVec3::Z) < 1e-9, "{v}");
        }
    }
}
