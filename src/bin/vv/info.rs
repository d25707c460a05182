//! `vv info`: counts of what is in a file.

use std::collections::BTreeMap;

use serde::Serialize;
use vvmesh::soup::Census;

use crate::Outcome;
use crate::args::InfoArguments;
use crate::console::{Failure, print, print_json};
use crate::input;
use crate::table::Table;

#[derive(Serialize)]
struct Info {
    vertices: usize,
    isolated_vertices: usize,
    edges: usize,
    faces: usize,
    triangles: usize,
    components: usize,
    boundary_loops: usize,
    euler_characteristic: i64,
    genus: Option<usize>,
    orientable: bool,
    valence: Valence,
    bounds: Option<Bounds>,
}

#[derive(Serialize)]
struct Valence {
    min: Option<usize>,
    mean: Option<f64>,
    max: Option<usize>,
    histogram: BTreeMap<usize, usize>,
}

#[derive(Serialize)]
struct Bounds {
    min: [f64; 3],
    max: [f64; 3],
}

pub(crate) fn run(arguments: &InfoArguments) -> Result<Outcome, Failure> {
    let loaded = input::read(&arguments.mesh)?;
    let info = Info::from(loaded.faces.census());
    if arguments.json {
        print_json(&info)?;
    } else {
        print(&format!("{} ({})\n{}", arguments.mesh.display(), loaded.format, table(&info)))?;
    }
    Ok(Outcome::Done)
}

impl From<Census> for Info {
    fn from(census: Census) -> Self {
        let Census { valence, bounds, .. } = census;
        Self {
            vertices: census.vertices,
            isolated_vertices: census.isolated_vertices,
            edges: census.edges,
            faces: census.faces,
            triangles: census.triangles,
            components: census.components,
            boundary_loops: census.boundary_loops,
            euler_characteristic: census.euler_characteristic,
            genus: census.genus,
            orientable: census.orientable,
            valence: Valence {
                min: valence.min,
                mean: valence.mean,
                max: valence.max,
                histogram: valence.histogram.into_iter().collect(),
            },
            bounds: bounds.map(|[min, max]| Bounds { min: min.to_array(), max: max.to_array() }),
        }
    }
}

fn table(info: &Info) -> Table {
    let mut table = Table::without_headers();
    for (name, value) in [
        ("vertices", info.vertices),
        ("isolated vertices", info.isolated_vertices),
        ("edges", info.edges),
        ("faces", info.faces),
        ("triangles", info.triangles),
        ("components", info.components),
        ("boundary loops", info.boundary_loops),
    ] {
        table.row(&[name.to_owned(), value.to_string()]);
    }
    let or_none = |value: Option<String>| value.unwrap_or_else(|| "none".to_owned());
    table.row(&["Euler characteristic".to_owned(), info.euler_characteristic.to_string()]);
    table.row(&["genus".to_owned(), or_none(info.genus.map(|genus| genus.to_string()))]);
    table.row(&["orientable", if info.orientable { "yes" } else { "no" }]);
    let Valence { min, mean, max, histogram } = &info.valence;
    table.row(&["least valence".to_owned(), or_none(min.map(|min| min.to_string()))]);
    table.row(&["mean valence".to_owned(), or_none(mean.map(|mean| format!("{mean:.3}")))]);
    table.row(&["greatest valence".to_owned(), or_none(max.map(|max| max.to_string()))]);
    for (valence, vertices) in histogram {
        table.row(&[format!("  of valence {valence}"), vertices.to_string()]);
    }
    if let Some(Bounds { min, max }) = &info.bounds {
        for (axis, (min, max)) in ["x", "y", "z"].into_iter().zip(min.iter().zip(max)) {
            table.row(&[format!("{axis} from"), min.to_string()]);
            table.row(&[format!("{axis} to"), max.to_string()]);
        }
    }
    table
}
