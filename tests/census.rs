//! Counts of face lists: against the tables of the mesh files, and what they mean where there is no manifold.

#![allow(clippy::unwrap_used, reason = "helpers of tests stop at what they do not expect")]

mod common;
#[path = "common/plain.rs"]
mod plain;

use vvmesh::error::DefectKind;
use vvmesh::glam::DVec3;
use vvmesh::soup::FaceList;

#[test]
fn counts_equal_the_tables_of_the_mesh_files() {
    let Some(folder) = common::meshes() else { return };
    let rows = plain::tables(&folder);
    assert!(rows.len() >= 80, "only {} files stand in the tables", rows.len());
    for row in rows {
        let list = plain::read(&folder.join(&row.file));
        let census = list.census();
        let same = |heading: &str, found: String| assert_eq!(found, row.cell(heading), "{heading} of {}", row.file);
        same("V", census.vertices.to_string());
        same("F", census.faces.to_string());
        same("comp.", census.components.to_string());
        same("chi", census.euler_characteristic.to_string());
        same("genus", census.genus.map_or("-".to_string(), |genus| genus.to_string()));
        same("valence", format!("{}..{}", census.valence.min.unwrap(), census.valence.max.unwrap()));
        if row.cell("loops") != "?" {
            same("loops", census.boundary_loops.to_string());
        }
        if row.cell("kinds") == "tri" {
            assert_eq!(census.triangles, census.faces, "{}", row.file);
        }
        assert_eq!(census.orientable, row.file != "models/moebius.obj", "{}", row.file);
        let of_valence: usize = census.valence.histogram.iter().map(|(valence, count)| valence * count).sum();
        assert_eq!(of_valence, 2 * census.edges, "{}", row.file);

        // The tables count both ends of an edge with too many faces as bad vertices too.
        let defects = list.defects();
        let of = |kind| defects.iter().filter(move |defect| defect.kind == kind);
        let bad_edges = of(DefectKind::NonManifoldEdge).count();
        let mut bad: Vec<_> = of(DefectKind::NonManifoldEdge).chain(of(DefectKind::BowTie)).collect();
        let mut bad_vertices: Vec<_> = bad.drain(..).flat_map(|defect| defect.vertices.clone()).collect();
        bad_vertices.sort_unstable();
        bad_vertices.dedup();
        let verdict = match (bad_edges, bad_vertices.len()) {
            (0, 0) => "yes".to_string(),
            (edges, vertices) => format!("no ({edges}e {vertices}v)"),
        };
        same("manifold", verdict);
    }
}

#[test]
fn an_empty_list_has_counts() {
    let census = FaceList::default().census();
    assert_eq!((census.vertices, census.edges, census.faces, census.components), (0, 0, 0, 0));
    assert_eq!((census.genus, census.orientable, census.bounds), (Some(0), true, None));
    assert_eq!((census.valence.min, census.valence.mean), (None, None));
}

#[test]
fn isolated_vertices_count_alone() {
    let mut list = vvmesh::shapes::grid(2, 2).to_face_list();
    let before = list.census();
    list.positions.extend([DVec3::splat(1e9), DVec3::NAN]);
    let after = list.census();
    assert_eq!((after.vertices, after.isolated_vertices), (11, 2));
    assert_eq!((after.bounds, &after.valence), (before.bounds, &before.valence));
    assert_eq!(after.bounds, Some([DVec3::ZERO, DVec3::new(2.0, 2.0, 0.0)]));
    assert_eq!((after.euler_characteristic, after.genus, after.components), (1, Some(0), 1));
}

#[test]
fn loops_are_counted_as_if_each_fan_had_its_own_vertex() {
    // Two triangles that meet in one vertex.
    let census = FaceList::from_triangles(vec![DVec3::ZERO; 5], &[[0, 1, 2], [0, 3, 4]]).census();
    assert_eq!((census.boundary_loops, census.components, census.genus), (2, 1, None));
    // In a grid without two squares that touch in a corner, the two holes make one.
    let grid = vvmesh::shapes::grid(4, 4);
    let all: Vec<[u32; 3]> = grid.to_face_list().faces().map(|face| face.try_into().unwrap()).collect();
    let square = |face: &[u32; 3]| {
        let lowest = *face.iter().min().unwrap();
        (lowest % 5, lowest / 5)
    };
    let kept: Vec<[u32; 3]> = all.into_iter().filter(|face| ![(1, 1), (2, 2)].contains(&square(face))).collect();
    assert_eq!(kept.len(), 28);
    assert_eq!(FaceList::from_triangles(grid.positions().to_vec(), &kept).census().boundary_loops, 2);
}

#[test]
fn lists_that_are_no_manifold_have_counts() {
    let mut list = FaceList::new(vec![DVec3::ZERO; 4]);
    for face in [&[0, 1, 2][..], &[0, 0, 1], &[1, 2], &[3], &[], &[2, 3, 9]] {
        list.push_face(face);
    }
    let census = list.census();
    assert_eq!((census.faces, census.edges, census.triangles), (6, 3, 3));
    assert_eq!((census.isolated_vertices, census.components, census.genus), (0, 1, None));
}
