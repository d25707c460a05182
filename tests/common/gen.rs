//! What the properties are tried on: a base shape and a script of edits, never a list of triangles, so that whatever is
//! generated, and whatever it shrinks to, is a mesh.

use quickcheck::{Arbitrary, Gen, QuickCheck, Testable};
use vvmesh::glam::DVec3;
use vvmesh::{Mesh, shapes};

/// Edits: what to do, and where. Both numbers are read modulo what there is.
pub(crate) type Script = Vec<(u8, u16)>;

/// A script on a mesh without boundary: spheres, tori, two components.
#[derive(Clone, Debug)]
pub(crate) struct Closed {
    pub(crate) base: u8,
    pub(crate) script: Script,
}

/// A script on a mesh with one boundary loop or several, some of them triangles.
#[derive(Clone, Debug)]
pub(crate) struct WithBoundary {
    pub(crate) base: u8,
    pub(crate) script: Script,
}

impl Closed {
    pub(crate) fn mesh(&self) -> Mesh {
        match self.base % 6 {
            0 => shapes::tetrahedron(),
            1 => shapes::octahedron(),
            2 => shapes::icosahedron(),
            3 => shapes::torus(3, 3, 2.0, 1.0),
            4 => shapes::torus(5, 4, 2.0, 1.0),
            _ => beside(&shapes::tetrahedron(), &shapes::torus(4, 3, 2.0, 1.0)),
        }
    }
}

impl WithBoundary {
    pub(crate) fn mesh(&self) -> Mesh {
        match self.base % 7 {
            0 => shapes::grid(1, 1),
            1 => shapes::grid(2, 2),
            2 => shapes::grid(4, 3),
            // Triangular holes: a sphere with one and with two of them, a torus with three.
            3 => with_holes(&shapes::tetrahedron(), 1),
            4 => with_holes(&shapes::octahedron(), 2),
            5 => with_holes(&shapes::torus(5, 4, 2.0, 1.0), 3),
            _ => beside(&with_holes(&shapes::icosahedron(), 2), &shapes::grid(2, 1)),
        }
    }
}

macro_rules! arbitrary {
    ($($name:ident),*) => {
        $(impl Arbitrary for $name {
            fn arbitrary(g: &mut Gen) -> Self {
                Self { base: u8::arbitrary(g), script: Script::arbitrary(g) }
            }

            fn shrink(&self) -> Box<dyn Iterator<Item = Self>> {
                let base = self.base;
                Box::new(self.script.shrink().map(move |script| Self { base, script }))
            }
        })*
    };
}

arbitrary!(Closed, WithBoundary);

/// Tries a property on cases that are the same at every run; `VV_SEED` chooses others. A failure tells the seed.
pub(crate) fn check(cases: u64, property: impl Testable) {
    let seed = std::env::var("VV_SEED").map_or(2003, |seed| seed.parse().expect("VV_SEED is a number"));
    eprintln!("VV_SEED={seed}");
    QuickCheck::new().rng(Gen::from_size_and_seed(40, seed)).tests(cases).quickcheck(property);
}

/// A mesh of two, with an isolated vertex between them.
fn beside(one: &Mesh, other: &Mesh) -> Mesh {
    let offset = one.vertex_count() as u32 + 1;
    let mut positions = one.positions().to_vec();
    positions.push(DVec3::ZERO);
    positions.extend(other.positions().iter().map(|&p| p + 10.0 * DVec3::X));
    let mut triangles = indices(one);
    triangles.extend(indices(other).iter().map(|triangle| triangle.map(|v| v + offset)));
    Mesh::from_triangles(positions, &triangles).expect("two meshes side by side are one")
}

/// A mesh with so many triangular holes, the first of its triangles that share no corner.
fn with_holes(mesh: &Mesh, count: usize) -> Mesh {
    let mut holes: Vec<[u32; 3]> = Vec::new();
    let mut triangles = indices(mesh);
    triangles.retain(|triangle| {
        let apart = !holes.as_flattened().iter().any(|v| triangle.contains(v));
        if apart && holes.len() < count {
            holes.push(*triangle);
            return false;
        }
        true
    });
    assert_eq!(holes.len(), count);
    Mesh::from_triangles(mesh.positions().to_vec(), &triangles).expect("holes that do not touch leave a mesh")
}

fn indices(mesh: &Mesh) -> Vec<[u32; 3]> {
    mesh.triangles().map(|triangle| triangle.corners().map(|v| v.index() as u32)).collect()
}
