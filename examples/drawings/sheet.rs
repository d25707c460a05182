//! A flat mesh on a canvas.

use vvmesh::glam::DVec3;
use vvmesh::query::{self, measure};
use vvmesh::scratch::Scratch;
use vvmesh::{Edge, Mesh, Triangle, VertexId, shapes};

use super::canvas::{Canvas, Point, ink};

/// Pixels for one edge of the grid, and around the mesh.
const SCALE: f64 = 56.0;
const MARGIN: f64 = 24.0;

/// Room for the text below.
const LEAST_WIDTH: f64 = 220.0;

/// A grid of equilateral triangles.
pub(crate) fn grid(columns: usize, rows: usize) -> Mesh {
    let mut mesh = shapes::grid(columns, rows);
    for position in mesh.positions_mut() {
        *position = DVec3::new(position.x - position.y / 2.0, position.y * 0.75_f64.sqrt(), 0.0);
    }
    mesh
}

/// The hexagon of equilateral triangles with this many rings around its middle, which is returned too.
pub(crate) fn hexagon(rings: usize) -> (Mesh, VertexId) {
    let grid = grid(2 * rings, 2 * rings);
    let middle = VertexId::new(grid.vertex_count() / 2);
    let disk = query::r_disk(grid.rotation(), [middle], rings, &mut Scratch::new());
    let mut kept = disk.into_vertices();
    kept.sort();
    let place = |v: VertexId| kept.binary_search(&v).ok().map(|k| k as u32);
    let triangles: Vec<[u32; 3]> = grid
        .triangles()
        .filter_map(|triangle| {
            let [a, b, c] = triangle.corners().map(place);
            Some([a?, b?, c?])
        })
        .collect();
    let positions = kept.iter().map(|&v| grid.position(v)).collect();
    let mesh = Mesh::from_triangles(positions, &triangles).expect("a disk of a grid is a mesh");
    let middle = place(middle).expect("the middle is in its disk");
    (mesh, VertexId::new(middle as usize))
}

/// Draws the parts of one mesh.
pub(crate) struct Sheet<'a> {
    mesh: &'a Mesh,
    pub(crate) canvas: Canvas,
    /// The corner of the mesh, and where it stands on the canvas.
    corner: DVec3,
    left: f64,
    height: f64,
    middle: f64,
}

impl<'a> Sheet<'a> {
    /// The mesh in faint lines, with room for a line of text below.
    pub(crate) fn new(mesh: &'a Mesh) -> Self {
        let bounds = measure::bounds(mesh).expect("the mesh has vertices");
        let size = (bounds.max - bounds.min) * SCALE;
        let width = (size.x + 2.0 * MARGIN).max(LEAST_WIDTH);
        let height = size.y + MARGIN;
        let canvas = Canvas::new(width, height + MARGIN + 22.0);
        let left = (width - size.x) / 2.0;
        let mut sheet = Self { mesh, canvas, corner: bounds.min, left, height, middle: width / 2.0 };
        sheet.fill(mesh.triangles(), ink::PAPER);
        sheet
    }

    pub(crate) fn at(&self, v: VertexId) -> Point {
        let from_corner = (self.mesh.position(v) - self.corner) * SCALE;
        [self.left + from_corner.x, self.height - from_corner.y]
    }

    /// The middle of some vertices.
    pub(crate) fn between(&self, vertices: &[VertexId]) -> Point {
        let points = vertices.iter().map(|&v| self.at(v));
        let [x, y] = points.fold([0.0, 0.0], |[x, y], p| [x + p[0], y + p[1]]);
        [x / vertices.len() as f64, y / vertices.len() as f64]
    }

    pub(crate) fn fill(&mut self, triangles: impl IntoIterator<Item = Triangle>, fill: &str) {
        for triangle in triangles {
            let corners = triangle.corners().map(|v| self.at(v));
            self.canvas.polygon(&corners, fill, ink::LINE, 1.0);
        }
    }

    pub(crate) fn edges(&mut self, edges: impl IntoIterator<Item = Edge>, ink: &str) {
        for edge in edges {
            let ends = edge.ends().map(|v| self.at(v));
            self.canvas.line(ends, ink, 3.0);
        }
    }

    pub(crate) fn dots(&mut self, vertices: impl IntoIterator<Item = VertexId>, fill: &str) {
        for v in vertices {
            let at = self.at(v);
            self.canvas.dot(at, 4.5, fill, ink::DARK);
        }
    }

    /// A vertex as a circle with a text in it.
    pub(crate) fn label(&mut self, v: VertexId, text: &str, fill: &str) {
        let [x, y] = self.at(v);
        self.canvas.dot([x, y], 10.0, fill, ink::DARK);
        self.canvas.text([x, y + 4.5], text, ink::DARK);
    }

    /// A line of text below the mesh.
    pub(crate) fn caption(&mut self, text: &str) {
        self.canvas.text([self.middle, self.height + 34.0], text, ink::DARK);
    }

    pub(crate) fn finish(self) -> String {
        self.canvas.finish()
    }
}
