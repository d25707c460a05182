//! The picture of the README: one model, its head refined by each method.

use std::collections::BTreeMap;
use std::error::Error;
use std::fmt::Write;

use vvmesh::adaptive::{AdaptiveMethod, Incremental, Simple, Uniform};
use vvmesh::glam::DVec3;
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Selection, Sphere};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId};

use super::canvas::ink;

/// Tenths of a pixel for a unit of the model, for a panel, and for the lines of text below it.
const SCALE: f64 = 330.0;
const PANEL: [f64; 2] = [2300.0, 2900.0];
const TEXT: f64 = 420.0;
const STEPS: usize = 2;

/// A mesh with what is selected on it.
struct Run {
    mesh: Mesh,
    history: History,
    selection: Selection,
}

pub(crate) fn cover() -> Result<String, Box<dyn Error>> {
    let start = animal()?;
    let selection = Sphere::new(DVec3::new(4.5, 6.5, 0.0), 1.9)?.select(&start, &mut Scratch::new())?;
    let coarse = Run { history: History::new(&start, KEEP), mesh: start, selection };
    let uniform = run(&coarse, Uniform)?;

    let mut out = String::new();
    let size = [4.0 * PANEL[0], PANEL[1] + TEXT];
    write!(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{}\" height=\"{}\" viewBox=\"0 0 {} {}\" \
         font-family=\"sans-serif\" font-size=\"130\" text-anchor=\"middle\" stroke-linejoin=\"round\">\n\
         <rect width=\"{2}\" height=\"{3}\" fill=\"{}\"/>\n",
        size[0] / 10.0,
        size[1] / 10.0,
        size[0],
        size[1],
        ink::WHITE
    )?;
    panel(&mut out, 0, &coarse, "coarse", "blue: what is selected")?;
    for (number, name, run) in
        [(1, "simple", run(&coarse, Simple)?), (2, "incremental", run(&coarse, Incremental::new(1)?)?)]
    {
        let off = deviation(&run, &uniform).ok_or("a selected vertex has no uniform twin")?;
        let told = if off == 0.0 { "0".into() } else { format!("{off:.3}") };
        panel(&mut out, number, &run, name, &format!("blue differs from uniform by {told}"))?;
    }
    panel(&mut out, 3, &uniform, "uniform", "everything is refined")?;
    out.push_str("</svg>\n");
    Ok(out)
}

const KEEP: Keep = Keep { names: true, certificate: false };

fn run(coarse: &Run, method: impl AdaptiveMethod + 'static) -> Result<Run, Box<dyn Error>> {
    let Run { mut mesh, mut history, mut selection } =
        Run { mesh: coarse.mesh.clone(), history: coarse.history.clone(), selection: coarse.selection.clone() };
    let subdivider = Subdivider::new(Loop::default(), method);
    let mut scratch = Scratch::new();
    for _ in 0..STEPS {
        selection =
            subdivider.step(&mut mesh, &mut history, &selection, &mut scratch, &mut Control::default())?.selection;
    }
    Ok(Run { mesh, history, selection })
}

/// The greatest distance of a selected vertex from the one of the same name in the uniform mesh.
fn deviation(run: &Run, uniform: &Run) -> Option<f64> {
    let names = run.history.same_names(&uniform.history)?;
    let distance = |&v: &VertexId| Some(run.mesh.position(v).distance(uniform.mesh.position(names[v.index()]?)));
    run.selection.vertices().iter().map(distance).try_fold(0.0, |most: f64, distance| Some(most.max(distance?)))
}

fn panel(out: &mut String, number: usize, run: &Run, name: &str, note: &str) -> std::fmt::Result {
    let left = number as f64 * PANEL[0];
    // From far away, a little from above and from the side; x to the right, y up, z to the eye.
    let eye = DVec3::new(0.55, 0.35, 1.0).normalize();
    let right = DVec3::Y.cross(eye).normalize();
    let up = eye.cross(right);
    let at = |p: DVec3| {
        let p = p - DVec3::new(2.5, 3.75, 0.0);
        [left + PANEL[0] / 2.0 + SCALE * p.dot(right), PANEL[1] / 2.0 - SCALE * p.dot(up)].map(|x| x.round() as i64)
    };
    let mut seen: Vec<(f64, String)> = Vec::new();
    for triangle in run.mesh.triangles() {
        let corners = triangle.corners().map(|v| run.mesh.position(v));
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        if normal.dot(eye) <= 0.0 {
            continue;
        }
        let selected = triangle.corners().iter().all(|&v| run.selection.contains(v));
        let light = 0.62 + 0.38 * normal.dot(DVec3::new(-0.2, 0.8, 0.6).normalize()).max(0.0);
        let fill = if selected { [150.0, 200.0, 240.0] } else { [236.0, 232.0, 224.0] };
        let [red, green, blue] = fill.map(|part| ((part * light / 4.0_f64).round() * 4.0) as u8);
        let [[ax, ay], [bx, by], [cx, cy]] = corners.map(at);
        let path = format!("<path fill=\"#{red:02x}{green:02x}{blue:02x}\" d=\"M{ax} {ay}L{bx} {by}L{cx} {cy}z\"/>");
        seen.push(((a + b + c).dot(eye), path));
    }
    // Painted from the far side; depths are compared to a thousandth, ties by the order of the mesh.
    seen.sort_by_key(|(depth, _)| (depth * 1000.0).round() as i64);
    writeln!(out, "<g stroke=\"#52606d\" stroke-width=\"4\">")?;
    for (_, path) in seen {
        writeln!(out, "{path}")?;
    }
    writeln!(out, "</g>")?;
    let middle = left + PANEL[0] / 2.0;
    let line = format!("{name}: {} faces", run.mesh.face_count());
    writeln!(out, "<text x=\"{middle}\" y=\"{}\" fill=\"{}\">{line}</text>", PANEL[1] + 120.0, ink::DARK)?;
    writeln!(out, "<text x=\"{middle}\" y=\"{}\" fill=\"{}\">{note}</text>", PANEL[1] + 300.0, ink::DARK)
}

/// An animal of unit cubes: four legs, a body, a neck and a head. Every square between a cube and the air is cut in two.
fn animal() -> Result<Mesh, vvmesh::error::BuildError> {
    let mut cubes: Vec<[i32; 3]> = Vec::new();
    for (x, y, z) in [(0, 0, -1), (0, 0, 1), (4, 0, -1), (4, 0, 1)] {
        cubes.extend((0..2).map(|k| [x, y + k, z]));
    }
    cubes.extend((0..5).flat_map(|x| (-1..2).map(move |z| [x, 2, z])));
    cubes.extend([[4, 3, 0], [4, 4, 0], [4, 5, 0], [4, 6, 0], [5, 6, 0], [4, 7, 0]]);

    let mut ids: BTreeMap<[i32; 3], u32> = BTreeMap::new();
    let (mut positions, mut triangles) = (Vec::new(), Vec::new());
    for &cube in &cubes {
        for axis in 0..3 {
            for side in 0..2 {
                let mut beyond = cube;
                beyond[axis] += 2 * side - 1;
                if cubes.contains(&beyond) {
                    continue;
                }
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut square = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(du, dv)| {
                    let mut corner = cube;
                    corner[axis] += side;
                    corner[u] += du;
                    corner[v] += dv;
                    *ids.entry(corner).or_insert_with(|| {
                        positions.push(DVec3::from_array(corner.map(f64::from)) - DVec3::new(0.0, 0.0, 0.5));
                        positions.len() as u32 - 1
                    })
                });
                if side == 0 {
                    square.reverse();
                }
                let [a, b, c, d] = square;
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    Mesh::from_triangles(positions, &triangles)
}
