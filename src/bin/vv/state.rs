//! A run that is left and gone on with: what `--state` reads and writes.
//!
//! A history follows from the mesh with which it began and from what was selected in each step, to the last bit. So these
//! are what the file holds, and the steps are made again when it is read: it is small, no state that steps could not have
//! made can be read from it, and it means the same whatever a history will look like inside. The steps of a run together
//! are not much more than the last of them.
//!
//! The file is JSON. Coordinates and sharpness are written as the bits of their numbers.

use std::collections::BTreeMap;
use std::fs;
use std::io::{self, Write};
use std::ops::Range;
use std::path::Path;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};
use vvmesh::glam::DVec3;
use vvmesh::io::write_atomically;
use vvmesh::mesh::{Sharpness, SharpnessRule};
use vvmesh::select::{Elements, Selection};
use vvmesh::subdivide::Control;
use vvmesh::{Edge, Mesh, Triangle, VertexId};

use crate::args::{BoundaryName, RefineArguments};
use crate::console::{Failure, json, refuse};
use crate::memory::FaceLimit;
use crate::refine;
use crate::run::Run;
use crate::table::count;

const FORMAT: &str = "vv state";
const VERSION: u32 = 2;

/// What every version says first.
#[derive(Deserialize)]
struct Header {
    format: String,
    version: u32,
}

/// How a run was begun, and what was selected in its steps.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct State {
    format: String,
    version: u32,
    /// Scheme and method with their options.
    how: String,
    /// The expression that was evaluated last, with its camera.
    select: String,
    boundary: String,
    mesh: SavedMesh,
    /// What was selected in each step.
    steps: Vec<Selected>,
}

#[derive(Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Selected {
    /// Runs of ids, each as its first and the one behind its last.
    Vertices(Vec<[u32; 2]>),
    Edges(Vec<[u32; 2]>),
    Faces(Vec<[u32; 3]>),
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedMesh {
    positions: Vec<[u64; 3]>,
    triangles: Vec<[u32; 3]>,
    chaikin: bool,
    /// In an order in which tagging leads to the same order at each vertex.
    sharp_edges: Vec<(u32, u32, u64)>,
    sharp_vertices: Vec<(u32, u64)>,
}

impl State {
    /// The state of a run that begins.
    pub(crate) fn new(mesh: &Mesh, arguments: &RefineArguments, boundary: BoundaryName) -> Self {
        Self {
            format: FORMAT.to_owned(),
            version: VERSION,
            how: how(arguments),
            select: String::new(),
            boundary: boundary.to_string(),
            mesh: SavedMesh::of(mesh),
            steps: Vec::new(),
        }
    }

    /// What a file says; `None` if there is no file.
    pub(crate) fn read(path: &Path, arguments: &RefineArguments) -> Result<Option<Self>, Failure> {
        let bytes = match fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return refused(path, error),
        };
        let header: Header = match serde_json::from_slice(&bytes) {
            Ok(header) => header,
            Err(error) => return refused(path, format_args!("this is no state of `vv`: {error}")),
        };
        if header.format != FORMAT {
            return refused(path, "this is no state of `vv`");
        }
        if header.version != VERSION {
            let found = header.version;
            return refused(path, format_args!("version {found} of the format is not read, only version {VERSION}"));
        }
        let state: Self = match serde_json::from_slice(&bytes) {
            Ok(state) => state,
            Err(error) => return refused(path, error),
        };
        let asked = how(arguments);
        if state.how != asked {
            return refused(path, format_args!("it was begun with {}, and cannot go on with {asked}", state.how));
        }
        if let Some(option) = arguments.tags.first_given() {
            return refused(path, format_args!("what is sharp comes with it; leave {option} out"));
        }
        Ok(Some(state))
    }

    /// The mesh with which the run began, and the boundary policy.
    pub(crate) fn begin(&self, path: &Path) -> Result<(Mesh, BoundaryName), Failure> {
        let boundary = BoundaryName::from_str(&self.boundary, false);
        match (self.mesh.restore(), boundary) {
            (Ok(mesh), Ok(boundary)) => Ok((mesh, boundary)),
            (Err(error), _) | (_, Err(error)) => refused(path, error),
        }
    }

    /// Makes the steps again.
    pub(crate) fn replay(&self, run: &mut Run, path: &Path, limit: FaceLimit) -> Result<(), Failure> {
        for (number, selected) in self.steps.iter().enumerate() {
            let step = number + 1;
            run.selection = match selected.restore(run.mesh.vertex_count()) {
                Some(selection) => selection,
                None => {
                    return refused(
                        path,
                        format_args!("step {step} selects vertices that do not exist, or not in order"),
                    );
                }
            };
            let mut control = Control { max_faces: Some(limit.faces), ..Control::default() };
            if let Err(error) = run.step(&mut control) {
                return refused(path, format_args!("step {step} cannot be made again: {error}"));
            }
        }
        Ok(())
    }

    /// Whether the last expression was this one, so that what it picked is followed.
    pub(crate) fn follows(&self, expression: &str) -> bool {
        !self.steps.is_empty() && self.select == expression
    }

    /// Writes how to go on after a run.
    pub(crate) fn write(mut self, path: &Path, run: &Run, expression: &str) -> Result<(), Failure> {
        self.steps = run.selections.iter().flatten().map(Selected::of).collect();
        expression.clone_into(&mut self.select);
        let text = json(&self)?;
        Ok(write_atomically(path, |out| out.write_all(text.as_bytes()))?)
    }
}

/// Refuses a mesh to which a state does not belong.
pub(crate) fn refuse_mesh(path: &Path, mesh: &Path, step_count: usize) -> Result<(), Failure> {
    refused(
        path,
        format_args!(
            "it does not belong to {}: that is neither the mesh with which the state began nor the one that its {} made",
            mesh.display(),
            count(step_count, "step", "steps")
        ),
    )
}

/// Whether two meshes have the same triangles, and the same positions to the last bit.
pub(crate) fn is_same(one: &Mesh, other: &Mesh) -> bool {
    let triangles = |mesh: &Mesh| {
        let mut triangles: Vec<_> = mesh.triangles().collect();
        triangles.sort_unstable();
        triangles
    };
    let bits = |mesh: &Mesh| mesh.positions().iter().map(|&p| p.to_array().map(f64::to_bits)).collect::<Vec<_>>();
    one.face_count() == other.face_count() && bits(one) == bits(other) && triangles(one) == triangles(other)
}

fn refused<T>(path: &Path, why: impl std::fmt::Display) -> Result<T, Failure> {
    refuse(format!("--state: {}: {why}", path.display()))
}

/// Scheme and method with all options that change positions.
fn how(arguments: &RefineArguments) -> String {
    let mut how = format!("--scheme {} --method {}", refine::scheme(arguments).name(), arguments.method);
    let mut add = |option: &str, value: Option<String>| {
        if let Some(value) = value {
            how.push_str(&format!(" {option} {value}"));
        }
    };
    add("--weights", arguments.weights.map(|weights| weights.to_string()));
    add("--blocks", arguments.blocks.map(|blocks| blocks.to_string()));
    add("--rings", arguments.rings.map(|rings| rings.to_string()));
    add("--diagonal", arguments.diagonal.map(|diagonal| diagonal.to_string()));
    add("--min-move", arguments.min_move.map(|distance| distance.to_string()));
    add("--accuracy", arguments.accuracy.map(|accuracy| accuracy.distance().to_string()));
    how
}

impl Selected {
    fn of(selection: &Selection) -> Self {
        let id = |v: VertexId| v.index() as u32;
        match selection.elements() {
            Elements::Vertices(vertices) => Self::Vertices(ranges(vertices)),
            Elements::Edges(edges) => Self::Edges(edges.iter().map(|edge| edge.ends().map(id)).collect()),
            Elements::Faces(faces) => Self::Faces(faces.iter().map(|face| face.corners().map(id)).collect()),
        }
    }

    /// The selection, if a mesh with so many vertices can have it.
    fn restore(&self, vertex_count: usize) -> Option<Selection> {
        let id = |v: u32| Some(v as usize).filter(|&v| v < vertex_count).map(VertexId::new);
        match self {
            Self::Vertices(ranges) => {
                let is_run = |&[start, end]: &[u32; 2]| start < end;
                let are_apart = ranges.iter().all(is_run) && ranges.is_sorted_by(|one, other| one[1] < other[0]);
                let ids = ranges.iter().flat_map(|&[start, end]| start..end);
                are_apart.then(|| ids.map(id).collect())?
            }
            Self::Edges(edges) => edges.iter().map(|&[a, b]| Some(Edge::new(id(a)?, id(b)?))).collect(),
            Self::Faces(faces) => faces.iter().map(|&[a, b, c]| Some(Triangle::new(id(a)?, id(b)?, id(c)?))).collect(),
        }
    }
}

fn ranges(vertices: &[VertexId]) -> Vec<[u32; 2]> {
    let mut ranges: Vec<Range<u32>> = Vec::new();
    for v in vertices.iter().map(|v| v.index() as u32) {
        match ranges.last_mut() {
            Some(last) if last.end == v => last.end += 1,
            _ => ranges.push(v..v + 1),
        }
    }
    ranges.into_iter().map(|range| [range.start, range.end]).collect()
}

impl SavedMesh {
    fn of(mesh: &Mesh) -> Self {
        let tags = mesh.tags();
        let id = |v: VertexId| v.index() as u32;
        let edge = |edge: Edge| {
            let [a, b] = edge.ends();
            (id(a), id(b), tags.sharpness(edge).value().to_bits())
        };
        Self {
            positions: mesh.positions().iter().map(|p| p.to_array().map(f64::to_bits)).collect(),
            triangles: mesh.triangles().map(|triangle| triangle.corners().map(id)).collect(),
            chaikin: tags.rule() == SharpnessRule::Chaikin,
            sharp_edges: in_order_of_tagging(mesh).into_iter().map(edge).collect(),
            sharp_vertices: tags
                .sharp_vertices()
                .into_iter()
                .map(|v| (id(v), tags.vertex_sharpness(v).value().to_bits()))
                .collect(),
        }
    }

    fn restore(&self) -> Result<Mesh, String> {
        let positions: Vec<DVec3> =
            self.positions.iter().map(|bits| DVec3::from_array(bits.map(f64::from_bits))).collect();
        if let Some(v) = positions.iter().position(|position| !position.is_finite()) {
            return Err(format!("the position of vertex {v} is not finite"));
        }
        let mut mesh = Mesh::from_triangles(positions, &self.triangles).map_err(|error| error.to_string())?;
        mesh.set_sharpness_rule(if self.chaikin { SharpnessRule::Chaikin } else { SharpnessRule::Uniform });
        let sharpness = |bits| Sharpness::new(f64::from_bits(bits)).map_err(|error| error.to_string());
        let id = |v: u32| VertexId::try_new(v as usize).ok_or("a sharp vertex does not exist");
        for &(a, b, bits) in &self.sharp_edges {
            if !mesh.set_sharpness(Edge::new(id(a)?, id(b)?), sharpness(bits)?) {
                return Err(format!("the sharp edge {a}-{b} does not exist"));
            }
        }
        for &(v, bits) in &self.sharp_vertices {
            if !mesh.set_vertex_sharpness(id(v)?, sharpness(bits)?) {
                return Err(format!("the sharp vertex {v} does not exist"));
            }
        }
        Ok(mesh)
    }
}

/// The sharp edges in an order in which those at each vertex come as they do there, which sums depend on: an edge may come
/// as soon as it is the next at both ends.
fn in_order_of_tagging(mesh: &Mesh) -> Vec<Edge> {
    let sharp = mesh.tags().sharp_edges();
    let mut next: BTreeMap<VertexId, usize> = BTreeMap::new();
    let mut ready: Vec<VertexId> = sharp.iter().flat_map(|edge| edge.ends()).collect();
    let mut ordered = Vec::with_capacity(sharp.len());
    let head = |next: &BTreeMap<VertexId, usize>, v: VertexId| {
        mesh.tags().sharp_neighbors(v).get(next.get(&v).copied().unwrap_or(0)).copied()
    };
    while let Some(v) = ready.pop() {
        let Some(w) = head(&next, v).filter(|&w| head(&next, w) == Some(v)) else { continue };
        ordered.push(Edge::new(v, w));
        for end in [v, w] {
            *next.entry(end).or_default() += 1;
            ready.push(end);
        }
    }
    ordered
}
