//! The model of `vv demo`: a vase, open at the top, with a sharp edge around its foot.

use std::f64::consts::TAU;

use vvmesh::glam::DVec3;
use vvmesh::{Edge, Mesh, VertexId};

/// How many vertices each ring of the vase has.
const AROUND: usize = 12;

/// Radius and height of the rings, from the foot to the rim.
const PROFILE: [[f64; 2]; 8] =
    [[0.52, 0.0], [0.66, 0.32], [0.88, 0.72], [0.96, 1.16], [0.78, 1.58], [0.48, 1.88], [0.42, 2.2], [0.62, 2.5]];

/// What is refined: one side from the foot to the rim, so that it meets the sharp edge and the boundary.
pub(crate) const SELECT: &str = "sphere:1.1,1.25,0,1.4";

/// The vase. Vertex 0 is the middle of its bottom; the ring of the foot is sharp.
pub(crate) fn vase() -> Mesh {
    let mut corners = vec![DVec3::ZERO];
    for (ring, [radius, height]) in PROFILE.into_iter().enumerate() {
        for k in 0..AROUND {
            // Each ring is turned by half a step against the one below, which makes nearly equal triangles.
            let turn = (k as f64 + 0.5 * (ring % 2) as f64) / AROUND as f64 * TAU;
            corners.push(DVec3::new(radius * turn.cos(), height, -radius * turn.sin()));
        }
    }
    let at = |ring: usize, k: usize| (1 + ring * AROUND + k % AROUND) as u32;
    let mut triangles: Vec<[u32; 3]> = (0..AROUND).map(|k| [0, at(0, k + 1), at(0, k)]).collect();
    for ring in 0..PROFILE.len() - 1 {
        for k in 0..AROUND {
            let [a, b] = [at(ring, k), at(ring, k + 1)];
            let [c, d] = [at(ring + 1, k), at(ring + 1, k + 1)];
            triangles.extend(if ring % 2 == 0 { [[a, b, c], [b, d, c]] } else { [[a, b, d], [a, d, c]] });
        }
    }
    let mut mesh = Mesh::from_triangles(corners, &triangles).expect("a vase is a mesh");
    for k in 0..AROUND {
        let [a, b] = [at(0, k), at(0, k + 1)].map(|k| VertexId::new(k as usize));
        mesh.set_sharp(Edge::new(a, b), true);
    }
    mesh
}
