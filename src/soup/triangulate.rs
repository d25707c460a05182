//! Triangles of polygons: a fan where the polygon is convex, else ear clipping.
//!
//! Every corner is used, so neighbouring faces still meet corner by corner and no crack opens, not even at corners on
//! a straight side: a polygon of `n` corners makes `n - 2` triangles whose outer edges are those of the polygon. A new
//! edge (a diagonal) is chosen so that no face has it already: on small surfaces of higher genus the nearest choice may
//! well be an edge elsewhere, and then three or four faces would meet there.
//!
//! **Deliberately not here**: corners that are not in the file. Nothing is cut, moved or joined.

use std::collections::HashSet;

use glam::{DVec2, DVec3};

use super::FaceList;

/// The triangles of a list of faces.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Triangulation {
    /// The triangles, in the order of the faces.
    pub triangles: Vec<[u32; 3]>,
    /// The face that each triangle comes from.
    pub face_of: Vec<u32>,
    /// How many faces of more than three sides were convex and cut into a fan.
    pub fanned: usize,
    /// How many faces of more than three sides were cut ear by ear.
    pub clipped: usize,
}

impl FaceList {
    /// Triangles of all faces; triangles stay as they are.
    ///
    /// The fan of a convex polygon starts at its first corner, or at the next at which no triangle is flat and no diagonal
    /// is an edge of another face. Convex, flat and left are judged in the plane of the polygon's Newell normal, up to
    /// 1e-12 of the lengths concerned, so that size and place do not matter.
    ///
    /// It never fails. A polygon that is degenerate, crosses itself, names a vertex twice or a vertex that does not exist is
    /// cut as well as it goes, and what is wrong with it shows in the triangles; if no choice avoids a diagonal that is an
    /// edge elsewhere, one is taken. [`FaceList::defects`] tells of all that. A face of fewer than three corners has no
    /// triangle.
    ///
    /// # Complexity
    /// O(corners) and sorting the edges of polygons. Ear clipping is quadratic in the corners of one concave polygon;
    /// after some 10⁹ tests in all, ears are no longer tested for corners inside them.
    ///
    /// ```
    /// use vvmesh::{glam::DVec3, soup::FaceList};
    /// // An arrowhead: its concave corner is vertex 3.
    /// let mut list = FaceList::new([[0, 0], [4, 1], [0, 2], [1, 1]].map(|[x, y]| DVec3::new(x.into(), y.into(), 0.)).to_vec());
    /// list.push_face(&[0, 1, 2, 3]);
    /// let cut = list.triangulate();
    /// assert_eq!((cut.triangles.len(), cut.fanned, cut.clipped), (2, 0, 1));
    /// assert!(cut.triangles.iter().all(|triangle| triangle.contains(&3)));
    /// ```
    #[must_use]
    pub fn triangulate(&self) -> Triangulation {
        let polygons: Vec<usize> = (0..self.face_count()).filter(|&k| self.face(k).len() > 3).collect();
        let mut result = Triangulation::default();
        let cuts = self.cut(&polygons);
        let mut rest = cuts.triangles.as_slice();
        let mut cut_faces = polygons.iter().zip(&cuts.fanned);
        for (k, face) in self.faces().enumerate() {
            if let [a, b, c] = *face {
                result.triangles.push([a, b, c]);
            } else if face.len() > 3 {
                let (here, after) = rest.split_at(face.len() - 2);
                result.triangles.extend_from_slice(here);
                rest = after;
                let is_fan = cut_faces.next().is_some_and(|(_, &is_fan)| is_fan);
                *(if is_fan { &mut result.fanned } else { &mut result.clipped }) += 1;
            }
            result.face_of.resize(result.triangles.len(), k as u32);
        }
        result
    }

    /// Cuts the polygons one by one. The first choices may leave none to a later one: then it begins anew with those that
    /// were left without.
    fn cut(&self, polygons: &[usize]) -> Cuts {
        const ROUNDS: usize = 8;
        let mut taken = Taken::new(self, polygons);
        let mut order: Vec<usize> = (0..polygons.len()).collect();
        let mut best: Option<(usize, Cuts)> = None;
        for _ in 0..ROUNDS {
            taken.diagonals.clear();
            let mut cuts = Cuts::new(self, polygons);
            let mut cutter = Cutter::new(self, &mut taken);
            let mut is_left = vec![false; polygons.len()];
            for &place in &order {
                let before = cutter.conflicts;
                cuts.fanned[place] = cutter.cut(polygons[place], cuts.of(place));
                is_left[place] = cutter.conflicts > before;
            }
            let conflicts = cutter.conflicts;
            if best.as_ref().is_none_or(|(fewest, _)| conflicts < *fewest) {
                best = Some((conflicts, cuts));
            }
            if conflicts == 0 {
                break;
            }
            order.sort_by_key(|&place| !is_left[place]);
        }
        best.map(|(_, cuts)| cuts).unwrap_or_default()
    }
}

/// What becomes of the polygons, by their place among them.
#[derive(Default)]
struct Cuts {
    triangles: Vec<[u32; 3]>,
    starts: Vec<usize>,
    fanned: Vec<bool>,
}

impl Cuts {
    fn new(list: &FaceList, polygons: &[usize]) -> Self {
        let mut count = 0;
        let mut starts = Vec::with_capacity(polygons.len() + 1);
        for &face in polygons {
            starts.push(count);
            count += list.face(face).len() - 2;
        }
        starts.push(count);
        Self { triangles: vec![[0; 3]; count], starts, fanned: vec![false; polygons.len()] }
    }

    fn of(&mut self, place: usize) -> &mut [[u32; 3]] {
        &mut self.triangles[self.starts[place]..self.starts[place + 1]]
    }
}

/// The edges that no diagonal may double.
struct Taken {
    /// Those of the faces between corners of polygons, sorted.
    edges: Vec<u64>,
    diagonals: HashSet<u64>,
}

impl Taken {
    fn new(list: &FaceList, polygons: &[usize]) -> Self {
        let mut of_polygon = vec![false; list.vertex_count()];
        for &corner in polygons.iter().flat_map(|&face| list.face(face)) {
            if let Some(mark) = of_polygon.get_mut(corner as usize) {
                *mark = true;
            }
        }
        let is_marked = |v: u32| of_polygon.get(v as usize).is_some_and(|&mark| mark);
        let mut edges = Vec::new();
        if !polygons.is_empty() {
            for face in list.faces().filter(|face| !face.is_empty()) {
                let mut a = face[face.len() - 1];
                for &b in face {
                    if is_marked(a) && is_marked(b) {
                        edges.push(key(a, b));
                    }
                    a = b;
                }
            }
        }
        edges.sort_unstable();
        edges.dedup();
        Self { edges, diagonals: HashSet::new() }
    }

    fn is_free(&self, a: u32, b: u32) -> bool {
        a != b && self.edges.binary_search(&key(a, b)).is_err() && !self.diagonals.contains(&key(a, b))
    }
}

fn key(a: u32, b: u32) -> u64 {
    u64::from(a.min(b)) << 32 | u64::from(a.max(b))
}

/// What is needed to cut one polygon after the other.
struct Cutter<'a> {
    list: &'a FaceList,
    taken: &'a mut Taken,
    /// Diagonals so far that are edges elsewhere.
    conflicts: usize,
    /// How many more corners are tested for lying in an ear.
    tests_left: u64,
    points: Vec<DVec2>,
    next: Vec<u32>,
    previous: Vec<u32>,
    /// The corners that may lie in an ear: those that are not strictly convex.
    blockers: Vec<u32>,
}

/// Up to so many corners, those left when no ear is found are cut in the best of all ways (cubic).
const SEARCHED: usize = 32;

/// How many first corners are tried for a fan.
const FAN_STARTS: usize = 16;

impl<'a> Cutter<'a> {
    fn new(list: &'a FaceList, taken: &'a mut Taken) -> Self {
        Self {
            list,
            taken,
            conflicts: 0,
            tests_left: 1 << 30,
            points: Vec::new(),
            next: Vec::new(),
            previous: Vec::new(),
            blockers: Vec::new(),
        }
    }

    /// Cuts a polygon into triangles and answers whether they are a fan.
    fn cut(&mut self, face: usize, triangles: &mut [[u32; 3]]) -> bool {
        let corners = self.list.face(face);
        flatten(self.list, corners, &mut self.points);
        if let Some(start) = self.fan_start(corners) {
            let n = corners.len();
            let at = |k: usize| corners[(start + k) % n];
            for (k, triangle) in triangles.iter_mut().enumerate() {
                *triangle = [at(0), at(k + 1), at(k + 2)];
                if k > 0 {
                    self.take(at(0), at(k + 1));
                }
            }
            return true;
        }
        self.clip(corners, triangles);
        false
    }

    fn take(&mut self, a: u32, b: u32) {
        self.conflicts += usize::from(!self.taken.is_free(a, b));
        self.taken.diagonals.insert(key(a, b));
    }

    /// The first corner of a fan that is sound and doubles no edge, if the polygon is convex.
    fn fan_start(&self, corners: &[u32]) -> Option<usize> {
        let (points, n) = (&self.points, corners.len());
        let is_convex = (0..n).all(|k| {
            let [a, b, c] = [points[k], points[(k + 1) % n], points[(k + 2) % n]];
            side(b - a, c - b) >= 0
        });
        if !is_convex {
            return None;
        }
        (0..n.min(FAN_STARTS)).find(|&start| {
            let spoke = |k: usize| points[(start + k) % n] - points[start];
            // No flat triangle; and all lies left of the first side, so the polygon runs round once only.
            (1..n - 1).all(|k| side(spoke(k), spoke(k + 1)) > 0 && side(spoke(1), spoke(k + 1)) >= 0)
                && (2..n - 1).all(|k| self.taken.is_free(corners[start], corners[(start + k) % n]))
        })
    }

    /// Cuts ears off until a triangle is left.
    fn clip(&mut self, corners: &[u32], triangles: &mut [[u32; 3]]) {
        let n = corners.len();
        self.next.clear();
        self.next.extend((1..n as u32).chain([0]));
        self.previous.clear();
        self.previous.extend([n as u32 - 1].into_iter().chain(0..n as u32 - 1));
        self.blockers.clear();
        for k in 0..n {
            if self.turn(k) <= 0 {
                self.blockers.push(k as u32);
            }
        }

        let mut demand = Demand::Ear;
        let (mut at, mut left, mut missed) = (0, n, 0);
        for place in 0..triangles.len() {
            if left > 3 {
                while !self.is_cut(corners, at, demand) {
                    at = self.next[at] as usize;
                    missed += 1;
                    if missed == left {
                        if left <= SEARCHED {
                            return self.cut_best(corners, at, left, &mut triangles[place..]);
                        }
                        demand = demand.relaxed();
                        missed = 0;
                    }
                }
                missed = 0;
            }
            let (a, c) = (self.previous[at] as usize, self.next[at] as usize);
            triangles[place] = [corners[a], corners[at], corners[c]];
            if left > 3 {
                self.take(corners[a], corners[c]);
            }
            self.next[a] = c as u32;
            self.previous[c] = a as u32;
            // A corner that points to itself is off.
            self.next[at] = at as u32;
            left -= 1;
            // Going on behind the neighbour makes better triangles than cutting it next.
            at = self.next[c] as usize;
        }
    }

    /// On which side the polygon turns at a corner.
    fn turn(&self, k: usize) -> i8 {
        let [a, b, c] = [self.previous[k] as usize, k, self.next[k] as usize].map(|k| self.points[k]);
        side(b - a, c - b)
    }

    fn is_cut(&mut self, corners: &[u32], k: usize, demand: Demand) -> bool {
        let is_free = |taken: &Taken, a: u32, c: u32| taken.is_free(corners[a as usize], corners[c as usize]);
        match demand {
            Demand::Ear => self.turn(k) > 0 && is_free(self.taken, self.previous[k], self.next[k]) && self.is_empty(k),
            Demand::Free => is_free(self.taken, self.previous[k], self.next[k]),
            Demand::Any => true,
        }
    }

    /// Whether no corner lies in the triangle at a corner, its edges included.
    fn is_empty(&mut self, k: usize) -> bool {
        let [a, b, c] = [self.previous[k] as usize, k, self.next[k] as usize].map(|k| self.points[k]);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        let mut j = 0;
        while j < self.blockers.len() {
            if self.tests_left == 0 {
                return true;
            }
            self.tests_left -= 1;
            let blocker = self.blockers[j] as usize;
            if self.next[blocker] as usize == blocker {
                self.blockers.swap_remove(j);
                continue;
            }
            j += 1;
            let p = self.points[blocker];
            // A polygon may touch itself at a corner, as one with a bridge to a hole does.
            let is_corner = p == a || p == b || p == c;
            if !is_corner
                && p.cmpge(low).all()
                && p.cmple(high).all()
                && side(b - a, p - a) >= 0
                && side(c - b, p - b) >= 0
                && side(a - c, p - c) >= 0
            {
                return false;
            }
        }
        true
    }

    /// Cuts what is left around `at` so that, in this order, the fewest diagonals double an edge, the least area is folded
    /// over, and the fewest triangles are flat.
    fn cut_best(&mut self, corners: &[u32], at: usize, left: usize, triangles: &mut [[u32; 3]]) {
        let ring: Vec<usize> = std::iter::successors(Some(at), |&k| Some(self.next[k] as usize)).take(left).collect();
        // best[i][j] cuts the polygon ring[i..=j] and says where its triangle on the side i-j has its tip.
        let mut best = vec![[(Cost::default(), 0_usize); SEARCHED]; left];
        for width in 2..left {
            for i in 0..left - width {
                let j = i + width;
                let is_side = width + 1 == left;
                let doubles = !is_side && !self.taken.is_free(corners[ring[i]], corners[ring[j]]);
                let tips = (i + 1..j).map(|tip| {
                    let [a, b, c] = [i, tip, j].map(|k| self.points[ring[k]]);
                    (best[i][tip].0.plus(best[tip][j].0).plus(Cost::of(a, b, c)), tip)
                });
                let cheapest = tips.reduce(|one, other| if other.0.is_below(one.0) { other } else { one });
                let (cost, tip) = cheapest.expect("a polygon of three corners and more has a tip on each side");
                best[i][j] = (Cost { doubled: cost.doubled + u32::from(doubles), ..cost }, tip);
            }
        }
        let mut open = vec![(0, left - 1)];
        let mut places = triangles.iter_mut();
        while let Some((i, j)) = open.pop() {
            let tip = best[i][j].1;
            let place = places.next().expect("n corners make n - 2 triangles");
            *place = [i, tip, j].map(|k| corners[ring[k]]);
            for (i, j) in [(i, tip), (tip, j)] {
                if j - i > 1 {
                    self.take(corners[ring[i]], corners[ring[j]]);
                    open.push((i, j));
                }
            }
        }
    }
}

/// What a corner must fulfil to be cut off.
#[derive(Clone, Copy)]
enum Demand {
    /// It is convex, nothing lies inside, the diagonal doubles no edge.
    Ear,
    /// The diagonal doubles no edge.
    Free,
    /// Nothing.
    Any,
}

impl Demand {
    fn relaxed(self) -> Self {
        match self {
            Self::Ear => Self::Free,
            Self::Free | Self::Any => Self::Any,
        }
    }
}

/// What is bad about some triangles of a polygon.
#[derive(Clone, Copy, Default)]
struct Cost {
    doubled: u32,
    folded: f64,
    flat: u32,
}

impl Cost {
    fn of(a: DVec2, b: DVec2, c: DVec2) -> Self {
        match side(b - a, c - b) {
            1 => Self::default(),
            0 => Self { flat: 1, ..Self::default() },
            _ => Self { folded: -(b - a).perp_dot(c - b), ..Self::default() },
        }
    }

    fn plus(self, other: Self) -> Self {
        Self { doubled: self.doubled + other.doubled, folded: self.folded + other.folded, flat: self.flat + other.flat }
    }

    fn is_below(self, other: Self) -> bool {
        let equal = (self.doubled, self.folded) == (other.doubled, other.folded);
        if equal { self.flat < other.flat } else { (self.doubled, self.folded) < (other.doubled, other.folded) }
    }
}

/// On which side of `u` the vector `v` points: 1 left, -1 right, 0 along the same line.
///
/// Along means within an angle of 1e-12: far above what rounding makes of points on a line, far below what is meant.
fn side(u: DVec2, v: DVec2) -> i8 {
    const ANGLE: f64 = 1e-12;
    let cross = u.perp_dot(v);
    if cross * cross <= ANGLE * ANGLE * u.length_squared() * v.length_squared() {
        0
    } else if cross > 0.0 {
        1
    } else {
        -1
    }
}

/// The corners in the plane of the polygon's Newell normal, at most 1 from the first; all at one place if it has no
/// normal.
fn flatten(list: &FaceList, corners: &[u32], points: &mut Vec<DVec2>) {
    points.clear();
    let position = |&v: &u32| list.positions.get(v as usize).copied().unwrap_or(DVec3::NAN);
    // Halves, as the difference of two great numbers may be none.
    let first = corners.first().map_or(DVec3::ZERO, position) / 2.0;
    let offset = |v: &u32| position(v) / 2.0 - first;
    let size = corners.iter().map(|v| offset(v).abs().max_element()).fold(0.0, f64::max);
    let is_sound = size > 0.0 && corners.iter().all(|v| offset(v).is_finite());
    // Dividing by a subnormal number directly is exact enough; its reciprocal may be infinite.
    let scaled = |v: &u32| if is_sound { offset(v) / size } else { DVec3::ZERO };
    let mut normal = DVec3::ZERO;
    let mut a = corners.last().map_or(DVec3::ZERO, scaled);
    for v in corners {
        let b = scaled(v);
        normal += a.cross(b);
        a = b;
    }
    match normal.try_normalize() {
        Some(normal) => {
            let (x, y) = normal.any_orthonormal_pair();
            points.extend(corners.iter().map(scaled).map(|p| DVec2::new(p.dot(x), p.dot(y))));
        }
        None => points.resize(corners.len(), DVec2::ZERO),
    }
}
