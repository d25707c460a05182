//! The surroundings of one triangle, as far as the surface on it depends on them, and their refinement.
//!
//! For each corner of the triangle a [`Fan`] has the neighbours in the sector that the triangle is in. Loop's rules read
//! nothing else, so a refined triangle is again three fans, and no mesh has to be made.

use glam::DVec3;
use smallvec::SmallVec;

use super::bezier::Bezier;
use crate::id::VertexId;
use crate::mesh::{Mesh, Neighborhood, VertexClass};
use crate::scheme::LoopWeights;

/// What becomes of the vertex in the middle of a fan, and whether the ends of the fan are sharp edges.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Rule {
    /// A whole ring; 3/8 + λ for the vertex, and α for each neighbour.
    Smooth([f64; 2]),
    /// The same with one sharp edge, at which the fan begins and ends.
    Dart([f64; 2]),
    /// 3/4 for the vertex, 1/8 for both ends.
    Crease,
    /// A sector of a vertex that stays.
    Corner,
    /// The whole ring, without a sharp edge, of a vertex that stays.
    Cone,
}

impl Rule {
    /// The rule of a smooth vertex.
    pub(super) fn smooth(weights: LoopWeights, n: usize) -> Self {
        Self::Smooth([0.375 + weights.lambda(n), weights.alpha(n)])
    }

    pub(crate) fn is_whole(self) -> bool {
        matches!(self, Self::Smooth(_) | Self::Cone)
    }
}

/// A corner of a triangle with its neighbours in order.
#[derive(Clone, Debug)]
pub(crate) struct Fan {
    pub(crate) center: DVec3,
    /// One more than faces: a whole ring ends with its first neighbour again.
    pub(crate) ring: SmallVec<[DVec3; 7]>,
    /// The place of the next corner of the triangle; the third one follows. 0 in a whole ring.
    at: usize,
    pub(crate) rule: Rule,
}

impl Fan {
    /// A fan from the neighbours in order, the next corner of the triangle first.
    pub(super) fn whole(center: DVec3, neighbors: impl IntoIterator<Item = DVec3>, rule: Rule) -> Self {
        let mut ring: SmallVec<[DVec3; 7]> = neighbors.into_iter().collect();
        ring.push(ring[0]);
        Self { center, ring, at: 0, rule }
    }

    /// The corner `v` of a triangle, not semi-sharp, whose next corner is `next`; with the places of it and its neighbours.
    pub(crate) fn of(
        around: Neighborhood<'_>,
        position: impl Fn(VertexId) -> DVec3,
        weights: LoopWeights,
        [v, next]: [VertexId; 2],
    ) -> Self {
        let (ring, center) = (around.ring(v), position(v));
        let even = |n: usize| [0.375 + weights.lambda(n), weights.alpha(n)];
        let class = around.class(v);
        let with_place = |sector: crate::mesh::Sector<'_>| {
            let at = sector.neighbors().take(sector.face_count()).position(|w| w == next)?;
            Some((sector.neighbors().map(&position).collect(), at))
        };
        if let Some((positions, at)) = around.sectors(v).find_map(with_place) {
            let rule = match class {
                VertexClass::Crease => Rule::Crease,
                VertexClass::Dart => Rule::Dart(even(ring.valence())),
                VertexClass::Corner | VertexClass::Smooth => Rule::Corner,
            };
            return Self { center, ring: positions, at, rule };
        }
        let slot = ring.slot_of(next).expect("the corners of a triangle are neighbours");
        let (before, after) = ring.neighbors().split_at(slot);
        let rule = if class == VertexClass::Corner { Rule::Cone } else { Rule::Smooth(even(ring.valence())) };
        Self::whole(center, after.iter().chain(before).map(|&w| position(w)), rule)
    }

    /// The neighbours of a smooth vertex, from the next corner of the triangle on; `None` for any other.
    pub(super) fn smooth_ring(&self) -> Option<&[DVec3]> {
        matches!(self.rule, Rule::Smooth(_)).then(|| &self.ring[..self.faces()])
    }

    /// Six neighbours, from the next corner of the triangle on, with which the surface is a polynomial here; `None` if the
    /// fan is not regular.
    ///
    /// Across a regular crease the sector is continued by reflection: with it the rules of inner vertices give the same
    /// points as those of the crease.
    pub(crate) fn hexagon(&self) -> Option<[DVec3; 6]> {
        let mut six: [DVec3; 6] = match (self.rule, &self.ring[..]) {
            (Rule::Smooth(_), &[a, b, c, d, e, f, _]) => [a, b, c, d, e, f],
            (Rule::Crease, &[a, b, c, d]) => [a, b, c, d, self.center + d - c, self.center + a - b],
            _ => return None,
        };
        six.rotate_left(self.at);
        Some(six)
    }

    pub(crate) fn faces(&self) -> usize {
        self.ring.len() - 1
    }

    /// Whether the edge to the neighbour at a place is sharp.
    pub(crate) fn is_sharp(&self, place: usize) -> bool {
        !self.rule.is_whole() && (place == 0 || place == self.faces())
    }

    /// The place of the next corner of the triangle.
    pub(crate) fn next(&self) -> usize {
        self.at
    }

    /// The place of the third corner of the triangle.
    pub(crate) fn third(&self) -> usize {
        self.at + 1
    }

    /// The neighbour before the next corner of the triangle.
    fn before(&self) -> DVec3 {
        self.ring[if self.at == 0 { self.faces() - 1 } else { self.at - 1 }]
    }

    /// The neighbour after the third corner of the triangle.
    fn after(&self) -> DVec3 {
        self.ring[if self.at + 1 == self.faces() { 1 } else { self.at + 2 }]
    }

    /// The fan of the same vertex after a step.
    fn refined(&self) -> Self {
        let (center, faces) = (self.center, self.faces());
        let ring = (0..=faces).map(|i| match self.is_sharp(i) {
            true => 0.5 * (center + self.ring[i]),
            false => {
                let before = self.ring[if i == 0 { faces - 1 } else { i - 1 }];
                let after = self.ring[if i == faces { 1 } else { i + 1 }];
                0.375 * (center + self.ring[i]) + 0.125 * (before + after)
            }
        });
        let center = match self.rule {
            Rule::Smooth([own, each]) | Rule::Dart([own, each]) => {
                own * center + each * self.ring[..faces].iter().sum::<DVec3>()
            }
            Rule::Crease => 0.75 * center + 0.125 * (self.ring[0] + self.ring[faces]),
            Rule::Corner | Rule::Cone => center,
        };
        Self { center, ring: ring.collect(), ..*self }
    }
}

/// A triangle as the fans of its corners.
#[derive(Clone, Debug)]
pub(crate) struct Fans(pub(crate) [Fan; 3]);

impl Fans {
    /// The fans of a triangle of a mesh.
    pub(super) fn of(mesh: &Mesh, weights: LoopWeights, corners: [VertexId; 3]) -> Self {
        let position = |v| mesh.position(v);
        Self([0, 1, 2].map(|c| Fan::of(mesh.neighborhood(), position, weights, [corners[c], corners[(c + 1) % 3]])))
    }

    /// The same, moved.
    pub(crate) fn moved(mut self, by: DVec3) -> Self {
        for fan in &mut self.0 {
            fan.center += by;
            fan.ring.iter_mut().for_each(|x| *x += by);
        }
        self
    }

    /// The polynomial, if all corners are regular.
    pub(super) fn bezier(&self) -> Option<Bezier> {
        let [a, b, c] = &self.0;
        let corner = |fan: &Fan| fan.hexagon().map(|hexagon| (fan.center, hexagon));
        Some(Bezier::regular([corner(a)?, corner(b)?, corner(c)?]))
    }

    /// The four triangles after a step: see [`Fans::part`].
    pub(crate) fn split(&self) -> [Self; 4] {
        [0, 1, 2, 3].map(|part| self.part(part))
    }

    /// One of the triangles after a step: number 0, 1 or 2 at that corner, 3 between them. It has its corners in the order of
    /// the corners that they are nearest to or, for the one between, opposite to.
    pub(crate) fn part(&self, part: usize) -> Self {
        let fans = self.0.each_ref().map(Fan::refined);
        let between = |c: usize, seen| Self::between([&fans[c], &fans[(c + 1) % 3]], seen);
        match part {
            0 => Self([fans[0].clone(), between(0, Seen::First), between(2, Seen::Second)]),
            1 => Self([between(0, Seen::Second), fans[1].clone(), between(1, Seen::First)]),
            2 => Self([between(2, Seen::First), between(1, Seen::Second), fans[2].clone()]),
            _ => Self([between(1, Seen::Middle), between(2, Seen::Middle), between(0, Seen::Middle)]),
        }
    }

    /// The fan of the new vertex on the edge from a refined corner to the next, as one of its three triangles sees it. It is
    /// regular, inside or on a crease.
    fn between([x, y]: [&Fan; 2], seen: Seen) -> Fan {
        let center = x.ring[x.at];
        // Counter-clockwise, this side of the edge first.
        let near = [y.center, y.ring[y.at], x.ring[x.at + 1], x.center];
        let at = match seen {
            Seen::Second => 0,
            Seen::Middle => 1,
            Seen::First => 2,
        };
        if x.is_sharp(x.at) {
            return Fan { center, ring: SmallVec::from_slice(&near), at, rule: Rule::Crease };
        }
        let mut six = [near[0], near[1], near[2], near[3], x.before(), y.after()];
        six.rotate_left(at);
        Fan::whole(center, six, Rule::Smooth([0.625, 0.0625]))
    }
}

/// From which triangle a new vertex is seen: the one at the first end of its edge, the one at the second, the one between.
#[derive(Clone, Copy)]
enum Seen {
    First,
    Second,
    Middle,
}
