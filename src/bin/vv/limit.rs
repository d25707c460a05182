//! `vv limit`: a mesh in, the same mesh with its vertices on the limit surface out.

use serde::Serialize;
use vvmesh::attributes::{NormalRule, ObjAttributes, ObjRules};
use vvmesh::glam::DVec3;
use vvmesh::io::{FaceAttributes, Format};
use vvmesh::limit::{AnyLimit, ButterflyLimit, Limit, LoopLimit, ModifiedButterflyLimit, Normals, Sqrt3Limit};
use vvmesh::step::{History, Keep};
use vvmesh::{Mesh, VertexId};

use crate::Outcome;
use crate::args::{LimitArguments, LimitName, MethodName, RefineArguments, SchemeName, loop_weights};
use crate::attributes::{self, Finished};
use crate::console::{Failure, print, print_json, refuse, warning};
use crate::input::Input;
use crate::outputs::{self, MESH, OUT};
use crate::table::count;
use crate::{input, sharp};

/// How many examples a warning gives.
const EXAMPLES: usize = 3;

#[derive(Serialize)]
struct Report {
    mesh: String,
    output: String,
    scheme: String,
    vertices: usize,
    faces: usize,
    /// How many were written; `None` if none were asked for.
    normals: Option<usize>,
    /// The vertices that have none on some side, or no side.
    without_normal: Vec<usize>,
}

pub(crate) fn run(arguments: &LimitArguments) -> Result<Outcome, Failure> {
    refuse_without_meaning(arguments)?;
    outputs::check_mesh(&arguments.output)?;
    let mut inputs = vec![(MESH, arguments.mesh.as_path())];
    inputs.extend(arguments.tags.sharp.as_deref().map(|path| ("--sharp", path)));
    outputs::check(&[(OUT, &arguments.output)], &inputs)?;

    let with_tags = arguments.tags.of_mesh.is_some();
    let Input { mut mesh, said, tags, .. } = input::read_mesh(&arguments.mesh, with_tags)?;
    sharp::tag(&mut mesh, &arguments.mesh, tags.as_ref(), &arguments.tags)?;
    sharp::refuse_unblended(&mesh, arguments.scheme == LimitName::Loop, arguments.scheme)?;
    refuse_unfaded("", &mesh)?;
    let limit = limit(arguments);
    let mut said = attributes::for_output(&arguments.mesh, &arguments.output, said);
    if arguments.normals && said.is_none() {
        said = Some((mesh.to_face_list(), FaceAttributes::default()));
    }
    let mut attributes = match said {
        Some((triangles, said)) => {
            let normals = if arguments.normals { NormalRule::Limit(limit) } else { NormalRule::Keep };
            let (history, rules) = (History::new(&mesh, Keep::default()), ObjRules { normals, ..ObjRules::default() });
            let attributes = ObjAttributes::new(&mesh, &history, &triangles, said, rules)?;
            attributes::tell_of_changes(&arguments.mesh, &attributes);
            Some(attributes)
        }
        None => None,
    };
    let positions = limit_positions("", &mesh, &limit)?;
    attributes.iter_mut().for_each(|attributes| attributes.move_to_limit(&mesh, &limit));
    let normals = attributes.as_ref().and_then(ObjAttributes::limit_normals);
    let without = normals.map_or(Vec::new(), |normals| without_normal(&limit, &mesh, normals));
    mesh.positions_mut().copy_from_slice(&positions);
    let finished = Finished::new(&arguments.mesh, &mesh, attributes);
    finished.save(&arguments.output)?;
    finished.tell_of_rounding(&arguments.output);

    let report = Report {
        mesh: arguments.mesh.display().to_string(),
        output: arguments.output.display().to_string(),
        scheme: arguments.scheme.to_string(),
        vertices: mesh.vertex_count(),
        faces: mesh.face_count(),
        normals: arguments.normals.then(|| finished.normal_count()),
        without_normal: without.iter().map(|v| v.index()).collect(),
    };
    if arguments.json {
        print_json(&report)?
    } else {
        print(&text(&report))?
    }
    Ok(Outcome::Done)
}

/// Moves every vertex, and what is said of it, to where infinitely many steps would bring it; a refusal begins with
/// `option`.
pub(crate) fn move_vertices(
    option: &str,
    mesh: &mut Mesh,
    attributes: Option<&mut ObjAttributes>,
    limit: &(impl Limit + Sync),
) -> Result<(), Failure> {
    let positions = limit_positions(option, mesh, limit)?;
    if let Some(attributes) = attributes {
        attributes.move_to_limit(mesh, limit);
    }
    mesh.positions_mut().copy_from_slice(&positions);
    Ok(())
}

/// Where infinitely many steps would bring the vertices; a refusal begins with `option`.
fn limit_positions(option: &str, mesh: &Mesh, limit: &(impl Limit + Sync)) -> Result<Vec<DVec3>, Failure> {
    refuse_unfaded(option, mesh)?;
    let positions = limit.positions(mesh);
    if let Some(k) = positions.iter().position(|position| !position.is_finite()) {
        return refuse(format!(
            "{option}the limit of {} is not finite; scale the mesh down. Nothing was written",
            VertexId::new(k)
        ));
    }
    Ok(positions)
}

/// Refuses a mesh that has no known limit yet; the refusal begins with `option`.
fn refuse_unfaded(option: &str, mesh: &Mesh) -> Result<(), Failure> {
    let around = mesh.neighborhood();
    let steps =
        if mesh.tags().has_semi_sharp() { mesh.vertices().map(|v| around.semi_sharp_steps(v)).max() } else { None };
    match steps {
        None | Some(0) => Ok(()),
        Some(steps) => refuse(format!(
            "{option}edges or vertices of finite sharpness are left, and the limit is known when they have faded: refine \
             by {} everywhere. Nothing was written",
            count(steps as usize, "more level", "more levels")
        )),
    }
}

/// The limit of a refinement at its vertices, or why none is known.
pub(crate) fn of_refinement(arguments: &RefineArguments) -> Result<AnyLimit, &'static str> {
    match (arguments.scheme, arguments.method) {
        (SchemeName::Loop, _) => Ok(LoopLimit::new(loop_weights(arguments.weights)).into()),
        (SchemeName::Sqrt3, MethodName::Uniform) => Ok(Sqrt3Limit.into()),
        (SchemeName::Sqrt3, _) => Err("its limits are known after `uniform` steps only"),
        (SchemeName::Butterfly | SchemeName::ModifiedButterfly | SchemeName::Midpoint, _) => {
            Err("its vertices stay where they are made, which is their limit")
        }
        (SchemeName::FourEight, _) => Err("its limits are not known"),
    }
}

/// Refuses a refined mesh the limit of which is not known yet; the refusal begins with `option`.
pub(crate) fn refuse_unready(option: &str, mesh: &Mesh, arguments: &RefineArguments) -> Result<(), Failure> {
    if arguments.scheme == SchemeName::Sqrt3
        && arguments.levels() % 2 == 1
        && mesh.vertices().any(|v| mesh.is_boundary(v))
    {
        return refuse(format!(
            "{option}the mesh has a boundary, of which two levels of sqrt3 cut the edges once, and the limit is known after \
             both: take an even number of levels. Nothing was written"
        ));
    }
    refuse_unfaded(option, mesh)
}

fn limit(arguments: &LimitArguments) -> AnyLimit {
    match arguments.scheme {
        LimitName::Loop => LoopLimit::new(loop_weights(arguments.weights)).into(),
        LimitName::Butterfly => ButterflyLimit.into(),
        LimitName::ModifiedButterfly => ModifiedButterflyLimit.into(),
        LimitName::Sqrt3 => Sqrt3Limit.into(),
    }
}

/// Refuses options that would do nothing under the scheme, or that the format has no place for.
fn refuse_without_meaning(arguments: &LimitArguments) -> Result<(), Failure> {
    let scheme = arguments.scheme;
    if arguments.weights.is_some() && scheme != LimitName::Loop {
        return refuse(format!("--weights has no meaning with --scheme {scheme}: its weights are fixed; leave it out"));
    }
    match arguments.tags.first_given() {
        Some(option) if matches!(scheme, LimitName::Butterfly | LimitName::Sqrt3) => {
            return refuse(format!(
                "{option} has no meaning with --scheme {scheme}: its weights know neither creases nor corners; leave it out"
            ));
        }
        _ => {}
    }
    match Format::from_ending(&arguments.output) {
        Some(format @ (Format::Off | Format::Ply)) if arguments.normals => refuse(format!(
            "--normals: {format} has one normal for a vertex, and one at a sharp edge has two; write OBJ"
        )),
        Some(Format::Stl) if arguments.normals => {
            refuse("--normals: STL has normals of triangles, and none at their corners; write OBJ")
        }
        _ => Ok(()),
    }
}

/// The vertices that have no normal on some side, or no side, which is told.
fn without_normal(limit: &AnyLimit, mesh: &Mesh, normals: &Normals) -> Vec<VertexId> {
    let is_without = |&v: &VertexId| normals.of(v).is_empty() || normals.of(v).contains(&None);
    let without: Vec<VertexId> = mesh.vertices().filter(is_without).collect();
    if !without.is_empty() {
        warn_of_missing(limit, mesh, normals, &without);
    }
    without
}

fn warn_of_missing(limit: &AnyLimit, mesh: &Mesh, normals: &Normals, without: &[VertexId]) {
    let reason = |v: VertexId| {
        let Some(side) = normals.of(v).iter().position(Option::is_none) else {
            return if mesh.ring(v).valence() == 0 { "isolated" } else { "the tip of a cone" };
        };
        match limit.tangents(mesh, v, side) {
            None => "the scheme has no tangent plane there",
            Some(_) => "its tangents vanish or are parallel",
        }
    };
    let examples: Vec<String> = without.iter().take(EXAMPLES).map(|&v| format!("{v} ({})", reason(v))).collect();
    warning(format_args!(
        "{} without a normal, on one side at least: {}{}; faces there are written without normals",
        count(without.len(), "vertex is", "vertices are"),
        examples.join(", "),
        if without.len() > EXAMPLES { ", ..." } else { "" }
    ));
}

fn text(report: &Report) -> String {
    let Report { output, vertices, faces, normals, .. } = report;
    let normals = normals.map_or(String::new(), |normals| format!(", {}", count(normals, "normal", "normals")));
    format!("wrote {output}: {}, {}{normals}\n", count(*vertices, "vertex", "vertices"), count(*faces, "face", "faces"))
}
