//! Simple triangulation without edges whose middle would hardly move.

use glam::DVec3;

use super::AdaptiveMethod;
use crate::error::ConfigError;
use crate::id::{Edge, VertexId};
use crate::mesh::Mesh;
use crate::parallel;
use crate::scheme::{Butterfly, Scheme, WeightedSum};
use crate::scratch::Scratch;
use crate::select::{Elements, Selection};
use crate::step::{Parent, Region};

/// Splits of the edges that [`Simple`](super::Simple) would split those whose new vertex the [`Butterfly`] scheme puts at least
/// so far from their middle.
///
/// The test looks at an edge and not at a face, so both sides agree and no crack opens; faces with one and two split edges
/// arise. It is meant for steps of that scheme, under which no other vertex moves. Source: `[iterative]`.
///
/// ```
/// use vvmesh::adaptive::SimpleMoving;
/// use vvmesh::scheme::Butterfly;
/// use vvmesh::scratch::Scratch;
/// use vvmesh::select::Selection;
/// use vvmesh::step::{History, Keep};
/// use vvmesh::subdivide::{Control, Subdivider};
/// use vvmesh::shapes;
///
/// // Where a grid is flat nothing moves.
/// let mut mesh = shapes::grid(4, 4);
/// let (mut history, all) = (History::new(&mesh, Keep::default()), Selection::all(mesh.vertex_count()));
/// let subdivider = Subdivider::new(Butterfly, SimpleMoving::new(1e-6)?);
/// let step = subdivider.step(&mut mesh, &mut history, &all, &mut Scratch::new(), &mut Control::default())?;
/// assert_eq!(step.split_edges, 0);
/// # Ok::<(), vvmesh::error::Error>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct SimpleMoving {
    least: f64,
}

impl SimpleMoving {
    /// Edges whose new vertex is this far from their middle, or farther.
    ///
    /// # Errors
    /// If the distance is not a finite number, 0 or more.
    pub fn new(least: f64) -> Result<Self, ConfigError> {
        if least.is_finite() && least >= 0.0 {
            return Ok(Self { least });
        }
        let expected = "expected a finite distance, 0 or more".to_owned();
        Err(ConfigError { name: "min-move", value: least.to_string(), expected })
    }
}

impl AdaptiveMethod for SimpleMoving {
    fn region(&self, mesh: &Mesh, selection: &Selection, scratch: &mut Scratch) -> Region {
        let edges = edges_of(mesh, selection, scratch);
        let moving = |k: usize| Some(edges[k]).filter(|&edge| movement(mesh, edge) >= self.least);
        Region::edges(parallel::gather(0..edges.len(), moving))
    }

    fn promises_exactness(&self) -> bool {
        false
    }
}

/// The edges that [`Simple`](super::Simple) splits; those between two selected faces come twice.
fn edges_of(mesh: &Mesh, selection: &Selection, scratch: &mut Scratch) -> Vec<Edge> {
    match selection.elements() {
        Elements::Vertices(vertices) => {
            let marks = scratch.marked(mesh.vertex_count(), vertices);
            let between = |&v: &VertexId| mesh.ring(v).iter().filter(move |&w| v < w).map(move |w| [v, w]);
            let inside = vertices.iter().flat_map(between).filter(|&[_, w]| marks.is_set(w));
            inside.map(|[v, w]| Edge::new(v, w)).collect()
        }
        Elements::Edges(edges) => edges.to_vec(),
        Elements::Faces(faces) => faces.iter().flat_map(|face| face.edges()).collect(),
    }
}

/// How far the new vertex on an edge is from its middle.
fn movement(mesh: &Mesh, edge: Edge) -> f64 {
    let [p, q] = edge.ends();
    let ring = mesh.ring(p);
    let parent = Parent { p, q, left: ring.next(q), right: ring.prev(q) };
    let middle = mesh.position(p).midpoint(mesh.position(q));
    // Relative to the middle, so that what is far from the origin is not rounded more.
    let mut sum = WeightedSum::new(|v: VertexId| mesh.position(v) - middle);
    Butterfly.odd(mesh.neighborhood(), &parent, &mut sum);
    sum.total().map_or(0.0, DVec3::length)
}
