//! `vv subdivide`: a mesh in, a region refined, a mesh and its tables out.

use std::fmt::Display;
use std::io::Write;
use std::path::{Path, PathBuf};

use vvmesh::Accuracy;
use vvmesh::Mesh;
use vvmesh::io::{FaceAttributes, ObjTags, write_atomically};
use vvmesh::soup::FaceList;
use vvmesh::step::Keep;
use vvmesh::subdivide::Subdivider;

use crate::Outcome;
use crate::aim::Aim;
use crate::args::{BoundaryName, CreasesName, MethodName, SubdivideArguments};
use crate::attributes::{self, Finished};
use crate::console::{Failure, json, print, refuse};
use crate::input::Input;
use crate::memory::FaceLimit;
use crate::outputs::{self, Named, OUT};
use crate::progress::Bar;
use crate::refine::Selecting;
use crate::report::{self, Report, Sizes};
use crate::run::Run;
use crate::state::{self, State};
use crate::table::count;
use crate::{input, limit, refine, tsv};

pub(crate) fn run(arguments: &mut SubdivideArguments) -> Result<Outcome, Failure> {
    let mut bar = Bar::new();
    let (subdivider, mut selecting) = refine::prepare(&mut arguments.refine)?;
    let arguments = &*arguments;
    let asked = &arguments.refine;
    check_outputs(arguments, &selecting)?;

    let begun = match &arguments.state {
        Some(path) => State::read(path, asked)?.map(|state| (path.as_path(), state)),
        None => None,
    };
    let Input { mesh, face_numbers, said, tags } = input::read_mesh(&asked.mesh, asked.tags.of_mesh.is_some())?;
    selecting.number_faces(face_numbers);
    selecting.take_fields(said.as_ref())?;
    let said = attributes::to_take_along(arguments, &mesh, said)?;
    let limit = match said {
        Some(_) => FaceLimit::with_attributes(asked),
        None => FaceLimit::new(asked.max_faces, asked.method),
    };
    let ready = Ready { arguments, subdivider, said, limit };
    let (mut run, boundary, state) = match begun {
        None => ready.begin(mesh, tags.as_ref())?,
        Some((path, state)) => ready.go_on(&mesh, path, state)?,
    };
    if selecting.each_level || !state.as_ref().is_some_and(|state| state.follows(&refine::expression_seen(asked))) {
        selecting.select(&mut run, 1)?;
    }
    let input = run.sizes();
    refine::refine(&mut run, asked, &selecting, limit, None, &mut bar)?;
    if let (true, Ok(limit)) = (asked.limit, limit::of_refinement(asked)) {
        limit::refuse_unready("--limit: ", &run.mesh, asked)?;
        limit::move_vertices("--limit: ", &mut run.mesh, run.attributes.as_mut(), &limit)?;
    }

    let report = report(arguments, &run, input, boundary);
    bar.show_stage(format!("writing {}", arguments.output.display()));
    let attributes = run.attributes.take();
    let unclosed = if arguments.is_unclosed() { run.history.unclosed(&run.mesh) } else { None };
    let finished = match unclosed {
        Some(faces) => Finished::of_faces(&run.mesh, faces),
        None => Finished::new(&asked.mesh, &run.mesh, attributes),
    };
    let written = write(arguments, &run, &finished, &report, state);
    bar.hide();
    written?;
    finished.tell_of_rounding(&arguments.output);
    if arguments.json {
        print(&json(&report)?)?;
    } else {
        print(&text(arguments, &report, finished.face_count()))?;
    }
    Ok(run.aim.as_ref().map_or(Outcome::Done, Aim::outcome))
}

/// What a run is made of beside its mesh.
struct Ready<'a> {
    arguments: &'a SubdivideArguments,
    subdivider: Subdivider,
    said: Option<(FaceList, FaceAttributes)>,
    limit: FaceLimit,
}

/// A run before its first step, or the first one more; with the state if there is one.
type Begun = (Run, BoundaryName, Option<State>);

impl Ready<'_> {
    /// A run of a mesh that was read.
    fn begin(self, mut mesh: Mesh, tags: Option<&ObjTags>) -> Result<Begun, Failure> {
        let (arguments, asked) = (self.arguments, &self.arguments.refine);
        let boundary = refine::tag(&mut mesh, tags, asked)?;
        let state = arguments.state.as_ref().map(|_| State::new(&mesh, asked, boundary));
        let mut run = refine::begin(mesh, asked, self.subdivider, keep(arguments))?;
        run.selections = state.as_ref().map(|_| Vec::new());
        attach(arguments, &mut run, self.said)?;
        Ok((run, boundary, state))
    }

    /// A run that was begun before, after its last step. What rides along has to be told for the mesh with which it began, or
    /// for the one that was made; on a hierarchy, which takes faces back, for the former.
    fn go_on(self, mesh: &Mesh, path: &Path, state: State) -> Result<Begun, Failure> {
        let (arguments, asked) = (self.arguments, &self.arguments.refine);
        let (first, boundary) = state.begin(path)?;
        let is_first = state::is_same(mesh, &first);
        let mut run = refine::begin(first, asked, self.subdivider, keep(arguments))?;
        run.selections = Some(Vec::new());
        let mut said = self.said;
        if is_first {
            attach(arguments, &mut run, said.take())?;
        }
        state.replay(&mut run, path, self.limit)?;
        if !is_first && !state::is_same(mesh, &run.mesh) {
            state::refuse_mesh(path, &asked.mesh, run.levels.len())?;
        }
        if said.is_some() && asked.method.is_on_hierarchy() {
            return refuse(format!(
                "{}: --method {} takes along what a file says from the first mesh on; give the mesh with which {} began",
                asked.mesh.display(),
                asked.method,
                path.display()
            ));
        }
        attach(arguments, &mut run, said)?;
        Ok((run, boundary, Some(state)))
    }
}

/// Lets ride along what the file says.
fn attach(
    arguments: &SubdivideArguments,
    run: &mut Run,
    said: Option<(FaceList, FaceAttributes)>,
) -> Result<(), Failure> {
    if let Some((triangles, said)) = said {
        run.attributes = Some(attributes::take_along(arguments, run, &triangles, said)?);
    }
    Ok(())
}

fn check_outputs(arguments: &SubdivideArguments, selecting: &Selecting) -> Result<(), Failure> {
    fn named<'a>(option: &'static str, path: Option<&'a PathBuf>) -> Option<Named<'a>> {
        path.map(|path| (option, path.as_path()))
    }
    outputs::check_mesh(&arguments.output)?;
    attributes::refuse_without_meaning(arguments)?;
    let optional = [
        named(OUT, Some(&arguments.output)),
        named("--state", arguments.state.as_ref()),
        named("--report", arguments.report.as_ref()),
        named("--vertex-table", arguments.vertex_table.as_ref()),
        named("--face-table", arguments.face_table.as_ref()),
    ];
    let inputs = refine::inputs(&arguments.refine, selecting);
    outputs::check(&optional.into_iter().flatten().collect::<Vec<_>>(), &inputs)
}

/// Only what some output needs: it costs memory. Uniform refinement needs no proof that it is what it is, and of other
/// splits than that in four nothing is certified.
fn keep(arguments: &SubdivideArguments) -> Keep {
    let vertex_table = arguments.vertex_table.is_some();
    let report = arguments.json || arguments.report.is_some();
    Keep {
        names: vertex_table || arguments.face_table.is_some(),
        certificate: refine::scheme(&arguments.refine).reach().is_some()
            && (vertex_table || report || arguments.refine.method != MethodName::Uniform),
    }
}

fn report(arguments: &SubdivideArguments, run: &Run, input: Sizes, boundary: BoundaryName) -> Report {
    let asked = &arguments.refine;
    let is_incremental = asked.method == MethodName::Incremental;
    let scheme = refine::scheme(asked);
    let creases = asked.tags.creases.unwrap_or(CreasesName::Uniform);
    Report {
        mesh: asked.mesh.display().to_string(),
        output: arguments.output.display().to_string(),
        scheme: asked.scheme.to_string(),
        method: asked.method.to_string(),
        rings: is_incremental.then(|| refine::rings(asked)),
        select: refine::expression(asked).to_owned(),
        each_level: asked.select_each.is_some(),
        boundary: scheme.reads_tags().then(|| boundary.to_string()),
        creases: scheme.blends_sharpness().then(|| creases.to_string()),
        diagonal: refine::draws_diagonals(asked).then(|| refine::diagonal_name(asked).to_string()),
        min_move: asked.min_move,
        limit: asked.limit,
        accuracy: asked.accuracy.map(Accuracy::distance),
        until: run.aim.as_ref().map(Aim::report),
        closed: !arguments.is_unclosed(),
        input,
        levels: run.levels.clone(),
        totals: run.totals(),
    }
}

/// Writes what was asked for, the mesh last: when it is there, everything is.
fn write(
    arguments: &SubdivideArguments,
    run: &Run,
    finished: &Finished<'_>,
    report: &Report,
    state: Option<State>,
) -> Result<(), Failure> {
    if let Some((path, state)) = arguments.state.as_ref().zip(state) {
        state.write(path, run, &refine::expression_seen(&arguments.refine))?;
    }
    if let Some(path) = &arguments.vertex_table {
        write_atomically(path, |out| tsv::vertices(run, out))?;
    }
    if let Some(path) = &arguments.face_table {
        write_atomically(path, |out| tsv::faces(run, finished.triangles(), out))?;
    }
    if let Some(path) = &arguments.report {
        let text = json(report)?;
        write_atomically(path, |out| out.write_all(text.as_bytes()))?;
    }
    finished.save(&arguments.output)?;
    Ok(())
}

fn text(arguments: &SubdivideArguments, report: &Report, faces: usize) -> String {
    let SubdivideArguments { vertex_table, face_table, report: report_file, state, .. } = arguments;
    let mut text = if report.levels.is_empty() { String::new() } else { report::table(&report.levels).to_string() };
    let others = [vertex_table, face_table, report_file, state].into_iter().flatten().map(PathBuf::as_path);
    let line = |path: &Path, what: &dyn Display| format!("wrote {}{what}\n", path.display());
    let Sizes { vertices, .. } = report.totals.sizes;
    let sizes = format!(": {}, {}", count(vertices, "vertex", "vertices"), count(faces, "face", "faces"));
    text.extend(others.map(|path| line(path, &"")));
    text.push_str(&line(&arguments.output, &sizes));
    text
}
