//! 6. Texture coordinates with a seam, which refinement does not tear.

use std::error::Error;
use std::f64::consts::TAU;
use std::io::{self, Write};

use vvmesh::adaptive::Uniform;
use vvmesh::attributes::{Attributes, Blend, Channel, Seams};
use vvmesh::glam::DVec3;
use vvmesh::scheme::Loop;
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;
use vvmesh::step::{History, Keep};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId};

/// Vertices around the tube.
const AROUND: u32 = 6;

/// Refines a tube that a picture is wound around: where its ends meet, u is both 0 and 1.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let angle = |k: u32| TAU * f64::from(k) / f64::from(AROUND);
    let positions = (0..2 * AROUND).map(|k| DVec3::new(angle(k).cos(), angle(k).sin(), f64::from(k / AROUND)));
    let quads = (0..AROUND).map(|k| [k, (k + 1) % AROUND, (k + 1) % AROUND + AROUND, k + AROUND]);
    let triangles: Vec<[u32; 3]> = quads.flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    let mut mesh = Mesh::from_triangles(positions.collect(), &triangles)?;

    // The picture has a column of values more than the tube has vertices.
    let values =
        (0..2 * (AROUND + 1)).map(|k| [f64::from(k % (AROUND + 1)) / f64::from(AROUND), f64::from(k / (AROUND + 1))]);
    let texture = Channel::new("uv", Blend::Scheme, values.collect())?;
    let corners = mesh.triangles().map(|triangle| {
        let corners = triangle.corners().map(|v| v.index() as u32);
        // Beside the last column of vertices, the first is the end of the picture.
        let is_last = corners.iter().any(|v| v % AROUND == AROUND - 1);
        let column = |v: u32| if is_last && v % AROUND == 0 { AROUND } else { v % AROUND };
        Some(corners.map(|v| column(v) + v / AROUND * (AROUND + 1)))
    });
    let corners: Vec<_> = corners.collect();

    let mut history = History::new(&mesh, Keep::default());
    let mut attributes = Attributes::default();
    attributes.add_corner_channel(&mesh, &history, &texture, &corners, Seams::Linear)?;
    let subdivider = Subdivider::new(Loop::default(), Uniform);
    for _ in 0..2 {
        let (all, scratch) = (Selection::empty(), &mut Scratch::new());
        attributes.step(&subdivider, &mut mesh, &mut history, &all, scratch, &mut Control::default())?;
    }

    let texture = attributes.corner_channel("uv").ok_or("it was added")?;
    let values = texture.values();
    let over = |v: VertexId| (0..values.len()).filter(move |&k| texture.vertex_below(k) == v);
    let on_seam: Vec<VertexId> = mesh.vertices().filter(|&v| over(v).count() == 2).collect();
    let spans = |v: VertexId| [0.0, 1.0].iter().all(|u| over(v).any(|k| values.value(k)[0] == *u));
    writeln!(
        out,
        "{} values at {} vertices; {} of {} vertices on the seam have u = 0 on one side and u = 1 on the other",
        values.len(),
        mesh.vertex_count(),
        on_seam.iter().filter(|&&v| spans(v)).count(),
        on_seam.len()
    )?;
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
