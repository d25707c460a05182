//! The modified Butterfly scheme.

use std::f64::consts::{PI, TAU};

use super::butterfly::{eight_point, regular_eight_point, regular_ends};
use super::loop_::crease_neighbors;
use super::{MaskSink, Reach, Scheme};
use crate::id::VertexId;
use crate::mesh::{Neighborhood, Sector, VertexClass};
use crate::rotation::Ring;
use crate::step::Parent;

/// The modified Butterfly scheme, with boundaries, creases, darts and corners.
///
/// An end with less than two sharp edges (boundary edges count) is *interior*: it is seen with its whole ring and is regular
/// at valence 6. Any other end is a *crease* end: it is seen within the sector that contains the edge, from one sharp edge
/// to the next, and is regular if that has 3 faces. So a corner counts as a crease vertex in each of its sectors.
///
/// | edge | rule |
/// |---|---|
/// | sharp | −1/16, 9/16, 9/16, −1/16 along the curve |
/// | two regular interior ends | 8-point, as [`Butterfly`](super::Butterfly) |
/// | regular interior and regular crease end | interior-crease |
/// | two regular crease ends | crease-crease 1 or 2 |
/// | one extraordinary end | the rule of that end, interior or crease |
/// | two extraordinary ends | the mean of both rules |
///
/// A curve ends at a dart and at a corner, tagged or not; there it is continued by reflection (p₋₁ = 2p₀ − p₁). Vertices
/// that coincide on a small mesh get the sum of their weights.
///
/// Its masks name types of vertices, of which semi-sharp edges would make many more: masks are not blended, whatever is
/// sharp counts as infinitely sharp, and steps refuse a mesh with semi-sharp edges or vertices
/// ([`RefineError::SemiSharp`](crate::error::RefineError::SemiSharp)).
///
/// Source: `[zorin1996]`, boundary rules from `[zorin2000]`. The end of a curve is our decision. The extraordinary crease
/// rule has −c₀ at the far crease neighbour: with the sign that is sometimes seen in programs its weights do not add to 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct ModifiedButterfly;

impl Scheme for ModifiedButterfly {
    #[inline]
    fn moves_even(&self) -> bool {
        false
    }

    fn reads_tags(&self) -> bool {
        true
    }

    #[inline]
    fn reach(&self) -> Reach {
        Reach::BothStars
    }

    #[inline(always)]
    fn odd(&self, around: Neighborhood<'_>, parent: &Parent, mask: &mut impl MaskSink) {
        // Most of a refined mesh is like this, and the table then says the same.
        match regular_ends(around, parent) {
            Some(ends) if around.has_no_tags() => regular_eight_point(ends, parent, mask),
            _ => by_ends(around, parent, mask),
        }
    }
}

/// Writes the mask by the table.
#[inline(never)]
fn by_ends(around: Neighborhood<'_>, parent: &Parent, mask: &mut impl MaskSink) {
    let Parent { p, q, left, right } = *parent;
    if left.is_none() || right.is_none() || around.is_tagged(p, q) {
        return curve(around, [p, q], mask);
    }
    match [End::new(around, p, q), End::new(around, q, p)] {
        [at_p, at_q] if !at_p.is_regular() && !at_q.is_regular() => {
            at_p.extraordinary(0.5, mask);
            at_q.extraordinary(0.5, mask);
        }
        [end, _] | [_, end] if !end.is_regular() => end.extraordinary(1.0, mask),
        [End::Interior(_), End::Interior(_)] => eight_point(around, parent, mask),
        [End::Crease(crease), End::Interior(interior)] | [End::Interior(interior), End::Crease(crease)] => {
            interior_crease(crease, interior, mask);
        }
        [End::Crease(at_p), End::Crease(at_q)] => crease_crease(at_p, at_q, mask),
    }
}

/// One end of an edge that is not sharp, as it is seen from the edge.
#[derive(Clone, Copy)]
enum End<'a> {
    Interior(InteriorEnd<'a>),
    Crease(CreaseEnd<'a>),
}

/// An end with its whole ring, and the slot in it to which the edge leads.
#[derive(Clone, Copy)]
struct InteriorEnd<'a> {
    v: VertexId,
    ring: Ring<'a>,
    slot: usize,
}

/// An end with the sector that contains the edge, and the number in it of the neighbour to which the edge leads.
#[derive(Clone, Copy)]
struct CreaseEnd<'a> {
    v: VertexId,
    sector: Sector<'a>,
    number: usize,
}

impl<'a> End<'a> {
    /// The end `v` of the edge `v - other`, which is not sharp.
    fn new(around: Neighborhood<'a>, v: VertexId, other: VertexId) -> Self {
        let ring = around.ring(v);
        let slot = around.slot_of(v, other).expect("the ends of an edge are neighbours");
        if let VertexClass::Smooth | VertexClass::Dart = around.class(v) {
            return End::Interior(InteriorEnd { v, ring, slot });
        }
        let within = |sector: Sector<'a>| sector.inner_number(slot).map(|number| (sector, number));
        // A tagged corner with one sharp edge has one sector, its whole ring.
        let mut sectors = around.sectors(v).filter(|sector| sector.face_count() < ring.valence());
        match sectors.find_map(within) {
            Some((sector, number)) => End::Crease(CreaseEnd { v, sector, number }),
            None => End::Interior(InteriorEnd { v, ring, slot }),
        }
    }

    fn is_regular(self) -> bool {
        match self {
            End::Interior(end) => end.ring.valence() == 6,
            End::Crease(end) => end.sector.face_count() == 3,
        }
    }

    fn extraordinary(self, scale: f64, mask: &mut impl MaskSink) {
        match self {
            End::Interior(end) => end.extraordinary(scale, mask),
            End::Crease(end) => end.extraordinary(scale, mask),
        }
    }
}

impl InteriorEnd<'_> {
    /// The neighbour `steps` after the other end.
    fn neighbor(self, steps: usize) -> VertexId {
        self.ring.neighbors()[(self.slot + steps) % self.ring.valence()]
    }

    /// 3/4 for the vertex, s(j) for its neighbours counted from the other end.
    ///
    /// Neighbours at equal distances on both sides are summed first: the order does not depend on the side.
    fn extraordinary(self, scale: f64, mask: &mut impl MaskSink) {
        let n = self.ring.valence();
        mask.group(scale * 0.75, [self.v]);
        match n {
            3 => {
                mask.group(scale * 5.0 / 12.0, [self.neighbor(0)]);
                mask.group(-scale / 12.0, [self.neighbor(1), self.neighbor(2)]);
            }
            4 => {
                mask.group(scale * 0.375, [self.neighbor(0)]);
                mask.group(scale * -0.125, [self.neighbor(2)]);
            }
            _ => {
                // s(j) = (1/4 + cos x + cos 2x / 2) / n with x = 2πj/n, and cos 2x = 2 cos² x − 1.
                let weight = |j: usize| {
                    let cos = (TAU * j as f64 / n as f64).cos();
                    scale * (cos * (1.0 + cos) - 0.25) / n as f64
                };
                mask.group(weight(0), [self.neighbor(0)]);
                for j in 1..n.div_ceil(2) {
                    mask.group(weight(j), [self.neighbor(j), self.neighbor(n - j)]);
                }
                if n % 2 == 0 {
                    mask.group(weight(n / 2), [self.neighbor(n / 2)]);
                }
            }
        }
    }
}

impl CreaseEnd<'_> {
    /// The weights of a crease vertex with `k` faces in its sector, k ≠ 3; of two faces the midpoint.
    fn extraordinary(self, scale: f64, mask: &mut impl MaskSink) {
        let Self { v, sector, number: i } = self;
        let k = sector.face_count();
        if k == 2 {
            mask.group(scale * 0.5, [v, sector.neighbor(i)]);
            return;
        }
        let (faces, theta) = (k as f64, PI / k as f64);
        let sin = |times: usize| (theta * times as f64).sin();
        let cos = |times: usize| (theta * times as f64).cos();
        let center = 1.0 - sin(1) * sin(i) / (faces * (1.0 - cos(1)));
        let end = 0.25 * cos(i) - sin(2) * sin(2 * i) / (4.0 * faces * (cos(1) - cos(2)));
        mask.group(scale * center, [v]);
        mask.group(scale * end, [sector.neighbor(0)]);
        mask.group(-scale * end, [sector.neighbor(k)]);
        for j in 1..k {
            let weight = (sin(i) * sin(j) + 0.5 * sin(2 * i) * sin(2 * j)) / faces;
            mask.group(scale * weight, [sector.neighbor(j)]);
        }
    }

    /// The crease neighbour next to the edge, if the end is regular.
    fn near(self) -> VertexId {
        self.sector.neighbor(if self.number == 1 { 0 } else { 3 })
    }

    /// The crease neighbour on the other side of the sector, if the end is regular.
    fn far(self) -> VertexId {
        self.sector.neighbor(if self.number == 1 { 3 } else { 0 })
    }

    /// The neighbour inside the sector that is not the other end, if the end is regular.
    fn inner(self) -> VertexId {
        self.sector.neighbor(3 - self.number)
    }
}

/// The rule between a regular crease vertex and a regular interior one.
fn interior_crease(crease: CreaseEnd<'_>, interior: InteriorEnd<'_>, mask: &mut impl MaskSink) {
    // The rings run the same way, so of the two triangles on the edge one comes first here and last there.
    let (beyond_near, beyond_inner) = if crease.number == 1 { (2, 4) } else { (4, 2) };
    mask.group(0.625, [interior.v]);
    mask.group(0.375, [crease.v]);
    mask.group(0.1875, [crease.inner()]);
    mask.group(0.0625, [crease.near()]);
    mask.group(-0.0625, [crease.far(), interior.neighbor(beyond_near)]);
    mask.group(-0.125, [interior.neighbor(beyond_inner)]);
}

/// The rules between two regular crease vertices: number 1 if both creases bound the same triangle on the edge, else 2.
fn crease_crease(p: CreaseEnd<'_>, q: CreaseEnd<'_>, mask: &mut impl MaskSink) {
    mask.group(0.5, [p.v, q.v]);
    // Seen from p and from q, the same triangle lies on opposite sides.
    if p.number != q.number {
        mask.group(0.25, [p.inner()]);
        mask.group(-0.125, [p.far(), q.far()]);
    }
}

/// The 4-point rule along a curve of sharp edges, continued by reflection where it ends.
fn curve(around: Neighborhood<'_>, [p, q]: [VertexId; 2], mask: &mut impl MaskSink) {
    match [beyond(around, p, q), beyond(around, q, p)] {
        [None, None] => mask.group(0.5, [p, q]),
        [Some(before), Some(after)] => {
            mask.group(0.5625, [p, q]);
            mask.group(-0.0625, [before, after]);
        }
        // The reflected point 2p − q gives p −2/16 and q 1/16.
        [None, Some(after)] => open_curve([p, q, after], mask),
        [Some(before), None] => open_curve([q, p, before], mask),
    }
}

/// The 4-point rule between the last two points of a curve, `end` and `inner`.
fn open_curve([end, inner, beyond]: [VertexId; 3], mask: &mut impl MaskSink) {
    mask.group(0.4375, [end]);
    mask.group(0.625, [inner]);
    mask.group(-0.0625, [beyond]);
}

/// The next vertex after `v` on the curve that comes from `other`, or `None` if it ends at `v`.
fn beyond(around: Neighborhood<'_>, v: VertexId, other: VertexId) -> Option<VertexId> {
    if around.class(v) != VertexClass::Crease {
        return None;
    }
    let [a, b] = crease_neighbors(around, v);
    Some(if a == other { b } else { a })
}
