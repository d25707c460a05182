//! T-junctions and cracks: where boundaries lie so close to each other that a gap between faces was not meant.

use std::borrow::Cow;
use std::ops::RangeInclusive;

use glam::DVec3;
use rstar::primitives::GeomWithData;
use rstar::{AABB, RTree, SelectionFunction};

use super::{Finding, FindingKind};
use crate::id::VertexId;
use crate::parallel;
use crate::soup::{self, EdgeTable, TableEdge, enumerated};

/// The default tolerance, as a part of the diagonal of the box around the vertices in use.
const PART_OF_DIAGONAL: f64 = 1e-6;

/// A triangular gap is a crack if it is flatter than this part of its longest edge.
const FLAT: f64 = 0.25;

/// Where along its longest edge the third vertex of a crack may stand. A crack opens where one face splits an edge near
/// its middle and the other does not; a flat hole with its third vertex near an end is a hole.
const MIDDLE: RangeInclusive<f64> = 0.25..=0.75;

/// How many vertices on one edge are looked for: with fewer the work on n edges through the same n points would be n²;
/// an edge cut in two six times has 63.
const ON_ONE_EDGE: usize = 64;

/// If a coordinate is above this, or all are below its inverse, they are multiplied by a power of two that brings them
/// nearer to 1, so that no square overflows or vanishes.
const LARGE: f64 = 1e100;

/// A distinct place of boundary vertices, with where they stand in [`Boundary::by_place`].
type Place = GeomWithData<[f64; 3], (u32, u32)>;

/// The boundary edges of a list of faces and the vertices on them, in space.
pub(super) struct Boundary<'a> {
    table: &'a EdgeTable<'a>,
    edges: Vec<TableEdge<'a>>,
    /// All positions, scaled so that squares of distances are finite.
    points: Cow<'a, [DVec3]>,
    /// What positions were multiplied by.
    scale: f64,
    /// The tolerance after scaling.
    tolerance: f64,
    /// The greatest absolute coordinate after scaling.
    reach: f64,
}

/// Findings, and the pairs of corners of two fans each that would become one if what was found were closed.
#[derive(Default)]
pub(super) struct Gaps {
    pub(super) findings: Vec<Finding>,
    pub(super) glued: Vec<[u32; 2]>,
}

impl<'a> Boundary<'a> {
    /// The boundary `edges` of a table, in its order.
    pub(super) fn new(
        positions: &'a [DVec3],
        table: &'a EdgeTable<'a>,
        edges: Vec<TableEdge<'a>>,
        used: &[bool],
        tolerance: Option<f64>,
    ) -> Self {
        let bounds = soup::bounds(positions, used).unwrap_or_default();
        let greatest = bounds.map(|corner| corner.abs().max_element()).into_iter().fold(0.0, f64::max);
        let scale = match greatest {
            _ if greatest > LARGE => 2_f64.powi(-640),
            _ if greatest > 0.0 && greatest < 1.0 / LARGE => 2_f64.powi(640),
            _ => 1.0,
        };
        let [min, max] = bounds.map(|corner| corner * scale);
        let tolerance = match tolerance {
            Some(given) => given.max(0.0) * scale,
            None => PART_OF_DIAGONAL * min.distance(max),
        };
        let points = match scale {
            1.0 => Cow::Borrowed(positions),
            _ => positions.iter().map(|&p| p * scale).collect(),
        };
        Self { table, edges, points, scale, tolerance, reach: greatest * scale }
    }

    /// The distance up to which a vertex counts as lying on an edge.
    pub(super) fn tolerance(&self) -> f64 {
        self.tolerance / self.scale
    }

    /// One finding for each boundary edge with a boundary vertex within the tolerance of its inside.
    pub(super) fn t_junctions(&self) -> Gaps {
        let by_place = self.by_place();
        let same_place = |&p: &u32, &q: &u32| self.points[p as usize] == self.points[q as usize];
        let mut start = 0;
        let places = by_place.chunk_by(same_place).map(|same| {
            let range = (start, start + same.len() as u32);
            start = range.1;
            Place::new(self.points[same[0] as usize].to_array(), range)
        });
        let tree = RTree::bulk_load(places.collect());

        let mut gaps = Gaps::default();
        for (k, on_edge) in parallel::gather(0..self.edges.len(), |k| {
            let on_edge = self.on_edge(self.edges[k], &tree, &by_place);
            (!on_edge.is_empty()).then_some((k, on_edge))
        }) {
            self.add_t_junction(self.edges[k], &on_edge, &mut gaps);
        }
        gaps
    }

    /// The vertices within the tolerance of the inside of an edge, from its smaller end on.
    fn on_edge(&self, edge: TableEdge<'_>, tree: &RTree<Place>, by_place: &[u32]) -> Vec<u32> {
        let [a, b] = edge.ends().map(|v| self.points[v as usize]);
        let length_squared = a.distance_squared(b);
        if length_squared == 0.0 || !length_squared.is_finite() {
            return Vec::new();
        }
        let around = Around::new(a, b, self.tolerance, self.reach * 1e-12);
        let on_edge = tree.locate_with_selection_function(around).flat_map(|place| {
            let (start, end) = place.data;
            &by_place[start as usize..end as usize]
        });
        let mut on_edge: Vec<u32> = on_edge.copied().take(ON_ONE_EDGE).collect();
        let along = |v: u32| (self.points[v as usize] - a).dot(b - a);
        on_edge.sort_by(|&v, &w| along(v).total_cmp(&along(w)).then(v.cmp(&w)));
        on_edge
    }

    /// One finding for each flat loop of three boundary edges.
    pub(super) fn cracks(&self) -> Gaps {
        let links = self.links();
        let neighbors = |v: u32| -> &[(u32, u32)] {
            let start = links.partition_point(|link| link.0 < v);
            &links[start..start + links[start..].partition_point(|link| link.0 == v)]
        };
        let mut gaps = Gaps::default();
        for two in links.chunk_by(|p, q| p.0 == q.0).filter(|two| two.len() == 2) {
            let [x, a, b] = [two[0].0, two[0].1, two[1].1];
            // The smallest of the vertices where the loop is all of the boundary speaks for it.
            if [a, b].iter().any(|&v| v < x && neighbors(v).len() == 2) {
                continue;
            }
            let edges = [(a, b), (a, x), (b, x)].map(|(v, w)| self.table.edge(v, w));
            if let [Some(ab), Some(ax), Some(bx)] = edges {
                if ab.is_boundary() {
                    self.add_crack([(ab, x), (ax, b), (bx, a)], &mut gaps);
                }
            }
        }
        gaps.findings.sort_by(|p, q| p.vertices.cmp(&q.vertices));
        gaps
    }

    /// The boundary vertices with finite positions, those at one place side by side.
    fn by_place(&self) -> Vec<u32> {
        let mut vertices: Vec<u32> = self.edges.iter().flat_map(|edge| edge.ends()).collect();
        vertices.sort_unstable();
        vertices.dedup();
        vertices.retain(|&v| self.points[v as usize].is_finite());
        vertices.sort_by(|&v, &w| {
            let [p, q] = [v, w].map(|v| self.points[v as usize].to_array());
            p.partial_cmp(&q).expect("finite numbers have an order")
        });
        vertices
    }

    /// Both directions of all boundary edges, sorted.
    fn links(&self) -> Vec<(u32, u32)> {
        let ends = self.edges.iter().map(|edge| edge.ends());
        let mut links: Vec<(u32, u32)> = ends.flat_map(|[a, b]| [(a, b), (b, a)]).collect();
        links.sort_unstable();
        links
    }

    fn add_t_junction(&self, edge: TableEdge<'_>, on_edge: &[u32], gaps: &mut Gaps) {
        for (end, &x) in edge.ends().iter().flat_map(|&end| on_edge.iter().map(move |x| (end, x))) {
            if let Some(half) = self.table.edge(end, x).filter(|half| half.is_boundary()) {
                gaps.glued.push([edge.corner_at(end), half.corner_at(end)]);
            }
        }
        let hanging: Vec<VertexId> = on_edge.iter().map(|&v| VertexId::new(v as usize)).collect();
        let names = enumerated(hanging.iter().map(VertexId::to_string));
        let verb = if hanging.len() == 1 { "lies" } else { "lie" };
        let faces: Vec<usize> = edge.faces().collect();
        gaps.findings.push(Finding {
            kind: FindingKind::TJunction,
            message: format!("{names} {verb} on the inside of edge {} of face {}", edge.name(), faces[0]),
            vertices: edge.name().ends().into_iter().chain(hanging).collect(),
            faces,
        });
    }

    /// Adds a loop of three edges, each with the vertex opposite to it, if it is a crack.
    fn add_crack(&self, sides: [(TableEdge<'_>, u32); 3], gaps: &mut Gaps) {
        let mut faces: Vec<usize> = sides.iter().flat_map(|(edge, _)| edge.faces()).collect();
        faces.sort_unstable();
        faces.dedup();
        if faces.len() == 1 {
            return;
        }
        let length = |edge: TableEdge<'_>| {
            let [a, b] = edge.ends().map(|v| self.points[v as usize]);
            a.distance(b)
        };
        let [mut longest, second, third] = sides;
        for side in [second, third] {
            if length(side.0) > length(longest.0) {
                longest = side;
            }
        }
        let (edge, x) = longest;
        let [a, b] = edge.ends().map(|v| self.points[v as usize]);
        let off = distance_to_segment(self.points[x as usize], a, b);
        let foot = (self.points[x as usize] - a).dot(b - a) / (b - a).length_squared();
        let is_crack = off > self.tolerance && off < FLAT * length(edge) && MIDDLE.contains(&foot);
        if !is_crack {
            return;
        }
        for (half, _) in sides.into_iter().filter(|side| side.1 != x) {
            for end in edge.ends().into_iter().filter(|end| half.ends().contains(end)) {
                gaps.glued.push([edge.corner_at(end), half.corner_at(end)]);
            }
        }
        let x = VertexId::new(x as usize);
        gaps.findings.push(Finding {
            kind: FindingKind::Crack,
            message: format!("{x} is off edge {} by {:.3e}: a crack runs between them", edge.name(), off / self.scale),
            vertices: edge.name().ends().into_iter().chain([x]).collect(),
            faces,
        });
    }
}

/// What lies within the tolerance of a segment, but not of its ends.
struct Around {
    a: DVec3,
    b: DVec3,
    tolerance: f64,
    /// The tolerance and a little more, so that rounding hides nothing.
    margin: DVec3,
    /// The box around all that is within the margin.
    lower: DVec3,
    upper: DVec3,
}

impl Around {
    fn new(a: DVec3, b: DVec3, tolerance: f64, slack: f64) -> Self {
        let margin = DVec3::splat(tolerance + slack);
        Self { a, b, tolerance, margin, lower: a.min(b) - margin, upper: a.max(b) + margin }
    }

    /// Whether the segment meets a box. The box of the segment alone would not do: that of a long slanting edge holds
    /// all vertices of the mesh.
    fn crosses(&self, lower: DVec3, upper: DVec3) -> bool {
        let direction = self.b - self.a;
        let (mut start, mut end) = (0.0, 1.0_f64);
        for axis in (0..3).filter(|&axis| direction[axis] != 0.0) {
            let s = (lower[axis] - self.a[axis]) / direction[axis];
            let t = (upper[axis] - self.a[axis]) / direction[axis];
            start = s.min(t).max(start);
            end = s.max(t).min(end);
        }
        start <= end
    }
}

impl SelectionFunction<Place> for Around {
    /// Whether the segment comes near to a box, and the box does not lie within the tolerance of an end as a whole.
    fn should_unpack_parent(&self, envelope: &AABB<[f64; 3]>) -> bool {
        let [lower, upper] = [envelope.lower(), envelope.upper()].map(DVec3::from_array);
        if lower.cmpgt(self.upper).any() || upper.cmplt(self.lower).any() {
            return false;
        }
        let is_within = |end: DVec3| {
            (end - lower).abs().max((end - upper).abs()).length_squared() < self.tolerance * self.tolerance
        };
        self.crosses(lower - self.margin, upper + self.margin) && !is_within(self.a) && !is_within(self.b)
    }

    fn should_unpack_leaf(&self, place: &Place) -> bool {
        let p = DVec3::from_array(*place.geom());
        p.cmpge(self.lower).all()
            && p.cmple(self.upper).all()
            && p.distance(self.a) > self.tolerance
            && p.distance(self.b) > self.tolerance
            && distance_to_segment(p, self.a, self.b) <= self.tolerance
    }
}

/// The distance of a point to the nearest point of a segment, NaN if its ends coincide.
fn distance_to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let t = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    p.distance(a + t * along)
}
