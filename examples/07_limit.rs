//! 7. Where subdivision ends: the limit of a vertex, and any point of the Loop surface with its derivatives.

use std::error::Error;
use std::io::{self, Write};

use vvmesh::limit::{Limit, LimitSurface, LoopLimit};
use vvmesh::scheme::LoopWeights;
use vvmesh::{VertexId, shapes};

/// Walks over one triangle of an icosahedron, from a corner of valence 5 to the middle of the opposite edge.
pub fn run(out: &mut dyn Write) -> Result<(), Box<dyn Error>> {
    let mesh = shapes::icosahedron();
    let v = VertexId::new(0);
    let limit = LoopLimit::default().position(&mesh, v);
    writeln!(out, "{v} is {:.6} from the centre, its limit {:.6}", mesh.position(v).length(), limit.length())?;

    let surface = LimitSurface::new(&mesh, LoopWeights::Loop);
    let triangle = mesh.triangles().next().ok_or("an icosahedron has triangles")?;
    let patch = surface.patch(triangle).ok_or("the triangle is one of the mesh")?;
    writeln!(out, "{triangle}, from its first corner:\nt      distance  area stretch")?;
    for step in 0..=4 {
        let t = f64::from(step) / 4.0;
        // Barycentric coordinates belong to the corners in order.
        let point = patch.evaluate(1.0 - t, 0.5 * t);
        // At the corner the derivatives vanish, and tangents stand in their place.
        let stretch = match (point.first, point.second) {
            (Some([du, dv]), Some(_)) => format!("{:.6}", du.cross(dv).length()),
            _ => "-".to_owned(),
        };
        writeln!(out, "{t:.2}   {:.6}  {stretch}", point.position.length())?;
    }
    Ok(())
}

fn main() -> Result<(), Box<dyn Error>> {
    run(&mut io::stdout())
}
