//! The words of the rotation system.

use std::f64::consts::TAU;

use vvmesh::scratch::Scratch;
use vvmesh::{DirectedEdge, VertexId, query};

use super::canvas::{Point, ink};
use super::sheet::{Sheet, grid, hexagon};

pub(crate) fn all() -> Vec<(&'static str, String)> {
    vec![
        ("ring", ring()),
        ("splice", splice()),
        ("valence", valence()),
        ("disk", disk()),
        ("star", star()),
        ("directed-edge", directed_edge()),
        ("boundary", boundary()),
    ]
}

fn ring() -> String {
    let (mesh, v) = hexagon(1);
    let mut sheet = Sheet::new(&mesh);
    let center = sheet.at(v);
    let neighbors = mesh.ring(v).neighbors();
    let start = angle(center, sheet.at(neighbors[0]));
    sheet.canvas.turn(center, 28.0, [start, start + TAU * 0.86], ink::BLUE);
    sheet.label(v, "v", ink::PALE_BLUE);
    for (slot, &w) in neighbors.iter().enumerate() {
        sheet.label(w, &slot.to_string(), ink::WHITE);
    }
    sheet.caption("ring of v: slots 0 to 5");
    sheet.finish()
}

fn splice() -> String {
    let (mesh, v) = hexagon(1);
    let ring = mesh.ring(v);
    let a = ring.neighbors()[4];
    let (next, prev) = (ring.next(a).expect("the ring is closed"), ring.prev(a).expect("the ring is closed"));
    let mut sheet = Sheet::new(&mesh);
    let [ends, x] = [sheet.between(&[a, next]), sheet.at(v)];
    let new = [x[0] + (ends[0] - x[0]) * 0.9, x[1] + (ends[1] - x[1]) * 0.9];
    sheet.canvas.dashes([sheet.at(v), new], ink::ORANGE, 2.0);
    sheet.canvas.dot(new, 10.0, ink::PALE_ORANGE, ink::ORANGE);
    sheet.canvas.text([new[0], new[1] + 4.5], "x", ink::DARK);
    for (w, name, fill) in
        [(v, "v", ink::PALE_BLUE), (a, "a", ink::WHITE), (next, "n", ink::WHITE), (prev, "p", ink::WHITE)]
    {
        sheet.label(w, name, fill);
    }
    sheet.caption("n next, p prev; x after a");
    sheet.finish()
}

fn valence() -> String {
    let mesh = grid(3, 3);
    let mut sheet = Sheet::new(&mesh);
    for v in mesh.vertices() {
        let regular = mesh.ring(v).valence() == if mesh.is_boundary(v) { 4 } else { 6 };
        sheet.label(v, &mesh.ring(v).valence().to_string(), if regular { ink::WHITE } else { ink::PALE_ORANGE });
    }
    sheet.caption("valences; regular ones white");
    sheet.finish()
}

fn disk() -> String {
    let (mesh, v) = hexagon(2);
    let disk = query::r_disk(mesh.rotation(), [v], 2, &mut Scratch::new());
    let mut sheet = Sheet::new(&mesh);
    for (distance, layer) in disk.layers().enumerate() {
        for &w in layer {
            sheet.label(w, &distance.to_string(), [ink::PALE_ORANGE, ink::PALE_BLUE, ink::WHITE][distance]);
        }
    }
    sheet.caption("1-ring and 2-ring; all together: 2-disk");
    sheet.finish()
}

fn star() -> String {
    let (mesh, v) = hexagon(1);
    let star = query::star(mesh.rotation(), v);
    let mut sheet = Sheet::new(&mesh);
    sheet.fill(star.triangles(), ink::PALE_BLUE);
    sheet.edges(star.edges(), ink::BLUE);
    sheet.edges(star.link().map(DirectedEdge::edge), ink::ORANGE);
    sheet.dots(star.one_ring(), ink::WHITE);
    sheet.label(v, "v", ink::WHITE);
    sheet.caption("star blue, link orange");
    sheet.finish()
}

fn directed_edge() -> String {
    let mesh = grid(1, 1);
    let [a, b] = [VertexId::new(0), VertexId::new(3)];
    let left = mesh.rotation().left_of(a, b).expect("the edge has two triangles");
    let right = mesh.rotation().right_of(a, b).expect("the edge has two triangles");
    let mut sheet = Sheet::new(&mesh);
    sheet.fill(mesh.triangles().filter(|triangle| triangle.corners().contains(&left)), ink::PALE_BLUE);
    let (from, to) = (sheet.at(a), sheet.at(b));
    let short = |t: f64| [from[0] + (to[0] - from[0]) * t, from[1] + (to[1] - from[1]) * t];
    sheet.canvas.arrow([short(0.2), short(0.78)], ink::BLUE, 2.5);
    for (v, name) in [(a, "a"), (b, "b"), (left, "l"), (right, "r")] {
        sheet.label(v, name, ink::WHITE);
    }
    sheet.caption("a → b: l left, r right");
    sheet.finish()
}

fn boundary() -> String {
    let mesh = grid(2, 2);
    let v = VertexId::new(1);
    let mut sheet = Sheet::new(&mesh);
    sheet.edges(
        mesh.edges().filter(|edge| {
            let [a, b] = edge.ends();
            mesh.rotation().is_boundary_edge(a, b)
        }),
        ink::ORANGE,
    );
    let center = sheet.at(v);
    let neighbors = mesh.ring(v).neighbors();
    let [first, last] = [neighbors[0], neighbors[neighbors.len() - 1]].map(|w| angle(center, sheet.at(w)));
    sheet.canvas.turn(center, 26.0, [first, last.rem_euclid(TAU) - 0.1], ink::BLUE);
    sheet.label(v, "v", ink::PALE_BLUE);
    for (slot, &w) in neighbors.iter().enumerate() {
        sheet.label(w, &slot.to_string(), ink::WHITE);
    }
    sheet.caption("boundary; the ring of v is open");
    sheet.finish()
}

/// The angle of a direction from the x axis, counter-clockwise as seen.
fn angle(from: Point, to: Point) -> f64 {
    (from[1] - to[1]).atan2(to[0] - from[0])
}
