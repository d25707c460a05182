//! First derivatives at a vertex whose surroundings are not regular.

use std::collections::BTreeMap;
use std::f64::consts::{FRAC_PI_3, PI, TAU};

use glam::{DMat2, DVec2, DVec3};

use crate::id::VertexId;
use crate::limit::{Limit, LoopLimit};
use crate::mesh::{Mesh, VertexClass};
use crate::scheme::Mask;

/// Responses of tangent masks to a flat fan whose determinant is below this are parallel.
const PARALLEL: f64 = 1e-9;

/// Two tangents at a vertex, towards two neighbours that follow one another; `None` if there is no tangent plane.
///
/// They are those that a flat fan of equal angles has, mapped linearly: the tangent masks make of the fan what the map
/// makes tangents of the mesh. A fan around a smooth vertex or a dart has a full turn, one on a crease half of it, one at
/// a corner 60° for its first two faces, as has a single face on a crease. With regular surroundings these are the
/// derivatives along the two edges.
pub(super) fn tangents(limit: LoopLimit, mesh: &Mesh, v: VertexId, [next, third]: [VertexId; 2]) -> Option<[DVec3; 2]> {
    let around = mesh.neighborhood();
    let ring = around.ring(v);
    let side = limit.side_at(around, v, ring.slot_of(next)?)?;
    let (faces, turn, neighbors): (usize, f64, Vec<VertexId>) = match around.class(v) {
        VertexClass::Smooth | VertexClass::Dart => (ring.valence(), TAU, ring.iter().collect()),
        class => {
            let sector = around.sectors(v).nth(side)?;
            let faces = sector.face_count();
            let turn = match (class, faces) {
                (VertexClass::Crease, 2..) => PI,
                _ => faces.min(2) as f64 * FRAC_PI_3,
            };
            (faces, turn, sector.neighbors().collect())
        }
    };
    let spoke = |(j, w)| (w, DVec2::from_angle(turn * j as f64 / faces as f64));
    let spokes: BTreeMap<VertexId, DVec2> = neighbors.into_iter().enumerate().map(spoke).collect();
    // The vertex itself is at 0.
    let flat = |w: VertexId| spokes.get(&w).copied().unwrap_or(DVec2::ZERO);
    let mut masks = [Mask::default(), Mask::default()];
    let [first, second] = &mut masks;
    limit.tangent_masks(around, v, side, first, second);
    let response = |mask: &Mask| -> DVec2 {
        mask.groups().iter().map(|(weight, vertices)| *weight * vertices.iter().map(|&w| flat(w)).sum::<DVec2>()).sum()
    };
    let responses = DMat2::from_cols(response(&masks[0]), response(&masks[1]));
    if responses.determinant().abs() < PARALLEL {
        return None;
    }
    let [first, second] = limit.tangents(mesh, v, side)?;
    let inverse = responses.inverse();
    Some([next, third].map(|w| {
        let parts = inverse * flat(w);
        parts.x * first + parts.y * second
    }))
}
