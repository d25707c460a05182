//! Topology of a [`Hierarchy`](crate::step::Hierarchy): its levels, what a new split needs, and the mesh that is shown.
//!
//! The hierarchy says which edges are split; the mesh shows the *leaves*, the triangles that are not split in four. A leaf
//! with one split edge is bisected, one with two is cut in three; one with three counts as split. These edges that close
//! cracks are no part of the hierarchy: they are drawn and wiped away as it changes, and no later step reads them.
//!
//! Read in this order: `levels` (rings and triangles of every level, read from the map and the rings as they are), `grow` (to
//! split a triangle or to require a star, with all that it needs), `shrink` (to require a star no longer), `red` (to split without requirements), `show` (to write
//! the rings of what changed). All costs what changes: nothing goes through the mesh or the hierarchy.
//!
//! **Deliberately not here**: positions, tags, and who asks for what; see [`crate::subdivide`].

mod grow;
mod levels;
mod red;
mod show;
mod shrink;

pub(crate) use grow::{Grower, Growth};
pub(crate) use levels::{Across, Levels};
pub(crate) use red::{Red, leaf_of};
pub(crate) use show::{Shown, leaves_around, show};
pub(crate) use shrink::Shrinker;

#[cfg(test)]
mod tests {
    //! The rings that are shown, against a model that knows triangles only.

    use std::collections::{BTreeMap, BTreeSet};

    use super::*;
    use crate::id::{Triangle, VertexId};
    use crate::rotation::RotationSystem;
    use crate::scratch::Scratch;
    use crate::step::Hierarchy;
    use crate::{Mesh, shapes};

    /// Numbers that look random; the same at every run.
    struct Random(u64);

    impl Random {
        fn below(&mut self, bound: usize) -> usize {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 33) as usize % bound
        }
    }

    /// A hierarchy with its mesh, and who asks for what.
    struct Tried {
        input: Vec<[VertexId; 3]>,
        rotation: RotationSystem,
        hierarchy: Hierarchy,
        asked: BTreeSet<(VertexId, u8)>,
        shown: BTreeMap<VertexId, Shown>,
    }

    impl Tried {
        fn new(mesh: &Mesh) -> Self {
            Self {
                input: mesh.triangles().map(Triangle::corners).collect(),
                rotation: mesh.rotation().clone(),
                hierarchy: Hierarchy::new(mesh.vertex_count()),
                asked: BTreeSet::new(),
                shown: BTreeMap::new(),
            }
        }

        fn grow(&mut self, add: impl FnOnce(&mut Grower<'_>)) {
            let mut growth = Growth::default();
            let Self { rotation, hierarchy, .. } = self;
            add(&mut Grower { rotation, hierarchy, growth: &mut growth, max_faces: None });
            let faces = rotation.triangle_count();
            self.show(&growth.made);
            assert_eq!(self.rotation.triangle_count(), faces + growth.added_faces);
        }

        fn ask(&mut self, v: VertexId, level: u8) {
            self.asked.insert((v, level));
            self.grow(|grower| grower.require_star(v, level).unwrap());
        }

        fn give_up(&mut self, v: VertexId, level: u8) {
            self.asked.remove(&(v, level));
            let asked = |v: VertexId, level: u8| self.asked.range((v, level)..=(v, u8::MAX)).next().is_some();
            let (rotation, hierarchy) = (&self.rotation, &mut self.hierarchy);
            let mut shrinker = Shrinker { rotation, hierarchy, asked, removed: Vec::new(), lost: Vec::new() };
            shrinker.settle(v);
            let removed = shrinker.removed;
            self.show(&removed);
            for x in removed {
                self.hierarchy.release(x);
                self.shown.remove(&x);
            }
            self.rotation.truncate(self.hierarchy.vertex_count());
        }

        fn show(&mut self, changed: &[VertexId]) {
            let Self { rotation, hierarchy, shown, .. } = self;
            show(rotation, hierarchy, changed, &mut Scratch::new(), |v, how| {
                shown.insert(v, how);
            });
        }

        /// The leaves with their levels, from the map alone.
        fn leaves(&self) -> Vec<([VertexId; 3], u8)> {
            let mut open: Vec<([VertexId; 3], u8)> = self.input.iter().map(|&corners| (corners, 0)).collect();
            let mut leaves = Vec::new();
            while let Some((corners, level)) = open.pop() {
                let [a, b, c] = corners;
                if let [Some(bc), Some(ca), Some(ab)] = self.hierarchy.odds(corners) {
                    let parts = [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]];
                    open.extend(parts.map(|part| (part, level + 1)));
                } else {
                    leaves.push((corners, level));
                }
            }
            leaves
        }

        fn assert_is_what_the_model_says(&self) {
            assert_eq!(self.rotation.validate_triangles(), []);
            let mut found: BTreeSet<Triangle> = self.rotation.triangles().collect();
            let count = found.len();
            let mut extremes: BTreeMap<VertexId, (u8, u8)> = BTreeMap::new();
            let mut closed = 0;
            for (corners, level) in self.leaves() {
                let [a, b, c] = corners;
                assert_eq!(self.hierarchy.level_of(corners), level);
                for v in corners {
                    let (least, greatest) = extremes.entry(v).or_insert((level, level));
                    (*least, *greatest) = (level.min(*least), level.max(*greatest));
                }
                let mut take = |p, q, r| assert!(found.remove(&Triangle::new(p, q, r)), "{corners:?}");
                for (a, b, c) in [(a, b, c), (b, c, a), (c, a, b)] {
                    let (bc, ca) = (self.hierarchy.odd(b, c), self.hierarchy.odd(c, a));
                    // No edge of a leaf is split twice.
                    let twice = |p, q| self.hierarchy.odd(p, q).is_some();
                    assert!(!bc.is_some_and(|x| twice(b, x) || twice(x, c)));
                    match (self.hierarchy.odd(a, b), bc, ca) {
                        (Some(x), None, None) => {
                            take(a, x, c);
                            take(x, b, c);
                            closed += 1;
                        }
                        (None, Some(x), Some(y)) => {
                            take(x, c, y);
                            closed += 2;
                        }
                        _ => {}
                    }
                }
                if self.hierarchy.odds(corners).iter().all(Option::is_none) {
                    take(a, b, c);
                }
            }
            // What is left are the two parts of a quadrangle beside each corner that was cut off.
            let two_split =
                self.leaves().iter().filter(|leaf| self.hierarchy.odds(leaf.0).iter().flatten().count() == 2).count();
            assert_eq!((found.len(), self.rotation.triangle_count()), (2 * two_split, count));
            assert_eq!(self.rotation.edges().filter(|edge| self.hierarchy.is_closing(edge.ends())).count(), closed);
            for (&v, shown) in &self.shown {
                let (least, greatest) = extremes.get(&v).copied().unwrap_or_default();
                assert_eq!(shown.star_level, self.hierarchy.level(v).max(least));
                assert_eq!(shown.leaf_level, self.hierarchy.level(v).max(greatest));
                let closing = self.rotation.neighbors(v).iter().filter(|&&w| self.hierarchy.is_closing([v, w]));
                assert!(shown.closing <= closing.count() && (shown.hangs || self.hierarchy.contains(v)));
            }
        }

        /// Restriction: the stars of the corners of what is split are complete.
        fn assert_is_restricted(&self) {
            let levels = Levels::new(&self.rotation, &self.hierarchy);
            for (_, birth) in self.hierarchy.births() {
                for end in [birth.parent.p, birth.parent.q] {
                    assert!(self.hierarchy.has_star(end, birth.level - 1));
                    levels.ring(end, birth.level - 1);
                }
            }
        }

        fn any_vertex(&self, random: &mut Random) -> VertexId {
            loop {
                let v = VertexId::new(random.below(self.hierarchy.vertex_count()));
                if self.hierarchy.contains(v) {
                    return v;
                }
            }
        }
    }

    fn shapes_to_try() -> [Mesh; 6] {
        [
            shapes::tetrahedron(),
            shapes::octahedron(),
            shapes::icosahedron(),
            shapes::torus(3, 3, 2.0, 1.0),
            shapes::grid(1, 1),
            shapes::grid(3, 2),
        ]
    }

    #[test]
    fn stars_come_and_go_and_leave_nothing_behind() {
        for (number, mesh) in shapes_to_try().iter().enumerate() {
            for script in 0..10 {
                let mut random = Random((100 * number + script) as u64);
                let mut tried = Tried::new(mesh);
                for _ in 0..20 {
                    let asked: Vec<_> = tried.asked.iter().copied().collect();
                    if !asked.is_empty() && random.below(3) == 0 {
                        let (v, level) = asked[random.below(asked.len())];
                        tried.give_up(v, level);
                    } else {
                        let v = tried.any_vertex(&mut random);
                        let level = (tried.hierarchy.level(v) + random.below(3) as u8).min(4);
                        tried.ask(v, level);
                    }
                    tried.assert_is_what_the_model_says();
                    tried.assert_is_restricted();
                }
                for (v, level) in tried.asked.clone() {
                    tried.give_up(v, level);
                    tried.assert_is_what_the_model_says();
                }
                assert_eq!(tried.hierarchy.vertex_count(), mesh.vertex_count());
                assert!(
                    mesh.vertices()
                        .all(|v| tried.rotation.ring(v) == mesh.ring(v) && tried.hierarchy.star_count(v) == 0)
                );
            }
        }
    }

    #[test]
    fn a_restricted_split_makes_rings_as_uniform_refinement_has_them() {
        use crate::adaptive::Uniform;
        use crate::scheme::Midpoint;
        use crate::step::{History, Keep};
        use crate::subdivide::{Control, Subdivider};

        for mesh in shapes_to_try() {
            let mut tried = Tried::new(&mesh);
            for level in 0..2 {
                for (corners, _) in tried.leaves().into_iter().filter(|leaf| leaf.1 == level) {
                    tried.grow(|grower| grower.split_restricted(corners).unwrap());
                    tried.assert_is_what_the_model_says();
                }
            }
            let (mut uniform, keep) = (mesh.clone(), Keep { names: true, ..Keep::default() });
            let mut history = History::new(&mesh, keep);
            let subdivider = Subdivider::new(Midpoint, Uniform);
            for _ in 0..2 {
                let all = crate::select::Selection::empty();
                subdivider
                    .step(&mut uniform, &mut history, &all, &mut Scratch::new(), &mut Control::default())
                    .unwrap();
            }
            assert_eq!(uniform.vertex_count(), tried.rotation.vertex_count());
            // Both name their vertices by ends, from the oldest on.
            let mut names: Vec<VertexId> = mesh.vertices().collect();
            for x in (mesh.vertex_count()..uniform.vertex_count()).map(VertexId::new) {
                let ends: Vec<VertexId> =
                    history.parents(x).unwrap().vertices().map(|end| names[end.index()]).collect();
                let same = tried.hierarchy.odd(ends[0], ends[1]).unwrap();
                let birth = tried.hierarchy.birth(same).unwrap();
                assert_eq!([birth.parent.p, birth.parent.q].as_slice(), ends);
                names.push(same);
            }
            for v in uniform.vertices() {
                let ring: Vec<VertexId> = uniform.ring(v).iter().map(|w| names[w.index()]).collect();
                let found = tried.rotation.ring(names[v.index()]);
                assert_eq!((found.neighbors(), found.is_open()), (ring.as_slice(), uniform.ring(v).is_open()));
            }
        }
    }
}
