//! `vv select`: what an expression picks.

use std::fmt::Write;

use serde::Serialize;
use vvmesh::query::r_disk;
use vvmesh::scratch::Scratch;
use vvmesh::select::{Elements, Selection};
use vvmesh::{Edge, Mesh, Triangle, VertexId};

use crate::Outcome;
use crate::args::SelectArguments;
use crate::console::{Failure, note, print, print_json, refuse};
use crate::input::Input;
use crate::table::count;
use crate::{fields, input, sharp};

/// `selected` and `region` are |S| and |E^r(S)| in vertices, as in the report of `vv subdivide`.
#[derive(Serialize)]
struct Selected<'a> {
    expression: &'a str,
    kind: Kind,
    rings: usize,
    vertices: usize,
    selected: usize,
    region: usize,
    selected_vertices: Vec<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    selected_edges: Option<Vec<[usize; 2]>>,
    /// The numbers that they have in the file.
    #[serde(skip_serializing_if = "Option::is_none")]
    selected_faces: Option<Vec<usize>>,
    region_vertices: Vec<usize>,
}

/// What an expression picks.
#[derive(Serialize, Clone, Copy)]
#[serde(rename_all = "lowercase")]
enum Kind {
    Vertices,
    Edges,
    Faces,
}

pub(crate) fn run(arguments: &SelectArguments) -> Result<Outcome, Failure> {
    if arguments.tags.creases.is_some() {
        return refuse("--creases has no meaning here: nothing is refined; leave it out");
    }
    let (expression, _) = input::parse_expression("--select", &arguments.select, arguments.view.camera)?;
    let with_tags = arguments.tags.of_mesh.is_some();
    let Input { mut mesh, face_numbers, said, tags } = input::read_mesh(&arguments.mesh, with_tags)?;
    sharp::tag(&mut mesh, &arguments.mesh, tags.as_ref(), &arguments.tags)?;
    let expression = expression.with_faces_numbered_by(face_numbers.clone());
    let expression = fields::of_file("--select", expression, said.as_ref().map(|(_, said)| said))?;
    let mut scratch = Scratch::new();
    let selection = input::evaluate("--select", &expression, &mesh, &mut scratch)?;
    if selection.is_empty() {
        note(format_args!("--select '{}' picks nothing", arguments.select));
    }
    let seeds = selection.vertices().iter().copied();
    let region: Selection =
        r_disk(mesh.rotation(), seeds, arguments.rings, &mut scratch).into_vertices().into_iter().collect();

    let indices = |vertices: &[VertexId]| vertices.iter().map(|v| v.index()).collect();
    let (kind, selected_edges, selected_faces) = match selection.elements() {
        Elements::Vertices(_) => (Kind::Vertices, None, None),
        Elements::Edges(edges) => (Kind::Edges, Some(edges.iter().map(ends).collect()), None),
        Elements::Faces(faces) => (Kind::Faces, None, Some(numbers(faces, &face_numbers))),
    };
    let selected = Selected {
        expression: &arguments.select,
        kind,
        rings: arguments.rings,
        vertices: mesh.vertex_count(),
        selected: selection.vertices().len(),
        region: region.len(),
        selected_vertices: indices(selection.vertices()),
        selected_edges,
        selected_faces,
        region_vertices: indices(region.vertices()),
    };
    if arguments.json {
        print_json(&selected)?
    } else {
        print(&text(&selected, &mesh))?
    }
    Ok(Outcome::Done)
}

fn ends(edge: &Edge) -> [usize; 2] {
    edge.ends().map(VertexId::index)
}

/// The places of faces in the file, ascending.
fn numbers(faces: &[Triangle], order: &[Triangle]) -> Vec<usize> {
    (0..order.len()).filter(|&k| faces.binary_search(&order[k]).is_ok()).collect()
}

/// A comment, and what was picked in a form that expressions read: vertices as `vertices:@FILE` has them, faces as
/// `faces:@FILE`, and edges by their ends. With rings it is the vertices within them.
fn text(selected: &Selected<'_>, mesh: &Mesh) -> String {
    let Selected { kind, rings, region, selected_vertices, selected_edges, selected_faces, .. } = selected;
    let (picked, of) = match kind {
        Kind::Vertices => (selected_vertices.len(), count(mesh.vertex_count(), "vertex", "vertices")),
        Kind::Edges => (selected_edges.iter().flatten().count(), count(mesh.edge_count(), "edge", "edges")),
        Kind::Faces => (selected_faces.iter().flatten().count(), count(mesh.face_count(), "face", "faces")),
    };
    let expanded = match (rings, kind) {
        (0, _) => String::new(),
        (_, Kind::Vertices) => format!(", {region} within {}", count(*rings, "ring", "rings")),
        (_, Kind::Edges | Kind::Faces) => {
            format!(", {} within {}", count(*region, "vertex", "vertices"), count(*rings, "ring", "rings"))
        }
    };
    // What the user typed may run over several lines, a comment may not.
    let expression = selected.expression.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut text = format!("# {expression}: {picked} of {of}{expanded}\n");
    let lines: Vec<String> = match (rings, selected_edges, selected_faces) {
        (0, Some(edges), _) => edges.iter().map(|[a, b]| format!("{a} {b}")).collect(),
        (0, _, Some(faces)) => faces.iter().map(usize::to_string).collect(),
        _ => selected.region_vertices.iter().map(usize::to_string).collect(),
    };
    for line in lines {
        let _ = writeln!(text, "{line}");
    }
    text
}
