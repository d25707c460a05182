//! Which two faces of the input make a block: a matching of the dual graph, whose nodes are the faces.
//!
//! Long edges are matched first, a boundary edge making a half block of its one face. Among the faces that are left,
//! each is then the root of a search for a path of which every second edge is matched, ending at a face that can spare
//! its partner: another one that is left, or one with a boundary edge, which can be a half block. Along the path the
//! matching is turned over. What remains after that cannot be matched at all (Edmonds 1965): nothing on a closed mesh,
//! whose dual graph is cubic and without bridges and so has a perfect matching (Petersen 1891).
//!
//! Source: `[velho-zorin2001]` for blocks, `[edmonds1965]` for the search.
//!
//! **Deliberately not here**: what is done with blocks, see [`super::bisect`], and with faces that remain.

use std::collections::VecDeque;

use crate::id::{Edge, VertexId};
use crate::rotation::{ReverseSlots, RotationSystem};
use crate::step::{Blocks, InputBlocks};

/// No face: a gap across an edge, or a face without a partner.
const NONE: u32 = u32::MAX;
/// In the place of a partner: the face is a half block.
const HALF: u32 = u32::MAX - 1;

/// Pairs the faces of a mesh. O(edges log edges), and for [`Blocks::Maximum`] a search for each face that is left: in
/// all O(faces × faces left) at worst, though nearly every search ends after a few faces.
///
/// `squared_length` is that of an edge; equal ones come in the order of [`RotationSystem::triangles`].
pub(crate) fn input_blocks(
    rotation: &RotationSystem,
    choice: Blocks,
    squared_length: impl Fn(VertexId, VertexId) -> f64,
) -> InputBlocks {
    let dual = Dual::new(rotation);
    let lengths: Vec<[f64; 3]> =
        dual.corners.iter().map(|&[a, b, c]| [(a, b), (b, c), (c, a)].map(|(v, w)| squared_length(v, w))).collect();
    let mut partners = longest_first(&dual, &lengths);
    if choice == Blocks::Maximum {
        let mut search = Search::new(&dual, &mut partners);
        for face in 0..dual.len() {
            search.cover(face);
        }
    }
    let edges = (0..dual.len()).filter_map(|face| match partners[face as usize] {
        NONE => None,
        HALF => dual.longest_boundary_edge(face, &lengths[face as usize]),
        partner if partner < face => None,
        partner => dual.edge_to(face, partner),
    });
    let edges: Vec<Edge> = edges.collect();
    InputBlocks::new(edges, partners.iter().filter(|&&partner| partner == NONE).count())
}

/// The faces, numbered in the order of [`RotationSystem::triangles`], with those across their edges.
struct Dual {
    corners: Vec<[VertexId; 3]>,
    /// Across the edge from each corner to the next one.
    across: Vec<[u32; 3]>,
}

impl Dual {
    fn new(rotation: &RotationSystem) -> Self {
        let reverse = ReverseSlots::new(rotation);
        let back = |v, slot| reverse.get(v, slot).expect("rings are symmetric");
        // The face left of every directed edge, first the numbers of these edges for every face.
        let mut left = vec![NONE; reverse.edge_count()];
        let mut corners = Vec::with_capacity(rotation.triangle_count());
        let mut opposite = Vec::with_capacity(rotation.triangle_count());
        for v in rotation.vertices() {
            let ring = rotation.ring(v);
            for slot in 0..ring.face_count() {
                let next = ring.slot_after(slot).expect("a face has two neighbours");
                let [a, b] = [slot, next].map(|slot| ring.neighbors()[slot]);
                if v > a || v > b {
                    continue;
                }
                let (v_in_a, v_in_b) = (back(v, slot), back(v, next));
                let b_in_a = rotation.ring(a).slot_before(v_in_a).expect("a face is left of a -> b");
                let a_in_b = rotation.ring(b).slot_after(v_in_b).expect("a face is left of b -> v");
                let inside = [reverse.number(v, slot), reverse.number(a, b_in_a), reverse.number(b, v_in_b)];
                for edge in inside {
                    left[edge] = corners.len() as u32;
                }
                opposite.push([reverse.number(a, v_in_a), reverse.number(b, a_in_b), reverse.number(v, next)]);
                corners.push([v, a, b]);
            }
        }
        let across = opposite.into_iter().map(|edges| edges.map(|edge| left[edge])).collect();
        Self { corners, across }
    }

    fn len(&self) -> u32 {
        self.corners.len() as u32
    }

    fn edge(&self, face: u32, side: usize) -> Edge {
        let corners = &self.corners[face as usize];
        Edge::new(corners[side], corners[(side + 1) % 3])
    }

    fn edge_to(&self, face: u32, other: u32) -> Option<Edge> {
        let side = self.across[face as usize].iter().position(|&across| across == other)?;
        Some(self.edge(face, side))
    }

    fn has_boundary_edge(&self, face: u32) -> bool {
        self.across[face as usize].contains(&NONE)
    }

    fn longest_boundary_edge(&self, face: u32, lengths: &[f64; 3]) -> Option<Edge> {
        let sides = (0..3).rev().filter(|&side| self.across[face as usize][side] == NONE);
        sides.max_by(|&one, &other| lengths[one].total_cmp(&lengths[other])).map(|side| self.edge(face, side))
    }
}

/// Goes over all edges from the longest to the shortest and takes what can be taken.
fn longest_first(dual: &Dual, lengths: &[[f64; 3]]) -> Vec<u32> {
    let once =
        |face: u32| (0..3).filter(move |&side| face < dual.across[face as usize][side]).map(move |side| (face, side));
    let mut edges: Vec<(u32, usize)> = (0..dual.len()).flat_map(once).collect();
    let length = |&(face, side): &(u32, usize)| lengths[face as usize][side];
    edges.sort_by(|one, other| length(other).total_cmp(&length(one)));
    let mut partners = vec![NONE; dual.corners.len()];
    for (face, side) in edges {
        let other = dual.across[face as usize][side];
        if partners[face as usize] != NONE {
            continue;
        }
        if other == NONE {
            partners[face as usize] = HALF;
        } else if partners[other as usize] == NONE {
            partners[face as usize] = other;
            partners[other as usize] = face;
        }
    }
    partners
}

/// What a search knows of a face.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Label {
    Unseen,
    /// At an even distance from the root, on some path.
    Outer,
    /// At odd distances alone, so far.
    Inner,
    /// Met by a search that found nothing: no later search can get through.
    Dead,
}

/// The search for a path that ends at a face which can spare its partner.
struct Search<'a> {
    dual: &'a Dual,
    partners: &'a mut [u32],
    labels: Vec<Label>,
    /// Of an inner face, and of an outer one that was inner before: the outer face from which it was reached.
    before: Vec<u32>,
    /// Towards the base of the blossom, an odd cycle, that a face lies in; itself if it is a base.
    toward_base: Vec<u32>,
    /// Stamps of walks to the root.
    walked: Vec<u32>,
    walks: u32,
    seen: Vec<u32>,
    queue: VecDeque<u32>,
}

impl<'a> Search<'a> {
    fn new(dual: &'a Dual, partners: &'a mut [u32]) -> Self {
        let count = dual.corners.len();
        Self {
            dual,
            partners,
            labels: vec![Label::Unseen; count],
            before: vec![NONE; count],
            toward_base: (0..dual.len()).collect(),
            walked: vec![0; count],
            walks: 0,
            seen: Vec::new(),
            queue: VecDeque::new(),
        }
    }

    fn has_partner(&self, face: u32) -> bool {
        self.partners[face as usize] < HALF
    }

    /// Gives a face that is left a partner by turning a path over, if there is one.
    fn cover(&mut self, root: u32) {
        if self.partners[root as usize] != NONE {
            return;
        }
        let found = self.find(root);
        let label = if found { Label::Unseen } else { Label::Dead };
        for face in self.seen.drain(..) {
            self.labels[face as usize] = label;
            self.before[face as usize] = NONE;
            self.toward_base[face as usize] = face;
        }
        self.queue.clear();
    }

    fn find(&mut self, root: u32) -> bool {
        self.label(root, Label::Outer);
        while let Some(face) = self.queue.pop_front() {
            if self.dual.has_boundary_edge(face) {
                let freed = std::mem::replace(&mut self.partners[face as usize], HALF);
                self.turn_over(freed);
                return true;
            }
            for other in self.dual.across[face as usize] {
                let label = self.labels[other as usize];
                match label {
                    Label::Unseen => {
                        self.before[other as usize] = face;
                        if !self.has_partner(other) {
                            self.turn_over(other);
                            return true;
                        }
                        self.label(other, Label::Inner);
                        self.label(self.partners[other as usize], Label::Outer);
                    }
                    Label::Outer if self.base(face) != self.base(other) => {
                        let base = self.common_base(face, other);
                        self.shrink(face, other, base);
                        self.shrink(other, face, base);
                    }
                    Label::Outer | Label::Inner | Label::Dead => {}
                }
            }
        }
        false
    }

    fn label(&mut self, face: u32, label: Label) {
        if self.labels[face as usize] == Label::Unseen {
            self.seen.push(face);
        }
        self.labels[face as usize] = label;
        if label == Label::Outer {
            self.queue.push_back(face);
        }
    }

    /// Matches the faces along the path from one that was reached, and is now free, back to the root.
    fn turn_over(&mut self, mut face: u32) {
        while face < HALF {
            let before = self.before[face as usize];
            let freed = std::mem::replace(&mut self.partners[before as usize], face);
            self.partners[face as usize] = before;
            face = freed;
        }
    }

    fn base(&mut self, face: u32) -> u32 {
        let mut base = face;
        while self.toward_base[base as usize] != base {
            let farther = self.toward_base[self.toward_base[base as usize] as usize];
            self.toward_base[base as usize] = farther;
            base = farther;
        }
        base
    }

    /// The first base that lies on the ways of both faces to the root.
    fn common_base(&mut self, face: u32, other: u32) -> u32 {
        self.walks += 1;
        let mut ways = [self.base(face), self.base(other)];
        loop {
            if ways[0] != NONE {
                let at = ways[0] as usize;
                if std::mem::replace(&mut self.walked[at], self.walks) == self.walks {
                    return ways[0];
                }
                // The root has no partner.
                let inner = self.partners[at];
                ways[0] = if inner < HALF { self.base(self.before[inner as usize]) } else { NONE };
            }
            ways.swap(0, 1);
        }
    }

    /// Draws the way from an outer face to the base of a blossom into it. All on it can be outer, reached across the
    /// edge from `face` to `other` from the other side.
    fn shrink(&mut self, mut face: u32, mut other: u32, base: u32) {
        while self.base(face) != base {
            self.before[face as usize] = other;
            let inner = self.partners[face as usize];
            if self.labels[inner as usize] == Label::Inner {
                self.label(inner, Label::Outer);
            }
            for of_cycle in [face, inner] {
                if self.toward_base[of_cycle as usize] == of_cycle {
                    self.toward_base[of_cycle as usize] = base;
                }
            }
            other = inner;
            face = self.before[inner as usize];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Mesh;
    use crate::shapes;

    fn blocks(mesh: &Mesh, choice: Blocks) -> InputBlocks {
        input_blocks(mesh.rotation(), choice, |v, w| mesh.position(v).distance_squared(mesh.position(w)))
    }

    /// Every face has one refinement edge at most, those in blocks of two the same, and the others are counted.
    fn assert_matching(mesh: &Mesh, blocks: &InputBlocks) {
        let mut without = 0;
        for triangle in mesh.triangles() {
            let [a, b, c] = triangle.corners();
            let found = [(a, b), (b, c), (c, a)].into_iter().filter(|&(v, w)| blocks.contains(Edge::new(v, w))).count();
            assert!(found <= 1, "{triangle:?}");
            without += 1 - found;
        }
        assert_eq!(without, blocks.unmatched());
    }

    #[test]
    fn every_face_of_a_closed_mesh_has_a_partner() {
        let sphere = shapes::icosahedron();
        let greedy = blocks(&sphere, Blocks::LongestEdge);
        for mesh in [shapes::tetrahedron(), shapes::octahedron(), sphere, shapes::torus(9, 7, 3.0, 1.0)] {
            assert_matching(&mesh, &blocks(&mesh, Blocks::LongestEdge));
            let all = blocks(&mesh, Blocks::Maximum);
            assert_matching(&mesh, &all);
            assert_eq!(all.unmatched(), 0);
        }
        // So there is something to do.
        assert!(greedy.unmatched() > 0);
    }

    #[test]
    fn long_edges_come_first_and_boundary_edges_make_half_blocks() {
        let mesh = shapes::grid(4, 3);
        let found = blocks(&mesh, Blocks::Maximum);
        assert_eq!(found, blocks(&mesh, Blocks::LongestEdge));
        assert_eq!(found.unmatched(), 0);
        let diagonals = mesh.edges().filter(|edge| {
            let [a, b] = edge.ends();
            mesh.position(a).distance(mesh.position(b)) > 1.2
        });
        assert!(diagonals.into_iter().all(|edge| found.contains(edge)));
        let alone =
            Mesh::from_triangles(vec![glam::DVec3::ZERO, glam::DVec3::X, glam::DVec3::Y], &[[0, 1, 2]]).unwrap();
        let found = blocks(&alone, Blocks::LongestEdge);
        assert!(found.contains(Edge::new(VertexId::new(1), VertexId::new(2))));
        assert_matching(&alone, &found);
    }

    #[test]
    fn a_face_without_a_partner_is_covered_at_the_far_end_of_a_path() {
        // With a face taken out the others are odd in number, so one of the three beside the hole is a half block.
        let mesh = shapes::torus(9, 7, 3.0, 1.0);
        let triangles: Vec<_> = mesh.triangles().skip(1).map(|face| face.corners().map(|v| v.index() as u32)).collect();
        let mesh = Mesh::from_triangles(mesh.positions().to_vec(), &triangles).unwrap();
        let all = blocks(&mesh, Blocks::Maximum);
        assert_matching(&mesh, &all);
        assert_eq!(all.unmatched(), 0);
    }
}
