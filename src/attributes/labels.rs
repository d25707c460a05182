//! Labels of faces: a face of the refined mesh has the label of the input face in which it lies.

use std::collections::HashMap;

use smallvec::SmallVec;

use super::Splits;
use crate::id::{Edge, Triangle, VertexId};
use crate::mesh::Mesh;
use crate::step::{History, SplitKind};

/// From which faces the faces of a refined mesh descend.
///
/// Nothing is kept of a face: where its corners come from tells the face before in which it lies, and so on back. 12 bytes
/// a new vertex, and under √3 and on a hierarchy one more a vertex.
///
/// On a hierarchy steps take back what closes cracks, and make several levels at once. There a face is traced back from level
/// to level instead, for which all steps on it count as one.
///
/// # √3
/// Two steps make nine faces of one, and those lie in it; but in between an edge is turned and each of the two faces
/// beside it lies half in one old face and half in the next. Such a face, with the corner v at an end of the old edge
/// v-w, counts to the old face left of v → w. So of the two one goes to each side, each old face gets three, and nothing
/// depends on ids. A face of an even number of steps is traced back by two at once, so half faces never add up: the
/// border between two labels is, after every second step, the old border cut in three.
#[derive(Clone, Debug)]
pub(super) struct Ancestry {
    /// How many vertices there were at the start, and after each step; after the last of those on one hierarchy.
    starts: Vec<usize>,
    /// Of every vertex made since the start what it was made of: the ends of an edge, the last twice, or a triangle,
    /// counter-clockwise; under √3 always the triangle.
    homes: Vec<[VertexId; 3]>,
    /// The birth levels of all vertices, after the first step of √3; or on hierarchies, each with levels of its own, up to the
    /// last vertex that was made on one.
    levels: Vec<u8>,
    is_trisected: bool,
    /// The triangle at each boundary edge in which the two vertices that cut it in three would be made.
    at_boundary: HashMap<Edge, [VertexId; 3]>,
}

impl Ancestry {
    pub(super) fn new(mesh: &Mesh) -> Self {
        let boundary = mesh.vertices().filter_map(|v| {
            // The last neighbour of an open ring is the one before the gap.
            let (&w, ring) = (mesh.ring(v).neighbors().first()?, mesh.ring(v));
            let corner = ring.is_open().then(|| ring.next(w))??;
            Some((Edge::new(v, w), [v, w, corner]))
        });
        let at_boundary = boundary.collect();
        Self {
            starts: vec![mesh.vertex_count()],
            homes: Vec::new(),
            levels: Vec::new(),
            is_trisected: false,
            at_boundary,
        }
    }

    /// Whether there were steps of √3.
    pub(super) fn is_trisected(&self) -> bool {
        self.is_trisected
    }

    /// Takes the vertices that a step made; the history is the one after it.
    pub(super) fn record(&mut self, splits: &Splits, kind: SplitKind, history: &History) {
        if kind == SplitKind::Trisect {
            for (x, made_of) in splits.made() {
                let home = self.home_in_trisection(x, made_of);
                self.homes.push(home);
            }
        } else {
            self.homes.extend(splits.made().map(|(_, made_of)| made_of));
        }
        let count = self.starts[0] + self.homes.len();
        let hierarchy = history.hierarchy();
        if hierarchy.is_some_and(|hierarchy| self.starts.iter().rev().nth(1) == Some(&hierarchy.input_count())) {
            self.starts.pop();
        }
        self.starts.push(count);
        let new = (self.levels.len()..count).map(VertexId::new);
        if let Some(hierarchy) = hierarchy {
            self.levels.extend(new.map(|v| hierarchy.level(v)));
        } else if kind == SplitKind::Trisect {
            self.is_trisected = true;
            self.levels.extend(new.map(|v| history.level(v).unwrap_or(0)));
        }
    }

    /// The triangle in which a vertex was made, and what that changes along the boundary.
    fn home_in_trisection(&mut self, x: VertexId, [a, b, c]: [VertexId; 3]) -> [VertexId; 3] {
        if b == c {
            let Some(home) = self.at_boundary.remove(&Edge::new(a, b)) else {
                // The second of the two on an edge, which have consecutive ids.
                return *self.homes.last().expect("the first came before");
            };
            let other = VertexId::new(x.index() + 1);
            self.at_boundary.extend([(a, x), (x, other), (other, b)].map(|(v, w)| (Edge::new(v, w), home)));
            return home;
        }
        for (v, w) in [(a, b), (b, c), (c, a)] {
            self.at_boundary.entry(Edge::new(v, w)).and_modify(|home| *home = [v, w, x]);
        }
        [a, b, c]
    }

    /// The corners of the face in which a face lies in the mesh as it was when it had so many vertices. If it lies half in
    /// each of two, the one that counts comes first. O(steps).
    fn faces_among(&self, vertex_count: usize, face: Triangle) -> [[VertexId; 3]; 2] {
        let mut one = face.corners();
        while let Some([left, right]) = self.before(vertex_count, one) {
            if left != right {
                return [left, right].map(|half| self.face_among(vertex_count, half));
            }
            one = left;
        }
        [one; 2]
    }

    /// The corners of the face that counts.
    fn face_among(&self, vertex_count: usize, mut face: [VertexId; 3]) -> [VertexId; 3] {
        while let Some([before, _]) = self.before(vertex_count, face) {
            face = before;
        }
        face
    }

    /// The face before in which a face lies, twice, or the two in which its halves lie; `None` if it is one of the mesh
    /// with so many vertices.
    fn before(&self, vertex_count: usize, corners: [VertexId; 3]) -> Option<[[VertexId; 3]; 2]> {
        if corners.iter().all(|v| v.index() < vertex_count) {
            return None;
        }
        Some(if self.is_trisected() {
            self.before_trisection(vertex_count, corners)
        } else {
            [self.before_step(corners); 2]
        })
    }

    /// The triangle in which a new vertex was made.
    fn home(&self, v: VertexId) -> [VertexId; 3] {
        self.homes[v.index() - self.starts[0]]
    }

    /// The corners of the face that the step made a face of by which its newest corner was made; on a hierarchy the level.
    ///
    /// A step leaves a face as it is, or makes faces of it that all have a new corner. New corners lie in the old face or
    /// on its edges, and with all that they were made of its three corners come out.
    fn before_step(&self, corners: [VertexId; 3]) -> [VertexId; 3] {
        let ages = corners.map(|v| {
            let step = self.starts.partition_point(|&start| start <= v.index());
            (step, self.levels.get(v.index()).copied().unwrap_or(0))
        });
        let newest = ages.into_iter().max();
        let mut old: SmallVec<[VertexId; 9]> = SmallVec::new();
        for (v, age) in corners.into_iter().zip(ages) {
            if Some(age) < newest {
                old.push(v);
            } else {
                old.extend(self.home(v));
            }
        }
        old.sort_unstable();
        old.dedup();
        <[VertexId; 3]>::try_from(&old[..]).expect("a face lies in one face of the step before")
    }

    /// The face before in which a face of √3 lies, half a step back, a whole one or two; or two of them.
    ///
    /// An odd face is a part of the triangle in which its youngest corner was made. An even one, `v, right, left` with the
    /// two youngest last, was made by turning the edge v-w between the triangles in which `left` and `right` were made. The
    /// edge itself was made a level before, with one of its ends in that one's triangle; or it was turned there, between
    /// the triangles of both ends. Near v the face then lies in the triangle of v, if v is the younger end, else in that of w.
    fn before_trisection(&self, vertex_count: usize, corners: [VertexId; 3]) -> [[VertexId; 3]; 2] {
        let levels = corners.map(|v| self.levels[v.index()]);
        let level = levels[0].max(levels[1]).max(levels[2]);
        let place =
            |is_young: bool| levels.iter().position(|&of| (of == level) == is_young).expect("one is the youngest");
        if levels.iter().filter(|&&of| of == level).count() == 1 {
            return [self.home(corners[place(true)]); 2];
        }
        let oldest = place(false);
        let [v, right, left] = [0, 1, 2].map(|k| corners[(oldest + k) % 3]);
        let is_new = |x: VertexId| x.index() >= vertex_count;
        let corner_from_v = |x: VertexId, steps: usize| {
            let home = self.home(x);
            home.iter().position(|&corner| corner == v).map_or(v, |at_v| home[(at_v + steps) % 3])
        };
        let w = if is_new(left) { corner_from_v(left, 1) } else { corner_from_v(right, 2) };
        // One that was there waited for the other, in a face of its own.
        let left = if is_new(left) { self.home(left) } else { [v, w, left] };
        let right = if is_new(right) { self.home(right) } else { [w, v, right] };
        if left == right {
            return [left; 2];
        }
        let made_the_edge = |end: &VertexId| is_new(*end) && self.levels[end.index()] + 1 == level;
        // The last of the vertices that are there has the level of the mesh.
        let is_even = (level ^ self.levels[vertex_count - 1]) & 1 == 0;
        match [v, w].into_iter().find(made_the_edge) {
            Some(end) if is_even => [self.home(end); 2],
            _ => [left, right],
        }
    }
}

/// A named label for each face that there was when they were added.
#[derive(Clone, Debug)]
pub(super) struct FaceLabels {
    name: String,
    /// How many vertices there were.
    vertex_count: usize,
    /// By the corners of the face, ascending.
    labels: Vec<([VertexId; 3], u32)>,
}

impl FaceLabels {
    /// Labels of the triangles of a mesh, in their order.
    pub(super) fn new(name: String, mesh: &Mesh, labels: &[u32]) -> Self {
        let corners = mesh.triangles().map(|triangle| {
            let mut corners = triangle.corners();
            corners.sort_unstable();
            corners
        });
        let mut labels: Vec<_> = corners.zip(labels.iter().copied()).collect();
        labels.sort_unstable();
        Self { name, vertex_count: mesh.vertex_count(), labels }
    }

    pub(super) fn name(&self) -> &str {
        &self.name
    }

    /// The label of the face in which a face lies. O(steps + log faces).
    pub(super) fn of(&self, face: Triangle, ancestry: &Ancestry) -> u32 {
        self.of_halves(face, ancestry)[0]
    }

    /// The labels of the faces in which the halves of a face lie, the one that counts first.
    pub(super) fn of_halves(&self, face: Triangle, ancestry: &Ancestry) -> [u32; 2] {
        ancestry.faces_among(self.vertex_count, face).map(|mut corners| {
            corners.sort_unstable();
            let place = self.labels.binary_search_by_key(&corners, |&(corners, _)| corners);
            self.labels[place.expect("it was a face")].1
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes;

    #[test]
    fn faces_are_traced_back_over_steps() {
        let [a, b, c, d, e, x, y] = [0, 1, 2, 3, 4, 5, 6].map(VertexId::new);
        // 4 on 0-1, then 5 on 0-4 and 6 on 4-2.
        let homes = vec![[a, b, b], [a, e, e], [e, c, c]];
        let ancestry = Ancestry {
            starts: vec![4, 5, 7],
            homes,
            levels: Vec::new(),
            is_trisected: false,
            at_boundary: HashMap::new(),
        };
        let traced = |vertex_count, face| {
            let [mut face, other] = ancestry.faces_among(vertex_count, face);
            assert_eq!(face, other);
            face.sort_unstable();
            face
        };
        assert_eq!(traced(5, Triangle::new(x, y, a)), [a, c, e]);
        assert_eq!(traced(4, Triangle::new(x, y, a)), [a, b, c]);
        assert_eq!(traced(4, Triangle::new(c, b, d)), [b, c, d]);
    }

    #[test]
    fn labels_are_those_of_the_faces_in_order() {
        let mesh = shapes::octahedron();
        let labels = FaceLabels::new("number".into(), &mesh, &[0, 1, 2, 3, 4, 5, 6, 7]);
        let ancestry = Ancestry::new(&mesh);
        assert!(mesh.triangles().map(|face| labels.of(face, &ancestry)).eq(0..8));
    }
}
