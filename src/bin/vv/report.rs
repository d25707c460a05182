//! The report of a refinement, one row a step.

use serde::Serialize;

use crate::table::{Table, seconds};

/// One step: `selected` and `region` in vertices before it, split edges, T- and O-vertices made by it, the rest after it.
/// Under √3 only boundary edges are split, and there are no T- and O-vertices.
#[derive(Serialize, Clone, Debug)]
pub(crate) struct Row {
    pub(crate) level: u8,
    pub(crate) selected: usize,
    pub(crate) region: usize,
    pub(crate) split_edges: usize,
    pub(crate) vertices: usize,
    pub(crate) edges: usize,
    pub(crate) faces: usize,
    pub(crate) t_vertices: usize,
    pub(crate) o_vertices: usize,
    pub(crate) max_valence: usize,
    /// `None` if no certificate was kept: in a written report, where triangles are not split in four.
    pub(crate) certified: Option<usize>,
    /// Only of static/mobile subdivision.
    #[serde(flatten)]
    pub(crate) mobile: Option<MobileRow>,
    /// Only with `--until`: the greatest distance left; infinite, which is `null` in JSON, where something is semi-sharp.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) error: Option<f64>,
    pub(crate) seconds: f64,
}

/// What a step of static/mobile subdivision tells beside: the vertices before it that stay, the faces before it by how many
/// corners move, and the faces after it without those that close cracks. The region are the vertices that move.
#[derive(Serialize, Clone, Debug)]
pub(crate) struct MobileRow {
    pub(crate) static_vertices: usize,
    pub(crate) faces_by_mobile_corners: [usize; 4],
    pub(crate) unclosed_faces: usize,
}

/// What was to be reached, and what is left: the greatest distance of the mesh that came in, and of that which goes out.
#[derive(Serialize, Clone, Copy, Debug)]
pub(crate) struct UntilReport {
    pub(crate) accuracy: f64,
    pub(crate) measure: &'static str,
    pub(crate) first_error: f64,
    pub(crate) error: f64,
    pub(crate) far_faces: usize,
    pub(crate) reached: bool,
}

/// Sizes of a mesh.
#[derive(Serialize, Clone, Copy, Debug)]
pub(crate) struct Sizes {
    pub(crate) vertices: usize,
    pub(crate) edges: usize,
    pub(crate) faces: usize,
    pub(crate) max_valence: usize,
}

/// What stands at the end of a run.
#[derive(Serialize, Clone, Copy, Debug)]
pub(crate) struct Totals {
    #[serde(flatten)]
    pub(crate) sizes: Sizes,
    pub(crate) selected: usize,
    pub(crate) certified: Option<usize>,
    pub(crate) seconds: f64,
}

/// All that `vv subdivide` tells: what was asked, what came in, the steps, what came out.
#[derive(Serialize, Debug)]
pub(crate) struct Report {
    pub(crate) mesh: String,
    pub(crate) output: String,
    pub(crate) scheme: String,
    pub(crate) method: String,
    pub(crate) rings: Option<usize>,
    pub(crate) select: String,
    /// Whether the expression was evaluated at every level.
    pub(crate) each_level: bool,
    /// `None` for schemes that do not know corners.
    pub(crate) boundary: Option<String>,
    /// `None` for schemes that know no finite sharpness.
    pub(crate) creases: Option<String>,
    /// `None` of methods under which no face has two split edges, or that have a rule of their own.
    pub(crate) diagonal: Option<String>,
    /// `None` if edges are split wherever the new vertex goes.
    pub(crate) min_move: Option<f64>,
    pub(crate) limit: bool,
    /// `None` of methods that do not look at limits.
    pub(crate) accuracy: Option<f64>,
    /// Only with `--until`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) until: Option<UntilReport>,
    /// Whether cracks were closed, which only *mobile* may leave.
    pub(crate) closed: bool,
    pub(crate) input: Sizes,
    pub(crate) levels: Vec<Row>,
    pub(crate) totals: Totals,
}

/// The steps as a table for people.
pub(crate) fn table(levels: &[Row]) -> Table {
    let is_mobile = levels.iter().any(|row| row.mobile.is_some());
    let mut columns = vec![
        "level",
        "selected",
        "region",
        "split",
        "vertices",
        "edges",
        "faces",
        "T",
        "O",
        "max valence",
        "certified",
    ];
    if is_mobile {
        columns.extend(["static", "faces of 0/1/2/3 mobile corners", "unclosed faces"]);
    }
    let has_error = levels.iter().any(|row| row.error.is_some());
    columns.extend(has_error.then_some("error left"));
    columns.push("time");
    let mut table = Table::new(&columns);
    for row in levels {
        let counts = [row.selected, row.region, row.split_edges, row.vertices, row.edges, row.faces];
        let mut cells = vec![row.level.to_string()];
        cells.extend(counts.iter().chain(&[row.t_vertices, row.o_vertices, row.max_valence]).map(usize::to_string));
        cells.push(row.certified.map_or("-".to_owned(), |certified| certified.to_string()));
        if let Some(MobileRow { static_vertices, faces_by_mobile_corners, unclosed_faces }) = &row.mobile {
            let by_corners = faces_by_mobile_corners.map(|count| count.to_string()).join("/");
            cells.extend([static_vertices.to_string(), by_corners, unclosed_faces.to_string()]);
        }
        cells.extend(row.error.map(|error| format!("{error:.3e}")));
        cells.push(seconds(row.seconds));
        table.row(&cells);
    }
    table
}
