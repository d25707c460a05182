//! `vv stroke`: a recorded stroke, drawn again.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;
use vvmesh::Mesh;
use vvmesh::error::RefineError;
use vvmesh::io::{Format, save, write_atomically};
use vvmesh::scheme::AnyScheme;
use vvmesh::stroke::{Event, Pen, PenMethod, Touch};
use vvmesh::subdivide::Control;

use crate::Outcome;
use crate::args::{PenName, StrokeArguments};
use crate::console::{Failure, json, note, print, refuse};
use crate::input::{self, Input};
use crate::memory::FaceLimit;
use crate::outputs::{self, Named};
use crate::report::Sizes;
use crate::sharp;
use crate::stroke_file::StrokeFile;
use crate::table::count;

/// How many events a note names.
const EXAMPLES: usize = 5;

/// All that is told of a stroke. It names no output, so that it is the same wherever that is.
#[derive(Serialize)]
struct Report {
    mesh: String,
    stroke: String,
    scheme: String,
    method: String,
    input: Sizes,
    events: Vec<Row>,
    totals: Totals,
}

/// What an event did; the place is `None` where nothing was hit.
#[derive(Serialize)]
struct Row {
    event: usize,
    time: f64,
    place: Option<[f64; 3]>,
    touched: usize,
    wanted: u8,
    refined: usize,
    proven: usize,
    region: usize,
    added: usize,
    faces: usize,
    /// Only if times are asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    ms: Option<f64>,
}

#[derive(Serialize)]
struct Totals {
    #[serde(flatten)]
    sizes: Sizes,
    missed: usize,
    refined: usize,
    proven: usize,
}

pub(crate) fn run(arguments: &StrokeArguments) -> Result<Outcome, Failure> {
    let scheme = AnyScheme::named(&arguments.scheme.to_string())?;
    if let Some(option) = arguments.tags.first_given().filter(|_| !scheme.reads_tags()) {
        return refuse(format!(
            "{option} has no meaning with --scheme {}: its weights know neither creases nor corners; leave it out",
            arguments.scheme
        ));
    }
    if arguments.tags.creases.is_some() && !scheme.blends_sharpness() {
        return refuse(format!(
            "--creases has no meaning with --scheme {}: its weights know no finite sharpness; leave it out",
            arguments.scheme
        ));
    }
    let stroke = StrokeFile::read(&arguments.stroke)?;
    let Input { mut mesh, said, tags, .. } = input::read_mesh(&arguments.mesh, arguments.tags.of_mesh.is_some())?;
    if said.is_some() {
        note(format_args!("{}: positions and faces alone are drawn on and written again", arguments.mesh.display()));
    }
    let events = stroke.events(&arguments.stroke, &mesh)?;
    sharp::tag(&mut mesh, &arguments.mesh, tags.as_ref(), &arguments.tags)?;
    sharp::refuse_unblended(&mesh, scheme.blends_sharpness(), arguments.scheme)?;
    let limit = FaceLimit::of_pen(arguments);
    let pen = Pen::new(mesh, scheme, method(arguments)).or_else(|error| refuse(format!("--{error}")))?;
    let folder = Folder::new(arguments, events.len())?;

    let input = sizes(&pen);
    let (pen, rows) = draw(arguments, pen, &events, limit, &folder)?;
    let report = report(arguments, input, rows, &pen);
    tell_of_misses(&report);
    folder.finish(pen.mesh(), &report)?;
    print(&if arguments.json { json(&report)? } else { text(&report, &folder.mesh()) })?;
    Ok(Outcome::Done)
}

/// Draws all events, and writes the frames that are asked for.
fn draw(
    arguments: &StrokeArguments,
    mut pen: Pen,
    events: &[Event],
    limit: FaceLimit,
    folder: &Folder,
) -> Result<(Pen, Vec<Row>), Failure> {
    let mut rows = Vec::with_capacity(events.len());
    for (number, event) in (1..).zip(events) {
        let started = Instant::now();
        let touch = pen.touch(event, &mut Control { max_faces: Some(limit.faces), ..Control::default() });
        let ms = arguments.times.then(|| started.elapsed().as_secs_f64() * 1e3);
        let touch = touch.map_err(|error| Failure(format!("event {number}: {}", reason(&error, limit))))?;
        rows.push(row(number, event, &touch, &pen, ms));
        folder.write_frame(number, pen.mesh())?;
    }
    Ok((pen, rows))
}

fn reason(error: &RefineError, limit: FaceLimit) -> String {
    match *error {
        RefineError::TooManyFaces { needed, .. } => limit.refusal_of("the mesh", needed),
        ref other => format!("{other}. Nothing was written"),
    }
}

fn method(arguments: &StrokeArguments) -> PenMethod {
    match arguments.method {
        PenName::Incremental => PenMethod::Incremental,
        PenName::Dynamic => PenMethod::Dynamic,
    }
}

fn row(event: usize, &Event { time, .. }: &Event, touch: &Touch, pen: &Pen, ms: Option<f64>) -> Row {
    let &Touch { hit, touched, wanted, refined, proven, region, added } = touch;
    let place = hit.map(|hit| hit.position.to_array());
    Row { event, time, place, touched, wanted, refined, proven, region, added, faces: pen.mesh().face_count(), ms }
}

fn sizes(pen: &Pen) -> Sizes {
    let mesh = pen.mesh();
    Sizes {
        vertices: mesh.vertex_count(),
        edges: mesh.edge_count(),
        faces: mesh.face_count(),
        max_valence: mesh.vertices().map(|v| mesh.ring(v).valence()).max().unwrap_or(0),
    }
}

fn report(arguments: &StrokeArguments, input: Sizes, events: Vec<Row>, pen: &Pen) -> Report {
    let sum = |of: fn(&Row) -> usize| events.iter().map(of).sum();
    let totals = Totals {
        sizes: sizes(pen),
        missed: sum(|row| usize::from(row.place.is_none())),
        refined: sum(|row| row.refined),
        proven: sum(|row| row.proven),
    };
    Report {
        mesh: arguments.mesh.display().to_string(),
        stroke: arguments.stroke.display().to_string(),
        scheme: arguments.scheme.to_string(),
        method: arguments.method.to_string(),
        input,
        events,
        totals,
    }
}

fn tell_of_misses(report: &Report) {
    let mut missed = report.events.iter().filter(|row| row.place.is_none()).map(|row| row.event.to_string());
    let examples: Vec<String> = missed.by_ref().take(EXAMPLES).collect();
    if !examples.is_empty() {
        let more = if missed.next().is_some() { ", ..." } else { "" };
        let events = count(report.totals.missed, "event meets", "events meet");
        note(format_args!("{events} nothing: {}{more}", examples.join(", ")));
    }
}

fn text(report: &Report, mesh: &Path) -> String {
    let Report { events, totals, input, .. } = report;
    format!(
        "{}: {} refined, {} of them proven to be as in a uniform mesh; {} faces before, {} after\nwrote {}: {}, {}\n",
        count(events.len(), "event", "events"),
        count(totals.refined, "touched vertex", "touched vertices"),
        totals.proven,
        input.faces,
        totals.sizes.faces,
        mesh.display(),
        count(totals.sizes.vertices, "vertex", "vertices"),
        count(totals.sizes.faces, "face", "faces")
    )
}

/// Where a stroke is written: frames in a folder beside, until the last event is drawn.
struct Folder {
    path: PathBuf,
    /// That of the input, if meshes are written with it.
    ending: String,
    /// The events after which there is a frame, ascending, and its name.
    frames: Vec<(usize, String)>,
    unfinished: tempfile::TempDir,
}

impl Folder {
    /// Makes the folder and looks whether all can be written.
    fn new(arguments: &StrokeArguments, events: usize) -> Result<Self, Failure> {
        let path = arguments.folder.clone();
        let failed = |error| Failure(format!("-o: {}: {error}", path.display()));
        fs::create_dir_all(&path).map_err(failed)?;
        let unfinished = tempfile::Builder::new().prefix(".vv-").tempdir_in(&path).map_err(failed)?;
        let known = arguments.mesh.extension().filter(|_| Format::from_ending(&arguments.mesh).is_some());
        let ending = known.map_or("obj".to_owned(), |ending| ending.to_string_lossy().into_owned());
        let width = events.to_string().len();
        let name = |event| (event, format!("frame-{event:0width$}.{ending}"));
        let frames = arguments.frames.map_or(Vec::new(), |frames| frames.of(events)).into_iter().map(name).collect();
        let folder = Self { path, ending, frames, unfinished };
        // What is not there yet is as writable as the folder, and nothing that is read.
        let frames = folder.frames.iter().map(|(_, name)| folder.path.join(name)).filter(|path| path.exists());
        let outputs: Vec<PathBuf> = frames.chain([folder.report(), folder.mesh()]).collect();
        let named: Vec<Named<'_>> = outputs.iter().map(|path| (outputs::OUT, path.as_path())).collect();
        // Nobody names the files in the folder, so none takes the place of what is read.
        let mut inputs: Vec<Named<'_>> = vec![("the mesh", &arguments.mesh), ("--stroke", &arguments.stroke)];
        inputs.extend(arguments.tags.sharp.iter().map(|file| ("--sharp", file.as_path())));
        outputs::check(&named, &inputs)?;
        Ok(folder)
    }

    fn mesh(&self) -> PathBuf {
        self.path.join(format!("mesh.{}", self.ending))
    }

    fn report(&self) -> PathBuf {
        self.path.join("report.json")
    }

    fn write_frame(&self, event: usize, mesh: &Mesh) -> Result<(), Failure> {
        if let Ok(k) = self.frames.binary_search_by_key(&event, |(event, _)| *event) {
            save(self.unfinished.path().join(&self.frames[k].1), mesh)?;
        }
        Ok(())
    }

    /// Brings everything to its place, the mesh last: when it is there, all is.
    fn finish(&self, mesh: &Mesh, report: &Report) -> Result<(), Failure> {
        for (_, name) in &self.frames {
            let to = self.path.join(name);
            fs::rename(self.unfinished.path().join(name), &to)
                .map_err(|error| Failure(format!("-o: {}: {error}", to.display())))?;
        }
        let text = json(report)?;
        write_atomically(self.report(), |out| out.write_all(text.as_bytes()))?;
        Ok(save(self.mesh(), mesh)?)
    }
}
