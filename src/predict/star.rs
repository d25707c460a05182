//! The second differences at one vertex, and what a step makes of them.

use glam::DVec3;
use smallvec::SmallVec;

use crate::id::VertexId;
use crate::limit::{Fan, Rule as FanRule};
use crate::mesh::{Mesh, VertexClass};
use crate::scheme::{LoopWeights, crease_neighbors};

/// For so many levels darts are followed to their limit, whose way has no single rate: 0.625⁶⁴ is 1e-13.
const DART_LEVELS: usize = 64;

/// What a step makes of the motion of a vertex.
#[derive(Clone, Copy, Debug)]
enum Rule {
    /// Smooth or dart: half of it less n α of it, and α/8 of the sum of the differences.
    Even { own: f64, each: f64 },
    /// Crease and corner: a quarter; a corner has none.
    Quarter,
}

/// A vertex of a mesh by the numbers in which the bound is derived: see [`DistanceBound`](super::DistanceBound).
#[derive(Clone, Debug)]
pub(super) struct Star {
    /// D of the edge to each neighbour, in ring order.
    differences: SmallVec<[DVec3; 8]>,
    /// To which neighbours sharp edges lead; their differences are 0 and stay it.
    is_sharp: SmallVec<[bool; 8]>,
    is_open: bool,
    /// d, by which the next step moves the vertex.
    motion: DVec3,
    rule: Rule,
}

impl Star {
    /// The star of a vertex that is not semi-sharp. O(valence).
    pub(super) fn of(mesh: &Mesh, weights: LoopWeights, v: VertexId) -> Self {
        let (around, ring, center) = (mesh.neighborhood(), mesh.ring(v), mesh.position(v));
        let n = ring.valence();
        let spoke = |w: VertexId| mesh.position(w) - center;
        let mut is_sharp = SmallVec::from_elem(false, n);
        around.sharp_slots(v).for_each(|slot| is_sharp[slot] = true);
        let difference = |slot: usize| match is_sharp[slot] {
            true => DVec3::ZERO,
            false => {
                let [before, own, after] = [slot + n - 1, slot, slot + 1].map(|k| spoke(ring.neighbors()[k % n]));
                before + after - own
            }
        };
        let alpha = weights.alpha(n);
        let even = Rule::Even { own: 0.5 - n as f64 * alpha, each: alpha / 8.0 };
        let (motion, rule) = match around.class(v) {
            VertexClass::Smooth | VertexClass::Dart => (alpha * ring.iter().map(spoke).sum::<DVec3>(), even),
            VertexClass::Crease => {
                let [a, b] = crease_neighbors(around, v);
                (0.125 * (spoke(a) + spoke(b)), Rule::Quarter)
            }
            VertexClass::Corner => (DVec3::ZERO, Rule::Quarter),
        };
        Self { differences: (0..n).map(difference).collect(), is_sharp, is_open: ring.is_open(), motion, rule }
    }

    /// What a fan has of the star of its vertex. O(faces).
    pub(super) fn of_fan(fan: &Fan) -> Self {
        let (ring, faces, center) = (&fan.ring[..], fan.faces(), fan.center);
        let is_open = !fan.rule.is_whole();
        let places = if is_open { faces + 1 } else { faces };
        let is_sharp: SmallVec<[bool; 8]> = (0..places).map(|place| fan.is_sharp(place)).collect();
        let difference = |place: usize| match is_sharp[place] {
            true => DVec3::ZERO,
            false => {
                let before = ring[if place == 0 { faces - 1 } else { place - 1 }];
                (before - ring[place]) + (ring[place + 1] - center)
            }
        };
        let (motion, rule) = match fan.rule {
            FanRule::Smooth([_, alpha]) | FanRule::Dart([_, alpha]) => {
                let even = Rule::Even { own: 0.5 - faces as f64 * alpha, each: alpha / 8.0 };
                (alpha * ring[..faces].iter().map(|x| x - center).sum::<DVec3>(), even)
            }
            FanRule::Crease => (0.125 * ((ring[0] - center) + (ring[faces] - center)), Rule::Quarter),
            FanRule::Corner | FanRule::Cone => (DVec3::ZERO, Rule::Quarter),
        };
        Self { differences: (0..places).map(difference).collect(), is_sharp, is_open, motion, rule }
    }

    /// The star of the same vertex after a step. O(valence), in place.
    pub(super) fn refine(&mut self) {
        let Some((&first, &last)) = self.differences.first().zip(self.differences.last()) else { return };
        let sum: DVec3 = self.differences.iter().sum();
        let mut before = last;
        for slot in 0..self.differences.len() {
            let own = self.differences[slot];
            let after = self.differences.get(slot + 1).copied().unwrap_or(first);
            if !self.is_sharp[slot] {
                self.differences[slot] = 0.375 * own + 0.125 * (before + after) - self.motion;
            }
            before = own;
        }
        self.motion *= match self.rule {
            Rule::Even { own, .. } => own,
            Rule::Quarter => 0.25,
        };
        if let Rule::Even { each, .. } = self.rule {
            self.motion += each * sum;
        }
    }

    /// The length of the greatest difference.
    pub(super) fn greatest_difference(&self) -> f64 {
        greatest(self.differences.iter().copied())
    }

    /// The length of the greatest difference but one.
    pub(super) fn greatest_difference_but(&self, place: usize) -> f64 {
        let (before, after) = self.differences.split_at(place);
        greatest(before.iter().chain(&after[1..]).copied())
    }

    /// The difference of the edge to a neighbour.
    pub(super) fn difference(&self, place: usize) -> DVec3 {
        self.differences[place]
    }

    /// The way from the vertex to its limit.
    pub(super) fn way_to_limit(&self) -> DVec3 {
        match self.rule {
            Rule::Quarter => self.motion / 0.75,
            Rule::Even { own, .. } if !self.is_sharp.contains(&true) => self.motion / (0.875 - own),
            Rule::Even { .. } => {
                let mut star = self.clone();
                let mut motion = |_| {
                    let motion = star.motion;
                    star.refine();
                    motion
                };
                (0..DART_LEVELS).map(&mut motion).sum()
            }
        }
    }

    /// How far any point of a triangle at an irregular vertex may still go, if differences elsewhere are so great: by the
    /// rates at which all of it shrinks.
    pub(super) fn rest(&self, regular: f64) -> f64 {
        0.5 * regular + 3.0 * (self.greatest_difference() + 3.0 * self.motion())
    }

    /// How far the next step moves the vertex.
    pub(super) fn motion(&self) -> f64 {
        self.motion.length()
    }

    /// The greatest part that the star has in the difference of an edge opposite to the vertex after a step.
    pub(super) fn greatest_opposite(&self) -> f64 {
        let n = self.differences.len();
        let faces = if self.is_open { n.saturating_sub(1) } else { n };
        let opposite = |slot: usize| self.motion - 0.125 * (self.differences[slot] + self.differences[(slot + 1) % n]);
        greatest((0..faces).map(opposite))
    }
}

fn greatest(vectors: impl Iterator<Item = DVec3>) -> f64 {
    vectors.map(DVec3::length_squared).fold(0.0, f64::max).sqrt()
}
