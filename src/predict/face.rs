//! How far the limit surface may be from one face, whatever the levels of the faces around it.

use glam::DVec3;

use super::bound::LEVELS;
use super::star::Star;
use crate::limit::{Fan, Fans};

/// What may follow after the levels that were looked at is not followed any further when it is such a part of the bound.
const NEGLIGIBLE: f64 = 1.0 / 1024.0;

/// A face of some level as it is drawn: flat, or cut in up to three triangles where its edges are split for a finer neighbour.
///
/// # Derivation
///
/// The level of uniform refinement to which the face belongs, M, is known around it by its [`Fans`], and so is the next one,
/// M'. Let S be the surface and F what is drawn, all of the same parameters: those of a corner, of the middle of an edge, and
/// linear in between. Then
///
/// |S − F| ≤ |S − M'| + |M' − F|.
///
/// **M' − F.** Both are linear on triangles, and the difference is nowhere greater than at the corners of the triangles
/// that both cuts make together. M' has the corners of the face and the middles of its edges. F has them too, where an
/// edge is split; there the edge that closes the crack goes from the middle of edge i to the corner i opposite, and
/// between these two it crosses the line of M' between the other middles half way. With two split edges one such line is
/// drawn, or the other: both are looked at. So it is enough to look at six points and as many more as edges are split.
/// Nothing is assumed of where the corners of F are: they may stand at the level of the face, or behind, or ahead.
///
/// **S − M'** on each of the four parts is found as in [`DistanceBound`](super::DistanceBound), with the differences around
/// the part alone: let D be the differences of the edges at the three corners of a triangle, each in the sector between sharp
/// edges that the triangle is in, and d what the next step moves the corners by. What a step makes of these is a function of
/// them again, for each of the four parts. So the first step is no longer than the longest d and D/8, D of the sides; and
///
/// - if the corners are regular, differences fall to quarters, and all later steps together are at most g/8, g being the
///   greatest of them;
/// - if one is not, a point leaves its surroundings at some step or stays there for ever: the same sum over what it moves by
///   until then, and by the rest of a regular triangle, with s, t and m of this one vertex;
/// - if more are, which is so in the input only, none of the four parts has more than one.
///
/// The levels of the faces around are in none of it. So it holds for each face of any mesh whose faces are those of levels and
/// whose vertices lie at parameters of their own: the greatest of all is nowhere exceeded.
pub(crate) struct Face {
    /// Where the corners are.
    pub(crate) corners: [DVec3; 3],
    /// Where the vertex is that splits the edge opposite to each corner, if there is one.
    pub(crate) hanging: [Option<DVec3>; 3],
}

impl Face {
    /// At no point of the face the surface is farther away, but for rounding.
    pub(crate) fn bound(&self, fans: &Fans) -> f64 {
        let parts = fans.split();
        let of_level = [0, 1, 2].map(|c| parts[c].0[c].center);
        let middles = parts[3].0.each_ref().map(|fan| fan.center);
        let at_corner = |c: usize| of_level[c].distance(self.corners[c]);
        let at_middle = |c: usize| middles[c].distance(self.middle(c));
        let at_crossing = |c: usize| {
            let [next, third] = others(c);
            let crossing = |x| 0.5 * (middles[next] + middles[third]).distance(self.corners[c] + x);
            self.hanging[c].map_or(0.0, crossing)
        };
        let drawn = |part: usize| match part {
            0..3 => {
                let [next, third] = others(part);
                greatest([at_corner(part), at_middle(next), at_middle(third), at_crossing(part)])
            }
            _ => greatest([0, 1, 2].map(|c| at_middle(c).max(at_crossing(c)))),
        };
        greatest([0, 1, 2, 3].map(|part| drawn(part) + rest(&parts[part])))
    }

    /// How far its vertices are from their limits at most, those on the inside of its edges included. Elsewhere it says
    /// nothing.
    pub(crate) fn at_vertices(&self, fans: &Fans) -> f64 {
        let distance = |fan: &Fan, x: DVec3| x.distance(fan.center + Star::of_fan(fan).way_to_limit());
        let at_corners = greatest([0, 1, 2].map(|c| distance(&fans.0[c], self.corners[c])));
        if self.hanging == [None; 3] {
            return at_corners;
        }
        let Fans(between) = fans.part(3);
        let at_hanging = [0, 1, 2].map(|c| self.hanging[c].map_or(0.0, |x| distance(&between[c], x)));
        greatest(at_hanging).max(at_corners)
    }

    /// The middle of the edge opposite to a corner.
    fn middle(&self, corner: usize) -> DVec3 {
        let [next, third] = others(corner);
        self.hanging[corner].unwrap_or_else(|| 0.5 * (self.corners[next] + self.corners[third]))
    }
}

fn others(corner: usize) -> [usize; 2] {
    [(corner + 1) % 3, (corner + 2) % 3]
}

fn greatest<const N: usize>(distances: [f64; N]) -> f64 {
    distances.into_iter().fold(0.0, f64::max)
}

/// How far the surface may be from a triangle of a uniform mesh.
fn rest(fans: &Fans) -> f64 {
    let stars = fans.0.each_ref().map(Star::of_fan);
    let sides = [0, 1, 2].map(|c| stars[c].difference(fans.0[c].next()).length() / 8.0);
    let first_step = greatest(stars.each_ref().map(Star::motion)).max(greatest(sides));
    let mut irregular = (0..3).filter(|&c| fans.0[c].hexagon().is_none());
    match (irregular.next(), irregular.next()) {
        (None, _) => first_step + greatest(stars.each_ref().map(Star::greatest_difference)) / 8.0,
        (Some(corner), None) => {
            let [next, third] = others(corner);
            // Those that lead to the irregular corner are counted there.
            let regular = [(next, fans.0[next].third()), (third, fans.0[third].next())];
            let regular = greatest(regular.map(|(c, place)| stars[c].greatest_difference_but(place)));
            follow(stars[corner].clone(), first_step, regular)
        }
        _ => first_step + greatest(fans.split().each_ref().map(rest)),
    }
}

/// How far the surface may be from a triangle with one irregular corner, by the star of that: where its points go.
fn follow(mut star: Star, first_step: f64, mut regular: f64) -> f64 {
    let (mut bound, mut step, mut moved, mut share) = (0.0_f64, first_step, 0.0, 0.0);
    for _ in 0..LEVELS {
        let (difference, opposite, motion) = (star.greatest_difference(), star.greatest_opposite(), star.motion());
        let all = regular.max(difference);
        star.refine();
        let regular_after = (0.25 * all).max(opposite + 0.125 * regular);
        let left = 0.25 * (regular_after + regular_after.max(star.greatest_difference()));
        bound = bound.max(moved + share + step + left);
        // For who stays.
        moved += motion;
        share = 0.5 * share + 0.125 * difference;
        regular = regular_after;
        step = star.motion().max(0.25 * regular + 0.125 * regular.max(star.greatest_difference()));
        if star.rest(regular) <= NEGLIGIBLE * bound {
            break;
        }
    }
    bound.max(moved + share + star.rest(regular))
}
