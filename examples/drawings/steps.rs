//! The words of refinement.

use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::error::Error;
use vvmesh::mesh::VertexClass;
use vvmesh::scheme::{FourEight, Loop, Mask, Midpoint, Scheme, Sqrt3};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Disk, Selection};
use vvmesh::step::{History, Keep, Parent};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Edge, Triangle, VertexId};

use super::canvas::{Canvas, ink};
use super::sheet::{Sheet, grid, hexagon};

pub(crate) fn all() -> Result<Vec<(&'static str, String)>, Error> {
    Ok(vec![
        ("features", features()),
        ("even-odd", even_odd()?),
        ("mask", mask()),
        ("region", region()?),
        ("closing", closing()?),
        ("half-steps", half_steps()?),
        ("blocks", blocks()?),
        ("levels", levels()?),
        ("conforming", conforming()),
    ])
}

fn features() -> String {
    let mut mesh = grid(6, 3);
    // A chain along the second row, and at its fourth vertex a branch upwards.
    let id = VertexId::new;
    for (a, b) in [(8, 9), (9, 10), (10, 11), (11, 12), (11, 18), (18, 25)] {
        assert!(mesh.set_sharp(Edge::new(id(a), id(b)), true), "the chain runs along edges");
    }
    let inside: Vec<VertexId> = mesh.vertices().filter(|&v| !mesh.is_boundary(v)).collect();
    let mut sheet = Sheet::new(&mesh);
    sheet.edges(mesh.tags().sharp_edges(), ink::BLUE);
    for v in inside {
        let (name, fill) = match mesh.neighborhood().class(v) {
            VertexClass::Smooth => continue,
            VertexClass::Crease => ("", ink::PALE_BLUE),
            VertexClass::Dart => ("d", ink::WHITE),
            VertexClass::Corner => ("c", ink::PALE_ORANGE),
        };
        sheet.label(v, name, fill);
    }
    sheet.caption("creases blue, their ends darts (d), a corner (c)");
    sheet.finish()
}

fn even_odd() -> Result<String, Error> {
    let (mut mesh, _) = hexagon(1);
    let mut history = History::new(&mesh, Keep::default());
    Subdivider::new(Midpoint, Uniform).step(
        &mut mesh,
        &mut history,
        &Selection::empty(),
        &mut Scratch::new(),
        &mut Control::default(),
    )?;
    let mut sheet = Sheet::new(&mesh);
    let (even, odd): (Vec<_>, Vec<_>) = mesh.vertices().partition(|v| v.index() < history.input_count());
    sheet.dots(even, ink::BLUE);
    sheet.dots(odd, ink::WHITE);
    sheet.caption("even vertices blue, odd white");
    Ok(sheet.finish())
}

fn mask() -> String {
    let mesh = grid(1, 1);
    let [p, q] = [VertexId::new(0), VertexId::new(3)];
    let parent = Parent { p, q, left: mesh.rotation().left_of(p, q), right: mesh.rotation().right_of(p, q) };
    let mut mask = Mask::default();
    Loop::default().odd(mesh.neighborhood(), &parent, &mut mask);
    let mut sheet = Sheet::new(&mesh);
    let new = sheet.between(&[p, q]);
    sheet.canvas.dot(new, 4.5, ink::WHITE, ink::DARK);
    for v in mesh.vertices() {
        sheet.label(v, &(8.0 * mask.weight_of(v)).to_string(), ink::PALE_BLUE);
    }
    sheet.caption("Loop's odd mask, in eighths");
    sheet.finish()
}

fn region() -> Result<String, Error> {
    let (mesh, middle) = hexagon(3);
    let region = Disk::new(middle, 1).select(&mesh, &mut Scratch::new())?;
    let mut sheet = Sheet::new(&mesh);
    sheet.fill(
        mesh.triangles().filter(|triangle| triangle.corners().iter().all(|&v| region.contains(v))),
        ink::PALE_BLUE,
    );
    let is_frontier = |edge: &Edge| {
        let [a, b] = edge.ends();
        region.contains(a) != region.contains(b)
    };
    sheet.edges(mesh.edges().filter(is_frontier), ink::ORANGE);
    sheet.dots(region.vertices().iter().copied(), ink::BLUE);
    sheet.caption("region blue, frontier orange");
    Ok(sheet.finish())
}

/// One step of [`Simple`] with midpoints, which leaves every vertex where it was.
fn closing() -> Result<String, Error> {
    let (mut mesh, middle) = hexagon(2);
    let mut scratch = Scratch::new();
    let mut history = History::new(&mesh, Keep { names: true, ..Keep::default() });
    let selection = Disk::new(middle, 1).select(&mesh, &mut scratch)?;
    let subdivider = Subdivider::new(Midpoint, Simple);
    let step = subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default())?;
    let mut sheet = Sheet::new(&mesh);
    sheet.edges(history.closing_edges(&mesh).unwrap_or_default(), ink::ORANGE);
    for &v in &step.t_vertices {
        sheet.label(v, "T", ink::PALE_ORANGE);
    }
    for &v in &step.o_vertices {
        sheet.label(v, "O", ink::PALE_BLUE);
    }
    sheet.caption("edges that close the cracks orange");
    Ok(sheet.finish())
}

/// One step of √3 around a vertex.
fn half_steps() -> Result<String, Error> {
    let (mut mesh, middle) = hexagon(2);
    let mut scratch = Scratch::new();
    let mut history = History::new(&mesh, Keep::default());
    let selection = Disk::new(middle, 1).select(&mesh, &mut scratch)?;
    let before = mesh.clone();
    let subdivider = Subdivider::new(Sqrt3::default(), Simple);
    subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default())?;
    let is_odd = |triangle: &Triangle| history.generation(*triangle).is_some_and(|made| made % 2 == 1);
    let mut sheet = Sheet::new(&mesh);
    sheet.fill(mesh.triangles().filter(is_odd), ink::PALE_BLUE);
    // Of an odd triangle one edge alone is old.
    let is_mate = |edge: &Edge| {
        let [a, b] = edge.ends();
        let beside = [mesh.rotation().left_of(a, b), mesh.rotation().right_of(a, b)];
        before.rotation().has_edge(a, b) && beside.iter().flatten().any(|&c| is_odd(&Triangle::new(a, b, c)))
    };
    sheet.edges(mesh.edges().filter(is_mate), ink::ORANGE);
    sheet.dots(mesh.vertices().skip(before.vertex_count()), ink::BLUE);
    sheet.caption("odd triangles blue, their mates orange");
    Ok(sheet.finish())
}

/// One step of 4-8.
fn blocks() -> Result<String, Error> {
    let (mut mesh, _) = hexagon(2);
    let mut history = History::new(&mesh, Keep::default());
    let before = mesh.vertex_count();
    let (subdivider, control) = (Subdivider::new(FourEight::default(), Uniform), &mut Control::default());
    subdivider.step(&mut mesh, &mut history, &Selection::empty(), &mut Scratch::new(), control)?;
    let mut sheet = Sheet::new(&mesh);
    // Each triangle has one new corner, and opposite to it an edge between old ones.
    let is_refinement_edge = |edge: &Edge| edge.ends().iter().all(|v| v.index() < before);
    sheet.edges(mesh.edges().filter(is_refinement_edge), ink::ORANGE);
    sheet.dots(mesh.vertices().skip(before), ink::BLUE);
    sheet.caption("apexes blue, refinement edges orange");
    Ok(sheet.finish())
}

fn levels() -> Result<String, Error> {
    let (mut mesh, middle) = hexagon(3);
    let mut scratch = Scratch::new();
    let mut history = History::new(&mesh, Keep { names: true, ..Keep::default() });
    let mut selection: Selection = [middle].into_iter().collect();
    let subdivider = Subdivider::new(Midpoint, Incremental::new(1)?);
    for _ in 0..2 {
        selection =
            subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default())?.selection;
    }
    let closing = history.closing_edges(&mesh).unwrap_or_default();
    let mut sheet = Sheet::new(&mesh);
    for triangle in mesh.triangles() {
        let (level, closes) = history.face_level(triangle, &closing).unwrap_or_default();
        let fill = match (closes, level) {
            (true, _) => ink::PALE_ORANGE,
            (false, 0) => ink::PAPER,
            (false, 1) => ink::FAINT_BLUE,
            (false, _) => ink::PALE_BLUE,
        };
        sheet.fill([triangle], fill);
    }
    sheet.caption("the darker the higher the level; orange closes cracks");
    Ok(sheet.finish())
}

/// Two halves below, with their common vertex off the edge above: a crack, and how it is closed.
fn conforming() -> String {
    let mut canvas = Canvas::new(340.0, 190.0);
    for (x, closed) in [(35.0, false), (195.0, true)] {
        let [a, b, top, bottom] = [[x, 80.0], [x + 110.0, 80.0], [x + 55.0, 20.0], [x + 55.0, 150.0]];
        let odd = [x + 55.0, 96.0];
        let above: &[[_; 3]] = if closed { &[[a, odd, top], [odd, b, top]] } else { &[[a, b, top]] };
        for triangle in above {
            canvas.polygon(triangle, if closed { ink::PALE_ORANGE } else { ink::PAPER }, ink::LINE, 1.0);
        }
        for triangle in [[a, bottom, odd], [odd, bottom, b]] {
            canvas.polygon(&triangle, ink::PALE_BLUE, ink::LINE, 1.0);
        }
        canvas.dot(odd, 4.5, ink::WHITE, ink::DARK);
        canvas.text([x + 55.0, 176.0], if closed { "conforming" } else { "a T-vertex and a crack" }, ink::DARK);
    }
    canvas.finish()
}
