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

use super::points::{PointSum, Points};
use crate::id::VertexId;
use crate::mesh::Mesh;
use crate::rotation::RotationSystem;
use crate::scheme::Sqrt3;
use crate::split::trisect::{Face, Levels};
use crate::step::Motion;

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
                points.make(v, Motion::BEFORE, |sum| sum.add(1.0, before, 0));
                points.make(v, Motion::AFTER, |sum| sum.add(1.0, after, 0));
                points.motions.set(v, Motion::Boundary { since: 0 });
            }
            neighbors => {
                let n = neighbors.len();
                settle_inner(scheme, points, v, Motion::BIRTH, 0, n, |sum, part| {
                    neighbors.iter().for_each(|&w| sum.add(part, w, 0));
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
        points.make(p, Motion::BIRTH, |sum| sum.add_after(1.0, a, level));
        points.make(q, Motion::BIRTH, |sum| sum.add_before(1.0, b, level));
        points.make(p, Motion::BEFORE, |sum| sum.add(1.0, a, level));
        points.make(p, Motion::AFTER, |sum| sum.add(1.0, q, level));
        points.make(q, Motion::BEFORE, |sum| sum.add(1.0, p, level));
        points.make(q, Motion::AFTER, |sum| sum.add(1.0, b, level));
    } else {
        points.motions.push(Motion::Open);
        for (x, _) in face.made() {
            points.make(x, Motion::BIRTH, |sum| {
                face.corners.iter().for_each(|&v| sum.add(1.0 / 3.0, v, level - 1));
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
        settle_inner(scheme, points, v, Motion::BIRTH, level, REGULAR, |sum, part| {
            ring.iter().for_each(|w| sum.add(part, w, level));
        });
        return;
    }
    let alpha = scheme.alpha(ring.valence());
    points.make(v, Motion::START, |sum| {
        sum.add_point(1.0 - alpha, v, Motion::BIRTH);
        let part = alpha / ring.valence() as f64;
        ring.iter().for_each(|w| sum.add(part, w, level));
    });
    let is_parent = |w| levels.of(w) < level;
    settle_inner(scheme, points, v, Motion::START, level + 1, REGULAR, |sum, part| {
        for (a, b) in ring.pairs() {
            if is_parent(a) && is_parent(b) {
                sum.add_after(part, a, level + 1);
                sum.add_before(part, b, level + 1);
            } else {
                [v, a, b].into_iter().for_each(|w| sum.add(part / 3.0, w, level));
            }
        }
    });
}

/// Settles the motion of an inner vertex from a level on, at which it is at a point and has `n` neighbours; `add_all` adds
/// a part of each of them.
fn settle_inner(
    scheme: &Sqrt3,
    points: &mut Points,
    v: VertexId,
    start: u8,
    since: u8,
    n: usize,
    add_all: impl FnOnce(&mut PointSum<'_>, f64),
) {
    let alpha = scheme.alpha(n);
    let beta = 3.0 * alpha / (1.0 + 3.0 * alpha);
    points.make(v, Motion::LIMIT, |sum| {
        sum.add_point(1.0 - beta, v, start);
        add_all(sum, beta / n as f64);
    });
    points.motions.set(v, Motion::Inner { since, start, rate: 2.0 / 3.0 - alpha });
}
