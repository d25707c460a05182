//! From a file to faces, and from faces to a mesh; what was done on the way is told.

use std::path::Path;

use vvmesh::Mesh;
use vvmesh::error::BuildError;
use vvmesh::io::{self, FaceAttributes, Loaded};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Expression, Selection};
use vvmesh::soup::{FaceList, Triangulation};

use crate::console::{Failure, note, refuse};
use crate::table::count;

/// Reads a file and tells what was ignored in it.
pub(crate) fn read(path: &Path) -> Result<Loaded, Failure> {
    let loaded = io::read(path)?;
    for ignored in &loaded.notes {
        note(format_args!("{}: {ignored}", path.display()));
    }
    Ok(loaded)
}

/// Reads a file and makes a mesh of it; polygons are cut into triangles, and that is told.
pub(crate) fn read_mesh(path: &Path) -> Result<Mesh, Failure> {
    let faces = read(path)?.faces;
    mesh_of(path, &faces, triangulation(path, &faces)?.as_ref())
}

/// A mesh, and what its file says beside.
pub(crate) struct Input {
    pub(crate) mesh: Mesh,
    /// The triangles in the order of the file, and what it says of them; `None` if it says nothing.
    pub(crate) said: Option<(FaceList, FaceAttributes)>,
}

/// As [`read_mesh`], for a mesh that is written again.
pub(crate) fn read_mesh_with_attributes(path: &Path) -> Result<Input, Failure> {
    let Loaded { faces, attributes, .. } = read(path)?;
    let cut = triangulation(path, &faces)?;
    let mesh = mesh_of(path, &faces, cut.as_ref())?;
    let said = (!attributes.is_empty()).then(|| match cut {
        Some(cut) => {
            let attributes = attributes.of_triangles(&faces, &cut);
            (FaceList::from_triangles(faces.positions, &cut.triangles), attributes)
        }
        None => (faces, attributes),
    });
    Ok(Input { mesh, said })
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

/// An expression given with an option, and the files that it named.
pub(crate) fn parse_expression(option: &str, text: &str) -> Result<(Expression, Vec<std::path::PathBuf>), Failure> {
    let mut files = Vec::new();
    let expression = Expression::parse(text, &mut |path| {
        files.push(path.to_owned());
        std::fs::read_to_string(path)
    });
    match expression {
        Ok(expression) => Ok((expression, files)),
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
        Err(error) => refuse(format!("{option}: {error}")),
    }
}
