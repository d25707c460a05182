//! From a file to faces, and from faces to a mesh; what was done on the way is told.

use std::path::Path;

use vvmesh::Mesh;
use vvmesh::error::BuildError;
use vvmesh::io::{self, Loaded};
use vvmesh::scratch::Scratch;
use vvmesh::select::{Criterion, Expression, Selection};
use vvmesh::soup::FaceList;

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
    mesh_of(path, read(path)?.faces)
}

/// As [`read_mesh`], for a mesh that is written again: what will be missing there is told.
pub(crate) fn read_mesh_to_write(path: &Path) -> Result<Mesh, Failure> {
    let loaded = read(path)?;
    if !loaded.attributes.is_empty() {
        note(format_args!(
            "{}: only positions and faces are written again, not groups, materials, texture coordinates, normals or colours",
            path.display()
        ));
    }
    mesh_of(path, loaded.faces)
}

fn mesh_of(path: &Path, faces: FaceList) -> Result<Mesh, Failure> {
    let refused = |error: &dyn std::fmt::Display| Failure(format!("{}: {error}", path.display()));
    if faces.faces().all(|face| face.len() == 3) {
        return Mesh::from_face_list(&faces).map_err(|error| refused(&error));
    }
    // Defects are looked for first, as afterwards the faces have other numbers.
    if let Some(error) = BuildError::from_defects(faces.defects()) {
        return Err(refused(&error));
    }
    let cut = faces.triangulate();
    note(format_args!(
        "{}: {} cut into triangles ({} convex by a fan, {} others by ear clipping)",
        path.display(),
        count(cut.fanned + cut.clipped, "polygon was", "polygons were"),
        cut.fanned,
        cut.clipped
    ));
    let FaceList { positions, .. } = faces;
    Mesh::from_triangles(positions, &cut.triangles).map_err(|error| {
        refused(&format_args!("after cutting polygons into triangles, which are counted here: {error}"))
    })
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
