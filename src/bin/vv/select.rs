//! `vv select`: what an expression picks.

use std::fmt::Write;

use serde::Serialize;
use vvmesh::VertexId;
use vvmesh::query::r_disk;
use vvmesh::scratch::Scratch;
use vvmesh::select::Selection;

use crate::Outcome;
use crate::args::SelectArguments;
use crate::console::{Failure, note, print, print_json};
use crate::input;
use crate::table::count;

/// The words are those of the report of `vv subdivide`: `selected` is |S| and `region` |E^r(S)|.
#[derive(Serialize)]
struct Selected<'a> {
    expression: &'a str,
    rings: usize,
    vertices: usize,
    selected: usize,
    region: usize,
    selected_vertices: Vec<usize>,
    region_vertices: Vec<usize>,
}

pub(crate) fn run(arguments: &SelectArguments) -> Result<Outcome, Failure> {
    let (expression, _) = input::parse_expression("--select", &arguments.select)?;
    let mesh = input::read_mesh(&arguments.mesh)?;
    let mut scratch = Scratch::new();
    let selection = input::evaluate("--select", &expression, &mesh, &mut scratch)?;
    if selection.is_empty() {
        note(format_args!("--select '{}' picks no vertex", arguments.select));
    }
    let seeds = selection.vertices().iter().copied();
    let region: Selection =
        r_disk(mesh.rotation(), seeds, arguments.rings, &mut scratch).into_vertices().into_iter().collect();

    let indices = |vertices: &[VertexId]| vertices.iter().map(|v| v.index()).collect();
    let selected = Selected {
        expression: &arguments.select,
        rings: arguments.rings,
        vertices: mesh.vertex_count(),
        selected: selection.len(),
        region: region.len(),
        selected_vertices: indices(selection.vertices()),
        region_vertices: indices(region.vertices()),
    };
    if arguments.json {
        print_json(&selected)?
    } else {
        print(&text(&selected))?
    }
    Ok(Outcome::Done)
}

/// A comment and the ids of the region, in the form that `vertices:@FILE` reads.
fn text(selected: &Selected<'_>) -> String {
    let expanded = match selected.rings {
        0 => String::new(),
        rings => format!(", {} within {}", selected.region, count(rings, "ring", "rings")),
    };
    // What the user typed may run over several lines, a comment may not.
    let expression = selected.expression.split_whitespace().collect::<Vec<_>>().join(" ");
    let mut text = format!("# {expression}: {} of {} vertices{expanded}\n", selected.selected, selected.vertices);
    for v in &selected.region_vertices {
        let _ = writeln!(text, "{v}");
    }
    text
}
