//! A mesh in space on paper: seen from far away, in light and shade, with what is hidden painted over.

use std::collections::BTreeMap;
use std::fmt::Write;

use vvmesh::glam::DVec3;
use vvmesh::select::{Elements, Selection};
use vvmesh::{Mesh, Triangle};

use super::canvas::{Canvas, Point, ink};

/// Of these a pixel has so many: whole numbers are short.
const PARTS: f64 = 4.0;

/// What is not selected, and what is.
const PLAIN: [f64; 3] = [236.0, 232.0, 224.0];
const SELECTED: [f64; 3] = [132.0, 190.0, 240.0];

/// From where a mesh is seen, and where on the paper it stands.
#[derive(Clone, Copy)]
pub(crate) struct View {
    /// To the right, upwards, and to the eye.
    axes: [DVec3; 3],
    /// Pixels for a unit.
    pub(crate) scale: f64,
    /// Where the origin is.
    pub(crate) origin: Point,
}

impl View {
    /// From a direction, with another one upwards.
    pub(crate) fn from(eye: DVec3, up: DVec3) -> Self {
        let eye = eye.normalize();
        let right = up.cross(eye).normalize();
        Self { axes: [right, eye.cross(right), eye], scale: 1.0, origin: [0.0; 2] }
    }

    /// The same with some points in the middle of a rectangle, as large as it can hold them.
    pub(crate) fn fit(self, points: impl IntoIterator<Item = DVec3>, [left, top]: Point, size: Point) -> Self {
        let plain = Self { scale: 1.0, origin: [0.0; 2], ..self };
        let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for at in points.into_iter().map(|point| plain.at(point)) {
            low = [0, 1].map(|k| at[k].min(low[k]));
            high = [0, 1].map(|k| at[k].max(high[k]));
        }
        let scale = (size[0] / (high[0] - low[0])).min(size[1] / (high[1] - low[1]));
        let origin = [0, 1].map(|k| [left, top][k] + (size[k] - scale * (low[k] + high[k])) / 2.0);
        Self { scale, origin, ..self }
    }

    pub(crate) fn at(&self, point: DVec3) -> Point {
        let [right, up, _] = self.axes;
        [self.origin[0] + self.scale * point.dot(right), self.origin[1] - self.scale * point.dot(up)]
    }

    /// A point in parts of pixels.
    fn whole(&self, point: DVec3) -> [i64; 2] {
        self.at(point).map(|x| (PARTS * x).round() as i64)
    }

    /// The faces that turn to the eye, from the far side, each in the first layer above all that it hides.
    ///
    /// So no face of a layer hides another, and it does not matter in which order they are painted.
    fn seen(&self, mesh: &Mesh) -> Vec<Seen> {
        let [right, up, eye] = self.axes;
        let light = (0.5 * up - 0.4 * right + 0.9 * eye).normalize();
        let mut seen: Vec<Seen> = Vec::new();
        for face in mesh.triangles() {
            let [a, b, c] = face.corners().map(|v| mesh.position(v));
            let normal = (b - a).cross(c - a).normalize_or_zero();
            if normal.dot(eye) > 0.0 {
                let corners = [a, b, c].map(|corner| self.whole(corner));
                // A thousandth of a unit: ties go by the order of the mesh.
                let depth = (1000.0 * (a + b + c).dot(eye)).round() as i64;
                seen.push(Seen { face, corners, depth, light: normal.dot(light).max(0.0), layer: 0 });
            }
        }
        seen.sort_by_key(|one| one.depth);
        for k in 0..seen.len() {
            let below = seen[..k].iter().filter(|below| below.overlaps(&seen[k]));
            seen[k].layer = below.map(|below| below.layer + 1).max().unwrap_or(0);
        }
        seen
    }

    /// Paints a mesh: the faces of a selection blue, those of vertices with all corners in it; and if it is marked, the
    /// vertices or edges that were selected orange.
    pub(crate) fn paint(&self, canvas: &mut Canvas, mesh: &Mesh, selection: &Selection, marked: bool) {
        let elements = selection.elements();
        let mut layers: Vec<Layer> = Vec::new();
        let (mut edges, mut vertices) = (BTreeMap::new(), BTreeMap::new());
        for one in self.seen(mesh) {
            layers.resize_with(layers.len().max(one.layer + 1), Layer::default);
            let is_selected = !matches!(elements, Elements::Edges(_)) && selection.contains_face(one.face);
            let fill = shade(if is_selected { SELECTED } else { PLAIN }, one.light);
            let [a, b, c] = one.corners;
            let _ =
                write!(layers[one.layer].faces.entry(fill).or_default(), "M{}l{}l{}z", pair(a), way(a, b), way(b, c));
            one.face.edges().into_iter().for_each(|edge| raise(&mut edges, edge, one.layer));
            one.face.corners().into_iter().for_each(|v| raise(&mut vertices, v, one.layer));
        }
        match elements {
            Elements::Vertices(selected) if marked => {
                for (v, &layer) in selected.iter().filter_map(|v| Some((v, vertices.get(v)?))) {
                    let _ = write!(layers[layer].dots, "M{}h0", pair(self.whole(mesh.position(*v))));
                }
            }
            Elements::Edges(selected) if marked => {
                for (edge, &layer) in selected.iter().filter_map(|edge| Some((edge, edges.get(edge)?))) {
                    let [a, b] = edge.ends().map(|v| self.whole(mesh.position(v)));
                    let _ = write!(layers[layer].lines, "M{}l{}", pair(a), way(a, b));
                }
            }
            _ => {}
        }
        canvas.put(&format!(r##"<g transform="scale({})" stroke="#52606d" stroke-width="2">"##, 1.0 / PARTS));
        for layer in layers {
            for (fill, path) in layer.faces {
                canvas.put(&format!(r#"<path fill="{fill}" d="{path}"/>"#));
            }
            for (path, width) in [(layer.lines, 11), (layer.dots, 24)] {
                if !path.is_empty() {
                    canvas.put(&format!(r#"<path stroke="{}" stroke-width="{width}" d="{path}"/>"#, ink::ORANGE));
                }
            }
        }
        canvas.put("</g>");
    }
}

/// A face on the paper.
struct Seen {
    face: Triangle,
    corners: [[i64; 2]; 3],
    depth: i64,
    light: f64,
    layer: usize,
}

impl Seen {
    /// Whether the two have more than a side in common on the paper: no side of either has the other beyond it.
    fn overlaps(&self, other: &Self) -> bool {
        let is_parted_by_a_side = |one: &Self, other: &Self| {
            (0..3).any(|k| {
                let ([ax, ay], [bx, by]) = (one.corners[k], one.corners[(k + 1) % 3]);
                // Upside down on the paper, so that counter-clockwise is negative.
                other.corners.iter().all(|&[x, y]| (bx - ax) * (y - ay) - (by - ay) * (x - ax) >= 0)
            })
        };
        !is_parted_by_a_side(self, other) && !is_parted_by_a_side(other, self)
    }
}

/// What belongs to several faces is painted with the last of them.
fn raise<K: Ord>(layers: &mut BTreeMap<K, usize>, key: K, layer: usize) {
    let last = layers.entry(key).or_insert(layer);
    *last = layer.max(*last);
}

/// What is painted together: paths, those of faces by their fill.
#[derive(Default)]
struct Layer {
    faces: BTreeMap<String, String>,
    lines: String,
    dots: String,
}

/// A colour in light and shade.
fn shade(color: [f64; 3], light: f64) -> String {
    // In few steps, so that many faces have one fill.
    let bright = 0.6 + 0.4 * (12.0 * light).round() / 12.0;
    let [red, green, blue] = color.map(|part| (part * bright).round() as u8);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

fn pair([x, y]: [i64; 2]) -> String {
    if y < 0 { format!("{x}{y}") } else { format!("{x} {y}") }
}

fn way(from: [i64; 2], to: [i64; 2]) -> String {
    pair([to[0] - from[0], to[1] - from[1]])
}
