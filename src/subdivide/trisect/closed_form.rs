//! Positions of √3 at the level at which they are needed.
//!
//! In an adaptive mesh the neighbours of a vertex are of many levels, and masks cannot be applied to them. But a [`Motion`]
//! tells where a vertex is at any level, and it is known from the first complete star on: of input vertices from the
//! beginning, of a new boundary vertex from its birth, as boundaries are curves of their own, and of a new inner vertex as
//! soon as the three edges of its triangle that are not on a boundary are turned.
//!
//! A motion runs between points, and those are made here, of points of other vertices.
//!
//! **Deliberately not here**: what has to be split so that a star is complete; see [`super::passes`].

use super::points::{Points, add};
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::rotation::RotationSystem;
use crate::scheme::{Mask, MaskSink, Sqrt3};
use crate::split::trisect::{Face, Levels};
use crate::step::{Motion, Motions};
use crate::subdivide::ValueId;

/// The valence of every inner vertex that is not an input vertex, once its star is whole and off the boundary.
const REGULAR: usize = 6;

/// Adds the vertices of a mesh that was not refined yet.
pub(super) fn push_input(scheme: &Sqrt3, mesh: &Mesh, points: &mut Points) {
    for v in mesh.vertices() {
        points.push_input(v, mesh.position(v));
    }
    for v in mesh.vertices() {
        match mesh.ring(v).neighbors() {
            &[after, .., before] if mesh.is_boundary(v) => {
                points.make(v, Motion::BEFORE, |motions, mask| add(mask, 1.0, before, motions.at(before, 0)));
                points.make(v, Motion::AFTER, |motions, mask| add(mask, 1.0, after, motions.at(after, 0)));
                points.motions.set(v, Motion::Boundary { since: 0 });
            }
            neighbors => {
                let n = neighbors.len();
                settle_inner(scheme, points, v, Motion::BIRTH, 0, n, |motions, scale, mask| {
                    neighbors.iter().for_each(|&w| add(mask, scale, w, motions.at(w, 0)));
                });
            }
        }
    }
}

/// Adds what is new in a face; the motion of an inner vertex is open.
pub(super) fn push(points: &mut Points, face: &Face) {
    let ([a, b, _], level) = (face.corners, face.level);
    if let Some([p, q]) = face.cutting() {
        for _ in [p, q] {
            points.motions.push(Motion::Boundary { since: level });
        }
        points.make(p, Motion::BIRTH, |motions, mask| add(mask, 1.0, a, motions.along(a, level)[1]));
        points.make(q, Motion::BIRTH, |motions, mask| add(mask, 1.0, b, motions.along(b, level)[0]));
        points.make(p, Motion::BEFORE, |motions, mask| add(mask, 1.0, a, motions.at(a, level)));
        points.make(p, Motion::AFTER, |motions, mask| add(mask, 1.0, q, motions.at(q, level)));
        points.make(q, Motion::BEFORE, |motions, mask| add(mask, 1.0, p, motions.at(p, level)));
        points.make(q, Motion::AFTER, |motions, mask| add(mask, 1.0, b, motions.at(b, level)));
    } else {
        points.motions.push(Motion::Open);
        for (x, _) in face.made() {
            points.make(x, Motion::BIRTH, |motions, mask| {
                face.corners.iter().for_each(|&v| add(mask, 1.0 / 3.0, v, motions.at(v, level - 1)));
            });
        }
    }
}

/// Settles the motion of an inner vertex, the star of which has just become complete.
///
/// Its ring has the corners of its triangle and, between two of them, the vertex across the edge, or nothing if the edge
/// lies on a boundary. If one does, the valence is not that of the levels to come, at which the two thirds of the edge are
/// neighbours: so one level is made with masks, and the motion starts there.
pub(super) fn settle(scheme: &Sqrt3, points: &mut Points, rotation: &RotationSystem, levels: &Levels<'_>, v: VertexId) {
    let (ring, level) = (rotation.ring(v), levels.of(v));
    if ring.valence() == REGULAR {
        settle_inner(scheme, points, v, Motion::BIRTH, level, REGULAR, |motions, scale, mask| {
            ring.iter().for_each(|w| add(mask, scale, w, motions.at(w, level)));
        });
        return;
    }
    let alpha = scheme.alpha(ring.valence());
    points.make(v, Motion::START, |motions, mask| {
        add(mask, 1.0 - alpha, v, motions.at(v, level));
        let scale = alpha / ring.valence() as f64;
        ring.iter().for_each(|w| add(mask, scale, w, motions.at(w, level)));
    });
    let is_parent = |w| levels.of(w) < level;
    settle_inner(scheme, points, v, Motion::START, level + 1, REGULAR, |motions, scale, mask| {
        for (a, b) in ring.pairs() {
            if is_parent(a) && is_parent(b) {
                add(mask, scale, a, motions.along(a, level + 1)[1]);
                add(mask, scale, b, motions.along(b, level + 1)[0]);
            } else {
                [v, a, b].into_iter().for_each(|w| add(mask, scale / 3.0, w, motions.at(w, level)));
            }
        }
    });
}

/// Settles the motion of an inner vertex from a level on, at which it is at a point and has `n` neighbours. Their sum is
/// written by `write`, times a number.
fn settle_inner(
    scheme: &Sqrt3,
    points: &mut Points,
    v: VertexId,
    start: u8,
    since: u8,
    n: usize,
    write: impl FnOnce(&Motions, f64, &mut Mask<ValueId>),
) {
    let alpha = scheme.alpha(n);
    let beta = 3.0 * alpha / (1.0 + 3.0 * alpha);
    points.make(v, Motion::LIMIT, |motions, mask| {
        mask.group(1.0 - beta, [ValueId::Kept(v, start)]);
        write(motions, beta / n as f64, mask);
    });
    points.motions.set(v, Motion::Inner { since, start, rate: 2.0 / 3.0 - alpha });
}
