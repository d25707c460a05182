//! The conformity checker on planted faults: exactly what was planted is found.

#![allow(clippy::unwrap_used, reason = "helpers of tests stop at what they do not expect")]

mod common;
#[path = "common/plain.rs"]
mod plain;

use std::collections::BTreeMap;

use common::random::check;
use vvmesh::check::{Finding, FindingKind, Report, Sharing, balance, conformity, mesh_conformity};
use vvmesh::glam::DVec3;
use vvmesh::soup::FaceList;
use vvmesh::{Mesh, shapes};

use FindingKind::{
    BowTie, Crack, DegenerateFace, DuplicateFace, IndexOutOfRange, IsolatedVertex, LevelBalance, NonFinite,
    NonManifoldEdge, NonOrientable, Orientation, TJunction,
};

fn triangles(list: &FaceList) -> Vec<[u32; 3]> {
    list.faces().map(|face| face.try_into().expect("a triangle")).collect()
}

/// Kind, vertices and faces of each finding.
fn outlines(report: &Report) -> Vec<(FindingKind, Vec<usize>, Vec<usize>)> {
    let outline = |f: &Finding| (f.kind, f.vertices.iter().map(|v| v.index()).collect(), f.faces.clone());
    report.findings.iter().map(outline).collect()
}

fn kinds(list: &FaceList) -> BTreeMap<FindingKind, usize> {
    let mut kinds = BTreeMap::new();
    for finding in conformity(list, None).findings {
        *kinds.entry(finding.kind).or_insert(0) += 1;
    }
    kinds
}

/// A list of faces some of which were split in four at the midpoints of their edges, the others left as they were.
struct Split {
    list: FaceList,
    /// The edges with a split face on one side and another on the other.
    hanging: usize,
}

/// Splits the faces that are chosen. Midpoints of edges between a split face and another are moved by `off` times the
/// length of their edge, away from it in the plane of the split face.
fn split(list: &FaceList, chosen: impl Fn(usize) -> bool, off: f64) -> Split {
    let faces = triangles(list);
    let mut at: BTreeMap<(u32, u32), Vec<usize>> = BTreeMap::new();
    for (k, &[a, b, c]) in faces.iter().enumerate() {
        for (v, w) in [(a, b), (b, c), (c, a)] {
            at.entry((v.min(w), v.max(w))).or_default().push(k);
        }
    }
    let mut positions = list.positions.clone();
    let mut midpoints = BTreeMap::new();
    let mut hanging = 0;
    for (&(a, b), at) in &at {
        let split: Vec<usize> = at.iter().copied().filter(|&k| chosen(k)).collect();
        if split.is_empty() {
            continue;
        }
        let [p, q] = [a, b].map(|v| list.positions[v as usize]);
        let mut midpoint = (p + q) / 2.0;
        if split.len() < at.len() {
            hanging += 1;
            let apex = faces[split[0]].into_iter().find(|v| ![a, b].contains(v)).expect("a third corner");
            let inward = list.positions[apex as usize] - midpoint;
            let away = inward - inward.project_onto(q - p);
            midpoint += away.normalize() * off * p.distance(q);
        }
        midpoints.insert((a, b), positions.len() as u32);
        positions.push(midpoint);
    }
    let mut after = Vec::new();
    for (k, &[a, b, c]) in faces.iter().enumerate() {
        if chosen(k) {
            let [x, y, z] = [(a, b), (b, c), (c, a)].map(|(v, w)| midpoints[&(v.min(w), v.max(w))]);
            after.extend([[a, x, z], [x, b, y], [z, y, c], [x, y, z]]);
        } else {
            after.push([a, b, c]);
        }
    }
    Split { list: FaceList::from_triangles(positions, &after), hanging }
}

/// Ways to choose about half of the faces: the first half, every second, and no pattern.
fn halves(count: usize) -> [Box<dyn Fn(usize) -> bool>; 3] {
    [
        Box::new(move |k| k < count / 2),
        Box::new(|k| k % 2 == 0),
        Box::new(|k| (k.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 40) & 1 == 1),
    ]
}

#[test]
fn half_of_the_faces_split_leave_exactly_the_t_junctions() {
    for shape in [shapes::torus(12, 9, 2.0, 1.0), shapes::grid(9, 7), shapes::icosahedron()] {
        let list = shape.to_face_list();
        for chosen in halves(list.face_count()) {
            let Split { list, hanging } = split(&list, chosen, 0.0);
            assert!(hanging > 0);
            assert_eq!(kinds(&list), BTreeMap::from([(TJunction, hanging)]));
        }
    }
}

#[test]
fn half_of_the_faces_of_a_file_split_leave_exactly_the_t_junctions() {
    let Some(folder) = common::meshes() else { return };
    let is_mesh = |row: &plain::Row| row.cell("kinds") == "tri" && row.cell("manifold") == "yes";
    let mut count = 0;
    for row in plain::tables(&folder).into_iter().filter(is_mesh) {
        let list = plain::read(&folder.join(&row.file));
        for chosen in halves(list.face_count()) {
            let Split { list, hanging } = split(&list, chosen, 0.0);
            // This file has a face so flat that, with its edges torn open, one corner lies on the opposite edge.
            let tolerance = (row.file == "models/mpi_triang.off").then_some(1e-9);
            let report = conformity(&list, tolerance);
            assert_eq!(report.findings.len(), hanging, "{}", row.file);
            assert!(report.findings.iter().all(|finding| finding.kind == TJunction), "{}", row.file);
        }
        count += 1;
    }
    assert!(count >= 60, "only {count} files");
}

#[test]
fn a_t_junction_names_the_edge_and_what_hangs_on_it() {
    // Below a coarse triangle, above three fine ones; the vertices on the edge are numbered against its direction.
    let corners = [(0., 0.), (4., 0.), (2., -2.), (2., 2.), (3., 0.), (1., 0.)];
    let corners = corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let list = FaceList::from_triangles(corners, &[[1, 0, 2], [0, 5, 3], [5, 4, 3], [4, 1, 3]]);
    let report = conformity(&list, None);
    assert_eq!(outlines(&report), [(TJunction, vec![0, 1, 5, 4], vec![0])]);
    assert_eq!(report.findings[0].message, "v5 and v4 lie on the inside of edge v0-v1 of face 0");
    assert!(!report.is_conforming());
    assert_eq!(report.tolerance, 1e-6 * 32.0_f64.sqrt());
}

#[test]
fn edges_that_are_cut_differently_on_both_sides_hang_on_each_other() {
    let corners = [(0., 0.), (3., 0.), (1., -2.), (1., 2.), (1., 0.), (2., 0.)];
    let corners = corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    let list = FaceList::from_triangles(corners, &[[4, 0, 2], [1, 4, 2], [0, 5, 3], [5, 1, 3]]);
    let expected = [(TJunction, vec![0, 5, 4], vec![2]), (TJunction, vec![1, 4, 5], vec![1])];
    assert_eq!(outlines(&conformity(&list, None)), expected);
}

#[test]
fn the_tolerance_decides_between_t_junction_crack_and_hole() {
    let list = shapes::torus(12, 9, 2.0, 1.0).to_face_list();
    for chosen in halves(list.face_count()) {
        let Split { list: split, hanging } = split(&list, &chosen, 0.05);
        assert_eq!(kinds(&split), BTreeMap::from([(Crack, hanging)]));
        let wide = conformity(&split, Some(0.09));
        assert_eq!(wide.tolerance, 0.09);
        assert!(wide.findings.iter().all(|finding| finding.kind != Crack));
        assert_eq!(wide.findings.iter().filter(|finding| finding.kind == TJunction).count(), hanging);
    }
    // One face split next to a large hole: three holes at its sides, each too large for a crack, with bow-ties between.
    let open = split(&list, |k| k == 0, 0.3);
    assert_eq!((open.hanging, kinds(&open.list)), (3, BTreeMap::from([(BowTie, 3)])));
}

#[test]
fn a_flat_hole_with_its_tip_near_an_end_is_no_crack() {
    let corners = |tip: f64| {
        let corners = [(0., 0.), (4., 0.), (2., -2.), (2., 2.), (tip, 0.3)];
        let flat = corners.map(|(x, y)| DVec3::new(x, y, 0.0));
        [flat.as_slice(), &[DVec3::new(2.0, 0.0, -3.0)]].concat()
    };
    let faces = [[1, 0, 2], [0, 4, 3], [4, 1, 3], [2, 0, 5], [0, 3, 5], [3, 1, 5], [1, 2, 5]];
    let kinds = |tip| kinds(&FaceList::from_triangles(corners(tip), &faces));
    assert_eq!(kinds(1.1), BTreeMap::from([(Crack, 1)]));
    assert_eq!(kinds(0.9), BTreeMap::new());
}

#[test]
fn a_crack_names_the_edge_and_the_vertex_off_it() {
    let corners = [(0., 0.), (4., 0.), (2., -2.), (2., 2.), (2., 0.5)];
    let corners = corners.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    // The outer edges are closed by a vertex behind.
    let corners = [corners, vec![DVec3::new(2.0, 0.0, -3.0)]].concat();
    let faces = [[1, 0, 2], [0, 4, 3], [4, 1, 3], [2, 0, 5], [0, 3, 5], [3, 1, 5], [1, 2, 5]];
    let list = FaceList::from_triangles(corners.clone(), &faces);
    let report = conformity(&list, None);
    assert_eq!(outlines(&report), [(Crack, vec![0, 1, 4], vec![0, 1, 2])]);
    assert_eq!(report.findings[0].message, "v4 is off edge v0-v1 by 5.000e-1: a crack runs between them");
    // A quarter of the edge is a hole.
    let mut wide = list;
    wide.positions[4].y = 1.0;
    assert_eq!(outlines(&conformity(&wide, None)), []);
    wide.positions[4].y = 0.999;
    assert_eq!(kinds(&wide), BTreeMap::from([(Crack, 1)]));
    wide.positions[4].y = 0.0;
    assert_eq!(outlines(&conformity(&wide, None)), [(TJunction, vec![0, 1, 4], vec![0])]);
}

#[test]
fn a_boundary_is_no_finding() {
    assert_eq!(mesh_conformity(&shapes::grid(5, 4), None).findings, []);
    // A single flat triangle has a flat loop of three edges around it.
    let flat = FaceList::from_triangles(vec![DVec3::ZERO, DVec3::X, DVec3::new(0.5, 0.01, 0.0)], &[[0, 1, 2]]);
    assert_eq!(conformity(&flat, None).findings, []);
    // A mesh without one face has a triangular hole.
    let sphere = shapes::icosahedron().to_face_list();
    let open = FaceList::from_triangles(sphere.positions.clone(), &triangles(&sphere)[1..]);
    assert_eq!(conformity(&open, None).findings, []);
}

#[test]
fn unwelded_faces_touch_at_the_ends_of_edges_only() {
    let list = shapes::torus(8, 7, 2.0, 1.0).to_face_list();
    let corners: Vec<DVec3> = list.faces().flatten().map(|&v| list.positions[v as usize]).collect();
    let apart: Vec<[u32; 3]> = (0..list.face_count() as u32).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    assert_eq!(conformity(&FaceList::from_triangles(corners, &apart), None).findings, []);
}

/// The torus with more vertices and faces.
fn torus_and(positions: &[DVec3], more: &[&[u32]]) -> FaceList {
    let mut list = shapes::torus(6, 5, 2.0, 1.0).to_face_list();
    list.positions.extend_from_slice(positions);
    for face in more {
        list.push_face(face);
    }
    list
}

const FAR: [DVec3; 2] = [DVec3::new(9.0, 0.0, 0.0), DVec3::new(9.0, 1.0, 0.0)];

#[test]
fn an_edge_with_three_faces_is_found() {
    let list = torus_and(&FAR[..1], &[&[0, 1, 30]]);
    let faces: Vec<usize> = (0..61).filter(|&k| [0, 1].iter().all(|v| list.face(k).contains(v))).collect();
    assert_eq!(outlines(&conformity(&list, None)), [(NonManifoldEdge, vec![0, 1], faces)]);
}

#[test]
fn a_bow_tie_is_found() {
    let list = torus_and(&FAR, &[&[0, 30, 31]]);
    let faces: Vec<usize> = (0..61).filter(|&k| list.face(k).contains(&0)).collect();
    assert_eq!(outlines(&conformity(&list, None)), [(BowTie, vec![0], faces)]);
}

#[test]
fn a_face_turned_round_is_found_at_its_three_edges() {
    let list = shapes::torus(6, 5, 2.0, 1.0).to_face_list();
    let mut faces = triangles(&list);
    faces[7].reverse();
    let report = conformity(&FaceList::from_triangles(list.positions, &faces), None);
    assert!(report.findings.iter().all(|found| found.kind == Orientation && found.faces.contains(&7)));
    assert_eq!(report.findings.len(), 3);
}

#[test]
fn a_moebius_strip_is_found_once() {
    let turn = |k: usize| (k as f64 * 72_f64.to_radians()).sin_cos();
    let corners = (0..5).map(|k| DVec3::new(turn(k).1, turn(k).0, (k * k) as f64)).collect();
    let strip: Vec<[u32; 3]> = (0..5).map(|k| [k, (k + 1) % 5, (k + 2) % 5]).collect();
    let list = FaceList::from_triangles(corners, &strip);
    assert_eq!(kinds(&list), BTreeMap::from([(NonOrientable, 1)]));
}

#[test]
fn a_duplicate_is_found_and_hides_no_boundary() {
    assert_eq!(kinds(&torus_and(&[], &[&[0, 5, 6]])), BTreeMap::from([(DuplicateFace, 1)]));
    // A coarse face that stands twice still has a T-junction at its edge.
    let Split { list, hanging } = split(&shapes::icosahedron().to_face_list(), |k| k != 0, 0.0);
    let mut twice = list.clone();
    let coarse = twice.face(0).to_vec();
    twice.push_face(&coarse);
    assert_eq!(kinds(&twice), BTreeMap::from([(TJunction, hanging), (DuplicateFace, 1)]));
}

#[test]
fn degenerate_faces_and_wrong_indices_are_found() {
    let list = torus_and(&[], &[&[0, 0, 5], &[3, 4], &[0, 1, 99]]);
    let expected = [
        (DegenerateFace, vec![0, 0, 5], vec![60]),
        (DegenerateFace, vec![3, 4], vec![61]),
        (IndexOutOfRange, vec![], vec![62]),
    ];
    assert_eq!(outlines(&conformity(&list, None)), expected);
}

#[test]
fn isolated_vertices_are_told_but_do_no_harm() {
    let list = torus_and(&[DVec3::splat(1e6)], &[]);
    let report = conformity(&list, None);
    assert_eq!(outlines(&report), [(IsolatedVertex, vec![30], vec![])]);
    assert!(report.is_conforming());
    assert_eq!(report.tolerance, conformity(&torus_and(&[], &[]), None).tolerance);
}

#[test]
fn coordinates_that_are_no_numbers_are_found() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut list = torus_and(&[], &[]);
        list.positions[3].z = bad;
        let report = conformity(&list, None);
        assert_eq!(outlines(&report), [(NonFinite, vec![3], vec![])]);
        assert!(!report.is_conforming() && report.tolerance.is_finite());
    }
}

#[test]
fn levels_of_neighbours_are_compared() {
    let grid = shapes::grid(4, 1);
    let along =
        |triangle: vvmesh::Triangle| triangle.corners().map(|v| v.index() as u32 % 5).into_iter().min().unwrap();
    assert_eq!(balance(&grid, Sharing::Edge, along), []);
    let weak = balance(&grid, Sharing::Edge, |triangle| 2 * along(triangle));
    assert_eq!(weak.len(), 3);
    assert!(weak.iter().all(|finding| finding.kind == LevelBalance && finding.faces.len() == 2));
    // Two squares apart the triangles share vertices only.
    let steps = [0, 1, 2, 2];
    assert_eq!(balance(&grid, Sharing::Edge, |triangle| steps[along(triangle) as usize]), []);
    let slow = [0, 1, 1, 2];
    assert_eq!(balance(&grid, Sharing::Vertex, |triangle| slow[along(triangle) as usize]), []);
    let mut level = [0, 1, 2, 1].into_iter();
    let strong = balance(&fan(), Sharing::Vertex, |_| level.next().unwrap());
    assert_eq!((strong.len(), strong[0].faces.as_slice()), (1, [0, 2].as_slice()));
    assert_eq!(strong[0].message, "faces 0 and 2 at vertex v0 have levels 0 and 2");
}

/// An open fan of four triangles around vertex 0, whose last corner is joined to nothing.
fn fan() -> Mesh {
    let turn = |k: usize| (k as f64 * 0.5).sin_cos();
    let corners = std::iter::once(DVec3::ZERO).chain((0..5).map(|k| DVec3::new(turn(k).1, turn(k).0, 0.0))).collect();
    Mesh::from_triangles(corners, &[[0, 1, 2], [0, 2, 3], [0, 3, 4], [0, 4, 5]]).unwrap()
}

#[test]
fn good_files_have_no_findings() {
    let Some(folder) = common::meshes() else { return };
    let rows = plain::tables(&folder);
    let good = |row: &&plain::Row| row.cell("manifold") == "yes" && row.cell("genus") != "-";
    assert!(rows.iter().filter(good).count() >= 80);
    for row in rows.iter().filter(good) {
        let report = conformity(&plain::read(&folder.join(&row.file)), None);
        assert_eq!(outlines(&report), [], "{}", row.file);
    }
}

#[test]
fn bad_files_have_the_defects_that_their_index_names() {
    let Some(folder) = common::meshes() else { return };
    let expected: &[(&str, &[(FindingKind, usize)])] = &[
        ("bad/octa_negative.obj", &[]),
        ("bad/octa_crlf_bom.obj", &[]),
        ("bad/prism_polygons.obj", &[]),
        ("bad/octa_three_on_edge.obj", &[(NonManifoldEdge, 1)]),
        ("bad/hourglass.off", &[(BowTie, 1)]),
        ("bad/octa_one_flipped.obj", &[(Orientation, 3)]),
        ("bad/moebius_7.off", &[(NonOrientable, 1)]),
        ("bad/octa_degenerate.obj", &[(DegenerateFace, 1)]),
        ("bad/octa_duplicate.off", &[(DuplicateFace, 1)]),
        ("bad/octa_bad_index.obj", &[(IndexOutOfRange, 1)]),
        ("bad/octa_nan.obj", &[(NonFinite, 1)]),
        ("models/moebius.obj", &[(NonOrientable, 1)]),
        ("models/hourglass_ico.obj", &[(BowTie, 1)]),
        ("models/fan3.obj", &[(NonManifoldEdge, 1)]),
    ];
    for (file, findings) in expected {
        let found = kinds(&plain::read(&folder.join(file)));
        assert_eq!(found, findings.iter().copied().collect(), "{file}");
    }
    // Every OBJ and OFF of the index is in the list, or cannot be read at all.
    let index = std::fs::read_to_string(folder.join("bad/INDEX.tsv")).unwrap();
    let names = index.lines().skip(1).map(|line| line.split('\t').next().unwrap());
    for name in names.filter(|name| name.ends_with(".obj") || name.ends_with(".off")) {
        let listed = expected.iter().any(|(file, _)| *file == format!("bad/{name}"));
        assert!(listed || ["truncated.off", "empty.off"].contains(&name), "{name}");
    }
}

#[test]
fn scaling_changes_nothing_however_large_or_small() {
    let Split { list, hanging } = split(&shapes::torus(6, 5, 2.0, 1.0).to_face_list(), |k| k < 30, 0.0);
    for factor in [1e-300, 1e-150, 1e-20, 1e20, 1e150, 1e307] {
        let mut scaled = list.clone();
        scaled.positions.iter_mut().for_each(|p| *p *= factor);
        let report = conformity(&scaled, None);
        assert_eq!(report.findings.len(), hanging, "{factor}");
        assert!(report.findings.iter().all(|finding| finding.kind == TJunction) && report.tolerance.is_finite());
        let given = conformity(&scaled, Some(report.tolerance));
        assert_eq!(given.findings, report.findings);
    }
}

#[test]
fn hard_input_takes_no_quadratic_time() {
    let count = 60_002_u32;
    let apart: Vec<[u32; 3]> = (0..count / 3).map(|k| [3 * k, 3 * k + 1, 3 * k + 2]).collect();
    // All boundary vertices in one place.
    let one = FaceList::from_triangles(vec![DVec3::ONE; count as usize], &apart);
    assert_eq!(conformity(&one, None).findings.len(), 2, "the two vertices left over are isolated");
    // All in few places, so each edge has very many vertices at its ends and on it.
    let few = (0..count).map(|k| DVec3::X * f64::from(k % 3) * f64::from(1 + k % 2)).collect();
    let report = conformity(&FaceList::from_triangles(few, &apart), None);
    assert!(report.findings.iter().all(|finding| finding.vertices.len() <= 66));
    // Nearly one place, within the tolerance of a far vertex.
    let near = (0..count).map(|k| if k % 3 == 0 { DVec3::X } else { DVec3::Y * f64::from(k) * 1e-13 }).collect();
    assert!(conformity(&FaceList::from_triangles(near, &apart), None).findings.iter().all(|f| f.kind != TJunction));
    // Long slanting edges side by side, each with a box that holds all vertices.
    let beside = (0..count).map(|k| match (k % 3, f64::from(k / 3)) {
        (0, t) => DVec3::new(t, 0.0, 0.0),
        (1, t) => DVec3::new(t, 1e5, 1e5),
        (_, t) => DVec3::new(t + 0.4, 0.0, 0.0),
    });
    let beside = FaceList::from_triangles(beside.collect(), &apart);
    assert!(conformity(&beside, None).findings.iter().all(|finding| finding.kind == IsolatedVertex));
    // One long edge with all others on it.
    let mut on_one: Vec<DVec3> = (0..count).map(|k| DVec3::new(f64::from(k), f64::from(k % 3 % 2), 0.0)).collect();
    on_one[0] = DVec3::new(-1.0, 0.0, 0.0);
    on_one[2] = DVec3::new(1e6, 0.0, 0.0);
    let on_one = conformity(&FaceList::from_triangles(on_one, &apart), None);
    assert!(on_one.findings.iter().any(|finding| finding.kind == TJunction && finding.vertices.len() == 66));
}

#[test]
fn t_junctions_are_those_of_a_naive_search() {
    /// All distances between points of a lattice of few points are far from the tolerance, or far below.
    fn property(points: Vec<(u8, u8, u8)>, bytes: Vec<u8>) -> bool {
        let place = |&(x, y, z): &(u8, u8, u8)| DVec3::new(f64::from(x % 5), f64::from(y % 5), f64::from(z % 2));
        let positions: Vec<DVec3> = points.iter().map(place).collect();
        let corners: Vec<u32> = bytes.iter().map(|&v| u32::from(v) % points.len().max(1) as u32).collect();
        let faces =
            if points.is_empty() { vec![] } else { corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect() };
        let list = FaceList::from_triangles(positions.clone(), &faces);
        let found = conformity(&list, Some(1e-3));
        let set_aside: Vec<usize> = found
            .findings
            .iter()
            .filter_map(|f| match f.kind {
                DuplicateFace | DegenerateFace => f.faces.last().copied(),
                _ => None,
            })
            .collect();
        let mut uses: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        for (_, &[a, b, c]) in faces.iter().enumerate().filter(|(k, _)| !set_aside.contains(k)) {
            for (v, w) in [(a, b), (b, c), (c, a)] {
                *uses.entry((v.min(w) as usize, v.max(w) as usize)).or_default() += 1;
            }
        }
        let boundary: Vec<(usize, usize)> = uses.into_iter().filter(|one| one.1 == 1).map(|one| one.0).collect();
        let hangs = |x: usize, a: usize, b: usize| {
            let [x, a, b] = [x, a, b].map(|v| positions[v]);
            let between = (x - a).dot(b - a) > 0.0 && (x - b).dot(a - b) > 0.0;
            between && (x - a).cross(b - a).length_squared() == 0.0
        };
        let on = |&(a, b): &(usize, usize)| -> Vec<usize> {
            let mut ends: Vec<usize> = boundary.iter().flat_map(|&(v, w)| [v, w]).filter(|&x| hangs(x, a, b)).collect();
            ends.sort_unstable();
            ends.dedup();
            [vec![a, b], ends].concat()
        };
        let expected: Vec<Vec<usize>> = boundary.iter().map(on).filter(|all| all.len() > 2).collect();
        let t_junctions = found.findings.iter().filter(|f| f.kind == TJunction);
        let named = |f: &Finding| {
            let mut all: Vec<usize> = f.vertices.iter().map(|v| v.index()).collect();
            all[2..].sort_unstable();
            all
        };
        t_junctions.map(named).eq(expected)
    }
    check(225, 3_000, property as fn(Vec<(u8, u8, u8)>, Vec<u8>) -> bool);
}

#[test]
fn any_input_gets_an_answer() {
    fn property(numbers: Vec<(f64, f64, f64)>, corners: Vec<u8>, sides: Vec<u8>, tolerance: Option<f64>) -> bool {
        let mut list = FaceList::new(numbers.iter().map(|&(x, y, z)| DVec3::new(x, y, z)).collect());
        let modulus = numbers.len() as u32 + 1;
        let mut corners = corners.iter().map(|&v| u32::from(v) % modulus);
        for count in sides {
            let face: Vec<u32> = corners.by_ref().take(usize::from(count) % 6).collect();
            list.push_face(&face);
        }
        let report = conformity(&list, tolerance);
        let named = report.findings.iter().flat_map(|f| &f.vertices).all(|v| v.index() < list.vertex_count());
        let sorted = report.findings.is_sorted_by_key(|finding| finding.kind);
        let census = list.census();
        named && sorted && census.vertices == numbers.len() && report == conformity(&list, tolerance)
    }
    type Property = fn(Vec<(f64, f64, f64)>, Vec<u8>, Vec<u8>, Option<f64>) -> bool;
    check(226, 3_000, property as Property);
}
