//! The Butterfly scheme.

use super::{MaskSink, Reach, Scheme};
use crate::id::VertexId;
use crate::mesh::Neighborhood;
use crate::rotation::{Regular, Ring};
use crate::step::Parent;

/// The original Butterfly scheme: the 8-point mask on every edge, whatever the valences of its ends.
///
/// The ends have 1/2 each, the two opposite corners 1/8, the four *wings* (the corners beyond the other edges of the two
/// triangles) −1/16. Vertices that coincide on a small mesh get the sum of their weights.
///
/// Near a boundary the mesh is thought continued by parallelograms: a missing wing is the sum of the ends of its edge minus
/// the corner opposite. Of a boundary edge the whole missing side is made so; its share is then zero. Tags of sharp edges
/// and corners have no meaning for this scheme and are not read.
///
/// The limit is smooth but at vertices of valence 3 and of 8 and more; [`ModifiedButterfly`](super::ModifiedButterfly)
/// mends that.
///
/// Source: `[dyn1990]`, with tension w = 1/16.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Butterfly;

impl Scheme for Butterfly {
    #[inline]
    fn moves_even(&self) -> bool {
        false
    }

    fn reads_tags(&self) -> bool {
        false
    }

    #[inline]
    fn reach(&self) -> Reach {
        Reach::BothStars
    }

    #[inline(always)]
    fn odd(&self, around: Neighborhood<'_>, parent: &Parent, mask: &mut impl MaskSink) {
        eight_point(around, parent, mask);
    }
}

/// One wing as the vertices that have −1/16 for it, and the one that has 1/16 if it is made by a parallelogram.
struct Wing {
    minus: [Option<VertexId>; 2],
    plus: Option<VertexId>,
}

impl Wing {
    /// The wing beyond the edge `a - b` of a triangle whose third corner is `opposite`.
    fn new(found: Option<VertexId>, [a, b]: [VertexId; 2], opposite: VertexId) -> Self {
        match found {
            Some(wing) => Wing { minus: [Some(wing), None], plus: None },
            None => Wing { minus: [Some(a), Some(b)], plus: Some(opposite) },
        }
    }

    const NONE: Wing = Wing { minus: [None; 2], plus: None };
}

/// Writes the 8-point mask.
///
/// Opposite corners and wings come counter-clockwise from `p`'s left, so the order of summing does not depend on ids.
#[inline(always)]
pub(super) fn eight_point(around: Neighborhood<'_>, parent: &Parent, mask: &mut impl MaskSink) {
    match regular_ends(around, parent) {
        Some(ends) => regular_eight_point(ends, parent, mask),
        None => irregular_eight_point(around, parent, mask),
    }
}

/// The rings of both ends if both are regular and off the boundary.
#[inline]
pub(super) fn regular_ends<'a>(around: Neighborhood<'a>, parent: &Parent) -> Option<[Regular<'a>; 2]> {
    around.regular_ring(parent.p).zip(around.regular_ring(parent.q)).map(<[_; 2]>::from)
}

/// The 8-point mask between two regular vertices, in the order of [`eight_point`].
#[inline(always)]
pub(super) fn regular_eight_point([at_p, at_q]: [Regular<'_>; 2], parent: &Parent, mask: &mut impl MaskSink) {
    let Parent { p, q, left, right } = *parent;
    let ([right_wing_p, left_wing_p], [left_wing_q, right_wing_q]) = (at_p.two_off(q), at_q.two_off(p));
    mask.group(0.5, [p, q]);
    mask.group(0.125, [left, right].map(|corner| corner.expect("a regular vertex has no gap")));
    mask.group(-0.0625, [left_wing_p, left_wing_q, right_wing_q, right_wing_p]);
}

#[inline(never)]
fn irregular_eight_point(around: Neighborhood<'_>, parent: &Parent, mask: &mut impl MaskSink) {
    let Parent { p, q, left, right } = *parent;
    let (at_p, at_q) = (around.ring(p), around.ring(q));
    let [slot_p, slot_q] =
        [(p, q), (q, p)].map(|(v, w)| around.slot_of(v, w).expect("the ends of an edge are neighbours"));
    let two_after = |ring: Ring<'_>, slot| ring.behind(ring.slot_after(slot)?);
    let two_before = |ring: Ring<'_>, slot| ring.ahead(ring.slot_before(slot)?);
    let on_left =
        left.map(|c| [Wing::new(two_after(at_p, slot_p), [p, c], q), Wing::new(two_before(at_q, slot_q), [c, q], p)]);
    let on_right =
        right.map(|d| [Wing::new(two_after(at_q, slot_q), [q, d], p), Wing::new(two_before(at_p, slot_p), [d, p], q)]);
    let sides = [on_left, on_right].map(|side| side.unwrap_or([Wing::NONE; 2]));
    let wings = || sides.iter().flatten();

    mask.group(0.5, [p, q]);
    mask.group(0.125, [left, right].into_iter().flatten());
    mask.group(-0.0625, wings().flat_map(|wing| wing.minus).flatten());
    if wings().any(|wing| wing.plus.is_some()) {
        mask.group(0.0625, wings().filter_map(|wing| wing.plus));
    }
}
