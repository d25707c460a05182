//! From a file to faces, and from faces to a mesh; what was done on the way is told.

use std::path::Path;
use std::sync::Arc;

use vvmesh::error::{BuildError, ExpressionError, ExpressionErrorKind, ReadError, SelectError};
use vvmesh::io::{self, FaceAttributes, Format, Loaded, Note, NoteKind, ObjTags};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Expression, Selection};
use vvmesh::soup::{FaceList, Triangulation};
use vvmesh::{Camera, Mesh, Triangle, VertexId};

use crate::console::{Failure, note, refuse};
use crate::table::count;

/// Reads a file and tells what was ignored in it.
pub(crate) fn read(path: &Path) -> Result<Loaded, Failure> {
    let loaded = io::read(path)?;
    tell(path, &loaded.notes);
    Ok(loaded)
}

fn tell<'a>(path: &Path, notes: impl IntoIterator<Item = &'a Note>) {
    for ignored in notes {
        note(format_args!("{}: {ignored}", path.display()));
    }
}

/// The faces of a mesh in the order of its file, those of a polygon as it was cut into triangles.
pub(crate) type FaceNumbers = Arc<[Triangle]>;

fn face_numbers(faces: &FaceList, cut: Option<&Triangulation>) -> FaceNumbers {
    let triangle = |corners: &[u32]| {
        let [a, b, c] = [0, 1, 2].map(|k| VertexId::new(corners[k] as usize));
        Triangle::new(a, b, c)
    };
    match cut {
        None => faces.faces().map(triangle).collect(),
        Some(cut) => cut.triangles.iter().map(|corners| triangle(corners)).collect(),
    }
}

/// A mesh, and what its file says beside.
pub(crate) struct Input {
    pub(crate) mesh: Mesh,
    pub(crate) face_numbers: FaceNumbers,
    /// The triangles in the order of the file, and what it says of them; `None` if it says nothing.
    pub(crate) said: Option<(FaceList, FaceAttributes)>,
    /// The tag lines of the file, if they were asked for.
    pub(crate) tags: Option<ObjTags>,
}

/// The tag lines of a file; that there are none is legal, and told.
fn read_tags(path: &Path, loaded: &Loaded) -> Result<ObjTags, Failure> {
    if loaded.format != Format::Obj {
        return refuse(format!("--tags obj: {} is {}, which has no tag lines", path.display(), loaded.format));
    }
    if loaded.tag_lines.is_empty() {
        note(format_args!("{}: there are no tag lines in it", path.display()));
    }
    loaded.tag_lines.parse().map_err(|error| at_line_of(path, error))
}

/// An error at a line of a file, with its name.
pub(crate) fn at_line_of(path: &Path, error: ReadError) -> Failure {
    ReadError { path: Some(path.to_owned()), ..error }.into()
}

/// Reads a file and makes a mesh of it, with the tag lines of the file if they are asked for; polygons are cut into triangles,
/// and that is told.
pub(crate) fn read_mesh(path: &Path, with_tags: bool) -> Result<Input, Failure> {
    let loaded = io::read(path)?;
    let tags = if with_tags { Some(read_tags(path, &loaded)?) } else { None };
    tell(path, loaded.notes.iter().filter(|note| !with_tags || note.kind != NoteKind::Tags));
    tell(path, tags.iter().flat_map(|tags| &tags.notes));
    let Loaded { faces, attributes, .. } = loaded;
    let cut = triangulation(path, &faces)?;
    let mesh = mesh_of(path, &faces, cut.as_ref())?;
    let face_numbers = face_numbers(&faces, cut.as_ref());
    let said = (!attributes.is_empty()).then(|| match cut {
        Some(cut) => {
            let attributes = attributes.of_triangles(&faces, &cut);
            (FaceList::from_triangles(faces.positions, &cut.triangles), attributes)
        }
        None => (faces, attributes),
    });
    Ok(Input { mesh, face_numbers, said, tags })
}

/// The triangles of a list of faces if some are polygons, which is told.
fn triangulation(path: &Path, faces: &FaceList) -> Result<Option<Triangulation>, Failure> {
    if faces.faces().all(|face| face.len() == 3) {
        return Ok(None);
    }
    // Defects are looked for first, as afterwards the faces have other numbers.
    if let Some(error) = BuildError::from_defects(faces.defects()) {
        return refuse(format!("{}: {error}", path.display()));
    }
    let cut = faces.triangulate();
    note(format_args!(
        "{}: {} cut into triangles ({} convex by a fan, {} others by ear clipping)",
        path.display(),
        count(cut.fanned + cut.clipped, "polygon was", "polygons were"),
        cut.fanned,
        cut.clipped
    ));
    Ok(Some(cut))
}

fn mesh_of(path: &Path, faces: &FaceList, cut: Option<&Triangulation>) -> Result<Mesh, Failure> {
    let (mesh, counted) = match cut {
        None => (Mesh::from_face_list(faces), ""),
        Some(cut) => (
            Mesh::from_triangles(faces.positions.clone(), &cut.triangles),
            "after cutting polygons into triangles, which are counted here: ",
        ),
    };
    mesh.map_err(|error| Failure(format!("{}: {counted}{error}", path.display())))
}

/// The option whose expression is evaluated at every level, and may have a value for each.
pub(crate) const SELECT_EACH: &str = "--select-each";

/// An expression given with an option, and the files that it named. A camera through which nothing in it looks is refused.
pub(crate) fn parse_expression(
    option: &str,
    text: &str,
    camera: Option<Camera>,
) -> Result<(Expression, Vec<std::path::PathBuf>), Failure> {
    let mut files = Vec::new();
    let mut read = |path: &Path| {
        files.push(path.to_owned());
        std::fs::read_to_string(path)
    };
    let expression = match camera {
        Some(camera) => Expression::parse_seen(text, camera, &mut read),
        None => Expression::parse(text, &mut read),
    };
    match expression {
        Ok(expression) if expression.level_count().is_some() && option != SELECT_EACH => refuse(format!(
            "{option} '{text}': it is evaluated once, and a list has a value for each level; a list belongs to {SELECT_EACH}"
        )),
        Ok(expression) if camera.is_some() && !expression.uses_camera() => refuse(format!(
            "--camera has no meaning with {option} '{text}': nothing in it looks through a camera; leave it out"
        )),
        Ok(expression) => Ok((expression, files)),
        Err(error @ ExpressionError { kind: ExpressionErrorKind::NoCamera { .. }, .. }) => {
            refuse(format!("{option} '{text}': {error}; give one with --camera"))
        }
        Err(error) => refuse(format!("{option} '{text}': {error}")),
    }
}

/// What an expression picks; nothing is legal, and told.
pub(crate) fn evaluate(
    option: &str,
    expression: &Expression,
    mesh: &Mesh,
    scratch: &mut Scratch,
) -> Result<Selection, Failure> {
    match expression.select(mesh, scratch) {
        Ok(selection) => Ok(selection),
        Err(error @ SelectError::NoField { .. }) => {
            refuse(format!("{option}: {error}: colours ride along only where they are written, to OBJ or PLY"))
        }
        Err(error) => refuse(format!("{option}: {error}")),
    }
}
