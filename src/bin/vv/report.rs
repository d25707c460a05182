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
    pub(crate) seconds: f64,
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
    pub(crate) limit: bool,
    pub(crate) input: Sizes,
    pub(crate) levels: Vec<Row>,
    pub(crate) totals: Totals,
}

/// The steps as a table for people.
pub(crate) fn table(levels: &[Row]) -> Table {
    let mut table = Table::new(&[
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
        "time",
    ]);
    for row in levels {
        let counts = [row.selected, row.region, row.split_edges, row.vertices, row.edges, row.faces];
        let mut cells = vec![row.level.to_string()];
        cells.extend(counts.iter().chain(&[row.t_vertices, row.o_vertices, row.max_valence]).map(usize::to_string));
        cells.push(row.certified.map_or("-".to_owned(), |certified| certified.to_string()));
        cells.push(seconds(row.seconds));
        table.row(&cells);
    }
    table
}
