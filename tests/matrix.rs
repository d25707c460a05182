//! Is the matrix the refinement: for every scheme, method and number of levels, and for the input moved?

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod common;
#[path = "common/tables.rs"]
mod tables;

use std::collections::BTreeMap;

use common::load::load;
use common::random::{Closed, Picks, Random, Surface, WithBoundary, check};
use common::run::schemes;
use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::glam::DVec3;
use vvmesh::limit::{AnyLimit, ButterflyLimit, Limit, LoopLimit, ModifiedButterflyLimit, Sqrt3Limit};
use vvmesh::matrix::{SubdivisionMatrix, WeightMatrix};
use vvmesh::scheme::{AnyScheme, Butterfly, FourEight, Loop, LoopWeights, ModifiedButterfly, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep, SplitKind};
use vvmesh::subdivide::{Control, Subdivider, Values};
use vvmesh::{Mesh, VertexId, shapes};

/// Each method; incremental with one ring and with two.
fn methods(scheme: &AnyScheme) -> [Subdivider; 4] {
    let incremental = |rings| Subdivider::new(scheme.clone(), Incremental::new(rings).unwrap());
    [Subdivider::new(scheme.clone(), Uniform), incremental(1), incremental(2), Subdivider::new(scheme.clone(), Simple)]
}

/// Refines with a selection that follows.
fn refine(input: &Mesh, subdivider: &Subdivider, selection: &Selection, levels: usize) -> (Mesh, SubdivisionMatrix) {
    let (mut mesh, mut selection) = (input.clone(), selection.clone());
    let (mut matrix, mut scratch) = (SubdivisionMatrix::new(input), Scratch::new());
    let mut history = History::new(input, Keep::default());
    for _ in 0..levels {
        let mut control = Control { follower: Some(&mut matrix), ..Control::default() };
        selection = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut control).unwrap().selection;
    }
    (mesh, matrix)
}

/// The same mesh with every vertex elsewhere.
fn moved(mesh: &Mesh) -> Mesh {
    let (mut moved, mut random) = (mesh.clone(), Random::new(7));
    for position in moved.positions_mut() {
        *position = *position * 1.5 + 0.3 * random.vector() + DVec3::new(2.0, -1.0, 0.5);
    }
    moved
}

/// Equal to 1e-12 of the greatest coordinate.
fn assert_near(made: &[DVec3], expected: &[DVec3], what: &str) {
    let scale = expected.iter().map(|position| position.abs().max_element()).fold(0.0, f64::max);
    assert_eq!(made.len(), expected.len(), "{what}");
    for (k, (made, expected)) in made.iter().zip(expected).enumerate() {
        assert!(made.distance(*expected) <= 1e-12 * scale, "{what}, row {k}: {made}, not {expected}");
    }
}

/// Each row adds to a sum: of k weights and for each level at most the rounding of k products and as many additions.
fn assert_sums(matrix: &WeightMatrix, sum: f64, levels: usize, what: &str) {
    for k in 0..matrix.row_count() {
        let row: Vec<f64> = matrix.row(k).map(|(_, weight)| weight).collect();
        let size: f64 = row.iter().map(|weight| weight.abs()).sum();
        let rounding = (levels + 1) as f64 * 2.0 * row.len() as f64 * f64::EPSILON * size;
        assert!((row.iter().sum::<f64>() - sum).abs() <= rounding.max(1e-14), "{what}, row {k}");
        assert!(matrix.row(k).is_sorted_by(|one, next| one.0 < next.0), "{what}, row {k}");
    }
}

fn the_matrix_is_the_refinement(input: &Mesh, selection: &Selection, levels: usize, what: &str) {
    let elsewhere = moved(input);
    let mut scaled = input.clone();
    scaled.positions_mut().iter_mut().for_each(|position| *position *= -4.0);
    let others = [("sqrt3", Sqrt3::default().into()), ("4-8", FourEight::default().into())];
    for (name, scheme) in schemes().into_iter().chain(others) {
        for (k, subdivider) in methods(&scheme).iter().enumerate() {
            let what = format!("{what}, {name}, method {k}");
            let (mesh, matrix) = refine(input, subdivider, selection, levels);
            let weights = matrix.weights();
            assert_eq!((weights.row_count(), weights.column_count()), (mesh.vertex_count(), input.vertex_count()));
            assert_near(&weights.apply(input.positions()), mesh.positions(), &what);
            // Blocks of 4-8 are chosen by lengths, so those are only scaled, without rounding.
            let elsewhere = if scheme.split_kind() == SplitKind::Bisect { &scaled } else { &elsewhere };
            let (again, same) = refine(elsewhere, subdivider, selection, levels);
            assert!(matrix == same, "{what}: positions do not count");
            assert_near(&weights.apply(elsewhere.positions()), again.positions(), &what);
            assert_sums(&weights, 1.0, levels, &what);
            if !matches!(scheme, AnyScheme::Butterfly(_) | AnyScheme::ModifiedButterfly(_)) {
                assert!(weights.csr().data().iter().all(|&weight| weight >= 0.0), "{what}");
            }
        }
    }
}

fn random_refinements<S: Surface>(surface: S, picks: Picks) {
    let mesh = surface.mesh();
    the_matrix_is_the_refinement(&mesh, &picks.patch(&mesh), 3, "a random mesh");
}

#[test]
fn the_matrix_times_the_input_is_the_refined_mesh() {
    check(81, 6, random_refinements::<Closed> as fn(Closed, Picks));
    check(82, 6, random_refinements::<WithBoundary> as fn(WithBoundary, Picks));
}

#[test]
fn the_matrix_of_every_small_mesh_file_is_its_refinement() {
    let Some(folder) = common::meshes() else { return };
    let mut tried = 0;
    for row in tables::readme(&folder) {
        let is_text = row.file.ends_with("obj") || row.file.ends_with("off");
        if is_text && row.is_manifold && row.is_orientable && row.kinds == "tri" && row.vertices <= 400 {
            let mesh = load(&folder.join(&row.file));
            the_matrix_is_the_refinement(
                &mesh,
                &(0..mesh.vertex_count().min(5)).map(VertexId::new).collect(),
                2,
                &row.file,
            );
            tried += 1;
        }
    }
    assert!(tried >= 15, "only {tried} files");
}

fn limit_rows_are_those_of_the_refined_mesh<S: Surface>(surface: S, picks: Picks) {
    let input = surface.mesh();
    for weights in [LoopWeights::Loop, LoopWeights::Warren] {
        let limit = LoopLimit::new(weights);
        let subdivider = Subdivider::new(Loop::new(weights), Incremental::new(1).unwrap());
        for levels in 0..3 {
            let (mesh, matrix) = refine(&input, &subdivider, &picks.patch(&input), levels);
            let rows = matrix.limit(&mesh, &limit);
            assert_near(&rows.apply(input.positions()), &limit.positions(&mesh), "limits");
            assert_sums(&rows, 1.0, levels + 1, "limits");
            normals_are_those_of_the_limit(&input, &mesh, &matrix, limit);
        }
    }
}

#[test]
fn limits_and_normals_are_rows_too() {
    check(83, 8, limit_rows_are_those_of_the_refined_mesh::<Closed> as fn(Closed, Picks));
    check(84, 8, limit_rows_are_those_of_the_refined_mesh::<WithBoundary> as fn(WithBoundary, Picks));
}

fn limits_of_any_scheme_are_rows<S: Surface>(surface: S) {
    let input = surface.mesh();
    let pairs: [(AnyScheme, AnyLimit); 4] = [
        (Loop::default().into(), LoopLimit::default().into()),
        (Butterfly.into(), ButterflyLimit.into()),
        (ModifiedButterfly.into(), ModifiedButterflyLimit.into()),
        (Sqrt3::default().into(), Sqrt3Limit.into()),
    ];
    for (scheme, limit) in pairs {
        let (mesh, matrix) = refine(&input, &Subdivider::new(scheme, Uniform), &Selection::empty(), 2);
        let rows = matrix.limit(&mesh, &limit);
        assert_near(&rows.apply(input.positions()), &limit.positions(&mesh), "limits");
        assert_sums(&rows, 1.0, 3, "limits");
        for tangents in matrix.tangents(&mesh, &limit).tangents() {
            assert_sums(tangents, 0.0, 16, "tangents");
        }
    }
}

#[test]
fn every_scheme_with_limits_has_rows_of_them() {
    check(85, 3, limits_of_any_scheme_are_rows::<Closed> as fn(Closed));
    check(86, 3, limits_of_any_scheme_are_rows::<WithBoundary> as fn(WithBoundary));
}

/// Rows are made again and again, those that are out of date thrown out, and S is still the refinement.
#[test]
fn many_small_steps_are_one_matrix() {
    let input = shapes::torus(9, 6, 2.0, 1.0);
    for scheme in [Loop::default().into(), Sqrt3::default().into(), AnyScheme::from(FourEight::default())] {
        let (mut mesh, mut history, mut matrix) =
            (input.clone(), History::new(&input, Keep::default()), SubdivisionMatrix::new(&input));
        let subdivider = Subdivider::new(scheme, Incremental::new(1).unwrap());
        for k in 0..30 {
            let v = VertexId::new(7 * k % input.vertex_count());
            let selection: Selection = [v].into_iter().collect();
            let mut control = Control { follower: Some(&mut matrix), ..Control::default() };
            subdivider.step(&mut mesh, &mut history, &selection, &mut Scratch::new(), &mut control).unwrap();
        }
        assert_near(&matrix.weights().apply(input.positions()), mesh.positions(), "many steps");
        assert_sums(&matrix.weights(), 1.0, 30, "many steps");
    }
}

fn normals_are_those_of_the_limit(input: &Mesh, mesh: &Mesh, matrix: &SubdivisionMatrix, limit: LoopLimit) {
    let rows = matrix.tangents(mesh, &limit);
    for tangents in rows.tangents() {
        assert_sums(tangents, 0.0, 8, "tangents");
    }
    let normals = rows.normals(input.positions());
    assert_eq!(rows.sides().len(), normals.len());
    let counted: usize = mesh.vertices().map(|v| limit.side_count(mesh.neighborhood(), v)).sum();
    assert_eq!(rows.sides().len(), counted);
    for (&(v, side), normal) in rows.sides().iter().zip(normals) {
        match (normal, limit.normal(mesh, v, side)) {
            (Some(made), Some(expected)) => assert!(made.distance(expected) < 1e-9, "{v}: {made}, not {expected}"),
            (made, expected) => assert_eq!(made, expected, "{v}"),
        }
    }
}

#[test]
fn a_flat_or_vanishing_star_has_no_normal() {
    let mesh = shapes::octahedron();
    let matrix = SubdivisionMatrix::new(&mesh);
    let rows = matrix.tangents(&mesh, &LoopLimit::default());
    assert_eq!(rows.normals(&[DVec3::ONE; 6]), [None; 6]);
    let line: Vec<DVec3> = (0..6).map(|k| DVec3::new(0.1, 0.2, 0.3) * f64::from(k)).collect();
    assert_eq!(rows.normals(&line), [None; 6]);
    assert!(rows.normals(mesh.positions()).iter().all(Option::is_some));
}

/// On a regular mesh an even row has 7 entries and an odd one 4, and nothing is pruned.
#[test]
fn a_regular_step_has_the_known_entries() {
    let mesh = shapes::torus(9, 6, 2.0, 1.0);
    let (_, matrix) = refine(&mesh, &Subdivider::new(Loop::default(), Uniform), &Selection::empty(), 1);
    let weights = matrix.weights();
    assert_eq!(weights.nonzero_count(), 7 * 54 + 4 * 162);
    assert_eq!(weights.memory_bytes(), 12 * weights.nonzero_count() + 8 * (54 + 162 + 1));
    let center: Vec<_> = weights.row(0).filter(|&(column, _)| column == 0).collect();
    assert_eq!(center, [(0, 0.625)]);
    let csr = weights.into_csr();
    assert_eq!((csr.rows(), csr.cols(), csr.nnz()), (216, 54, 1026));
}

/// The second tangent of a regular star weighs the first neighbour with sin 0: a zero is an entry as any other.
#[test]
fn nothing_is_pruned() {
    let torus = shapes::torus(9, 6, 2.0, 1.0);
    let rows = SubdivisionMatrix::new(&torus).tangents(&torus, &LoopLimit::default());
    let [_, second] = rows.tangents();
    for v in 0..54 {
        assert_eq!(second.row(v).len(), 6);
        assert!(second.row(v).any(|(_, weight)| weight == 0.0));
    }
}

/// The matrix of two steps is the product of those of one.
#[test]
fn levels_multiply() {
    let mesh = shapes::torus(6, 5, 2.0, 1.0);
    let subdivider = Subdivider::new(Loop::default(), Uniform);
    let (once, first) = refine(&mesh, &subdivider, &Selection::empty(), 1);
    let (_, second) = refine(&once, &subdivider, &Selection::empty(), 1);
    let (_, both) = refine(&mesh, &subdivider, &Selection::empty(), 2);
    let product = second.weights().csr() * first.weights().csr();
    let entries = |csr: &vvmesh::sprs::CsMatI<f64, u32, usize>| -> BTreeMap<(u32, u32), f64> {
        csr.iter().map(|(&weight, place)| (place, weight)).collect()
    };
    let (made, expected) = (entries(both.weights().csr()), entries(&product));
    assert!(made.keys().eq(expected.keys()));
    assert!(made.values().zip(expected.values()).all(|(one, other)| (one - other).abs() < 1e-15));
}

/// Other values than positions go through the same product.
#[test]
fn any_values_can_be_weighed() {
    let mesh = shapes::icosahedron();
    let heat: Vec<f64> = (0..12).map(f64::from).collect();
    let (_, matrix) = refine(&mesh, &Subdivider::new(Loop::default(), Uniform), &Selection::empty(), 1);
    let mut followed = Values::new(heat.clone());
    let mut control = Control { follower: Some(&mut followed), ..Control::default() };
    let mut history = History::new(&mesh, Keep::default());
    Subdivider::new(Loop::default(), Uniform)
        .step(&mut mesh.clone(), &mut history, &Selection::empty(), &mut Scratch::new(), &mut control)
        .unwrap();
    let product = matrix.weights().apply(&heat);
    assert!(product.iter().zip(followed.shown()).all(|(one, other)| (one - other).abs() < 1e-14));
}

#[test]
#[should_panic(expected = "the mesh is the one that was followed")]
fn another_mesh_is_not_followed() {
    let mut matrix = SubdivisionMatrix::new(&shapes::octahedron());
    let mut mesh = shapes::icosahedron();
    let mut history = History::new(&mesh, Keep::default());
    let mut control = Control { follower: Some(&mut matrix), ..Control::default() };
    let subdivider = Subdivider::new(Loop::default(), Uniform);
    let _ = subdivider.step(&mut mesh, &mut history, &Selection::empty(), &mut Scratch::new(), &mut control);
}
