//! What a file says of its faces, from the file through refinement to the file.

use std::path::Path;

use vvmesh::attributes::{Across, Blend, LeftOut, NormalRule, ObjAttributes, ObjRules, Seams};
use vvmesh::error::WriteError;
use vvmesh::glam::DVec3;
use vvmesh::io::{FaceAttributes, Format, save, save_with};
use vvmesh::limit::LoopLimit;
use vvmesh::soup::FaceList;
use vvmesh::{Mesh, Triangle, VertexId};

use crate::args::{ColorsName, MethodName, NormalsName, SchemeName, SubdivideArguments, TextureName, loop_weights};
use crate::console::{Failure, note, refuse};
use crate::run::Run;
use crate::table::count;

/// Refuses options that the output or the scheme give no meaning.
pub(crate) fn refuse_without_meaning(arguments: &SubdivideArguments) -> Result<(), Failure> {
    let format = Format::from_ending(&arguments.output);
    let is_obj = format == Some(Format::Obj);
    let has_place = is_obj || format == Some(Format::Ply);
    let given = [
        ("--uv", arguments.uv.is_some(), has_place, "OBJ and PLY are"),
        ("--colors", arguments.colors.is_some(), has_place, "OBJ and PLY are"),
        ("--normals", arguments.normals.is_some(), is_obj, "OBJ is"),
    ];
    let mut given = given.into_iter().filter(|(_, is_given, ..)| *is_given);
    if let Some((option, _, _, formats)) = given.clone().find(|(_, _, has_place, _)| !has_place) {
        let output = arguments.output.display();
        return refuse(format!(
            "{option} has no meaning with -o {output}: only {formats} written with it; leave it out"
        ));
    }
    if let Some((option, ..)) = given.next().filter(|_| arguments.is_unclosed()) {
        return refuse(format!(
            "{option} has no meaning with --method mobile without --close: only positions and faces are written; leave it \
             out"
        ));
    }
    let method = arguments.refine.method;
    if arguments.close && method != MethodName::Mobile {
        return refuse(format!("--close has no meaning with --method {method}: it leaves no cracks; leave it out"));
    }
    let scheme = arguments.refine.scheme;
    if arguments.normals == Some(NormalsName::Limit) && scheme != SchemeName::Loop {
        return refuse(format!(
            "--normals limit has no meaning with --scheme {scheme}: limit normals are known for `loop` only; leave it \
             out"
        ));
    }
    Ok(())
}

/// What a file says as far as the format of the output has a place for it; what has none is told.
pub(crate) fn for_output(
    path: &Path,
    output: &Path,
    said: Option<(FaceList, FaceAttributes)>,
) -> Option<(FaceList, FaceAttributes)> {
    let format = Format::from_ending(output)?;
    let (triangles, said) = said?;
    let held = said.clone().held_by(format);
    if held != said {
        let (written, not) = match format {
            Format::Ply => ("colours and two texture coordinates", "groups, materials, normals or third ones"),
            _ => ("positions and faces", "groups, materials, texture coordinates, normals or colours"),
        };
        note(format_args!(
            "{}: only {written} are written again, not {not}: {format} has no place for them",
            path.display()
        ));
    }
    (!held.is_empty()).then_some((triangles, held))
}

/// What rides along of what a file says, if anything does; what does not is told.
pub(crate) fn to_take_along(
    arguments: &SubdivideArguments,
    mesh: &Mesh,
    said: Option<(FaceList, FaceAttributes)>,
) -> Result<Option<(FaceList, FaceAttributes)>, Failure> {
    let path = arguments.refine.mesh.display();
    let said = for_output(&arguments.refine.mesh, &arguments.output, said);
    if arguments.is_unclosed() {
        if said.is_some() {
            note(format_args!(
                "{path}: only positions and faces are written again: nothing rides along with faces that are not closed, see \
                 --close"
            ));
        }
        return Ok(None);
    }
    let nothing = FaceAttributes::default();
    let words = said.as_ref().map_or(&nothing, |(_, said)| said);
    let missing = [
        ("--uv", arguments.uv.is_some() && words.texture_coordinates.is_empty(), "texture coordinates"),
        ("--colors", arguments.colors.is_some() && words.vertex_colors.is_empty(), "colours"),
        ("--normals drop", arguments.normals == Some(NormalsName::Drop) && words.normals.is_empty(), "normals"),
    ];
    if let Some((option, _, what)) = missing.iter().find(|(_, is_missing, _)| *is_missing) {
        return refuse(format!("{option} has no meaning with {path}: it has no {what}; leave it out"));
    }
    Ok(match said {
        None if arguments.normals.is_some() => Some((mesh.to_face_list(), nothing)),
        said => said,
    })
}

/// Ready to ride along with a run.
pub(crate) fn take_along(
    arguments: &SubdivideArguments,
    run: &Run,
    triangles: &FaceList,
    said: FaceAttributes,
) -> Result<ObjAttributes, Failure> {
    let (texture, seams) = match arguments.uv {
        None | Some(TextureName::Scheme) => (Blend::Scheme, Seams::Scheme),
        Some(TextureName::LinearSeams) => (Blend::Scheme, Seams::Linear),
        Some(TextureName::Linear) => (Blend::Linear, Seams::Linear),
    };
    let colors = match arguments.colors {
        None | Some(ColorsName::Scheme) => Blend::Scheme,
        Some(ColorsName::Linear) => Blend::Linear,
        Some(ColorsName::Nearest) => Blend::Nearest,
    };
    let limit = LoopLimit::new(loop_weights(arguments.refine.weights));
    let normals = match arguments.normals {
        None => NormalRule::Keep,
        Some(NormalsName::Recompute) => NormalRule::Recompute,
        Some(NormalsName::Limit) => NormalRule::Limit(limit.into()),
        Some(NormalsName::Drop) => NormalRule::Drop,
    };
    let rules = ObjRules { texture, seams, colors, normals };
    let attributes = ObjAttributes::new(&run.mesh, &run.history, triangles, said, rules)?;
    if arguments.refine.levels() > 0 || arguments.refine.limit {
        tell_of_changes(&arguments.refine.mesh, &attributes);
    }
    Ok(attributes)
}

/// Tells what of a file changes when the mesh does.
pub(crate) fn tell_of_changes(path: &Path, attributes: &ObjAttributes) {
    let LeftOut { partly_textured, partly_normal, unused_texture, uncolored } = attributes.left_out();
    let triangles = |number| count(number, "triangle", "triangles");
    let told = [
        (
            partly_textured,
            format!("texture coordinates of {} lost, as some corners have none", triangles(partly_textured)),
        ),
        (partly_normal, format!("normals of {} lost, as some corners have none", triangles(partly_normal))),
        (
            unused_texture,
            format!("{} lost", count(unused_texture, "unused texture coordinate", "unused texture coordinates")),
        ),
        (
            uncolored,
            format!("{} no colour, nor has what is made of them", count(uncolored, "vertex has", "vertices have")),
        ),
    ];
    for (_, text) in told.iter().filter(|(number, _)| *number > 0) {
        note(format_args!("{}: {text}", path.display()));
    }
    if attributes.replaces_normals() {
        note(format_args!(
            "{}: normals are computed anew from the faces as they come out, see --normals",
            path.display()
        ));
    }
}

/// Tells which triangles lie across what they should keep apart.
fn tell_of_crossing(path: &Path, mesh: &Mesh, attributes: &ObjAttributes) {
    let Across { seams, hard_edges, sections } = attributes.across(mesh);
    let told = [
        (seams, "across seams", "without texture coordinates"),
        (hard_edges, "across hard edges", "without normals"),
        (sections, "across borders of groups or materials", "with the one or the other"),
    ];
    for (number, place, outcome) in told.into_iter().filter(|(number, ..)| *number > 0) {
        note(format_args!(
            "{}: {} {place}, {outcome}: sqrt3 turns those edges, and back at the next level; take an even number of \
             levels of the whole mesh, or --scheme loop or four-eight",
            path.display(),
            count(number, "triangle lies", "triangles lie"),
        ));
    }
}

/// The refined mesh as it is written.
pub(crate) struct Finished<'a> {
    mesh: &'a Mesh,
    /// Its faces with what is said of them, if anything is.
    with: Option<(FaceList, FaceAttributes)>,
}

impl<'a> Finished<'a> {
    /// The mesh refined from the file at `path`; what that said of triangles which no step could keep is told.
    pub(crate) fn new(path: &Path, mesh: &'a Mesh, attributes: Option<ObjAttributes>) -> Self {
        let finish = |attributes: ObjAttributes| {
            tell_of_crossing(path, mesh, &attributes);
            attributes.finish(mesh)
        };
        Self { mesh, with: attributes.map(finish) }
    }

    /// Other faces than those of the mesh, with its vertices.
    pub(crate) fn of_faces(mesh: &'a Mesh, faces: FaceList) -> Self {
        Self { mesh, with: Some((faces, FaceAttributes::default())) }
    }

    pub(crate) fn face_count(&self) -> usize {
        self.with.as_ref().map_or(self.mesh.face_count(), |(faces, _)| faces.face_count())
    }

    /// How many normals are written.
    pub(crate) fn normal_count(&self) -> usize {
        self.with.as_ref().map_or(0, |(_, said)| said.normals.len())
    }

    /// The faces in the order of the output.
    pub(crate) fn triangles(&self) -> Box<dyn Iterator<Item = Triangle> + '_> {
        match &self.with {
            None => Box::new(self.mesh.triangles()),
            Some((faces, _)) => Box::new(faces.faces().map(|face| {
                let [a, b, c] = [face[0], face[1], face[2]].map(|v| VertexId::new(v as usize));
                Triangle::new(a, b, c)
            })),
        }
    }

    pub(crate) fn save(&self, path: &Path) -> Result<(), WriteError> {
        match &self.with {
            None => save(path, self.mesh),
            Some((faces, said)) => save_with(path, faces, said),
        }
    }

    /// Tells what the format of a file that was written does not hold of the mesh.
    pub(crate) fn tell_of_rounding(&self, path: &Path) {
        match Format::from_ending(path) {
            Some(Format::Stl) => {
                let is_rounded = |position: &&DVec3| position.as_vec3().as_dvec3() != **position;
                let rounded = self.mesh.positions().iter().filter(is_rounded).count();
                let isolated = self.mesh.vertices().filter(|&v| self.mesh.ring(v).valence() == 0).count();
                for (number, what) in [
                    (rounded, "rounded: STL has single precision"),
                    (isolated, "without a face left out: STL has corners of triangles only"),
                ] {
                    if number > 0 {
                        note(format_args!("{}: {} {what}", path.display(), count(number, "vertex", "vertices")));
                    }
                }
            }
            Some(Format::Ply) => {
                let colors = self.with.as_ref().map_or(&[][..], |(_, said)| &said.vertex_colors);
                let is_whole = |value: f64| (255.0 * value).round() / 255.0 == value;
                let is_rounded =
                    |color: &&Option<[f64; 3]>| !color.is_some_and(|color| color.into_iter().all(is_whole));
                let rounded = colors.iter().filter(is_rounded).count();
                if rounded > 0 {
                    note(format_args!(
                        "{}: colours of {} rounded to eight bits, or white where there is none",
                        path.display(),
                        count(rounded, "vertex", "vertices")
                    ));
                }
            }
            _ => {}
        }
    }
}
