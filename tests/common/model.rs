//! Naive models of what the rings stand for: a set of oriented triangles, and plain lists. They share no code and no
//! idea with the library.

use std::collections::{BTreeMap, BTreeSet};

/// Neighbours, and whether there is a gap behind the last.
pub(crate) type PlainRing = (Vec<usize>, bool);

/// Oriented triangles, each starting with its smallest corner.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Triangles(pub(crate) BTreeSet<[usize; 3]>);

/// What is counted of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Counts {
    pub(crate) euler_characteristic: i64,
    pub(crate) components: usize,
    pub(crate) loops: usize,
    pub(crate) genus: usize,
}

impl Triangles {
    pub(crate) fn new(triangles: impl IntoIterator<Item = [usize; 3]>) -> Self {
        let mut all = Self::default();
        for triangle in triangles {
            assert!(all.insert(triangle), "a triangle comes twice");
        }
        all
    }

    /// Answers whether it was not there before.
    fn insert(&mut self, [a, b, c]: [usize; 3]) -> bool {
        let smallest = a.min(b).min(c);
        self.0.insert(match smallest {
            s if s == a => [a, b, c],
            s if s == b => [b, c, a],
            _ => [c, a, b],
        })
    }

    /// The corner left of a -> b.
    pub(crate) fn left(&self, a: usize, b: usize) -> Option<usize> {
        self.directed().find(|&(from, to, _)| (from, to) == (a, b)).map(|(_, _, c)| c)
    }

    pub(crate) fn vertices(&self) -> BTreeSet<usize> {
        self.0.iter().flatten().copied().collect()
    }

    pub(crate) fn edges(&self) -> BTreeSet<[usize; 2]> {
        self.directed().map(|(a, b, _)| [a.min(b), a.max(b)]).collect()
    }

    /// Every side of every triangle, and the corner opposite.
    fn directed(&self) -> impl Iterator<Item = (usize, usize, usize)> {
        self.0.iter().flat_map(|&[a, b, c]| [(a, b, c), (b, c, a), (c, a, b)])
    }

    pub(crate) fn split(&self, p: usize, q: usize, x: usize) -> Self {
        let mut result = Self::default();
        for &triangle in &self.0 {
            let turned = (0..3).map(|k| [triangle[k], triangle[(k + 1) % 3], triangle[(k + 2) % 3]]);
            match turned.into_iter().find(|&[a, b, _]| (a, b) == (p, q) || (a, b) == (q, p)) {
                Some([a, b, c]) => assert!(result.insert([a, x, c]) && result.insert([x, b, c])),
                None => assert!(result.insert(triangle)),
            }
        }
        result
    }

    /// The triangles after a flip, if they make a surface.
    pub(crate) fn flip(&self, a: usize, b: usize) -> Option<Self> {
        let (c, d) = (self.left(a, b)?, self.left(b, a)?);
        let mut result = Self::default();
        for &triangle in self.0.iter().filter(|triangle| !(triangle.contains(&a) && triangle.contains(&b))) {
            result.insert(triangle);
        }
        let added = c != d && result.insert([a, d, c]) && result.insert([b, c, d]);
        (added && result.vertices() == self.vertices()).then_some(result).filter(|result| result.rings().is_some())
    }

    /// The triangles after `b` went to `a`, if they make a surface of the same kind.
    pub(crate) fn collapse(&self, a: usize, b: usize) -> Option<Self> {
        if !self.edges().contains(&[a.min(b), a.max(b)]) {
            return None;
        }
        let mut result = Self::default();
        for triangle in self.0.iter().filter(|triangle| !(triangle.contains(&a) && triangle.contains(&b))) {
            if !result.insert(triangle.map(|v| if v == b { a } else { v })) {
                return None;
            }
        }
        result.rings()?;
        let mut expected = self.vertices();
        expected.remove(&b);
        (result.vertices() == expected && result.counts() == self.counts()).then_some(result)
    }

    /// The rings, an open one from its gap on, or `None` if this is no oriented manifold.
    pub(crate) fn rings(&self) -> Option<BTreeMap<usize, PlainRing>> {
        let mut after: BTreeMap<usize, BTreeMap<usize, usize>> = BTreeMap::new();
        for (b, c, v) in self.directed() {
            if v == b || after.entry(v).or_default().insert(b, c).is_some() {
                return None;
            }
        }
        let mut rings = BTreeMap::new();
        for (v, next) in after {
            let starts: Vec<usize> = next.keys().copied().filter(|b| !next.values().any(|c| c == b)).collect();
            let open = match starts.len() {
                0 => false,
                1 => true,
                _ => return None,
            };
            let first = *starts.first().unwrap_or_else(|| next.keys().next().unwrap());
            let mut ring = vec![first];
            while let Some(&c) = next.get(ring.last().unwrap()) {
                if c == first {
                    break;
                }
                ring.push(c);
            }
            if ring.len() != next.len() + usize::from(open) || (!open && ring.len() < 3) {
                return None;
            }
            rings.insert(v, (ring, open));
        }
        Some(rings)
    }

    pub(crate) fn counts(&self) -> Counts {
        let sides: BTreeSet<(usize, usize)> = self.directed().map(|(a, b, _)| (a, b)).collect();
        let outer: BTreeMap<usize, usize> =
            sides.iter().filter(|&&(a, b)| !sides.contains(&(b, a))).map(|&(a, b)| (b, a)).collect();
        let links = self.edges();
        let (vertices, edges, faces) = (self.vertices(), links.len(), self.0.len());
        let euler_characteristic = vertices.len() as i64 - edges as i64 + faces as i64;
        let components = classes(&vertices, links.iter().map(|&[a, b]| (a, b)));
        let loops = classes(&outer.keys().copied().collect(), outer.iter().map(|(&a, &b)| (a, b)));
        let twice = 2 * components as i64 - euler_characteristic - loops as i64;
        Counts { euler_characteristic, components, loops, genus: usize::try_from(twice).unwrap() / 2 }
    }
}

/// How many classes of vertices remain when pairs are joined.
pub(crate) fn classes(vertices: &BTreeSet<usize>, pairs: impl Iterator<Item = (usize, usize)>) -> usize {
    let mut name: BTreeMap<usize, usize> = vertices.iter().map(|&v| (v, v)).collect();
    for (a, b) in pairs {
        let (keep, drop) = (name[&a], name[&b]);
        name.values_mut().filter(|other| **other == drop).for_each(|other| *other = keep);
    }
    name.values().collect::<BTreeSet<_>>().len()
}

/// Whether plain rings make a rotation system: the rules as they are written down, one by one.
pub(crate) fn is_rotation_system(rings: &[PlainRing]) -> bool {
    rings.iter().enumerate().all(|(v, (ring, open))| {
        let once = ring.iter().collect::<BTreeSet<_>>().len() == ring.len() && !ring.contains(&v);
        let both = ring.iter().all(|&w| rings[w].0.contains(&v));
        // A gap on the left of v -> w is one on the left of what comes back on the other side.
        let gap = |from: usize, to: usize| rings[from].1 && rings[from].0.last() == Some(&to);
        let gap_seen_from_end = |from: usize, to: usize| rings[to].1 && rings[to].0.first() == Some(&from);
        once && both && (*open <= !ring.is_empty()) && ring.iter().all(|&w| gap(v, w) == gap_seen_from_end(v, w))
    })
}

/// Whether a rotation system is one of triangles.
pub(crate) fn is_triangular(rings: &[PlainRing]) -> bool {
    let next = |v: usize, a: usize| -> Option<usize> {
        let (ring, open) = &rings[v];
        let slot = ring.iter().position(|&w| w == a).unwrap();
        if slot + 1 < ring.len() { Some(ring[slot + 1]) } else { (!open).then(|| ring[0]) }
    };
    rings.iter().enumerate().all(|(v, (ring, open))| {
        let enough = ring.is_empty() || ring.len() >= if *open { 2 } else { 3 };
        enough
            && ring.iter().all(|&a| match next(v, a) {
                None => true,
                Some(b) => rings[a].0.contains(&b) && next(a, b) == Some(v) && next(b, v) == Some(a),
            })
    })
}
