//! Every defect of a face list is found, with its ids, and a mesh is built exactly if there is none.

#![allow(clippy::unwrap_used, reason = "helpers of tests stop at what they do not expect")]

mod common;

use std::collections::{BTreeMap, BTreeSet};

use common::random::check;
use quickcheck::TestResult;
use vvmesh::error::{Defect, DefectKind};
use vvmesh::glam::DVec3;
use vvmesh::soup::FaceList;
use vvmesh::{Mesh, VertexId, shapes};

const OCTAHEDRON: [[u32; 3]; 8] =
    [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]];

/// Points in general position.
fn points(count: usize) -> Vec<DVec3> {
    (0..count).map(|k| k as f64).map(|t| DVec3::new(t.sin(), t.cos(), t * 0.3)).collect()
}

fn defects(count: usize, triangles: &[[u32; 3]]) -> Vec<Defect> {
    let error = Mesh::from_triangles(points(count), triangles).expect_err("this is no mesh");
    assert_eq!(error.defects(), FaceList::from_triangles(points(count), triangles).defects());
    error.defects().to_vec()
}

/// Kind, vertices and faces.
type Outline = (DefectKind, Vec<usize>, Vec<usize>);

fn outlines(defects: &[Defect]) -> Vec<Outline> {
    let outline = |d: &Defect| (d.kind, d.vertices.iter().map(|v| v.index()).collect(), d.faces.clone());
    defects.iter().map(outline).collect()
}

fn octahedron_and(vertices: usize, more: &[[u32; 3]]) -> Vec<Outline> {
    outlines(&defects(vertices, &[&OCTAHEDRON, more].concat()))
}

#[test]
fn an_index_out_of_range_is_one_defect() {
    let found = octahedron_and(6, &[[0, 1, 6], [u32::MAX, 1, 2]]);
    assert_eq!(found, [(DefectKind::IndexOutOfRange, vec![], vec![8]), (DefectKind::IndexOutOfRange, vec![], vec![9])]);
}

#[test]
fn a_degenerate_face_is_one_defect() {
    assert_eq!(octahedron_and(6, &[[0, 0, 1]]), [(DefectKind::DegenerateFace, vec![0, 0, 1], vec![8])]);
    let mut list = FaceList::new(points(6));
    for face in [&[0, 1][..], &[], &[0, 1, 2, 3, 1], &[0, 1, 9, 0]] {
        list.push_face(face);
    }
    let expected = [
        (DefectKind::IndexOutOfRange, vec![], vec![3]),
        (DefectKind::DegenerateFace, vec![0, 1], vec![0]),
        (DefectKind::DegenerateFace, vec![], vec![1]),
        (DefectKind::DegenerateFace, vec![0, 1, 2, 3, 1], vec![2]),
        (DefectKind::DegenerateFace, vec![0, 1, 0], vec![3]),
    ];
    assert_eq!(outlines(&list.defects()), expected);
}

#[test]
fn a_duplicate_is_one_defect_however_it_is_written() {
    for face in [[0, 1, 4], [1, 4, 0], [4, 1, 0]] {
        let vertices = face.map(|v| v as usize).to_vec();
        assert_eq!(octahedron_and(6, &[face]), [(DefectKind::DuplicateFace, vertices, vec![0, 8])]);
    }
    // Two triangles glued along all sides.
    let pillow = defects(3, &[[0, 1, 2], [2, 1, 0]]);
    assert_eq!(outlines(&pillow), [(DefectKind::DuplicateFace, vec![2, 1, 0], vec![0, 1])]);
    assert_eq!(pillow[0].message, "face 1 repeats face 0, turned round (corners v2, v1 and v0)");
}

#[test]
fn polygons_of_the_same_corners_in_another_order_are_no_duplicates() {
    let mut list = FaceList::new(points(6));
    for face in [[0, 1, 2, 3], [0, 2, 1, 3], [3, 2, 1, 0]] {
        list.push_face(&face);
    }
    let duplicates: Vec<Outline> =
        outlines(&list.defects()).into_iter().filter(|defect| defect.0 == DefectKind::DuplicateFace).collect();
    assert_eq!(duplicates, [(DefectKind::DuplicateFace, vec![3, 2, 1, 0], vec![0, 2])]);
    let mut list = FaceList::new(points(6));
    for face in [&[0, 1, 2, 3, 4][..], &[0, 1, 2, 4, 3], &[1, 0, 4, 3, 2], &[0, 1, 2]] {
        list.push_face(face);
    }
    assert_eq!(outlines(&list.defects())[0], (DefectKind::DuplicateFace, vec![1, 0, 4, 3, 2], vec![0, 2]));
}

#[test]
fn an_edge_with_three_faces_is_one_defect() {
    assert_eq!(octahedron_and(7, &[[0, 1, 6]]), [(DefectKind::NonManifoldEdge, vec![0, 1], vec![0, 4, 8])]);
}

#[test]
fn a_vertex_of_two_fans_is_one_defect() {
    assert_eq!(octahedron_and(8, &[[0, 6, 7]]), [(DefectKind::BowTie, vec![0], vec![0, 3, 4, 7, 8])]);
}

#[test]
fn a_face_turned_round_is_told_at_its_edges_and_mended_by_orienting() {
    let mut faces = OCTAHEDRON;
    faces[0].reverse();
    let error = Mesh::from_triangles(points(6), &faces).unwrap_err();
    let expected = [
        (DefectKind::Orientation, vec![0, 1], vec![0, 4]),
        (DefectKind::Orientation, vec![0, 4], vec![0, 3]),
        (DefectKind::Orientation, vec![1, 4], vec![0, 1]),
    ];
    assert_eq!(outlines(error.defects()), expected);
    assert_eq!(error.defects()[0].message, "faces 0 and 4 both run from v1 to v0");
    assert!(error.is_mended_by_orienting());
    assert!(error.to_string().ends_with("turning faces round so that they agree would mend it"));
}

#[test]
fn a_moebius_strip_is_one_defect_for_each_component() {
    let strip =
        |first: u32| -> Vec<[u32; 3]> { (0..5).map(|k| [k, (k + 1) % 5, (k + 2) % 5].map(|v| v + first)).collect() };
    let two = [strip(0), strip(5), vec![[10, 11, 12], [10, 11, 13]]].concat();
    let found = outlines(&defects(14, &two));
    let kinds: Vec<DefectKind> = found.iter().map(|defect| defect.0).collect();
    assert_eq!(kinds, [DefectKind::Orientation, DefectKind::NonOrientable, DefectKind::NonOrientable]);
    assert_eq!(found[0], (DefectKind::Orientation, vec![10, 11], vec![10, 11]));
    for (defect, faces) in found[1..].iter().zip([0..5_usize, 5..10]) {
        assert!(defect.2.len() == 2 && defect.2.iter().all(|face| faces.contains(face)));
        let shared = |face: &[u32; 3]| defect.1.iter().all(|&v| face.contains(&(v as u32)));
        assert!(defect.2.iter().all(|&face| shared(&two[face])), "both faces are at the edge");
    }
}

#[test]
fn a_coordinate_that_is_no_number_is_one_defect() {
    let mut positions = points(7);
    positions[6].y = f64::INFINITY;
    positions[2].x = f64::NAN;
    let error = Mesh::from_triangles(positions, &OCTAHEDRON).unwrap_err();
    assert_eq!(
        outlines(error.defects()),
        [(DefectKind::NonFinite, vec![2], vec![]), (DefectKind::NonFinite, vec![6], vec![])]
    );
}

#[test]
fn all_defects_are_told_at_once_in_order() {
    let more = [[0, 1, 6], [0, 9, 8], [3, 3, 3], [4, 1, 0], [0, 1, 99], [11, 12, 10], [11, 12, 13]];
    let kinds: Vec<DefectKind> = octahedron_and(14, &more).into_iter().map(|defect| defect.0).collect();
    use DefectKind::{BowTie, DegenerateFace, DuplicateFace, IndexOutOfRange, NonManifoldEdge, Orientation};
    assert_eq!(kinds, [IndexOutOfRange, DegenerateFace, DuplicateFace, NonManifoldEdge, BowTie, Orientation]);
}

#[test]
fn a_vertex_in_very_many_faces_takes_no_quadratic_time() {
    let count = 200_000;
    let fan: Vec<[u32; 3]> = (1..count).map(|k| [0, k, k + 1]).collect();
    assert!(Mesh::from_triangles(vec![DVec3::ZERO; count as usize + 1], &fan).is_ok());
    let book: Vec<[u32; 3]> = (2..count).map(|k| [0, 1, k]).collect();
    let found = FaceList::from_triangles(vec![DVec3::ZERO; count as usize], &book).defects();
    assert_eq!((found.len(), found[0].faces.len()), (1, book.len()));
    assert!(found[0].message.len() < 200);
    let apart: Vec<[u32; 3]> = (0..count).map(|k| [0, 2 * k + 1, 2 * k + 2]).collect();
    let found = FaceList::from_triangles(vec![DVec3::ZERO; 2 * count as usize + 1], &apart).defects();
    assert_eq!((found.len(), found[0].kind), (1, DefectKind::BowTie));
    let mut one = FaceList::new(vec![DVec3::ZERO; count as usize]);
    for _ in 0..2 {
        one.push_face(&(0..count).collect::<Vec<u32>>());
    }
    assert_eq!(one.defects().len(), 1);
}

/// Triangles over few vertices, so that every kind of defect is common. Indices one above the range occur.
fn soup(bytes: &[u8], vertices: u32) -> Vec<[u32; 3]> {
    let corner = |byte: u8| u32::from(byte) % (vertices * 16 + 1) / 16;
    bytes.chunks_exact(3).map(|three| [corner(three[0]), corner(three[1]), corner(three[2])]).collect()
}

#[test]
fn a_mesh_is_built_exactly_if_there_is_no_defect() {
    fn property(bytes: Vec<u8>, vertices: u32, length: usize) -> bool {
        let vertices = 3 + vertices % 7;
        let triangles = soup(&bytes[..bytes.len().min(3 * (1 + length % 6))], vertices);
        let list = FaceList::from_triangles(points(vertices as usize), &triangles);
        Mesh::from_triangles(points(vertices as usize), &triangles).is_ok() == list.defects().is_empty()
    }
    check(221, 20_000, property as fn(Vec<u8>, u32, usize) -> bool);
}

#[test]
fn part_of_a_shape_with_faces_turned_is_built_exactly_if_there_is_no_defect() {
    fn property(mask: u32, turned: Vec<u8>, swap: Option<u8>) -> bool {
        let mut faces: Vec<[u32; 3]> =
            shapes::icosahedron().to_face_list().faces().map(|face| face.try_into().unwrap()).collect();
        for k in turned.iter().take(2) {
            faces[usize::from(*k) % 20].reverse();
        }
        if let Some(k) = swap {
            faces[usize::from(k) % 20][0] = u32::from(k) % 12;
        }
        let kept: Vec<[u32; 3]> = (0..20).filter(|k| mask >> k & 1 == 1).map(|k| faces[k]).collect();
        let list = FaceList::from_triangles(points(12), &kept);
        Mesh::from_triangles(points(12), &kept).is_ok() == list.defects().is_empty()
    }
    check(222, 5_000, property as fn(u32, Vec<u8>, Option<u8>) -> bool);
}

#[test]
fn defects_are_those_of_a_naive_search() {
    fn property(bytes: Vec<u8>, vertices: u32, length: usize) -> TestResult {
        let vertices = 4 + vertices % 6;
        let triangles = soup(&bytes[..bytes.len().min(3 * (1 + length % 8))], vertices);
        let list = FaceList::from_triangles(points(vertices as usize), &triangles);
        let found = outlines(&list.defects());
        let expected = naive(&triangles, vertices);
        if found.iter().filter(|d| d.0 != DefectKind::NonOrientable).ne(expected.iter()) {
            return TestResult::error(format!("{triangles:?}: found {found:?}, expected {expected:?}"));
        }
        TestResult::passed()
    }
    check(223, 20_000, property as fn(Vec<u8>, u32, usize) -> TestResult);
}

/// All defects but the one-sided components, by trying everything; orientation by trying all ways to turn faces.
fn naive(triangles: &[[u32; 3]], vertices: u32) -> Vec<Outline> {
    let ids = |face: &[u32]| face.iter().map(|&v| v as usize).collect::<Vec<usize>>();
    let mut kept: BTreeMap<usize, [u32; 3]> = BTreeMap::new();
    let mut found = Vec::new();
    for (k, face) in triangles.iter().enumerate() {
        let set: BTreeSet<u32> = face.iter().copied().collect();
        let exists: Vec<u32> = face.iter().copied().filter(|&v| v < vertices).collect();
        if exists.len() < 3 {
            found.push((DefectKind::IndexOutOfRange, vec![], vec![k]));
        }
        if set.len() < 3 {
            found.push((DefectKind::DegenerateFace, ids(&exists), vec![k]));
        }
        if exists.len() < 3 || set.len() < 3 {
            continue;
        }
        match kept.iter().find(|(_, other)| other.iter().copied().collect::<BTreeSet<u32>>() == set) {
            Some((&first, _)) => found.push((DefectKind::DuplicateFace, ids(face), vec![first, k])),
            None => drop(kept.insert(k, *face)),
        }
    }
    let runs = |face: &[u32; 3], a: u32, b: u32| (0..3).any(|k| (face[k], face[(k + 1) % 3]) == (a, b));
    let at = |a: u32, b: u32| -> Vec<usize> {
        kept.iter().filter(|(_, face)| runs(face, a, b) || runs(face, b, a)).map(|(&k, _)| k).collect()
    };
    let pairs: Vec<(u32, u32)> = (0..vertices).flat_map(|a| (a + 1..vertices).map(move |b| (a, b))).collect();
    for &(a, b) in pairs.iter().filter(|&&(a, b)| at(a, b).len() > 2) {
        found.push((DefectKind::NonManifoldEdge, ids(&[a, b]), at(a, b)));
    }
    let reach = |start: usize, near: &dyn Fn(usize, usize) -> bool| {
        let mut reached = BTreeSet::from([start]);
        for _ in 0..kept.len() {
            let more: Vec<usize> =
                kept.keys().copied().filter(|&k| reached.iter().any(|&reached| near(reached, k))).collect();
            reached.extend(more);
        }
        reached
    };
    for v in 0..vertices {
        let around: Vec<usize> = kept.iter().filter(|(_, face)| face.contains(&v)).map(|(&k, _)| k).collect();
        let near = |p: usize, q: usize| {
            (0..vertices).any(|w| w != v && [p, q].iter().all(|&k| at(v.min(w), v.max(w)).contains(&k)))
        };
        if around.first().is_some_and(|&first| reach(first, &near).len() < around.len()) {
            found.push((DefectKind::BowTie, ids(&[v]), around));
        }
    }
    let two_sided: Vec<(u32, u32)> = pairs.iter().copied().filter(|&(a, b)| at(a, b).len() == 2).collect();
    let same_way = |a: u32, b: u32| at(a, b).iter().filter(|k| runs(&kept[*k], a, b)).count() != 1;
    let linked = |p: usize, q: usize| two_sided.iter().any(|&(a, b)| at(a, b) == [p.min(q), p.max(q)]);
    for &(a, b) in two_sided.iter().filter(|&&(a, b)| same_way(a, b)) {
        let component: Vec<usize> = reach(at(a, b)[0], &linked).into_iter().collect();
        let inside: Vec<(u32, u32)> =
            two_sided.iter().copied().filter(|&(a, b)| component.contains(&at(a, b)[0])).collect();
        let mends = |turned: usize| {
            let is_turned = |face: usize| turned >> component.iter().position(|&k| k == face).unwrap() & 1 == 1;
            inside.iter().all(|&(a, b)| same_way(a, b) == (is_turned(at(a, b)[0]) != is_turned(at(a, b)[1])))
        };
        if (0..1 << component.len()).any(mends) {
            found.push((DefectKind::Orientation, ids(&[a, b]), at(a, b)));
        }
    }
    found.sort_by_key(|defect| defect.0);
    found
}

#[test]
fn a_one_sided_component_is_told_exactly_if_its_edges_are_not() {
    fn property(bytes: Vec<u8>, length: usize) -> bool {
        let triangles = soup(&bytes[..bytes.len().min(3 * (3 + length % 10))], 5);
        let list = FaceList::from_triangles(points(5), &triangles);
        let told = list.defects().iter().any(|defect| defect.kind == DefectKind::NonOrientable);
        // Turning every face that takes part in a told edge one by one must never mend a one-sided component.
        let orientable = |turned: usize| {
            let faces: Vec<[u32; 3]> = (0..triangles.len())
                .map(|k| {
                    let [a, b, c] = triangles[k];
                    if turned >> k & 1 == 1 { [c, b, a] } else { [a, b, c] }
                })
                .collect();
            let kinds = FaceList::from_triangles(points(5), &faces).defects();
            !kinds.iter().any(|d| matches!(d.kind, DefectKind::Orientation | DefectKind::NonOrientable))
        };
        told != (0..1_usize << triangles.len()).any(orientable)
    }
    check(224, 100, property as fn(Vec<u8>, usize) -> bool);
}

#[test]
fn vertices_without_a_face_are_kept() {
    let mesh = Mesh::from_triangles(points(9), &OCTAHEDRON).unwrap();
    assert_eq!((mesh.vertex_count(), mesh.face_count()), (9, 8));
    assert_eq!(mesh.ring(VertexId::new(8)).valence(), 0);
}
