//! `vv compare`: every method on the same selection, beside uniform refinement.

use serde::Serialize;
use vvmesh::compare::{self, METHODS, Measures, Outcome, Reference};
use vvmesh::error::RefineError;
use vvmesh::scheme::AnyScheme;
use vvmesh::scratch::Scratch;

use crate::Outcome as Exit;
use crate::args::{CompareArguments, FormArguments, MethodName};
use crate::console::{Failure, note, print, print_json, refuse};
use crate::fields;
use crate::input::{self, Input};
use crate::memory::FaceLimit;
use crate::progress::Bar;
use crate::table::{Table, seconds};

#[derive(Serialize)]
struct Comparison {
    rows: Vec<Row>,
}

/// A row as it is written.
#[derive(Serialize)]
struct Row {
    #[serde(flatten)]
    columns: Columns,
    #[serde(flatten)]
    reason: Option<Reason>,
}

/// Why nothing was made.
#[derive(Serialize, Clone, Default)]
struct Reason {
    skipped: String,
}

/// What is not known, as nothing was made, is `None`.
#[derive(Serialize, Default)]
struct Columns {
    method: &'static str,
    level: u8,
    faces: Option<u64>,
    vertices: Option<u64>,
    t_vertices: Option<usize>,
    o_vertices: Option<usize>,
    max_valence: Option<usize>,
    max_deviation: Option<f64>,
    mean_deviation: Option<f64>,
    max_limit_deviation: Option<f64>,
    equal_percent: Option<f64>,
    balance: Option<u32>,
    min_angle_deg: Option<f64>,
    passes: Option<usize>,
    seconds: Option<f64>,
    bytes: Option<usize>,
}

pub(crate) fn run(arguments: &CompareArguments) -> Result<Exit, Failure> {
    let (expression, _) = input::parse_expression("--select", &arguments.select, arguments.view.camera)?;
    let scheme = AnyScheme::named(&arguments.scheme.to_string())?;
    let Input { mesh, face_numbers, said, .. } = input::read_mesh(&arguments.mesh, false)?;
    let expression = expression.with_faces_numbered_by(face_numbers);
    let expression = fields::of_file("--select", expression, said.as_ref().map(|(_, said)| said))?;
    let selection = input::evaluate("--select", &expression, &mesh, &mut Scratch::new())?;
    if selection.is_empty() {
        note(format_args!("--select '{}' picks nothing", arguments.select));
    }

    let mut bar = Bar::new();
    bar.show_stage("uniform refinement of the region".to_owned());
    // The methods on a hierarchy take the most.
    let limit = FaceLimit::new(arguments.max_faces, MethodName::Dynamic);
    let reference = Reference::new(&mesh, &selection, scheme, arguments.levels, Some(limit.faces));
    let reference = match reference {
        Ok(reference) => reference,
        Err(error @ RefineError::TooManyFaces { .. }) => return refuse(format!("around the selection {error}")),
        Err(error) => return Err(error.into()),
    };
    let mut rows = Vec::new();
    for method in METHODS {
        bar.show_stage(method.to_owned());
        let made = reference.compare_named(method, arguments.accuracy);
        rows.extend(made.into_iter().map(|row| Row::new(method, row)));
    }
    bar.hide();
    let comparison = Comparison { rows };
    match arguments.form {
        FormArguments { json: true, .. } => print_json(&comparison)?,
        FormArguments { csv: true, .. } => print(&comparison.csv()?)?,
        FormArguments { markdown: true, .. } => print(&comparison.markdown())?,
        FormArguments { .. } => print(&comparison.text())?,
    }
    Ok(Exit::Done)
}

impl Row {
    fn new(method: &'static str, row: compare::Row) -> Self {
        let level = row.level;
        match row.outcome {
            Outcome::Made(measures) => Self { columns: Columns::new(method, level, &measures), reason: None },
            Outcome::Skipped { reason, sizes } => {
                let [faces, vertices] = sizes.map_or([None; 2], |sizes| sizes.map(Some));
                let columns = Columns { method, level, faces, vertices, ..Columns::default() };
                Self { columns, reason: Some(Reason { skipped: reason }) }
            }
        }
    }
}

impl Columns {
    fn new(method: &'static str, level: u8, measures: &Measures) -> Self {
        Self {
            method,
            level,
            faces: Some(measures.faces as u64),
            vertices: Some(measures.vertices as u64),
            t_vertices: Some(measures.t_vertices),
            o_vertices: Some(measures.o_vertices),
            max_valence: Some(measures.max_valence),
            max_deviation: measures.max_deviation,
            mean_deviation: measures.mean_deviation,
            max_limit_deviation: measures.max_limit_deviation,
            equal_percent: measures.equal_percent,
            balance: Some(measures.balance),
            min_angle_deg: measures.min_angle_deg,
            passes: Some(measures.passes),
            seconds: Some(measures.seconds),
            bytes: Some(measures.bytes),
        }
    }

    /// The headers for people, and what stands below them.
    fn cells(&self) -> [(&'static str, String); 16] {
        fn whole<T: ToString>(value: Option<T>) -> String {
            value.map_or("-".to_owned(), |value| value.to_string())
        }
        let distance = |value: Option<f64>| match value {
            None => "-".to_owned(),
            Some(0.0) => "0".to_owned(),
            Some(value) => format!("{value:.2e}"),
        };
        let decimal = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{value:.1}"));
        [
            ("method", self.method.to_owned()),
            ("level", self.level.to_string()),
            ("faces", whole(self.faces)),
            ("vertices", whole(self.vertices)),
            ("T", whole(self.t_vertices)),
            ("O", whole(self.o_vertices)),
            ("max valence", whole(self.max_valence)),
            ("max deviation", distance(self.max_deviation)),
            ("mean", distance(self.mean_deviation)),
            ("of limits", distance(self.max_limit_deviation)),
            ("equal %", decimal(self.equal_percent)),
            ("balance", whole(self.balance)),
            ("min angle", decimal(self.min_angle_deg)),
            ("passes", whole(self.passes)),
            ("time", self.seconds.map_or("-".to_owned(), seconds)),
            ("KiB", whole(self.bytes.map(|bytes| bytes.div_ceil(1024)))),
        ]
    }
}

impl Comparison {
    /// What was skipped, each reason once.
    fn reasons(&self) -> Vec<String> {
        let sentence = |row: &Row| {
            let Reason { skipped } = row.reason.as_ref()?;
            Some(format!("{} is skipped: {skipped}\n", row.columns.method))
        };
        let mut reasons: Vec<String> = self.rows.iter().filter_map(sentence).collect();
        reasons.dedup();
        reasons
    }

    fn headers(&self) -> [&'static str; 16] {
        Columns::default().cells().map(|(header, _)| header)
    }

    fn cells(&self) -> impl Iterator<Item = [String; 16]> {
        self.rows.iter().map(|row| row.columns.cells().map(|(_, cell)| cell))
    }

    fn text(&self) -> String {
        let mut table = Table::new(&self.headers());
        self.cells().for_each(|cells| table.row(&cells));
        format!("{table}{}", self.reasons().concat())
    }

    fn markdown(&self) -> String {
        let line = |cells: [String; 16]| format!("| {} |\n", cells.join(" | "));
        let headers = self.headers();
        let rule = headers.map(|header| if header == "method" { "---" } else { "---:" }.to_owned());
        let lines = [headers.map(str::to_owned), rule].into_iter().chain(self.cells()).map(line);
        let reasons = self.reasons().into_iter().map(|reason| format!("\n{reason}"));
        lines.chain(reasons).collect()
    }

    /// One record a row, with the names that JSON has; what is not known is empty.
    fn csv(&self) -> Result<String, Failure> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        for Row { columns, reason } in &self.rows {
            writer.serialize((columns, reason.clone().unwrap_or_default()))?;
        }
        Ok(String::from_utf8(writer.into_inner()?)?)
    }
}
