//! `vv subdivide`: a mesh in, a region refined, a mesh and its tables out.

use std::fmt::Display;
use std::io::Write;
use std::path::{Path, PathBuf};

use vvmesh::adaptive::{Incremental, Simple, Uniform};
use vvmesh::certify::Certificate;
use vvmesh::error::RefineError;
use vvmesh::io::{save, write_atomically};
use vvmesh::limit::LoopLimit;
use vvmesh::mesh::BoundaryPolicy;
use vvmesh::scheme::{AnyScheme, Butterfly, Loop, LoopWeights, Midpoint, ModifiedButterfly, Sqrt3};
use vvmesh::select::Expression;
use vvmesh::step::{Cause, Keep, Spoiler};
use vvmesh::subdivide::{Control, Subdivider};
use vvmesh::{Mesh, VertexId};

use crate::Outcome;
use crate::args::{BoundaryName, MethodName, SchemeName, SubdivideArguments, WeightsName};
use crate::console::{Failure, json, note, print, refuse, warning};
use crate::memory::FaceLimit;
use crate::outputs::{self, MESH, Named, OUT};
use crate::progress::Bar;
use crate::report::{self, Report, Sizes};
use crate::run::Run;
use crate::table::count;
use crate::{input, sharp, tsv};

/// How many examples a warning gives.
const EXAMPLES: usize = 3;

pub(crate) fn run(arguments: &SubdivideArguments) -> Result<Outcome, Failure> {
    let mut bar = Bar::new();
    let scheme = scheme(arguments);
    refuse_without_meaning(arguments, &scheme)?;
    let subdivider = subdivider(arguments, scheme)?;
    let selecting = Selecting::new(arguments)?;
    check_outputs(arguments, &selecting)?;

    let mut mesh = input::read_mesh_to_write(&arguments.mesh)?;
    tag(&mut mesh, arguments)?;
    let limit = FaceLimit::new(arguments.max_faces);
    if arguments.method == MethodName::Uniform {
        limit.refuse_uniform(mesh.face_count(), arguments.levels)?;
    }
    let mut run = Run::new(mesh, subdivider, keep(arguments));
    let input = run.sizes();
    selecting.select(&mut run)?;
    refine(&mut run, arguments, &selecting, limit, &mut bar)?;
    if arguments.limit {
        move_to_limit(&mut run.mesh, weights(arguments))?;
    }

    let report = report(arguments, &run, input);
    bar.show_stage(format!("writing {}", arguments.output.display()));
    let written = write(arguments, &run, &report);
    bar.hide();
    written?;
    if arguments.json {
        print(&json(&report)?)?;
    } else {
        print(&text(arguments, &report))?;
    }
    Ok(Outcome::Done)
}

/// The expression, and how often it is evaluated.
struct Selecting {
    option: &'static str,
    expression: Expression,
    /// The files that the expression names.
    files: Vec<PathBuf>,
    each_level: bool,
}

impl Selecting {
    fn new(arguments: &SubdivideArguments) -> Result<Self, Failure> {
        let each_level = arguments.select_each.is_some();
        let option = if each_level { "--select-each" } else { "--select" };
        let (expression, files) = input::parse_expression(option, expression(arguments))?;
        Ok(Self { option, expression, files, each_level })
    }

    /// Evaluates the expression on the mesh as it is; picking nothing is legal, and told.
    fn select(&self, run: &mut Run) -> Result<(), Failure> {
        run.selection = input::evaluate(self.option, &self.expression, &run.mesh, &mut run.scratch)?;
        if run.selection.is_empty() {
            let level = if self.each_level { format!("level {}: ", run.next_level()) } else { String::new() };
            note(format_args!("{level}{} picks no vertex", self.option));
        }
        Ok(())
    }
}

fn expression(arguments: &SubdivideArguments) -> &str {
    arguments.select_each.as_deref().or(arguments.select.as_deref()).unwrap_or("all")
}

fn scheme(arguments: &SubdivideArguments) -> AnyScheme {
    match arguments.scheme {
        SchemeName::Loop => Loop::new(weights(arguments)).into(),
        SchemeName::Butterfly => Butterfly.into(),
        SchemeName::ModifiedButterfly => ModifiedButterfly.into(),
        SchemeName::Midpoint => Midpoint.into(),
        SchemeName::Sqrt3 => Sqrt3::default().into(),
    }
}

fn weights(arguments: &SubdivideArguments) -> LoopWeights {
    match arguments.weights {
        None | Some(WeightsName::Loop) => LoopWeights::Loop,
        Some(WeightsName::Warren) => LoopWeights::Warren,
    }
}

fn subdivider(arguments: &SubdivideArguments, scheme: AnyScheme) -> Result<Subdivider, Failure> {
    Ok(match arguments.method {
        MethodName::Uniform => Subdivider::new(scheme, Uniform),
        MethodName::Simple => Subdivider::new(scheme, Simple),
        MethodName::Incremental => match Incremental::new(rings(arguments)) {
            Ok(method) => Subdivider::new(scheme, method),
            Err(error) => return refuse(format!("--{error}")),
        },
    })
}

fn rings(arguments: &SubdivideArguments) -> usize {
    arguments.rings.unwrap_or(1)
}

/// Refuses options that would do nothing under the scheme or the method.
fn refuse_without_meaning(arguments: &SubdivideArguments, scheme: &AnyScheme) -> Result<(), Failure> {
    let SubdivideArguments { scheme: name, method, .. } = arguments;
    let is_loop = *name == SchemeName::Loop;
    let reads_tags = scheme.reads_tags();
    let no_tags = "its weights know neither creases nor corners";
    let refusals = [
        (
            "--rings",
            arguments.rings.is_some() && *method != MethodName::Incremental,
            format!("--method {method}: only `incremental` expands the selection"),
        ),
        ("--weights", arguments.weights.is_some() && !is_loop, format!("--scheme {name}: its weights are fixed")),
        ("--limit", arguments.limit && !is_loop, format!("--scheme {name}: limit positions are known for `loop` only")),
        ("--boundary", arguments.boundary.is_some() && !reads_tags, format!("--scheme {name}: {no_tags}")),
        ("--sharp", arguments.sharp.is_some() && !reads_tags, format!("--scheme {name}: {no_tags}")),
        ("--sharp-angle", arguments.sharp_angle.is_some() && !reads_tags, format!("--scheme {name}: {no_tags}")),
    ];
    match refusals.iter().find(|(_, refused, _)| *refused) {
        Some((option, _, reason)) => refuse(format!("{option} has no meaning with {reason}; leave it out")),
        None => Ok(()),
    }
}

fn check_outputs(arguments: &SubdivideArguments, selecting: &Selecting) -> Result<(), Failure> {
    fn named<'a>(option: &'static str, path: Option<&'a PathBuf>) -> Option<Named<'a>> {
        path.map(|path| (option, path.as_path()))
    }
    outputs::check_mesh(&arguments.output)?;
    let optional = [
        named(OUT, Some(&arguments.output)),
        named("--report", arguments.report.as_ref()),
        named("--vertex-table", arguments.vertex_table.as_ref()),
        named("--face-table", arguments.face_table.as_ref()),
    ];
    let mut inputs = vec![(MESH, arguments.mesh.as_path())];
    inputs.extend(named("--sharp", arguments.sharp.as_ref()));
    inputs.extend(selecting.files.iter().map(|file| (selecting.option, file.as_path())));
    outputs::check(&optional.into_iter().flatten().collect::<Vec<_>>(), &inputs)
}

/// Tags the input: corners by the boundary policy, sharp edges by angle or from a file.
fn tag(mesh: &mut Mesh, arguments: &SubdivideArguments) -> Result<(), Failure> {
    mesh.apply_boundary_policy(match arguments.boundary {
        None | Some(BoundaryName::Smooth) => BoundaryPolicy::Smooth,
        Some(BoundaryName::Corners) => BoundaryPolicy::Corners,
        Some(BoundaryName::Fixed) => BoundaryPolicy::Fixed,
    });
    if let Some(degrees) = arguments.sharp_angle {
        let sharp = sharp::by_angle(mesh, degrees);
        note(format_args!("{} sharp, folded by more than {degrees} degrees", count(sharp, "edge is", "edges are")));
    }
    arguments.sharp.as_deref().map_or(Ok(()), |path| sharp::from_file(mesh, path))
}

/// Only what some output needs: it costs memory. Uniform refinement needs no proof that it is what it is, and of other
/// splits than that in four nothing is certified.
fn keep(arguments: &SubdivideArguments) -> Keep {
    let vertex_table = arguments.vertex_table.is_some();
    let report = arguments.json || arguments.report.is_some();
    Keep {
        names: vertex_table || arguments.face_table.is_some(),
        certificate: scheme(arguments).reach().is_some()
            && (vertex_table || report || arguments.method != MethodName::Uniform),
    }
}

/// Makes all levels.
fn refine(
    run: &mut Run,
    arguments: &SubdivideArguments,
    selecting: &Selecting,
    limit: FaceLimit,
    bar: &mut Bar,
) -> Result<(), Failure> {
    let reach = scheme(arguments).reach();
    for level in 1..=arguments.levels {
        if selecting.each_level && level > 1 {
            bar.hide();
            selecting.select(run)?;
        }
        // The reasons are those before the step; a selection that follows needs none.
        let doubts = match run.certificate().zip(reach) {
            Some((certificate, reach)) if selecting.each_level => {
                let unproven = certificate.unproven(&run.selection, reach);
                unproven.iter().take(EXAMPLES).map(|&v| doubt(&certificate, &run.mesh, v)).collect()
            }
            _ => Vec::new(),
        };
        let mut show = |progress| bar.show(level, progress);
        let step =
            run.step(&mut Control { max_faces: Some(limit.faces), progress: Some(&mut show), ..Control::default() });
        let step = step.map_err(|error| {
            bar.hide();
            Failure(match error {
                RefineError::TooManyFaces { needed, .. } => limit.refusal(level, needed),
                other => format!("level {level}: {other}. Nothing was written"),
            })
        })?;
        if !step.unproven.is_empty() {
            bar.hide();
            warn_of_unproven(level, &step.unproven, step.selected, &doubts);
        }
    }
    bar.hide();
    Ok(())
}

fn warn_of_unproven(level: u8, unproven: &[VertexId], selected: usize, doubts: &[String]) {
    let examples = match doubts {
        [] => unproven.iter().take(EXAMPLES).map(VertexId::to_string).collect(),
        doubts => doubts.to_vec(),
    };
    let more = if unproven.len() > examples.len() { ", ..." } else { "" };
    warning(format_args!(
        "level {level}: for {} of {selected} selected vertices this step is not proven equal to uniform refinement, as \
         the selection did not follow the levels before: {}{more}",
        unproven.len(),
        examples.join(", ")
    ));
}

/// A vertex for which the next step is not proven exact, with the reason.
fn doubt(certificate: &Certificate<'_>, mesh: &Mesh, v: VertexId) -> String {
    // A vertex that is certified itself has a neighbour that is not.
    let (beside, cause) = match certificate.cause(v) {
        Some(cause) => ("", Some(cause)),
        None => (" beside it", mesh.ring(v).iter().find_map(|w| certificate.cause(w))),
    };
    match cause {
        Some(Cause::Spoiled(Spoiler::TVertex(t))) => format!("{v} (T-vertex {t}{beside})"),
        Some(Cause::Spoiled(Spoiler::OVertex(o))) => format!("{v} (O-vertex {o}{beside})"),
        Some(Cause::NotRefined) => format!("{v} (coarser{beside})"),
        None => v.to_string(),
    }
}

/// Moves every vertex to where infinitely many steps would bring it.
fn move_to_limit(mesh: &mut Mesh, weights: LoopWeights) -> Result<(), Failure> {
    let positions = LoopLimit::new(weights).positions(mesh);
    if let Some(k) = positions.iter().position(|position| !position.is_finite()) {
        return refuse(format!(
            "--limit: the limit of {} is not finite; scale the mesh down. Nothing was written",
            VertexId::new(k)
        ));
    }
    mesh.positions_mut().copy_from_slice(&positions);
    Ok(())
}

fn report(arguments: &SubdivideArguments, run: &Run, input: Sizes) -> Report {
    let is_incremental = arguments.method == MethodName::Incremental;
    let boundary = arguments.boundary.unwrap_or(BoundaryName::Smooth);
    Report {
        mesh: arguments.mesh.display().to_string(),
        output: arguments.output.display().to_string(),
        scheme: arguments.scheme.to_string(),
        method: arguments.method.to_string(),
        rings: is_incremental.then(|| rings(arguments)),
        select: expression(arguments).to_owned(),
        each_level: arguments.select_each.is_some(),
        boundary: scheme(arguments).reads_tags().then(|| boundary.to_string()),
        limit: arguments.limit,
        input,
        levels: run.levels.clone(),
        totals: run.totals(),
    }
}

/// Writes what was asked for, the mesh last: when it is there, everything is.
fn write(arguments: &SubdivideArguments, run: &Run, report: &Report) -> Result<(), Failure> {
    if let Some(path) = &arguments.vertex_table {
        write_atomically(path, |out| tsv::vertices(run, out))?;
    }
    if let Some(path) = &arguments.face_table {
        write_atomically(path, |out| tsv::faces(run, out))?;
    }
    if let Some(path) = &arguments.report {
        let text = json(report)?;
        write_atomically(path, |out| out.write_all(text.as_bytes()))?;
    }
    save(&arguments.output, &run.mesh)?;
    Ok(())
}

fn text(arguments: &SubdivideArguments, report: &Report) -> String {
    let SubdivideArguments { vertex_table, face_table, report: report_file, .. } = arguments;
    let mut text = if report.levels.is_empty() { String::new() } else { report::table(&report.levels).to_string() };
    let others = [vertex_table, face_table, report_file].into_iter().flatten().map(PathBuf::as_path);
    let line = |path: &Path, what: &dyn Display| format!("wrote {}{what}\n", path.display());
    let Sizes { vertices, faces, .. } = report.totals.sizes;
    let sizes = format!(": {}, {}", count(vertices, "vertex", "vertices"), count(faces, "face", "faces"));
    text.extend(others.map(|path| line(path, &"")));
    text.push_str(&line(&arguments.output, &sizes));
    text
}
