//! What the commands that refine do alike: what was asked for is checked, the mesh is tagged, all levels are made.

use std::path::PathBuf;

use vvmesh::adaptive::{Incremental, SimpleMoving};
use vvmesh::certify::Certificate;
use vvmesh::error::{ConfigError, RefineError};
use vvmesh::io::{FaceAttributes, ObjTags};
use vvmesh::scheme::{AnyScheme, Butterfly, FourEight, Loop, Midpoint, ModifiedButterfly, Sqrt3};
use vvmesh::select::{Elements, Expression};
use vvmesh::soup::FaceList;
use vvmesh::split::Diagonal;
use vvmesh::step::{Blocks, Cause, Keep, SplitKind, Spoiler};
use vvmesh::subdivide::{AnyMethod, Control, Follower, Subdivider};
use vvmesh::until::Until;
use vvmesh::{Mesh, Triangle, VertexId};

use crate::aim::Aim;
use crate::args::{BlocksName, BoundaryName, DiagonalName, MethodName, RefineArguments, SchemeName, loop_weights};
use crate::console::{Failure, note, refuse, warning};
use crate::input::{FaceNumbers, SELECT_EACH};
use crate::memory::FaceLimit;
use crate::outputs::{MESH, Named};
use crate::progress::Bar;
use crate::run::Run;
use crate::table::count;
use crate::{fields, input, limit, sharp};

/// The expression if none is given.
const ALL: &str = "all";

/// What stands in place of an expression if `--until` selects.
const UNTIL: &str = "until";

/// How many examples a warning gives.
const EXAMPLES: usize = 3;

/// Looks at the arguments before any work is done. Lists of values tell the number of levels, which is noted there.
pub(crate) fn prepare(arguments: &mut RefineArguments) -> Result<(Subdivider, Selecting), Failure> {
    let selecting = Selecting::new(arguments)?;
    arguments.levels = levels(arguments, &selecting)?;
    let scheme = scheme(arguments);
    refuse_without_meaning(arguments, &scheme)?;
    if arguments.until.is_some() {
        method(arguments)
            .and_then(|method| Until::allow(&method))
            .or_else(|error| refuse(format!("--until: {error}")))?;
    }
    Ok((subdivider(arguments, scheme)?, selecting))
}

/// How many steps are made, or at most.
fn levels(arguments: &RefineArguments, selecting: &Selecting) -> Result<Option<u8>, Failure> {
    let values = selecting.expression.level_count();
    match (arguments.levels, values) {
        (Some(levels), Some(values)) if usize::from(levels) != values => refuse(format!(
            "--levels {levels} does not agree with --select-each, which has {values} values, one a level; leave --levels out"
        )),
        (None, None) if arguments.accuracy.is_none() && arguments.until.is_none() => {
            refuse("--levels <N> is missing; only a list of values in --select-each takes its place".to_owned())
        }
        (None, Some(values)) => Ok(u8::try_from(values).ok()),
        (levels, _) => Ok(levels),
    }
}

/// Tags the input, and answers with the boundary policy.
pub(crate) fn tag(
    mesh: &mut Mesh,
    tags: Option<&ObjTags>,
    arguments: &RefineArguments,
) -> Result<BoundaryName, Failure> {
    let boundary = sharp::tag(mesh, &arguments.mesh, tags, &arguments.tags)?;
    sharp::refuse_unblended(mesh, scheme(arguments).blends_sharpness(), arguments.scheme)?;
    Ok(boundary)
}

/// The files that are read.
pub(crate) fn inputs<'a>(arguments: &'a RefineArguments, selecting: &'a Selecting) -> Vec<Named<'a>> {
    let mut inputs = vec![(MESH, arguments.mesh.as_path())];
    inputs.extend(arguments.tags.sharp.iter().map(|file| ("--sharp", file.as_path())));
    inputs.extend(selecting.files.iter().map(|file| (selecting.option, file.as_path())));
    inputs
}

/// A run before its first step, with what it is to reach.
pub(crate) fn begin(
    mesh: Mesh,
    arguments: &RefineArguments,
    subdivider: Subdivider,
    keep: Keep,
) -> Result<Run, Failure> {
    let aim = Aim::new(arguments, &mesh)?;
    let mut run = Run::new(mesh, subdivider, keep);
    run.aim = aim;
    Ok(run)
}

/// Refuses levels of a selection that is followed, if already the faces inside of it become too many.
fn refuse_growth(run: &Run, arguments: &RefineArguments, limit: FaceLimit) -> Result<(), Failure> {
    let (first, faces) = (run.next_level(), run.mesh.face_count());
    let last = run.made_levels().saturating_add(arguments.levels());
    let inside = match run.selection.elements() {
        Elements::Vertices(vertices) if vertices.len() == run.mesh.vertex_count() => faces,
        Elements::Vertices(_) => {
            let is_inside = |triangle: &Triangle| triangle.corners().iter().all(|&v| run.selection.contains(v));
            run.mesh.triangles().filter(is_inside).count()
        }
        Elements::Faces(faces) => faces.len(),
        // A face may keep some of its own.
        Elements::Edges(_) => 0,
    };
    let (parts, splits_inside) = match scheme(arguments).split_kind() {
        SplitKind::Quadrisect => (4, true),
        // What lies inside of a part does not stay there.
        SplitKind::Trisect => (3, false),
        SplitKind::Bisect => (2, false),
    };
    let growing = match arguments.method {
        MethodName::Uniform => faces,
        MethodName::Mobile => 0,
        // Of the faces that are shown some may be taken back.
        method if method.is_on_hierarchy() && first > 1 => 0,
        // Nor are edges split then because they are selected.
        _ if arguments.min_move.is_some() => 0,
        _ if splits_inside || inside == faces => inside,
        _ => 0,
    };
    limit.refuse_growth(faces, growing, parts, first..=last)
}

/// Makes all levels, or as many as it takes to reach what is to be reached; [`Run::aim`] tells whether it was.
pub(crate) fn refine(
    run: &mut Run,
    arguments: &RefineArguments,
    selecting: &Selecting,
    limit: FaceLimit,
    mut follower: Option<&mut dyn Follower>,
    bar: &mut Bar,
) -> Result<(), Failure> {
    let reach = scheme(arguments).reach();
    let (first, last) = (run.next_level(), run.made_levels().saturating_add(arguments.levels()));
    let mut aim = run.aim.take();
    match &mut aim {
        Some(aim) => aim.look(run)?,
        None if selecting.each_level => {}
        None => refuse_growth(run, arguments, limit)?,
    }
    for level in first..=last {
        if aim.as_ref().is_some_and(Aim::is_reached) {
            break;
        }
        if selecting.each_level && level > first {
            bar.hide();
            selecting.select(run, usize::from(level - first) + 1)?;
        }
        // The reasons are those before the step; a selection that follows needs none.
        let doubts = match run.certificate().zip(reach) {
            Some((certificate, reach)) if selecting.each_level => {
                let unproven = certificate.unproven(&run.selection, reach);
                unproven.iter().take(EXAMPLES).map(|&v| doubt(&certificate, &run.mesh, v)).collect()
            }
            _ => Vec::new(),
        };
        let error = aim.as_ref().map(Aim::error);
        let mut show = |progress| bar.show(level, error, progress);
        let follower = follower.as_mut().map(|follower| &mut **follower as &mut dyn Follower);
        let step = run.step(&mut Control { max_faces: Some(limit.faces), progress: Some(&mut show), follower });
        let step = match step {
            Ok(step) => step,
            Err(error) => {
                bar.hide();
                let reason = match error {
                    RefineError::TooManyFaces { needed, .. } => limit.excess_of(format_args!("level {level}"), needed),
                    ref other => format!("level {level}: {other}"),
                };
                if aim.is_some() && matches!(error, RefineError::TooManyFaces { .. }) {
                    note(reason);
                    break;
                }
                return refuse(format!("{reason}. Nothing was written"));
            }
        };
        if let Some(aim) = &mut aim {
            aim.look(run)?;
        }
        if step.did_nothing() {
            break;
        }
        if level == first {
            bar.hide();
            tell_of_unmatched(run);
        }
        if !step.unproven.is_empty() {
            bar.hide();
            warn_of_unproven(level, &step.unproven, step.selected, &doubts);
        }
    }
    bar.hide();
    run.aim = aim;
    Ok(())
}

/// The expression, and how often it is evaluated.
pub(crate) struct Selecting {
    option: &'static str,
    expression: Expression,
    /// The files that the expression names.
    files: Vec<PathBuf>,
    pub(crate) each_level: bool,
}

impl Selecting {
    fn new(arguments: &RefineArguments) -> Result<Self, Failure> {
        let each_level = arguments.select_each.is_some();
        let option = if each_level { SELECT_EACH } else { "--select" };
        let text = arguments.select_each.as_deref().or(arguments.select.as_deref()).unwrap_or(ALL);
        let (expression, files) = input::parse_expression(option, text, arguments.view.camera)?;
        Ok(Self { option, expression, files, each_level })
    }

    /// Takes the numbers that faces have in the file.
    pub(crate) fn number_faces(&mut self, numbers: FaceNumbers) {
        self.expression = self.expression.clone().with_faces_numbered_by(numbers);
    }

    /// Takes the fields that the file has.
    pub(crate) fn take_fields(&mut self, said: Option<&(FaceList, FaceAttributes)>) -> Result<(), Failure> {
        self.expression = fields::of_file(self.option, self.expression.clone(), said.map(|(_, said)| said))?;
        Ok(())
    }

    /// Evaluates the expression on the mesh as it is, for so many steps from now; picking nothing is legal, and told.
    pub(crate) fn select(&self, run: &mut Run, step: usize) -> Result<(), Failure> {
        let expression = self.expression.at_level(step).expect("there are as many steps as values");
        let expression = fields::of_run(expression, run.attributes.as_ref());
        run.selection = input::evaluate(self.option, &expression, &run.mesh, &mut run.scratch)?;
        if run.selection.is_empty() {
            let level = if self.each_level { format!("level {}: ", run.next_level()) } else { String::new() };
            note(format_args!("{level}{} picks nothing", self.option));
        }
        Ok(())
    }
}

/// What was asked for, as it is told and compared: an expression, or [`UNTIL`].
pub(crate) fn expression(arguments: &RefineArguments) -> &str {
    let otherwise = if arguments.until.is_some() { UNTIL } else { ALL };
    arguments.select_each.as_deref().or(arguments.select.as_deref()).unwrap_or(otherwise)
}

/// The expression with the camera that looks, for what is to know whether both are the same as before.
pub(crate) fn expression_seen(arguments: &RefineArguments) -> String {
    let expression = expression(arguments);
    match arguments.view.camera {
        Some(camera) => format!("{expression} --camera {camera}"),
        None => expression.to_owned(),
    }
}

pub(crate) fn scheme(arguments: &RefineArguments) -> AnyScheme {
    match arguments.scheme {
        SchemeName::Loop => Loop::new(loop_weights(arguments.weights)).into(),
        SchemeName::Butterfly => Butterfly.into(),
        SchemeName::ModifiedButterfly => ModifiedButterfly.into(),
        SchemeName::Midpoint => Midpoint.into(),
        SchemeName::Sqrt3 => Sqrt3::default().into(),
        SchemeName::FourEight => FourEight::new(blocks(arguments)).into(),
    }
}

fn blocks(arguments: &RefineArguments) -> Blocks {
    match arguments.blocks {
        None | Some(BlocksName::Maximum) => Blocks::Maximum,
        Some(BlocksName::LongestEdge) => Blocks::LongestEdge,
    }
}

fn subdivider(arguments: &RefineArguments, scheme: AnyScheme) -> Result<Subdivider, Failure> {
    let subdivider = match arguments.min_move {
        Some(least) => SimpleMoving::new(least).map(|method| Subdivider::new(scheme, method)),
        None => method(arguments).and_then(|method| Subdivider::of(scheme, method)),
    };
    match subdivider {
        Ok(subdivider) => Ok(subdivider.with_diagonal(diagonal(arguments))),
        Err(error) => refuse(format!("--{error}")),
    }
}

/// Whether faces with two split edges may arise, and are cut by a diagonal that can be chosen.
pub(crate) fn draws_diagonals(arguments: &RefineArguments) -> bool {
    let in_four = scheme(arguments).split_kind() == SplitKind::Quadrisect;
    in_four && matches!(arguments.method, MethodName::Simple | MethodName::Mobile)
}

pub(crate) fn diagonal_name(arguments: &RefineArguments) -> DiagonalName {
    arguments.diagonal.unwrap_or(DiagonalName::Valence)
}

fn diagonal(arguments: &RefineArguments) -> Diagonal {
    match diagonal_name(arguments) {
        DiagonalName::Longest => Diagonal::Longest,
        DiagonalName::Shortest => Diagonal::Shortest,
        DiagonalName::Valence => Diagonal::Valence,
        DiagonalName::Id => Diagonal::ById,
    }
}

fn method(arguments: &RefineArguments) -> Result<AnyMethod, ConfigError> {
    Ok(match arguments.method {
        MethodName::Uniform => AnyMethod::Uniform,
        MethodName::Simple => AnyMethod::Simple,
        MethodName::Incremental => AnyMethod::Incremental(Incremental::new(rings(arguments))?),
        MethodName::RedGreen => AnyMethod::RedGreen,
        MethodName::RedGreenRestricted => AnyMethod::RedGreenRestricted,
        MethodName::Dynamic => AnyMethod::Dynamic,
        MethodName::Mobile => AnyMethod::Mobile(arguments.accuracy.expect("without it the arguments are refused")),
    })
}

pub(crate) fn rings(arguments: &RefineArguments) -> usize {
    arguments.rings.unwrap_or(1)
}

/// Refuses options that would do nothing under the scheme or the method.
fn refuse_without_meaning(arguments: &RefineArguments, scheme: &AnyScheme) -> Result<(), Failure> {
    let RefineArguments { scheme: name, method, .. } = arguments;
    let is_loop = *name == SchemeName::Loop;
    let reads_tags = scheme.reads_tags();
    let refusals = [
        (
            "--rings",
            arguments.rings.is_some() && *method != MethodName::Incremental,
            format!("--method {method}: only `incremental` expands the selection"),
        ),
        ("--weights", arguments.weights.is_some() && !is_loop, format!("--scheme {name}: its weights are fixed")),
        (
            "--accuracy",
            arguments.accuracy.is_some() && *method != MethodName::Mobile,
            format!("--method {method}: only `mobile` looks at limits"),
        ),
        (
            "--diagonal",
            arguments.diagonal.is_some() && !draws_diagonals(arguments),
            format!("--scheme {name} --method {method}: no face has two split edges, or it has a rule of its own"),
        ),
        (
            "--min-move",
            arguments.min_move.is_some() && *method != MethodName::Simple,
            format!("--method {method}: only `simple` splits each edge for itself"),
        ),
        (
            "--min-move",
            arguments.min_move.is_some() && *name != SchemeName::Butterfly,
            format!("--scheme {name}: it is the movement of a new vertex under `butterfly`, which moves no other"),
        ),
        (
            "--until",
            arguments.until.is_some() && !is_loop,
            format!("--scheme {name}: the distance to the limit surface is known under `loop` alone"),
        ),
        (
            "--limit",
            arguments.limit && arguments.until.is_some(),
            "--until: what is reached is the distance of vertices that stay off the surface".to_owned(),
        ),
        (
            "--limit",
            arguments.limit && *method == MethodName::Mobile,
            "--method mobile: vertices stay where they are near enough".to_owned(),
        ),
        (
            "--blocks",
            arguments.blocks.is_some() && *name != SchemeName::FourEight,
            format!("--scheme {name}: only `four-eight` pairs faces"),
        ),
    ];
    let limit = limit::of_refinement(arguments).err().filter(|_| arguments.limit);
    let limit = limit.map(|reason| ("--limit", true, format!("--scheme {name} --method {method}: {reason}")));
    let creases = (
        "--creases",
        arguments.tags.creases.is_some() && !scheme.blends_sharpness(),
        format!("--scheme {name}: its weights know no finite sharpness"),
    );
    let tag = arguments.tags.first_given().filter(|_| !reads_tags);
    let tag =
        tag.map(|option| (option, true, format!("--scheme {name}: its weights know neither creases nor corners")));
    match refusals.iter().chain(&limit).chain([&creases]).chain(&tag).find(|(_, refused, _)| *refused) {
        Some((option, _, reason)) => refuse(format!("{option} has no meaning with {reason}; leave it out")),
        None => Ok(()),
    }
}

/// Tells how many input faces are in no block, if any.
fn tell_of_unmatched(run: &Run) {
    if let Some(unmatched @ 1..) = run.history.unmatched_faces() {
        let faces = count(unmatched, "face is", "faces are");
        note(format_args!("{faces} in no block and split in three"));
    }
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
