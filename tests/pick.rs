//! Does a ray find the face that looking at all of them finds, and never slip through a closed surface?
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

mod common;

use common::load::load;
use vvmesh::adaptive::Incremental;
use vvmesh::glam::DVec3;
use vvmesh::pick::{FaceTree, Hit, Ray};
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Disk};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Dynamic, Subdivider};
use vvmesh::{Edge, Mesh, Triangle, VertexId, shapes};

/// Numbers that look random, the same in every run.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// A point in a cube around 0.
    fn point(&mut self, half: f64) -> DVec3 {
        DVec3::from([(); 3].map(|()| (2.0 * self.next() - 1.0) * half))
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }
}

/// Every face that a ray meets, by another test than that of the library, nearest first; with the least barycentric coordinate.
fn all_hits(mesh: &Mesh, ray: &Ray) -> Vec<(f64, f64, Triangle)> {
    let meet = |face: Triangle| {
        let [a, b, c] = face.corners().map(|v| mesh.position(v));
        let (ab, ac) = (b - a, c - a);
        let across = ray.direction().cross(ac);
        let determinant = ab.dot(across);
        let offset = ray.origin() - a;
        let v = offset.dot(across) / determinant;
        let w = ray.direction().dot(offset.cross(ab)) / determinant;
        let distance = ac.dot(offset.cross(ab)) / determinant;
        let least = v.min(w).min(1.0 - v - w);
        (least >= -1e-9 && distance >= 0.0 && distance.is_finite()).then_some((distance, least, face))
    };
    let mut hits: Vec<_> = mesh.triangles().filter_map(meet).collect();
    hits.sort_by(|one, other| one.0.total_cmp(&other.0));
    hits
}

/// Asserts that the first hit is that of looking at all faces, where rounding leaves no doubt about it.
fn assert_first(mesh: &Mesh, ray: &Ray, hit: Option<Hit>) {
    let hits = all_hits(mesh, ray);
    let Some(first) = hits.iter().find(|(_, least, _)| *least >= 1e-9) else {
        return assert!(!hits.is_empty() || hit.is_none(), "{hit:?}");
    };
    let hit = hit.unwrap_or_else(|| panic!("{ray:?} passes {first:?}"));
    let same = |(distance, _, _): &&(f64, f64, Triangle)| (distance - hit.distance).abs() <= 1e-9 * (1.0 + distance);
    let among: Vec<Triangle> = hits.iter().filter(same).map(|&(.., face)| face).collect();
    assert!(among.contains(&hit.face), "{hit:?} is not among {hits:?}");
    assert!(hit.distance <= first.0 + 1e-9 * (1.0 + first.0), "{hit:?}, but nearer is {first:?}");
    assert!(hit.weights.iter().all(|weight| (0.0..=1.0).contains(weight)), "{hit:?}");
    assert!((hit.weights.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{hit:?}");
    let along = ray.origin() + ray.direction() * hit.distance;
    assert!(hit.position.distance(along) <= 1e-9 * (1.0 + hit.distance), "{hit:?}");
}

fn models() -> Vec<Mesh> {
    let mut models = vec![
        shapes::tetrahedron(),
        shapes::icosahedron(),
        shapes::grid(7, 5),
        shapes::torus(40, 24, 1.0, 0.4),
        shapes::torus(9, 5, 1.0, 0.9),
    ];
    if let Some(folder) = common::meshes() {
        models.extend(
            ["papers/head_1200.off", "models/elephant.off", "models/anchor.off"].map(|name| load(&folder.join(name))),
        );
    }
    models
}

#[test]
fn random_rays_find_what_looking_at_all_faces_finds() {
    let mut numbers = Numbers(1);
    for mesh in models() {
        let tree = FaceTree::new(&mesh);
        let size = mesh.positions().iter().fold(0.0, |size: f64, p| size.max(p.abs().max_element()));
        let mut hits = 0;
        for k in 0..400 {
            let origin = numbers.point(2.0 * size);
            // To somewhere, to a point of the surface, along an axis.
            let direction = match k % 4 {
                0 => numbers.point(1.0),
                3 => [DVec3::X, -DVec3::Y, DVec3::Z][numbers.below(3)],
                _ => {
                    mesh.position(VertexId::new(numbers.below(mesh.vertex_count()))) + numbers.point(0.05 * size)
                        - origin
                }
            };
            let ray = Ray::new(origin, direction).unwrap();
            let hit = tree.pick(&mesh, &ray);
            hits += usize::from(hit.is_some());
            assert_first(&mesh, &ray, hit);
        }
        assert!(hits > 40, "{hits} hits");
    }
}

#[test]
fn no_ray_slips_through_an_edge_or_a_vertex() {
    let mut numbers = Numbers(2);
    // Faces meet in positions that are no round numbers; all origins are inside, so each ray has to meet something.
    for (mesh, inside) in [
        (shapes::icosahedron(), DVec3::ZERO),
        (shapes::octahedron(), DVec3::ZERO),
        (shapes::torus(30, 20, 2.0, 1.0), DVec3::X * 2.0),
    ] {
        let tree = FaceTree::new(&mesh);
        let edges: Vec<Edge> = mesh.edges().collect();
        for k in 0..20_000 {
            let origin = inside + numbers.point(0.2);
            let [a, b] = edges[numbers.below(edges.len())].ends().map(|v| mesh.position(v));
            let part = if k % 2 == 0 { numbers.next() } else { [0.0, 0.5, 1.0][numbers.below(3)] };
            let ray = Ray::new(origin, a.lerp(b, part) - origin).unwrap();
            assert!(tree.pick(&mesh, &ray).is_some(), "{ray:?}");
        }
    }
}

#[test]
fn at_a_vertex_the_smallest_face_around_it_is_hit() {
    let mesh = shapes::grid(6, 6);
    let tree = FaceTree::new(&mesh);
    for v in mesh.vertices() {
        for direction in [DVec3::Z, -DVec3::Z, DVec3::new(0.5, 0.25, 1.0)] {
            let ray = Ray::new(mesh.position(v) - 2.0 * direction, direction).unwrap();
            let hit = tree.pick(&mesh, &ray).unwrap();
            assert_eq!(Some(hit.face), mesh.rotation().triangles_around(v).min(), "{v}");
            assert_eq!(hit.position, mesh.position(v));
        }
    }
    // In the middle of an edge both faces are at the same distance.
    for edge in mesh.edges() {
        let [a, b] = edge.ends();
        let ray = Ray::new(mesh.position(a).midpoint(mesh.position(b)) + DVec3::Z, -DVec3::Z).unwrap();
        let beside = [mesh.rotation().left_of(a, b), mesh.rotation().right_of(a, b)];
        let faces = beside.iter().zip([[a, b], [b, a]]).filter_map(|(&c, [a, b])| Some(Triangle::new(a, b, c?)));
        assert_eq!(tree.pick(&mesh, &ray).map(|hit| (hit.face, hit.distance)), faces.min().map(|face| (face, 1.0)));
    }
}

#[test]
fn faces_without_area_are_passed_and_their_neighbours_hit() {
    // A square whose diagonal is a needle of two faces, and a face that lies in the ray.
    let corners =
        [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 0.0], [1.0, 3.0, 0.0]];
    let mesh = Mesh::from_triangles(
        corners.map(DVec3::from).to_vec(),
        &[[0, 1, 2], [0, 2, 4], [0, 4, 3], [4, 2, 3], [3, 2, 5]],
    )
    .unwrap();
    let tree = FaceTree::new(&mesh);
    for (x, y) in [(0.5, 0.5), (1.0, 1.0), (1.5, 1.5), (0.25, 0.25)] {
        let hit = tree.pick(&mesh, &Ray::new(DVec3::new(x, y, 1.0), -DVec3::Z).unwrap()).unwrap();
        assert_ne!(hit.face, Triangle::new(VertexId::new(0), VertexId::new(2), VertexId::new(4)));
    }
    assert_eq!(tree.pick(&mesh, &Ray::new(DVec3::new(-1.0, 0.5, 0.0), DVec3::X).unwrap()), None, "edge on");
    let flat = Mesh::from_triangles(vec![DVec3::ONE; 3], &[[0, 1, 2]]).unwrap();
    assert_eq!(FaceTree::new(&flat).pick(&flat, &Ray::new(DVec3::ZERO, DVec3::ONE).unwrap()), None);
}

#[test]
fn nothing_is_hit_where_nothing_is() {
    let ray = Ray::new(DVec3::ZERO, DVec3::Z).unwrap();
    let mut empty = Mesh::default();
    let mut tree = FaceTree::new(&empty);
    assert_eq!(tree.pick(&empty, &ray), None);
    tree.update(&empty, []);
    empty = Mesh::from_triangles(vec![DVec3::ONE; 4], &[]).unwrap();
    tree.update(&empty, empty.vertices());
    assert_eq!(tree.pick(&empty, &ray), None);
    let mesh = shapes::octahedron();
    let tree = FaceTree::new(&mesh);
    assert_eq!(tree.pick(&mesh, &Ray::new(DVec3::X * 3.0, DVec3::X).unwrap()), None, "behind");
    assert_eq!(tree.pick(&mesh, &Ray::new(DVec3::X * f64::MAX, -DVec3::X).unwrap()), None, "out of reach");
    assert_eq!(tree.pick(&mesh, &Ray::new(DVec3::X, DVec3::Y).unwrap()).map(|hit| hit.distance), Some(0.0), "on it");
}

#[test]
fn size_does_not_matter() {
    let mesh = shapes::torus(12, 8, 2.0, 1.0);
    let ray = |scale: f64| Ray::new(DVec3::new(2.1, 0.3, 4.0) * scale, DVec3::new(-0.1, 0.05, -1.0)).unwrap();
    let expected = FaceTree::new(&mesh).pick(&mesh, &ray(1.0)).unwrap();
    for power in [-1000, -600, 600, 1000] {
        let scale = 2_f64.powi(power);
        let mut scaled = mesh.clone();
        scaled.positions_mut().iter_mut().for_each(|position| *position *= scale);
        let hit = FaceTree::new(&scaled).pick(&scaled, &ray(scale)).unwrap();
        assert_eq!((hit.face, hit.weights, hit.distance), (expected.face, expected.weights, expected.distance * scale));
    }
}

/// Asserts that a tree that was kept up to date finds what a new one finds.
fn assert_up_to_date(tree: &FaceTree, mesh: &Mesh, numbers: &mut Numbers) {
    let fresh = FaceTree::new(mesh);
    for _ in 0..40 {
        let origin = numbers.point(4.0);
        let target = mesh.position(VertexId::new(numbers.below(mesh.vertex_count())));
        let ray = Ray::new(origin, target + numbers.point(0.02) - origin).unwrap();
        assert_eq!(tree.pick(mesh, &ray), fresh.pick(mesh, &ray));
    }
}

#[test]
fn a_tree_follows_local_steps() {
    let (mut mesh, mut scratch, mut numbers) = (shapes::torus(24, 16, 2.0, 1.0), Scratch::new(), Numbers(3));
    let (mut tree, mut history) = (FaceTree::new(&mesh), History::new(&mesh, Keep::default()));
    let subdivider = Subdivider::new(Loop::default(), Incremental::new(1).unwrap());
    for _ in 0..60 {
        let first = mesh.vertex_count();
        let disk = Disk::new(VertexId::new(numbers.below(first)), 2).select(&mesh, &mut scratch).unwrap();
        subdivider.step(&mut mesh, &mut history, &disk, &mut scratch, &mut Control::default()).unwrap();
        let new = (first..mesh.vertex_count()).map(VertexId::new);
        // Who moved has a new neighbour.
        tree.update(&mesh, new.clone().chain(new.flat_map(|x| mesh.ring(x).iter())));
        assert_up_to_date(&tree, &mesh, &mut numbers);
    }
    assert!(mesh.face_count() > 3000, "{}", mesh.face_count());
}

#[test]
fn a_tree_follows_what_goes_away_again() {
    let (mut mesh, mut scratch, mut numbers) = (shapes::torus(12, 8, 2.0, 1.0), Scratch::new(), Numbers(4));
    let (mut tree, mut history) = (FaceTree::new(&mesh), History::new(&mesh, Keep::default()));
    let dynamic = Dynamic::new(Loop::default()).unwrap();
    for k in 0..40 {
        let v = VertexId::new(7 * k % 96);
        let change = dynamic.refine(&mut mesh, &mut history, v, 3, &mut scratch, &mut Control::default()).unwrap();
        tree.update(&mesh, change.changed);
        assert_up_to_date(&tree, &mesh, &mut numbers);
        let change = dynamic.coarsen(&mut mesh, &mut history, v, 3, &mut scratch).unwrap();
        tree.update(&mesh, change.changed.into_iter().filter(|&v| mesh.rotation().contains(v)));
        assert_up_to_date(&tree, &mesh, &mut numbers);
    }
    assert_eq!(mesh.face_count(), 192);
}
