//! Files to be written, looked at before any work is done.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use vvmesh::io::Format;

use crate::console::{Failure, refuse};

/// A file and the argument that names it.
pub(crate) type Named<'a> = (&'static str, &'a Path);

/// The names of the mesh that is read and of the one that is written, which may be the same file.
pub(crate) const MESH: &str = "MESH";
/// See [`MESH`].
pub(crate) const OUT: &str = "-o";

/// Refuses outputs that could not be written at the end, that would overwrite each other, or one of the inputs.
pub(crate) fn check(outputs: &[Named<'_>], inputs: &[Named<'_>]) -> Result<(), Failure> {
    let mut seen: Vec<(&str, PathBuf)> = Vec::new();
    for &(option, path) in inputs {
        // An input that is not there is told when it is read.
        if let Ok(file) = fs::canonicalize(path) {
            seen.push((option, file));
        }
    }
    for &(option, path) in outputs {
        let file = writable(path).map_err(|reason| Failure(format!("{option}: {}: {reason}", path.display())))?;
        if let Some((other, _)) = seen.iter().find(|(other, seen)| *seen == file && (option, *other) != (OUT, MESH)) {
            return refuse(format!("{option}: {} is the file of {other} too; name another", path.display()));
        }
        seen.push((option, file));
    }
    Ok(())
}

/// Refuses a name whose ending tells no format of meshes.
pub(crate) fn check_mesh(path: &Path) -> Result<(), Failure> {
    match Format::from_ending(path) {
        Some(_) => Ok(()),
        None => refuse(format!("{OUT}: {}: the name must end in .obj, .off, .ply or .stl", path.display())),
    }
}

/// The one name of a file that can be written, whether it is there already or not.
fn writable(path: &Path) -> Result<PathBuf, String> {
    let Some(name) = path.file_name() else {
        return Err("this names no file".to_owned());
    };
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    match fs::metadata(folder) {
        Ok(metadata) if metadata.is_dir() => {}
        Ok(_) => return Err(format!("{} is no folder", folder.display())),
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Err(format!("there is no folder {}", folder.display()));
        }
        Err(error) => return Err(error.to_string()),
    }
    match fs::metadata(path) {
        Ok(metadata) if metadata.is_dir() => Err("this is a folder; name a file in it".to_owned()),
        Ok(metadata) if metadata.permissions().readonly() => Err("the file there is read-only".to_owned()),
        Ok(metadata) => {
            let file = fs::canonicalize(path).map_err(|error| error.to_string())?;
            // What is no file, such as /dev/stdout, is written to as it is.
            if metadata.is_file() { probe(file.parent().unwrap_or(folder)).map(|()| file) } else { Ok(file) }
        }
        Err(_) => {
            probe(folder)?;
            fs::canonicalize(folder).map(|folder| folder.join(name)).map_err(|error| error.to_string())
        }
    }
}

/// Whether a file can be made in a folder: files are written beside their place and then renamed.
fn probe(folder: &Path) -> Result<(), String> {
    match tempfile::tempfile_in(folder) {
        Ok(_) => Ok(()),
        Err(error) => Err(format!("no file can be written in {}: {error}", folder.display())),
    }
}
