//! Positions of √3 at the level at which they are needed.
//!
//! In an adaptive mesh the neighbours of a vertex are of many levels, and masks cannot be applied to them. But a [`Motion`]
//! tells where a vertex is at any level, and it is known from the first complete star on: of input vertices from the
//! beginning, of a new boundary vertex from its birth, as boundaries are curves of their own, and of a new inner vertex as
//! soon as the three edges of its triangle that are not on a boundary are turned.
//!
//! **Deliberately not here**: what has to be split so that a star is complete; see [`super::passes`].

use glam::DVec3;

use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::rotation::RotationSystem;
use crate::scheme::Sqrt3;
use crate::split::trisect::{Face, Levels};
use crate::step::{Motion, Motions};

/// The valence of every inner vertex that is not an input vertex, once its star is whole and off the boundary.
const REGULAR: usize = 6;

/// The motions of the vertices of a mesh that was not refined yet.
pub(super) fn of_input(scheme: &Sqrt3, mesh: &Mesh) -> Motions {
    let mut motions = Motions::default();
    for v in mesh.vertices() {
        let (ring, position) = (mesh.ring(v), mesh.position(v));
        let motion = match ring.neighbors() {
            [after, .., before] if ring.is_open() => {
                Motion::boundary(0, [mesh.position(*before), position, mesh.position(*after)])
            }
            neighbors => {
                let mean = mean(neighbors.iter().map(|&w| mesh.position(w))).unwrap_or(position);
                inner(scheme, 0, position, neighbors.len(), mean)
            }
        };
        motions.push(position, motion);
    }
    motions
}

/// Adds the motions of what is new in a face; that of an inner vertex is open.
pub(super) fn push(motions: &mut Motions, face: &Face) {
    let [a, b, _] = face.corners;
    if face.cutting().is_some() {
        let [before, after] = [motions.at(a, face.level), motions.at(b, face.level)];
        let [p, q] = [motions.along(a, face.level)[1], motions.along(b, face.level)[0]];
        motions.push(p, Motion::boundary(face.level, [before, p, q]));
        motions.push(q, Motion::boundary(face.level, [p, q, after]));
    } else {
        let corners = face.corners.map(|v| motions.at(v, face.level - 1));
        motions.push((corners[0] + corners[1] + corners[2]) / 3.0, Motion::Open);
    }
}

/// Settles the motion of an inner vertex, the star of which has just become complete.
///
/// Its ring has the corners of its triangle and, between two of them, the vertex across the edge, or nothing if the edge
/// lies on a boundary. If one does, the valence is not that of the levels to come, at which the two thirds of the edge are
/// neighbours: so one level is made with masks, and the motion starts there.
pub(super) fn settle(
    scheme: &Sqrt3,
    motions: &mut Motions,
    rotation: &RotationSystem,
    levels: &Levels<'_>,
    v: VertexId,
) {
    let (ring, level, birth) = (rotation.ring(v), levels.of(v), motions.birth(v));
    let at = |w| motions.at(w, level);
    let around = mean(ring.iter().map(at)).unwrap_or(birth);
    let motion = if ring.valence() == REGULAR {
        inner(scheme, level, birth, REGULAR, around)
    } else {
        let alpha = scheme.alpha(ring.valence());
        let position = (1.0 - alpha) * birth + alpha * around;
        let is_parent = |w| levels.of(w) < level;
        let next = ring.pairs().map(|(a, b)| {
            if is_parent(a) && is_parent(b) {
                motions.along(a, level + 1)[1] + motions.along(b, level + 1)[0]
            } else {
                (birth + at(a) + at(b)) / 3.0
            }
        });
        inner(scheme, level + 1, position, REGULAR, next.sum::<DVec3>() / REGULAR as f64)
    };
    motions.set(v, motion);
}

/// The motion of an inner vertex from a level on, by the mean of its `n` neighbours there.
fn inner(scheme: &Sqrt3, since: u8, position: DVec3, n: usize, mean: DVec3) -> Motion {
    let alpha = scheme.alpha(n);
    let beta = 3.0 * alpha / (1.0 + 3.0 * alpha);
    Motion::inner(since, position, (1.0 - beta) * position + beta * mean, 2.0 / 3.0 - alpha)
}

fn mean(positions: impl ExactSizeIterator<Item = DVec3>) -> Option<DVec3> {
    let count = positions.len() as f64;
    positions.reduce(|sum, position| sum + position).map(|sum| sum / count)
}
