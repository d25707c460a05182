//! The picture of the README: one model, its head refined by each method.

use std::collections::BTreeMap;
use std::error::Error;

use vvmesh::adaptive::{AdaptiveMethod, Incremental, Simple, Uniform};
use vvmesh::glam::DVec3;
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Selection, Sphere};
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId};

use super::canvas::{Canvas, ink};
use super::solid::View;

/// Pixels for a unit of the model, for a panel, and for the lines of text below it.
const SCALE: f64 = 33.0;
const PANEL: [f64; 2] = [230.0, 290.0];
const TEXT: f64 = 42.0;
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

    let mut canvas = Canvas::new(4.0 * PANEL[0], PANEL[1] + TEXT);
    panel(&mut canvas, 0, &coarse, "coarse", "blue: what is selected");
    for (number, name, run) in
        [(1, "simple", run(&coarse, Simple)?), (2, "incremental", run(&coarse, Incremental::new(1)?)?)]
    {
        let off = deviation(&run, &uniform).ok_or("a selected vertex has no uniform twin")?;
        let told = if off == 0.0 { "0".into() } else { format!("{off:.3}") };
        panel(&mut canvas, number, &run, name, &format!("blue differs from uniform by {told}"));
    }
    panel(&mut canvas, 3, &uniform, "uniform", "everything is refined");
    Ok(canvas.finish())
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

fn panel(canvas: &mut Canvas, number: usize, run: &Run, name: &str, note: &str) {
    let middle = (number as f64 + 0.5) * PANEL[0];
    // A little from above and from the side.
    let mut view = View::from(DVec3::new(0.55, 0.35, 1.0), DVec3::Y);
    view.scale = SCALE;
    let [x, y] = view.at(DVec3::new(2.5, 3.75, 0.0));
    view.origin = [middle - x, PANEL[1] / 2.0 - y];
    view.paint(canvas, &run.mesh, &run.selection, false);
    canvas.text([middle, PANEL[1] + 12.0], &format!("{name}: {} faces", run.mesh.face_count()), ink::DARK);
    canvas.text([middle, PANEL[1] + 30.0], note, ink::DARK);
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
