//! Triangles of polygons: all corners used, no crack, no edge doubled, never stuck.

mod common;
#[path = "common/tables.rs"]
mod tables;

use std::collections::{HashMap, HashSet};
use std::time::{Duration, Instant};

use common::random::check_up_to;
use vvmesh::Mesh;
use vvmesh::glam::DVec3;
use vvmesh::io;
use vvmesh::soup::{FaceList, Triangulation};

fn list(points: &[[f64; 3]], faces: &[&[u32]]) -> FaceList {
    let mut list = FaceList::new(points.iter().map(|&point| DVec3::from(point)).collect());
    faces.iter().for_each(|face| list.push_face(face));
    list
}

fn one_polygon(points: &[[f64; 3]]) -> FaceList {
    let corners: Vec<u32> = (0..points.len() as u32).collect();
    list(points, &[&corners])
}

fn flat(points: &[[f64; 2]]) -> FaceList {
    one_polygon(&points.iter().map(|&[x, y]| [x, y, 0.0]).collect::<Vec<_>>())
}

/// What holds for the triangles of every list: how many there are, and that their outer edges are those of the faces.
fn assert_sound(list: &FaceList, cut: &Triangulation) {
    assert_eq!(cut.triangles.len(), cut.face_of.len());
    assert!(cut.face_of.is_sorted());
    let polygons = list.faces().filter(|face| face.len() > 3).count();
    assert_eq!(cut.fanned + cut.clipped, polygons);
    let mut k = 0;
    for (face, corners) in list.faces().enumerate() {
        let count = corners.len().saturating_sub(2);
        let triangles = &cut.triangles[k..k + count];
        assert!(cut.face_of[k..k + count].iter().all(|&of| of as usize == face));
        if corners.len() == 3 {
            assert_eq!(triangles[0], corners);
        }
        // Directed edges of the triangles, those of opposite pairs taken out, are the sides of the face.
        let mut edges: HashMap<[u32; 2], i32> = HashMap::new();
        let mut add = |a: u32, b: u32| match a.cmp(&b) {
            std::cmp::Ordering::Less => *edges.entry([a, b]).or_default() += 1,
            std::cmp::Ordering::Greater => *edges.entry([b, a]).or_default() -= 1,
            std::cmp::Ordering::Equal => {}
        };
        for &[a, b, c] in triangles {
            [(a, b), (b, c), (c, a)].into_iter().for_each(|(a, b)| add(a, b));
        }
        if count > 0 {
            for side in 0..corners.len() {
                add(corners[(side + 1) % corners.len()], corners[side]);
            }
        }
        assert!(edges.values().all(|&count| count == 0), "face {face} {corners:?} became {triangles:?}");
        k += count;
    }
    assert_eq!(k, cut.triangles.len());
}

/// Twice the area in the plane z = 0, and the least of a triangle.
fn areas(list: &FaceList, cut: &Triangulation) -> (f64, f64) {
    let area = |corners: &[u32]| {
        let at = |k: usize| list.positions[corners[k % corners.len()] as usize];
        (0..corners.len()).map(|k| at(k).cross(at(k + 1)).z).sum::<f64>()
    };
    let triangles: Vec<f64> = cut.triangles.iter().map(|triangle| area(triangle)).collect();
    let whole: f64 = list.faces().map(area).sum();
    assert!((triangles.iter().sum::<f64>() - whole).abs() < 1e-9 * whole.abs(), "the areas do not add up");
    (whole, triangles.into_iter().fold(f64::INFINITY, f64::min))
}

fn assert_cut_well(list: &FaceList, fanned: bool) {
    let cut = list.triangulate();
    assert_sound(list, &cut);
    assert!(areas(list, &cut).1 > 0.0, "a triangle is flat or turned over: {:?}", cut.triangles);
    assert_eq!(cut.fanned == 1, fanned);
}

#[test]
fn convex_polygons_become_fans() {
    assert_cut_well(&flat(&[[0., 0.], [1., 0.], [1., 1.], [0., 1.]]), true);
    let cut = flat(&[[0., 0.], [1., 0.], [1., 1.], [0., 1.]]).triangulate();
    assert_eq!(cut.triangles, [[0, 1, 2], [0, 2, 3]]);
    // Corners on straight sides are used, without flat triangles.
    assert_cut_well(&flat(&[[0., 0.], [1., 0.], [2., 0.], [2., 2.], [0., 2.]]), true);
    assert_cut_well(&flat(&[[0., 0.], [0.3, 0.1], [0.6, 0.2], [0.1, 0.9], [0.05, 0.45]]), true);
    // Size and place do not matter.
    for (scale, shift) in [(1e-200, 0.0), (1e150, 0.0), (1e-3, 1e6), (1.0, -1e9)] {
        let points = [[0., 0.], [1., 0.], [2., 0.], [2., 2.], [1., 2.], [0., 2.]];
        let moved = flat(&points.map(|point| point.map(|x| x * scale + shift)));
        let cut = moved.triangulate();
        assert_sound(&moved, &cut);
        assert_eq!(cut.triangles, flat(&points).triangulate().triangles, "scale {scale}, shift {shift}");
    }
}

#[test]
fn concave_polygons_are_clipped() {
    let l = flat(&[[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 2.], [0., 2.]]);
    assert_cut_well(&l, false);
    assert_cut_well(&flat(&[[0., 0.], [4., 1.], [0., 2.], [1., 1.]]), false);
    // A comb, and a spiral of two turns with a wall of its own.
    let mut comb = vec![[0., 0.], [20., 0.]];
    comb.extend((0..20).rev().map(|k| [f64::from(k) + 0.5, if k % 2 == 0 { 5.0 } else { 1.0 }]));
    assert_cut_well(&flat(&comb), false);
    let arm = |radius: f64, turn: f64| [radius * turn.cos() * (1.0 + turn), radius * turn.sin() * (1.0 + turn)];
    let turns = |k: i32| f64::from(k) * 0.2;
    let mut spiral: Vec<_> = (0..60).map(|k| arm(1.0, turns(k))).collect();
    spiral.extend((0..60).rev().map(|k| arm(0.8, turns(k))));
    spiral.reverse();
    let area = areas(&flat(&spiral), &flat(&spiral).triangulate()).0;
    if area < 0.0 {
        spiral.reverse();
    }
    assert_cut_well(&flat(&spiral), false);
}

#[test]
fn polygons_that_run_round_twice_are_no_fans() {
    let star: Vec<_> = (0..5).map(|k| (f64::from(k) * 0.4 * std::f64::consts::TAU).sin_cos().into()).collect();
    let star = flat(&star);
    let cut = star.triangulate();
    assert_sound(&star, &cut);
    assert_eq!(cut.clipped, 1);
}

#[test]
fn a_bridge_to_a_hole_is_kept_open() {
    // A square with a square hole, joined by a bridge that is run both ways.
    let points = [
        [0., 0., 0.],
        [4., 0., 0.],
        [4., 4., 0.],
        [0., 4., 0.],
        [1., 1., 0.],
        [1., 3., 0.],
        [3., 3., 0.],
        [3., 1., 0.],
    ];
    let ring = list(&points, &[&[0, 1, 2, 3, 0, 4, 5, 6, 7, 4]]);
    let cut = ring.triangulate();
    assert_sound(&ring, &cut);
    assert!(areas(&ring, &cut).1 > 0.0);
    let mesh = Mesh::from_triangles(ring.positions, &cut.triangles).unwrap();
    assert_eq!((mesh.face_count(), mesh.edge_count()), (8, 16));
}

#[test]
fn degenerate_polygons_do_no_harm() {
    let nan = f64::NAN;
    for points in [
        vec![[0.; 3]; 7],
        (0..50).map(|k| [f64::from(k), 0., 0.]).collect(),
        vec![[nan, 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]],
        vec![[f64::MAX, 0., 0.], [-f64::MAX, 0., 0.], [0., f64::MAX, 0.], [0., 0., f64::INFINITY]],
        vec![[5e-324, 0., 0.], [0., 5e-324, 0.], [-5e-324, 0., 0.], [0., -5e-324, 0.]],
        vec![[0., 0., 0.], [1., 1., 0.], [1., 0., 0.], [0., 1., 0.]],
    ] {
        let polygon = one_polygon(&points);
        assert_sound(&polygon, &polygon.triangulate());
    }
    // Corners that repeat, that do not exist, and faces that are none.
    let odd = list(
        &[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]],
        &[&[0, 0, 0, 0, 0], &[0, 1, 0, 1], &[0, 1, 2, 9], &[7, 8, 9, 10], &[0, 1], &[], &[3, 3, 3], &[0, 1, 2, 3]],
    );
    let cut = odd.triangulate();
    assert_sound(&odd, &cut);
}

#[test]
fn a_diagonal_doubles_no_edge() {
    // A square and the triangle over its first diagonal: the fan must start elsewhere.
    let points = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0.5, 0.5, 1.]];
    for square in [[0, 1, 2, 3], [1, 2, 3, 0]] {
        let faces = list(&points, &[&square, &[0, 2, 4]]);
        let cut = faces.triangulate();
        assert_sound(&faces, &cut);
        assert!(cut.triangles[..2].iter().all(|triangle| triangle.contains(&1) && triangle.contains(&3)));
    }
    // A pillow of two equal squares: each takes another diagonal, as that is all that is left.
    let pillow = list(&points[..4], &[&[0, 1, 2, 3], &[3, 2, 1, 0]]);
    let cut = pillow.triangulate();
    assert!(Mesh::from_triangles(pillow.positions, &cut.triangles).is_ok());
    // A diagonal that is an edge on one way, and that the other way leaves the polygon, is still avoided.
    let arrow =
        list(&[[0., 0., 0.], [4., 1., 0.], [0., 2., 0.], [1., 1., 0.]], &[&[0, 1, 2, 3], &[1, 3, 2], &[3, 1, 0]]);
    assert!(!arrow.triangulate().triangles[..2].contains(&[1, 2, 3]));
    // Four squares in a cube's place that leave nothing: it must end all the same.
    let full = list(&points[..4], &[&[0, 1, 2, 3], &[0, 2, 1, 3], &[0, 1, 3, 2]]);
    assert_sound(&full, &full.triangulate());
}

#[test]
fn an_early_choice_is_taken_back_for_a_later_face() {
    // The second square can take one diagonal only, the one that the first would choose.
    let points = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.], [0.5, 0.5, 1.]];
    let faces = list(&points, &[&[0, 1, 2, 3], &[3, 2, 1, 0], &[1, 3, 4]]);
    let cut = faces.triangulate();
    let mut edges = HashSet::new();
    for &[a, b, c] in &cut.triangles {
        edges.extend([(a, b), (b, c), (c, a)].into_iter().filter(|(a, b)| a < b));
    }
    assert_sound(&faces, &cut);
    // Sides, both diagonals: one square must take 1-3 once more, but not a third time.
    assert!(edges.contains(&(0, 2)));
}

#[test]
fn great_polygons_take_no_great_time() {
    let circle = |n: u32, radius: &dyn Fn(u32) -> f64| {
        let points: Vec<[f64; 2]> = (0..n)
            .map(|k| {
                let (sin, cos) = (f64::from(k) / f64::from(n) * std::f64::consts::TAU).sin_cos();
                [radius(k) * cos, radius(k) * sin]
            })
            .collect();
        flat(&points)
    };
    let wild = |k: u32| 1.0 + f64::from(k.wrapping_mul(2_654_435_761) >> 20) / 4096.0;
    for (list, fanned) in [
        (circle(100_000, &|_| 1.0), true),
        (circle(20_000, &|k| if k % 2 == 0 { 1.0 } else { 0.5 }), false),
        (circle(20_000, &wild), false),
    ] {
        let start = Instant::now();
        let cut = list.triangulate();
        let time = start.elapsed();
        assert_sound(&list, &cut);
        assert_eq!(cut.fanned == 1, fanned);
        assert!(areas(&list, &cut).1 > -1e-12, "a triangle is turned over");
        assert!(time < Duration::from_secs(20), "{time:?}");
    }
    let line: Vec<[f64; 3]> = (0..100_000).map(|k| [f64::from(k), 0., 0.]).collect();
    assert_sound(&one_polygon(&line), &one_polygon(&line).triangulate());
}

#[test]
fn random_polygons_are_sound() {
    fn property(points: Vec<(i8, i8, i8)>, faces: Vec<Vec<u8>>) {
        let points: Vec<[f64; 3]> =
            points.into_iter().map(|(x, y, z)| [x.into(), y.into(), f64::from(z % 3)]).collect();
        let faces: Vec<Vec<u32>> =
            faces.into_iter().map(|face| face.into_iter().map(|k| u32::from(k) % 16).collect()).collect();
        let all: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
        let faces = list(&points, &all);
        assert_sound(&faces, &faces.triangulate());
        let polygon = one_polygon(&points);
        if points.len() > 2 {
            assert_sound(&polygon, &polygon.triangulate());
        }
    }
    check_up_to(60, 232, 300, property as fn(_, _));
}

#[test]
fn star_shaped_polygons_are_covered_once() {
    fn property(radii: Vec<u8>) {
        if radii.len() < 4 {
            return;
        }
        let points: Vec<[f64; 2]> = radii
            .iter()
            .enumerate()
            .map(|(k, &radius)| {
                let (sin, cos) = (k as f64 / radii.len() as f64 * std::f64::consts::TAU).sin_cos();
                [(1.0 + f64::from(radius)) * cos, (1.0 + f64::from(radius)) * sin]
            })
            .collect();
        let list = flat(&points);
        let cut = list.triangulate();
        assert_sound(&list, &cut);
        assert!(areas(&list, &cut).1 > -1e-9, "{points:?}");
    }
    check_up_to(80, 233, 500, property as fn(_));
}

#[test]
fn every_manifold_file_becomes_a_mesh() {
    let Some(folder) = common::meshes() else { return };
    let mut polygonal = 0;
    for row in tables::readme(&folder) {
        let faces = io::read(folder.join(&row.file)).unwrap().faces;
        let cut = faces.triangulate();
        assert_sound(&faces, &cut);
        polygonal += usize::from(cut.fanned + cut.clipped > 0);
        let (positions, used) = (faces.positions.clone(), faces.faces().flatten().collect::<HashSet<_>>().len());
        let mesh = Mesh::from_triangles(positions, &cut.triangles);
        assert_eq!(mesh.is_ok(), row.is_manifold && row.is_orientable, "{}", row.file);
        if let Ok(mesh) = mesh {
            assert_eq!(mesh.vertex_count(), row.vertices, "{}", row.file);
            let euler = used as i64 - mesh.edge_count() as i64 + mesh.face_count() as i64;
            assert_eq!(euler, row.euler_characteristic, "{}", row.file);
        }
    }
    assert!(polygonal >= 15, "{polygonal} files with polygons");
}
